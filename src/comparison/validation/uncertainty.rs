//! How well printed numbers and ours are known: the digits of a table, and the standard errors of the inputs that were fitted.

use super::{Entry, Kind};
use crate::analysis::{Calibration, RunError};
use crate::input::Input;

/// Inputs are moved by this share of their standard error, either way.
const STEP: f64 = 0.25;
/// Changes to either side that differ by more than this share are of different places.
const BENT: f64 = 0.5;
/// Digits that a printed number has at most.
const DIGITS: usize = 9;

/// Decimals that a number is printed with at least: negative where it ends with zeros before the point.
fn decimals(value: f64) -> Option<i32> {
    if value == 0.0 || !value.is_finite() {
        return None;
    }
    let text = format!("{:.*e}", DIGITS - 1, value.abs());
    let (mantissa, exponent) = text.split_once('e')?;
    let digits = mantissa.replace('.', "");
    let significant = digits.trim_end_matches('0').len().max(1) as i32;
    Some(significant - 1 - exponent.parse::<i32>().ok()?)
}

/// Half of the last digit of numbers printed alike: they have the decimals of the one that needs most; `None` of zeros alone.
pub fn half_digit(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let decimals = values.into_iter().filter_map(decimals).max()?;
    Some(0.5 * 10f64.powi(-decimals))
}

/// Half of the last digit of every printed number: those of one unit in one table are printed alike, and each number of the text by itself.
pub fn digits(entries: &mut [Entry]) {
    let of = |e: &Entry, others: &[Entry]| {
        let alike = |o: &&Entry| (&o.table, &o.unit, o.kind) == (&e.table, &e.unit, e.kind);
        let own = e.published?;
        if e.table == "text" && e.kind == Kind::Other {
            half_digit([own])
        } else {
            half_digit(others.iter().filter(alike).filter_map(|o| o.published))
        }
    };
    let halves: Vec<Option<f64>> = entries.iter().map(|e| of(e, entries)).collect();
    entries.iter_mut().zip(halves).for_each(|(e, half)| e.uncertainty.half_digit = e.uncertainty.half_digit.or(half));
}

/// Standard error of every computed number from those of the fitted inputs and their correlation: s² = sum over pairs of inputs of d_i r_ij d_j, where d_i is what one standard error of input i changes, by
/// differences. `again`: the same entries with other values of the inputs. Nothing where an input has no finite error, and none of a number that has no slope, as another place governs a little further.
///
/// # Errors
/// Those of `again`.
pub fn standard_errors(
    entries: &mut [Entry],
    calibration: &Calibration,
    again: impl Fn(&[(Input, f64)]) -> Result<Vec<Entry>, RunError>,
) -> Result<(), RunError> {
    let fitted: Vec<(Input, f64)> = calibration.inputs.iter().map(|c| (c.free.input, c.value)).collect();
    let errors: Option<Vec<f64>> = calibration.inputs.iter().map(|c| c.standard_error.filter(|e| e.is_finite())).collect();
    let Some(errors) = errors else { return Ok(()) };
    let mut changes: Vec<Vec<f64>> = Vec::new();
    for (i, error) in errors.iter().enumerate() {
        let moved = |by: f64| {
            let mut values = fitted.clone();
            let bounds = &calibration.inputs[i].free;
            values[i].1 = (values[i].1 + by * error).clamp(bounds.lower, bounds.upper);
            Ok((values[i].1, again(&values)?))
        };
        let ((low, before), (high, after)) = (moved(-STEP)?, moved(STEP)?);
        // other values may leave an entry out: then they do not belong together
        if before.len() != entries.len() || after.len() != entries.len() {
            return Ok(());
        }
        let change = |(own, (b, a)): (&Entry, (&Entry, &Entry))| match (b.computed, own.computed, a.computed) {
            (Some(b), Some(own), Some(a)) if high > low => {
                let (down, up) = (own - b, a - own);
                // another throw or peak governs on one side: there is no slope
                let bent = (up - down).abs() > BENT * up.abs().max(down.abs());
                if bent { f64::NAN } else { (a - b) / (high - low) * error }
            }
            _ => 0.0,
        };
        changes.push(entries.iter().zip(before.iter().zip(&after)).map(change).collect());
    }
    let correlated = |i: usize, j: usize| if i == j { 1.0 } else { calibration.statistics.correlation[i][j].unwrap_or(0.0) };
    for (n, e) in entries.iter_mut().enumerate() {
        let pairs = (0..errors.len()).flat_map(|i| (0..errors.len()).map(move |j| (i, j)));
        let variance: f64 = pairs.map(|(i, j)| changes[i][n] * correlated(i, j) * changes[j][n]).sum();
        e.uncertainty.standard_error = Some(variance.sqrt()).filter(|s| s.is_finite() && *s > 0.0);
    }
    Ok(())
}
