//! Optimisation: the problem and its variables, starts, gradient-free search, sequential quadratic minimax, and the front over ring inertia.

pub(crate) mod conflict;
mod curvature;
pub mod front;
pub mod gradient_free;
mod interchange;
mod levels;
pub mod memory;
pub mod minimax;
pub(crate) mod prices;
pub mod problem;
pub mod robust;
pub(crate) mod scan;
pub mod search;
pub(crate) mod second_order;
pub mod starts;
mod stop;
mod subproblem;
pub mod tradeoff;
pub mod variables;

pub use conflict::{Conflict, Party};
pub use front::{Front, FrontPoint};
pub(crate) use interchange::Interchange;
pub use memory::{Found, Memory, Remembers, Sought};
pub use minimax::Outcome;
pub use prices::OnBound;
pub(crate) use problem::largest;
pub use problem::{LoadCase, Problem, Role, Row, Rows};
pub use robust::Tolerances;
pub use scan::{Nearby, Scan};
pub use search::{LocalOptimum, Optimum, Stages, Start};
pub use second_order::SecondOrder;
pub use stop::Stop;
pub use tradeoff::{Tradeoff, TradeoffPoint};
pub use variables::{Slot, Space, Variable};
