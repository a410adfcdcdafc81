//! Stress histories, point by point, so that memory does not grow with their number.

use super::cycle::{CLOSED, ends_where_it_began, follows};
use super::named::HISTORY;
use super::shown::shown;
use super::stream::Stream;
use crate::fatigue::multiaxial::History;
use crate::input::error::InputError;
use crate::units::PA_PER_MPA;
use std::collections::HashSet;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;

/// Samples of one point: a tenth of a degree of two turns is 7200.
const MOST_SAMPLES: usize = 100_000;

/// The stress of one point over a cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct PointHistory {
    /// Name of the point.
    pub name: String,
    /// Its stress; the end of the cycle is not repeated.
    pub history: History,
}

/// Reads a table of histories. Rows of a point follow each other; all points have the same angles.
pub struct HistoryReader {
    stream: Stream,
    /// First row of the next point, already read.
    waiting: Option<Row>,
    /// Angles of the first point.
    angles: Vec<f64>,
    /// Hashes of the names so far: eight bytes a point.
    seen: HashSet<u64>,
    ended: bool,
}

struct Row {
    line: u64,
    name: String,
    angle: f64,
    tensor: [f64; 6],
}

impl HistoryReader {
    /// Opens a table.
    ///
    /// # Errors
    /// [`InputError`] where it cannot be read or a column is missing.
    pub fn open(path: &Path) -> Result<Self, InputError> {
        let stream = Stream::open(path, ["point", "crank_deg"], &HISTORY)?;
        Ok(Self { stream, waiting: None, angles: Vec::new(), seen: HashSet::new(), ended: false })
    }

    fn at(&self, line: u64, column: usize, message: String) -> InputError {
        self.stream.at(line, column, message)
    }

    fn row(&mut self) -> Result<Option<Row>, InputError> {
        if let Some(row) = self.waiting.take() {
            return Ok(Some(row));
        }
        let Some((line, record)) = self.stream.next()? else { return Ok(None) };
        let name = self.stream.name(line, &record, 0, "point")?;
        Ok(Some(Row { line, name, angle: self.stream.number(line, &record, 1)?, tensor: self.stream.tensor(line, &record)? }))
    }

    /// The next point; nothing after the last.
    fn point(&mut self) -> Result<Option<PointHistory>, InputError> {
        let Some(first) = self.row()? else {
            return if self.seen.is_empty() {
                Err(self.stream.at_head(0, "found no row, expected the history of a point".into()))
            } else {
                Ok(None)
            };
        };
        let (name, start) = (first.name.clone(), first.line);
        let mut hasher = DefaultHasher::new();
        name.hash(&mut hasher);
        if !self.seen.insert(hasher.finish()) {
            return Err(self.at(start, 0, format!("found point `{}` again after another, expected its rows together", shown(&name))));
        }
        let (mut angles, mut tensors, mut last) = (vec![first.angle], vec![first.tensor], start);
        while let Some(row) = self.row()? {
            if row.name != name {
                self.waiting = Some(row);
                break;
            }
            if angles.len() == MOST_SAMPLES {
                let words = format!("found more than {MOST_SAMPLES} samples of point `{}`, expected at most so many", shown(&name));
                return Err(self.at(row.line, 1, words));
            }
            self.check_angle(&angles, &row)?;
            angles.push(row.angle);
            tensors.push(row.tensor);
            last = row.line;
        }
        self.check_cycle(&name, &angles, &mut tensors, last)?;
        if self.angles.is_empty() {
            self.angles = angles;
        }
        Ok(Some(PointHistory { name, history: History::new(tensors) }))
    }

    /// Angles rise in equal steps, and are those of the first point.
    fn check_angle(&self, angles: &[f64], row: &Row) -> Result<(), InputError> {
        follows(angles, row.angle, self.angles.get(angles.len()).copied()).map_err(|words| self.at(row.line, 1, words))
    }

    /// Samples make up a closed cycle of whole turns; an end that repeats the beginning is left out.
    fn check_cycle(&self, name: &str, angles: &[f64], tensors: &mut Vec<[f64; 6]>, last: u64) -> Result<(), InputError> {
        let n = angles.len();
        if !self.angles.is_empty() && n != self.angles.len() {
            let words = format!("found {n} samples of point `{}`, expected {}, as the first point has", shown(name), self.angles.len());
            return Err(self.at(last, 1, words));
        }
        let again = ends_where_it_began(angles, &format!(" of point `{}`", shown(name)));
        if again.map_err(|words| self.at(last, 1, words))? {
            let largest = tensors.iter().flatten().fold(0.0, |m: f64, v| m.max(v.abs()));
            let off = tensors[0].iter().zip(&tensors[n - 1]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            if off > CLOSED * largest {
                let words =
                    format!("found stress at the end of the cycle {} MPa off its beginning, expected a closed cycle", off / PA_PER_MPA);
                return Err(self.at(last, 2, words));
            }
            tensors.pop();
        }
        if tensors.iter().flatten().all(|v| *v == 0.0) {
            return Err(self.at(last, 2, format!("found no stress at all at point `{}`, expected some", shown(name))));
        }
        Ok(())
    }
}

impl Iterator for HistoryReader {
    type Item = Result<PointHistory, InputError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let point = self.point();
        self.ended = !matches!(point, Ok(Some(_)));
        point.transpose()
    }
}
