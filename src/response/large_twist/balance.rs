//! Harmonic balance at one speed: Newton's method with the exact Jacobian, forces by alternating between frequency and time \[Cameron & Griffin 1989\].

use super::harmonic_matrix::{Spectrum, Transform, add_products};
use super::in_time::InTime;
use crate::absorber::{Absorber, Host, Instant, LargeTwist, Law, Mounted, Operating, Reaction};
use crate::drivetrain::System;
use crate::numerics::lu::Lu;
use crate::numerics::{C64, I, ZERO};
use crate::response::factored::Factored;
use crate::response::{Quantity, ResponseError, Work};
use crate::units::RAD_PER_S_PER_RPM;
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// A step of Newton's method is the last when it is this share of the motion: the error it leaves is about the square of that.
const LAST_STEP: f64 = 1e-8;
/// A step of this share of the motion leads so near that its Jacobian serves the next.
const NEAR: f64 = 1e-2;
/// Steps of Newton's method times the cube of the unknowns: some seconds.
const MOST_WORK: f64 = 1e10;
/// Most steps from a start that may be far.
pub(super) const MOST_STEPS: usize = 30;

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

/// What the linear part does at one speed, harmonic by harmonic from the first.
pub(super) struct Linear {
    pub speed_rpm: f64,
    omega: Vec<f64>,
    /// Hub under the torque, and per torque on it.
    hub: Vec<(C64, C64)>,
    /// The same of each quantity.
    outputs: Vec<Vec<(C64, C64)>>,
}

impl Linear {
    /// Under a share of the torque.
    pub fn under(&self, share: f64) -> Self {
        let scaled = |list: &Vec<(C64, C64)>| list.iter().map(|(y, by)| (y * share, *by)).collect();
        let outputs = self.outputs.iter().map(scaled).collect();
        Self { speed_rpm: self.speed_rpm, omega: self.omega.clone(), hub: scaled(&self.hub), outputs }
    }
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

/// A solution.
pub(super) struct Found {
    pub x: DVector<f64>,
    /// Whether the determinant of the Jacobian is positive: it changes where a curve folds.
    pub even: bool,
}

/// Forces at a motion.
struct Forces {
    own: Spectrum,
    torque: Spectrum,
    /// By twist, rate, acceleration, rate and acceleration of the hub.
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
        others[index].absorber = Absorber::Locked { ring_inertia: 0.0 };
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
        let (system, h) = (self.system, self.harmonics());
        let (n, shaft_speed) = (system.chain.len(), speed_rpm * RAD_PER_S_PER_RPM);
        let mut solver = Factored::new(system);
        let mut linear =
            Linear { speed_rpm, omega: Vec::new(), hub: Vec::new(), outputs: vec![Vec::with_capacity(h); self.quantities.len()] };
        let mut unit = vec![ZERO; n];
        for k in 1..=h {
            let omega = k as f64 * self.order_of_cycle() * shaft_speed;
            let order = system.excitation.harmonics.iter().position(|own| *own as usize == k);
            let unbounded = || ResponseError::unbounded(system.excitation.orders[order.unwrap_or_default()], speed_rpm);
            solver.factor_at(&self.others, Operating { omega, shaft_speed }).map_err(|_| unbounded())?;
            match order {
                Some(order) => system.torque(order, speed_rpm, &mut solver.x),
                None => solver.x.fill(ZERO),
            }
            solver.matrix.solve(&mut solver.x);
            unit.fill(ZERO);
            unit[self.station] = C64::from(1.0);
            solver.matrix.solve(&mut unit);
            let hub = (solver.angle(self.station, &solver.x), solver.angle(self.station, &unit));
            if !(hub.0.is_finite() && hub.1.is_finite()) {
                return Err(unbounded());
            }
            linear.omega.push(omega);
            linear.hub.push(hub);
            for (q, own) in self.quantities.iter().zip(&mut linear.outputs) {
                own.push((solver.output(*q, &solver.x), solver.output(*q, &unit)));
            }
        }
        Ok(linear)
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

    /// Torque of a ring on its hub per angle of hub and twist together: T = -w² J (hub + twist), with hub = u0 - H T.
    fn ring_torque(&self, linear: &Linear, k: usize, twist: C64) -> (C64, C64) {
        let inertia = self.law.ring_inertia() * linear.omega[k] * linear.omega[k];
        let (u0, receptance) = linear.hub[k];
        let per_angle = -inertia / (1.0 - inertia * receptance);
        (per_angle * (u0 + twist), per_angle)
    }

    /// Harmonics of hub and twist; `hub_by`: what the hub does by the twist where it is no unknown of its own.
    fn motion(&self, linear: &Linear, x: &DVector<f64>) -> (Vec<C64>, Vec<C64>) {
        let h = self.harmonics();
        let twist = phasors(&x.as_slice()[1..2 * h + 1]);
        let hub = if self.equations().is_ring() {
            (0..h).map(|k| linear.hub[k].0 - linear.hub[k].1 * self.ring_torque(linear, k, twist[k]).0).collect()
        } else {
            phasors(&x.as_slice()[2 * h + 1..])
        };
        (twist, hub)
    }

    /// Reactions at the samples of the cycle.
    pub(super) fn reactions(&self, speed_rpm: f64, (mean, twist): (f64, &[C64]), hub: &[C64]) -> Vec<(Reaction, Reaction)> {
        let shaft_speed = speed_rpm * RAD_PER_S_PER_RPM;
        let first = self.order_of_cycle() * shaft_speed;
        let rate = |y: &[C64]| -> Vec<C64> { y.iter().enumerate().map(|(k, y)| I * ((k + 1) as f64 * first) * y).collect() };
        let (twist_rate, hub_rate) = (rate(twist), rate(hub));
        let t = &self.transform;
        let angle = t.sampled((mean, twist), (0.0, &twist_rate));
        let rates = t.sampled((0.0, &hub_rate), (0.0, &rate(&twist_rate)));
        let hub_acceleration = t.sampled((0.0, &rate(&hub_rate)), (0.0, &[]));
        let equations = self.equations();
        let at = |j: usize| Instant {
            twist: angle[j].re,
            rate: angle[j].im,
            acceleration: rates[j].im,
            hub_rate: rates[j].re,
            hub_acceleration: hub_acceleration[j].re,
            shaft_speed,
        };
        (0..angle.len()).map(|j| equations.reactions(&at(j))).collect()
    }

    fn forces(&self, linear: &Linear, mean: f64, (twist, hub): (&[C64], &[C64]), with_slopes: bool) -> Option<Forces> {
        let reactions = self.reactions(linear.speed_rpm, (mean, twist), hub);
        if reactions.iter().any(|(own, torque)| !(own.value.is_finite() && torque.value.is_finite())) {
            return None;
        }
        let packed = |f: &dyn Fn(&(Reaction, Reaction)) -> C64| {
            let samples: Vec<C64> = reactions.iter().map(f).collect();
            // most slopes are constants
            if samples.iter().all(|z| *z == samples[0]) {
                [samples[0].re, samples[0].im].map(Spectrum::constant)
            } else {
                self.transform.spectra(samples)
            }
        };
        let [own, torque] = packed(&|r| C64::new(r.0.value, r.1.value));
        let (mut own_by, mut torque_by) = (Vec::new(), Vec::new());
        for i in (0..5).filter(|_| with_slopes) {
            let [o, p] = packed(&|r| C64::new(r.0.by[i], r.1.by[i]));
            own_by.push(o);
            torque_by.push(p);
        }
        Some(Forces { own, torque, own_by, torque_by })
    }

    /// What the equations miss, in units of an angle, with their Jacobian where asked for; nothing where the law ends.
    pub(super) fn missing(&self, linear: &Linear, x: &DVector<f64>, jacobian: Option<&mut DMatrix<f64>>) -> Option<DVector<f64>> {
        let (h, ring) = (self.harmonics(), self.equations().is_ring());
        let (twist, hub) = self.motion(linear, x);
        let f = self.forces(linear, x[0], (&twist, &hub), jacobian.is_some())?;
        let inertia = self.law.ring_inertia();
        let row = |k: usize| C64::from(1.0 / (inertia * linear.omega[k.max(1) - 1].powi(2)));
        let mut missing = DVector::zeros(self.unknowns());
        missing[0] = f.own.phasor(0).re * row(0).re;
        for k in 1..=h {
            let own = f.own.phasor(k) * row(k);
            (missing[2 * k - 1], missing[2 * k]) = (own.re, own.im);
            if !ring {
                let (u0, receptance) = linear.hub[k - 1];
                let y = hub[k - 1] - u0 + receptance * f.torque.phasor(k);
                (missing[2 * h + 2 * k - 1], missing[2 * h + 2 * k]) = (y.re, y.im);
            }
        }
        if let Some(jacobian) = jacobian {
            jacobian.fill(0.0);
            let rate = |k: usize| I * linear.omega[k - 1];
            fn of_twist(by: &[Spectrum], w: C64) -> Vec<(&Spectrum, C64)> {
                vec![(&by[0], C64::from(1.0)), (&by[1], w), (&by[2], w * w)]
            }
            fn of_hub(by: &[Spectrum], w: C64, factor: C64) -> Vec<(&Spectrum, C64)> {
                vec![(&by[3], w * factor), (&by[4], w * w * factor)]
            }
            if ring {
                let products = |k: usize| {
                    let mut all = of_twist(&f.own_by, rate(k));
                    let hub_by = -linear.hub[k - 1].1 * self.ring_torque(linear, k - 1, ZERO).1;
                    all.extend(of_hub(&f.own_by, rate(k), hub_by));
                    all
                };
                add_products(jacobian, (0, 0), h, (true, Some(&f.own_by[0])), &row, &products);
            } else {
                let one = C64::from(1.0);
                let receptance = |k: usize| if k == 0 { ZERO } else { linear.hub[k - 1].1 };
                let own_mean = Some(&f.own_by[0]);
                add_products(jacobian, (0, 0), h, (true, own_mean), &row, &|k| of_twist(&f.own_by, rate(k)));
                add_products(jacobian, (0, 2 * h + 1), h, (true, None), &row, &|k| of_hub(&f.own_by, rate(k), one));
                let below = 2 * h + 1;
                add_products(jacobian, (below, 0), h, (false, Some(&f.torque_by[0])), &receptance, &|k| of_twist(&f.torque_by, rate(k)));
                add_products(jacobian, (below, below), h, (false, None), &receptance, &|k| of_hub(&f.torque_by, rate(k), one));
                (below..jacobian.nrows()).for_each(|i| jacobian[(i, i)] += 1.0);
            }
        }
        Some(missing)
    }

    /// Newton's method at a speed; nothing where it does not converge in so many steps.
    pub(super) fn newton(&self, linear: &Linear, start: &DVector<f64>, most: usize, work: &mut Work) -> Option<Found> {
        let mut x = start.clone();
        // near the solution one Jacobian serves several steps, as long as each is a tenth of the one before
        let (mut kept, mut last, mut factored) = (None, f64::INFINITY, 0);
        while kept.is_some() || factored < most {
            let is_kept = kept.is_some();
            let (missing, lu) = match kept.take() {
                Some(lu) => (self.missing(linear, &x, None)?, lu),
                None => {
                    work.harmonic_balances += 1;
                    factored += 1;
                    let mut jacobian = DMatrix::zeros(x.len(), x.len());
                    let missing = self.missing(linear, &x, Some(&mut jacobian))?;
                    (missing, Lu::new(jacobian))
                }
            };
            let step = lu.solve(&missing)?;
            x -= &step;
            if !x.iter().all(|x| x.is_finite()) {
                return None;
            }
            let (size, reach) = (step.amax(), x.amax());
            // the error that is left: the square of the step, or as much less than the step as that is less than the one before
            let scale = if is_kept { last } else { reach };
            if size <= LAST_STEP * reach && size * size <= LAST_STEP * LAST_STEP * reach * scale {
                let even = lu.is_positive();
                return Some(Found { x, even });
            }
            let converges = size <= if is_kept { 0.1 * last } else { NEAR * reach };
            (kept, last) = (converges.then_some(lu), size);
        }
        None
    }

    /// A motion of this balance by the harmonics of a finer one; nothing where Newton's method does not find it.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance of the chain.
    pub fn refined(&self, finer: &Self, steady: &Steady) -> Result<Option<Steady>, ResponseError> {
        let linear = finer.linear(steady.speed_rpm)?;
        let mut x = DVector::zeros(finer.unknowns());
        x[0] = steady.mean_twist;
        let rows = if self.equations().is_ring() { vec![&steady.twist] } else { vec![&steady.twist, &steady.hub] };
        for (b, row) in rows.into_iter().enumerate() {
            for (k, y) in row.iter().enumerate() {
                let at = 1 + 2 * (b * finer.harmonics() + k);
                (x[at], x[at + 1]) = (y.re, y.im);
            }
        }
        let found = finer.newton(&linear, &x, MOST_STEPS, &mut Work::default());
        Ok(found.and_then(|found| finer.steady(&linear, &found.x)))
    }

    /// What a solution is.
    pub(super) fn steady(&self, linear: &Linear, x: &DVector<f64>) -> Option<Steady> {
        let (twist, hub) = self.motion(linear, x);
        let f = self.forces(linear, x[0], (&twist, &hub), false)?;
        let torque = |k: usize| f.torque.phasor(k + 1);
        let of = |each: &Vec<(C64, C64)>| each.iter().enumerate().map(|(k, (y0, by))| y0 - by * torque(k)).collect();
        let mean_torque = f.torque.phasor(0).re;
        let vibratory: f64 = (0..hub.len()).map(|k| 0.5 * (torque(k) * (I * linear.omega[k] * hub[k]).conj()).re).sum();
        let power = mean_torque * linear.speed_rpm * RAD_PER_S_PER_RPM + vibratory;
        Some(Steady {
            speed_rpm: linear.speed_rpm,
            mean_twist: x[0],
            quantities: linear.outputs.iter().map(of).collect(),
            twist,
            hub,
            mean_torque,
            power,
        })
    }
}
