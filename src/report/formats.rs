//! Formats that are written beside CSV, SVG and PNG where they are asked for.

use std::sync::atomic::{AtomicBool, Ordering};

/// One of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Format {
    /// Every plot as PDF.
    Pdf,
    /// Every table as Parquet.
    Parquet,
}

/// Of this process: what is written has the same formats everywhere.
static PDF: AtomicBool = AtomicBool::new(false);
static PARQUET: AtomicBool = AtomicBool::new(false);

impl Format {
    fn flag(self) -> &'static AtomicBool {
        match self {
            Self::Pdf => &PDF,
            Self::Parquet => &PARQUET,
        }
    }

    /// Asks for it, from now on.
    pub fn ask(self) {
        self.flag().store(true, Ordering::Relaxed);
    }

    /// Whether it is asked for.
    pub(crate) fn is_wanted(self) -> bool {
        self.flag().load(Ordering::Relaxed)
    }

    /// The name of a file in this format beside one in `.csv` or `.svg`; nothing where it has none.
    pub(crate) fn beside(self, name: &str) -> Option<String> {
        let (from, to) = match self {
            Self::Pdf => (".svg", "pdf"),
            Self::Parquet => (".csv", "parquet"),
        };
        name.strip_suffix(from).map(|stem| format!("{stem}.{to}"))
    }
}
