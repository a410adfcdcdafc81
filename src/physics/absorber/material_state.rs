//! States of a material.

/// A state of the material of an absorber.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub enum State {
    /// At the lowest temperature of a study.
    Cold,
    /// At the highest one.
    Hot,
    /// Aged.
    Aged,
}
