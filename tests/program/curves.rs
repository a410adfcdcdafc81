//! `hartog curves`: every figure is a plot and a table that reads back, and the curves obey their laws.

use crate::support::{assert_close, study};
use assert_cmd::Command;
use hartog::analysis::Silent;
use hartog::analysis::curves::{Curves, Figure, Look, Panel, Shown, curves, curves_of};
use hartog::analysis::sizing::run;
use hartog::engine::{Excitation, Source};
use std::fs;
use std::path::Path;

fn of(name: &str, speeds: &[f64]) -> Curves {
    curves(&study(name), speeds, &Silent).unwrap_or_else(|e| panic!("{e}"))
}

fn panel<'a>(curves: &'a Curves, figure: &str, panel: usize) -> &'a Panel {
    let found: &Figure = curves.figures.iter().find(|f| f.name == figure).unwrap_or_else(|| panic!("{figure}"));
    &found.panels[panel]
}

/// Trapezoids under y(x).
fn area(points: &[(f64, f64)]) -> f64 {
    points.windows(2).map(|w| 0.5 * (w[0].1 + w[1].1) * (w[1].0 - w[0].0)).sum()
}

/// Law: the loop of the indicator diagram is the indicated work, the mean torque of all throws is order zero, a throw carries its own share, and torque of
/// gas and masses add up. Points are a degree apart; the burn bends the loop within a few of them.
#[test]
fn work_of_the_cycle() {
    let (curves, study) = (of("villalva_i6", &[1600.0]), study("villalva_i6"));
    let audit = *Excitation::new(&study.engine, 12.0).audit.iter().find(|a| a.speed_rpm == 1600.0).expect("tabulated");
    let Source::Cylinder { geometry, .. } = &study.engine.source else { panic!("a cylinder") };
    let loop_at = panel(&curves, "cylinder", 1).curves.iter().find(|c| c.label == "1600 rpm").expect("a curve");
    // bar cm³ are 0.1 J
    let mut closed = loop_at.points.clone();
    closed.push(closed[0]);
    assert_close(0.1 * area(&closed), audit.indicated_mean_pressure * geometry.displacement(), 2e-3, 0.0, "indicated work");
    let total = &panel(&curves, "torque_1600", 1).curves[0].points;
    let mean = total.iter().map(|p| p.1).sum::<f64>() / total.len() as f64;
    assert_close(mean, audit.mean_torque, 2e-3, 0.0, "mean torque");
    let unit = panel(&curves, "forces_1600", 2);
    for (j, (_, all)) in unit.curves[0].points.iter().enumerate() {
        let parts: f64 = unit.curves[1..].iter().map(|c| c.points[j].1).sum();
        // forces on the pin on one side, virtual work of gas and masses on the other; liner friction is none here
        assert_close(parts, *all, 0.0, 1e-9 * 1e3, "gas, masses and friction");
    }
}

/// Law: at a speed between two of the table the pressure that is shown stands between theirs, linear in speed; at those that are asked for, and no others.
#[test]
fn pressure_at_speeds_that_are_asked_for() {
    let curves = of("villalva_i6", &[1600.0, 2100.0, 2600.0]);
    let [low, middle, high] = panel(&curves, "cylinder", 0).curves.as_slice() else { panic!("three speeds") };
    assert_eq!([&low.label, &middle.label, &high.label], ["1600 rpm", "2100 rpm", "2600 rpm"]);
    for ((a, b), c) in low.points.iter().zip(&middle.points).zip(&high.points) {
        assert_close(b.1, 0.5 * (a.1 + c.1), 1e-12, 0.0, "halfway");
    }
}

/// Law: Holzer's torque behind the last station vanishes, and each link carries its stiffness times its twist. (With branches and gears: `trees.rs`.)
#[test]
fn holzer_closes() {
    for name in ["villalva_i6", "villalva_v10", "mendes_mwm6"] {
        let curves = of(name, &[]);
        let largest = curves.holzer.iter().map(|r| r.sum.abs()).fold(0.0, f64::max);
        for r in &curves.holzer {
            let carried = if r.stiffness > 0.0 { r.stiffness * r.twist } else { 0.0 };
            assert_close(r.sum, carried, 1e-9, 1e-9 * largest, &format!("{name}, mode {}, {}", r.mode, r.station));
        }
    }
}

/// Law: an even six in line has free forces of the sixth order only, and no free moment; its counterweights change neither. Rods long against the crank have
/// little of the sixth.
#[test]
fn balance_of_a_six() {
    let curves = of("villalva_i6", &[3000.0]);
    let force = &panel(&curves, "balance", 0).curves[0].points;
    let one = 2.666 * 0.062 * (3000.0 * std::f64::consts::TAU / 60.0_f64).powi(2);
    let largest = force.iter().map(|p| p.1.abs()).fold(0.0, f64::max);
    assert!(largest > 0.0 && largest < 0.01 * one, "{largest} N of {one} N a cylinder");
    for j in 0..60 {
        assert_close(force[j].1, force[j + 60].1, 0.0, 1e-9 * one, "repeats every 60 degrees");
    }
    assert!(panel(&curves, "balance", 1).curves.iter().flat_map(|c| &c.points).all(|p| p.1 == 0.0), "no free moment");
}

/// The command writes a table and two pictures a figure; tables read back as the curves; a speed outside the study is refused.
#[test]
fn the_command_writes_figures() {
    let folder = tempfile::tempdir().expect("folder");
    let command = || {
        let mut command = Command::cargo_bin("hartog").expect("built");
        command.current_dir(env!("CARGO_MANIFEST_DIR")).args(["curves", "studies/villalva_v10.toml", "--out"]).arg(folder.path());
        command
    };
    command().assert().code(0);
    let curves = of("villalva_v10", &[]);
    assert!(curves.figures.len() >= 15);
    for figure in &curves.figures {
        let at = |ending: &str| folder.path().join(format!("{}.{ending}", figure.name));
        assert!(at("png").is_file() && fs::read_to_string(at("svg")).expect("svg").starts_with("<svg"), "{}", figure.name);
        let mut reader = csv::Reader::from_path(at("csv")).expect("csv");
        let mut rows = reader.records().map(|r| r.expect("a row"));
        for panel in &figure.panels {
            for (curve, point) in panel.curves.iter().flat_map(|c| c.points.iter().map(move |p| (c, p))) {
                let row = rows.next().expect("as many rows as points");
                assert_eq!([&row[0], &row[1], &row[2], &row[4]], [&panel.title, &curve.label, panel.x.column, panel.y.column]);
                assert_eq!((row[3].parse::<f64>(), row[5].parse::<f64>()), (Ok(point.0), Ok(point.1)));
            }
        }
        assert!(rows.next().is_none());
    }
    assert!(fs::read_to_string(folder.path().join("holzer.csv")).expect("holzer").starts_with("mode,frequency_hz,station,"));
    let refused = command().args(["--speed", "9000"]).assert().code(2);
    let said = String::from_utf8_lossy(&refused.get_output().stderr).into_owned() + &String::from_utf8_lossy(&refused.get_output().stdout);
    assert!(said.contains("expected a speed of the study, 1000 to 8700 rpm"), "{said}");
}

/// Law: the torque of a throw is its tangential force at the crank radius; what moving masses do returns to itself every turn, so that its mean over the cycle vanishes; velocity and acceleration are the rates of the travel; both
/// methods agree for a rod that is two masses.
#[test]
fn forces_of_the_mechanism() {
    for (name, speed) in [("villalva_v10", 6500.0), ("villalva_i6", 1600.0)] {
        let curves = of(name, &[speed]);
        let study = study(name);
        let Source::Cylinder { geometry, .. } = &study.engine.source else { panic!("a cylinder") };
        let tangential = panel(&curves, &format!("pin_forces_{speed}"), 2);
        let torque = panel(&curves, &format!("torque_{speed}"), 0);
        for (force, torque) in tangential.curves.iter().zip(&torque.curves) {
            for (f, t) in force.points.iter().zip(&torque.points) {
                assert_close(f.1 * geometry.slider_crank.crank_radius, t.1, 1e-9, 1e-6, "torque of a throw");
            }
        }
        let (size, radial) = (panel(&curves, &format!("pin_forces_{speed}"), 0), panel(&curves, &format!("pin_forces_{speed}"), 1));
        for ((s, r), t) in size.curves.iter().zip(&radial.curves).zip(&tangential.curves) {
            for ((s, r), t) in s.points.iter().zip(&r.points).zip(&t.points) {
                assert_close(r.1.hypot(t.1), s.1, 1e-12, 1e-9, "size of a force");
            }
        }
        for i in [3, 4] {
            for own in &panel(&curves, &format!("pin_forces_{speed}"), i).curves {
                let largest = own.points.iter().map(|p| p.1.abs()).fold(0.0, f64::max);
                let mean = own.points.iter().map(|p| p.1).sum::<f64>() / own.points.len() as f64;
                assert_close(mean, 0.0, 0.0, 1e-9 * largest, "moving masses");
            }
        }
        let kinematics = |i: usize| &panel(&curves, &format!("kinematics_{speed}"), i).curves[0].points;
        let step = 1.0 / (6.0 * speed);
        for (of, rate, scale) in [(0, 1, 1e-3), (1, 2, 1.0), (3, 4, std::f64::consts::PI / 180.0), (4, 5, 1.0)] {
            let (of, rate) = (kinematics(of), kinematics(rate));
            let largest = rate.iter().map(|p| p.1.abs()).fold(0.0, f64::max);
            for j in 1..of.len() - 1 {
                let slope = (of[j + 1].1 - of[j - 1].1) * scale / (2.0 * step);
                assert_close(slope, rate[j].1, 0.0, 3e-4 * largest, "rate by differences a degree apart");
            }
        }
        for methods in &curves.figures.iter().find(|f| f.name == format!("methods_{speed}")).expect("both methods").panels {
            let [a, b] = &methods.curves[..] else { panic!("two methods") };
            let largest = a.points.iter().map(|p| p.1.abs()).fold(0.0, f64::max);
            for (a, b) in a.points.iter().zip(&b.points) {
                assert_close(a.1, b.1, 0.0, 1e-9 * largest, &methods.title);
            }
        }
    }
}

/// Law: half the range of a shaft's torque over the cycle is what the sweep has at that speed (720 points a cycle: 1e-3); along the crank the torque rises at a pin by the torque of its throw in the cases A and C; the two instants of
/// the cases are one set for all designs.
#[test]
fn torque_of_the_crank() {
    let curves = of("villalva_v10_thesis", &[6500.0]);
    let shafts = panel(&curves, "shafts_6500", 0);
    let sweep = curves.figures.iter().find(|f| f.name == "shaft_torque_none").expect("a sweep");
    let every = &sweep.panels[0].curves;
    for swept in &sweep.panels[1..] {
        let own = shafts.curves.iter().find(|c| c.label == swept.title).expect("the shaft");
        let (low, high) = own.points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |m, p| (m.0.min(p.1), m.1.max(p.1)));
        let all = swept.curves.iter().find(|c| c.label == "all orders").expect("the sum");
        let at = all.points.iter().find(|p| p.0 == 6500.0).expect("a speed of the study");
        assert_close(0.5 * (high - low), at.1, 1e-3, 0.0, &swept.title);
        assert_eq!(every.iter().find(|c| c.label == swept.title).expect("every shaft").points, all.points);
    }
    assert_eq!(every.iter().map(|c| &c.label).collect::<Vec<_>>(), shafts.curves.iter().map(|c| &c.label).collect::<Vec<_>>());
    let torque = panel(&curves, "torque_6500", 0);
    let title = &panel(&curves, "torsion_cases_6500", 0).curves[0].label;
    let angle: f64 = title.trim_start_matches("at the largest load, ").trim_end_matches('°').parse().expect("an angle");
    for case in [0, 2] {
        let own = &panel(&curves, "torsion_cases_6500", 4).curves[case].points;
        for (throw, corners) in own.chunks(4).enumerate() {
            let jump = corners[2].1 - corners[1].1;
            // the label is rounded to a degree: between its neighbours
            let near: Vec<f64> = torque.curves[throw].points.iter().filter(|p| (p.0 - angle).abs() <= 1.0).map(|p| p.1).collect();
            let (low, high) = near.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |m, t| (m.0.min(*t), m.1.max(*t)));
            assert!(jump >= low - 1e-6 && jump <= high + 1e-6, "case {case}, throw {}: {jump} in {low} to {high}", throw + 1);
        }
    }
}

/// Law: at a resonance the frequency of a mode is that of an order at that speed; every mode and order that is drawn meets in all the points that the range of speeds holds.
#[test]
fn resonances_of_the_campbell_diagram() {
    let found = of("villalva_v10", &[8700.0]);
    let campbell = panel(&found, "campbell", 0);
    let of_look = |wanted: fn(&Look) -> bool| campbell.curves.iter().filter(move |c| wanted(&c.look));
    let modes: Vec<f64> = of_look(|l| matches!(l, Look::Black(_))).map(|c| c.points[0].1).collect();
    let orders: Vec<f64> = of_look(|l| matches!(l, Look::Order(_))).map(|c| c.points[1].1 / c.points[1].0).collect();
    let (low, high) = (campbell.curves[0].points[0].0, campbell.curves[0].points[1].0);
    let mut expected: Vec<(f64, f64)> =
        orders.iter().flat_map(|o| modes.iter().map(move |f| (f / o, *f))).filter(|p| (low..=high).contains(&p.0)).collect();
    let mut drawn = of_look(|l| *l == Look::Points).next().expect("resonances").points.clone();
    expected.sort_by(|a, b| a.0.total_cmp(&b.0));
    drawn.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert!(drawn.len() > 10 && drawn.len() == expected.len(), "{} of {}", drawn.len(), expected.len());
    for (a, b) in drawn.iter().zip(&expected) {
        assert_close(a.0, b.0, 1e-12, 0.0, "speed");
        assert_close(a.1, b.1, 1e-12, 0.0, "frequency");
    }
}

/// Law: without offset and friction the liner alone holds the piston across its cylinder against the rod; the rod's force is as large in axes of the cylinder as along and across the rod.
#[test]
fn rod_of_a_sized_crank() {
    let study = hartog::input::read_sizing(&Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/fialho_two_stroke.toml")).expect("a study");
    let results = run(&study, &Silent).expect("sizes");
    let figure = results.figures.iter().find(|f| f.name.starts_with("sizing_forces")).expect("forces");
    let find = |title: &str, label: &str| {
        let own = figure.panels.iter().find(|p| p.title.starts_with(title)).expect("a panel");
        own.curves.iter().find(|c| c.label.starts_with(label)).expect("a curve").points.clone()
    };
    let (along, across) = (find("rod on piston pin", "along"), find("rod on piston pin", "across"));
    let (tension, beside, liner) = (find("rod: tension", "along, small"), find("rod: tension", "across, small"), find("piston", "liner"));
    let largest = along.iter().fold(0.0, |m: f64, p| m.max(p.1.abs()));
    for j in 0..along.len() {
        assert_close(across[j].1, -liner[j].1, 0.0, 1e-9 * largest, "across the cylinder");
        assert_close(along[j].1.hypot(across[j].1), tension[j].1.hypot(beside[j].1), 1e-12, 1e-9, "size");
    }
    // at firing dead centre gas pushes the rod, and that the piston away from the crank
    assert!(along[0].1 > 0.0 && tension[0].1 < 0.0, "{} {}", along[0].1, tension[0].1);
}

/// What is asked for is shown, and nothing else: one design, one throw, all orders; the fit of the inputs sees all designs.
#[test]
fn only_what_is_asked_for() {
    let study = study("villalva_v10_thesis");
    let shown = Shown { speeds_rpm: vec![8700.0], designs: vec!["tuned_unity".into()], throws: vec![1], all_orders: true };
    let (some, all) = (curves_of(&study, &shown, &Silent).expect("damped"), curves(&study, &[8700.0], &Silent).expect("damped"));
    let names = |c: &Curves| c.figures.iter().map(|f| f.name.clone()).filter(|n| n.starts_with("shaft_torque")).collect::<Vec<_>>();
    assert_eq!((names(&some), names(&all).len()), (vec!["shaft_torque_tuned_unity".to_owned()], 4));
    let pins = panel(&some, "pin_forces_8700", 0);
    assert_eq!(pins.curves.len(), 1);
    assert_eq!(pins.curves[0], panel(&all, "pin_forces_8700", 0).curves[1]);
    // orders 1/2 to 12, and all together
    let of = |c: &Curves| panel(c, "shaft_torque_tuned_unity", 1).curves.len();
    assert_eq!((of(&some), of(&all)), (25, 7));
    assert_eq!(panel(&some, "shafts_8700", 0).curves, panel(&all, "shafts_8700", 1).curves);
}
