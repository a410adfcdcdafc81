//! Published multiaxial safety factors, and the stresses behind them.

use super::Table;
use crate::study::input_error::InputError;
use crate::study::published::{PublishedHistory, PublishedMultiaxial, PublishedPoint, SIX_CRITERIA};
use crate::units::PA_PER_MPA;
use std::path::Path;

/// Columns that name a point.
const POINT: [&str; 4] = ["table", "crank", "speed_rpm", "point"];

/// A point with the cells of some columns.
type Row = (PublishedPoint, Vec<Option<f64>>);

/// Rows of a table with the point of each, and the cells of some further columns.
fn rows(path: &Path, columns: &[&str]) -> Result<Vec<Row>, InputError> {
    let table = Table::read(path)?;
    let named: Vec<usize> = POINT.iter().map(|c| table.column(c)).collect::<Result<_, _>>()?;
    let places: Vec<usize> = columns.iter().map(|c| table.column(c)).collect::<Result<_, _>>()?;
    let mut list: Vec<Row> = Vec::new();
    for (line, cells) in &table.rows {
        let [number, crank, speed, point] = [0, 1, 2, 3].map(|i| cells[named[i]].clone());
        let at = PublishedPoint { table: number, crank, speed, point };
        if list.iter().any(|(known, _)| known.is_same(&at)) {
            return Err(table.at(*line, named[3], "found this crank, speed and point a second time".into()));
        }
        let values = places.iter().map(|c| table.number(*line, *c, &cells[*c])).collect::<Result<_, _>>()?;
        list.push((at, values));
    }
    Ok(list)
}

/// A cell that must be filled.
fn filled(path: &Path, at: &PublishedPoint, column: &str, value: Option<f64>, least: f64) -> Result<f64, InputError> {
    value.filter(|v| *v >= least).ok_or_else(|| {
        let found = value.map_or("nothing".into(), |v| v.to_string());
        super::whole(path, format!("found {found} in column `{column}` of point `{}`, expected a number of at least {least}", at.point))
    })
}

/// `table, crank, speed_rpm, point` and a column for each of the six criteria of \[Minucci 2010\].
///
/// # Errors
/// [`InputError`] with the place.
pub fn multiaxial(path: &Path) -> Result<Vec<PublishedMultiaxial>, InputError> {
    let row = |(at, values): Row| {
        let mut factors = [0.0; 6];
        for ((factor, value), column) in factors.iter_mut().zip(values).zip(SIX_CRITERIA) {
            *factor = filled(path, &at, column, value, 1e-3)?;
        }
        Ok(PublishedMultiaxial { at, factors })
    };
    rows(path, &SIX_CRITERIA)?.into_iter().map(row).collect()
}

/// `table, crank, speed_rpm, point, shear_amplitude_mpa, normal_max_mpa, sqrt_j2_amplitude_mpa, hydrostatic_amplitude_mpa, hydrostatic_mean_mpa`; the first two
/// stresses may be empty.
///
/// # Errors
/// [`InputError`] with the place.
pub fn histories(path: &Path) -> Result<Vec<PublishedHistory>, InputError> {
    const COLUMNS: [&str; 5] =
        ["shear_amplitude_mpa", "normal_max_mpa", "sqrt_j2_amplitude_mpa", "hydrostatic_amplitude_mpa", "hydrostatic_mean_mpa"];
    let row = |(at, v): Row| {
        let needed = |i: usize, least: f64| filled(path, &at, COLUMNS[i], v[i], least).map(|s| s * PA_PER_MPA);
        Ok(PublishedHistory {
            shear_amplitude: v[0].map(|s| s * PA_PER_MPA),
            normal_max: v[1].map(|s| s * PA_PER_MPA),
            sqrt_j2_amplitude: needed(2, 0.0)?,
            hydrostatic_amplitude: needed(3, 0.0)?,
            hydrostatic_mean: needed(4, f64::NEG_INFINITY)?,
            at: at.clone(),
        })
    };
    rows(path, &COLUMNS)?.into_iter().map(row).collect()
}
