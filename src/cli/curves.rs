//! `hartog curves`: what lies behind a design, as tables and plots.

use super::exit::{DONE, fail, files, say};
use super::progress::Bar;
use crate::analysis::curves::{Curves, curves as compute};
use crate::engine::Source;
use crate::input;
use crate::report::{Folder, text, write_curves, write_folder};
use std::path::{Path, PathBuf};

/// Arguments of `curves`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  hartog curves studies/villalva_v10.toml\n  hartog curves studies/mendes_mwm6.toml --speed 1400 --speed 2200\n\n\
Writes a table and a plot each of: cylinder pressure, forces, torque of every throw, loads of the main bearings, shear, moment and torque along the\n\
crank, balance, mode shapes, phase vectors, spectrum, torque of the shafts by orders, motions over the cycle, absorber charts; and holzer.csv."
)]
pub struct Arguments {
    /// Study file (TOML).
    pub study: PathBuf,
    /// Output folder [default: out/STUDY_curves].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Speed of forces and loads; may be given several times [default: that of the largest mean torque and the highest].
    #[arg(long, value_name = "RPM")]
    pub speed: Vec<f64>,
    /// Number of threads [default: all]; results are the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub threads: Option<u16>,
}

/// Computes the curves of a study and writes them.
pub fn curves(arguments: &Arguments) -> u8 {
    crate::cli::threads(arguments.threads.map(usize::from));
    let study = match input::read(&arguments.study) {
        Ok(study) => study,
        Err(error) => return fail(&error),
    };
    let (low, high) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    if let Some(speed) = arguments.speed.iter().find(|s| !(low..=high).contains(*s)) {
        return fail(&format!("error: found --speed {speed}, expected a speed of the study, {low} to {high} rpm"));
    }
    if let (Some(speed), Source::Harmonics(_)) = (arguments.speed.first(), &study.engine.source) {
        return fail(&format!(
            "error: found --speed {speed} for an engine whose torque comes from a table, expected none: it has no forces to show"
        ));
    }
    let mut speeds = arguments.speed.clone();
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    let path = arguments.out.clone().unwrap_or_else(|| Path::new("out").join(format!("{}_curves", study.name)));
    let folder = match Folder::create(&path) {
        Ok(folder) => folder,
        Err(error) => return fail(&error),
    };
    let bar = Bar::default();
    let found = compute(&study, &speeds, &bar);
    drop(bar);
    let Curves { figures, holzer } = match found {
        Ok(curves) => curves,
        Err(error) => return fail(&format!("error: {error}")),
    };
    let printed = || text::curves(&figures, &holzer);
    let title = format!("{}: what lies behind its designs", study.engine.name);
    let written = write_curves(&figures, &holzer, &folder).and_then(|()| write_folder(&title, printed, &folder));
    if let Err(error) = written.and_then(|()| folder.complete()) {
        return fail(&error);
    }
    say(&printed());
    say(&files(&folder));
    DONE
}
