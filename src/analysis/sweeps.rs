//! Response of a design over the speeds of the study, for tables and plots.

use super::ConditionResult;
use super::systems::engines_in;
use crate::absorber::Mounted;
use crate::engine::Units;
use crate::input::Study;
use crate::numerics::C64;
use crate::numerics::elementary::Elementary;
use crate::objective::in_operation::absorbers;
use crate::objective::{Condition, PeakFinder};
use crate::response::{Direct, Grid, Quantity, Response, ResponseError, Work};
use crate::units::DEG_PER_RAD;

/// What is swept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub enum Swept {
    /// Twist between two stations, degrees.
    Twist,
    /// Vibration of a station, degrees.
    Amplitude,
    /// Torque of a shaft length, N m.
    Torque,
    /// Twist of a ring against its hub, degrees.
    RingTwist,
    /// Power dissipated in an absorber, W.
    DissipatedPower,
}

impl Swept {
    /// The word in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Twist => "twist",
            Self::Amplitude => "amplitude",
            Self::Torque => "torque",
            Self::RingTwist => "ring_twist",
            Self::DissipatedPower => "dissipated_power",
        }
    }

    /// Its unit in tables.
    pub(crate) fn unit(self) -> &'static str {
        match self {
            Self::Twist | Self::Amplitude | Self::RingTwist => "deg",
            Self::Torque => "N m",
            Self::DissipatedPower => "W",
        }
    }

    fn per_si(self) -> f64 {
        match self {
            Self::Twist | Self::Amplitude | Self::RingTwist => DEG_PER_RAD,
            Self::Torque | Self::DissipatedPower => 1.0,
        }
    }
}

/// One order of a quantity over the speeds of the study: a cos(n theta + phi), theta being the angle of the crank, zero where the first cylinder fires.
#[derive(Debug, Clone, serde::Serialize)]
pub struct OrderSweep {
    /// a, in the unit of the quantity.
    pub amplitude: Vec<f64>,
    /// phi, degrees from -180 to 180.
    pub phase_deg: Vec<f64>,
}

/// One quantity over the speeds of the study.
#[derive(Debug, Clone, serde::Serialize)]
pub struct QuantitySweep {
    /// What it is.
    pub of: Swept,
    /// Of what: stations, a shaft length, an absorber.
    pub place: String,
    /// The condition.
    pub condition: Condition,
    /// Orders of the engine; empty where only the total is kept.
    pub orders: Vec<OrderSweep>,
    /// Half peak-to-peak of all orders together (power: the sum).
    pub total: Vec<f64>,
}

impl QuantitySweep {
    fn new((of, place): (Swept, String), (finder, phasors): (&PeakFinder, &[C64]), keeps_orders: bool) -> Self {
        let factor = of.per_si();
        let count = finder.system.orders();
        let each = |n: usize| phasors.iter().skip(n).step_by(count);
        let order = |n: usize| OrderSweep {
            amplitude: each(n).map(|y| y.norm() * factor).collect(),
            phase_deg: each(n).map(|y| y.im.arctangent(y.re) * DEG_PER_RAD).collect(),
        };
        let orders = if keeps_orders { (0..count).map(order).collect() } else { Vec::new() };
        let total = finder.synthesis(phasors).iter().map(|v| v * factor).collect();
        Self { of, place, condition: Condition::Firing, orders, total }
    }
}

/// Response of one design over the speeds of the study.
#[derive(Debug, Clone, serde::Serialize)]
pub struct Sweeps {
    /// Name of the design.
    pub design: String,
    /// Twist, hub, then the torque of each shaft, ring twist and power of each absorber, every other station where the study asks for it, then the twist in each condition, with the torque of each shaft where that is asked for.
    pub quantities: Vec<QuantitySweep>,
}

/// The engine of a condition, with the cylinder misfiring that is worst.
fn finder_of<'a, 'f>(finders: &'f [PeakFinder<'a>], c: &ConditionResult) -> &'f PeakFinder<'a> {
    let units = |f: &&PeakFinder| f.system.excitation.units.misfiring() == c.cylinder;
    engines_in(c.condition, finders).find(units).unwrap_or(&finders[0])
}

/// What is swept besides the torque of every shaft, and the twist and power of every ring.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Asked {
    /// The twist.
    pub twist: Quantity,
    /// The station that carries the absorbers.
    pub hub: usize,
    /// All stations, and all orders of all.
    pub every_station: bool,
    /// The torque of every shaft in every condition.
    pub torque_in_conditions: bool,
}

impl Asked {
    /// By a study.
    pub(crate) fn by(study: &Study) -> Self {
        let Study { twist, hub, every_station, torque_in_conditions, .. } = *study;
        Self { twist, hub, every_station, torque_in_conditions }
    }
}

/// Computes the sweeps of a design on `grid` (the study's own speeds).
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance met exactly.
pub(crate) fn sweeps(
    finders: &[PeakFinder],
    grid: &Grid,
    (name, conditions): (&str, &[ConditionResult]),
    design: &[Mounted],
    asked: Asked,
    work: &mut Work,
) -> Result<Sweeps, ResponseError> {
    let Asked { twist, hub, every_station, torque_in_conditions } = asked;
    let finder = &finders[0];
    let direct = Direct::new(finder.system, grid);
    let orders = finder.system.orders();
    let chain = &finder.system.chain;
    let mut wanted = vec![(Swept::Twist, twist), (Swept::Amplitude, Quantity::Twist { from: hub, to: None })];
    wanted.extend((0..chain.len() - 1).map(|s| (Swept::Torque, Quantity::ShaftTorque(s))));
    wanted.extend((0..design.len()).map(|i| (Swept::RingTwist, Quantity::RingTwist(i))));
    if every_station {
        let others = (0..chain.len()).filter(|s| *s != hub).map(|from| (Swept::Amplitude, Quantity::Twist { from, to: None }));
        wanted.extend(others);
    }
    let list: Vec<Quantity> = wanted.iter().map(|w| w.1).collect();
    let mut quantities = Vec::new();
    for ((of, quantity), phasors) in wanted.into_iter().zip(direct.sweep_each(design, &list, work)?) {
        // single orders of twist and hub are kept; the rest would make the table many times as long, and is asked for
        let keeps_orders = every_station || matches!(of, Swept::Twist | Swept::Amplitude);
        quantities.push(QuantitySweep::new((of, quantity.place(chain)), (finder, &phasors), keeps_orders));
        if let Quantity::RingTwist(ring) = quantity {
            let power = |(y, speed): (&[C64], &f64)| direct.power_of_twist(design, ring, *speed, y);
            let total = phasors.chunks(orders).zip(&grid.speed_rpm).map(power).collect();
            quantities.push(QuantitySweep {
                of: Swept::DissipatedPower,
                place: quantity.place(chain),
                condition: Condition::Firing,
                orders: Vec::new(),
                total,
            });
        }
    }
    for c in conditions {
        let finder = finder_of(finders, c);
        let mut wanted = vec![(Swept::Twist, twist)];
        if torque_in_conditions {
            wanted.extend((0..chain.len() - 1).map(|s| (Swept::Torque, Quantity::ShaftTorque(s))));
        }
        let list: Vec<Quantity> = wanted.iter().map(|w| w.1).collect();
        let phasors = Direct::new(finder.system, grid).sweep_each(&absorbers(c.condition, finder, design)?, &list, work)?;
        // cylinders that differ bring orders of their own
        let differ = finder.system.excitation.units != Units::Equal;
        for ((of, quantity), phasors) in wanted.into_iter().zip(phasors) {
            let keeps_orders = differ && (every_station || of == Swept::Twist);
            let swept = QuantitySweep::new((of, quantity.place(chain)), (finder, &phasors), keeps_orders);
            quantities.push(QuantitySweep { condition: c.condition, ..swept });
        }
    }
    Ok(Sweeps { design: name.to_owned(), quantities })
}
