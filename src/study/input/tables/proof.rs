//! `proof_<design>.csv`: a proof of an optimum as boxes that exclude all designs.

use super::table::Table;
use crate::input::error::InputError;
use crate::objective::Condition;
use crate::optimise::{ExcludingSpeed, Exclusion};
use std::path::Path;

/// A box of designs, and the speeds that are to exclude it.
#[derive(Debug, Clone, PartialEq)]
pub struct ExcludedBox {
    /// Line of the file.
    pub line: u64,
    /// What is to be excluded, and how.
    pub own: Exclusion,
}

/// A proof as it stands in a file.
#[derive(Debug, Clone, PartialEq)]
pub struct ProofTable {
    /// Name of the optimum.
    pub design: String,
    /// Key of its objective, and the unit of the bound.
    pub objective: [String; 2],
    /// What no design is to be below, in the unit of the objective; `None`: no design is to hold all limits.
    pub bound: Option<f64>,
    /// Keys of the free parameters.
    pub free: Vec<String>,
    /// The boxes.
    pub boxes: Vec<ExcludedBox>,
}

/// Columns of every proof.
#[doc(hidden)]
pub const COLUMNS: [&str; 10] =
    ["design", "objective", "lower_bound", "unit", "box", "condition", "misfire_cylinder", "speed_rpm", "excluded_by", "share"];
/// What excludes a box at a speed: an objective, or a limit.
#[doc(hidden)]
pub const EXCLUDED_BY: [&str; 2] = ["objective", "limit"];
/// Beginnings of the names of columns with ends of ranges.
#[doc(hidden)]
pub const ENDS: [&str; 2] = ["lowest_", "highest_"];

/// Reads [`COLUMNS`], and for each free parameter `lowest_…` and `highest_…`.
///
/// # Errors
/// [`InputError`] with row and column.
#[doc(hidden)]
pub fn proof_table(path: &Path) -> Result<ProofTable, InputError> {
    let table = Table::read(path, &COLUMNS)?;
    let [design, objective, bound, unit, number, condition, cylinder, speed, by, share] = COLUMNS.map(|name| table.column(name));
    let (design, objective, bound, unit, number, condition) = (design?, objective?, bound?, unit?, number?, condition?);
    let (cylinder, speed, by, share) = (cylinder?, speed?, by?, share?);
    let free: Vec<String> = table.header.iter().filter_map(|h| h.strip_prefix(ENDS[0])).map(str::to_owned).collect();
    let pair = |key: &String| Ok((table.column(&format!("{}{key}", ENDS[0]))?, table.column(&format!("{}{key}", ENDS[1]))?));
    let columns = free.iter().map(pair).collect::<Result<Vec<_>, InputError>>()?;
    let Some((first, cells)) = table.rows.first() else {
        return Err(table.whole("found no box, expected a row for each of its speeds".into()));
    };
    let claim = |row: u64, cells: &[String]| table.number(row, bound, &cells[bound]);
    let words = |column: usize| table.words(*first, column, &cells[column]);
    let found = ProofTable {
        design: words(design)?,
        objective: [words(objective)?, words(unit)?],
        bound: claim(*first, cells)?,
        free,
        boxes: Vec::new(),
    };
    let row = |line: u64, cells: &[String]| -> Result<(Vec<(f64, f64)>, ExcludingSpeed), InputError> {
        let [of, its] = &found.objective;
        let differs = [
            (design, cells[design] != found.design),
            (objective, cells[objective] != *of),
            (unit, cells[unit] != *its),
            (bound, claim(line, cells)? != found.bound),
        ];
        if let Some((column, _)) = differs.into_iter().find(|d| d.1) {
            return Err(table.at(line, column, format!("found `{}`, expected that of the first row", cells[column])));
        }
        let range = |(low, high): &(usize, usize)| {
            let ends = (table.filled(line, *low, &cells[*low])?, table.filled(line, *high, &cells[*high])?);
            if ends.0 > ends.1 {
                return Err(table.at(line, *high, format!("found {}, expected no less than the lowest, {}", ends.1, ends.0)));
            }
            Ok(ends)
        };
        let wrong = |column: usize, expected: &str| table.at(line, column, format!("found `{}`, expected {expected}", cells[column]));
        let named = Condition::NAMED.into_iter().find(|c| c.name() == cells[condition]);
        let misfires = match table.number(line, cylinder, &cells[cylinder])? {
            None => None,
            Some(n) if n >= 1.0 && n.fract() == 0.0 => Some(n as usize - 1),
            Some(_) => return Err(wrong(cylinder, "the number of a cylinder")),
        };
        let by_limit = EXCLUDED_BY.iter().position(|word| *word == cells[by]);
        let by_limit = by_limit.ok_or_else(|| wrong(by, &format!("`{}` or `{}`", EXCLUDED_BY[0], EXCLUDED_BY[1])))? == 1;
        let speed = ExcludingSpeed {
            condition: named.ok_or_else(|| wrong(condition, "a condition, as `firing`"))?,
            cylinder: misfires,
            speed_rpm: table.filled(line, speed, &cells[speed])?,
            by_limit,
            share: table.filled(line, share, &cells[share])?,
        };
        Ok((columns.iter().map(range).collect::<Result<_, InputError>>()?, speed))
    };
    let (mut boxes, mut last): (Vec<ExcludedBox>, Option<&str>) = (Vec::new(), None);
    for (line, cells) in &table.rows {
        let (ranges, speed) = row(*line, cells)?;
        match boxes.last_mut() {
            Some(b) if last == Some(&cells[number]) => {
                if b.own.ranges != ranges {
                    return Err(table.at(
                        *line,
                        number,
                        format!("found other ranges than in the row before it, which is of box `{}`, too", cells[number]),
                    ));
                }
                b.own.speeds.push(speed);
            }
            _ => boxes.push(ExcludedBox { line: *line, own: Exclusion { ranges, speeds: vec![speed] } }),
        }
        last = Some(&cells[number]);
    }
    Ok(ProofTable { boxes, ..found })
}
