//! Where motions of large amplitude may be: those of a ring whose spring is replaced by its mean over a sine of the motion's own amplitude (equivalent linearisation). They are starts for Newton's method, no
//! results.

use super::balance::Balance;
use super::linear::Linear;
use crate::absorber::Instant;
use crate::numerics::C64;
use crate::numerics::elementary::Elementary;
use crate::numerics::roots::roots;
use crate::units::RAD_PER_S_PER_RPM;
use nalgebra::DVector;
use std::convert::Infallible;
use std::f64::consts::TAU;

/// Amplitudes looked at, rad, by their logarithm; samples of a sine.
const LEAST: f64 = 1e-6;
const MOST: f64 = 10.0;
const AMPLITUDES: usize = 60;
const SAMPLES: usize = 32;

impl Balance<'_> {
    /// Motions at amplitudes that agree with themselves, where several do; none of laws that are no ring on a spring.
    pub(super) fn equivalent(&self, linear: &Linear) -> Vec<DVector<f64>> {
        if !self.equations().is_ring() {
            return Vec::new();
        }
        let sine: Vec<f64> = (0..SAMPLES).map(|i| (TAU * i as f64 / SAMPLES as f64).cosine()).collect();
        let mean_stiffness = |amplitude: f64| self.mean_stiffness((amplitude, &sine), linear.speed_rpm);
        let least = mean_stiffness(LEAST);
        let motion_at = |amplitude: f64| self.linear_motion(linear, mean_stiffness(amplitude) - least);
        let twist_amplitude =
            |x: &DVector<f64>| x.as_slice()[1..].as_chunks::<2>().0.iter().map(|c| C64::new(c[0], c[1]).norm_sqr()).sum::<f64>().sqrt();
        let mut excess = |x: f64| Ok::<f64, Infallible>(x - twist_amplitude(&motion_at(x.exponential())).max(LEAST).logarithm());
        let most = self.equations().largest_twist().unwrap_or(MOST);
        let Ok(found) = roots(LEAST.logarithm(), most.logarithm(), AMPLITUDES, &mut excess);
        if found.len() < 2 { Vec::new() } else { found.into_iter().map(|x| motion_at(x.exponential())).collect() }
    }

    /// Mean stiffness of the spring over a sine of this amplitude (rad): 1/(pi A) times the integral of T(A cos phi) cos phi over a period, N m/rad.
    fn mean_stiffness(&self, (amplitude, sine): (f64, &[f64]), speed_rpm: f64) -> f64 {
        let shaft_speed = speed_rpm * RAD_PER_S_PER_RPM;
        let torque = |twist: f64| self.equations().reactions(&Instant { twist, shaft_speed, ..Instant::default() }).0.value;
        sine.iter().map(|cos| torque(amplitude * cos) * cos).sum::<f64>() * 2.0 / (sine.len() as f64 * amplitude)
    }
}
