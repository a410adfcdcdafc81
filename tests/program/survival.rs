//! A run that is killed at any moment goes on to the files of one that was not; what is not as it was written is refused by name.

use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::OnceLock;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Den Hartog's two masses, in half a second by one thread: several optima, two fronts and tolerances.
fn short(folder: &Path) -> String {
    let engine = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/engines/den_hartog.toml");
    let text = format!(
        "engine = {engine:?}\nspeed_rpm = {{ from = 100, to = 2000, step = 20 }}\norder_limit = 1\n\
         [[objective]]\npeak_twist = {{ from = \"engine\", to = \"ground\" }}\n\
         [[design]]\nname = \"given\"\n[[design.absorber]]\non.station = \"engine\"\n\
         type.seeded = {{ by = \"h_infinity\", ring_inertia_kg_m2 = 0.1 }}\n\
         [optimise]\n[[optimise.absorber]]\non.station = \"engine\"\ntypes = [\"tuned\", \"viscous\"]\n\
         size.ring_inertia_kg_m2.each = [0.076]\n[pareto]\npoints = 30\nagainst.ring_inertia_kg_m2 = [0.01, 0.3]\n\
         [robust]\ntolerance = {{ stiffness_n_m_per_rad = 0.1 }}\n"
    );
    let path = folder.join("short.toml");
    fs::write(&path, text).expect("written");
    path.to_string_lossy().into_owned()
}

fn hartog(arguments: &[&str]) -> Command {
    let mut c = Command::new(env!("CARGO_BIN_EXE_hartog"));
    c.current_dir(env!("CARGO_MANIFEST_DIR")).args(arguments).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    c
}

fn run(study: &str, out: &Path, more: &[&str]) -> Command {
    let out = out.to_string_lossy().into_owned();
    hartog(&[&["run", study, "--out", &out], more].concat())
}

fn ended(mut command: Command) -> Output {
    command.output().expect("runs")
}

fn error(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Every file but that of times.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).expect("a folder").map(|e| e.expect("an entry").path());
    let named = entries.map(|p| (p.file_name().expect("a name").to_string_lossy().into_owned(), fs::read(&p).expect("bytes")));
    named.filter(|(name, _)| name != "timing.csv").collect()
}

/// Names of files that differ.
fn differing(a: &BTreeMap<String, Vec<u8>>, b: &BTreeMap<String, Vec<u8>>) -> Vec<String> {
    a.keys().chain(b.keys()).filter(|name| a.get(*name) != b.get(*name)).cloned().collect()
}

/// Runs a study, kills it after a while, and goes on; whether it was still at work when it was killed.
fn killed_and_resumed(study: &str, after: Duration, threads: [&str; 2], expected: &BTreeMap<String, Vec<u8>>) -> bool {
    let folder = tempfile::tempdir().expect("a folder");
    let mut child = run(study, folder.path(), &["--threads", threads[0]]).spawn().expect("starts");
    sleep(after);
    let at_work = child.try_wait().expect("a state").is_none();
    child.kill().expect("killed");
    child.wait().expect("gone");
    let resumed = ended(run(study, folder.path(), &["--resume", "--threads", threads[1]]));
    assert!(resumed.status.code().is_some_and(|c| c <= 1), "{}", error(&resumed));
    let own = files(folder.path());
    assert!(differing(expected, &own).is_empty(), "killed after {after:?}: {:?} differ", differing(expected, &own));
    at_work
}

/// Kills at random times, all of the run.
fn kills(study: &str, count: usize, threads: &str) -> usize {
    let folder = tempfile::tempdir().expect("a folder");
    let start = Instant::now();
    let whole = ended(run(study, folder.path(), &["--threads", threads]));
    assert!(whole.status.code().is_some_and(|c| c <= 1), "{}", error(&whole));
    let time = start.elapsed();
    println!("{study}: {:.1} s", time.as_secs_f64());
    let expected = files(folder.path());
    assert!(!expected.contains_key("journal.log"), "a complete run needs no journal");
    let mut random = Xoshiro256PlusPlus::seed_from_u64(18);
    (0..count).filter(|_| killed_and_resumed(study, time.mul_f64(random.random()), [threads, threads], &expected)).count()
}

/// That study and the files of a whole run of it, which several tests compare with.
fn whole() -> &'static (String, BTreeMap<String, Vec<u8>>) {
    static WHOLE: OnceLock<(String, BTreeMap<String, Vec<u8>>)> = OnceLock::new();
    WHOLE.get_or_init(|| {
        let place = Path::new(env!("CARGO_TARGET_TMPDIR")).join("survival");
        fs::create_dir_all(&place).expect("a folder");
        let (study, out) = (short(&place), tempfile::tempdir().expect("a folder"));
        ended(run(&study, out.path(), &[]));
        (study, files(out.path()))
    })
}

/// What a run that is killed once it has done so many searches has left of its journal.
fn journal_left(study: &str, folder: &Path, searches: usize) -> PathBuf {
    let journal = folder.join("journal.log");
    let mut child = run(study, folder, &["--threads", "1"]).spawn().expect("starts");
    let lines = || fs::read(&journal).map_or(0, |bytes| bytes.iter().filter(|b| **b == b'\n').count());
    while lines() <= searches {
        assert!(child.try_wait().expect("a state").is_none(), "it ended before it could be killed");
        sleep(Duration::from_millis(1));
    }
    child.kill().expect("killed");
    child.wait().expect("gone");
    journal
}

/// A run that was killed goes on by another number of threads to the same files, whatever it had done.
#[test]
fn killed_runs_go_on() {
    let (study, expected) = whole();
    assert!(!expected.contains_key("journal.log"), "a complete run needs no journal");
    for (searches, threads) in [(0, "8"), (10, "2"), (60, "1")] {
        let folder = tempfile::tempdir().expect("a folder");
        journal_left(study, folder.path(), searches);
        ended(run(study, folder.path(), &["--resume", "--threads", threads]));
        let own = files(folder.path());
        assert!(differing(expected, &own).is_empty(), "after {searches} searches: {:?} differ", differing(expected, &own));
    }
}

/// The same of a run of a minute and more, fifty times.
#[test]
#[ignore = "an hour"]
fn fifty_kills_of_a_long_run() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies");
    let inputs = tempfile::tempdir().expect("a folder");
    let study = inputs.path().join("limits.toml");
    let text = fs::read_to_string(root.join("villalva_i6_limits.toml")).expect("a study");
    let longer = text.replace("engines/", &format!("{}/engines/", root.display())).replace("points = 24", "points = 40");
    fs::write(&study, longer).expect("written");
    assert!(kills(&study.to_string_lossy(), 52, "1") >= 40);
}

/// Bytes of a journal changed, left out or put in at random: refused by the line, or of no consequence.
fn damage(count: usize) {
    let (study, expected) = whole();
    let killed = tempfile::tempdir().expect("a folder");
    let journal = journal_left(study, killed.path(), 10);
    let bytes = fs::read(&journal).expect("bytes");
    let mut random = Xoshiro256PlusPlus::seed_from_u64(4);
    let (mut refused, mut harmless) = (0, 0);
    for _ in 0..count {
        let mut damaged = bytes.clone();
        for _ in 0..random.random_range(1..4) {
            let at = random.random_range(0..damaged.len());
            match random.random_range(0..4) {
                0 => damaged[at] = random.random(),
                1 => damaged[at] ^= 1 << random.random_range(0..8),
                2 => drop(damaged.remove(at)),
                _ => damaged.insert(at, random.random()),
            }
        }
        fs::write(&journal, &damaged).expect("written");
        let output = ended(run(study, killed.path(), &["--resume"]));
        if output.status.code() == Some(2) {
            let text = error(&output);
            assert!(text.contains("journal.log, line ") && text.contains("is damaged"), "{text}");
            refused += 1;
        } else {
            assert!(output.status.success(), "{}", error(&output));
            let own = files(killed.path());
            assert!(differing(expected, &own).is_empty(), "{:?} differ", differing(expected, &own));
            harmless += 1;
        }
    }
    println!("{refused} refused, {harmless} without consequence");
    assert!(refused > 0);
}

/// A damaged journal is refused by its line.
#[test]
fn a_damaged_journal_is_refused() {
    damage(12);
}

/// Ten thousand times.
#[test]
#[ignore = "several minutes"]
fn ten_thousand_damages() {
    damage(10_000);
}

/// A torn last line is left out; a changed study or engine file, another study, or a journal that is cut into is refused with its reason; without `--resume` a run starts anew.
#[test]
fn what_has_changed_refuses_to_go_on() {
    let inputs = tempfile::tempdir().expect("a folder");
    let study = short(inputs.path());
    let killed = tempfile::tempdir().expect("a folder");
    let journal = journal_left(&study, killed.path(), 10);
    let bytes = fs::read(&journal).expect("bytes");
    let resumed = |study: &str| ended(run(study, killed.path(), &["--resume"]));

    let text = fs::read_to_string(&study).expect("a study");
    fs::write(&study, format!("{text}# changed\n")).expect("written");
    let refused = resumed(&study);
    fs::write(&study, text).expect("written");
    assert_eq!(refused.status.code(), Some(2));
    assert!(error(&refused).contains("short.toml` has changed since"), "{}", error(&refused));

    let refused = resumed("studies/den_hartog.toml");
    assert!(error(&refused).contains("short.toml`, this run reads `studies/den_hartog.toml`"), "{}", error(&refused));

    // another program: its own line of another version, with a checksum that is right
    let end = bytes.iter().position(|b| *b == b'\n').expect("a first line");
    let header = String::from_utf8(bytes[9..end].to_vec()).expect("text").replace("hartog 0", "hartog 9");
    let other = [format!("{:08x} {header}", crc32fast::hash(header.as_bytes())).as_bytes(), &bytes[end..]].concat();
    fs::write(&journal, other).expect("written");
    let refused = resumed(&study);
    assert!(error(&refused).contains("it was begun by hartog 9"), "{}", error(&refused));

    // a torn last line
    fs::write(&journal, &bytes[..bytes.len() - 5]).expect("written");
    let known = bytes.iter().filter(|b| **b == b'\n').count() - 2;
    let output = resumed(&study);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(said.contains(&format!("{known} searches of the interrupted run are known")), "{said}");
    assert!(!journal.exists());
    let again = resumed(&study);
    assert!(String::from_utf8_lossy(&again.stdout).contains("from the beginning"));
}

/// An interrupt ends a run with code 130; the best designs so far and an unfinished summary are left, which the run that goes on replaces.
#[cfg(unix)]
#[test]
fn an_interrupt_leaves_what_is_known() {
    let (inputs, folder) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("a folder"));
    let study = short(inputs.path());
    let journal = folder.path().join("journal.log");
    let child = run(&study, folder.path(), &["--threads", "1"]).spawn().expect("starts");
    while fs::read(&journal).map_or(0, |bytes| bytes.len()) < 10_000 {
        sleep(Duration::from_millis(1));
    }
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill");
    assert!(sent.success());
    let output = child.wait_with_output().expect("ends");
    assert_eq!(output.status.code(), Some(130));
    assert!(error(&output).contains("run again with --resume to go on"), "{}", error(&output));
    let table = fs::read_to_string(folder.path().join("unfinished.csv")).expect("a table");
    assert!(table.lines().nth(1).is_some_and(|l| l.contains("ring_inertia_kg_m2") || l.contains("stiffness")), "{table}");
    assert!(fs::read_to_string(folder.path().join("summary.json")).expect("a summary").contains("\"finished\": false"));
    let resumed = ended(run(&study, folder.path(), &["--resume"]));
    assert!(resumed.status.success());
    assert!(!folder.path().join("unfinished.csv").exists());
    assert!(fs::read_to_string(folder.path().join("summary.json")).expect("a summary").contains("\"finished\": true"));
}

/// An interrupt does not wait for threads that are at work: of a run whose one thread has some hundred optima before it, which take minutes, it ends at once what would otherwise end with them. The half minute after which the
/// test gives up only tells the two apart.
#[cfg(unix)]
#[test]
fn an_interrupt_waits_for_no_thread() {
    let (inputs, folder) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("a folder"));
    let study = short(inputs.path());
    let sizes: Vec<String> = (0..450).map(|i| format!("{}", 0.02 + 0.0002 * f64::from(i))).collect();
    let text = fs::read_to_string(&study).expect("a study");
    assert!(text.contains("[0.076]"));
    let text = text.replace("[0.076]", &format!("[{}]", sizes.join(", ")));
    fs::write(&study, text).expect("written");
    let mut child = run(&study, folder.path(), &["--threads", "1"]).spawn().expect("starts");
    let journal = folder.path().join("journal.log");
    while fs::read(&journal).map_or(0, |bytes| bytes.len()) < 10_000 {
        assert!(child.try_wait().expect("a state").is_none(), "it ended before it could be interrupted");
        sleep(Duration::from_millis(1));
    }
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill");
    assert!(sent.success());
    let begun = Instant::now();
    while child.try_wait().expect("a state").is_none() && begun.elapsed() < Duration::from_secs(30) {
        sleep(Duration::from_millis(5));
    }
    let ended = child.try_wait().expect("a state");
    let _gone = child.kill();
    child.wait().expect("gone");
    assert_eq!(ended.and_then(|s| s.code()), Some(130), "it was still at work");
}

/// A run that is killed while it writes its files, over those of an earlier one or not, blocks none: the next has the files of a run that was not killed, and no others.
#[test]
fn a_run_killed_among_its_files_blocks_none() {
    let (study, expected) = whole();
    for earlier in [false, true] {
        let folder = tempfile::tempdir().expect("a folder");
        if earlier {
            ended(run(study, folder.path(), &["--format", "pdf"]));
            fs::write(folder.path().join("notes.txt"), "mine").expect("written");
        }
        let summary = folder.path().join("summary.json");
        let begun = || if earlier { !summary.exists() } else { folder.path().join("response.csv").exists() };
        let mut child = run(study, folder.path(), &["--threads", "1"]).spawn().expect("starts");
        while !begun() {
            assert!(child.try_wait().expect("a state").is_none(), "it ended before it could be killed");
            sleep(Duration::from_millis(1));
        }
        child.kill().expect("killed");
        child.wait().expect("gone");
        let next = ended(run(study, folder.path(), &[]));
        assert!(next.status.success(), "{}", error(&next));
        let mut own = files(folder.path());
        assert_eq!(own.remove("notes.txt").is_some(), earlier);
        assert!(differing(expected, &own).is_empty(), "{:?} differ", differing(expected, &own));
    }
}

/// Where the folder is gone nothing is said to be kept, by a run that ends and by one that is interrupted.
#[cfg(unix)]
#[test]
fn what_is_gone_is_not_kept() {
    let (study, _) = whole();
    for interrupted in [false, true] {
        let place = tempfile::tempdir().expect("a folder");
        let folder = place.path().join("out");
        let journal = folder.join("journal.log");
        let child = run(study, &folder, &["--threads", "1"]).spawn().expect("starts");
        while fs::read(&journal).map_or(0, |bytes| bytes.len()) < 5_000 {
            sleep(Duration::from_millis(1));
        }
        fs::remove_dir_all(&folder).expect("removed");
        if interrupted {
            assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill").success());
        }
        let text = error(&child.wait_with_output().expect("ends"));
        assert!(text.contains("its journal is gone") && !text.contains("kept") && !text.contains("--resume"), "{text}");
    }
}

/// On a full disk, here one on which no file may grow beyond a size, the run says what it could not write, leaves no half of a file, and keeps what its searches have found, a torn last line apart:
/// once there is space it goes on to the files of a run that never failed.
#[cfg(unix)]
#[test]
fn a_full_disk_costs_no_search() {
    let (study, expected) = whole();
    for blocks in ["8", "64"] {
        let folder = tempfile::tempdir().expect("a folder");
        let out = folder.path().to_string_lossy().into_owned();
        let script = "trap '' XFSZ; ulimit -f \"$1\"; exec \"$0\" run \"$2\" --out \"$3\"";
        let full = Command::new("bash").args(["-c", script, env!("CARGO_BIN_EXE_hartog"), blocks, study, &out]).output().expect("runs");
        assert_eq!(full.status.code(), Some(2));
        assert!(error(&full).contains("no file may be as large here") && error(&full).contains("add --resume"), "{}", error(&full));
        let left = files(folder.path());
        assert!(!left.contains_key("summary.json") && left.keys().all(|name| !name.starts_with(".hartog")), "{:?}", left.keys());
        let unlike = |(name, bytes): (&String, &Vec<u8>)| name != "journal.log" && expected.get(name) != Some(bytes);
        assert!(!left.iter().any(unlike), "no half of a file");
        let resumed = ended(run(study, folder.path(), &["--resume"]));
        let said = String::from_utf8_lossy(&resumed.stdout).into_owned();
        assert!(said.contains("searches of the interrupted run are known"), "{said}");
        let own = files(folder.path());
        assert!(differing(expected, &own).is_empty(), "{blocks} blocks: {:?} differ", differing(expected, &own));
    }
}
