//! Designs within tolerances, in words.

use super::proof::told;
use super::table::{significant, table};
use crate::absorber::{Deviation, Mounted};
use crate::analysis::{Results, RobustOfDesign, RowCase};
use crate::input::{MeasureSpec, RobustSpec, Study, UnitOf};
use crate::objective::{Condition, holds};
use crate::optimise::Scatter;

/// What is deviated, in words: "k +10 %, c -30 %"; of several absorbers each with its number.
pub(crate) fn deviation(design: &[Mounted], deviation: &Deviation) -> String {
    let mut words = Vec::new();
    for (i, (m, factors)) in design.iter().zip(&deviation.factors).enumerate() {
        let Some(declaration) = m.absorber.declaration() else { continue };
        for (p, factor) in declaration.parameters.iter().zip(factors).filter(|(_, f)| **f != 1.0) {
            let symbol = p.label.split('/').next().unwrap_or(p.label);
            let which = if design.len() > 1 { format!(" of {}", i + 1) } else { String::new() };
            let percent = format!("{:+.1}", 100.0 * (factor - 1.0));
            words.push(format!("{symbol}{which} {} %", percent.trim_end_matches(".0")));
        }
    }
    if words.is_empty() { "as drawn".into() } else { words.join(", ") }
}

/// The condition and deviation of a row, after a comma.
pub(super) fn during(design: &[Mounted], case: &RowCase) -> String {
    let condition = match (case.condition, case.cylinder) {
        (Condition::Firing, _) => String::new(),
        (condition, None) => format!(", {}", condition.name().replace('_', " ")),
        (condition, Some(cylinder)) => format!(", {} of cylinder {}", condition.name(), cylinder + 1),
    };
    let deviated = case.deviation.as_ref().map_or_else(String::new, |d| format!(", {}", deviation(design, d)));
    condition + &deviated
}

/// One of the tolerances by its key.
pub(crate) fn scattered(s: &Scatter) -> String {
    let share = |key: &str, share: f64| {
        let percent = format!("{:.2}", 100.0 * share);
        format!("{key} ±{} %", percent.trim_end_matches('0').trim_end_matches('.'))
    };
    match s {
        Scatter::Share(key, own) => share(key, *own),
        Scatter::Amount(key, amount) => format!("{key} ±{amount}"),
        Scatter::Hardness(amount) => format!("hardness ±{amount} Shore A"),
        Scatter::Viscosity(own) => share("viscosity", *own),
        Scatter::Temperature(kelvin) => format!("temperature ±{kelvin} K"),
    }
}

/// Tolerances by their keys.
#[doc(hidden)]
pub fn tolerances(spec: &RobustSpec) -> String {
    spec.scatter().iter().map(scattered).collect::<Vec<_>>().join(", ")
}

/// A row a design with nominal and worst value; empty where the study has no tolerances.
#[doc(hidden)]
pub fn robust(study: &Study, results: &Results) -> String {
    let Some(spec) = study.robust.as_ref().filter(|_| !results.robust.is_empty()) else { return String::new() };
    let of = &study.objective;
    let unit = match of.unit {
        UnitOf::Angle => "°",
        UnitOf::Margin => "",
        unit => unit.symbol(),
    };
    let column = |word: &str| if unit.is_empty() { word.to_owned() } else { format!("{word}/{unit}") };
    let mut header = vec!["design".to_owned(), column("nominal"), column("worst"), "rise/%".into(), "where it is worst".into()];
    if let Some(s) = spec.sampling {
        header.extend([column(&format!("{} % of designs", s.percentile)), column("from"), column("to")]);
    }
    let absorbers = |name: &str| {
        let all = results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
        all.into_iter().find(|d| d.name == name).map_or(&[][..], |d| &d.absorbers)
    };
    let mut rows = Vec::new();
    for d in &results.robust {
        let mut row = vec![d.design.clone(), shown(of, d.worst.nominal), shown(of, d.worst.value)];
        row.push(format!("{:.1}", 100.0 * (of.unit.ratio(d.worst.value / d.worst.nominal) - 1.0)));
        row.push(deviation(absorbers(&d.design), &d.worst.deviation));
        row.extend(d.percentile.iter().flat_map(|p| [p.value, p.between.0, p.between.1]).map(|v| shown(of, v)));
        rows.push(row);
    }
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let mut text = format!("Within tolerances ({}), {}:\n{}", tolerances(spec), of.label, table(&header, &rows));
    if let Some(s) = spec.sampling {
        let how = if s.normal { "normal, the tolerance being three standard deviations" } else { "uniform" };
        text.push_str(&format!("  {} random designs, {how}; from and to: 95 % confidence interval of the percentile\n", s.samples));
    }
    if let Some(effort) = spec.prove.filter(|effort| effort.boxes > 0) {
        text.push_str(&proved(of, results, effort.gap));
    }
    if results.conditions().any(|c| c == Condition::InOperation) {
        text.push_str(
            "  tolerances are about the reference of each material: the temperature and strain of operation are judged without them\n",
        );
    }
    for d in &results.robust {
        for (limit, worst) in study.limits.iter().zip(&d.limits).filter(|(_, worst)| !holds(worst.value)) {
            let at = deviation(absorbers(&d.design), &worst.deviation);
            text.push_str(&format!(
                "  {}: limit {} is broken at {at} ({:.0} % of it)\n",
                d.design,
                limit.words,
                100.0 * limit.of.unit.ratio(worst.value)
            ));
        }
    }
    text
}

/// What is proved of worst cases, in lines.
fn proved(of: &MeasureSpec, results: &Results, gap: f64) -> String {
    let of_design = |d: &RobustOfDesign| match d.worst.bound {
        Some(b) => {
            let share = b.value / d.worst.value - 1.0;
            let how = if (0.0..=gap * 1.001).contains(&share) { "proved" } else { "proved to a part" };
            let side = if of.unit.is_inverse() { "below" } else { "above" };
            let bound = told(of, b.value, false);
            format!(
                "  {how}: no combination within them makes {} {side} {bound} (gap {}, {} boxes)\n",
                d.design,
                significant(share, 2),
                b.boxes
            )
        }
        None => format!("  not proved: what {} is at worst within them\n", d.design),
    };
    results.robust.iter().map(of_design).collect()
}

/// A value of the objective in its unit.
fn shown(of: &MeasureSpec, value: f64) -> String {
    if !value.is_finite() {
        return "unbounded".into();
    }
    match of.unit {
        UnitOf::Margin => significant(1.0 / value, 4),
        unit => significant(unit.shown(value), 4),
    }
}
