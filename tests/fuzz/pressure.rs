//! Fuzzes tables of measured pressure, and the torque that follows from them.

#![no_main]

use hartog::engine::Excitation;
use libfuzzer_sys::fuzz_target;
use std::fs;
use std::sync::LazyLock;

/// A folder with a study and an engine that read `pressure.csv`.
static FOLDER: LazyLock<tempfile::TempDir> = LazyLock::new(|| {
    let folder = tempfile::tempdir().expect("a folder");
    let given = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_input");
    let engine = fs::read_to_string(given.join("engine.toml")).expect("an engine");
    let (start, end) = (engine.find("[pressure").expect("pressure"), engine.find("[[station").expect("stations"));
    let measured = format!("{}[pressure.measured]\nfile = \"pressure.csv\"\n{}", &engine[..start], &engine[end..]);
    fs::write(folder.path().join("engine.toml"), measured).expect("written");
    fs::copy(given.join("study.toml"), folder.path().join("study.toml")).expect("copied");
    folder
});

fuzz_target!(|bytes: &[u8]| {
    fs::write(FOLDER.path().join("pressure.csv"), bytes).expect("written");
    match hartog::input::read(&FOLDER.path().join("study.toml")) {
        Err(error) => assert!(error.to_string().contains("error: ")),
        Ok(study) => assert!(!format!("{:?}", Excitation::new(&study.engine, study.order_limit)).contains("NaN")),
    }
});
