//! Load, counterweights and moving masses: what the engine runs at, and what its chain and crank bear.

use crate::support::{assert_close, study};
use hartog::Study;
use hartog::analysis::sweeps::Swept;
use hartog::engine::Excitation;
use std::fs;
use std::path::Path;

/// The shipped six at another load: keys put at the top of its study.
fn six(keys: &str) -> Study {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/villalva_i6.toml");
    let text = fs::read_to_string(&path).expect("study");
    let start = text.find("duty = [").expect("duty");
    let end = start + text[start..].find("\n]\n").expect("its end") + 3;
    let text = format!("{}{}{}", &text[..start], keys, &text[end..]);
    Study::from_toml(&text, &path).unwrap_or_else(|e| panic!("{e}"))
}

/// The indicated mean pressure of the cycle is the full-load curve times the share: linear between the speeds of both tables.
#[test]
fn part_load_scales_the_mean_pressure() {
    let mean = |s: &Study| -> Vec<(f64, f64)> {
        Excitation::new(&s.engine, 12.0).audit.iter().map(|a| (a.speed_rpm, a.indicated_mean_pressure / 1e5)).collect()
    };
    // 0.1° samples of the cycle close its area to 1e-6
    for (speed, p) in mean(&six("load_fraction = 0.5\n")) {
        let full = [(600.0, 8.0), (1000.0, 14.0), (1600.0, 18.0), (2600.0, 15.0), (3200.0, 6.0)];
        let full = full.iter().find(|f| f.0 == speed).expect("a speed of the curve").1;
        assert_close(p, 0.5 * full, 1e-5, 0.0, "half load");
    }
    let part = mean(&six("part_load = { speed_rpm = [1000, 2000, 3000], fraction = [1, 0.5, 0.25] }\n"));
    let expected = [
        (600.0, 8.0),
        (1000.0, 14.0),
        (1600.0, 18.0 * 0.7),
        (2000.0, 16.8 * 0.5),
        (2600.0, 15.0 * 0.35),
        (3000.0, 9.0 * 0.25),
        (3200.0, 6.0 * 0.25),
    ];
    assert_eq!(part.len(), expected.len());
    for (found, wanted) in part.iter().zip(expected) {
        assert_close(found.0, wanted.0, 0.0, 0.0, "speed");
        assert_close(found.1, wanted.1, 1e-5, 0.0, "part load over speed");
    }
}

/// A point of the duty is what a study of that load gives at that speed.
#[test]
fn a_duty_point_is_the_study_at_its_load() {
    let mut whole =
        six("duty = [{ speed_rpm = 1600, load_fraction = 0.5, share = 0.75 }, { speed_rpm = 2400, load_fraction = 1, share = 0.25 }]\n");
    let mut half = six("load_fraction = 0.5\n");
    for s in [&mut whole, &mut half] {
        (s.optimise, s.front, s.fatigue) = (None, None, None);
        s.conditions.clear();
        s.more_objectives.clear();
    }
    let (whole, half) = (whole.run().expect("run"), half.run().expect("run"));
    assert_eq!(whole.duty.len(), 4);
    for (d, sweep) in whole.duty.iter().zip(&half.sweeps) {
        let at = half.study.speeds_rpm.iter().position(|s| *s == 1600.0).expect("a speed of the study");
        let named = |of: Swept| sweep.quantities.iter().find(|q| q.of == of).map(|q| q.total[at]);
        assert_close(d.points[0].twist.to_degrees(), named(Swept::Twist).expect("twist"), 1e-12, 0.0, "twist");
        assert_close(d.points[0].power, named(Swept::DissipatedPower).unwrap_or(0.0), 1e-12, 0.0, "power");
        assert_close(d.mean_power(), 0.75 * d.points[0].power + 0.25 * d.points[1].power, 1e-14, 0.0, "mean power");
    }
}

/// Measured traces between two loads are those between them; a load that was not measured is refused.
#[test]
fn measured_maps_are_linear_in_load() {
    let folder = tempfile::tempdir().expect("folder");
    let bad = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_input");
    let engine = fs::read_to_string(bad.join("engine.toml")).expect("engine");
    let (start, end) = (engine.find("[pressure.wiebe]").expect("pressure"), engine.find("[[station]]").expect("station"));
    let engine = format!("{}[pressure.measured]\nfile = \"map.csv\"\n{}", &engine[..start], &engine[end..]);
    fs::write(folder.path().join("engine.toml"), engine).expect("written");
    let pressure = |deg: f64, peak: f64| 1.0 + peak * (0.5 + 0.5 * deg.to_radians().cos()).powi(20);
    let rows: String = (0..144)
        .map(|i| f64::from(i) * 5.0)
        .map(|d| format!("{d},{},{},{},{}\n", pressure(d, 40.0), pressure(d, 60.0), pressure(d, 10.0), pressure(d, 20.0)))
        .collect();
    let header = "crank_deg,1000_rpm_bar,4000_rpm_bar,1000_rpm_20_percent_bar,4000_rpm_20_percent_bar\n";
    fs::write(folder.path().join("map.csv"), format!("{header}{rows}")).expect("written");
    let text = fs::read_to_string(bad.join("study.toml")).expect("study");
    let at = |load: &str| {
        Study::from_toml(&text.replace("order_limit = 6", &format!("order_limit = 6\n{load}")), folder.path().join("study.toml"))
    };
    let torque = |load: &str| {
        let study = at(load).unwrap_or_else(|e| panic!("{e}"));
        Excitation::new(&study.engine, 6.0).unit_torque(1, 2500.0)
    };
    let (full, low, between) = (torque(""), torque("load_fraction = 0.2"), torque("load_fraction = 0.6"));
    assert!((full - low).norm() > 1.0);
    assert_close((0.5 * (full + low) - between).norm(), 0.0, 0.0, 1e-9 * full.norm(), "halfway between the loads measured");
    let refused = at("load_fraction = 0.1").expect_err("below the lowest load").to_string();
    assert!(refused.contains("outside those of the measured traces"), "{refused}");
}

/// `reciprocating_inertia = "mean"` adds half of m r² for each cylinder of a throw: oscillating mass 2 + 2/3 kg (0.333 of the rod), radius 62 mm.
#[test]
fn mean_reciprocating_inertia_is_half_m_r_squared() {
    let (with, without) = (study("villalva_i6"), study("villalva_i6_thesis"));
    let each = 0.5 * (2.0 + 0.333 * 2.0) * 0.062 * 0.062;
    for (a, b) in with.chain.stations.iter().zip(&without.chain.stations) {
        assert_close(a.inertia - b.inertia, each * a.throws.len() as f64, 1e-9, 1e-15, &a.name);
    }
    let (a, b) = (study("villalva_v10"), study("villalva_v10_thesis"));
    let each = 0.5 * (0.43 + 0.333 * 0.56) * 0.0464 * 0.0464;
    assert_close(a.chain.total_inertia() - b.chain.total_inertia(), 10.0 * each, 1e-9, 0.0, "ten cylinders");
}

/// Fatigue takes the work of the brake curve: the shaft at the flywheel carries 530 N m at 6500 rpm, though the excitation is scaled to 0.75 of it.
#[test]
fn the_crank_bears_the_brake_torque() {
    let study = study("villalva_v10");
    let excited = Excitation::new(&study.engine, 12.0).audit[6];
    let borne = Excitation::new(study.engine_of_crank(), 12.0).audit[6];
    assert_close(excited.mean_torque, 0.75 * 530.0, 1e-4, 0.0, "excitation");
    assert_close(borne.mean_torque, 530.0, 1e-4, 0.0, "crank");
}

/// A V6 of 60° fires evenly where its pins are split by 60°: every throw then has its cylinders 120° apart. The torque orders of all throws together are those of
/// an even six: multiples of three only.
#[test]
fn split_pins_make_a_v_fire_evenly() {
    let bad = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_input");
    let engine = fs::read_to_string(bad.join("engine.toml")).expect("engine");
    let (start, end) = (engine.find("[layout.in_line]").expect("layout"), engine.find("[pressure.wiebe]").expect("pressure"));
    let study = fs::read_to_string(bad.join("study.toml")).expect("study");
    let folder = tempfile::tempdir().expect("folder");
    let with = |layout: &str| {
        let text = format!("{}{layout}\n{}", &engine[..start], &engine[end..]).replace("throws = [1, 2]", "throws = [1, 2, 3]");
        fs::write(folder.path().join("engine.toml"), text).expect("written");
        Study::from_toml(&study, folder.path().join("study.toml")).map_err(|e| e.to_string())
    };
    let order = "firing_order = [1, 2, 3, 4, 5, 6]\nfiring_deg = [0, 120, 240, 360, 480, 600]";
    let even = with(&format!("[layout.v]\nbank_angle_deg = 60\nsplit_pin_deg = 60\n{order}")).unwrap_or_else(|e| panic!("{e}"));
    let e = Excitation::new(&even.engine, 6.0);
    let whole = |n: usize| (0..3).map(|t| e.throw_torque(t, n, 2000.0)).sum::<hartog::numerics::C64>().norm();
    let largest = (0..e.orders.len()).map(whole).fold(0.0, f64::max);
    for n in 0..e.orders.len() {
        let is_third = (e.orders[n].value() / 3.0).fract() == 0.0;
        assert_eq!(whole(n) > 1e-9 * largest, is_third, "order {}", e.orders[n]);
    }
    let refused = with(&format!("[layout.v]\nbank_angle_deg = 60\n{order}")).expect_err("one pin");
    assert!(refused.contains("expected 60 degrees between them"), "{refused}");
}

/// Opposed cylinders on throws half a turn apart: inertia forces of a pair cancel at every angle, what is left of a flat twin is its moment.
#[test]
fn opposed_pistons_cancel() {
    use hartog::analysis::Silent;
    use hartog::analysis::curves::curves;
    let bad = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_input");
    let engine = fs::read_to_string(bad.join("engine.toml")).expect("engine").replace("[layout.in_line]", "[layout.opposed]");
    let study = fs::read_to_string(bad.join("study.toml")).expect("study");
    let folder = tempfile::tempdir().expect("folder");
    fs::write(folder.path().join("engine.toml"), engine).expect("written");
    let study = Study::from_toml(&study, folder.path().join("study.toml")).unwrap_or_else(|e| panic!("{e}"));
    let found = curves(&study, &[3000.0], &Silent).expect("curves");
    let balance = found.figures.iter().find(|f| f.name == "balance").expect("balance");
    assert!(balance.panels[0].curves.iter().flat_map(|c| &c.points).all(|p| p.1 == 0.0), "a flat twin has no free force");
}

/// The gas of one cylinder as harmonics, its masses from the geometry: the same torque as the whole cylinder, at tabulated speeds to rounding and between
/// them, where both are linear in the gas.
#[test]
fn gas_harmonics_with_masses_are_the_cylinder() {
    let bad = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_input");
    let text = fs::read_to_string(bad.join("study.toml")).expect("study");
    let engine = fs::read_to_string(bad.join("engine.toml")).expect("engine").replace("[10, 10]", "[10, 6]");
    let folder = tempfile::tempdir().expect("folder");
    let with = |engine: &str| {
        fs::write(folder.path().join("engine.toml"), engine).expect("written");
        Study::from_toml(&text, folder.path().join("study.toml")).map_err(|e| e.to_string())
    };
    let cylinder = Excitation::new(&with(&engine).unwrap_or_else(|e| panic!("{e}")).engine, 6.0);
    let massless = engine.replace("piston_mass_kg = 0.5", "piston_mass_kg = 0").replace("rod_mass_kg = 0.6", "rod_mass_kg = 0");
    let gas = Excitation::new(&with(&massless).unwrap_or_else(|e| panic!("{e}")).engine, 6.0);
    let rows: String = [1000.0, 4000.0]
        .iter()
        .flat_map(|speed| (0..gas.orders.len()).map(|n| (*speed, n)).collect::<Vec<_>>())
        .map(|(speed, n)| {
            let c = gas.unit_torque(n, speed);
            format!("{speed},{},{:e},{:e}\n", gas.orders[n].value(), c.norm(), c.arg().to_degrees())
        })
        .collect();
    fs::write(folder.path().join("gas.csv"), format!("speed_rpm,order,amplitude_n_m,phase_deg\n{rows}")).expect("written");
    let (start, end) = (engine.find("[pressure.wiebe]").expect("pressure"), engine.find("[[station]]").expect("station"));
    let of = |keys: &str| format!("{}[pressure.harmonics]\nfile = \"gas.csv\"\n{keys}{}", &engine[..start], &engine[end..]);
    let table = Excitation::new(&with(&of("torque = \"gas\"\n")).unwrap_or_else(|e| panic!("{e}")).engine, 6.0);
    assert_eq!(table.orders, cylinder.orders);
    for n in 0..table.orders.len() {
        for speed in [1000.0, 2200.0, 4000.0] {
            let (a, b) = (table.throw_torque(0, n, speed), cylinder.throw_torque(0, n, speed));
            assert_close(
                (a - b).norm(),
                0.0,
                0.0,
                1e-9 * cylinder.unit_torque(1, 4000.0).norm(),
                &format!("order {} at {speed} rpm", table.orders[n]),
            );
        }
    }
    let whole = with(&of("")).expect_err("a whole throw beside masses");
    assert!(whole.contains("`torque = \"gas\"` in [pressure.harmonics]"), "{whole}");
}

/// An engine whose torque is known over a part of the speeds of its study, and what `check` warns of.
fn known_in_part(pressure: &str, tables: &[(&str, String)], more: &str, (from, to): (f64, f64)) -> (Study, String) {
    let place = tempfile::tempdir().expect("a folder");
    let engine = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_input/engine.toml")).expect("engine");
    let (cycle, stations) = (engine.find("[pressure.wiebe]").expect("a cycle"), engine.find("[[station]]").expect("stations"));
    let mut engine = format!("{}{pressure}\n{}", &engine[..cycle], &engine[stations..]);
    if pressure.contains("harmonics") {
        let geometry = engine.find("[geometry]").expect("a geometry")..engine.find("[layout").expect("a layout");
        engine.replace_range(geometry, "");
    }
    let study =
        format!("engine = \"engine.toml\"\nspeed_rpm = {{ from = {from}, to = {to}, step = 50 }}\n{more}\n[[design]]\nname = \"none\"\n");
    for (name, text) in tables.iter().map(|t| (t.0, &t.1)).chain([("engine.toml", &engine), ("study.toml", &study)]) {
        fs::write(place.path().join(name), text).expect("written");
    }
    let path = place.path().join("study.toml");
    let check = crate::support::hartog().args(["check", &path.to_string_lossy()]).output().expect("run");
    // lines are broken at a hundred columns
    let told = String::from_utf8_lossy(&check.stdout).split_whitespace().collect::<Vec<_>>().join(" ");
    (hartog::input::read(&path).unwrap_or_else(|e| panic!("{e}")), told)
}

/// Torque beyond the speeds at which it is known is that at the nearest of them, as it is of one trace at every speed; inertia torque stays exact. Law, to the last digits: every order of an engine with two
/// traces is, below and above both, that of the engine with one of them alone, and so are its loads on the throws; harmonics stay those of the nearest row; a curve of torque, power or mean pressure
/// stays that of its end. `check` says which speeds. At 19b2337 these studies are refused. Speeds that meet none of those known are refused as before.
#[test]
fn torque_is_held_beyond_the_speeds_it_is_known_at() {
    let (low, high) = (1500.0, 2500.0);
    let trace = |columns: &[(f64, f64)]| {
        let heads: String = columns.iter().map(|c| format!(",{}_rpm_bar", c.0)).collect();
        let row = |i: u32| -> String { columns.iter().map(|c| format!(",{}", 1.0 + c.1 / f64::from(1 + i.min(48 - i)))).collect() };
        ("p.csv", format!("crank_deg{heads}\n{}", (0..48).map(|i| format!("{}{}\n", 15 * i, row(i))).collect::<String>()))
    };
    let measured = "[pressure.measured]\nfile = \"p.csv\"";
    let speeds = (1000.0, 4000.0);
    let (both, told) = known_in_part(measured, &[trace(&[(low, 30.0), (high, 60.0)])], "", speeds);
    let words = "warning: the pressure is known from 1500 to 2500 rpm only: from 1000 to 1500 rpm it is taken as at 1500 rpm, from 2500 to 4000 rpm as at 2500 rpm";
    assert!(told.contains(&words.replace("as at 2500", "it is taken as at 2500")), "{told}");
    for (own, beyond) in [((low, 30.0), 1000.0), ((high, 60.0), 4000.0)] {
        let (one, told) = known_in_part(measured, &[trace(&[own])], "", speeds);
        assert!(told.contains(&format!("the pressure is known at {} rpm only", own.0)), "{told}");
        let [a, b] = [&both, &one].map(|s| Excitation::new(&s.engine, 12.0));
        for o in 0..a.orders.len() {
            let (a, b) = (a.unit_torque(o, beyond), b.unit_torque(o, beyond));
            assert!((a - b).norm() <= 1e-12 * b.norm(), "order {o}: {a} {b}");
        }
        let [a, b] = [&both, &one].map(|s| hartog::engine::cycle::throw_loads(&s.engine, beyond).expect("a cylinder"));
        for (a, b) in a.torque.iter().flatten().zip(b.torque.iter().flatten()) {
            assert_close(*a, *b, 1e-10, 1e-8, "torque on a throw");
        }
    }
    let rows = "order,amplitude_n_m,phase_deg,speed_rpm\n0.5,300,10,1500\n1,100,20,1500\n0.5,400,30,2500\n1,150,40,2500\n".to_owned();
    let (harmonics, told) = known_in_part("[pressure.harmonics]\nfile = \"h.csv\"", &[("h.csv", rows)], "", (1000.0, 2500.0));
    assert!(told.contains("the torque is known from 1500 to 2500 rpm only: from 1000 to 1500 rpm it is taken as at 1500 rpm"), "{told}");
    let excitation = Excitation::new(&harmonics.engine, 12.0);
    assert_eq!(excitation.unit_torque(0, 1000.0), excitation.unit_torque(0, 1500.0));
    let rows = "order,amplitude_n_m,phase_deg,speed_rpm\n0.5,300,10,1500\n".to_owned();
    let (_, told) = known_in_part("[pressure.harmonics]\nfile = \"h.csv\"", &[("h.csv", rows)], "", (1000.0, 2500.0));
    assert!(told.contains("the torque is known at 1500 rpm only"), "{told}");
    for curve in ["torque_n_m = [100, 200]", "power_kw = [15, 50]"] {
        let pressure = format!("[pressure.otto]\nspeed_rpm = [1500, 2500]\ncurve.{curve}\ncompression_ratio = 10\npressure_scale = 1.2");
        let (otto, told) = known_in_part(&pressure, &[], "", speeds);
        assert!(told.contains("the curve of torque, power or mean pressure is known from 1500 to 2500 rpm only"), "{told}");
        let mut still = otto.engine.clone();
        if let hartog::engine::Source::Cylinder { geometry, .. } = &mut still.source {
            (geometry.piston_mass, geometry.rod_mass) = (0.0, 0.0);
        }
        let excitation = Excitation::new(&still, 12.0);
        for (beyond, end) in [(1000.0, 1500.0), (4000.0, 2500.0)] {
            let (a, b) = (excitation.unit_torque(0, beyond), excitation.unit_torque(0, end));
            assert!((a - b).norm() <= 1e-12 * b.norm(), "{curve} at {beyond} rpm: {a} {b}");
        }
    }
}

/// A load that varies over speed does so beyond the speeds of the curve, too: the mean pressure there is that of its end times the share there (linear between the corners of both; the cycle closes its
/// area to 1e-6). At 19b2337 a curve of one speed took the share at that speed for all.
#[test]
fn load_varies_beyond_the_curve() {
    let wiebe = |speeds: &str, bar: &str| {
        format!(
            "[pressure.wiebe]\nspeed_rpm = {speeds}\nindicated_mean_pressure_bar = {bar}\nboost_bar = 1\ncompression_ratio = 10\nburn_start_deg = -10\nburn_duration_deg = 60"
        )
    };
    let load = "part_load = { speed_rpm = [1000, 2000], fraction = [0.5, 1] }";
    for (speeds, bar, expected) in [
        ("[2000, 3000]", "[10, 8]", vec![(1200.0, 6.0), (2000.0, 10.0), (3000.0, 8.0)]),
        ("[1800]", "[10]", vec![(1200.0, 6.0), (1800.0, 9.0), (2000.0, 10.0), (3000.0, 10.0)]),
    ] {
        let (study, _) = known_in_part(&wiebe(speeds, bar), &[], load, (1200.0, 3000.0));
        let found = Excitation::new(&study.engine, 12.0).audit;
        assert_eq!(found.iter().map(|a| a.speed_rpm).collect::<Vec<_>>(), expected.iter().map(|e| e.0).collect::<Vec<_>>());
        for (found, (_, bar)) in found.iter().zip(expected) {
            assert_close(found.indicated_mean_pressure / 1e5, bar, 1e-5, 0.0, "mean pressure");
        }
    }
}
