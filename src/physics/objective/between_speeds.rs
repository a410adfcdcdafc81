//! That no peak lies between two speeds: what a measure of a design is nowhere above, over the whole range of speeds.
//!
//! Between two speeds without a kink between them a phasor differs from its chord by a second-order rest ([`AboutFrequency`]). Half the range of a sum of orders, an amplitude and a root mean square are norms: over a
//! chord they are largest at an end, and what is added to the phasors adds no more than its own. A share of strength by amplitude and mean is the gauge of a convex set of bending, mean torque, maximum and minimum of the
//! torque, the first two linear in the square of the speed; over all torques between a maximum and a minimum it is largest for these or for one of them alone. Intervals whose bound is above what is asked are halved.

use super::measure::{Measure, Over};
use super::peak_search::PeakFinder;
use super::strain_peaks::per_twist;
use crate::absorber::Mounted;
use crate::crankshaft::Torque;
use crate::numerics::C64;
use crate::numerics::synthesis::{Extremes, bound};
use crate::response::tangent::{AboutFrequency, Parabola, Tangent};
use crate::response::{Quantity, Work};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Intervals that are this share of the range are not halved.
const SHORTEST: f64 = 1e-12;
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
    weight: f64,
}

/// Between two speeds.
struct Interval {
    ends: [Solved; 2],
    upper: f64,
    /// Index of the part without kinks.
    part: usize,
}

impl PartialEq for Interval {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Interval {}

impl PartialOrd for Interval {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Interval {
    /// That with the highest bound is halved first.
    fn cmp(&self, other: &Self) -> Ordering {
        self.upper.total_cmp(&other.upper).then(other.ends[0].speed_rpm.total_cmp(&self.ends[0].speed_rpm))
    }
}

/// Speeds without a kink between them.
struct Part {
    torque: Parabola,
    /// Of each order, what is known about frequencies: circular frequency, a third of the radius (rad/s), and each quantity there.
    known: Vec<Vec<(f64, f64, Vec<Tangent>)>>,
}

struct Search<'s> {
    finder: &'s PeakFinder<'s>,
    design: &'s [Mounted],
    measure: &'s Measure,
    quantities: Vec<Quantity>,
    parts: Vec<Part>,
    solved: u64,
}

impl PeakFinder<'_> {
    /// What a measure is nowhere above over the range, as close to `target` as so many speeds allow; `None` where it has no such bound: of multiaxial criteria, temperatures, properties and means, of flexible cranks, of
    /// absorbers on rings or without an enclosure, and where so many speeds do not suffice for any.
    pub fn ceiling(&self, design: &[Mounted], measure: &Measure, (target, most): (f64, u64), work: &mut Work) -> Option<Ceiling> {
        let is_there = |q: &Quantity| !matches!(q, Quantity::RingTwist(i) if *i >= design.len());
        let quantities: Vec<Quantity> = measure.quantities.iter().copied().filter(is_there).collect();
        if !self.has_ceiling(measure) {
            return None;
        }
        let mut search = Search { finder: self, design, measure, quantities, parts: Vec::new(), solved: 0 };
        search.run(target, most, work)
    }

    fn has_ceiling(&self, measure: &Measure) -> bool {
        match measure.over {
            Over::Synthesis | Over::Orders | Over::Order(_) | Over::Statistic(_) | Over::Power | Over::Strain => true,
            Over::Margin(criterion) => self.margin.is_some_and(|margin| !margin.is_multiaxial(criterion)),
            Over::Temperature | Over::Mean | Over::AtDuty(_) | Over::MeanPower | Over::Damage | Over::Property(_) => false,
        }
    }
}

impl Search<'_> {
    fn run(&mut self, target: f64, most: u64, work: &mut Work) -> Option<Ceiling> {
        let mut open = BinaryHeap::new();
        let mut upper = 0.0;
        for speeds in self.without_kinks() {
            let [low, high] = [self.solve(speeds.0, work)?, self.solve(speeds.1, work)?];
            for end in [&low, &high] {
                upper = f64::max(upper, self.at_end(end, &vec![Vec::new(); self.quantities.len()], end.speed_rpm, target));
            }
            if !self.finder.refine || speeds.0 >= speeds.1 {
                continue;
            }
            self.parts
                .push(Part { torque: Parabola::between(self.finder.system, speeds), known: vec![Vec::new(); self.finder.system.orders()] });
            let part = self.parts.len() - 1;
            let upper = self.upper(part, [&low, &high], target);
            open.push(Interval { ends: [low, high], upper, part });
        }
        let range = self.finder.grid.speed_rpm[self.finder.grid.len() - 1] * SHORTEST;
        while let Some(Interval { ends: [low, high], upper, part }) = open.pop() {
            if upper <= target || self.solved >= most || high.speed_rpm - low.speed_rpm <= range {
                open.push(Interval { ends: [low, high], upper, part });
                break;
            }
            let middle = self.solve(0.5 * (low.speed_rpm + high.speed_rpm), work)?;
            let of_halves = [self.upper(part, [&low, &middle], target), self.upper(part, [&middle, &high], target)];
            let again = Solved { phasors: middle.phasors.clone(), ..middle };
            open.push(Interval { ends: [low, middle], upper: of_halves[0], part });
            open.push(Interval { ends: [again, high], upper: of_halves[1], part });
        }
        let value = open.peek().map_or(upper, |i| f64::max(upper, i.upper)) * (1.0 + ROUNDED);
        value.is_finite().then_some(Ceiling { value, speeds: self.solved })
    }

    /// The range of the measure, cut at kinks of the torque and of the measure and, where the crank is asked for, at the speeds of its table. Where peaks are not refined, single speeds.
    fn without_kinks(&self) -> Vec<(f64, f64)> {
        let (grid, within) = (self.finder.grid, &self.measure.within);
        let all = (grid.speed_rpm[0], grid.speed_rpm[grid.len() - 1]);
        let whole = [all];
        let ranges: &[(f64, f64)] = if within.ranges.is_empty() { &whole } else { &within.ranges };
        if !self.finder.refine {
            return grid.speed_rpm.iter().filter(|s| within.holds(**s)).map(|s| (*s, *s)).collect();
        }
        let cuts_all = matches!(self.measure.over, Over::Margin(_));
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

    fn solve(&mut self, speed_rpm: f64, work: &mut Work) -> Option<Solved> {
        self.solved += 1;
        let phasors = self.finder.direct.at_each(self.design, &self.quantities, &[speed_rpm], work).ok()?;
        Some(Solved { speed_rpm, phasors, weight: self.measure.within.weight(speed_rpm) })
    }

    /// What the measure is nowhere above between two speeds; infinite where they are too far apart to tell.
    fn upper(&mut self, part: usize, ends: [&Solved; 2], target: f64) -> f64 {
        let Some(off) = self.off_chord(part, ends) else { return f64::INFINITY };
        let middle = 0.5 * (ends[0].speed_rpm + ends[1].speed_rpm);
        ends.iter().map(|end| self.at_end(end, &off, middle, target)).fold(0.0, f64::max)
    }

    /// How far each order of each quantity may be from its chord; of powers, each order of each power.
    fn off_chord(&mut self, part: usize, ends: [&Solved; 2]) -> Option<Vec<Vec<f64>>> {
        let system = self.finder.system;
        let (low, high) = (ends[0].speed_rpm, ends[1].speed_rpm);
        let mut off = vec![vec![0.0; system.orders()]; self.quantities.len()];
        for order in 0..system.orders() {
            if !self.parts[part].torque.acts(order) {
                continue;
            }
            let value = system.excitation.orders[order];
            let (from, to) = (value.omega(low), value.omega(high));
            let covers = |k: &&(f64, f64, Vec<Tangent>)| from >= k.0 - k.1 && to <= k.0 + k.1;
            let known = &self.parts[part].known[order];
            if !known.iter().any(|k| covers(&k)) {
                let speed = 0.5 * (low + high);
                let about = AboutFrequency::new(system, self.design, order, speed)?;
                let third = about.radius / 3.0;
                if value.omega(speed) - third > from || value.omega(speed) + third < to {
                    return None;
                }
                let outputs = about.outputs(&self.quantities, &self.parts[part].torque);
                let outputs = if self.measure.over == Over::Power { self.powers(&about, &outputs) } else { outputs };
                self.parts[part].known[order].push((about.omega, third, outputs));
            }
            let known = self.parts[part].known[order].iter().filter(covers);
            for k in known.take(1) {
                off.iter_mut().zip(&k.2).for_each(|(off, y)| off[order] = y.off_chord(to - from));
            }
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

    /// The measure at a speed, at most, where orders may be off by as much; no closer than tells that it is not above the target. `between`: a speed of the interval.
    fn at_end(&self, end: &Solved, off: &[Vec<f64>], between: f64, target: f64) -> f64 {
        if self.measure.over == Over::Power {
            let own = self.quantities.iter().zip(&end.phasors).map(|(q, y)| self.power(*q, end.speed_rpm, y)).sum::<f64>();
            return (own + off.iter().flatten().sum::<f64>()) * end.weight;
        }
        let of_quantity = |((q, y), off): ((&Quantity, &Vec<C64>), &Vec<f64>)| self.quantity_at(end, (*q, y, off), between, target);
        self.quantities.iter().zip(&end.phasors).zip(off).map(of_quantity).fold(0.0, f64::max) * end.weight
    }

    fn power(&self, quantity: Quantity, speed_rpm: f64, twists: &[C64]) -> f64 {
        let Quantity::RingTwist(i) = quantity else { return 0.0 };
        self.finder.direct.power_of_twist(self.design, i, speed_rpm, twists)
    }

    fn quantity_at(&self, end: &Solved, (quantity, y, off): (Quantity, &[C64], &[f64]), between: f64, target: f64) -> f64 {
        let (sum, orders) = (off.iter().sum::<f64>(), &self.finder.system.excitation.orders);
        let off_of = |n: usize| off.get(n).copied().unwrap_or(0.0);
        let amplitude = |n: usize| y[n].norm() + off_of(n);
        match self.measure.over {
            Over::Orders => (0..y.len()).map(amplitude).fold(0.0, f64::max),
            Over::Order(order) => orders.iter().position(|o| *o == order).map_or(0.0, amplitude),
            Over::Statistic(statistic) => {
                let off: Vec<C64> = off.iter().map(|x| C64::from(*x)).collect();
                (statistic.0.value)(y) + (statistic.0.value)(&off)
            }
            Over::Margin(criterion) => self.used(end, (criterion, quantity), (y, sum), (between, target)),
            over => {
                let by = if over == Over::Strain { per_twist(self.design, quantity).unwrap_or(0.0) } else { 1.0 };
                // the magnitudes of the orders are a bound that needs no extremes
                let rough = (bound(y) + sum) * by;
                if rough * end.weight <= target { rough } else { (self.finder.synthesiser.extremes(y).half_peak_to_peak + sum) * by }
            }
        }
    }

    /// Share of the strength of a shaft.
    fn used(&self, end: &Solved, (criterion, quantity): (usize, Quantity), (y, off): (&[C64], f64), (between, target): (f64, f64)) -> f64 {
        let (Some(margin), Quantity::ShaftTorque(shaft)) = (self.finder.margin, quantity) else { return 0.0 };
        let rough = margin.rough_bound(criterion, shaft, if off > 0.0 { between } else { end.speed_rpm }, bound(y) + off);
        if rough * end.weight <= target {
            return rough;
        }
        let extremes = self.finder.synthesiser.extremes(y);
        let still = |middle: f64| Extremes { half_peak_to_peak: 0.0, middle, ..extremes };
        let (middle, half) = (extremes.middle, extremes.half_peak_to_peak);
        let all = [extremes, still(middle + half), still(middle - half)];
        let share = |extremes: Extremes| {
            let used = margin.most_used(criterion, shaft, end.speed_rpm, &Torque { extremes, phasors: y });
            used.map_or(0.0, |u| u.value)
        };
        let own = if off > 0.0 { all.into_iter().map(share).fold(0.0, f64::max) } else { share(extremes) };
        own + margin.used_per_torque(criterion, shaft, between) * off
    }
}
