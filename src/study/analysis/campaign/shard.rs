//! The cases of a shard, one after the other.

use super::cases::Case;
use super::columns::{Cell, Column, index_of};
use super::platform;
use super::rows::{By, Row, Status, as_asked, evaluated, rows};
use super::setup::with_searches;
use crate::absorber::mounted::with_law;
use crate::absorber::types;
use crate::analysis::searches::Searches;
use crate::input::campaign::{Axis, Campaign, Each};
use crate::input::{DesignSpec, InputError, Study};
use std::ops::Range;

/// A sampled key that is a parameter of a given design: what is behind it is shared by the cases that differ in nothing else.
#[derive(Debug, Clone, Copy, PartialEq)]
struct OfDesign {
    design: usize,
    absorber: usize,
    parameter: usize,
}

/// The rows of a case, in the order of columns.
pub type Rows = Vec<Vec<Cell>>;

/// Where sampled keys lead in a study, if all of them are parameters of its designs: `design.0.absorber.0.type.tuned.stiffness_n_m_per_rad`.
fn of_designs(campaign: &Campaign, study: &Study) -> Option<Vec<OfDesign>> {
    if !study.catalogues.is_empty() {
        return None;
    }
    let keys = &campaign.sample.as_ref()?.keys;
    let one = |key: &str| {
        let ["design", design, "absorber", absorber, "type", kind, parameter] = key.split('.').collect::<Vec<_>>()[..] else { return None };
        let design =
            design.parse().ok().filter(|i| *i < study.designs.len()).or_else(|| study.designs.iter().position(|d| d.name == design))?;
        let absorber: usize = absorber.parse().ok()?;
        let declaration = study.designs.get(design)?.absorbers.get(absorber)?.absorber.declaration()?;
        (declaration.name == types::find(kind)?.name).then_some(())?;
        Some(OfDesign { design, absorber, parameter: declaration.index(parameter)? })
    };
    keys.iter().map(|k| one(&k.key)).collect()
}

/// Designs with other values of some parameters; `None` where one is out of its range.
fn with_values(designs: &[DesignSpec], of: &[OfDesign], values: &[f64]) -> Option<Vec<DesignSpec>> {
    let mut designs = designs.to_vec();
    for (place, value) in of.iter().zip(values) {
        let own = &mut designs[place.design];
        let law = own.absorbers[place.absorber].absorber.law()?;
        if !law.declaration().parameters[place.parameter].range.holds(*value) {
            return None;
        }
        own.absorbers = with_law(&own.absorbers, place.absorber, |law| {
            let mut all = law.values();
            all[place.parameter] = *value;
            law.rebuilt(&all)
        });
    }
    Some(designs)
}

fn refused(error: &InputError) -> Row {
    let first = &error.mistakes[0];
    let more = error.mistakes.len() - 1;
    let more = if more > 0 { format!(", and {more} more") } else { String::new() };
    Row::without(Status::Refused, format!("{}{more}", first.message))
}

/// A case by itself.
fn alone(campaign: &Campaign, case: &Case) -> Vec<Row> {
    let (members, mut studies) = (campaign.members(case), Vec::new());
    for member in &members {
        match campaign.study_of_case(member) {
            Ok(study) => studies.push(study),
            Err(error) => {
                let mut row = Row { covered: member.covered.clone(), ..refused(&error) };
                if campaign.platform.is_some() {
                    row.reason = format!("{}: {}", campaign.study_name(member), row.reason);
                }
                return vec![row];
            }
        }
    }
    let found = match &campaign.platform {
        Some(own) => {
            let names = members.iter().map(|m| campaign.study_name(m)).collect();
            platform::rows(own, &platform::Named { members: &members, names, studies: &studies })
        }
        None => rows(&studies[0], campaign.each),
    };
    match found {
        Ok(rows) if rows.is_empty() => vec![Row::without(Status::Refused, "the study has nothing of what is asked".into())],
        Ok(rows) => rows,
        Err(error) => vec![Row::without(Status::Unbounded, error.to_string())],
    }
}

/// Finds exactly what may be the best of each design: what is above the best by less than both may err.
fn confirm(searches: &Searches, of: &[OfDesign], (cases, found): (&[Case], &mut [Vec<Row>]), tolerance: f64) {
    for i in 0..searches.study.designs.len() {
        let best = found.iter().filter_map(|rows| rows.get(i)).map(|r| r.minimised).fold(f64::INFINITY, f64::min);
        let may_win = |row: &Row| !row.exact && row.minimised <= best * (1.0 + tolerance) / (1.0 - tolerance);
        for (case, rows) in cases.iter().zip(found.iter_mut()) {
            let Some(own) = rows.get_mut(i).filter(|row| may_win(row)) else { continue };
            if let Some(d) = with_values(&searches.study.designs, of, &case.values).map(|mut designs| designs.swap_remove(i)) {
                *own = evaluated(searches, &d.name, &d.absorbers, By::Exact);
            }
        }
    }
}

/// What takes the rows of each case, in the order of the cases.
type Put<'p> = &'p mut dyn FnMut(&Case, Vec<Row>);

/// Cases that differ in parameters of given designs only, on one engine.
fn together(campaign: &Campaign, study: &Study, of: &[OfDesign], (range, crashed): (Range<usize>, &[usize]), put: Put) {
    let by = if campaign.tolerance.is_some() { By::Tables } else { By::Exact };
    let done = with_searches(&as_asked(study, campaign.each), campaign.tolerance, |searches| {
        in_parts(campaign, range.clone(), |cases| {
            let rows_of = |case: &Case| {
                let designs = with_values(&searches.study.designs, of, &case.values)?;
                Some(designs.iter().map(|d| evaluated(searches, &d.name, &d.absorbers, by)).collect::<Vec<Row>>())
            };
            let one = |case: &Case| ended(case, crashed).or_else(|| rows_of(case)).unwrap_or_else(|| alone(campaign, case));
            let mut found: Vec<Vec<Row>> = cases.iter().map(one).collect();
            if let Some(tolerance) = campaign.tolerance {
                confirm(searches, of, (cases, &mut found), tolerance);
            }
            cases.iter().zip(found).for_each(|(case, rows)| put(case, rows));
        });
        Ok(())
    });
    if done.is_err() {
        each_alone(campaign, (range, crashed), put);
    }
}

/// Each case by itself.
fn each_alone(campaign: &Campaign, (range, crashed): (Range<usize>, &[usize]), put: Put) {
    in_parts(campaign, range, |cases| {
        cases.iter().for_each(|case| put(case, ended(case, crashed).unwrap_or_else(|| alone(campaign, case))));
    });
}

/// So many cases are made at a time.
const PART: usize = 4096;

/// Cases of a range, some at a time: there may be as many as one likes.
fn in_parts(campaign: &Campaign, range: Range<usize>, mut of: impl FnMut(&[Case])) {
    for start in range.clone().step_by(PART) {
        of(&campaign.cases_of(start..(start + PART).min(range.end)));
    }
}

/// The row of a case that is known to end the program.
fn ended(case: &Case, crashed: &[usize]) -> Option<Vec<Row>> {
    #[cfg(feature = "poison")]
    if !crashed.contains(&case.number) && std::env::var("HARTOG_POISON").is_ok_and(|n| n == case.number.to_string()) {
        std::process::abort();
    }
    crashed.contains(&case.number).then(|| vec![Row::without(Status::Crashed, "it ended the program".into())])
}

/// Computes cases in their order, and hands on the rows of each. `crashed`: those that end the program, which are told as such.
#[doc(hidden)]
pub fn run_cases(campaign: &Campaign, columns: &[Column], range: Range<usize>, crashed: &[usize], put: &mut dyn FnMut(usize, Rows)) {
    let mut put = |case: &Case, rows: Vec<Row>| {
        put(case.number, rows.into_iter().map(|row| cells(campaign, columns, case, row)).collect());
    };
    for own in campaign.by_combination(range) {
        let first = campaign.cases_of(own.start..own.start + 1);
        let shared = (campaign.each == Each::Evaluate && own.len() > 1).then(|| campaign.study_of_case(&first[0]).ok()).flatten();
        match shared.and_then(|study| of_designs(campaign, &study).map(|of| (study, of))) {
            Some((study, of)) => together(campaign, &study, &of, (own, crashed), &mut put),
            None => each_alone(campaign, (own, crashed), &mut put),
        }
    }
}

/// The cells of a row.
fn cells(campaign: &Campaign, columns: &[Column], case: &Case, row: Row) -> Vec<Cell> {
    let mut cells = vec![Cell::Empty; columns.len()];
    let own = Case { covered: row.covered, ..case.clone() };
    let label = |(i, axis): (usize, &Axis)| match campaign.labels(&own).get(i) {
        Some(label) => label.parse().ok().filter(|_| axis.numeric).map_or_else(|| Cell::Text((*label).to_owned()), Cell::Number),
        None => Cell::Empty,
    };
    let labels = campaign.all_axes().enumerate().map(label);
    let values = case.values.iter().map(|x| Cell::Number(*x));
    let reason = if row.reason.is_empty() { Cell::Empty } else { Cell::Text(row.reason) };
    let own = std::iter::once(Cell::Count(case.number as i64)).chain(labels).chain(values);
    for (cell, value) in cells.iter_mut().zip(own.chain([Cell::Text(row.status.word().to_owned()), reason])) {
        *cell = value;
    }
    for (name, value) in row.cells {
        if let Some(i) = index_of(campaign, columns, &name) {
            cells[i] = value;
        }
    }
    cells
}
