//! What evaluations of one design share: the extremes of a shaft's torque at a speed are the same for every criterion, and so is the path of a fillet.

use crate::numerics::C64;
use crate::numerics::synthesis::{Extremes, Most, Precision, Synthesiser};
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

/// Known torques and shares of one design. Another design needs another.
#[derive(Debug, Default)]
pub struct Known {
    /// By shaft and speed.
    torques: RefCell<HashMap<(usize, u64), KnownTorque>>,
    /// By location and speed: share of the strength by each multiaxial criterion.
    shares: RefCell<HashMap<(usize, u64), Shares>>,
}

/// By criterion.
type Shares = Rc<[f64]>;

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

    /// Shares of a location at a speed, rpm: `find` where they are not known yet.
    pub(super) fn shares(&self, location: usize, speed_rpm: f64, find: impl FnOnce() -> Shares) -> Shares {
        let known = self.shares.borrow().get(&(location, speed_rpm.to_bits())).cloned();
        known.unwrap_or_else(|| {
            let found = find();
            self.shares.borrow_mut().insert((location, speed_rpm.to_bits()), found.clone());
            found
        })
    }
}
