//! Commands as a user runs them: exit codes, files, columns, determinism.

use crate::support::{compared, hartog, read, variant};
use std::fs;
use std::path::Path;

/// Of the six of the thesis: without the optimum by a margin, which costs most of its time.
const BY_TWIST_ONLY: (&str, &str) =
    ("[[objective]]                    # optima of the first size, by each objective\nmargin = { criterion = \"goodman\" }\n", "");

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
    assert_eq!(header("response.csv"), "design,condition,quantity,where,unit,order,kind,speed_rpm,amplitude,phase_deg");
    assert!(header("pareto.csv").starts_with("absorber,ring_inertia_kg_m2,stiffness_n_m_per_rad,damping_n_m_s_per_rad,peak_twist_deg"));
    assert!(header("timing.csv").starts_with("stage,seconds"));
    assert!(read(&out, "designs.csv").contains("\noptimum_tuned,tuned,"));
    for plot in ["campbell", "designs", "excitation", "pareto", "response_h_infinity", "response_optimum_viscous"] {
        assert!(read(&out, &format!("{plot}.svg")).starts_with("<svg width=\"720\""), "{plot}");
        let png = fs::read(out.join(format!("{plot}.png"))).expect("a picture");
        assert!(png.starts_with(b"\x89PNG") && png.len() > 5000, "{plot}");
    }
    let left: Vec<_> = fs::read_dir(&out)
        .expect("folder")
        .filter(|e| e.as_ref().is_ok_and(|e| e.file_name().to_string_lossy().starts_with('.')))
        .collect();
    assert!(left.is_empty(), "no temporary file stays");
    // numbers read back exactly, and nothing is infinite
    for cell in read(&out, "response.csv").lines().skip(1).take(2000).filter_map(|l| l.split(',').nth(8)) {
        assert!(cell.parse::<f64>().is_ok_and(f64::is_finite), "{cell}");
    }
}

/// Plots of runs and figures have text of at least 7 pt (1 pt = 127/360 mm) when they are printed 170 mm wide, and each PNG says that it is meant to be that wide (its chunk `pHYs`, pixels per
/// metre), within a millimetre.
#[test]
fn plots_can_be_printed() {
    let folder = tempfile::tempdir().expect("folder");
    let out = |n: &str| folder.path().join(n);
    let fewer =
        ["--set", "optimise.prove={boxes=0}", "--set", "optimise.random_starts=0", "--set", "order_limit=6", "--set", "speed_rpm.step=100"];
    hartog().args(["run", "studies/villalva_i6_materials.toml", "--quiet"]).args(fewer).arg("--out").arg(out("run")).assert().code(0);
    hartog().args(["run", "studies/minucci_i4.toml", "--quiet", "--out"]).arg(out("crank")).assert().code(0);
    hartog().args(["curves", "studies/mendes_mwm6.toml", "--out"]).arg(out("curves")).assert().code(0);
    let mut looked_at = 0;
    for path in
        ["run", "crank", "curves"].map(out).iter().flat_map(|f| fs::read_dir(f).expect("folder")).map(|e| e.expect("an entry").path())
    {
        match path.extension().and_then(|e| e.to_str()) {
            Some("svg") => {
                let svg = fs::read_to_string(&path).expect("a drawing");
                let numbers = |before: &str| -> Vec<f64> {
                    let found = svg.split(before).skip(1).filter_map(|r| r.split([' ', '"']).next());
                    found.map(|v| v.parse().expect("a number")).collect()
                };
                let width = numbers("viewBox=\"0 0 ")[0];
                for size in numbers("font-size=\"") {
                    let points = size / width * 170.0 * 360.0 / 127.0;
                    assert!(points >= 7.0, "{}: {points:.2} pt", path.display());
                    looked_at += 1;
                }
            }
            Some("png") => {
                let png = fs::read(&path).expect("a picture");
                let number = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().expect("four bytes"));
                assert_eq!(&png[37..41], b"pHYs", "{}", path.display());
                let mm = f64::from(number(16)) / f64::from(number(41)) * 1e3;
                assert!((mm - 170.0).abs() < 1.0, "{}: {mm:.1} mm", path.display());
            }
            _ => {}
        }
    }
    assert!(looked_at > 300, "{looked_at}");
}

/// A limit that no ring meets: exit code 1, said in words, and the files are there all the same.
#[test]
fn failing_limit_is_exit_code_one() {
    let folder = tempfile::tempdir().expect("folder");
    let limit = "[[constraint]]\nring_twist = { absorber = 1, max_deg = 1e-9 }\n\n[optimise]";
    let study = variant(folder.path(), "den_hartog", &[("[optimise]", limit)]);
    let output = hartog().arg("run").arg(&study).arg("--out").arg(folder.path().join("o")).assert().code(1).get_output().stdout.clone();
    assert!(String::from_utf8_lossy(&output).contains("FAILS"));
    assert!(folder.path().join("o/designs.csv").is_file());
}

/// Where nothing is searched, it is the best absorber of the catalogues that is to hold the limits: exit code 1 where it does not.
#[test]
fn failing_catalogue_is_exit_code_one() {
    let folder = tempfile::tempdir().expect("folder");
    let engine = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/engines/villalva_i6.toml");
    fs::write(
        folder.path().join("c.csv"),
        "name,type,ring_inertia_kg_m2,stiffness_n_m_per_rad,damping_n_m_s_per_rad\na,tuned,0.04,30000,20\n",
    )
    .expect("written");
    for (degrees, code) in [(5.0, 0), (0.01, 1)] {
        let study = format!(
            "engine = '{}'\nspeed_rpm = {{ from = 600, to = 3200, step = 100 }}\norder_limit = 6\n[[objective]]\npeak_twist = {{ from = \"pulley\", to = \"flywheel\" }}\n[[constraint]]\npeak_twist = {{ from = \"pulley\", to = \"flywheel\", max_deg = {degrees} }}\n[[catalogue]]\non.station = \"pulley\"\nfile = \"c.csv\"\nbest = 1\n",
            engine.display()
        );
        fs::write(folder.path().join("s.toml"), study).expect("written");
        hartog().arg("run").arg(folder.path().join("s.toml")).arg("--out").arg(folder.path().join("o")).assert().code(code);
        // a limit that is used up by so much, a hundred being all of it
        let limits = fs::read_to_string(folder.path().join("o/limits.csv")).expect("a table");
        let row: Vec<&str> = limits.lines().find(|l| l.starts_with('a')).expect("a row").split(',').collect();
        let [value, limit, used] = [3, 4, 6].map(|i| row[i].parse::<f64>().expect("a number"));
        assert!((used - 100.0 * value / limit).abs() < 1e-6 && row[7] == if code == 0 { "true" } else { "false" }, "{limits}");
    }
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
    let output = hartog().args(["check", "--verbose", "studies/villalva_v10_thesis.toml"]).assert().code(0).get_output().stdout.clone();
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

/// `compare` without arguments takes every study of ./studies with tables, exits 0, writes one page an engine with the columns of the contract,
/// says in brief what a reader wants first, on one screen of 40 lines of 100 columns, and the rest on its pages.
#[test]
fn compare_writes_a_page_an_engine() {
    let (folder, text) = compared();
    let lines: Vec<&str> = text.lines().collect();
    assert!((20..=40).contains(&lines.len()) && lines.iter().all(|l| l.chars().count() <= 100), "{} lines\n{text}", lines.len());
    assert!(text.contains("tolerances that the studies state hold") && !text.contains("Den Hartog"));
    let pages: Vec<String> = ["villalva_i6_thesis", "villalva_v10_thesis"].map(|e| read(&folder.join(e), "report.html")).into();
    for words in
        ["Best published: viscous_untuned", "Possible with the same ring", "Erratum", "Unexplained", "std. error", "correlation", "holds"]
    {
        assert!(pages.iter().any(|p| p.contains(words)), "{words}");
    }
    assert!(pages.iter().any(|p| p.contains("tuned by hand beforehand, and held: boost_bar")));
    for engine in ["villalva_i6_thesis", "villalva_v10_thesis"] {
        let page = folder.join(engine);
        let table = read(&page, "comparison.csv");
        assert!(table.starts_with("table,engine,design,quantity,unit,published,computed,deviation_percent,role,note,half_digit,"));
        for role in
            ["given", "calibrated", "predicted", "recomputed", "\"fitted, no freedom left\"", "other model", "erratum", "unexplained"]
        {
            assert!(table.contains(&format!(",{role},")), "{engine}: {role}");
        }
        assert!(!table.contains("NaN") && !table.contains("inf,"));
        assert!(read(&page, "calibration.csv").starts_with("input,in_file,fitted,standard_error,lower,upper,note\npressure_scale,"));
        assert!(
            read(&page, "choices.csv")
                .starts_with("quantity,unit,design,published,computed,published_place,computed_place,recommended_in\n")
        );
        for plot in ["comparison", "orders", "calibration"] {
            assert!(read(&page, &format!("{plot}.svg")).starts_with("<svg") && page.join(format!("{plot}.png")).is_file(), "{plot}");
        }
    }
}

/// `compare --verbose` prints every row beside what it says in brief.
#[test]
fn compare_in_full() {
    let folder = tempfile::tempdir().expect("folder");
    let printed = |more: &[&str]| {
        let out = folder.path().join(format!("o{}", more.len()));
        let output = hartog()
            .args(["compare", "studies/mendes_mwm6.toml"])
            .args(more)
            .arg("--out")
            .arg(out)
            .assert()
            .code(0)
            .get_output()
            .stdout
            .clone();
        String::from_utf8(output).expect("text")
    };
    let (brief, full) = (printed(&[]), printed(&["--verbose"]));
    let rows = |text: &str| text.lines().filter(|l| l.contains("predicted") && l.contains("Hz")).count();
    assert_eq!((rows(&brief), rows(&full)), (0, 4), "{full}");
}

/// A tolerance that fails is exit code 1, a study without tables exit code 2, each said in words.
#[test]
fn compare_that_fails() {
    let folder = tempfile::tempdir().expect("folder");
    let study = variant(folder.path(), "villalva_v10_thesis", &[("amplitude_worst = 30", "amplitude_worst = 3")]);
    let output = hartog().arg("compare").arg(&study).arg("--out").arg(folder.path().join("o")).assert().code(1).get_output().stdout.clone();
    assert!(String::from_utf8_lossy(&output).contains("worst predicted amplitude beyond its digits, 3 %: 21.42 %: FAILS"));
    let output = hartog().args(["compare", "studies/den_hartog.toml"]).assert().code(2).get_output().stderr.clone();
    assert!(String::from_utf8_lossy(&output).contains("has no [published] table"));
}

/// Columns of the conditions follow those of the contract; files of an earlier run that this one does not make are gone.
#[test]
fn conditions_in_tables_and_no_stale_plots() {
    let folder = tempfile::tempdir().expect("folder");
    let small = [
        ("step = 10", "step = 40"),
        ("each = [0.076, 0.038, 0.0152, 0.0076]", "fixed = 0.076"),
        ("points = 100", "points = 2"),
        ("seed = 1", "seed = 1\nrandom_starts = 0\nprove = { boxes = 0 }"),
        BY_TWIST_ONLY,
    ];
    let study = variant(folder.path(), "villalva_i6_thesis", &small);
    let out = folder.path().join("o");
    hartog().arg("run").arg(&study).arg("--out").arg(&out).assert().code(0);
    let table = read(&out, "designs.csv");
    let header = table.lines().next().expect("a header");
    assert!(
        header.contains("objective_value,misfire_cylinder,misfire_peak_twist_deg,misfire_peak_twist_speed_rpm,misfire_peak_twist_order")
    );
    assert!(
        header.contains("absorber_locked_peak_twist_deg")
            && header.contains("absorber_lost_objective_value,margin_goodman,margin_goodman_speed_rpm,margin_goodman_fillet")
    );
    let none = table.lines().find(|l| l.starts_with("none,")).expect("a row");
    assert_eq!(none.split(',').count(), header.split(',').count());
    assert!(none.contains(",,,,,,,,,,,,"), "nothing to lock or lose: {none}");
    let margins = read(&out, "margin.csv");
    assert!(margins.starts_with("design,speed_rpm,fillet,criterion,amplitude_mpa,mean_mpa,safety_factor\nnone,600,crankpin_1,goodman,"));
    assert!(margins.lines().all(|l| l.split(',').count() == 7 && !l.contains("NaN")));
    assert!(read(&out, "response.csv").contains("viscous_untuned,misfire,twist,pulley to flywheel,deg,0.5,order,"));
    assert!(out.join("response_viscous_untuned.svg").is_file() && out.join("calibration.csv").is_file());
    let text = fs::read_to_string(&study).expect("study");
    let (start, end) = (text.find("[[design]]\nname = \"viscous").expect("a design"), text.find("[[objective]]").expect("an objective"));
    let published = text.find("[published]").expect("tables");
    fs::write(&study, format!("{}{}", &text[..start], &text[end..published])).expect("written");
    hartog().arg("run").arg(&study).arg("--out").arg(&out).assert().code(0);
    assert!(!out.join("response_viscous_untuned.svg").is_file() && !out.join("calibration.csv").is_file());
    assert!(out.join("response_tuned_unity.svg").is_file());
}

/// `compare` finds the optimum in the conditions it is to hold in, as `run` does.
#[test]
fn compare_holds_the_conditions_of_the_optimum() {
    let folder = tempfile::tempdir().expect("folder");
    let changes = [
        ("step = 10", "step = 100"),
        ("order_limit = 12", "order_limit = 6"),
        ("each = [0.076, 0.038, 0.0152, 0.0076]", "fixed = 0.076"),
        ("[pareto]\npoints = 100\nagainst.ring_inertia_kg_m2 = [0.0038, 0.152]", ""),
        ("seed = 1", "seed = 1\nrandom_starts = 0\nprove = { boxes = 0 }\nconditions = [\"misfire\"]"),
        ("types = [\"tuned\", \"viscous\"]", "types = [\"tuned\"]"),
        BY_TWIST_ONLY,
    ];
    let study = variant(folder.path(), "villalva_i6_thesis", &changes);
    let out = folder.path().join("o");
    hartog().arg("run").arg(&study).arg("--out").arg(&out).assert().code(0);
    let designs = read(&out, "designs.csv");
    let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
    let column = cells(designs.lines().next().expect("header")).iter().position(|c| c == "objective_value").expect("a column");
    let optimum = designs.lines().find(|l| l.starts_with("optimum_tuned,")).map(|l| cells(l)[column].clone()).expect("a row");
    let output = hartog().arg("compare").arg(&study).arg("--out").arg(&out).assert().code(0).get_output().stdout.clone();
    let words = format!("Possible with the same ring: {:.4}°", optimum.parse::<f64>().expect("a number"));
    assert!(String::from_utf8_lossy(&output).contains(&words), "{words}");
}

/// `chart` writes the table of the contract and its plots, finds every method on every scenario of stability as it is declared (no defect), and a coarse grid errs where a refined peak does not.
#[test]
fn chart_writes_speed_and_accuracy() {
    let folder = tempfile::tempdir().expect("folder");
    // of two absorbers nothing is proved, which would take most of the time
    let ring = "[[optimise.absorber]]\non.station = \"engine\"\ntypes = [\"tuned\", \"viscous\"]\nsize.inertia_ratio.fixed = 0.1\n";
    let pareto = "\n[pareto]\npoints = 25\nagainst.inertia_ratio = [0.01, 1]\n";
    let path = variant(folder.path(), "den_hartog", &[(ring, &format!("{ring}{ring}")), (pareto, "")]);
    let out = folder.path().join("out");
    let output = hartog().arg("chart").arg(path).arg("--out").arg(&out).assert().code(0).get_output().stdout.clone();
    let text = String::from_utf8_lossy(&output);
    assert!(text.contains("Stability: 30 scenarios") && !text.contains("DEFECT"), "{text}");
    let table = read(&out, "speed_accuracy.csv");
    assert!(table.starts_with("method,setting,seconds_per_design,peak_error,stable,note\n"));
    let error = |method: &str, setting: &str| -> f64 {
        let line = table.lines().find(|l| l.starts_with(&format!("{method},")) && l.contains(setting)).expect("a row");
        line.rsplit(',').nth(2).and_then(|c| c.parse().ok()).expect("an error")
    };
    assert!(error("direct", ",14 speeds,") > 1e-3 && error("direct", ",53 speeds refined,") < 1e-9);
    for plot in ["speed_accuracy", "growth", "stability"] {
        assert!(read(&out, &format!("{plot}.svg")).starts_with("<svg") && out.join(format!("{plot}.png")).is_file());
    }
}

/// What an optimum asks of its builder is said: the loss factor that spring and damper imply, c/sqrt(k J) (0.371 for Den Hartog's ratio of 0.1: 2 zeta of Brock's 0.168 over 1/1.1, and the
/// difference of the exact optimum), and a bound that it lies on; without bounds there is none to lie on.
#[test]
fn loss_factors_and_bounds_of_an_optimum() {
    let folder = tempfile::tempdir().expect("folder");
    let run = |changes: &[(&str, &str)]| {
        let out = folder.path().join("o");
        let study = variant(folder.path(), "den_hartog", changes);
        let output = hartog().args(["run", "--verbose"]).arg(&study).arg("--out").arg(&out).output().expect("run");
        (String::from_utf8_lossy(&output.stdout).into_owned(), read(&out, "absorbers.csv"))
    };
    let few = ("points = 25", "points = 2");
    let (said, table) = run(&[few]);
    assert!(said.contains("implied loss factor 0.371 (c omega/k at the ring's own 14.47 Hz)") && !said.contains("lies on its"), "{said}");
    let columns: Vec<&str> = table.lines().next().expect("a header").split(',').collect();
    let row: Vec<&str> = table.lines().find(|l| l.starts_with("optimum_tuned,")).expect("a row").split(',').collect();
    let value = |name: &str| row[columns.iter().position(|c| *c == name).expect(name)].parse::<f64>().expect(name);
    let root = (value("stiffness_n_m_per_rad") * value("ring_inertia_kg_m2")).sqrt();
    assert!((value("implied_loss_factor") / (value("damping_n_m_s_per_rad") / root) - 1.0).abs() < 1e-12);
    let bounded = ("size.inertia_ratio.fixed = 0.1", "size.inertia_ratio.fixed = 0.1\nstiffness_n_m_per_rad.between = [0, 500]");
    let (said, _) = run(&[few, bounded]);
    assert!(said.contains("`stiffness_n_m_per_rad` lies on its upper bound, 500.0: one per cent further, all else tuned anew,"), "{said}");
}

/// Nothing printed is wider than a hundred columns, whatever the names and numbers; `--wide` prints every column of a table in one piece.
#[test]
fn what_is_printed_fits_a_hundred_columns() {
    let folder = tempfile::tempdir().expect("a folder");
    let [out, other] = ["laws", "other"].map(|name| folder.path().join(name).to_string_lossy().into_owned());
    let printed = |arguments: &[&str]| -> Vec<String> {
        let output = hartog().args(arguments).assert().success();
        String::from_utf8_lossy(&output.get_output().stdout).lines().map(str::to_owned).collect()
    };
    let widest = |lines: &[String]| lines.iter().map(|l| l.chars().count()).max().unwrap_or(0);
    for arguments in [
        &["run", "studies/villalva_i6_laws.toml", "--out", &out][..],
        &["check", "studies/villalva_v10.toml"],
        &["run", "studies/den_hartog.toml", "--verbose", "--out", &other],
    ] {
        let lines = printed(arguments);
        assert!(lines.len() > 10 && widest(&lines) <= 100, "{arguments:?}: {} columns", widest(&lines));
    }
    let wide = printed(&["run", "studies/villalva_i6_laws.toml", "--wide", "--out", &out]);
    assert!(widest(&wide) > 100 && wide.iter().any(|l| l.contains("f3/Hz") && l.contains("order @ rpm")));
}
