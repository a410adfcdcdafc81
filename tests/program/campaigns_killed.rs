//! Campaigns whose workers are killed, whose cases end the program, whose files are edited, and that schedulers run.

use super::campaigns::{OPTIMA, files, hartog, place, planned, rows, run, said};
use std::fs;
use std::path::{Path, PathBuf};

/// What a pattern finds later, receipts and manifests that were edited, and files of others in the folder: each is refused by name, and nothing of it is lost.
#[test]
fn what_was_edited_or_came_later_is_refused() {
    let place = place(
        &OPTIMA.replace("[sample]", "[[vary]]\nkey = \"engine\"\nfiles = \"motors/*.toml\"\n[sample]").replace("points = 8", "points = 1"),
    );
    fs::create_dir_all(place.path().join("motors")).expect("made");
    let copy = |name: &str| {
        let engine = fs::read_to_string(place.path().join("studies/engines/den_hartog.toml")).expect("an engine");
        fs::write(
            place.path().join("motors").join(name),
            engine.replace("den_hartog_harmonics", "../studies/engines/den_hartog_harmonics"),
        )
        .expect("written");
    };
    copy("m.toml");
    let of = |arguments: &[&str]| hartog(place.path(), &[&["campaign"], arguments].concat());
    let refused = |arguments: &[&str], words: &str| {
        let found = of(arguments);
        assert!(matches!(found.status.code(), Some(2 | 3)) && said(&found).contains(words), "{arguments:?}: {}", said(&found));
    };
    assert!(of(&["plan", "own.toml", "--out", "out"]).status.success());
    copy("a.toml");
    refused(&["run", "out"], "find other files than they did");
    fs::remove_file(place.path().join("motors/a.toml")).expect("removed");
    assert_eq!(of(&["run", "out"]).status.code(), Some(0));
    let out = place.path().join("out");
    let edited = |name: &str, from: &str, to: &str| {
        let before = fs::read_to_string(out.join(name)).expect("a file");
        assert!(before.contains(from), "{before}");
        fs::write(out.join(name), before.replace(from, to)).expect("written");
        before
    };
    let before = edited("receipts/00000.json", "\"rows\":1", "\"rows\":5");
    refused(&["collect", "out"], "1 of 2 shards are missing");
    fs::write(out.join("receipts/00000.json"), &before).expect("written");
    edited("receipts/00000.json", "\"rows\":1", "\"rows\":2");
    edited("receipts/00000.json", "\"ok\":1", "\"ok\":2");
    refused(&["collect", "out"], "its rows are not the 2 of its receipt");
    fs::write(out.join("receipts/00000.json"), before).expect("written");
    let before = edited("manifest.json", "\"cases_per_shard\": 4", "\"cases_per_shard\": 0");
    refused(&["run", "out"], "what it says is not what its address was made of");
    fs::write(out.join("manifest.json"), before).expect("written");
    for (name, arguments, words) in [
        ("campaign.html", ["collect", "out"].as_slice(), "is no page of a campaign"),
        ("submit.sh", &["export", "out", "--for", "slurm"], "is another file"),
        ("Snakefile", &["export", "out", "--for", "snakemake"], "is another file"),
    ] {
        fs::write(out.join(name), "mine").expect("written");
        refused(arguments, words);
        assert_eq!(fs::read_to_string(out.join(name)).expect("there"), "mine");
        fs::remove_file(out.join(name)).expect("removed");
        assert_eq!(of(arguments).status.code(), Some(0));
        assert_eq!(of(arguments).status.code(), Some(0), "once more");
    }
    let line = String::from_utf8(of(&["export", "out", "--for", "parallel"]).stdout).expect("text");
    assert!(line.lines().count() == 1 && line.contains("--missing | parallel"), "{line}");
}

/// Workers of a campaign, by the words they were started with.
#[cfg(target_os = "linux")]
fn workers(out: &Path) -> Vec<String> {
    let is_worker = |pid: &String| {
        let words = fs::read(format!("/proc/{pid}/cmdline")).unwrap_or_default();
        let words = String::from_utf8_lossy(&words).into_owned();
        words.contains(&*out.to_string_lossy()) && words.contains("--shard")
    };
    let pids = fs::read_dir("/proc").expect("processes").filter_map(|e| e.ok()?.file_name().into_string().ok());
    pids.filter(|p| p.bytes().all(|b| b.is_ascii_digit())).filter(is_worker).collect()
}

/// Equals itself: fifty workers and five coordinators are killed at random; shards that were done are not made again.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "a minute of kills"]
fn fifty_kills_of_workers_and_five_of_coordinators_change_nothing() {
    use rand::{Rng, SeedableRng};
    let campaign = OPTIMA.replace("points = 8", "points = 400").replace("cases_per_shard = 4", "cases_per_shard = 20");
    let whole = {
        let place = planned(&campaign);
        assert_eq!(run(place.path(), &[]).status.code(), Some(0));
        files(&place.path().join("out"))
    };
    let place = planned(&campaign);
    let out = place.path().join("out");
    let mut generator = rand_xoshiro::Xoshiro256PlusPlus::seed_from_u64(1);
    let kill = |pid: &str| std::process::Command::new("kill").args(["-9", pid]).status().expect("kill runs").success();
    let mut killed = 0;
    for _ in 0..5 {
        let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin("hartog"));
        let arguments = ["campaign", "run", &out.to_string_lossy(), "--workers", "2"];
        let mut coordinator = command.args(arguments).stderr(std::process::Stdio::null()).spawn().expect("started");
        let mut own = 0;
        while own < 10 && coordinator.try_wait().expect("a child").is_none() {
            std::thread::sleep(std::time::Duration::from_millis(generator.random_range(20..120)));
            let all = workers(&out);
            if !all.is_empty() && kill(&all[generator.random_range(0..all.len())]) {
                own += 1;
            }
        }
        killed += own;
        coordinator.kill().expect("killed");
        coordinator.wait().expect("ended");
    }
    assert_eq!(killed, 50);
    let done: Vec<PathBuf> = files(&out).into_keys().filter(|p| p.starts_with("receipts") && p.extension().is_some()).collect();
    let written = |p: &PathBuf| fs::metadata(out.join(p)).expect("there").modified().expect("a time");
    let times: Vec<_> = done.iter().map(written).collect();
    assert_eq!(run(place.path(), &[]).status.code(), Some(0));
    assert_eq!(times, done.iter().map(written).collect::<Vec<_>>(), "what was done stays");
    assert_eq!(hartog(place.path(), &["campaign", "collect", "out"]).status.code(), Some(0));
    assert!(files(&out) == whole);
}

/// A case that ends the program costs its own row, and no other.
#[test]
#[ignore = "needs HARTOG_POISONED, a program built with --features poison"]
fn a_case_that_ends_the_program_is_a_row() {
    let program =
        std::env::var("HARTOG_POISONED").expect("HARTOG_POISONED names a program built with `cargo build --release --features poison`");
    let place = place(OPTIMA);
    let of = |arguments: &[&str], poisoned: &str| {
        let mut command = std::process::Command::new(&program);
        command.current_dir(place.path()).args(arguments).env("HARTOG_POISON", poisoned).output().expect("it ran")
    };
    assert!(of(&["campaign", "plan", "own.toml", "--out", "out"], "").status.success());
    let died = of(&["campaign", "run", "out"], "6");
    assert_eq!(died.status.code(), Some(3), "{}", said(&died));
    assert!(said(&died).contains("shard 1 ended its program 3 times (signal 6); --isolate finds the case that does it"), "{}", said(&died));
    let isolated = of(&["campaign", "run", "out", "--isolate"], "6");
    assert_eq!(isolated.status.code(), Some(1), "{}", said(&isolated));
    let all = rows(&place.path().join("out"));
    let crashed: Vec<&str> = all.iter().filter(|r| r["status"] == "crashed").map(|r| r["case"].as_str()).collect();
    assert_eq!((all.len(), crashed), (16, vec!["6"]));
}

/// One digest from one worker, two, reversed shards, GNU parallel, an array of Slurm, another one whose slurmd is killed, and Snakemake, locally and by Slurm: see `tests/schedulers/run`, which sets them up from nothing.
#[test]
#[ignore = "needs root on Debian: installs and runs Slurm, Snakemake and GNU parallel, six minutes"]
fn schedulers_make_the_same_tables() {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/schedulers/run");
    let mut command = std::process::Command::new("bash");
    let output = command.arg(script).env("HARTOG", assert_cmd::cargo::cargo_bin("hartog")).output().expect("bash runs");
    let told = said(&output);
    println!("{told}");
    assert!(output.status.success() && told.matches("digest of the tables").count() == 8, "{told}");
}

/// A folder on a disk that is full, and on one that may be read only: both are named, what is done stays, and the tables are the same once there is room.
#[test]
#[ignore = "needs root on Linux: mounts small file systems"]
fn full_and_read_only_disks_are_named() {
    let mount = |arguments: &[&str], folder: &str| {
        let done = std::process::Command::new("mount").args(arguments).arg(folder).status().expect("mount runs");
        assert!(done.success(), "{arguments:?}");
    };
    let whole = planned(OPTIMA);
    assert_eq!(run(whole.path(), &[]).status.code(), Some(0));
    let place = planned(OPTIMA);
    let folder = place.path().join("out").display().to_string();
    let manifest = fs::read(place.path().join("out/manifest.json")).expect("a manifest");
    mount(&["-t", "tmpfs", "-o", "size=32k", "none"], &folder);
    fs::write(place.path().join("out/manifest.json"), manifest).expect("written");
    let full = run(place.path(), &["--workers", "1"]);
    assert!(full.status.code() == Some(2) && said(&full).contains("no space is left"), "{}", said(&full));
    mount(&["-o", "remount,ro,size=32k"], &folder);
    let closed = run(place.path(), &["--workers", "1"]);
    assert!(closed.status.code() == Some(2) && said(&closed).contains("Read-only file system"), "{}", said(&closed));
    mount(&["-o", "remount,rw,size=1m"], &folder);
    let done = run(place.path(), &["--workers", "1"]);
    let same = files(&place.path().join("out")) == files(&whole.path().join("out"));
    assert!(std::process::Command::new("umount").arg(&folder).status().expect("umount runs").success());
    assert!(done.status.code() == Some(0) && same, "{}", said(&done));
}
