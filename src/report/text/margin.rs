//! Margins of the crank, in words.

use super::table::{dash, table};
use crate::analysis::{DesignResult, Results, SmallestMargin};
use crate::crankshaft::{FatigueSpec, MarginCriterion};
use crate::fatigue::multiaxial::Criterion as Multiaxial;
use crate::input::Study;
use std::fmt::Write;

/// A safety factor.
pub fn factor(n: f64) -> String {
    if n.is_finite() { format!("{n:.3}") } else { "infinite: no stress".into() }
}

/// Optima whose margins differ by less than this share are the same to a designer.
const SAME: f64 = 0.005;

/// So many criteria have their places beside them; more have a table of their own.
const ABREAST: usize = 3;
/// A constant below this leaves next to nothing of a mean stress.
const LITTLE: f64 = 0.05;

/// The smallest margin of every design by every criterion, and what the objectives mean for it; empty without `[fatigue]`.
pub fn margins(study: &Study, results: &Results) -> String {
    let (Some(model), Some(fatigue)) = (&results.margin, &study.fatigue) else { return String::new() };
    let all: Vec<&DesignResult> = results.designs.iter().chain(results.optima.iter().filter(|o| o.main).map(|o| &o.design)).collect();
    let found = |d: &DesignResult, c: usize| -> Option<SmallestMargin> { d.margins.iter().find(|m| m.criterion == c).copied() };
    let margin_of = |d: &DesignResult, c: usize| found(d, c).map_or_else(|| "infinite".into(), |m| factor(m.margin));
    let place = |m: &SmallestMargin| model.locations[m.used.location].name.clone();
    let with_names = |cells: &dyn Fn(&DesignResult, usize) -> Vec<String>| -> Vec<Vec<String>> {
        let all_cells = |d: &DesignResult| (0..fatigue.criteria.len()).flat_map(|c| cells(d, c)).collect::<Vec<String>>();
        all.iter().map(|d| std::iter::once(d.name.clone()).chain(all_cells(d)).collect()).collect()
    };
    let names = fatigue.criteria.iter().map(|c| c.name());
    let mut text = "Smallest margin of the crank over the speeds:\n".to_owned();
    if fatigue.criteria.len() <= ABREAST {
        let header: Vec<&str> = std::iter::once("design").chain(names.flat_map(|name| [name, "at/rpm", "fillet"])).collect();
        let rows = with_names(&|d, c| {
            let m = found(d, c);
            vec![margin_of(d, c), dash(m.map(|m| format!("{:.0}", m.speed_rpm))), dash(m.as_ref().map(place))]
        });
        text.push_str(&table(&header, &rows));
    } else {
        let header: Vec<&str> = std::iter::once("design").chain(names).collect();
        text.push_str(&table(&header, &with_names(&|d, c| vec![margin_of(d, c)])));
        text.push_str("At the fillet and speed (rpm):\n");
        let rows = with_names(&|d, c| vec![dash(found(d, c).map(|m| format!("{} @ {:.0}", place(&m), m.speed_rpm)))]);
        text.push_str(&table(&header, &rows));
    }
    if let Some(line) = super::crank_pressure(study) {
        let _ = writeln!(text, "  {line}");
    }
    if let Some(crank) = study.crank.as_ref().filter(|c| !c.assumed.is_empty()) {
        let _ = writeln!(text, "  Assumed dimensions of the crank: {}. Margins are as good as those.", crank.assumed.join(", "));
    }
    let below = below_acceptable(study, results);
    for c in fatigue.criteria.iter().filter(|c| c.acceptable().is_some()) {
        let told = below.iter().find(|line| line.starts_with(&format!("{} asks", c.name())));
        let least = c.acceptable().unwrap_or_default();
        match told {
            Some(line) => _ = writeln!(text, "  {line}"),
            None => _ = writeln!(text, "  {} asks for at least {least}: every design reaches it.", c.name()),
        }
    }
    text.push_str(&multiaxial(fatigue, &all));
    text.push_str(&differ(study, results));
    text
}

/// A line for each criterion with a least margin that designs do not reach.
pub(super) fn below_acceptable(study: &Study, results: &Results) -> Vec<String> {
    let all = || results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    let line = |(i, c): (usize, &MarginCriterion)| {
        let least = c.acceptable()?;
        let is_below = |d: &&DesignResult| d.margins.iter().any(|m| m.criterion == i && m.margin < least);
        let below: Vec<String> = all().filter(is_below).map(|d| format!("`{}`", d.name)).collect();
        (!below.is_empty()).then(|| format!("{} asks for at least {least}: not reached by {}.", c.name(), below.join(", ")))
    };
    study.fatigue.iter().flat_map(|f| f.criteria.iter().enumerate()).filter_map(line).collect()
}

/// One sentence a multiaxial criterion: how far it is from the first one over the designs, whether it prefers another, and how much mean stress counts in it.
fn multiaxial(fatigue: &FatigueSpec, all: &[&DesignResult]) -> String {
    let margin = |d: &DesignResult, c: usize| d.margins.iter().find(|m| m.criterion == c).map(|m| m.margin);
    let best = |c: usize| all.iter().max_by(|a, b| margin(a, c).unwrap_or(0.0).total_cmp(&margin(b, c).unwrap_or(0.0)));
    let first = fatigue.criteria[0].name();
    let mut text = String::new();
    for (c, criterion) in fatigue.criteria.iter().enumerate() {
        let (MarginCriterion::Multiaxial(word), Some(limits)) = (criterion, &fatigue.limits) else { continue };
        if text.is_empty() {
            text.push_str("  Multiaxial criteria follow bending and torque with their phase; criteria of amplitude and mean take both at their worst.\n");
        }
        let mut ratios: Vec<f64> = all.iter().filter_map(|d| Some(margin(d, c)? / margin(d, 0)?)).filter(|r| r.is_finite()).collect();
        ratios.sort_by(f64::total_cmp);
        let (Some(low), Some(high)) = (ratios.first(), ratios.last()) else { continue };
        let constant = word.weight(limits).ok().filter(|k| k.abs() < LITTLE);
        let constant = constant.filter(|_| [Multiaxial::CROSSLAND, Multiaxial::PAPADOPOULOS].contains(word));
        if c == 0 && constant.is_none() {
            continue;
        }
        let _ = write!(text, "  {}", criterion.name());
        if c > 0 {
            let _ = write!(text, ": {low:.2} to {high:.2} times {first}");
        }
        if let (Some(own), Some(of_first)) = (best(c), best(0).filter(|_| c > 0)) {
            let behind = margin(of_first, c).zip(margin(own, c)).map_or(0.0, |(a, b)| 1.0 - a / b);
            if behind < SAME {
                let _ = write!(text, "; {} is best by both, or as good as the best", of_first.name);
            } else {
                let _ = write!(text, "; best by it is {}, by {first} {} ({:.1} % behind)", own.name, of_first.name, 100.0 * behind);
            }
        }
        if let Some(k) = constant {
            let _ = write!(text, "; mean stress hardly counts in it, its constant being {:.3} for this torsion limit", k.abs());
        }
        text.push_str(".\n");
    }
    text
}

/// One sentence a type and further objective: whether its optimum differs from the first one.
fn differ(study: &Study, results: &Results) -> String {
    let mut text = String::new();
    for o in results.optima.iter().filter(|o| o.objective > 0) {
        let objective = study.objective_of(o.objective);
        let first = &o.family;
        let Some(twin) = results.optima.iter().find(|t| t.objective == 0 && t.family == *first) else { continue };
        let margin = |d: &DesignResult| {
            d.margins.iter().find(|m| format!("margin_{}", name(study, m.criterion)) == objective.word).map(|m| m.margin)
        };
        let (Some(by_margin), Some(by_first)) = (margin(&o.design), margin(&twin.design)) else { continue };
        let gain = by_margin / by_first - 1.0;
        let lost = o.design.objective.zip(twin.design.objective).map_or(0.0, |(a, b)| study.objective.unit.ratio(a / b) - 1.0);
        let verdict = if gain.abs() < SAME { "the two optima do not differ for the crank" } else { "the two optima differ" };
        let _ = writeln!(
            text,
            "  {} and {first}: {verdict}: margin {} against {} ({:+.1} %), {} {:+.1} %.",
            o.design.name,
            factor(by_margin),
            factor(by_first),
            100.0 * gain,
            study.objective.label,
            100.0 * lost
        );
    }
    text
}

fn name(study: &Study, criterion: usize) -> &'static str {
    study.fatigue.as_ref().map_or("", |f| f.criteria[criterion].name())
}
