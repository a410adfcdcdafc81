//! Safety factors and stresses of the crank: recomputed from the printed stresses. Which limit stands behind the factors, and which rows contradict
//! their own stresses, is found, not listed.

use super::{Entry, Kind, Role, Uncertainty};
use crate::fatigue::mean_stress::goodman_limit;
use crate::fatigue::{Criterion, Cycle, Strength};
use crate::input::published::PublishedFatigue;
use crate::input::{Published, Study};
use crate::units::PA_PER_MPA;

/// Printed with two digits: a factor further off than this contradicts its stresses.
const DIGITS: f64 = 0.006;
/// The same where a stress follows from a sum printed without decimals.
const REPAIRED: f64 = 0.01;
/// Stresses that add up to another sum than printed elsewhere by more than this share are misprinted.
const OTHER_SUM: f64 = 0.01;

/// What the factors follow from: tensile strength as printed, and the fatigue limit that the middle one of them needs, Pa.
pub fn strength(published: &Published) -> Option<Strength> {
    let tensile = number(published, "tensile_strength")? * PA_PER_MPA;
    let needed = |f: &PublishedFatigue| goodman_limit(f.cycle, tensile, f.safety_factor);
    let mut limits: Vec<f64> = published.fatigue.iter().filter_map(needed).collect();
    limits.sort_by(f64::total_cmp);
    let fatigue_limit = *limits.get(limits.len() / 2)?;
    Some(Strength { tensile, yielding: None, fatigue_limit })
}

fn number(published: &Published, name: &str) -> Option<f64> {
    published.quantities.iter().find(|q| q.name == name).and_then(|q| q.value.as_ref().ok().copied())
}

pub fn entries(study: &Study, published: &Published) -> Vec<Entry> {
    let Some(strength) = strength(published) else { return Vec::new() };
    let mut list = Vec::new();
    list.extend(number(published, "fatigue_limit").map(|stated| limit(stated, strength)));
    list.extend(published.fatigue.iter().map(|f| factor(study, published, f, strength)));
    list.extend(published.stresses.iter().map(|s| {
        let from = |f: &&PublishedFatigue| {
            f.torsion_case == s.model
                && f.condition == s.condition
                && f.fillet == "crankpin"
                && study.designs[f.design].absorbers.is_empty()
        };
        let row = published.fatigue.iter().find(from);
        let sum = row.map(|f| (f.cycle.amplitude + f.cycle.mean) / PA_PER_MPA);
        let off = sum.map(|sum| (sum * PA_PER_MPA / s.von_mises - 1.0).abs());
        let (role, note) = match (row, off) {
            (Some(f), Some(off)) if off > OTHER_SUM && !fits(Criterion::Goodman.safety_factor(f.cycle, strength), f) => {
                (Role::Recomputed, format!("amplitude and factor of table {} give it; the mean is misprinted there", f.table))
            }
            (Some(f), Some(off)) if off > OTHER_SUM => {
                (Role::Erratum, format!("amplitude and mean at the crankpin in table {} add up to another stress", f.table))
            }
            (Some(f), _) => (Role::Recomputed, format!("amplitude and mean at the crankpin in table {}, added up", f.table)),
            (None, _) => (Role::OtherModel, "finite elements in a flexible multibody model: for comparison".into()),
        };
        // where the mean is misprinted, the one that the printed factor needs stands in
        let needed = row.filter(|_| role == Role::Recomputed && off.is_some_and(|off| off > OTHER_SUM)).map(|f| {
            let mean = strength.tensile * (1.0 / f.safety_factor - f.cycle.amplitude / strength.fatigue_limit);
            (f.cycle.amplitude + mean) / PA_PER_MPA
        });
        Entry {
            table: s.table.clone(),
            design: String::new(),
            quantity: format!("largest von Mises stress, {}, {}", words(&s.model), s.condition.replace('_', " ")),
            kind: Kind::Other,
            unit: "MPa".into(),
            published: Some(s.von_mises / PA_PER_MPA),
            computed: needed.or(sum),
            uncertainty: Uncertainty::default(),
            role,
            note,
        }
    }));
    list
}

/// Whether a factor is the printed one, to its digits.
fn fits(n: f64, f: &PublishedFatigue) -> bool {
    fits_within(n, f, DIGITS)
}

fn fits_within(n: f64, f: &PublishedFatigue, digits: f64) -> bool {
    (n - f.safety_factor).abs() <= digits
}

fn words(model: &str) -> String {
    if model.len() == 1 { format!("case {model}") } else { model.replace('_', " ") }
}

/// The limit behind the factors beside the stated one.
fn limit(stated: f64, strength: Strength) -> Entry {
    let found = strength.fatigue_limit / PA_PER_MPA;
    let contradicts = (found / stated - 1.0).abs() > 0.002;
    let share = strength.fatigue_limit / strength.tensile;
    Entry {
        table: "text".into(),
        design: String::new(),
        quantity: "fatigue limit behind the safety factors".into(),
        kind: Kind::Other,
        unit: "MPa".into(),
        published: Some(stated),
        computed: Some(found),
        uncertainty: Uncertainty::default(),
        role: if contradicts { Role::Erratum } else { Role::Recomputed },
        note: format!("the factors follow from {share:.3} of the tensile strength"),
    }
}

fn factor(study: &Study, published: &Published, f: &PublishedFatigue, strength: Strength) -> Entry {
    let own = Criterion::Goodman.safety_factor(f.cycle, strength);
    let swapped = Cycle { amplitude: f.cycle.mean, mean: f.cycle.amplitude };
    let fits = |n: f64| fits(n, f);
    let sum = f.cycle.amplitude + f.cycle.mean;
    let elsewhere = published.stresses.iter().find(|s| {
        s.model == f.torsion_case
            && s.condition == f.condition
            && study.designs[f.design].absorbers.is_empty()
            && (sum / s.von_mises - 1.0).abs() > OTHER_SUM
    });
    let gerber = Criterion::Gerber.safety_factor(f.cycle, strength);
    let (role, note) = if fits(own) {
        (
            Role::Recomputed,
            format!("Goodman's line from the printed stresses, with the limit behind all of them; Gerber's parabola gives {gerber:.2}"),
        )
    } else if fits(Criterion::Goodman.safety_factor(swapped, strength)) {
        (Role::Erratum, "amplitude and mean are swapped: the other way round they give the printed factor".into())
    } else if let Some(s) = elsewhere.filter(|_| f.fillet == "crankpin") {
        let (sum, printed) = (sum / PA_PER_MPA, s.von_mises / PA_PER_MPA);
        let mean = s.von_mises - f.cycle.amplitude;
        let repaired = Cycle { amplitude: f.cycle.amplitude, mean };
        let rest = if fits_within(Criterion::Goodman.safety_factor(repaired, strength), f, REPAIRED) {
            format!("; with the mean of {:.0} MPa that this leaves the printed factor follows", mean / PA_PER_MPA)
        } else {
            String::new()
        };
        (Role::Erratum, format!("stresses misprinted: they add up to {sum:.0} MPa, table {} prints {printed:.0}{rest}", s.table))
    } else if let Some(twin) =
        published.fatigue.iter().find(|t| (&t.table, &t.condition) == (&f.table, &f.condition) && t.fillet != f.fillet)
    {
        let ratio = |a: f64, b: f64| a / b;
        let (amplitudes, means) = (ratio(twin.cycle.amplitude, f.cycle.amplitude), ratio(twin.cycle.mean, f.cycle.mean));
        if (amplitudes / means - 1.0).abs() < OTHER_SUM {
            (Role::Erratum, "factor misprinted: the stresses are in the ratio of those at the other fillet".into())
        } else {
            (
                Role::Erratum,
                format!("stresses misprinted: amplitude and mean are {amplitudes:.2} and {means:.2} times below those at the other fillet"),
            )
        }
    } else {
        (Role::Erratum, "contradicts its own stresses".into())
    };
    Entry {
        table: f.table.clone(),
        design: study.designs[f.design].name.clone(),
        quantity: format!("safety factor, case {}, {}, {}", f.torsion_case, f.condition.replace('_', " "), f.fillet),
        kind: Kind::SafetyFactor,
        unit: "-".into(),
        published: Some(f.safety_factor),
        computed: Some(own),
        uncertainty: Uncertainty::default(),
        role,
        note,
    }
}
