//! Slider-crank sizing: tendencies of random engines, and the command as a user runs it.

use crate::sizing::two_stroke;
use crate::support::assert_close;
use hartog::engine::Pressure;
use hartog::engine::pressure::Measured;
use hartog::fatigue::endurance::Surface;
use hartog::input::read_sizing;
use hartog::sizing::{Material, Sizes, SizingError, Specification, size};
use std::path::Path;

/// A number from a counter, 0 to 1, the same on every machine.
fn draw(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1u64 << 53) as f64
}

/// A random engine: all proportions, loads and materials within what is built.
fn random(seed: &mut u64) -> Specification {
    let mut spec = read_sizing(Path::new("studies/fialho_four.toml")).expect("a sizing file").specification;
    let mut between = |low: f64, high: f64| low + (high - low) * draw(seed);
    spec.stroke = between(0.03, 0.3);
    spec.bore = spec.stroke * between(0.6, 1.5);
    spec.rod_length = 0.5 * spec.stroke / between(0.2, 0.34);
    spec.piston_mass = between(30.0, 120.0) * spec.bore.powi(2);
    // a mean piston speed up to 18 m/s
    let top = 30.0 * between(4.0, 18.0) / spec.stroke;
    spec.speeds_rpm = vec![1e-3 * top, top];
    spec.design_factor = between(1.0, 3.0);
    spec.buckling_factor = between(2.0, 6.0);
    spec.liner_friction = if between(0.0, 1.0) < 0.5 { 0.0 } else { between(0.0, 0.2) };
    spec.fillet_radius = spec.stroke * between(0.02, 0.08);
    spec.clearance = spec.stroke * 1e-3;
    let span = spec.bore * between(0.6, 1.4);
    spec.bearings.before = span * between(0.7, 1.3);
    spec.bearings.after = span;
    spec.bearings.flywheel_weight = 1e5 * spec.bore.powi(2);
    let tensile = between(500e6, 1300e6);
    for material in [&mut spec.pin, &mut spec.rod, &mut spec.crank] {
        *material = Material {
            tensile,
            yield_strength: tensile * 0.75,
            shear_yield: tensile * 0.45,
            surface: if between(0.0, 1.0) < 0.5 { Surface::Machined } else { Surface::Forged },
            ..*material
        };
    }
    let throws = 1 + (between(0.0, 8.0) as usize);
    spec.firing_deg = (0..throws).map(|i| 360.0 * (i * 3 % throws.max(1)) as f64 / throws as f64).collect();
    (spec.given.small_eye_ratio, spec.given.big_eye_ratio) = (None, None);
    spec
}

/// Pressures above the crankcase's times a factor.
fn stronger(spec: &Specification, factor: f64) -> Specification {
    let Pressure::Measured(m) = &spec.pressure else { panic!("a table") };
    let crankcase = spec.crankcase_pressure;
    let pressure = m.pressure.iter().map(|t| t.iter().map(|p| crankcase + factor * (p - crankcase)).collect()).collect();
    Specification { pressure: Pressure::Measured(Measured { pressure, ..m.clone() }), ..spec.clone() }
}

/// What a random engine is, without its table.
fn print(spec: &Specification) -> String {
    let mut shown = spec.clone();
    if let Pressure::Measured(m) = &mut shown.pressure {
        (m.crank_deg, m.pressure) = (Vec::new(), Vec::new());
    }
    format!("{shown:?}")
}

/// How much thinner a part gets, relative; nothing where it gets thicker.
fn thinner(a: f64, b: f64) -> f64 {
    ((a - b) / a).max(0.0)
}

/// Sizes with more pressure, more speed (the lowest stays) or a larger factor, each by 7 %; nothing where there are none.
fn with_more(spec: &Specification) -> [Option<Sizes>; 3] {
    let factors = (1.07 * spec.design_factor, 1.07 * spec.buckling_factor);
    let more = [
        stronger(spec, 1.07),
        Specification { speeds_rpm: vec![spec.speeds_rpm[0], 1.07 * spec.speeds_rpm[1]], ..spec.clone() },
        Specification { design_factor: factors.0, buckling_factor: factors.1, ..spec.clone() },
    ];
    more.map(|spec| size(&spec).ok().map(|sized| sized.last().sizes))
}

/// Theory: with more pressure, more speed or a larger design factor a part gets no thinner under the masses and arms that it has: the pin always; the shank where pins and eyes are held; eyes
/// where their bores and width are; seat, journal and web where the rod and what sets the arms are. To 1e-6, and to 1e-3 with friction, which is not linear in the forces. Left to itself a rod
/// that gets heavier may relieve the crankpin, whose smaller eye relieves the rod in turn, and a wider one has thinner eyes and brings the journal nearer to its bearing: by how much is printed
/// and bounded. Whatever does not converge says why by name.
fn tendencies(count: usize) {
    let mut seed = 7;
    let (mut converged, mut named, mut free) = (0, 0, [0.0f64; 5]);
    for _ in 0..count {
        let spec = random(&mut seed);
        let sized = match size(&spec) {
            Ok(sized) => sized,
            Err(SizingError::NoRoom { .. } | SizingError::Web { .. } | SizingError::Eye { .. } | SizingError::DoesNotFit(_)) => {
                named += 1;
                continue;
            }
            Err(other) => panic!("{other}: {}", print(&spec)),
        };
        converged += 1;
        let a = sized.last().sizes;
        let tolerance = if spec.liner_friction == 0.0 { 1e-6 } else { 1e-3 };
        let not_thinner = |name: &str, a: f64, b: f64| {
            assert!(thinner(a, b) < tolerance, "the {name} goes from {a} to {b}: {}", print(&spec));
        };
        for b in with_more(&spec).into_iter().flatten() {
            not_thinner("pin", a.pin_diameter, b.pin_diameter);
            let pairs = [
                (a.shank_thickness, b.shank_thickness),
                (a.crankpin_diameter, b.crankpin_diameter),
                (a.seat_diameter, b.seat_diameter),
                (a.journal_diameter, b.journal_diameter),
                (a.web_breadth, b.web_breadth),
            ];
            free.iter_mut().zip(pairs).for_each(|(worst, (a, b))| *worst = worst.max(thinner(a, b)));
        }
        let mut shank = spec.clone();
        shank.given.pin_diameter = Some(a.pin_diameter);
        shank.given.crankpin_diameter = Some(a.crankpin_diameter);
        shank.given.small_eye_ratio = Some(a.small_eye_diameter / a.small_eye_bore);
        shank.given.big_eye_ratio = Some(a.big_eye_diameter / a.big_eye_bore);
        for b in with_more(&shank).into_iter().flatten() {
            not_thinner("shank", a.shank_thickness, b.shank_thickness);
        }
        let mut eyes = spec.clone();
        eyes.given.pin_diameter = Some(a.pin_diameter);
        eyes.given.shank_thickness = Some(a.shank_thickness);
        eyes.given.crankpin_diameter = Some(a.crankpin_diameter);
        for b in with_more(&eyes).into_iter().flatten() {
            not_thinner("small eye", a.small_eye_diameter, b.small_eye_diameter);
            not_thinner("big eye", a.big_eye_diameter, b.big_eye_diameter);
        }
        // the rod as it is: its eyes, too
        let mut crank = eyes.clone();
        crank.given.small_eye_ratio = Some(a.small_eye_diameter / a.small_eye_bore);
        crank.given.big_eye_ratio = Some(a.big_eye_diameter / a.big_eye_bore);
        crank.given.crankpin_length = Some(a.crankpin_length);
        crank.given.web_thickness = Some(a.web_thickness);
        let held = size(&crank).expect("what is held holds").last().sizes;
        for b in with_more(&crank).into_iter().flatten() {
            not_thinner("journal", held.journal_diameter, b.journal_diameter);
            not_thinner("web", held.web_breadth, b.web_breadth);
            not_thinner("seat", held.seat_diameter, b.seat_diameter);
        }
    }
    assert!(2 * converged > count, "{converged} of {count} converge, {named} have no room");
    assert!(free.iter().all(|worst| *worst < 0.1), "{free:?}");
    println!(
        "{converged} of {count} converge, {named} are refused by name; left free, shank, crankpin, seat, journal and web get thinner by at most {free:?}"
    );
}

#[test]
fn tendencies_of_five_engines() {
    tendencies(5);
}

/// The same for a thousand.
#[test]
#[ignore = "about five minutes"]
fn tendencies_of_a_thousand_engines() {
    tendencies(1000);
}

fn hartog() -> assert_cmd::Command {
    let mut c = assert_cmd::Command::cargo_bin("hartog").expect("built");
    c.current_dir(env!("CARGO_MANIFEST_DIR"));
    c
}

/// The two commands chain: what `size` writes is a study that `run` takes, with the masses that were sized; every file is the same at 1 and 2 threads.
#[test]
fn size_then_run() {
    let folder = tempfile::tempdir().expect("folder");
    let place = |name: &str| folder.path().join(name);
    for threads in ["1", "2"] {
        hartog().args(["size", "studies/fialho_two_stroke.toml", "--threads", threads, "--out"]).arg(place(threads)).assert().code(0);
    }
    let names: Vec<_> = std::fs::read_dir(place("1")).expect("folder").map(|e| e.expect("file").file_name()).collect();
    for name in ["sizing.csv", "sizing_comparison.csv", "drawing.svg", "drawing.png", "engine.toml", "study.toml", "pressure.csv"] {
        assert!(names.iter().any(|n| n == name), "{name}");
    }
    for name in names {
        let read = |threads: &str| std::fs::read(place(threads).join(&name)).expect("a file");
        assert!(read("1") == read("2"), "{name:?}");
    }
    let study = hartog::Study::read(place("1").join("study.toml")).expect("a study");
    let sized = size(&two_stroke().specification).expect("sizes");
    let (round, spec) = (sized.last(), two_stroke().specification);
    // the throw about the axis, what of the rod turns with it, and half of m r² of what moves to and fro
    let turning = round.rod.mass * (1.0 - round.rod.centre / spec.rod_length);
    let moving = spec.piston_mass + round.rod.mass - turning;
    let expected = round.throw.inertia_at_reference + (turning + 0.5 * moving) * spec.crank_radius().powi(2);
    assert_close(study.chain.stations[1].inertia, expected, 1e-9, 0.0, "inertia of the throw");
    hartog().args(["run"]).arg(place("1").join("study.toml")).arg("--out").arg(place("run")).assert().code(0);
}

/// A dimension that is given and does not hold is said, with exit code 1; unusual proportions are warned of with the reason.
#[test]
fn given_too_thin_and_unusual() {
    let folder = tempfile::tempdir().expect("folder");
    let text = std::fs::read_to_string("tests/bad_input/sizing.toml").expect("a file");
    let text =
        text.replace("[chain]", "[given]\ncrankpin_diameter_mm = 12\n\n[chain]").replace("crank_to_rod = 0.33", "crank_to_rod = 0.45");
    let file = folder.path().join("thin.toml");
    std::fs::write(&file, text).expect("written");
    let output = hartog().arg("size").arg(&file).arg("--out").arg(folder.path().join("out")).output().expect("run");
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("FAILS: with the dimensions given, crankpin is short of the factor."), "{said}");
    assert!(said.contains("the ratio of crank radius to rod length of 0.450 is outside 0.200 to 0.333"), "{said}");
}

/// The same engine from its displacement, or from its power: V = P/(p f) with f cycles a second.
#[test]
fn stroke_displacement_and_power() {
    let folder = tempfile::tempdir().expect("folder");
    let text = std::fs::read_to_string("tests/bad_input/sizing.toml").expect("a file");
    let with = |basis: &str| {
        let file = folder.path().join("basis.toml");
        std::fs::write(&file, text.replace("basis.stroke_mm = 38.4", basis)).expect("written");
        read_sizing(&file).expect("a sizing file").specification.stroke
    };
    let stroke = with("basis.stroke_mm = 38.4");
    let volume = 4.0 * std::f64::consts::FRAC_PI_4 * (1.53f64 * 0.0384).powi(2) * 0.0384;
    assert_close(with(&format!("basis.displacement_cm3 = {}", 1e6 * volume)), stroke, 1e-12, 0.0, "displacement");
    let power = 5e5 * volume * 100.0;
    let basis = format!("basis.power = {{ power_kw = {}, mean_effective_pressure_bar = 5 }}", power / 1e3);
    assert_close(with(&basis), stroke, 1e-12, 0.0, "power at 6000 rpm, two strokes");
}

/// Theory: a crank sized by the response of its chain is one that agrees with it: the chain that is written has the torque that sized the crank. An absorber that halves the vibratory torque
/// makes the crank lighter, a larger ring at least nearly as light; every crank has the same factor.
#[test]
fn a_crank_and_its_absorber() {
    let mut study = read_sizing(Path::new("studies/fialho_four.toml")).expect("a sizing file");
    study.front = vec![2e-4, 2e-3];
    study.speeds_rpm = study.speeds_rpm.into_iter().step_by(20).filter(|s| *s >= 4500.0).collect();
    study.speed_step_rpm *= 20.0;
    study.by_response = true;
    let results = hartog::analysis::sizing::run(&study, &hartog::analysis::Silent).expect("sizes");
    for m in &results.sized.last().margins {
        assert!(m.yielding.min(m.fatigue) >= study.specification.design_factor * (1.0 - 1e-9), "{}", m.section);
    }
    let [none, small, large] = results.front.as_slice() else { panic!("three points") };
    assert!(small.response.torque < 0.65 * none.response.torque, "{} {}", small.response.torque, none.response.torque);
    assert!(small.crank_mass < 0.85 * none.crank_mass && large.crank_mass < 1.01 * small.crank_mass);
    let by_response = results.by_response.expect("by response");
    let folder = tempfile::tempdir().expect("folder");
    for (name, text) in [("engine.toml", &results.files.engine), ("study.toml", &results.files.study)] {
        std::fs::write(folder.path().join(name), text).expect("written");
    }
    std::fs::write(folder.path().join("pressure.csv"), results.files.pressure.expect("a table")).expect("written");
    let written = hartog::Study::read(folder.path().join("study.toml")).expect("a study");
    let again = written.run().expect("damped");
    let best = again.optima.iter().find(|o| o.main).expect("an optimum");
    assert_close(best.design.torque.expect("shafts").value, by_response.torque, 1e-4, 0.0, "the same torque again");
    assert_close(best.design.twist.expect("shafts").value, by_response.twist, 1e-4, 0.0, "the same twist again");
}

/// Theory: far below every resonance a chain responds like a rigid crank: its sizes are those of the crank rigid in torsion, every order of the torque counted once (10 rpm, a flywheel that does not yield), to what samples a
/// degree apart can tell of the highest orders, 3e-4.
#[test]
fn a_slow_chain_is_a_rigid_crank() {
    let mut study = read_sizing(Path::new("studies/fialho_four.toml")).expect("a sizing file");
    (study.front, study.absorber) = (Vec::new(), None);
    (study.chain.pulley_inertia, study.chain.flywheel_inertia) = (1e-6, 1e3);
    study.speeds_rpm = vec![10.0];
    study.specification.speeds_rpm = vec![10.0];
    let by_response = hartog::analysis::sizing::run(&study, &hartog::analysis::Silent).expect("sizes").sized.last().sizes;
    let rigid = size(&study.specification).expect("sizes").last().sizes;
    for ((name, a), (_, b)) in by_response.named().iter().zip(rigid.named()) {
        assert_close(*a, b, 3e-4, 0.0, name);
    }
}

/// What one part needs and another does not leave room for is named, and what is written is what `hartog run` takes, or nothing is.
#[test]
fn parts_that_do_not_go_together() {
    let folder = tempfile::tempdir().expect("folder");
    let text = std::fs::read_to_string("tests/bad_input/sizing.toml").expect("a file");
    for (given, words) in [
        ("small_eye_ratio = 4", "for the small eye, expected less than the bore"),
        ("pin_diameter_mm = 80", "found 80.00 mm for the piston pin, expected less than the bore, 58.75 mm"),
        ("shank_thickness_mm = 6\ncrankpin_length_mm = 10", "the width of the rod"),
        ("web_breadth_mm = 20", "the breadth of the web"),
    ] {
        let file = folder.path().join("parts.toml");
        std::fs::write(&file, text.replace("[chain]", &format!("[given]\n{given}\n\n[chain]"))).expect("written");
        let output = hartog().arg("size").arg(&file).arg("--out").arg(folder.path().join("out")).output().expect("run");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{given}: {said}");
        assert!(said.contains(words), "{given}: {said}");
    }
    let file = folder.path().join("formula.toml");
    std::fs::write(&file, text.replace("ker_wilson", "bracket")).expect("written");
    let output = hartog().arg("size").arg(&file).arg("--out").arg(folder.path().join("out")).output().expect("run");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.code() == Some(2) && said.contains("makes no study for `hartog run`: found `bracket`"), "{said}");
}
