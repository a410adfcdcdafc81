//! The whole crank put together.

use super::assembled::{Assembled, Carried, ends};
use super::spec::{CrankBody, FlexibleSpec};
use super::{of_beams, of_matrices};
use crate::crankshaft::Crank;
use crate::drivetrain::Chain;
use crate::engine::cycle::pin_angles;
use crate::engine::{Engine, Source};

/// Puts a crank together on the stations of a chain.
///
/// # Errors
/// In words, where chain and crank do not fit together.
#[doc(hidden)]
pub fn assemble(crank: &Crank, engine: &Engine, chain: &Chain, spec: &FlexibleSpec, carried: Carried) -> Result<Assembled, String> {
    let Source::Cylinder { geometry, .. } = &engine.source else {
        return Err("the torque comes from a table: a flexible crank wants the forces of a cylinder pressure".to_owned());
    };
    let throws = ends(chain, crank.throws())?;
    let angles = pin_angles(engine);
    let on_pin = (angles.as_slice(), geometry.mass_on_pin());
    match &spec.body {
        CrankBody::Beams(own) => of_beams::assemble((crank, chain), (own, spec, carried), throws, on_pin),
        CrankBody::Matrices(own) => of_matrices::assemble((crank, chain), (own, spec, carried), throws, on_pin),
    }
}
