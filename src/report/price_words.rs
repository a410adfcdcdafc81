//! What is changed of a study to tell what it costs, and the cost as it is shown.

use crate::analysis::{Change, Price};
use crate::input::Study;

/// A parameter, with the number of its absorber where there are several.
pub(super) fn parameter(study: &Study, absorber: usize, key: &str) -> String {
    let several = study.optimise.as_ref().is_some_and(|o| o.absorbers.len() > 1);
    if several { format!("{key} of absorber {}", absorber + 1) } else { key.to_owned() }
}

/// What is changed, in words: "without condition cold".
pub(super) fn change(study: &Study, p: &Price) -> String {
    match p.change {
        Change::WithoutCondition(c) => format!("without condition {}", c.name()),
        Change::WithoutLimit(i) => format!("without limit {}", study.limits[i].words),
        Change::WithoutBound { absorber, key, bound, instead } => {
            format!("{} to {instead} instead of {bound}", parameter(study, absorber, key))
        }
        Change::HalfTheRing => "half the ring".to_owned(),
    }
}

/// By how many per cent the objective, as it is shown, is worse for what is asked, or for half the ring: larger, or smaller where it is a margin; `None` where limits are broken.
pub(super) fn costs(study: &Study, p: &Price) -> Option<f64> {
    let cost = p.cost()?;
    let unit = study.objective.unit;
    Some(100.0 * if unit.is_inverse() { 1.0 - unit.ratio(1.0 + cost) } else { unit.ratio(1.0 + cost) - 1.0 })
}
