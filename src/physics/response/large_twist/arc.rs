//! Pseudo-arc-length continuation \[Keller 1977\]: a step along the tangent of the curve, then back to the curve at right angles to it, through folds.

use super::balance::Balance;
use crate::numerics::lu::Lu;
use crate::response::{ResponseError, Work};
use nalgebra::{DMatrix, DVector};

/// First, longest and shortest step, in units of the range of speed and of the largest motion met.
const FIRST: f64 = 5e-3;
const LONGEST: f64 = 3e-2;
const SHORTEST: f64 = 1e-8;
/// A step of Newton's method is the last when it is this share of the motion.
const LAST_STEP: f64 = 1e-11;
/// Steps of Newton's method: more are given up, fewer lengthen the next step.
const MOST: usize = 9;
const FEW: usize = 4;
/// Share of the speed for a difference.
const DIFFERENCE: f64 = 1e-7;

/// The matrix of all equations, and what is missing.
type Bordered = (DMatrix<f64>, DVector<f64>);

/// Where a continuation is.
#[derive(Debug, Clone)]
pub(super) struct Place {
    pub x: DVector<f64>,
    pub speed_rpm: f64,
    /// Change of the unknowns in units of the largest motion, and of the speed in units of its range, of length one.
    tangent: DVector<f64>,
}

impl Place {
    pub fn new(x: DVector<f64>, speed_rpm: f64) -> Self {
        Self { tangent: DVector::zeros(x.len() + 1), x, speed_rpm }
    }
}

/// A piece of a curve.
pub(super) struct Piece {
    /// With those at speeds asked for marked.
    pub points: Vec<(Place, bool)>,
    /// Whether it came back to where it began.
    pub closed: bool,
    /// Whether it came back, or left the range of speeds.
    pub whole: bool,
}

/// A continuation.
pub(super) struct Arc<'w, 'a> {
    balance: &'w Balance<'a>,
    range: (f64, f64),
    scale: f64,
    work: &'w mut Work,
}

impl<'w, 'a> Arc<'w, 'a> {
    /// Within a range of speeds, from a motion of about this size.
    pub fn new(balance: &'w Balance<'a>, range: (f64, f64), x: &DVector<f64>, work: &'w mut Work) -> Self {
        Self { balance, range, scale: x.amax().max(f64::MIN_POSITIVE), work }
    }

    fn width(&self) -> f64 {
        if self.range.1 > self.range.0 { self.range.1 - self.range.0 } else { self.range.0 }
    }

    /// Points from a motion on in one direction of speed, without it.
    pub fn follow(&mut self, start: &Place, direction: f64, speeds: &[f64]) -> Result<Piece, ResponseError> {
        let n = start.x.len();
        let mut place = start.clone();
        place.tangent = DVector::zeros(n + 1);
        place.tangent[n] = direction;
        let (mut points, mut length, mut travelled) = (Vec::new(), FIRST, 0.0);
        let piece = |points, closed, whole| Ok(Piece { points, closed, whole });
        match self.tangent(&place)? {
            Some(tangent) => place.tangent = tangent,
            None => return piece(points, false, false),
        }
        while !self.balance.is_spent(self.work) {
            let Some((next, steps)) = self.step(&place, length)? else {
                length *= 0.5;
                if length < SHORTEST {
                    break;
                }
                continue;
            };
            self.scale = self.scale.max(next.x.amax());
            self.passed(&place, &next, speeds, &mut points)?;
            travelled += length;
            if next.speed_rpm <= self.range.0 || next.speed_rpm >= self.range.1 {
                return piece(points, false, true);
            }
            let near =
                (&next.x - &start.x).amax() <= self.scale * length && (next.speed_rpm - start.speed_rpm).abs() <= length * self.width();
            if near && travelled > 10.0 * FIRST && travelled > 3.0 * length {
                return piece(points, true, true);
            }
            length = if steps <= FEW {
                (1.6 * length).min(LONGEST)
            } else if steps > FEW + 2 {
                0.6 * length
            } else {
                length
            };
            points.push((next.clone(), false));
            place = next;
        }
        piece(points, false, false)
    }

    /// Motions at speeds asked for that a step has passed.
    fn passed(&mut self, from: &Place, to: &Place, speeds: &[f64], points: &mut Vec<(Place, bool)>) -> Result<(), ResponseError> {
        let (a, b) = (from.speed_rpm, to.speed_rpm);
        let (low, high) = (a.min(b), a.max(b));
        let mut between: Vec<f64> = speeds.iter().copied().filter(|s| (low < *s && *s < high) || *s == b).collect();
        if b < a {
            between.reverse();
        }
        let change = &to.x - &from.x;
        for speed in between {
            let start = &from.x + &change * ((speed - a) / (b - a));
            let found = self.balance.newton(&self.balance.linear(speed)?, &start, MOST, self.work);
            // near a fold the other branch may be met
            if let Some(found) = found.filter(|found| (&found.x - &from.x).amax() <= 2.0 * change.amax()) {
                points.push((Place::new(found.x, speed), true));
            }
        }
        Ok(())
    }

    /// The place at a share of the way between two on the curve.
    pub fn between(&mut self, a: (&DVector<f64>, f64), b: (&DVector<f64>, f64), share: f64) -> Result<Option<Place>, ResponseError> {
        let n = a.0.len();
        self.scale = self.scale.max(b.0.amax());
        let mut chord = DVector::zeros(n + 1);
        chord.rows_mut(0, n).copy_from(&((b.0 - a.0) / self.scale));
        chord[n] = (b.1 - a.1) / self.width();
        let length = chord.norm();
        let from = Place { x: a.0.clone(), speed_rpm: a.1, tangent: chord / length };
        Ok(self.step(&from, share * length)?.map(|found| found.0))
    }

    /// Change of what is missing by the speed, in units of the range.
    fn by_speed(&self, (x, speed_rpm): (&DVector<f64>, f64), missing: &DVector<f64>) -> Result<Option<DVector<f64>>, ResponseError> {
        let change = DIFFERENCE * speed_rpm;
        let other = self.balance.missing(&self.balance.linear(speed_rpm + change)?, x, None);
        Ok(other.map(|other| (other - missing) * (self.width() / change)))
    }

    /// The matrix of all equations, the last one given, and what is missing.
    fn bordered(
        &mut self,
        x: &DVector<f64>,
        speed_rpm: f64,
        last: &DVector<f64>,
        by_speed: &mut Option<DVector<f64>>,
    ) -> Result<Option<Bordered>, ResponseError> {
        let n = x.len();
        self.work.harmonic_balances += 1;
        let mut jacobian = DMatrix::zeros(n, n);
        let Some(missing) = self.balance.missing(&self.balance.linear(speed_rpm)?, x, Some(&mut jacobian)) else { return Ok(None) };
        // one difference a step of the curve: Newton's method converges all the same
        if by_speed.is_none() {
            *by_speed = self.by_speed((x, speed_rpm), &missing)?;
        }
        let Some(by_speed) = by_speed else { return Ok(None) };
        let mut matrix = DMatrix::zeros(n + 1, n + 1);
        matrix.view_mut((0, 0), (n, n)).copy_from(&(jacobian * self.scale));
        matrix.view_mut((0, n), (n, 1)).copy_from(by_speed);
        matrix.view_mut((n, 0), (1, n + 1)).copy_from(&last.transpose());
        Ok(Some((matrix, missing)))
    }

    /// Direction of the curve at a place, on from the last one.
    fn tangent(&mut self, place: &Place) -> Result<Option<DVector<f64>>, ResponseError> {
        let Some((matrix, _)) = self.bordered(&place.x, place.speed_rpm, &place.tangent, &mut None)? else { return Ok(None) };
        Ok(Lu::new(&matrix).solve(&ahead(place.x.len())).map(|t| t.normalize()).filter(|t| t.iter().all(|x| x.is_finite())))
    }

    /// A step of a length along the tangent, then back to the curve at right angles to it; with the number of Newton's steps.
    fn step(&mut self, from: &Place, length: f64) -> Result<Option<(Place, usize)>, ResponseError> {
        let n = from.x.len();
        let mut moved = &from.tangent * length;
        let mut by_speed = None;
        for steps in 1..=MOST {
            let (x, speed_rpm) = (&from.x + moved.rows(0, n) * self.scale, from.speed_rpm + moved[n] * self.width());
            // there is no motion at no speed
            if speed_rpm <= 0.0 {
                return Ok(None);
            }
            let Some((matrix, missing)) = self.bordered(&x, speed_rpm, &from.tangent, &mut by_speed)? else { return Ok(None) };
            let mut right = DVector::zeros(n + 1);
            right.rows_mut(0, n).copy_from(&missing);
            right[n] = from.tangent.dot(&moved) - length;
            let lu = Lu::new(&matrix);
            let Some(step) = lu.solve(&right).filter(|s| s.iter().all(|x| x.is_finite())) else { return Ok(None) };
            moved -= &step;
            if step.amax() <= LAST_STEP * (1.0 + x.amax() / self.scale) {
                let Some(tangent) = lu.solve(&ahead(n)).map(|t| t.normalize()) else { return Ok(None) };
                let mut place =
                    Place { x: &from.x + moved.rows(0, n) * self.scale, speed_rpm: from.speed_rpm + moved[n] * self.width(), tangent };
                let is_within = self.balance.within_path(&mut place.x);
                // a sharp turn within a step is another branch
                return Ok((is_within && place.tangent.dot(&from.tangent) > 0.5).then_some((place, steps)));
            }
        }
        Ok(None)
    }
}

/// Right-hand side of a tangent: along the last one by one.
fn ahead(n: usize) -> DVector<f64> {
    let mut right = DVector::zeros(n + 1);
    right[n] = 1.0;
    right
}
