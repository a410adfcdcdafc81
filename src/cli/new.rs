//! `hartog new`: a study and an engine to begin with.

use super::exit::{BAD_INPUT, DONE, fail, say};
use crate::report::Folder;
use crate::report::example::{Arrangement, Example, Gas};
use std::path::PathBuf;

/// How cylinders stand.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
pub enum Engine {
    /// In line.
    InLine,
    /// In two banks, two on a throw.
    V,
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
    let arrangement = match arguments.engine {
        Engine::InLine => Arrangement::InLine,
        Engine::V => Arrangement::V,
    };
    let cylinders = usize::from(arguments.cylinders);
    if arrangement == Arrangement::V && !cylinders.is_multiple_of(2) {
        return fail(&format!("error: found {cylinders} cylinders of a V engine, expected an even number: two are on a throw"));
    }
    let gas = match arguments.pressure {
        Pressure::Wiebe => Gas::Wiebe,
        Pressure::Otto => Gas::Otto,
        Pressure::Measured => Gas::Measured,
        Pressure::Harmonics => Gas::Harmonics,
    };
    let files = Example { arrangement, cylinders, gas }.files();
    if let Some(there) = files.iter().map(|f| arguments.folder.join(f.0)).find(|path| path.exists()) {
        return fail(&format!("error: {} is there already, and would be lost; name another folder", there.display()));
    }
    let written =
        Folder::create(&arguments.folder).and_then(|folder| files.iter().try_for_each(|(name, text)| folder.write(name, text.as_bytes())));
    if let Err(error) = written {
        return fail(&error);
    }
    let names: Vec<&str> = files.iter().map(|f| f.0).collect();
    let folder = arguments.folder.display();
    say(&format!(
        "{} written to {folder}: every value is an example. Replace them, look at what they mean with\n  hartog check {folder}/study.toml\nand run with\n  hartog run {folder}/study.toml\n",
        names.join(", ")
    ));
    DONE
}

/// Prints what a shell needs to complete commands and options.
pub fn completions(shell: clap_complete::Shell, command: &mut clap::Command) -> u8 {
    let mut text = Vec::new();
    clap_complete::generate(shell, command, "hartog", &mut text);
    match String::from_utf8(text) {
        Ok(text) => {
            super::exit::say_raw(&text);
            DONE
        }
        Err(_) => BAD_INPUT,
    }
}
