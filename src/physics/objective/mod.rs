//! The objective and how it is evaluated: measures, conditions, peaks over speed with their gradients, and surrogates for searches.

#[doc(hidden)]
pub mod between_speeds;
pub mod condition;
mod damage;
mod design_cache;
mod design_peaks;
pub mod duty;
mod duty_means;
mod gradient;
#[doc(hidden)]
pub mod in_operation;
mod local_maxima;
pub mod measure;
mod order_peaks;
pub mod peak;
pub mod peak_search;
mod peak_tracking;
pub mod point_metric;
mod poles;
mod power_peaks;
mod properties;
mod search_value;
mod sharp_resonances;
pub mod speeds;
pub mod statistic;
mod statistic_peaks;
mod strain_peaks;
pub mod surrogate;
mod sweeps;
mod synthesis_peaks;
mod temperature_peaks;

pub use condition::Condition;
pub use damage::Sheared;
pub use design_cache::Shared;
pub use design_peaks::DesignPeaks;
pub use duty::DutyLoad;
pub use measure::{AtExceptedSpeeds, Limit, Measure, Over, Price, Property, Within};
pub use measure::{HELD, holds};
pub use peak::{Peak, Place};
pub(crate) use peak_search::Asked;
pub use peak_search::PeakFinder;
pub use properties::mass;
pub use statistic::{STATISTICS, Statistic};
