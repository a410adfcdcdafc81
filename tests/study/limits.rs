//! Limits on Den Hartog's problem, damped and undamped, against a brute-force search over stiffness and damping by formulas of two masses.

use crate::support::{assert_close, golden, h_infinity_peak, scanned, study};
use hartog::absorber::{TUNED, VISCOUS};
use hartog::analysis::{self, OptimumResult, Silent};
use hartog::drivetrain::Modes;
use hartog::input::{CombinedSpec, FrontSpec, LimitSpec, MeasureSpec, Size, Study};
use hartog::numerics::C64;
use hartog::objective::{Condition, Measure, Over, Property};
use hartog::response::Quantity;
use std::sync::LazyLock;

/// Static twist of the study, rad.
const STATIC: f64 = 1e-4;
const OMEGA: f64 = 100.0;

/// Two masses: an inertia of 1 kg m² on 1e4 N m/rad with a damping ratio, and a ring on it, under 1 N m.
#[derive(Clone, Copy, Debug)]
pub struct TwoMasses {
    pub damping_ratio: f64,
    pub ring: f64,
}

/// What is looked at of them.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum What {
    Twist,
    RingTwist,
    Power,
    LossFactor,
    RingInertia,
}

impl TwoMasses {
    fn at(self, k: f64, c: f64, what: What, omega: f64) -> f64 {
        let j = C64::new(0.0, 1.0);
        let s = C64::from(k) + j * omega * c;
        let ring = C64::from(-self.ring * omega * omega);
        let own = C64::from(1e4 - omega * omega) + j * omega * (2.0 * self.damping_ratio * OMEGA);
        let theta = C64::from(1.0) / (own + s * ring / (s + ring));
        let twist = -ring / (s + ring) * theta;
        match what {
            // `norm` guards against overflow, which costs more than all the rest
            What::Twist => theta.norm_sqr().sqrt(),
            What::RingTwist => twist.norm_sqr().sqrt(),
            What::Power => 0.5 * c * omega * omega * twist.norm_sqr(),
            What::LossFactor => c / (k * self.ring).sqrt(),
            What::RingInertia => self.ring,
        }
    }

    /// The largest value over the speeds of the study.
    pub fn peak(self, (k, c): (f64, f64), what: What) -> f64 {
        if what == What::LossFactor {
            return self.at(k, c, what, 1.0);
        }
        const N: usize = 150;
        static SPEEDS: LazyLock<Vec<f64>> = LazyLock::new(|| {
            let (low, high) = (100.0f64 * 2.0 * std::f64::consts::PI / 60.0, 2000.0 * 2.0 * std::f64::consts::PI / 60.0);
            (0..=N).map(|i| low * (high / low).powf(i as f64 / N as f64)).collect()
        });
        let (n, at) = (N, |i: usize| SPEEDS[i]);
        let values: Vec<f64> = (0..=n).map(|i| self.at(k, c, what, at(i))).collect();
        let mut largest = values[0].max(values[n]);
        for i in 1..n {
            if values[i] >= values[i - 1] && values[i] >= values[i + 1] && values[i] > 0.5 * largest {
                largest = largest.max(-golden(at(i - 1), at(i + 1), &|w| -self.at(k, c, what, w)).1);
            }
        }
        largest
    }

    /// Minimises a function of stiffness and damping by golden sections within golden sections, round a first guess.
    pub fn minimise(self, f: &dyn Fn((f64, f64)) -> f64) -> ((f64, f64), f64) {
        let mu = self.ring;
        let k0 = (mu * 1e4 / (1.0 + mu).powi(2)).ln();
        let c0 = (2.0 * mu * OMEGA * (3.0 * mu / (8.0 * (1.0 + mu).powi(3))).sqrt()).ln();
        let best_c = |k: f64| scanned(c0 - 2.5, c0 + 1.5, &|c| f((k.exp(), c.exp())));
        let (k, value) = scanned(k0 - 1.0, k0 + 1.0, &|k| best_c(k).1);
        ((k.exp(), best_c(k).0.exp()), value)
    }

    /// The least peak of something within limits, by an exact penalty.
    fn within(self, what: What, limits: &[(What, f64)]) -> f64 {
        let cost = |p: (f64, f64)| {
            let excess = limits.iter().map(|(l, most)| (self.peak(p, *l) / most).ln()).fold(0.0, f64::max);
            self.peak(p, what) * (1.0 + 30.0 * excess)
        };
        self.minimise(&cost).1
    }
}

pub fn measure(what: What) -> Measure {
    let ring = vec![Quantity::RingTwist(0)];
    match what {
        What::Twist => Measure::new(vec![Quantity::Twist { from: 0, to: None }], Over::Synthesis),
        What::RingTwist => Measure::new(ring, Over::Synthesis),
        What::Power => Measure::new(ring, Over::Power),
        What::LossFactor => Measure::new(ring, Over::Property(Property::LossFactor)),
        What::RingInertia => Measure::new(ring, Over::Property(Property::RingInertia)),
    }
}

/// Den Hartog's study with one ring, a damped primary, and limits.
pub fn limited(masses: TwoMasses, objective: What, limits: &[(What, f64)]) -> OptimumResult {
    analysis::run(&with(masses, objective, limits), &Silent).unwrap_or_else(|e| panic!("{e}")).optima.remove(0)
}

pub fn with(masses: TwoMasses, objective: What, limits: &[(What, f64)]) -> Study {
    let mut s: Study = study("den_hartog");
    s.chain.stations[0].damping_to_ground = 2.0 * masses.damping_ratio * OMEGA;
    s.modes = Modes::new(&s.chain);
    let o = s.optimise.as_mut().expect("optimises");
    (o.absorbers[0].types, o.absorbers[0].size) = (vec![&TUNED], Size::Each(vec![masses.ring]));
    s.front = None;
    s.designs.clear();
    s.objective.measure = measure(objective);
    let of = |what| MeasureSpec { measure: measure(what), ..s.objective.clone() };
    s.limits =
        limits.iter().map(|(what, limit)| LimitSpec { of: of(*what), words: format!("{what:?}"), limit: *limit, rule: None }).collect();
    s
}

/// Source: [Nishihara & Asami 2002] for the undamped primary, by which the brute-force search is judged, too; the search for damped ones. Mass ratios 0.01 to 1, damping
/// ratios 0 to 0.1, to 1e-8.
#[test]
fn damped_and_undamped_primaries_are_solved_exactly() {
    for ring in [0.01, 0.1, 1.0] {
        for damping_ratio in [0.0, 0.02, 0.1] {
            let masses = TwoMasses { damping_ratio, ring };
            let found = limited(masses, What::Twist, &[]).optimum.value();
            let expected = masses.within(What::Twist, &[]);
            if damping_ratio == 0.0 {
                assert_close(expected, STATIC * h_infinity_peak(ring), 1e-8, 0.0, "the search");
                assert_close(found, STATIC * h_infinity_peak(ring), 1e-8, 0.0, "the optimum");
            }
            assert_close(found, expected, 1e-8, 0.0, &format!("ring {ring}, damping ratio {damping_ratio}"));
        }
    }
}

/// Each limit alone, active: the least twist within it is that of the search to 1e-6, and its price is what a limit looser by 1e-5 brings.
#[test]
fn each_limit_alone() {
    for damping_ratio in [0.0, 0.05] {
        let masses = TwoMasses { damping_ratio, ring: 0.1 };
        let free = limited(masses, What::Twist, &[]);
        let (mounted, best) = (&free.optimum.design[0], free.optimum.value());
        let point = (mounted.absorber.stiffness().expect("k"), mounted.absorber.damping().expect("c"));
        for what in [What::LossFactor, What::RingTwist, What::Power] {
            // half way from what the free optimum has to the least there is; a loss factor may be as small as one likes
            let least = if what == What::LossFactor { 0.0 } else { masses.within(what, &[]) };
            let limit = 0.5 * (least + masses.peak(point, what));
            let found = limited(masses, What::Twist, &[(what, limit)]);
            assert!(
                found.conflict.is_none() && found.optimum.outcome.rows.excess() < 1e-8,
                "{what:?}: {:e}",
                found.optimum.outcome.rows.excess()
            );
            assert_close(found.design.limits[0], 1.0, 1e-8, 0.0, "active");
            let value = found.optimum.value();
            assert!(value > best);
            assert_close(value, masses.within(What::Twist, &[(what, limit)]), 1e-6, 0.0, &format!("{what:?}"));
            let looser = limited(masses, What::Twist, &[(what, 1.00001 * limit)]).optimum.value();
            assert_close(found.prices[0], 1e5 * (1.0 - looser / value), 0.02, 1e-4, &format!("price of {what:?}"));
            // loose limits change nothing and cost nothing
            let loose = limited(masses, What::Twist, &[(what, 2.0 * masses.peak(point, what))]);
            assert_close(loose.optimum.value(), best, 1e-9, 0.0, "loose");
            assert_eq!(loose.prices[0], 0.0);
        }
    }
}

/// Several objectives as one, the largest in units of their targets and the weighted sum: the least is that of a brute-force search, to 1e-7.
#[test]
fn combined_objectives() {
    let masses = TwoMasses { damping_ratio: 0.02, ring: 0.1 };
    let of = [What::Twist, What::RingTwist, What::Power];
    let targets = of.map(|what| 0.9 * masses.within(what, &[]));
    for weights in [vec![], vec![1.0, 0.3, 0.1], vec![1.0, 0.1, 0.3]] {
        let mut s = with(masses, What::Twist, &[]);
        let part = |(what, limit): (&What, f64)| LimitSpec {
            of: MeasureSpec { measure: measure(*what), ..s.objective.clone() },
            words: format!("{what:?}"),
            limit,
            rule: None,
        };
        s.combined =
            Some(CombinedSpec { parts: of.iter().zip(targets).map(part).collect(), weights: weights.clone(), spec: s.objective.clone() });
        let results = s.run().unwrap_or_else(|e| panic!("{e}"));
        let found = results.optima.iter().find(|o| o.design.name == "optimum_tuned_combined").expect("an optimum");
        let terms = |p: (f64, f64)| of.iter().zip(targets).map(move |(what, target)| masses.peak(p, *what) / target);
        let value = |p: (f64, f64)| match weights.as_slice() {
            [] => terms(p).fold(0.0, f64::max),
            weights => terms(p).zip(weights).map(|(v, w)| v * w).sum(),
        };
        let (_, expected) = masses.minimise(&value);
        assert_close(found.optimum.value(), expected, 1e-7, 0.0, &format!("weights {weights:?}"));
        let own = &found.optimum.design[0].absorber;
        assert_close(value((own.stiffness().expect("k"), own.damping().expect("c"))), expected, 1e-7, 0.0, "its own value");
    }
}

/// Two limits that cannot hold together: both are named, the least violation is that of the search, and loosening one as far as is said is what the search finds, too. One limit
/// that cannot hold by itself is named alone, with the exact optimum as the nearest.
#[test]
fn limits_in_conflict() {
    let masses = TwoMasses { damping_ratio: 0.02, ring: 0.1 };
    let least = masses.within(What::Twist, &[]);
    let alone = limited(masses, What::Twist, &[(What::Twist, 0.9 * least), (What::RingTwist, 1.0)]);
    let conflict = alone.conflict.expect("a conflict");
    assert_close(conflict.ratio, 1.0 / 0.9, 1e-7, 0.0, "nearest");
    assert_eq!(conflict.parties.iter().map(|p| p.limit).collect::<Vec<_>>(), [0]);
    assert_close(conflict.parties[0].loosened.expect("the other holds"), 1.0 / 0.9, 1e-7, 0.0, "loosened");

    // a twist that can be held, and a twist of the ring that can be held, but not both
    let twist = 1.02 * least;
    let (needed, possible) = (masses.within(What::RingTwist, &[(What::Twist, twist)]), masses.within(What::RingTwist, &[]));
    let ring_twist = 0.5 * (needed + possible);
    let limits = [(What::Twist, twist), (What::RingTwist, ring_twist), (What::LossFactor, 5.0)];
    let found = limited(masses, What::Twist, &limits);
    let conflict = found.conflict.expect("a conflict");
    let ratio = |p: (f64, f64)| (masses.peak(p, What::Twist) / twist).max(masses.peak(p, What::RingTwist) / ring_twist);
    assert_close(conflict.ratio, masses.minimise(&ratio).1, 1e-6, 0.0, "least violation");
    let mut parties: Vec<usize> = conflict.parties.iter().map(|p| p.limit).collect();
    parties.sort_unstable();
    assert_eq!(parties, [0, 1]);
    assert_close(conflict.parties.iter().map(|p| p.share).sum(), 1.0, 1e-6, 0.0, "shares");
    let of = |limit: usize| conflict.parties.iter().find(|p| p.limit == limit).and_then(|p| p.loosened).expect("holds then");
    assert_close(of(1), needed / ring_twist, 1e-6, 0.0, "ring twist loosened");
    assert_close(of(0), masses.within(What::Twist, &[(What::RingTwist, ring_twist)]) / twist, 1e-6, 0.0, "twist loosened");
    for ratio in &found.design.limits[..2] {
        assert_close(*ratio, conflict.ratio, 1e-6, 0.0, "the nearest design is shown");
    }
}

/// Where no family holds all limits, the one is shown that is least beyond the limit it is furthest beyond, not the one with the least twist.
#[test]
fn the_nearest_of_all_families_is_shown() {
    let masses = TwoMasses { damping_ratio: 0.02, ring: 0.1 };
    let least = masses.within(What::Twist, &[]);
    let possible = masses.within(What::RingTwist, &[]);
    let mut s = with(masses, What::Twist, &[(What::Twist, 0.98 * least), (What::RingTwist, 0.5 * possible)]);
    s.optimise.as_mut().expect("optimises").absorbers[0].types = vec![&TUNED, &VISCOUS];
    let results = analysis::run(&s, &Silent).expect("damped");
    let excess = |o: &OptimumResult| o.design.limits.iter().copied().fold(0.0, f64::max);
    let shown = results.best_optimum(false).expect("an optimum");
    assert_eq!(results.optima.len(), 2);
    assert!(results.optima.iter().all(|o| o.conflict.is_some() && excess(o) >= excess(shown)));
    let [a, b] = [&results.optima[0], &results.optima[1]];
    assert!((excess(a) - excess(b)).abs() > 1e-3, "the two differ");
}

/// Source: [Nishihara & Asami 2002]. The front of twist against a free ring inertia is the exact optimum of each ring, to 1e-6, between the bounds of the ring; the front of twist against the
/// loss factor that of the search. Neither has a dominated point, and each has one knee.
#[test]
fn fronts_of_two_masses() {
    let masses = TwoMasses { damping_ratio: 0.0, ring: 0.1 };
    let front = |size: Size, seconds: What| {
        let mut s = with(masses, What::Twist, &[]);
        s.optimise.as_mut().expect("optimises").absorbers[0].size = size;
        let of = |what| MeasureSpec { measure: measure(what), ..s.objective.clone() };
        s.front = Some(FrontSpec::Of { points: 20, measures: vec![of(What::Twist), of(seconds)] });
        let mut results = analysis::run(&s, &Silent).unwrap_or_else(|e| panic!("{e}"));
        let front = results.tradeoffs.remove(0).families.remove(0).1;
        assert!((18..=20).contains(&front.points.len()), "{}", front.points.len());
        assert!(front.points.iter().all(|p| !p.dominated) && front.points.iter().filter(|p| p.knee).count() == 1);
        front.points
    };
    let rings = front(Size::Between(0.01, 1.0), What::RingInertia);
    for p in &rings {
        assert_close(p.values[0], STATIC * h_infinity_peak(p.values[1]), 1e-6, 0.0, &format!("ring {}", p.values[1]));
    }
    assert_close(rings[0].values[1], 0.01, 1e-5, 0.0, "lightest");
    assert_close(rings[rings.len() - 1].values[1], 1.0, 1e-9, 0.0, "heaviest");
    // adaptive: the steep tenth near light rings has more than its share of points
    assert!(rings[5].values[1] < 0.2, "{}", rings[5].values[1]);
    let losses = front(Size::Each(vec![0.1]), What::LossFactor);
    // the search looks at dampers from a twelfth of Den Hartog's on
    for p in losses.iter().filter(|p| p.values[1] > 0.1).step_by(4) {
        assert_close(
            p.values[0],
            masses.within(What::Twist, &[(What::LossFactor, p.values[1])]),
            1e-6,
            0.0,
            &format!("loss {}", p.values[1]),
        );
    }
}

/// A study of limits with its first absorber only, of a ring of this size.
fn one_ring(name: &str, size: Size) -> Study {
    let mut s = study(name);
    let o = s.optimise.as_mut().expect("optimises");
    o.absorbers.truncate(1);
    o.absorbers[0].size = size;
    s.limits.retain(|l| !l.words.contains("absorber 2"));
    s
}

/// Equals itself: the table of the guide. Rubber that can be had costs 6 % of twist on the six and 60 % on the V10; heat decides on the V10.
#[test]
fn what_can_be_built() {
    for (name, ring, cool, rubber) in [("villalva_i6_limits", 0.076, 0.4593, 0.4593), ("villalva_v10_limits", 0.052, 0.4678, 0.4126)] {
        let mut s = one_ring(name, Size::Each(vec![ring]));
        s.front = None;
        for expected in [cool, rubber] {
            let results = analysis::run(&s, &Silent).unwrap_or_else(|e| panic!("{e}"));
            assert!(results.limits_hold() && results.optima[0].conflict.is_none());
            assert_close(results.optima[0].optimum.value().to_degrees(), expected, 2e-4, 0.0, name);
            assert!(results.optima[0].design.absorbers[0].absorber.value("loss_factor").expect("rubber") <= 0.25);
            s.limits.clear();
        }
    }
}

/// No global search at the second measure of a point finds less of the first, by 1e-6: fronts of both engines of one ring, within their limits.
#[test]
#[ignore = "about a minute"]
fn points_of_fronts_are_optima() {
    for (name, sizes) in [("villalva_i6_limits", (0.005, 0.076)), ("villalva_v10_limits", (0.0005, 0.052))] {
        let mut s = one_ring(name, Size::Between(sizes.0, sizes.1));
        let Some(FrontSpec::Of { measures, .. }) = s.front.clone() else { panic!("a front") };
        let front = analysis::run(&s, &Silent).unwrap_or_else(|e| panic!("{e}")).tradeoffs.remove(0).families.remove(0).1;
        s.front = None;
        assert!(front.points.len() > 10);
        for p in front.points.iter().step_by(3) {
            let mut at = s.clone();
            let limit = LimitSpec { of: measures[1].clone(), words: "ring".into(), limit: p.values[1] * (1.0 + 1e-9), rule: None };
            at.limits.push(limit);
            let found = analysis::run(&at, &Silent).unwrap_or_else(|e| panic!("{e}")).optima.remove(0);
            assert!(
                p.values[0] <= found.optimum.value() * (1.0 + 1e-6),
                "{name}, ring {}: {:?} against {}",
                p.values[1],
                p.values,
                found.optimum.value()
            );
            assert!(p.kkt_residual < 1e-5, "{name}, ring {}: {:e}", p.values[1], p.kkt_residual);
        }
    }
}

/// Law: what a family cannot change is no part of its front: a lost absorber is the same for all designs, and worse than each of them.
#[test]
fn fronts_in_conditions() {
    let mut s = one_ring("villalva_i6_limits", Size::Each(vec![0.076]));
    s.limits.clear();
    s.conditions = vec![Condition::AbsorberLost];
    let twist = s.objective.clone();
    let ring = MeasureSpec { measure: measure(What::RingTwist), key: "ring_twist", ..twist.clone() };
    s.front = Some(FrontSpec::Of { points: 6, measures: vec![twist, ring] });
    let values = |held: &[Condition]| {
        let mut s = s.clone();
        s.optimise.as_mut().expect("optimises").conditions = held.to_vec();
        let front = analysis::run(&s, &Silent).unwrap_or_else(|e| panic!("{e}")).tradeoffs.remove(0).families.remove(0).1;
        front.points.iter().map(|p| p.values).collect::<Vec<_>>()
    };
    let firing = values(&[Condition::Firing]);
    assert!(firing.len() >= 4);
    assert_eq!(firing, values(&[Condition::Firing, Condition::AbsorberLost]));
}
