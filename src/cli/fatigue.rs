//! `hartog fatigue`: multiaxial criteria on stress histories.

use super::exit::{DONE, fail, files, paths, say, say_to_error, threads};
use super::place::chosen;
use super::progress::Bar;
use crate::analysis::Progress;
use crate::analysis::stress_figures::{of_point, of_points};
use crate::analysis::stress_histories::{self, CHUNK, Summary};
use crate::fatigue::multiaxial::Grid;
use crate::fatigue::multiaxial::invariants::Amplitude as DeviatorAmplitude;
use crate::fatigue::multiaxial::plane::Amplitude;
use crate::input::tables::{HistoryReader, PointHistory, Superposed};
use crate::input::{InputError, noted, read_material, remarked};
use crate::report::csv::fatigue::FatigueTable;
use crate::report::{Folder, Job, Names, about_inputs, plot, text, write_figure, write_folder};
use crate::units::RAD_PER_DEG;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Arguments of `fatigue`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  hartog fatigue history.csv --material steel.toml\n\n\
  hartog fatigue --unit-loads units.csv --loads loads.csv --material steel.toml\n\n\
HISTORY has the columns point, crank_deg, sxx_mpa, syy_mpa, szz_mpa, sxy_mpa, syz_mpa, szx_mpa, the rows of a point together; UNIT has point, load and the\n\
same six stresses per unit of that load; LOADS has crank_deg and a column a load, over whole turns. The material file has tensile_strength_mpa,\n\
bending_fatigue_limit_mpa, torsion_fatigue_limit_mpa and, if known, yield_strength_mpa and repeated_bending_fatigue_limit_mpa.\n\n\
Exit code: 0 done, 2 bad input.")]
pub struct Arguments {
    /// Stress histories (CSV).
    #[arg(required_unless_present = "unit_loads")]
    pub history: Option<PathBuf>,
    /// Stresses per unit load (CSV), as from one finite-element run a load; with --loads, instead of HISTORY.
    #[arg(long, value_name = "UNIT.csv", requires = "loads", conflicts_with = "history")]
    pub unit_loads: Option<PathBuf>,
    /// Loads over the cycle (CSV).
    #[arg(long, value_name = "LOADS.csv", requires = "unit_loads")]
    pub loads: Option<PathBuf>,
    /// Fatigue limits (TOML).
    #[arg(long, value_name = "M.toml")]
    pub material: PathBuf,
    /// Planes every so many degrees and no refinement, as the thesis did with 15 [default: refined to 0.1 %].
    #[arg(long, value_name = "DEG", value_parser = grid)]
    pub grid: Option<f64>,
    /// What amplitude a path of shear has: the radius of the smallest circle round it, or half its longest chord or projection (which are equal), to see why not.
    #[arg(long, value_name = "WAY", value_enum, default_value_t)]
    pub shear: Shear,
    /// What amplitude a path of the deviator has: the radius of the smallest ball in five dimensions, or the largest of the ten circles in two, as the thesis took it, to see why not.
    #[arg(long, value_name = "WAY", value_enum, default_value_t)]
    pub deviator: Deviator,
    /// Point that is drawn [default: that with the smallest factor].
    #[arg(long, value_name = "NAME")]
    pub point: Option<String>,
    /// Output folder [default: out/HISTORY].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Number of threads [default: all]; results are the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub threads: Option<u16>,
}

impl Arguments {
    /// Planes and amplitudes that are asked for.
    fn planes(&self) -> Grid {
        Grid {
            step: self.grid.map(|deg| deg * RAD_PER_DEG),
            amplitude: match self.shear {
                Shear::Circle => Amplitude::Circle,
                Shear::Chord | Shear::Projection => Amplitude::Chord,
            },
            deviator: match self.deviator {
                Deviator::Ball => DeviatorAmplitude::Ball,
                Deviator::Pairs => DeviatorAmplitude::Pairs,
            },
        }
    }
}

/// Amplitude of a path of shear.
#[derive(Debug, Clone, Copy, Default, clap::ValueEnum)]
pub enum Shear {
    /// Radius of the smallest circle round it.
    #[default]
    Circle,
    /// Half its longest chord.
    Chord,
    /// Half its longest projection.
    Projection,
}

/// Amplitude of a path of the deviator.
#[derive(Debug, Clone, Copy, Default, clap::ValueEnum)]
pub enum Deviator {
    /// Radius of the smallest ball in five dimensions.
    #[default]
    Ball,
    /// The largest radius of the smallest circles in pairs of dimensions.
    Pairs,
}

fn grid(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(deg) if (0.5..=45.0).contains(&deg) => Ok(deg),
        _ => Err("expected an angle from 0.5 to 45 degrees".into()),
    }
}

type Points = Box<dyn Iterator<Item = Result<PointHistory, InputError>>>;

/// The histories, and the table they come from.
fn open(arguments: &Arguments) -> Result<(Points, PathBuf), InputError> {
    match (&arguments.history, &arguments.unit_loads, &arguments.loads) {
        (None, Some(units), Some(loads)) => Ok((Box::new(Superposed::open(units, loads)?), units.clone())),
        (history, ..) => {
            let path = history.as_deref().unwrap_or(Path::new(""));
            Ok((Box::new(HistoryReader::open(path)?), path.to_path_buf()))
        }
    }
}

/// Evaluates every point, writes the table and plots, and prints the worst points.
pub fn fatigue(arguments: &Arguments) -> u8 {
    threads(arguments.threads.map(usize::from));
    let start = Instant::now();
    let (limits, material) = noted(|| read_material(&arguments.material));
    let limits = match limits {
        Ok(limits) => limits,
        Err(error) => return fail(&error),
    };
    let ((opened, remarks), mut inputs) = noted(|| remarked(|| open(arguments)));
    remarks.iter().for_each(|words| say_to_error(&format!("note: {words}")));
    let (points, table) = match opened {
        Ok(opened) => opened,
        Err(error) => return fail(&error),
    };
    // what the folder is of comes first
    inputs.sort_by_key(|f| f.path != table);
    inputs.extend(material);
    let path = match chosen(arguments.out.as_ref(), &table, "") {
        Ok(path) => path,
        Err(error) => return fail(&error),
    };
    let folder = match Folder::create(&path, Job { names: &Names::of_fatigue(), inputs: &inputs, reads: &paths(&inputs) }) {
        Ok(folder) => folder,
        Err(error) => return fail(&error),
    };
    let grid = arguments.planes();
    let mut table = match FatigueTable::create(&folder) {
        Ok(table) => table,
        Err(error) => return fail(&error),
    };
    let bar = Bar::default();
    bar.stage("points", 0);
    let mut summary = Summary { asked: arguments.point.clone(), ..Summary::default() };
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
        let results = match stress_histories::points(&chunk, &limits, grid) {
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
    if let (Some(name), None) = (&arguments.point, &summary.critical) {
        return fail(&format!("error: found --point {name}, expected the name of one of the {} points of the table", summary.points));
    }
    let printed = || text::fatigue::summary(&summary, &limits);
    let written = table.finish(&folder).and_then(|()| plot::fatigue::draw(&summary, &limits, &folder));
    let figures = [of_point(&summary), of_points(&summary)].into_iter().flatten();
    let written = written.and_then(|()| figures.into_iter().try_for_each(|figure| write_figure(&figure, &folder)));
    let title = format!("Multiaxial fatigue of {} points", summary.points);
    if let Err(error) = written.and_then(|()| write_folder(&title, printed, &folder)).and_then(|()| folder.complete(&about_inputs(&inputs)))
    {
        return fail(&error);
    }
    say(&printed());
    say(&format!("{} points in {:.1} s; {}", summary.points, start.elapsed().as_secs_f64(), files(&folder)));
    DONE
}
