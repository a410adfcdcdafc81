//! The front of two measures of a family: what the least of the first is at every value of the second.
//!
//! The second is held below a level (the epsilon constraint \[Haimes, Lasdon & Wismer 1971\]), and the optimum followed from level to level by the minimax method, from both neighbours. Both
//! ends are searched globally, some levels between them from all starts of a search; new levels are put where the front is longest between its points.

use super::Problem;
use super::adaptive_levels::{Level, SAME, distinct, gaps, middle, range};
use super::checkpoint::Remembers;
use super::conflict;
use super::load_case::largest;
use super::lower_elsewhere::lower_elsewhere;
use super::minimax::{self, Outcome};
use super::search::{self, Finish, Optimum, Recorder};
use super::starts::Starts;
use super::survey;
use crate::absorber::Mounted;
use crate::objective::{HELD, Limit};
use crate::response::{ResponseError, Work};
use nalgebra::DMatrix;
use rayon::prelude::*;

/// A point of a front.
#[derive(Debug, Clone, serde::Serialize)]
pub struct TradeoffPoint {
    /// The optimum.
    pub design: Vec<Mounted>,
    /// The first measure and the second, in SI units.
    pub values: [f64; 2],
    /// First-order residual.
    pub kkt_residual: f64,
    /// Whether another point of any family is no worse in both.
    pub dominated: bool,
    /// Whether it is the knee: the furthest from the line between the ends, both measures over their ranges.
    pub knee: bool,
}

/// A front and the work it took.
#[derive(Debug, Clone, serde::Serialize)]
pub struct Tradeoff {
    /// By ascending second measure.
    pub points: Vec<TradeoffPoint>,
    /// Evaluations of its minimax stage, and designs that it ended in.
    pub minimax: Work,
    /// Evaluations of global searches.
    pub searches: Work,
}

/// A point to begin with, and the curvature there.
type Known<'l> = (&'l [f64], Option<&'l DMatrix<f64>>);

/// Where an outcome ended.
fn end(outcome: &Outcome) -> Known<'_> {
    (&outcome.point, Some(&outcome.curvature))
}

/// Of the random points of a whole box.
const SEED: u64 = 1;
/// Levels that are looked at from all starts, ends included.
const KNOTS: usize = 5;
/// An optimum that is lower than another by more than this share is a better one.
const BETTER: f64 = 1e-9;
/// Where a front begins, as shares of the range of the second measure above its least: at the first at which there is a design.
const ABOVE_LEAST: [f64; 4] = [0.0, 1e-3, 1e-2, 1e-1];
/// A design that is level in the first measure ends a front where it is lower in the second by more than this share: less is what rounding of the first leaves.
const WORTH: f64 = 1e-4;
/// Between neighbours whose measures differ by more than these shares of their ranges the branches of several absorbers change, and there is room for a third.
const JUMP: f64 = 0.25;
const WIDE: f64 = 0.2;
/// Rounds in which points take over what a neighbour found.
const MOST_ROUNDS: usize = 20;

/// A front between the least of each of two measures.
pub struct Follower<'a> {
    problem: &'a Problem<'a>,
    second: &'a Limit,
    starts: Starts<'a>,
    least: [Option<&'a Optimum>; 2],
}

impl<'a> Follower<'a> {
    /// Of the (only) objective of a problem against a second measure.
    pub fn new(problem: &'a Problem<'a>, second: &'a Limit, starts: Starts<'a>) -> Self {
        Self { problem, second, starts, least: [None; 2] }
    }

    /// With the least of each measure, where a search of the same problem has found it.
    #[must_use]
    #[doc(hidden)]
    pub fn with_least(self, least: [Option<&'a Optimum>; 2]) -> Self {
        Self { least, ..self }
    }

    /// Limits of the problem, the second measure at most at a level being the last.
    fn limits(&self, most: f64) -> Vec<Limit> {
        self.problem.limits.iter().cloned().chain([Limit { limit: most, ..self.second.measure.in_si() }]).collect()
    }

    fn within<'p>(&self, limits: &'p [Limit], objectives: &'p [Limit]) -> Problem<'p>
    where
        'a: 'p,
    {
        Problem {
            load_cases: self.problem.load_cases,
            space: self.problem.space.clone(),
            objectives,
            weights: &[],
            limits,
            memory: self.problem.memory.map(Remembers::part),
        }
    }

    /// Both measures at a point, where the family can change them.
    fn values(&self, w: &[f64], work: &mut Work) -> Result<[f64; 2], ResponseError> {
        let design = self.problem.space.design(w);
        let mut value_of = |limit: &Limit| largest(self.problem.steering().map(|s| s.1), &design, &limit.measure, work);
        Ok([value_of(&self.problem.objectives[0])?, value_of(self.second)?])
    }

    /// The best outcome of the minimax method from some points, with the curvature there where it is known.
    fn best_of_points(&self, most: f64, points: &[Known], work: &mut Work) -> Result<Option<Level>, ResponseError> {
        let limits = self.limits(most);
        let problem = self.within(&limits, self.problem.objectives);
        let ends: Vec<(Option<Outcome>, Work)> = points
            .par_iter()
            .map(|(point, curvature)| {
                let mut work = Work::default();
                let outcome = match curvature {
                    Some(known) => minimax::minimise_with(&problem, point, (*known).clone(), &mut work),
                    None => minimax::minimise(&problem, point, &mut work),
                };
                let outcome = outcome.ok();
                let finite = outcome.filter(|o| self.values(&o.point, &mut work).is_ok());
                (finite, work)
            })
            .collect();
        let mut best: Option<Outcome> = None;
        for (outcome, spent) in ends {
            *work += spent;
            let Some(outcome) = outcome else { continue };
            best = Some(match best {
                Some(b) if b.merit() <= outcome.merit() => b,
                _ => outcome,
            });
        }
        best.filter(|b| b.rows.hold())
            .map(|outcome| Ok(Level { most, values: self.values(&outcome.point, &mut Work::default())?, outcome }))
            .transpose()
    }

    /// The same from some points and from all starts of a search.
    fn best_of_starts(&self, most: f64, points: &[Known], work: &mut Work) -> Result<Option<Level>, ResponseError> {
        let starts = (self.starts)(&self.problem.space);
        let all: Vec<Known> = points.iter().copied().chain(starts.iter().map(|s| (s.1.as_slice(), None))).collect();
        self.best_of_points(most, &all, work)
    }

    /// An optimum within the limits of a problem: by a global search, where that ends outside them by the points of the whole box, and by what comes nearest to all limits. `None` where none of these holds them.
    fn within_limits(&self, problem: &Problem, work: &mut Work) -> Result<Option<Optimum>, ResponseError> {
        let starts = (self.starts)(&problem.space);
        let mut optimum = search::optimise(problem, &starts, Finish::All, &|| {})?;
        if !optimum.outcome.rows.hold() && survey::is_wanted(problem) {
            survey::survey(problem, &mut optimum, SEED);
        }
        if optimum.outcome.rows.hold() && problem.space.slots.len() > 1 {
            lower_elsewhere(problem, &mut optimum, SEED);
        }
        if !optimum.outcome.rows.hold()
            && let conflict::Verdict::Found(outcome) = conflict::judge(problem, &optimum, &starts)?
        {
            optimum.design = problem.space.design(&outcome.point);
            optimum.outcome = *outcome;
        }
        *work += optimum.stages.all();
        Ok(optimum.outcome.rows.hold().then_some(optimum))
    }

    /// The least of the first measure by a global search, and the starts that led there.
    fn searched(&self, work: &mut Work) -> Result<Option<(Level, Vec<String>)>, ResponseError> {
        let limits = self.limits(f64::MAX);
        let problem = self.within(&limits, self.problem.objectives);
        let Some(optimum) = self.within_limits(&problem, work)? else { return Ok(None) };
        let values = self.values(&optimum.outcome.point, &mut Work::default())?;
        let starts = optimum.level_starts().map(str::to_owned).collect();
        Ok(Some((Level { most: f64::MAX, values, outcome: optimum.outcome }, starts)))
    }

    /// Of designs that are level with this one in the first measure the one with the least of the second, from it and from the starts that led to a level one.
    fn least_of_second(&self, last: Level, level: &[String], work: &mut Work) -> Result<Level, ResponseError> {
        let most = last.values[0] * (1.0 + HELD);
        let first = Limit { limit: most, ..self.problem.objectives[0].measure.in_si() };
        let limits: Vec<Limit> = self.problem.limits.iter().cloned().chain([first]).collect();
        let seconds = [self.second.measure.in_si()];
        let problem = self.within(&limits, &seconds);
        let starts = (self.starts)(&self.problem.space).into_iter().filter(|s| level.contains(&s.0));
        let own = last.outcome.point.clone();
        let points: Vec<Vec<f64>> = std::iter::once(own).chain(starts.map(|s| s.1)).collect();
        let ends: Vec<(Option<Level>, Work)> = points
            .par_iter()
            .map(|point| {
                let mut work = Work::default();
                let lower = |o: &Outcome| o.rows.hold() && o.rows.objective() < last.values[1] * (1.0 - WORTH);
                let outcome = minimax::minimise(&problem, point, &mut work).ok().filter(lower);
                let level = outcome.and_then(|outcome| {
                    let values = self.values(&outcome.point, &mut work).ok()?;
                    Some(Level { most: values[1], values, outcome })
                });
                (level, work)
            })
            .collect();
        let mut best = last;
        for (level, spent) in ends {
            *work += spent;
            best = level.filter(|l| l.outcome.rows.objective() < best.values[1] * (1.0 - WORTH)).unwrap_or(best);
        }
        Ok(best)
    }

    /// What the second measure is where all variables are at their lower bounds, where that is the least of it: of inertias, which grow with their own variables alone.
    fn lowest(&self) -> Result<Option<f64>, ResponseError> {
        if !self.second.measure.is_inertia() {
            return Ok(None);
        }
        let corner: Vec<f64> = self.problem.space.bounds().iter().map(|bound| bound.0).collect();
        let design = self.problem.space.design(&corner);
        largest(self.problem.steering().map(|s| s.1), &design, &self.second.measure, &mut Work::default()).map(Some)
    }

    /// The least of each measure, first that of the second.
    fn ends(&self, work: &mut Work) -> Result<Option<[Level; 2]>, ResponseError> {
        let again = |o: &Optimum, work: &mut Work| self.best_of_points(f64::MAX, &[(&o.outcome.point, None)], work);
        let known = self.least[0].map(|o| Ok(again(o, work)?.map(|level| (level, o.level_starts().map(str::to_owned).collect()))));
        let known: Option<(Level, Vec<String>)> = known.transpose()?.flatten();
        let Some((last, level)) = known.map_or_else(|| self.searched(work), |known| Ok(Some(known)))? else { return Ok(None) };
        let last = self.least_of_second(last, &level, work)?;
        // the least that bounds allow needs no search where a design of that holds the limits
        if let Some(lowest) = self.lowest()?
            && let Some(first) = self.best_of_starts(lowest * (1.0 + HELD), &[(&last.outcome.point, None)], work)?
        {
            return Ok(Some([first, last]));
        }
        let seconds = [self.second.measure.in_si()];
        let least_second = self.within(self.problem.limits, &seconds);
        let known = self.least[1].map(|o| minimax::minimise(&least_second, &o.outcome.point, work)).transpose()?;
        let found = match known.filter(|o| o.rows.hold()) {
            Some(outcome) => Some(outcome),
            None => self.within_limits(&least_second, work)?.map(|o| o.outcome),
        };
        let Some(found) = found else { return Ok(None) };
        let least = found.rows.objective();
        // designs that are level in the second measure differ in the first; the least of the second may be one without a finite first, as a ring without damping is
        for above in ABOVE_LEAST {
            let most = (least * (1.0 + HELD)).max(least + above * (last.values[1] - least));
            if let Some(first) = self.best_of_starts(most, &[(&found.point, None), (&last.outcome.point, None)], work)? {
                return Ok(Some([first, last]));
            }
        }
        Ok(None)
    }

    /// Follows the front with about as many points as asked for.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where no start has a finite response.
    pub fn follow(&self, count: usize, recorder: Recorder) -> Result<Tradeoff, ResponseError> {
        let (mut work, mut searches) = (Work::default(), Work::default());
        let Some([first, last]) = self.ends(&mut searches)? else {
            return Ok(Tradeoff { points: Vec::new(), minimax: work, searches });
        };
        recorder();
        let several = self.problem.space.slots.len() > 1;
        let (low, high) = (first.values[1], last.values[1]);
        let knots: Vec<f64> = (1..KNOTS - 1).map(|i| low + (high - low) * i as f64 / (KNOTS - 1) as f64).collect();
        let found: Vec<(Option<Level>, Work)> = knots
            .into_par_iter()
            .map(|most| {
                let mut work = Work::default();
                Ok((self.best_of_starts(most, &[(&first.outcome.point, None), (&last.outcome.point, None)], &mut work)?, work))
            })
            .collect::<Result<_, ResponseError>>()?;
        let mut levels = vec![first];
        for (level, spent) in found {
            searches += spent;
            levels.extend(level);
        }
        levels.push(last);
        recorder();
        while levels.len() < count {
            let gaps = gaps(&levels, count);
            if gaps.is_empty() {
                break;
            }
            let between: Vec<(usize, Option<Level>, Work)> = gaps
                .into_par_iter()
                .map(|i| {
                    let (left, right) = (&levels[i], &levels[i + 1]);
                    let mut work = Work::default();
                    let (most, ends) = (middle(left, right), [end(&left.outcome), end(&right.outcome)]);
                    // between two branches there may be a third
                    let apart = |k: usize, share: f64| (left.values[k] - right.values[k]).abs() > share * range(&levels, k);
                    let level = if several && apart(0, JUMP) && apart(1, WIDE) {
                        self.best_of_starts(most, &ends, &mut work)?
                    } else {
                        self.best_of_points(most, &ends, &mut work)?
                    };
                    recorder();
                    Ok((i, level, work))
                })
                .collect::<Result<_, ResponseError>>()?;
            let range = range(&levels, 1);
            for (i, level, spent) in between.into_iter().rev() {
                work += spent;
                let most = middle(&levels[i], &levels[i + 1]);
                match level {
                    // a new point, unless the optimum stays where a stricter level had it
                    Some(level) if level.values[1] > levels[i].values[1] + SAME * range => levels.insert(i + 1, level),
                    _ => levels[i].most = most,
                }
            }
        }
        self.repair(&mut levels, &mut work)?;
        distinct(&mut levels);
        let points = levels.iter().map(|l| TradeoffPoint {
            design: self.problem.space.design(&l.outcome.point),
            values: l.values,
            kkt_residual: l.outcome.kkt_residual,
            dominated: false,
            knee: false,
        });
        Ok(Tradeoff { points: points.collect(), minimax: work, searches })
    }

    /// Where a level's optimum is beaten by a stricter one's, or may be by that of a neighbour, it is followed anew from there.
    fn repair(&self, levels: &mut [Level], work: &mut Work) -> Result<(), ResponseError> {
        let mut changed: Vec<bool> = vec![true; levels.len()];
        for _ in 0..MOST_ROUNDS {
            // a stricter level with a lower optimum, or a neighbour whose optimum has changed
            let beaten = |i: usize| (0..i).rev().find(|j| levels[*j].values[0] < levels[i].values[0] * (1.0 - BETTER));
            let wanted: Vec<(usize, usize)> =
                (1..levels.len()).filter_map(|i| beaten(i).map(|j| (i, j))).filter(|(i, j)| changed[*i] || changed[*j]).collect();
            if wanted.is_empty() {
                return Ok(());
            }
            let found: Vec<(usize, Option<Level>, Work)> = wanted
                .into_par_iter()
                .map(|(i, j)| {
                    let mut work = Work::default();
                    let level = self.best_of_points(levels[i].most, &[end(&levels[j].outcome)], &mut work)?;
                    Ok((i, level, work))
                })
                .collect::<Result<_, ResponseError>>()?;
            changed.fill(false);
            for (i, level, spent) in found {
                *work += spent;
                if let Some(level) = level.filter(|l| l.values[0] < levels[i].values[0] * (1.0 - BETTER)) {
                    levels[i] = level;
                    changed[i] = true;
                }
            }
        }
        Ok(())
    }
}

/// Marks what another point of any front is no worse than in both measures, and the knee of what is left.
#[doc(hidden)]
pub fn mark(fronts: &mut [Tradeoff]) {
    let all: Vec<[f64; 2]> = fronts.iter().flat_map(|f| &f.points).map(|p| p.values).collect();
    let beats = |a: &[f64; 2], b: &[f64; 2]| a[0] <= b[0] && a[1] <= b[1] && (a[0] < b[0] * (1.0 - BETTER) || a[1] < b[1] * (1.0 - BETTER));
    for point in fronts.iter_mut().flat_map(|f| &mut f.points) {
        point.dominated = all.iter().any(|other| beats(other, &point.values));
    }
    let mut left: Vec<&mut TradeoffPoint> = fronts.iter_mut().flat_map(|f| &mut f.points).filter(|p| !p.dominated).collect();
    left.sort_by(|a, b| a.values[1].total_cmp(&b.values[1]));
    let (Some(a), Some(b)) = (left.first().map(|p| p.values), left.last().map(|p| p.values)) else { return };
    let over = |k: usize, x: f64| if a[k] == b[k] { 0.0 } else { (x - a[k]) / (b[k] - a[k]) };
    // with both measures over their ranges the line between the ends is that of equal shares
    let depth = |v: [f64; 2]| over(0, v[0]) - over(1, v[1]);
    let deepest = left.iter_mut().max_by(|a, b| depth(a.values).total_cmp(&depth(b.values)));
    if let Some(knee) = deepest.filter(|p| depth(p.values) > 0.0) {
        knee.knee = true;
    }
}
