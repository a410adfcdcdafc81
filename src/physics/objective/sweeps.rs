//! Sweeps of quantities over the speeds of a design, once for all its measures.

use super::design_cache::{Shared, Sweep, Swept};
use super::measure::{Measure, Over};
use super::peak_search::PeakFinder;
use super::speeds::Speeds;
use crate::absorber::Mounted;
use crate::numerics::C64;
use crate::response::{Quantity, Response, ResponseError, Work};
use std::borrow::Cow;
use std::rc::Rc;

/// Bytes of sweeps that are held for a measure; of chains with hundreds of shafts they would be gigabytes.
const HELD: usize = 128 << 20;

impl PeakFinder<'_> {
    /// How many quantities may be swept together.
    fn together(&self, speeds: &Speeds) -> usize {
        (HELD / (size_of::<C64>() * self.system.orders() * speeds.rpm.len()).max(1)).max(1)
    }

    /// A measure whose quantities count each by itself in parts that may be swept together.
    pub(super) fn turns<'m>(&self, measure: &'m Measure, speeds: &Speeds) -> Vec<Cow<'m, Measure>> {
        let most = self.together(speeds);
        if measure.over != Over::Synthesis || measure.quantities.len() <= most {
            return vec![Cow::Borrowed(measure)];
        }
        let part = |quantities: &[Quantity]| Cow::Owned(Measure { quantities: quantities.to_vec(), ..measure.clone() });
        measure.quantities.chunks(most).map(part).collect()
    }

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
            let many = shared.together.len() + measure.quantities.len() > self.together(speeds);
            let others: &[Quantity] = if measure.within.has_kinks() || many { &[] } else { &shared.together };
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
