//! Tables as other programs save them, with words and units in their heads.

use super::unit::{SURROUNDINGS, Units, known, parts, plain, prefix_of_another, scale};
use crate::input::error::InputError;
use crate::input::tables::Table;
use std::path::Path;

/// Heads and cells.
pub(super) struct Sheet {
    table: Table,
}

impl Sheet {
    /// Reads one; `knows` tells how many of the heads of a row mean something.
    ///
    /// # Errors
    /// [`InputError`] where it is no table.
    pub(super) fn read(path: &Path, knows: &dyn Fn(&[&str]) -> usize) -> Result<Self, InputError> {
        // one head that means something may be a title or a name
        let score = |cells: &[&str]| Some(knows(cells)).filter(|known| *known > 1).unwrap_or(0);
        Ok(Self { table: Table::of(path, &score)? })
    }

    /// Says which columns are read: the others say nothing of how numbers are written.
    pub(super) fn reads(&mut self, columns: &[usize]) {
        self.table.learn_from(columns);
        self.table.tell_convention();
    }

    /// Heads of the columns.
    pub(super) fn heads(&self) -> &[String] {
        &self.table.header
    }

    /// Line in the file and cells, as many as heads.
    pub(super) fn rows(&self) -> &[(u64, Vec<String>)] {
        &self.table.rows
    }

    /// A mistake in a cell.
    pub(super) fn at(&self, row: u64, column: usize, message: String) -> InputError {
        self.table.at(row, column, message)
    }

    /// A mistake in a head.
    pub(super) fn at_head(&self, column: usize, message: String) -> InputError {
        self.table.at_head(column, message)
    }

    /// The same with help.
    pub(super) fn at_head_with_help(&self, column: usize, message: String, help: String) -> InputError {
        self.table.at_head_with_help(column, message, help)
    }

    /// What is to be said of it.
    pub(super) fn remark(&self, words: &str) {
        self.table.remark(words);
    }

    /// A mistake of the file.
    pub(super) fn whole(&self, message: String) -> InputError {
        self.table.whole(message)
    }

    /// The factor of a column, from the unit in its head.
    ///
    /// # Errors
    /// [`InputError`] at the head where it names no unit or another one.
    pub(super) fn factor(&self, column: usize, (units, example): (Units, &str), unit: Option<&str>) -> Result<f64, InputError> {
        if units.is_empty() {
            return Ok(1.0);
        }
        if let Some(scale) = self.heads().get(column).and_then(|head| scale(&parts(head).0).map(str::to_owned)) {
            return Err(self.at_head(
                column,
                format!("found `{scale}` beside the unit, expected the numbers themselves in a unit such as in `{example}`"),
            ));
        }
        let Some(unit) = unit else {
            return Err(self.at_head(column, format!("found no unit, expected one in the header, such as `{example}`")));
        };
        if let Some(factor) = known(units, unit) {
            return Ok(factor);
        }
        let all = units.iter().map(|u| u.0).collect::<Vec<_>>().join(", ");
        let message = format!("found the unit `{unit}`, expected one of {all}");
        let gauge = ["barg", "psig", "baru", "barue"].contains(&plain(unit).as_str());
        Err(match prefix_of_another(unit) {
            Some((found, other)) => {
                let help =
                    format!("did you mean `{}`? `{found}` is another power of ten than `{other}`", unit.trim().replacen(found, other, 1));
                self.at_head_with_help(column, message, help)
            }
            None if gauge => self.at_head_with_help(column, message, SURROUNDINGS.into()),
            None => self.at_head(column, message),
        })
    }

    /// The mistake that a column is missing.
    pub(super) fn lacks(&self, example: &str) -> InputError {
        if self.heads().is_empty() {
            return self.whole(format!("found an empty table, expected a column like `{example}` among others"));
        }
        self.at_head(0, format!("found columns {}, expected one like `{example}` among them", self.table.all_columns()))
    }

    /// A number; nothing where the cell is empty or a dash.
    ///
    /// # Errors
    /// [`InputError`] at the cell.
    pub(super) fn number(&self, row: u64, column: usize, cell: &str) -> Result<Option<f64>, InputError> {
        if ["-", "–", "—"].contains(&cell) {
            return Ok(None);
        }
        self.table.number(row, column, cell)
    }
}
