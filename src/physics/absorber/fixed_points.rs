//! Fixed points of a damped absorber on an undamped engine of one mode, and the damping that Villalva reads off one of them.
//!
//! Whatever the damping, the amplitude passes through two points (I below, II above). \[Villalva 2014\] section 6.2.2 asks the curve to be as
//! high a step of one per cent beside a point as at the point; exactly level is Brock's condition ([`crate::absorber::closed_forms`]).

/// One of the two points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Point {
    /// At the lower frequency.
    I,
    /// At the higher one.
    II,
}

/// Square of the frequency of a fixed point over the engine's, for an inertia ratio `mu` and a tuning omega_absorber/omega_engine: roots of
/// x² - 2 x (1 + tuning² (1 + mu))/(2 + mu) + 2 tuning²/(2 + mu) \[Villalva 2014\] eq. (6.14), \[Den Hartog 1956\] section 3.3.
pub fn frequency2(mu: f64, tuning: f64, point: Point) -> f64 {
    let half = (1.0 + tuning * tuning * (1.0 + mu)) / (2.0 + mu);
    let product = 2.0 * tuning * tuning / (2.0 + mu);
    let root = (half * half - product).sqrt();
    // the product of the roots keeps the digits of the smaller one
    match point {
        Point::I => product / (half + root),
        Point::II => half + root,
    }
}

/// Amplitude at a fixed point over the static deflection \[Villalva 2014\] eqs. (6.18) and (6.19): that of the locked ring.
pub fn amplification(mu: f64, tuning: f64, point: Point) -> f64 {
    1.0 / (1.0 - frequency2(mu, tuning, point) * (1.0 + mu)).abs()
}

/// Damping ratio c/(2 J omega_engine) for which the amplitude at `step` times the square of a fixed point's frequency is that of the point
/// \[Villalva 2014\] eq. (6.20), with a step of 1.01 or 0.99; `None` where no damping does that.
pub fn damping(mu: f64, tuning: f64, point: Point, step: f64) -> Option<f64> {
    let amplification = amplification(mu, tuning, point);
    let (x, t) = (frequency2(mu, tuning, point) * step, tuning * tuning);
    let undamped = (t - x).powi(2);
    let determinant = ((t - x) * (1.0 - x) - mu * x * t).powi(2);
    let locked = (1.0 - x * (1.0 + mu)).powi(2);
    let square = (undamped - amplification * amplification * determinant) / (4.0 * x * (amplification * amplification * locked - 1.0));
    (square.is_finite() && square >= 0.0).then(|| square.sqrt())
}

/// Amplitude of the engine over its static deflection at the square `x` of a frequency over the engine's, for an inertia ratio `mu`, a tuning and a damping ratio c/(2 J omega_engine); infinite damping locks the ring.
/// \[Villalva 2014\] eq. (6.20), which prints the square of the left side without a square on the right.
pub fn amplitude(mu: f64, tuning: f64, damping: f64, x: f64) -> f64 {
    let locked = 1.0 - x * (1.0 + mu);
    if damping == f64::INFINITY {
        return 1.0 / locked.abs();
    }
    let (t, c) = (tuning * tuning, 4.0 * x * damping * damping);
    let determinant = (t - x) * (1.0 - x) - mu * x * t;
    (((t - x).powi(2) + c) / (determinant.powi(2) + c * locked.powi(2))).sqrt()
}
