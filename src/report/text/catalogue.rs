//! Absorbers of catalogues, in words.

use super::limits::broken_within_tolerances;
use super::table::{significant, table};
use crate::analysis::Results;
use crate::input::Study;
use crate::objective::holds;

/// The best of each catalogue by the objective; empty where the study has none.
#[doc(hidden)]
pub fn catalogue(study: &Study, results: &Results) -> String {
    let mut text = String::new();
    let unit = study.objective.unit;
    for spec in &study.catalogues {
        let all: Vec<_> = results.catalogue.iter().filter(|r| r.file == spec.file).collect();
        let within = all.iter().filter(|r| r.objective.is_some() && holds(r.over_limit)).count();
        let limits = if study.limits.is_empty() { String::new() } else { format!(", {within} within all limits") };
        let row = |r: &&&crate::analysis::Ranked| {
            let value = r.objective.map_or("-".into(), |v| significant(unit.shown(v), 5));
            let held = match r.nearest_limit {
                _ if holds(r.over_limit) => "hold".to_owned(),
                Some(i) => format!("FAIL: {:.0} % of {}", 100.0 * r.over_limit, study.limits[i].of.key),
                None => "FAIL".to_owned(),
            };
            let mut row = vec![r.place.to_string(), r.design.clone(), value];
            row.extend((!study.limits.is_empty()).then_some(held));
            row
        };
        let rows: Vec<Vec<String>> = all.iter().filter(|r| r.shown).map(|r| row(&r)).collect();
        let value = format!("{}/{}", study.objective.key, unit.symbol());
        let header: Vec<&str> =
            ["place", "design", &value, "limits"].into_iter().take(if study.limits.is_empty() { 3 } else { 4 }).collect();
        let absorbers = if all.len() == 1 { "1 absorber".into() } else { format!("{} absorbers", all.len()) };
        let endless = all.iter().filter(|r| r.objective.is_none()).count();
        if rows.is_empty() {
            text.push_str(&format!("Catalogue {}: {absorbers}; each leaves a resonance that nothing damps.\n", spec.file));
            continue;
        }
        text.push_str(&format!("Catalogue {}: {absorbers}{limits}; the best:\n{}", spec.file, table(&header, &rows)));
        if endless > 0 {
            text.push_str(&format!("  {endless} of them leave a resonance that nothing damps.\n"));
        }
    }
    text
}

/// The best absorber of each catalogue, a line each.
pub(super) fn best_of_catalogues(study: &Study, results: &Results) -> String {
    let line = |file: &String| {
        let best = results.catalogue.iter().filter(|r| r.file == *file && r.objective.is_some()).min_by_key(|r| r.place)?;
        let (value, unit) = (significant(study.objective.unit.shown(best.objective?), 5), study.objective.unit.suffix());
        let held = if study.limits.is_empty() || holds(best.over_limit) { "" } else { ", which breaks a limit" };
        let design = results.designs.iter().find(|d| d.name == best.design);
        let built = design.and_then(|d| broken_within_tolerances(study, results, d)).filter(|_| held.is_empty());
        let built = built.map_or_else(String::new, |words| format!("; {words}"));
        Some(format!("Best of catalogue {file}: {} with {value}{unit}{held}{built}.\n", best.design))
    };
    study.catalogues.iter().filter_map(|spec| line(&spec.file)).collect()
}
