//! A chain as it was found in a file of another program.

/// A station as it was found, SI.
#[derive(Debug, Clone, Default, PartialEq)]
#[doc(hidden)]
pub struct FoundStation {
    pub name: String,
    /// kg m².
    pub inertia: f64,
    /// N m/rad; zero for the last.
    pub stiffness_to_next: f64,
    /// N m s/rad.
    pub damping_to_next: f64,
    pub loss_factor_to_next: f64,
    /// N m s/rad.
    pub damping_to_ground: f64,
    /// Numbers of its throws, from 1.
    pub throws: Vec<usize>,
}

/// A chain, and what of the file is not in it.
#[derive(Debug, Clone, Default, PartialEq)]
#[doc(hidden)]
pub struct FoundChain {
    pub stations: Vec<FoundStation>,
    pub left_out: Vec<String>,
}
