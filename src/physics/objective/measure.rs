//! Measures of a design: what objectives, limits and fronts are made of.

use super::statistic::Statistic;
use crate::engine::Order;
use crate::response::Quantity;
use crate::response::grid::SAME_SPEED;

/// How a measure comes from its quantities.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum Over {
    /// Half peak-to-peak of all orders together, with phase.
    Synthesis,
    /// The largest single order.
    Orders,
    /// One order; nothing where the torque has none of it.
    Order(Order),
    /// A number made of the magnitudes of all orders.
    Statistic(Statistic),
    /// Share of the crank's strength that is used, all orders together: the inverse of its margin by a criterion of the study (an index).
    Margin(usize),
    /// Mean power dissipated in the absorbers whose ring twists are the quantities, together, W.
    Power,
    /// Temperature that the absorbers whose ring twists are the quantities reach from cold, each by itself, °C.
    Temperature,
    /// Mean over the duty of half peak-to-peak of all orders together.
    Mean,
    /// Half peak-to-peak of all orders together at one point of the duty (an index): the terms that optimisers take a mean apart into.
    AtDuty(usize),
    /// Mean over the duty of the power as above, W.
    MeanPower,
    /// Share of its life that an hour of the duty takes of what the absorbers shear whose ring twists are the quantities, the largest, 1/h.
    Damage,
    /// Largest shear strain in the absorbers whose ring twists are the quantities, each by its own dimensions: half peak-to-peak of all orders together.
    Strain,
    /// Largest stress of springs in the same absorbers, Pa, in the same way.
    SpringStress,
    /// What the design has at no speed.
    Property(Property),
}

impl Over {
    /// Whether it asks for the points of a duty.
    #[doc(hidden)]
    pub fn asks_for_duty(self) -> bool {
        matches!(self, Self::Mean | Self::MeanPower | Self::Damage)
    }

    /// In words before what it is of, and before its column.
    #[doc(hidden)]
    pub fn names(self) -> (String, String) {
        match self {
            Self::Orders => ("largest order of ".into(), "peak_order_".into()),
            Self::Order(order) => (format!("order {order} of "), format!("peak_order_{order}_")),
            Self::Statistic(Statistic(row)) => (format!("peak {} ", row.label), format!("peak_{}_", row.name)),
            Self::Property(_) | Self::Damage => (String::new(), String::new()),
            Self::Mean | Self::MeanPower => ("mean over the duty of ".into(), "mean_".into()),
            Self::AtDuty(_) => ("mean over the duty of ".into(), "peak_mean_".into()),
            Self::Synthesis | Self::Margin(_) | Self::Power | Self::Temperature | Self::Strain | Self::SpringStress => {
                ("peak ".into(), "peak_".into())
            }
        }
    }
}

/// A property of the absorbers whose ring twists are the quantities of a measure.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum Property {
    /// Largest loss factor c omega/k that spring and damper imply at the ring's own frequency.
    LossFactor,
    /// Inertia of their rings together, kg m².
    RingInertia,
    /// The same with their hubs.
    TotalInertia,
    /// Mass of their rings, housings, springs and of what is sheared together, kg: of those that are given by their dimensions.
    Mass,
    /// Volume of the cylinders that they fill, m³.
    Volume,
    /// Price of them together.
    Cost(Price),
    /// Largest outer diameter, m.
    OuterDiameter,
    /// Largest width, m.
    Width,
    /// Inverse of the smallest diameter that is free inside, 1/m.
    Bore,
    /// How far a natural frequency of chain and absorbers lies inside a band, as the ratio to the nearer end of it: above one inside, Hz.
    Band {
        /// Hz.
        low: f64,
        /// Hz.
        high: f64,
    },
}

/// What a damper costs: a function of its masses and its diameter, in any currency.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Price {
    /// Whatever its size.
    pub fixed: f64,
    /// Per kg of the ring, of springs and of pendulum masses.
    pub ring: f64,
    /// Per kg of the housing.
    pub housing: f64,
    /// Per m of the outer diameter.
    pub diameter: f64,
}

/// A range with speeds at its ends that differ from them by rounding.
pub(super) fn with_its_ends((low, high): (f64, f64)) -> (f64, f64) {
    (low * (1.0 - SAME_SPEED), high * (1.0 + SAME_SPEED))
}

/// Where a measure counts, and how much.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Within {
    /// Speeds in ascending ranges, rpm; everywhere where there are none.
    pub ranges: Vec<(f64, f64)>,
    /// At a speed (rpm, ascending) the value counts divided by this factor: linear between, constant beyond; one where there are none.
    pub factors: Vec<(f64, f64)>,
}

impl Within {
    /// Whether a value has a kink at any speed.
    pub(super) fn has_kinks(&self) -> bool {
        self.kinks().next().is_some()
    }

    /// What a value counts at a speed.
    pub fn weight(&self, speed_rpm: f64) -> f64 {
        let (Some(first), Some(last)) = (self.factors.first(), self.factors.last()) else { return 1.0 };
        if speed_rpm <= first.0 || self.factors.len() == 1 {
            return 1.0 / first.1;
        }
        if speed_rpm >= last.0 {
            return 1.0 / last.1;
        }
        let i = self.factors.partition_point(|f| f.0 <= speed_rpm);
        let (a, b) = (self.factors[i - 1], self.factors[i]);
        1.0 / (a.1 + (b.1 - a.1) * (speed_rpm - a.0) / (b.0 - a.0))
    }

    /// Whether it counts at a speed.
    #[doc(hidden)]
    pub fn holds(&self, speed_rpm: f64) -> bool {
        self.ranges.is_empty() || self.ranges.iter().map(|r| with_its_ends(*r)).any(|r| (r.0..=r.1).contains(&speed_rpm))
    }

    /// Speeds at which it is not smooth, rpm.
    #[doc(hidden)]
    pub fn kinks(&self) -> impl Iterator<Item = f64> + '_ {
        self.ranges.iter().flat_map(|r| [r.0, r.1]).chain(self.factors.iter().map(|f| f.0))
    }
}

/// The largest value of some quantities over the speed range.
#[derive(Debug, Clone, PartialEq)]
pub struct Measure {
    /// The largest of these counts (several for the torque of all shafts), of powers their sum; all of one unit.
    pub quantities: Vec<Quantity>,
    /// How it comes from them.
    pub over: Over,
    /// Where it counts.
    pub within: Within,
}

impl Measure {
    /// Over the whole range.
    pub fn new(quantities: Vec<Quantity>, over: Over) -> Self {
        Self { quantities, over, within: Within::default() }
    }

    /// The quantity, where the measure is the synthesis of one over the whole range: what surrogate peaks answer for.
    #[doc(hidden)]
    pub fn synthesised(&self) -> Option<Quantity> {
        match (self.over, self.quantities.as_slice()) {
            (Over::Synthesis, [quantity]) if self.within == Within::default() => Some(*quantity),
            _ => None,
        }
    }

    /// Whether it is of inertias and sizes alone, which are the same in every condition.
    #[doc(hidden)]
    pub fn is_inertia(&self) -> bool {
        use Property::{Bore, Cost, Mass, OuterDiameter, RingInertia, TotalInertia, Volume, Width};
        let drawn = |p: &Property| matches!(p, RingInertia | TotalInertia | Mass | Volume | Cost(_) | OuterDiameter | Width | Bore);
        matches!(&self.over, Over::Property(p) if drawn(p))
    }

    /// In units of one: W, rad, N m.
    #[must_use]
    pub fn in_si(&self) -> Limit {
        Limit { measure: self.clone(), limit: 1.0, excepted: Vec::new(), engine: None }
    }

    /// The same where two absorbers have changed places.
    pub(crate) fn exchanged(&self, i: usize, j: usize) -> Self {
        let place = |k: usize| {
            if k == i {
                j
            } else if k == j {
                i
            } else {
                k
            }
        };
        let renumbered = |q: &Quantity| if let Quantity::RingTwist(k) = q { Quantity::RingTwist(place(*k)) } else { *q };
        Self { quantities: self.quantities.iter().map(renumbered).collect(), ..self.clone() }
    }

    /// Whether another measure asks for the same; the order of quantities does not count.
    pub(crate) fn is(&self, other: &Self) -> bool {
        let within = |a: &Self, b: &Self| a.quantities.iter().all(|q| b.quantities.contains(q));
        self.over == other.over && self.within == other.within && within(self, other) && within(other, self)
    }

    /// Absorbers whose ring twists it is made of.
    #[doc(hidden)]
    pub fn absorbers(&self) -> impl Iterator<Item = usize> + '_ {
        self.quantities.iter().filter_map(|q| if let Quantity::RingTwist(i) = q { Some(*i) } else { None })
    }

    /// Whether it says something of designs with so many absorbers: one of absorbers says nothing of a design that has none of these.
    #[doc(hidden)]
    pub fn is_of(&self, absorbers: usize) -> bool {
        let mut asked = self.absorbers().peekable();
        asked.peek().is_none() || asked.any(|i| i < absorbers)
    }
}

/// A limit holds up to this share above it.
#[doc(hidden)]
pub const HELD: f64 = 1e-6;

/// Whether a limit holds with this ratio of the measure to it.
#[doc(hidden)]
pub fn holds(ratio: f64) -> bool {
    ratio <= 1.0 + HELD
}

/// A measure in units of a value of it: an upper limit, or a target.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// What is limited.
    pub measure: Measure,
    /// In the unit of the measure; positive.
    pub limit: f64,
    /// What is left of it at speeds that a study excepts.
    pub excepted: Vec<AtExceptedSpeeds>,
    /// Of several engines that share a design, the one that it is of; `None`: of every one.
    pub engine: Option<usize>,
}

/// What a limit allows at speeds that a study excepts from it: a rule lets them be barred, but limits the stress there, too.
#[derive(Debug, Clone, PartialEq)]
pub struct AtExceptedSpeeds {
    /// The measure at those speeds.
    pub measure: Measure,
    /// In its unit.
    pub limit: f64,
    /// Whether it holds with all cylinders firing only.
    pub in_service: bool,
}

impl Limit {
    /// The same, a factor as large.
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        let excepted = self.excepted.iter().map(|e| AtExceptedSpeeds { limit: e.limit * factor, ..e.clone() }).collect();
        Self { measure: self.measure.clone(), limit: self.limit * factor, excepted, engine: self.engine }
    }

    /// Its measures, each with what it is in units of, and whether that holds with all cylinders firing only.
    pub(crate) fn parts(&self) -> impl Iterator<Item = (&Measure, f64, bool)> {
        std::iter::once((&self.measure, self.limit, false)).chain(self.excepted.iter().map(|e| (&e.measure, e.limit, e.in_service)))
    }
}
