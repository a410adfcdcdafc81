//! What the smallest margin of a design costs by each criterion: by whole histories, by the corners of plane ones, and where bounds leave most of them out.

use crate::absorber::Mounted;
use crate::analysis::timing::{Repeats, median_seconds};
use crate::analysis::{RunError, margins};
use crate::crankshaft::{Margin, Torque};
use crate::drivetrain::System;
use crate::engine::Excitation;
use crate::input::Study;
use crate::objective::{Over, PeakFinder};
use crate::response::{Direct, Grid, Method, Quantity, Response, ResponseError, Work};
use std::time::Instant;

/// The margin by one criterion, every fillet and speed of the study.
#[derive(Debug, Clone, PartialEq)]
pub struct MarginCost {
    /// Its word.
    pub criterion: &'static str,
    /// Seconds by whole histories, from some of them; nothing by criteria that ask for extremes only.
    pub whole: Option<f64>,
    /// Seconds where every fillet is evaluated at every speed, by corners.
    pub all: f64,
    /// Largest relative difference of the two.
    pub difference: f64,
    /// Seconds with bounds.
    pub bounds: f64,
    /// Relative difference of the smallest margin from that of all.
    pub missed: f64,
}

/// Every so many speeds are evaluated by whole histories.
const STRIDE: usize = 40;
const REPEATS: Repeats = Repeats { least: 1, most: 7, seconds: 0.2 };

/// For one design on one thread; nothing without `[fatigue]`.
///
/// # Errors
/// [`RunError`] where it has no finite response.
pub fn measure(study: &Study, (name, design): (&str, &[Mounted])) -> Result<Vec<MarginCost>, RunError> {
    let excitation = Excitation::new(&study.engine, study.order_limit);
    let system = System::with_modes(study.chain.clone(), study.modes.clone(), excitation);
    let grid = Grid::new(&study.speeds_rpm, &[]);
    let Some(model) = margins::model(study, &system.excitation.harmonics, &grid) else { return Ok(Vec::new()) };
    let method = Method::Direct(Direct::new(&system, &grid));
    let finder = PeakFinder::new(&system, &grid, &method, false).with_margin(Some(&model));
    costs(study, &finder, &model, design).map_err(|error| RunError { what: format!("design `{name}`"), error })
}

fn costs(study: &Study, finder: &PeakFinder, model: &Margin, design: &[Mounted]) -> Result<Vec<MarginCost>, ResponseError> {
    let orders = finder.system.orders();
    let shafts: Vec<Quantity> = (0..finder.system.chain.len() - 1).map(Quantity::ShaftTorque).collect();
    let sweeps = finder.direct.sweep_each(design, &shafts, &mut Work::default())?;
    let extremes: Vec<_> = sweeps.iter().map(|s| finder.extremes(s)).collect();
    let speeds = &finder.grid.speed_rpm;
    let torque = |shaft: usize, i: usize| Torque { extremes: extremes[shaft][i], phasors: &sweeps[shaft][i * orders..(i + 1) * orders] };
    let mut list = Vec::new();
    for measure in margins::measures(study) {
        let Over::Margin(criterion) = measure.over else { continue };
        let spots: Vec<(usize, usize)> = (0..shafts.len()).flat_map(|s| model.spots_of(criterion, s).map(move |l| (s, l))).collect();
        let mut largest = 0.0;
        let all = median_seconds(REPEATS, || {
            largest = 0.0;
            for (i, speed) in speeds.iter().enumerate() {
                for (shaft, location) in &spots {
                    largest = f64::max(largest, model.used(criterion, *location, *speed, &torque(*shaft, i)).value);
                }
            }
            Ok(())
        })?;
        let (mut difference, mut evaluated, begun) = (0.0_f64, 0_usize, Instant::now());
        let mut shares = Vec::new();
        for (i, speed) in speeds.iter().enumerate().step_by(STRIDE) {
            for (shaft, location) in &spots {
                if let Some(share) = model.used_by_whole_history(criterion, *location, *speed, &torque(*shaft, i)) {
                    shares.push((i, *shaft, *location, share));
                    evaluated += 1;
                }
            }
        }
        let seconds = begun.elapsed().as_secs_f64();
        for (i, shaft, location, share) in shares {
            let own = model.used(criterion, location, speeds[i], &torque(shaft, i)).value;
            difference = difference.max((own / share - 1.0).abs());
        }
        let mut found = 0.0;
        let bounds = median_seconds(REPEATS, || {
            found = finder.peak(design, &measure, &mut Work::default())?.map_or(0.0, |p| p.value);
            Ok(())
        })?;
        list.push(MarginCost {
            criterion: model.criteria[criterion].name(),
            whole: (evaluated > 0).then(|| seconds / evaluated as f64 * (spots.len() * speeds.len()) as f64),
            all,
            difference,
            bounds,
            missed: (found / largest - 1.0).abs(),
        });
    }
    Ok(list)
}
