//! What is proved of an optimum, in words.

use super::judged::value_of;
use super::table::significant;
use crate::analysis::OptimumResult;
use crate::input::tables::ProofTable;
use crate::input::{MeasureSpec, Study};
use crate::optimise::{Proof, Verdict};

/// A bound in words, with its last digit on the safe side: no lower bound is told that was not proved, nor an upper one; of a margin they change places.
pub(super) fn told(objective: &MeasureSpec, bound: f64, is_lower: bool) -> String {
    let exact = objective.unit.shown(bound);
    let number = |text: &str| text.split(|c: char| !(c.is_ascii_digit() || ".e-".contains(c))).next().and_then(|t| t.parse::<f64>().ok());
    let is_safe =
        |text: &String| number(text).is_none_or(|n| if objective.unit.is_inverse() == is_lower { n >= exact } else { n <= exact });
    let shares = std::iter::once(0.0).chain(std::iter::successors(Some(1e-7), |share| (*share < 0.1).then_some(2.0 * share)));
    let mut texts = shares.map(|share| value_of(objective, if is_lower { bound * (1.0 - share) } else { bound * (1.0 + share) }));
    texts.find(is_safe).unwrap_or_else(|| value_of(objective, if is_lower { 0.9 * bound } else { 1.1 * bound }))
}

/// A clause: what no design of the family is better than, or why nothing is proved.
pub(super) fn clause(study: &Study, o: &OptimumResult) -> String {
    let Some(proof) = &o.proof else { return "not proved".into() };
    let objective = study.objective_of(o.objective);
    let within = if study.limits.is_empty() { "" } else { " within the limits" };
    let side = if objective.unit.is_inverse() { "above" } else { "below" };
    let bound = proof.lower_bound;
    let no_design = |bound: f64| format!("no design of its family{within} is {side} {}", told(objective, bound, true));
    let gap = bound.and_then(|b| gap(o, b)).map_or_else(String::new, |gap| format!("gap {}, ", significant(gap, 2)));
    let boxes = if proof.boxes == 1 { "1 box".to_owned() } else { format!("{} boxes", proof.boxes) };
    let said = match (&proof.verdict, bound) {
        (Verdict::Proved, Some(b)) => format!("proved: {} ({gap}{boxes})", no_design(b)),
        (Verdict::Impossible, _) => format!("proved: no design of its family holds all limits ({boxes})"),
        (Verdict::Open(_), Some(b)) => format!("proved to a part: {} ({gap}{boxes})", no_design(b)),
        (Verdict::Open(_), None) | (Verdict::Proved, None) => format!("not proved in {boxes}"),
        (Verdict::None(reason), _) => format!("not proved ({})", reason.words()),
    };
    let other_side = if objective.unit.is_inverse() { "below" } else { "above" };
    let said = match proof.upper_bound {
        Some(b) => format!("{said}; at no speed is it {other_side} {}", told(objective, b, false)),
        None => said,
    };
    let said = match (&o.exclusions, &proof.verdict) {
        (Some(_), _) => format!("{said}; its boxes are in proof_{}.csv", o.design.name),
        (None, Verdict::Proved | Verdict::Impossible | Verdict::Open(_)) if study.optimise.as_ref().is_some_and(|s| s.prove.file) => {
            format!("{said}; no table of it was written")
        }
        (None, _) => said,
    };
    match proof.better {
        0 => said,
        1 => format!("{said}; a box of the proof led to it"),
        n => format!("{said}; {n} boxes of the proof led to it"),
    }
}

/// What a proof from a file says, once it is confirmed in so many parts of its boxes.
#[doc(hidden)]
pub fn confirmed(study: &Study, objective: usize, table: &ProofTable, parts: u64) -> String {
    let objective = study.objective_of(objective);
    let within = if study.limits.is_empty() { "" } else { " within the limits" };
    let side = if objective.unit.is_inverse() { "above" } else { "below" };
    let range = |d: usize| {
        let ends = table.boxes.iter().map(|b| b.own.ranges[d]);
        let (low, high) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |m, r| (m.0.min(r.0), m.1.max(r.1)));
        format!("{} {} to {}", table.free[d], significant(low, 4), significant(high, 4))
    };
    let ranges: Vec<String> = (0..table.free.len()).map(range).collect();
    let found = match table.bound {
        Some(bound) => format!("no design of its family{within} is {side} {}", told(objective, objective.unit.inside(bound), true)),
        None => "no design of its family holds all limits".to_owned(),
    };
    let boxes = if table.boxes.len() == 1 { "1 box covers".to_owned() } else { format!("{} boxes cover", table.boxes.len()) };
    format!(
        "{}: confirmed, {found}: {boxes} {}, and solutions of the whole matrix exclude each at its speeds ({parts} parts)\n",
        table.design,
        ranges.join(" and ")
    )
}

/// Whether it is proved that no design holds all limits.
pub(super) fn is_impossible(o: &OptimumResult) -> bool {
    matches!(o.proof, Some(Proof { verdict: Verdict::Impossible, .. }))
}

/// Share of its value that an optimum is above a bound, at most; `None` where it breaks a limit.
fn gap(o: &OptimumResult, bound: f64) -> Option<f64> {
    o.optimum.outcome.rows.hold().then(|| 1.0 - bound / o.optimum.value())
}
