//! Peaks of the mean power that absorbers dissipate, over speed.

use super::design_cache::Sweep;
use super::measure::{Measure, Over};
use super::peak::Peak;
use super::peak_search::{LargestPeaks, PeakFinder};
use super::sharp_resonances::{RISE, RISE_OF_SQUARES, bend};
use super::speeds::Speeds;
use crate::absorber::{Mounted, Operating};
use crate::numerics::ZERO;
use crate::response::{Direct, Quantity, ResponseError, Work};
use crate::units::RAD_PER_S_PER_RPM;

/// Below this share of the largest known power a maximum is not refined: power grows as the square of a twist.
const LEAST_SHARE: f64 = 0.3;

impl PeakFinder<'_> {
    /// Power of the absorbers of a measure at a speed, W, order by order: sum over rings of omega Im S |twist|²/2.
    pub(super) fn powers_at(
        &self,
        design: &[Mounted],
        measure: &Measure,
        speed_rpm: f64,
        work: &mut Work,
    ) -> Result<Vec<f64>, ResponseError> {
        let own: Vec<usize> = measure.absorbers().filter(|i| *i < design.len()).collect();
        let twists: Vec<Quantity> = own.iter().map(|i| Quantity::RingTwist(*i)).collect();
        let mut by_order = vec![0.0; self.system.orders()];
        for (i, twists) in own.into_iter().zip(self.direct.at_each(design, &twists, &[speed_rpm], work)?) {
            let Some(law) = design[i].absorber.law() else { continue };
            for (n, (sum, y)) in by_order.iter_mut().zip(&twists).enumerate() {
                *sum += law.dissipated_power(self.operating(n, speed_rpm), y.norm_sqr());
            }
        }
        Ok(by_order)
    }

    /// Local maxima on a part of the range that begins at index `start` of the sweeps of the ring twists.
    pub(super) fn powers(
        &self,
        design: &[Mounted],
        measure: &Measure,
        (speeds, start): (&Speeds, usize),
        twists: &[Sweep],
        found: &mut LargestPeaks,
        work: &mut Work,
    ) -> Result<(), ResponseError> {
        let orders = self.system.orders();
        let Some(&quantity) = measure.quantities.first() else { return Ok(()) };
        let at: Vec<Operating> = speeds.rpm.iter().flat_map(|speed| (0..orders).map(|n| self.operating(n, *speed))).collect();
        let losses_of = |r: usize| {
            let mut losses = vec![0.0; at.len()];
            design[r].absorber.law().inspect(|law| law.loss_each(&at, &mut losses));
            losses
        };
        let losses: Vec<Vec<f64>> = measure.absorbers().map(losses_of).collect();
        let power_at = |i: usize| -> f64 {
            let power_of = |(losses, y): (&Vec<f64>, &Sweep)| {
                let y = &y[(start + i) * orders..(start + i + 1) * orders];
                losses[i * orders..].iter().zip(y).map(|(loss, y)| loss * y.norm_sqr()).sum::<f64>()
            };
            losses.iter().zip(twists).map(power_of).sum::<f64>() * measure.within.weight(speeds.rpm[i])
        };
        let values: Vec<f64> = (0..speeds.rpm.len()).map(power_at).collect();
        let value_at = |speed: f64, work: &mut Work| -> Result<f64, ResponseError> {
            Ok(self.powers_at(design, measure, speed, work)?.iter().sum::<f64>() * measure.within.weight(speed))
        };
        let rise = |i: usize, n: usize| {
            let power_rise = |(losses, twist): (&Vec<f64>, &Sweep)| {
                let y = |j: usize| twist[(start + j) * orders + n];
                let size = y(i).norm().max(y(i + 1).norm());
                let most = (size + bend(&speeds.rpm, i, y).min(RISE * size)).powi(2) - size * size;
                losses[i * orders + n] * most
            };
            losses.iter().zip(twists).map(power_rise).sum::<f64>() * measure.within.weight(speeds.rpm[i])
        };
        let peak_at = |speed_rpm: f64, place, work: &mut Work| {
            let by_order = self.powers_at(design, measure, speed_rpm, work)?;
            let (order, order_value) = by_order.iter().enumerate().fold((0, 0.0), |m, (n, p)| if *p > m.1 { (n, *p) } else { m });
            let weight = measure.within.weight(speed_rpm);
            let value = by_order.iter().sum::<f64>() * weight;
            Ok(Peak { value, weight, over: Over::Power, speed_rpm, order, order_value, quantity, extremes: None, place })
        };
        let rises = (RISE_OF_SQUARES, rise);
        self.smooth_peaks((design, quantity), (speeds, &values), (LEAST_SHARE, rises), (value_at, peak_at), found, work)
    }

    /// Frequency of an order at a speed.
    pub(super) fn operating(&self, order: usize, speed_rpm: f64) -> Operating {
        Operating { omega: self.system.excitation.orders[order].omega(speed_rpm), shaft_speed: speed_rpm * RAD_PER_S_PER_RPM }
    }

    /// Derivatives of a power by the parameters of some absorbers: of their own laws, and of all twists.
    pub(super) fn power_gradients(
        &self,
        direct: &Direct,
        (design, absorbers): (&[Mounted], &[usize]),
        measure: &Measure,
        speed_rpm: f64,
        work: &mut Work,
    ) -> Result<Vec<Vec<f64>>, ResponseError> {
        let orders = self.system.orders();
        let mut y = vec![ZERO; orders];
        let mut gradients: Vec<Vec<f64>> = vec![Vec::new(); absorbers.len()];
        for i in measure.absorbers().filter(|i| *i < design.len()) {
            let Some(law) = design[i].absorber.law() else { continue };
            direct.at(design, Quantity::RingTwist(i), speed_rpm, &mut y, work)?;
            let all = direct.sensitivities(design, absorbers, Quantity::RingTwist(i), 0..orders, speed_rpm, work)?;
            for ((index, gradient), changes) in absorbers.iter().zip(&mut gradients).zip(all) {
                for (n, (y, changes)) in y.iter().zip(&changes).enumerate() {
                    let at = self.operating(n, speed_rpm);
                    gradient.resize(changes.len(), 0.0);
                    let damping = at.omega * law.dynamic_stiffness(at).im;
                    gradient.iter_mut().zip(changes).for_each(|(g, d)| *g += damping * (y.conj() * d).re);
                    if i == *index {
                        let own = law.derivatives(at);
                        gradient.iter_mut().zip(own).for_each(|(g, d)| *g += 0.5 * at.omega * d.im * y.norm_sqr());
                    }
                }
            }
        }
        Ok(gradients)
    }

    /// By those of absorber `index` alone.
    pub(super) fn power_gradient(
        &self,
        direct: &Direct,
        (design, index): (&[Mounted], usize),
        measure: &Measure,
        speed_rpm: f64,
        work: &mut Work,
    ) -> Result<Vec<f64>, ResponseError> {
        Ok(self.power_gradients(direct, (design, &[index]), measure, speed_rpm, work)?.swap_remove(0))
    }
}
