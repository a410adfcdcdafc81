//! Names of files that a command may write, told before anything is computed. What a study does not ask for is not among them; what is written all the same is looked at again when it is.

use super::formats::Format;
use super::manifest::{JOURNAL, SUMMARY};

/// Name of the page of a folder.
#[doc(hidden)]
pub const PAGE: &str = "report.html";
/// Name of the calculation that a classification society asks for.
#[doc(hidden)]
pub const CLASSIFICATION: &str = "classification.html";
/// Name of what a script wants of a run.
pub(super) const RESULTS: &str = "results.json";
/// What an interrupted run leaves of its searches.
#[doc(hidden)]
pub const UNFINISHED: &str = "unfinished.csv";

/// Names of a command. A stem that ends in `*` stands for all that begin so, in `#` for those that go on with a number.
#[derive(Debug, Clone)]
#[doc(hidden)]
pub struct Names {
    /// The command.
    pub(super) command: &'static str,
    /// Whether it lists what it has written.
    pub(super) lists: bool,
    /// Whole names.
    files: Vec<String>,
    /// Stems of tables.
    tables: Vec<String>,
    /// Stems of plots.
    pub(super) plots: Vec<String>,
    /// Stems of order sheets.
    pub(super) sheets: Vec<String>,
}

impl Names {
    /// Names of a command that lists what it has written.
    pub(super) fn of(command: &'static str, files: &[&str]) -> Self {
        Self { lists: true, ..Self::given(command, files.iter().chain(&[SUMMARY]).map(|n| (*n).to_owned())) }
    }

    /// Whole names of a command that lists nothing when it has ended.
    #[doc(hidden)]
    pub fn given(command: &'static str, files: impl Iterator<Item = String>) -> Self {
        Self {
            command,
            lists: false,
            files: files.chain([JOURNAL.to_owned()]).collect(),
            tables: Vec::new(),
            plots: Vec::new(),
            sheets: Vec::new(),
        }
    }

    pub(super) fn with_files(mut self, names: Vec<String>) -> Self {
        self.files.extend(names);
        self
    }

    pub(super) fn tables(mut self, stems: &[&str]) -> Self {
        self.tables.extend(stems.iter().map(|s| (*s).to_owned()));
        self
    }

    pub(super) fn plots(mut self, stems: &[&str]) -> Self {
        self.plots.extend(stems.iter().map(|s| (*s).to_owned()));
        self
    }

    pub(super) fn both(self, stems: &[&str]) -> Self {
        self.tables(stems).plots(stems)
    }

    pub(super) fn both_if(self, asked: bool, stems: &[&str]) -> Self {
        if asked { self.both(stems) } else { self }
    }

    pub(super) fn plots_if(self, asked: bool, stems: &[&str]) -> Self {
        if asked { self.plots(stems) } else { self }
    }

    pub(super) fn tables_if(self, asked: bool, stems: &[&str]) -> Self {
        if asked { self.tables(stems) } else { self }
    }

    /// Returns whether a file of this name may be written.
    pub(super) fn hold(&self, name: &str) -> bool {
        let stem = |ends: &[(&str, bool)]| ends.iter().filter(|e| e.1).find_map(|e| name.strip_suffix(e.0));
        let table = stem(&[(".csv", true), (".parquet", Format::Parquet.is_wanted())]);
        let plot = stem(&[(".svg", true), (".png", true), (".pdf", Format::Pdf.is_wanted())]);
        let sheet = stem(&[(".html", true), (".pdf", true), (".json", true)]);
        let is_of = |stem: Option<&str>, known: &[String]| stem.is_some_and(|s| known.iter().any(|k| fits(s, k)));
        is_of(sheet, &self.sheets) || self.files.iter().any(|f| f == name) || is_of(table, &self.tables) || is_of(plot, &self.plots)
    }
}

fn fits(stem: &str, known: &str) -> bool {
    match (known.strip_suffix('*'), known.strip_suffix('#')) {
        (Some(begin), _) => stem.starts_with(begin),
        (_, Some(begin)) => stem.strip_prefix(begin).is_some_and(|number| number.parse::<f64>().is_ok()),
        _ => stem == known,
    }
}
