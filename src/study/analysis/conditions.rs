//! A design in a load case with a fault: a cylinder misfires, the cylinders burn unequally, the absorber is locked or lost.

use super::RunError;
use super::evaluation_plan::{EvaluationPlan, asked, shafts};
use super::systems::engines_in;
use crate::absorber::Mounted;
use crate::objective::in_operation::absorbers;
use crate::objective::{Condition, DesignPeaks, Measure, Over, Peak, PeakFinder};
use crate::response::{ResponseError, Work};
use rayon::prelude::*;

/// Numbers of a design in such a load case, SI.
#[derive(Debug, Clone, serde::Serialize)]
pub struct ConditionResult {
    /// The condition.
    pub condition: Condition,
    /// Of a misfire: the cylinder (from 0) with the largest objective.
    pub cylinder: Option<usize>,
    /// Synthesised twist.
    pub twist: Option<Peak>,
    /// Synthesised vibratory torque of all shafts; of a misfire the largest of all cylinders.
    pub torque: Option<Peak>,
    /// The study's objective.
    pub objective: f64,
    /// Value of each limited measure over its limit; of a misfire the largest of all cylinders.
    pub limits: Vec<f64>,
}

/// Evaluates a design in every condition of the study that makes a difference to it. `finders`: of the engine as it should be, then of those whose
/// cylinders differ.
///
/// # Errors
/// [`RunError`] where nothing damps a resonance, with the condition.
pub(crate) fn in_conditions(
    finders: &[PeakFinder],
    name: &str,
    design: &[Mounted],
    wanted: &EvaluationPlan,
    work: &mut Work,
) -> Result<Vec<ConditionResult>, RunError> {
    let failed = |condition: Condition, error| RunError { what: format!("{name}, {}", condition.name().replace('_', " ")), error };
    let one = |condition: Condition, finder: &PeakFinder| -> Result<(ConditionResult, Work), ResponseError> {
        let cylinder = finder.system.excitation.units.misfiring();
        let (design, mut work) = (absorbers(condition, finder, design)?, Work::default());
        let (twist, shafts) = (Measure::new(vec![wanted.twist], Over::Synthesis), Measure::new(shafts(finder), Over::Synthesis));
        let mut peaks = DesignPeaks::new(finder, &design, [&twist, &shafts].into_iter().chain(wanted.asked()));
        let twist = peaks.peak(&twist, &mut work)?;
        let torque = if shafts.quantities.is_empty() { None } else { peaks.peak(&shafts, &mut work)? };
        let (objective, limits) = asked(&mut peaks, wanted, &mut work)?;
        Ok((ConditionResult { condition, cylinder, twist, torque, objective, limits }, work))
    };
    let mut results = Vec::new();
    for &condition in &wanted.conditions {
        let found: Vec<(ConditionResult, Work)> = match condition {
            Condition::Firing => continue,
            _ if condition.changes_nothing(design) => continue,
            _ => {
                let engines: Vec<&PeakFinder> = engines_in(condition, finders).collect();
                let found = engines.into_par_iter().map(|finder| one(condition, finder)).collect::<Result<_, _>>();
                found.map_err(|e| failed(condition, e))?
            }
        };
        found.iter().for_each(|f| *work += f.1);
        let limits = (0..wanted.limits.len()).map(|l| found.iter().map(|f| f.0.limits[l]).fold(0.0, f64::max)).collect();
        // the torque may be largest with another cylinder than the objective
        let torques = found.iter().filter_map(|f| f.0.torque);
        let torque = torques.reduce(|m, t| if t.value > m.value { t } else { m });
        // the first of equals: symmetric engines have several worst cylinders
        let worst = found.into_iter().map(|f| f.0).reduce(|m, f| if f.objective > m.objective * (1.0 + 1e-9) { f } else { m });
        results.extend(worst.map(|w| ConditionResult { limits, torque, ..w }));
    }
    Ok(results)
}
