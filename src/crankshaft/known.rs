//! What evaluations of one design share: the extremes of a shaft's torque at a speed are the same for every criterion, and so is the path of a fillet.

use super::speed_table::At;
use crate::fatigue::multiaxial::bound::Within;
use crate::numerics::C64;
use crate::numerics::synthesis::{Extremes, Most, Precision, Synthesiser};
use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

/// Known torques and shares of one design. Another design needs another.
#[derive(Debug, Default)]
pub struct Known {
    /// By shaft and speed.
    torques: RefCell<HashMap<(usize, u64), KnownTorque>>,
    /// By location and speed (the bits of a positive number grow with it).
    paths: RefCell<HashMap<usize, BTreeMap<u64, Rc<KnownPath>>>>,
}

/// What is known of the path of a location at a speed.
#[derive(Debug)]
pub(super) struct KnownPath {
    /// Share of the strength by each multiaxial criterion, zero by the others.
    pub shares: Vec<f64>,
    /// Of a nominal state: what it does not exceed.
    pub within: Option<Within>,
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
        (synthesiser, precision): (&Synthesiser, Precision),
        phasors: &[C64],
        can_matter: impl Fn(Most) -> bool,
    ) -> (Option<Extremes>, Most) {
        let key = (shaft, speed_rpm.to_bits());
        match self.torques.borrow().get(&key) {
            Some(KnownTorque::Found(extremes, most)) => return (can_matter(Most::of(extremes)).then_some(*extremes), *most),
            Some(KnownTorque::AtMost(most)) if !can_matter(*most) => return (None, *most),
            _ => {}
        }
        let found = synthesiser.extremes_if(phasors, precision, can_matter);
        let known = found.0.map_or(KnownTorque::AtMost(found.1), |extremes| KnownTorque::Found(extremes, found.1));
        self.torques.borrow_mut().insert(key, known);
        found
    }

    /// The path of a location at a speed, rpm, where it is known.
    pub(super) fn path(&self, location: usize, speed_rpm: f64) -> Option<Rc<KnownPath>> {
        self.paths.borrow().get(&location)?.get(&speed_rpm.to_bits()).cloned()
    }

    /// Its known paths at the next speeds below and above, rpm.
    pub(super) fn beside(&self, location: usize, speed_rpm: f64) -> [Option<Rc<KnownPath>>; 2] {
        let paths = self.paths.borrow();
        let Some(own) = paths.get(&location) else { return [None, None] };
        let bits = speed_rpm.to_bits();
        [own.range(..bits).next_back(), own.range(bits + 1..).next()].map(|found| found.map(|(_, path)| path.clone()))
    }

    /// Keeps a path.
    pub(super) fn keep(&self, location: usize, speed_rpm: f64, path: &Rc<KnownPath>) {
        self.paths.borrow_mut().entry(location).or_default().insert(speed_rpm.to_bits(), path.clone());
    }
}
