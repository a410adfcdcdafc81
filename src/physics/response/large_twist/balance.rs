//! Harmonic balance at one speed: Newton's method with the exact Jacobian, forces by alternating between frequency and time \[Cameron & Griffin 1989\].

use super::harmonic_matrix::{Spectrum, Transform, add_products};
use super::in_time::InTime;
use super::linear::{Linear, Surroundings};
use crate::absorber::{Host, Instant, LargeTwist, Law, Mounted, Operating, Reaction};
use crate::drivetrain::System;
use crate::numerics::{C64, I, ZERO};
use crate::response::{Quantity, ResponseError, Work};
use crate::units::RAD_PER_S_PER_RPM;
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// Steps of Newton's method times the cube of the unknowns: some seconds.
const MOST_WORK: f64 = 1e10;

/// A design with one absorber whose twist is not small.
pub struct Balance<'a> {
    /// The system.
    pub system: &'a System,
    /// The design, that absorber replaced by its hub.
    pub others: Vec<Mounted>,
    /// Its index.
    pub index: usize,
    /// Its law.
    pub law: Arc<dyn Law>,
    /// Its station.
    pub station: usize,
    quantities: Vec<Quantity>,
    transform: Transform,
    /// For stability; nothing where it cannot be told.
    pub(super) in_time: Option<InTime>,
}

/// A steady motion at one speed.
#[derive(Debug, Clone)]
pub struct Steady {
    /// rpm.
    pub speed_rpm: f64,
    /// Mean twist, rad.
    pub mean_twist: f64,
    /// Harmonics of the twist from the first, rad.
    pub twist: Vec<C64>,
    /// Of the hub, rad.
    pub hub: Vec<C64>,
    /// Of each quantity asked for.
    pub quantities: Vec<Vec<C64>>,
    /// Mean torque that the hub gives to the absorber, N m.
    pub mean_torque: f64,
    /// Mean power that the absorber dissipates, W: what the hub does on it.
    pub power: f64,
}

/// Phasors from reals.
fn phasors(x: &[f64]) -> Vec<C64> {
    x.as_chunks::<2>().0.iter().map(|c| C64::new(c[0], c[1])).collect()
}

/// Forces at a motion; of a ring without what its inertia makes of them, which is known by harmonics.
struct Forces {
    own: Spectrum,
    torque: Spectrum,
    /// By twist, rate, acceleration, rate and acceleration of the hub; of a ring by the first two.
    own_by: Vec<Spectrum>,
    torque_by: Vec<Spectrum>,
}

impl<'a> Balance<'a> {
    /// The first absorber of a design whose law is one of large twists, where there is one; with this many harmonics of the working cycle.
    pub fn new(system: &'a System, design: &[Mounted], quantities: &[Quantity], harmonics: usize) -> Option<Self> {
        let (index, law) =
            design.iter().enumerate().find_map(|(i, m)| Some((i, m.absorber.law()?.clone())).filter(|l| l.1.large_twist().is_some()))?;
        let Host::Station(station) = design[index].on else { return None };
        let mut others = design.to_vec();
        others[index] = others[index].locked(0.0);
        let degree = law.large_twist().and_then(|l| l.degree());
        let (in_time, transform) = (InTime::new(system, &others, station), Transform::new(harmonics, degree));
        Some(Self { system, others, index, law, station, quantities: quantities.to_vec(), transform, in_time })
    }

    /// Harmonics of the working cycle.
    pub fn harmonics(&self) -> usize {
        self.transform.harmonics
    }

    pub(super) fn equations(&self) -> &dyn LargeTwist {
        self.law.large_twist().expect("chosen for its equations")
    }

    /// Number of unknowns.
    pub(super) fn unknowns(&self) -> usize {
        let h = self.harmonics();
        if self.equations().is_ring() { 2 * h + 1 } else { 4 * h + 1 }
    }

    /// Whether no more work is to be spent: each step of Newton's method costs about the cube of the unknowns.
    pub(super) fn is_spent(&self, work: &Work) -> bool {
        work.harmonic_balances as f64 * (self.unknowns() as f64).powi(3) > MOST_WORK
    }

    /// Orders per harmonic of the cycle.
    pub(super) fn order_of_cycle(&self) -> f64 {
        let excitation = &self.system.excitation;
        excitation.orders[0].value() / f64::from(excitation.harmonics[0])
    }

    /// The linear part at a speed.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance of the chain.
    pub(super) fn linear(&self, speed_rpm: f64) -> Result<Linear, ResponseError> {
        let surroundings = Surroundings {
            system: self.system,
            others: &self.others,
            station: self.station,
            quantities: &self.quantities,
            harmonics: self.harmonics(),
            order_of_cycle: self.order_of_cycle(),
            ring_inertia: self.law.ring_inertia(),
        };
        surroundings.at(speed_rpm)
    }

    /// The motion that the law of small twists gives: where Newton's method starts.
    pub(super) fn small(&self, linear: &Linear) -> DVector<f64> {
        self.linear_motion(linear, 0.0)
    }

    /// The motion of that law with a spring beside it, N m/rad.
    pub(super) fn linear_motion(&self, linear: &Linear, spring: f64) -> DVector<f64> {
        let mut x = DVector::zeros(self.unknowns());
        let h = self.harmonics();
        for k in 0..h {
            let omega = linear.omega[k];
            let s = spring + self.law.dynamic_stiffness(Operating { omega, shaft_speed: linear.speed_rpm * RAD_PER_S_PER_RPM });
            let inertia = C64::from(self.law.ring_inertia() * omega * omega);
            let (u0, receptance) = linear.hub[k];
            // z = -w² J S/(S - w² J); the hub moves by u0/(1 + z H), the ring against it by w² J/(S - w² J) of that
            let z = -inertia * s / (s - inertia);
            let hub = u0 / (1.0 + z * receptance);
            let twist = inertia / (s - inertia) * hub;
            if twist.is_finite() && hub.is_finite() {
                (x[2 * k + 1], x[2 * k + 2]) = (twist.re, twist.im);
                if !self.equations().is_ring() {
                    (x[2 * h + 2 * k + 1], x[2 * h + 2 * k + 2]) = (hub.re, hub.im);
                }
            }
        }
        x
    }

    /// Torque of a ring on its hub.
    fn ring_torque(&self, linear: &Linear, k: usize, twist: C64) -> C64 {
        linear.ring[k] * (linear.hub[k].0 + twist)
    }

    /// Harmonics of twist and hub.
    fn motion(&self, linear: &Linear, x: &DVector<f64>) -> (Vec<C64>, Vec<C64>) {
        let h = self.harmonics();
        let twist = phasors(&x.as_slice()[1..2 * h + 1]);
        let hub = if self.equations().is_ring() {
            (0..h).map(|k| linear.hub[k].0 - linear.hub[k].1 * self.ring_torque(linear, k, twist[k])).collect()
        } else {
            phasors(&x.as_slice()[2 * h + 1..])
        };
        (twist, hub)
    }

    /// Reactions at the samples of the cycle; of a ring those at no acceleration, for what these add is known by harmonics.
    pub(super) fn reactions(&self, speed_rpm: f64, (mean, twist): (f64, &[C64]), hub: &[C64]) -> Vec<(Reaction, Reaction)> {
        let shaft_speed = speed_rpm * RAD_PER_S_PER_RPM;
        let first = self.order_of_cycle() * shaft_speed;
        let rate = |y: &[C64]| -> Vec<C64> { y.iter().enumerate().map(|(k, y)| I * ((k + 1) as f64 * first) * y).collect() };
        let (t, equations) = (&self.transform, self.equations());
        let twist_rate = rate(twist);
        let angle = t.sampled((mean, twist), (0.0, &twist_rate));
        let moving = |angle: &C64| Instant { twist: angle.re, rate: angle.im, shaft_speed, ..Instant::default() };
        if equations.is_ring() {
            return angle.iter().map(|angle| equations.reactions(&moving(angle))).collect();
        }
        let hub_rate = rate(hub);
        let rates = t.sampled((0.0, &hub_rate), (0.0, &rate(&twist_rate)));
        let hub_acceleration = t.sampled((0.0, &rate(&hub_rate)), (0.0, &[]));
        let instant_at = |j: usize| Instant {
            acceleration: rates[j].im,
            hub_rate: rates[j].re,
            hub_acceleration: hub_acceleration[j].re,
            ..moving(&angle[j])
        };
        (0..angle.len()).map(|j| equations.reactions(&instant_at(j))).collect()
    }

    /// Turns a motion back by full turns of what moves to where it is about its rest, and says whether it stays within half a turn there: beyond, a mass on a circle would pass over the top, and
    /// its equations, which go on, are those of no absorber.
    pub(super) fn within_path(&self, x: &mut DVector<f64>) -> bool {
        let equations = self.equations();
        let (Some(turn), Some(largest)) = (equations.full_turn(), equations.largest_twist()) else { return true };
        x[0] -= turn * (x[0] / turn).round();
        let twist = phasors(&x.as_slice()[1..2 * self.harmonics() + 1]);
        self.transform.sampled((x[0], &twist), (0.0, &[])).iter().all(|angle| angle.re.abs() < largest)
    }

    fn forces(&self, linear: &Linear, mean: f64, (twist, hub): (&[C64], &[C64]), with_slopes: bool) -> Option<Forces> {
        let reactions = self.reactions(linear.speed_rpm, (mean, twist), hub);
        if reactions.iter().any(|(own, torque)| !(own.value.is_finite() && torque.value.is_finite())) {
            return None;
        }
        if self.equations().is_ring() {
            let [own, by_twist] = self.spectra(&reactions, |r| [r.0.value, if with_slopes { r.0.by[0] } else { 0.0 }]);
            let [by_rate, torque] =
                if with_slopes { self.spectra(&reactions, |r| [r.0.by[1], 0.0]) } else { [0.0; 2].map(Spectrum::constant) };
            return Some(Forces { own, torque, own_by: vec![by_twist, by_rate], torque_by: Vec::new() });
        }
        let [own, torque] = self.spectra(&reactions, |r| [r.0.value, r.1.value]);
        let (mut own_by, mut torque_by) = (Vec::new(), Vec::new());
        for i in (0..5).filter(|_| with_slopes) {
            let [o, p] = self.spectra(&reactions, |r| [r.0.by[i], r.1.by[i]]);
            own_by.push(o);
            torque_by.push(p);
        }
        Some(Forces { own, torque, own_by, torque_by })
    }

    /// Of two functions of the reactions.
    fn spectra(&self, reactions: &[(Reaction, Reaction)], of: impl Fn(&(Reaction, Reaction)) -> [f64; 2]) -> [Spectrum; 2] {
        let first = of(&reactions[0]);
        // most slopes are constants
        if reactions.iter().all(|r| of(r) == first) {
            return first.map(Spectrum::constant);
        }
        self.transform.spectra(reactions.iter().map(|r| of(r).into()).map(|(a, b)| C64::new(a, b)).collect())
    }

    /// What the equations miss, in units of an angle, with their Jacobian added to a matrix where one is given; nothing where the law ends.
    pub(super) fn missing(&self, linear: &Linear, x: &DVector<f64>, jacobian: Option<&mut DMatrix<f64>>) -> Option<DVector<f64>> {
        let (h, ring) = (self.harmonics(), self.equations().is_ring());
        let (twist, hub) = if ring { (phasors(&x.as_slice()[1..]), Vec::new()) } else { self.motion(linear, x) };
        let f = self.forces(linear, x[0], (&twist, &hub), jacobian.is_some())?;
        let row = &linear.row;
        let mut missing = DVector::zeros(self.unknowns());
        missing[0] = f.own.phasor(0).re * row[0].re;
        for k in 1..=h {
            let inertial = if ring { self.ring_torque(linear, k - 1, twist[k - 1]) } else { ZERO };
            let own = (f.own.phasor(k) + inertial) * row[k];
            (missing[2 * k - 1], missing[2 * k]) = (own.re, own.im);
            if !ring {
                let (u0, receptance) = linear.hub[k - 1];
                let y = hub[k - 1] - u0 + receptance * f.torque.phasor(k);
                (missing[2 * h + 2 * k - 1], missing[2 * h + 2 * k]) = (y.re, y.im);
            }
        }
        if let Some(jacobian) = jacobian {
            self.slopes(linear, &f, row, jacobian);
        }
        Some(missing)
    }

    /// The Jacobian of what the equations miss, by the factor of each harmonic of the absorber's own equation.
    fn slopes(&self, linear: &Linear, f: &Forces, row: &[C64], jacobian: &mut DMatrix<f64>) {
        let h = self.harmonics();
        let (one, rate) = (C64::from(1.0), |k: usize| I * linear.omega[k - 1]);
        let own_mean = Some(&f.own_by[0]);
        if self.equations().is_ring() {
            add_products(jacobian, (0, 0), (true, own_mean), row, |k| [(&f.own_by[0], one), (&f.own_by[1], rate(k))]);
            for (k, (torque, row)) in linear.ring.iter().zip(&row[1..]).enumerate() {
                let (own, at) = (torque * row, 2 * k + 1);
                jacobian[(at, at)] += own.re;
                jacobian[(at, at + 1)] -= own.im;
                jacobian[(at + 1, at)] += own.im;
                jacobian[(at + 1, at + 1)] += own.re;
            }
            return;
        }
        fn of_twist(by: &[Spectrum], w: C64) -> [(&Spectrum, C64); 3] {
            [(&by[0], C64::from(1.0)), (&by[1], w), (&by[2], w * w)]
        }
        fn of_hub(by: &[Spectrum], w: C64) -> [(&Spectrum, C64); 2] {
            [(&by[3], w), (&by[4], w * w)]
        }
        let receptance: Vec<C64> = std::iter::once(ZERO).chain(linear.hub.iter().map(|hub| hub.1)).collect();
        let below = 2 * h + 1;
        add_products(jacobian, (0, 0), (true, own_mean), row, |k| of_twist(&f.own_by, rate(k)));
        add_products(jacobian, (0, below), (true, None), row, |k| of_hub(&f.own_by, rate(k)));
        add_products(jacobian, (below, 0), (false, Some(&f.torque_by[0])), &receptance, |k| of_twist(&f.torque_by, rate(k)));
        add_products(jacobian, (below, below), (false, None), &receptance, |k| of_hub(&f.torque_by, rate(k)));
        (below..self.unknowns()).for_each(|i| jacobian[(i, i)] += 1.0);
    }

    /// What a solution is.
    pub(super) fn steady(&self, linear: &Linear, x: &DVector<f64>) -> Option<Steady> {
        let (twist, hub) = self.motion(linear, x);
        let f = self.forces(linear, x[0], (&twist, &hub), false)?;
        let ring = self.equations().is_ring();
        let torque = |k: usize| if ring { self.ring_torque(linear, k, twist[k]) } else { f.torque.phasor(k + 1) };
        let phasors_of = |each: &Vec<(C64, C64)>| each.iter().enumerate().map(|(k, (y0, by))| y0 - by * torque(k)).collect();
        let mean_torque = f.torque.phasor(0).re;
        let vibratory: f64 = (0..hub.len()).map(|k| 0.5 * (torque(k) * (I * linear.omega[k] * hub[k]).conj()).re).sum();
        let power = mean_torque * linear.speed_rpm * RAD_PER_S_PER_RPM + vibratory;
        Some(Steady {
            speed_rpm: linear.speed_rpm,
            mean_twist: x[0],
            quantities: linear.outputs.iter().map(phasors_of).collect(),
            twist,
            hub,
            mean_torque,
            power,
        })
    }
}
