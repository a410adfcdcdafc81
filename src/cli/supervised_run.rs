//! A run that is watched: its progress on the terminal, its journal on the disk, and what an interrupt leaves.

use super::exit::{INTERRUPTED, say_to_error};
use super::progress::Bar;
use crate::analysis::Progress;
use crate::input::{Study, UnitOf};
use crate::objective::holds;
use crate::optimise::{BestSoFar, Memory};
use crate::report::{Folder, Journal, UNFINISHED};
use std::sync::{Arc, Mutex, PoisonError};

/// What a run tells of itself goes to a bar and a journal.
#[derive(Debug)]
pub(crate) struct Watched {
    pub bar: Bar,
    journal: Arc<Journal>,
    /// Unit of the first objective, and its best value so far.
    unit: UnitOf,
    best: Mutex<f64>,
}

impl Watched {
    pub fn new(study: &Study, journal: Arc<Journal>, quiet: bool) -> Self {
        Self {
            bar: if quiet { Bar::hidden() } else { Bar::default() },
            journal,
            unit: study.objective.unit,
            best: Mutex::new(f64::INFINITY),
        }
    }
}

impl Progress for Watched {
    fn stage(&self, name: &str, steps: usize) {
        self.bar.stage(name, steps);
    }
    fn step(&self) {
        self.bar.step();
    }
    fn memory(&self) -> Option<&dyn Memory> {
        Some(self)
    }
}

impl Memory for Watched {
    fn recall(&self, key: u64) -> Option<Vec<u8>> {
        self.journal.recall(key)
    }
    fn keep(&self, key: u64, found: &[u8]) {
        self.journal.keep(key, found);
    }
    fn found(&self, found: &BestSoFar) {
        self.journal.found(found);
        let mut best = self.best.lock().unwrap_or_else(PoisonError::into_inner);
        if found.search.objective == 0 && holds(1.0 + found.excess) && found.value < *best {
            *best = found.value;
            self.bar.best(&format!("best {:.5}{}", self.unit.shown(*best), self.unit.suffix()));
        }
    }
}

/// An interrupt (Ctrl-C) ends the run: the best designs so far are written, marked as unfinished; the journal stays.
pub(crate) fn end_at_interrupt(study: &Study, folder: &Arc<Folder>, journal: &Arc<Journal>) {
    let (folder, journal) = (folder.clone(), journal.clone());
    let units: Vec<UnitOf> = study.objectives().map(|o| o.unit).collect();
    let end = move || {
        let shown = |objective: usize, value: f64| {
            let unit = units.get(objective).copied().unwrap_or(UnitOf::Ratio);
            (unit.shown(value), unit.suffix().trim())
        };
        let written = folder.write(UNFINISHED, &journal.best(shown)).and_then(|()| folder.summarise(false, &serde_json::Map::new()));
        let (kept, goes_on) = journal.kept();
        let on = if goes_on { "; run again with --resume to go on" } else { "" };
        match written {
            Ok(()) => say_to_error(&format!("interrupted: {kept}, the best designs so far in {UNFINISHED} beside it{on}")),
            Err(error) => say_to_error(&format!("interrupted: {kept}{on}\n{error}")),
        }
        std::process::exit(i32::from(INTERRUPTED));
    };
    // another handler is there already: the first wins
    let _first = ctrlc::set_handler(end);
}
