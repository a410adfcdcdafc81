//! Derivatives of peaks with respect to the values of an absorber.

use super::level::Level;
use super::peaks::{Peak, PeakFinder};
use crate::absorber::Mounted;
use crate::numerics::{C64, ZERO};
use crate::response::{ResponseError, Work};

impl PeakFinder<'_> {
    /// Derivatives of a peak's value with respect to ring inertia, stiffness and damping of absorber `index`, at fixed speed and cycle
    /// angles: exact, because a peak is stationary in both (or held by an end of the range); of a multiaxial margin by differences.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance.
    pub fn gradient(&self, design: &[Mounted], index: usize, peak: &Peak, work: &mut Work) -> Result<[f64; 3], ResponseError> {
        let Some(extremes) = &peak.extremes else {
            let y = self.direct.order_at(design, peak.quantity, peak.order, peak.speed_rpm, work)?;
            let change = self.direct.sensitivity(design, index, peak.quantity, peak.order..peak.order + 1, peak.speed_rpm, work)?;
            return Ok(change[0].map(|d| (y.conj() * d).re / y.norm()));
        };
        let changes = self.direct.sensitivity(design, index, peak.quantity, 0..self.system.orders(), peak.speed_rpm, work)?;
        let level = Level::of(peak.over, peak.quantity, self.margin);
        let mut phasors = vec![ZERO; self.system.orders()];
        if level.asks_for_all() {
            self.direct.at(design, peak.quantity, peak.speed_rpm, &mut phasors, work)?;
        }
        let changes = [0, 1, 2].map(|p| changes.iter().map(|c| c[p]).collect::<Vec<C64>>());
        Ok(level.derivatives(&self.synthesiser, peak.speed_rpm, (extremes, &phasors), changes))
    }
}
