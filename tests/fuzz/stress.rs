//! Fuzzes tables of stress histories, and the criteria on them.

#![no_main]

use hartog::analysis::stress_histories::points;
use hartog::fatigue::multiaxial::{Grid, Limits};
use hartog::input::tables::HistoryReader;
use libfuzzer_sys::fuzz_target;
use std::fs;
use std::sync::LazyLock;

static FOLDER: LazyLock<tempfile::TempDir> = LazyLock::new(|| tempfile::tempdir().expect("a folder"));

/// Points of a table that are judged.
const MOST: usize = 4;

fuzz_target!(|bytes: &[u8]| {
    let table = FOLDER.path().join("history.csv");
    fs::write(&table, bytes).expect("written");
    let limits = Limits { tensile: 900e6, bending: 300e6, torsion: 180e6, repeated_bending: 225e6 };
    match HistoryReader::open(&table).and_then(|rows| rows.take(MOST).collect::<Result<Vec<_>, _>>()) {
        Err(error) => assert!(error.to_string().contains("error: ")),
        Ok(list) => {
            if let Ok(results) = points(&list, &limits, Grid::default()) {
                assert!(!format!("{results:?}").contains("NaN"));
            }
        }
    }
});
