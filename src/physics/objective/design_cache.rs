//! What evaluations of one design share: its speeds, the sweeps of quantities, and what the crank knows of them.

use super::measure::{Measure, Over};
use super::speeds::Speeds;
use crate::crankshaft::Known;
use crate::numerics::C64;
use crate::response::Quantity;
use std::cell::{OnceCell, RefCell};
use std::rc::Rc;

/// A sweep: speed by speed, the orders of a speed together.
pub(super) type Sweep = Rc<Vec<C64>>;

/// Of one design; another needs another.
#[derive(Debug, Default)]
#[doc(hidden)]
pub struct Shared {
    pub(super) known: Known,
    pub(super) speeds: OnceCell<Speeds>,
    /// Quantities that measures over the same speeds will ask for.
    pub(super) together: Vec<Quantity>,
    pub(super) swept: RefCell<Vec<Swept>>,
    /// Shafts and speeds (rpm) at which the crank is used most by criteria that have been asked for: by the next one it is hardly used less there than anywhere.
    pub(super) worst: RefCell<Vec<(Quantity, f64)>>,
}

/// Sweeps over speeds, rpm.
#[derive(Debug)]
pub(super) struct Swept {
    pub speeds_rpm: Vec<f64>,
    pub sweeps: Vec<(Quantity, Sweep)>,
}

impl Shared {
    /// For measures that will be asked for: what they need is swept at once.
    pub fn of<'m>(measures: impl Iterator<Item = &'m Measure>) -> Self {
        let swept =
            |m: &&Measure| matches!(m.over, Over::Synthesis | Over::Margin(_) | Over::Statistic(_) | Over::Power) && !m.within.has_kinks();
        let mut together: Vec<Quantity> = Vec::new();
        for quantity in measures.filter(swept).flat_map(|m| &m.quantities) {
            if !together.contains(quantity) {
                together.push(*quantity);
            }
        }
        Self { together, ..Self::default() }
    }
}
