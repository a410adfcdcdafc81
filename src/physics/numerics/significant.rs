//! Numbers as people read them.

use super::elementary::Elementary;

/// A number with about `digits` significant digits, without exponent where it is short.
#[doc(hidden)]
pub fn significant(x: f64, digits: i32) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let decimals = (digits - 1 - x.abs().decimal_logarithm().floor() as i32).max(0) as usize;
    if x.abs() < 1e-4 || x.abs() >= 1e8 { format!("{x:.*e}", digits as usize - 1) } else { format!("{x:.decimals$}") }
}
