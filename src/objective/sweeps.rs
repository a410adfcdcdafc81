//! Sweeps of quantities over the speeds of a design, once for all its measures.

use super::measure::Measure;
use super::peak_search::PeakFinder;
use super::shared::{Shared, Sweep, Swept};
use super::speeds::Speeds;
use crate::absorber::Mounted;
use crate::numerics::C64;
use crate::response::{Quantity, Response, ResponseError, Work};
use std::rc::Rc;

impl PeakFinder<'_> {
    /// Speeds of a design for a measure.
    pub(super) fn speeds_for(&self, design: &[Mounted], measure: &Measure, shared: &Shared) -> Speeds {
        shared.speeds.get_or_init(|| self.speeds(design)).clone().with_kinks(measure.within.kinks())
    }

    /// Sweeps of the quantities of a measure, those that other measures need with them.
    pub(super) fn swept(
        &self,
        design: &[Mounted],
        measure: &Measure,
        speeds: &Speeds,
        shared: &Shared,
        work: &mut Work,
    ) -> Result<Vec<Sweep>, ResponseError> {
        let mut all = shared.swept.borrow_mut();
        let known = all.iter().position(|s| s.speeds_rpm == speeds.rpm).unwrap_or_else(|| {
            all.push(Swept { speeds_rpm: speeds.rpm.clone(), sweeps: Vec::new() });
            all.len() - 1
        });
        let own = &mut all[known].sweeps;
        if measure.quantities.iter().any(|q| own.iter().all(|s| s.0 != *q)) {
            let others: &[Quantity] = if measure.within.has_kinks() { &[] } else { &shared.together };
            let there = |q: &Quantity| !matches!(q, Quantity::RingTwist(i) if *i >= design.len());
            let mut missing: Vec<Quantity> = Vec::new();
            for quantity in measure.quantities.iter().chain(others).filter(|q| there(q)) {
                if !missing.contains(quantity) && own.iter().all(|s| s.0 != *quantity) {
                    missing.push(*quantity);
                }
            }
            let sweeps = self.sweeps(design, &missing, speeds, work)?;
            own.extend(missing.into_iter().zip(sweeps.into_iter().map(Rc::new)));
        }
        let sweep = |q: &Quantity| own.iter().find(|s| s.0 == *q).map(|s| s.1.clone());
        Ok(measure.quantities.iter().filter_map(sweep).collect())
    }

    fn sweeps(
        &self,
        design: &[Mounted],
        quantities: &[Quantity],
        speeds: &Speeds,
        work: &mut Work,
    ) -> Result<Vec<Vec<C64>>, ResponseError> {
        let grid = self.method.sweep_each(design, quantities, work)?;
        if speeds.added.is_empty() {
            return Ok(grid);
        }
        let added = self.direct.at_each(design, quantities, &speeds.added_rpm(), work)?;
        Ok(grid.into_iter().zip(added).map(|(g, a)| speeds.merge(g, &a, self.system.orders())).collect())
    }
}
