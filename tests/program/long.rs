//! Minutes long: `cargo test --release -- --ignored`.

use crate::support::{study, system};
use hartog::absorber::Declaration;
use hartog::absorber::closed_forms::EngineMode;
use hartog::analysis::model_check::highest_frequency_hz;
use hartog::analysis::{self, OptimumResult, Silent, families};
use hartog::input::{OptimiseSpec, Study};
use hartog::objective::{Condition, Limit, PeakFinder};
use hartog::optimise::{LoadCase, Problem, minimax, search, starts};
use hartog::response::{Grid, Method, Receptance, Work};
use rayon::prelude::*;
use std::fs;
use std::path::Path;
use std::process::Command;

fn with_scenes(study: &Study, f: impl FnOnce(&[LoadCase], &[Vec<EngineMode>])) {
    let sys = system(study);
    let grid = Grid::new(&study.speeds_rpm, &sys.excitation.tabulated_rpm);
    let method = Method::Receptance(Receptance::new(&sys, &grid, 0, &[study.twist]));
    let modes = families::engine_modes(study, family(study), highest_frequency_hz(study, &sys.excitation.orders));
    f(&[LoadCase::new(Condition::Firing, &PeakFinder::new(&sys, &grid, &method, true))], &modes);
}

/// What a study optimises.
fn family(study: &Study) -> &OptimiseSpec {
    study.optimise.as_ref().expect("optimises")
}

/// The problem of one type and ring.
fn problem<'a>(
    study: &Study,
    load_cases: &'a [LoadCase<'a>],
    objective: &'a Limit,
    modes: &[Vec<EngineMode>],
    declaration: &'static Declaration,
    ring: f64,
) -> Problem<'a> {
    let space = families::family(family(study), &families::Choice { types: vec![declaration], rings: vec![Some(ring)] }, modes);
    Problem { load_cases, space, objectives: std::slice::from_ref(objective), weights: &[], limits: &[], memory: None }
}

/// Runs both engines and hands over every optimum of twist with its problem.
fn for_every_optimum(check: impl Fn(&str, &OptimumResult, &Problem, &[Vec<EngineMode>])) {
    for name in ["villalva_i6_thesis", "villalva_v10_thesis"] {
        let mut s = study(name);
        s.front = None;
        let results = analysis::run(&s, &Silent).expect("damped");
        with_scenes(&s, |load_cases, modes| {
            for o in results.optima.iter().filter(|o| o.objective == 0) {
                let a = &o.optimum.design[0].absorber;
                check(
                    name,
                    o,
                    &problem(&s, load_cases, &s.objective.measure.in_si(), modes, a.declaration().expect("a ring"), a.ring_inertia()),
                    modes,
                );
            }
        });
    }
}

/// No point of a logarithmic grid of 10⁵ points in stiffness and damping, four decades wide round the optimum's seed, nor of a second one
/// zoomed on its best point, beats an optimum by more than 0.01 %. Every size and type of both engines.
#[test]
#[ignore = "about 25 minutes"]
fn no_grid_beats_an_optimum() {
    for_every_optimum(|name, o, problem, modes| {
        let seed = starts::starts(&problem.space, modes, 0, 1)[0].1.clone();
        let n = problem.space.variables.len();
        let (mut centre, mut half) = (seed, 2.0 * std::f64::consts::LN_10);
        let side = 100_000f64.powf(1.0 / n as f64).round() as usize;
        for zoom in 0..2 {
            let point = |index: usize| -> Vec<f64> {
                (0..n)
                    .map(|d| {
                        let i = index / side.pow(d as u32) % side;
                        let (low, high) = problem.space.bounds()[d];
                        (centre[d] + half * (2.0 * i as f64 / (side - 1) as f64 - 1.0)).clamp(low, high)
                    })
                    .collect()
            };
            let best = (0..side.pow(n as u32))
                .into_par_iter()
                .map(|i| (problem.cost(&point(i), &mut Work::default()), i))
                .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
                .expect("points");
            let value = o.optimum.value();
            println!("{name} {} zoom {zoom}: grid {:.9}, optimum {value:.9}, ratio {:.7}", o.design.name, best.0, best.0 / value);
            assert!(best.0 > value * (1.0 - 1e-4), "{name} {}: {} beats {value}", o.design.name, best.0);
            centre = point(best.1);
            half *= 4.0 / (side - 1) as f64;
        }
    });
}

/// Every third point of both fronts is within 1e-5 of what forty random starts and all closed forms find for its ring.
#[test]
#[ignore = "two minutes"]
fn fronts_are_optimal() {
    for name in ["villalva_i6_thesis", "villalva_v10_thesis"] {
        let s = study(name);
        let results = analysis::run(&s, &Silent).expect("damped");
        with_scenes(&s, |load_cases, modes| {
            for front in &results.fronts {
                let mut worst = 0.0f64;
                for p in front.front.points.iter().step_by(3) {
                    let ring = p.design[0].absorber.ring_inertia();
                    let objective = s.objective.measure.in_si();
                    let problem = problem(&s, load_cases, &objective, modes, front.declaration, ring);
                    let list = starts::starts(&problem.space, modes, 40, 7);
                    let best = search::optimise(&problem, &list, search::Finish::All, &|| {}).expect("damped").value();
                    worst = worst.max(p.value / best - 1.0);
                    assert!(p.value <= best * (1.0 + 1e-5), "{name} {} at {ring}: {} against {best}", front.declaration.name, p.value);
                }
                println!("{name} {}: worst point {worst:.1e} above the best of all starts", front.declaration.name);
            }
        });
    }
}

/// Random starts by themselves reach every optimum by the minimax method: the share that does is printed.
#[test]
#[ignore = "a minute"]
fn random_starts_reach_the_optima() {
    for_every_optimum(|name, o, problem, modes| {
        let random: Vec<_> = starts::starts(&problem.space, modes, 20, 99).into_iter().filter(|s| s.0.starts_with("random")).collect();
        let found = search::optimise(problem, &random, search::Finish::All, &|| {}).expect("damped");
        let alone = minimax::minimise(problem, &random[0].1, &mut Work::default()).expect("damped");
        println!(
            "{name} {}: {} of 20 random starts agree; minimax alone from the first: {:.4}",
            o.design.name,
            found.agreeing(),
            alone.rows.objective() / o.optimum.value()
        );
        assert!(found.value() >= o.optimum.value() * (1.0 - 1e-6), "{name} {}: a random start is better", o.design.name);
        assert!(found.value() <= o.optimum.value() * (1.0 + 1e-6), "{name} {}: no random start arrives", o.design.name);
    });
}

/// The guide's table of materials: the best of rubber, silicone oil and leaf springs at each temperature alone and at all, to its printed digits; the same numbers from its rows.
#[test]
#[ignore = "half a minute"]
fn materials_at_each_temperature() {
    let chapter = std::fs::read_to_string("src/guide/absorbers_and_materials.md").expect("text");
    let rows = chapter.lines().skip_while(|l| !l.starts_with("| peak twist, six |")).skip(2).take_while(|l| l.starts_with('|'));
    let number = |cell: &str| cell.trim().strip_suffix('°').and_then(|x| x.parse::<f64>().ok());
    let printed: Vec<Vec<f64>> = rows.map(|l| l.split('|').filter_map(number).collect()).collect();
    assert_eq!(printed.len(), 6);
    for (e, name) in ["villalva_i6_materials", "villalva_v10_materials"].into_iter().enumerate() {
        let alone = [Condition::Cold, Condition::Firing, Condition::Hot].map(|c| vec![c]);
        let all = vec![Condition::Cold, Condition::Firing, Condition::Hot];
        for (c, conditions) in alone.into_iter().chain([all]).enumerate() {
            let mut s = study(name);
            s.designs.clear();
            s.optimise.as_mut().expect("optimises").conditions = conditions;
            let results = analysis::run(&s, &Silent).expect("damped");
            for (o, row) in results.optima.iter().zip(&printed[3 * e..]) {
                let found = o.optimum.value().to_degrees();
                assert!((found - row[c]).abs() < 6e-4, "{}, {}, column {c}: {found} against {}", name, o.design.name, row[c]);
            }
        }
    }
}

/// Files do not depend on the instructions of the processor: a program that makes no choice of them at run time, under a C library that is told of none beyond the oldest, writes the same, byte for byte.
#[test]
#[ignore = "builds the program a second time, about five minutes"]
fn files_do_not_depend_on_the_processor() {
    let place = tempfile::tempdir().expect("a folder");
    let folder = |name: &str| place.path().join(name);
    let build = folder("target");
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let root = env!("CARGO_MANIFEST_DIR");
    let built = Command::new(cargo)
        .args(["build", "--release", "--features", "baseline", "--bin", "hartog", "--target-dir"])
        .arg(&build)
        .current_dir(root)
        .status();
    assert!(built.expect("cargo").success());
    let usual = assert_cmd::cargo::cargo_bin("hartog");
    for study in ["den_hartog", "villalva_i6", "villalva_i6_laws", "villalva_i6_large_twist", "villalva_i6_robust", "minucci_i4"] {
        let run = |program: &Path, out: &Path, tunables: &str| {
            let path = format!("studies/{study}.toml");
            let mut command = Command::new(program);
            command.current_dir(root).args(["run", &path, "--out"]).arg(out).env("GLIBC_TUNABLES", tunables);
            assert!(command.output().expect("runs").status.success(), "{study}");
        };
        let (one, other) = (folder(&format!("{study}_one")), folder(&format!("{study}_other")));
        run(&usual, &one, "");
        run(&build.join("release/hartog"), &other, "glibc.cpu.hwcaps=-AVX,-AVX2,-AVX512F,-FMA,-FMA4");
        let mut compared = 0;
        for entry in fs::read_dir(&one).expect("files").map(|e| e.expect("a file")) {
            if entry.file_name() != "timing.csv" {
                let own = fs::read(entry.path()).expect("bytes");
                assert!(own == fs::read(other.join(entry.file_name())).expect("bytes"), "{study}: {:?}", entry.file_name());
                compared += 1;
            }
        }
        assert!(compared > 10, "{study}: {compared} files");
    }
}
