//! `proof_<design>.csv`: a proof of an optimum as boxes that exclude all designs.

use super::table::Table;
use crate::input::error::InputError;
use crate::objective::Condition;
use std::path::Path;

/// A box of designs, and the speed that is to exclude it.
#[derive(Debug, Clone, PartialEq)]
pub struct ExcludedBox {
    /// Line of the file.
    pub line: u64,
    /// Lowest and highest value of each free parameter.
    pub ranges: Vec<(f64, f64)>,
    /// Condition of the engine.
    pub condition: Condition,
    /// The cylinder (from 0) that misfires.
    pub cylinder: Option<usize>,
    /// rpm.
    pub speed_rpm: f64,
}

/// A proof as it stands in a file.
#[derive(Debug, Clone, PartialEq)]
pub struct ProofTable {
    /// Name of the optimum.
    pub design: String,
    /// What no design is to be below, in the unit of the objective; `None`: no design is to hold all limits.
    pub bound: Option<f64>,
    /// Keys of the free parameters.
    pub free: Vec<String>,
    /// The boxes.
    pub boxes: Vec<ExcludedBox>,
}

/// Beginnings of the names of columns with ends of ranges.
pub const ENDS: [&str; 2] = ["lowest_", "highest_"];

/// Reads `design, lower_bound, condition, misfire_cylinder, speed_rpm`, and for each free parameter `lowest_…` and `highest_…`.
///
/// # Errors
/// [`InputError`] with row and column.
pub fn proof_table(path: &Path) -> Result<ProofTable, InputError> {
    let table = Table::read(path, &["design", "speed_rpm", "condition"])?;
    let [design, bound, condition, cylinder, speed] =
        ["design", "lower_bound", "condition", "misfire_cylinder", "speed_rpm"].map(|name| table.column(name));
    let (design, bound, condition, cylinder, speed) = (design?, bound?, condition?, cylinder?, speed?);
    let free: Vec<String> = table.header.iter().filter_map(|h| h.strip_prefix(ENDS[0])).map(str::to_owned).collect();
    let pair = |key: &String| Ok((table.column(&format!("{}{key}", ENDS[0]))?, table.column(&format!("{}{key}", ENDS[1]))?));
    let columns = free.iter().map(pair).collect::<Result<Vec<_>, InputError>>()?;
    let Some((first, cells)) = table.rows.first() else { return Err(table.whole("found no box, expected one row each".into())) };
    let claim = |row: u64, cells: &[String]| table.number(row, bound, &cells[bound]);
    let found = ProofTable { design: table.words(*first, design, &cells[design])?, bound: claim(*first, cells)?, free, boxes: Vec::new() };
    let known = |word: &str| Condition::NAMED.into_iter().find(|c| c.name() == word);
    let row = |(line, cells): &(u64, Vec<String>)| {
        for (column, differs) in [(design, cells[design] != found.design), (bound, claim(*line, cells)? != found.bound)] {
            if differs {
                return Err(table.at(*line, column, format!("found `{}`, expected that of the first row", cells[column])));
            }
        }
        let Some(condition) = known(&cells[condition]) else {
            return Err(table.at(*line, condition, format!("found `{}`, expected a condition, as `firing`", cells[condition])));
        };
        let range =
            |(low, high): &(usize, usize)| Ok((table.filled(*line, *low, &cells[*low])?, table.filled(*line, *high, &cells[*high])?));
        let misfires = match table.number(*line, cylinder, &cells[cylinder])? {
            None => None,
            Some(n) if n >= 1.0 && n.fract() == 0.0 => Some(n as usize - 1),
            Some(_) => return Err(table.at(*line, cylinder, format!("found `{}`, expected the number of a cylinder", cells[cylinder]))),
        };
        Ok(ExcludedBox {
            line: *line,
            ranges: columns.iter().map(range).collect::<Result<_, InputError>>()?,
            condition,
            cylinder: misfires,
            speed_rpm: table.filled(*line, speed, &cells[speed])?,
        })
    };
    let boxes = table.rows.iter().map(row).collect::<Result<_, InputError>>()?;
    Ok(ProofTable { boxes, ..found })
}
