//! Studies that a program builds without files.

use crate::support::{assert_close, study};
use hartog::absorber::TUNED;
use hartog::input::Size;
use hartog::{PartsError, Study};
use std::path::Path;
use std::process::Command;

/// Engine and chain of a study that was read, put together again.
fn again(name: &str) -> Result<Study, PartsError> {
    let read = study(name);
    Study::from_parts(read.engine, read.chain, read.speeds_rpm, read.order_limit)
}

/// Law: a study has no more in it than its parts. The optimum of the six's first ring, of a study from memory, is that of the file to rounding: twist from the pulley to the flywheel, wide bounds, four random starts.
#[test]
fn a_study_from_memory_is_that_of_the_file() {
    let mut file = study("villalva_i6");
    file.speeds_rpm = file.speeds_rpm.iter().copied().step_by(20).collect();
    file.order_limit = 6.0;
    let parts = Study::from_parts(file.engine.clone(), file.chain.clone(), file.speeds_rpm.clone(), file.order_limit).expect("parts");
    let memory = parts.with_search(file.hub, &TUNED, 0.076).expect("a station");
    assert_eq!(memory.objective, file.objective);
    let best = |s: &Study| s.run().expect("damped").optima.into_iter().find(|o| o.design.name == "optimum_tuned").expect("an optimum");
    file.front = None;
    let absorber = &mut file.optimise.as_mut().expect("optimises").absorbers[0];
    (absorber.types, absorber.size) = (vec![&TUNED], Size::Each(vec![0.076]));
    assert_close(best(&memory).optimum.value(), best(&file).optimum.value(), 1e-9, 0.0, "the same optimum");
}

/// What does not belong together is refused by name, and nothing panics.
#[test]
fn parts_that_do_not_belong_together() {
    let read = study("den_hartog");
    let with = |change: &dyn Fn(&mut Study)| {
        let mut s = read.clone();
        change(&mut s);
        Study::from_parts(s.engine, s.chain, s.speeds_rpm, s.order_limit).expect_err("refused").to_string()
    };
    assert!(with(&|s| s.chain.stations.clear()).contains("without stations"));
    assert!(with(&|s| s.chain.stations[0].inertia = f64::NAN).starts_with("station 0: found an inertia"));
    assert!(with(&|s| s.chain.stations[0].stiffness_to_next = 1.0).contains("expected nothing"));
    assert!(with(&|s| s.chain.stations[0].throws.clear()).contains("found 0 throws"));
    assert!(with(&|s| s.engine.strokes = 3).contains("2 or 4 strokes"));
    assert!(with(&|s| s.engine.layout.firing_deg.clear()).contains("firing angle"));
    assert!(with(&|s| s.speeds_rpm = vec![200.0, 100.0]).contains("ascending"));
    assert!(with(&|s| s.order_limit = f64::INFINITY).contains("order limit"));
    let other = again("den_hartog").expect("parts");
    assert_eq!(other.engine.source, read.engine.source);
    assert!(other.with_search(7, &TUNED, 0.1).expect_err("no station").to_string().contains("on station 7"));
    let given = hartog::absorber::types::TYPES.iter().find(|t| t.name == "hardening").expect("a type");
    let searched = again("den_hartog").expect("parts").with_search(0, given, 0.1).expect_err("of large twist");
    assert!(searched.to_string().contains("search for `hardening`"), "{searched}");
    let no_ring = again("den_hartog").expect("parts").with_search(0, &TUNED, 0.0).expect_err("no ring");
    assert!(no_ring.to_string().contains("ring of 0 kg m²"), "{no_ring}");
}

/// The library compiles without the program, and asks then for no crate of plots, Parquet or the command line.
#[test]
#[ignore = "two minutes: compiles the library again"]
fn the_library_alone() {
    let cargo = |arguments: &[&str]| {
        let mut c = Command::new(env!("CARGO"));
        let output = c.current_dir(env!("CARGO_MANIFEST_DIR")).args(arguments).output().expect("cargo");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    let tree = cargo(&["tree", "--offline", "--no-default-features", "--edges", "normal", "--prefix", "none"]);
    for absent in ["clap", "plotters", "parquet", "resvg", "pdf-writer", "maud", "indicatif", "heuropt"] {
        assert!(!tree.lines().any(|l| l.starts_with(&format!("{absent} v"))), "{absent}: {tree}");
    }
    let place = Path::new(env!("CARGO_TARGET_TMPDIR")).join("library");
    let place = place.to_string_lossy();
    cargo(&["check", "--offline", "--lib", "--examples", "--no-default-features", "--target-dir", &place]);
}
