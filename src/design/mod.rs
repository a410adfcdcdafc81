//! Absorber design: what may vary, what is to be small, and the one pipeline from values to peaks.

pub mod condition;
mod gradient;
pub mod level;
mod local;
pub mod margin;
pub mod measure;
pub mod peaks;
mod poles;
pub mod problem;
pub mod quick;
mod searched;
pub mod space;
pub mod speeds;

pub use condition::Condition;
pub use margin::{FatigueSpec, Margin, MarginCriterion};
pub use measure::{Limit, Measure, Over};
pub use peaks::{Peak, PeakFinder, Place};
pub use problem::{Problem, Row, Rows, Scene};
pub use space::{Parameter, Space, Variable};
