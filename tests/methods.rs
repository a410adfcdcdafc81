//! Every response method on every scenario of the stability map, with the outcome each pair declares: right within a tolerance, refused by name,
//! or known to be wrong by at least some share. A new method needs its outcomes only.

use crate::support::{assert_close, one_throw, uniform_chain};
use hartog::assess::methods::Candidate;
use hartog::assess::stability::scenarios;
use hartog::response::{Grid, Newmark, Quantity, Response, System, Work};

#[test]
fn every_method_on_every_scenario() {
    let mut failed = Vec::new();
    for scenario in scenarios() {
        for cell in scenario.cells() {
            println!("{:<34} {:<18} {:?}: {:?}", scenario.name, cell.candidate.label(), cell.declared, cell.found);
            if !cell.as_declared() {
                failed.push(format!("{}, {}: {:?}, found {:?}", scenario.name, cell.candidate.label(), cell.declared, cell.found));
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

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

#[test]
fn show() { for b in hartog::assess::energy::balances() { println!("{} {} {} {:?}", b.scenario, b.method, b.setting, b.missing); } }
