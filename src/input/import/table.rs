//! A mass-elastic table: a row a station, from the free end, with units in its header.

use super::sheet::Sheet;
use super::unit::{Role, factor, parts};
use super::{FoundChain, FoundStation};
use crate::input::error::InputError;
use std::path::Path;

/// A column with its meaning and the factor to SI.
type Column = (Role, usize, f64);

/// Reads it.
///
/// # Errors
/// [`InputError`] at the cell that is not understood.
pub(super) fn read(path: &Path) -> Result<FoundChain, InputError> {
    let sheet = Sheet::read(path)?;
    let (columns, left_out) = columns(&sheet)?;
    let stations = sheet.rows.iter().map(|(row, cells)| station(&sheet, &columns, *row, cells)).collect::<Result<_, _>>()?;
    Ok(FoundChain { stations, left_out })
}

/// What the columns hold, and those that are left out.
fn columns(sheet: &Sheet) -> Result<(Vec<Column>, Vec<String>), InputError> {
    let (mut columns, mut left_out): (Vec<Column>, Vec<String>) = (Vec::new(), Vec::new());
    for (i, head) in sheet.heads.iter().enumerate().filter(|h| !h.1.is_empty()) {
        let (words, unit) = parts(head);
        let Some(role) = Role::of(&words) else {
            let hint = if words.contains("damp") { ", which does not say whether it is to the next station or to ground" } else { "" };
            left_out.push(format!("column `{head}`{hint}"));
            continue;
        };
        match columns.iter().any(|c| c.0 == role) {
            // a number of the row beside its name
            true if role == Role::Name => left_out.push(format!("column `{head}`")),
            true => return Err(sheet.at(1, i, format!("found a second column like `{}`, expected one", role.example()))),
            false => columns.push((role, i, factor(sheet, i, (role.units(), role.example()), unit)?)),
        }
    }
    for role in [Role::Name, Role::Inertia, Role::Stiffness] {
        if columns.iter().all(|c| c.0 != role) {
            let message = format!("found columns {}, expected one like `{}` among them", sheet.all_heads(), role.example());
            return Err(sheet.at(1, 0, message));
        }
    }
    Ok((columns, left_out))
}

fn station(sheet: &Sheet, columns: &[Column], row: u64, cells: &[String]) -> Result<FoundStation, InputError> {
    let mut station = FoundStation::default();
    for (role, column, factor) in columns {
        let cell = &cells[*column];
        let value = || match sheet.number(row, *column, cell)? {
            Some(x) if x < 0.0 => Err(sheet.at(row, *column, format!("found {x}, expected at least zero"))),
            found => Ok(found.unwrap_or(0.0) * factor),
        };
        match role {
            Role::Name => station.name.clone_from(cell),
            Role::Inertia => station.inertia = value()?,
            Role::Stiffness => station.stiffness_to_next = value()?,
            Role::DampingToNext => station.damping_to_next = value()?,
            Role::DampingToGround => station.damping_to_ground = value()?,
            Role::Throws => {
                let throws = cell.split([' ', '+']).filter(|w| !w.is_empty() && *w != "-").map(str::parse::<usize>);
                let wrong = |_| sheet.at(row, *column, format!("found `{cell}`, expected numbers of throws with spaces between"));
                station.throws = throws.collect::<Result<_, _>>().map_err(wrong)?;
            }
        }
        if *role == Role::Name && cell.is_empty() {
            return Err(sheet.at(row, *column, "found no name, expected that of the station".into()));
        }
        if *role == Role::Inertia && station.inertia <= 0.0 {
            return Err(sheet.at(row, *column, format!("found `{cell}`, expected an inertia above zero")));
        }
    }
    Ok(station)
}
