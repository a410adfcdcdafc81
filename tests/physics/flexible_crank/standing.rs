//! A whole crank in the standing frame: what the program finds in turning axes, put into Newton's law of every point of mass as it moves through space, and bearings that stand still.
//!
//! A point at p + s of the crank is at x = R(Omega t) (p + s + u + phi x s + 1/2 phi x (phi x s)); its force of inertia does the virtual work m x'' . dx. Neither gyroscopic nor centrifugal nor circulatory terms are
//! written down: the second derivative of x is taken from its values in time, which hold a few harmonics only.

use super::independent::{Mass, Model};
use super::{Study, alone};
use hartog::rotor::shaft::Turning;
use nalgebra::{Complex, DMatrix, DVector, Matrix3, Rotation3, Vector3};
use std::f64::consts::TAU;

type C = Complex<f64>;

/// Revolutions after which a motion repeats itself, and instants within them.
const REVOLUTIONS: usize = 8;
const INSTANTS: usize = 256;

/// A motion of small amplitude over time.
struct Motion<'a> {
    model: &'a Model,
    phasor: &'a DVector<C>,
    omega: f64,
    speed: f64,
}

impl Motion<'_> {
    fn time(&self, i: usize) -> f64 {
        TAU / self.speed * (REVOLUTIONS * i) as f64 / INSTANTS as f64
    }

    fn frame(&self, i: usize) -> Matrix3<f64> {
        *Rotation3::from_axis_angle(&Vector3::z_axis(), self.speed * self.time(i)).matrix()
    }

    fn at(&self, i: usize, phasor: C) -> f64 {
        (phasor * C::from_polar(1.0, self.omega * self.time(i))).re
    }

    /// The derivative of a periodic function by its values at all instants, as weights of these, at one of them: that of its harmonics.
    fn derivative(&self, at: usize, second: bool) -> Vec<f64> {
        let base = self.speed / REVOLUTIONS as f64;
        let weight = |k: usize| {
            let angle = TAU * (at as f64 - k as f64) / INSTANTS as f64;
            let harmonic = |h: usize| {
                let (h, w) = (h as f64, h as f64 * base);
                if second { -w * w * (h * angle).cos() } else { -w * (h * angle).sin() }
            };
            2.0 / INSTANTS as f64 * (1..INSTANTS / 2).map(harmonic).sum::<f64>()
        };
        (0..INSTANTS).map(weight).collect()
    }

    /// What inertia does on the unknowns of a point at an instant, at an amplitude.
    fn inertia(&self, point: &Mass, (at, weights): (usize, &[f64]), amplitude: f64) -> DVector<f64> {
        let own = |i: usize| DVector::from_fn(point.rows.len(), |k, _| amplitude * self.at(i, self.phasor[point.rows[k]]));
        let s = point.beside;
        let place = |i: usize| {
            let q = own(i);
            let (u, phi) = (&point.moved * &q, &point.turned * &q);
            let (u, phi) = (Vector3::from(u), Vector3::from(phi));
            self.frame(i) * (point.place + s + u + phi.cross(&s) + phi.cross(&phi.cross(&s)) * 0.5)
        };
        let acceleration: Vector3<f64> = (0..INSTANTS).map(|i| place(i) * weights[i]).sum();
        let force = self.frame(at).transpose() * acceleration * point.mass;
        let phi = Vector3::from(&point.turned * own(at));
        DVector::from_fn(point.rows.len(), |k, _| {
            let (u, r) = (Vector3::from(point.moved.column(k)), Vector3::from(point.turned.column(k)));
            force.dot(&(u + r.cross(&s) + (r.cross(&phi.cross(&s)) + phi.cross(&r.cross(&s))) * 0.5))
        })
    }

    /// Forces of inertia of all points at an instant per amplitude: the part that is linear in it.
    fn of_inertia(&self, at: usize) -> DVector<f64> {
        let weights = self.derivative(at, true);
        let mut all = DVector::zeros(self.phasor.len());
        let small = 1e-4 / self.phasor.camax();
        for point in &self.model.points {
            let [more, less] = [small, -small].map(|a| self.inertia(point, (at, &weights), a));
            for (row, force) in point.rows.iter().zip((more - less).iter()) {
                all[*row] += force / (2.0 * small);
            }
        }
        for (node, polar) in &self.model.polars {
            all[6 * node + 5] -= polar * self.omega * self.omega * self.at(at, self.phasor[6 * node + 5]);
        }
        all
    }

    /// Forces of bearings that stand still, k U + c U' of the journal's motion U through space, on the unknowns of the nodes in them.
    fn of_bearings(&self, at: usize, (k, c): (f64, f64)) -> DVector<f64> {
        let weights = self.derivative(at, false);
        let mut all = DVector::zeros(self.phasor.len());
        for node in self.model.bearings.iter().flatten() {
            let through =
                |i: usize| self.frame(i) * Vector3::new(self.at(i, self.phasor[6 * node]), self.at(i, self.phasor[6 * node + 1]), 0.0);
            let rate: Vector3<f64> = (0..INSTANTS).map(|i| through(i) * weights[i]).sum();
            let force = self.frame(at).transpose() * (through(at) * k + rate * c);
            (0..2).for_each(|i| all[6 * node + i] += force[i]);
        }
        all
    }
}

/// What is left of Newton's law for the motion that the program finds at a frequency and a speed, as a share of the largest force of inertia.
fn left_over(study: &Study, model: &Model, (multiple, speed): (f64, f64), damping: f64) -> f64 {
    let spec = &study.flexible.as_ref().expect("flexible").spec;
    let omega = multiple * speed;
    let force = model.on_pins(multiple, speed * 60.0 / TAU);
    let phasor = study.flexible.as_ref().expect("flexible").assembled.shaft.response(Turning { omega, speed }, &force).expect("damped");
    let motion = Motion { model, phasor: &phasor, omega, speed };
    let [stiffness, loss, own_damping] = model.of_the_crank();
    let complex = |m: DMatrix<f64>, factor: C| m.map(|x| factor * x);
    let turning =
        complex(stiffness + &model.strings * (speed * speed), C::new(1.0, 0.0)) + complex(loss + own_damping * omega, C::new(0.0, 1.0));
    let of_the_crank = turning * &phasor - &force;
    let point = spec.bearing.point(0, 0, 3);
    let worst = |at: usize| {
        let inertia = motion.of_inertia(at);
        let bearings = motion.of_bearings(at, (point.stiffness, damping * point.damping));
        let rest = DVector::from_fn(phasor.len(), |i, _| inertia[i] + bearings[i] + motion.at(at, of_the_crank[i]));
        rest.amax() / inertia.amax()
    };
    [3, 90, 201].into_iter().map(worst).fold(0.0, f64::max)
}

/// Newton's law of every point of the six's crank, in the standing frame, holds for what the program finds in turning axes: between orders, where a bending mode whirls at 3200 rpm (167 Hz seen from the crank, 3.125 per
/// revolution), and at a low speed; to 1e-8 of the largest force of inertia. Bearings that damp a thousandth more are seen.
#[test]
fn newtons_law_of_a_whole_crank() {
    let study = alone();
    let model = Model::new(&study);
    for (multiple, rpm) in [(3.125, 3200.0), (5.5, 1234.0)] {
        let at = (multiple, rpm * TAU / 60.0);
        let left = left_over(&study, &model, at, 1.0);
        let other = left_over(&study, &model, at, 1.001);
        assert!(left < 1e-8, "{left:e} at {rpm} rpm");
        assert!(other > 1e4 * left, "{other:e} at {rpm} rpm");
    }
}
