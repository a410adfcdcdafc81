//! `hartog fit`: a law of an absorber from measured stiffness.

use super::exit::{DONE, fail, files, paths, say, say_to_error, threads};
use super::place::chosen;
use crate::absorber::{Declaration, types};
use crate::analysis::fit_law::fit_law;
use crate::input;
use crate::input::tables::measured_law;
use crate::report::{Folder, Job, Names, about_inputs, text, write_fit, write_folder};
use std::path::PathBuf;

/// Arguments of `fit`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Example:\n  hartog fit studies/absorbers/epdm_sleeve.csv --type fractional_zener --reference-c 23 --hold glass_ratio=500\n\n\
TABLE has frequency_hz, stiffness_n_m_per_rad (its real part) and loss_factor, loss_angle_deg or damping_n_m_s_per_rad, as from a shaker, and temperature_c where there are several.\n\
Least squares of the error over the size of the stiffness, from 40 starts; standard errors by linear theory, from the errors that are left. Each\n\
temperature but the reference has a factor of its own on what follows temperature.\n\n\
Exit code: 0 done, 2 bad input."
)]
pub struct Arguments {
    /// Measured stiffness (CSV).
    pub table: PathBuf,
    /// Type of absorber.
    #[arg(long = "type", value_name = "TYPE", value_parser = kind)]
    pub kind: &'static Declaration,
    /// Temperature that the values are for, one of the table's.
    #[arg(long, value_name = "C", allow_negative_numbers = true)]
    pub reference_c: Option<f64>,
    /// A parameter that is known; may be given several times.
    #[arg(long, value_name = "KEY=VALUE", value_parser = held)]
    pub hold: Vec<(String, f64)>,
    /// Output folder [default: out/TABLE_TYPE].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Number of threads [default: all]; results are the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub threads: Option<u16>,
}

fn kind(name: &str) -> Result<&'static Declaration, String> {
    types::find(name).ok_or_else(|| format!("expected one of {}", types::TYPES.map(|t| t.name).join(", ")))
}

fn held(text: &str) -> Result<(String, f64), String> {
    let parts = text.split_once('=').and_then(|(key, value)| Some((key.trim().to_owned(), value.trim().parse().ok()?)));
    parts.ok_or_else(|| "expected a key and a number, as in loss_factor=0.2".into())
}

/// Fits a type to a table, writes what was measured beside the law, and prints its values.
pub fn fit(arguments: &Arguments) -> u8 {
    threads(arguments.threads.map(usize::from));
    let ((table, remarks), inputs) = input::noted(|| input::remarked(|| measured_law(&arguments.table)));
    remarks.iter().for_each(|words| say_to_error(&format!("note: {words}")));
    let table = match table {
        Ok(table) => table,
        Err(error) => return fail(&error),
    };
    let path = match chosen(arguments.out.as_ref(), &arguments.table, &format!("_{}", arguments.kind.name)) {
        Ok(path) => path,
        Err(error) => return fail(&error),
    };
    let folder = match Folder::create(&path, Job { names: &Names::of_fit(), inputs: &inputs, reads: &paths(&inputs) }) {
        Ok(folder) => folder,
        Err(error) => return fail(&error),
    };
    let found = match fit_law(&table, arguments.kind, arguments.reference_c, &arguments.hold) {
        Ok(found) => found,
        Err(error) => return fail(&format!("error: {}: {error}", arguments.table.display())),
    };
    let stem = arguments.table.file_stem().unwrap_or_default().to_string_lossy();
    let printed = || text::fit_law(&found);
    let title = format!("{stem}: a law of type {}", arguments.kind.name);
    let written = write_fit(&found, &folder).and_then(|()| write_folder(&title, printed, &folder));
    if let Err(error) = written.and_then(|()| folder.complete(&about_inputs(&inputs))) {
        return fail(&error);
    }
    say(&printed());
    say(&files(&folder));
    DONE
}
