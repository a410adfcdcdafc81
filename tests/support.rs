//! Shared by all tests: a binary may do without a part of it.
#![allow(dead_code, reason = "three binaries share it")]

use assert_cmd::Command;
use hartog::absorber::{Absorber, Mounted, Tuned, Undamped, Viscous};
use hartog::drivetrain::{Chain, Station, System};
use hartog::engine::HarmonicTable;
use hartog::engine::{Engine, Excitation, Layout, Order, Source};
use hartog::input::Study;
use hartog::numerics::C64;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// Fails unless |actual - expected| <= atol + rtol |expected|.
#[track_caller]
pub fn assert_close(actual: f64, expected: f64, rtol: f64, atol: f64, what: &str) {
    let error = (actual - expected).abs();
    assert!(error <= atol + rtol * expected.abs(), "{what}: {actual} against {expected}, off by {error:e}");
}

/// A shipped study.
pub fn study(name: &str) -> Study {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies").join(format!("{name}.toml"));
    hartog::input::read(&path).unwrap_or_else(|e| panic!("{e}"))
}

/// The system of a study.
pub fn system(study: &Study) -> System {
    System::new(study.chain.clone(), Excitation::new(&study.engine, study.order_limit))
}

/// Absorbers that tests name in one word.
#[derive(Debug, Clone, Copy)]
pub enum Kind {
    Tuned,
    Viscous,
    Undamped,
    Locked,
}

/// An absorber without hub on a station.
pub fn on(station: usize, kind: Kind, ring_inertia: f64, stiffness: f64, damping: f64) -> Mounted {
    let absorber = match kind {
        Kind::Tuned => Tuned { ring_inertia, stiffness, damping }.into(),
        Kind::Viscous => Viscous { ring_inertia, damping }.into(),
        Kind::Undamped => Undamped { ring_inertia, stiffness }.into(),
        Kind::Locked => Absorber::Locked { ring_inertia },
    };
    Mounted::on_station(station, absorber)
}

/// Ring inertia, stiffness and damping of an absorber with a constant law.
pub fn three_values(m: &Mounted) -> [f64; 3] {
    [m.absorber.ring_inertia(), m.absorber.stiffness().expect("a number"), m.absorber.damping().expect("a number")]
}

/// A chain of alike stations; the first carries throw 1.
pub fn uniform_chain(n: usize, inertia: f64, stiffness: f64) -> Chain {
    let station = |i: usize| Station {
        name: format!("s{i}"),
        inertia,
        stiffness_to_next: if i + 1 < n { stiffness } else { 0.0 },
        throws: if i == 0 { vec![0] } else { Vec::new() },
        ..Station::default()
    };
    Chain { stations: (0..n).map(station).collect() }
}

/// One throw under the given harmonics (twice the order, torque amplitude), two strokes.
pub fn one_throw(harmonics: &[(u32, f64)]) -> Excitation {
    let table = HarmonicTable {
        harmonics: harmonics.iter().map(|(o, a)| (Order::from_twice(*o), C64::from(*a))).collect(),
        ..HarmonicTable::default()
    };
    let layout = Layout { rods_per_throw: 1, firing_deg: vec![0.0], bank_angle_deg: None, split_pin_deg: 0.0 };
    Excitation::new(&Engine { name: "one throw".into(), strokes: 2, layout, source: Source::Harmonics(table) }, 200.0)
}

/// Largest amplitude of the exact optimum of Den Hartog's problem, in static deflections [Nishihara & Asami 2002]; for mu from 1e-4 (below,
/// the difference loses digits).
pub fn h_infinity_peak(mu: f64) -> f64 {
    let difference = (8.0 + 9.0 * mu).powi(2) * (16.0 + 9.0 * mu) - 128.0 * (4.0 + 3.0 * mu).powf(1.5);
    (difference / (27.0 * mu * mu * (32.0 + 27.0 * mu))).sqrt()
}

/// The command, as a user of this folder calls it.
pub fn hartog() -> Command {
    let mut c = Command::cargo_bin("hartog").expect("built");
    c.current_dir(env!("CARGO_MANIFEST_DIR"));
    c
}

/// The folder and the screen of `hartog compare` of all publications, made once for all tests.
pub fn compared() -> &'static (PathBuf, String) {
    static RUN: OnceLock<(PathBuf, String)> = OnceLock::new();
    RUN.get_or_init(|| {
        // nothing removes what a static holds: the next run takes the place of this one
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("compared");
        if folder.exists() {
            fs::remove_dir_all(&folder).expect("removed");
        }
        let output = hartog().args(["compare", "--out"]).arg(&folder).assert().code(0).get_output().stdout.clone();
        (folder, String::from_utf8(output).expect("text"))
    })
}

/// The text of a file that a command wrote.
pub fn read(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// A copy of a shipped study with some text replaced, beside its engines and published tables.
pub fn variant(folder: &Path, name: &str, changes: &[(&str, &str)]) -> PathBuf {
    let studies = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies");
    for part in ["engines", "published"] {
        fs::create_dir_all(folder.join(part)).expect("writable");
        for file in fs::read_dir(studies.join(part)).expect(part) {
            let file = file.expect(part);
            fs::copy(file.path(), folder.join(part).join(file.file_name())).expect("copied");
        }
    }
    let mut text = fs::read_to_string(studies.join(format!("{name}.toml"))).expect("study");
    for (from, to) in changes {
        assert!(text.contains(from), "{name} has `{from}`");
        text = text.replace(from, to);
    }
    let path = folder.join(format!("{name}.toml"));
    fs::write(&path, text).expect("written");
    path
}

/// Place and value of the lowest point of a valley, by golden sections.
pub fn golden(mut a: f64, mut b: f64, f: &dyn Fn(f64) -> f64) -> (f64, f64) {
    let g = 0.5 * (5f64.sqrt() - 1.0);
    let (mut x, mut y) = (b - g * (b - a), a + g * (b - a));
    let (mut fx, mut fy) = (f(x), f(y));
    while b - a > 1e-12 * (1.0 + a.abs()) {
        if fx < fy {
            (b, y, fy) = (y, x, fx);
            x = b - g * (b - a);
            fx = f(x);
        } else {
            (a, x, fx) = (x, y, fy);
            y = a + g * (b - a);
            fy = f(y);
        }
    }
    if fx < fy { (x, fx) } else { (y, fy) }
}

/// The same where there may be several valleys: the lowest of some points first.
pub fn scanned(a: f64, b: f64, f: &dyn Fn(f64) -> f64) -> (f64, f64) {
    const POINTS: usize = 24;
    let at = |i: usize| a + (b - a) * i as f64 / POINTS as f64;
    let best = (0..=POINTS).map(|i| (i, f(at(i)))).fold((0, f64::INFINITY), |m, x| if x.1 < m.1 { x } else { m }).0;
    golden(at(best.saturating_sub(1)), at((best + 1).min(POINTS)), f)
}
