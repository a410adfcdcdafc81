//! Piston pin: a beam as long as the bore, loaded and carried over half of its length each; M = P B/8 \[Fialho & Almeida 2019\] eq. (47).

use super::cycle::Cycle;
use super::section::{Moments, Swing};

/// Moments in the middle of the pin.
pub fn moments(cycle: &Cycle, bore: f64) -> Moments {
    let moment = || cycle.rod_tension_small.iter().map(|p| p * bore / 8.0);
    Moments { bending: [Swing::of(moment()), Swing::default()], largest: moment().map(f64::abs).fold(0.0, f64::max), ..Moments::default() }
}
