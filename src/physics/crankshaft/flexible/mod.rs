//! The crank in bending, torsion and axial motion on its bearings, as beams and bodies in axes that turn with it.
//!
//! Journals and pins are round beams, each web one beam from axis to axis with factors on its stiffness ([`WebFactors`]), the ends of webs beyond the axes, counterweights, hub and flywheel rigid
//! bodies. Half the reciprocating mass and the rotating part of the rods are points on the pins. Bearings are linear and alike in all directions; each has one node, or three over two
//! thirds of its length.
//!
//! Inertias about the axis are those of the torsional chain: what the steel of a throw lacks is its counterweights, sectors of 120° whose moment
//! balances it as `unbalance` says; where the steel has more than the station, it counts less dense.

mod assembled;
mod assembly;
pub mod imported;
mod matrix_nodes;
mod mean_load;
mod of_beams;
mod of_matrices;
pub mod on_joints;
mod reduced;
mod round_section;
mod row;
mod spec;
mod stiffness;
mod throw;
mod web_factors;
mod web_loads;
mod web_section;

pub use assembled::{Assembled, Balance, Carried};
pub use assembly::assemble;
pub use mean_load::mean_load;
pub use reduced::reduced;
pub use round_section::{Cut, SectionLoad};
pub use spec::{BeamCrank, Bearing, BearingNodes, CarriedRing, CrankBody, End, FlexibleSpec, JointSpec, LinearBearings};
pub use stiffness::{ThrowStiffness, throw_stiffness};
pub use web_factors::WebFactors;
pub use web_loads::{QuasiStatic, WebLoads, in_plane};
pub use web_section::{WebLoad, WebSection};
