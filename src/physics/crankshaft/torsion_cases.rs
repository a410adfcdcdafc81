//! Stress of the crank at two instants of the cycle, torsion by the three cases of \[Villalva 2014\] section 7.2: from torques on the throws and half peak-to-peak vibratory torques at the bearings.
//! The chain's own torque with phase over the full cycle needs no such model: it is the response itself ([`super::Margin`]).

use super::loads::CrankLoads;
use crate::engine::Engine;
use crate::fatigue::{Criterion, Cycle, Strength};
use crate::units::RAD_PER_DEG;
use std::f64::consts::PI;

/// From firing to the dead centre at which the exhaust stroke begins, rad.
const TO_EXHAUST: f64 = PI;

/// How torques of the throws and vibratory torques add up along the crank.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TorsionCase {
    /// Both are summed up to the flywheel, eq. (7.20): the flywheel takes all at once. Far too severe for the vibratory torque.
    A,
    /// Each throw loads its own length only, eq. (7.21): an engine that runs free.
    B,
    /// Torques of the throws are summed; of the vibratory torques only the differences between neighbours, eq. (7.22).
    C,
}

impl TorsionCase {
    /// All three.
    pub const ALL: [Self; 3] = [Self::A, Self::B, Self::C];

    /// The letter in studies and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::A => "a",
            Self::B => "b",
            Self::C => "c",
        }
    }

    /// The case of a letter, small or large.
    pub fn of(letter: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|c| c.name().eq_ignore_ascii_case(letter))
    }

    /// Torque in the front half and in the rear half of every throw, N m. `applied`: one a throw. `vibratory`: half peak-to-peak at every bearing, throws + 1; `sign` is
    /// +1 for the largest load and -1 for the smallest, where it acts the other way.
    pub fn halves(self, applied: &[f64], vibratory: &[f64], sign: f64) -> Vec<[f64; 2]> {
        let (mut thrown, mut shaken) = (0.0, 0.0);
        (0..applied.len())
            .map(|i| {
                let before = thrown;
                thrown += applied[i];
                match self {
                    Self::A => shaken += vibratory[i],
                    Self::B => {
                        let own = sign * vibratory[i];
                        let previous = if i > 0 { applied[i - 1] } else { 0.0 };
                        return [previous + own, applied[i] + own];
                    }
                    Self::C => shaken += (vibratory[i] - vibratory[i + 1]).abs(),
                }
                [before + sign * shaken, thrown + sign * shaken]
            })
            .collect()
    }
}

/// The two instants of section 7.3.1 at one speed: where the force of the rods and of what turns with a throw, along the middle of the banks and towards the crankcase, is largest, and where the exhaust stroke of the cylinder begins that
/// fires next to that. The source has the first at the combustion: so it is where gas outweighs the moving masses; at high speed it is where they push the crankpin outwards at the lower dead centre.
#[derive(Debug, Clone, PartialEq)]
pub struct Instants {
    /// Index of their samples.
    pub samples: [usize; 2],
    /// Crank angles, rad.
    pub theta: [f64; 2],
    /// Resultant moment at every crankpin, N m.
    pub moments: [Vec<f64>; 2],
    /// Moment in the plane of its throw at the front and rear web of every throw, N m.
    pub webs: [Vec<[f64; 2]>; 2],
    /// Torque of every throw, N m.
    pub applied: [Vec<f64>; 2],
}

impl Instants {
    /// Of loads at one speed.
    pub fn new(engine: &Engine, loads: &CrankLoads) -> Self {
        let n = loads.theta.len();
        let pushed = |t: usize, j: usize| -loads.on_throw(t, j)[0];
        let (mut throw, mut first) = (0, 0);
        for t in 0..loads.torque.len() {
            for j in 0..n {
                if pushed(t, j) > pushed(throw, first) {
                    (throw, first) = (t, j);
                }
            }
        }
        let cycle = engine.cycle_deg() * RAD_PER_DEG;
        let apart = |firing: f64| {
            let d = (loads.theta[first] - firing).rem_euclid(cycle);
            d.min(cycle - d)
        };
        let firing = engine.layout.firing_on_throw(throw).iter().map(|f| f * RAD_PER_DEG);
        let nearest = firing.reduce(|a, b| if apart(b) < apart(a) { b } else { a }).unwrap_or(0.0);
        let second = ((nearest + TO_EXHAUST).rem_euclid(cycle) / cycle * n as f64) as usize % n;
        let samples = [first, second];
        Self {
            samples,
            theta: samples.map(|j| loads.theta[j]),
            moments: samples.map(|j| loads.pin_moments(j)),
            webs: samples.map(|j| loads.web_moments(j)),
            applied: samples.map(|j| loads.torque.iter().map(|t| t[j]).collect()),
        }
    }
}

/// Local stresses per moment and per torque at crankpins and at journals, factors included, 1/m³.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PerLoad {
    /// Stress per bending moment.
    pub bending: f64,
    /// Whether that is the moment at the web, of factors on its section; otherwise it is the resultant at the crankpin, on its round section.
    pub on_web: bool,
    /// Shear stress per torque.
    pub torsion: f64,
}

/// The half of a throw with the smallest safety factor at its crankpin.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct AtInstants {
    /// From 0.
    pub throw: usize,
    /// Whether it is behind the crankpin.
    pub rear: bool,
    /// Equivalent stress at its crankpin and at its journal, Pa.
    pub cycles: [Cycle; 2],
}

/// Equivalent stresses at crankpin and journal of the half throw with the smallest factor by Goodman at its crankpin, eqs. (7.23) to (7.30). `vibratory`: half peak-to-peak torque at every bearing, N m;
/// `per_load`: of crankpins and journals.
pub fn stresses(case: TorsionCase, at: &Instants, vibratory: &[f64], per_load: [PerLoad; 2], strength: Strength) -> AtInstants {
    let twisting = [case.halves(&at.applied[0], vibratory, 1.0), case.halves(&at.applied[1], vibratory, -1.0)];
    let cycle = |throw: usize, half: usize, place: usize| {
        let PerLoad { bending, on_web, torsion } = per_load[place];
        let moment = |i: usize| if on_web { at.webs[i][throw][half] } else { at.moments[i][throw] };
        let bending = [0, 1].map(|i| moment(i) * bending);
        let torsion = twisting.each_ref().map(|t| t[throw][half] * torsion);
        let combine = |b: f64, t: f64| (b * b + 3.0 * t * t).sqrt();
        Cycle {
            amplitude: combine(0.5 * (bending[0] - bending[1]), 0.5 * (torsion[0] - torsion[1])),
            mean: combine(0.5 * (bending[0] + bending[1]), 0.5 * (torsion[0] + torsion[1])),
        }
    };
    let all = (0..at.moments[0].len()).flat_map(|t| [(t, 0), (t, 1)]);
    let used = |(t, h): (usize, usize)| Criterion::Goodman.utilisation(cycle(t, h, 0), strength).0;
    let (throw, half) = all.reduce(|a, b| if used(b) > used(a) { b } else { a }).unwrap_or((0, 0));
    AtInstants { throw, rear: half == 1, cycles: [cycle(throw, half, 0), cycle(throw, half, 1)] }
}
