//! Every response method on every scenario of the stability map, with the outcome each pair declares: right within a tolerance, refused by name,
//! or known to be wrong by at least some share. A new method needs its outcomes only.

use crate::support::{assert_close, one_throw, uniform_chain};
use hartog::benchmark::energy::balances;
use hartog::benchmark::methods::Candidate;
use hartog::benchmark::scenarios::scenarios;
use hartog::drivetrain::System;
use hartog::numerics::C64;
use hartog::numerics::I;
use hartog::response::{Grid, Newmark, Quantity, Rate, Response, Work};
use hartog::units::RAD_PER_S_PER_RPM;

/// Law: every integrator errs by the square of its step. Den Hartog's two masses at 180 and 360 steps a cycle.
#[test]
fn integrators_are_of_second_order() {
    let scenario = scenarios().into_iter().find(|s| s.name.starts_with("Den Hartog")).expect("a scenario");
    let grid = Grid::new(&scenario.speeds, &[]);
    let sweep = |candidate: Candidate| {
        let method = candidate.build(&scenario.system, &grid, &scenario.design, scenario.quantity).expect("a method");
        let mut out = Vec::new();
        method.sweep(&scenario.design, scenario.quantity, &mut out, &mut Work::default()).expect("damped");
        out
    };
    let exact = sweep(Candidate::Dense);
    let error = |candidate| sweep(candidate).iter().zip(&exact).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    for method in [Candidate::Average, Candidate::Linear, Candidate::Central, Candidate::Exponential] {
        let order = (error(method(180)) / error(method(360))).log2();
        assert_close(order, 2.0, 0.0, 0.05, &method(180).label());
    }
}

/// Both sides of the stability limit, sqrt(12) for linear acceleration and 2 for central difference, on one mass: below it the answer is
/// there, above it is refused; average acceleration takes any step; gamma below 1/2 is refused.
#[test]
fn stability_limits_of_newmark() {
    let omega = 100.0;
    let mut chain = uniform_chain(1, 1.0, 0.0);
    (chain.stations[0].stiffness_to_ground, chain.stations[0].damping_to_ground) = (omega * omega, 4.0);
    let system = System::new(chain, one_throw(&[(2, 1.0)]));
    let steps = 4;
    let at = |beta: f64, gamma: f64, product: f64| {
        // a two-stroke cycle is one revolution
        let speed_rpm = 60.0 * omega / (product * f64::from(steps));
        let grid = Grid::new(&[speed_rpm], &[]);
        let method = Newmark::new(&system, &grid, (beta, gamma), steps as usize);
        method.phasor(&[], Quantity::Twist { from: 0, to: None }, (0, speed_rpm), &mut Work::default())
    };
    for (beta, limit) in [(1.0 / 6.0, 12f64.sqrt()), (0.0, 2.0)] {
        assert!(at(beta, 0.5, 0.99 * limit).is_ok_and(|y| y.is_finite()), "below {limit}");
        let refused = at(beta, 0.5, 1.01 * limit).expect_err("above").to_string();
        assert!(refused.contains("unstable") && refused.contains(&format!("{limit:.3}")), "{refused}");
    }
    assert!(at(0.25, 0.5, 50.0).is_ok_and(|y| y.norm() < 1.0), "average acceleration stays bounded");
    assert!(at(0.25, 0.4, 0.1).expect_err("gamma").to_string().contains("gamma below 1/2"));
}

/// Law: average acceleration answers as if the frequency w were (2/dt) tan(w dt/2): its period comes out longer by (w dt)²/12. One mass, to
/// rounding.
#[test]
fn period_error_of_average_acceleration() {
    let (stiffness, damping) = (1e4, 4.0);
    let mut chain = uniform_chain(1, 1.0, 0.0);
    (chain.stations[0].stiffness_to_ground, chain.stations[0].damping_to_ground) = (stiffness, damping);
    let system = System::new(chain, one_throw(&[(2, 1.0)]));
    for steps in [8, 20, 100] {
        let speed_rpm = 900.0;
        let omega = speed_rpm * RAD_PER_S_PER_RPM;
        let grid = Grid::new(&[speed_rpm], &[]);
        let found = Newmark::new(&system, &grid, (0.25, 0.5), steps)
            .phasor(&[], Quantity::Twist { from: 0, to: None }, (0, speed_rpm), &mut Work::default())
            .expect("damped");
        let dt = std::f64::consts::TAU / omega / steps as f64;
        let shifted = 2.0 / dt * (0.5 * omega * dt).tan();
        let predicted = 1.0 / (stiffness - shifted * shifted + I * shifted * damping);
        assert_close((found / predicted - 1.0).norm(), 0.0, 0.0, 1e-10, &format!("{steps} steps"));
        assert_close(shifted / omega - 1.0, (omega * dt).powi(2) / 12.0, 0.1, 0.0, "period error");
    }
}

/// Law: in a steady motion the dampers take out what the torques put in. Methods that solve the system, and Newmark with gamma = 1/2 by sample means,
/// to 1e-9; the matrix exponential by the integral under the straight lines that its torque is held to; real modes with their own damping matrix, which is
/// not that of the system: what those dampers take out is off by half and more. Newmark's gamma above 1/2 takes energy out by itself, below it is refused.
#[test]
fn energy_put_in_is_dissipated() {
    let balances = balances();
    for scenario in ["tuned absorber", "viscous absorber", "loss factors"] {
        for b in balances.iter().filter(|b| b.scenario == scenario) {
            let what = format!("{scenario}, {}, {}: {:?}", b.method, b.setting, b.missing);
            let in_time = b.method == "newmark" || b.method == "exponential";
            match (b.method, b.setting, &b.missing) {
                (_, _, Err(e)) if in_time && scenario == "loss factors" => assert!(e.to_string().contains("loss factors"), "{what}"),
                (_, "gamma 0.4, refused", Err(e)) => assert!(e.to_string().contains("gamma below 1/2"), "{what}"),
                (_, "gamma 0.6, dissipative", Ok(missing)) => assert!((0.03..0.5).contains(missing), "{what}"),
                ("modal", "dampers of the system", Ok(missing)) => assert!(*missing > 0.5, "{what}"),
                ("reduced", _, Ok(missing)) => assert!(missing.abs() < 0.2, "{what}"),
                (_, _, Ok(missing)) => assert!(missing.abs() < 1e-9, "{what}"),
                (_, _, Err(e)) => panic!("{what}: {e}"),
            }
        }
    }
    assert!(balances.len() >= 36, "{}", balances.len());
}

/// Law: a velocity is i times the frequency times the angle, an acceleration minus the square of the frequency times it, by every method that answers.
#[test]
fn rates_are_derivatives_of_angles() {
    let scenario = scenarios().into_iter().find(|s| s.name.starts_with("Den Hartog")).expect("a scenario");
    let grid = Grid::new(&scenario.speeds, &[]);
    let mut answered = 0;
    for rate in [Rate::Velocity, Rate::Acceleration] {
        for cell in scenario.cells() {
            let sweep = |quantity| {
                let method = cell.candidate.build(&scenario.system, &grid, &scenario.design, quantity)?;
                let mut out = Vec::new();
                method.sweep(&scenario.design, quantity, &mut out, &mut Work::default()).ok().map(|()| out)
            };
            let (Some(angles), Some(found)) = (sweep(Quantity::Twist { from: 0, to: None }), sweep(Quantity::Motion(0, rate))) else {
                continue;
            };
            answered += 1;
            for (i, (angle, found)) in angles.iter().zip(&found).enumerate() {
                let orders = scenario.system.orders();
                let omega = scenario.system.excitation.orders[i % orders].omega(scenario.speeds[i / orders]);
                let expected = match rate {
                    Rate::Velocity => angle * C64::new(0.0, omega),
                    Rate::Acceleration => angle * -(omega * omega),
                };
                assert_close((found - expected).norm(), 0.0, 0.0, 1e-9 * expected.norm(), &cell.candidate.label());
            }
        }
    }
    assert!(answered >= 16, "{answered} methods");
}
