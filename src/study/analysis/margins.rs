//! Margins of the crank over the speeds of the study, for tables and plots, and the smallest of each design.

use crate::absorber::Mounted;
use crate::crankshaft::fillets::{Fillet, Worst};
use crate::crankshaft::{self, Margin, Torque, Used};
use crate::input::Study;
use crate::numerics::ZERO;
use crate::numerics::synthesis::Extremes;
use crate::objective::{DesignPeaks, Measure, Over, Peak, PeakFinder};
use crate::response::{Direct, Grid, Quantity, Response, ResponseError, Work};
use rayon::prelude::*;

/// The smallest margin of a design by one criterion.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct SmallestMargin {
    /// Index of the criterion.
    pub criterion: usize,
    /// Safety factor.
    pub margin: f64,
    /// rpm.
    pub speed_rpm: f64,
    /// The location, and what it bears there.
    pub used: Used,
    /// The peak behind it: a largest share of the strength.
    pub peak: Peak,
}

/// A fillet (the worse of its webs) by one criterion over the speeds.
#[derive(Debug, Clone, serde::Serialize)]
pub struct FilletSweep {
    /// Index of the criterion.
    pub criterion: usize,
    /// Name of the fillet.
    pub name: String,
    /// At each speed; the location tells the worst point of a fillet with many.
    pub used: Vec<Used>,
}

/// All fillets of a design.
#[derive(Debug, Clone, serde::Serialize)]
pub struct MarginSweep {
    /// The design.
    pub design: String,
    /// By criterion, then as the locations are listed.
    pub fillets: Vec<FilletSweep>,
    /// Paths over the cycle that multiaxial criteria judged in full, all speeds together.
    pub judged: u64,
}

impl MarginSweep {
    /// Smallest safety factor of all fillets at each speed by a criterion.
    pub fn smallest(&self, criterion: usize) -> Vec<f64> {
        let own: Vec<&FilletSweep> = self.fillets.iter().filter(|f| f.criterion == criterion).collect();
        let count = own.first().map_or(0, |f| f.used.len());
        (0..count).map(|i| 1.0 / own.iter().map(|f| f.used[i].value).fold(0.0, f64::max)).collect()
    }
}

/// The margin model of a study on the speeds of a sweep, with the harmonics of its torque; nothing without `[fatigue]`.
pub fn model(study: &Study, harmonics: &[u32], grid: &Grid) -> Option<Margin> {
    Margin::new(study.engine_of_crank(), &study.chain, study.crank.as_ref()?, study.fatigue.as_ref()?, &grid.speed_rpm, harmonics)
}

/// What the smallest margins are asked with: one measure a criterion.
pub fn measures(study: &Study) -> Vec<Measure> {
    let (Some(fatigue), Some(crank)) = (&study.fatigue, &study.crank) else { return Vec::new() };
    let quantities: Vec<Quantity> = crankshaft::shafts(&study.chain, crank.throws()).into_iter().map(Quantity::ShaftTorque).collect();
    (0..fatigue.criteria.len()).map(|c| Measure::new(quantities.clone(), Over::Margin(c))).collect()
}

/// The smallest margin of a design by each criterion.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance.
pub fn smallest(
    finder: &PeakFinder,
    design: &[Mounted],
    measures: &[Measure],
    work: &mut Work,
) -> Result<Vec<SmallestMargin>, ResponseError> {
    smallest_of(&mut DesignPeaks::new(finder, design, measures.iter()), measures, work)
}

/// The same with what is known of the design.
pub(crate) fn smallest_of(peaks: &mut DesignPeaks, measures: &[Measure], work: &mut Work) -> Result<Vec<SmallestMargin>, ResponseError> {
    let (finder, design) = (peaks.finder, peaks.design);
    let mut list = Vec::new();
    for measure in measures {
        let peak = peaks.peak(measure, work)?;
        let (Some(model), Over::Margin(criterion), Some(peak)) = (finder.margin, measure.over, peak) else { continue };
        let (Quantity::ShaftTorque(shaft), Some(extremes)) = (peak.quantity, peak.extremes) else { continue };
        let mut phasors = vec![ZERO; finder.system.orders()];
        finder.direct.at(design, peak.quantity, peak.speed_rpm, &mut phasors, work)?;
        let used = model.most_used(criterion, shaft, peak.speed_rpm, &Torque { extremes, phasors: &phasors });
        list.extend(used.map(|used| SmallestMargin { criterion, margin: 1.0 / peak.value, speed_rpm: peak.speed_rpm, used, peak }));
    }
    Ok(list)
}

/// Every fillet of a design over the speeds of `grid`. `step`: told of each speed.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance met exactly.
pub fn sweep(
    finder: &PeakFinder,
    grid: &Grid,
    name: &str,
    design: &[Mounted],
    step: &(dyn Fn() + Sync),
) -> Result<Option<MarginSweep>, ResponseError> {
    finder.margin.map(|model| sweep_by(model, finder, grid, (name, design), step)).transpose()
}

/// The same by a model of the margins on the speeds of `grid`.
pub(super) fn sweep_by(
    model: &Margin,
    finder: &PeakFinder,
    grid: &Grid,
    (name, design): (&str, &[Mounted]),
    step: &(dyn Fn() + Sync),
) -> Result<MarginSweep, ResponseError> {
    let direct = Direct::new(finder.system, grid);
    let mut shafts: Vec<usize> = model.locations.iter().map(|l| l.shaft).collect();
    shafts.sort_unstable();
    shafts.dedup();
    let quantities: Vec<Quantity> = shafts.iter().copied().map(Quantity::ShaftTorque).collect();
    let sweeps = direct.sweep_each(design, &quantities, &mut Work::default())?;
    let orders = finder.system.orders();
    let fillets = model.fillets();
    let none = Torque { extremes: Extremes::default(), phasors: &[] };
    let worst_at = |(i, speed): (usize, &f64)| {
        // of all shafts, those beside no throw left out
        let mut torques = vec![none; finder.system.chain.len() - 1];
        for (shaft, sweep) in shafts.iter().zip(&sweeps) {
            let phasors = &sweep[i * orders..(i + 1) * orders];
            torques[*shaft] = Torque { extremes: finder.synthesiser.extremes(phasors), phasors };
        }
        let worst = model.worst_of_each(&fillets, *speed, &torques);
        step();
        worst
    };
    let rows: Vec<Worst> = grid.speed_rpm.par_iter().enumerate().map(worst_at).collect();
    let sweep_of = |(k, fillet): (usize, Fillet)| FilletSweep {
        criterion: fillet.criterion,
        name: fillet.name,
        used: rows.iter().map(|row| row.used[k]).collect(),
    };
    let judged = rows.iter().map(|row| row.judged).sum();
    Ok(MarginSweep { design: name.to_owned(), fillets: fillets.into_iter().enumerate().map(sweep_of).collect(), judged })
}
