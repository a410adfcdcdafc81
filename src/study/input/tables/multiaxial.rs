//! Published multiaxial safety factors, and the stresses behind them.

use super::table::Table;
use crate::input::error::InputError;
use crate::input::published::{PublishedHistory, PublishedMultiaxial, PublishedPlanes, PublishedPoint, SIX_CRITERIA};
use crate::units::{PA_PER_MPA, RAD_PER_DEG};
use std::path::Path;

/// Columns that name a point.
const POINT: [&str; 4] = ["table", "crank", "speed_rpm", "point"];

/// A row: its line, its point, and the cells of the further columns with their places.
struct Row<'a> {
    table: &'a Table,
    line: u64,
    at: PublishedPoint,
    cells: Vec<(usize, &'a str)>,
}

impl Row<'_> {
    /// A cell that may be empty.
    fn optional(&self, i: usize) -> Result<Option<f64>, InputError> {
        self.table.number(self.line, self.cells[i].0, self.cells[i].1)
    }

    /// A cell with a number.
    fn number(&self, i: usize) -> Result<f64, InputError> {
        self.table.filled(self.line, self.cells[i].0, self.cells[i].1)
    }

    /// A cell with a number above zero.
    fn positive(&self, i: usize) -> Result<f64, InputError> {
        let x = self.number(i)?;
        if x > 0.0 {
            return Ok(x);
        }
        Err(self.table.at(self.line, self.cells[i].0, format!("found {x}, expected a number above zero")))
    }
}

fn rows<T>(path: &Path, columns: &[&str], read: impl Fn(Row) -> Result<T, InputError>) -> Result<Vec<T>, InputError> {
    let table = Table::read(path, &[&POINT, columns].concat())?;
    let named: Vec<usize> = POINT.iter().map(|c| table.column(c)).collect::<Result<_, _>>()?;
    let places: Vec<usize> = columns.iter().map(|c| table.column(c)).collect::<Result<_, _>>()?;
    if table.rows.is_empty() {
        return Err(table.whole("found no row, expected at least one".into()));
    }
    let (mut list, mut points): (Vec<T>, Vec<PublishedPoint>) = (Vec::new(), Vec::new());
    for (line, cells) in &table.rows {
        let words = |i: usize| table.words(*line, named[i], &cells[named[i]]);
        let at = PublishedPoint { table: words(0)?, crank: words(1)?, speed: words(2)?, point: words(3)? };
        if points.iter().any(|known| known.is_same(&at)) {
            return Err(table.at(*line, named[3], "found this crank, speed and point a second time".into()));
        }
        points.push(at.clone());
        let cells = places.iter().map(|c| (*c, cells[*c].as_str())).collect();
        list.push(read(Row { table: &table, line: *line, at, cells })?);
    }
    Ok(list)
}

/// `table, crank, speed_rpm, point` and a column for each of the six criteria of \[Minucci 2010\].
///
/// # Errors
/// [`InputError`] with row and column.
pub fn multiaxial(path: &Path) -> Result<Vec<PublishedMultiaxial>, InputError> {
    rows(path, &SIX_CRITERIA, |row| {
        let mut factors = [0.0; 6];
        for (i, factor) in factors.iter_mut().enumerate() {
            *factor = row.positive(i)?;
        }
        Ok(PublishedMultiaxial { at: row.at, factors })
    })
}

/// `table, crank, speed_rpm, point, shear_amplitude_mpa, normal_max_mpa, sqrt_j2_amplitude_mpa, hydrostatic_amplitude_mpa, hydrostatic_mean_mpa`; the first two
/// stresses may be empty.
///
/// # Errors
/// [`InputError`] with row and column.
pub fn histories(path: &Path) -> Result<Vec<PublishedHistory>, InputError> {
    let columns = ["shear_amplitude_mpa", "normal_max_mpa", "sqrt_j2_amplitude_mpa", "hydrostatic_amplitude_mpa", "hydrostatic_mean_mpa"];
    rows(path, &columns, |row| {
        Ok(PublishedHistory {
            shear_amplitude: row.optional(0)?.map(|s| s * PA_PER_MPA),
            normal_max: row.optional(1)?.map(|s| s * PA_PER_MPA),
            sqrt_j2_amplitude: row.positive(2)? * PA_PER_MPA,
            hydrostatic_amplitude: row.positive(3)? * PA_PER_MPA,
            hydrostatic_mean: row.number(4)? * PA_PER_MPA,
            at: row.at,
        })
    })
}

/// `table, crank, speed_rpm, point, shear_theta_deg, shear_phi_deg, dang_van_theta_deg, dang_van_phi_deg`.
///
/// # Errors
/// [`InputError`] with row and column.
pub fn planes(path: &Path) -> Result<Vec<PublishedPlanes>, InputError> {
    rows(path, &["shear_theta_deg", "shear_phi_deg", "dang_van_theta_deg", "dang_van_phi_deg"], |row| {
        let angle = |i: usize| Ok::<f64, InputError>(row.number(i)? * RAD_PER_DEG);
        let (shear, dang_van) = ([angle(0)?, angle(1)?], [angle(2)?, angle(3)?]);
        Ok(PublishedPlanes { at: row.at, shear, dang_van })
    })
}
