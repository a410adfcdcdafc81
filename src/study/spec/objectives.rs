//! Objective and limits.

use super::station;
use crate::chain::Chain;
use crate::design::{Limit, Measure, Over};
use crate::response::Quantity;
use crate::study::input_error::{At, Check};
use crate::study::raw::study::{RawConstraint, RawObjective, RawOver, RawStudy};
use crate::units::RAD_PER_DEG;

/// Unit a measure is reported in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnitOf {
    /// Degrees (rad inside).
    Angle,
    /// N m.
    Torque,
}

/// What is to be small.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ObjectiveSpec {
    /// The measure.
    pub measure: Measure,
    /// Its column in tables, unit included.
    pub column: &'static str,
    /// In words, for titles.
    pub label: String,
    /// Its unit.
    pub unit: UnitOf,
    /// Whether it is a twist.
    pub is_twist: bool,
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
pub fn default_twist(chain: &Chain, hub: usize) -> Quantity {
    let last = chain.len() - 1;
    Quantity::Twist { from: if hub == last { 0 } else { hub }, to: (last > 0).then_some(last) }
}

/// The objective; by default the synthesised twist from the hub to the last station.
pub fn objective(check: &mut Check, study: &RawStudy, chain: &Chain, hub: usize) -> ObjectiveSpec {
    let last = chain.len() - 1;
    let spec = |quantities: Vec<Quantity>, over: Over, kind: Kind| {
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
        let column = match (kind, over) {
            (Kind::Twist, Over::Synthesis) => "peak_twist_deg",
            (Kind::Twist, Over::Orders) => "peak_order_twist_deg",
            (Kind::Amplitude, Over::Synthesis) => "peak_hub_deg",
            (Kind::Amplitude, Over::Orders) => "peak_order_hub_deg",
            (Kind::Torque, Over::Synthesis) => "peak_torque_n_m",
            (Kind::Torque, Over::Orders) => "peak_order_torque_n_m",
        };
        ObjectiveSpec {
            measure: Measure { quantities, over },
            column,
            label: format!("{prefix} {of}"),
            unit: if kind == Kind::Torque { UnitOf::Torque } else { UnitOf::Angle },
            is_twist: kind == Kind::Twist,
        }
    };
    let default = || spec(vec![default_twist(chain, hub)], Over::Synthesis, Kind::Twist);
    if let Some(second) = study.objective.get(1) {
        check.wrong(second, "found a second [[objective]], expected one: the front is drawn over ring inertia by [pareto]");
    }
    let Some(raw) = study.objective.first() else { return default() };
    match raw.get_ref() {
        RawObjective::PeakTwist(t) => {
            twist(check, chain, &t.from, &t.to).map_or_else(default, |q| spec(vec![q], over(t.over), Kind::Twist))
        }
        RawObjective::HubAmplitude(a) => station(check, chain, &a.station)
            .map_or_else(default, |s| spec(vec![Quantity::Twist { from: s, to: None }], over(a.over), Kind::Amplitude)),
        RawObjective::VibratoryTorque(t) => {
            if last == 0 {
                check.wrong(raw, "found the vibratory torque of a chain without shafts, expected two stations or another objective");
                return default();
            }
            spec(torques(chain), over(t.over), Kind::Torque)
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
pub fn limits(check: &mut Check, study: &RawStudy, chain: &Chain) -> Vec<(String, Limit)> {
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
        };
        if let Some((words, quantities, raw_over, limit)) = limit {
            limits.push((words, Limit { measure: Measure { quantities, over: over(raw_over) }, limit }));
        }
    }
    limits
}
