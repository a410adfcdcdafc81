//! Misfire, absorber locked, absorber lost: against theory, limits, and an independent sum in time.

use crate::support::{Kind, assert_close, on, study, system, three_values};
use hartog::absorber::{Absorber, Mounted, TUNED};
use hartog::analysis::families::Choice;
use hartog::analysis::{self, Silent};
use hartog::drivetrain::{System, natural};
use hartog::engine::forces::gas_torque;
use hartog::engine::pressure::{sample_angle, samples};
use hartog::engine::{Excitation, Source};
use hartog::input::{Size, Study};
use hartog::numerics::{C64, harmonics};
use hartog::objective::{Condition, Measure, Over, PeakFinder};
use hartog::optimise::{LoadCase, Problem, Row};
use hartog::response::{Direct, Grid, Method, Quantity, Receptance, Response, Work};
use hartog::units::RAD_PER_S_PER_RPM;
use std::path::Path;

fn misfiring(study: &Study, cylinder: usize) -> Excitation {
    let e = Excitation::new(&study.engine, study.order_limit);
    let change = e.motored_change(&study.engine).expect("a cylinder");
    e.misfiring(&study.engine, cylinder, &change)
}

fn unequal(study: &Study, scatter: &[f64]) -> Excitation {
    let e = Excitation::new(&study.engine, study.order_limit);
    let change = e.motored_change(&study.engine).expect("a cylinder");
    e.unequal(&study.engine, scatter, &change)
}

/// Independent: the torque of every throw summed in time from its cylinders, each motored plus a share of what burning adds (none: it misfires),
/// has the order amplitudes of the excitation. Firing angles are multiples of the sampling, so the sum is exact.
#[test]
fn a_misfire_is_a_motored_cylinder_and_others_burn_unequally() {
    for name in ["villalva_i6_thesis", "villalva_v10_thesis"] {
        let s = study(name);
        let Source::Cylinder { geometry, pressure } = &s.engine.source else { panic!("a cylinder") };
        let (n, cylinders) = (samples(4), s.engine.layout.firing_deg.len());
        let (index, cylinder) = (1, 3);
        let one_misfires: Vec<f64> = (0..cylinders).map(|c| if c == cylinder { -1.0 } else { 0.0 }).collect();
        let scattered: Vec<f64> = (0..cylinders).map(|c| 0.07 * (1.0 + 3.0 * c as f64).sin()).collect();
        let speed = pressure.speeds_rpm()[index];
        let omega2 = (speed * RAD_PER_S_PER_RPM).powi(2);
        let torque = |trace: Vec<f64>| -> Vec<f64> {
            let inertia = |theta| hartog::engine::forces::inertia_torque_per_omega2(geometry, theta) * omega2;
            trace.iter().enumerate().map(|(j, p)| gas_torque(geometry, *p, sample_angle(j)) + inertia(sample_angle(j))).collect()
        };
        let fired = torque(pressure.trace(index, geometry, 4, cylinders));
        let motored = torque(pressure.motored(index, geometry, 4));
        for (e, scatter) in [(misfiring(&s, cylinder), &one_misfires), (unequal(&s, &scattered), &scattered)] {
            for throw in 0..s.engine.layout.throws() {
                let mut sum = vec![0.0; n];
                let rods = s.engine.layout.rods_per_throw;
                for (unit, share) in scatter.iter().enumerate().filter(|(unit, _)| unit / rods == throw) {
                    let shift = (s.engine.layout.firing_deg[unit] * 10.0).round() as usize;
                    (0..n).for_each(|j| sum[(j + shift) % n] += motored[j] + (1.0 + share) * (fired[j] - motored[j]));
                }
                for (o, c) in harmonics::analyse(&sum, &e.harmonics).iter().enumerate() {
                    assert!((e.throw_torque(throw, o, speed) - c).norm() < 1e-8 * fired[400].abs(), "{name} throw {throw} {}", e.orders[o]);
                }
            }
        }
    }
}

/// Theory: a study whose only cylinder that differs does not burn comes to the same response as a misfire of that cylinder; one whose cylinders
/// differ by nothing to that of the engine as it should be.
#[test]
fn unequal_cylinders_between_firing_and_misfire() {
    let design = |conditions: &[Condition], scatter: Option<Vec<f64>>| {
        let mut s = study("villalva_i6_thesis");
        (s.optimise, s.front, s.conditions, s.scatter) = (None, None, conditions.to_vec(), scatter);
        (s.fatigue, s.calibrate) = (None, None);
        s.designs.truncate(2);
        analysis::run(&s, &Silent).expect("damped").designs.swap_remove(1)
    };
    let misfire = design(&[Condition::Misfire], None);
    let worst = misfire.conditions[0].cylinder.expect("one misfires");
    let only = |share: f64| Some((0..6).map(|c| if c == worst { share } else { 0.0 }).collect());
    let unequal = |share| design(&[Condition::UnequalCylinders], only(share)).conditions[0].objective;
    assert_close(unequal(-1.0), misfire.conditions[0].objective, 1e-12, 0.0, "a misfire");
    assert_close(unequal(0.0), misfire.objective.expect("firing"), 1e-12, 0.0, "all alike");
    let (some, more) = (unequal(-0.3), unequal(-0.6));
    assert!((some - more).abs() > 1e-3 * more, "{some} {more}");
}

/// Theory: on the overrun every cylinder does what the one that misfires does: the response is that of cylinders which differ by all of their combustion, and the phasor of each throw is that of the firing engine with
/// what each misfire changes of it added up.
#[test]
fn on_the_overrun_every_cylinder_misfires() {
    let design = |condition: Condition, scatter: Option<Vec<f64>>| {
        let mut s = study("villalva_v10_thesis");
        (s.optimise, s.front, s.conditions, s.scatter) = (None, None, vec![condition], scatter);
        (s.fatigue, s.calibrate) = (None, None);
        s.designs.truncate(2);
        analysis::run(&s, &Silent).expect("damped").designs.swap_remove(1)
    };
    let (overrun, unequal) = (design(Condition::Overrun, None), design(Condition::UnequalCylinders, Some(vec![-1.0; 10])));
    assert_close(overrun.conditions[0].objective, unequal.conditions[0].objective, 1e-12, 0.0, "all motored");
    assert!(overrun.conditions[0].objective < 0.9 * overrun.objective.expect("firing"), "compression alone shakes less");
    let s = study("villalva_v10_thesis");
    let firing = Excitation::new(&s.engine, s.order_limit);
    let motored = firing.motored(&s.engine, &firing.motored_change(&s.engine).expect("a cylinder"));
    let misfires: Vec<Excitation> = (0..10).map(|c| misfiring(&s, c)).collect();
    for (throw, n) in (0..firing.throws()).flat_map(|t| (0..firing.orders.len()).map(move |n| (t, n))) {
        let of = |e: &Excitation| e.throw_torque(throw, n, 6000.0);
        let expected = misfires.iter().map(|e| of(e) - of(&firing)).fold(of(&firing), |sum, c| sum + c);
        assert!((of(&motored) - expected).norm() < 1e-9 * of(&firing).norm().max(1.0), "{throw} {n}");
    }
}

/// Theory: the torque of the whole engine has the orders at which all firing phases add up, multiples of 3 in the six and of 2.5 in the V10
/// (but 10, where its banks cancel); with one cylinder misfiring every half order is there, as large as that cylinder's loss, whichever it is.
#[test]
fn misfire_brings_the_half_orders() {
    for (name, spacing, cancelled) in [("villalva_i6_thesis", 3.0, None), ("villalva_v10_thesis", 2.5, Some(10.0))] {
        let mut s = study(name);
        (s.optimise, s.front, s.conditions) = (None, None, vec![Condition::Misfire]);
        // crank and further designs tell nothing of the orders
        s.fatigue = None;
        s.designs.truncate(1);
        let appearing: Vec<f64> = analysis::run(&s, &Silent).expect("damped").appearing.iter().map(|o| o.value()).collect();
        let silent = |o: &f64| o % spacing != 0.0 || Some(*o) == cancelled;
        let theory: Vec<f64> = (1..=24).map(|i| 0.5 * f64::from(i)).filter(silent).collect();
        assert_eq!(appearing, theory, "{name}");
        let firing = Excitation::new(&s.engine, 12.0);
        let whole = |e: &Excitation, n| (0..e.throws()).map(|t| e.throw_torque(t, n, 2000.0)).sum::<C64>();
        for n in 0..4 {
            let loss = |c| (whole(&misfiring(&s, c), n) - whole(&firing, n)).norm();
            assert!(loss(0) > 10.0, "{name}: {}", loss(0));
            for c in 1..s.engine.layout.firing_deg.len() {
                assert_close(loss(c), loss(0), 1e-9, 0.0, &format!("{name}, order {}, cylinder {}", firing.orders[n], c + 1));
            }
        }
    }
}

/// Limits: a locked ring is a very stiff one and an inertia on the hub; a lost one is a lighter chain's. By both methods, with frequencies.
#[test]
fn locked_and_lost_are_limits() {
    let s = study("villalva_i6_thesis");
    let sys = system(&s);
    let grid = Grid::new(&s.speeds_rpm, &[]);
    let direct = Direct::new(&sys, &grid);
    let receptance = Receptance::new(&sys, &grid, 0, &[s.twist]);
    let sweep = |method: &dyn Response, design: &[Mounted]| {
        let mut out = Vec::new();
        method.sweep(design, s.twist, &mut out, &mut Work::default()).expect("damped");
        out
    };
    let ring = Mounted { hub_inertia: 0.01, ..on(0, Kind::Tuned, 0.076, 1.5e5, 30.0) };
    let locked = Condition::AbsorberLocked.absorbers(std::slice::from_ref(&ring));
    let lost = Condition::AbsorberLost.absorbers(std::slice::from_ref(&ring));
    let with = |inertia: f64| {
        let mut chain = s.chain.clone();
        chain.stations[0].inertia += inertia;
        System::new(chain, Excitation::new(&s.engine, s.order_limit))
    };
    for (what, design, heavier) in [("locked", locked, with(0.086)), ("lost", lost, with(0.01))] {
        let reference = sweep(&Direct::new(&heavier, &grid), &[]);
        for method in [&direct as &dyn Response, &receptance] {
            let found = sweep(method, &design);
            let worst = found.iter().zip(&reference).map(|(a, b)| (a - b).norm() / (1e-9 + b.norm())).fold(0.0, f64::max);
            assert!(worst < 1e-6, "{what} by {}: {worst:e}", method.name());
        }
        let frequencies = natural::frequencies_hz(&s.chain, &s.modes, &design);
        for (a, b) in frequencies.iter().zip(heavier.modes.frequencies_hz()) {
            assert_close(*a, b, 1e-9, 0.0, what);
        }
    }
    let stiff = Mounted { hub_inertia: 0.01, ..on(0, Kind::Tuned, 0.076, 1e13, 0.0) };
    let (a, b) = (sweep(&direct, &[stiff]), sweep(&direct, &Condition::AbsorberLocked.absorbers(std::slice::from_ref(&ring))));
    assert!(a.iter().zip(&b).all(|(a, b)| (a - b).norm() < 1e-5 * (1e-6 + b.norm())));
    // its ring does not move against the hub
    let mut twist = Vec::new();
    direct
        .sweep(&Condition::AbsorberLocked.absorbers(std::slice::from_ref(&ring)), Quantity::RingTwist(0), &mut twist, &mut Work::default())
        .expect("damped");
    assert!(twist.iter().all(|y| *y == C64::default()));
}

/// Gradients of all rows of a problem with several conditions, a free locked ring among them, against central differences.
#[test]
fn gradients_in_every_condition() {
    let s = study("villalva_i6_thesis");
    let firing = system(&s);
    let misfire = System::new(s.chain.clone(), misfiring(&s, 2));
    let grid = Grid::new(&s.speeds_rpm, &[]);
    let methods = [&firing, &misfire].map(|sys| Method::Direct(Direct::new(sys, &grid)));
    let finders = [(&firing, &methods[0]), (&misfire, &methods[1])].map(|(sys, method)| PeakFinder::new(sys, &grid, method, true));
    let load_case = |condition, finder| LoadCase::new(condition, finder);
    let load_cases = [
        load_case(Condition::Firing, &finders[0]),
        load_case(Condition::Misfire, &finders[1]),
        load_case(Condition::AbsorberLocked, &finders[0]),
        load_case(Condition::AbsorberLost, &finders[0]),
    ];
    let mut spec = s.optimise.clone().expect("optimises");
    spec.absorbers[0].size = Size::Between(0.01, 0.1);
    let space = hartog::analysis::families::family(&spec, &Choice { types: vec![&TUNED], rings: vec![None] }, &[Vec::new()]);
    let objective = Measure::new(vec![s.twist], Over::Synthesis).in_si();
    // a locked ring is far worse than a working one: together only its rows would count
    let problem = |range: std::ops::Range<usize>| Problem {
        load_cases: &load_cases[range],
        space: space.clone(),
        objectives: std::slice::from_ref(&objective),
        weights: &[],
        limits: &[],
        memory: None,
    };
    let mut seen = [0; 4];
    let design = on(0, Kind::Tuned, 0.076, 5.5e4, 28.0);
    for (first, problem) in [(0, problem(0..2)), (2, problem(2..4))] {
        let w = problem.space.point(&[three_values(&design).to_vec()]);
        let rows = problem.rows(&w, &mut Work::default()).expect("damped");
        for row in &rows.rows {
            seen[first + row.load_case] += 1;
            for i in 0..w.len() {
                let at = |step: f64| {
                    let mut w = w.clone();
                    w[i] += step;
                    let there = problem.rows(&w, &mut Work::default()).expect("damped");
                    let same = there.rows.into_iter().filter(|r| r.load_case == row.load_case);
                    // several pairs of extremes may peak at one speed
                    let angles = |r: &Row| r.peak.extremes.map_or((0.0, 0.0), |e| (e.angle_max, e.angle_min));
                    let distance = |r: &Row| {
                        let (a, b) = (angles(r), angles(row));
                        (r.peak.speed_rpm - row.peak.speed_rpm).abs() + (a.0 - b.0).abs() + (a.1 - b.1).abs()
                    };
                    same.min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("the same peak").value
                };
                let difference = (at(1e-4) - at(-1e-4)) / 2e-4;
                assert_close(row.gradient[i], difference, 1e-3, 1e-6 * row.value, &format!("load_case {} variable {i}", row.load_case));
            }
        }
    }
    assert!(seen[0] > 0 && seen[1] > 0 && seen[2] > 0 && seen[3] == 0, "{seen:?}");
}

/// An optimum asked to hold with any cylinder misfiring is better there than the one that was not, never better than that one while all
/// fire, and its first-order conditions hold.
#[test]
fn an_optimum_that_holds_in_a_misfire() {
    let run = |conditions: &[Condition]| {
        let mut s = study("villalva_v10_thesis");
        (s.front, s.conditions) = (None, vec![Condition::Misfire]);
        s.more_objectives.clear();
        s.fatigue = None;
        let o = s.optimise.as_mut().expect("optimises");
        (o.absorbers[0].types, o.absorbers[0].size, o.conditions) = (vec![&TUNED], Size::Each(vec![0.01]), conditions.to_vec());
        o.prove.effort.boxes = 0;
        s.designs.clear();
        s.speeds_rpm = s.speeds_rpm.iter().copied().step_by(4).collect();
        analysis::run(&s, &Silent).expect("damped")
    };
    let (plain, held) = (run(&[Condition::Firing]), run(&[Condition::Firing, Condition::Misfire]));
    let (plain, held) = (&plain.optima[0], &held.optima[0]);
    let misfire = |o: &analysis::OptimumResult| o.design.conditions[0].objective;
    let firing = |o: &analysis::OptimumResult| o.design.twist.expect("excited").value;
    assert!(misfire(held) < misfire(plain) * (1.0 - 1e-4), "{} {}", misfire(held), misfire(plain));
    assert!(firing(held) >= firing(plain) * (1.0 - 1e-9));
    assert_close(held.optimum.value(), misfire(held).max(firing(held)), 1e-9, 0.0, "the worst condition counts");
    assert_eq!(held.design.objective, Some(misfire(held).max(firing(held))));
    assert!(held.optimum.outcome.kkt_residual < 1e-5, "{:e}", held.optimum.outcome.kkt_residual);
}

/// Lost and locked absorbers in the table of a run: a lost ring leaves the engine that never had one; nothing is said of a design without.
#[test]
fn conditions_of_the_given_designs() {
    let mut s = study("villalva_i6_thesis");
    (s.optimise, s.front, s.conditions) = (None, None, vec![Condition::AbsorberLocked, Condition::AbsorberLost]);
    let results = analysis::run(&s, &Silent).expect("damped");
    assert!(results.designs[0].conditions.is_empty(), "no absorber");
    let none = results.designs[0].twist.expect("excited").value;
    for d in &results.designs[1..] {
        assert_close(d.conditions[1].twist.expect("excited").value, none, 1e-9, 0.0, &d.name);
        let heavier = Mounted { absorber: Absorber::Locked { ring_inertia: 0.076 }, ..d.absorbers[0].clone() };
        assert_eq!(Condition::AbsorberLocked.absorbers(&d.absorbers), std::slice::from_ref(&heavier));
        assert!(
            heavier.absorber.ring_inertia() == 0.076 && d.conditions[0].objective > none,
            "{}: a dead ring lowers f1 into the range",
            d.name
        );
    }
}

/// An inertia is the same in every condition: the lightest ring under a limit in two conditions is no worst of them, the limit is.
#[test]
fn an_inertia_is_of_no_condition() {
    let text = "engine = \"engines/villalva_i6.toml\"\nspeed_rpm = { from = 600, to = 3200, step = 100 }\norder_limit = 6\n\n[[objective]]\nring_inertia = {}\n\n\
                [[constraint]]\npeak_twist = { from = \"pulley\", to = \"flywheel\", max_deg = 0.6 }\n\n[optimise]\nconditions = [\"firing\", \"misfire\"]\nrandom_starts = 0\nprove = { boxes = 0 }\n\
                [[optimise.absorber]]\non.station = \"pulley\"\ntypes = [\"tuned\"]\nsize.ring_inertia_kg_m2.between = [0.005, 0.15]\n";
    let study = hartog::input::Study::from_toml(text, Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/lightest.toml"));
    let results = study.unwrap_or_else(|e| panic!("{e}")).run().expect("damped");
    let optimum = results.best_optimum(false).expect("an optimum");
    let judged = results.judged_optimum(optimum);
    assert!(judged.is_reference() && judged.other_reference().is_none(), "{judged:?}");
    assert!(judged.value == optimum.optimum.value() && results.study.held().len() == 2);
}

/// The curve of a misfire is that of the worst cylinder at every speed: the largest synthesis of a sweep of each, whose orders add up to it. It was the curve of the cylinder that is worst at its peak, 26 % below another one
/// elsewhere.
#[test]
fn the_curve_of_a_misfire_is_of_the_worst_cylinder_everywhere() {
    let mut s = study("villalva_i6_thesis");
    (s.optimise, s.front, s.conditions) = (None, None, vec![Condition::Misfire]);
    s.speeds_rpm = s.speeds_rpm.iter().copied().step_by(10).collect();
    let results = analysis::run(&s, &Silent).expect("damped");
    let none = results.sweeps.iter().find(|d| d.design == "none").expect("a design without absorber");
    let curve = none.quantities.iter().find(|q| q.condition == Condition::Misfire).expect("its twist");
    let grid = Grid::new(&s.speeds_rpm, &[]);
    let of = |cylinder: usize| {
        let system = System::new(s.chain.clone(), misfiring(&s, cylinder));
        let method = Method::Direct(Direct::new(&system, &grid));
        let mut sweep = Vec::new();
        method.sweep(&[], s.twist, &mut sweep, &mut Work::default()).expect("damped");
        PeakFinder::new(&system, &grid, &method, false).synthesis(&sweep)
    };
    let all: Vec<Vec<f64>> = (0..6).map(of).collect();
    let mut worst_at = std::collections::BTreeSet::new();
    for (i, total) in curve.total.iter().enumerate() {
        let (worst, largest) = all.iter().map(|c| c[i]).enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).expect("cylinders");
        assert_close(*total, largest.to_degrees(), 1e-9, 0.0, &format!("{} rpm", s.speeds_rpm[i]));
        worst_at.insert(worst);
    }
    assert!(worst_at.len() > 1, "one cylinder is worst everywhere");
}
