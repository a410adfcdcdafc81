//! Stress histories by superposition \[Minucci 2010\] section 5.1.1: stresses per unit load, times the loads over the cycle.

use super::cycle::{CLOSED, ends_where_it_began, follows};
use super::named::LOADS;
use super::table::{Table, whole};
use super::{PointHistory, UnitLoadReader};
use crate::fatigue::multiaxial::History;
use crate::input::error::InputError;
use std::path::{Path, PathBuf};

/// Loads over a cycle.
#[derive(Debug, Clone, PartialEq)]
struct Loads {
    names: Vec<String>,
    /// Of each load, a value a sample; the end of the cycle is not repeated.
    values: Vec<Vec<f64>>,
}

impl Loads {
    /// `crank_deg`, then a column a load.
    fn read(path: &Path) -> Result<Self, InputError> {
        let table = Table::read_named(path, &["crank_deg"], &LOADS)?;
        let angle = table.column("crank_deg")?;
        let columns: Vec<usize> = (0..table.header.len()).filter(|c| *c != angle).collect();
        if let Some(c) = columns.iter().find(|c| table.header[**c].is_empty()) {
            return Err(table.at_head(*c, "found a column without a name, expected that of a load".into()));
        }
        if columns.is_empty() {
            return Err(table.whole("found no column beside `crank_deg`, expected one a load".into()));
        }
        let rows = table.numbers()?;
        let mut angles: Vec<f64> = Vec::new();
        for (line, row) in &rows {
            if !angles.is_empty() {
                follows(&angles, row[angle], None).map_err(|words| table.at(*line, angle, words))?;
            }
            angles.push(row[angle]);
        }
        let last = rows.last().map_or(1, |r| r.0);
        let mut kept = rows.len();
        if ends_where_it_began(&angles, "").map_err(|words| table.at(last, angle, words))? {
            kept -= 1;
            for c in &columns {
                let largest = rows.iter().map(|r| r.1[*c].abs()).fold(0.0, f64::max);
                let off = (rows[kept].1[*c] - rows[0].1[*c]).abs();
                if off > CLOSED * largest {
                    let words = format!("found the load at the end of the cycle {off} off its beginning, expected a closed cycle");
                    return Err(table.at(last, *c, words));
                }
            }
        }
        let names = columns.iter().map(|c| table.header[*c].clone()).collect();
        Ok(Self { names, values: columns.iter().map(|c| rows[..kept].iter().map(|r| r.1[*c]).collect()).collect() })
    }
}

/// Histories of the points of a table of stresses per unit load, one after the other.
#[doc(hidden)]
pub struct Superposed {
    path: PathBuf,
    points: UnitLoadReader,
    loads: Loads,
    ended: bool,
}

impl Superposed {
    /// Opens a table of stresses per unit load, and reads the loads.
    ///
    /// # Errors
    /// [`InputError`] with file, row and column.
    #[doc(hidden)]
    pub fn open(unit_loads: &Path, loads: &Path) -> Result<Self, InputError> {
        let loads = Loads::read(loads)?;
        Ok(Self { path: unit_loads.to_path_buf(), points: UnitLoadReader::open(unit_loads, &loads.names)?, loads, ended: false })
    }
}

impl Iterator for Superposed {
    type Item = Result<PointHistory, InputError>;

    fn next(&mut self) -> Option<Self::Item> {
        let superposed = |(name, tensors): crate::input::tables::UnitPoint| {
            let samples = self.loads.values.first().map_or(0, Vec::len);
            let tensor_at = |j: usize| -> [f64; 6] {
                std::array::from_fn(|c| tensors.iter().zip(&self.loads.values).map(|(t, load)| t[c] * load[j]).sum())
            };
            let history = History::new((0..samples).map(tensor_at));
            if history.components.iter().flatten().all(|s| *s == 0.0) {
                let message = format!("found no stress at all at point `{}` under these loads, expected some", super::shown::shown(&name));
                return Err(whole(&self.path, message));
            }
            Ok(PointHistory { name, history })
        };
        if let Some(point) = self.points.next() {
            return Some(point.and_then(superposed));
        }
        // what no point has stresses under was forgotten; told once, at the end
        if std::mem::replace(&mut self.ended, true) {
            return None;
        }
        let load = self.points.unnamed().next()?;
        Some(Err(whole(&self.path, format!("found no stresses under the load `{load}`, expected some, or zeros, under each of the loads"))))
    }
}
