//! `hartog compare`: published tables beside our own numbers.

use super::exit::{BAD_INPUT, DONE, FAILED, fail, files, paths, say};
use super::place::named_after;
use super::progress::Bar;
use crate::analysis::{self, Calibration, Results, RunError};
use crate::crankshaft::MarginCriterion;
use crate::fatigue::Criterion;
use crate::input::{self, CrankModel, InputFile, Published, Size, SizingStudy, Study};
use crate::objective::Over;
use crate::report::text::publications::SizedPage;
use crate::report::{self, Folder, Names, PAGE, about_inputs, text, write_comparison, write_examples, write_folder, write_rounds};
use crate::sizing::size;
use crate::validation::Comparison;
use crate::validation::rounds::rounds;
use crate::validation::worked_examples::worked_examples;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Arguments of `compare`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  hartog compare\n  hartog compare studies/villalva_v10.toml --out out/v10\n\n\
Every published number has a role: given (an input of the model), calibrated (fitted to), predicted (by our loads and models, without it),\n\
recomputed (from other printed numbers), fitted without freedom, other model, erratum (it contradicts its own source, as the computation\n\
shows) or unexplained (no model comes near it). Notes are in comparison.csv, the order of designs by every measure in choices.csv.\n\n\
Exit code: 0 done, 1 a tolerance stated in a study fails, 2 bad input or no finite response.")]
pub struct Arguments {
    /// Study files (TOML) with published tables [default: those in ./studies].
    pub studies: Vec<PathBuf>,
    /// Output folder; each study gets its own in it [default: out/compare].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Number of threads [default: all]; results are the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub threads: Option<u16>,
    /// Print every row, misprint and tolerance; the page of a study has them in any case.
    #[arg(long)]
    pub verbose: bool,
}

/// What is read for a page, and where that goes.
struct Origin {
    /// Name of its folder.
    name: OsString,
    inputs: Vec<InputFile>,
}

/// A study with what it is compared with.
struct Job {
    study: Study,
    published: Published,
    of: Origin,
}

/// What is to be done.
#[derive(Default)]
struct Jobs {
    studies: Vec<Job>,
    sizings: Vec<(SizingStudy, Origin)>,
}

impl Jobs {
    fn origins(&self) -> impl Iterator<Item = &Origin> {
        self.studies.iter().map(|j| &j.of).chain(self.sizings.iter().map(|s| &s.1))
    }
}

/// What a job gives.
struct Page {
    study: Study,
    calibration: Option<Calibration>,
    comparison: Comparison,
    results: Results,
}

/// Compares studies with their published tables, prints the pages and writes their files.
pub fn compare(arguments: &Arguments) -> u8 {
    crate::cli::threads(arguments.threads.map(usize::from));
    let start = Instant::now();
    let jobs = match jobs(&arguments.studies) {
        Ok(jobs) => jobs,
        Err(code) => return code,
    };
    let root = arguments.out.clone().unwrap_or_else(|| Path::new("out").join("compare"));
    let reads: Vec<PathBuf> = jobs.origins().flat_map(|o| paths(&o.inputs)).collect();
    let folder = |of: &Origin, names: &Names| {
        let job = report::Job { names, inputs: &of.inputs, reads: &reads };
        Folder::create(&root.join(&of.name), job).map_err(|error| fail(&error))
    };
    // all folders before anything is computed
    let of_studies = jobs.studies.iter().map(|job| folder(&job.of, &Names::of_comparison())).collect::<Result<Vec<_>, u8>>();
    let of_sizings = jobs.sizings.iter().map(|(_, of)| folder(of, &Names::of_rounds())).collect::<Result<Vec<_>, u8>>();
    let (of_studies, of_sizings) = match (of_studies, of_sizings) {
        (Ok(studies), Ok(sizings)) => (studies, sizings),
        (Err(code), _) | (_, Err(code)) => return code,
    };
    let (mut pages, alone) = (Vec::new(), jobs.studies.len() + jobs.sizings.len() == 1);
    for (job, folder) in jobs.studies.into_iter().zip(of_studies) {
        let about = about_inputs(&job.of.inputs);
        let bar = Bar::default();
        let page = page(job, &bar);
        drop(bar);
        let page = match page {
            Ok(page) => page,
            Err(error) => return fail(&format!("error: {error}")),
        };
        let written = write_comparison(&page.study, page.calibration.as_ref(), &page.comparison, &page.results, &folder);
        let title = format!("{}: published and computed", page.study.engine.name);
        let written = written.and_then(|()| write_folder(&title, || printed(&page), &folder));
        if let Err(error) = written.and_then(|()| folder.complete(&about)) {
            return fail(&error);
        }
        if alone || arguments.verbose {
            let brief = || text::comparison::brief(&page.study, &page.comparison);
            let told = if arguments.verbose { format!("\n{}", printed(&page)) } else { brief() };
            say(&section(&page.study.engine.name, &told, &folder, alone));
        }
        pages.push(page);
    }
    let mut sized: Vec<SizedPage> = Vec::new();
    for ((study, of), folder) in jobs.sizings.iter().zip(&of_sizings) {
        match sizing((study, of), folder, (arguments.verbose || alone, alone)) {
            Ok(page) => sized.push(page),
            Err(code) => return code,
        }
    }
    if !alone {
        let all: Vec<(&Study, &Comparison)> = pages.iter().map(|p| (&p.study, &p.comparison)).collect();
        say(&text::publications::publications(&all, &sized));
    }
    let first = if alone { String::new() } else { format!(": open {PAGE} in the folders of {}", root.display()) };
    say(&format!("Done in {:.1} s{first}.\n", start.elapsed().as_secs_f64()));
    if pages.iter().all(|p| p.comparison.verdict.holds()) { DONE } else { FAILED }
}

/// What is said of a study, with where its files are.
fn section(title: &str, told: &str, folder: &Folder, alone: bool) -> String {
    if alone {
        return format!("{title}\n{told}  {}\n", files(folder));
    }
    format!("{title}, {} files in {}\n{told}\n", folder.written(), folder.path().display())
}

/// Writes the rounds of sizing and worked examples beside the printed ones, and prints them where that is asked for.
fn sizing((study, of): (&SizingStudy, &Origin), folder: &Folder, (told, alone): (bool, bool)) -> Result<SizedPage, u8> {
    let sized = size(&study.specification).map_err(|e| fail(&format!("error: {}: {e}", study.name)))?;
    let rounds = rounds(&study.specification, &sized.rounds, study.published.as_deref().unwrap_or_default());
    let page = SizedPage { title: study.title.clone(), rounds, examples: worked_examples(&study.examples) };
    let printed = || format!("{}\n{}", text::rounds(&page.rounds), text::examples(&page.examples));
    let title = format!("{}: published and computed", study.title);
    let written = write_rounds(&page.rounds, folder).and_then(|()| write_examples(&page.examples, folder));
    let written = written.and_then(|()| write_folder(&title, printed, folder));
    written.and_then(|()| folder.complete(&about_inputs(&of.inputs))).map_err(|e| fail(&e))?;
    if told {
        say(&section(&study.title, &format!("\n{}", printed()), folder, alone));
    }
    Ok(page)
}

/// The studies and sizing files named, or all in the folder of shipped ones that have tables.
fn jobs(named: &[PathBuf]) -> Result<Jobs, u8> {
    let mut jobs = Jobs::default();
    let paths = if named.is_empty() { shipped()? } else { named.to_vec() };
    for path in paths {
        let missing = |what: &str| Err(fail(&format!("error: {} has no {what} table, expected one to compare with", path.display())));
        let name = named_after(&path).map_err(|error| fail(&error))?;
        if input::is_sizing(&path) {
            let (study, inputs) = input::noted(|| input::read_sizing(&path));
            let study = study.map_err(|error| fail(&error))?;
            match &study.published {
                Some(_) => jobs.sizings.push((study, Origin { name, inputs })),
                None if named.is_empty() => {}
                None => return missing("`published`"),
            }
        } else {
            let (study, inputs) = input::noted(|| input::read(&path));
            let study = study.map_err(|error| fail(&error))?;
            match study.published.clone() {
                Some(published) => jobs.studies.push(Job { study, published, of: Origin { name, inputs } }),
                None if named.is_empty() => {}
                None => return missing("[published]"),
            }
        }
    }
    let names: Vec<&OsString> = jobs.origins().map(|o| &o.name).collect();
    if let Some(name) = (1..names.len()).find(|i| names[..*i].contains(&names[*i])).map(|i| names[i]) {
        return Err(fail(&format!("error: two studies are named `{}`: their output would be mixed", name.display())));
    }
    if names.is_empty() {
        return Err(fail(&"error: no study in ./studies has a [published] table; name one: hartog compare STUDY.toml"));
    }
    Ok(jobs)
}

fn shipped() -> Result<Vec<PathBuf>, u8> {
    let Ok(folder) = std::fs::read_dir("studies") else {
        return Err(fail(&"error: there is no folder ./studies here; name a study: hartog compare STUDY.toml"));
    };
    let mut paths: Vec<PathBuf> =
        folder.filter_map(|e| e.ok().map(|e| e.path())).filter(|p| p.extension().is_some_and(|e| e == "toml")).collect();
    paths.sort();
    if paths.is_empty() {
        let _code = fail(&"error: there is no study in ./studies; name one: hartog compare STUDY.toml");
        return Err(BAD_INPUT);
    }
    Ok(paths)
}

fn page(job: Job, bar: &Bar) -> Result<Page, RunError> {
    let (mut study, calibration) = analysis::calibrate(&job.study, bar)?;
    let whole = study.clone();
    only_published_rings(&mut study, &job.published);
    let results = analysis::run(&study, bar)?;
    let comparison = crate::validation::compare((&study, &whole), &job.published, calibration.as_ref(), &results)?;
    Ok(Page { study, calibration, comparison, results })
}

/// What a comparison needs: no front, only the conditions that an optimum is to hold in, optima for the ring sizes that were published, and no criterion of fatigue after
/// the last that an optimum or a table asks for.
fn only_published_rings(study: &mut Study, published: &Published) {
    if !published.tells_of_responses() {
        // the crank by itself is not excited
        study.leave_searches_out();
        study.designs.truncate(1);
        (study.fatigue, study.crank_model) = (None, CrankModel::Chain);
        return;
    }
    study.front = None;
    study.more_objectives.clear();
    study.combined = None;
    let measures = std::iter::once(&study.objective.measure).chain(study.limits.iter().map(|l| &l.of.measure));
    let of_optima = measures.filter_map(|m| if let Over::Margin(c) = m.over { Some(c) } else { None }).max();
    if let Some(fatigue) = &mut study.fatigue {
        let of_tables = fatigue.criteria.iter().position(|c| *c == MarginCriterion::MeanStress(Criterion::Goodman));
        fatigue.criteria.truncate(1 + of_optima.max(of_tables).unwrap_or(0));
    }
    let held = study.optimise.as_ref().map_or_else(Vec::new, |o| o.conditions.clone());
    study.conditions.retain(|c| held.contains(c));
    for absorber in study.optimise.iter_mut().flat_map(|o| &mut o.absorbers) {
        let Size::Each(sizes) = &mut absorber.size else { continue };
        let is_published = |j: &f64| published.absorbers.iter().any(|a| a.ring_inertia.is_some_and(|r| (r / j - 1.0).abs() < 1e-9));
        if sizes.iter().any(is_published) {
            sizes.retain(is_published);
        }
    }
}

/// What is said of a study.
fn printed(page: &Page) -> String {
    let Page { study, calibration, comparison, .. } = page;
    let calibration = calibration.as_ref().map_or_else(String::new, |c| format!("{}\n", text::calibration::calibration(study, c)));
    let entries = text::comparison::entries(comparison);
    let rankings = text::publications::rankings(comparison);
    format!("{entries}\n{rankings}\n{calibration}In short:\n{}", text::comparison::paragraph(study, comparison))
}
