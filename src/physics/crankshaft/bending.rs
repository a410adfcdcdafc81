//! Local bending stress of every location over the working cycle, at every speed of a sweep.

use super::loads::{CrankLoads, CrankModel, InPlane, STRIDE, Section as History};
use super::{Crank, CriticalLocation, Family, Place};
use crate::drivetrain::Chain;
use crate::engine::Engine;
use crate::engine::cycle::ThrowLoads;
use crate::fatigue::Cycle;
use hartog_kernel::kernel;
use rayon::prelude::*;

/// What no absorber changes, in rows by speed.
#[derive(Debug, Default)]
pub struct Table {
    /// Local bending stress of the locations that have one, Pa.
    pub bending: Vec<Vec<Cycle>>,
    /// Column of each location; none of those with stresses per unit load.
    pub columns: Vec<Option<usize>>,
    /// Mean torque of every shaft, N m.
    pub mean_torque: Vec<Vec<f64>>,
    /// Loads of the front and rear web of every throw over the cycle, where histories are asked for.
    pub histories: Vec<Vec<History>>,
}

/// Loads of all webs over the cycle at a speed (its index), in the place of those of a continuous beam: front and rear of every throw, [`OTHER_STRIDE`] samples of the pressure apart.
pub type OtherWebs<'a> = &'a (dyn Fn(usize) -> Vec<InPlane> + Sync);

/// Every so many samples of the pressure, 0.5° apart: half a step beside its top a wave of order 10 is 1e-3 below it.
pub(crate) const OTHER_STRIDE: usize = 5;

/// Every so many samples of the pressure are enough for histories: 1° apart.
const APART: usize = 10;

/// The table. Nothing where the torque comes from a table.
pub fn table(
    (engine, chain, crank): (&Engine, &Chain, &Crank),
    locations: &[CriticalLocation],
    (speeds_rpm, others): (&[f64], Option<OtherWebs>),
    with_histories: bool,
) -> Option<Table> {
    let model = CrankModel::new(engine, crank)?;
    let mut numbers = 0..;
    let column = |l: &CriticalLocation| if l.unit_loads.is_none() { numbers.next() } else { None };
    let columns: Vec<Option<usize>> = locations.iter().map(column).collect();
    let count = columns.iter().flatten().count();
    // locations of one section share its loads
    let mut sections: Vec<(Section, Vec<usize>)> = Vec::new();
    for (i, location) in locations.iter().enumerate() {
        let section = Section::of(location);
        match sections.iter_mut().find(|s| s.0 == section) {
            Some(known) => known.1.push(i),
            None => sections.push((section, vec![i])),
        }
    }
    let stride = if others.is_some() { OTHER_STRIDE } else { STRIDE };
    let row = |place: &mut ThrowLoads, (i, speed): (usize, &f64)| {
        let others = others.map(|of| of(i));
        let other = |throw: usize, rear: bool| others.as_ref().map(|all| all[2 * throw + usize::from(rear)].clone());
        let loads = model.in_place_of(std::mem::take(place), *speed);
        let mut local = vec![Cycle { amplitude: 0.0, mean: 0.0 }; count];
        let mut webs = vec![None; if with_histories { 2 * crank.throws() } else { 0 }];
        for (section, own) in &sections {
            let replaced = if let Section::Web(throw, rear) = section { other(*throw, *rear) } else { None };
            let in_plane = replaced.unwrap_or_else(|| section.loads(crank, &loads));
            for (i, column) in own.iter().filter_map(|i| Some((*i, columns[*i]?))) {
                local[column] = stress(&locations[i], &in_plane);
            }
            if let (true, Section::Web(throw, rear)) = (with_histories, section) {
                webs[2 * throw + usize::from(*rear)] = Some(history(&in_plane, stride));
            }
        }
        let missing = |(i, known): (usize, Option<History>)| {
            known.unwrap_or_else(|| history(&other(i / 2, i % 2 == 1).unwrap_or_else(|| loads.web(i / 2, i % 2 == 1)), stride))
        };
        let webs = webs.into_iter().enumerate().map(missing).collect();
        let mean_torque = mean_torque(chain, &loads);
        *place = loads.place();
        (local, mean_torque, webs)
    };
    // loads of one speed take the place of the last: they are large
    let rows: Vec<_> = speeds_rpm.par_iter().enumerate().map_init(ThrowLoads::default, row).collect();
    let mut table = Table { columns, ..Table::default() };
    for (bending, mean_torque, histories) in rows {
        table.bending.push(bending);
        table.mean_torque.push(mean_torque);
        table.histories.push(histories);
    }
    Some(table)
}

/// Of loads so many samples of the pressure apart.
fn history(section: &InPlane, stride: usize) -> History {
    [&section.moment, &section.tangential, &section.shear].map(|load| load.iter().step_by(APART / stride).copied().collect())
}

/// A section of the crank, and how its loads are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Section {
    /// A web (front, rear) of the crank on all its bearings.
    Web(usize, bool),
    /// A web of one throw on its own bearings.
    OwnWeb(usize, bool),
    /// The middle of the crankpin of such a throw.
    OwnPin(usize),
}

impl Section {
    fn of(location: &CriticalLocation) -> Self {
        match (location.family, location.place) {
            // the rule has no other bending for the middle of the pin
            (_, Place::OilBore) => Self::OwnPin(location.throw),
            (Family::Rule, _) => Self::OwnWeb(location.throw, location.rear),
            (Family::Nominal | Family::UnitLoads | Family::RuleContinuous, _) => Self::Web(location.throw, location.rear),
        }
    }

    fn loads(self, crank: &Crank, loads: &CrankLoads) -> InPlane {
        let determinate_at = |throw: usize, which: usize| loads.determinate(throw, crank.places(throw)[which] - crank.bearings()[throw]);
        match self {
            Self::Web(throw, rear) => loads.web(throw, rear),
            Self::OwnWeb(throw, rear) => determinate_at(throw, if rear { 2 } else { 0 }),
            Self::OwnPin(throw) => determinate_at(throw, 1),
        }
    }
}

fn stress(location: &CriticalLocation, own: &InPlane) -> Cycle {
    let (low, high) = range([&own.moment, &own.tangential, &own.shear], [location.bending[0], location.bending[1], location.radial]);
    Cycle { amplitude: 0.5 * (high - low), mean: 0.5 * (high + low) }
}

/// Smallest and largest value of a weighted sum of rows.
#[kernel]
fn range(rows: [&[f64]; 3], weights: [f64; 3]) -> (f64, f64) {
    const LANES: usize = 16;
    let sum = |x: f64, y: f64, z: f64| weights[0] * x + weights[1] * y + weights[2] * z;
    let [x, y, z] = rows.map(|row| row.as_chunks::<LANES>());
    // the same operation for both ends: compilers mix up lanes of different ones
    let (mut low, mut high) = ([f64::NEG_INFINITY; LANES], [f64::NEG_INFINITY; LANES]);
    for ((x, y), z) in x.0.iter().zip(y.0).zip(z.0) {
        for l in 0..LANES {
            let v = sum(x[l], y[l], z[l]);
            low[l] = if -v > low[l] { -v } else { low[l] };
            high[l] = if v > high[l] { v } else { high[l] };
        }
    }
    let rest = x.1.iter().zip(y.1).zip(z.1).map(|((x, y), z)| sum(*x, *y, *z));
    let wider = |m: (f64, f64), v: (f64, f64)| (if v.0 < m.0 { v.0 } else { m.0 }, if v.1 > m.1 { v.1 } else { m.1 });
    low.map(|v| -v).into_iter().zip(high).chain(rest.map(|v| (v, v))).fold((f64::INFINITY, f64::NEG_INFINITY), wider)
}

/// Mean torque in every shaft. What the engine delivers leaves at the end of the chain with the flywheel, the heavier one: before that, a shaft carries the
/// torque of all throws on its other side.
fn mean_torque(chain: &Chain, loads: &CrankLoads) -> Vec<f64> {
    let mut sum = 0.0;
    let mean = |throw: &usize| loads.torque[*throw].iter().sum::<f64>() / loads.theta.len() as f64;
    let mut shafts = Vec::new();
    for station in &chain.stations {
        sum += station.throws.iter().map(mean).sum::<f64>();
        shafts.push(sum);
    }
    shafts.pop();
    let heavier_first = chain.stations.first().zip(chain.stations.last()).is_some_and(|(first, last)| first.inertia > last.inertia);
    if heavier_first {
        shafts.iter_mut().for_each(|s| *s -= sum);
    }
    shafts
}
