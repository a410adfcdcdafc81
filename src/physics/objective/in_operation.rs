//! The absorbers of a design as they are in operation: at every speed a law of its own.

use super::condition::Condition;
use super::peak_search::PeakFinder;
use crate::absorber::{Absorber, Law, Material, Mounted, varying};
use crate::drivetrain::System;
use crate::numerics::synthesis::Synthesiser;
use crate::response::operation::{AtSpeed, Follower, Rule};
use crate::response::{Direct, Grid, Hosts, ResponseError};
use crate::units::RAD_PER_S_PER_RPM;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// What the law of an absorber in operation needs to find its state at any speed.
struct InOperation {
    system: System,
    grid: Grid,
    synthesiser: Synthesiser,
    design: Vec<Mounted>,
    index: usize,
    /// Of the reference.
    law: Arc<dyn Law>,
    known: Mutex<HashMap<u64, Arc<dyn Law>>>,
    hosts: Option<Arc<Hosts>>,
}

impl InOperation {
    /// Of a design; `None` where none of its materials follows its motion.
    fn of(finder: &PeakFinder, design: &[Mounted]) -> Option<Self> {
        let Follower { index, law, .. } = Follower::of(design, Material::follows_motion)?;
        Some(Self {
            system: finder.system.clone(),
            grid: finder.grid.clone(),
            synthesiser: finder.synthesiser.clone(),
            design: design.to_vec(),
            index,
            law,
            known: Mutex::default(),
            hosts: finder.hosts(design),
        })
    }

    /// The design with the law that is another one at every speed.
    fn mounted(self, design: &[Mounted]) -> Vec<Mounted> {
        let mut design = design.to_vec();
        let index = self.index;
        design[index].absorber = Absorber::Ring(varying(self.law.clone(), move |shaft_speed| self.law_at(shaft_speed)));
        design
    }

    /// The law at a speed, `index` in the grid where it is one of it.
    fn find(&self, speed_rpm: f64, index: Option<usize>) -> Result<Arc<dyn Law>, ResponseError> {
        let direct = Direct::new(&self.system, &self.grid);
        let of = Follower { design: &self.design, index: self.index, law: self.law.clone() };
        let at = AtSpeed::new((&direct, &self.synthesiser), &of, Rule::HalfPeakToPeak, speed_rpm, self.hosts.as_deref().zip(index));
        at.at(at.celsius()?)
    }

    /// The law at a speed, found once; beyond those of the grid it is that at their end. Where nothing damps a resonance it is that of the reference, whose response says so.
    fn law_at(&self, shaft_speed: f64) -> Arc<dyn Law> {
        let ends = [0, self.grid.len() - 1].map(|i| self.grid.speed_rpm[i] * RAD_PER_S_PER_RPM);
        let shaft_speed = shaft_speed.clamp(ends[0], ends[1]);
        let known = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(law) = known().get(&shaft_speed.to_bits()) {
            return law.clone();
        }
        let law = self.find(shaft_speed / RAD_PER_S_PER_RPM, None).unwrap_or_else(|_| self.law.clone());
        known().insert(shaft_speed.to_bits(), law.clone());
        law
    }
}

/// The absorbers of a design in a condition; in operation, each speed has its own temperature and strain.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance.
#[doc(hidden)]
pub fn absorbers(condition: Condition, finder: &PeakFinder, design: &[Mounted]) -> Result<Vec<Mounted>, ResponseError> {
    let (Condition::InOperation, Some(own)) = (condition, InOperation::of(finder, design)) else { return Ok(condition.absorbers(design)) };
    // all speeds of the grid at once, by all threads
    let speeds = &finder.grid.speed_rpm;
    let laws = speeds.par_iter().enumerate().map(|(i, speed)| own.find(*speed, Some(i))).collect::<Result<Vec<_>, _>>()?;
    let keys = speeds.iter().map(|speed| (speed * RAD_PER_S_PER_RPM).to_bits());
    *own.known.lock().unwrap_or_else(PoisonError::into_inner) = keys.zip(laws).collect();
    Ok(own.mounted(design))
}

/// The same where only a few speeds are asked for: the state at a speed is found when it is.
pub(crate) fn absorbers_at_few_speeds(condition: Condition, finder: &PeakFinder, design: &[Mounted]) -> Vec<Mounted> {
    match (condition, InOperation::of(finder, design)) {
        (Condition::InOperation, Some(own)) => own.mounted(design),
        _ => condition.absorbers(design),
    }
}
