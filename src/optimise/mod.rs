//! Optimisation: the problem and its variables, starts, gradient-free search, sequential quadratic minimax, and the front over ring inertia.

pub mod front;
pub mod gradient_free;
pub mod minimax;
pub mod problem;
pub mod search;
pub mod starts;
mod subproblem;
pub mod tradeoff;
pub mod variables;

pub use front::{Front, FrontPoint};
pub use minimax::{Outcome, Stop};
pub(crate) use problem::largest;
pub use problem::{LoadCase, Problem, Role, Row, Rows};
pub use search::{Optimum, Scan, Stages, Start};
pub use tradeoff::{Tradeoff, TradeoffPoint};
pub use variables::{Slot, Space, Variable};
