//! Absorbers: closed forms, and the laws every type obeys.

use crate::support::{Kind, assert_close, h_infinity_peak, study};
use hartog::absorber::closed_forms::{self, EngineMode};
use hartog::absorber::{Host, SpringAndDamper};

/// Amplitude of the engine mass in static deflections, omega/omega_engine = x, [Den Hartog 1956] eq. (3.24); `zeta` = c/(2 J omega_engine).
fn amplitude(mu: f64, tuning: f64, zeta: f64, x: f64) -> f64 {
    let (f2, x2, d) = (tuning * tuning, x * x, (2.0 * zeta * x).powi(2));
    let top = (f2 - x2).powi(2) + d;
    let bottom = ((f2 - x2) * (1.0 - x2) - mu * f2 * x2).powi(2) + d * (1.0 - x2 - mu * x2).powi(2);
    (top / bottom).sqrt()
}

fn peak(mu: f64, tuning: f64, zeta: f64) -> f64 {
    let coarse =
        (1..20_000).map(|i| f64::from(i) * 2e-4).max_by(|a, b| amplitude(mu, tuning, zeta, *a).total_cmp(&amplitude(mu, tuning, zeta, *b)));
    let x = coarse.expect("not empty");
    (-2000..=2000).map(|i| amplitude(mu, tuning, zeta, x + f64::from(i) * 1e-7)).fold(0.0, f64::max)
}

/// Source: [Nishihara & Asami 2002]. Independent check: the closed-form peak is the peak of the closed-form absorber (1e-9), no neighbour is
/// better, and for light rings it tends to Den Hartog's sqrt(1 + 2/mu).
#[test]
fn exact_optimum_is_optimal() {
    for mu in [0.01, 0.05, 0.1, 0.3, 1.0] {
        let (f, z) = closed_forms::h_infinity(mu);
        let best = h_infinity_peak(mu);
        assert_close(peak(mu, f, z), best, 1e-9, 0.0, "peak");
        for (df, dz) in [(1e-3, 0.0), (-1e-3, 0.0), (0.0, 1e-2), (0.0, -1e-2), (1e-3, 1e-2), (-1e-3, -1e-2), (1e-3, -1e-2), (-1e-3, 1e-2)] {
            assert!(peak(mu, f * (1.0 + df), z * (1.0 + dz)) > best, "mu {mu}: a neighbour is better");
        }
    }
    assert_close(h_infinity_peak(1e-3), (1.0 + 2.0 / 1e-3f64).sqrt(), 1e-4, 0.0, "light ring");
}

/// Source: [Den Hartog 1956] section 3.3: the fixed points are level at sqrt(1 + 2/mu) for the tuning 1/(1 + mu); Brock's damping brings the
/// peak within 1 % of them, and the exact optimum is lower still by a hair. The points lie at x² = (1 -+ sqrt(mu/(2 + mu)))/(1 + mu):
/// [Villalva 2014] p. 128 prints the factor 1/(1 + mu) outside the root.
#[test]
fn den_hartog_and_brock() {
    for mu in [0.02f64, 0.1, 0.25] {
        let level = (1.0 + 2.0 / mu).sqrt();
        let tuning = 1.0 / (1.0 + mu);
        for sign in [-1.0f64, 1.0] {
            let x = (tuning * (1.0 + sign * (mu / (2.0 + mu)).sqrt())).sqrt();
            for zeta in [0.01, 0.1, 1.0] {
                assert_close(amplitude(mu, tuning, zeta, x), level, 1e-11, 0.0, "fixed point");
            }
        }
        let brock = peak(mu, tuning, closed_forms::den_hartog_brock(mu));
        assert!(brock < 1.01 * level && brock > h_infinity_peak(mu), "mu {mu}: {brock} against {level}");
    }
}

/// Source: [Brock 1946]: with unity tuning the curve is horizontal at the lower fixed point, x² = 1 - sqrt(mu/(2 + mu)).
#[test]
fn brock_unity_is_horizontal_at_the_lower_fixed_point() {
    for mu in [0.02f64, 0.1, 0.25, 1.0] {
        let (z, h) = (closed_forms::brock_unity(mu), 1e-5);
        let x = (1.0 - (mu / (2.0 + mu)).sqrt()).sqrt();
        let slope = (amplitude(mu, 1.0, z, x + h) - amplitude(mu, 1.0, z, x - h)) / (2.0 * h);
        assert_close(slope / amplitude(mu, 1.0, z, x), 0.0, 0.0, 1e-6, "slope");
    }
}

/// Source: [Villalva 2014] eqs. (6.29) and (6.33): the viscous absorber's peak is (2 + mu)/mu static deflections, and no other damping is better.
#[test]
fn viscous_optimum() {
    for mu in [0.1, 1.0, 5.0] {
        let z = closed_forms::viscous_untuned(mu);
        assert_close(peak(mu, 0.0, z), (2.0 + mu) / mu, 1e-9, 0.0, "peak");
        assert!(peak(mu, 0.0, 1.01 * z) > peak(mu, 0.0, z) && peak(mu, 0.0, 0.99 * z) > peak(mu, 0.0, z));
    }
}

/// The two damping ratios: c/(2 J omega_absorber) = sqrt(3 mu/(8 (1 + mu))) is the same damper as den_hartog_brock's c/(2 J omega_engine).
#[test]
fn the_two_damping_ratios_mean_the_same_damper() {
    let (mu, engine) = (0.2f64, EngineMode { inertia: 3.0, omega: 700.0 });
    let SpringAndDamper { stiffness, damping } = closed_forms::den_hartog_brock_ring(0.6, engine);
    let omega_absorber = (stiffness / 0.6).sqrt();
    assert_close(omega_absorber, 700.0 / 1.2, 1e-14, 0.0, "tuning");
    assert_close(damping / (2.0 * 0.6 * omega_absorber), (3.0 * mu / (8.0 * (1.0 + mu))).sqrt(), 1e-14, 0.0, "of the absorber");
    assert_close(damping / (2.0 * 0.6 * 700.0), closed_forms::den_hartog_brock(mu), 1e-14, 0.0, "of the engine");
}

/// Source: [Villalva 2014] Tables 6.1 and 6.2 (whole-chain inertia, flywheel included): unity stiffness J w0² within 1 %, unity and viscous
/// damping within 7 % (the thesis reads its damping from a point 1 % beside the fixed point).
#[test]
fn closed_forms_reproduce_the_thesis() {
    for (name, ring, stiffness, damping, viscous_ring, viscous) in
        [("villalva_v10_thesis", 0.052, 350e3, 99.9, 0.01, 24.7), ("villalva_i6_thesis", 0.076, 158e3, 34.2, 0.076, 105.1)]
    {
        let s = study(name);
        let engine = EngineMode { inertia: s.chain.total_inertia(), omega: s.modes.omega[1] };
        let unity = closed_forms::brock_unity_ring(ring, engine);
        assert_close(unity.stiffness, stiffness, 0.01, 0.0, "unity stiffness");
        assert_close(unity.damping, damping, 0.07, 0.0, "unity damping");
        assert_close(closed_forms::viscous_damping(viscous_ring, engine), viscous, 0.07, 0.0, "viscous damping");
    }
}

/// A design that hangs on nothing is an error that names the absorber, not a panic: on a station that the chain does not have, on a ring that is none, on its own ring.
#[test]
fn what_hangs_on_nothing_is_refused() {
    let s = study("den_hartog");
    let on = |host: Host| {
        let mut mounted = crate::support::on(0, Kind::Tuned, 0.1, 800.0, 3.0);
        mounted.on = host;
        s.evaluate("mine", vec![mounted]).expect_err("refused").to_string()
    };
    assert!(
        on(Host::Station(9)).contains("absorber 1 cannot be mounted: the chain has no station of that index"),
        "{}",
        on(Host::Station(9))
    );
    for host in [Host::Ring(3), Host::Ring(0)] {
        assert!(on(host).contains("cannot be mounted: the absorbers hang on each other's rings"), "{}", on(host));
    }
}
