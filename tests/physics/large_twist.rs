//! Laws of large twist: harmonic balance against shooting in time, folds and their stability, paths of pendulums.

use crate::support::{assert_close, one_throw, study, system, uniform_chain};
use hartog::absorber::{
    Absorber, CIRCULAR_PENDULUM, CYCLOIDAL_PENDULUM, HARDENING, Instant, LargeTwist, Law, Mounted, Reaction, TAUTOCHRONE_PENDULUM,
    TWO_STAGE,
};
use hartog::analysis::LargePoint;
use hartog::drivetrain::{Chain, System};
use hartog::engine::Order;
use hartog::input::{LimitSpec, MeasureSpec};
use hartog::numerics::C64;
use hartog::numerics::harmonics::analyse;
use hartog::objective::{Measure, Over, Property};
use hartog::response::bodies::Bodies;
use hartog::response::large_twist::{Balance, Curve, Stability, Steady};
use hartog::response::{Direct, Grid, Quantity, Response, Work};
use hartog::units::RAD_PER_S_PER_RPM;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

/// Equations of motion in time, written without harmonics: angles of all bodies, then the twist.
pub struct InTime<'a> {
    bodies: Bodies,
    equations: &'a dyn LargeTwist,
    station: usize,
    shaft_speed: f64,
    /// Harmonic of the cycle, torque at each station.
    torque: Vec<(f64, Vec<C64>)>,
    /// On the hub, N m: what keeps the shaft at its mean speed.
    mean: f64,
    cycle: f64,
}

impl<'a> InTime<'a> {
    pub fn new(system: &System, law: &'a dyn Law, station: usize, speed_rpm: f64) -> Self {
        let bodies = Bodies::new(system, &[]);
        let excitation = &system.excitation;
        let per_cycle = excitation.orders[0].value() / f64::from(excitation.harmonics[0]);
        let shaft_speed = speed_rpm * RAD_PER_S_PER_RPM;
        let torque = (0..system.orders()).map(|n| {
            let mut own = vec![C64::default(); bodies.len()];
            system.torque(n, speed_rpm, &mut own);
            (f64::from(excitation.harmonics[n]), own)
        });
        let torque = torque.collect();
        let equations = law.large_twist().expect("equations");
        Self { bodies, equations, station, shaft_speed, torque, mean: 0.0, cycle: TAU / (per_cycle * shaft_speed) }
    }

    /// Rates of the state: angles, twist, their rates.
    fn rates(&self, time: f64, state: &[f64]) -> Vec<f64> {
        let n = self.bodies.len();
        let (angle, rate) = state.split_at(n + 1);
        let psi = TAU * time / self.cycle;
        let mut force: Vec<f64> = (0..n)
            .map(|i| {
                let acting: f64 = self.torque.iter().map(|(h, own)| (own[i] * C64::cis(h * psi)).re).sum();
                let held: f64 = (0..n).map(|j| self.bodies.stiffness[(i, j)] * angle[j] + self.bodies.damping[(i, j)] * rate[j]).sum();
                acting - held
            })
            .collect();
        let h = self.station;
        let at = Instant { twist: angle[n], rate: rate[n], hub_rate: rate[h], shaft_speed: self.shaft_speed, ..Instant::default() };
        let (own, torque) = self.equations.reactions(&at);
        // J h'' = F - T - T2 q'' - T4 h'';  0 = r + r2 q'' + r4 h''
        let (a, b, c, d) = (self.bodies.inertia[h] + torque.by[4], torque.by[2], own.by[4], own.by[2]);
        let (x, y) = (force[h] + self.mean - torque.value, -own.value);
        let hub = (d * x - b * y) / (a * d - b * c);
        let twist = (a * y - c * x) / (a * d - b * c);
        force.iter_mut().zip(&self.bodies.inertia).for_each(|(f, j)| *f /= j);
        force[h] = hub;
        rate.iter().copied().chain(force).chain([twist]).collect()
    }

    /// States of a cycle, `steps` of Runge and Kutta's method, and the one after it.
    pub fn cycle(&self, start: &[f64], steps: usize) -> (Vec<Vec<f64>>, Vec<f64>) {
        let dt = self.cycle / steps as f64;
        let (mut state, mut states) = (start.to_vec(), Vec::new());
        let moved = |s: &[f64], by: f64, r: &[f64]| -> Vec<f64> { s.iter().zip(r).map(|(s, r)| s + by * r).collect() };
        for j in 0..steps {
            let t = j as f64 * dt;
            states.push(state.clone());
            let k1 = self.rates(t, &state);
            let k2 = self.rates(t + 0.5 * dt, &moved(&state, 0.5 * dt, &k1));
            let k3 = self.rates(t + 0.5 * dt, &moved(&state, 0.5 * dt, &k2));
            let k4 = self.rates(t + dt, &moved(&state, dt, &k3));
            for i in 0..state.len() {
                state[i] += dt / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
            }
        }
        (states, state)
    }
}

fn design(law: &Arc<dyn Law>) -> [Mounted; 1] {
    [Mounted::on_station(0, Absorber::Ring(law.clone()))]
}

fn curves(system: &System, law: &Arc<dyn Law>, harmonics: usize, speeds: &[f64]) -> Vec<Curve> {
    let balance = Balance::new(system, &design(law), &[Quantity::Twist { from: 0, to: None }], harmonics);
    balance.expect("a law of large twist").curves(speeds, &mut Work::default()).expect("damped")
}

/// A ring that stiffens on a damped mass on a spring, under one order: a fold, and three motions between 1210 and 1420 rpm.
fn folded() -> (System, Arc<dyn Law>) {
    let mut chain = uniform_chain(1, 1.0, 0.0);
    (chain.stations[0].stiffness_to_ground, chain.stations[0].damping_to_ground) = (1e4, 4.0);
    (System::new(chain, one_throw(&[(2, 100.0)])), (HARDENING.build)(&[0.1, 700.0, 0.6, 100.0]))
}

/// The state at the beginning of the cycle, angles of a chain without mean.
pub fn state(time: &InTime, steady: &Steady, angles: &[Vec<C64>]) -> Vec<f64> {
    let rate = |k: usize| C64::new(0.0, TAU * (k + 1) as f64 / time.cycle);
    let value = |y: &[C64]| y.iter().map(|y| y.re).sum::<f64>();
    let rates = |y: &[C64]| y.iter().enumerate().map(|(k, y)| (rate(k) * y).re).sum::<f64>();
    let mut angle: Vec<f64> = angles.iter().map(|y| value(y)).collect();
    angle.push(steady.mean_twist + value(&steady.twist));
    angle.extend(angles.iter().map(|y| rates(y)));
    angle.push(rates(&steady.twist));
    angle
}

/// Law: the harmonics that are balanced are those of a cycle in time, by a method that knows of none. On the in-line six with a ring that stiffens and with pendulums on each path, at three speeds: every
/// order of every station and of the twist to 1e-6 of the largest, and all angles return after a cycle. What the hub does on the absorber is what its damper takes, to 1e-8.
#[test]
fn harmonic_balance_equals_time() {
    let s = study("villalva_i6_large_twist");
    let sys = system(&s);
    let stations: Vec<Quantity> = (0..sys.chain.len()).map(|from| Quantity::Twist { from, to: None }).collect();
    for d in s.designs.iter().filter(|d| !d.absorbers.is_empty()) {
        let law = d.absorbers[0].absorber.law().expect("a ring").clone();
        let ring = law.large_twist().is_some_and(|l| l.is_ring());
        let balance = Balance::new(&sys, &d.absorbers, &stations, 96).expect("of large twist");
        let (speeds, range) =
            if ring { (vec![1200.0, 1620.0], vec![1200.0, 1400.0, 1620.0]) } else { (vec![1200.0, 1620.0, 2400.0], vec![]) };
        for speed in speeds {
            // on a curve that folds, a motion is found from those at other speeds
            let found = balance.curves(if ring { &range } else { std::slice::from_ref(&speed) }, &mut Work::default()).expect("damped");
            let points = found.iter().flat_map(|c| &c.points);
            let at_speed: Vec<&Steady> = points.filter(|p| p.asked && p.steady.speed_rpm == speed).map(|p| &p.steady).collect();
            let steady = at_speed[0];
            let mut time = InTime::new(&sys, &*law, 0, speed);
            let damping = law.values()[2];
            let omega = |k: usize| TAU * (k + 1) as f64 / time.cycle;
            let taken: f64 = steady.twist.iter().enumerate().map(|(k, y)| 0.5 * damping * (omega(k) * y.norm()).powi(2)).sum();
            assert_close(steady.power, taken, 1e-8, 0.0, &format!("power of {} at {speed} rpm", d.name));
            // pendulums take part of it from the mean torque
            time.mean = steady.mean_torque;
            let start = state(&time, steady, &steady.quantities);
            let (mut states, end) = time.cycle(&start, 8192);
            states.push(end);
            // nothing holds the chain: angles are counted from the flywheel, the twist is one already
            let n = sys.chain.len();
            for s in &mut states {
                let flywheel = s[n - 1];
                s[..n].iter_mut().for_each(|angle| *angle -= flywheel);
            }
            let end = states.pop().expect("a cycle");
            let largest = states.iter().flat_map(|s| &s[..n]).map(|x| x.abs()).fold(0.0, f64::max);
            for i in 0..=n {
                let what = format!("{} at {speed} rpm, angle {i}", d.name);
                let samples: Vec<f64> = states.iter().map(|s| s[i]).collect();
                assert_close(end[i], samples[0], 0.0, 1e-6 * largest, &format!("{what} after a cycle"));
                let from = |k: usize| if i == n { steady.twist[k] } else { steady.quantities[i][k] - steady.quantities[n - 1][k] };
                for (k, y) in analyse(&samples, &(1..=24).collect::<Vec<u32>>()).into_iter().enumerate() {
                    assert!((y - from(k)).norm() <= 1e-6 * largest, "{what}, harmonic {}", k + 1);
                }
            }
        }
    }
}

/// Law: the curve of a ring that stiffens folds; between the folds there are three motions, the middle one does not last. Each returns to itself after a cycle in time, and its largest multiplier is that
/// of differences of cycles in time (1e-3). Up in speed the upper branch is followed to the upper fold, down the lower one to the lower fold.
#[test]
fn a_fold_and_its_branches() {
    let (sys, law) = folded();
    let speeds: Vec<f64> = (0..=120).map(|i| 600.0 + 10.0 * f64::from(i)).collect();
    let balance = Balance::new(&sys, &design(&law), &[], 15).expect("a law of large twist");
    let found = balance.curves(&speeds, &mut Work::default()).expect("damped");
    assert_eq!(found.len(), 1, "one curve");
    assert!(found[0].whole);
    let mut seen = [0; 4];
    for &speed in &speeds {
        let here: Vec<_> = found[0].points.iter().filter(|p| p.asked && p.steady.speed_rpm == speed).collect();
        seen[here.len()] += 1;
        if here.len() == 3 {
            let stable: Vec<bool> = here.iter().map(|p| matches!(p.stability, Stability::Stable(_))).collect();
            assert_eq!(stable[1..], [false, true], "{speed} rpm: {stable:?}");
        }
        let time = InTime::new(&sys, &*law, 0, speed);
        for p in here.iter().filter(|_| (speed / 10.0) as i64 % 7 == 0 || here.len() == 3) {
            let start = state(&time, &p.steady, std::slice::from_ref(&p.steady.hub));
            let (_, end) = time.cycle(&start, 1000);
            let scale = start.iter().map(|x| x.abs()).fold(0.0, f64::max);
            assert!(start.iter().zip(&end).all(|(a, b)| (a - b).abs() < 1e-6 * scale), "{speed} rpm");
            let multipliers = nalgebra::DMatrix::from_fn(4, 4, |i, j| {
                let shifted = |by: f64| {
                    let mut s = start.clone();
                    s[j] += by;
                    time.cycle(&s, 500).1[i]
                };
                (shifted(1e-5) - shifted(-1e-5)) / 2e-5
            });
            let largest = multipliers.complex_eigenvalues().iter().map(|m| m.norm()).fold(0.0, f64::max);
            let (Stability::Stable(own) | Stability::Unstable(own)) = balance.stability(&p.steady) else { panic!("a law in time") };
            assert_close(own, largest, 1e-3, 0.0, &format!("multiplier at {speed} rpm"));
            assert_eq!(p.stability.may_last(), largest <= 1.0, "{speed} rpm");
        }
    }
    assert!(seen[0] == 0 && seen[1] > 90 && seen[2] == 0 && seen[3] >= 20, "{seen:?}");
}

/// Law: at small twist the balance is the linear response: a spring that stiffens next to nothing gives what the direct solution gives, 1e-10; pendulums, and springs of two stages with friction, under a ten-thousandth of the torque, 1e-6.
#[test]
fn small_twist_is_linear() {
    let s = study("villalva_i6_large_twist");
    let twist = Quantity::Twist { from: 0, to: None };
    for (declaration, values, share, tolerance) in [
        (&HARDENING, [0.076, 6e4, 20.0, 1e-9].as_slice(), 1.0, 1e-10),
        (&CIRCULAR_PENDULUM, [0.03, 6.2, 1.0].as_slice(), 1e-6, 1e-7),
        (&TAUTOCHRONE_PENDULUM, [0.03, 6.2, 1.0].as_slice(), 1e-6, 1e-7),
        (&CYCLOIDAL_PENDULUM, [0.03, 6.2, 1.0].as_slice(), 1e-6, 1e-7),
        (&TWO_STAGE, [0.076, 6e4, 20.0, 1e5, 1.0, 5.0, 0.5, 100.0].as_slice(), 1e-6, 1e-7),
    ] {
        let sys = one_order(&s.chain, share);
        let law = (declaration.build)(values);
        for speed in [900.0, 2000.0] {
            let found = curves(&sys, &law, 24, &[speed]);
            let grid = Grid::new(&[speed], &[]);
            let mut expected = Vec::new();
            Direct::new(&sys, &grid).sweep(&design(&law), twist, &mut expected, &mut Work::default()).expect("damped");
            let own = &found[0].points[0].steady.quantities[0];
            for (y, h) in expected.iter().zip(&sys.excitation.harmonics) {
                let found = own[*h as usize - 1];
                assert!((found - y).norm() <= tolerance * y.norm(), "{} at {speed} rpm: {found} against {y}", declaration.name);
            }
        }
    }
}

/// A chain under orders 3 and 6 alone, at a share of some torque.
fn one_order(chain: &Chain, share: f64) -> System {
    let mut chain = chain.clone();
    let loaded = chain.stations.iter().position(|s| s.throws == [0]).expect("the first throw");
    chain.stations.iter_mut().enumerate().for_each(|(i, s)| s.throws.retain(|_| i == loaded));
    System::new(chain, one_throw(&[(6, 900.0 * share), (12, 300.0 * share)]))
}

/// Reactions at a twist where nothing else moves, and what they tell of the path: R², its slope, G.
fn path(law: &dyn Law, arc: f64) -> (f64, f64, f64) {
    let at = Instant { twist: arc, shaft_speed: 1.0, ..Instant::default() };
    let (own, torque) = law.large_twist().expect("a path").reactions(&at);
    let inertia = law.ring_inertia();
    (torque.by[4] / inertia, -2.0 * own.value / inertia, own.by[4] / inertia)
}

/// Order at which pendulums swing freely on a shaft that turns uniformly, s'' = 1/2 dR²/ds: a quarter of the period is the integral of ds/sqrt(R²(s) - R²(s0)), smooth and periodic in the angle of
/// s = s0 cos: midpoints are exact but for rounding.
fn free_order(law: &dyn Law, amplitude: f64) -> f64 {
    let (least, n) = (path(law, amplitude).0, 60);
    let integrand = |angle: f64| amplitude * angle.sin() / (path(law, amplitude * angle.cos()).0 - least).sqrt();
    let sum: f64 = (0..n).map(|i| integrand(FRAC_PI_2 * (f64::from(i) + 0.5) / f64::from(n))).sum();
    f64::from(n) / sum
}

/// Source: [Denman 1992]; the tautochrone keeps its order at every swing (1e-9, half its travel), on a circle it falls by the elliptic integral, n pi/(2 K(sin(phi/2))) with phi = s/rho0 (1e-7), on a
/// cycloid it rises. G² = R² - (dR²/ds)²/4 on all, and all slopes are differences (1e-7).
#[test]
fn paths_of_pendulums() {
    for n in [1.5, 3.0, 6.0] {
        let [circle, tautochrone, cycloid] =
            [&CIRCULAR_PENDULUM, &TAUTOCHRONE_PENDULUM, &CYCLOIDAL_PENDULUM].map(|d| (d.build)(&[0.02, n, 0.3]));
        let rho0 = 1.0 / (n * n + 1.0);
        let travel = tautochrone.large_twist().and_then(|l| l.largest_twist()).expect("a cusp");
        assert_close(travel, 1.0 / (n * (1.0 + n * n).sqrt()), 1e-12, 0.0, "cusp of the tautochrone");
        for share in [0.1, 0.3, 0.5] {
            let amplitude = share * travel;
            assert_close(path(&*tautochrone, amplitude).0, 1.0 - n * n * amplitude * amplitude, 1e-13, 0.0, "R² of the tautochrone");
            assert_close(free_order(&*tautochrone, amplitude), n, 1e-9, 0.0, "tautochrone");
            let k = (0.5 * amplitude / rho0).sin();
            let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
            for _ in 0..20 {
                (a, b) = (0.5 * (a + b), (a * b).sqrt());
            }
            // K = pi/(2 agm(1, k'))
            assert_close(free_order(&*circle, amplitude), n * a, 1e-7, 0.0, "circle");
            assert!(free_order(&*cycloid, amplitude) > n * (1.0 + 1e-4 * share * share), "cycloid");
        }
        for law in [circle, tautochrone, cycloid] {
            let equations = law.large_twist().expect("a path");
            for arc in [-0.4 * travel, 0.2 * travel, 0.6 * travel] {
                let (square, slope, g) = path(&*law, arc);
                assert_close(g * g, square - 0.25 * slope * slope, 1e-12, 0.0, "G");
                let at = Instant { twist: arc, rate: 0.7, acceleration: -3.0, hub_rate: 0.2, hub_acceleration: 5.0, shaft_speed: 100.0 };
                let (own, torque) = equations.reactions(&at);
                for i in 0..5 {
                    let shifted = |by: f64| {
                        let mut a = at;
                        *[&mut a.twist, &mut a.rate, &mut a.acceleration, &mut a.hub_rate, &mut a.hub_acceleration][i] += by;
                        equations.reactions(&a)
                    };
                    let by = 1e-5 * travel;
                    let (up, down) = (shifted(by), shifted(-by));
                    let slope = |f: &dyn Fn(&(Reaction, Reaction)) -> f64| (f(&up) - f(&down)) / (2.0 * by);
                    assert_close(own.by[i], slope(&|r| r.0.value), 1e-7, 1e-7 * own.by[0].abs(), "own");
                    assert_close(torque.by[i], slope(&|r| r.1.value), 1e-7, 1e-7 * torque.by[0].abs(), "torque");
                }
            }
        }
    }
}

/// A limit that small twist keeps and the fold breaks is broken; the objective is that of the own amplitude. What harmonic balance does not tell (power over the duty, properties) stays at small twist, by name.
#[test]
fn limits_at_own_amplitude() {
    let mut s = study("villalva_i6_large_twist");
    s.designs.retain(|d| d.name == "hardening_more");
    s.speeds_rpm.retain(|speed| (1500.0..=2000.0).contains(speed));
    let limit = 0.6f64.to_radians();
    let of = |quantity, over| MeasureSpec { measure: Measure::new(vec![quantity], over), ..s.objective.clone() };
    let ring = Quantity::RingTwist(0);
    let measures = [
        (s.objective.clone(), limit),
        (of(ring, Over::Synthesis), limit),
        (of(ring, Over::Power), 200.0),
        (of(s.twist, Over::Order(Order::from_twice(9))), limit),
        (of(ring, Over::Property(Property::RingInertia)), 1.0),
    ];
    s.limits = measures.map(|(of, limit)| LimitSpec { of, words: String::new(), limit, rule: None }).to_vec();
    let results = s.run().expect("damped");
    let (d, own) = (&results.designs[0], &results.large_twist[0]);
    let (small, peak) = (d.twist.expect("a peak").value, own.peak.expect("a peak").twist);
    assert!(small < limit && peak > limit, "{small} and {peak} round {limit}");
    assert_close(d.limits[0], peak / limit, 1e-9, 0.0, "twist");
    assert_eq!(d.objective, Some(peak));
    let lasting = || own.curves.iter().flatten().filter(|p| p.stable == Some(true));
    let largest = |of: &dyn Fn(&LargePoint) -> f64| lasting().map(of).fold(0.0, f64::max);
    for (i, most) in [(1, largest(&|p| p.ring_twist) / limit), (2, largest(&|p| p.power) / 200.0)] {
        let found = own.at_large_twist.limits[i].expect("told");
        assert!(found >= most && found < 1.02 * most, "limit {i}: {found} against {most} of the points");
        assert_eq!(d.limits[i], found);
    }
    // between the folds, where small twist leads to the lower branch alone: equivalent linearisation leads to the upper one
    s.speeds_rpm.retain(|speed| (1760.0..=1800.0).contains(speed));
    let narrow = s.run().expect("damped").large_twist[0].peak.expect("a peak").twist;
    assert_close(narrow, peak, 1e-7, 0.0, "the fold seen from inside");
    let order = own.at_large_twist.limits[3].expect("told");
    assert!(order > 0.0 && order < peak / limit);
    assert_eq!((own.at_large_twist.limits[4], d.limits[4]), (None, 0.076));
}
