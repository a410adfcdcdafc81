//! Torsional chain: modes and what follows from them.

use crate::support::{assert_close, study, uniform_chain};
use hartog::drivetrain::{Chain, Modes, Station};
use hartog::engine::Order;

/// Source: [Villalva 2014] Tables 4.1 and 4.7. Independent method: eigenvalues of J⁻¹K by the unsymmetric Schur form, to 1e-9. The printed
/// digits are those of the issue that asked for them.
#[test]
fn natural_frequencies_of_the_shipped_engines() {
    let expected =
        [("villalva_v10_thesis", [412.84, 1053.40, 1634.40, 2079.93]), ("villalva_i6_thesis", [229.21, 618.04, 1073.64, 1352.47])];
    for (name, printed) in expected {
        let study = study(name);
        let own = study.modes.frequencies_hz();
        let mut dense = study.chain.stiffness_matrix();
        for (i, j) in study.chain.inertias().iter().enumerate() {
            dense.row_mut(i).scale_mut(1.0 / j);
        }
        let mut lambda: Vec<f64> = dense.complex_eigenvalues().iter().map(|l| l.re).collect();
        lambda.sort_by(f64::total_cmp);
        for (i, f) in own.iter().enumerate() {
            assert_close(*f, lambda[i + 1].sqrt() / std::f64::consts::TAU, 1e-9, 0.0, name);
        }
        for (f, printed) in own.iter().zip(printed) {
            assert_eq!(format!("{f:.2}"), format!("{printed:.2}"), "{name}");
        }
    }
}

/// Source: a free uniform chain has omega_i = 2 sqrt(k/J) sin(i pi/(2 n)). A thousand stations lose no digits that matter.
#[test]
fn uniform_chains_have_their_closed_form() {
    for n in [1usize, 2, 3, 50, 1000] {
        let modes = Modes::new(&uniform_chain(n, 0.01, 1e6));
        assert_eq!((modes.rigid, modes.omega.len()), (1, n));
        for i in modes.elastic() {
            let exact = 2.0 * 1e4 * (i as f64 * std::f64::consts::PI / (2 * n) as f64).sin();
            assert_close(modes.omega[i], exact, 1e-9, 1e-6, &format!("mode {i} of {n}"));
        }
    }
}

/// Law: modes are orthonormal with respect to J, and diagonalise K.
#[test]
fn modes_are_orthonormal() {
    let study = study("villalva_i6_thesis");
    let (phi, j, k) = (&study.modes.shapes, study.chain.inertias(), study.chain.stiffness_matrix());
    let product = phi.transpose() * nalgebra::DMatrix::from_diagonal(&j.into()) * phi;
    let stiffness = phi.transpose() * k * phi;
    let largest = study.modes.omega[7] * study.modes.omega[7];
    for a in 0..8 {
        for b in 0..8 {
            let unit = f64::from(u8::from(a == b));
            assert_close(product[(a, b)], unit, 0.0, 1e-12, "J");
            assert_close(stiffness[(a, b)], unit * study.modes.omega[a].powi(2), 0.0, 1e-11 * largest, "K");
        }
    }
}

/// A spring to ground removes a rigid mode, a shaft without stiffness adds one.
#[test]
fn rigid_bodies_are_counted() {
    let mut chain = uniform_chain(4, 0.01, 1e6);
    assert_eq!(chain.rigid_bodies(), 1);
    chain.stations[1].stiffness_to_next = 0.0;
    assert_eq!(chain.rigid_bodies(), 2);
    assert_eq!(Modes::new(&chain).frequencies_hz().len(), 2);
    chain.stations[3].stiffness_to_ground = 1e5;
    assert_eq!(chain.rigid_bodies(), 1);
    assert_eq!(Modes::new(&chain).frequencies_hz().len(), 3);
}

/// Source: one grounded inertia: omega = sqrt(k/J), zeta = c/(2 J omega), and loss factor eta adds eta/2.
#[test]
fn damping_ratio_and_equivalent_inertia_of_one_station() {
    let station = Station { name: "a".into(), inertia: 0.5, stiffness_to_ground: 2e4, damping_to_ground: 4.0, ..Station::default() };
    let modes = Modes::new(&Chain { stations: vec![station] });
    assert_close(modes.omega[0], 200.0, 1e-14, 0.0, "frequency");
    assert_close(modes.damping_ratio(0), 4.0 / (2.0 * 0.5 * 200.0), 1e-14, 0.0, "damping ratio");
    assert_close(modes.equivalent_inertia(0, 0), 0.5, 1e-14, 0.0, "equivalent inertia");
    let mut two = uniform_chain(2, 1.0, 100.0);
    two.stations[0].loss_factor_to_next = 0.06;
    assert_close(Modes::new(&two).damping_ratio(1), 0.03, 1e-12, 0.0, "loss factor");
}

/// Source: [Villalva 2014] Table 5.2: order 3.5 meets mode 1 of the V10 at 7080 rpm, order 5 at 4956 (from 413 Hz, printed without decimals).
#[test]
fn critical_speeds_of_the_v10() {
    let study = study("villalva_v10_thesis");
    for (twice, printed) in [(7, 7080.0), (8, 6195.0), (10, 4956.0), (15, 3304.0)] {
        assert_close(study.modes.critical_speed_rpm(1, Order::from_twice(twice)), printed, 0.001, 0.0, "critical speed");
    }
}
