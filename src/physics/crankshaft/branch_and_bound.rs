//! The location that is used most among some, each known at first by a bound that costs little, then by others that cost more, and evaluated only where it may be the worst.

use super::Used;
use crate::numerics::ranked::{ByRank, Ranked};
use std::collections::BinaryHeap;

/// A location that may be used most, the one with the larger bound before another.
#[derive(Debug, Clone, Copy)]
pub(super) struct Able {
    pub location: usize,
    /// At least what it uses.
    pub bound: f64,
    /// How many closer bounds are known.
    pub level: u8,
}

/// What is known next of a location.
#[derive(Debug, Clone, Copy)]
pub(super) enum Next {
    /// A closer bound.
    Bound(f64),
    /// No closer bound: it has to be evaluated.
    Evaluate,
    /// That it does not count after all.
    Out,
}

impl Able {
    /// With a bound that costs little.
    pub fn new(location: usize, bound: f64) -> Self {
        Self { location, bound, level: 0 }
    }
}

impl Ranked for Able {
    /// That with the highest bound; of level ones the first as they are listed.
    fn rank(&self) -> (f64, u64) {
        (self.bound, self.location as u64)
    }
}

/// The worst, of level ones the first as they are listed. `next`: of a location of which so many closer bounds are known.
pub(super) fn worst(able: Vec<Able>, mut next: impl FnMut(usize, u8) -> Next, mut used: impl FnMut(usize) -> Used) -> Option<Used> {
    let mut most: Option<Used> = None;
    let mut able: BinaryHeap<ByRank<Able>> = able.into_iter().map(ByRank).collect();
    while let Some(ByRank(top)) = able.pop() {
        if most.is_some_and(|m| top.bound < m.value) {
            break;
        }
        match next(top.location, top.level) {
            Next::Bound(bound) => able.push(ByRank(Able { bound: bound.min(top.bound), level: top.level + 1, ..top })),
            Next::Out => {}
            Next::Evaluate => {
                let own = used(top.location);
                let holds = |m: &Used| m.value > own.value || (m.value == own.value && m.location < own.location);
                most = most.filter(holds).or(Some(own));
            }
        }
    }
    most
}
