//! The tolerances that designs can bear, in words.

use super::table::significant;
use crate::analysis::{AllocationOfDesign, Results};
use crate::input::{Study, scatter_key};
use crate::optimise::Scatter;

/// What the tolerances are found for.
fn asked(study: &Study) -> Option<String> {
    let spec = study.robust.as_ref()?.allocate.as_ref()?;
    let kind = if spec.costs.is_some() { "cheapest tolerances" } else { "widest tolerances of the given ratio" };
    let until = match spec.holding {
        Some((share, s)) => format!("with which {} % of {} random designs hold all limits", significant(100.0 * share, 4), s.samples),
        None => "within which no limit was found to be broken".to_owned(),
    };
    Some(format!("{kind} {until}, at the reference of the materials"))
}

/// Those of a design.
fn of_design(study: &Study, d: &AllocationOfDesign) -> Option<String> {
    let spec = study.robust.as_ref()?;
    let (scatter, costs) = (spec.scatter(), spec.allocate.as_ref()?.costs.as_ref());
    let limit = study.limits.get(d.limit.0).map_or("", |l| l.words.as_str());
    if d.tolerances.is_empty() {
        return Some(format!("none: {} % of {limit} is used as drawn", significant(100.0 * d.limit.1, 4)));
    }
    let one = |t: &crate::analysis::Allocated| {
        let own = scatter[t.of];
        let farther = if t.at_most { ", not looked at any wider" } else { "" };
        format!("{} ±{}{farther} (given ±{})", scatter_key(&own), width(own.times(t.factor)), width(own))
    };
    let mut words: Vec<String> = d.tolerances.iter().map(one).collect();
    if let Some(costs) = costs {
        let given: f64 = d.tolerances.iter().map(|t| costs[t.of]).sum();
        let own: f64 = d.tolerances.iter().map(|t| costs[t.of] / t.factor).sum();
        words.push(format!("cost {} (as given {})", significant(own, 4), significant(given, 4)));
    }
    let decides = if d.tolerances.iter().all(|t| t.at_most) { "no limit decides".to_owned() } else { format!("{limit} decides") };
    let settled = if d.settled { "" } else { "; NOT SETTLED: a worse deviation was found in every round" };
    Some(format!("{}; {decides}{settled}", words.join(", ")))
}

/// Tolerances that a design can bear, by their keys.
pub(crate) fn borne(study: &Study, results: &Results, design: &str) -> Vec<String> {
    let Some((spec, d)) = study.robust.as_ref().zip(results.allocation.iter().find(|d| d.design == design)) else { return Vec::new() };
    let scatter = spec.scatter();
    d.tolerances.iter().map(|t| format!("{} ±{}", scatter_key(&scatter[t.of]), width(scatter[t.of].times(t.factor)))).collect()
}

/// A tolerance in the unit of its key.
fn width(s: Scatter) -> String {
    match s {
        Scatter::Share(..) | Scatter::Viscosity(_) => format!("{} %", significant(100.0 * s.width(), 4)),
        Scatter::Amount(..) | Scatter::Hardness(_) | Scatter::Temperature(_) => significant(s.width(), 4),
    }
}

/// A line for a design; `None` where the study does not ask for it.
pub(super) fn line(study: &Study, results: &Results, design: &str) -> Option<String> {
    let d = results.allocation.iter().find(|d| d.design == design)?;
    Some(format!("  {}: {}", asked(study)?, of_design(study, d)?))
}

/// All of them; empty where the study does not ask for it.
#[doc(hidden)]
pub fn allocation(study: &Study, results: &Results) -> String {
    let Some(asked) = asked(study).filter(|_| !results.allocation.is_empty()) else { return String::new() };
    let line = |d: &AllocationOfDesign| Some(format!("  {}: {}\n", d.design, of_design(study, d)?));
    let lines: String = results.allocation.iter().filter_map(line).collect();
    let first: String = asked.chars().take(1).flat_map(char::to_uppercase).collect();
    format!("{first}{}:\n{lines}", &asked[1..])
}
