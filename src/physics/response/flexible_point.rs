//! A flexible crank with absorbers at one order and speed: what it does without them is known, they are a change of their number of stations in rank.
//!
//! With u0 the angles of their stations and y0 any answer without them, H the receptances between the stations, h the answers per unit torque there and N/D the dynamic stiffness of all absorbers of
//! a station: (D + H N) q = u0 with q the angles over D, and y = y0 - h N q, exactly.

use crate::drivetrain::flexible::CrankPoint;
use crate::drivetrain::{FlexibleCrank, System};
use crate::numerics::tridiagonal::Singular;
use crate::numerics::{C64, ZERO};
use nalgebra::{DMatrix, DVector, Dyn, LU};
use std::sync::Arc;

/// A point with its absorbers.
pub(super) struct FlexiblePoint<'a> {
    crank: &'a FlexibleCrank,
    point: CrankPoint,
    absorbers: Absorbers,
}

/// What absorbers change at an order and a speed.
pub(super) struct Absorbers {
    /// Stations with absorbers and the numerators of their sums.
    stations: Vec<(usize, C64)>,
    /// Answers per unit torque on each of them.
    columns: Vec<Vec<C64>>,
    factors: Factors,
}

/// D + H N, factored.
enum Factors {
    /// Of no station or one.
    One(C64),
    Many(LU<C64, Dyn, Dyn>),
}

impl<'a> FlexiblePoint<'a> {
    /// At an order and a speed with the sums of the absorbers on each station, numerators and denominators; `rows`: answers that are asked for, those of these stations among them.
    pub(super) fn new(
        crank: &'a FlexibleCrank,
        at: (usize, f64),
        sums: &[(usize, C64, C64)],
        rows: Option<Arc<[usize]>>,
    ) -> Result<Self, Singular> {
        let point = crank.at(at, rows)?;
        let columns = sums.iter().map(|s| crank.under_unit(&point, s.0)).collect::<Result<Vec<_>, _>>()?;
        Ok(Self { crank, point, absorbers: Absorbers::new(sums, columns)? })
    }

    /// Unknowns under the forces of an engine: angles of stations (over the denominators of their absorbers), then torques of shafts.
    pub(super) fn under_load(&self, system: &System) -> Result<Vec<C64>, Singular> {
        self.absorbers.put_on(self.crank.under_load(&self.point, &system.excitation))
    }

    /// The same under a unit torque on a station.
    pub(super) fn under_unit(&self, station: usize) -> Result<Vec<C64>, Singular> {
        let known = self.absorbers.stations.iter().position(|s| s.0 == station);
        self.absorbers.put_on(match known {
            Some(k) => self.absorbers.columns[k].clone(),
            None => self.crank.under_unit(&self.point, station)?,
        })
    }
}

impl Absorbers {
    /// Of their sums on each station (numerators and denominators) and the answers per unit torque there.
    pub(super) fn new(sums: &[(usize, C64, C64)], columns: Vec<Vec<C64>>) -> Result<Self, Singular> {
        let n = sums.len();
        let element = |i: usize, k: usize| columns[k][sums[i].0] * sums[k].1 + if i == k { sums[i].2 } else { ZERO };
        let factors = match n {
            0 => Factors::One(C64::from(1.0)),
            1 => Factors::One(element(0, 0)),
            _ => Factors::Many(DMatrix::from_fn(n, n, element).lu()),
        };
        if matches!(&factors, Factors::One(x) if *x == ZERO) {
            return Err(Singular { row: 0 });
        }
        Ok(Self { stations: sums.iter().map(|s| (s.0, s.1)).collect(), columns, factors })
    }

    /// Answers with them, of those without.
    pub(super) fn put_on(&self, mut y: Vec<C64>) -> Result<Vec<C64>, Singular> {
        let Some((first, numerator)) = self.stations.first() else { return Ok(y) };
        let q = match &self.factors {
            Factors::One(element) => {
                let q = y[*first] / element;
                let factor = numerator * q;
                y.iter_mut().zip(&self.columns[0]).for_each(|(y, h)| *y -= h * factor);
                y[*first] = q;
                return Ok(y);
            }
            Factors::Many(factors) => {
                let base = DVector::from_fn(self.stations.len(), |k, _| y[self.stations[k].0]);
                factors.solve(&base).ok_or(Singular { row: 0 })?
            }
        };
        for ((column, (_, numerator)), q) in self.columns.iter().zip(&self.stations).zip(q.iter()) {
            let factor = numerator * q;
            y.iter_mut().zip(column).for_each(|(y, h)| *y -= h * factor);
        }
        self.stations.iter().zip(q.iter()).for_each(|((station, _), q)| y[*station] = *q);
        Ok(y)
    }
}
