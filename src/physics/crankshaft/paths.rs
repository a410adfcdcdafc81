//! The margin by multiaxial criteria, which ask for the path of a location over the cycle: only paths that may be used most are searched.

use super::branch_and_bound::{Able, Next, worst};
use super::evaluation_cache::Outline;
use super::margin::{ROUNDING, multiaxially};
use super::speed_table::At;
use super::stress_histories::{Histories, Path};
use super::unit_loads::UnitLoads;
use super::web_paths::WebPath;
use super::{Known, Margin, MarginCriterion, Torque, Used};
use crate::fatigue::multiaxial::{self, Criterion, bound::Within};
use crate::numerics::synthesis::Extremes;
use crate::numerics::{C64, abs_sums};
use std::cell::{OnceCell, RefCell};
use std::collections::HashMap;
use std::rc::Rc;

impl Histories {
    /// What is known next of a location with stresses per unit load, of which so many closer bounds are known; `wanted`: that it does not count below, however far its torque rises.
    pub(super) fn next_of_point(
        &self,
        word: Criterion,
        (location, units): (usize, &UnitLoads),
        (web, level): (&WebPath, u8),
        (wanted, bound): (f64, &impl Fn(&Within) -> f64),
    ) -> Next {
        let Some(point) = self.bounds.point(location) else { return Next::Evaluate };
        match level {
            0 => {
                let own = bound(&web.within(word, point));
                let counts = own >= wanted || bound(&web.risen().within(word, point)) >= wanted;
                if counts { Next::Bound(own) } else { Next::Out }
            }
            1 => web.closely(word, point, units).map_or(Next::Evaluate, |within| Next::Bound(bound(&within))),
            _ => Next::Evaluate,
        }
    }
}

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
        let own = Known::default();
        let known = known.unwrap_or(&own);
        let samples = OnceCell::new();
        let samples = || samples.get_or_init(|| histories.torque(torque.phasors, self.mean_at(at, shaft)));
        let mut able = Vec::new();
        for i in self.spots_of(criterion, shaft) {
            let risen = bound(&self.by_ranges(histories, i, at, torque, rise));
            if risen >= wanted {
                let own = if rise == 1.0 { risen } else { bound(&self.by_ranges(histories, i, at, torque, 1.0)) };
                able.push(Able::new(i, own));
            }
        }
        let phasors: OnceCell<Rc<[C64]>> = OnceCell::new();
        let outlined = |i: usize| {
            let outline = match known.outline(i, speed_rpm, rise) {
                Ok(outline) => outline,
                Err(beside) => {
                    if beside.iter().flatten().any(|other| bound(&self.by_neighbour(histories, (i, at), (torque, rise), other)) < wanted) {
                        return Next::Out;
                    }
                    let [within, risen] = histories.outline(&self.locations[i], at, samples(), rise);
                    let torque = phasors.get_or_init(|| torque.phasors.into()).clone();
                    let outline = Rc::new(Outline { within, risen: (rise, risen), at, torque });
                    known.keep(i, speed_rpm, outline.clone());
                    outline
                }
            };
            let own = bound(&outline.within);
            if own.max(bound(&outline.risen.1)) >= wanted { Next::Bound(own) } else { Next::Out }
        };
        let webs = RefCell::new(HashMap::new());
        let next = |i: usize, level: u8| match (&self.locations[i].unit_loads, level) {
            (Some(units), _) => {
                let of_web = || Rc::new(histories.web_path(self.locations[i].web(), at, samples(), rise));
                let web: Rc<WebPath> = webs.borrow_mut().entry(self.locations[i].web()).or_insert_with(of_web).clone();
                histories.next_of_point(word, (i, units), (&web, level), (wanted, &bound))
            }
            (None, 0) => outlined(i),
            (None, _) => Next::Evaluate,
        };
        let shares = |i: usize| self.shares(criterion, histories, &histories.path(&self.locations[i], at, samples()));
        let used = |i: usize| multiaxially(histories, i, known.share((criterion, i, speed_rpm), || shares(i)));
        worst(able, next, used)
    }

    /// What a location does not exceed where its torque is up to so many times as large.
    pub(super) fn by_ranges(&self, histories: &Histories, location: usize, at: At, torque: &Torque, rise: f64) -> Within {
        let s = &self.locations[location];
        let Extremes { half_peak_to_peak, middle, .. } = torque.extremes;
        let largest = self.mean_at(at, s.shaft).abs() + rise * (middle.abs() + half_peak_to_peak);
        histories.bounds.by_ranges(location, at, rise * half_peak_to_peak, largest)
    }

    /// What a location does not exceed where its torque is up to so many times as large, by what is known at another speed.
    fn by_neighbour(&self, histories: &Histories, (location, at): (usize, At), (torque, rise): (&Torque, f64), other: &Outline) -> Within {
        let shaft = self.locations[location].shaft;
        let change =
            abs_sums::of_difference(torque.phasors, &other.torque) + (self.mean_at(at, shaft) - self.mean_at(other.at, shaft)).abs();
        // on its way to the next speed the torque changes by as much again, at most
        let Extremes { half_peak_to_peak, middle, .. } = torque.extremes;
        let more = if rise > 1.0 { (rise - 1.0) * (half_peak_to_peak + middle.abs()) } else { 0.0 };
        histories.bounds.by_another(location, (at, other.at), &other.within, change + more)
    }

    /// Share of the strength that a path uses by a multiaxial criterion, and by others that cost nothing besides, each with its index.
    pub(super) fn shares(&self, criterion: usize, histories: &Histories, path: &Path) -> Vec<(usize, f64)> {
        let multiaxial_criterion = |c: &MarginCriterion| if let MarginCriterion::Multiaxial(c) = c { Some(*c) } else { None };
        let searched = |c: &MarginCriterion| multiaxial_criterion(c).is_some_and(|c| Histories::is_searched(c, path));
        let together = searched(&self.criteria[criterion]);
        let asked: Vec<usize> =
            (0..self.criteria.len()).filter(|i| *i == criterion || (together && searched(&self.criteria[*i]))).collect();
        let words: Vec<multiaxial::Criterion> = asked.iter().filter_map(|i| multiaxial_criterion(&self.criteria[*i])).collect();
        asked.into_iter().zip(histories.shares(&words, path)).collect()
    }
}
