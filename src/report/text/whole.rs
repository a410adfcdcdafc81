//! All that a run has found, in words and tables: what `hartog run --verbose` prints and its page holds.

use super::{calibration, margin};
use crate::analysis::{Calibration, Results, plausibility};
use crate::input::Study;

/// Everything but what the run took.
#[doc(hidden)]
pub fn whole(study: &Study, fitted: Option<&Calibration>, results: &Results) -> String {
    let reciprocating = super::reciprocating(study).map_or_else(String::new, |line| format!("  {line}\n"));
    let mut text = format!("{}: {}\n{reciprocating}\n", study.engine.name, super::flexible::frequencies(study, results));
    if let Some(fitted) = fitted {
        text += &format!("{}\n", calibration::calibration(study, fitted));
    }
    text += &super::designs(study, results);
    let sections = [
        margin::margins(study, results),
        super::torsion_cases(results),
        super::crank_models(results),
        super::duty(results),
        super::life(results),
        super::catalogue(study, results),
        super::simplest(study, results),
        super::made_of(results),
        super::heat(results),
        super::strain(results),
        super::large_twist(study, results),
        super::conditions(study, results),
        super::robust(study, results),
        super::allocation::allocation(study, results),
    ];
    let optima = results.optima.iter().filter(|o| o.main).map(|o| super::optimum(study, results, o));
    let rest = sections.into_iter().filter(|section| !section.is_empty()).chain(optima).chain([super::summary(study, results)]);
    rest.for_each(|section| text += &format!("\n{section}"));
    text
}

/// What a user is to know of the inputs, a sentence each: placeholders, how files were read, what is unlikely.
#[doc(hidden)]
pub fn notes(study: &Study, results: &Results) -> Vec<String> {
    let placeholders = super::placeholders(study, true);
    let mut list: Vec<String> = if placeholders.is_empty() { Vec::new() } else { vec![placeholders] };
    list.extend(study.remarks.iter().map(|sentence| format!("note: {sentence}")));
    let unlikely = super::implausible(&plausibility::implausible(study, &results.system.excitation.audit));
    list.extend(unlikely.into_iter().map(|sentence| format!("warning: {sentence}")));
    list
}
