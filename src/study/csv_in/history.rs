//! Stress histories, point by point, so that memory does not grow with their number.

use super::shown;
use crate::fatigue::multiaxial::History;
use crate::study::input_error::{InputError, Mistake, Place};
use crate::units::{DEG_PER_REV, PA_PER_MPA};
use std::collections::HashSet;
use std::fs::File;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

/// Columns of a history, in this order or another.
const COLUMNS: [&str; 8] = ["point", "crank_deg", "sxx_mpa", "syy_mpa", "szz_mpa", "sxy_mpa", "syz_mpa", "szx_mpa"];
/// Angles are as equal as this, degrees.
const EQUAL_DEG: f64 = 1e-6;
/// The end of a cycle is its beginning again to this share of the largest stress.
const CLOSED: f64 = 1e-6;
/// Fewer samples are no cycle.
const FEWEST: usize = 3;

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
    path: PathBuf,
    rows: csv::StringRecordsIntoIter<File>,
    /// Cell of each of [`COLUMNS`].
    places: [usize; 8],
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
        let whole = |message: String| InputError::from(Mistake { message, place: Place::File(path.to_path_buf()), help: None });
        if !path.is_file() {
            return Err(whole(if path.exists() { "found no file there, expected a table".into() } else { "file not found".into() }));
        }
        let file = File::open(path).map_err(|e| whole(format!("cannot be read: {e}")))?;
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).flexible(true).comment(Some(b'#')).from_reader(file);
        let header = reader.headers().map_err(|e| whole(format!("the header could not be read: {e}")))?.clone();
        let mut places = [0; 8];
        for (place, name) in places.iter_mut().zip(COLUMNS) {
            let found: Vec<usize> = (0..header.len()).filter(|i| header[*i].trim_start_matches('\u{feff}') == name).collect();
            let wrong = match found.as_slice() {
                [one] => {
                    *place = *one;
                    continue;
                }
                [] => format!("found no column `{name}`, expected {}", COLUMNS.join(", ")),
                _ => format!("found column `{name}` a second time"),
            };
            let place = Place::Cell { path: path.to_path_buf(), row: 1, column: name.to_owned() };
            return Err(Mistake { message: wrong, place, help: None }.into());
        }
        let rows = reader.into_records();
        let path = path.to_path_buf();
        Ok(Self { path, rows, places, waiting: None, angles: Vec::new(), seen: HashSet::new(), ended: false })
    }

    fn at(&self, line: u64, column: usize, message: String) -> InputError {
        Mistake { message, place: Place::Cell { path: self.path.clone(), row: line, column: COLUMNS[column].to_owned() }, help: None }
            .into()
    }

    fn row(&mut self) -> Result<Option<Row>, InputError> {
        if let Some(row) = self.waiting.take() {
            return Ok(Some(row));
        }
        let Some(record) = self.rows.next() else { return Ok(None) };
        let record = record.map_err(|e| {
            let line = e.position().map_or(0, csv::Position::line);
            self.at(line, 0, format!("the table could not be read: {e}"))
        })?;
        let line = record.position().map_or(0, csv::Position::line);
        let cell = |c: usize| record.get(self.places[c]).unwrap_or("");
        let number = |c: usize| match cell(c).parse::<f64>() {
            Ok(x) if x.abs() <= 1e20 => Ok(x),
            _ => Err(self.at(line, c, format!("found `{}`, expected a number up to 1e20", shown(cell(c))))),
        };
        let name = cell(0).to_owned();
        if name.is_empty() {
            return Err(self.at(line, 0, "found an empty cell, expected the name of a point".into()));
        }
        let mut tensor = [0.0; 6];
        for (i, t) in tensor.iter_mut().enumerate() {
            *t = number(i + 2)? * PA_PER_MPA;
        }
        Ok(Some(Row { line, name, angle: number(1)?, tensor }))
    }

    /// The next point; nothing after the last.
    fn point(&mut self) -> Result<Option<PointHistory>, InputError> {
        let Some(first) = self.row()? else {
            return if self.seen.is_empty() {
                Err(self.at(1, 0, "found no row, expected the history of a point".into()))
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
        let before = angles[angles.len() - 1];
        let expected = match (self.angles.get(angles.len()), angles) {
            (Some(known), _) => *known,
            (None, [first, second, ..]) => before + (second - first),
            (None, _) if row.angle > before => return Ok(()),
            (None, _) => return Err(self.at(row.line, 1, format!("found {} after {before}, expected a larger angle", row.angle))),
        };
        if (row.angle - expected).abs() > EQUAL_DEG * expected.abs().max(1.0) {
            return Err(self.at(
                row.line,
                1,
                format!("found {} after {before}, expected {expected}: equal steps, the same for all points", row.angle),
            ));
        }
        Ok(())
    }

    /// Samples make up a closed cycle of whole turns; an end that repeats the beginning is left out.
    fn check_cycle(&self, name: &str, angles: &[f64], tensors: &mut Vec<[f64; 6]>, last: u64) -> Result<(), InputError> {
        let n = angles.len();
        if n < FEWEST {
            return Err(self.at(last, 1, format!("found {n} samples of point `{}`, expected at least {FEWEST}", shown(name))));
        }
        if !self.angles.is_empty() && n != self.angles.len() {
            let words = format!("found {n} samples of point `{}`, expected {}, as the first point has", shown(name), self.angles.len());
            return Err(self.at(last, 1, words));
        }
        let step = angles[1] - angles[0];
        let turns = |length: f64| {
            let turns = length / DEG_PER_REV;
            turns.round() >= 1.0 && (turns - turns.round()).abs() < EQUAL_DEG
        };
        if turns(angles[n - 1] - angles[0]) {
            let largest = tensors.iter().flatten().fold(0.0, |m: f64, v| m.max(v.abs()));
            let off = tensors[0].iter().zip(&tensors[n - 1]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            if off > CLOSED * largest {
                let words =
                    format!("found stress at the end of the cycle {} MPa off its beginning, expected a closed cycle", off / PA_PER_MPA);
                return Err(self.at(last, 2, words));
            }
            tensors.pop();
        } else if !turns(angles[n - 1] - angles[0] + step) {
            let words = format!("found angles from {} to {} in steps of {step}, expected whole turns", angles[0], angles[n - 1]);
            return Err(self.at(last, 1, words));
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
