//! A mass-elastic table: a row a station, from the free end, with units in its header.

use super::sheet::Sheet;
use super::unit::{folded, parts};
use super::words::{Role, is_damping, is_ratio, is_stiffness_to_ground, is_sum, is_to_previous, loss_factors, units};
use super::{FoundChain, FoundStation};
use crate::input::error::InputError;
use crate::input::letters::fault;
use std::path::Path;

/// A column with its meaning and the factor to SI.
type Column = (Role, usize, f64);

/// Largest and smallest value that is taken, in SI; a longer name is none.
const RANGE: std::ops::RangeInclusive<f64> = 1e-20..=1e20;
const LONGEST_NAME: usize = 100;

/// How many roles the heads of a row have.
fn knows(cells: &[&str]) -> usize {
    let mut found: Vec<Role> = Vec::new();
    for (words, unit) in cells.iter().map(|cell| parts(cell)) {
        found.extend(Role::of(&words, unit.as_deref()).filter(|role| !found.contains(role)));
    }
    found.len()
}

/// Reads it.
///
/// # Errors
/// [`InputError`] at the cell that is not understood.
pub(super) fn read(path: &Path) -> Result<FoundChain, InputError> {
    let mut sheet = Sheet::read(path, &knows)?;
    let (columns, left_out) = columns(&sheet)?;
    let numbers: Vec<usize> = columns.iter().filter(|c| c.0 != Role::Name).map(|c| c.1).collect();
    sheet.reads(&numbers);
    let stations = sheet.rows().iter().map(|(row, cells)| station(&sheet, &columns, *row, cells)).collect::<Result<Vec<_>, _>>()?;
    check_line(&sheet, &columns, &stations)?;
    Ok(FoundChain { stations, left_out })
}

/// Names differ, and every station but the last has a stiffness to the next.
fn check_line(sheet: &Sheet, columns: &[Column], stations: &[FoundStation]) -> Result<(), InputError> {
    let column = |role: Role| columns.iter().find(|c| c.0 == role).map_or(0, |c| c.1);
    for (i, s) in stations.iter().enumerate() {
        let fault_at = |role: Role, message: String| Err(sheet.at(sheet.rows()[i].0, column(role), message));
        let is_last = i + 1 == stations.len();
        if stations[..i].iter().any(|other| other.name == s.name) {
            return fault_at(Role::Name, format!("found station `{}` a second time, expected different names", s.name));
        }
        if !is_last && s.stiffness_to_next <= 0.0 {
            let message = format!("found no stiffness from `{}` to the next station, expected one for all but the last", s.name);
            return fault_at(Role::Stiffness, message);
        }
        if is_last && s.stiffness_to_next > 0.0 {
            return fault_at(Role::Stiffness, format!("found a stiffness behind the last station `{}`, expected none", s.name));
        }
    }
    Ok(())
}

/// What the columns hold, and those that are left out.
fn columns(sheet: &Sheet) -> Result<(Vec<Column>, Vec<String>), InputError> {
    let (mut columns, mut left_out): (Vec<Column>, Vec<String>) = (Vec::new(), Vec::new());
    let role_of = |head: &str| {
        let (words, unit) = parts(head);
        Role::of(&words, unit.as_deref())
    };
    // beside a column of words, one of numbers tells rows apart and names nothing
    let numbers = |i: usize| sheet.rows().iter().all(|(_, cells)| cells[i].parse::<f64>().is_ok());
    let is_name = |i: &usize| role_of(&sheet.heads()[*i]) == Some(Role::Name);
    let named = (0..sheet.heads().len()).filter(is_name).find(|i| !numbers(*i));
    for (i, head) in sheet.heads().iter().enumerate().filter(|h| !h.1.is_empty()) {
        let (words, unit) = parts(head);
        let Some(role) = role_of(head) else {
            let hint = match () {
                () if is_damping(&words, unit.as_deref()) => {
                    ", which does not say whether it is to the next station or to ground, as `Damping to next [N m s/rad]` (Relative Dämpfung) and `Damping to ground [N m s/rad]` (Absolute Dämpfung) do"
                }
                () if is_stiffness_to_ground(&words) => {
                    ", a stiffness to ground, which has to be put in by `stiffness_to_ground_n_m_per_rad`"
                }
                () if is_ratio(&words) => ": all is read as of one speed, and a gear has to be put in by `gear_ratio_to_next`",
                () => "",
            };
            left_out.push(format!("column `{head}`{hint}"));
            continue;
        };
        if matches!(role, Role::Stiffness | Role::DampingToNext) && is_to_previous(&words) {
            let message = format!("found `{head}`, expected what lies between a station and the next one, such as `{}`", role.example());
            return Err(sheet.at_head_with_help(i, message, "move the column up by one row, so that the last station has none".into()));
        }
        match columns.iter().any(|c| c.0 == role) || role == Role::Name && named.is_some_and(|own| own != i) {
            // a number of the row beside its name
            true if role == Role::Name => left_out.push(format!("column `{head}`")),
            true => return Err(sheet.at_head(i, format!("found a second column like `{}`, expected one", role.example()))),
            false => {
                let factor = match loss_factors(&words, unit.as_deref()).filter(|_| role == Role::LossFactorToNext) {
                    Some((factor, is_psi)) => {
                        if is_psi {
                            sheet.remark(&format!("column `{head}` is read as the relative damping ψ, 2π times the loss factor"));
                        }
                        factor
                    }
                    None => sheet.factor(i, (units(role), role.example()), unit.as_deref())?,
                };
                columns.push((role, i, factor));
            }
        }
    }
    for role in [Role::Name, Role::Inertia, Role::Stiffness] {
        if columns.iter().all(|c| c.0 != role) {
            return Err(sheet.lacks(role.example()));
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
            Some(x) if x > 0.0 && !RANGE.contains(&(x * factor)) => {
                Err(sheet.at(row, *column, format!("found `{cell}`, expected a value from 1e-20 to 1e20 in SI")))
            }
            found => Ok(found.unwrap_or(0.0) * factor),
        };
        match role {
            Role::Name => match fault(cell) {
                Some(fault) => return Err(sheet.at(row, *column, format!("found {fault}"))),
                None => station.name.clone_from(cell),
            },
            Role::Inertia => station.inertia = value()?,
            Role::Stiffness => station.stiffness_to_next = value()?,
            Role::DampingToNext => station.damping_to_next = value()?,
            Role::LossFactorToNext => station.loss_factor_to_next = value()?,
            Role::DampingToGround => station.damping_to_ground = value()?,
            Role::Throws => {
                let throws = cell.split([' ', '+']).filter(|w| !w.is_empty() && *w != "-").map(str::parse::<usize>);
                let wrong = |_| sheet.at(row, *column, format!("found `{cell}`, expected numbers of throws with spaces between"));
                station.throws = throws.collect::<Result<_, _>>().map_err(wrong)?;
            }
        }
        if *role == Role::Name && cell.is_empty() {
            let message = match cells.iter().find(|c| is_sum(&folded(c))) {
                Some(sum) => format!("found `{sum}`, expected a station, not a row of sums"),
                None => "found no name, expected that of the station".into(),
            };
            return Err(sheet.at(row, *column, message));
        }
        if *role == Role::Name && (cell.chars().any(char::is_control) || cell.chars().count() > LONGEST_NAME) {
            let words = "found a name with control characters or more than 100 letters, expected one that can be printed";
            return Err(sheet.at(row, *column, words.into()));
        }
        if *role == Role::Name && is_sum(&folded(cell)) {
            return Err(sheet.at(row, *column, format!("found `{cell}`, expected a station, not a row of sums")));
        }
        if *role == Role::Inertia && station.inertia <= 0.0 {
            let message = match cell.as_str() {
                "" => "found no inertia, expected one above zero: a row is a station, the shaft behind it has no row of its own, and a comment begins with `#`".into(),
                cell => format!("found `{cell}`, expected an inertia above zero"),
            };
            return Err(sheet.at(row, *column, message));
        }
    }
    Ok(station)
}
