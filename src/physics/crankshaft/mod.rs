//! The crank as a structure: bending between its main bearings, stress concentration in its fillets, and the fatigue margin of its critical locations.

pub mod beam;
mod bending;
mod branch_and_bound;
pub mod crank;
pub mod criterion;
pub mod critical_locations;
pub mod elements;
mod evaluation_cache;
#[doc(hidden)]
pub mod fillets;
pub mod flexible;
mod load_paths;
pub mod loads;
pub mod margin;
mod path_bounds;
mod paths;
pub mod section;
pub mod singularity;
pub mod speed_table;
pub mod stress_concentration;
pub mod stress_histories;
pub mod torsion_cases;
mod unit_load_bounds;
pub mod unit_loads;
mod unsurpassed;
mod von_mises;
mod web_paths;

pub use beam::{Beam, Reactions, Support};
pub use crank::{Crank, OilBore, Place};
pub use criterion::{FactorSource, Family, FatigueSpec, FilletSpec, MarginCriterion, MeanBending};
pub use critical_locations::stations_of_throws;
pub use critical_locations::{CriticalLocation, shafts};
pub use evaluation_cache::Known;
pub use margin::{Margin, Torque, Used};
pub use stress_concentration::{Concentration, Geometry as NotchGeometry};
pub use torsion_cases::TorsionCase;
pub use unit_loads::UnitLoads;
pub use von_mises::LargestVonMises;
