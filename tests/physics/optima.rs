//! Optimisation: the exact optimum of Den Hartog's problem, first-order conditions, limits, bounds, the front.

use crate::support::{Kind, assert_close, h_infinity_peak, on, study, system};
use hartog::absorber::{Declaration, Host, Mounted, RUBBER, TUNED, UNDAMPED, VISCOUS};
use hartog::analysis::{self, Results, Silent};
use hartog::drivetrain::{Chain, Modes, Station};
use hartog::input::{DesignSpec, FrontSpec, LimitSpec, MeasureSpec, Size, Study, UnitOf};
use hartog::objective::{Measure, Over, PeakFinder};
use hartog::optimise::Variable;
use hartog::response::{Grid, Method, Quantity, Receptance, Work};
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

fn run(study: &Study) -> Results {
    analysis::run(study, &Silent).unwrap_or_else(|e| panic!("{e}"))
}

/// Leaves a study with one size and one type, and no front.
fn only(name: &str, declaration: &'static Declaration, size: Size) -> Study {
    let mut s = study(name);
    let o = s.optimise.as_mut().expect("optimises");
    (o.absorbers[0].types, o.absorbers[0].size) = (vec![declaration], size);
    // nothing here asks for a proof
    o.prove.effort.boxes = 0;
    s.front = None;
    s.more_objectives.clear();
    // none of these optima looks at the crank or at an engine with a fault
    s.fatigue = None;
    s.conditions.clear();
    s
}

/// Source: [Nishihara & Asami 2002], static twist 1e-4 rad. Optimum and front of the shipped study, mass ratios 0.01 to 1, within 1e-6; the
/// viscous front is (2 + mu)/mu [Villalva 2014] eq. (6.29).
#[test]
fn den_hartog_is_solved_exactly() {
    let results = run(&study("den_hartog"));
    assert_close(results.optima[0].optimum.value(), 1e-4 * h_infinity_peak(0.1), 1e-6, 0.0, "optimum");
    for front in &results.fronts {
        assert_eq!(front.front.points.len(), 25);
        for p in &front.front.points {
            let mu = p.design[0].absorber.ring_inertia();
            let exact = if front.declaration == &TUNED { h_infinity_peak(mu) } else { (2.0 + mu) / mu };
            assert_close(p.value, 1e-4 * exact, 1e-6, 0.0, &format!("{} at mu = {mu}", front.declaration.name));
        }
        let (first, last) = (&front.front.points[0].design[0].absorber, &front.front.points[24].design[0].absorber);
        assert_close(first.ring_inertia(), 0.01, 1e-12, 0.0, "first ratio");
        assert_close(last.ring_inertia(), 1.0, 1e-12, 0.0, "last ratio");
    }
}

/// A ring on rubber on Den Hartog's undamped mass: k = J w0²/(1 + mu)², eta = sqrt(mu (3 + mu)/2), largest amplitude sqrt(2 (1 + mu)/mu) static twists; the
/// amplitude to 1e-9, what is flat at the optimum to its root.
#[test]
fn rubber_on_an_undamped_mass_is_solved_exactly() {
    for mu in [0.05f64, 0.1, 0.5] {
        let results = run(&only("den_hartog", &RUBBER, Size::Each(vec![mu])));
        let optimum = &results.optima[0].optimum;
        assert_close(optimum.value(), 1e-4 * (2.0 * (1.0 + mu) / mu).sqrt(), 1e-9, 0.0, "amplitude");
        let value = |key: &str| optimum.design[0].absorber.value(key).expect("a parameter");
        assert_close(value("stiffness_n_m_per_rad"), mu * 1e4 / (1.0 + mu).powi(2), 1e-5, 0.0, "stiffness");
        assert_close(value("loss_factor"), (0.5 * mu * (3.0 + mu)).sqrt(), 1e-5, 0.0, "loss factor");
        // a search without closed forms to start from arrives too
        let random = optimum.starts.iter().filter(|s| s.name.starts_with("random"));
        assert!(random.clone().any(|s| s.finished <= optimum.value() * (1.0 + 1e-8)), "{:?}", optimum.starts);
    }
}

/// Every optimum of the in-line six meets the first-order conditions, its active peaks are level, it beats the published designs of its
/// type, and random starts reach it too.
#[test]
fn optima_of_the_six() {
    let mut s = study("villalva_i6_thesis");
    (s.front, s.fatigue) = (None, None);
    s.more_objectives.clear();
    s.conditions.clear();
    s.optimise.as_mut().expect("optimises").prove.effort.boxes = 0;
    let results = run(&s);
    assert_eq!(results.optima.len(), 8);
    for o in &results.optima {
        let (name, out) = (&o.design.name, &o.optimum.outcome);
        assert!(out.kkt_residual < 1e-5, "{name}: {:e}", out.kkt_residual);
        let best = o.optimum.value();
        let random = o.optimum.starts.iter().filter(|s| s.name.starts_with("random") && s.finished <= best * (1.0 + 1e-6)).count();
        assert!(random > 0, "{name}: no random start arrives");
        assert_close(o.design.objective.expect("excited"), best, 1e-9, 0.0, "reported again");
    }
    let value = |name: &str| {
        results
            .designs
            .iter()
            .chain(results.optima.iter().map(|o| &o.design))
            .find(|d| d.name == name)
            .and_then(|d| d.objective)
            .expect(name)
    };
    assert!(value("optimum_tuned") < value("tuned_optimal") && value("optimum_tuned") < value("tuned_unity"));
    assert!(value("optimum_viscous") < value("viscous_untuned"));
    assert!(value("optimum_tuned") < value("optimum_viscous"), "a spring more can only help");
    assert!(results.forced_floor.expect("a twist") < value("optimum_tuned"));
}

/// Law: the optimum over a free ring inertia is the lowest point of the front over its range.
#[test]
fn free_ring_inertia_finds_the_lowest_point_of_the_front() {
    let (a, b) = (0.02, 0.152);
    let coarse = |size| {
        let mut s = only("villalva_i6_thesis", &TUNED, size);
        s.speeds_rpm = s.speeds_rpm.iter().copied().step_by(8).collect();
        s.order_limit = 6.0;
        s
    };
    let free = run(&coarse(Size::Between(a, b)));
    let mut s = coarse(Size::Each(vec![a]));
    s.front = Some(FrontSpec::OverInertia((0..24).map(|i| a * (b / a).powf(f64::from(i) / 23.0)).collect()));
    let front = run(&s);
    let lowest = front.fronts[0].front.points.iter().map(|p| p.value).fold(f64::INFINITY, f64::min);
    let best = free.optima[0].optimum.value();
    assert!(best <= lowest * (1.0 + 1e-9), "{best} against {lowest}");
    assert_close(best, lowest, 5e-3, 0.0, "24 points come close");
}

/// Stiffness and damping may reach zero: tuned to one speed the best ring has no damper at all, exactly; and zero is a point of the
/// coordinates like any other, so that a tuned ring may become a viscous one.
#[test]
fn damping_reaches_zero() {
    let mut s = only("den_hartog", &TUNED, Size::Each(vec![0.1]));
    s.designs.clear();
    s.speeds_rpm = vec![954.0, 955.0, 956.0];
    let one_speed = run(&s);
    assert_eq!(one_speed.optima[0].optimum.design[0].absorber.damping(), Some(0.0), "no damper");
    // an undamped ring leaves |f² - x²|/mu static twists near its frequency: 0.001 x 2/0.1 at the ends of this range
    assert!(one_speed.optima[0].optimum.value() < 0.025 * 1e-4, "the hub all but stands still");
    let stiffness = Variable { absorber: 0, parameter: 1, lower: 0.0, upper: 1e7, scale: 10.0 };
    assert_eq!((stiffness.coordinate(0.0), stiffness.value(0.0)), (0.0, 0.0));
    assert_close(stiffness.value(stiffness.coordinate(3e4)), 3e4, 1e-12, 0.0, "there and back");
}

/// Degenerate families are answered: nothing free to vary; no elastic mode and no random start; a ring on a node of the only excited mode.
#[test]
fn degenerate_families_are_answered() {
    let mut s = only("den_hartog", &TUNED, Size::Each(vec![0.1]));
    let absorber = &mut s.optimise.as_mut().expect("optimises").absorbers[0];
    absorber.bounds = vec![("stiffness_n_m_per_rad", (826.0, 826.0)), ("damping_n_m_s_per_rad", (3.4, 3.4))];
    let held = run(&s);
    assert_eq!(held.optima[0].optimum.design[0].absorber.stiffness(), Some(826.0));
    let mut rigid = only("den_hartog", &VISCOUS, Size::Each(vec![0.1]));
    rigid.chain.stations[0].stiffness_to_ground = 0.0;
    rigid.modes = Modes::new(&rigid.chain);
    rigid.optimise.as_mut().expect("optimises").random_starts = 0;
    rigid.designs.clear();
    let freed = run(&rigid);
    assert!(freed.optima[0].design.frequencies_hz.is_empty() && freed.optima[0].optimum.value().is_finite());
}

/// The optimiser finds no gap between grid speeds to hide a peak in: three equal stations, the ring on the node of mode 1, step 5 rpm. The
/// reported optimum is the same design's peak on a grid of 0.1 rpm.
#[test]
fn no_peak_hides_between_grid_speeds() {
    let mut s = only("den_hartog", &TUNED, Size::Each(vec![0.3]));
    s.designs.clear();
    let station = |i: usize| Station {
        name: format!("s{i}"),
        inertia: 1.0,
        stiffness_to_next: if i < 2 { 1e4 } else { 0.0 },
        damping_to_ground: 1.0,
        throws: if i == 0 { vec![0] } else { vec![] },
        ..Station::default()
    };
    s.chain = Chain { stations: (0..3).map(station).collect() };
    s.modes = Modes::new(&s.chain);
    s.optimise.as_mut().expect("optimises").absorbers[0].on = Host::Station(1);
    (s.hub, s.twist) = (1, Quantity::Twist { from: 0, to: Some(2) });
    s.objective.measure.quantities = vec![s.twist];
    let coarse = run(&s);
    let design = coarse.optima[0].optimum.design.clone();
    s.speeds_rpm = (0..=19_000).map(|i| 100.0 + 0.1 * f64::from(i)).collect();
    s.optimise = None;
    s.designs = vec![DesignSpec { name: "same".into(), absorbers: design }];
    let fine = run(&s);
    assert_close(coarse.optima[0].optimum.value(), fine.designs[0].objective.expect("excited"), 1e-6, 0.0, "peak");
}

/// A limit that binds is met exactly and costs objective; one that cannot be met is reported as failing.
#[test]
fn limits_bind() {
    let mut s = only("villalva_i6_thesis", &TUNED, Size::Each(vec![0.076]));
    s.speeds_rpm = s.speeds_rpm.iter().copied().step_by(8).collect();
    (s.order_limit, s.refine_peaks) = (6.0, false);
    let free = run(&s);
    let torque = Measure::new((0..7).map(Quantity::ShaftTorque).collect(), Over::Synthesis);
    let unlimited = free.optima[0].design.torque.expect("shafts").value;
    let of = MeasureSpec { measure: torque, unit: UnitOf::Torque, ..s.objective.clone() };
    let limit = |limit| LimitSpec { of: of.clone(), words: "torque".into(), limit, rule: None };
    s.limits = vec![limit(0.97 * unlimited)];
    let limited = run(&s);
    assert!(limited.limits_hold());
    let design = &limited.optima[0].design;
    assert_close(design.limits[0], 1.0, 1e-6, 0.0, "the limit is active");
    assert!(limited.optima[0].optimum.value() > free.optima[0].optimum.value());
    assert!(limited.optima[0].optimum.outcome.kkt_residual < 1e-4);
    s.limits = vec![limit(100.0)];
    assert!(!run(&s).limits_hold());
}

/// The other objectives run through the same machinery: largest order, hub amplitude, vibratory torque.
#[test]
fn other_objectives_have_stationary_optima() {
    let measures = [
        Measure::new(vec![Quantity::Twist { from: 0, to: Some(7) }], Over::Orders),
        Measure::new((0..7).map(Quantity::ShaftTorque).collect(), Over::Synthesis),
    ];
    for measure in measures {
        let mut s = only("villalva_i6_thesis", &TUNED, Size::Each(vec![0.03]));
        s.objective.measure = measure.clone();
        s.speeds_rpm = s.speeds_rpm.iter().copied().step_by(4).collect();
        let o = &run(&s).optima[0];
        assert!(o.optimum.outcome.kkt_residual < 1e-5, "{measure:?}: {:e} {:?}", o.optimum.outcome.kkt_residual, o.optimum.outcome.stop);
        assert!(o.optimum.agreeing() >= 2, "{measure:?}: {:?}", o.optimum.starts);
    }
}

/// An undamped ring on the damped six is an optimum of its own, worse than a damped one.
#[test]
fn undamped_optimum_is_worse_than_tuned() {
    let optimum = |declaration| {
        let mut s = only("villalva_i6_thesis", declaration, Size::Each(vec![0.0152]));
        (s.speeds_rpm, s.order_limit) = (s.speeds_rpm.iter().copied().step_by(8).collect(), 6.0);
        run(&s)
    };
    let (undamped, tuned) = (optimum(&UNDAMPED), optimum(&TUNED));
    assert!(tuned.optima[0].optimum.value() < undamped.optima[0].optimum.value());
    assert!(undamped.optima[0].optimum.outcome.kkt_residual < 1e-4);
}

/// A chain of many stations with inertias and stiffnesses over six decades, and throws somewhere.
fn long_chain(random: &mut Xoshiro256PlusPlus, count: usize) -> Study {
    let mut s = only("villalva_i6_thesis", &TUNED, Size::Each(vec![0.05]));
    s.designs.clear();
    let mut decades = |middle: f64| middle * 10f64.powf(random.random_range(-3.0..3.0));
    let mut stations: Vec<Station> = (0..count)
        .map(|i| Station {
            name: format!("s{i}"),
            inertia: decades(0.05),
            stiffness_to_next: if i + 1 < count { decades(1e6) } else { 0.0 },
            damping_to_ground: 0.1 * decades(0.1),
            ..Station::default()
        })
        .collect();
    let first = random.random_range(1..count - 7);
    (0..6).for_each(|t| stations[first + t].throws = vec![t]);
    s.chain = Chain { stations };
    s.modes = Modes::new(&s.chain);
    s.twist = Quantity::Twist { from: 0, to: Some(count - 1) };
    s.objective.measure = Measure::new(vec![s.twist], Over::Synthesis);
    s.hub = 0;
    s
}

/// Measured on long chains with inertias and stiffnesses over six decades: closed forms of the first modes and random points may all miss the tuned ring that is best (in the 17th of these chains the
/// starts ended 19 % above, at a locked ring). Designs elsewhere find it, and no design of a scan of 350 (in the usual test of every third) is lower. What is left if nothing resonates is no more than what the chain does without
/// absorber: soft links do not follow the torque as if static.
fn long_chains(which: impl Fn(usize) -> bool, stride: usize) {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(46);
    let mut better = 0;
    for i in 0..24 {
        let mut s = long_chain(&mut random, 46);
        (s.speeds_rpm, s.order_limit) = (s.speeds_rpm.iter().copied().step_by(8).collect(), 6.0);
        if !which(i) {
            continue;
        }
        let results = run(&s);
        let best = results.optima[0].optimum.value();
        better += usize::from(results.optima[0].scan.better);
        let sys = system(&s);
        let grid = Grid::new(&s.speeds_rpm, &sys.excitation.tabulated_rpm);
        let method = Method::Receptance(Receptance::new(&sys, &grid, 0, &[s.twist]));
        let finder = PeakFinder::new(&sys, &grid, &method, true);
        let value = |design: &[Mounted]| finder.peak(design, &s.objective.measure, &mut Work::default());
        for (a, b) in (0..35).flat_map(|a| (0..10).map(move |b| (a, b))).step_by(stride) {
            let omega = 10.0 * 2000f64.powf(f64::from(a) / 34.0);
            let damping = 2.0 * 0.05 * omega * 10f64.powf(-2.5 + f64::from(b) / 3.0);
            let peak = value(&[on(0, Kind::Tuned, 0.05, 0.05 * omega * omega, damping)]);
            // a ring that does nothing is no worse than another one
            assert!(peak.map_or(f64::INFINITY, |p| p.map_or(0.0, |p| p.value)) >= best * (1.0 - 1e-6), "chain {i} at {omega} rad/s");
        }
        let none = value(&[]).expect("damped").expect("excited").value;
        assert!(results.forced_floor.expect("a twist") < 1.2 * none, "chain {i}: {:?} against {none}", results.forced_floor);
    }
    assert!(better > 0);
}

#[test]
fn a_long_chain() {
    long_chains(|i| i == 16, 30);
}

#[test]
#[ignore = "about four minutes"]
fn long_chains_of_all_kinds() {
    long_chains(|_| true, 1);
}
