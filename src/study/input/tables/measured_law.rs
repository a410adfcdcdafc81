//! Measured stiffness of an absorber.

use super::named::MEASURED;
use super::shown::shown;
use super::table::Table;
use crate::absorber::measured::MeasuredTable;
use crate::absorber::parameter::STIFFNESS;
use crate::input::error::InputError;
use crate::input::files::remark;
use crate::input::import::unit::{STRESS, known, parts};
use crate::numerics::elementary::Elementary;
use crate::units::{HZ_PER_RAD_PER_S, RAD_PER_DEG};
use std::path::Path;

/// Smaller numbers are none of a measurement.
const LEAST: f64 = 1e-20;
/// Stiffnesses of one table lie within this factor: from its rubbery to its glassy state a polymer has 1e3 to 1e4.
const MOST_APART: f64 = 1e6;

/// In the place of the real part.
const MAGNITUDE: &str = "stiffness_magnitude_n_m_per_rad";

/// How a table states what is lost.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Loss {
    Factor,
    Angle,
    Damping,
}

impl Loss {
    const ALL: [Self; 3] = [Self::Factor, Self::Angle, Self::Damping];

    fn column(self) -> &'static str {
        match self {
            Self::Factor => "loss_factor",
            Self::Angle => "loss_angle_deg",
            Self::Damping => "damping_n_m_s_per_rad",
        }
    }

    /// Real and imaginary part of a stiffness by one of its parts or its magnitude, with this loss at a frequency (Hz); `None` where no stiffness has so much.
    fn parts(self, value: f64, (stiffness, is_magnitude): (f64, bool), hz: f64) -> Option<(f64, f64)> {
        let tangent = match self {
            Self::Factor => value,
            Self::Angle => {
                let (sine, cosine) = (value * RAD_PER_DEG).sine_cosine();
                if value < 90.0 { sine / cosine } else { return None }
            }
            Self::Damping => {
                let lost = value * hz / HZ_PER_RAD_PER_S;
                let real = if is_magnitude { ((stiffness - lost) * (stiffness + lost)).sqrt() } else { stiffness };
                return (real > 0.0).then_some((real, lost));
            }
        };
        let real = if is_magnitude { stiffness / tangent.hypotenuse(1.0) } else { stiffness };
        Some((real, real * tangent))
    }
}

/// A column of a modulus where a stiffness is missing, as makers of rubber measure it; `None` where there is none.
fn modulus(table: &Table) -> Option<InputError> {
    let is_modulus = |head: &String| {
        let (words, unit) = parts(head);
        words.contains("modul") || unit.is_some_and(|u| known(STRESS, &u).is_some())
    };
    let column = table.header.iter().position(is_modulus)?;
    let found = format!("found column `{}`, expected the stiffness of an element, `{}`", shown(&table.header[column]), STIFFNESS.key);
    let help = "a shear modulus is multiplied by the shape of what is sheared: by 4 pi L/(1/r_i² - 1/r_o²) of a sleeve of length L between two radii in m";
    Some(table.at_head_with_help(column, found, help.into()))
}

/// `frequency_hz, stiffness_n_m_per_rad` (its real part) or `stiffness_magnitude_n_m_per_rad`, and one of `loss_factor`, `loss_angle_deg` (whose tangent that is) and `damping_n_m_s_per_rad`, with `temperature_c` where it was measured at several: every temperature at every frequency.
///
/// # Errors
/// [`InputError`] with file, row and column.
#[doc(hidden)]
pub fn measured_law(path: &Path) -> Result<MeasuredTable, InputError> {
    let columns = ["frequency_hz", STIFFNESS.key, MAGNITUDE, "loss_factor", "loss_angle_deg", "damping_n_m_s_per_rad", "temperature_c"];
    let table = Table::read_named(path, &columns, &MEASURED)?.without_empty_columns(&columns);
    let frequency = table.column("frequency_hz")?;
    let magnitude = table.optional(MAGNITUDE).filter(|_| table.optional(STIFFNESS.key).is_none());
    let stiffness = magnitude.map_or_else(|| table.column(STIFFNESS.key).map_err(|e| modulus(&table).unwrap_or(e)), Ok)?;
    let temperature = table.optional("temperature_c");
    let losses: Vec<Loss> = Loss::ALL.into_iter().filter(|l| table.optional(l.column()).is_some()).collect();
    let [loss] = losses.as_slice() else {
        let names = Loss::ALL.map(|l| format!("`{}`", l.column())).join(", ");
        return Err(table.whole(format!("found {} of {names}, expected one of them", losses.len())));
    };
    let loss_column = table.column(loss.column())?;
    if magnitude.is_none() && (*loss == Loss::Angle || table.is_in_other_words(stiffness)) {
        let beside = if *loss == Loss::Angle { " beside a loss angle" } else { "" };
        let words = format!("the stiffness{beside} is read as its real part: a magnitude has |c*| in its head, or is");
        remark(path, &format!("{words} `{MAGNITUDE}`"));
    }
    let known = [Some(frequency), Some(stiffness), Some(loss_column), temperature];
    if let Some(c) = (0..table.header.len()).find(|c| !known.contains(&Some(*c))) {
        return Err(table.at_head(c, format!("found column `{}`, which means nothing here", shown(&table.header[c]))));
    }
    let mut points: Vec<(f64, f64, f64, f64)> = Vec::new();
    // lines with the size of the complex stiffness
    let mut lines: Vec<(u64, f64)> = Vec::new();
    for (line, row) in table.numbers()? {
        for c in [frequency, stiffness, loss_column] {
            if row[c] <= 0.0 {
                return Err(table.at(line, c, format!("found {}, expected a number above zero", row[c])));
            }
            if row[c] < LEAST {
                return Err(table.at(line, c, format!("found {:e}, expected a number from {LEAST:e} to 1e20", row[c])));
            }
        }
        let hz = row[frequency];
        let Some((real, lost)) = loss.parts(row[loss_column], (row[stiffness], magnitude.is_some()), hz) else {
            return Err(table.at(line, loss_column, format!("found {}, expected less: no stiffness has so much loss", row[loss_column])));
        };
        let celsius = temperature.map_or(0.0, |c| row[c]);
        if points.iter().any(|p| p.0 == celsius && p.1 == hz) {
            return Err(table.at(line, frequency, format!("found {hz} Hz a second time, expected each frequency once at a temperature")));
        }
        points.push((celsius, hz, real, lost));
        lines.push((line, real.hypotenuse(lost)));
    }
    let largest = lines.iter().map(|l| l.1).fold(0.0, f64::max);
    if let Some((line, size)) = lines.iter().find(|l| l.1 * MOST_APART < largest) {
        let found = format!("found a complex stiffness of {size:e} N m/rad beside one of {largest:e}");
        return Err(table.at(*line, stiffness, format!("{found}, expected all of a table within a factor of 1e6: errors are relative")));
    }
    let temperatures_c = ascending(points.iter().map(|p| p.0).collect());
    let frequencies_hz = ascending(points.iter().map(|p| p.1).collect());
    if frequencies_hz.len() < 2 {
        return Err(table.whole(format!("found {} frequencies, expected at least two", frequencies_hz.len())));
    }
    let mut grid = Vec::new();
    for t in &temperatures_c {
        let mut row = Vec::new();
        for f in &frequencies_hz {
            let Some(p) = points.iter().find(|p| p.0 == *t && p.1 == *f) else {
                let place = if temperature.is_some() { format!(" at {t} °C") } else { String::new() };
                return Err(table.whole(format!(
                    "found a hole in the table: no value at {f} Hz{place}, expected every temperature at every frequency"
                )));
            };
            row.push((p.2, p.3));
        }
        grid.push(row);
    }
    if temperature.is_some() && temperatures_c.len() < 2 {
        return Err(table.whole("found one temperature, expected several, or no column `temperature_c`".into()));
    }
    Ok(MeasuredTable { frequencies_hz, temperatures_c, stiffness: grid })
}

/// Each value once.
fn ascending(mut list: Vec<f64>) -> Vec<f64> {
    list.sort_by(f64::total_cmp);
    list.dedup();
    list
}
