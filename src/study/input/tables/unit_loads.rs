//! Stress tensors per unit load, point by point: what one finite-element run gives for every speed and absorber.

use super::named::UNIT_LOADS;
use super::shown::shown;
use super::stream::Stream;
use crate::input::error::InputError;
use std::collections::HashSet;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;

/// A point with its tensor per unit of each load, Pa; zero where the table has none.
pub(crate) type UnitPoint = (String, Vec<[f64; 6]>);

/// Reads a table of stresses per unit load. Rows of a point follow each other.
pub(crate) struct UnitLoadReader {
    stream: Stream,
    /// Names of the loads.
    loads: Vec<String>,
    /// First row of the next point, already read.
    waiting: Option<Row>,
    /// Hashes of the names so far: eight bytes a point.
    seen: HashSet<u64>,
    /// Indices of the loads that rows have named.
    named: HashSet<usize>,
    ended: bool,
}

struct Row {
    line: u64,
    point: String,
    load: usize,
    tensor: [f64; 6],
}

impl UnitLoadReader {
    /// Opens a table whose loads are among these.
    ///
    /// # Errors
    /// [`InputError`] where it cannot be read or a column is missing.
    pub(crate) fn open(path: &Path, loads: &[String]) -> Result<Self, InputError> {
        let stream = Stream::open(path, ["point", "load"], &UNIT_LOADS)?;
        Ok(Self { stream, loads: loads.to_vec(), waiting: None, seen: HashSet::new(), named: HashSet::new(), ended: false })
    }

    /// Loads that no row has named.
    pub(crate) fn unnamed(&self) -> impl Iterator<Item = &str> {
        self.loads.iter().enumerate().filter(|(i, _)| !self.named.contains(i)).map(|(_, load)| load.as_str())
    }

    fn row(&mut self) -> Result<Option<Row>, InputError> {
        if let Some(row) = self.waiting.take() {
            return Ok(Some(row));
        }
        let Some((line, record)) = self.stream.next()? else { return Ok(None) };
        let point = self.stream.name(line, &record, 0, "point")?;
        let load = self.stream.name(line, &record, 1, "load")?;
        let Some(index) = self.loads.iter().position(|l| *l == load) else {
            return Err(self.stream.at(line, 1, format!("found load `{}`, expected one of {}", shown(&load), self.loads.join(", "))));
        };
        self.named.insert(index);
        Ok(Some(Row { line, point, load: index, tensor: self.stream.tensor(line, &record)? }))
    }

    fn point(&mut self) -> Result<Option<UnitPoint>, InputError> {
        let Some(first) = self.row()? else {
            let none = || self.stream.at_head(0, "found no row, expected stresses per unit load".into());
            return if self.seen.is_empty() { Err(none()) } else { Ok(None) };
        };
        let mut hasher = DefaultHasher::new();
        first.point.hash(&mut hasher);
        if !self.seen.insert(hasher.finish()) {
            let words = format!("found point `{}` again after another, expected its rows together", shown(&first.point));
            return Err(self.stream.at(first.line, 0, words));
        }
        let name = first.point.clone();
        let mut tensors: Vec<Option<[f64; 6]>> = vec![None; self.loads.len()];
        let mut next = Some(first);
        while let Some(row) = next {
            if row.point != name {
                self.waiting = Some(row);
                break;
            }
            if tensors[row.load].replace(row.tensor).is_some() {
                let words = format!("found load `{}` of point `{}` a second time", self.loads[row.load], shown(&name));
                return Err(self.stream.at(row.line, 1, words));
            }
            next = self.row()?;
        }
        Ok(Some((name, tensors.into_iter().map(|t| t.unwrap_or([0.0; 6])).collect())))
    }
}

impl Iterator for UnitLoadReader {
    type Item = Result<UnitPoint, InputError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let point = self.point();
        self.ended = !matches!(point, Ok(Some(_)));
        point.transpose()
    }
}
