//! `hartog curves`: what lies behind a design, as tables and plots.

use super::exit::{DONE, fail, files, paths, say};
use super::place::chosen;
use super::progress::Bar;
use super::study_arguments::StudyArguments;
use crate::analysis::curves::{Shown, curves_of};
use crate::engine::Source;
use crate::report::{Folder, Job, Names, about_study, text, write_curves, write_folder};
use std::path::PathBuf;

/// Arguments of `curves`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  hartog curves studies/villalva_v10.toml\n  hartog curves studies/mendes_mwm6.toml --speed 1400 --speed 2200\n  \
hartog curves studies/villalva_i6.toml --design none --throw 1 --orders all\n\n\
Writes a table and a plot each of: cylinder pressure, motion of piston and rod, forces on piston, rod and crankpins, torque of every throw,\n\
shafts over the cycle, loads of the main bearings, shear, moment and torque along the crank (by torsion case where the study has one),\n\
balance, mode shapes, phase vectors, spectrum, torque of the shafts by orders, motions over the cycle, absorber charts; and holzer.csv. Of a\n\
flexible crank its modes, orbits, bearing forces and moments of webs, too; of one by matrices the motions of its unknowns, for stresses."
)]
pub struct Arguments {
    /// The study.
    #[command(flatten)]
    pub study: StudyArguments,
    /// Output folder [default: out/STUDY_curves; of a file called study.toml, after the folder where it is].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Speed of pressure, forces and loads; may be given several times [default: of pressure the lowest tabulated speed, that of its largest value, and the highest; else that of the largest mean torque and the highest].
    #[arg(long, value_name = "RPM")]
    pub speed: Vec<f64>,
    /// Design that is shown; may be given several times [default: all].
    #[arg(long, value_name = "NAME")]
    pub design: Vec<String>,
    /// Throw that is shown where there is a curve a throw, and whose loads are written where the crank is flexible; may be given several times [default: all, without their loads].
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u16).range(1..))]
    pub throw: Vec<u16>,
    /// Orders that the torque of shafts shows.
    #[arg(long, value_name = "WHICH", value_enum, default_value_t)]
    pub orders: Orders,
    /// Number of threads [default: all]; results are the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub threads: Option<u16>,
}

/// Orders that are drawn.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Orders {
    /// Those with the largest peaks.
    #[default]
    Main,
    /// All of the study.
    All,
}

/// Computes the curves of a study and writes them.
pub fn curves(arguments: &Arguments) -> u8 {
    crate::cli::threads(arguments.threads.map(usize::from));
    let (study, inputs) = arguments.study.read();
    let study = match study {
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
    if let Some(name) = arguments.design.iter().find(|name| !study.designs.iter().any(|d| d.name == **name)) {
        let known: Vec<&str> = study.designs.iter().map(|d| d.name.as_str()).collect();
        return fail(&format!("error: found --design {name}, expected one of the study: {}", known.join(", ")));
    }
    let throws = study.engine.layout.throws();
    if let Some(throw) = arguments.throw.iter().find(|t| usize::from(**t) > throws) {
        return fail(&format!("error: found --throw {throw}, expected a number from 1 to {throws}"));
    }
    let path = match chosen(arguments.out.as_ref(), &arguments.study.path, "_curves") {
        Ok(path) => path,
        Err(error) => return fail(&error),
    };
    let job = Job { names: &Names::of_curves(&study), inputs: &inputs, reads: &paths(&inputs) };
    let folder = match Folder::create(&path, job) {
        Ok(folder) => folder,
        Err(error) => return fail(&error),
    };
    let bar = Bar::default();
    let shown = Shown {
        speeds_rpm: speeds,
        designs: arguments.design.clone(),
        throws: arguments.throw.iter().map(|t| usize::from(*t) - 1).collect(),
        all_orders: arguments.orders == Orders::All,
    };
    let found = curves_of(&study, &shown, &bar);
    drop(bar);
    let found = match found {
        Ok(curves) => curves,
        Err(error) => return fail(&format!("error: {error}")),
    };
    let printed = || text::curves(&found.figures, &found.holzer);
    let title = format!("{}: what lies behind its designs", study.engine.name);
    let written = write_curves(&found, &folder).and_then(|()| write_folder(&title, printed, &folder));
    if let Err(error) = written.and_then(|()| folder.complete(&about_study(&study, &inputs))) {
        return fail(&error);
    }
    say(&printed());
    say(&files(&folder));
    DONE
}
