//! The location that is used most among some, each known at first by a bound that costs little, then by one that costs more, and evaluated only where it may be the worst.

use super::Used;

/// A location that may be used most.
#[derive(Debug, Clone, Copy)]
pub(super) struct Able {
    pub location: usize,
    /// At least what it uses.
    pub bound: f64,
    /// Whether the bound is the closer one.
    close: bool,
}

impl Able {
    /// With a bound that costs little.
    pub fn new(location: usize, bound: f64) -> Self {
        Self { location, bound, close: false }
    }
}

/// The worst, of level ones the first as they are listed. `closer`: a closer bound, or nothing where the location does not count after all.
pub(super) fn worst(
    mut able: Vec<Able>,
    mut closer: impl FnMut(usize) -> Option<f64>,
    mut used: impl FnMut(usize) -> Used,
) -> Option<Used> {
    let mut most: Option<Used> = None;
    while let Some(k) = (0..able.len()).reduce(|m, k| if able[k].bound > able[m].bound { k } else { m }) {
        let next = able.swap_remove(k);
        if most.is_some_and(|m| next.bound < m.value) {
            break;
        }
        if next.close {
            let own = used(next.location);
            let holds = |m: &Used| m.value > own.value || (m.value == own.value && m.location < own.location);
            most = most.filter(holds).or(Some(own));
        } else if let Some(bound) = closer(next.location) {
            able.push(Able { bound: bound.min(next.bound), close: true, ..next });
        }
    }
    most
}
