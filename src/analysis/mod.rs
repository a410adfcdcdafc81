//! Whole studies: calibration, designs evaluated, optima and fronts found, margins.

pub mod amplitude;
pub mod audit;
pub mod bearings;
pub mod calibrate;
pub mod choice;
pub mod conditions;
pub mod cost;
pub mod curves;
pub mod diagram;
mod duty;
pub mod evaluate;
pub mod families;
pub mod margins;
pub mod progress;
pub(crate) mod reciprocating;
pub mod results;
pub mod run;
mod searches;
pub mod sizing;
pub mod stress_histories;
pub mod sweeps;
pub mod systems;
pub mod timing;
mod tradeoffs;
pub mod wanted;

pub use calibrate::{Calibration, calibrate};
pub use conditions::ConditionResult;
pub use duty::{DutyOfDesign, DutyResult};
pub use evaluate::{AbsorberLoad, DesignResult, Nature, PeakKind};
pub use margins::{MarginSweep, SmallestMargin};
pub use progress::{Progress, RunError, Silent};
pub use results::{Beside, FrontResult, OptimumResult, Results, RowCase, TradeoffResult};
pub use run::run;
pub use sweeps::Sweeps;
pub use timing::Timing;
