//! A proof to be checked by others: boxes that cover all designs, each with one speed that excludes it.
//!
//! The search excludes boxes by several speeds together, too; here each is cut until a single one does. It is made to a smaller gap than the proof is told to, so that whoever checks it may err.

use super::asked;
use super::boxes::{Bounds, FIRST, Search, along, halves};
use super::form::Form;
use super::verdict::{Effort, Found, Verdict};
use crate::objective::Condition;
use crate::optimise::{Outcome, Problem};
use crate::response::Work;

/// A box of designs that one speed excludes: all of them break a limit there, or have an objective there that is no less than what is proved.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Exclusion {
    /// Lowest and highest value of each free parameter.
    pub ranges: Vec<(f64, f64)>,
    /// Condition of the engine.
    pub condition: Condition,
    /// The cylinder (from 0) that misfires.
    pub cylinder: Option<usize>,
    /// rpm.
    pub speed_rpm: f64,
    /// Whether a limit is broken there.
    pub by_limit: bool,
}

/// Boxes that cover all designs.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Exclusions {
    /// Absorber and key of each free parameter.
    pub free: Vec<(usize, &'static str)>,
    /// In the order in which they lie.
    pub boxes: Vec<Exclusion>,
}

/// Boxes that cover the whole range of the free parameters, each excluded by one speed: no design of them is below the share `1 - gap` of the value of an optimum and holds all limits, or, where the optimum breaks one, none
/// holds all. `None` where there is no such proof, and where more boxes are needed than the effort allows.
#[doc(hidden)]
pub fn exclusions(problem: &Problem, optimum: &Outcome, effort: Effort, work: &mut Work) -> Option<Exclusions> {
    let value = optimum.rows.objective();
    let target = optimum.rows.hold().then_some(value * (1.0 - SEARCHED * effort.gap));
    let cases = asked::cases(problem, &optimum.point, target).ok()?;
    let mut search = Search::new(problem, cases, optimum);
    let mut boxes = 0;
    match search.run(value, target, (effort, &mut boxes), work).ok()? {
        Found::Ended(_, Verdict::Proved | Verdict::Impossible) => {}
        _ => return None,
    }
    let least = (1.0 - EXCLUDED * effort.gap) / (1.0 - SEARCHED * effort.gap);
    let mut found: Vec<Exclusion> = Vec::new();
    // the lower half comes first, whatever is cut
    let mut open = vec![(problem.space.bounds(), Vec::new())];
    while let Some((bounds, known)) = open.pop() {
        if (found.len() + open.len()) as u64 >= effort.boxes {
            return None;
        }
        match search.excluded_by_one(bounds, &known, least)? {
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

/// What comes of a box.
enum Step {
    Excluded(Exclusion),
    /// Its halves, and the speeds that say most of it.
    Cut([Bounds; 2], Vec<u32>),
}

impl Search<'_> {
    /// Looks for a speed that excludes a box, those that say most of the box it is half of first.
    fn excluded_by_one(&self, bounds: Bounds, known: &[u32], least: f64) -> Option<Step> {
        let values = self.values(&bounds);
        let absorbers = self.cases.iter().map(|c| c.enclosed(&values).ok()).collect::<Option<Vec<_>>>()?;
        let others = (0..self.speeds.len() as u32).filter(|s| !known.contains(s));
        let (mut forms, mut said): (Vec<Form>, Vec<(f64, u32)>) = (Vec::new(), Vec::new());
        for s in known.iter().copied().chain(others) {
            let (at, first) = (&self.speeds[s as usize], forms.len());
            let case = &self.cases[at.case];
            case.forms(at, &absorbers[at.case], &mut forms);
            let excludes = |f: &&Form| f.least() >= if f.is_objective { least } else { 1.0 };
            if let Some(form) = forms[first..].iter().find(excludes) {
                let ranges = self.ranges(&bounds).into_iter().map(|(_, low, high)| (low, high)).collect();
                let load_case = &self.problem.load_cases[case.index];
                let (condition, cylinder) = (load_case.condition, load_case.cylinder);
                return Some(Step::Excluded(Exclusion {
                    ranges,
                    condition,
                    cylinder,
                    speed_rpm: at.speed_rpm,
                    by_limit: !form.is_objective,
                }));
            }
            said.push((forms[first..].iter().map(|f| f.middle).fold(f64::NEG_INFINITY, f64::max), s));
        }
        said.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let halves = halves(&bounds, along(&bounds, &forms));
        Some(Step::Cut(halves, said.into_iter().map(|s| s.1).take(FIRST).collect()))
    }
}
