//! A load case at one speed, and its absorbers over a box there.

use super::form::Form;
use crate::numerics::taylor::Taylor;
use crate::numerics::{C64, ZERO};
use crate::response::enclosed::{BaseAtSpeed, Corners};
use crate::response::pair::{Loads, Quotient};

/// A load case at one speed.
pub(super) struct AtSpeed {
    /// Index of the case.
    pub case: usize,
    pub speed_rpm: f64,
    pub base: BaseAtSpeed,
    /// What the quantities of the chain are with two absorbers, or one, order after order; nothing where that is not looked at.
    pub quotients: Vec<Vec<Option<Quotient>>>,
}

impl AtSpeed {
    /// Whether absorbers are looked at as quotients.
    pub(super) fn is_pair(&self) -> bool {
        !self.quotients.is_empty()
    }
}

/// The absorbers of a case over a box, two or one; `None` where they are not looked at as quotients.
pub(super) type Pair = Option<[Corners; 2]>;

/// The absorbers over a box at a speed.
pub(super) struct PairOver<'s> {
    pub(super) at: &'s AtSpeed,
    pub(super) pair: &'s [Corners; 2],
    /// Of each order.
    pub(super) loads: Vec<[Loads; 2]>,
}

impl<'s> PairOver<'s> {
    /// `None` where laws are no quotients.
    pub(super) fn of(at: &'s AtSpeed, pair: &'s Pair) -> Option<Self> {
        let pair = pair.as_ref().filter(|_| at.is_pair())?;
        Some(Self { at, pair, loads: (0..at.base.orders()).map(|order| at.base.loads(pair, order)).collect::<Option<_>>()? })
    }

    pub(super) fn loads(&self, order: usize) -> [&Loads; 2] {
        self.loads[order].each_ref()
    }

    /// An output as a quotient; `None` of a ring.
    pub(super) fn quotient(&self, order: usize, quantity: usize) -> Option<&'s Quotient> {
        self.at.quotients[order][quantity].as_ref()
    }

    /// An output of which nothing is known but its middle, and not even that of a ring.
    pub(super) fn unknown(&self, order: usize, quantity: usize) -> Taylor {
        let middle = self.quotient(order, quantity).map_or(ZERO, |q| q.middle(self.loads(order)));
        Taylor { rest: f64::INFINITY, ..Taylor::constant(middle) }
    }

    /// The real part of a sum of phasors times numbers: of each order the better of its model and of the least over the box.
    pub(super) fn sum(&self, quantity: usize, terms: impl Iterator<Item = (Taylor, C64)>) -> Form {
        terms.enumerate().fold(Form::default(), |sum, (order, (y, by))| {
            if by == ZERO {
                return sum;
            }
            let own = if y.rest.is_finite() { Form::of_sum(std::iter::once((y, by))) } else { Form::unknown(y.centre * by) };
            let least = self.quotient(order, quantity).map_or(f64::NEG_INFINITY, |q| q.least_along(self.loads(order), by));
            sum.plus(&if least > own.least() { Form { value: least, middle: own.middle, ..Form::default() } } else { own })
        })
    }
}
