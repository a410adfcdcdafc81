//! Angles of a cycle: equal steps over whole turns.

use crate::units::DEG_PER_REV;

/// Angles are as equal as this, degrees.
const EQUAL_DEG: f64 = 1e-6;
/// Fewer samples are no cycle.
const FEWEST: usize = 3;
/// The end of a cycle is its beginning again to this share of the largest value.
pub(crate) const CLOSED: f64 = 1e-6;

/// Whether an angle follows the others: in a step as theirs, or as `known` where the angles are known.
///
/// # Errors
/// What is wrong.
pub fn follows(angles: &[f64], next: f64, known: Option<f64>) -> Result<(), String> {
    let before = angles[angles.len() - 1];
    let expected = match (known, angles) {
        (Some(known), _) => known,
        (None, [first, second, ..]) => before + (second - first),
        (None, _) if next > before => return Ok(()),
        (None, _) => return Err(format!("found {next} after {before}, expected a larger angle")),
    };
    if (next - expected).abs() > EQUAL_DEG * expected.abs().max(1.0) {
        return Err(format!("found {next} after {before}, expected {expected}: equal steps, the same for all points"));
    }
    Ok(())
}

/// Whether the last angle is the first again, after whole turns.
///
/// # Errors
/// What is wrong.
pub(crate) fn ends_where_it_began(angles: &[f64], of: &str) -> Result<bool, String> {
    let n = angles.len();
    if n < FEWEST {
        return Err(format!("found {n} samples{of}, expected at least {FEWEST}"));
    }
    let (first, last, step) = (angles[0], angles[n - 1], angles[1] - angles[0]);
    let whole = |length: f64| {
        let turns = length / DEG_PER_REV;
        turns.round() >= 1.0 && (turns - turns.round()).abs() < EQUAL_DEG
    };
    if whole(last - first) {
        return Ok(true);
    }
    if whole(last - first + step) {
        return Ok(false);
    }
    Err(format!("found angles from {first} to {last} in steps of {step}, expected whole turns"))
}
