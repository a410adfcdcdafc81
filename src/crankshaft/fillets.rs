//! The worst of the locations of every fillet (its webs, and the shafts on both sides of a crankpin) at a speed.

use super::margin::{ROUNDING, multiaxially};
use super::stress_histories::{Path, SampledTorque};
use super::worst_first::{Able, worst};
use super::{Known, Margin, MarginCriterion, Torque, Used};
use crate::fatigue::multiaxial::bound::Within;
use std::cell::OnceCell;

/// A fillet by one criterion.
#[derive(Debug, Clone)]
pub(crate) struct Fillet {
    /// Index of the criterion.
    pub criterion: usize,
    /// Its name.
    pub name: String,
    /// Its locations.
    locations: Vec<usize>,
}

impl Margin {
    /// All fillets: by criterion, then as the locations are listed.
    pub(crate) fn fillets(&self) -> Vec<Fillet> {
        let mut list: Vec<Fillet> = Vec::new();
        for criterion in 0..self.criteria.len() {
            for (i, location) in self.locations.iter().enumerate().filter(|(i, _)| self.judges(criterion, *i)) {
                match list.iter_mut().find(|f| f.criterion == criterion && f.name == location.name) {
                    Some(fillet) => fillet.locations.push(i),
                    None => list.push(Fillet { criterion, name: location.name.clone(), locations: vec![i] }),
                }
            }
        }
        list
    }

    /// The location of each fillet that is used most, under the torques of all shafts at a speed. Of a multiaxial criterion only those are searched whose bound is above what another one
    /// uses.
    pub(crate) fn worst_of_each(&self, fillets: &[Fillet], speed_rpm: f64, torques: &[Torque]) -> Vec<Used> {
        let at = self.place(speed_rpm);
        let samples: Vec<OnceCell<SampledTorque>> = (0..torques.len()).map(|_| OnceCell::new()).collect();
        let outlines: Vec<OnceCell<Option<Within>>> = vec![OnceCell::new(); self.locations.len()];
        let paths: Vec<OnceCell<Path>> = (0..self.locations.len()).map(|_| OnceCell::new()).collect();
        let known = Known::default();
        let corners = self.criteria.iter().any(|c| matches!(c, MarginCriterion::Multiaxial(c) if c.asks_for_corners()));
        let larger = |most: Option<Used>, used: Used| match most {
            Some(most) if (most.value, used.location) >= (used.value, most.location) => Some(most),
            _ => Some(used),
        };
        let of = |fillet: &Fillet| -> Option<Used> {
            let Fillet { criterion, locations, .. } = fillet;
            let torque_of = |i: usize| &torques[self.locations[i].shaft];
            let Some((word, histories)) = self.multiaxial(*criterion) else {
                return locations.iter().map(|i| self.used(*criterion, *i, speed_rpm, torque_of(*i))).fold(None, larger);
            };
            let bound = |within: &Within| histories.at_most(word, within) * (1.0 + ROUNDING);
            let able = |i: &usize| Able::new(*i, bound(&self.by_ranges(histories, *i, at, torque_of(*i), 1.0)));
            let sampled = |i: usize| {
                let shaft = self.locations[i].shaft;
                samples[shaft].get_or_init(|| histories.torque(torques[shaft].phasors, self.mean_at(at, shaft)))
            };
            let outline = |i: usize| histories.outline(&self.locations[i], at, sampled(i), 1.0).map(|[own, _]| own);
            let closer = |i: usize| Some(outlines[i].get_or_init(|| outline(i)).as_ref().map_or(f64::INFINITY, bound));
            let path = |i: usize| {
                paths[i].get_or_init(|| {
                    let path = histories.path(&self.locations[i], at, sampled(i));
                    if let Path::Plane(state) = &path {
                        // another criterion asks for the corners, and then they serve this one, too
                        corners.then(|| state.corners());
                    }
                    path
                })
            };
            let shares = |i: usize| self.shares(*criterion, histories, path(i));
            let used = |i: usize| multiaxially(histories, i, known.share((*criterion, i, speed_rpm), || shares(i)));
            worst(locations.iter().map(able).collect(), closer, used)
        };
        fillets.iter().filter_map(of).collect()
    }
}
