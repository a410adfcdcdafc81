//! Peaks over speed of the temperature that an absorber reaches from cold, with their gradients through the balance of heat.

use super::local_maxima;
use super::measure::{Measure, Over};
use super::peak::Peak;
use super::peak_search::{LargestPeaks, PeakFinder};
use super::sharp_resonances::{RISE_OF_SQUARES, resolved_values};
use super::speeds::Speeds;
use crate::absorber::Mounted;
use crate::absorber::mounted::with_law;
use crate::numerics::C64;
use crate::response::operation::{AtSpeed, Follower, Rule};
use crate::response::{Quantity, ResponseError, Work};
use crate::units::RAD_PER_S_PER_RPM;

/// Temperatures count from this one up, °C: a limit is a ratio.
const LEAST: f64 = 1e-3;
/// Steps of differences: of a temperature, K, and of a parameter, relative.
const STEP_K: f64 = 1e-3;
const STEP: f64 = 1e-5;
/// No surroundings are colder than this below zero, °C: a temperature has risen by no more than it lies above.
const COLDEST: f64 = 100.0;
/// Nearer to a fold, where R dP/dT reaches one, a balance has no slope to speak of.
const FOLD: f64 = 0.05;

impl PeakFinder<'_> {
    fn at_speed<'s>(&'s self, of: &Follower<'s>, speed_rpm: f64) -> AtSpeed<'s> {
        AtSpeed::new((&self.direct, &self.synthesiser), of, Rule::HalfPeakToPeak, speed_rpm, None)
    }

    /// What an absorber reaches at a speed, °C.
    fn reached(&self, of: &Follower, speed_rpm: f64) -> Result<f64, ResponseError> {
        Ok(self.at_speed(of, speed_rpm).reached()?.unwrap_or(0.0).max(LEAST))
    }

    /// By how much an order may raise the temperature of absorber `index` between known speeds beside a sharp resonance: by its share of the power at the reference.
    fn rises<'s>(
        &self,
        design: &[Mounted],
        index: usize,
        (speeds, values): (&'s Speeds, &'s [f64]),
        work: &mut Work,
    ) -> Result<impl Fn(usize, usize) -> f64 + 's, ResponseError> {
        let orders = self.system.orders();
        let law = design[index].absorber.law();
        let known: &[f64] = if speeds.sharp.is_empty() { &[] } else { &speeds.rpm };
        let twists = self.direct.at_each(design, &[Quantity::RingTwist(index)], known, work)?.swap_remove(0);
        let power = |(at, y): (usize, &C64)| {
            law.map_or(0.0, |law| law.dissipated_power(self.operating(at % orders, speeds.rpm[at / orders]), y.norm_sqr()))
        };
        let powers: Vec<f64> = twists.iter().enumerate().map(power).collect();
        Ok(move |i: usize, n: usize| {
            let share = |i: usize| {
                let all = &powers[i * orders..(i + 1) * orders];
                all[n] / all.iter().sum::<f64>().max(f64::MIN_POSITIVE) * (values[i] + COLDEST)
            };
            RISE_OF_SQUARES * share(i).max(share(i + 1))
        })
    }

    /// Local maxima on a part of the range, of every absorber of the measure whose material says what cools it.
    pub(super) fn temperatures(
        &self,
        design: &[Mounted],
        measure: &Measure,
        speeds: &Speeds,
        found: &mut LargestPeaks,
        work: &mut Work,
    ) -> Result<(), ResponseError> {
        for i in measure.absorbers() {
            let Some(of) = Follower::cooled(design, i) else { continue };
            let quantity = Quantity::RingTwist(i);
            let weight = |speed: f64| measure.within.weight(speed);
            let values = speeds.rpm.iter().map(|s| Ok(self.reached(&of, *s)? * weight(*s))).collect::<Result<Vec<f64>, ResponseError>>()?;
            let wanted = found.keep * values.iter().copied().fold(found.best, f64::max);
            let rise = self.rises(design, i, (speeds, &values), work)?;
            let can_matter = (0..self.system.orders(), |value| value + RISE_OF_SQUARES * (value + COLDEST), rise);
            let finer = resolved_values((speeds, &values), wanted, can_matter, |speed| Ok(self.reached(&of, speed)? * weight(speed)))?;
            let (speeds, values) = finer.as_ref().map_or((speeds, &values), |f| (&f.0, &f.1));
            let top = values.iter().copied().fold(found.best, f64::max);
            for candidate in local_maxima::maxima(&speeds.rpm, values) {
                let value_at = |speed: f64, _: &mut Work| Ok(self.reached(&of, speed)? * weight(speed));
                let wanted = found.keep * found.best.max(top);
                let Some((speed_rpm, place)) = self.refined((design, quantity), candidate, speeds, wanted, value_at, work)? else {
                    continue;
                };
                let (value, weight) = (self.reached(&of, speed_rpm)? * weight(speed_rpm), weight(speed_rpm));
                let (order, order_value) = (0, 0.0);
                found.put(Peak { value, weight, over: Over::Temperature, speed_rpm, order, order_value, quantity, extremes: None, place });
            }
        }
        Ok(())
    }

    /// Derivatives by the parameters of absorber `index`. T = T0 + R P(T, p) gives dT/dp = R dP/dp/(1 - R dP/dT), with dP/dp at that temperature in closed form; of an absorber that overheats it is R dP/dp at
    /// its limit. Where the material follows its strain besides, by differences of the balance.
    pub(super) fn temperature_gradient(
        &self,
        (design, index): (&[Mounted], usize),
        measure: &Measure,
        peak: &Peak,
        work: &mut Work,
    ) -> Result<Vec<f64>, ResponseError> {
        let Quantity::RingTwist(own) = peak.quantity else { return Ok(Vec::new()) };
        let Some(of) = Follower::cooled(design, own) else { return Ok(Vec::new()) };
        let Some((thermal, follows_strain)) = of.law.material().and_then(|m| Some((m.thermal?, m.amplitude.is_some()))) else {
            return Ok(Vec::new());
        };
        if follows_strain {
            return self.temperature_differences((design, index), own, peak);
        }
        let at = self.at_speed(&of, peak.speed_rpm);
        let (base, resistance) = thermal.cooling.at(peak.speed_rpm * RAD_PER_S_PER_RPM);
        let celsius = peak.value / peak.weight;
        let overheats = celsius > thermal.cooling.limit;
        let slope = if overheats { 0.0 } else { (at.power_at(celsius + STEP_K)? - at.power_at(celsius - STEP_K)?) / (2.0 * STEP_K) };
        let held = (1.0 - resistance * slope).max(FOLD);
        if celsius <= LEAST.max(base) {
            return Ok(Vec::new());
        }
        let law = at.at(Some(celsius.min(thermal.cooling.limit)))?;
        let warm = with_law(design, own, |_| law.clone());
        let power = Measure { quantities: vec![peak.quantity], over: Over::Power, within: measure.within.clone() };
        let gradient = self.power_gradient(&self.direct, (&warm, index), &power, peak.speed_rpm, work)?;
        Ok(gradient.into_iter().map(|g| peak.weight * resistance * g / held).collect())
    }

    fn temperature_differences(&self, (design, index): (&[Mounted], usize), own: usize, peak: &Peak) -> Result<Vec<f64>, ResponseError> {
        let Some(law) = design[index].absorber.law() else { return Ok(Vec::new()) };
        let values = law.values();
        let temperature_at = |p: usize, share: f64| -> Result<f64, ResponseError> {
            let mut moved = values.clone();
            moved[p] *= 1.0 + share;
            let moved = with_law(design, index, |law| law.rebuilt(&moved));
            Follower::cooled(&moved, own).map_or(Ok(0.0), |of| self.reached(&of, peak.speed_rpm))
        };
        let one = |p: usize| {
            if values[p] == 0.0 {
                Ok(0.0)
            } else {
                Ok(peak.weight * (temperature_at(p, STEP)? - temperature_at(p, -STEP)?) / (2.0 * STEP * values[p]))
            }
        };
        (0..values.len()).map(one).collect()
    }
}
