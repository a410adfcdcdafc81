//! What is changed of a study to tell what it costs, and the cost as it is shown.

use crate::analysis::{Change, Price};
use crate::input::Study;

/// What is changed, in words: "without condition cold".
pub(super) fn change(study: &Study, p: &Price) -> String {
    match p.change {
        Change::WithoutCondition(c) => format!("without condition {}", c.name()),
        Change::WithoutLimit(i) => format!("without limit {}", study.limits[i].words),
        Change::WithoutBound { key, bound, instead, .. } => {
            format!("{key} to {instead} instead of {bound}")
        }
        Change::HalfTheRing => "half the ring".to_owned(),
    }
}

/// Per cent of the objective, as it is shown, that what is asked costs, or half the ring; `None` where limits are broken.
pub(super) fn costs(study: &Study, p: &Price) -> Option<f64> {
    let cost = p.cost()?;
    Some(100.0 * (study.objective.unit.ratio(1.0 + cost) - 1.0))
}
