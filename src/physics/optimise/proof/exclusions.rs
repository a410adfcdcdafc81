//! A proof to be checked by others: boxes that cover all designs, each with the speeds that exclude it.
//!
//! The range is cut anew with the speeds that the search came to. It is made to a smaller gap than the proof is told to, so that whoever checks it may err.

use super::asked;
use super::boxes::{Bounds, FIRST, Search, halves, longest};
use super::form::{Form, combination};
use super::verdict::{Effort, Found, Verdict};
use crate::objective::Condition;
use crate::optimise::{Outcome, Problem};
use crate::response::Work;

/// A speed that excludes a box, alone or with others.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct ExcludingSpeed {
    /// Condition of the engine.
    pub condition: Condition,
    /// The cylinder (from 0) that misfires.
    pub cylinder: Option<usize>,
    /// rpm.
    pub speed_rpm: f64,
    /// Whether a limit is asked for there, or the objective.
    pub by_limit: bool,
    /// What it counts; of a box they add up to one.
    pub share: f64,
}

/// A box of designs that are excluded: what they have at some speeds, in units of what they must not reach, is nowhere below one in a weighted mean.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Exclusion {
    /// Lowest and highest value of each free parameter.
    pub ranges: Vec<(f64, f64)>,
    /// The speeds.
    pub speeds: Vec<ExcludingSpeed>,
}

/// Boxes that cover all designs.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Exclusions {
    /// Absorber and key of each free parameter.
    pub free: Vec<(usize, &'static str)>,
    /// In the order in which they lie.
    pub boxes: Vec<Exclusion>,
}

/// Boxes that cover the whole range of the free parameters and exclude all of it: no design is below the share `1 - gap` of the value of an optimum and holds all limits, or, where the optimum breaks one, none
/// holds all. `None` where there is no such proof, and where more boxes are needed than the effort allows.
#[doc(hidden)]
pub fn exclusions(problem: &Problem, optimum: &Outcome, effort: Effort, work: &mut Work) -> Option<Exclusions> {
    let value = optimum.rows.objective();
    let target = optimum.rows.hold().then_some(value * (1.0 - SEARCHED * effort.gap));
    let cases = asked::cases(problem, &optimum.point, target).ok()?;
    let mut search = Search::new(problem, cases, optimum);
    // what excludes two absorbers is no share of speeds
    if search.is_pair {
        return None;
    }
    let mut boxes = 0;
    match search.run(value, target, (effort, &mut boxes), work).ok()? {
        Found::Ended(_, Verdict::Proved | Verdict::Impossible) => {}
        _ => return None,
    }
    let least = (1.0 - EXCLUDED * effort.gap) / (1.0 - SEARCHED * effort.gap);
    let mut found: Vec<Exclusion> = Vec::new();
    let mut open = vec![(problem.space.bounds(), Vec::new())];
    while let Some((bounds, known)) = open.pop() {
        if (found.len() + open.len()) as u64 >= effort.boxes {
            return None;
        }
        match search.excluded(bounds, &known, least)? {
            Step::Excluded(exclusion) => found.push(exclusion),
            Step::Cut([low, high], known) => open.extend([(high, known.clone()), (low, known)]),
        }
    }
    let space = &problem.space;
    let free = space.variables.iter().map(|v| (v.absorber, space.slots[v.absorber].declaration.parameters[v.parameter].key));
    Some(Exclusions { free: free.collect(), boxes: found })
}

/// Shares of the gap to which speeds are sought, and to which boxes are excluded.
const SEARCHED: f64 = 0.8;
const EXCLUDED: f64 = 0.9;

/// A limit is exceeded by this factor at least.
const BEYOND_LIMIT: f64 = 1.0 + 1e-7;

/// What comes of a box.
enum Step {
    Excluded(Exclusion),
    /// Its halves, and the speeds that say most of it.
    Cut([Bounds; 2], Vec<u32>),
}

impl Search<'_> {
    /// Looks for a speed that excludes a box, those that say most of the box it is half of first, then the most useful and last all others, and for several together.
    fn excluded(&self, bounds: Bounds, known: &[u32], least: f64) -> Option<Step> {
        let values = self.values(&bounds);
        let absorbers = self.cases.iter().map(|c| c.enclosed(&values).ok()).collect::<Option<Vec<_>>>()?;
        let useful: Vec<u32> = self.useful.iter().copied().filter(|s| !known.contains(s)).collect();
        let rest = (0..self.speeds.len() as u32).filter(|s| !known.contains(s) && !useful.contains(s));
        let first = known.len() + useful.len();
        let (mut said, mut own): (Vec<(Form, u32)>, Vec<Form>) = (Vec::new(), Vec::new());
        for (i, s) in known.iter().chain(&useful).copied().chain(rest).enumerate() {
            // what excludes the middle will exclude smaller boxes
            if i == first && said.iter().any(|(form, _)| form.middle >= 1.0) {
                break;
            }
            let at = &self.speeds[s as usize];
            own.clear();
            self.cases[at.case].forms(at, (&absorbers[at.case], &None), &mut own);
            // what an objective must not reach is a little less than what was searched for, and a limit is a little more
            for form in own.drain(..).map(|f| f.times(if f.is_objective { 1.0 / least } else { 1.0 / BEYOND_LIMIT })) {
                if form.least() >= 1.0 {
                    return Some(Step::Excluded(self.exclusion(&bounds, &[(s, &form, 1.0)])));
                }
                said.push((form, s));
            }
        }
        said.sort_by(|a, b| b.0.middle.total_cmp(&a.0.middle));
        let (bound, shares) = combination(&mut said.iter().map(|s| s.0).collect::<Vec<_>>());
        if bound >= 1.0 {
            let speeds: Vec<_> = shares.iter().filter(|s| s.1 > 0.0).map(|(i, share)| (said[*i].1, &said[*i].0, *share)).collect();
            return Some(Step::Excluded(self.exclusion(&bounds, &speeds)));
        }
        let best = said.iter().map(|s| &s.0).reduce(|m, f| if f.least() > m.least() { f } else { m });
        let along = best.and_then(Form::loses_most_along).unwrap_or_else(|| longest(&bounds));
        let mut first: Vec<u32> = Vec::new();
        for (_, s) in &said {
            if first.len() < FIRST && !first.contains(s) {
                first.push(*s);
            }
        }
        Some(Step::Cut(halves(&bounds, along), first))
    }

    fn exclusion(&self, bounds: &Bounds, speeds: &[(u32, &Form, f64)]) -> Exclusion {
        let speed = |(s, form, share): &(u32, &Form, f64)| {
            let at = &self.speeds[*s as usize];
            let load_case = &self.problem.load_cases[self.cases[at.case].index];
            let (condition, cylinder) = (load_case.condition, load_case.cylinder);
            ExcludingSpeed { condition, cylinder, speed_rpm: at.speed_rpm, by_limit: !form.is_objective, share: *share }
        };
        let ranges = self.ranges(bounds).into_iter().map(|(_, low, high)| (low, high)).collect();
        Exclusion { ranges, speeds: speeds.iter().map(speed).collect() }
    }
}
