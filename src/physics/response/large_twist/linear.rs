//! What chain and other absorbers do at one speed, harmonic by harmonic of the working cycle.

use crate::absorber::{Mounted, Operating};
use crate::drivetrain::System;
use crate::numerics::{C64, ZERO};
use crate::response::batch::Block;
use crate::response::direct::LARGEST_CANCELLATION;
use crate::response::factored::Factored;
use crate::response::lane::{LANES, Lane};
use crate::response::output::Output;
use crate::response::{Quantity, ResponseError};
use crate::units::RAD_PER_S_PER_RPM;

/// What the linear part does at one speed, harmonic by harmonic from the first.
pub(super) struct Linear {
    pub speed_rpm: f64,
    pub omega: Vec<f64>,
    /// Hub under the torque, and per torque on it.
    pub hub: Vec<(C64, C64)>,
    /// The same of each quantity.
    pub outputs: Vec<Vec<(C64, C64)>>,
    /// Torque of a ring on the hub per angle of hub and twist together: T = -w² J (hub + twist), with hub = u0 - H T.
    pub ring: Vec<C64>,
    /// Factors that make angles of torques in the absorber's own equation, 1/(w² J): of the mean as of the first harmonic, then of each.
    pub row: Vec<C64>,
}

impl Linear {
    /// Under a share of the torque.
    pub fn under(&self, share: f64) -> Self {
        let scaled = |list: &Vec<(C64, C64)>| list.iter().map(|(y, by)| (y * share, *by)).collect();
        let outputs = self.outputs.iter().map(scaled).collect();
        Self { hub: scaled(&self.hub), outputs, omega: self.omega.clone(), ring: self.ring.clone(), row: self.row.clone(), ..*self }
    }
}

/// Under the torque, and per torque on the hub: the hub first, then each quantity.
type Motions = Vec<(C64, C64)>;

/// Chain and other absorbers round the one of large twist.
pub(super) struct Surroundings<'s> {
    pub system: &'s System,
    pub others: &'s [Mounted],
    /// Station of the absorber.
    pub station: usize,
    pub quantities: &'s [Quantity],
    /// Harmonics of the working cycle, and orders of each.
    pub harmonics: usize,
    pub order_of_cycle: f64,
    /// kg m².
    pub ring_inertia: f64,
}

impl Surroundings<'_> {
    /// At a speed.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance of the chain.
    pub fn at(&self, speed_rpm: f64) -> Result<Linear, ResponseError> {
        let (h, shaft_speed) = (self.harmonics, speed_rpm * RAD_PER_S_PER_RPM);
        let outputs = vec![Vec::with_capacity(h); self.quantities.len()];
        let mut linear = Linear { speed_rpm, omega: Vec::new(), hub: Vec::new(), outputs, ring: Vec::new(), row: Vec::new() };
        let operating_at = |k: usize| Operating { omega: k as f64 * self.order_of_cycle * shaft_speed, shaft_speed };
        linear.omega.extend((1..=h).map(|k| operating_at(k).omega));
        linear.row.extend((0..=h).map(|k| C64::from(1.0 / (self.ring_inertia * operating_at(k.max(1)).omega.powi(2)))));
        let harmonics = &self.system.excitation.harmonics;
        let order = |k: usize| harmonics.iter().position(|own| *own as usize == k);
        let stations = self.system.chain.len();
        let torques: Vec<Option<Vec<C64>>> = (1..=h)
            .map(|k| {
                let mut torque = vec![ZERO; stations];
                self.system.torque(order(k)?, speed_rpm, &mut torque);
                Some(torque)
            })
            .collect();
        let made_of: Vec<Output> = self.quantities.iter().map(|q| Output::of(&self.system.chain, *q)).collect();
        let mut block = Block::new(&self.system.chain, self.others.len());
        let mut scalar: Option<Factored> = None;
        for first in (1..=h).step_by(LANES) {
            let motions = self.several(&mut block, &made_of, |lane| operating_at((first + lane).min(h)), &torques[first - 1..]);
            for (k, motions) in (first..=h).zip(motions) {
                let motions = match motions {
                    Some(motions) => motions,
                    None => {
                        let solver = scalar.get_or_insert_with(|| Factored::new(self.system));
                        let unbounded = || ResponseError::unbounded(self.system.excitation.orders[order(k).unwrap_or_default()], speed_rpm);
                        self.single(solver, operating_at(k), torques[k - 1].as_deref()).ok_or_else(unbounded)?
                    }
                };
                let inertial = self.ring_inertia * operating_at(k).omega.powi(2);
                linear.ring.push(-inertial / (1.0 - inertial * motions[0].1));
                linear.hub.push(motions[0]);
                linear.outputs.iter_mut().zip(&motions[1..]).for_each(|(own, motion)| own.push(*motion));
            }
        }
        Ok(linear)
    }

    /// At some frequencies together; nothing where one has to be solved with exchange of rows.
    fn several(
        &self,
        block: &mut Block,
        made_of: &[Output],
        at: impl Fn(usize) -> Operating,
        torques: &[Option<Vec<C64>>],
    ) -> [Option<Motions>; LANES] {
        let chain = &self.system.chain;
        let mut solved = |torque: &dyn Fn(usize, usize) -> C64| -> ([bool; LANES], Vec<Lane>) {
            for lane in 0..LANES {
                (block.omega[lane], block.shaft_speed[lane]) = (at(lane).omega, at(lane).shaft_speed);
                (0..chain.len()).for_each(|station| block.x[station].set(lane, torque(lane, station)));
            }
            block.solve(&chain.stations, self.others);
            let outputs = std::iter::once(block.x[self.station]).chain(made_of.iter().map(|output| output.value(chain, block))).collect();
            (block.cancelled.map(|c| c <= LARGEST_CANCELLATION), outputs)
        };
        let given = |lane: usize, station: usize| torques.get(lane).and_then(|t| Some(t.as_ref()?[station])).unwrap_or(ZERO);
        let (usable, under) = solved(&given);
        let (_, per) = solved(&|_, station| if station == self.station { C64::from(1.0) } else { ZERO });
        std::array::from_fn(|lane| {
            let motions: Motions = under.iter().zip(&per).map(|(y, by)| (y.get(lane), by.get(lane))).collect();
            (usable[lane] && motions.iter().all(|(y, by)| y.is_finite() && by.is_finite())).then_some(motions)
        })
    }

    /// At one frequency, with exchange of rows; nothing at a resonance.
    fn single(&self, solver: &mut Factored, at: Operating, torque: Option<&[C64]>) -> Option<Motions> {
        solver.factor_at(self.others, at).ok()?;
        match torque {
            Some(torque) => solver.torque.copy_from_slice(torque),
            None => solver.torque.fill(ZERO),
        }
        solver.solve_torque();
        let unit = solver.under_unit(self.station);
        let hub = (solver.angle(self.station, &solver.x), solver.angle(self.station, &unit));
        let outputs = self.quantities.iter().map(|q| (solver.output(*q, &solver.x), solver.output(*q, &unit)));
        (hub.0.is_finite() && hub.1.is_finite()).then(|| std::iter::once(hub).chain(outputs).collect())
    }
}
