//! What a long computation tells while it runs, and what it says when it cannot go on.

use crate::optimise::Memory;

/// Told of progress.
pub trait Progress: Sync {
    /// A stage of `steps` steps begins.
    fn stage(&self, name: &str, steps: usize);
    /// A step is done.
    fn step(&self);
    /// What remembers searches from one run to the next; nothing by itself.
    fn memory(&self) -> Option<&dyn Memory> {
        None
    }
}

/// Says nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Progress for Silent {
    fn stage(&self, _: &str, _: usize) {}
    fn step(&self) {}
}

/// Whatever can go wrong between a file, or the parts of a study, and its results.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Mistakes in input files.
    #[error(transparent)]
    Input(#[from] crate::input::InputError),
    /// Parts that make no study.
    #[error(transparent)]
    Parts(#[from] crate::input::PartsError),
    /// A response that does not exist.
    #[error(transparent)]
    Run(#[from] RunError),
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
