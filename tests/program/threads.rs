//! Results do not depend on the number of threads: files are the same, byte for byte, at 1, 2 and 8.

use crate::support::{hartog, variant};
use std::fs;

/// Files are the same, byte for byte, at 1, 2 and 8 threads.
#[test]
fn threads_change_nothing() {
    let folder = tempfile::tempdir().expect("folder");
    let coarse = [
        ("step = 10", "step = 200"),
        ("order_limit = 12", "order_limit = 6"),
        ("each = [0.076, 0.038, 0.0152, 0.0076]", "each = [0.076]"),
        ("points = 100", "points = 3"),
        (
            r#"["goodman", "iacs_m53", "iacs_m53_continuous", "crossland", "dang_van_mesoscopic", "papadopoulos"]"#,
            r#"["goodman", "iacs_m53", "crossland"]"#,
        ),
        ("seed = 1", "seed = 1\nrandom_starts = 0\nprove = { gap = 1e-2, boxes = 500 }"),
    ];
    let study = variant(folder.path(), "villalva_i6_thesis", &coarse);
    let out = |n: &str| folder.path().join(n);
    for n in ["1", "2", "8"] {
        hartog().arg("run").arg(&study).args(["--threads", n, "--out"]).arg(out(n)).assert().code(0);
    }
    for name in
        ["designs.csv", "response.csv", "pareto.csv", "campbell.svg", "designs.png", "pareto.svg", "excitation.png", "response_none.svg"]
    {
        let first = fs::read(out("1").join(name)).expect(name);
        for n in ["2", "8"] {
            assert!(first == fs::read(out(n).join(name)).expect(name), "{name} differs at {n} threads");
        }
    }
}

/// The same of laws of real materials, held cold and hot, with their balance of heat, measured tables beside them.
#[test]
fn threads_change_nothing_in_materials() {
    let folder = tempfile::tempdir().expect("folder");
    let coarse = [
        ("step = 20", "step = 400"),
        ("order_limit = 12", "order_limit = 6"),
        ("[optimise]\n", "[optimise]\nrandom_starts = 0\nprove = { gap = 1e-2, boxes = 500 }\n"),
        (r#"types = ["fractional_zener", "carreau", "spring_pack"]"#, r#"types = ["fractional_zener", "carreau"]"#),
    ];
    let text = fs::read_to_string("studies/villalva_i6_materials.toml").expect("shipped");
    let (head, springs) = text.split_once("# leaf springs").expect("the last material");
    assert!(springs.contains("spring_pack"));
    let engine = std::env::current_dir().expect("here").join("studies/engines/villalva_i6.toml");
    let mut changed = head.replace("engines/villalva_i6.toml", &engine.display().to_string());
    for (from, to) in coarse {
        assert!(changed.contains(from), "{from}");
        changed = changed.replace(from, to);
    }
    let study = folder.path().join("materials.toml");
    fs::write(&study, changed).expect("written");
    let out = |n: &str| folder.path().join(n);
    for n in ["1", "2", "8"] {
        hartog().arg("run").arg(&study).args(["--threads", n, "--out"]).arg(out(n)).assert().code(0);
    }
    for name in ["designs.csv", "absorbers.csv", "heat.csv", "optima.csv", "heat.png"] {
        let first = fs::read(out("1").join(name)).expect(name);
        for n in ["2", "8"] {
            assert!(first == fs::read(out(n).join(name)).expect(name), "{name} differs at {n} threads");
        }
    }
}
