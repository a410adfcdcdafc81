//! Optimisation: the problem and its variables, starts, gradient-free search, sequential quadratic minimax, and the front over ring inertia.

mod adaptive_levels;
pub mod allocation;
#[doc(hidden)]
pub mod assignment;
pub mod checkpoint;
#[doc(hidden)]
pub mod conflict;
mod curvature;
pub mod front;
pub mod gradient_free;
mod load_case;
mod lower_elsewhere;
pub mod minimax;
mod operation;
pub mod problem;
#[doc(hidden)]
pub mod proof;
pub mod robust;
mod scatter;
pub mod search;
#[doc(hidden)]
pub mod second_order;
#[doc(hidden)]
pub mod shadow_prices;
pub mod starts;
mod subproblem;
#[doc(hidden)]
pub mod survey;
mod symmetry;
mod termination;
pub mod tradeoff;
pub mod variables;
#[doc(hidden)]
pub mod verification_scan;

pub use checkpoint::{BestSoFar, Memory, Remembers, Sought};
pub use conflict::{Conflict, Party};
pub use front::{Front, FrontPoint};
pub use load_case::largest;
pub use load_case::{Engine, LoadCase};
pub use minimax::Outcome;
pub use problem::{Problem, Role, Row, Rows};
pub use proof::{Effort, ExcludingSpeed, Exclusion, Exclusions, Proof, Reason, Verdict};
pub use robust::Tolerances;
pub use scatter::Scatter;
pub use search::{LocalOptimum, Optimum, Stages, Start};
pub use second_order::SecondOrder;
pub use shadow_prices::OnBound;
pub use survey::Survey;
pub use symmetry::Interchange;
pub use termination::Stop;
pub use tradeoff::{Tradeoff, TradeoffPoint};
pub use variables::{Slot, Space, Variable};
pub use verification_scan::{Nearby, Scan};
