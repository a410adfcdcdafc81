//! What is said of an optimum: second order, sensitivities, other local optima.

use crate::limits::{TwoMasses, What, limited, measure, with};
use crate::support::{assert_close, scanned, study};
use hartog::absorber::{Mounted, TUNED, VISCOUS};
use hartog::input::{CombinedSpec, FrontSpec, LimitSpec, MeasureSpec, Size};
use hartog::objective::Condition;

/// Law: with the damping held beside its optimum, the least peak over stiffness rises as half the curvature times the square of the way along the valley (coordinates are
/// logarithms); the valley by golden sections on formulas of two masses. Both peaks are level, so that one of two directions is free. To 2 %: third order over 2 % of damping.
#[test]
fn second_order_of_two_masses() {
    for (damping_ratio, ring) in [(0.0, 0.1), (0.05, 0.1), (0.02, 0.5)] {
        let masses = TwoMasses { damping_ratio, ring };
        let found = limited(masses, What::Twist, &[]);
        let second = found.second_order.expect("peaks keep their places");
        let own = &found.optimum.design[0].absorber;
        let (k, c) = (own.stiffness().expect("k"), own.damping().expect("c"));
        let best = masses.peak((k, c), What::Twist);
        let h: f64 = 0.02;
        let least = |c: f64| scanned(k.ln() - 0.1, k.ln() + 0.1, &|k| masses.peak((k.exp(), c), What::Twist));
        let (up, down) = (least(c * h.exp()), least(c * (-h).exp()));
        let rise = (up.1 + down.1 - 2.0 * best) / (h * h * best);
        let slope = (up.0 - down.0) / (2.0 * h);
        assert_eq!(second.free, 1);
        let expected = rise / (1.0 + slope * slope);
        assert_close(second.curvature.expect("one free direction"), expected, 0.02, 0.0, &format!("ring {ring}"));
    }
}

/// A primary mass without damping resonates without limit where the absorber has none: such designs are counted by the search that met them, which goes on; with a damped primary mass every design has a
/// finite response.
#[test]
fn designs_without_finite_response_are_counted() {
    let unbounded = |damping_ratio: f64| {
        let masses = TwoMasses { damping_ratio, ring: 0.1 };
        let mut study = with(masses, What::Twist, &[]);
        study.optimise.as_mut().expect("optimises").absorbers[0].types = vec![&VISCOUS];
        let found = study.run().unwrap_or_else(|e| panic!("{e}")).optima.remove(0);
        let c = found.optimum.design[0].absorber.damping().expect("c");
        assert_close(found.optimum.value(), masses.peak((0.0, c), What::Twist), 1e-9, 0.0, "the peak");
        let s = &found.optimum.stages;
        [s.seeds, s.search, s.minimax].iter().map(|w| w.unbounded_evaluations).sum::<u64>()
    };
    assert!(unbounded(0.0) > 0);
    assert_eq!(unbounded(0.02), 0);
}

/// Law: a ring without spring has one peak at its optimum, a minimum of its own: the curvature is the second difference of the peak over the logarithm of the damping, by formulas.
#[test]
fn second_order_of_a_single_peak() {
    let masses = TwoMasses { damping_ratio: 0.02, ring: 0.1 };
    let mut study = with(masses, What::Twist, &[]);
    study.optimise.as_mut().expect("optimises").absorbers[0].types = vec![&VISCOUS];
    let found = study.run().unwrap_or_else(|e| panic!("{e}")).optima.remove(0);
    let c = found.optimum.design[0].absorber.damping().expect("c");
    let (at, h) = (|share: f64| masses.peak((0.0, c * share.exp()), What::Twist), 1e-3);
    let second = found.second_order.expect("a smooth peak");
    assert_eq!(second.free, 1);
    let difference = (at(h) + at(-h) - 2.0 * at(0.0)) / (h * h * at(0.0));
    assert_close(second.curvature.expect("one free direction"), difference, 1e-3, 0.0, "curvature");

    // a sum of such peaks is as smooth: each has a bound of its own, which holds nothing back
    let weights = [1.0, 0.5];
    let of = [What::Twist, What::RingTwist];
    let part = |what: &What| LimitSpec {
        of: MeasureSpec { measure: measure(*what), ..study.objective.clone() },
        words: format!("{what:?}"),
        limit: masses.peak((0.0, c), *what),
        rule: None,
    };
    let parts: Vec<LimitSpec> = of.iter().map(part).collect();
    let targets: Vec<f64> = parts.iter().map(|p| p.limit).collect();
    study.combined = Some(CombinedSpec { parts, weights: weights.to_vec(), spec: study.objective.clone() });
    let results = study.run().unwrap_or_else(|e| panic!("{e}"));
    let found = results.optima.iter().find(|o| o.design.name.ends_with("combined")).expect("a combined optimum");
    let c = found.optimum.design[0].absorber.damping().expect("c");
    let at = |share: f64| -> f64 { (0..2).map(|i| weights[i] * masses.peak((0.0, c * share.exp()), of[i]) / targets[i]).sum() };
    let second = found.second_order.expect("smooth peaks");
    assert_eq!(second.free, 1);
    let difference = (at(h) + at(-h) - 2.0 * at(0.0)) / (h * h * at(0.0));
    assert_close(second.curvature.expect("one free direction"), difference, 1e-3, 0.0, "curvature of the sum");
}

/// Two alike rings on one station may change places: of starts that differ by that only, one is made, since the other takes the same steps to the same design. A limit on one of them tells them apart.
#[test]
fn starts_of_alike_rings() {
    let starts = |limited: bool| -> Vec<String> {
        let mut s = study("villalva_v10_limits");
        s.front = None;
        s.refine_peaks = false;
        s.limits.retain(|l| limited && l.words.contains("absorber 1"));
        let mut found = s.run().unwrap_or_else(|e| panic!("{e}")).optima;
        found.remove(0).optimum.starts.into_iter().map(|s| s.name).collect()
    };
    let (alike, apart) = (starts(false), starts(true));
    assert!(alike.iter().all(|name| apart.contains(name)));
    let mirrored: Vec<&str> = apart.iter().filter(|name| !alike.contains(name)).map(String::as_str).collect();
    let expected =
        ["1 and 1, the other way", "2 and 1", "3 and 1", "2 and 2, the other way"].map(|modes| format!("closed forms, modes {modes}"));
    assert_eq!(mirrored.len(), expected.len(), "{mirrored:?}");
    assert!(expected.iter().all(|name| mirrored.contains(&name.as_str())), "{mirrored:?}");
}

/// Law: sensitivities are one-sided differences by formulas of two masses, of twist (two level peaks: more and less are no opposites) and of a limited ring twist, which
/// holds up to the drift and no further. Differences over 1e-6 err by about that share.
#[test]
fn sensitivities_are_differences() {
    let masses = TwoMasses { damping_ratio: 0.02, ring: 0.1 };
    let free = limited(masses, What::Twist, &[]);
    let point = |o: &Mounted| (o.absorber.stiffness().expect("k"), o.absorber.damping().expect("c"));
    let most = 1.3 * masses.peak(point(&free.optimum.design[0]), What::RingTwist);
    let found = limited(masses, What::Twist, &[(What::RingTwist, most)]);
    let (k, c) = point(&found.optimum.design[0]);
    let moved = |parameter: usize, share: f64, what: What| {
        let values = [masses.ring, k, c];
        let at = |p: usize| values[p] * if p == parameter { 1.0 + share } else { 1.0 };
        TwoMasses { ring: at(0), ..masses }.peak((at(1), at(2)), what)
    };
    let mut seen = 0;
    for s in &found.sensitivities {
        let what = if s.limited { What::RingTwist } else { What::Twist };
        let (here, h) = (moved(0, 0.0, what), 1e-6);
        let [more, less] = [h, -h].map(|h| (moved(s.parameter, h, what) / here - 1.0) / h.abs());
        assert_close(s.more, more, 1e-4, 1e-5, &format!("{what:?} by more of parameter {}", s.parameter));
        assert_close(s.less, less, 1e-4, 1e-5, &format!("{what:?} by less of parameter {}", s.parameter));
        if s.limited {
            let within = |change: f64| moved(s.parameter, change, what) <= most * (1.0 + 2e-6);
            for (drift, sign) in [(s.drift.0, 1.0), (s.drift.1, -1.0)] {
                let last = drift.unwrap_or(0.5);
                assert!((0..=50).all(|i| within(sign * last * f64::from(i) / 50.0)), "parameter {}", s.parameter);
                assert!(drift.is_none_or(|d| !within(sign * (d * 1.001 + 1e-5))), "parameter {}: {drift:?}", s.parameter);
            }
        } else {
            assert!(s.drift == (None, None));
        }
        seen += 1;
    }
    assert_eq!(seen, 6, "two measures by ring inertia, stiffness and damping");
}

/// Law: another local optimum of the six (ring of a fifth) is higher than the best, and no design within half a per cent of it, nor beyond the bounds of the study, is lower than itself.
#[test]
fn other_local_optima_are_minima() {
    let mut s = study("villalva_i6");
    let o = s.optimise.as_mut().expect("optimises");
    (o.absorbers[0].types, o.absorbers[0].size) = (vec![&TUNED], Size::Each(vec![0.0152]));
    o.conditions = vec![Condition::Firing];
    (s.front, s.fatigue) = (None, None);
    s.more_objectives.clear();
    s.conditions.clear();
    let results = s.run().unwrap_or_else(|e| panic!("{e}"));
    let found = &results.optima[0];
    let other = found.optimum.others.first().expect("another optimum");
    assert!(other.value > found.optimum.value() * 1.1);
    let value = |k: f64, c: f64| {
        let mut mounted = other.design.clone();
        let values = mounted[0].absorber.law().expect("a law").values();
        mounted[0].absorber =
            hartog::absorber::Absorber::Ring((TUNED.build)(&[values[0], (values[1] * k).min(1e7), (values[2] * c).min(1e4)]));
        s.evaluate("other", mounted).expect("finite").objective.expect("an objective")
    };
    let here = value(1.0, 1.0);
    assert_close(here, other.value, 1e-9, 0.0, "its value");
    for (k, c) in [(1.005, 1.0), (0.995, 1.0), (1.0, 1.005), (1.0, 0.995), (1.003, 1.003), (0.997, 0.997), (1.003, 0.997), (0.997, 1.003)] {
        assert!(value(k, c) >= here * (1.0 - 1e-9), "{k}, {c}: {} against {here}", value(k, c));
    }
}

/// Law: a front that is followed by the minimax method is no higher anywhere than one by NSGA-II with four times its evaluations, which finds nothing below it.
#[test]
fn evolution_finds_nothing_below_a_front() {
    let mut s = study("villalva_i6_thesis");
    s.optimise.as_mut().expect("[optimise]").absorbers[0].types.truncate(1);
    s.more_objectives.clear();
    s.fatigue = None;
    s.front = Some(FrontSpec::OverInertia((0..6).map(|i| 0.01 * 1.5_f64.powi(i)).collect()));
    let found = hartog::benchmark::evolution::measure(&s).expect("damped");
    assert_eq!(found.len(), 1);
    for round in &found[0].rounds {
        assert!(round.below < 1e-7, "{found:?}");
        assert!(round.median > 0.0 && round.largest < 0.2, "{found:?}");
    }
    assert!(found[0].rounds[1].median < found[0].rounds[0].median, "{found:?}");
}
