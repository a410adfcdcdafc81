//! Temperatures of an absorber in balance: the heat it dissipates, which depends on its temperature, against the heat that leaves it.
//!
//! F(T) = T - T0 - R P(T) with the temperature T0 of what surrounds it and its resistance R to heat. F is negative at T0; a balance is stable where F rises through zero (R dP/dT < 1), and
//! from cold the lowest one is reached. Three are possible where heating moves the ring's resonance into an order.

use super::DesignResult;
use crate::absorber::{Absorber, Mounted, Thermal, at_temperature};
use crate::input::Study;
use crate::numerics::roots::roots;
use crate::objective::PeakFinder;
use crate::response::{ResponseError, Work};
use crate::units::RAD_PER_S_PER_RPM;
use rayon::prelude::*;

/// A temperature in balance.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Balance {
    /// °C.
    pub celsius: f64,
    /// W.
    pub power: f64,
    /// Whether the absorber returns to it.
    pub stable: bool,
}

/// An absorber at one speed.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct HeatAt {
    /// rpm.
    pub speed_rpm: f64,
    /// All temperatures in balance up to the limit, ascending; none where it overheats.
    pub balances: Vec<Balance>,
    /// Half peak-to-peak twist that the study reports, at the lowest of them or at the limit, rad.
    pub twist: f64,
    /// Power at the limit, W.
    pub power_at_limit: f64,
}

/// The absorber of a design whose material follows temperature, over speed.
#[derive(Debug, Clone, serde::Serialize)]
pub struct HeatOfDesign {
    /// Its name.
    pub design: String,
    /// Index of the absorber.
    pub absorber: usize,
    /// What its material bears, °C.
    pub limit: f64,
    /// By speed.
    pub points: Vec<HeatAt>,
}

impl HeatAt {
    /// The temperature that is reached from cold; nothing where it overheats.
    pub(crate) fn cold_start(&self) -> Option<&Balance> {
        self.balances.first()
    }
}

/// Temperatures of a scan.
const SAMPLES: usize = 40;

/// Every design with an absorber that says what cools it.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance, with the design.
pub(crate) fn heat<'d>(
    study: &Study,
    finder: &PeakFinder,
    shown: &[&'d DesignResult],
) -> Result<Vec<HeatOfDesign>, (&'d DesignResult, ResponseError)> {
    let one = |d: &&'d DesignResult| {
        let of = |m: &Mounted| -> Option<Thermal> { m.absorber.law()?.material()?.thermal };
        let (absorber, thermal) = d.absorbers.iter().enumerate().find_map(|(i, m)| Some((i, of(m)?)))?;
        let at = |speed: &f64| at(study, finder, (&d.absorbers, absorber), &thermal, *speed);
        let points = finder.grid.speed_rpm.par_iter().map(at).collect::<Result<_, _>>();
        let found = points.map(|points| HeatOfDesign { design: d.name.clone(), absorber, limit: thermal.cooling.limit, points });
        Some(found.map_err(|error| (*d, error)))
    };
    shown.iter().filter_map(one).collect()
}

/// The design with the material of one absorber at a temperature.
fn warmed(design: &[Mounted], index: usize, celsius: f64) -> Vec<Mounted> {
    let mut warm = design.to_vec();
    if let Absorber::Ring(law) = &design[index].absorber {
        warm[index].absorber = Absorber::Ring(at_temperature(law, celsius));
    }
    warm
}

fn at(
    study: &Study,
    finder: &PeakFinder,
    (design, index): (&[Mounted], usize),
    thermal: &Thermal,
    speed_rpm: f64,
) -> Result<HeatAt, ResponseError> {
    let (base, resistance) = thermal.cooling.at(speed_rpm * RAD_PER_S_PER_RPM);
    let limit = thermal.cooling.limit;
    let power = |celsius: f64| finder.direct.dissipated_power(&warmed(design, index, celsius), index, speed_rpm, &mut Work::default());
    let mut missing = |celsius: f64| Ok(celsius - base - resistance * power(celsius)?);
    let mut balances = Vec::new();
    // F rises through every other zero, the first among them
    for (i, celsius) in roots(base, limit, SAMPLES, &mut missing)?.into_iter().enumerate() {
        balances.push(Balance { celsius, power: power(celsius)?, stable: i % 2 == 0 });
    }
    let warm = warmed(design, index, balances.first().map_or(limit, |b| b.celsius));
    let phasors = finder.direct.at_each(&warm, &[study.twist], &[speed_rpm], &mut Work::default())?.swap_remove(0);
    Ok(HeatAt { speed_rpm, balances, twist: finder.synthesis(&phasors)[0], power_at_limit: power(limit)? })
}
