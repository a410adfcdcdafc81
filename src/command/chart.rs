//! `hartog chart`: speed against accuracy of every response method, and where each fails.

use super::progress::Bar;
use super::{DONE, FAILED, fail, say};
use crate::assess::speed_accuracy::{self, SpeedAccuracy};
use crate::assess::stability::{self, Cell, Scenario};
use crate::report::{Folder, text, write_chart};
use crate::study;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Arguments of `chart`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  hartog chart studies/villalva_i6.toml\n\n\
Times are medians of repetitions on one thread; they differ from run to run and from machine to machine, errors do not.\n\n\
Exit code: 0 done, 1 a method does not do what is declared of it in a scenario, 2 bad input or no finite response.")]
pub struct Arguments {
    /// Study file (TOML).
    #[arg(default_value = "studies/villalva_i6.toml")]
    pub study: PathBuf,
    /// Output folder [default: out/chart/STUDY].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// Measures every method on a study and on the scenarios, prints and plots.
pub fn chart(arguments: &Arguments) -> u8 {
    let start = Instant::now();
    let study = match study::read(&arguments.study) {
        Ok(study) => study,
        Err(error) => return fail(&error),
    };
    let default = Path::new("out").join("chart").join(&study.name);
    let folder = match Folder::create(arguments.out.as_ref().unwrap_or(&default)) {
        Ok(folder) => folder,
        Err(error) => return fail(&error),
    };
    let bar = Bar::default();
    let measured = speed_accuracy::measure(&study, &bar);
    let map: Vec<(Scenario, Vec<Cell>)> = stability::scenarios().into_iter().map(|s| (s.clone(), s.cells())).collect();
    drop(bar);
    let measured = match measured {
        Ok(measured) => measured,
        Err(error) => return fail(&format!("error: {error}")),
    };
    if let Err(error) = write_chart(&study, &measured, &map, &folder) {
        return fail(&error);
    }
    print(&study.engine.name, &measured, &map);
    say(&format!("{} files written to {} ({:.1} s)\n", folder.written(), folder.path().display(), start.elapsed().as_secs_f64()));
    if map.iter().flat_map(|m| &m.1).all(Cell::as_declared) { DONE } else { FAILED }
}

fn print(engine: &str, measured: &SpeedAccuracy, map: &[(Scenario, Vec<Cell>)]) {
    if measured.probes.is_empty() {
        say(&format!("{engine}: no design with one absorber to probe: only growth of cost and stability were measured\n"));
    } else {
        say(&format!("{engine}: peak twist of {} probe designs ({})\n\n", measured.probes.len(), measured.probes.join(", ")));
        say(&text::chart::methods(measured));
    }
    say(&format!("\n{}", text::chart::growth(measured)));
    say(&format!("\n{}", text::chart::stability(map)));
}
