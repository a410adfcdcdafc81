//! What a run tells while it is at work, and how much it tells of what is wrong.

use crate::margin::short;
use crate::support::{hartog, study};
use hartog::analysis::{Progress, run};
use hartog::cli::progress::left;
use hartog::input::Study;
use std::sync::Mutex;
use std::time::Duration;

/// Stages with the steps that they announce, and those that are done.
#[derive(Default)]
struct Told(Mutex<Vec<(String, usize, usize)>>);

impl Progress for Told {
    fn stage(&self, name: &str, steps: usize) {
        self.0.lock().expect("told").push((name.to_owned(), steps, 0));
    }
    fn step(&self) {
        if let Some(last) = self.0.lock().expect("told").last_mut() {
            last.2 += 1;
        }
    }
}

/// Steps of a stage of a run, as announced and as done.
fn steps(of: &Study, names: &[&str]) -> Vec<(usize, usize)> {
    let told = Told::default();
    run(of, &told).expect("finite");
    let all = told.0.into_inner().expect("told");
    let found = |name: &&str| all.iter().find(|s| s.0 == *name).map(|s| (s.1, s.2)).unwrap_or_else(|| panic!("no stage {name} in {all:?}"));
    names.iter().map(found).collect()
}

/// Margins, catalogues and screens have stages of their own, each with as many steps as it announces: a speed a step of margins, an absorber of a catalogue, a family of a screen.
#[test]
fn long_stages_tell_their_steps() {
    let of = short("villalva_i6_thesis");
    let all = of.designs.len() * (1 + of.speeds_rpm.len());
    assert_eq!(steps(&of, &["loads of the crank", "response and margins"]), [(1, 1), (all, all)]);
    let of = short("villalva_i6_oils");
    let sold = of.catalogues.iter().map(|c| c.designs.len()).sum();
    assert_eq!(steps(&of, &["catalogue", "response over speed"])[0], (sold, sold));
    assert_eq!(steps(&study("den_hartog"), &["screens of random designs"]), [(2, 2)], "tuned and viscous");
}

/// Before the first step nothing is known of the time left, and nothing is said of it.
#[test]
fn no_time_is_left_before_the_first_step() {
    assert_eq!(left(0, Duration::ZERO), "");
    assert_eq!(left(0, Duration::from_secs(5)), "");
    let later = left(1, Duration::from_secs(40));
    assert!(later.starts_with(", 40") && later.ends_with(" left"), "{later}");
}

/// Of very many mistakes the first twenty are told, and how many more there are; a file of a hundred thousand is no reason to read it line by line for each.
#[test]
fn many_mistakes_are_counted() {
    let folder = tempfile::tempdir().expect("folder");
    let engine = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/bad_input/engine.toml")).expect("an engine");
    std::fs::write(folder.path().join("engine.toml"), engine).expect("written");
    let base = "engine = \"engine.toml\"\nspeed_rpm = { from = 1000, to = 4000, step = 50 }\norder_limit = 6\n";
    let path = folder.path().join("study.toml").to_string_lossy().into_owned();
    for (count, told) in [(20, None), (21, Some("and 1 more mistake")), (1500, Some("and 1480 more mistakes"))] {
        let design = |i: usize| {
            format!(
                "[[design]]\nname = \"d{i}\"\nabsorber = [{{ on.station = \"hub\", type.viscous = {{ ring_inertia_kg_m2 = -1, damping_n_m_s_per_rad = 1 }} }}]\n"
            )
        };
        std::fs::write(&path, base.to_owned() + &(0..count).map(design).collect::<String>()).expect("written");
        let output = hartog().args(["check", &path]).output().expect("runs");
        assert_eq!(output.status.code(), Some(2));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(said.matches("found -1, expected").count(), 20, "{said}");
        assert_eq!(said.lines().last().filter(|l| l.starts_with("and ")), told, "{said}");
    }
}
