//! `pareto.csv`: the fronts.

use super::table::{Table, in_unit, in_unit_of, number, optional};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::input::Study;
use crate::objective::HELD;

/// `pareto.csv`.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn pareto(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.fronts.is_empty() {
        return Ok(());
    }
    let mut header = vec![
        "absorber",
        "ring_inertia_kg_m2",
        "stiffness_n_m_per_rad",
        "damping_n_m_s_per_rad",
        &study.objective.column,
        "kkt_residual",
        "limits_hold",
        "dominated",
    ];
    // of types that have more than a spring and a damper
    let mut others: Vec<&str> = Vec::new();
    for key in results.fronts.iter().flat_map(|f| f.declaration.parameters).map(|p| p.key) {
        if !header.contains(&key) && !others.contains(&key) {
            others.push(key);
        }
    }
    header.extend(&others);
    header.extend(study.more_objectives.iter().map(|o| o.column.as_str()));
    let bound_column = format!("lower_bound_of_{}", study.objective.column);
    let is_proved = study.optimise.as_ref().is_some_and(|o| o.prove.all);
    if is_proved {
        header.extend(["proof", &bound_column]);
    }
    let mut table = Table::new(&header);
    for front in &results.fronts {
        for (point, values) in front.front.points.iter().zip(&front.others) {
            let a = &point.design[0].absorber;
            let mut row = vec![
                front.declaration.name.to_owned(),
                number(a.ring_inertia()),
                optional(a.stiffness()),
                optional(a.damping()),
                number(in_unit(study, point.value)),
                optional(Some(point.kkt_residual).filter(|r| r.is_finite())),
                (point.excess <= HELD).to_string(),
                point.dominated.to_string(),
            ];
            row.extend(others.iter().map(|key| optional(a.value(key))));
            row.extend(study.more_objectives.iter().zip(values).map(|(o, v)| number(in_unit_of(o, *v))));
            if is_proved {
                let proof = point.proof.as_ref();
                row.push(proof.map_or_else(String::new, |p| p.verdict.word().to_owned()));
                row.push(optional(proof.and_then(|p| p.lower_bound).map(|b| in_unit(study, b))));
            }
            table.row(row);
        }
    }
    table.save(folder, "pareto.csv")
}
