//! Rings on Prony series.

use crate::support::{assert_close, study};
use hartog::absorber::{Branch, Law, Maxwell, Operating, Prony};
use hartog::numerics::C64;

fn at(omega: f64) -> Operating {
    Operating { omega, shaft_speed: 100.0 }
}

fn close(a: C64, b: C64, tolerance: f64, what: &str) {
    assert!((a - b).norm() <= tolerance * b.norm(), "{what}: {a} against {b}");
}

/// Of one branch and no spring a Prony series is an oil of Maxwell; of several it goes from k to k + sum k_j; it is passive, and its derivatives are those of differences.
#[test]
fn branches_of_a_prony_series() {
    let series = |stiffness: f64, branches: &[(f64, f64)], stiffness_scale: f64, time_scale: f64| {
        let branches = branches.iter().map(|b| Branch { stiffness: b.0, relaxation_time: b.1 }).collect();
        Prony { ring_inertia: 0.1, stiffness, branches, stiffness_scale, time_scale }
    };
    let branches = [(300.0, 2e-2), (500.0, 3e-3), (900.0, 4e-4)];
    let maxwell = Maxwell { ring_inertia: 0.1, damping: 7.0, relaxation_time: 4e-3 };
    for omega in [3.0, 100.0, 2000.0] {
        close(
            series(0.0, &[(7.0 / 4e-3, 4e-3)], 1.0, 1.0).dynamic_stiffness(at(omega)),
            maxwell.dynamic_stiffness(at(omega)),
            1e-14,
            "Maxwell",
        );
        let own = series(800.0, &branches, 1.3, 0.7);
        assert!(own.dynamic_stiffness(at(omega)).im > 0.0);
        for (i, derivative) in own.derivatives(at(omega)).into_iter().enumerate() {
            let moved = |by: f64| {
                let values: Vec<f64> = own.values().iter().enumerate().map(|(j, v)| if i == j { v * (1.0 + by) } else { *v }).collect();
                own.rebuilt(&values).dynamic_stiffness(at(omega))
            };
            let difference = (moved(1e-5) - moved(-1e-5)) / (2e-5 * own.values()[i]);
            assert!((difference - derivative).norm() < 1e-8 * own.dynamic_stiffness(at(omega)).norm(), "{i}: {difference} {derivative}");
        }
    }
    let own = series(800.0, &branches, 1.0, 1.0);
    close(own.dynamic_stiffness(at(1e-9)), 800.0.into(), 1e-9, "at rest");
    close(own.dynamic_stiffness(at(1e12)), 2500.0.into(), 1e-6, "at high frequency");
}

/// The shipped Prony series is the fractional Zener law at the reference temperature, fitted to 0.3 % of S over the frequencies of the study: the twist is off by no more.
#[test]
fn a_prony_series_is_the_rubber_it_was_fitted_to() {
    let mut s = study("villalva_i6_laws");
    s.designs.retain(|d| ["prony", "fractional_zener"].contains(&d.name.as_str()));
    let results = s.run().expect("damped");
    let [law, series] = results.designs.as_slice() else { panic!("two designs") };
    assert_close(series.objective.expect("twist"), law.objective.expect("twist"), 3e-3, 0.0, "firing");
}
