//! What designs do at the points of a duty: speeds and loads at which the engine runs for shares of its time.

use super::DesignResult;
use super::life::{self, LifeOverDuty};
use crate::absorber::Mounted;
use crate::drivetrain::System;
use crate::engine::{Engine, Excitation, Load, Source};
use crate::input::{DutyPoint, Study};
use crate::numerics::synthesis::Synthesiser;
use crate::objective::DutyLoad;
use crate::response::{Direct, Grid, Quantity, ResponseError, Work};

/// A design at one point of the duty.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct DutyResult {
    /// The point.
    pub point: DutyPoint,
    /// Half peak-to-peak twist, rad.
    pub twist: f64,
    /// Largest vibratory torque of a shaft, N m.
    pub torque: f64,
    /// Mean power dissipated in all absorbers, W.
    pub power: f64,
}

/// A design over the duty.
#[derive(Debug, Clone, serde::Serialize)]
pub struct DutyOfDesign {
    /// Its name.
    pub design: String,
    /// In the order of the study.
    pub points: Vec<DutyResult>,
    /// Of absorbers whose material says how many cycles of strain it bears.
    pub lives: Vec<LifeOverDuty>,
}

impl DutyOfDesign {
    /// Mean of the dissipated power over the duty, W.
    pub fn mean_power(&self) -> f64 {
        self.points.iter().map(|p| p.point.share * p.power).sum()
    }
}

/// The engine at a share of its full load.
fn at_load(engine: &Engine, point: &DutyPoint) -> Option<Engine> {
    let Source::Cylinder { geometry, pressure } = &engine.source else { return None };
    let pressure = pressure.at_load(&Load::constant(point.load_fraction), (point.speed_rpm, point.speed_rpm))?;
    Some(Engine { source: Source::Cylinder { geometry: geometry.clone(), pressure }, ..engine.clone() })
}

/// The points of the duty where a measure of the study asks for them; else none.
#[doc(hidden)]
pub fn points(study: &Study) -> Vec<DutyLoad> {
    if study.measures().any(|m| m.measure.over.asks_for_duty()) { systems(study).map(|s| s.1).collect() } else { Vec::new() }
}

fn systems(study: &Study) -> impl Iterator<Item = (DutyPoint, DutyLoad)> + '_ {
    study.duty.iter().filter_map(|point| {
        let engine = at_load(&study.engine, point)?;
        let excitation = study.with_radial(Excitation::new(&engine, study.order_limit), &engine);
        let system = study.system(excitation);
        Some((*point, DutyLoad { share: point.share, speed_rpm: point.speed_rpm, system }))
    })
}

/// Every design at every point; empty without a duty.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance met exactly, with the name of the design.
#[doc(hidden)]
pub fn duty<'d>(study: &Study, shown: &[&'d DesignResult]) -> Result<Vec<DutyOfDesign>, (&'d DesignResult, ResponseError)> {
    let systems: Vec<(DutyPoint, DutyLoad)> = systems(study).collect();
    let all = |d: &&'d DesignResult| {
        let points = systems.iter().map(|(point, system)| at(study, &system.system, *point, &d.absorbers)).collect::<Result<_, _>>();
        let lives = life::over(systems.iter().map(|(point, system)| (*point, &system.system)), &d.absorbers);
        let failed = |error| (*d, error);
        Ok(DutyOfDesign { design: d.name.clone(), points: points.map_err(failed)?, lives: lives.map_err(failed)? })
    };
    if systems.is_empty() { Ok(Vec::new()) } else { shown.iter().map(all).collect() }
}

fn at(study: &Study, system: &System, point: DutyPoint, design: &[Mounted]) -> Result<DutyResult, ResponseError> {
    let grid = Grid::new(&[point.speed_rpm], &[]);
    let direct = Direct::new(system, &grid);
    let shafts = system.chain.len() - 1;
    let mut quantities = vec![study.twist];
    quantities.extend((0..shafts).map(Quantity::ShaftTorque));
    quantities.extend((0..design.len()).map(Quantity::RingTwist));
    let phasors = direct.at_each(design, &quantities, &[point.speed_rpm], &mut Work::default())?;
    let synthesiser = Synthesiser::new(&system.excitation.harmonics);
    let half = |i: usize| synthesiser.extremes(&phasors[i]).half_peak_to_peak;
    let power = |i: usize| direct.power_of_twist(design, i, point.speed_rpm, &phasors[1 + shafts + i]);
    Ok(DutyResult {
        point,
        twist: half(0),
        torque: (1..=shafts).map(half).fold(0.0, f64::max),
        // an empty sum would be -0
        power: (0..design.len()).map(power).fold(0.0, |sum, p| sum + p),
    })
}
