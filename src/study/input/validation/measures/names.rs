//! What measures are called.

use crate::input::error::At;
use crate::input::measure::{LimitOfRule, MeasureSpec, UnitOf};
use crate::objective::{Measure, Over, Within};
use crate::response::Quantity;

/// A measure, what limits it, and in words what of the system it is of.
pub(super) struct Resolved<'r> {
    pub spec: MeasureSpec,
    /// The largest value as typed, or of a margin or a life the smallest; a band is a limit by itself.
    pub bound: Bound<'r>,
}

pub(super) enum Bound<'r> {
    Most(Option<&'r At<f64>>),
    Least(Option<&'r At<f64>>),
    Band,
    /// Of a rule, in words; at the rated speed, as it is reported.
    Rule {
        words: &'static str,
        limit: f64,
        rule: LimitOfRule,
    },
}

/// What a measure is called.
pub(super) struct Names {
    pub key: &'static str,
    /// In columns, behind what orders it is of.
    pub column: &'static str,
    /// In names of optima.
    pub word: &'static str,
    pub what: &'static str,
    pub place: String,
}

/// A measure with its names.
pub(super) fn spec(names: Names, (quantities, over, within): (Vec<Quantity>, Over, Within), unit: UnitOf) -> MeasureSpec {
    let Names { key, column, word, what, place } = names;
    let (prefix, head) = over.names();
    let of = if place.is_empty() { what.to_owned() } else { format!("{what} {place}") };
    let ranges: Vec<String> = within.ranges.iter().map(|(a, b)| format!("{a} to {b} rpm")).collect();
    let at = if ranges.is_empty() { String::new() } else { format!(", {}", ranges.join(" and ")) };
    MeasureSpec {
        measure: Measure { quantities, over, within },
        key,
        place: format!("{place}{at}"),
        column: format!("{head}{column}"),
        label: format!("{prefix}{of}{at}"),
        unit,
        is_twist: key == "peak_twist",
        word: format!("{}{word}", head.trim_start_matches("peak_")),
    }
}
