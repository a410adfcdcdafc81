//! Objective and limits.

use super::named::station;
use crate::crankshaft::FatigueSpec;
use crate::drivetrain::Chain;
use crate::input::error::{At, Check};
use crate::input::schema::fatigue::RawCriterion;
use crate::input::schema::study::{RawConstraint, RawMargin, RawObjective, RawOver, RawStudy};
use crate::objective::{Limit, Measure, Over};
use crate::response::Quantity;
use crate::units::RAD_PER_DEG;

/// Unit a measure is reported in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnitOf {
    /// Degrees (rad inside).
    Angle,
    /// N m.
    Torque,
    /// None: a safety factor, of which the inverse is minimised.
    Margin,
}

/// An objective.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ObjectiveSpec {
    /// The measure.
    pub measure: Measure,
    /// Its column in tables, unit included.
    pub column: String,
    /// In words, for titles.
    pub label: String,
    /// Its unit.
    pub unit: UnitOf,
    /// Whether it is a twist.
    pub is_twist: bool,
    /// A word for names of optima.
    pub word: String,
}

fn over(raw: RawOver) -> Over {
    match raw {
        RawOver::Synthesis => Over::Synthesis,
        RawOver::Orders => Over::Orders,
    }
}

fn twist(check: &mut Check, chain: &Chain, from: &At<String>, to: &At<String>) -> Option<Quantity> {
    let a = station(check, chain, from);
    let b = if to.get_ref() == "ground" { Some(None) } else { station(check, chain, to).map(Some) };
    let (a, b) = (a?, b?);
    if b == Some(a) {
        check.wrong(to, format!("found a twist from `{0}` to `{0}`, expected two different stations", to.get_ref()));
    }
    Some(Quantity::Twist { from: a, to: b })
}

fn torques(chain: &Chain) -> Vec<Quantity> {
    (0..chain.len() - 1).map(Quantity::ShaftTorque).collect()
}

/// The twist reported where a study names none: from the hub to the last station, or over the whole chain where the hub is the last; to
/// the ground where there is one station only.
pub(crate) fn default_twist(chain: &Chain, hub: usize) -> Quantity {
    let last = chain.len() - 1;
    Quantity::Twist { from: if hub == last { 0 } else { hub }, to: (last > 0).then_some(last) }
}

/// What a study says of fatigue.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Judged<'a> {
    /// Nothing.
    Not,
    /// With mistakes.
    Wrongly,
    /// This.
    By(&'a FatigueSpec),
}

/// The criterion of a margin: the one named, or the first of the study.
fn criterion<'f, T>(
    check: &mut Check,
    named: Option<&At<RawCriterion>>,
    at: &At<T>,
    fatigue: Judged<'f>,
) -> Option<(usize, &'f FatigueSpec)> {
    let fatigue = match fatigue {
        Judged::By(fatigue) => fatigue,
        // its own mistakes have been reported
        Judged::Wrongly => return None,
        Judged::Not => {
            check.wrong(at, "found a margin in a study without [fatigue], expected material and criteria there");
            return None;
        }
    };
    let Some(named) = named else { return Some((0, fatigue)) };
    let wanted = named.get_ref().0;
    let found = fatigue.criteria.iter().position(|c| *c == wanted);
    if found.is_none() {
        check.wrong(named, format!("found criterion `{}`, expected one of those in [fatigue]", wanted.name()));
    }
    found.map(|index| (index, fatigue))
}

/// Shafts whose torque the crank carries.
fn crank_torques(chain: &Chain) -> Vec<Quantity> {
    let throws = chain.stations.iter().map(|s| s.throws.len()).sum();
    crate::crankshaft::shafts(chain, throws).into_iter().map(Quantity::ShaftTorque).collect()
}

/// Objectives, the first one first; by default the synthesised twist from the hub to the last station.
pub fn objectives(check: &mut Check, study: &RawStudy, chain: &Chain, hub: usize, fatigue: Judged) -> Vec<ObjectiveSpec> {
    let mut list: Vec<ObjectiveSpec> = Vec::new();
    for raw in &study.objective {
        let Some(spec) = objective(check, raw, chain, fatigue) else { continue };
        if list.iter().any(|o| o.word == spec.word) {
            check.wrong(raw, format!("found a second objective of the kind `{}`, expected different kinds", spec.word));
        }
        list.push(spec);
    }
    if list.is_empty() {
        list.push(spec(chain, vec![default_twist(chain, hub)], Over::Synthesis, Kind::Twist));
    }
    list
}

fn spec(chain: &Chain, quantities: Vec<Quantity>, over: Over, kind: Kind) -> ObjectiveSpec {
    let of = match (kind, quantities.first()) {
        (_, Some(Quantity::Twist { from, to })) => {
            let name = |i: usize| chain.stations[i].name.as_str();
            match (kind, to) {
                (Kind::Amplitude, _) => format!("amplitude of {}", name(*from)),
                (_, to) => format!("twist {} to {}", name(*from), to.map_or("ground", name)),
            }
        }
        _ => "vibratory torque of the shafts".into(),
    };
    let prefix = if over == Over::Synthesis { "peak" } else { "largest order of" };
    let (column, word) = match (kind, over) {
        (Kind::Twist, Over::Orders) => ("peak_order_twist_deg", "order_twist"),
        (Kind::Twist, _) => ("peak_twist_deg", "twist"),
        (Kind::Amplitude, Over::Orders) => ("peak_order_hub_deg", "order_hub"),
        (Kind::Amplitude, _) => ("peak_hub_deg", "hub"),
        (Kind::Torque, Over::Orders) => ("peak_order_torque_n_m", "order_torque"),
        (Kind::Torque, _) => ("peak_torque_n_m", "torque"),
    };
    ObjectiveSpec {
        measure: Measure { quantities, over },
        column: column.into(),
        label: format!("{prefix} {of}"),
        unit: if kind == Kind::Torque { UnitOf::Torque } else { UnitOf::Angle },
        is_twist: kind == Kind::Twist,
        word: word.into(),
    }
}

fn margin_spec(chain: &Chain, index: usize, fatigue: &FatigueSpec) -> ObjectiveSpec {
    let column = fatigue.criteria[index].column();
    ObjectiveSpec {
        measure: Measure { quantities: crank_torques(chain), over: Over::Margin(index) },
        column: column.clone(),
        label: format!("smallest margin by {}", fatigue.criteria[index].name()),
        unit: UnitOf::Margin,
        is_twist: false,
        word: column,
    }
}

/// One objective; nothing where a mistake leaves none.
fn objective(check: &mut Check, raw: &At<RawObjective>, chain: &Chain, fatigue: Judged) -> Option<ObjectiveSpec> {
    match raw.get_ref() {
        RawObjective::PeakTwist(t) => {
            let quantity = twist(check, chain, &t.from, &t.to)?;
            Some(spec(chain, vec![quantity], over(t.over), Kind::Twist))
        }
        RawObjective::HubAmplitude(a) => {
            let from = station(check, chain, &a.station)?;
            Some(spec(chain, vec![Quantity::Twist { from, to: None }], over(a.over), Kind::Amplitude))
        }
        RawObjective::VibratoryTorque(t) => {
            if chain.len() == 1 {
                check.wrong(raw, "found the vibratory torque of a chain without shafts, expected two stations or another objective");
                return None;
            }
            Some(spec(chain, torques(chain), over(t.over), Kind::Torque))
        }
        RawObjective::Margin(RawMargin { criterion: named }) => {
            let (index, fatigue) = criterion(check, named.as_ref(), raw, fatigue)?;
            Some(margin_spec(chain, index, fatigue))
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Twist,
    Amplitude,
    Torque,
}

/// Limits with their words.
pub fn limits(check: &mut Check, study: &RawStudy, chain: &Chain, fatigue: Judged) -> Vec<(String, Limit)> {
    let mut limits = Vec::new();
    for raw in &study.constraint {
        let limit = match raw {
            RawConstraint::PeakTwist(t) => {
                let limit = check.positive(&t.max_deg);
                twist(check, chain, &t.from, &t.to).map(|q| {
                    let words = format!("twist {} to {} at most {limit}°", t.from.get_ref(), t.to.get_ref());
                    (words, vec![q], t.over, limit * RAD_PER_DEG)
                })
            }
            RawConstraint::HubAmplitude(a) => {
                let limit = check.positive(&a.max_deg);
                station(check, chain, &a.station).map(|s| {
                    let words = format!("amplitude of {} at most {limit}°", a.station.get_ref());
                    (words, vec![Quantity::Twist { from: s, to: None }], a.over, limit * RAD_PER_DEG)
                })
            }
            RawConstraint::VibratoryTorque(t) => {
                let limit = check.positive(&t.max_n_m);
                Some((format!("vibratory torque at most {limit} N m"), torques(chain), t.over, limit))
            }
            RawConstraint::Margin(m) => {
                let least = check.positive(&m.min);
                if let Some((index, fatigue)) = criterion(check, m.criterion.as_ref(), &m.min, fatigue) {
                    let words = format!("margin by {} at least {least}", fatigue.criteria[index].name());
                    let measure = Measure { quantities: crank_torques(chain), over: Over::Margin(index) };
                    limits.push((words, Limit { measure, limit: 1.0 / least }));
                }
                None
            }
        };
        if let Some((words, quantities, raw_over, limit)) = limit {
            limits.push((words, Limit { measure: Measure { quantities, over: over(raw_over) }, limit }));
        }
    }
    limits
}
