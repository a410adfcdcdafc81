//! Fuzzes studies and engine files: bytes before and after a line of `%%%`. What is read is evaluated where that is quick.

#![no_main]

use hartog::analysis::Silent;
use libfuzzer_sys::fuzz_target;
use std::fs;
use std::sync::LazyLock;

static FOLDER: LazyLock<tempfile::TempDir> = LazyLock::new(|| tempfile::tempdir().expect("a folder"));

/// Stations times speeds times orders that take a moment.
const QUICK: usize = 2_000;

fuzz_target!(|bytes: &[u8]| {
    let text = String::from_utf8_lossy(bytes);
    let (study, engine) = text.split_once("\n%%%\n").unwrap_or((&text, ""));
    let folder = FOLDER.path();
    fs::write(folder.join("study.toml"), study).expect("written");
    fs::write(folder.join("engine.toml"), engine).expect("written");
    match hartog::input::read(&folder.join("study.toml")) {
        Err(error) => assert!(error.to_string().contains("error: ")),
        Ok(mut study) => {
            let size = study.chain.len() * study.speeds_rpm.len() * (2.0 * study.order_limit) as usize;
            if size > QUICK {
                return;
            }
            // searches take too long for this
            study.optimise = None;
            study.front = None;
            if let Ok(results) = hartog::analysis::run(&study, &Silent) {
                assert!(!format!("{:?}", (&results.designs, &results.sweeps)).contains("NaN"));
            }
        }
    }
});
