//! Derivatives of what a design does in operation, where its temperature and strain follow its parameters.

use super::Problem;
use super::load_case::LoadCase;
use crate::objective::{Measure, Peak};
use crate::response::{ResponseError, Work};

/// Step of the differences, in coordinates.
const STEP: f64 = 1e-4;

impl Problem<'_> {
    /// Derivatives of a peak in operation by the coordinates, by central differences at the speed of the peak (a peak does not change with its speed); one-sided at a bound. Where a measure is not found
    /// speed by speed, the differences are those of its largest value.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    pub(super) fn gradient_in_operation(
        &self,
        case: &LoadCase,
        w: &[f64],
        (measure, peak): (&Measure, &Peak),
        work: &mut Work,
    ) -> Result<Vec<f64>, ResponseError> {
        let mut value = |w: &[f64]| -> Result<f64, ResponseError> {
            let design = self.space.design(w);
            match case.finder.value_at_peak(&case.absorbers_at_few_speeds(&design), (measure, peak), work)? {
                Some(value) => Ok(value),
                None => case.peak(&design, measure, work),
            }
        };
        let mut along = |(i, (low, high)): (usize, (f64, f64))| -> Result<f64, ResponseError> {
            let moved = |step: f64| {
                let mut moved = w.to_vec();
                moved[i] = (moved[i] + step).clamp(low, high);
                moved
            };
            let (before, after) = (moved(-STEP), moved(STEP));
            Ok((value(&after)? - value(&before)?) / (after[i] - before[i]))
        };
        self.space.bounds().into_iter().enumerate().map(&mut along).collect()
    }
}
