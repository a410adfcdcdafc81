//! Locations that need not be looked at, since another one is used more whatever the torque.

/// Those of a list that no other one surpasses.
pub(super) fn unsurpassed(list: &[usize], surpasses: impl Fn(usize, usize) -> bool) -> Vec<usize> {
    list.iter().copied().filter(|b| !list.iter().any(|a| a != b && surpasses(*a, *b))).collect()
}
