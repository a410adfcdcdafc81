//! Proofs as files: `hartog run` writes them where a study asks for it, `hartog check --proof` confirms or refuses them.

use crate::support::{hartog, read, variant};
use std::fs;

/// Words of a message, and how a proof was changed.
type Changed<'a> = (&'a str, &'a dyn Fn(&str) -> String);

/// A proof of Den Hartog's problem is confirmed with exit code 0; without one of its rows, of another study in another unit and with a higher bound it is not (1); what is no proof of the study is bad input (2).
#[test]
fn proofs_are_written_and_checked() {
    let folder = tempfile::tempdir().expect("folder");
    let asked = ("[optimise]\n", "[optimise]\nprove = { gap = 1e-5, boxes = 10000, file = true }\n");
    let study = variant(folder.path(), "den_hartog", &[asked, ("points = 25", "points = 2")]);
    let out = folder.path().join("out");
    let run = hartog().args(["run", "--out"]).arg(&out).arg(&study).assert().code(0);
    let said = String::from_utf8_lossy(&run.get_output().stdout).into_owned();
    assert!(said.replace("\n    ", " ").contains("its boxes are in proof_optimum_tuned.csv"), "{said}");
    let check = |file: &std::path::Path| {
        let found = hartog().args(["check", "--proof"]).arg(file).arg(&study).output().expect("runs");
        (found.status.code(), String::from_utf8_lossy(&found.stdout).into_owned() + &String::from_utf8_lossy(&found.stderr))
    };
    for (kind, bound) in [("tuned", "0.026293"), ("viscous", "0.120319")] {
        let (code, said) = check(&out.join(format!("proof_optimum_{kind}.csv")));
        assert_eq!(code, Some(0), "{said}");
        assert!(said.starts_with(&format!("optimum_{kind}: confirmed, no design of its family is below {bound}°")), "{said}");
    }
    let whole = read(&out, "proof_optimum_tuned.csv");
    let changed = |how: &dyn Fn(&str) -> String| {
        let path = folder.path().join("changed.csv");
        fs::write(&path, how(&whole)).expect("writable");
        check(&path)
    };
    let without = |i: usize| move |text: &str| text.lines().enumerate().filter(|(n, _)| *n != i).map(|(_, l)| format!("{l}\n")).collect();
    let higher = |text: &str| text.replace(",0.02629", ",0.02630");
    let unit = |text: &str| text.replace(",deg,", ",rad,");
    let refused: [Changed; 3] =
        [("do not cover", &without(1)), ("not excluded", &higher), ("the optimum is by `peak_twist` in `deg`", &unit)];
    for (words, how) in refused {
        let (code, said) = changed(how);
        assert_eq!(code, Some(1), "{said}");
        assert!(said.starts_with("not confirmed: ") && said.contains(words), "{said}");
    }
    let bad: [Changed; 7] = [
        ("found a proof of `optimum_other`, expected one of an optimum of the study", &|t| t.replace("optimum_tuned", "optimum_other")),
        ("found `fring`, expected a condition, as `firing`", &|t| t.replace("firing", "fring")),
        ("found no box, expected a row for each of its speeds", &|t| t.lines().take(1).collect()),
        ("expected `lower_bound` among them", &|t| t.replace("lower_bound", "bound")),
        ("expected `objective` or `limit`", &|t| t.replace(",objective,1", ",nothing,1")),
        ("expected that of the first row", &|t| t.replacen(",0.02629", ",0.02628", 2).replacen(",0.02628", ",0.02629", 1)),
        ("expected no less than the lowest", &|t| {
            t.replace("lowest_", "other_").replace("highest_", "lowest_").replace("other_", "highest_")
        }),
    ];
    for (words, how) in bad {
        let (code, said) = changed(how);
        assert_eq!(code, Some(2), "{said}");
        assert!(said.contains(words), "{said}");
    }
}
