//! `hartog new`: a study and an engine to begin with.

use super::exit::{DONE, fail, say};
use crate::input;
use crate::report::example::{Arrangement, Example, Files, Gas};
use crate::report::{Folder, Job, Names};
use std::path::{Path, PathBuf};

/// How cylinders stand.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
pub enum Engine {
    /// In line.
    InLine,
    /// In two banks, two on a throw.
    V,
}

impl Engine {
    pub(super) fn arrangement(self) -> Arrangement {
        match self {
            Self::InLine => Arrangement::InLine,
            Self::V => Arrangement::V,
        }
    }
}

/// What is known of the gas.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
pub enum Pressure {
    /// Burning by Wiebe's law, from mean pressures.
    Wiebe,
    /// An ideal cycle, from a torque curve.
    Otto,
    /// Measured over the cycle, with a sample table.
    Measured,
    /// Harmonics of the torque of a throw, with a sample table.
    Harmonics,
}

impl Pressure {
    pub(super) fn gas(self) -> Gas {
        match self {
            Self::Wiebe => Gas::Wiebe,
            Self::Otto => Gas::Otto,
            Self::Measured => Gas::Measured,
            Self::Harmonics => Gas::Harmonics,
        }
    }
}

/// Arguments of `new`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  hartog new own --cylinders 4\n  hartog run own/study.toml")]
pub struct Arguments {
    /// Folder for the files; none of theirs may be there already.
    pub folder: PathBuf,
    /// How the cylinders stand.
    #[arg(long, value_enum, default_value = "in-line")]
    pub engine: Engine,
    /// Number of cylinders; of a V engine an even one.
    #[arg(long, default_value_t = 4, value_parser = clap::value_parser!(u16).range(1..=20))]
    pub cylinders: u16,
    /// What is known of the gas.
    #[arg(long, value_enum, default_value = "wiebe")]
    pub pressure: Pressure,
}

/// Writes a commented study and engine that run at once.
pub fn new(arguments: &Arguments) -> u8 {
    let arrangement = arguments.engine.arrangement();
    let cylinders = usize::from(arguments.cylinders);
    if arrangement == Arrangement::V && !cylinders.is_multiple_of(2) {
        return fail(&format!("error: found {cylinders} cylinders of a V engine, expected an even number: two are on a throw"));
    }
    let example = Example { arrangement, cylinders, gas: arguments.pressure.gas(), chain: None, traces: None };
    match write(&example, &arguments.folder) {
        Ok(names) => {
            let folder = arguments.folder.display();
            say(&format!(
                "{names} written to {folder}: every value is an example. Replace them, look at what they mean with\n  hartog check {folder}/study.toml\nand run with\n  hartog run {folder}/study.toml\n"
            ));
            DONE
        }
        Err(code) => code,
    }
}

/// Reads what is to be written as `check` will, so that nothing is left that is refused afterwards.
fn checked(files: &Files, folder: &Path) -> Result<(), u8> {
    let place = tempfile::tempdir().map_err(|e| fail(&format!("error: no temporary folder could be made: {e}")))?;
    for (name, text) in files {
        std::fs::write(place.path().join(name), text).map_err(|e| fail(&format!("error: no temporary file could be written: {e}")))?;
    }
    let read = input::read(&place.path().join("study.toml"));
    read.map(|_| ()).map_err(|error| fail(&format!("{}\nNothing is written.", error.moved(place.path(), folder))))
}

/// Writes an example where none of its files is there already, and tells their names.
pub(super) fn write(example: &Example, folder: &Path) -> Result<String, u8> {
    let files = example.files();
    // a link that leads nowhere is there, too
    if let Some(there) = files.iter().map(|f| folder.join(f.0)).find(|path| path.symlink_metadata().is_ok()) {
        return Err(fail(&format!("error: {} is there already, and would be lost; name another folder", there.display())));
    }
    checked(&files, folder)?;
    let own = Names::given("new", files.iter().map(|f| f.0.to_owned()));
    let folder = Folder::create(folder, Job { names: &own, inputs: &[], reads: &[] }).map_err(|error| fail(&error))?;
    files.iter().try_for_each(|(name, text)| folder.write(name, text.as_bytes())).map_err(|error| fail(&error))?;
    folder.close();
    let names: Vec<&str> = files.iter().map(|f| f.0).collect();
    Ok(names.join(", "))
}
