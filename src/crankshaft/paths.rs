//! The margin by multiaxial criteria, which ask for the path of a location over the cycle: only paths that may be used most are searched.

use super::known::KnownPath;
use super::margin::ROUNDING;
use super::speed_table::At;
use super::stress_histories::{Histories, Path};
use super::{Known, Margin, MarginCriterion, Torque, Used};
use crate::fatigue::Cycle;
use crate::fatigue::multiaxial::{self, bound::Within};
use crate::numerics::magnitudes;
use crate::numerics::synthesis::Extremes;
use std::rc::Rc;

impl Margin {
    /// The location of a shaft that is used most by a multiaxial criterion, among those that may be used as much as `wanted` where the torque is up to `rise` times as large.
    pub(super) fn most_used_path(
        &self,
        criterion: usize,
        (shaft, speed_rpm): (usize, f64),
        torque: &Torque,
        (rise, wanted): (f64, f64),
        known: Option<&Known>,
    ) -> Option<Used> {
        let (word, histories) = self.multiaxial(criterion)?;
        let at = self.place(speed_rpm);
        let bound = |within: &Within| histories.at_most(word, within) * (1.0 + ROUNDING);
        // those that may be used most first: the others need no history then
        let mut able: Vec<(f64, usize)> = Vec::new();
        for i in self.spots_of(criterion, shaft) {
            let risen = self.by_ranges(histories, i, at, torque, rise);
            if bound(&risen) < wanted {
                continue;
            }
            let within = self.by_ranges(histories, i, at, torque, 1.0);
            let [within, risen] = known
                .map_or([within, risen], |known| self.by_neighbours(histories, (i, speed_rpm), (torque, rise), known, [within, risen]));
            if bound(&risen) >= wanted {
                able.push((bound(&within), i));
            }
        }
        able.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut most: Option<Used> = None;
        let mut whole: Option<(Vec<f64>, Rc<[_]>)> = None;
        for (bound, location) in able {
            if most.is_some_and(|m| bound < m.value) {
                break;
            }
            let path = known.and_then(|known| known.path(location, speed_rpm)).unwrap_or_else(|| {
                let (samples, phasors) =
                    whole.get_or_insert_with(|| (histories.torque(torque.phasors, self.mean_at(at, shaft)), torque.phasors.into()));
                let (shares, within) = self.judged(histories, location, at, samples);
                let path = Rc::new(KnownPath { shares, within, at, torque: phasors.clone() });
                if let Some(known) = known {
                    known.keep(location, speed_rpm, &path);
                }
                path
            });
            let used = self.used_as(criterion, location, &path.shares);
            most = most.filter(|m| m.value >= used.value).or(Some(used));
        }
        most
    }

    /// What a location does not exceed where its torque is up to so many times as large.
    fn by_ranges(&self, histories: &Histories, location: usize, at: At, torque: &Torque, rise: f64) -> Within {
        let s = &self.locations[location];
        let Extremes { half_peak_to_peak, middle, .. } = torque.extremes;
        let largest = self.mean_at(at, s.shaft).abs() + rise * (middle.abs() + half_peak_to_peak);
        histories.bounds.by_ranges((location, s), at, rise * half_peak_to_peak, largest)
    }

    /// The same bounds, of the torque itself and of one that is up to `rise` times as large, no further than paths known at other speeds allow.
    fn by_neighbours(
        &self,
        histories: &Histories,
        (location, speed_rpm): (usize, f64),
        (torque, rise): (&Torque, f64),
        known: &Known,
        [mut within, mut risen]: [Within; 2],
    ) -> [Within; 2] {
        let (at, shaft) = (self.place(speed_rpm), self.locations[location].shaft);
        let Extremes { half_peak_to_peak, middle, .. } = torque.extremes;
        for path in known.beside(location, speed_rpm).into_iter().flatten() {
            let Some(other) = &path.within else { continue };
            let change =
                magnitudes::of_difference(torque.phasors, &path.torque) + (self.mean_at(at, shaft) - self.mean_at(path.at, shaft)).abs();
            let by = |change: f64| histories.bounds.by_another(location, (at, path.at), other, change);
            within = within.and(&by(change));
            // on its way to the next speed the torque changes by as much again, at most
            let more = if rise > 1.0 { change + (rise - 1.0) * (half_peak_to_peak + middle.abs()) } else { 0.0 };
            risen = risen.and(&by(change + more));
        }
        [within, risen]
    }

    /// At least the share that a location uses by a multiaxial criterion.
    pub(super) fn bound_of(&self, criterion: usize, location: usize, speed_rpm: f64, torque: &Torque) -> f64 {
        let Some((word, histories)) = self.multiaxial(criterion) else { return f64::INFINITY };
        histories.at_most(word, &self.by_ranges(histories, location, self.place(speed_rpm), torque, 1.0)) * (1.0 + ROUNDING)
    }

    /// The torque of a shaft at every sample, N m; of multiaxial criteria only.
    pub(super) fn whole_torque(&self, shaft: usize, speed_rpm: f64, torque: &Torque) -> Vec<f64> {
        let mean = self.mean_at(self.place(speed_rpm), shaft);
        self.histories.as_ref().map_or_else(Vec::new, |h| h.torque(torque.phasors, mean))
    }

    /// Share of the strength that a location uses by each multiaxial criterion, under a torque at every sample; zero by the others.
    pub(super) fn shares_of(&self, location: usize, speed_rpm: f64, torque: &[f64]) -> Vec<f64> {
        let none = || vec![0.0; self.criteria.len()];
        self.histories.as_ref().map_or_else(none, |h| self.judged(h, location, self.place(speed_rpm), torque).0)
    }

    /// A location by a multiaxial criterion, of the shares that it uses.
    pub(super) fn used_as(&self, criterion: usize, location: usize, shares: &[f64]) -> Used {
        let amplitude = self.histories.as_ref().map_or(0.0, |h| h.equivalent(shares[criterion]));
        Used { location, value: shares[criterion], slopes: (0.0, 0.0), cycle: Cycle { amplitude, mean: 0.0 } }
    }

    /// Share of the strength that a location uses by each criterion that asks for its path, zero by the others; and what the path of a nominal state does not exceed.
    pub(super) fn judged(&self, histories: &Histories, location: usize, at: At, torque: &[f64]) -> (Vec<f64>, Option<Within>) {
        let path = histories.path(&self.locations[location], at, torque);
        let multiaxial = |c: &MarginCriterion| if let MarginCriterion::Multiaxial(c) = c { Some(*c) } else { None };
        let asked: Vec<multiaxial::Criterion> = self.criteria.iter().filter_map(multiaxial).collect();
        let mut used = histories.used(&asked, &path).into_iter();
        let shares = self.criteria.iter().map(|c| multiaxial(c).and_then(|_| used.next()).unwrap_or(0.0)).collect();
        (shares, if let Path::Plane(state) = &path { Some(state.within()) } else { None })
    }
}
