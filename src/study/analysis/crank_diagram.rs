//! Shear, bending and torque along the crank at the angles of the cycle where its most used web is bent most and least.

use super::SmallestMargin;
use crate::absorber::Mounted;
use crate::crankshaft::Margin;
use crate::crankshaft::loads::{CrankModel, InPlanes};
use crate::input::Study;
use crate::numerics::ZERO;
use crate::numerics::elementary::turn;
use crate::objective::PeakFinder;
use crate::response::{Quantity, ResponseError, Work};
use crate::units::DEG_PER_RAD;

/// The crank at one angle of the cycle.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Instant {
    /// Crank angle from the firing of the cylinder that fires at 0°, degrees.
    pub crank_deg: f64,
    /// N, steps.
    pub shear: InPlanes,
    /// N m, corners.
    pub moment: InPlanes,
    /// (place in m, N m): steps.
    pub torque: Vec<(f64, f64)>,
}

/// Diagrams of one design.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Diagram {
    /// The design.
    pub design: String,
    /// rpm.
    pub speed_rpm: f64,
    /// Name of the most used location.
    pub location: String,
    /// Where the bending of its web is largest in magnitude, then at the other end of its range.
    pub instants: [Instant; 2],
    /// Places of the main bearings, m.
    pub bearings: Vec<f64>,
    /// Places of the crankpins, m.
    pub pins: Vec<f64>,
}

/// The diagrams at the smallest margin of a design; nothing where the engine has no cylinder pressure.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance.
pub fn diagram(
    study: &Study,
    model: &Margin,
    finder: &PeakFinder,
    (name, design): (&str, &[Mounted]),
    smallest: &SmallestMargin,
) -> Result<Option<Diagram>, ResponseError> {
    let Some(crank) = &study.crank else { return Ok(None) };
    let location = &model.locations[smallest.used.location];
    let Some(crank_model) = CrankModel::new(study.engine_of_crank(), crank) else { return Ok(None) };
    let loads = crank_model.at(smallest.speed_rpm);
    let bending: Vec<f64> = loads.web(location.throw, location.rear).moment;
    let place = |better: fn(f64, f64) -> bool| (0..bending.len()).fold(0, |m, j| if better(bending[j], bending[m]) { j } else { m });
    let (high, low) = (place(|a, b| a > b), place(|a, b| a < b));
    let order = if bending[high].abs() >= bending[low].abs() { [high, low] } else { [low, high] };
    let chain = &study.chain;
    let shafts: Vec<Quantity> = (0..chain.len() - 1).map(Quantity::ShaftTorque).collect();
    let mut phasors = Vec::new();
    for q in &shafts {
        let mut y = vec![ZERO; finder.system.orders()];
        finder.direct.at(design, *q, smallest.speed_rpm, &mut y, &mut Work::default())?;
        phasors.push(y);
    }
    let pins: Vec<f64> = (0..crank.throws()).map(|t| crank.places(t)[1]).collect();
    let stations: Vec<usize> = (0..crank.throws()).filter_map(|t| chain.stations.iter().position(|s| s.throws.contains(&t))).collect();
    let bearings = crank.bearings();
    let end = bearings[bearings.len() - 1];
    let instant = |j: usize| {
        let cycle_angle = loads.theta[j] / (0.5 * f64::from(study.engine.strokes));
        let mean = model.mean_torque(smallest.speed_rpm);
        let torque = |shaft: usize| -> f64 {
            let harmonics = &finder.system.excitation.harmonics;
            let sum: f64 = harmonics.iter().zip(&phasors[shaft]).map(|(&h, y)| (y * turn(f64::from(h) * cycle_angle)).re).sum();
            sum + mean[shaft]
        };
        // before the first pin, then behind each
        let mut steps = vec![(0.0, torque(stations[0].saturating_sub(1)))];
        steps.extend(pins.iter().zip(&stations).map(|(x, s)| (*x, torque((*s).min(chain.len() - 2)))));
        let (shear, moment) = loads.along(j, location.throw);
        Instant { crank_deg: loads.theta[j] * DEG_PER_RAD, shear, moment, torque: stairs(&steps, end) }
    };
    let instants = order.map(instant);
    Ok(Some(Diagram { design: name.to_owned(), speed_rpm: smallest.speed_rpm, location: location.name.clone(), instants, bearings, pins }))
}

/// Corners of steps that begin at the given places and end at `end`.
fn stairs(steps: &[(f64, f64)], end: f64) -> Vec<(f64, f64)> {
    let next = steps.iter().skip(1).map(|s| s.0).chain([end]);
    steps.iter().zip(next).flat_map(|((x, y), to)| [(*x, *y), (to, *y)]).collect()
}
