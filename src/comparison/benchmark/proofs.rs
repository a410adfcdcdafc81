//! What a proof costs against its gap and the number of free parameters.

use crate::absorber::Declaration;
use crate::analysis::{RunError, Silent, run};
use crate::input::{ProveSpec, Size, Study};
use crate::optimise::{Effort, Verdict};

/// A proof of the first objective.
#[derive(Debug, Clone, PartialEq)]
pub struct ProofCost {
    /// Type of the absorber.
    pub kind: &'static str,
    /// Free parameters.
    pub free: usize,
    /// That was asked for.
    pub gap: f64,
    /// Boxes that were looked at.
    pub boxes: u64,
    /// On all threads.
    pub seconds: f64,
    /// Whether the boxes sufficed.
    pub proved: bool,
}

const GAPS: [f64; 4] = [1e-2, 1e-3, 1e-4, 1e-5];
/// Boxes, at most.
const BOXES: u64 = 100_000;
/// With a free size the ring is between this share of the first size and that size.
const SMALLEST: f64 = 0.5;

/// Proofs of the optima of one absorber of a study: each type with the first size held, and free. None of others.
///
/// # Errors
/// [`RunError`] where no start of a search has a finite response.
pub fn measure(study: &Study) -> Result<Vec<ProofCost>, RunError> {
    let Some(absorber) = study.optimise.as_ref().filter(|o| o.absorbers.len() == 1).map(|o| &o.absorbers[0]) else { return Ok(Vec::new()) };
    let first = match &absorber.size {
        Size::Between(_, high) => *high,
        Size::Each(list) => list[0],
    };
    let mut costs = Vec::new();
    for kind in &absorber.types {
        for size in [Size::Each(vec![first]), Size::Between(SMALLEST * first, first)] {
            for gap in GAPS {
                costs.extend(cost(study, kind, &size, gap)?);
            }
        }
    }
    Ok(costs)
}

/// The study with one type, one size, its first objective and nothing that is not asked here; `None` where there is no proof.
fn cost(study: &Study, kind: &'static Declaration, size: &Size, gap: f64) -> Result<Option<ProofCost>, RunError> {
    let mut own = study.clone();
    (own.front, own.combined, own.robust, own.fatigue) = (None, None, None, None);
    own.designs.clear();
    own.more_objectives.clear();
    let Some(spec) = own.optimise.as_mut() else { return Ok(None) };
    (spec.absorbers[0].types, spec.absorbers[0].size) = (vec![kind], size.clone());
    spec.prove = ProveSpec { effort: Effort { gap, boxes: BOXES }, all: true, file: false };
    let results = run(&own, &Silent)?;
    let Some(found) = results.optima.first() else { return Ok(None) };
    let Some(proof) = found.proof.as_ref().filter(|p| !matches!(p.verdict, Verdict::None(_))) else { return Ok(None) };
    let seconds = results.timing.iter().find(|t| t.stage == "proofs").map_or(0.0, |t| t.seconds);
    let free = found.optimum.outcome.point.len();
    Ok(Some(ProofCost { kind: kind.name, free, gap, boxes: proof.boxes, seconds, proved: proof.verdict == Verdict::Proved }))
}
