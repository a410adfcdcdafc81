//! Mathematics against independent methods.

use crate::support::assert_close;
use hartog::numerics::elementary::{ComplexElementary, Elementary};
use hartog::numerics::ellipsoid::ellipsoid;
use hartog::numerics::interpolation::Interpolation;
use hartog::numerics::matrix_exponential::matrix_exponential;
use hartog::numerics::polyline::polyline;
use hartog::numerics::rounding::seven_digits;
use hartog::numerics::synthesis::Synthesiser;
use hartog::numerics::tridiagonal::Tridiagonal;
use hartog::numerics::{C64, eigen, harmonics, maximise};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use std::f64::consts::TAU;

fn complex() -> impl Strategy<Value = C64> {
    // zeros often: pivots vanish, rows must be exchanged
    let part = || prop_oneof![2 => Just(0.0), 5 => -2.0..2.0f64];
    (part(), part()).prop_map(|(re, im)| C64::new(re, im))
}

proptest! {
    /// Independent method: dense LU with full pivoting of nalgebra. Tolerance: 1e-9 of the solution's size for matrices that are not
    /// nearly singular.
    #[test]
    fn tridiagonal_solve_equals_dense(n in 1usize..8, values in prop::collection::vec(complex(), 32)) {
        let mut t = Tridiagonal::zeros(n);
        for i in 0..n {
            t.diagonal[i] = values[i];
            if i + 1 < n {
                t.lower[i] = values[8 + i];
                t.upper[i] = values[16 + i];
            }
        }
        let dense = DMatrix::from_fn(n, n, |i, j| match i as i64 - j as i64 {
            0 => t.diagonal[i],
            1 => t.lower[j],
            -1 => t.upper[i],
            _ => C64::default(),
        });
        let b: Vec<C64> = values[24..24 + n].to_vec();
        let condition = dense.clone().singular_values();
        prop_assume!(condition[condition.len() - 1] > 1e-4);
        let expected = dense.full_piv_lu().solve(&DVector::from_vec(b.clone())).expect("regular");
        t.factor().expect("regular");
        let mut x = b;
        t.solve(&mut x);
        for (a, e) in x.iter().zip(expected.iter()) {
            prop_assert!((a - e).norm() <= 1e-9 * (1.0 + expected.norm()), "{a} against {e}");
        }
    }

    /// Independent method: 20 000 samples of the cycle. They miss a maximum by at most half the curvature times the square of half a step.
    #[test]
    fn synthesis_equals_dense_sampling(parts in prop::collection::vec((-1.0..1.0f64, -1.0..1.0f64), 12), set in 0..5usize) {
        // all, with gaps, odd ones, one kind (multiples of four), and short waves
        let harmonics: Vec<u32> = match set {
            0 => (1..=12).collect(),
            1 => vec![1, 2, 3, 4, 6, 8, 9, 12, 13, 16, 20, 21],
            2 => (0..12).map(|k| 2 * k + 1).collect(),
            3 => (1..=12).map(|k| 4 * k).collect(),
            _ => vec![1, 2, 5, 10, 20, 40, 75, 120, 171, 206, 303, 400],
        };
        let phasors: Vec<C64> = parts.iter().map(|(a, b)| C64::new(*a, *b)).collect();
        let n = 20_000;
        let f = |j: usize| -> f64 { harmonics.iter().zip(&phasors).map(|(h, y)| (y * C64::cis(TAU * (j * *h as usize % n) as f64 / n as f64)).re).sum() };
        let (low, high) = (0..n).map(f).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        let curvature: f64 = harmonics.iter().zip(&phasors).map(|(h, y)| f64::from(h * h) * y.norm()).sum();
        let missed = 0.5 * curvature * (0.5 * TAU / n as f64).powi(2);
        let exact = Synthesiser::new(&harmonics).extremes(&phasors).half_peak_to_peak;
        prop_assert!(exact >= 0.5 * (high - low) - 1e-12 && exact <= 0.5 * (high - low) + missed + 1e-12, "{exact} against {}", 0.5 * (high - low));
    }
}

/// A singular matrix is refused, never answered with infinities.
#[test]
fn singular_tridiagonal_is_refused() {
    let mut t = Tridiagonal::zeros(3);
    t.diagonal = vec![C64::from(1.0), C64::from(0.0), C64::from(2.0)];
    assert!(t.factor().is_err());
}

/// Law: the analysis of a trigonometric polynomial returns its coefficients.
#[test]
fn harmonics_of_a_polynomial_are_its_coefficients() {
    let wanted = [(1u32, C64::new(0.3, -0.7)), (2, C64::new(-1.1, 0.2)), (7, C64::new(0.05, 0.4))];
    let samples: Vec<f64> =
        (0..64).map(|j| 5.0 + wanted.iter().map(|(h, c)| (c * C64::cis(TAU * f64::from(j * h) / 64.0)).re).sum::<f64>()).collect();
    let found = harmonics::analyse(&samples, &[0, 1, 2, 3, 7]);
    for (h, c) in [(0, C64::from(5.0)), (1, wanted[0].1), (2, wanted[1].1), (3, C64::default()), (4, wanted[2].1)] {
        assert_close((found[h] - c).norm(), 0.0, 0.0, 1e-14, "coefficient");
    }
}

/// Law: a single harmonic has its amplitude as half peak-to-peak, and a phase only moves it along.
#[test]
fn one_harmonic_is_its_amplitude() {
    let extremes = Synthesiser::new(&[3]).extremes(&[C64::from_polar(2.5, 1.0)]);
    assert_close(extremes.half_peak_to_peak, 2.5, 1e-15, 0.0, "amplitude");
    assert_close((3.0 * extremes.angle_max + 1.0).rem_euclid(TAU).min(1.0), 0.0, 0.0, 1e-12, "angle of the maximum");
}

/// Branches: with two maxima of nearly the same height the lower one is offered, and a sum with a shorter period offers none.
#[test]
fn pairs_are_other_waves_only() {
    let two = Synthesiser::new(&[1, 2]);
    let offered = two.pairs(&[C64::from(0.01), C64::from(1.0)], 0.05);
    assert_eq!(offered.len(), 2, "the maximum half a cycle on: {offered:?}");
    assert_eq!(offered[0], two.extremes(&[C64::from(0.01), C64::from(1.0)]));
    assert!(offered[1].half_peak_to_peak < offered[0].half_peak_to_peak);
    let repeated = Synthesiser::new(&[2, 4]).pairs(&[C64::from(1.0), C64::new(0.2, 0.1)], 0.5);
    let distinct: Vec<_> = repeated.iter().map(|e| e.half_peak_to_peak).collect();
    assert!(distinct.windows(2).all(|w| w[0] > w[1]), "the same wave half a cycle on is not offered: {distinct:?}");
}

/// Law: through n + 1 points of a polynomial of degree n lies that polynomial, with its lowest place.
#[test]
fn interpolation_of_a_quartic() {
    let f = |x: f64| (x - 3.2).powi(2) * (1.0 + 0.1 * (x - 1.0).powi(2));
    let mut through = Interpolation::new(3.0, 0.5);
    [3.0, 2.0, 4.0, 1.0, 5.0].into_iter().for_each(|x| through.push(x, f(x)));
    assert_close(through.lowest(3.0).expect("bends upwards"), 3.2, 1e-12, 0.0, "lowest place");
    assert_close(through.value(2.5), f(2.5), 1e-14, 0.0, "between the points");
    let mut falling = Interpolation::new(0.0, 1.0);
    [0.0, 1.0, -1.0].into_iter().for_each(|x| falling.push(x, -x * x));
    assert_eq!(falling.lowest(0.0), None, "a hill has no lowest place");
}

/// Law: a parabola's vertex is found; a maximum at a bracket's middle is never lost, searched to either side.
#[test]
fn maximum_of_a_parabola() {
    let f = |x: f64| Ok::<f64, ()>(3.0 - (x - 0.7).powi(2));
    let (at, value) = maximise::maximise(0.0, 2.0, f).expect("no error");
    assert_close(at, 0.7, 0.0, 1e-4, "vertex");
    assert_close(value, 3.0, 0.0, 1e-9, "value");
    for right in [true, false] {
        let spike = |x: f64| Ok::<f64, ()>(-(x - 1.0).abs() * 1e3);
        let (at, value) = maximise::maximise_bracket((0.0, 1.0, 2.0), right, &mut { spike }).expect("no error");
        assert_eq!((at, value), (1.0, 0.0), "the middle is the best point");
    }
    assert_eq!(maximise::maximise(0.0, 1.0, |_| Err::<f64, _>("no")), Err("no"), "errors come through");
}

/// Independent method: roots of the characteristic polynomial of one damped mass, s = -zeta w +- i w sqrt(1 - zeta²).
#[test]
fn quadratic_eigenvalues_of_one_mass() {
    let (m, k, zeta): (f64, f64, f64) = (2.0, 50.0, 0.1);
    let w = (k / m).sqrt();
    let c = DMatrix::from_element(1, 1, 2.0 * zeta * w * m);
    let mut s = eigen::quadratic(&DMatrix::from_element(1, 1, m), &c, &DMatrix::from_element(1, 1, k)).expect("finite");
    s.sort_by(|a, b| a.im.total_cmp(&b.im));
    assert_close(s[1].re, -zeta * w, 1e-12, 0.0, "decay");
    assert_close(s[1].im, w * (1.0 - zeta * zeta).sqrt(), 1e-12, 0.0, "frequency");
    // nothing but inertia has zero eigenvalues; what is not finite is refused
    let (one, zero) = (DMatrix::from_element(1, 1, 1.0), DMatrix::zeros(1, 1));
    assert_eq!(eigen::quadratic(&one, &zero, &zero), Some(vec![C64::default(); 2]));
    assert_eq!(eigen::quadratic(&one, &zero, &DMatrix::from_element(1, 1, f64::NAN)), None);
}

/// Law: elementary functions are those of the standard library to two roundings, over twelve decades and both signs; complex ones obey exp ln z = z, (z^a)^(1/a) = z near the positive axis and w² = z with Re w >= 0.
#[test]
fn elementary_functions() {
    let mut x = 1e-6;
    while x < 1e6 {
        for v in [x, -x] {
            let small: f64 = v / 1e6;
            let pairs = [
                (v.sine(), v.sin()),
                (v.cosine(), v.cos()),
                (v.sine_cosine().0, v.sin_cos().0),
                (v.sine_cosine().1, v.sin_cos().1),
                (small.tangent(), small.tan()),
                (small.arcsine(), small.asin()),
                (small.arccosine(), small.acos()),
                (v.arctangent(3.0), v.atan2(3.0)),
                ((v / 1e4).exponential(), (v / 1e4).exp()),
                (x.logarithm(), x.ln()),
                (x.decimal_logarithm(), x.log10()),
                (x.power(0.37), x.powf(0.37)),
                (x.power(-2.9), x.powf(-2.9)),
                ((v / 1e4).hyperbolic_sine(), (v / 1e4).sinh()),
                (v.area_hyperbolic_sine(), v.asinh()),
                (v.cube_root(), v.cbrt()),
                (v.hypotenuse(2.0), v.hypot(2.0)),
            ];
            for (i, (own, known)) in pairs.into_iter().enumerate() {
                assert!((own - known).abs() <= 4.0 * f64::EPSILON * known.abs(), "function {i} at {v}: {own:e} against {known:e}");
            }
        }
        x *= 1.37;
    }
    for (re, im) in [(2.0, 3.0), (2.0, -3.0), (-2.0, 3.0), (-2.0, -3.0), (0.0, 1e-9), (-4.0, 0.0), (5e-9, 2.0), (0.0, 0.0)] {
        let z = C64::new(re, im);
        let root = z.square_root();
        assert!((root * root - z).norm() <= 1e-15 * z.norm() && root.re >= 0.0, "{z}: {root}");
        if z.norm() > 0.0 {
            assert!((z.logarithm().exponential() - z).norm() <= 4e-15 * z.norm(), "{z}");
            assert!((z.power(0.5) - root).norm() <= 4e-15 * root.norm(), "{z}");
        }
    }
}

/// Law: exp of a rotation, of a nilpotent and of a diagonal matrix are known; exp A exp(-A) is one, with squaring, too.
#[test]
fn exponentials_of_matrices() {
    let turned = matrix_exponential(&DMatrix::from_row_slice(2, 2, &[0.0, -40.0, 40.0, 0.0]));
    let expected = DMatrix::from_row_slice(2, 2, &[40f64.cos(), -40f64.sin(), 40f64.sin(), 40f64.cos()]);
    assert!((turned - expected).amax() < 1e-12);
    let nilpotent = matrix_exponential(&DMatrix::from_row_slice(3, 3, &[0.0, 2.0, 3.0, 0.0, 0.0, 5.0, 0.0, 0.0, 0.0]));
    assert!((nilpotent - DMatrix::from_row_slice(3, 3, &[1.0, 2.0, 8.0, 0.0, 1.0, 5.0, 0.0, 0.0, 1.0])).amax() < 1e-14);
    let diagonal = matrix_exponential(&DMatrix::from_diagonal(&DVector::from_row_slice(&[-700.0, 0.1, 3.0])));
    for (i, x) in [-700.0f64, 0.1, 3.0].into_iter().enumerate() {
        assert!((diagonal[(i, i)] / x.exp() - 1.0).abs() < 1e-12, "{x}");
    }
    let a = DMatrix::from_fn(6, 6, |i, j| ((3 * i + 5 * j) % 7) as f64 - 3.0);
    assert!((matrix_exponential(&a) * matrix_exponential(&-&a) - DMatrix::identity(6, 6)).amax() < 1e-6);
}

/// Law: rounding by powers of ten says what the digits say. Over forty decades, and beside the middles of seven digits and the powers of ten. Tolerance: none, it is the same number.
#[test]
fn seven_digits_of_any_number() {
    for i in 0..60_000 {
        let x = (0.1 + f64::from(i) * 0.618_033_988_749_894_9) * 10f64.powi(i % 40 - 20) * if i % 3 == 0 { -1.0 } else { 1.0 };
        let middle = f64::from(1_000_000 + 149 * i) + 0.5;
        for x in [x, middle, middle * (1.0 + f64::EPSILON), middle * 1e-3, 9_999_999.499, 10f64.powi(i % 30 - 15)] {
            let by_digits: f64 = format!("{x:.6e}").parse().expect("a number");
            assert_eq!(seven_digits(x).to_bits(), by_digits.to_bits(), "{x:e}");
        }
    }
    for x in [0.0, -0.0, f64::INFINITY, 5e-324, f64::MAX] {
        let by_digits: f64 = format!("{x:.6e}").parse().expect("a number");
        assert_eq!(seven_digits(x).to_bits(), by_digits.to_bits(), "{x:e}");
    }
    assert!(seven_digits(f64::NAN).is_nan());
}

/// Law: between two samples of a polyline, walked evenly, no sample is farther off than was asked, nor than is said; ends stay, a straight curve needs no more, and a coordinate that does not change does not count.
#[test]
fn a_polyline_stays_near() {
    let n = 360;
    let curve = |f: fn(f64) -> f64| (0..n).map(|j| f(TAU * j as f64 / n as f64)).collect::<Vec<f64>>();
    let rows = [curve(|x| x.sin() + 0.3 * (5.0 * x).cos()), curve(|x| (-(x - 2.0).powi(2) / 0.02).exp()), vec![7.0; n]];
    let near = [0.01, 0.002, 0.0];
    let (chosen, off) = polyline(rows.each_ref().map(Vec::as_slice), near);
    assert_eq!((chosen[0], chosen[chosen.len() - 1]), (0, n - 1));
    assert!(chosen.windows(2).all(|p| p[0] < p[1]) && chosen.len() < n / 3, "{} of {n}", chosen.len());
    for pair in chosen.windows(2) {
        for j in pair[0]..=pair[1] {
            let share = (j - pair[0]) as f64 / (pair[1] - pair[0]) as f64;
            for d in 0..3 {
                let apart = (rows[d][j] - (rows[d][pair[0]] + (rows[d][pair[1]] - rows[d][pair[0]]) * share)).abs();
                assert!(apart <= off[d] + 1e-15 && off[d] <= near[d] + 1e-15, "sample {j}, coordinate {d}: {apart}, {}", off[d]);
            }
        }
    }
    let straight: Vec<f64> = (0..n).map(|j| 0.25 * j as f64).collect();
    assert_eq!(polyline([&straight], [1e-9]).0, [0, n - 1]);
    assert_eq!(polyline([&[3.0][..]], [0.1]).0, [0]);
}

/// Law: no point lies farther out along any direction than its ellipsoid says, whatever the points, on a line or all at the origin, too; round points of a circle it is the circle, to a thousandth.
#[test]
fn an_ellipsoid_holds_its_points() {
    let mut state = 3_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    for case in 0..40 {
        let spread = [1.0, 1e3, if case % 3 == 0 { 0.0 } else { 1e-4 }, 1.0];
        let mut rows: [Vec<f64>; 4] = Default::default();
        for _ in 0..if case % 7 == 0 { 1 } else { 60 } {
            let common = random();
            for (d, row) in rows.iter_mut().enumerate() {
                row.push(spread[d] * if case % 2 == 0 { common } else { random() });
            }
        }
        let a = ellipsoid(rows.each_ref().map(Vec::as_slice));
        for _ in 0..50 {
            let direction: [f64; 4] = std::array::from_fn(|d| if spread[d] > 0.0 { random() / spread[d] } else { random() });
            let square: f64 = (0..4).map(|i| (0..4).map(|j| direction[i] * a[i][j] * direction[j]).sum::<f64>()).sum();
            let out = (0..rows[0].len()).map(|j| (0..4).map(|d| direction[d] * rows[d][j]).sum::<f64>().abs()).fold(0.0, f64::max);
            assert!(out <= square.max(0.0).sqrt() * (1.0 + 1e-6) + 1e-12, "case {case}: {out} {square}");
        }
    }
    assert_eq!(ellipsoid([&[0.0][..], &[0.0][..]]), [[0.0; 2]; 2]);
    let circle = |f: fn(f64) -> f64| (0..48).map(|j| 3.0 * f(TAU * f64::from(j) / 48.0)).collect::<Vec<f64>>();
    let a = ellipsoid([&circle(f64::cos), &circle(f64::sin)]);
    assert_close(a[0][0], 9.0, 1e-3, 0.0, "the square of the radius");
    assert_close(a[1][1], 9.0, 1e-3, 0.0, "the square of the radius");
    assert!(a[0][1].abs() < 1e-6, "{a:?}");
}
