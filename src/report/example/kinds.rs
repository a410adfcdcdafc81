//! What an example is of: how cylinders stand, what is known of the gas, and a chain and pressures of one's own.

use crate::input::{FoundChain, FoundTraces};

/// How cylinders stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[doc(hidden)]
pub enum Arrangement {
    InLine,
    V,
}

/// What is known of the gas.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[doc(hidden)]
pub enum Gas {
    Wiebe,
    Otto,
    Measured,
    Harmonics,
}

/// What an example is of.
#[derive(Debug, Clone)]
#[doc(hidden)]
pub struct Example {
    pub arrangement: Arrangement,
    pub cylinders: usize,
    pub gas: Gas,
    /// A chain of one's own in place of that of the example.
    pub chain: Option<FoundChain>,
    /// Pressures of one's own in place of those of the example.
    pub traces: Option<FoundTraces>,
}
