//! `hartog import`: a study and an engine round a chain that another program wrote.

use super::exit::{DONE, fail, say, say_to_error};
use super::new::{Engine, Pressure, write};
use crate::input::import::{chain, traces};
use crate::input::{FoundChain, FoundStation, remarked};
use crate::report::example::{Arrangement, Example, Gas};
use std::path::PathBuf;

/// Arguments of `import`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  hartog import mass_elastic.csv own --throws \"throw 1,throw 2,throw 3\" --trace 2000=pressure.csv\n  hartog import assembly.json own --throws Crank1,Crank2\n\n\
A table has a row a station from the free end to the flywheel, with units in its header: `Mass;Inertia [kg m2];Stiffness to next [MN m/rad]`, and if known\n\
`Damping to next [N m s/rad]`, `Damping to ground [N m s/rad]` and `Throws`; commas, semicolons or tabs between columns. A trace has\n\
columns like `Angle [deg];Pressure [bar]`. Heads may be German, French or Portuguese, and numbers have decimal commas where these do not separate\n\
columns. An assembly of openTorsion is a line of disks and shafts as JSON.\n\
All that is not of the chain is an example, to be replaced."
)]
pub struct Arguments {
    /// Mass-elastic table (CSV) or assembly of openTorsion (JSON).
    pub chain: PathBuf,
    /// Folder for the files; none of theirs may be there already.
    pub folder: PathBuf,
    /// Stations with a throw, in their order, commas between [default: those of the table's column of throws].
    #[arg(long, value_name = "STATIONS", value_delimiter = ',')]
    pub throws: Vec<String>,
    /// How the cylinders stand; of a V engine two are on a throw.
    #[arg(long, value_enum, default_value = "in-line")]
    pub engine: Engine,
    /// What is known of the gas.
    #[arg(long, value_enum, default_value = "wiebe", conflicts_with = "trace")]
    pub pressure: Pressure,
    /// A trace of the absolute pressure measured at a speed, as a table over the angle from firing dead centre; may be given several times.
    #[arg(long, value_name = "RPM=FILE", value_parser = speed_and_file)]
    pub trace: Vec<(f64, PathBuf)>,
}

fn speed_and_file(text: &str) -> Result<(f64, PathBuf), String> {
    let grouped = |speed: &str| speed.split_once(['.', ',']).is_some_and(|(whole, rest)| whole.len() <= 3 && rest.len() == 3);
    if let Some((speed, _)) = text.split_once('=').filter(|(speed, _)| grouped(speed.trim())) {
        let own = speed.trim();
        return Err(format!("`{own}` may be grouped thousands: write {} or {}0", own.replace(['.', ','], ""), own.replace(',', ".")));
    }
    let found = text.split_once('=').and_then(|(speed, file)| Some((speed.trim().parse::<f64>().ok()?, PathBuf::from(file))));
    found.filter(|f| (1.0..=1e5).contains(&f.0)).ok_or_else(|| "expected a speed in rpm and a file, such as 2000=trace.csv".into())
}

/// Reads the chain and writes a commented study and engine round it.
pub fn import(arguments: &Arguments) -> u8 {
    let (found, mut remarks) = remarked(|| chain(&arguments.chain));
    let mut found = match found {
        Ok(found) => found,
        Err(error) => return fail(&error),
    };
    if let Err(message) = place(&mut found, &arguments.throws) {
        return fail(&format!("error: {message}"));
    }
    let (gas, traces) = match arguments.trace.as_slice() {
        [] => (arguments.pressure.gas(), None),
        files => {
            let (found, more) = remarked(|| traces(files));
            remarks.extend(more);
            match found {
                Ok(found) => (Gas::Measured, Some(found)),
                Err(error) => return fail(&error),
            }
        }
    };
    let throws = found.stations.iter().map(|s| s.throws.len()).sum::<usize>();
    let arrangement = arguments.engine.arrangement();
    let cylinders = if arrangement == Arrangement::V { 2 * throws } else { throws };
    remarks.iter().for_each(|words| say_to_error(&format!("note: {words}")));
    if let Some(first) = heavy_first(&found) {
        say_to_error(&format!(
            "note: the chain begins with `{first}`, its largest inertia: a table is read from the free end, and the absorber of the study is on its first station"
        ));
    }
    let left_out: String = found.left_out.iter().map(|words| format!("Left out: {words}.\n")).collect();
    let stations = found.stations.len();
    let example = Example { arrangement, cylinders, gas, chain: Some(found), traces };
    let names = match write(&example, &arguments.folder) {
        Ok(names) => names,
        Err(code) => return code,
    };
    let folder = arguments.folder.display();
    say(&format!(
        "{left_out}{stations} stations with {throws} throws imported; {names} written to {folder}. The inertias are taken to hold the reciprocating masses. \
         All that was not imported is an example: replace it, look at what it means with\n  hartog check {folder}/study.toml\nand run with\n  hartog run {folder}/study.toml\n"
    ));
    DONE
}

/// The first station where no other has as much inertia: a flywheel, most likely.
fn heavy_first(found: &FoundChain) -> Option<&str> {
    let (first, others) = found.stations.split_first()?;
    others.iter().all(|s| s.inertia < first.inertia).then_some(first.name.as_str())
}

/// Puts throws where they are named; they must be somewhere, and each number once.
fn place(found: &mut FoundChain, named: &[String]) -> Result<(), String> {
    let all = |stations: &[FoundStation]| stations.iter().map(|s| format!("`{}`", s.name)).collect::<Vec<_>>().join(", ");
    if !named.is_empty() {
        found.stations.iter_mut().for_each(|s| s.throws.clear());
    }
    for (i, name) in named.iter().enumerate() {
        let names = all(&found.stations);
        let station = found.stations.iter_mut().find(|s| s.name == name.trim());
        station.ok_or_else(|| format!("found `{name}` in --throws, expected stations among {names}"))?.throws.push(i + 1);
    }
    let mut throws: Vec<usize> = found.stations.iter().flat_map(|s| s.throws.iter().copied()).collect();
    throws.sort_unstable();
    if throws.is_empty() {
        return Err(format!("found no station with a throw, expected --throws with some of {}", all(&found.stations)));
    }
    if throws.iter().zip(1..).any(|(t, i)| *t != i) || throws.len() > 20 {
        return Err(format!("found the throws {throws:?}, expected each number from 1 once, 20 at most"));
    }
    Ok(())
}
