//! A proof of an optimum: no design within the bounds is better by more than a gap.
//!
//! The box of the free parameters is cut into smaller ones until each is excluded. At one speed an output is a Möbius function of the dynamic stiffness of the ring, so a first-order Taylor model of
//! each order's phasor over a box is known with its rest; a measure at that speed is at least a linear function of the parameters over the box, and no less than that over all speeds. A box goes where
//! such a function, or a convex combination of several (of other speeds, limits and conditions), is nowhere below what the optimum is to be better than. Half the range of a sum of orders is at least half
//! the difference of its values at two angles; it is at least pi/4 of a single order's amplitude, not that amplitude.
//!
//! Speeds come as they are needed: where the middle of a box looks better than the optimum at all speeds so far, its true peaks are found, and their speeds join; where it is better, the search goes
//! on from there. A bound over some speeds, and without what has no enclosure, is a bound over all.
//!
//! The value of the optimum itself is proved from above: between any two speeds its measure is nowhere higher by more than the gap.

mod asked;
mod at_speed;
mod boxes;
mod exclusions;
mod form;
mod over_speeds;
mod pairs;
mod settle;
mod verdict;
mod worst;

pub use exclusions::{ExcludingSpeed, Exclusion, Exclusions, exclusions};
pub use over_speeds::upper_bound;
pub use settle::{settle, settle_front};
pub use verdict::{Effort, Proof, Ranges, Reason, Verdict};
pub use worst::{WorstBound, worst_bound};
