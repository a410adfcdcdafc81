//! What no combination within tolerances is worse than: branch and bound over speeds and deviations together.
//!
//! Over a box of both a phasor is linear but for a bound of the rest ([`AboutFrequency`]). Half the range of a sum of orders, an amplitude and a root mean square are norms: of linear phasors they are largest in a corner of the
//! box, and the rest adds no more than its own. The box whose bound is highest is cut first.

use super::asked::has_enclosure;
use super::verdict::Effort;
use crate::absorber::{Mounted, OperatingOver};
use crate::numerics::C64;
use crate::numerics::ranked::{ByRank, Ranked};
use crate::numerics::synthesis::bound;
use crate::numerics::taylor::{MOST, Taylor};
use crate::objective::{Condition, Measure, Over, PeakFinder};
use crate::optimise::{LoadCase, Tolerances};
use crate::response::Quantity;
use crate::response::about_frequency::{AboutFrequency, Change};
use crate::response::factored::Factored;
use crate::response::tangent::Parabola;
use rayon::prelude::*;
use std::collections::BinaryHeap;

/// Boxes that are cut together.
const TOGETHER: usize = 64;
/// Share of a value that rounding of direct solutions may hide.
const ROUNDED: f64 = 1e-9;

/// What no combination within tolerances is above.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct WorstBound {
    /// In the unit of the measure.
    pub value: f64,
    /// Boxes of speeds and deviations that were looked at.
    pub boxes: u64,
}

/// A range of speeds, rpm, and of each factor or amount.
#[derive(Debug, Clone)]
struct Region {
    speeds: (f64, f64),
    ranges: Vec<(f64, f64)>,
}

/// A box that may hold something worse.
struct Cell {
    own: Region,
    upper: f64,
    /// The variable along which it is cut: zero is the speed.
    along: usize,
    part: usize,
    age: u64,
}

impl Ranked for Cell {
    /// That with the highest bound is cut first.
    fn rank(&self) -> (f64, u64) {
        (self.upper, self.age)
    }
}

struct Search<'a> {
    finder: &'a PeakFinder<'a>,
    /// As drawn.
    design: Vec<Mounted>,
    tolerances: &'a Tolerances,
    measure: &'a Measure,
    quantities: Vec<Quantity>,
    torques: Vec<Parabola>,
    target: f64,
}

/// What a measure of a design is nowhere above within tolerances, in all load cases, as close to `worst` as the gap where the boxes suffice; `None` where it has no such bound (of other measures than sums of orders, single ones
/// and root mean squares; where peaks are not refined between speeds; of flexible cranks, beside very stiff shafts, of absorbers on rings or without an enclosure, of states in operation, of more than five tolerances or where one leads past the range of a parameter), and where the boxes do not suffice for any.
#[doc(hidden)]
pub fn worst_bound(
    cases: &[LoadCase],
    design: &[Mounted],
    tolerances: &Tolerances,
    (measure, worst): (&Measure, f64),
    effort: Effort,
) -> Option<WorstBound> {
    let is_norm = matches!(measure.over, Over::Synthesis | Over::Orders | Over::Order(_) | Over::Statistic(_));
    if !is_norm || tolerances.edges() >= MOST || !worst.is_finite() || effort.boxes == 0 {
        return None;
    }
    let mut all = WorstBound { value: 0.0, boxes: 0 };
    for case in cases {
        if case.condition == Condition::InOperation || case.deviation.is_some() || !case.finder.refine {
            return None;
        }
        let design = case.absorbers(design).ok()?;
        if !design.iter().all(|m| m.absorber.law().is_none_or(has_enclosure)) {
            return None;
        }
        let is_there = |q: &Quantity| !matches!(q, Quantity::RingTwist(i) if *i >= design.len());
        let quantities = measure.quantities.iter().copied().filter(is_there).collect();
        let target = worst * (1.0 + effort.gap);
        let mut search = Search { finder: case.finder, design, tolerances, measure, quantities, torques: Vec::new(), target };
        search.run(effort.boxes, &mut all)?;
    }
    Some(WorstBound { value: all.value * (1.0 + ROUNDED), ..all })
}

impl Search<'_> {
    fn run(&mut self, most: u64, all: &mut WorstBound) -> Option<()> {
        let ranges: Vec<(f64, f64)> = self.tolerances.ranges().map(|edge| edge.3).collect();
        let mut open = BinaryHeap::new();
        for speeds in self.finder.without_kinks(self.measure) {
            self.torques.push(self.finder.torque_about(speeds));
            all.boxes += 1;
            open.push(ByRank(self.looked_at(Region { speeds, ranges: ranges.clone() }, self.torques.len() - 1, all.boxes)?));
        }
        while all.boxes < most && open.peek().is_some_and(|cell| cell.0.upper > self.target) {
            let cut: Vec<Cell> = (0..TOGETHER).map_while(|_| Some(open.pop()?.0)).collect();
            let halves: Vec<(Region, usize)> = cut.iter().flat_map(|cell| cell.halves().map(|half| (half, cell.part))).collect();
            let age = all.boxes;
            all.boxes += halves.len() as u64;
            let look = |(i, (half, part)): (usize, (Region, usize))| self.looked_at(half, part, age + i as u64);
            open.extend(halves.into_par_iter().enumerate().map(look).collect::<Option<Vec<Cell>>>()?.into_iter().map(ByRank));
        }
        all.value = open.peek().map_or(all.value, |cell| f64::max(all.value, cell.0.upper));
        all.value.is_finite().then_some(())
    }

    /// `None` where there is no enclosure at all.
    fn looked_at(&self, own: Region, part: usize, age: u64) -> Option<Cell> {
        let middle: Vec<f64> = own.ranges.iter().map(|r| 0.5 * (r.0 + r.1)).collect();
        let design = self.tolerances.built(&middle).of(&self.design);
        let values = self.values(&own)?;
        let system = self.finder.system;
        let mut solver = Factored::new(system);
        let mut models = vec![vec![Taylor::constant(C64::default()); system.orders()]; self.quantities.len()];
        let (speed, width) = (0.5 * (own.speeds.0 + own.speeds.1), own.speeds.1 - own.speeds.0);
        let mut by_speed = 0.0;
        let too_large = |own, along| Some(Cell { own, upper: f64::INFINITY, along, part, age });
        for order in (0..system.orders()).filter(|n| self.torques[part].acts(*n)) {
            let Some(about) = AboutFrequency::interval(&mut solver, (system, &design), (order, speed, width)) else {
                return too_large(own, 0);
            };
            let changes = self.changes(&design, &values, about.band())?;
            let Some(outputs) = about.changed(&self.quantities, &self.torques[part], &changes) else {
                return too_large(own.clone(), widest(&own));
            };
            let (outputs, before) = outputs;
            by_speed += before;
            models.iter_mut().zip(outputs).for_each(|(models, y)| models[order] = y);
        }
        if !models.iter().flatten().all(Taylor::is_finite) {
            return too_large(own, 0);
        }
        let mut spread = [0.0; MOST];
        for y in models.iter().flatten() {
            spread.iter_mut().zip(&y.slopes).for_each(|(sum, g)| *sum += g.norm());
        }
        // what is linear is taken into account: what counts is whether the rest comes from speed or from deviations
        let rest: f64 = models.iter().flatten().map(|y| y.rest).sum();
        let along = if 2.0 * by_speed > rest { 0 } else { largest(&spread) };
        let weights = [own.speeds.0, own.speeds.1].map(|s| self.measure.within.weight(s));
        let upper = models.iter().map(|y| self.over_box(y, own.ranges.len(), weights)).fold(0.0, f64::max);
        Some(Cell { own, upper, along, part, age })
    }

    /// What laws and inertias of a box are more than those in its middle; `None` where they have no enclosure.
    fn changes(&self, middle: &[Mounted], values: &[Vec<Taylor>], band: OperatingOver) -> Option<Vec<Change>> {
        let mut changes = Vec::new();
        for (i, (m, values)) in middle.iter().zip(values).enumerate() {
            let (Some(law), Some(drawn)) = (m.absorber.law(), self.design[i].absorber.law()) else { continue };
            if values.iter().all(|v| v.slopes.iter().all(|g| *g == C64::default())) {
                continue;
            }
            let own: Vec<Taylor> = law.values().into_iter().map(number).collect();
            let (all, inertia) = (drawn.over(values, &band)?, drawn.ring_over(values));
            let more = all.minus(&law.over(&own, &band)?);
            changes.push(Change::Law(i, more));
            let heavier = inertia.plus_number(C64::from(-law.ring_inertia()));
            if inertia.slopes.iter().any(|g| *g != C64::default()) {
                changes.push(Change::Inertia(i, band.omega.times(&band.omega).times(&heavier).times_number(C64::from(-1.0))));
            }
        }
        Some(changes)
    }

    /// Values of all parameters over a box, the deviations the second and further variables.
    fn values(&self, own: &Region) -> Option<Vec<Vec<Taylor>>> {
        let laws = || self.design.iter().map(|m| m.absorber.law());
        let mut values: Vec<Vec<Taylor>> =
            laws().map(|law| law.map_or_else(Vec::new, |law| law.values().into_iter().map(number).collect())).collect();
        for (edge, ((absorber, parameters, is_amount, range), own)) in self.tolerances.ranges().zip(&own.ranges).enumerate() {
            let Some(law) = self.design.get(absorber).and_then(|m| m.absorber.law()) else { continue };
            let change = Taylor::between(own.0, own.1, edge + 1);
            for p in parameters {
                let (drawn, allowed) = (law.values()[*p], law.declaration().parameters[*p].range);
                if drawn == 0.0 {
                    continue;
                }
                let built = |x: f64| if is_amount { drawn + x } else { drawn * x };
                if [range.0, range.1].iter().any(|x| allowed.nearest(built(*x)) != built(*x)) {
                    return None;
                }
                // of several that change one parameter each
                let others = &values[absorber][*p];
                values[absorber][*p] = if is_amount { change.plus(others) } else { change.times(others) };
            }
        }
        Some(values)
    }

    /// The largest of a quantity over a box, at most, times what it counts at either end; no closer than tells that it is not above the target.
    fn over_box(&self, models: &[Taylor], edges: usize, weights: [f64; 2]) -> f64 {
        let heaviest = f64::max(weights[0], weights[1]);
        let rests: Vec<C64> = models.iter().map(|y| C64::from(y.rest)).collect();
        let reaches: Vec<C64> =
            models.iter().map(|y| C64::from(y.centre.norm() + y.slopes.iter().map(|g| g.norm()).sum::<f64>() + y.rest)).collect();
        let rough = self.at_most(&reaches) * heaviest;
        if rough <= self.target {
            return rough;
        }
        let by_rest = self.at_most(&rests);
        let corner = |bits: usize| {
            let at =
                |y: &Taylor| (0..=edges).fold(y.centre, |sum, d| if bits >> d & 1 == 1 { sum + y.slopes[d] } else { sum - y.slopes[d] });
            let phasors: Vec<C64> = models.iter().map(at).collect();
            let weight = weights[bits & 1];
            let most = (self.at_most(&phasors) + by_rest) * weight;
            if most <= self.target { most } else { (self.exact(&phasors) + by_rest) * weight }
        };
        (0..1usize << (edges + 1)).map(corner).fold(0.0, f64::max)
    }

    /// The norm of some phasors.
    fn exact(&self, y: &[C64]) -> f64 {
        match self.measure.over {
            Over::Synthesis => self.finder.synthesiser.extremes(y).half_peak_to_peak,
            _ => self.at_most(y),
        }
    }

    /// The same at most: of a sum of orders the sum of their magnitudes.
    fn at_most(&self, y: &[C64]) -> f64 {
        let orders = &self.finder.system.excitation.orders;
        match self.measure.over {
            Over::Statistic(statistic) => (statistic.0.value)(y),
            Over::Orders => y.iter().map(|y| y.norm()).fold(0.0, f64::max),
            Over::Order(order) => orders.iter().position(|o| *o == order).map_or(0.0, |n| y[n].norm()),
            _ => bound(y),
        }
    }
}

impl Cell {
    fn halves(&self) -> [Region; 2] {
        let cut = |(low, high): (f64, f64)| {
            let middle = 0.5 * (low + high);
            [(low, middle), (middle, high)]
        };
        if self.along == 0 {
            return cut(self.own.speeds).map(|speeds| Region { speeds, ..self.own.clone() });
        }
        cut(self.own.ranges[self.along - 1]).map(|range| {
            let mut half = self.own.clone();
            half.ranges[self.along - 1] = range;
            half
        })
    }
}

/// Index of the largest.
fn largest(each: &[f64; MOST]) -> usize {
    (0..MOST).fold(0, |most, d| if each[d] > each[most] { d } else { most })
}

/// The variable of the widest range of deviations.
fn widest(own: &Region) -> usize {
    let width = |d: usize| own.ranges[d].1 - own.ranges[d].0;
    1 + (0..own.ranges.len()).fold(0, |most, d| if width(d) > width(most) { d } else { most })
}

fn number(x: f64) -> Taylor {
    Taylor::constant(C64::from(x))
}
