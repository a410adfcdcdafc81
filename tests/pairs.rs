//! Two absorbers at once on Den Hartog's undamped mass, all parameters free: side by side, and one on the ring of the other.

use crate::support::assert_close;
use hartog::Study;
use hartog::absorber::Host;
use hartog::analysis::OptimumResult;
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// Inertias of the rings together, per that of the engine.
const SHARE: f64 = 0.1;
/// The mass, its spring, and the static twist of the shipped study.
const MASS: f64 = 1.0;
const SPRING: f64 = 1e4;

/// Rings that together weigh a tenth of the mass. Side by side the division is free between a fifth and four fifths for one of them, the other keeping the rest
/// of a fixed size; in series likewise.
fn text(first: f64, second: f64, on: &str) -> String {
    format!(
        r#"
engine = "engines/den_hartog.toml"
speed_rpm = {{ from = 100, to = 2000, step = 5 }}
order_limit = 1
objective = [{{ peak_twist = {{ from = "engine", to = "ground" }} }}]

[optimise]
random_starts = 8

[[optimise.absorber]]
name = "inner"
on.station = "engine"
types = ["tuned"]
size.ring_inertia_kg_m2.fixed = {first}

[[optimise.absorber]]
{on}
types = ["tuned"]
size.ring_inertia_kg_m2.fixed = {second}
"#
    )
}

fn optimum(first: f64, second: f64, on: &str) -> OptimumResult {
    let study = Study::from_toml(&text(first, second, on), "studies/pair.toml").unwrap_or_else(|e| panic!("{e}"));
    study.run().expect("damped").optima.swap_remove(0)
}

const PARALLEL: &str = r#"on.station = "engine""#;
const SERIES: &str = r#"on.ring = "inner""#;

/// Values of stiffness and damping, the inner ring first.
fn springs_and_dampers(o: &OptimumResult) -> [f64; 4] {
    let of = |i: usize| {
        let a = &o.optimum.design[i].absorber;
        [a.stiffness().expect("a spring"), a.damping().expect("a damper")]
    };
    [of(0)[0], of(0)[1], of(1)[0], of(1)[1]]
}

/// First-order conditions below 1e-8, reached from at least three starts: neither is better than one ring of the same inertia by less than 1 %.
fn certified(o: &OptimumResult) {
    assert!(o.optimum.outcome.kkt_residual < 1e-8, "KKT residual {:e}", o.optimum.outcome.kkt_residual);
    assert!(o.optimum.agreeing() >= 3, "{:?}", o.optimum.starts);
    assert!(o.optimum.value() < 0.99 * 1e-4 * crate::support::h_infinity_peak(SHARE), "{}", o.optimum.value());
}

/// Side by side, equal rings: two different absorbers, three level peaks.
#[test]
fn side_by_side() {
    let o = optimum(0.05, 0.05, PARALLEL);
    certified(&o);
    let [k1, _, k2, _] = springs_and_dampers(&o);
    assert!((k1 / k2 - 1.0).abs() > 0.1, "equal rings are tuned apart: {k1} {k2}");
    let best = o.optimum.value();
    let level = o.optimum.outcome.rows.rows.iter().filter(|r| r.value > best * (1.0 - 1e-7)).count();
    assert!(level >= 3, "{level} peaks are level");
}

/// In series: the inner damper vanishes at the optimum although nothing holds it there, and the pair beats two rings side by side.
#[test]
fn in_series() {
    let o = optimum(0.09, 0.01, SERIES);
    certified(&o);
    assert_eq!(o.optimum.design[1].on, Host::Ring(0));
    let [_, inner, _, outer] = springs_and_dampers(&o);
    assert!(inner == 0.0 && outer > 0.0, "inner damping {inner}, outer {outer}");
}

/// Amplitude per static twist at omega, by the two or three equations of motion: nothing of hartog is used.
fn amplitude(omega: f64, rings: [f64; 2], p: &[f64; 4], series: bool) -> f64 {
    type C = hartog::numerics::C64;
    let s = |k: f64, c: f64| C::new(k, omega * c);
    let (s1, s2, w2) = (s(p[0], p[1]), s(p[2], p[3]), omega * omega);
    let engine = C::from(SPRING - w2 * MASS);
    let z = if series {
        let outer = s2 * (-w2 * rings[1]) / (s2 - w2 * rings[1]);
        let moving = outer - w2 * rings[0];
        s1 * moving / (s1 + moving)
    } else {
        [(s1, rings[0]), (s2, rings[1])].iter().map(|(s, j)| s * (-w2 * j) / (s - w2 * j)).sum()
    };
    SPRING / (engine + z).norm()
}

/// Largest amplitude over the range of the study: a fine grid, then golden sections round its maxima.
fn peak(rings: [f64; 2], p: &[f64; 4], series: bool) -> f64 {
    const POINTS: usize = 600;
    let (from, to) = (30.0, 210.0);
    let at = |x: f64| amplitude(from + (to - from) * x / POINTS as f64, rings, p, series);
    let values: Vec<f64> = (0..=POINTS).map(|i| at(i as f64)).collect();
    let largest = values.iter().copied().fold(0.0, f64::max);
    let mut best = largest;
    for i in 1..POINTS {
        if values[i] >= values[i - 1] && values[i] >= values[i + 1] && values[i] > 0.9 * largest {
            let (mut a, mut b) = (i as f64 - 1.0, i as f64 + 1.0);
            for _ in 0..60 {
                let (x, y) = (b - 0.618_033_988_749_895 * (b - a), a + 0.618_033_988_749_895 * (b - a));
                if at(x) > at(y) { b = y } else { a = x }
            }
            best = best.max(at(0.5 * (a + b)));
        }
    }
    best
}

/// The peak of the optimum by those equations is the reported one (1e-9), and an evolution strategy on them, from starts of its own, finds nothing lower by more
/// than 3e-8.
#[test]
#[ignore = "two minutes"]
fn an_independent_search_finds_nothing_lower() {
    for (rings, on, series) in [([0.05, 0.05], PARALLEL, false), ([0.03, 0.07], PARALLEL, false), ([0.09, 0.01], SERIES, true)] {
        let o = optimum(rings[0], rings[1], on);
        let reported = o.optimum.value() / 1e-4;
        assert_close(peak(rings, &springs_and_dampers(&o), series), reported, 1e-9, 0.0, "the same design");
        let mut generator = Xoshiro256PlusPlus::seed_from_u64(31);
        let mut lowest = f64::INFINITY;
        for _ in 0..40 {
            lowest = lowest.min(evolve(rings, series, &mut generator));
        }
        println!("rings {rings:?} {on}: reported {reported:.10}, independent {lowest:.10}");
        assert!(lowest > reported * (1.0 - 3e-8), "{on}: {lowest} beats {reported}");
        assert!(lowest < reported * (1.0 + 1e-4), "{on}: the search that is to find fault found only {lowest}");
    }
}

/// One run of a (1+1) evolution strategy in the logarithms of the four parameters, with the success rule for its step; dampings may drop to zero.
fn evolve(rings: [f64; 2], series: bool, generator: &mut Xoshiro256PlusPlus) -> f64 {
    let mut x = [0.0; 4];
    for i in 0..2 {
        x[2 * i] = (rings[i] * SPRING / MASS).ln() + generator.random_range(-0.7..0.7);
        x[2 * i + 1] = (2.0 * rings[i] * 100.0 * 0.2).ln() + generator.random_range(-2.0..2.0);
    }
    let values = |x: &[f64; 4]| x.map(f64::exp).map(|v| if v < 1e-9 { 0.0 } else { v });
    let (mut value, mut step) = (peak(rings, &values(&x), series), 0.3);
    for _ in 0..6000 {
        let mut y = x;
        y.iter_mut().for_each(|y| *y += step * (0..6).map(|_| generator.random_range(-1.0..1.0)).sum::<f64>() / 1.4);
        let there = peak(rings, &values(&y), series);
        if there < value {
            (x, value) = (y, there);
            step *= 1.5;
        } else {
            step *= 0.904;
        }
        step = step.clamp(1e-10, 1.0);
    }
    value
}
