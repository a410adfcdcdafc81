//! Names of the files that commands may write, told before anything is computed. What a study does not ask for is not among them; what is written all the same is looked at again when it is.

use super::formats::Format;
use super::manifest::{JOURNAL, SUMMARY};
use super::run_tables::{RUN_TABLES, has_large_twist, materials};
use crate::input::{FrontSpec, RETUNED, Study};

/// Name of the page of a folder.
pub(crate) const PAGE: &str = "report.html";
/// Name of the calculation that a classification society asks for.
pub(crate) const CLASSIFICATION: &str = "classification.html";
/// Name of what a script wants of a run.
pub(super) const RESULTS: &str = "results.json";
/// What an interrupted run leaves of its searches.
pub(crate) const UNFINISHED: &str = "unfinished.csv";

/// Names of a command. A stem that ends in `*` stands for all that begin so, in `#` for those that go on with a number.
#[derive(Debug, Clone)]
pub(crate) struct Names {
    /// The command.
    pub(super) command: &'static str,
    /// Whether it lists what it has written.
    pub(super) lists: bool,
    /// Whole names.
    files: Vec<String>,
    /// Stems of tables.
    tables: Vec<String>,
    /// Stems of plots.
    plots: Vec<String>,
}

impl Names {
    /// Names of a command that lists what it has written.
    fn of(command: &'static str, files: &[&str]) -> Self {
        Self { lists: true, ..Self::given(command, files.iter().chain(&[SUMMARY]).map(|n| (*n).to_owned())) }
    }

    /// Whole names of a command that lists nothing when it has ended.
    pub(crate) fn given(command: &'static str, files: impl Iterator<Item = String>) -> Self {
        Self { command, lists: false, files: files.chain([JOURNAL.to_owned()]).collect(), tables: Vec::new(), plots: Vec::new() }
    }

    fn tables(mut self, stems: &[&str]) -> Self {
        self.tables.extend(stems.iter().map(|s| (*s).to_owned()));
        self
    }

    fn plots(mut self, stems: &[&str]) -> Self {
        self.plots.extend(stems.iter().map(|s| (*s).to_owned()));
        self
    }

    fn both(self, stems: &[&str]) -> Self {
        self.tables(stems).plots(stems)
    }

    fn both_if(self, asked: bool, stems: &[&str]) -> Self {
        if asked { self.both(stems) } else { self }
    }

    fn plots_if(self, asked: bool, stems: &[&str]) -> Self {
        if asked { self.plots(stems) } else { self }
    }

    fn tables_if(self, asked: bool, stems: &[&str]) -> Self {
        if asked { self.tables(stems) } else { self }
    }

    /// Plots of designs: those that are given, the best of catalogues, and optima.
    fn each_design(mut self, study: &Study) -> Self {
        let sold = study.catalogues.iter().flat_map(|c| &c.designs);
        let sold = sold.flat_map(|d| [d.name.clone(), format!("{}{RETUNED}", d.name)]);
        let given = study.designs.iter().map(|d| d.name.clone());
        let found = study.optimise.iter().map(|_| "optimum_*".to_owned());
        self.plots.extend(given.chain(sold).chain(found).map(|name| format!("response_{name}")));
        self
    }

    /// Those of `hartog run`.
    pub(crate) fn of_run(study: &Study) -> Self {
        let asked = RUN_TABLES.iter().filter(|t| (t.asked)(study)).map(|t| t.stem);
        let mut names = Self::of("run", &[PAGE, RESULTS, UNFINISHED])
            .tables(&asked.collect::<Vec<_>>())
            .tables(&["response", "timing"])
            .plots(&["designs", "campbell", "excitation"])
            .each_design(study)
            .plots_if(materials(study, &|m| m.thermal.is_some()), &["heat"])
            .plots_if(has_large_twist(study), &["large_twist"])
            .both_if(study.robust.is_some(), &["tolerance_band"])
            .both_if(study.calibrate.is_some(), &["calibration"])
            .both_if(study.fatigue.is_some(), &["margin"]);
        if study.fatigue.is_some() {
            names = names.plots(&["crank"]);
        }
        match &study.front {
            Some(FrontSpec::OverInertia(_)) => names.plots(&["pareto"]),
            Some(FrontSpec::Of { measures, .. }) => {
                let words = || measures.iter().map(|m| &m.word);
                names.plots.extend(words().flat_map(|a| words().map(move |b| format!("front_{a}_{b}"))));
                names
            }
            None => names,
        }
    }

    /// Those of `hartog report`.
    pub(crate) fn of_report(study: &Study) -> Self {
        Self::of("report", &[CLASSIFICATION])
            .tables(&["designs", "values", "absorbers", "response", "holzer", "vector_sums", "criticals", "shaft_torques"])
            .tables_if(!study.limits.is_empty(), &["limits", "barred"])
            .plots(&["campbell", "excitation"])
            .each_design(study)
    }

    /// Those of `hartog compare` of a study.
    pub(crate) fn of_comparison() -> Self {
        Self::of("compare", &[PAGE]).both(&["comparison", "calibration"]).plots(&["orders"])
    }

    /// Those of `hartog compare` of a sizing file.
    pub(crate) fn of_rounds() -> Self {
        Self::of("compare", &[PAGE]).tables(&["sizing_comparison"])
    }

    /// Those of `hartog chart`.
    pub(crate) fn of_chart() -> Self {
        Self::of("chart", &[PAGE]).both(&["speed_accuracy"]).plots(&["models", "growth", "stability"])
    }

    /// Those of `hartog curves`.
    pub(crate) fn of_curves(study: &Study) -> Self {
        let shafts: Vec<String> = study.designs.iter().map(|d| format!("shaft_torque_{}", d.name)).collect();
        Self::of("curves", &[PAGE])
            .tables(&["holzer"])
            .both(&["cylinder", "forces_#", "torque_#", "bearings_#", "crank_loads_#", "balance", "campbell", "modes"])
            .both(&["phase_vectors", "spectrum", "histories", "absorber_chart"])
            .both(&shafts.iter().map(String::as_str).collect::<Vec<_>>())
    }

    /// Those of `hartog fatigue`.
    pub(crate) fn of_fatigue() -> Self {
        Self::of("fatigue", &[PAGE]).both(&["fatigue"])
    }

    /// Those of `hartog fit`.
    pub(crate) fn of_fit() -> Self {
        Self::of("fit", &[PAGE]).both(&["fit"])
    }

    /// Those of `hartog size`.
    pub(crate) fn of_size() -> Self {
        Self::of("size", &[PAGE, "engine.toml", "study.toml", "pressure.csv"])
            .tables(&["sizing", "sizing_comparison"])
            .both(&["sizing_front", "sizing_forces_*", "sizing_moments_*"])
            .plots(&["drawing"])
    }

    /// Returns whether a file of this name may be written.
    pub(super) fn hold(&self, name: &str) -> bool {
        let stem = |ends: &[(&str, bool)]| ends.iter().filter(|e| e.1).find_map(|e| name.strip_suffix(e.0));
        let table = stem(&[(".csv", true), (".parquet", Format::Parquet.is_wanted())]);
        let plot = stem(&[(".svg", true), (".png", true), (".pdf", Format::Pdf.is_wanted())]);
        let is_of = |stem: Option<&str>, known: &[String]| stem.is_some_and(|s| known.iter().any(|k| fits(s, k)));
        self.files.iter().any(|f| f == name) || is_of(table, &self.tables) || is_of(plot, &self.plots)
    }
}

fn fits(stem: &str, known: &str) -> bool {
    match (known.strip_suffix('*'), known.strip_suffix('#')) {
        (Some(begin), _) => stem.starts_with(begin),
        (_, Some(begin)) => stem.strip_prefix(begin).is_some_and(|number| number.parse::<f64>().is_ok()),
        _ => stem == known,
    }
}
