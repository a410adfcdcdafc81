//! What is asked for of the curves of a study.

/// What is shown of a study.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Shown {
    /// Speeds of forces and loads, rpm; without any, that of the largest mean torque and the highest.
    pub speeds_rpm: Vec<f64>,
    /// Names of designs; without any, all.
    pub designs: Vec<String>,
    /// Throws, from 0, in figures with a curve a throw; without any, all.
    pub throws: Vec<usize>,
    /// Whether the torque of shafts shows every order, not the largest alone.
    pub all_orders: bool,
}

impl Shown {
    /// The throws of an engine that are shown.
    pub(super) fn throws(&self, count: usize) -> impl Iterator<Item = usize> + '_ {
        (0..count).filter(|t| self.throws.is_empty() || self.throws.contains(t))
    }
}
