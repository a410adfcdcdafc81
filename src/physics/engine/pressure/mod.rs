//! Cylinder pressure against crank angle.
pub mod measured;
pub mod model;
pub mod otto;
mod sampling;
pub mod wiebe;
pub use measured::{Measured, PartLoad};
pub use model::Pressure;
pub use otto::Otto;
pub use sampling::SAMPLE_DEG;
pub(crate) use sampling::each_revolution;
pub use sampling::{sample_angle, samples};
pub use wiebe::Wiebe;
