//! Margins of the crank, in words.

use super::{dash, table};
use crate::assess::{DesignResult, Results, SmallestMargin};
use crate::study::Study;
use std::fmt::Write;

/// A safety factor.
pub fn factor(n: f64) -> String {
    if n.is_finite() { format!("{n:.3}") } else { "infinite: no stress".into() }
}

/// Optima whose margins differ by less than this share are the same to a designer.
const SAME: f64 = 0.005;

/// The smallest margin of every design by every criterion, and what the objectives mean for it; empty without `[fatigue]`.
pub fn margins(study: &Study, results: &Results) -> String {
    let (Some(model), Some(fatigue)) = (&results.margin, &study.fatigue) else { return String::new() };
    let all: Vec<&DesignResult> = results.designs.iter().chain(results.optima.iter().filter(|o| o.main).map(|o| &o.design)).collect();
    let mut header = vec!["design".to_owned()];
    for c in &fatigue.criteria {
        header.extend([c.name().to_owned(), "at/rpm".into(), "fillet".into()]);
    }
    let cells = |d: &DesignResult, c: usize| -> Vec<String> {
        let m: Option<&SmallestMargin> = d.margins.iter().find(|m| m.criterion == c);
        vec![
            m.map_or_else(|| "infinite".into(), |m| factor(m.margin)),
            dash(m.map(|m| format!("{:.0}", m.speed_rpm))),
            dash(m.map(|m| model.spots[m.used.spot].name.clone())),
        ]
    };
    let row = |d: &&DesignResult| -> Vec<String> {
        std::iter::once(d.name.clone()).chain((0..fatigue.criteria.len()).flat_map(|c| cells(d, c))).collect()
    };
    let rows: Vec<Vec<String>> = all.iter().map(row).collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let mut text = format!("Smallest margin of the crank over the speeds:\n{}", table(&header, &rows));
    if let Some(crank) = study.crank.as_ref().filter(|c| !c.assumed.is_empty()) {
        let _ = writeln!(text, "  Assumed dimensions of the crank: {}. Margins are as good as those.", crank.assumed.join(", "));
    }
    for (i, c) in fatigue.criteria.iter().enumerate() {
        let Some(least) = c.acceptable() else { continue };
        let below: Vec<&str> =
            all.iter().filter(|d| d.margins.iter().any(|m| m.criterion == i && m.margin < least)).map(|d| d.name.as_str()).collect();
        let words = if below.is_empty() { "every design reaches it".to_owned() } else { format!("not reached by {}", below.join(", ")) };
        let _ = writeln!(text, "  {} asks for at least {least}: {words}.", c.name());
    }
    text.push_str(&differ(study, results));
    text
}

/// One sentence a type and further objective: whether its optimum differs from the first one.
fn differ(study: &Study, results: &Results) -> String {
    let mut text = String::new();
    for o in results.optima.iter().filter(|o| o.objective > 0) {
        let objective = study.objective_of(o.objective);
        let Some((first, _)) = o.design.name.split_once("_by_") else { continue };
        let Some(twin) = results.optima.iter().find(|t| t.design.name == first) else { continue };
        let margin = |d: &DesignResult| {
            d.margins.iter().find(|m| format!("margin_{}", name(study, m.criterion)) == objective.word).map(|m| m.margin)
        };
        let (Some(by_margin), Some(by_first)) = (margin(&o.design), margin(&twin.design)) else { continue };
        let gain = by_margin / by_first - 1.0;
        let lost = o.design.objective.zip(twin.design.objective).map_or(0.0, |(a, b)| a / b - 1.0);
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
