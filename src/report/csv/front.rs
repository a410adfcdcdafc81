//! `front.csv`: fronts of pairs of measures.

use super::table::{Table, optional};
use crate::analysis::{Results, TradeoffResult};
use crate::files::{Folder, WriteError};
use crate::input::{FrontSpec, MeasureSpec, Study};
use crate::optimise::TradeoffPoint;

/// Of every absorber.
const KEYS: [&str; 3] = ["ring_inertia_kg_m2", "stiffness_n_m_per_rad", "damping_n_m_s_per_rad"];

/// `front.csv`: a row a point: the pair of measures it is a front of, the family, every measure of the front, whether another point is no worse in both of the pair, whether it is the
/// knee, and the absorbers.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn front(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.tradeoffs.is_empty() {
        return Ok(());
    }
    let Some(FrontSpec::Of { measures, .. }) = &study.front else { return Ok(()) };
    let points = || results.tradeoffs.iter().flat_map(|t| &t.families).flat_map(|f| &f.1.points);
    let most = points().map(|p| p.design.len()).max().unwrap_or(0);
    // of types that have more than a spring and a damper
    let mut others: Vec<&str> = Vec::new();
    let declared = points().flat_map(|p| &p.design).filter_map(|m| m.absorber.declaration());
    for key in declared.flat_map(|d| d.parameters).map(|p| p.key) {
        if !KEYS.contains(&key) && !others.contains(&key) {
            others.push(key);
        }
    }
    let mut header: Vec<String> = ["front", "absorbers", "point"].map(str::to_owned).to_vec();
    header.extend(measures.iter().map(|m| m.column.clone()));
    header.extend(["dominated", "knee", "kkt_residual"].map(str::to_owned));
    for i in 1..=most {
        header.extend(KEYS.iter().chain(&others).map(|k| format!("{k}_{i}")));
    }
    let mut table = Table::new(&header.iter().map(String::as_str).collect::<Vec<_>>());
    for t in &results.tradeoffs {
        for ((family, front), third) in t.families.iter().zip(&t.third) {
            for (i, point) in front.points.iter().enumerate() {
                let mut row = vec![of(t, measures), family.clone(), (i + 1).to_string()];
                row.extend(values(t, measures, point, third.get(i).copied()));
                row.extend([point.dominated.to_string(), point.knee.to_string()]);
                row.push(optional(Some(point.kkt_residual).filter(|r| r.is_finite())));
                for k in 0..most {
                    let absorber = point.design.get(k).map(|m| &m.absorber);
                    row.push(optional(absorber.map(|a| a.ring_inertia())));
                    row.push(optional(absorber.and_then(|a| a.stiffness())));
                    row.push(optional(absorber.and_then(|a| a.damping())));
                    row.extend(others.iter().map(|key| optional(absorber.and_then(|a| a.value(key)))));
                }
                table.row(row);
            }
        }
    }
    table.save(folder, "front.csv")
}

/// The pair a front is of.
fn of(t: &TradeoffResult, measures: &[MeasureSpec]) -> String {
    format!("{} against {}", measures[t.of[0]].word, measures[t.of[1]].word)
}

/// Every measure at a point, in the unit of its column.
fn values(t: &TradeoffResult, measures: &[MeasureSpec], point: &TradeoffPoint, third: Option<f64>) -> Vec<String> {
    let value_of = |m: usize| match t.of.iter().position(|of| *of == m) {
        Some(k) => Some(point.values[k]),
        None => third,
    };
    let shown = |(m, spec): (usize, &MeasureSpec)| value_of(m).map(|v| spec.unit.shown(v)).filter(|v| v.is_finite());
    measures.iter().enumerate().map(shown).map(optional).collect()
}
