//! What evaluations of one design share: the extremes of a shaft's torque at a speed are the same for every criterion, and so is the path of a fillet.

use super::speed_table::At;
use crate::fatigue::multiaxial::bound::Within;
use crate::numerics::C64;
use crate::numerics::extremes::Most;
use crate::numerics::lazy_extremes::Screen;
use crate::numerics::synthesis::Extremes;
use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

/// Known torques and shares of one design. Another design needs another.
#[derive(Debug, Default)]
pub struct Known {
    /// By shaft and speed.
    torques: RefCell<HashMap<(usize, u64), KnownTorque>>,
    /// By location and speed (the bits of a positive number grow with it).
    outlines: RefCell<HashMap<usize, BTreeMap<u64, Rc<Outline>>>>,
    /// Of the strength, by multiaxial criterion, location and speed.
    shares: RefCell<HashMap<(usize, usize, u64), f64>>,
}

/// What the path of a nominal state at a speed does not exceed.
#[derive(Debug, Clone)]
pub(super) struct Outline {
    /// Its own.
    pub within: Within,
    /// Where its torque is up to so many times as large.
    pub risen: (f64, Within),
    /// Its speed.
    pub at: At,
    /// Orders of the torque that it bears.
    pub torque: Rc<[C64]>,
}

/// What is known of a torque.
#[derive(Debug, Clone, Copy)]
enum KnownTorque {
    /// Bounds of its extremes.
    AtMost(Most),
    /// Its extremes, as right as was asked, and bounds of them.
    Found(Extremes, Most),
}

impl Known {
    /// The extremes of the torque of a shaft at a speed, rpm, where they may matter: nothing where `can_matter` says no to bounds of them, which come with them.
    pub(crate) fn extremes_if(
        &self,
        (shaft, speed_rpm): (usize, f64),
        screen: &mut Screen,
        phasors: &[C64],
        can_matter: impl Fn(Most) -> bool,
    ) -> (Option<Extremes>, Most) {
        let key = (shaft, speed_rpm.to_bits());
        match self.torques.borrow().get(&key) {
            Some(KnownTorque::Found(extremes, most)) => return (can_matter(Most::of(extremes)).then_some(*extremes), *most),
            Some(KnownTorque::AtMost(most)) if !can_matter(*most) => return (None, *most),
            _ => {}
        }
        let found = screen.extremes_if(phasors, can_matter);
        let known = found.0.map_or(KnownTorque::AtMost(found.1), |extremes| KnownTorque::Found(extremes, found.1));
        self.torques.borrow_mut().insert(key, known);
        found
    }

    /// The outline of a location at a speed, rpm, with a rise of this or more; else those at the next speeds below and above.
    pub(super) fn outline(&self, location: usize, speed_rpm: f64, rise: f64) -> Result<Rc<Outline>, [Option<Rc<Outline>>; 2]> {
        let outlines = self.outlines.borrow();
        let Some(own) = outlines.get(&location) else { return Err([None, None]) };
        let bits = speed_rpm.to_bits();
        if let Some(known) = own.get(&bits).filter(|o| o.risen.0 >= rise) {
            return Ok(known.clone());
        }
        Err([own.range(..bits).next_back(), own.range(bits + 1..).next()].map(|found| found.map(|(_, outline)| outline.clone())))
    }

    /// Keeps an outline.
    pub(super) fn keep(&self, location: usize, speed_rpm: f64, outline: Rc<Outline>) {
        self.outlines.borrow_mut().entry(location).or_default().insert(speed_rpm.to_bits(), outline);
    }

    /// Share of the strength that a location uses by a multiaxial criterion at a speed, rpm. `find`: by that criterion and others, with their indices.
    pub(super) fn share(&self, (criterion, location, speed_rpm): (usize, usize, f64), find: impl FnOnce() -> Vec<(usize, f64)>) -> f64 {
        let key = |criterion: usize| (criterion, location, speed_rpm.to_bits());
        if let Some(share) = self.shares.borrow().get(&key(criterion)) {
            return *share;
        }
        let found = find();
        self.shares.borrow_mut().extend(found.iter().map(|(criterion, share)| (key(*criterion), *share)));
        found.iter().find(|f| f.0 == criterion).map_or(0.0, |f| f.1)
    }
}
