//! Life of what an absorber shears, as the share of it that an hour of the duty takes: cycles of the strain of all orders together, counted by rainflow over the working cycle at each point, by Miner's rule.

use super::duty::DutyLoad;
use super::measure::{Measure, Over};
use super::peak::Peak;
use super::peak_search::PeakFinder;
use super::point_metric::DIFFERENCE;
use crate::absorber::construction::strain_derivatives;
use crate::absorber::{Mounted, StrainLife};
use crate::drivetrain::System;
use crate::numerics::rainflow::amplitudes;
use crate::numerics::synthesis::Synthesiser;
use crate::numerics::{C64, ZERO};
use crate::response::{Direct, Quantity, ResponseError, Work};
use crate::units::RAD_PER_S_PER_RPM;
use std::f64::consts::TAU;

/// What an absorber shears.
#[derive(Debug, Clone, Copy)]
#[doc(hidden)]
pub struct Sheared {
    /// Cycles of strain that it bears.
    pub life: StrainLife,
    /// Largest shear strain per twist, 1/rad.
    pub per_twist: f64,
}

/// What an hour at one speed does.
#[derive(Debug, Clone, Copy)]
#[doc(hidden)]
pub struct Hour {
    /// Largest amplitude of shear strain of a counted cycle.
    pub strain: f64,
    /// Counted cycles.
    pub cycles: f64,
    /// Share of the life that they take.
    pub damage: f64,
}

impl Sheared {
    /// Of an absorber whose material says so.
    pub fn of(mounted: &Mounted) -> Option<Self> {
        let law = mounted.absorber.law()?;
        Some(Self { life: law.material()?.life?, per_twist: law.strain_per_twist()? })
    }

    /// An hour at a speed, under orders of the ring's twist.
    pub fn hour(&self, (system, synthesiser): (&System, &Synthesiser), speed_rpm: f64, twist: &[C64]) -> Hour {
        let strains: Vec<f64> = amplitudes(&synthesiser.turning_points(twist)).into_iter().map(|a| self.per_twist * a).collect();
        // the first harmonic of the synthesis goes through one period a working cycle
        let excitation = &system.excitation;
        let order_of_cycle = excitation.orders[0].value() / f64::from(excitation.harmonics[0]);
        let rounds = 3600.0 * order_of_cycle * speed_rpm * RAD_PER_S_PER_RPM / TAU;
        Hour {
            strain: strains.iter().copied().fold(0.0, f64::max),
            cycles: rounds * strains.len() as f64,
            damage: rounds * strains.iter().map(|s| self.life.damage(*s)).sum::<f64>(),
        }
    }
}

impl PeakFinder<'_> {
    /// The damage of an hour of the duty, the largest of the rings, as the only peak of its measure; nothing where none is sheared.
    pub(super) fn damage(&self, design: &[Mounted], measure: &Measure, work: &mut Work) -> Result<Option<Peak>, ResponseError> {
        let mut most: Option<Peak> = None;
        for ring in measure.absorbers() {
            let Some(sheared) = design.get(ring).and_then(Sheared::of) else { continue };
            let mut damage = 0.0;
            for point in self.duty {
                let twist = self.twist_at(design, ring, point, work)?;
                damage += point.share * sheared.hour((&point.system, &self.synthesiser), point.speed_rpm, &twist).damage;
            }
            if damage > most.as_ref().map_or(0.0, |m| m.value) {
                most = Some(Peak::nowhere(damage, Over::Damage, Quantity::RingTwist(ring)));
            }
        }
        Ok(most)
    }

    fn twist_at(&self, design: &[Mounted], ring: usize, point: &DutyLoad, work: &mut Work) -> Result<Vec<C64>, ResponseError> {
        let mut y = vec![ZERO; point.system.orders()];
        Direct::new(&point.system, self.grid).at(design, Quantity::RingTwist(ring), point.speed_rpm, &mut y, work)?;
        work.syntheses += 1;
        Ok(y)
    }

    /// Derivatives of the damage by the parameters of absorber `index`: by central differences along the derivatives of the twist.
    pub(super) fn damage_gradient(
        &self,
        (design, index): (&[Mounted], usize),
        quantity: Quantity,
        work: &mut Work,
    ) -> Result<Vec<f64>, ResponseError> {
        let Quantity::RingTwist(ring) = quantity else { return Ok(Vec::new()) };
        let Some(sheared) = design.get(ring).and_then(Sheared::of) else { return Ok(Vec::new()) };
        let length = |y: &[C64]| y.iter().map(|y| y.norm_sqr()).sum::<f64>().sqrt();
        let mut gradient: Vec<f64> = Vec::new();
        for point in self.duty {
            let twist = self.twist_at(design, ring, point, work)?;
            let direct = Direct::new(&point.system, self.grid);
            let changes = direct.sensitivity(design, index, quantity, 0..point.system.orders(), point.speed_rpm, work)?;
            gradient.resize(changes.first().map_or(0, Vec::len), 0.0);
            for (p, sum) in gradient.iter_mut().enumerate() {
                let change: Vec<C64> = changes.iter().map(|c| c[p]).collect();
                let step = DIFFERENCE * length(&twist) / length(&change);
                if !step.is_finite() {
                    continue;
                }
                let moved = |step: f64| {
                    let y: Vec<C64> = twist.iter().zip(&change).map(|(y, d)| y + d * step).collect();
                    sheared.hour((&point.system, &self.synthesiser), point.speed_rpm, &y).damage
                };
                *sum += point.share * (moved(step) - moved(-step)) / (2.0 * step);
            }
            if let Some(law) = design[index].absorber.law().filter(|_| index == ring) {
                // damage goes with a power of the strain per twist
                let own =
                    sheared.life.exponent * point.share * sheared.hour((&point.system, &self.synthesiser), point.speed_rpm, &twist).damage;
                gradient.iter_mut().zip(strain_derivatives(law.as_ref())).for_each(|(g, d)| *g += own * d);
            }
        }
        Ok(gradient)
    }
}
