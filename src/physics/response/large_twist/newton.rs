//! Newton's method at one speed.

use super::balance::{Balance, Steady};
use super::linear::Linear;
use crate::numerics::lu::{Lu, height};
use crate::response::{ResponseError, Work};
use nalgebra::{DMatrix, DVector};

/// A step is the last when it is no larger than the first share of the motion, and leaves an error of no more than the second.
const LAST_STEP: (f64, f64) = (1e-6, 1e-13);
/// A step of this share of the motion leads so near that its Jacobian serves the next.
const NEAR: f64 = 1e-2;
/// A Jacobian serves as long as each step is this share of the one before.
const SHRINKS: f64 = 0.1;
/// Most steps from a start that may be far.
pub(super) const MOST_STEPS: usize = 30;

/// So near to a motion that is known, as a share of it, the method ends there.
const KNOWN: f64 = 1e-3;

/// A solution.
pub(super) struct Motion {
    pub x: DVector<f64>,
    /// Whether the determinant of the Jacobian is positive: it changes where a curve folds.
    pub even: bool,
}

impl Balance<'_> {
    /// Nothing where it does not converge in so many steps, or to a motion beyond the path of what moves.
    pub(super) fn newton(&self, linear: &Linear, start: &DVector<f64>, most: usize, work: &mut Work) -> Option<Motion> {
        self.newton_beside(linear, start, &[], most, work)
    }

    /// The same; nothing, too, where it leads to one of the motions that are known.
    pub(super) fn newton_beside(
        &self,
        linear: &Linear,
        start: &DVector<f64>,
        known: &[&DVector<f64>],
        most: usize,
        work: &mut Work,
    ) -> Option<Motion> {
        let mut x = start.clone();
        // near the solution one Jacobian serves several steps, as long as each is a tenth of the one before
        let (mut kept, mut last, mut factored) = (None, f64::INFINITY, 0);
        while kept.is_some() || factored < most {
            let is_kept = kept.is_some();
            let (missing, lu) = match kept.take() {
                Some(lu) => (self.missing(linear, &x, None)?, lu),
                None => {
                    work.harmonic_balances += 1;
                    factored += 1;
                    let mut jacobian = DMatrix::zeros(height(x.len()), x.len());
                    let missing = self.missing(linear, &x, Some(&mut jacobian))?;
                    (missing, Lu::filled_up(jacobian))
                }
            };
            let step = lu.solve(&missing)?;
            x -= &step;
            let (size, reach) = (step.amax(), x.amax());
            // the first unknown, the mean, may be far larger than all that moves about it
            let moves = x.as_slice()[1..].iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            if !x.iter().all(|x| x.is_finite()) || known.iter().any(|known| (*known - &x).amax() <= KNOWN * moves) {
                return None;
            }
            // the error that is left: the square of the step, or as much less than the step as that is less than the one before
            let scale = if is_kept { last } else { reach };
            if size <= LAST_STEP.0 * reach && size * size <= LAST_STEP.1 * reach * scale {
                return self.within_path(&mut x).then(|| Motion { x, even: lu.is_positive() });
            }
            let converges = size <= if is_kept { SHRINKS * last } else { NEAR * reach };
            (kept, last) = (converges.then_some(lu), size);
        }
        None
    }

    /// A motion of this balance by the harmonics of a finer one; nothing where Newton's method does not find it.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance of the chain.
    pub fn refined(&self, finer: &Self, steady: &Steady) -> Result<Option<Steady>, ResponseError> {
        let linear = finer.linear(steady.speed_rpm)?;
        let mut x = DVector::zeros(finer.unknowns());
        x[0] = steady.mean_twist;
        let rows = if self.equations().is_ring() { vec![&steady.twist] } else { vec![&steady.twist, &steady.hub] };
        for (b, row) in rows.into_iter().enumerate() {
            for (k, y) in row.iter().enumerate() {
                let at = 1 + 2 * (b * finer.harmonics() + k);
                (x[at], x[at + 1]) = (y.re, y.im);
            }
        }
        let found = finer.newton(&linear, &x, MOST_STEPS, &mut Work::default());
        Ok(found.and_then(|found| finer.steady(&linear, &found.x)))
    }
}
