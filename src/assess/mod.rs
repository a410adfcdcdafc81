//! Whole studies: models put together, designs evaluated, optima and fronts found.

pub mod amplitude;
pub mod audit;
pub mod auto;
pub mod calibrate;
pub mod comparison;
pub mod conditions;
pub mod evaluate;
pub mod families;
pub mod methods;
pub mod probe;
pub mod run;
pub mod speed_accuracy;
pub mod stability;
pub mod sweeps;

pub use calibrate::{Calibration, calibrate};
pub use comparison::{Comparison, compare};
pub use conditions::ConditionResult;
pub use evaluate::{DesignResult, Nature, PeakKind};
pub use run::{FrontResult, OptimumResult, Results, Timing, run};
pub use sweeps::Sweeps;

/// Told of progress.
pub trait Progress: Sync {
    /// A stage of `steps` steps begins.
    fn stage(&self, name: &str, steps: usize);
    /// A step is done.
    fn step(&self);
}

/// Says nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Progress for Silent {
    fn stage(&self, _: &str, _: usize) {}
    fn step(&self) {}
}

/// A response that does not exist, and whose.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{what}: {error}")]
pub struct RunError {
    /// Design or optimum.
    pub what: String,
    /// Why.
    pub error: crate::response::ResponseError,
}
