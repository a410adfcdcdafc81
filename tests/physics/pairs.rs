//! Two absorbers at once on Den Hartog's undamped mass, all parameters free: side by side, and one on the ring of the other.

use crate::support::{assert_close, golden};
use hartog::Study;
use hartog::absorber::Host;
use hartog::analysis::OptimumResult;
use hartog::numerics::C64;
use hartog::optimise::Verdict;
use nalgebra::{Cholesky, Matrix3, Matrix4, Vector3, Vector4};
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use rayon::prelude::*;

/// Inertias of the rings together, per that of the engine.
const SHARE: f64 = 0.1;
/// The mass, its spring, and the static twist of the shipped study.
const MASS: f64 = 1.0;
const SPRING: f64 = 1e4;

/// Two rings, every parameter of both free: stiffness and damping between hartog's own wide bounds, ring inertias between a tenth of the given ones and them.
fn text(largest: [f64; 2], on: &str) -> String {
    let size = largest.map(|j| format!("size.ring_inertia_kg_m2.between = [{}, {j}]", 0.1 * j));
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
{}

[[optimise.absorber]]
{on}
types = ["tuned"]
{}
"#,
        size[0], size[1]
    )
}

fn optimum(largest: [f64; 2], on: &str) -> OptimumResult {
    let study = Study::from_toml(&text(largest, on), "studies/pair.toml").unwrap_or_else(|e| panic!("{e}"));
    study.run().expect("damped").optima.swap_remove(0)
}

const PARALLEL: &str = r#"on.station = "engine""#;
const SERIES: &str = r#"on.ring = "inner""#;

fn rings(o: &OptimumResult) -> [f64; 2] {
    [0, 1].map(|i| o.optimum.design[i].absorber.ring_inertia())
}

/// Values of stiffness and damping, the inner ring first.
fn springs_and_dampers(o: &OptimumResult) -> [f64; 4] {
    let of = |i: usize| {
        let a = &o.optimum.design[i].absorber;
        [a.stiffness().expect("a spring"), a.damping().expect("a damper")]
    };
    [of(0)[0], of(0)[1], of(1)[0], of(1)[1]]
}

/// First-order conditions below 1e-8, reached from at least three starts; better by more than 1 % than one ring of the same inertia.
fn certified(o: &OptimumResult) {
    assert!(o.optimum.outcome.kkt_residual < 1e-8, "KKT residual {:e}", o.optimum.outcome.kkt_residual);
    assert!(o.optimum.agreeing() >= 3, "{:?}", o.optimum.starts);
    assert!(o.optimum.value() < 0.99 * 1e-4 * crate::support::h_infinity_peak(SHARE), "{}", o.optimum.value());
}

/// Side by side: two different absorbers, as heavy as they may be, three level peaks.
#[test]
fn side_by_side() {
    let o = optimum([0.05, 0.05], PARALLEL);
    certified(&o);
    rings(&o).into_iter().for_each(|j| assert_close(j, 0.05, 1e-12, 0.0, "the largest ring"));
    let [k1, _, k2, _] = springs_and_dampers(&o);
    assert!((k1 / k2 - 1.0).abs() > 0.1, "equal rings are tuned apart: {k1} {k2}");
    let best = o.optimum.value();
    let level = o.optimum.outcome.rows.rows.iter().filter(|r| r.value > best * (1.0 - 1e-7)).count();
    assert!(level >= 3, "{level} peaks are level");
}

/// In series, near the best division of the inertia: the inner damper vanishes although its bounds are wide, and the pair beats two rings side by side
/// [Asami 2017]. A lighter outer ring asks for an inner damper: nothing is assumed.
#[test]
fn in_series() {
    let o = optimum([0.08, 0.02], SERIES);
    certified(&o);
    assert_eq!(o.optimum.design[1].on, Host::Ring(0));
    let [_, inner, _, outer] = springs_and_dampers(&o);
    assert!(inner == 0.0 && outer > 0.0, "inner damping {inner}, outer {outer}");
    assert!(o.optimum.value() < 0.95 * optimum([0.05, 0.05], PARALLEL).optimum.value());
    let lighter = optimum([0.09, 0.01], SERIES);
    certified(&lighter);
    assert!(springs_and_dampers(&lighter)[1] > 0.5, "{:?}", springs_and_dampers(&lighter));
}

/// Law: of two given rings side by side no stiffnesses and dampings (or loss factors) within hartog's wide bounds are better than the optimum by more than the gap: proved, for light and heavy rings. By the dense equations no
/// random design is below the bound, anywhere within a factor of e^3 of the optimum or close to it.
#[test]
fn two_rings_are_proved() {
    for (kind, rings, gap, boxes) in [("tuned", 0.05, 1e-3, 6_000), ("tuned", 0.3, 1e-3, 3_000), ("rubber", 0.05, 1e-3, 6_000)] {
        let text = text([rings, rings], PARALLEL)
            .replace("\"tuned\"", &format!("{kind:?}"))
            .replace("random_starts = 8", &format!("random_starts = 8\nprove = {{ gap = {gap:e}, boxes = {boxes} }}"))
            .replace(&format!("between = [{}, {rings}]", 0.1 * rings), &format!("fixed = {rings}"));
        let study = Study::from_toml(&text, "studies/pair.toml").unwrap_or_else(|e| panic!("{e}"));
        let o = study.run().expect("damped").optima.swap_remove(0);
        let proof = o.proof.as_ref().expect("asked for");
        assert_eq!((&proof.verdict, proof.better), (&Verdict::Proved, 0), "{kind} {rings}: {proof:?}");
        let bound = proof.lower_bound.expect("proved");
        assert_close(bound, o.optimum.value() * (1.0 - gap), 1e-12, 0.0, "to the gap");
        assert!(proof.upper_bound.expect("proved from above") <= o.optimum.value() * (1.0 + gap * 1.001));
        let (dense, mut random) = (Dense { rings: [rings, rings], series: false }, Xoshiro256PlusPlus::seed_from_u64(1));
        let own = [0, 1].map(|i| o.optimum.design[i].absorber.law().expect("a ring").values());
        for _ in 0..300 {
            let size = 3.0 * 10f64.powf(random.random_range(-3.0..0.0));
            let mut moved = || [0, 1].map(|i| [1, 2].map(|k| own[i][k] * f64::exp(size * random.random_range(-1.0..1.0))));
            let [[k1, c1], [k2, c2]] = moved();
            let p = [k1, c1, k2, c2];
            let peak = if kind == "tuned" { dense.maxima(&p).into_iter().fold(0.0, f64::max) } else { dense.hysteretic(&p) };
            assert!(1e-4 * peak >= bound, "{kind} {rings}: {p:?} has {peak}");
        }
    }
}

/// Amplitudes of the engine per static twist over the range of the study, by a dense LU of the three equations of motion: nothing of hartog is used.
struct Dense {
    rings: [f64; 2],
    series: bool,
}

impl Dense {
    fn amplitude(&self, omega: f64, p: &[f64; 4]) -> f64 {
        self.with_springs(omega, C64::new(p[0], omega * p[1]), C64::new(p[2], omega * p[3]))
    }

    /// The largest amplitude at 2,000 frequencies with stiffnesses and loss factors.
    fn hysteretic(&self, p: &[f64; 4]) -> f64 {
        let at = |i: u32| self.with_springs(40.0 + 0.07 * f64::from(i), C64::new(p[0], p[0] * p[1]), C64::new(p[2], p[2] * p[3]));
        (0..2000).map(at).fold(0.0, f64::max)
    }

    fn with_springs(&self, omega: f64, inner: C64, outer: C64) -> f64 {
        let mut d = Matrix3::from_diagonal(&Vector3::new(MASS, self.rings[0], self.rings[1]).map(|j| C64::from(-omega * omega * j)));
        d[(0, 0)] += SPRING;
        for (a, b, s) in [(0, 1, inner), (if self.series { 1 } else { 0 }, 2, outer)] {
            d[(a, a)] += s;
            d[(b, b)] += s;
            d[(a, b)] -= s;
            d[(b, a)] -= s;
        }
        let x = d.lu().solve(&Vector3::new(C64::from(SPRING), C64::default(), C64::default()));
        x.map_or(f64::INFINITY, |x| x[0].norm())
    }

    /// Local maxima over the range above half the largest: a grid, then golden sections.
    fn maxima(&self, p: &[f64; 4]) -> Vec<f64> {
        const POINTS: usize = 240;
        let (from, to) = (40.0, 180.0);
        let at = |x: f64| self.amplitude(from + (to - from) * x / POINTS as f64, p);
        let values: Vec<f64> = (0..=POINTS).map(|i| at(i as f64)).collect();
        let largest = values.iter().copied().fold(0.0, f64::max);
        let mut list = vec![];
        for i in 1..POINTS {
            if values[i] >= values[i - 1] && values[i] >= values[i + 1] && values[i] > 0.5 * largest {
                let top = -golden(i as f64 - 1.0, i as f64 + 1.0, &|x| -at(x)).1;
                list.push(top.max(values[i]));
            }
        }
        if list.is_empty() { vec![largest] } else { list }
    }

    /// The maxima in the norm of this exponent: smooth, and the largest of them as it grows.
    fn norm(&self, p: &[f64; 4], exponent: f64) -> f64 {
        let maxima = self.maxima(p);
        let largest = maxima.iter().copied().fold(0.0, f64::max);
        largest * maxima.iter().map(|m| (m / largest).powf(exponent)).sum::<f64>().powf(1.0 / exponent)
    }
}

/// The peak of the optimum by those equations is the reported one (1e-9), and an evolution strategy on them, from starts of its own, finds nothing lower by more
/// than 3e-8; it comes within 1e-4, so that it would have.
#[test]
#[ignore = "three minutes"]
fn an_independent_search_finds_nothing_lower() {
    for (largest, on, series) in [([0.05, 0.05], PARALLEL, false), ([0.03, 0.07], PARALLEL, false), ([0.08, 0.02], SERIES, true)] {
        let o = optimum(largest, on);
        let (reported, dense) = (o.optimum.value() / 1e-4, Dense { rings: largest, series });
        let same = dense.maxima(&springs_and_dampers(&o)).into_iter().fold(0.0, f64::max);
        println!("rings {:?} of at most {largest:?}, {on}", rings(&o));
        assert_close(
            Dense { rings: rings(&o), series }.maxima(&springs_and_dampers(&o)).into_iter().fold(0.0, f64::max),
            reported,
            1e-9,
            0.0,
            "same design",
        );
        let starts = 0..24u64;
        let lowest = starts
            .into_par_iter()
            .map(|seed| evolve(&dense, &mut Xoshiro256PlusPlus::seed_from_u64(seed)))
            .reduce(|| f64::INFINITY, f64::min);
        println!("  reported {reported:.10}, independent {lowest:.10}, {same}");
        assert!(lowest > reported * (1.0 - 3e-8), "{on}: {lowest} beats {reported}");
        assert!(lowest < reported * (1.0 + 1e-4), "{on}: the search that is to find fault found only {lowest}");
    }
}

/// One run of a (1+1) evolution strategy in the logarithms of the four parameters, with the success rule for its step and a covariance learned from the
/// steps that succeed [Igel, Suttorp & Hansen 2006], on norms of growing exponent; dampings may drop to zero.
fn evolve(dense: &Dense, generator: &mut Xoshiro256PlusPlus) -> f64 {
    let mut x = Vector4::zeros();
    for i in 0..2 {
        x[2 * i] = (dense.rings[i] * SPRING / MASS).ln() + generator.random_range(-0.7..0.7);
        x[2 * i + 1] = (2.0 * dense.rings[i] * 100.0 * 0.2).ln() + generator.random_range(-2.0..2.0);
    }
    let values = |x: &Vector4<f64>| [x[0], x[1], x[2], x[3]].map(f64::exp).map(|v| if v < 1e-7 { 0.0 } else { v });
    let mut covariance = Matrix4::identity();
    for exponent in [20.0, 100.0, 500.0, 2.5e3, 1.2e4, 6e4, 3e5] {
        let (mut value, mut step, mut path) = (dense.norm(&values(&x), exponent), 0.1, Vector4::zeros());
        for _ in 0..1200 {
            // twelve uniform numbers make a normal one
            let z: Vector4<f64> = Vector4::from_fn(|_, _| (0..12).map(|_| generator.random_range(-0.5..0.5)).sum::<f64>());
            let Some(root) = Cholesky::new(covariance) else { break };
            let along = root.l() * z;
            let y = x + along * step;
            // beyond e^25 of anything there is no absorber
            let there = if y.amax() < 25.0 { dense.norm(&values(&y), exponent) } else { f64::INFINITY };
            if there <= value {
                (x, value) = (y, there);
                step *= (0.8f64 / 2.2).exp();
                path = path * 0.83 + along * (0.31f64).sqrt();
                covariance = covariance * 0.91 + path * path.transpose() * 0.09;
            } else {
                step *= (-0.2f64 / 2.2 * 0.9).exp();
            }
            if step < 1e-13 {
                break;
            }
        }
    }
    dense.maxima(&values(&x)).into_iter().fold(0.0, f64::max)
}
