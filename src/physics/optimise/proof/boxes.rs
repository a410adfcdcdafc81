//! Branch and bound over the box of the free parameters: the box that says least is cut first.

use super::asked::{self, Case};
use super::at_speed::AtSpeed;
use super::form::{Form, least_of_largest};
use super::verdict::{Effort, Found, Ranges, Reason, Verdict};
use crate::numerics::C64;
use crate::numerics::ranked::{ByRank, Ranked};
use crate::numerics::taylor::{MOST, Taylor};
use crate::objective::HELD;
use crate::optimise::{Outcome, Problem, Row, Variable};
use crate::response::{ResponseError, Work};
use rayon::prelude::*;
use std::collections::BinaryHeap;

/// Speeds of a load case at which boxes are looked at from the beginning, besides those of the peaks of the optimum.
const SPEEDS: usize = 24;
/// Boxes that are cut together.
const TOGETHER: usize = 64;
/// Boxes of a round whose middle is evaluated.
const EVALUATED: usize = 2;
/// Of the boxes that are left, so many at most are evaluated in their middle.
const LAST: usize = 200;
/// A design is better by more than this share, or it is the optimum again.
const BETTER: f64 = 1e-6;
/// Middles that look better than they are although no speed says so, at most: what they are worse by has no enclosure.
const UNEXPLAINED: usize = 40;
/// Of a box that is narrower than this in every coordinate its middle tells what the box is.
const NARROW: f64 = 0.05;
/// Of the speeds of a box, those that say most of it: its halves are looked at there first.
pub(super) const FIRST: usize = 12;
/// Then at those that have excluded most boxes so far, and at the last that have joined.
const USEFUL: usize = 40;
const NEWEST: usize = 12;
/// Beside a resonance that nothing damps, speeds that differ from it by these shares.
const BESIDE: [f64; 4] = [-0.01, -0.001, 0.001, 0.01];

/// A box, by the lower and upper end of each coordinate.
pub(super) type Bounds = Vec<(f64, f64)>;

/// A box that is not excluded yet.
struct Cell {
    /// Of each coordinate.
    bounds: Bounds,
    /// What is asked is nowhere below this share of what excludes, by all forms and by those of objectives.
    bound: f64,
    of_objectives: f64,
    /// The same in its middle.
    middle: f64,
    /// Speeds by how much they say of it.
    speeds: Vec<u32>,
    /// The coordinate along which it is cut.
    along: usize,
    /// For boxes that are level: the older first.
    age: u64,
}

impl Ranked for Cell {
    /// That with the lowest bound is cut first.
    fn rank(&self) -> (f64, u64) {
        (-self.bound, self.age)
    }
}

/// What is said of a box.
enum Looked {
    /// A speed excludes it; `None`: several together.
    Excluded(Option<u32>),
    Open(Cell),
}

pub(super) struct Search<'a> {
    pub problem: &'a Problem<'a>,
    pub cases: Vec<Case<'a>>,
    pub speeds: Vec<AtSpeed>,
    /// Boxes that each speed has excluded.
    excluded: Vec<u64>,
    /// Speeds that boxes are looked at, after their own.
    pub useful: Vec<u32>,
    /// Whether absorbers are looked at as quotients.
    pub is_pair: bool,
    /// Whether nothing but amplitudes of single orders of the chain is asked for, and all absorbers are.
    pub amplitudes_alone: bool,
}

/// Proves that no design is below an optimum by more than the gap, or finds one; of an optimum that breaks a limit, that no design holds all limits.
/// `boxes`: looked at so far, at most as many as the effort allows.
pub(super) fn prove(problem: &Problem, optimum: &Outcome, effort: Effort, boxes: &mut u64, work: &mut Work) -> Found {
    let none = |reason| Found::Ended(None, Verdict::None(reason));
    let value = optimum.rows.objective();
    if optimum.rows.hold() && value <= 0.0 {
        return none(Reason::Zero);
    }
    let target = optimum.rows.hold().then_some(value * (1.0 - effort.gap));
    let cases = match asked::cases(problem, &optimum.point, target) {
        Ok(cases) => cases,
        Err(reason) => return none(reason),
    };
    match Search::new(problem, cases, optimum).run(value, target, (effort, boxes), work) {
        Ok(found) => found,
        Err(reason) => none(reason),
    }
}

impl<'a> Search<'a> {
    /// With the speeds of the peaks of an optimum, and some of the range.
    pub fn new(problem: &'a Problem<'a>, cases: Vec<Case<'a>>, optimum: &Outcome) -> Self {
        let mut search =
            Self { problem, cases, speeds: Vec::new(), excluded: Vec::new(), useful: Vec::new(), is_pair: false, amplitudes_alone: false };
        search.first_speeds(optimum);
        (search.is_pair, search.amplitudes_alone) = search.of_pairs();
        search
    }

    fn first_speeds(&mut self, optimum: &Outcome) {
        let rows = optimum.rows.rows.iter();
        let mut wanted: Vec<(usize, f64)> = Vec::new();
        for row in rows {
            wanted.extend(self.cases.iter().enumerate().filter(|(_, c)| c.asks(row)).map(|(i, _)| (i, row.peak.speed_rpm)));
        }
        for (i, case) in self.cases.iter().enumerate() {
            let all = case.speeds();
            let last = all.len() - 1;
            wanted.extend((0..=SPEEDS).map(|k| (i, all[last * k / SPEEDS])));
        }
        for (case, speed) in wanted {
            self.add(case, speed);
        }
        self.choose_useful();
    }

    /// Those that have excluded most, and the newest.
    fn choose_useful(&mut self) {
        let all = self.speeds.len() as u32;
        let mut list: Vec<u32> = (0..all).collect();
        list.sort_by(|a, b| self.excluded[*b as usize].cmp(&self.excluded[*a as usize]).then(a.cmp(b)));
        list.truncate(USEFUL);
        let newest = all.saturating_sub(NEWEST as u32)..all;
        let more: Vec<u32> = newest.filter(|s| !list.contains(s)).collect();
        list.extend(more);
        self.useful = list;
    }

    /// A speed joins; whether it is a new one.
    fn add(&mut self, case: usize, speed_rpm: f64) -> bool {
        if self.speeds.iter().any(|s| s.case == case && s.speed_rpm == speed_rpm) {
            return false;
        }
        let found = self.cases[case].at(case, speed_rpm);
        let is_new = found.is_some();
        self.speeds.extend(found);
        self.excluded.resize(self.speeds.len(), 0);
        is_new
    }

    pub fn run(&mut self, value: f64, target: Option<f64>, (effort, boxes): (Effort, &mut u64), work: &mut Work) -> Result<Found, Reason> {
        let whole = self.problem.space.bounds();
        let mut unexplained = 0;
        *boxes += 1;
        let mut open = BinaryHeap::new();
        if let Looked::Open(cell) = self.look_at(whole, None, 0)? {
            open.push(ByRank(cell));
        }
        while !open.is_empty() && *boxes + 1 < effort.boxes && unexplained < UNEXPLAINED {
            // each leaves two
            let together = TOGETHER.min(((effort.boxes - *boxes) / 2) as usize);
            let cut: Vec<Cell> = (0..together).map_while(|_| Some(open.pop()?.0)).collect();
            let halves: Vec<(Bounds, &Cell)> =
                cut.iter().flat_map(|cell| halves(&cell.bounds, cell.along).map(|half| (half, cell))).collect();
            let age = *boxes;
            let looked = |(i, (half, parent)): (usize, (Bounds, &Cell))| self.look_at(half, Some(parent), age + i as u64);
            let found = halves.into_par_iter().enumerate().map(looked).collect::<Result<Vec<Looked>, Reason>>()?;
            *boxes += 2 * cut.len() as u64;
            let mut rest: Vec<Cell> = Vec::new();
            for looked in found {
                match looked {
                    Looked::Excluded(Some(speed)) => self.excluded[speed as usize] += 1,
                    Looked::Excluded(None) => {}
                    Looked::Open(cell) => rest.push(cell),
                }
            }
            rest.sort_by(|a, b| a.middle.total_cmp(&b.middle));
            for cell in rest.iter().filter(|c| c.middle < 1.0).take(EVALUATED) {
                let point = cell.middle_point();
                if self.is_better(&point, (value, target), work) {
                    return Ok(Found::Better(point));
                }
                let is_narrow = cell.bounds.iter().all(|b| b.1 - b.0 < NARROW);
                if !self.learn(&point, target, work) && is_narrow {
                    unexplained += 1;
                }
            }
            self.choose_useful();
            open.extend(rest.into_iter().map(ByRank));
        }
        if open.is_empty() {
            return Ok(Found::Ended(target, if target.is_some() { Verdict::Proved } else { Verdict::Impossible }));
        }
        let all: Vec<Cell> = open.into_sorted_vec().into_iter().map(|cell| cell.0).collect();
        for cell in all.iter().step_by(all.len().div_ceil(LAST).max(1)) {
            let point = cell.middle_point();
            if self.is_better(&point, (value, target), work) {
                return Ok(Found::Better(point));
            }
        }
        let least = all.iter().map(|c| c.of_objectives).fold(1.0, f64::min);
        let weakest = all.last().map_or_else(Vec::new, |cell| self.ranges(&cell.bounds));
        Ok(Found::Ended(target.map(|target| target * least).filter(|bound| *bound > 0.0), Verdict::Open(weakest)))
    }

    /// Whether the design at a point is better than the optimum, or holds the limits that it breaks.
    fn is_better(&self, point: &[f64], (value, target): (f64, Option<f64>), work: &mut Work) -> bool {
        let Ok((own, excess)) = self.problem.exactly(point, work) else { return false };
        if target.is_some() { excess <= 0.0 && own < value * (1.0 - BETTER) } else { excess <= HELD }
    }

    /// Speeds of the peaks of the design at a point that exclude it join; whether there were any new ones.
    fn learn(&mut self, point: &[f64], target: Option<f64>, work: &mut Work) -> bool {
        let rows = match self.problem.rows(point, work) {
            Ok(rows) => rows,
            Err(ResponseError::Unbounded { speed_rpm, .. }) => {
                let beside = BESIDE.map(|share| speed_rpm * (1.0 + share));
                return (0..self.cases.len()).fold(false, |any, case| beside.iter().fold(any, |any, s| self.add(case, *s) || any));
            }
            Err(_) => return false,
        };
        let mut all: Vec<_> = rows.rows.iter().filter(|r| target.is_some() || r.role.is_limit()).collect();
        let over = |r: &Row| if r.role.is_limit() { r.value } else { r.value / target.unwrap_or(f64::INFINITY) - 1.0 };
        all.sort_by(|a, b| over(b).total_cmp(&over(a)));
        let mut is_new = false;
        for row in all.into_iter().filter(|r| over(r) >= 0.0).take(2) {
            let cases: Vec<usize> = self.cases.iter().enumerate().filter(|(_, c)| c.asks(row)).map(|(i, _)| i).collect();
            for case in cases {
                is_new |= self.add(case, row.peak.speed_rpm);
            }
        }
        is_new
    }

    /// What the speeds of the box it is half of, and then the most useful ones, say of a box.
    fn look_at(&self, bounds: Bounds, parent: Option<&Cell>, age: u64) -> Result<Looked, Reason> {
        let values = self.values(&bounds);
        let absorbers = self.cases.iter().map(|c| c.enclosed(&values)).collect::<Result<Vec<_>, Reason>>()?;
        let known: &[u32] = parent.map_or(&[], |p| &p.speeds);
        let others = self.useful.iter().copied().filter(|s| !known.contains(s));
        let all: Vec<u32> = known.iter().copied().chain(others).collect();
        let pairs = self.pairs(&absorbers);
        let seen = match self.seen(&pairs, &all) {
            Ok(seen) => seen,
            Err(speed) => return Ok(Looked::Excluded(Some(speed))),
        };
        let amplitudes = &seen.amplitudes;
        let mut forms: Vec<Form> = Vec::new();
        let mut said: Vec<(f64, u32)> = amplitudes.iter().map(|a| (a.middle, a.speed)).collect();
        let largest = |own: bool| amplitudes.iter().filter(|a| !own || a.is_objective).map(|a| a.least).fold(f64::NEG_INFINITY, f64::max);
        let mut bound = parent.map_or(f64::NEG_INFINITY, |p| p.bound).max(largest(false));
        for (i, s) in seen.foremost.iter().copied().enumerate() {
            let (at, first) = (&self.speeds[s as usize], forms.len());
            let found = self.cases[at.case].forms(at, (&absorbers[at.case], &pairs[at.case]), &mut forms);
            let most = |of: &dyn Fn(&Form) -> f64| forms[first..].iter().map(of).fold(f64::NEG_INFINITY, f64::max);
            bound = bound.max(most(&Form::least));
            if bound >= 1.0 {
                return Ok(Looked::Excluded(Some(s)));
            }
            said.push((if found.is_some() { most(&|f: &Form| f.middle) } else { f64::NEG_INFINITY }, s));
            if i + 1 == known.len() {
                bound = bound.max(least_of_largest(&mut forms.clone()));
                if bound >= 1.0 {
                    return Ok(Looked::Excluded(None));
                }
            }
        }
        let mut linear = self.linear(&pairs, amplitudes);
        if !linear.is_empty() {
            linear.extend(&forms);
            if least_of_largest(&mut linear) >= 1.0 {
                return Ok(Looked::Excluded(None));
            }
        }
        bound = bound.max(least_of_largest(&mut forms));
        if bound >= 1.0 {
            return Ok(Looked::Excluded(None));
        }
        let mut objectives: Vec<Form> = forms.iter().copied().filter(|f| f.is_objective).collect();
        let of_objectives = least_of_largest(&mut objectives).max(largest(true)).max(parent.map_or(f64::NEG_INFINITY, |p| p.of_objectives));
        said.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let middle = said.iter().map(|s| s.0).fold(f64::NEG_INFINITY, f64::max);
        let unknown = said.iter().filter(|s| s.0 == f64::NEG_INFINITY).count();
        let mut speeds: Vec<u32> = Vec::with_capacity(FIRST);
        for s in said.iter().map(|s| s.1) {
            if speeds.len() < FIRST && !speeds.contains(&s) {
                speeds.push(s);
            }
        }
        let along = match self.is_pair {
            true => self.best_cut(&bounds, &speeds),
            false => along(&bounds, if 2 * unknown > said.len() { &[] } else { &forms }),
        };
        Ok(Looked::Open(Cell { bounds, bound, of_objectives, middle, speeds, along, age }))
    }

    /// Values of all parameters over a box.
    pub fn values(&self, bounds: &[(f64, f64)]) -> Vec<Vec<Taylor>> {
        let space = &self.problem.space;
        let held = |x: &f64| Taylor::constant(C64::from(*x));
        let mut values: Vec<Vec<Taylor>> = space.slots.iter().map(|s| s.values.iter().map(held).collect()).collect();
        for (i, (v, (low, high))) in space.variables.iter().zip(bounds).enumerate() {
            values[v.absorber][v.parameter] = Taylor::between(v.value(*low), v.value(*high), i);
        }
        values
    }

    /// The same as ranges.
    pub fn ranges(&self, bounds: &[(f64, f64)]) -> Ranges {
        let space = &self.problem.space;
        let key = |v: &Variable| space.slots[v.absorber].declaration.parameters[v.parameter].key;
        space.variables.iter().zip(bounds).map(|(v, b)| (key(v), v.value(b.0), v.value(b.1))).collect()
    }
}

impl Cell {
    fn middle_point(&self) -> Vec<f64> {
        self.bounds.iter().map(|b| 0.5 * (b.0 + b.1)).collect()
    }
}

/// Both halves of a box along a coordinate.
pub(super) fn halves(bounds: &[(f64, f64)], along: usize) -> [Bounds; 2] {
    let (low, high) = bounds[along];
    let middle = 0.5 * (low + high);
    [(low, middle), (middle, high)].map(|half| {
        let mut bounds = bounds.to_vec();
        bounds[along] = half;
        bounds
    })
}

/// The coordinate along which a box is cut: that which moves most of what is largest; of a box that nothing linear is known of, the longest.
fn along(bounds: &[(f64, f64)], forms: &[Form]) -> usize {
    let largest = forms.iter().reduce(|m, f| if f.middle > m.middle { f } else { m });
    let spread = largest.map_or([0.0; MOST], |f| f.spread);
    let longest = longest(bounds);
    let most = (0..bounds.len()).max_by(|a, b| spread[*a].total_cmp(&spread[*b])).unwrap_or(0);
    if spread[most] > 0.0 && bounds[longest].1 - bounds[longest].0 < WIDE { most } else { longest }
}

/// The longest side of a box.
pub(super) fn longest(bounds: &[(f64, f64)]) -> usize {
    (0..bounds.len()).max_by(|a, b| (bounds[*a].1 - bounds[*a].0).total_cmp(&(bounds[*b].1 - bounds[*b].0))).unwrap_or(0)
}

/// Coordinates farther apart than this (a factor of e) are far apart.
const WIDE: f64 = 1.0;
