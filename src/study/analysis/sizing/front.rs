//! How much lighter a crank may be with an absorber: crank mass against ring inertia, every crank sized to the same factor by the response of its own chain.

use super::response;
use super::results::{FrontPoint, SizeError, crank_mass};
use crate::analysis::{Progress, Silent};
use crate::input::{SizedAbsorber, SizingStudy};
use crate::sizing::Sized;
use rayon::prelude::*;

/// The front: without absorber, then with rings of growing inertia.
///
/// # Errors
/// [`SizeError`] where a point has no crank.
pub(super) fn front(study: &SizingStudy, rigid: &Sized, progress: &dyn Progress) -> Result<Vec<FrontPoint>, SizeError> {
    let rings: Vec<Option<SizedAbsorber>> = std::iter::once(None)
        .chain(study.front.iter().map(|inertia| study.absorber.map(|a| SizedAbsorber { ring_inertia: *inertia, ..a })))
        .collect();
    progress.stage("front of crank mass", rings.len());
    let point = |absorber: &Option<SizedAbsorber>| {
        let (sized, response) = response::agree(study, rigid.clone(), *absorber, &Silent)?;
        let sizes = sized.last().sizes;
        progress.step();
        Ok(FrontPoint {
            ring_inertia: absorber.map_or(0.0, |a| a.ring_inertia),
            crank_mass: crank_mass(study, &sized),
            crankpin_diameter: sizes.crankpin_diameter,
            journal_diameter: sizes.journal_diameter,
            web_breadth: sizes.web_breadth,
            seat_diameter: sizes.seat_diameter,
            response,
        })
    };
    rings.par_iter().map(point).collect()
}
