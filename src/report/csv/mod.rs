//! Tables with the columns of the contract. Numbers in the shortest form that reads back exactly, in curves over speed (`response.csv`, `margin.csv`) to seven
//! significant digits and phases to 1e-4 degrees; what does not apply is empty.

mod absorbers;
mod barred;
mod catalogue;
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
mod robust;
mod sensitivities;
pub mod sizing;
mod strain;
mod table;
mod timing;
mod values;

pub use absorbers::absorbers;
pub use barred::barred;
pub use catalogue::catalogue;
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
pub use robust::robust;
pub use sensitivities::sensitivities;
pub use strain::strain;
pub(crate) use table::in_unit;
pub use table::number;
pub use timing::timing;
pub use values::values;
