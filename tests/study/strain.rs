//! Rubber that softens with its strain.

use crate::limits::{TwoMasses, What, with};
use crate::support::assert_close;
use hartog::absorber::{Absorber, Geometry, Kraus, Material, Mounted, RUBBER, WithMaterial};
use hartog::input::DesignSpec;
use hartog::numerics::{C64, I};
use std::f64::consts::PI;

const OMEGA: f64 = 100.0;

/// Source: [Kraus 1984]: at the reference nothing changes, at no strain the storage modulus is `storage_ratio` times that at large strain, the loss modulus is largest at the critical strain and the same at
/// none and at large strain.
#[test]
fn rubber_softens_with_its_strain() {
    let kraus = Kraus { storage_ratio: 3.0, loss_ratio: 2.0, strain: 0.02, exponent: 0.6, reference: 0.05 };
    assert_eq!(kraus.factors(0.05), (1.0, 1.0));
    let (none, large) = (kraus.factors(1e-12), kraus.factors(1e12));
    assert_close(none.0 / large.0, 3.0, 1e-6, 0.0, "storage");
    assert_close(none.1 / large.1, 1.0, 1e-5, 0.0, "loss");
    assert_close(kraus.factors(0.02).1 / large.1, 2.0, 1e-6, 0.0, "largest loss");
    for strain in [0.001, 0.01, 0.019, 0.021, 0.1, 1.0] {
        assert!(kraus.factors(strain).1 < kraus.factors(0.02).1 && kraus.factors(strain).0 > kraus.factors(1.1 * strain).0);
    }
}

/// Law: a strain agrees with itself where the twist under S at that strain is the twist that makes it: on two masses against a fine scan of formulas, 1e-6; of one order both rules are one. Somewhere
/// several do, and the lowest is told of.
#[test]
fn strains_that_agree_with_themselves() {
    let masses = TwoMasses { damping_ratio: 0.02, ring: 0.1 };
    let (k0, eta, per_twist) = (1300.0, 0.05, 400.0);
    let kraus = Kraus { storage_ratio: 4.0, loss_ratio: 1.2, strain: 0.05, exponent: 1.0, reference: 0.05 };
    let mut s = with(masses, What::Twist, &[]);
    s.optimise = None;
    let geometry = Geometry::Wedges { inner: 0.08, outer: 0.11, slope: 1.0 / per_twist, count: 1.0 };
    let material = Material { geometry: Some(geometry), amplitude: Some(kraus), ..Material::default() };
    let law = WithMaterial::of((RUBBER.build)(&[masses.ring, k0, eta]), &material.into());
    s.designs = vec![DesignSpec { name: "ring".into(), absorbers: vec![Mounted::on_station(0, Absorber::Ring(law))] }];
    let results = s.run().expect("damped");
    let [peaks, rms] = results.strain.as_slice() else { panic!("two rules") };
    let mut seen = [0; 4];
    for (p, r) in peaks.points.iter().zip(&rms.points) {
        let omega = p.speed_rpm * PI / 30.0;
        let made = |x: f64| {
            let (storage, loss) = kraus.factors(x.exp());
            let stiffness = k0 * C64::new(storage, eta * loss);
            let ring = C64::from(-masses.ring * omega * omega);
            let own = OMEGA * OMEGA - omega * omega + I * omega * 2.0 * masses.damping_ratio * OMEGA;
            let theta = 1.0 / (own + stiffness * ring / (stiffness + ring));
            x - (per_twist * (ring / (stiffness + ring) * theta).norm()).ln()
        };
        let n = 20_000;
        let at = |i: usize| (1e-6f64).ln() + (1e7f64).ln() * i as f64 / f64::from(n);
        let mut expected = Vec::new();
        for i in 0..n as usize {
            let (mut a, mut b) = (at(i), at(i + 1));
            let rises = made(b) > 0.0;
            if (made(a) > 0.0) == rises {
                continue;
            }
            for _ in 0..60 {
                let c = 0.5 * (a + b);
                if (made(c) > 0.0) == rises { b = c } else { a = c }
            }
            expected.push(a.exp());
        }
        assert_eq!(p.strains.len(), expected.len(), "{} rpm: {:?} against {expected:?}", p.speed_rpm, p.strains);
        seen[expected.len()] += 1;
        for ((found, expected), other) in p.strains.iter().zip(&expected).zip(&r.strains) {
            assert_close(*found, *expected, 1e-6, 0.0, "strain");
            assert_close(*other, *expected, 1e-6, 0.0, "of one order the rules are one");
        }
    }
    assert!(seen[1] > 0 && seen[3] > 0, "{seen:?}");
}
