//! Calibration: recovers what is known, says how well, and names what the rows cannot tell.

use crate::support::{assert_close, study};
use hartog::analysis::amplitude::near;
use hartog::analysis::calibrate::Known;
use hartog::analysis::calibrate::statistics::statistics;
use hartog::analysis::{self, Calibration, Silent};
use hartog::drivetrain::System;
use hartog::engine::{Excitation, Order, Pressure, Source};
use hartog::input::published::PublishedAmplitude;
use hartog::input::{FreeInput, Input, Study};
use hartog::numerics::least_squares::{Range, fit};
use hartog::response::{Direct, Grid, Work};
use hartog::units::RAD_PER_DEG;
use nalgebra::DMatrix;
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use rayon::prelude::*;
use std::convert::Infallible;

/// The six with synthetic measurements: orders of two designs near their resonances, from known inputs.
fn synthetic(truth: &[(Input, f64)]) -> Study {
    let mut s = study("villalva_i6_thesis");
    // the cycle is the same at both tabulated speeds: one is computed
    let Source::Cylinder { pressure: Pressure::Wiebe(w), .. } = &mut s.engine.source else { panic!("a Wiebe cycle") };
    w.speeds_rpm.truncate(1);
    w.indicated_mean_pressure.truncate(1);
    s.order_limit = 8.0;
    let model = s.with_inputs(truth);
    let system = System::new(model.chain.clone(), Excitation::new(&model.engine, model.order_limit));
    let grid = Grid::new(&model.speeds_rpm, &[]);
    let direct = Direct::new(&system, &grid);
    let frequency = |design: usize| [229.21, 156.2][design];
    let mut rows = Vec::new();
    for design in 0..2 {
        for twice in 5..=16 {
            let order = Order::from_twice(twice);
            let speed_rpm = 60.0 * frequency(design) / order.value();
            if !(700.0..3100.0).contains(&speed_rpm) {
                continue;
            }
            let found = near(&model, &direct, &s.designs[design].absorbers, order, speed_rpm, &mut Work::default());
            let amplitude = found.expect("damped").map(|n| n.amplitude);
            rows.push(PublishedAmplitude { table: String::new(), design, order, speed_rpm, amplitude });
        }
    }
    let spec = s.calibrate.as_mut().expect("calibrates");
    spec.rows = (0..rows.len()).collect();
    s.published.as_mut().expect("tables").amplitudes = rows;
    s
}

const TRUTH: [(Input, f64); 2] = [(Input::PressureScale, 1.13), (Input::ThrowDamping, 7.2)];

fn fitted(s: &Study) -> Calibration {
    analysis::calibrate(s, &Silent).expect("damped").1.expect("calibrates")
}

/// Without noise the inputs come back to rounding.
#[test]
fn exact_measurements_give_exact_inputs() {
    let c = fitted(&synthetic(&TRUTH));
    for (input, truth) in c.inputs.iter().zip(TRUTH) {
        assert_close(input.value, truth.1, 1e-6, 0.0, input.free.input.key());
        assert_eq!(input.known, Known::Yes);
    }
    assert!(c.rows.len() >= 16 && c.rms().1 < 1e-8 && c.rms().0 > 1e-4, "{:?}", c.rms());
}

/// The level of an Otto cycle without friction, whose torque is linear in it: measurements made by the cycle itself give it back, with the damping. To 1e-6.
#[test]
fn level_of_an_otto_cycle() {
    let truth = [(Input::PressureScale, 0.61), (Input::ThrowDamping, 3.1)];
    let mut s = study("villalva_v10_thesis");
    let model = s.with_inputs(&truth);
    let system = System::new(model.chain.clone(), Excitation::new(&model.engine, model.order_limit));
    let grid = Grid::new(&model.speeds_rpm, &[]);
    let direct = Direct::new(&system, &grid);
    let designs = s.designs.clone();
    for row in &mut s.published.as_mut().expect("tables").amplitudes {
        let found = near(&model, &direct, &designs[row.design].absorbers, row.order, row.speed_rpm, &mut Work::default());
        row.amplitude = found.expect("damped").map(|n| n.amplitude);
    }
    let c = fitted(&s);
    for (input, truth) in c.inputs.iter().zip(truth) {
        assert_close(input.value, truth.1, 1e-6, 0.0, input.free.input.key());
    }
    assert!(c.rms().1 < 1e-8 && c.rms().0 > 1e-4, "{:?}", c.rms());
}

/// With noise of 0.01° the true inputs lie within three standard errors in at least 95 of 100 seeds; here in all of the first 10.
#[test]
fn standard_errors_cover_the_truth() {
    covers_the_truth(10);
}

#[test]
#[ignore = "half a minute of processor time"]
fn standard_errors_of_a_hundred_seeds() {
    covers_the_truth(100);
}

fn covers_the_truth(seeds: u64) {
    let exact = synthetic(&TRUTH);
    let covered = |seed: u64| {
        let mut generator = Xoshiro256PlusPlus::seed_from_u64(seed);
        // Box and Muller
        let mut normal = || {
            (-2.0 * generator.random_range(f64::MIN_POSITIVE..1.0f64).ln()).sqrt()
                * (std::f64::consts::TAU * generator.random::<f64>()).cos()
        };
        let mut s = exact.clone();
        for row in &mut s.published.as_mut().expect("tables").amplitudes {
            row.amplitude = row.amplitude.map(|a| a + 0.01 * RAD_PER_DEG * normal());
        }
        let c = fitted(&s);
        c.inputs.iter().zip(TRUTH).all(|(i, truth)| (i.value - truth.1).abs() <= 3.0 * i.standard_error.expect("rows to spare"))
    };
    let count = (0..seeds).into_par_iter().filter(|seed| covered(*seed)).count() as u64;
    println!("{count} of {seeds} seeds");
    assert!(100 * count >= 95 * seeds, "{count} of {seeds}");
}

/// Inputs that the rows cannot tell apart or do not see are named: the loss factor of all shafts beside the damping of the throws,
/// and boost pressure beside the mean pressure.
#[test]
fn what_rows_cannot_tell_is_named() {
    let mut s = study("villalva_i6_thesis");
    let free = |input, lower, upper, start| FreeInput { input, lower, upper, start, varies: false, scale: 0.01 };
    let spec = s.calibrate.as_mut().expect("calibrates");
    spec.inputs.push(free(Input::ShaftLossFactor, 0.0, 0.02, 0.0));
    let c = fitted(&s);
    let loss = &c.inputs[2];
    assert!(loss.known != Known::Yes || !c.alike().is_empty(), "{:?} {:?}", c.inputs, c.statistics);
    // one row, two inputs
    let spec = s.calibrate.as_mut().expect("calibrates");
    spec.inputs.truncate(2);
    spec.rows.truncate(2);
    assert!(fitted(&s).inputs.iter().all(|i| i.known != Known::Yes && i.standard_error.is_none()));
}

/// Independent: standard errors and correlation of a straight line by its textbook formulas; columns that are zero or alike are not
/// determined.
#[test]
fn statistics_of_a_straight_line() {
    let x = [0.0, 1.0, 2.0, 3.0, 4.0];
    let residuals = [0.1, -0.2, 0.05, 0.15, -0.1];
    let jacobian = DMatrix::from_fn(5, 2, |i, j| if j == 0 { 1.0 } else { x[i] });
    let s = statistics(&jacobian, &residuals, &[10.0, 0.1], |_, _| 1.0);
    let variance = residuals.iter().map(|r| r * r).sum::<f64>() / 3.0;
    let (mean, spread) = (2.0, 10.0);
    assert_close(s.standard_errors[1].expect("known"), (variance / spread).sqrt(), 1e-9, 0.0, "slope");
    assert_close(s.standard_errors[0].expect("known"), (variance * (0.2 + mean * mean / spread)).sqrt(), 1e-9, 0.0, "intercept");
    assert_close(s.correlation[0][1].expect("known"), -mean / (spread / 5.0 + mean * mean).sqrt(), 1e-9, 0.0, "correlation");
    let alike = DMatrix::from_fn(5, 3, |i, j| if j < 2 { x[i] } else { 1.0 });
    let s = statistics(&alike, &residuals, &[1.0; 3], |_, _| 1.0);
    assert!(s.standard_errors[0] == Some(f64::INFINITY) && s.standard_errors[1] == Some(f64::INFINITY));
    assert!(s.standard_errors[2].is_some_and(f64::is_finite) && s.correlation[0][1].is_none());
    let zero = DMatrix::from_fn(5, 2, |i, j| if j == 0 { 0.0 } else { x[i] });
    assert_eq!(statistics(&zero, &residuals, &[1.0; 2], |_, _| 1.0).standard_errors[0], Some(f64::INFINITY));
}

/// Rosenbrock's valley, a minimum on a bound, and a problem whose residuals stay large and curved, where Gauss and Newton alone swing.
#[test]
fn least_squares_finds_known_minima() {
    let range = |lower, upper| Range { lower, upper, scale: 1.0 };
    let rosenbrock = |x: &[f64]| Ok::<_, Infallible>(vec![10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]]);
    let f = fit(rosenbrock, &[range(-2.0, 2.0), range(-1.0, 3.0)], &[-1.2, 1.0]).expect("finite");
    assert_close(f.point[0], 1.0, 1e-6, 0.0, "x");
    assert_close(f.point[1], 1.0, 1e-6, 0.0, "y");
    let f = fit(|x: &[f64]| Ok::<_, Infallible>(vec![x[0] - 5.0, 0.1 * x[0]]), &[range(0.0, 2.0)], &[0.5]).expect("finite");
    assert_close(f.point[0], 2.0, 1e-6, 0.0, "on the bound");
    // sum of (x - 1)² and (x² + 2)²: the derivative 2 (x - 1) + 4 x (x² + 2) has one root
    let curved = |x: &[f64]| Ok::<_, Infallible>(vec![x[0] - 1.0, x[0] * x[0] + 2.0]);
    let f = fit(curved, &[range(-3.0, 3.0)], &[2.0]).expect("finite");
    let x = f.point[0];
    assert_close(2.0 * (x - 1.0) + 4.0 * x * (x * x + 2.0), 0.0, 0.0, 1e-4, "stationary");
    assert!(f.evaluations < 100, "{}", f.evaluations);
    assert_eq!(fit(|_: &[f64]| Err::<Vec<f64>, _>("no"), &[range(0.0, 1.0)], &[0.5]), Err("no"));
}

/// Work is pinned: more evaluations of the six's rows than this would be a search that no longer converges.
#[test]
fn evaluations_are_few() {
    let c = fitted(&study("villalva_i6_thesis"));
    assert_eq!(c.agreeing.0, c.agreeing.1);
    assert!(c.evaluations <= 400, "{}", c.evaluations);
}

/// Bounds decades apart change nothing: the same values and standard errors as with narrow ones, and a search that ends on a bound says so.
#[test]
fn wide_bounds_change_nothing() {
    let with = |lower: f64, upper: f64| {
        let mut s = study("villalva_i6_thesis");
        let free = &mut s.calibrate.as_mut().expect("calibrates").inputs;
        free.remove(0);
        (free[0].lower, free[0].upper) = (lower, upper);
        fitted(&s).inputs[0].clone()
    };
    let narrow = with(5.0, 15.0);
    assert_eq!(narrow.known, Known::Yes);
    for upper in [2e3, 1e5, 1e9] {
        let wide = with(0.0, upper);
        assert_close(wide.value, narrow.value, 1e-4, 0.0, &format!("to {upper}"));
        assert_close(wide.standard_error.expect("rows"), narrow.standard_error.expect("rows"), 0.02, 0.0, &format!("error to {upper}"));
        assert_eq!(wide.known, Known::Yes, "to {upper}");
    }
    assert_eq!(with(20.0, 30.0).known, Known::AtBound);
}
