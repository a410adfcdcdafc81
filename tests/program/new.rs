//! A start from nothing: what `hartog new` writes is read, and runs at once.

use assert_cmd::Command;

fn hartog(arguments: &[&str]) -> assert_cmd::assert::Assert {
    let mut c = Command::cargo_bin("hartog").expect("built");
    c.current_dir(env!("CARGO_MANIFEST_DIR")).args(arguments).assert()
}

/// Every engine, number of cylinders and kind of pressure is read without a mistake; its first resonance lies where that of such an engine does.
#[test]
fn every_example_is_read() {
    let folder = tempfile::tempdir().expect("a folder");
    for engine in ["in-line", "v"] {
        for cylinders in 1..=12 {
            if engine == "v" && cylinders % 2 == 1 {
                continue;
            }
            for pressure in ["wiebe", "otto", "measured", "harmonics"] {
                let own = folder.path().join(format!("{engine}_{cylinders}_{pressure}"));
                hartog(&["new", &own.to_string_lossy(), "--engine", engine, "--cylinders", &cylinders.to_string(), "--pressure", pressure])
                    .success();
                let study = hartog::input::read(&own.join("study.toml")).unwrap_or_else(|e| panic!("{engine} {cylinders} {pressure}: {e}"));
                assert_eq!(study.engine.layout.firing_deg.len(), cylinders);
                let first = study.modes.frequencies_hz()[0];
                assert!((50.0..1000.0).contains(&first), "{engine} {cylinders}: {first} Hz");
            }
        }
    }
}

/// An example runs; its optimum is better than the absorber that it gives. Files that are there are kept, and an odd V engine is refused.
#[test]
fn an_example_runs_at_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let own = folder.path().join("own");
    let (own, out) = (own.to_string_lossy().into_owned(), folder.path().join("out").to_string_lossy().into_owned());
    hartog(&["new", &own, "--pressure", "measured"]).success();
    let run = hartog(&["run", &format!("{own}/study.toml"), "--out", &out]).success();
    let text = String::from_utf8_lossy(&run.get_output().stdout).into_owned();
    assert!(text.contains("% less than the best given design, given"), "{text}");
    let again = hartog(&["new", &own]).code(2);
    assert!(String::from_utf8_lossy(&again.get_output().stderr).contains("study.toml is there already"));
    let odd = hartog(&["new", &format!("{own}2"), "--engine", "v", "--cylinders", "5"]).code(2);
    assert!(String::from_utf8_lossy(&odd.get_output().stderr).contains("expected an even number"));
}

/// Completions know every command.
#[test]
fn shells_complete_commands() {
    let printed = hartog(&["completions", "bash"]).success();
    let text = String::from_utf8_lossy(&printed.get_output().stdout).into_owned();
    assert!(["run", "check", "new", "chart"].iter().all(|c| text.contains(c)) && text.contains("--resume"));
}

/// A manual page of the program and of each command, with the options of it.
#[test]
fn every_command_has_a_page_of_the_manual() {
    let folder = tempfile::tempdir().expect("a folder");
    hartog(&["man", &folder.path().to_string_lossy()]).success();
    for command in ["run", "check", "new", "import", "chart", "compare", "report"] {
        let page = std::fs::read_to_string(folder.path().join(format!("hartog-{command}.1"))).expect("a page");
        assert!(page.contains(".SH SYNOPSIS") && page.contains(".SH DESCRIPTION"), "{command}");
    }
    assert!(folder.path().join("hartog.1").exists());
}
