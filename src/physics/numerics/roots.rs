//! All zeros of a function in an interval, as far as a scan and its extrema tell.

use super::maximise::maximise;

/// An interval of zeros is halved or cut until it is this share of the whole.
const NARROW: f64 = 1e-12;
/// At most so often.
const MOST_CUTS: usize = 200;

/// Zeros of a continuous function between `low` and `high`, ascending: `samples` intervals of equal length are scanned, and extrema between them that come near zero are looked at, so that pairs of
/// zeros between two samples are found where the function is smooth on the scale of an interval. Each zero is found by regula falsi with halved weights (Illinois).
///
/// # Errors
/// Those of `f`.
pub(crate) fn roots<E>(low: f64, high: f64, samples: usize, f: &mut impl FnMut(f64) -> Result<f64, E>) -> Result<Vec<f64>, E> {
    let x = |i: usize| if i == samples { high } else { low + (high - low) * i as f64 / samples as f64 };
    let mut points = Vec::with_capacity(samples + 1);
    for i in 0..=samples {
        points.push((x(i), f(x(i))?));
    }
    // where the distance to zero falls towards a sample from both sides, or towards an end
    let nearest = |i: usize| {
        let sign = points[i].1.signum();
        let farther = |j: usize| sign * points[j].1 >= sign * points[i].1 && points[j].1 * sign > 0.0;
        points[i].1 != 0.0 && (i == 0 || farther(i - 1)) && (i == samples || farther(i + 1))
    };
    let mut extrema = Vec::new();
    for i in (0..=samples).filter(|i| nearest(*i)) {
        let sign = points[i].1.signum();
        let (from, to) = (points[i.saturating_sub(1)].0, points[(i + 1).min(samples)].0);
        let (at, value) = maximise(from, to, |x| f(x).map(|y| -sign * y))?;
        if value >= 0.0 {
            extrema.push((at, -sign * value));
        }
    }
    points.extend(extrema);
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut found = Vec::new();
    for p in points.windows(2) {
        if p[0].1 == 0.0 {
            found.push(p[0].0);
        } else if p[0].1 * p[1].1 < 0.0 {
            found.push(between(p[0], p[1], NARROW * (high - low), f)?);
        }
    }
    found.extend(points.last().filter(|p| p.1 == 0.0).map(|p| p.0));
    found.dedup();
    Ok(found)
}

/// The zero between two points of opposite sign.
///
/// # Errors
/// Those of `f`.
pub(crate) fn between<E>(
    (mut a, mut fa): (f64, f64),
    (mut b, mut fb): (f64, f64),
    width: f64,
    f: &mut impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let mut side = 0;
    for _ in 0..MOST_CUTS {
        let c = (a * fb - b * fa) / (fb - fa);
        if (b - a).abs() <= width || c == a || c == b {
            return Ok(if fa.abs() < fb.abs() { a } else { b });
        }
        let fc = f(c)?;
        if fc == 0.0 {
            return Ok(c);
        }
        if fc * fb < 0.0 {
            (a, fa) = (b, fb);
            side = 0;
        } else {
            side += 1;
            // the same end stayed twice: its weight is halved
            fa *= if side > 1 { 0.5 } else { 1.0 };
        }
        (b, fb) = (c, fc);
    }
    Ok(b)
}
