//! Motions of nodes, and where a shaft moves.

use nalgebra::SVector;

/// Motion of a node, or what acts on it.
pub type Six = SVector<f64, 6>;

/// Factors of unknowns of nodes: a motion, or what acts on it.
pub type Answer = Vec<(usize, usize, f64)>;

/// Where a shaft turns and oscillates, rad/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turning {
    /// Of the oscillation.
    pub omega: f64,
    /// Of the shaft.
    pub speed: f64,
}
