//! Tables with the columns of the contract. Numbers in the shortest form that reads back exactly; what does not apply is empty.

mod absorbers;
mod barred;
pub mod chart;
mod comparison;
pub mod curves;
mod designs;
mod duty;
pub mod fatigue;
mod front;
mod heat;
mod large_twist;
mod limits;
pub mod margin;
mod optima;
mod pareto;
mod response;
mod sensitivities;
pub mod sizing;
mod table;
mod timing;

pub use absorbers::absorbers;
pub use barred::barred;
pub use comparison::{calibration, comparison};
pub use designs::designs;
pub use duty::duty;
pub use front::front;
pub use heat::heat;
pub use large_twist::large_twist;
pub use limits::limits;
pub use optima::optima;
pub use pareto::pareto;
pub use response::response;
pub use sensitivities::sensitivities;
pub(crate) use table::in_unit;
pub use table::number;
pub use timing::timing;
