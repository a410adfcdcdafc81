//! Optima and fronts of several absorbers: closed forms share out modes among rings, and where an objective is not the response, or limits are held, the best may lie at a corner of the bounds.

use crate::limited::{optimum, read};
use hartog::absorber::{Absorber, Mounted};
use hartog::analysis::{self, Silent};
use hartog::input::{DesignSpec, Study};

/// A study with peaks at the speeds of its sweep alone: what is asked here is of searches, whatever the peaks are, and most of the time would go into peaks between speeds.
fn on_its_speeds(name: &str) -> Study {
    Study { refine_peaks: false, ..read(name) }
}

/// Law: the best of a set is no worse than any design of it. Two rings on the six by the power that they dissipate, and the end of their front with least power, against the 64 designs at the
/// corners of their bounds. At 8b77a08, where searches started from closed forms alone, the optimum was 3.6 times the best of these.
#[test]
fn no_corner_beats_two_rings() {
    let study = on_its_speeds("two_rings");
    let found = analysis::run(&study, &Silent).unwrap_or_else(|e| panic!("{e}"));
    let own = found.optima[0].optimum.value();
    let front = &found.tradeoffs[0].families.iter().find(|f| f.0.contains('_')).expect("two rings").1;
    let end = |measure: usize| front.points.iter().map(|p| p.values[measure]).fold(f64::INFINITY, f64::min);
    let (least, stillest) = (end(0), end(1));
    let by_twist = found.optima.iter().find(|o| o.objective == 1).expect("by twist").optimum.value();
    assert!(stillest <= by_twist * (1.0 + 1e-6), "{stillest} at the end of the front, {by_twist} by itself");
    let rubber = found.optima[0].optimum.design[0].absorber.law().expect("a ring");
    let ring = |inertias: [f64; 2]| -> Vec<Mounted> {
        let values = inertias.iter().flat_map(|j| [5e3, 5e5].into_iter().flat_map(move |k| [0.05, 0.25].map(|eta| [*j, k, eta])));
        values.map(|v| Mounted::on_station(0, Absorber::Ring(rubber.rebuilt(&v)))).collect()
    };
    let (outer, inner) = (ring([0.02, 0.08]), ring([0.008, 0.04]));
    let pairs = outer.iter().flat_map(|a| inner.iter().map(move |b| vec![a.clone(), b.clone()]));
    let mut given = study.clone();
    (given.optimise, given.front) = (None, None);
    given.designs = pairs.enumerate().map(|(i, absorbers)| DesignSpec { name: format!("d{i}"), absorbers }).collect();
    let designs = analysis::run(&given, &Silent).unwrap_or_else(|e| panic!("{e}")).designs;
    let lowest = designs.iter().filter_map(|d| d.objective).fold(f64::INFINITY, f64::min);
    assert!(designs.len() == 64 && own <= lowest * (1.0 + 1e-6), "{own} W against {lowest} W");
    assert!(least <= lowest * (1.0 + 1e-6), "{least} W at the end of the front, {lowest} W of a given design");
}

/// Law: the ratio by which the nearest design misses its limits is the largest of those it is judged by, in operation, too, where heat softens the rubber. At 8b77a08 it was that of the material's reference.
#[test]
fn the_nearest_design_is_that_of_operation() {
    let mut study = on_its_speeds("in_operation");
    study.speeds_rpm = study.speeds_rpm.iter().copied().step_by(13).collect();
    study.limits[0].limit *= 0.5;
    study.objective = study.limits[0].of.clone();
    study.optimise.as_mut().expect("optimises").absorbers[0].materials[0].1.properties[0].1 = (0.15, 0.15);
    let found = optimum(&study);
    let conflict = found.conflict.as_ref().expect("no design holds it");
    let judged = found.design.limits[0];
    assert!(conflict.ratio > 1.01 && (judged / conflict.ratio - 1.0).abs() < 1e-6, "{} of it, judged {judged}", conflict.ratio);
}

/// Law: an optimum is no higher than its other local optima, all within the same tolerances. Which of two rings' local optima is the lowest may change with the first deviation inside the box that is worse than its corners: at
/// 8b77a08 the one that was given here lay 0.4 % above another that it listed (0.380188° and 0.378731°), and no other was sought anew.
#[test]
fn no_other_local_optimum_within_tolerances_is_lower() {
    let found = analysis::run(&read("within_tolerances"), &Silent).unwrap_or_else(|e| panic!("{e}"));
    let robust = found.optima.iter().find(|o| o.robust).expect("an optimum within tolerances");
    let (value, others) = (robust.optimum.value(), &robust.optimum.others);
    assert!(!others.is_empty(), "there are others");
    assert!(
        others.iter().all(|other| other.value >= value * (1.0 - 1e-9)),
        "{value}: {:?}",
        others.iter().map(|o| o.value).collect::<Vec<_>>()
    );
    let judged = robust.design.name.as_str();
    let within = found.robust.iter().find(|r| r.design == judged).expect("judged within tolerances");
    assert!((within.worst.value / value - 1.0).abs() < 1e-6, "{} judged, {value} sought", within.worst.value);
}

/// Law: an optimum within tolerances holds its limits where all of the tolerances do. The torque of this one is 2084 N m as drawn, within 2100 N m, and beyond it with tolerances, and no design was found that holds it there: at
/// 8b77a08 the run said that all limits hold.
#[test]
fn limits_of_an_optimum_within_tolerances_are_those_within() {
    let found = analysis::run(&on_its_speeds("broken_within_tolerances"), &Silent).unwrap_or_else(|e| panic!("{e}"));
    let [drawn, robust] = [false, true].map(|robust| found.optima.iter().find(|o| o.robust == robust).expect("searched"));
    assert!(robust.conflict.is_some() && robust.design.within_limits(), "it holds as drawn alone: {:?}", robust.design.limits);
    assert!(drawn.limits_hold() && !robust.limits_hold() && !found.limits_hold());
}

/// Law: an optimum within tolerances holds its limits at every point of them that the table of tolerances finds. The twist of the inner of two rings is largest between corners, where the search looked at both limits as one and none of
/// its random points was beyond them: at d0177b5 it was 3.5 % beyond its limit in the table.
#[test]
fn limits_hold_between_corners() {
    let found = analysis::run(&read("limits_inside"), &Silent).unwrap_or_else(|e| panic!("{e}"));
    let robust = found.optima.iter().find(|o| o.robust).expect("an optimum within tolerances");
    let table = found.robust.iter().find(|r| r.design == robust.design.name).expect("its tolerances");
    let ratios: Vec<f64> = table.limits.iter().map(|w| w.value).collect();
    assert!(ratios.len() == 2 && ratios.iter().all(|r| *r <= 1.0 + 1e-9), "{ratios:?}");
    assert!(ratios.iter().any(|r| *r > 0.99), "a limit binds: {ratios:?}");
}

/// Law: limits are judged in operation, at the temperatures of a design, and an optimum within tolerances holds them there as it is drawn. At afbb8bc it was sought at the material's reference alone and was 9 % beyond its
/// limit, while the page said that no design was found that holds it.
#[test]
fn limits_of_a_robust_optimum_hold_in_operation() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/limited/in_operation.toml");
    let text = std::fs::read_to_string(&path).expect("a study") + "\n[robust]\ntolerance = { stiffness_n_m_per_rad = 0.05 }\n";
    let twist = "peak_twist = { from = \"pulley\", to = \"flywheel\" }";
    let text = text
        .replace("peak_twist = { from = \"pulley\", to = \"flywheel\", max_deg = 0.6 }", "ring_twist = { absorber = 1, max_deg = 0.66 }");
    let text = text.replace("temperature = { absorber = 1 }", twist).replace("order_limit = 12", "order_limit = 3");
    let mut study = hartog::input::Study::from_toml(&text, path).unwrap_or_else(|e| panic!("{e}"));
    (study.speeds_rpm, study.refine_peaks) = (vec![800.0, 1600.0, 2400.0, 3200.0], false);
    let found = analysis::run(&study, &Silent).unwrap_or_else(|e| panic!("{e}"));
    let robust = found.optima.iter().find(|o| o.robust).expect("an optimum within tolerances");
    assert!(robust.conflict.is_none() && robust.design.within_limits(), "{:?}", robust.design.limits);
    let table = found.robust.iter().find(|r| r.design == robust.design.name).expect("its tolerances");
    assert!(table.limits.iter().all(|w| w.value <= 1.0 + 1e-9), "within the tolerances, too");
}
