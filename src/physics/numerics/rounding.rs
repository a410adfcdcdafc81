//! Numbers rounded to the digits that tables show.

/// Powers of ten that are exact.
const POWERS: [f64; 23] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22];
/// A product this close to the middle of two whole numbers may be either of them.
const DOUBT: f64 = 1e-6;

/// The number nearest to `x` of seven significant decimal digits; zero, infinities and NaN are themselves.
///
/// A product and a quotient with an exact power of ten are right to the last bit \[Clinger 1990\]; where the product lies in the middle, and for large and small numbers, the digits are
/// written and read.
pub fn seven_digits(x: f64) -> f64 {
    if x == 0.0 {
        return x;
    }
    by_powers(x).unwrap_or_else(|| format!("{x:.6e}").parse().unwrap_or(x))
}

fn by_powers(x: f64) -> Option<f64> {
    let places = POWERS.iter().position(|power| x.abs() * power >= 1e6)?;
    let digits = x.abs() * POWERS[places];
    let doubtful = (digits.fract() - 0.5).abs() < DOUBT || digits >= 1e7 - 1.0;
    (!doubtful).then(|| (digits.round() / POWERS[places]).copysign(x))
}
