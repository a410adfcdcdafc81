//! Steady torsional response: phasors of any quantity, per order, over speed.
//!
//! Every method offers the same verbs ([`Response`]). Phasors of a sweep lie speed by speed, the orders of a speed together.

mod batch;
pub mod bodies;
pub mod closed_form;
pub mod dense;
pub mod direct;
pub mod exponential;
pub mod holzer;
mod kernel;
pub mod modal;
pub mod natural;
pub mod newmark;
pub mod periodic;
pub mod power;
pub mod receptance;
pub mod reduced;
pub mod system;

pub use closed_form::ClosedForm;
pub use dense::Dense;
pub use direct::Direct;
pub use exponential::Exponential;
pub use holzer::Holzer;
pub use modal::Modal;
pub use newmark::Newmark;
pub use receptance::Receptance;
pub use reduced::Reduced;
pub use system::System;

use crate::absorber::Mounted;
use crate::engine::Order;
use crate::numerics::C64;
use crate::units::HZ_PER_RPM;

/// A quantity that is linear in the angles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// Angle of station `from` less that of `to` (`None`: the ground, so the amplitude of a station), rad.
    Twist {
        /// Index of a station.
        from: usize,
        /// Index of a station, or the ground.
        to: Option<usize>,
    },
    /// Vibratory torque of a shaft length, elastic and damping parts, N m.
    ShaftTorque(usize),
    /// Angle of the ring of an absorber (index in the design) less that of its hub, rad.
    RingTwist(usize),
}

/// Speeds of a sweep, rpm, ascending.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// The speeds.
    pub speed_rpm: Vec<f64>,
    /// Whether the torque has a kink there (a tabulated speed): maxima may sit on it.
    pub kink: Vec<bool>,
}

impl Grid {
    /// The speeds of a study and, with `kinks`, the tabulated speeds between them.
    pub fn new(speeds_rpm: &[f64], kinks: &[f64]) -> Self {
        let (first, last) = (speeds_rpm[0], speeds_rpm[speeds_rpm.len() - 1]);
        let mut all: Vec<f64> = speeds_rpm.to_vec();
        all.extend(kinks.iter().filter(|k| **k > first && **k < last && !speeds_rpm.contains(k)));
        all.sort_by(f64::total_cmp);
        let kink = all.iter().map(|s| kinks.contains(s)).collect();
        Self { speed_rpm: all, kink }
    }

    /// Number of speeds.
    pub fn len(&self) -> usize {
        self.speed_rpm.len()
    }

    /// Never true for a checked study.
    pub fn is_empty(&self) -> bool {
        self.speed_rpm.is_empty()
    }
}

/// Work done, counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Evaluations of a whole design.
    pub evaluations: u64,
    /// Those of them that tables alone answered.
    pub quick_evaluations: u64,
    /// Tridiagonal systems factored, one an order and speed.
    pub direct_solves: u64,
    /// Points (order and speed) answered by receptance.
    pub receptance_points: u64,
    /// Points where receptance was near a singular base and the direct solve took over.
    pub singular_points: u64,
    /// Sums of orders with phase.
    pub syntheses: u64,
    /// Responses of a few modes, one an order and speed.
    pub modal_solves: u64,
    /// Eigenproblems of chain and rings.
    pub eigenproblems: u64,
    /// Marches along the chain, one an order and speed.
    pub marches: u64,
    /// Dense systems solved, one an order and speed.
    pub dense_solves: u64,
    /// Steps in time.
    pub time_steps: u64,
}

impl std::ops::AddAssign for Work {
    fn add_assign(&mut self, w: Self) {
        self.evaluations += w.evaluations;
        self.quick_evaluations += w.quick_evaluations;
        self.direct_solves += w.direct_solves;
        self.receptance_points += w.receptance_points;
        self.singular_points += w.singular_points;
        self.syntheses += w.syntheses;
        self.modal_solves += w.modal_solves;
        self.eigenproblems += w.eigenproblems;
        self.marches += w.marches;
        self.dense_solves += w.dense_solves;
        self.time_steps += w.time_steps;
    }
}

/// No finite answer.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ResponseError {
    /// Nothing limits the amplitude.
    #[error(
        "resonance without damping: order {order} at {speed_rpm:.1} rpm ({frequency_hz:.2} Hz) has no finite amplitude; give the chain or \
         the absorber some damping, or keep the resonance out of the speed range"
    )]
    Unbounded {
        /// The order.
        order: Order,
        /// rpm.
        speed_rpm: f64,
        /// Hz.
        frequency_hz: f64,
    },
    /// A method cannot take this system.
    #[error("{method} cannot be used here: {why}")]
    NotApplicable {
        /// Its word.
        method: &'static str,
        /// Why not.
        why: &'static str,
    },
    /// A step in time is too long for the highest mode.
    #[error(
        "{method} is unstable at {speed_rpm:.1} rpm: the highest frequency times the step is {product:.2}, expected below {limit:.3}; take \
         more steps or average acceleration"
    )]
    UnstableStep {
        /// Its word.
        method: &'static str,
        /// Highest circular frequency times the step.
        product: f64,
        /// Where stability ends.
        limit: f64,
        /// rpm.
        speed_rpm: f64,
    },
    /// A method would give an answer with too few digits.
    #[error("{method} loses digits: order {order} at {speed_rpm:.1} rpm cancels by a factor of {factor:.0e}; use the direct method")]
    LostDigits {
        /// Its word.
        method: &'static str,
        /// The order.
        order: Order,
        /// rpm.
        speed_rpm: f64,
        /// How much larger the terms are than their sum.
        factor: f64,
    },
}

impl ResponseError {
    /// At an order and speed.
    pub fn unbounded(order: Order, speed_rpm: f64) -> Self {
        Self::Unbounded { order, speed_rpm, frequency_hz: order.value() * speed_rpm * HZ_PER_RPM }
    }
}

/// Word, speeds and system of a method that holds its grid and system in fields of these names.
macro_rules! identity {
    ($name:literal) => {
        fn name(&self) -> &'static str {
            $name
        }
        fn grid(&self) -> &$crate::response::Grid {
            self.grid
        }
        fn system(&self) -> &$crate::response::System {
            self.system
        }
    };
}
use identity;

/// A modal stiffness below this share of the inertia forces is rounding: nothing damps a resonance met exactly.
const RESONANT: f64 = 1e-14;

/// A method that computes the steady response.
pub trait Response: Sync {
    /// Its word in studies.
    fn name(&self) -> &'static str;

    /// Speeds of its sweeps.
    fn grid(&self) -> &Grid;

    /// What it computes the response of.
    fn system(&self) -> &System;

    /// Indices of the orders.
    fn orders(&self) -> std::ops::Range<usize> {
        0..self.system().orders()
    }

    /// The phasor of one order (an index) at any speed (rpm).
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance; others where the method cannot take the system.
    fn phasor(&self, design: &[Mounted], quantity: Quantity, at: (usize, f64), work: &mut Work) -> Result<C64, ResponseError>;

    /// Phasors of `quantity` for all orders at any speed.
    ///
    /// # Errors
    /// Those of [`Self::phasor`].
    fn all_orders_at(&self, design: &[Mounted], quantity: Quantity, speed_rpm: f64, work: &mut Work) -> Result<Vec<C64>, ResponseError> {
        self.orders().map(|order| self.phasor(design, quantity, (order, speed_rpm), work)).collect()
    }

    /// Phasors of `quantity` at all grid speeds and orders (speed by speed).
    ///
    /// # Errors
    /// Those of [`Self::phasor`].
    fn sweep(&self, design: &[Mounted], quantity: Quantity, out: &mut Vec<C64>, work: &mut Work) -> Result<(), ResponseError> {
        out.clear();
        for &speed in &self.grid().speed_rpm {
            out.extend(self.all_orders_at(design, quantity, speed, work)?);
        }
        Ok(())
    }

    /// Phasors of several quantities at once, one sweep each: costs little more than one where every point is solved anew.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance.
    fn sweep_each(&self, design: &[Mounted], quantities: &[Quantity], work: &mut Work) -> Result<Vec<Vec<C64>>, ResponseError> {
        let one = |q: &Quantity| {
            let mut out = Vec::new();
            self.sweep(design, *q, &mut out, work).map(|()| out)
        };
        quantities.iter().map(one).collect()
    }

    /// Squares of the magnitudes of `quantity` at all grid speeds and orders (speed by speed).
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance.
    fn squares(&self, design: &[Mounted], quantity: Quantity, out: &mut Vec<f64>, work: &mut Work) -> Result<(), ResponseError> {
        let mut phasors = Vec::new();
        self.sweep(design, quantity, &mut phasors, work)?;
        out.clear();
        out.extend(phasors.iter().map(|y| y.norm_sqr()));
        Ok(())
    }
}

/// The method of a study.
#[derive(Debug)]
pub enum Method<'a> {
    /// Solve the whole system at every point.
    Direct(Direct<'a>),
    /// Solve the base once, add the absorber as a rank-one change.
    Receptance(Receptance<'a>),
}

impl Response for Method<'_> {
    fn name(&self) -> &'static str {
        match self {
            Self::Direct(m) => m.name(),
            Self::Receptance(m) => m.name(),
        }
    }
    fn grid(&self) -> &Grid {
        match self {
            Self::Direct(m) => m.grid(),
            Self::Receptance(m) => m.grid(),
        }
    }
    fn system(&self) -> &System {
        match self {
            Self::Direct(m) => m.system(),
            Self::Receptance(m) => m.system(),
        }
    }
    fn phasor(&self, design: &[Mounted], quantity: Quantity, at: (usize, f64), work: &mut Work) -> Result<C64, ResponseError> {
        match self {
            Self::Direct(m) => m.phasor(design, quantity, at, work),
            Self::Receptance(m) => m.phasor(design, quantity, at, work),
        }
    }
    fn sweep(&self, design: &[Mounted], quantity: Quantity, out: &mut Vec<C64>, work: &mut Work) -> Result<(), ResponseError> {
        match self {
            Self::Direct(m) => m.sweep(design, quantity, out, work),
            Self::Receptance(m) => m.sweep(design, quantity, out, work),
        }
    }
    fn sweep_each(&self, design: &[Mounted], quantities: &[Quantity], work: &mut Work) -> Result<Vec<Vec<C64>>, ResponseError> {
        match self {
            Self::Direct(m) => m.sweep_each(design, quantities, work),
            Self::Receptance(m) => m.sweep_each(design, quantities, work),
        }
    }
    fn squares(&self, design: &[Mounted], quantity: Quantity, out: &mut Vec<f64>, work: &mut Work) -> Result<(), ResponseError> {
        match self {
            Self::Direct(m) => m.squares(design, quantity, out, work),
            Self::Receptance(m) => m.squares(design, quantity, out, work),
        }
    }
}

/// A quantity per unit torque at each station if every elastic mode followed as if static (no amplification): what is left of it when
/// nothing resonates. Zero for rings.
pub fn quasi_static(system: &System, quantity: Quantity) -> Vec<f64> {
    let modes = &system.modes;
    let at = |mode: usize, station: usize| modes.shapes[(station, mode)];
    let output = |mode: usize| match quantity {
        Quantity::Twist { from, to } => at(mode, from) - to.map_or(0.0, |to| at(mode, to)),
        Quantity::ShaftTorque(s) => system.chain.stations[s].stiffness_to_next * (at(mode, s) - at(mode, s + 1)),
        Quantity::RingTwist(_) => 0.0,
    };
    let share = |station: usize, mode: usize| at(mode, station) * output(mode) / (modes.omega[mode] * modes.omega[mode]);
    (0..system.chain.len()).map(|station| modes.elastic().map(|mode| share(station, mode)).sum()).collect()
}
