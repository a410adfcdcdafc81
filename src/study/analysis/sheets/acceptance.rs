//! The acceptance test: a maker measures one number of each damper, the frequency of the ring on its held hub at the reference temperature of a compound, or the damping of an oil at low speed. Within the band
//! every damper holds all limits, however the rest of it scatters.

use crate::absorber::mounted::with_law;
use crate::absorber::{Deviation, Law, Medium, Mounted, Operating, construction};
use crate::analysis::limits_within::broken;
use crate::drivetrain::natural;
use crate::input::Study;
use crate::optimise::{LoadCase, Scatter, Tolerances};
use crate::units::HZ_PER_RAD_PER_S;
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use rayon::prelude::*;
use std::sync::Arc;

/// The number that is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Measured {
    /// Frequency of the ring on its held hub, Hz.
    FrequencyHz,
    /// Damping of the oil at low speed: braking torque over speed, N m s/rad.
    DampingNMSPerRad,
}

/// Within what every damper holds all limits.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Band {
    /// What is measured.
    pub of: Measured,
    /// As drawn.
    pub drawn: f64,
    /// The least and the most that are accepted; nothing where the design as drawn does not hold all limits with the scatter of the rest.
    pub between: Option<(f64, f64)>,
    /// Whether the band may go on below and above: farther than half of the number as drawn is not looked at.
    pub open: (bool, bool),
}

/// Largest change of the number that is looked at, each way.
const FARTHEST: f64 = 0.5;
/// Steps to there.
const STEPS: usize = 25;
/// Halvings of the step in which a limit breaks.
const HALVINGS: usize = 14;
/// Random deviations of the rest beside the corners, and at the end of the search.
const RANDOM: usize = 8;
const CHECKED: usize = 64;
/// The band is made narrower by this share of it until none of the deviations at its ends breaks a limit.
const NARROWER: f64 = 0.01;

/// Nothing where a material has no such number.
pub(super) fn acceptance(
    study: &Study,
    cases: &[LoadCase],
    (design, index): (&[Mounted], usize),
    (scatter, seed): (&[Scatter], u64),
) -> Option<Band> {
    let law = design[index].absorber.law()?;
    let shape = construction::shape(law.declaration())?;
    let of = match shape.medium {
        Medium::Rubber => Measured::FrequencyHz,
        Medium::Oil => Measured::DampingNMSPerRad,
        // what springs scatter are dimensions, by which frequency and stress change in ways of their own; what pendulums are tuned to shows at speed alone
        Medium::Leaves | Medium::Coils | Medium::Field => return None,
    };
    let drawn = number(of, law.as_ref())?;
    // what is measured stands for hardness or viscosity; temperature is that of the test, then that of the conditions
    let is_measured = |s: &Scatter| matches!(s, Scatter::Hardness(_) | Scatter::Viscosity(_) | Scatter::Temperature(_));
    let rest: Vec<Scatter> = scatter.iter().copied().filter(|s| !is_measured(s)).collect();
    let tolerances = Tolerances::scattered_of(design, &rest);
    let points = |random: usize, seed: u64| -> Vec<Vec<f64>> {
        let mut generator = Xoshiro256PlusPlus::seed_from_u64(seed);
        let corners = if tolerances.edges() == 0 { vec![Vec::new()] } else { tolerances.corners() };
        let middle = vec![0.0; tolerances.edges()];
        let more = (0..if tolerances.edges() == 0 { 0 } else { random }).map(|_| tolerances.sample(false, &mut generator));
        corners.into_iter().chain([middle]).chain(more).collect()
    };
    let holds_at = |measured: f64, points: &[Vec<f64>]| {
        points.par_iter().all(|p| {
            let made = tolerances.at(p);
            let Some(own) = with_number((design, index), &made, of, measured) else { return false };
            broken(study, cases, &own, &made).is_none()
        })
    };
    let some = points(RANDOM, seed);
    if !holds_at(drawn, &some) {
        return Some(Band { of, drawn, between: None, open: (false, false) });
    }
    let end = |sign: f64| {
        let at = |share: f64| drawn * (1.0 + sign * share);
        let mut below = 0.0;
        for step in 1..=STEPS {
            let mut above = FARTHEST * step as f64 / STEPS as f64;
            if holds_at(at(above), &some) {
                below = above;
                continue;
            }
            for _ in 0..HALVINGS {
                let middle = 0.5 * (below + above);
                if holds_at(at(middle), &some) {
                    below = middle;
                } else {
                    above = middle;
                }
            }
            break;
        }
        let more = points(CHECKED, seed.wrapping_add(1));
        while below > 0.0 && !holds_at(at(below), &more) {
            below = (below - NARROWER * FARTHEST).max(0.0);
        }
        at(below)
    };
    let (low, high) = (end(-1.0), end(1.0));
    let is_end = |x: f64| ((x / drawn - 1.0).abs() - FARTHEST).abs() < 1e-9;
    Some(Band { of, drawn, between: Some((low, high)), open: (is_end(low), is_end(high)) })
}

/// What is measured of a law.
fn number(of: Measured, law: &dyn Law) -> Option<f64> {
    match of {
        Measured::FrequencyHz => natural::own(law).map(|omega| omega * HZ_PER_RAD_PER_S),
        Measured::DampingNMSPerRad => Some(damping(law)),
    }
}

/// A design whose damper has this number where it is made so: its modulus, or its viscosity, with the relaxation time that is tied to it, is another one.
fn with_number((design, index): (&[Mounted], usize), made: &Deviation, of: Measured, measured: f64) -> Option<Vec<Mounted>> {
    let deviated = made.of(design);
    let law = deviated[index].absorber.law()?;
    let factor = match of {
        // S is proportional to the modulus: at the frequency asked for it has to carry the ring
        Measured::FrequencyHz => {
            let omega = measured / HZ_PER_RAD_PER_S;
            let s = law.dynamic_stiffness(Operating { omega, shaft_speed: omega });
            law.ring_inertia() * omega * omega / s.re
        }
        Measured::DampingNMSPerRad => measured / damping(law.as_ref()),
    };
    let shape = construction::shape(law.declaration())?;
    // its values are those that are drawn
    let mut values = law.values();
    let strength = shape.material().start;
    values[strength] *= factor;
    if of == Measured::DampingNMSPerRad {
        values[strength + 1] *= factor;
    }
    let changed = |law: &Arc<dyn Law>| law.rebuilt(&values);
    (factor.is_finite() && factor > 0.0).then(|| with_law(design, index, changed))
}

/// Damping at low frequency, N m s/rad: Im S/omega where omega is small.
pub(super) fn damping(law: &dyn Law) -> f64 {
    const LOW: f64 = 1e-6;
    law.dynamic_stiffness(Operating { omega: LOW, shaft_speed: LOW }).im / LOW
}
