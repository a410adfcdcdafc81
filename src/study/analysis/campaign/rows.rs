//! What a case gives: a row for each of its designs.

use super::columns::{Cell, at_worst, bound_of, of_limit, of_parameter};
use super::setup::with_searches;
use crate::absorber::Mounted;
use crate::analysis::searches::Searches;
use crate::analysis::timing::Clock;
use crate::analysis::{DesignResult, OptimumResult, RunError, Silent, evaluate, robust};
use crate::input::campaign::Each;
use crate::input::{FrontSpec, LimitSpec, MeasureSpec, Study};
use crate::objective::{Condition, HELD, Measure, Over, Shared, holds};
use crate::optimise::{LoadCase, largest};
use crate::response::{ResponseError, Work};

/// What became of a case, or of one of its designs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// It is done, and holds its limits.
    Ok,
    /// A limit is broken; of an optimum: no design that holds them was found.
    LimitsBroken,
    /// A search has not converged.
    NotConverged,
    /// An absorber has no steady motion or temperature at some speed, or is not judged at small twist.
    NoSteadyMotion,
    /// Nothing damps a resonance.
    Unbounded,
    /// Its input is refused.
    Refused,
    /// It ended the program.
    Crashed,
}

impl Status {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Ok, Self::LimitsBroken, Self::NotConverged, Self::NoSteadyMotion, Self::Unbounded, Self::Refused, Self::Crashed];

    /// Its word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::LimitsBroken => "limits_broken",
            Self::NotConverged => "not_converged",
            Self::NoSteadyMotion => "no_steady_motion",
            Self::Unbounded => "unbounded",
            Self::Refused => "refused",
            Self::Crashed => "crashed",
        }
    }
}

/// A row: what became of it, why, and its results by the names of their columns.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// What became of it.
    pub status: Status,
    /// Why it is not as asked.
    pub reason: String,
    /// Results.
    pub cells: Vec<(String, Cell)>,
    /// The first objective as it is minimised; not a number where there is none.
    pub(super) minimised: f64,
    /// Whether it is exact.
    pub(super) exact: bool,
    /// Which of the studies of a platform it is of.
    pub(super) covered: Vec<usize>,
}

impl Row {
    /// Of a case without a result.
    pub fn without(status: Status, reason: String) -> Self {
        Self { status, reason, cells: Vec::new(), minimised: f64::NAN, exact: true, covered: Vec::new() }
    }

    pub(super) fn of(name: &str, design: &[Mounted]) -> Self {
        let types: Vec<&str> = design.iter().map(|m| m.absorber.type_name()).collect();
        let types = if types.is_empty() { "none".to_owned() } else { types.join("+") };
        let mut row = Self::without(Status::Ok, String::new());
        row.put("design", Cell::Text(name.to_owned()));
        row.put("types", Cell::Text(types));
        for (i, m) in design.iter().enumerate() {
            let Some(law) = m.absorber.law() else { continue };
            for (p, value) in law.declaration().parameters.iter().zip(law.values()) {
                row.put(of_parameter(p.key, i, design.len()), Cell::of(Some(value)));
            }
        }
        row
    }

    pub(super) fn put(&mut self, name: impl Into<String>, cell: Cell) {
        self.cells.push((name.into(), cell));
    }

    pub(super) fn status(&mut self, status: Status, reason: impl Into<String>) {
        if self.status == Status::Ok {
            (self.status, self.reason) = (status, reason.into());
        }
    }

    pub(super) fn limits(&mut self, study: &Study, over: &[f64], hold: bool) {
        self.put("limits_hold", Cell::Truth(hold));
        for (i, value) in over.iter().enumerate() {
            self.put(of_limit(study, i), Cell::of(Some(*value)));
        }
        if !hold {
            let broken = study.limits.iter().zip(over).filter(|(_, x)| !holds(**x)).map(|(l, _)| l.words.as_str());
            self.status(Status::LimitsBroken, broken.collect::<Vec<_>>().join("; "));
        }
    }
}

/// Objectives and limits of a design at the worst of the conditions that it is judged in.
pub(super) struct Values {
    pub objectives: Vec<f64>,
    pub limits: Vec<f64>,
    pub exact: bool,
}

/// Load cases that a design is judged in.
fn judged_in<'a>(searches: &Searches<'a>, design: &[Mounted]) -> Vec<LoadCase<'a>> {
    let operation = LoadCase::new(Condition::InOperation, &searches.finders[0]);
    let operates = !Condition::InOperation.changes_nothing(design);
    searches.load_cases.iter().copied().chain(operates.then_some(operation)).collect()
}

/// How values are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum By {
    /// To rounding.
    Exact,
    /// Those of objectives by the tables of their finders, as far as these are within their tolerance.
    Tables,
}

pub(super) fn values(searches: &Searches, design: &[Mounted], by: By) -> Result<Values, ResponseError> {
    let cases = judged_in(searches, design);
    let mut work = Work::default();
    let mut of_objective = |measure: &Measure| match by {
        By::Exact => largest(cases.iter(), design, measure, &mut work),
        By::Tables => cases.iter().try_fold(0.0, |most, case| {
            let own = case.finder.value(&case.absorbers(design)?, (measure, 0.0), &Shared::default(), &mut work)?;
            Ok(f64::max(most, own))
        }),
    };
    let study = searches.study;
    let objectives = study.objectives().map(|o| of_objective(&o.measure)).collect::<Result<_, _>>()?;
    let exact = work.surrogate_evaluations == 0;
    let of_limit = |l: &LimitSpec| -> Result<f64, ResponseError> {
        let own = l.to_limit();
        let whole = largest(cases.iter(), design, &own.measure, &mut Work::default())? / own.limit;
        own.excepted.iter().try_fold(whole, |known, e| {
            let in_service = cases.iter().filter(|c| !e.in_service || c.condition.is_service());
            Ok(f64::max(known, largest(in_service, design, &e.measure, &mut Work::default())? / e.limit))
        })
    };
    Ok(Values { objectives, limits: study.limits.iter().map(of_limit).collect::<Result<_, _>>()?, exact })
}

/// The row of a given design.
pub(super) fn evaluated(searches: &Searches, name: &str, design: &[Mounted], by: By) -> Row {
    let (study, mut row) = (searches.study, Row::of(name, design));
    if design.iter().any(|m| m.absorber.law().is_some_and(|law| law.large_twist().is_some())) {
        row.status(Status::NoSteadyMotion, "an absorber of large twist is not judged here: `hartog run` computes its motion");
        return row;
    }
    match values(searches, design, by) {
        Ok(found) => {
            (row.minimised, row.exact) = (found.objectives[0], found.exact);
            row.put("exact", Cell::Truth(found.exact));
            for (o, value) in study.objectives().zip(&found.objectives) {
                row.put(o.column.clone(), Cell::of(Some(o.unit.shown(*value))));
            }
            row.limits(study, &found.limits, found.limits.iter().all(|l| holds(*l)));
        }
        Err(error) => row.status(Status::Unbounded, error.to_string()),
    }
    row
}

fn optimum(searches: &Searches, o: &OptimumResult) -> Row {
    let study = searches.study;
    let mut row = Row::of(&o.design.name, &o.design.absorbers);
    let own = study.objective_of(o.objective);
    row.put("objective", Cell::Text(own.key.to_owned()));
    let reached = if o.robust { at_worst(&own.column) } else { own.column.clone() };
    row.put(reached.clone(), Cell::of(Some(own.unit.shown(o.optimum.value()))));
    // what it was not sought by: other objectives, and its own as drawn
    let is_other = |other: &MeasureSpec| other.column != reached;
    if study.objectives().any(is_other)
        && let Ok(found) = values(searches, &o.design.absorbers, By::Exact)
    {
        for (other, value) in study.objectives().zip(&found.objectives).filter(|(other, _)| is_other(other)) {
            row.put(other.column.clone(), Cell::of(Some(other.unit.shown(*value))));
        }
    }
    row.limits(study, &o.design.limits, o.limits_hold());
    if o.design.objective.is_none() {
        row.status(Status::NoSteadyMotion, "at some speeds no steady motion of it is known");
    }
    let residual = o.optimum.outcome.kkt_residual;
    if o.is_unfinished() {
        row.status(Status::NotConverged, format!("first-order residual {residual:.0e}"));
    }
    row.put("converged", Cell::Truth(o.has_converged()));
    row.put("kkt_residual", Cell::of(Some(residual)));
    row.put("starts_agreeing", Cell::Count(o.optimum.agreeing() as i64));
    row.put("evaluations", Cell::Count(o.optimum.stages.all().evaluations as i64));
    if let Some(proof) = &o.proof {
        row.put("proof", Cell::Text(proof.verdict.word().to_owned()));
        row.put(bound_of(own), Cell::of(proof.lower_bound.map(|b| own.unit.shown(b))));
    }
    row
}

fn within_tolerances(searches: &Searches, designs: &[DesignResult]) -> Result<Vec<Row>, RunError> {
    let study = searches.study;
    let all: Vec<&DesignResult> = designs.iter().collect();
    let failed = |(d, error): (&DesignResult, ResponseError)| RunError { what: d.name.clone(), error };
    let found = robust::robust(study, (&searches.finders[0], searches.load_cases), &all, &Silent).map_err(failed)?;
    let one = |d: &DesignResult| {
        let mut row = evaluated(searches, &d.name, &d.absorbers, By::Exact);
        if let Some(own) = found.iter().find(|r| r.design == d.name) {
            let shown = |x: f64| Cell::of(Some(study.objective.unit.shown(x)));
            row.put(at_worst(&study.objective.column), shown(own.worst.value));
            if let Some(p) = &own.percentile {
                row.put(format!("percentile_{}", study.objective.column), shown(p.value));
            }
            for (i, limit) in own.limits.iter().enumerate() {
                row.put(at_worst(&of_limit(study, i)), Cell::of(Some(limit.value)));
            }
            let broken = study.limits.iter().zip(&own.limits).filter(|(_, w)| !holds(w.value)).map(|(l, _)| l.words.as_str());
            let broken: Vec<&str> = broken.collect();
            if !broken.is_empty() {
                row.status(Status::LimitsBroken, format!("within the tolerances: {}", broken.join("; ")));
            }
        }
        row
    };
    Ok(designs.iter().map(one).collect())
}

fn fronts(searches: &Searches) -> Result<Vec<Row>, RunError> {
    let study = searches.study;
    let Some(spec) = &study.optimise else { return Ok(Vec::new()) };
    let mut clock = Clock::start();
    let optima = searches.optima(spec, &mut clock)?;
    let mut rows = Vec::new();
    let point = |name: &str, i: usize, design: &[Mounted], dominated: bool, residual: f64| {
        let mut row = Row::of(name, design);
        row.put("point", Cell::Count(i as i64 + 1));
        row.put("dominated", Cell::Truth(dominated));
        row.put("kkt_residual", Cell::of(Some(residual)));
        row
    };
    for front in searches.fronts(spec, &optima, &mut clock)? {
        for (i, (p, others)) in front.front.points.iter().zip(&front.others).enumerate() {
            let mut row = point(&format!("front_{}", front.declaration.name), i, &p.design, p.dominated, p.kkt_residual);
            row.put("limits_hold", Cell::Truth(p.excess <= HELD));
            let values = std::iter::once(&p.value).chain(others);
            for (o, value) in study.objectives().zip(values) {
                row.put(o.column.clone(), Cell::of(Some(o.unit.shown(*value))));
            }
            if p.excess > HELD {
                row.status(Status::LimitsBroken, format!("beyond a limit by {:.3} of it", p.excess));
            }
            rows.push(row);
        }
    }
    let measures = match &study.front {
        Some(FrontSpec::Of { measures, .. }) => measures.as_slice(),
        _ => &[],
    };
    for tradeoff in &searches.tradeoffs(spec, &optima, &mut clock)? {
        for ((family, front), third) in tradeoff.families.iter().zip(&tradeoff.third) {
            for (i, p) in front.points.iter().enumerate() {
                let mut row = point(&format!("front_{family}"), i, &p.design, p.dominated, p.kkt_residual);
                let own = evaluated(searches, "", &p.design, By::Exact);
                row.cells.extend(own.cells.into_iter().filter(|(name, _)| name.ends_with("_over_limit") || name == "limits_hold"));
                row.status(own.status, own.reason);
                for (m, spec) in measures.iter().enumerate() {
                    let place = tradeoff.of.iter().position(|of| *of == m);
                    let value = place.map_or_else(|| third.get(i).copied(), |k| Some(p.values[k]));
                    row.put(spec.column.clone(), Cell::of(value.map(|v| spec.unit.shown(v))));
                }
                rows.push(row);
            }
        }
    }
    Ok(rows)
}

/// The study as far as rows of this kind ask for it: what costs time and reaches none of them is left out.
pub(super) fn as_asked(study: &Study, each: Each) -> Study {
    let mut study = study.clone();
    match each {
        Each::Evaluate => study.leave_searches_out(),
        Each::Optimise => (study.front, study.robust) = (None, study.robust.filter(|r| r.search)),
        Each::Front => study.robust = None,
        Each::Robust => study.front = None,
        // the first objective is asked for
        Each::Platform => {
            (study.front, study.robust, study.combined) = (None, None, None);
            study.more_objectives.clear();
        }
    }
    let needs_margin = study.measures().any(|m| matches!(m.measure.over, Over::Margin(_)));
    if !needs_margin {
        study.fatigue = None;
    }
    study
}

/// The rows of a case that changes more of its study than parameters of given designs.
///
/// # Errors
/// [`RunError`] where a design has no finite response.
pub(super) fn rows(study: &Study, each: Each) -> Result<Vec<Row>, RunError> {
    let study = as_asked(study, each);
    with_searches(&study, None, |searches| match each {
        Each::Evaluate => {
            let sold = searches.study.catalogues.iter().flat_map(|c| &c.designs);
            Ok(searches.study.designs.iter().chain(sold).map(|d| evaluated(searches, &d.name, &d.absorbers, By::Exact)).collect())
        }
        Each::Optimise => {
            let Some(spec) = &searches.study.optimise else { return Ok(Vec::new()) };
            Ok(searches.optima(spec, &mut Clock::start())?.iter().map(|o| optimum(searches, o)).collect())
        }
        Each::Front => fronts(searches),
        Each::Robust if searches.study.robust.is_none() => Ok(Vec::new()),
        Each::Robust => {
            let given = |d: &crate::input::DesignSpec| {
                evaluate::evaluate(searches.finders, &d.name, &d.absorbers, searches.wanted, &mut Work::default())
            };
            let mut designs = searches.study.designs.iter().map(given).collect::<Result<Vec<_>, _>>()?;
            if let Some(spec) = &searches.study.optimise {
                designs.extend(searches.optima(spec, &mut Clock::start())?.into_iter().map(|o| o.design));
            }
            within_tolerances(searches, &designs)
        }
        // of several studies
        Each::Platform => Ok(Vec::new()),
    })
}
