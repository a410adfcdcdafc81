//! `hartog report`: its tables against each other, against the response itself, and what the page holds.

use crate::support::{assert_close, study};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

type Row = BTreeMap<String, String>;

fn rows(folder: &Path, name: &str) -> Vec<Row> {
    let mut reader = csv::Reader::from_path(folder.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    reader.deserialize().map(|row| row.expect("a row")).collect()
}

fn value(row: &Row, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column}: {:?}", row[column]))
}

fn report(name: &str, folder: &Path) -> String {
    let mut c = Command::new(env!("CARGO_BIN_EXE_hartog"));
    let output = c
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["report", &format!("studies/{name}.toml"), "--out"])
        .arg(folder)
        .output()
        .expect("runs");
    assert!(output.status.code().is_some_and(|c| c <= 1), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// By hand from Holzer's tables: a six in line that fires every 120 degrees drives its throws by orders 3, 6, 9 and 12 in step, so that their vector sum is the sum of the angles of the throws; the
/// equilibrium amplitude of one N m is that sum over omega² sum of J Theta². To 1e-9; the torque behind the last station vanishes to 1e-8 of the largest.
#[test]
fn vector_sums_by_hand() {
    let folder = tempfile::tempdir().expect("folder");
    report("mendes_mwm6", folder.path());
    let throws: Vec<String> = study("mendes_mwm6").chain.stations.iter().filter(|s| !s.throws.is_empty()).map(|s| s.name.clone()).collect();
    assert_eq!(throws.len(), 6);
    let (holzer, sums) = (rows(folder.path(), "holzer.csv"), rows(folder.path(), "vector_sums.csv"));
    for mode in ["1", "2"] {
        let own: Vec<&Row> = holzer.iter().filter(|r| r["mode"] == mode).collect();
        let in_step: f64 = own.iter().filter(|r| throws.contains(&r["station"])).map(|r| value(r, "relative_angle")).sum();
        let kinetic: f64 = own.iter().map(|r| value(r, "inertia_kg_m2") * value(r, "relative_angle").powi(2)).sum();
        let omega = 2.0 * std::f64::consts::PI * value(own[0], "frequency_hz");
        for order in ["3", "6", "9", "12"] {
            let found = sums.iter().find(|r| r["mode"] == mode && r["order"] == order).expect("a sum");
            assert_close(value(found, "vector_sum"), in_step.abs(), 1e-9, 0.0, order);
            let equilibrium = in_step.abs() / (omega * omega * kinetic);
            assert_close(value(found, "equilibrium_deg_per_n_m").to_radians(), equilibrium, 1e-9, 0.0, order);
            assert_close(
                value(found, "critical_rpm"),
                30.0 * omega / std::f64::consts::PI / order.parse::<f64>().expect("an order"),
                1e-9,
                0.0,
                order,
            );
        }
        let most = own.iter().map(|r| value(r, "sum_of_torques_n_m_per_rad").abs()).fold(0.0, f64::max);
        assert!(value(own[own.len() - 1], "sum_of_torques_n_m_per_rad").abs() < 1e-8 * most);
    }
}

/// The amplitude in resonance of the largest criticals of mode 1 is that of the forced response of the engine without absorber, within 10 %: other modes and rigid rotation are left out of it.
#[test]
fn criticals_are_the_peaks_of_the_response() {
    let folder = tempfile::tempdir().expect("folder");
    report("mendes_mwm6", folder.path());
    let first = rows(folder.path(), "holzer.csv");
    let largest = first
        .iter()
        .filter(|r| r["mode"] == "1")
        .max_by(|a, b| value(a, "relative_angle").abs().total_cmp(&value(b, "relative_angle").abs()));
    assert_eq!(largest.expect("a station")["station"], "pulley");
    let mut criticals: Vec<Row> =
        rows(folder.path(), "criticals.csv").into_iter().filter(|r| r["mode"] == "1" && !r["resonance_deg"].is_empty()).collect();
    criticals.sort_by(|a, b| value(b, "resonance_deg").total_cmp(&value(a, "resonance_deg")));
    let response = rows(folder.path(), "response.csv");
    for critical in &criticals[..2] {
        let near = |r: &&Row| {
            r["design"] == "none"
                && r["condition"] == "firing"
                && r["quantity"] == "amplitude"
                && r["where"] == "pulley"
                && r["order"] == critical["order"]
                && (value(r, "speed_rpm") / value(critical, "critical_rpm") - 1.0).abs() < 0.05
        };
        let peak = response.iter().filter(near).map(|r| value(r, "amplitude")).fold(0.0, f64::max);
        assert_close(value(critical, "resonance_deg"), peak, 0.1, 0.0, &critical["order"]);
    }
}

/// With `--optima` the report holds the optima that `run` finds, to the last digit, and the torque of each shaft in each condition: with the ring locked more than with the ring at work.
#[test]
fn optima_are_reported_on_request() {
    let (folder, run) = (tempfile::tempdir().expect("folder"), tempfile::tempdir().expect("folder"));
    let own = tempfile::tempdir().expect("folder");
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/mendes_mwm6.toml")).expect("a study");
    let engine = format!("{}/studies/engines", env!("CARGO_MANIFEST_DIR"));
    let study = own.path().join("study.toml");
    let text = text.split("[published]").next().expect("a study").replace("engines/", &format!("{engine}/"));
    std::fs::write(&study, text.replace("[\"firing\", \"misfire\"]", "[\"firing\", \"absorber_locked\"]")).expect("written");
    let hartog = |command: &str, more: &[&str], out: &Path| {
        let mut c = Command::new(env!("CARGO_BIN_EXE_hartog"));
        let output = c.arg(command).arg(&study).args(more).arg("--out").arg(out).output().expect("runs");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    };
    hartog("report", &["--optima"], folder.path());
    hartog("run", &["--quiet"], run.path());
    let peaks = |folder: &Path| -> Vec<(String, String)> {
        rows(folder, "designs.csv").iter().map(|r| (r["design"].clone(), r["peak_twist_deg"].clone())).collect()
    };
    let found = peaks(run.path());
    assert!(found.iter().any(|d| d.0.starts_with("optimum_")));
    assert_eq!(peaks(folder.path()), found);
    let torques = rows(folder.path(), "shaft_torques.csv");
    let largest = |condition: &str| {
        let own = torques.iter().filter(|r| r["design"].starts_with("optimum_") && r["condition"] == condition);
        own.map(|r| value(r, "torque_n_m")).fold(0.0, f64::max)
    };
    assert!(largest("absorber_locked") > 1.2 * largest("firing") && largest("misfire") > 0.0, "{torques:?}");
}

/// A misfire is looked at although the study does not ask for it; the page needs nothing from elsewhere and has every part that is asked for; nothing is searched for.
#[test]
fn the_page_has_every_part() {
    let folder = tempfile::tempdir().expect("folder");
    let printed = report("villalva_i6_catalogue", folder.path());
    assert!(printed.contains("Critical speeds of the chain") && printed.contains("classification.html"));
    let page = std::fs::read_to_string(folder.path().join("classification.html")).expect("a page");
    for part in [
        "The model",
        "Holzer's tables",
        "Sums of phase vectors",
        "Critical speeds",
        "Vibratory torque of the shafts",
        "Conditions",
        "misfire",
        "Limits",
        "Where this comes from",
    ] {
        assert!(page.contains(part), "{part}");
    }
    assert!(!page.contains("src=\"http") && !page.contains("href=") && !page.contains("<script"));
    assert!(!folder.path().join("optima.csv").exists());
    let torques = rows(folder.path(), "shaft_torques.csv");
    assert!(torques.len() > 7 && torques.iter().all(|r| value(r, "torque_n_m") > 0.0));
}
