//! Rounds of sizing until dimensions, masses and forces agree.

use super::bodies::Body;
use super::crank::ThrowLoads;
use super::cycle::Cycle;
use super::failure::{LOOSE, MOST_ROUNDS, SizingError, TOLERANCE};
use super::fit;
use super::load_cases::loads;
use super::round::{Before, Round, round};
use super::section::Notch;
use super::specification::{Specification, TorqueCase};

/// From this round on a diameter stays on its side of a jump of the size factor: a smaller one may hold with the notch factor of the larger, but not with its own.
const STAYING: usize = 20;
/// Largest dimension, in bores: what grows beyond it grows without limit.
const LARGEST: f64 = 1e3;

/// A slider-crank that agrees with itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Sized {
    /// All rounds, the last one as it is.
    pub rounds: Vec<Round>,
    /// Forces of the last round: firing at each speed, then driven at the highest.
    pub cycles: Vec<Cycle>,
    /// Loads of all throws in each of these cycles.
    pub throws: Vec<Vec<ThrowLoads>>,
}

impl Sized {
    /// Adds a round with the masses and notches of the last one, and says how much changed, relative. Without `torque` the crank is rigid in torsion; with it
    /// torques are what it says, a case a speed.
    ///
    /// # Errors
    /// [`SizingError`] where no dimensions hold.
    pub fn next(&mut self, spec: &Specification, torque: Option<&[TorqueCase]>) -> Result<f64, SizingError> {
        let before = self.rounds.last();
        let (rod_body, notches) = before.map_or((Body::default(), [Notch::NONE; 2]), |r| (r.rod, [r.crankpin_notch, r.journal_notch]));
        let staying = before.filter(|_| self.rounds.len() >= STAYING);
        let first = staying.map_or([0.0; 2], |r| [r.sizes.crankpin_diameter, r.sizes.journal_diameter]);
        let loads = loads(spec, &rod_body, torque);
        let round = round(spec, &loads, Before { notches, first })?;
        if let Some((dimension, value)) = round.sizes.named().into_iter().find(|(_, v)| v.is_nan() || *v > LARGEST * spec.bore) {
            return Err(SizingError::Diverges { dimension, value, round: self.rounds.len() + 1 });
        }
        let change = before.map_or(f64::INFINITY, |b| b.change_to(&round));
        self.rounds.push(round);
        (self.cycles, self.throws) = loads;
        Ok(change)
    }

    /// The last round.
    ///
    /// # Panics
    /// Never: there is at least one.
    pub fn last(&self) -> &Round {
        &self.rounds[self.rounds.len() - 1]
    }
}

/// Sizes a slider-crank that is rigid in torsion: torques are those of gas and masses.
///
/// # Errors
/// [`SizingError`] where no dimensions hold or rounds do not settle.
pub fn size(spec: &Specification) -> Result<Sized, SizingError> {
    let mut sized = Sized { rounds: Vec::new(), cycles: Vec::new(), throws: Vec::new() };
    for round in 1..=MOST_ROUNDS {
        let tolerance = if round < MOST_ROUNDS { TOLERANCE } else { LOOSE };
        if sized.next(spec, None)? < tolerance {
            fit::check(spec, &sized.last().sizes)?;
            return Ok(sized);
        }
    }
    let change = sized.rounds.windows(2).last().map_or(f64::INFINITY, |r| r[0].change_to(&r[1]));
    Err(SizingError::NotConverged { change })
}
