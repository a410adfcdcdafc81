//! What campaigns cost: a million values, a shard of one case, and the fleet that ships. Times are printed and held to nothing: they are those of the machine.

use crate::campaigns::{files, hartog, rows, said};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

/// The six with one tuned damper of many stiffnesses and dampings.
fn six(points: usize, per_shard: usize, more: &str) -> String {
    let study = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/villalva_i6.toml");
    format!(
        r#"
study = "{}"
each = "evaluate"
cases_per_shard = {per_shard}
{more}
[[vary]]
name = "designs"
[[vary.variant]]
name = "one"
set = [
  'conditions=["firing"]',
  'objective=[{{ peak_twist = {{ from = "pulley", to = "flywheel" }} }}]',
  'design=[{{ name = "own", absorber = [{{ on.station = "pulley", type.tuned = {{ ring_inertia_kg_m2 = 0.076, stiffness_n_m_per_rad = 158e3, damping_n_m_s_per_rad = 34.2 }} }}] }}]',
]
[sample]
method = "sobol"
points = {points}
[[sample.of]]
key = "design.0.absorber.0.type.tuned.stiffness_n_m_per_rad"
uniform = [2e4, 2e5]
[[sample.of]]
key = "design.0.absorber.0.type.tuned.damping_n_m_s_per_rad"
uniform = [5, 80]
"#,
        study.display()
    )
}

/// Processor time of children that have ended, s.
fn of_children() -> f64 {
    let stat = fs::read_to_string("/proc/self/stat").expect("Linux");
    let after = stat.rsplit(')').next().expect("a name");
    let field = |i: usize| after.split_whitespace().nth(i).and_then(|x| x.parse::<f64>().ok()).expect("ticks");
    // cutime and cstime, in hundredths of a second
    (field(13) + field(14)) / 100.0
}

/// Most memory that any process in this folder has had while another one ran, MB.
fn run_watched(folder: &Path, arguments: &[&str]) -> f64 {
    let mut child = std::process::Command::new(assert_cmd::cargo::cargo_bin("hartog"));
    let mut child = child.current_dir(folder).args(arguments).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("started");
    let mut most = 0.0_f64;
    let own = |entry: &fs::DirEntry| fs::read_link(entry.path().join("cwd")).is_ok_and(|cwd| cwd == folder);
    while child.try_wait().expect("a state").is_none() {
        for process in fs::read_dir("/proc").expect("Linux").filter_map(Result::ok).filter(own) {
            let status = fs::read_to_string(process.path().join("status")).unwrap_or_default();
            let peak = status.lines().find_map(|l| l.strip_prefix("VmHWM:")).and_then(|l| l.split_whitespace().next()?.parse::<f64>().ok());
            most = most.max(peak.unwrap_or(0.0) / 1024.0);
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    assert!(child.wait().expect("ended").success());
    most
}

/// A million values of the six by tables, by one worker and by two: the same bytes; time, processor time and memory are printed, the last of which does not grow with the number of cases.
#[test]
#[ignore = "two minutes; Linux"]
fn a_million_values_of_the_six() {
    let made = |points: usize, workers: &str| {
        let place = tempfile::tempdir().expect("folder");
        let folder = place.path().canonicalize().expect("a path");
        fs::write(folder.join("own.toml"), six(points, 50_000, "tolerance = 1e-3")).expect("written");
        let plan = hartog(&folder, &["campaign", "plan", "own.toml", "--out", "out"]);
        assert!(plan.status.success(), "{}", said(&plan));
        let (begun, before) = (Instant::now(), of_children());
        let memory = run_watched(&folder, &["campaign", "run", "out", "--workers", workers]);
        let (time, processor) = (begun.elapsed().as_secs_f64(), of_children() - before);
        println!("{points} values, {workers} worker(s): {time:.1} s, {processor:.1} processor-seconds, at most {memory:.0} MB a process");
        (files(&folder.join("out")), time, processor, memory)
    };
    let few = made(100_000, "2");
    let (one, two) = (made(1_000_000, "1"), made(1_000_000, "2"));
    assert!(one.0 == two.0, "the same tables and receipts");
    println!("efficiency of two workers: {:.2} in time, {:.2} in processor time", one.1 / (2.0 * two.1), one.2 / two.2);
    assert!(two.3 < 1.2 * few.3 + 20.0, "{} MB of a million, {} MB of a tenth of it", two.3, few.3);
}

/// What a shard costs beside its cases, with one case each: printed.
#[test]
#[ignore = "prints what a shard costs"]
fn a_shard_of_one_case() {
    let place = tempfile::tempdir().expect("folder");
    fs::write(place.path().join("own.toml"), six(40, 1, "")).expect("written");
    assert!(hartog(place.path(), &["campaign", "plan", "own.toml", "--out", "out"]).status.success());
    let mut times: Vec<f64> = (0..40)
        .map(|i| {
            let begun = Instant::now();
            assert!(hartog(place.path(), &["campaign", "run", "out", "--shard", &i.to_string()]).status.success());
            begun.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!("a shard of one case: {:.0} ms (median of 40)", 1e3 * times[20]);
    assert_eq!(rows(&place.path().join("out")).len(), 40);
}

/// The fleet that ships: three engines at four loads with three families in three climates, 32 samples each. Mendes' pressure was measured at full load only, so that its other loads are refused; every other case has an optimum, of
/// which a handful with lossy rubber end before their first-order conditions are met.
#[test]
#[ignore = "three minutes"]
fn the_fleet_that_ships() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let out = tempfile::tempdir().expect("folder");
    let folder = out.path().display().to_string();
    let begun = Instant::now();
    assert!(hartog(root, &["campaign", "plan", "studies/campaigns/fleet.toml", "--out", &folder]).status.success());
    assert_eq!(hartog(root, &["campaign", "run", &folder]).status.code(), Some(1));
    println!("the fleet: {:.0} s", begun.elapsed().as_secs_f64());
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    let own = rows(out.path());
    own.iter().for_each(|row| *counts.entry(row["status"].clone()).or_default() += 1);
    println!("{counts:?}");
    let of_mendes = own.iter().filter(|row| row["engine"] == "mendes_mwm6" && row["load_fraction"] != "1.0").count();
    assert_eq!((own.len(), counts["refused"], of_mendes), (3456, 864, 864));
    assert!(counts["ok"] >= 2580 && counts["ok"] + counts.get("not_converged").unwrap_or(&0) == 2592, "{counts:?}");
    let page = hartog(root, &["campaign", "collect", &folder]);
    assert!(page.status.code() == Some(1) && out.path().join("campaign.html").is_file(), "{}", said(&page));
}
