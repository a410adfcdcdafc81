//! The example programs run, and print what `hartog run` prints.

#[path = "../../studies/examples/evaluate.rs"]
pub mod evaluate;
#[path = "../../studies/examples/optimise.rs"]
pub mod optimise;
#[path = "../../studies/examples/own_law.rs"]
pub mod own_law;

use assert_cmd::Command;
use hartog::Study;

#[test]
fn every_example_runs() {
    evaluate::main().expect("evaluates");
    optimise::main().expect("optimises");
    own_law::main().expect("takes another law");
}

/// The first program of the documentation against the command: the same number, to its last printed digit. What is optimised is the twist, which results
/// hold in rad. The results can be written by serde, absorbers with their type and keys.
#[test]
fn the_library_finds_what_the_command_prints() {
    let study = Study::read("studies/den_hartog.toml").expect("shipped");
    let results = study.run().expect("finite");
    let best = &results.optima[0];
    let line = format!("{}: {} {:.6}°", best.design.name, study.objective.label, best.optimum.value().to_degrees());
    let folder = tempfile::tempdir().expect("a folder");
    let out = Command::cargo_bin("hartog").expect("built").args(["run", "studies/den_hartog.toml", "--out"]).arg(folder.path()).output();
    let printed = String::from_utf8(out.expect("runs").stdout).expect("UTF-8");
    assert!(printed.contains(&line), "{line} is not in\n{printed}");
    let text = toml::to_string(&best.design.absorbers[0]).expect("serialises");
    assert!(text.contains("type = \"tuned\"") && text.contains("stiffness_n_m_per_rad = "), "{text}");
}
