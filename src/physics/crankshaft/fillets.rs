//! The worst of the locations of every fillet (its webs, and the shafts on both sides of a crankpin) at a speed.

use super::branch_and_bound::{Able, Next, worst};
use super::margin::{ROUNDING, multiaxially};
use super::stress_histories::{Path, SampledTorque};
use super::web_paths::WebPath;
use super::{Known, Margin, MarginCriterion, Torque, Used};
use crate::fatigue::multiaxial::bound::Within;
use std::cell::{Cell, OnceCell, RefCell};
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::rc::Rc;

/// Of a fillet with more points of stresses per unit load than this, the worst one counts at each speed; of others every point is a fillet of its own.
#[doc(hidden)]
pub const LISTED_POINTS: usize = 100;

/// A fillet by one criterion.
#[derive(Debug, Clone)]
#[doc(hidden)]
pub struct Fillet {
    /// Index of the criterion.
    pub criterion: usize,
    /// Its name.
    pub name: String,
    /// Its locations.
    locations: Vec<usize>,
}

/// The worst of each fillet at a speed.
#[derive(Debug, Clone)]
#[doc(hidden)]
pub struct Worst {
    /// In the order of the fillets.
    pub used: Vec<Used>,
    /// Paths over the cycle that multiaxial criteria judged in full: bounds spared the others.
    pub judged: u64,
}

impl Margin {
    /// All fillets: by criterion, then as the locations are listed.
    #[doc(hidden)]
    pub fn fillets(&self) -> Vec<Fillet> {
        let mut list: Vec<Fillet> = Vec::new();
        for criterion in 0..self.criteria.len() {
            let mut known: HashMap<&str, usize> = HashMap::new();
            for (i, location) in self.locations.iter().enumerate().filter(|(i, _)| self.judges(criterion, *i)) {
                let name = if location.points > LISTED_POINTS { &location.fillet } else { &location.name };
                match known.entry(name) {
                    Entry::Occupied(fillet) => list[*fillet.get()].locations.push(i),
                    Entry::Vacant(new) => {
                        new.insert(list.len());
                        list.push(Fillet { criterion, name: name.clone(), locations: vec![i] });
                    }
                }
            }
        }
        list
    }

    /// The location of each fillet that is used most, under the torques of all shafts at a speed. Of a multiaxial criterion only those are searched whose bound is above what another one
    /// uses.
    #[doc(hidden)]
    pub fn worst_of_each(&self, fillets: &[Fillet], speed_rpm: f64, torques: &[Torque]) -> Worst {
        let at = self.place(speed_rpm);
        let samples: Vec<OnceCell<SampledTorque>> = (0..torques.len()).map(|_| OnceCell::new()).collect();
        let outlines: RefCell<HashMap<usize, Within>> = RefCell::default();
        let paths: RefCell<HashMap<usize, Rc<Path>>> = RefCell::default();
        let webs: RefCell<HashMap<(usize, usize), Rc<WebPath>>> = RefCell::default();
        let (known, judged) = (Known::default(), Cell::new(0));
        let corners = self.criteria.iter().any(|c| matches!(c, MarginCriterion::Multiaxial(c) if c.asks_for_corners()));
        let larger = |most: Option<Used>, used: Used| match most {
            Some(most) if (most.value, used.location) >= (used.value, most.location) => Some(most),
            _ => Some(used),
        };
        let largest_use = |fillet: &Fillet| -> Option<Used> {
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
            let outline = |i: usize| histories.outline(&self.locations[i], at, sampled(i), 1.0)[0];
            let next = |i: usize, level: u8| match (&self.locations[i].unit_loads, level) {
                (Some(units), _) => {
                    let (web, shaft) = (self.locations[i].web(), self.locations[i].shaft);
                    let of_web = || Rc::new(histories.web_path(web, at, sampled(i), 1.0));
                    let web = webs.borrow_mut().entry((web, shaft)).or_insert_with(of_web).clone();
                    histories.next_of_point(word, (i, units), (&web, level), (0.0, &bound))
                }
                (None, 0) => Next::Bound(bound(outlines.borrow_mut().entry(i).or_insert_with(|| outline(i)))),
                (None, _) => Next::Evaluate,
            };
            let path = |i: usize| {
                let found = || {
                    let path = histories.path(&self.locations[i], at, sampled(i));
                    if let Path::Plane(state) = &path {
                        // another criterion asks for the corners, and then they serve this one, too
                        corners.then(|| state.corners());
                    }
                    Rc::new(path)
                };
                paths.borrow_mut().entry(i).or_insert_with(found).clone()
            };
            let shares = |i: usize| {
                judged.set(judged.get() + 1);
                self.shares(*criterion, histories, &path(i))
            };
            let used = |i: usize| multiaxially(histories, i, known.share((*criterion, i, speed_rpm), || shares(i)));
            worst(locations.iter().map(able).collect(), next, used)
        };
        Worst { used: fillets.iter().filter_map(largest_use).collect(), judged: judged.get() }
    }
}
