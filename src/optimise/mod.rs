//! Optimisers: gradient-free search, sequential quadratic minimax, their combination from many starts, and the front over ring inertia.

pub mod front;
pub mod gradient_free;
pub mod minimax;
pub mod search;
pub mod starts;
mod subproblem;

pub use front::{Front, FrontPoint};
pub use minimax::{Outcome, Stop};
pub use search::{Optimum, Stages, Start};

/// Told of progress: once for every start and every front point that is done.
pub type Recorder<'a> = &'a (dyn Fn() + Sync);
