//! Folders of output: nothing is lost in them but what an earlier command has left there, and each is of one study.

use crate::support::read;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A study without searches of a few milliseconds; it is written to `path`, with more lines.
fn small(path: &Path, more: &str) {
    let engine = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/engines/villalva_i6.toml");
    let text = format!(
        "engine = {engine:?}\nspeed_rpm = {{ from = 1600, to = 2600, step = 500 }}\norder_limit = 3\n[[design]]\nname = \"none\"\n{more}"
    );
    fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
    fs::write(path, text).expect("written");
}

/// A catalogue of one absorber, with the lines of a study that name it.
const CATALOGUE: &str = "name,type,ring_inertia_kg_m2,damping_n_m_s_per_rad\nsold,viscous,0.076,100\n";

fn sold(file: &str) -> String {
    format!("[[catalogue]]\nfile = \"{file}\"\non.station = \"pulley\"\nbest = 1\n")
}

fn hartog(place: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hartog")).current_dir(place).args(arguments).output().expect("runs")
}

fn error(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[track_caller]
fn done(output: &Output) {
    assert!(output.status.code().is_some_and(|c| c <= 1), "{}", error(output));
}

/// Refused with exit code 2, saying these words.
#[track_caller]
fn refused(output: &Output, words: &[&str]) {
    let text = error(output);
    assert_eq!(output.status.code(), Some(2), "{text}");
    assert!(words.iter().all(|w| text.contains(w)), "{words:?} in {text}");
}

/// Every file of a folder with its bytes; a link by what it leads to.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let entries = fs::read_dir(folder).expect("a folder").map(|e| e.expect("an entry").path());
    entries.filter(|p| p.is_file()).map(|p| (p.clone(), fs::read(&p).expect("bytes"))).collect()
}

/// An input under the name of an output is refused before anything is computed, by whatever path it is read or the folder is named; every file stays as it was, and nothing is added.
#[test]
fn no_input_is_written_over() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path();
    small(&place.join("study.toml"), &sold("absorbers.csv"));
    fs::write(place.join("absorbers.csv"), CATALOGUE).expect("written");
    let material = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_input/material.toml");
    let sizing = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_input/sizing.toml")).expect("a file");
    let history = "point,crank_deg,sxx_mpa,syy_mpa,szz_mpa,sxy_mpa,syz_mpa,szx_mpa\n".to_owned()
        + &(0..72).map(|i| format!("a,{},{},0,0,0,0,0\n", 10 * i, (f64::from(i) / 72.0 * std::f64::consts::TAU).sin())).collect::<String>();
    let law = "frequency_hz,stiffness_n_m_per_rad,loss_factor\n5,1000,0.1\n10,1100,0.12\n20,1200,0.14\n";
    fs::create_dir(place.join("sized")).expect("a folder");
    for (name, text) in [("sized/study.toml", sizing.as_str()), ("fatigue.csv", &history), ("fit.csv", law)] {
        fs::write(place.join(name), text).expect("written");
    }
    let material = material.to_string_lossy().into_owned();
    let own = place.file_name().expect("a name").to_string_lossy().into_owned();
    let round = format!("../{own}/sized/..");
    let before = (files(place), files(&place.join("sized")));
    for (arguments, input) in [
        (&["run", "study.toml", "--out", "."][..], "absorbers.csv"),
        (&["run", "study.toml", "--out", &round], "absorbers.csv"),
        (&["report", "study.toml", "--out", &place.to_string_lossy()], "absorbers.csv"),
        (&["size", "sized/study.toml", "--out", "sized"], "study.toml"),
        (&["fatigue", "fatigue.csv", "--material", &material, "--out", "."], "fatigue.csv"),
        (&["fit", "fit.csv", "--type", "rubber", "--out", "."], "fit.csv"),
    ] {
        refused(&hartog(place, arguments), &[input, "is read by this command, which would write over it", "--out"]);
        assert_eq!((files(place), files(&place.join("sized"))), before, "{arguments:?}");
    }
}

/// The same through links: a folder of output that is a link, an input that is one in the folder of output, and one that leads there.
#[cfg(unix)]
#[test]
fn no_input_is_written_over_through_links() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path();
    fs::create_dir_all(place.join("data")).expect("a folder");
    fs::write(place.join("data/absorbers.csv"), CATALOGUE).expect("written");
    symlink("data", place.join("other")).expect("a link");
    fs::create_dir(place.join("out")).expect("a folder");
    symlink("../data/absorbers.csv", place.join("out/designs.csv")).expect("a link");
    symlink("data/absorbers.csv", place.join("sold.csv")).expect("a link");
    for (file, out) in [("data/absorbers.csv", "other"), ("sold.csv", "data"), ("out/designs.csv", "out")] {
        small(&place.join("study.toml"), &sold(file));
        refused(&hartog(place, &["run", "study.toml", "--out", out]), &["is read by this command"]);
        assert_eq!(fs::read_to_string(place.join("data/absorbers.csv")).expect("a table"), CATALOGUE, "{file}");
        assert!(place.join("out/designs.csv").is_symlink());
        assert_eq!(fs::read_dir(place.join("data")).expect("a folder").count(), 1, "{file}");
    }
}

/// What only has a name of ours stays: under names that this study does not write it is let be, under one that it does the run is refused before it begins, by that name.
#[test]
fn what_is_not_ours_stays() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path();
    small(&place.join("own.toml"), &sold("margin.csv"));
    fs::write(place.join("margin.csv"), CATALOGUE).expect("written");
    let others = ["front_mine.svg", ".hartogrc", ".hartog-mine", "heat.csv", "pareto.png", "response_mine.svg", "designs.pdf", "notes.txt"];
    others.iter().for_each(|name| fs::write(place.join(name), "mine").expect("written"));
    done(&hartog(place, &["run", "own.toml", "--out", "."]));
    assert!(place.join("designs.csv").is_file() && place.join("response_sold.svg").is_file());
    others.iter().for_each(|name| assert_eq!(read(place, name), "mine", "{name}"));
    assert_eq!(read(place, "margin.csv"), CATALOGUE);
    assert!(!place.join("journal.log").exists());
    for name in ["designs.csv", "summary.json", "timing.csv", "journal.log", "response_none.png", "unfinished.csv"] {
        let out = place.join("other");
        fs::create_dir(&out).expect("a folder");
        fs::write(out.join(name), "mine").expect("written");
        refused(&hartog(place, &["run", "own.toml", "--out", "other"]), &[name, "would be lost", "--out"]);
        assert_eq!(files(&out), BTreeMap::from([(out.join(name), b"mine".to_vec())]), "{name}");
        fs::remove_dir_all(&out).expect("removed");
    }
}

/// A run takes away what an earlier one of the study has left and it does not make itself, but not what was changed since.
#[test]
fn only_what_a_run_has_left_is_taken_away() {
    let folder = tempfile::tempdir().expect("a folder");
    let (place, out) = (folder.path(), folder.path().join("out"));
    let limit = "[[constraint]]\nvibratory_torque = { max_n_m = 1e6 }\n";
    let study = place.join("own.toml");
    let run = |more: &str| {
        small(&study, more);
        done(&hartog(place, &["run", "own.toml", "--out", "out"]));
    };
    run(limit);
    assert!(out.join("limits.csv").is_file());
    run("");
    assert!(!out.join("limits.csv").exists());
    run(limit);
    fs::write(out.join("limits.csv"), "edited").expect("written");
    run("");
    assert_eq!(read(&out, "limits.csv"), "edited");
    let listed = read(&out, "summary.json");
    assert!(!listed.contains("limits.csv") && listed.contains("designs.csv"));
    fs::write(out.join("designs.csv"), "edited").expect("written");
    refused(&hartog(place, &["run", "own.toml", "--out", "out"]), &["`designs.csv`", "or changed since"]);
    assert_eq!(read(&out, "designs.csv"), "edited");
}

/// `size` replaces what it has written, and refuses where its engine was changed since, as `new` does.
#[test]
fn an_edited_engine_is_kept() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path();
    let sizing = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_input/sizing.toml");
    let size = || hartog(place, &["size", &sizing.to_string_lossy(), "--out", "sized"]);
    done(&size());
    done(&size());
    let engine = place.join("sized/engine.toml");
    let edited = fs::read_to_string(&engine).expect("an engine") + "# my own\n";
    fs::write(&engine, &edited).expect("written");
    let drawing = fs::metadata(place.join("sized/drawing.svg")).and_then(|m| m.modified()).expect("a time");
    refused(&size(), &["`engine.toml`", "or changed since"]);
    assert_eq!(fs::read_to_string(&engine).expect("an engine"), edited);
    assert_eq!(fs::metadata(place.join("sized/drawing.svg")).and_then(|m| m.modified()).expect("a time"), drawing);
}

/// `man` replaces its own pages, `new` none; neither leaves a journal.
#[test]
fn commands_without_a_summary() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path();
    done(&hartog(place, &["man", "man"]));
    done(&hartog(place, &["man", "man"]));
    fs::write(place.join("man/hartog-run.1"), "mine").expect("written");
    refused(&hartog(place, &["man", "man"]), &["hartog-run.1"]);
    done(&hartog(place, &["new", "own"]));
    refused(&hartog(place, &["new", "own"]), &["study.toml is there already"]);
    assert!(!place.join("man/journal.log").exists() && !place.join("own/journal.log").exists());
}

/// A journal that is a link is refused by name, and what it leads to stays.
#[cfg(unix)]
#[test]
fn a_journal_is_no_link() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path();
    small(&place.join("own.toml"), "");
    fs::write(place.join("target"), "mine").expect("written");
    fs::create_dir(place.join("out")).expect("a folder");
    std::os::unix::fs::symlink("../target", place.join("out/journal.log")).expect("a link");
    for more in [&[][..], &["--resume"]] {
        refused(&hartog(place, &[&["run", "own.toml", "--out", "out"], more].concat()), &["journal.log"]);
        assert_eq!(read(place, "target"), "mine");
    }
}

/// Files have the permissions that the mask of the process leaves of 0666, as those of any other program.
#[cfg(unix)]
#[test]
fn files_heed_the_umask() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path();
    small(&place.join("own.toml"), "");
    for (mask, mode) in [("077", 0o600), ("027", 0o640), ("000", 0o666)] {
        let script = format!("umask {mask}; exec \"$0\" run own.toml --format parquet --out {mask}");
        done(&Command::new("bash").current_dir(place).args(["-c", &script, env!("CARGO_BIN_EXE_hartog")]).output().expect("runs"));
        for name in ["designs.csv", "designs.parquet", "designs.png", "report.html", "summary.json"] {
            let found = fs::metadata(place.join(mask).join(name)).expect("a file").permissions().mode() & 0o777;
            assert_eq!(found, mode, "{name} by {mask}: {found:o}");
        }
    }
}

/// Two studies called `study.toml` have folders of their own, named after those where they are; a folder of another study is refused by both names, one of the same study that was moved or copied is not.
#[test]
fn a_folder_is_of_one_study() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path();
    small(&place.join("a/study.toml"), "");
    small(&place.join("b/study.toml"), "[[constraint]]\nvibratory_torque = { max_n_m = 1e6 }\n");
    done(&hartog(place, &["run", "a/study.toml"]));
    let first = files(&place.join("out/a"));
    done(&hartog(place, &["run", "b/study.toml"]));
    assert!(place.join("out/b/limits.csv").is_file() && files(&place.join("out/a")) == first && !place.join("out/study").exists());
    refused(&hartog(place, &["run", "b/study.toml", "--out", "out/a"]), &["out/a is of another study", "`a/study.toml`", "`b/study.toml`"]);
    assert!(files(&place.join("out/a")) == first);
    // the same study, by another path, or changed
    done(&hartog(place, &["run", "./a/../a/study.toml", "--out", "out/a"]));
    small(&place.join("a/study.toml"), "# changed\n");
    done(&hartog(place, &["run", "a/study.toml"]));
    // moved and changed, copied
    fs::rename(place.join("a"), place.join("c")).expect("moved");
    small(&place.join("c/study.toml"), "# changed again\n");
    done(&hartog(place, &["run", "c/study.toml", "--out", "out/a"]));
    small(&place.join("d/study.toml"), "# changed again\n");
    done(&hartog(place, &["run", "d/study.toml", "--out", "out/a"]));
    done(&hartog(&place.join("d"), &["run", "study.toml"]));
    assert!(place.join("d/out/d/designs.csv").is_file());
    for (command, out) in [("curves", "out/d_curves"), ("report", "out/d_report")] {
        done(&hartog(place, &[command, "d/study.toml"]));
        assert!(place.join(out).join("holzer.csv").is_file());
        refused(&hartog(place, &[command, "b/study.toml", "--out", out]), &["is of another study", "`d/study.toml`"]);
        refused(&hartog(place, &["run", "d/study.toml", "--out", out]), &[&format!("holds what `hartog {command}` has written")]);
    }
}

/// A name that gives none to a folder is refused where no folder is named; a path that is not UTF-8 is one like any other.
#[cfg(unix)]
#[test]
fn names_that_are_hard_to_write() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path();
    for name in ["...toml", "..toml"] {
        small(&place.join(name), "");
        refused(&hartog(place, &["run", name]), &[name, "gives no name to a folder"]);
        done(&hartog(place, &["run", name, "--out", "named"]));
        fs::remove_dir_all(place.join("named")).expect("removed");
    }
    assert!(!place.join("designs.csv").exists() && !place.join("out").exists());
    let name = OsStr::from_bytes(b"caf\xe9.toml");
    small(&place.join(name), "");
    for more in [&[][..], &["--resume"]] {
        let run = Command::new(env!("CARGO_BIN_EXE_hartog")).current_dir(place).arg("run").arg(name).args(more).output().expect("runs");
        done(&run);
    }
    let out = place.join("out").join(OsStr::from_bytes(b"caf\xe9"));
    let summary: serde_json::Value = serde_json::from_str(&read(&out, "summary.json")).expect("JSON");
    assert_eq!(summary["inputs"][0]["path"], "caf\u{fffd}.toml");
}
