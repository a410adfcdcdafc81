//! `hartog fatigue`: multiaxial criteria on stress histories.

use super::progress::Bar;
use super::{DONE, fail, say, threads};
use crate::assess::Progress;
use crate::assess::multiaxial::{self, CHUNK, Summary};
use crate::fatigue::multiaxial::Grid;
use crate::fatigue::multiaxial::plane::Amplitude;
use crate::report::csv::fatigue::FatigueTable;
use crate::report::{Folder, plot, text};
use crate::study::csv_in::{HistoryReader, PointHistory};
use crate::study::read_material;
use crate::units::RAD_PER_DEG;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Arguments of `fatigue`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  hartog fatigue history.csv --material steel.toml\n\n\
The table has the columns point, crank_deg, sxx_mpa, syy_mpa, szz_mpa, sxy_mpa, syz_mpa, szx_mpa, the rows of a point together; the material file has\n\
tensile_strength_mpa, bending_fatigue_limit_mpa, torsion_fatigue_limit_mpa and, if known, yield_strength_mpa and repeated_bending_fatigue_limit_mpa.\n\n\
Exit code: 0 done, 2 bad input.")]
pub struct Arguments {
    /// Stress histories (CSV).
    pub history: PathBuf,
    /// Fatigue limits (TOML).
    #[arg(long, value_name = "M.toml")]
    pub material: PathBuf,
    /// Planes every so many degrees and no refinement, as the thesis did with 15 [default: refined to 0.1 %].
    #[arg(long, value_name = "DEG", value_parser = grid)]
    pub grid: Option<f64>,
    /// Amplitude of shear as half the longest chord instead of the smallest circle: to see why not.
    #[arg(long)]
    pub chord: bool,
    /// Output folder [default: out/HISTORY].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Number of threads [default: all]; results are the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub threads: Option<u16>,
}

fn grid(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(deg) if (0.5..=45.0).contains(&deg) => Ok(deg),
        _ => Err("expected an angle from 0.5 to 45 degrees".into()),
    }
}

/// Evaluates every point, writes the table and plots, and prints the worst points.
pub fn fatigue(arguments: &Arguments) -> u8 {
    threads(arguments.threads.map(usize::from));
    let start = Instant::now();
    let limits = match read_material(&arguments.material) {
        Ok(limits) => limits,
        Err(error) => return fail(&error),
    };
    let points = match HistoryReader::open(&arguments.history) {
        Ok(points) => points,
        Err(error) => return fail(&error),
    };
    let stem = arguments.history.file_stem().unwrap_or_default();
    let default = Path::new("out").join(stem);
    let folder = match Folder::create(arguments.out.as_ref().unwrap_or(&default)) {
        Ok(folder) => folder,
        Err(error) => return fail(&error),
    };
    let amplitude = if arguments.chord { Amplitude::Chord } else { Amplitude::Circle };
    let grid = Grid { step: arguments.grid.map(|deg| deg * RAD_PER_DEG), amplitude };
    let mut table = match FatigueTable::create(&folder) {
        Ok(table) => table,
        Err(error) => return fail(&error),
    };
    let bar = Bar::default();
    bar.stage("points", 0);
    let mut summary = Summary::default();
    let mut points = points.peekable();
    while points.peek().is_some() {
        let chunk: Result<Vec<PointHistory>, _> = points.by_ref().take(CHUNK).collect();
        let chunk = match chunk {
            Ok(chunk) => chunk,
            Err(error) => {
                drop(bar);
                return fail(&error);
            }
        };
        let results = match multiaxial::points(&chunk, &limits, grid) {
            Ok(results) => results,
            Err(error) => return fail(&format!("error: {error}")),
        };
        for (point, result) in chunk.iter().zip(&results) {
            if let Err(error) = table.point(result) {
                return fail(&error);
            }
            summary.take(point, result);
            bar.step();
        }
    }
    drop(bar);
    let written = table.finish(&folder).and_then(|()| plot::fatigue::draw(&summary, &limits, &folder));
    if let Err(error) = written {
        return fail(&error);
    }
    say(&text::fatigue::summary(&summary, &limits));
    say(&format!(
        "{} points in {:.1} s; {} files written to {}\n",
        summary.points,
        start.elapsed().as_secs_f64(),
        folder.written(),
        folder.path().display()
    ));
    DONE
}
