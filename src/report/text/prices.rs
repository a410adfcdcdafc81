//! What each condition, limit and bound of a study costs, in words.

use super::table::significant;
use crate::analysis::{Change, OptimumResult, Price, Results};
use crate::input::Study;
use crate::price_words::{costs, parameter};

/// A smaller cost, per cent of the objective, is that of a search's tolerance.
const NOTHING: f64 = 1e-3;

/// What is asked, in words.
fn asked(study: &Study, p: &Price) -> String {
    match p.change {
        Change::WithoutCondition(c) => format!("condition {}", c.name().replace('_', " ")),
        Change::WithoutLimit(i) => study.limits[i].words.clone(),
        Change::WithoutBound { absorber, key, bound, instead } => {
            let key = parameter(study, absorber, key);
            format!("{key} {} {}", if instead > bound { "at most" } else { "at least" }, significant(bound, 4))
        }
        Change::HalfTheRing => "half the ring".to_owned(),
    }
}

/// What is asked and what it costs, with the compound or oil of the other optimum where it is another one.
fn clause(study: &Study, p: &Price, own_compound: Option<&str>) -> String {
    let cost = match (costs(study, p), p.own_holds, p.changed_holds) {
        (Some(c), ..) => format!("{}{} %", if c > 0.0 { "+" } else { "" }, significant(c, 3)),
        (None, true, true) => "has no value".to_owned(),
        (None, true, false) => "breaks limits".to_owned(),
        (None, false, holds) => {
            let then = if p.change == Change::HalfTheRing { "with it" } else { "without it" };
            format!("{then} {}", if holds { "all limits hold" } else { "limits are broken, too" })
        }
    };
    let other = p.compound.as_deref().filter(|c| own_compound.is_some_and(|own| own != *c));
    format!("{} {cost}{}", asked(study, p), other.map_or_else(String::new, |c| format!(" (then {c})")))
}

/// What is asked of an optimum and by how much each of it makes the objective worse, the dearest first, in a line; `None` where the study does not ask for that.
pub(crate) fn line(study: &Study, results: &Results, o: &OptimumResult) -> Option<String> {
    let mut own: Vec<&Price> = results.prices.iter().filter(|p| p.design == o.design.name).collect();
    let cost = |p: &Price| p.cost().unwrap_or(f64::INFINITY);
    own.sort_by(|a, b| cost(b).total_cmp(&cost(a)));
    let (free, dear): (Vec<&Price>, Vec<&Price>) = own.into_iter().partition(|p| costs(study, p).is_some_and(|c| c.abs() < NOTHING));
    let compound = o.design.absorbers.iter().find_map(|m| Some(m.absorber.law()?.material()?.substance.as_ref()?.name.clone()));
    let mut words: Vec<String> = dear.iter().map(|p| clause(study, p, compound.as_deref())).collect();
    if !free.is_empty() {
        words.push(format!("nothing: {}", free.iter().map(|p| asked(study, p)).collect::<Vec<_>>().join(", ")));
    }
    (!words.is_empty()).then(|| format!("  costs: {}", words.join("; ")))
}
