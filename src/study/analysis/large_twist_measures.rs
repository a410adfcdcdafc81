//! Measures of a design at a steady motion of large twist: objective and limits at its own amplitude.

use super::DesignResult;
use crate::drivetrain::System;
use crate::input::LimitSpec;
use crate::numerics::C64;
use crate::numerics::synthesis::Synthesiser;
use crate::objective::{Measure, Over};
use crate::response::Quantity;
use crate::response::large_twist::{Balance, Steady};

/// What a design comes to at its own amplitude.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize, serde::Deserialize)]
pub struct AtLargeTwist {
    /// The study's objective; nothing where harmonic balance does not tell it.
    pub objective: Option<f64>,
    /// Each limited measure over its limit; nothing where harmonic balance does not tell it.
    pub limits: Vec<Option<f64>>,
    /// Whether it is judged by this alone: where dry friction holds it fast at small twist.
    pub alone: bool,
    /// Whether a steady motion is known at every speed.
    pub has_motion: bool,
}

impl AtLargeTwist {
    /// The worse of small twist, where that counts, and of a design's own amplitude. Without a steady motion at some speed it has no objective, and holds no limit over speed: small twist tells nothing of it.
    pub(super) fn judge(&self, design: &mut DesignResult, limits: &[LimitSpec]) {
        if !self.has_motion {
            design.objective = None;
            let over_speed = |l: &LimitSpec| !matches!(l.of.measure.over, Over::Property(_));
            design.limits.iter_mut().zip(limits).filter(|l| over_speed(l.1)).for_each(|l| *l.0 = f64::INFINITY);
            return;
        }
        if let (Some(known), Some(own)) = (&mut design.objective, self.objective) {
            *known = if self.alone { own } else { known.max(own) };
        }
        for (known, own) in design.limits.iter_mut().zip(&self.limits) {
            *known = own.map_or(*known, |own| if self.alone { own } else { known.max(own) });
        }
    }
}

/// A measure that harmonic balance tells: twists, torques and accelerations by all orders or by some, and twist and power of the absorber of large twist itself.
pub(super) struct Told<'a> {
    measure: &'a Measure,
    /// Of each quantity its place among those of a motion; nothing for the absorber's own twist.
    places: Vec<Option<usize>>,
    /// The only harmonic that counts.
    harmonic: Option<usize>,
}

impl<'a> Told<'a> {
    /// A measure of a design whose absorber `index` is of large twist; quantities that it asks for are added to the list. Nothing where harmonic balance does not tell it.
    pub fn new(measure: &'a Measure, index: usize, system: &System, quantities: &mut Vec<Quantity>) -> Option<Self> {
        let own = Quantity::RingTwist(index);
        let harmonic = match measure.over {
            Over::Synthesis | Over::Orders | Over::Statistic(_) => None,
            Over::Order(order) => {
                let excitation = &system.excitation;
                let known = excitation.orders.iter().position(|o| *o == order)?;
                Some(excitation.harmonics[known] as usize)
            }
            Over::Power if measure.quantities == [own] => None,
            Over::Power
            | Over::Temperature
            | Over::Margin(_)
            | Over::Mean
            | Over::AtDuty(_)
            | Over::MeanPower
            | Over::Damage
            | Over::Strain
            | Over::SpringStress
            | Over::Property(_) => {
                return None;
            }
        };
        let mut place = |q: &Quantity| {
            (*q != own).then(|| {
                quantities.iter().position(|known| known == q).unwrap_or_else(|| {
                    quantities.push(*q);
                    quantities.len() - 1
                })
            })
        };
        Some(Self { measure, places: measure.quantities.iter().map(&mut place).collect(), harmonic })
    }

    /// Whether it is the synthesis of a quantity at every speed alike.
    pub fn is(&self, quantity: Quantity) -> bool {
        self.measure.synthesised() == Some(quantity)
    }

    /// Its value at a motion, in what it counts there; zero at speeds where it does not count. The absorber's own twist is the largest from where it rests.
    pub fn value(&self, synthesiser: &Synthesiser, steady: &Steady) -> f64 {
        let within = &self.measure.within;
        if !within.holds(steady.speed_rpm) {
            return 0.0;
        }
        let single = |y: &[C64]| match self.harmonic {
            Some(h) => y.get(h - 1).map_or(0.0, |y| y.norm()),
            None => y.iter().map(|y| y.norm()).fold(0.0, f64::max),
        };
        let one = |place: &Option<usize>| match (self.measure.over, place) {
            (Over::Power, _) => steady.power,
            (Over::Synthesis, Some(i)) => synthesiser.extremes(&steady.quantities[*i]).half_peak_to_peak,
            (Over::Synthesis, None) => largest_from_rest(synthesiser, steady),
            (Over::Statistic(s), place) => (s.0.value)(place.map_or(&steady.twist, |i| &steady.quantities[i])),
            (_, Some(i)) => single(&steady.quantities[*i]),
            (_, None) => single(&steady.twist),
        };
        within.weight(steady.speed_rpm) * self.places.iter().map(one).fold(0.0, f64::max)
    }
}

/// Largest twist of the ring from where it rests, rad.
pub(super) fn largest_from_rest(synthesiser: &Synthesiser, steady: &Steady) -> f64 {
    let ring = synthesiser.extremes(&steady.twist);
    ring.half_peak_to_peak + (ring.middle + steady.mean_twist).abs()
}

/// A synthesiser of the harmonics that are balanced.
pub(super) fn synthesiser(balance: &Balance) -> Synthesiser {
    let all: Vec<u32> = (1..).take(balance.harmonics()).collect();
    Synthesiser::new(&all)
}
