//! Response of a design over the speeds of the study, for tables and plots.

use super::ConditionResult;
use super::systems::engines_in;
use crate::absorber::Mounted;
use crate::drivetrain::System;
use crate::engine::Units;
use crate::input::Study;
use crate::numerics::C64;
use crate::numerics::elementary::Elementary;
use crate::objective::in_operation::absorbers;
use crate::objective::{Condition, PeakFinder};
use crate::response::{Direct, Grid, Quantity, Response, ResponseError, Work};
use crate::units::DEG_PER_RAD;
use rayon::prelude::*;

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
    #[doc(hidden)]
    pub fn unit(self) -> &'static str {
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
    /// What [`orders`] finds the orders of again where tables list them but they are too many to be kept.
    #[serde(skip)]
    #[doc(hidden)]
    pub listed: Option<Quantity>,
    /// Half peak-to-peak of all orders together (power: the sum).
    pub total: Vec<f64>,
}

impl QuantitySweep {
    fn new((of, place): (Swept, String), (finder, phasors): (&PeakFinder, &[C64]), keeps_orders: bool) -> Self {
        let count = finder.system.orders();
        let orders = if keeps_orders { (0..count).map(|n| OrderSweep::of(of, (n, count), phasors)).collect() } else { Vec::new() };
        let total = finder.synthesis(phasors).iter().map(|v| v * of.per_si()).collect();
        Self { of, place, condition: Condition::Firing, orders, listed: None, total }
    }
}

/// The phasors of quantities in a condition, `finder` being of the cylinder whose twist is worst where one misfires: at every speed those of the cylinder whose quantity is largest there. The method of the searches, exact
/// but for rounding, tells which it is.
fn of_the_worst_cylinder(
    (finders, grid): (&[PeakFinder], &Grid),
    design: &[Mounted],
    (condition, finder, wanted): (Condition, &PeakFinder, &[Quantity]),
    work: &mut Work,
) -> Result<Vec<Vec<C64>>, ResponseError> {
    let orders = finder.system.orders();
    let mut worst = Direct::new(finder.system, grid).sweep_each(&absorbers(condition, finder, design)?, wanted, work)?;
    let mut largest: Vec<Vec<f64>> = worst.iter().map(|phasors| finder.synthesis(phasors)).collect();
    for other in engines_in(condition, finders).filter(|f| !std::ptr::eq(*f, finder)) {
        let (own, direct) = (absorbers(condition, other, design)?, Direct::new(other.system, grid));
        for ((worst, largest), quantity) in worst.iter_mut().zip(&mut largest).zip(wanted) {
            let mut phasors = Vec::new();
            let is_same_grid = other.grid.speed_rpm == grid.speed_rpm;
            if !is_same_grid || other.method.sweep(&own, *quantity, &mut phasors, work).is_err() {
                direct.sweep(&own, *quantity, &mut phasors, work)?;
            }
            let above = other.synthesis(&phasors).into_iter().enumerate().filter(|(i, total)| *total > largest[*i]);
            let above: Vec<(usize, f64)> = above.collect();
            let speeds: Vec<f64> = above.iter().map(|(i, _)| grid.speed_rpm[*i]).collect();
            let exact = direct.at_each(&own, &[*quantity], &speeds, work)?.swap_remove(0);
            for ((i, total), phasors) in above.into_iter().zip(exact.chunks(orders)) {
                largest[i] = total;
                worst[i * orders..(i + 1) * orders].copy_from_slice(phasors);
            }
        }
    }
    Ok(worst)
}

impl OrderSweep {
    /// Order `n` of `count` in the phasors of a quantity, those of a speed together.
    fn of(of: Swept, (n, count): (usize, usize), phasors: &[C64]) -> Self {
        let (factor, each) = (of.per_si(), || phasors.iter().skip(n).step_by(count));
        Self {
            amplitude: each().map(|y| y.norm() * factor).collect(),
            phase_deg: each().map(|y| y.im.arctangent(y.re) * DEG_PER_RAD).collect(),
        }
    }
}

/// Bytes of phasors that are held at a time.
const AT_A_TIME: usize = 32 << 20;

/// How many quantities are swept together.
#[doc(hidden)]
pub fn together(orders: usize, speeds: usize) -> usize {
    (AT_A_TIME / (size_of::<C64>() * orders * speeds).max(1)).max(1)
}

/// The orders of quantities of a design at speeds, rpm, of each quantity a list.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance met exactly.
#[doc(hidden)]
pub fn orders(
    (system, speeds_rpm): (&System, &[f64]),
    design: &[Mounted],
    quantities: &[(Swept, Quantity)],
) -> Result<Vec<Vec<OrderSweep>>, ResponseError> {
    let (grid, count) = (Grid::new(speeds_rpm, &[]), system.orders());
    let list: Vec<Quantity> = quantities.iter().map(|q| q.1).collect();
    let found = Direct::new(system, &grid).sweep_each(design, &list, &mut Work::default())?;
    let orders_of =
        |((of, _), phasors): (&(Swept, Quantity), Vec<C64>)| (0..count).map(|n| OrderSweep::of(*of, (n, count), &phasors)).collect();
    Ok(quantities.iter().zip(found).map(orders_of).collect())
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
    let hub_amplitude = Quantity::Twist { from: hub, to: None };
    let mut wanted = vec![(Swept::Twist, twist), (Swept::Amplitude, hub_amplitude)];
    wanted.extend((0..chain.len() - 1).map(|s| (Swept::Torque, Quantity::ShaftTorque(s))));
    wanted.extend((0..design.len()).map(|i| (Swept::RingTwist, Quantity::RingTwist(i))));
    if every_station {
        let others = (0..chain.len()).filter(|s| *s != hub).map(|from| (Swept::Amplitude, Quantity::Twist { from, to: None }));
        wanted.extend(others);
    }
    // twist and hub, whose single orders are kept; of the rest they would make the table many times as long, and are listed where that is asked for
    let kept = |of: Swept, quantity: Quantity| of == Swept::Twist || quantity == hub_amplitude;
    let one = |(of, quantity): (Swept, Quantity), phasors: &[C64]| {
        let keeps_orders = kept(of, quantity);
        let swept = QuantitySweep::new((of, quantity.place(chain)), (finder, phasors), keeps_orders);
        let swept = QuantitySweep { listed: (every_station && !keeps_orders).then_some(quantity), ..swept };
        let Quantity::RingTwist(ring) = quantity else { return vec![swept] };
        let power = |(y, speed): (&[C64], &f64)| direct.power_of_twist(design, ring, *speed, y);
        let total = phasors.chunks(orders).zip(&grid.speed_rpm).map(power).collect();
        let power = QuantitySweep { of: Swept::DissipatedPower, orders: Vec::new(), listed: None, total, ..swept.clone() };
        vec![swept, power]
    };
    let some = |wanted: &[(Swept, Quantity)]| -> Result<(Vec<QuantitySweep>, Work), ResponseError> {
        let (list, mut work): (Vec<Quantity>, _) = (wanted.iter().map(|w| w.1).collect(), Work::default());
        let phasors = direct.sweep_each(design, &list, &mut work)?;
        Ok((wanted.iter().zip(&phasors).flat_map(|(w, phasors)| one(*w, phasors)).collect(), work))
    };
    let parts: Vec<&[(Swept, Quantity)]> = wanted.chunks(together(orders, grid.len())).collect();
    let mut quantities = Vec::new();
    for part in parts.into_par_iter().map(some).collect::<Result<Vec<_>, _>>()? {
        quantities.extend(part.0);
        *work += part.1;
    }
    for c in conditions {
        let finder = finder_of(finders, c);
        let mut wanted = vec![(Swept::Twist, twist)];
        if torque_in_conditions {
            wanted.extend((0..chain.len() - 1).map(|s| (Swept::Torque, Quantity::ShaftTorque(s))));
        }
        let list: Vec<Quantity> = wanted.iter().map(|w| w.1).collect();
        let phasors = of_the_worst_cylinder((finders, grid), design, (c.condition, finder, &list), work)?;
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
