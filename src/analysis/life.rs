//! How long what an absorber shears lasts over a duty: cycles of the strain of all orders together, counted over the working cycle at each point.

use crate::absorber::{Mounted, StrainLife};
use crate::drivetrain::System;
use crate::input::DutyPoint;
use crate::numerics::rainflow::amplitudes;
use crate::numerics::synthesis::Synthesiser;
use crate::response::{Direct, Grid, Quantity, ResponseError, Work};
use crate::units::RAD_PER_S_PER_RPM;
use std::f64::consts::TAU;

/// At one point of a duty.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct LifeAt {
    /// The point.
    pub point: DutyPoint,
    /// Largest amplitude of shear strain of a counted cycle.
    pub strain: f64,
    /// Counted cycles an hour.
    pub cycles_per_h: f64,
    /// Share of the life that an hour there takes.
    pub damage_per_h: f64,
}

/// Of one absorber.
#[derive(Debug, Clone, serde::Serialize)]
pub struct LifeOverDuty {
    /// Its index in the design.
    pub absorber: usize,
    /// In the order of the study.
    pub points: Vec<LifeAt>,
}

impl LifeOverDuty {
    /// Hours until the damage of the duty adds up to one; infinite where nothing is sheared.
    pub fn hours(&self) -> f64 {
        1.0 / self.points.iter().map(|p| p.point.share * p.damage_per_h).sum::<f64>()
    }
}

/// Of every absorber whose material says how many cycles of strain it bears, at its reference temperature and strain.
pub(super) fn over<'s>(
    duty: impl Iterator<Item = (DutyPoint, &'s System)> + Clone,
    design: &[Mounted],
) -> Result<Vec<LifeOverDuty>, ResponseError> {
    let known = |(absorber, m): (usize, &Mounted)| {
        let material = m.absorber.law()?.material()?;
        Some((absorber, material.life?, material.geometry?.strain_per_twist()))
    };
    let of = |(absorber, life, per_twist): (usize, StrainLife, f64)| {
        let points =
            duty.clone().map(|(point, system)| at(system, design, point, (absorber, life, per_twist))).collect::<Result<_, _>>()?;
        Ok(LifeOverDuty { absorber, points })
    };
    design.iter().enumerate().filter_map(known).map(of).collect()
}

fn at(
    system: &System,
    design: &[Mounted],
    point: DutyPoint,
    (absorber, life, per_twist): (usize, StrainLife, f64),
) -> Result<LifeAt, ResponseError> {
    let grid = Grid::new(&[point.speed_rpm], &[]);
    let direct = Direct::new(system, &grid);
    let phasors = direct.at_each(design, &[Quantity::RingTwist(absorber)], &[point.speed_rpm], &mut Work::default())?.swap_remove(0);
    let turns = Synthesiser::new(&system.excitation.harmonics).turning_points(&phasors);
    let strains: Vec<f64> = amplitudes(&turns).into_iter().map(|a| per_twist * a).collect();
    // the first harmonic of the synthesis goes through one period a working cycle
    let excitation = &system.excitation;
    let order_of_cycle = excitation.orders[0].value() / f64::from(excitation.harmonics[0]);
    let rounds_per_h = 3600.0 * order_of_cycle * point.speed_rpm * RAD_PER_S_PER_RPM / TAU;
    Ok(LifeAt {
        point,
        strain: strains.iter().copied().fold(0.0, f64::max),
        cycles_per_h: rounds_per_h * strains.len() as f64,
        damage_per_h: rounds_per_h * strains.iter().map(|s| life.damage(*s)).sum::<f64>(),
    })
}
