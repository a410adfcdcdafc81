//! Campaigns: many cases of studies, each with other values of some keys.

mod axes;
mod named;
mod platform;
mod read;
mod sample;
mod spec;

pub use platform::{BOUND_OF_RATIO, DAMPER, DAMPERS, RATIO, WORST_RATIO};
pub use read::read_campaign;
pub use spec::{Axis, Campaign, Distribution, Drawing, Each, Platform, Sample, Sampled, Variant};
