//! Resonances that nothing damps: whether a measure sees them.

use super::measure::Measure;
use super::peak_search::PeakFinder;
use super::speeds::Pole;
use crate::absorber::Mounted;
use crate::response::{Quantity, ResponseError, Work};

/// Towards an undamped resonance a quantity grows at least this many times in two decades of distance.
const STEEP: f64 = 50.0;

impl PeakFinder<'_> {
    /// Whether a quantity grows without bound towards an undamped resonance: a hundred times closer, it is a hundred times as large, unless
    /// the torque does not push the mode or the quantity does not see it.
    pub(super) fn check_pole(&self, design: &[Mounted], measure: &Measure, pole: &Pole, work: &mut Work) -> Result<(), ResponseError> {
        for quantity in &measure.quantities {
            let mut size = |distance: f64| -> Result<f64, ResponseError> {
                Ok(self.direct.order_at(design, *quantity, pole.order, pole.speed_rpm * (1.0 + distance), work)?.norm())
            };
            if size(1e-6)? > STEEP * size(1e-4)? {
                return Err(ResponseError::unbounded(self.system.excitation.orders[pole.order], pole.speed_rpm));
            }
        }
        Ok(())
    }

    /// The error for a quantity that runs away at this speed: its largest order is to blame.
    pub(super) fn pole(&self, design: &[Mounted], quantity: Quantity, speed_rpm: f64) -> ResponseError {
        let size =
            |n: usize| self.direct.order_at(design, quantity, n, speed_rpm, &mut Work::default()).map_or(f64::INFINITY, |y| y.norm());
        let n = (0..self.system.orders()).fold((0, 0.0), |m, n| if size(n) > m.1 { (n, size(n)) } else { m }).0;
        ResponseError::unbounded(self.system.excitation.orders[n], speed_rpm)
    }
}
