//! Commands as a user runs them: exit codes, files, columns, determinism.

use assert_cmd::Command;
use std::fs;
use std::path::Path;

fn hartog() -> Command {
    let mut c = Command::cargo_bin("hartog").expect("built");
    c.current_dir(env!("CARGO_MANIFEST_DIR"));
    c
}

fn read(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// A copy of a shipped study with some text replaced, beside its engines and published tables.
fn variant(folder: &Path, name: &str, changes: &[(&str, &str)]) -> std::path::PathBuf {
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

/// The whole of a run: exit code 0, every file of the contract, the columns in order, plots that are pictures.
#[test]
fn run_writes_the_contract() {
    let folder = tempfile::tempdir().expect("folder");
    let out = folder.path().join("deep/out");
    hartog().args(["run", "studies/den_hartog.toml", "--out"]).arg(&out).assert().code(0);
    let header = |name: &str| read(&out, name).lines().next().unwrap_or_default().to_owned();
    assert!(header("designs.csv").starts_with(
        "design,absorber,ring_inertia_kg_m2,stiffness_n_m_per_rad,damping_n_m_s_per_rad,f1_hz,f2_hz,f3_hz,peak_twist_deg,peak_twist_speed_rpm,\
         peak_order_twist_deg,peak_order_twist_order,peak_order_twist_speed_rpm,peak_order_hub_deg,peak_order_hub_order,\
         peak_order_hub_speed_rpm,peak_torque_n_m,peak_torque_shaft,dissipated_power_w,ring_twist_deg"
    ));
    assert_eq!(header("response.csv"), "design,quantity,order,speed_rpm,amplitude");
    assert!(header("pareto.csv").starts_with("absorber,ring_inertia_kg_m2,stiffness_n_m_per_rad,damping_n_m_s_per_rad,peak_twist_deg"));
    assert!(header("timing.csv").starts_with("stage,seconds"));
    assert!(read(&out, "designs.csv").contains("\noptimum_tuned,tuned,"));
    for plot in ["campbell", "designs", "excitation", "pareto", "response_h_infinity", "response_optimum_viscous"] {
        assert!(read(&out, &format!("{plot}.svg")).starts_with("<svg width=\"900\""), "{plot}");
        let png = fs::read(out.join(format!("{plot}.png"))).expect("a picture");
        assert!(png.starts_with(b"\x89PNG") && png.len() > 5000, "{plot}");
    }
    let left: Vec<_> = fs::read_dir(&out)
        .expect("folder")
        .filter(|e| e.as_ref().is_ok_and(|e| e.file_name().to_string_lossy().starts_with('.')))
        .collect();
    assert!(left.is_empty(), "no temporary file stays");
    // numbers read back exactly, and nothing is infinite
    for cell in read(&out, "response.csv").lines().skip(1).take(2000).filter_map(|l| l.rsplit(',').next()) {
        assert!(cell.parse::<f64>().is_ok_and(f64::is_finite), "{cell}");
    }
}

/// Files are the same, byte for byte, at 1, 2 and 8 threads.
#[test]
fn threads_change_nothing() {
    let folder = tempfile::tempdir().expect("folder");
    let coarse =
        [("step = 10", "step = 20"), ("each = [0.076, 0.038, 0.0152, 0.0076]", "each = [0.076, 0.0076]"), ("points = 100", "points = 15")];
    let study = variant(folder.path(), "villalva_i6", &coarse);
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

/// A limit that no ring meets: exit code 1, said in words, and the files are there all the same.
#[test]
fn failing_limit_is_exit_code_one() {
    let folder = tempfile::tempdir().expect("folder");
    let limit = "[[constraint]]\nvibratory_torque = { max_n_m = 500 }\n\n[optimise]";
    let changes = [
        ("[optimise]", limit),
        ("each = [0.076, 0.038, 0.0152, 0.0076]", "fixed = 0.076"),
        ("[pareto]\npoints = 100\nagainst.ring_inertia_kg_m2 = [0.0038, 0.152]", ""),
    ];
    let study = variant(folder.path(), "villalva_i6", &changes);
    let output = hartog().arg("run").arg(&study).arg("--out").arg(folder.path().join("o")).assert().code(1).get_output().stdout.clone();
    assert!(String::from_utf8_lossy(&output).contains("FAILS"));
    assert!(folder.path().join("o/designs.csv").is_file());
}

/// A resonance without damping: exit code 2 and a named error with order, speed and frequency; no table is left behind.
#[test]
fn undamped_resonance_is_exit_code_two() {
    let folder = tempfile::tempdir().expect("folder");
    let study = variant(
        folder.path(),
        "den_hartog",
        &[(
            "[[design]]\nname = \"h_infinity\"\n[[design.absorber]]\non.station = \"engine\"\ntype.seeded = { by = \"h_infinity\", ring_inertia_kg_m2 = 0.1 }",
            "[[design]]\nname = \"none\"",
        )],
    );
    let output = hartog().arg("run").arg(&study).arg("--out").arg(folder.path().join("o")).assert().code(2).get_output().stderr.clone();
    let text = String::from_utf8_lossy(&output);
    assert!(text.contains("design `none`: resonance without damping: order 1 at 954.9 rpm (15.92 Hz)"), "{text}");
    assert!(!folder.path().join("o/designs.csv").exists());
}

/// `check` prints the resolved model and audits the pressure.
#[test]
fn check_audits_the_engine() {
    let output = hartog().args(["check", "studies/villalva_v10.toml"]).assert().code(0).get_output().stdout.clone();
    let text = String::from_utf8_lossy(&output);
    for words in ["412.84", "1053.40", "9 at 144°", "friction/N m", "throw_5", "order 0/N m", "objective: peak twist pulley to flywheel"] {
        assert!(text.contains(words), "`{words}` in\n{text}");
    }
}

/// Help names an example for each command, and says why the objective is what it is.
#[test]
fn help_has_examples() {
    for (arguments, words) in [
        (&["--help"][..], "hartog run studies/villalva_i6.toml"),
        (&["run", "--help"], "hartog run studies/villalva_i6.toml --out out/six"),
        (&["run", "--help"], "Neither the hub's amplitude nor a single order will do"),
        (&["check", "--help"], "hartog check studies/villalva_v10.toml"),
    ] {
        let output = hartog().args(arguments).assert().code(0).get_output().stdout.clone();
        assert!(String::from_utf8_lossy(&output).contains(words), "{words}");
    }
}

/// A file in the way of the output folder is named before anything is computed.
#[test]
fn output_folder_in_the_way() {
    let folder = tempfile::tempdir().expect("folder");
    let file = folder.path().join("taken");
    fs::write(&file, "").expect("written");
    let output = hartog().args(["run", "studies/den_hartog.toml", "--out"]).arg(&file).assert().code(2).get_output().stderr.clone();
    let text = String::from_utf8_lossy(&output);
    assert!(text.contains("cannot write") && text.contains("taken") && text.contains("a file is in the way"), "{text}");
}
