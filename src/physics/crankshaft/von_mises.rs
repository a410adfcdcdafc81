//! The equivalent stress of von Mises at the locations of a crank over the working cycle.

use super::speed_table::At;
use super::stress_histories::{Histories, SampledTorque};
use super::{CriticalLocation, Family, Margin};

use crate::numerics::C64;

/// Where and when it is largest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LargestVonMises {
    /// Index of the location.
    pub location: usize,
    /// Pa.
    pub stress: f64,
    /// When: the sample, of so many over the working cycle from the firing of the first cylinder.
    pub sample: (usize, usize),
}

impl Histories {
    /// The largest of a location with the sample where it is: sqrt(sigma² + 3 tau²) of a nominal state with its factors, of a tensor by all its components.
    fn von_mises(&self, location: &CriticalLocation, at: At, torque: &SampledTorque) -> (f64, usize) {
        let [xx, yy, zz, xy, yz, zx] = self.whole(location, at, torque).components;
        let square = |j: usize| {
            let apart = (xx[j] - yy[j]).powi(2) + (yy[j] - zz[j]).powi(2) + (zz[j] - xx[j]).powi(2);
            0.5 * apart + 3.0 * (xy[j] * xy[j] + yz[j] * yz[j] + zx[j] * zx[j])
        };
        let most = (0..xx.len()).map(|j| (j, square(j))).fold((0, 0.0), |m, s| if s.1 > m.1 { s } else { m });
        (most.1.sqrt(), most.0)
    }
}

impl Margin {
    /// The largest equivalent stress of von Mises over the cycle and all locations that multiaxial criteria judge, at a speed under the torques of all shafts by order (none of those beside no throw). `None` where the study names no
    /// multiaxial criterion: only these ask for stresses over the cycle.
    pub fn largest_von_mises(&self, speed_rpm: f64, torques: &[&[C64]]) -> Option<LargestVonMises> {
        let (histories, at) = (self.histories.as_ref()?, self.place(speed_rpm));
        let sampled: Vec<SampledTorque> =
            torques.iter().enumerate().map(|(shaft, y)| histories.torque(y, self.mean_at(at, shaft))).collect();
        let judged = |l: &CriticalLocation| matches!(l.family, Family::Nominal | Family::UnitLoads);
        let all = self.locations.iter().enumerate().filter(|(_, l)| judged(l)).map(|(location, l)| {
            let (stress, sample) = histories.von_mises(l, at, &sampled[l.shaft]);
            LargestVonMises { location, stress, sample: (sample, histories.samples()) }
        });
        all.reduce(|m, s| if s.stress > m.stress { s } else { m })
    }
}
