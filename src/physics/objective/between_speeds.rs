//! That no peak lies between two speeds: what a measure of a design is nowhere above, over the whole range of speeds.
//!
//! Between two speeds without a kink between them a phasor differs from its chord by a second-order rest ([`AboutFrequency`]). Half the range of a sum of orders, an amplitude and a root mean square are norms: over a
//! chord they are largest at an end, and what is added to the phasors adds no more than its own. A share of strength by amplitude and mean is the gauge of a convex set of bending and torque, which grows with half the range
//! of the torque: over a chord of bending, mean torque (linear in the square of the speed), half range and middle it is largest at an end. Maximum and minimum of a sum that follows its chord are no farther inside theirs than
//! the values of the one end at the angles of the other. Intervals whose bound is above what is asked are halved.

use super::measure::{Measure, Over};
use super::peak_search::PeakFinder;
use super::strain_peaks::per_twist;
use crate::absorber::Mounted;
use crate::crankshaft::Torque;
use crate::numerics::C64;
use crate::numerics::elementary::turn;
use crate::numerics::ranked::{ByRank, Ranked};
use crate::numerics::synthesis::{Extremes, bound};
use crate::response::about_frequency::AboutFrequency;
use crate::response::factored::Factored;
use crate::response::tangent::{Parabola, Tangent};
use crate::response::{Grid, Quantity, Work};
use std::cell::OnceCell;
use std::collections::BinaryHeap;
use std::rc::Rc;

/// Intervals that are this share of the range are not halved.
const SHORTEST: f64 = 1e-12;
/// Share of its radius in which a disc is used.
const FARTHEST: f64 = 0.5;
/// Share of a value that rounding of direct solutions may hide.
const ROUNDED: f64 = 1e-9;

/// What a measure is nowhere above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ceiling {
    /// As the value of a peak.
    pub value: f64,
    /// Speeds at which the design was solved.
    pub speeds: u64,
}

/// A design at a speed.
struct Solved {
    speed_rpm: f64,
    /// Orders of every quantity.
    phasors: Vec<Vec<C64>>,
    /// Of each, once they are asked for.
    extremes: Vec<OnceCell<Extremes>>,
    weight: f64,
}

/// Between two speeds.
struct Interval {
    ends: [Rc<Solved>; 2],
    upper: f64,
    /// Index of the part without kinks of the torque.
    part: usize,
    age: u64,
}

impl Ranked for Interval {
    /// That with the highest bound is halved first.
    fn rank(&self) -> (f64, u64) {
        (self.upper, self.age)
    }
}

/// A disc of frequencies of an order.
struct Disc<'s> {
    about: AboutFrequency<'s>,
    /// Quantities, or powers, under the torque of each part that asked for them.
    by_part: Vec<(usize, Vec<Tangent>)>,
}

struct Search<'s> {
    finder: &'s PeakFinder<'s>,
    design: &'s [Mounted],
    measure: &'s Measure,
    quantities: Vec<Quantity>,
    /// Speeds between kinks of the torque, by the number of kinks below, with the torque there.
    parts: Vec<(usize, Parabola)>,
    /// Of each order, the discs that are known.
    discs: Vec<Vec<Disc<'s>>>,
    solver: Factored<'s>,
    solved: u64,
}

impl PeakFinder<'_> {
    /// What a measure is nowhere above over the range, as close to `target` as so many speeds allow; `None` where it has no such bound: where peaks are not refined; of multiaxial criteria, weighted margins, temperatures, properties and means; of flexible cranks, beside very stiff shafts, of
    /// absorbers on rings or without an enclosure; and where so many speeds do not suffice for any.
    pub fn ceiling(&self, design: &[Mounted], measure: &Measure, (target, most): (f64, u64), work: &mut Work) -> Option<Ceiling> {
        let is_there = |q: &Quantity| !matches!(q, Quantity::RingTwist(i) if *i >= design.len());
        let quantities: Vec<Quantity> = measure.quantities.iter().copied().filter(is_there).collect();
        // where peaks are not refined the grid knows no kinks, and no value between its speeds is told
        if !self.refine || !self.has_ceiling(measure) {
            return None;
        }
        let discs = (0..self.system.orders()).map(|_| Vec::new()).collect();
        let mut search =
            Search { finder: self, design, measure, quantities, parts: Vec::new(), discs, solver: Factored::new(self.system), solved: 0 };
        search.run(target, most, work)
    }

    /// The range of the measure, cut at kinks of the torque and of the measure and, where the crank is asked for, at the speeds of its table; a range of one speed as it is.
    pub(crate) fn without_kinks(&self, measure: &Measure) -> Vec<(f64, f64)> {
        let (grid, within) = (self.grid, &measure.within);
        let all = (grid.speed_rpm[0], grid.speed_rpm[grid.len() - 1]);
        let whole = [all];
        let ranges: &[(f64, f64)] = if within.ranges.is_empty() { &whole } else { &within.ranges };
        let cuts_all = matches!(measure.over, Over::Margin(_));
        let of_grid = grid.speed_rpm.iter().zip(&grid.kink).filter(|(_, kink)| **kink || cuts_all).map(|(s, _)| *s);
        let cuts: Vec<f64> = of_grid.chain(within.kinks()).collect();
        let parts_of = |&(low, high): &(f64, f64)| -> Vec<(f64, f64)> {
            let (low, high) = (low.max(all.0), high.min(all.1));
            let mut speeds: Vec<f64> = cuts.iter().copied().filter(|s| *s > low && *s < high).chain([low, high]).collect();
            speeds.sort_by(f64::total_cmp);
            speeds.dedup();
            if low > high {
                Vec::new()
            } else if speeds.len() == 1 {
                vec![(low, high)]
            } else {
                speeds.windows(2).map(|w| (w[0], w[1])).collect()
            }
        };
        ranges.iter().flat_map(parts_of).collect()
    }

    /// The torque between the kinks about two speeds that have none between them.
    pub(crate) fn torque_about(&self, speeds: (f64, f64)) -> Parabola {
        let (all, kinks, below) = (&self.grid.speed_rpm, kinks_of(self.grid), kinks_below(self.grid, speeds));
        let from = if below == 0 { all[0].min(speeds.0) } else { kinks[below - 1] };
        let to = kinks.get(below).copied().unwrap_or(all[all.len() - 1]).max(speeds.1);
        Parabola::between(self.system, (from, to))
    }

    fn has_ceiling(&self, measure: &Measure) -> bool {
        match measure.over {
            Over::Synthesis | Over::Orders | Over::Order(_) | Over::Statistic(_) | Over::Power | Over::Strain | Over::SpringStress => true,
            // the share is linear in the square of the speed, a factor in the speed
            Over::Margin(criterion) => {
                measure.within.factors.is_empty() && self.margin.is_some_and(|margin| !margin.is_multiaxial(criterion))
            }
            Over::Temperature | Over::Mean | Over::AtDuty(_) | Over::MeanPower | Over::Damage | Over::Property(_) => false,
        }
    }
}

fn kinks_of(grid: &Grid) -> Vec<f64> {
    grid.speed_rpm.iter().zip(&grid.kink).filter(|k| *k.1).map(|k| *k.0).collect()
}

/// Number of kinks of the torque below two speeds.
fn kinks_below(grid: &Grid, speeds: (f64, f64)) -> usize {
    kinks_of(grid).partition_point(|k| *k <= speeds.0)
}

impl Search<'_> {
    fn run(&mut self, target: f64, most: u64, work: &mut Work) -> Option<Ceiling> {
        let mut open = BinaryHeap::new();
        let mut upper = 0.0;
        for speeds in self.finder.without_kinks(self.measure) {
            let [low, high] = [self.solve(speeds.0, work)?, self.solve(speeds.1, work)?];
            for end in [&low, &high] {
                upper = f64::max(upper, self.at(end));
            }
            if speeds.0 >= speeds.1 {
                continue;
            }
            let part = self.part_of(speeds);
            let upper = self.upper(part, [&low, &high], target);
            open.push(ByRank(Interval { ends: [low, high], upper, part, age: self.solved }));
        }
        let range = self.finder.grid.speed_rpm[self.finder.grid.len() - 1] * SHORTEST;
        while let Some(ByRank(Interval { ends: [low, high], upper, part, age })) = open.pop() {
            if upper <= target || self.solved >= most || high.speed_rpm - low.speed_rpm <= range {
                open.push(ByRank(Interval { ends: [low, high], upper, part, age }));
                break;
            }
            let middle = self.solve(0.5 * (low.speed_rpm + high.speed_rpm), work)?;
            let of_halves = [self.upper(part, [&low, &middle], target), self.upper(part, [&middle, &high], target)];
            let halves = [[low, middle.clone()], [middle, high]].into_iter().zip(of_halves);
            open.extend(halves.map(|(ends, upper)| ByRank(Interval { ends, upper, part, age: self.solved })));
        }
        let value = open.peek().map_or(upper, |i| f64::max(upper, i.0.upper)) * (1.0 + ROUNDED);
        value.is_finite().then_some(Ceiling { value, speeds: self.solved })
    }

    fn solve(&mut self, speed_rpm: f64, work: &mut Work) -> Option<Rc<Solved>> {
        self.solved += 1;
        let phasors = self.finder.direct.at_each(self.design, &self.quantities, &[speed_rpm], work).ok()?;
        let extremes = vec![OnceCell::new(); phasors.len()];
        Some(Rc::new(Solved { speed_rpm, phasors, extremes, weight: self.measure.within.weight(speed_rpm) }))
    }

    /// What the measure is nowhere above between two speeds; infinite where they are too far apart to tell.
    fn upper(&mut self, part: usize, ends: [&Solved; 2], target: f64) -> f64 {
        let Some(off) = self.off_chord(part, ends) else { return f64::INFINITY };
        let of_quantity = |q: usize| self.quantity_over(ends, (q, &off[q]), target);
        if self.measure.over == Over::Power {
            let off: f64 = off.iter().flatten().sum();
            return ends.map(|end| (self.powers_at(end) + off) * end.weight).into_iter().fold(0.0, f64::max);
        }
        (0..self.quantities.len()).map(of_quantity).fold(0.0, f64::max)
    }

    /// Between the same kinks the torque is the same parabola.
    fn part_of(&mut self, speeds: (f64, f64)) -> usize {
        let below = kinks_below(self.finder.grid, speeds);
        self.parts.iter().position(|part| part.0 == below).unwrap_or_else(|| {
            self.parts.push((below, self.finder.torque_about(speeds)));
            self.parts.len() - 1
        })
    }

    /// How far each order of each quantity may be from its chord; of powers, each order of each power.
    fn off_chord(&mut self, part: usize, ends: [&Solved; 2]) -> Option<Vec<Vec<f64>>> {
        let system = self.finder.system;
        let (low, high) = (ends[0].speed_rpm, ends[1].speed_rpm);
        let mut off = vec![vec![0.0; system.orders()]; self.quantities.len()];
        for order in 0..system.orders() {
            if !self.parts[part].1.acts(order) {
                continue;
            }
            let omega = [low, high].map(|speed| system.excitation.orders[order].omega(speed));
            let farthest = |disc: &Disc| omega.iter().map(|omega| (omega - disc.about.omega).abs()).fold(0.0, f64::max) / disc.about.radius;
            let covers = |disc: &Disc| farthest(disc) <= FARTHEST;
            let disc = match self.discs[order].iter().position(covers) {
                Some(disc) => disc,
                None => {
                    let about = AboutFrequency::disc(&mut self.solver, (system, self.design), order, 0.5 * (low + high))?;
                    self.discs[order].push(Disc { about, by_part: Vec::new() });
                    self.discs[order].len() - 1
                }
            };
            if !covers(&self.discs[order][disc]) {
                return None;
            }
            let farthest = farthest(&self.discs[order][disc]);
            let tangents = self.tangents(order, disc, part);
            off.iter_mut().zip(tangents).for_each(|(off, y)| off[order] = y.off_chord(omega[1] - omega[0], farthest));
        }
        if !off.iter().flatten().all(|off| off.is_finite()) {
            return None;
        }
        if let Over::Margin(_) = self.measure.over {
            // chords over the square of the speed
            let share = 0.25 * (high - low) / (high + low);
            for (off, (a, b)) in off.iter_mut().zip(ends[0].phasors.iter().zip(&ends[1].phasors)) {
                off.iter_mut().zip(a.iter().zip(b)).for_each(|(off, (a, b))| *off += share * (b - a).norm());
            }
        }
        Some(off)
    }

    /// Quantities, or powers, in a disc of an order.
    fn tangents(&mut self, order: usize, disc: usize, part: usize) -> &[Tangent] {
        let own = &self.discs[order][disc];
        let index = match own.by_part.iter().position(|known| known.0 == part) {
            Some(index) => index,
            None => {
                let outputs = own.about.outputs(&self.quantities, &self.parts[part].1);
                let outputs = if self.measure.over == Over::Power { self.powers(&own.about, &outputs) } else { outputs };
                self.discs[order][disc].by_part.push((part, outputs));
                self.discs[order][disc].by_part.len() - 1
            }
        };
        &self.discs[order][disc].by_part[index].1
    }

    /// Power of each ring at an order as a function of frequency: omega Im S |twist|²/2.
    fn powers(&self, about: &AboutFrequency, twists: &[Tangent]) -> Vec<Tangent> {
        let radius = about.radius;
        let half_omega = Tangent { value: C64::from(0.5 * about.omega), slope: C64::from(0.5), bend: 0.0 };
        let none = Tangent { value: C64::default(), slope: C64::default(), bend: 0.0 };
        let power_of = |(q, y): (&Quantity, &Tangent)| {
            let Quantity::RingTwist(i) = q else { return none };
            let Some(s) = about.stiffness(*i) else { return none };
            y.times(&y.conj(), radius).times(&s.imaginary(), radius).times(&half_omega, radius)
        };
        self.quantities.iter().zip(twists).map(power_of).collect()
    }

    /// The measure at one speed.
    fn at(&self, at: &Solved) -> f64 {
        if self.measure.over == Over::Power {
            return self.powers_at(at) * at.weight;
        }
        let none = vec![0.0; self.finder.system.orders()];
        (0..self.quantities.len()).map(|q| self.quantity_over([at, at], (q, &none), 0.0)).fold(0.0, f64::max)
    }

    /// Power of all rings at one speed, W.
    fn powers_at(&self, at: &Solved) -> f64 {
        let power = |(q, y): (&Quantity, &Vec<C64>)| match q {
            Quantity::RingTwist(i) => self.finder.direct.power_of_twist(self.design, *i, at.speed_rpm, y),
            _ => 0.0,
        };
        self.quantities.iter().zip(&at.phasors).map(power).sum()
    }

    /// What the measure of a quantity is nowhere above between two speeds, where orders are no farther off their chords than this; no closer than tells that it is not above the target.
    fn quantity_over(&self, ends: [&Solved; 2], (q, off): (usize, &[f64]), target: f64) -> f64 {
        let (sum, orders) = (off.iter().sum::<f64>(), &self.finder.system.excitation.orders);
        let at_ends =
            |of: &dyn Fn(&Solved, &[C64]) -> f64| ends.map(|end| of(end, &end.phasors[q]) * end.weight).into_iter().fold(0.0, f64::max);
        match self.measure.over {
            Over::Orders => at_ends(&|_, y| y.iter().zip(off).map(|(y, off)| y.norm() + off).fold(0.0, f64::max)),
            Over::Order(order) => orders.iter().position(|o| *o == order).map_or(0.0, |n| at_ends(&|_, y| y[n].norm() + off[n])),
            Over::Statistic(statistic) => {
                let off: Vec<C64> = off.iter().map(|x| C64::from(*x)).collect();
                let of_off = (statistic.0.value)(&off);
                at_ends(&|_, y| (statistic.0.value)(y) + of_off)
            }
            Over::Margin(criterion) => self.used(ends, (criterion, q), sum, target),
            over => {
                let by = match over {
                    Over::Strain | Over::SpringStress => per_twist(self.design, self.quantities[q], over).unwrap_or(0.0),
                    _ => 1.0,
                };
                // the magnitudes of the orders are a bound that needs no extremes
                let rough = at_ends(&|_, y| (bound(y) + sum) * by);
                if rough <= target { rough } else { at_ends(&|end, _| (self.extremes(end, q).half_peak_to_peak + sum) * by) }
            }
        }
    }

    fn extremes<'e>(&self, end: &'e Solved, q: usize) -> &'e Extremes {
        end.extremes[q].get_or_init(|| self.finder.synthesiser.extremes(&end.phasors[q]))
    }

    /// Share of the strength of a shaft, at most.
    fn used(&self, ends: [&Solved; 2], (criterion, q): (usize, usize), off: f64, target: f64) -> f64 {
        let (Some(margin), Quantity::ShaftTorque(shaft)) = (self.finder.margin, self.quantities[q]) else { return 0.0 };
        let between = 0.5 * (ends[0].speed_rpm + ends[1].speed_rpm);
        let largest = |of: &dyn Fn(&Solved) -> f64| ends.map(|end| of(end) * end.weight).into_iter().fold(0.0, f64::max);
        let rough = largest(&|end| margin.rough_bound(criterion, shaft, between, bound(&end.phasors[q]) + off));
        if rough <= target {
            return rough;
        }
        let added = margin.used_per_torque(criterion, shaft, between) * (off + self.inside(ends, q));
        let share = |end: &Solved| {
            let torque = Torque { extremes: *self.extremes(end, q), phasors: &end.phasors[q] };
            margin.most_used(criterion, shaft, end.speed_rpm, &torque).map_or(0.0, |u| u.value)
        };
        largest(&|end| share(end) + added)
    }

    /// How far maximum and minimum of a sum on its chord may lie inside the chords of theirs, half of both together.
    fn inside(&self, ends: [&Solved; 2], q: usize) -> f64 {
        let [a, b] = ends;
        let value = |end: &Solved, angle: f64| {
            let harmonics = &self.finder.system.excitation.harmonics;
            end.phasors[q].iter().zip(harmonics).map(|(y, h)| (y * turn(f64::from(*h) * angle)).re).sum::<f64>()
        };
        let of = |angle: fn(&Extremes) -> f64, largest: f64| {
            let [own, its] = [a, b].map(|end| angle(self.extremes(end, q)));
            let lost = |end: &Solved, own: f64, other: f64| largest * (value(end, own) - value(end, other));
            lost(b, its, own).min(lost(a, own, its)).max(0.0)
        };
        0.5 * (of(|e| e.angle_max, 1.0) + of(|e| e.angle_min, -1.0))
    }
}
