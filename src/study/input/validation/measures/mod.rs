//! Measures of a study: objectives and limits.

mod context;
mod names;
mod of_absorbers;
mod of_chain;
mod of_construction;

pub(crate) use context::{Context, Judged, default_twist};

use crate::drivetrain::Chain;
use crate::input::error::{At, Check};
use crate::input::measure::{CombinedSpec, LimitSpec, MeasureSpec, UnitOf};
use crate::input::schema::measure::{RawInertia, RawLossFactor, RawMargin, RawMeasure, RawPower, RawRingTwist, RawTorque};
use crate::input::schema::measure_of_construction::{RawMass, RawVolume};
use crate::input::schema::study::RawStudy;
use crate::objective::condition::Burning;
use crate::objective::{Condition, Over, Property, Within};
use crate::response::Quantity;
use names::{Bound, Names, Resolved, spec};

/// A measure as typed; nothing where a mistake leaves none.
fn measure<'r>(check: &mut Check, raw: &'r At<RawMeasure>, of: Context) -> Option<Resolved<'r>> {
    let resolved = of_kind(check, raw, of)?;
    let measure = &resolved.spec.measure;
    if measure.over.asks_for_duty() {
        let what = if measure.over == Over::Damage { "a life" } else { "a mean" };
        if !of.has_duty {
            check.wrong(raw, format!("found {what} over the duty in a study without one, expected its points as `duty = [...]`"));
        }
        if of.unequal {
            let all = Condition::NAMED.iter().filter(|c| c.burning() != Burning::Alike).map(|c| format!("`{}`", c.name()));
            let all: Vec<String> = all.collect();
            let expected = "expected one or the other: the duty is of cylinders that all fire";
            check.wrong(raw, format!("found {what} over the duty beside a condition of {}, {expected}", all.join(", ")));
        }
        if measure.within != Within::default() {
            check.wrong(raw, "found speeds or a limit over speed beside `over = \"duty\"`, expected the points of the duty alone");
        }
    }
    Some(resolved)
}

/// The same, not yet held against the study's duty.
fn of_kind<'r>(check: &mut Check, raw: &'r At<RawMeasure>, of: Context) -> Option<Resolved<'r>> {
    match raw.get_ref() {
        RawMeasure::PeakTwist(m) => of_chain::peak_twist(check, m, of),
        RawMeasure::HubAmplitude(m) => of_chain::hub_amplitude(check, m, of),
        RawMeasure::Velocity(m) => of_chain::velocity(check, m, of),
        RawMeasure::Acceleration(m) => of_chain::acceleration(check, m, of),
        RawMeasure::VibratoryTorque(m) => of_chain::vibratory_torque(check, m, raw, of),
        RawMeasure::ShaftStress(m) => of_chain::shaft_stress(check, m, of),
        RawMeasure::RingTwist(m) => of_absorbers::ring_twist(check, m, of),
        RawMeasure::ElementStrain(m) => of_absorbers::element_strain(check, m, of),
        RawMeasure::Strain(m) => of_construction::strain(check, m, of),
        RawMeasure::Mass(m) => of_construction::mass(check, m, raw, of),
        RawMeasure::Volume(m) => of_construction::volume(check, m, raw, of),
        RawMeasure::Cost(m) => of_construction::cost(check, m, raw, of),
        RawMeasure::Envelope(_) => {
            check.wrong(raw, "found an envelope in an objective, expected it in a [[constraint]]");
            None
        }
        RawMeasure::SpringStress(m) => of_absorbers::spring_stress(check, m, of),
        RawMeasure::Life(m) => of_absorbers::life(check, m, of),
        RawMeasure::DissipatedPower(m) => of_absorbers::dissipated_power(check, m, of),
        RawMeasure::PowerPerArea(m) => of_absorbers::power_per_area(check, m, of),
        RawMeasure::Temperature(m) => of_absorbers::temperature(check, m, of),
        RawMeasure::LossFactor(m) => of_absorbers::loss_factor(check, m, of),
        RawMeasure::RingInertia(m) => of_absorbers::ring_inertia(check, m, of),
        RawMeasure::TotalInertia(m) => of_absorbers::total_inertia(check, m, of),
        RawMeasure::NaturalFrequency(m) => of_chain::natural_frequency(check, m, of),
        RawMeasure::Margin(m) => of_chain::margin(check, m, raw, of),
    }
}

/// The twist that is reported where a study names none.
fn reported_twist(of: Context) -> MeasureSpec {
    twist_spec(of.chain, of.hub)
}

/// The twist from a hub through a chain.
pub(super) fn twist_spec(chain: &Chain, hub: usize) -> MeasureSpec {
    let quantity = default_twist(chain, hub);
    let name = |i: usize| chain.stations[i].name.as_str();
    let place = match quantity {
        Quantity::Twist { from, to } => format!("{} to {}", name(from), to.map_or("ground", name)),
        Quantity::ShaftTorque(_) | Quantity::RingTwist(_) | Quantity::Motion(..) => String::new(),
    };
    let names = Names { key: "peak_twist", column: "twist_deg", word: "twist", what: "twist", place };
    spec(names, (vec![quantity], Over::Synthesis, Within::default()), UnitOf::Angle)
}

/// Words that need no more keys, for `of`.
const BY_WORD: [&str; 10] = [
    "peak_twist",
    "vibratory_torque",
    "ring_twist",
    "dissipated_power",
    "loss_factor",
    "ring_inertia",
    "total_inertia",
    "margin",
    "mass",
    "volume",
];

/// A measure by its word: that of the study's objectives or limits, or of all shafts, rings or locations.
fn by_word(check: &mut Check, word: &At<String>, known: &[&MeasureSpec], of: Context) -> Option<MeasureSpec> {
    if let Some(known) = known.iter().find(|k| k.word == *word.get_ref()).or_else(|| known.iter().find(|k| k.key == word.get_ref())) {
        // a factor belongs to the limit, not to the measure
        let mut spec = (*known).clone();
        spec.measure.within.factors.clear();
        return Some(spec);
    }
    match word.get_ref().as_str() {
        "peak_twist" => Some(reported_twist(of)),
        "vibratory_torque" => of_chain::vibratory_torque(check, &RawTorque::default(), word, of).map(|r| r.spec),
        "ring_twist" => of_absorbers::ring_twist(check, &RawRingTwist::default(), of).map(|r| r.spec),
        "dissipated_power" => of_absorbers::dissipated_power(check, &RawPower::default(), of).map(|r| r.spec),
        "loss_factor" => of_absorbers::loss_factor(check, &RawLossFactor::default(), of).map(|r| r.spec),
        "ring_inertia" => of_absorbers::ring_inertia(check, &RawInertia::default(), of).map(|r| r.spec),
        "total_inertia" => of_absorbers::total_inertia(check, &RawInertia::default(), of).map(|r| r.spec),
        "mass" => of_construction::mass(check, &RawMass::default(), word, of).map(|r| r.spec),
        "volume" => of_construction::volume(check, &RawVolume::default(), word, of).map(|r| r.spec),
        "margin" => of_chain::margin(check, &RawMargin::default(), word, of).map(|r| r.spec),
        other => {
            let expected = format!("expected one of {}, or the word of an objective or limit of the study", BY_WORD.join(", "));
            check.wrong(word, format!("found `{other}`, {expected}"));
            None
        }
    }
}

/// The measures of a front: two, or three for a front of each pair.
pub(super) fn of_front(
    check: &mut Check,
    words: &At<Vec<At<String>>>,
    known: (&[MeasureSpec], &[LimitSpec]),
    of: Context,
) -> Option<Vec<MeasureSpec>> {
    let list = different(check, words, known, of)?;
    if !(2..=3).contains(&list.len()) {
        check.wrong(words, format!("found {} measures, expected two, or three for a front of each pair", list.len()));
        return None;
    }
    Some(list)
}

/// Different measures by their words.
fn different(
    check: &mut Check,
    words: &At<Vec<At<String>>>,
    (objectives, limits): (&[MeasureSpec], &[LimitSpec]),
    of: Context,
) -> Option<Vec<MeasureSpec>> {
    let known: Vec<&MeasureSpec> = objectives.iter().chain(limits.iter().map(|l| &l.of)).collect();
    let mut list: Vec<MeasureSpec> = Vec::new();
    for word in words.get_ref() {
        let spec = by_word(check, word, &known, of)?;
        if matches!(spec.measure.over, Over::Property(Property::Band { .. })) {
            check.wrong(word, "found a band of natural frequencies, expected a measure that grows or falls");
        }
        if list.iter().any(|s| s.column == spec.column) {
            check.wrong(word, format!("found `{}` twice, expected different measures", word.get_ref()));
        }
        list.push(spec);
    }
    Some(list)
}

/// As many positive numbers as there are measures.
fn one_each(check: &mut Check, what: &str, numbers: &At<Vec<At<f64>>>, count: usize) -> Vec<f64> {
    let list: Vec<f64> = numbers.get_ref().iter().map(|n| check.positive(n)).collect();
    if list.len() != count {
        check.wrong(numbers, format!("found {} of the {what} for {count} measures, expected one each", list.len()));
    }
    list
}

/// Several measures as one objective: the largest in units of their targets, or their sum with weights.
pub(super) fn combined(check: &mut Check, study: &RawStudy, known: (&[MeasureSpec], &[LimitSpec]), of: Context) -> Option<CombinedSpec> {
    let raw = study.optimise.as_ref()?.combined.as_ref()?.get_ref();
    let list = different(check, &raw.of, known, of)?;
    if list.len() < 2 {
        check.wrong(&raw.of, "found fewer than two measures, expected at least two to be combined");
        return None;
    }
    let targets = one_each(check, "targets", &raw.targets, list.len());
    let weights = raw.weights.as_ref().map_or_else(Vec::new, |w| one_each(check, "weights", w, list.len()));
    let part = |(spec, target): (MeasureSpec, f64)| LimitSpec {
        words: format!("{} of {target}{}", shown(&spec), spec.unit.suffix()),
        limit: spec.unit.inside(target),
        rule: None,
        of: spec,
    };
    let first = list[0].clone();
    let parts: Vec<LimitSpec> = list.into_iter().zip(targets).map(part).collect();
    let words: Vec<&str> = parts.iter().map(|p| p.words.as_str()).collect();
    let how = if weights.is_empty() { "largest" } else { "weighted sum" };
    let spec = MeasureSpec {
        key: "combined",
        place: words.join("; "),
        column: "combined".into(),
        label: format!("{how} in units of targets ({})", words.join("; ")),
        unit: UnitOf::Ratio,
        is_twist: false,
        word: "combined".into(),
        ..first
    };
    Some(CombinedSpec { parts, weights, spec })
}

/// Objectives, the first one first; by default the synthesised twist from the hub to the last station.
pub(super) fn objectives(check: &mut Check, study: &RawStudy, of: Context) -> Vec<MeasureSpec> {
    let mut list: Vec<MeasureSpec> = Vec::new();
    for raw in &study.objective {
        let Some(Resolved { spec, bound }) = measure(check, raw, of) else { continue };
        let by_rule = matches!(bound, Bound::Rule { .. });
        match bound {
            Bound::Most(Some(at)) | Bound::Least(Some(at)) => {
                check.wrong(at, "found a limit in an objective, expected it in a [[constraint]]")
            }
            Bound::Rule { .. } => check.wrong(raw, "found a rule in an objective, expected it in a [[constraint]]"),
            Bound::Band => check.wrong(raw, "found a band of natural frequencies as an objective, expected it in a [[constraint]]"),
            Bound::Most(None) | Bound::Least(None) => {}
        }
        if !spec.measure.within.factors.is_empty() && !by_rule {
            check.wrong(raw, "found `factor_by_speed` in an objective, expected it in a [[constraint]]");
        }
        if list.iter().any(|o| o.word == spec.word) {
            check.wrong(raw, format!("found a second objective of the kind `{}`, expected different kinds", spec.word));
        }
        list.push(spec);
    }
    if list.is_empty() {
        list.push(reported_twist(of));
    }
    list
}

/// A measure in the words of its limit.
fn shown(spec: &MeasureSpec) -> String {
    spec.label.trim_start_matches("peak ").trim_start_matches("smallest ").to_owned()
}

/// Limits.
pub(super) fn limits(check: &mut Check, study: &RawStudy, of: Context) -> Vec<LimitSpec> {
    let mut limits = Vec::new();
    let mut resolved = Vec::new();
    for raw in &study.constraint {
        match raw.get_ref() {
            RawMeasure::Envelope(e) => resolved.extend(of_construction::envelope(check, e, of).into_iter().map(|r| (raw, r))),
            _ => resolved.extend(measure(check, raw, of).map(|r| (raw, r))),
        }
    }
    for (raw, Resolved { spec, bound }) in resolved {
        let (limit, words) = match bound {
            Bound::Most(None) => {
                let help = format!("`hartog keys constraint.{}.` lists its keys", spec.key);
                check.wrong_with_help(
                    raw,
                    format!("found a [[constraint]] of `{}` without a limit, expected its `max_…` key", spec.key),
                    help,
                );
                continue;
            }
            Bound::Least(None) => {
                let key = if spec.unit == UnitOf::Life { "min_h" } else { "min" };
                check.wrong(raw, format!("found a [[constraint]] of `{}` without a limit, expected its `{key}` key", spec.key));
                continue;
            }
            Bound::Most(Some(at)) => (spec.unit.inside(check.positive(at)), format!("at most {}{}", at.get_ref(), spec.unit.suffix())),
            Bound::Least(Some(at)) => (spec.unit.inside(check.positive(at)), format!("at least {}{}", at.get_ref(), spec.unit.suffix())),
            Bound::Band => (1.0, String::new()),
            Bound::Rule { words, limit, rule } => {
                let words = format!("{words}, {:.4}{} at the rated speed", limit, spec.unit.suffix());
                limits.push(LimitSpec {
                    words: format!("{} {words}", shown(&spec)),
                    limit: spec.unit.inside(limit),
                    of: spec,
                    rule: Some(rule),
                });
                continue;
            }
        };
        let label = shown(&spec);
        let factor = if spec.measure.within.factors.is_empty() { "" } else { ", times the factor of its speed" };
        let words = format!("{label} {words}{factor}").trim_end().to_owned();
        limits.push(LimitSpec { of: spec, words, limit, rule: None });
    }
    limits
}
