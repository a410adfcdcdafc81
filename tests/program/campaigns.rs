//! `hartog campaign`: shards are functions of the campaign and their number to bytes; whatever is killed, repeated, reordered or damaged, the tables come out the same or are refused by name.

use assert_cmd::Command;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

pub(crate) fn hartog(folder: &Path, arguments: &[&str]) -> Output {
    Command::cargo_bin("hartog").expect("built").current_dir(folder).args(arguments).output().expect("it ran")
}

pub(crate) fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
}

/// Den Hartog's problem with other rings, each with its optimum, in shards of four.
pub(crate) const OPTIMA: &str = r#"
study = "studies/den_hartog.toml"
each = "optimise"
cases_per_shard = 4
[[vary]]
key = "optimise.absorber.0.types"
name = "family"
values = [["tuned"], ["viscous"]]
[sample]
method = "sobol"
points = 8
[[sample.of]]
key = "optimise.absorber.0.size.inertia_ratio.fixed"
name = "inertia_ratio"
uniform = [0.05, 0.5]
"#;

/// Two parameters of one design of that problem.
const VALUES: &str = r#"
study = "studies/den_hartog.toml"
each = "evaluate"
cases_per_shard = 50
[[vary]]
name = "designs"
[[vary.variant]]
name = "one"
set = ['design=[{ name = "own", absorber = [{ on.station = "engine", type.tuned = { ring_inertia_kg_m2 = 0.1, stiffness_n_m_per_rad = 800, damping_n_m_s_per_rad = 3 } }] }]']
[sample]
method = "latin_hypercube"
points = 200
[[sample.of]]
key = "design.own.absorber.0.type.tuned.stiffness_n_m_per_rad"
uniform = [600, 1000]
[[sample.of]]
key = "design.own.absorber.0.type.tuned.damping_n_m_s_per_rad"
normal = { mean = 3.4, deviation = 0.3 }
"#;

/// A folder with the campaign and what it reads.
pub(crate) fn place(campaign: &str) -> tempfile::TempDir {
    let place = tempfile::tempdir().expect("folder");
    let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies");
    fs::create_dir_all(place.path().join("studies/engines")).expect("made");
    for name in ["den_hartog.toml", "engines/den_hartog.toml", "engines/den_hartog_harmonics.csv"] {
        fs::copy(from.join(name), place.path().join("studies").join(name)).expect("copied");
    }
    fs::write(place.path().join("own.toml"), campaign).expect("written");
    place
}

pub(crate) fn planned(campaign: &str) -> tempfile::TempDir {
    let place = place(campaign);
    let plan = hartog(place.path(), &["campaign", "plan", "own.toml", "--out", "out"]);
    assert!(plan.status.success(), "{}", said(&plan));
    place
}

/// All files below a folder but the page, by their names.
pub(crate) fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut list = BTreeMap::new();
    for part in ["cases", "receipts"] {
        let mut folders = vec![folder.join(part)];
        while let Some(own) = folders.pop() {
            for entry in fs::read_dir(own).into_iter().flatten().filter_map(Result::ok) {
                let path = entry.path();
                if path.is_dir() {
                    folders.push(path);
                } else {
                    list.insert(path.strip_prefix(folder).expect("inside").to_path_buf(), fs::read(&path).expect("a file"));
                }
            }
        }
    }
    list
}

pub(crate) fn run(place: &Path, more: &[&str]) -> Output {
    hartog(place, &[&["campaign", "run", "out"], more].concat())
}

/// The two-mass problem's optima are those of Nishihara & Asami's closed form, and of the fixed point of a ring without spring, (2 + mu)/mu static twists.
#[test]
fn optima_are_the_closed_forms() {
    hold_closed_forms(OPTIMA, 16);
}

/// The same of ten thousand.
#[test]
#[ignore = "two minutes on two processors"]
fn ten_thousand_optima_are_the_closed_forms() {
    hold_closed_forms(&OPTIMA.replace("points = 8", "points = 5000").replace("cases_per_shard = 4", "cases_per_shard = 100"), 10_000);
}

fn hold_closed_forms(campaign: &str, count: usize) {
    let place = planned(campaign);
    let done = run(place.path(), &["--workers", "2"]);
    assert_eq!(done.status.code(), Some(0), "{}", said(&done));
    let rows = rows(&place.path().join("out"));
    assert_eq!(rows.len(), count);
    let degrees = |twist: f64| twist.to_degrees() * 1e-4;
    for row in &rows {
        let number = |name: &str| row[name].parse::<f64>().unwrap_or_else(|_| panic!("{name}: {row:?}"));
        let (mu, peak) = (number("inertia_ratio"), number("peak_twist_deg"));
        let exact = if row["types"] == "viscous" { degrees((2.0 + mu) / mu) } else { degrees(largest_amplitude(mu)) };
        assert!((peak / exact - 1.0).abs() < 1e-8, "{row:?}: {exact}");
        assert_eq!((row["status"].as_str(), row["family"].as_str()), ("ok", row["types"].as_str()));
    }
}

/// The largest amplitude over the static one of Den Hartog's problem with the exact tuning and damping \[Nishihara & Asami 2002\], by a fine search round both of its peaks.
fn largest_amplitude(mu: f64) -> f64 {
    let (f, z) = hartog::absorber::closed_forms::h_infinity(mu);
    let at = |g: f64| {
        let above = (2.0 * z * g).powi(2) + (f * f - g * g).powi(2);
        let below =
            (2.0 * z * g).powi(2) * (1.0 - g * g - mu * g * g).powi(2) + ((1.0 - g * g) * (f * f - g * g) - mu * f * f * g * g).powi(2);
        (above / below).sqrt()
    };
    let step = 1e-4;
    let first = (1..20_000).map(|i| f64::from(i) * step).max_by(|a, b| at(*a).total_cmp(&at(*b))).expect("some");
    let fine = |i: i32| at(first + f64::from(i) * 1e-8);
    (-10_000..=10_000).map(fine).fold(0.0, f64::max)
}

/// Rows of the tables by their columns.
pub(crate) fn rows(out: &Path) -> Vec<BTreeMap<String, String>> {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    let mut list = Vec::new();
    for (path, _) in files(out).into_iter().filter(|f| f.0.extension().is_some_and(|e| e == "parquet")) {
        let reader = SerializedFileReader::new(fs::File::open(out.join(path)).expect("a table")).expect("Parquet");
        for row in reader.get_row_iter(None).expect("rows") {
            let row = row.expect("a row");
            let cell = |field: &parquet::record::Field| field.to_string().trim_matches('"').to_owned();
            list.push(row.get_column_iter().map(|(name, field)| (name.clone(), cell(field))).collect());
        }
    }
    list.sort_by_key(|row: &BTreeMap<String, String>| row["case"].parse::<usize>().expect("a number"));
    list
}

/// Equals itself: one worker, two, shards in reverse order, one by one, one of them twice.
#[test]
fn tables_do_not_depend_on_who_makes_them_and_when() {
    let all = |more: &[&[&str]]| {
        let place = planned(VALUES);
        more.iter().for_each(|own| assert_eq!(run(place.path(), own).status.code(), Some(0)));
        files(&place.path().join("out"))
    };
    let one = all(&[&["--workers", "1"]]);
    assert_eq!(one.len(), 8, "four tables and their receipts");
    assert!(one == all(&[&["--workers", "2"]]));
    assert!(one == all(&[&["--reversed", "--workers", "2"]]));
    assert!(one == all(&[&["--shard", "3"], &["--shard", "0"], &["--shard", "3"], &["--shard", "2"], &["--shard", "1"]]));
}

/// The values are those of `hartog run` of the same design.
#[test]
fn values_are_those_of_a_run() {
    let place = planned(VALUES);
    assert_eq!(run(place.path(), &[]).status.code(), Some(0));
    for row in rows(&place.path().join("out")).iter().step_by(67) {
        let (k, c) = (&row["stiffness_n_m_per_rad"], &row["damping_n_m_s_per_rad"]);
        let design = format!(
            "design=[{{ name = \"own\", absorber = [{{ on.station = \"engine\", type.tuned = {{ ring_inertia_kg_m2 = 0.1, stiffness_n_m_per_rad = {k}, damping_n_m_s_per_rad = {c} }} }}] }}]"
        );
        let run = hartog(place.path(), &["run", "studies/den_hartog.toml", "--set", &design, "--out", "own", "--quiet"]);
        assert!(run.status.success(), "{}", said(&run));
        let mut table = csv::Reader::from_path(place.path().join("own/designs.csv")).expect("a table");
        let column = table.headers().expect("heads").iter().position(|h| h == "peak_twist_deg").expect("a column");
        let twist: f64 = table.records().next().expect("a row").expect("a row")[column].parse().expect("a number");
        let own: f64 = row["peak_twist_deg"].parse().expect("a number");
        // rounding alone: a run keeps the phasors of its peaks, a campaign asks for the values
        assert!((own / twist - 1.0).abs() < 1e-14, "{own} {twist}");
    }
}

/// A campaign goes on where it was killed; what is torn or lost is made again, and nothing else.
#[test]
fn what_is_killed_torn_or_lost_is_made_again() {
    let whole = {
        let place = planned(OPTIMA);
        assert_eq!(run(place.path(), &["--workers", "1"]).status.code(), Some(0));
        files(&place.path().join("out"))
    };
    let place = planned(OPTIMA);
    let out = place.path().join("out");
    let status = hartog(place.path(), &["campaign", "status", "out", "--missing"]);
    assert_eq!((status.status.code(), String::from_utf8_lossy(&status.stdout).into_owned()), (Some(3), "0\n1\n2\n3\n".to_owned()));
    let collect = hartog(place.path(), &["campaign", "collect", "out"]);
    assert_eq!(collect.status.code(), Some(3), "{}", said(&collect));
    assert!(said(&collect).contains("4 of 4 shards are missing"), "{}", said(&collect));
    // the coordinator and its workers are killed while they work, all of them: what goes on would mend what is damaged below
    #[cfg(unix)]
    for wait in [30, 60, 120] {
        use std::os::unix::process::CommandExt;
        let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin("hartog"));
        command.current_dir(place.path()).args(["campaign", "run", "out", "--workers", "2"]).process_group(0);
        let mut child = command.spawn().expect("started");
        std::thread::sleep(std::time::Duration::from_millis(wait));
        let group = format!("-{}", child.id());
        assert!(std::process::Command::new("kill").args(["-9", "--", &group]).status().expect("kill runs").success());
        child.wait().expect("ended");
    }
    assert_eq!(run(place.path(), &[]).status.code(), Some(0));
    assert!(files(&out).iter().filter(|f| !f.0.to_string_lossy().contains(".hartog-")).eq(whole.iter()), "after kills");
    // a table that is cut, one that is changed without another size, a receipt that is gone, one that is none
    let table = |i: usize| whole.keys().filter(|p| p.extension().is_some_and(|e| e == "parquet")).nth(i).expect("a table");
    fs::write(out.join(table(0)), &whole[table(0)][..100]).expect("written");
    let mut changed = whole[table(1)].clone();
    changed[200] ^= 1;
    fs::write(out.join(table(1)), changed).expect("written");
    fs::remove_file(out.join("receipts/00002.json")).expect("removed");
    fs::write(out.join("receipts/00003.json"), "{\"campaign\": 1}").expect("written");
    let torn = hartog(place.path(), &["campaign", "collect", "out"]);
    assert_eq!(torn.status.code(), Some(3));
    assert!(said(&torn).contains("4 of 4 shards are missing; the tables of 0, 1 are not as they were written"), "{}", said(&torn));
    assert_eq!(run(place.path(), &[]).status.code(), Some(0));
    let collect = hartog(place.path(), &["campaign", "collect", "out"]);
    assert_eq!(collect.status.code(), Some(0), "{}", said(&collect));
    assert!(files(&out) == whole, "made again, and what kills have left is gone");
    assert!(fs::read_to_string(out.join("campaign.html")).expect("a page").contains("Distributions of results"));
}

/// Another program, changed inputs, other campaigns and files of others are named, and nothing of them is lost.
#[test]
fn what_has_changed_or_is_of_others_is_refused_by_name() {
    let place = planned(VALUES);
    let out = place.path().join("out");
    let refused = |arguments: &[&str], words: &str| {
        let found = hartog(place.path(), arguments);
        assert_eq!(found.status.code(), Some(2), "{arguments:?}: {}", said(&found));
        assert!(said(&found).contains(words), "{arguments:?}: {}", said(&found));
    };
    // planned again it is the same campaign; another one goes elsewhere
    assert!(hartog(place.path(), &["campaign", "plan", "own.toml", "--out", "out"]).status.success());
    fs::write(place.path().join("other.toml"), VALUES.replace("200", "100")).expect("written");
    refused(&["campaign", "plan", "other.toml", "--out", "out"], "is of another campaign");
    fs::create_dir_all(place.path().join("foreign/cases")).expect("made");
    refused(&["campaign", "plan", "own.toml", "--out", "foreign"], "is there without a campaign's manifest.json");
    refused(&["campaign", "run", "nothing"], "holds no manifest.json");
    refused(&["campaign", "run", "out", "--shard", "4"], "found shard 4, expected one from 0 to 3");
    assert_eq!(run(place.path(), &[]).status.code(), Some(0));
    // a table of somebody else among ours would be read with them
    let foreign = out.join("cases/designs=one/mine.parquet");
    fs::write(&foreign, "mine").expect("written");
    refused(&["campaign", "collect", "out"], "is no table of the campaign");
    assert_eq!(fs::read_to_string(&foreign).expect("there"), "mine");
    fs::remove_file(&foreign).expect("removed");
    let engine = place.path().join("studies/engines/den_hartog.toml");
    let before = fs::read_to_string(&engine).expect("an engine");
    fs::write(&engine, before.replace("1e4", "2e4")).expect("written");
    refused(&["campaign", "run", "out", "--shard", "0"], "den_hartog.toml` is not as it was");
    refused(&["campaign", "collect", "out"], "plan it anew in another folder");
    fs::write(&engine, before).expect("written");
    assert_eq!(hartog(place.path(), &["campaign", "collect", "out"]).status.code(), Some(0));
}

/// A case that is refused, has no finite response or breaks a limit is a row with its status and reason.
#[test]
fn what_has_no_result_is_a_row_with_its_reason() {
    let place = planned(
        r#"
study = "studies/den_hartog.toml"
each = "evaluate"
[[vary]]
key = "design"
name = "ring"
values = [
  [{ name = "bare" }],
  [{ name = "own", absorber = [{ on.station = "engine", type.viscous = { ring_inertia_kg_m2 = 0.1, damping_n_m_s_per_rad = 9.3 } }] }],
  [{ name = "lost", absorber = [{ on.station = "nowhere", type.viscous = { ring_inertia_kg_m2 = 0.1, damping_n_m_s_per_rad = 9.3 } }] }],
]
[[vary]]
key = "constraint"
name = "limit"
values = [[{ peak_twist = { from = "engine", to = "ground", max_deg = 0.5 } }], [{ peak_twist = { from = "engine", to = "ground", max_deg = 0.05 } }]]
"#,
    );
    let done = run(place.path(), &[]);
    assert_eq!(done.status.code(), Some(1), "{}", said(&done));
    let rows = rows(&place.path().join("out"));
    let told: Vec<(&str, bool)> = rows.iter().map(|r| (r["status"].as_str(), r["reason"] == "null")).collect();
    assert_eq!(
        told,
        [("unbounded", false), ("unbounded", false), ("ok", true), ("limits_broken", false), ("refused", false), ("refused", false)]
    );
    assert!(rows[4]["reason"].contains("nowhere"), "{:?}", rows[4]);
}

/// Mistakes in the file of a campaign have their place; those of a study are told with the combination that they are of.
#[test]
fn mistakes_have_their_place() {
    for (from, to, words) in [
        ("method = \"latin_hypercube\"", "method = \"latin\"", "found `latin`, expected `sobol`, `latin_hypercube`, `full` or `file`"),
        ("points = 200", "points = 0", "found 0, expected a whole number from 1 to 10000000"),
        ("uniform = [600, 1000]", "uniform = [1000, 600]", "found no range, expected two values, the lower one first"),
        ("deviation = 0.3", "deviation = 0", "found 0, expected a number above zero"),
        ("studies/den_hartog.toml", "studies/none.toml", "file not found"),
        ("[sample]", "partition = \"x\"\n[sample]", "found unknown key `partition`"),
        ("each = \"evaluate\"", "each = \"evaluate\"\npartition = \"x\"", "found `x`, expected the name of a [[vary]]"),
        ("each = \"evaluate\"", "each = \"optimise\"\ntolerance = 1e-3", "found `tolerance` beside a search"),
        ("set = ['design=", "set = ['load_fraction', 'design=", "found `load_fraction`, expected KEY=VALUE"),
        (
            "type.tuned.stiffness_n_m_per_rad\"",
            "type.tuned.damping_n_m_s_per_rad\"",
            "found the column `damping_n_m_s_per_rad` a second time",
        ),
        ("name = \"designs\"", "name = \"Status\"", "found `Status`, which every table has"),
        ("[sample]\n", "[[vary]]\nname = \"again\"\nkey = \"design\"\nvalues = [[]]\n[sample]\n", "among the keys of another [[vary]]"),
        ("ring_inertia_kg_m2 = 0.1", "ring_inertia_kg_m2 = -1", "so of one and every other combination"),
    ] {
        assert!(VALUES.contains(from), "{from}");
        let place = place(&VALUES.replacen(from, to, 1));
        let plan = hartog(place.path(), &["campaign", "plan", "own.toml", "--out", "out"]);
        assert_eq!(plan.status.code(), Some(2), "{to}: {}", said(&plan));
        assert!(said(&plan).replace('\n', " ").contains(words) && said(&plan).contains(" --> "), "{to}: {}", said(&plan));
        assert!(!place.path().join("out").exists(), "{to}");
    }
    let key = |i: usize| format!("[[sample.of]]\nkey = \"design.{i}\"\nname = \"k{i}\"\nuniform = [0, 1]\n");
    let many = "study = \"studies/den_hartog.toml\"\neach = \"evaluate\"\n[sample]\nmethod = \"sobol\"\npoints = 2\n".to_owned();
    let place = place(&(many + &(0..101).map(key).collect::<String>()));
    let plan = hartog(place.path(), &["campaign", "plan", "own.toml", "--out", "out"]);
    assert!(
        plan.status.code() == Some(2) && said(&plan).contains("found 101 keys of Sobol's sequence, expected at most 100"),
        "{}",
        said(&plan)
    );
}

/// A case is what `--set` makes of it, in shards of any size: a design by its number before its name, whole numbers where a key takes these, and the objective where a key has its column.
#[test]
fn a_case_is_what_set_makes_of_it() {
    let ring = "absorber = [{ on.station = \"engine\", type.tuned = { ring_inertia_kg_m2 = 0.1, stiffness_n_m_per_rad = 800, damping_n_m_s_per_rad = 3 } }]";
    let campaign = |size: usize| {
        format!(
            "study = \"studies/den_hartog.toml\"\neach = \"evaluate\"\ncases_per_shard = {size}\n[[vary]]\nname = \"designs\"\n[[vary.variant]]\nname = \"two\"\n\
             set = ['design=[{{ name = \"1\", {ring} }}, {{ name = \"b\", {ring} }}]']\n[sample]\nmethod = \"full\"\npoints = 3\n\
             [[sample.of]]\nkey = \"design.1.absorber.0.type.tuned.damping_n_m_s_per_rad\"\nname = \"peak_twist_deg\"\nuniform = [1, 5]\n"
        )
    };
    let all = |size: usize| {
        let place = planned(&campaign(size));
        assert_eq!(run(place.path(), &[]).status.code(), Some(0));
        let collected = hartog(place.path(), &["campaign", "collect", "out"]);
        assert_eq!(collected.status.code(), Some(0), "{}", said(&collected));
        (rows(&place.path().join("out")), said(&collected))
    };
    let (together, told) = all(3);
    assert_eq!(together, all(1).0, "in one shard as in three");
    for row in &together {
        let own = if row["design"] == "b" { row["peak_twist_deg"].parse::<f64>().expect("a number") } else { 3.0 };
        let damping: f64 = row["damping_n_m_s_per_rad"].parse().expect("a number");
        assert_eq!(damping, own, "{row:?}");
    }
    let least = together.iter().map(|r| r["peak_twist_deg_found"].parse::<f64>().expect("a number")).fold(f64::INFINITY, f64::min);
    assert!(told.contains(&format!("{least:.5}")), "{told}, {least}");

    let seeds = "[sample]\nmethod = \"full\"\npoints = 2\n[[sample.of]]\nkey = \"optimise.seed\"\ntable = { values = [1, 2], shares = [0.5, 0.5] }\n";
    let place = planned(&(OPTIMA[..OPTIMA.find("[sample]").expect("a sample")].to_owned() + seeds));
    assert_eq!(run(place.path(), &[]).status.code(), Some(0), "whole numbers are whole");
}
