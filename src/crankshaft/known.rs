//! What evaluations of one design share: the extremes of a shaft's torque at a speed are the same for every criterion, and so is the path of a fillet.

use crate::numerics::C64;
use crate::numerics::synthesis::{Extremes, Synthesiser};
use std::cell::{Cell, RefCell};
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
    /// Neither its half peak-to-peak value nor the size of its middle is above these.
    AtMost(f64, f64),
    /// Its extremes.
    Exact(Extremes),
}

impl Known {
    /// The extremes of the torque of a shaft at a speed, rpm, where they may matter: nothing where `can_matter` says no to a half peak-to-peak value and a size of the
    /// middle that they do not exceed.
    pub(crate) fn extremes_if(
        &self,
        (shaft, speed_rpm): (usize, f64),
        synthesiser: &Synthesiser,
        phasors: &[C64],
        can_matter: impl Fn(f64, f64) -> bool,
    ) -> Option<Extremes> {
        let key = (shaft, speed_rpm.to_bits());
        match self.torques.borrow().get(&key) {
            Some(KnownTorque::Exact(extremes)) => {
                return can_matter(extremes.half_peak_to_peak, extremes.middle.abs()).then_some(*extremes);
            }
            Some(KnownTorque::AtMost(half, middle)) if !can_matter(*half, *middle) => return None,
            _ => {}
        }
        let bounds = Cell::new((f64::INFINITY, f64::INFINITY));
        let found = synthesiser.extremes_if(phasors, |half, middle| {
            bounds.set((half, middle));
            can_matter(half, middle)
        });
        let known = found.map_or(KnownTorque::AtMost(bounds.get().0, bounds.get().1), KnownTorque::Exact);
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
