//! A flexible crank without absorbers at speeds that most designs of a search are asked for: those beside its own sharp resonances, which no absorber moves.

use crate::drivetrain::{FlexibleCrank, System};
use crate::numerics::tridiagonal::Singular;
use crate::numerics::{C64, ZERO};
use std::collections::HashMap;
use std::sync::{Arc, PoisonError, RwLock};

/// Numbers that are kept at most, 32 MB: what comes later is solved each time it is asked for.
const MOST: usize = 1 << 21;

/// What is asked: answers of the crank, and the stations with absorbers.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(super) struct Wanted {
    /// Angles of stations, then torques of shafts.
    pub rows: Arc<[usize]>,
    pub stations: Vec<usize>,
}

/// Answers at all orders of a speed, order after order: under the forces of the engine, then under a unit torque on each of the stations; those that are asked for alone.
pub(super) type AtSpeed = Arc<[C64]>;

/// Answers by what is asked and the speed (its bits).
#[derive(Debug, Default)]
pub(super) struct KnownPoints {
    known: RwLock<HashMap<Wanted, HashMap<u64, AtSpeed>>>,
}

impl Wanted {
    /// How many numbers an order has.
    pub fn len(&self) -> usize {
        self.rows.len() * (1 + self.stations.len())
    }

    /// Answers under the forces of the engine from those of an order; zero where they are not asked for.
    pub(super) fn under_load(&self, known: &[C64], answers: usize) -> Vec<C64> {
        self.whole(0, known, answers)
    }

    /// The same under a unit torque on a station.
    pub(super) fn under_unit(&self, station: usize, known: &[C64], answers: usize) -> Vec<C64> {
        self.stations.iter().position(|s| *s == station).map_or_else(Vec::new, |place| self.whole(1 + place, known, answers))
    }

    /// Answers that are asked for with absorbers on one station, numerator and denominator of their sum, as [`super::flexible_point::Absorbers`] puts them on: y = y0 - h N q, in place.
    pub(super) fn with_one(
        &self,
        (station, numerator, denominator): (usize, C64, C64),
        known: &[C64],
        x: &mut [C64],
    ) -> Result<(), Singular> {
        let place = self.stations.iter().position(|s| *s == station).ok_or(Singular { row: 0 })?;
        let own = self.rows.iter().position(|r| *r == station).ok_or(Singular { row: 0 })?;
        let (under_load, under_unit) = (known, &known[(1 + place) * self.rows.len()..]);
        let element = under_unit[own] * numerator + denominator;
        if element == ZERO {
            return Err(Singular { row: 0 });
        }
        let q = under_load[own] / element;
        let factor = numerator * q;
        self.rows.iter().zip(under_load.iter().zip(under_unit)).for_each(|(row, (y, h))| x[*row] = y - h * factor);
        x[station] = q;
        Ok(())
    }

    fn whole(&self, load: usize, known: &[C64], answers: usize) -> Vec<C64> {
        let mut all = vec![ZERO; answers];
        self.rows.iter().zip(&known[load * self.rows.len()..]).for_each(|(row, y)| all[*row] = *y);
        all
    }

    fn at(&self, system: &System, crank: &FlexibleCrank, speed_rpm: f64) -> Result<AtSpeed, usize> {
        let mut all = Vec::with_capacity(self.len() * system.orders());
        for order in 0..system.orders() {
            let singular = |_| order;
            let point = crank.at((order, speed_rpm), Some(self.rows.clone())).map_err(singular)?;
            let mut put = |answers: Vec<C64>| all.extend(self.rows.iter().map(|r| answers[*r]));
            put(crank.under_load(&point, &system.excitation));
            for station in &self.stations {
                put(crank.under_unit(&point, *station).map_err(singular)?);
            }
        }
        Ok(all.into())
    }
}

impl KnownPoints {
    /// Answers at a speed, kept from now on while there is room; the index of the order that has none at an undamped resonance.
    pub fn at(&self, (system, crank): (&System, &FlexibleCrank), wanted: &Wanted, speed_rpm: f64) -> Result<AtSpeed, usize> {
        let bits = speed_rpm.to_bits();
        let known = self.known.read().unwrap_or_else(PoisonError::into_inner).get(wanted).and_then(|own| own.get(&bits).cloned());
        if let Some(known) = known {
            return Ok(known);
        }
        let found = wanted.at(system, crank, speed_rpm)?;
        let mut all = self.known.write().unwrap_or_else(PoisonError::into_inner);
        let kept: usize = all.iter().map(|(wanted, own)| wanted.len() * system.orders() * own.len()).sum();
        if kept + found.len() <= MOST {
            all.entry(wanted.clone()).or_default().insert(bits, found.clone());
        }
        Ok(found)
    }
}
