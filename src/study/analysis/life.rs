//! How long what an absorber shears lasts over a duty: cycles of the strain of all orders together, counted over the working cycle at each point.

use crate::absorber::Mounted;
use crate::drivetrain::System;
use crate::input::DutyPoint;
use crate::numerics::synthesis::Synthesiser;
use crate::objective::Sheared;
use crate::response::{Direct, Grid, Quantity, ResponseError, Work};

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
    let known = |(absorber, m): (usize, &Mounted)| Some((absorber, Sheared::of(m)?));
    let life_of = |(absorber, sheared): (usize, Sheared)| {
        let points = duty.clone().map(|(point, system)| at(system, design, point, (absorber, sheared))).collect::<Result<_, _>>()?;
        Ok(LifeOverDuty { absorber, points })
    };
    design.iter().enumerate().filter_map(known).map(life_of).collect()
}

fn at(system: &System, design: &[Mounted], point: DutyPoint, (absorber, sheared): (usize, Sheared)) -> Result<LifeAt, ResponseError> {
    let grid = Grid::new(&[point.speed_rpm], &[]);
    let direct = Direct::new(system, &grid);
    let twist = direct.at_each(design, &[Quantity::RingTwist(absorber)], &[point.speed_rpm], &mut Work::default())?.swap_remove(0);
    let hour = sheared.hour((system, &Synthesiser::new(&system.excitation.harmonics)), point.speed_rpm, &twist);
    Ok(LifeAt { point, strain: hour.strain, cycles_per_h: hour.cycles, damage_per_h: hour.damage })
}
