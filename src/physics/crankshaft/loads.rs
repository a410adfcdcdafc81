//! The crank under its loads over the working cycle at one speed: forces on the throws, reactions of the bearings, shear and bending anywhere.

use super::beam::Reactions;
use super::{Beam, Crank, elements, singularity};
use crate::engine::Engine;
use crate::engine::cycle::{Cycle, ThrowLoads, pin_angles};
use crate::numerics::elementary::Elementary;
use crate::units::RAD_PER_S_PER_RPM;
use hartog_kernel::kernel;

/// Every so many samples of the pressure, 0.2° apart: a largest value is met within 1e-4 of itself.
#[doc(hidden)]
pub const STRIDE: usize = 2;

/// Loads of a section over the cycle: moment in the plane of the throw, across it, shear force in the plane.
pub(crate) type Section = [Vec<f64>; 3];

/// What does not depend on speed.
#[derive(Debug, Clone)]
pub struct CrankModel<'a> {
    cycle: Cycle<'a>,
    crank: &'a Crank,
    /// Sine and cosine of the angle of every throw at every sample.
    turns: Vec<Vec<(f64, f64)>>,
    beam: Beam,
    reactions: Reactions,
    /// Front and rear web of every throw.
    webs: Vec<[Influence; 2]>,
}

/// Moment and shear force at a section per force at every rod.
#[derive(Debug, Clone)]
struct Influence {
    moment: Vec<f64>,
    shear: Vec<f64>,
}

/// Loads at a section in axes of a throw: a sample each.
#[derive(Debug, Clone, Default)]
pub struct InPlane {
    /// Moment in the plane of the throw, N m.
    pub moment: Vec<f64>,
    /// Shear force in that plane, N.
    pub shear: Vec<f64>,
    /// Moment across it, N m.
    pub tangential: Vec<f64>,
}

/// (place in m, value) along the crank, in the plane of a throw and across it.
#[doc(hidden)]
pub type InPlanes = [Vec<(f64, f64)>; 2];

impl<'a> CrankModel<'a> {
    /// Reactions by beam elements. Nothing where the torque comes from a table.
    pub fn new(engine: &'a Engine, crank: &'a Crank) -> Option<Self> {
        Self::with(engine, crank, elements::reactions)
    }

    /// Reactions by the singularity functions of \[Villalva 2014\]: the same but for rounding.
    pub fn thesis(engine: &'a Engine, crank: &'a Crank) -> Option<Self> {
        Self::with(engine, crank, singularity::reactions)
    }

    fn with(engine: &'a Engine, crank: &'a Crank, method: fn(&Beam) -> Option<Reactions>) -> Option<Self> {
        let beam = crank.beam();
        let reactions = method(&beam)?;
        let section = |x: f64| Influence { moment: beam.moment_at(&reactions, x), shear: beam.shear_at(&reactions, x) };
        let webs = (0..crank.throws()).map(|t| [section(crank.places(t)[0]), section(crank.places(t)[2])]).collect();
        let cycle = Cycle::new(engine)?;
        let theta = cycle.theta(STRIDE);
        let turns = pin_angles(engine).iter().map(|angle| theta.iter().map(|theta| (theta + angle).sine_cosine()).collect()).collect();
        Some(Self { cycle, crank, turns, beam, reactions, webs })
    }

    /// The loads at a speed, rpm.
    pub fn at(&self, speed_rpm: f64) -> CrankLoads<'_> {
        self.in_place_of(ThrowLoads::default(), speed_rpm)
    }

    /// The same in the place of others, which are not needed any more.
    pub(super) fn in_place_of(&self, mut loads: ThrowLoads, speed_rpm: f64) -> CrankLoads<'_> {
        self.cycle.loads_into(speed_rpm, STRIDE, &mut loads);
        let ThrowLoads { theta, torque, rod_force } = loads;
        let rods = self.crank.rods;
        // what turns with a throw acts at its middle: half on each of two rods
        let outward = self.crank.unbalance * (speed_rpm * RAD_PER_S_PER_RPM).powi(2) / rods as f64;
        let mut forces = rod_force;
        for (rod, forces) in forces.iter_mut().enumerate() {
            for ([x, y], (sine, cosine)) in forces.iter_mut().zip(&self.turns[rod / rods]) {
                *x += outward * cosine;
                *y += outward * sine;
            }
        }
        CrankLoads { model: self, theta, torque, forces }
    }
}

/// The loads at one speed.
#[derive(Debug, Clone)]
pub struct CrankLoads<'a> {
    model: &'a CrankModel<'a>,
    /// Crank angle of every sample, rad.
    pub theta: Vec<f64>,
    /// Torque of every throw, mean included, N m.
    pub torque: Vec<Vec<f64>>,
    /// Force at every rod in axes of the engine, N: that of the rod and its part of what turns with the crank. A row a cylinder.
    pub forces: Vec<Vec<[f64; 2]>>,
}

impl CrankLoads<'_> {
    /// Their place, for others.
    pub(super) fn place(self) -> ThrowLoads {
        ThrowLoads { theta: self.theta, torque: self.torque, rod_force: self.forces }
    }

    /// In axes of a throw: radial, tangential.
    fn turned(&self, [x, y]: [f64; 2], j: usize, throw: usize) -> [f64; 2] {
        let (sine, cosine) = self.model.turns[throw][j];
        [x * cosine + y * sine, y * cosine - x * sine]
    }

    /// Rows of the forces on a throw.
    fn rods(&self, throw: usize) -> std::ops::Range<usize> {
        throw * self.model.crank.rods..(throw + 1) * self.model.crank.rods
    }

    /// Force on a throw at a sample, N, in axes of the engine.
    pub fn on_throw(&self, throw: usize, j: usize) -> [f64; 2] {
        self.rods(throw).fold([0.0; 2], |sum, r| [sum[0] + self.forces[r][j][0], sum[1] + self.forces[r][j][1]])
    }

    /// Front or rear web of a throw, the whole crank on all its bearings.
    pub fn web(&self, throw: usize, rear: bool) -> InPlane {
        let influence = &self.model.webs[throw][usize::from(rear)];
        let all: Vec<usize> = (0..self.forces.len()).collect();
        self.section(throw, &all, influence)
    }

    /// One throw on its own two bearings, statically determinate \[IACS UR M53\] section 2.1.1, at distance `at` from the first of them.
    pub fn determinate(&self, throw: usize, at: f64) -> InPlane {
        let crank = self.model.crank;
        let (pitch, start) = (crank.pitch(throw), crank.bearings()[throw]);
        let mut influence = Influence { moment: Vec::new(), shear: Vec::new() };
        for rod in crank.rod_places(throw).iter().map(|x| x - start) {
            // reaction before the section, with the sign of the beam: -F (pitch - x)/pitch
            let before = -(pitch - rod) / pitch;
            influence.moment.push(before * at + (at - rod).max(0.0));
            influence.shear.push(if at > rod { before + 1.0 } else { before });
        }
        let own: Vec<usize> = self.rods(throw).collect();
        self.section(throw, &own, &influence)
    }

    /// Loads at a section in axes of a throw, from the forces at some rods.
    fn section(&self, throw: usize, rods: &[usize], influence: &Influence) -> InPlane {
        let n = self.theta.len();
        let (mut moment, mut shear) = (vec![[0.0; 2]; n], vec![[0.0; 2]; n]);
        for (i, r) in rods.iter().enumerate() {
            add(moment.as_flattened_mut(), influence.moment[i], self.forces[*r].as_flattened());
            add(shear.as_flattened_mut(), influence.shear[i], self.forces[*r].as_flattened());
        }
        let mut own = InPlane { moment: vec![0.0; n], shear: vec![0.0; n], tangential: vec![0.0; n] };
        turn([&moment, &shear], &self.model.turns[throw], [&mut own.moment, &mut own.tangential, &mut own.shear]);
        own
    }

    /// Resultant bending moment at every crankpin at a sample, N m.
    pub(super) fn pin_moments(&self, j: usize) -> Vec<f64> {
        let model = self.model;
        let resultant = |at: &f64| {
            let influence = model.beam.moment_at(&model.reactions, *at);
            let sum = |axis: usize| -> f64 { influence.iter().zip(&self.forces).map(|(i, f)| i * f[j][axis]).sum() };
            sum(0).hypotenuse(sum(1))
        };
        let pins: Vec<f64> = (0..model.crank.throws()).map(|t| model.crank.places(t)[1]).collect();
        pins.iter().map(resultant).collect()
    }

    /// Bending moment in the plane of its throw at the front and rear web of every throw at a sample, N m.
    pub(super) fn web_moments(&self, j: usize) -> Vec<[f64; 2]> {
        let of = |throw: usize, influence: &Influence| {
            let sum = |axis: usize| -> f64 { influence.moment.iter().zip(&self.forces).map(|(i, f)| i * f[j][axis]).sum() };
            self.turned([sum(0), sum(1)], j, throw)[0]
        };
        self.model.webs.iter().enumerate().map(|(t, webs)| [of(t, &webs[0]), of(t, &webs[1])]).collect()
    }

    /// Force of the crank on every main bearing at a sample, N, in axes of the engine; missing bearings left out.
    pub fn bearing_forces(&self, j: usize) -> Vec<[f64; 2]> {
        let reactions = &self.model.reactions.0;
        let on = |b: usize| {
            let sum = |axis: usize| -> f64 { (0..self.forces.len()).map(|t| -reactions[(b, t)] * self.forces[t][j][axis]).sum() };
            [sum(0), sum(1)]
        };
        (0..reactions.nrows()).map(on).collect()
    }

    /// Corners of shear force and bending moment along the crank at a sample, in the plane of a throw and across it.
    pub fn along(&self, j: usize, throw: usize) -> (InPlanes, InPlanes) {
        let beam = &self.model.beam;
        let mut places: Vec<f64> = beam.supports.iter().map(|s| s.at).chain(beam.loads_at.iter().copied()).collect();
        places.sort_by(f64::total_cmp);
        let sum = |influence: Vec<f64>| {
            let along = |axis: usize| -> f64 { influence.iter().zip(&self.forces).map(|(i, f)| i * f[j][axis]).sum() };
            self.turned([along(0), along(1)], j, throw)
        };
        let (mut shear, mut moment) = ([Vec::new(), Vec::new()], [Vec::new(), Vec::new()]);
        let mut before = [0.0; 2];
        for x in places {
            let (after, here) = (sum(beam.shear_at(&self.model.reactions, x)), sum(beam.moment_at(&self.model.reactions, x)));
            for plane in 0..2 {
                shear[plane].extend([(x, before[plane]), (x, after[plane])]);
                moment[plane].push((x, here[plane]));
            }
            before = after;
        }
        (shear, moment)
    }
}

/// Adds a multiple of a row to a sum.
#[kernel]
fn add(sum: &mut [f64], factor: f64, row: &[f64]) {
    for (s, v) in sum.iter_mut().zip(row) {
        *s += factor * v;
    }
}

/// Moment along and across a throw, and shear force along it, from their parts in axes of the engine.
#[kernel]
fn turn([moment, shear]: [&[[f64; 2]]; 2], turns: &[(f64, f64)], [along, across, shear_along]: [&mut [f64]; 3]) {
    let out = along.iter_mut().zip(across).zip(shear_along);
    for (((((a, t), s), [mx, my]), [sx, sy]), (sine, cosine)) in out.zip(moment).zip(shear).zip(turns) {
        *a = mx * cosine + my * sine;
        *t = my * cosine - mx * sine;
        *s = sx * cosine + sy * sine;
    }
}
