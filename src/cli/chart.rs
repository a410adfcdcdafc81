//! `hartog chart`: speed against accuracy of every response method, and where each fails.

use super::exit::{DONE, FAILED, fail, files, paths, say};
use super::place::named_after;
use super::progress::Bar;
use crate::benchmark::{Chart, Common};
use crate::input::{self, InputFile, Study};
use crate::report::{Folder, Job, Names, about_inputs, text, write_chart, write_folder};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Arguments of `chart`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  hartog chart\n  hartog chart studies/villalva_i6.toml --out out/six\n\n\
Times are medians of repetitions on one thread; they differ from run to run and from machine to machine, errors do not.\n\n\
Exit code: 0 done, 1 a method does not do what is declared of it in a scenario or skipping changes a peak, 2 bad input or no finite\n\
response.")]
pub struct Arguments {
    /// Study files (TOML).
    #[arg(default_values = ["studies/villalva_i6.toml", "studies/villalva_v10.toml"])]
    pub studies: Vec<PathBuf>,
    /// Output folder; of several studies each gets its own in it [default: out/chart, with a folder for each study].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// Measures every method on studies and on the scenarios, prints and plots.
pub fn chart(arguments: &Arguments) -> u8 {
    let start = Instant::now();
    let jobs = match jobs(arguments) {
        Ok(jobs) => jobs,
        Err(code) => return code,
    };
    let bar = Bar::default();
    let common = Common::measure(&bar);
    drop(bar);
    let mut holds = common.holds();
    for (study, inputs, folder) in jobs {
        let bar = Bar::default();
        let chart = Chart::measure(&study, &common, &bar);
        drop(bar);
        let chart = match chart {
            Ok(chart) => chart,
            Err(error) => return fail(&format!("error: {error}")),
        };
        let title = format!("{}: speed against accuracy", chart.study.engine.name);
        let printed = || format!("{}\n{}", text::chart::of_study(&chart), text::chart::common(&common));
        let written = write_chart(&chart, &folder).and_then(|()| write_folder(&title, printed, &folder));
        if let Err(error) = written.and_then(|()| folder.complete(&about_inputs(&inputs))) {
            return fail(&error);
        }
        say(&text::chart::of_study(&chart));
        say(&format!("{}\n", files(&folder)));
        holds &= chart.holds();
    }
    say(&text::chart::common(&common));
    say(&format!("Done in {:.1} s.\n", start.elapsed().as_secs_f64()));
    if holds { DONE } else { FAILED }
}

/// The studies with what was read and the folders of their charts.
fn jobs(arguments: &Arguments) -> Result<Vec<(Study, Vec<InputFile>, Folder)>, u8> {
    let mut studies: Vec<(Study, Vec<InputFile>, OsString)> = Vec::new();
    for path in &arguments.studies {
        let (study, inputs) = input::noted(|| input::read(path));
        let study = study.map_err(|error| fail(&error))?;
        let name = named_after(path).map_err(|error| fail(&error))?;
        if studies.iter().any(|s| s.2 == name) {
            return Err(fail(&format!("error: two studies are named `{}`: their output would be mixed", name.display())));
        }
        studies.push((study, inputs, name));
    }
    let reads: Vec<PathBuf> = studies.iter().flat_map(|s| paths(&s.1)).collect();
    let mut jobs = Vec::new();
    for (study, inputs, name) in studies {
        let folder = match &arguments.out {
            Some(out) if arguments.studies.len() == 1 => out.clone(),
            Some(out) => out.join(name),
            None => Path::new("out").join("chart").join(name),
        };
        let job = Job { names: &Names::of_chart(), inputs: &inputs, reads: &reads };
        let folder = Folder::create(&folder, job).map_err(|error| fail(&error))?;
        jobs.push((study, inputs, folder));
    }
    Ok(jobs)
}
