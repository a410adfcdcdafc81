//! Local maxima of a quantity known at some speeds, and their refinement between them.

use super::peak::Place;
use super::speeds::Speeds;
use crate::numerics::interpolation::Interpolation;
use crate::numerics::maximise::{maximise, maximise_bracket};
use crate::response::{ResponseError, Work};

/// A peak may stand this many times as far above its known value as the parabola says, and this share of the value besides.
const DOUBT: f64 = 3.0;
const MARGIN: f64 = 0.005;
/// Near narrow resonances, neighbours lie at three times each other's distance and tell little: a peak may be this many times its known
/// value.
const NARROW: f64 = 10.0;
/// A refined peak this many times its known value is looked at again more closely; if it grows as much again, nothing damps it.
const STEEP: f64 = 50.0;
/// Direct solutions towards a smooth top, and the last step to it as a share of the distance between known speeds: the value is off by its square.
const MOST: usize = 8;
const LAST: f64 = 3e-6;

/// A local maximum among known values.
#[derive(Debug, Clone, Copy)]
pub struct Candidate {
    /// Index of the speed.
    pub index: usize,
    /// Value there.
    pub value: f64,
    /// Estimate of the peak between speeds.
    pub estimate: f64,
    /// Whether the peak lies to the right of the speed.
    right: bool,
}

impl Candidate {
    /// At an index that is higher than its neighbours.
    pub(super) fn of(speed: &[f64], values: &[f64], i: usize) -> Self {
        let last = values.len() - 1;
        let inside = i > 0 && i < last && values[i - 1] > 0.0 && values[i + 1] > 0.0;
        let estimate = if inside { vertex(&speed[i - 1..=i + 1], &values[i - 1..=i + 1]) } else { f64::INFINITY };
        // the flatter side, per rpm: the neighbours of a narrow resonance lie at different distances
        let fall = |a: usize, b: usize| (values[a] - values[b]) / (speed[a] - speed[b]).abs();
        let right = i < last && (i == 0 || fall(i, i + 1) <= fall(i, i - 1));
        Self { index: i, value: values[i], estimate, right }
    }

    /// Whether the peak between speeds may be as high as `wanted`.
    pub(super) fn may_reach(&self, wanted: f64, narrow: bool) -> bool {
        let possible = if narrow { NARROW * self.value } else { possible(self.value, self.estimate) };
        possible >= wanted
    }
}

fn possible(value: f64, estimate: f64) -> f64 {
    value + DOUBT * (estimate - value) + MARGIN * value
}

/// Whether a peak between the outer two of three speeds, with the largest value at the middle one, may be as high as `wanted`.
pub(super) fn may_reach(known: [(f64, f64); 3], wanted: f64) -> bool {
    let estimate = vertex(&known.map(|k| k.0), &known.map(|k| k.1));
    possible(known[1].1, estimate) >= wanted
}

/// A refined peak: speed, place, and whether it ran away.
pub(crate) struct Refined {
    /// rpm.
    pub speed_rpm: f64,
    /// Where on the range.
    pub place: Place,
    /// Nothing damps it.
    pub unbounded: bool,
}

/// Local maxima, largest first, each with an estimate of the true peak: the vertex of the parabola through 1/v² at three speeds, exact
/// for a single resonance.
pub fn maxima(speed: &[f64], values: &[f64]) -> Vec<Candidate> {
    let last = values.len() - 1;
    let mut found: Vec<Candidate> = (0..=last)
        .filter(|&i| values[i] > 0.0 && (i == 0 || values[i] > values[i - 1]) && (i == last || values[i] >= values[i + 1]))
        .map(|i| Candidate::of(speed, values, i))
        .collect();
    found.sort_by(|a, b| b.value.total_cmp(&a.value));
    found
}

/// Speed of the top beside a known speed that is higher than its neighbours, of a value that is smooth over speed: the lowest place of the polynomial of its inverse through known speeds and those
/// added on the way; nothing at an end, a kink or a narrow resonance, or where it does not settle between the neighbours.
///
/// # Errors
/// Those of `value_at`.
pub(super) fn smooth_top(
    i: usize,
    speeds: &Speeds,
    values: &[f64],
    mut value_at: impl FnMut(f64) -> Result<f64, ResponseError>,
) -> Result<Option<f64>, ResponseError> {
    let (rpm, last) = (&speeds.rpm, values.len() - 1);
    if i == 0 || i == last || speeds.kink[i] || speeds.is_narrow(i) {
        return Ok(None);
    }
    let distance = 0.5 * (rpm[i + 1] - rpm[i - 1]);
    let mut through = Interpolation::new(rpm[i], distance);
    let beyond = |j: usize, kink: usize| (j <= last && !speeds.kink[kink]).then_some(j);
    let near = [Some(i), Some(i - 1), Some(i + 1), beyond(i.wrapping_sub(2), i - 1), beyond(i + 2, i + 1)];
    for j in near.into_iter().flatten().filter(|j| values[*j] > 0.0) {
        through.push(rpm[j], 1.0 / values[j]);
    }
    let mut at = rpm[i];
    for _ in 0..MOST {
        let Some(next) = through.lowest(at).filter(|s| rpm[i - 1] < *s && *s < rpm[i + 1]) else { return Ok(None) };
        let step = (next - at).abs() / distance;
        if step <= LAST {
            return Ok(Some(next));
        }
        at = next;
        let value = value_at(at)?;
        if !(values[i]..=STEEP * values[i]).contains(&value) {
            return Ok(None);
        }
        through.push(at, 1.0 / value);
    }
    Ok(None)
}

/// How far a peak may rise above a known value: the square of its growth from its lower neighbour, and never less than a well-resolved
/// peak can hide.
pub fn growth(values: &[f64], i: usize) -> f64 {
    let lower = [i.checked_sub(1), Some(i + 1)].into_iter().flatten().filter_map(|j| values.get(j)).fold(values[i], |m, v| m.min(*v));
    (values[i] / lower).powi(2).max(1.03)
}

fn vertex(x: &[f64], v: &[f64]) -> f64 {
    let q: Vec<f64> = v.iter().map(|v| 1.0 / (v * v)).collect();
    let (h0, h1) = (x[1] - x[0], x[2] - x[1]);
    let (s0, s1) = ((q[1] - q[0]) / h0, (q[2] - q[1]) / h1);
    let curvature = (s1 - s0) / (h0 + h1);
    if curvature.is_nan() || curvature <= 0.0 {
        return v[1];
    }
    let slope = s0 + curvature * h0;
    let lowest = q[1] - 0.25 * slope * slope / curvature;
    if lowest > 0.0 { 1.0 / lowest.sqrt() } else { f64::INFINITY }
}

/// The true maximum near a candidate, or nothing where it cannot reach `wanted`.
///
/// # Errors
/// Those of `value_at`.
pub fn refine(
    candidate: Candidate,
    speeds: &Speeds,
    wanted: f64,
    mut value_at: impl FnMut(f64, &mut Work) -> Result<f64, ResponseError>,
    work: &mut Work,
) -> Result<Option<Refined>, ResponseError> {
    let Candidate { index: i, value, right, .. } = candidate;
    let speed = &speeds.rpm;
    let last = speed.len() - 1;
    let narrow = speeds.is_narrow(i);
    if !candidate.may_reach(wanted, narrow) {
        return Ok(None);
    }
    let end = if i == 0 || i == last { Place::End } else { Place::Interior };
    let mut f = |s: f64| value_at(s, work);
    let mut best = (speed[i], f(speed[i])?, end);
    let mut keep = |(at, v): (f64, f64)| {
        if v > best.1 * (1.0 + 1e-12) {
            best = (at, v, Place::Interior);
        }
    };
    let (left, beyond) = (speed[i.saturating_sub(1)], speed[(i + 1).min(last)]);
    // one search does where it reaches the neighbour on its side: not where that lies much further off than the other, as beside a tabulated speed
    let (searched, other) = if right { (beyond - speed[i], speed[i] - left) } else { (speed[i] - left, beyond - speed[i]) };
    if end == Place::Interior && !speeds.kink[i] && !narrow && searched <= 1.5 * other {
        keep(maximise_bracket((left, speed[i], beyond), right, &mut f)?);
    } else {
        // an end, a kink that may hold the maximum itself, or neighbours at different distances: each side is searched apart
        if i > 0 {
            keep(maximise(left, speed[i], &mut f)?);
        }
        if i < last {
            keep(maximise(speed[i], beyond, &mut f)?);
        }
    }
    let mut unbounded = false;
    if best.1 > STEEP * value {
        let near = 1e-4 * (beyond - left);
        let closer = maximise((best.0 - near).max(speed[0]), (best.0 + near).min(speed[last]), &mut f)?;
        unbounded = closer.1 > STEEP * best.1;
        if closer.1 > best.1 {
            (best.0, best.1) = closer;
        }
    }
    Ok(Some(Refined { speed_rpm: best.0, place: best.2, unbounded }))
}
