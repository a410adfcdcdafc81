//! What `hartog check` says is to be computed: designs, objectives, what is optimised and compared.

use super::robust::tolerances;
use super::table::significant;
use crate::absorber::{Host, Mounted};
use crate::engine::Excitation;
use crate::input::{DesignSpec, FrontSpec, ResponseMethod, Size, Study};
use crate::units::PA_PER_MPA;
use std::fmt::Write;

fn host(study: &Study, on: Host) -> String {
    match on {
        Host::Station(station) => study.chain.stations[station].name.clone(),
        Host::Ring(inner) => format!("the ring of absorber {}", inner + 1),
    }
}

fn absorber(study: &Study, m: &Mounted) -> String {
    let values: Vec<String> = match m.absorber.law() {
        Some(law) => {
            law.declaration().parameters.iter().zip(law.values()).map(|(p, v)| format!("{} {}", p.key, significant(v, 5))).collect()
        }
        None => vec![format!("ring_inertia_kg_m2 {}", significant(m.absorber.ring_inertia(), 5))],
    };
    format!("{} on {}: {}", m.absorber.type_name(), host(study, m.on), values.join(", "))
}

/// What is to be computed; of designs and goals beyond `most` only what they are called.
pub(super) fn work(study: &Study, excitation: &Excitation, most: usize) -> String {
    let (low, high) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let method = match study.method {
        ResponseMethod::Direct => "direct".to_owned(),
        ResponseMethod::Receptance => "receptance".to_owned(),
        ResponseMethod::Auto => format!("receptance, searches within {} %", significant(100.0 * study.tolerance, 2)),
    };
    let peaks = if study.refine_peaks { "refined between speeds" } else { "taken on the grid" };
    let mut text = format!(
        "To be computed: {} orders up to {}, {} speeds from {low} to {high} rpm, {method}, peaks {peaks}\n",
        excitation.orders.len(),
        study.order_limit,
        study.speeds_rpm.len()
    );
    text.push_str(&designs(study, most));
    text.push_str(&goals(study, most));
    if let Some(p) = &study.published {
        let counts = [
            (p.frequencies.len(), "natural frequencies"),
            (p.modes.len(), "modes of the crank"),
            (p.absorbers.len(), "absorbers"),
            (p.amplitudes.iter().filter(|a| a.amplitude.is_some()).count(), "amplitudes"),
            (p.quantities.len(), "numbers of the text"),
            (p.fatigue.len() + p.multiaxial.len(), "rows of safety factors"),
            (p.stresses.len(), "rows of stresses"),
            (p.factors.len(), "rows of stress concentration"),
            (p.histories.len(), "rows of stress histories"),
        ];
        let _ = writeln!(text, "  compared with, for engine {}: {}", p.engine, super::counted(&counts));
    }
    if let Some(c) = &study.calibrate {
        let inputs: Vec<String> = c
            .inputs
            .iter()
            .map(|f| format!("{} from {} to {} (in file {})", f.input.key(), f.lower, f.upper, significant(f.start, 5)))
            .collect();
        let _ = writeln!(
            text,
            "  calibrated first, against {} amplitudes: {}; what is printed above is the file as it is",
            c.rows.len(),
            inputs.join(", ")
        );
    }
    text
}

/// The given designs, a line each; beyond so many only their names and types.
fn designs(study: &Study, most: usize) -> String {
    let mut text = String::new();
    if study.designs.len() > most {
        let kind = |m: &Mounted| format!("{} on {}", m.absorber.type_name(), host(study, m.on));
        let named = |d: &DesignSpec| match d.absorbers.iter().map(kind).collect::<Vec<_>>().join(", ") {
            none if none.is_empty() => d.name.clone(),
            kinds => format!("{} ({kinds})", d.name),
        };
        let names: Vec<String> = study.designs.iter().map(named).collect();
        return format!("  designs: {}\n", names.join("; "));
    }
    for d in &study.designs {
        let absorbers: Vec<String> = d.absorbers.iter().map(|m| absorber(study, m)).collect();
        let _ = writeln!(text, "  design {}: {}", d.name, if absorbers.is_empty() { "no absorber".into() } else { absorbers.join("; ") });
    }
    text
}

/// Objectives, conditions, limits, and what is to be optimised.
fn goals(study: &Study, most: usize) -> String {
    let mut text = String::new();
    let _ = writeln!(text, "  objective: {}", study.objective.label);
    let conditions: Vec<String> = study.conditions.iter().map(|c| c.name().replace('_', " ")).collect();
    if !conditions.is_empty() {
        let _ = writeln!(text, "  conditions: {}", conditions.join(", "));
    }
    for objective in &study.more_objectives {
        let _ = writeln!(text, "  and, for optima of their own: {}", objective.label);
    }
    if let Some(combined) = &study.combined {
        let _ = writeln!(text, "  and, for optima of their own: {}", combined.spec.label);
    }
    if let Some(spec) = &study.robust {
        let _ = writeln!(text, "  within tolerances: {}", tolerances(spec));
    }
    if let Some(f) = &study.fatigue {
        let names: Vec<&str> = f.criteria.iter().map(|c| c.name()).collect();
        let _ = writeln!(
            text,
            "  margin of the crank: {}; tensile strength {} MPa, fatigue limit {} MPa{}",
            names.join(", "),
            significant(f.strength.tensile / PA_PER_MPA, 4),
            significant(f.strength.fatigue_limit / PA_PER_MPA, 4),
            f.limits.map_or_else(String::new, |l| format!(", in torsion {} MPa", significant(l.torsion / PA_PER_MPA, 4)))
        );
    }
    for limit in study.limits.iter().take(most) {
        let _ = writeln!(text, "  limit: {}", limit.words);
    }
    if study.limits.len() > most {
        let more = study.limits.len() - most;
        let _ = writeln!(text, "  and {more} more limit{}", if more == 1 { "" } else { "s" });
    }
    if let Some(o) = &study.optimise {
        for a in &o.absorbers {
            let types: Vec<&str> = a.types.iter().map(|t| t.name).collect();
            let size = match &a.size {
                Size::Between(a, b) => format!("ring from {} to {} kg m²", significant(*a, 5), significant(*b, 5)),
                Size::Each(list) => format!("ring of {} kg m²", list.iter().map(|j| significant(*j, 5)).collect::<Vec<_>>().join(", ")),
            };
            let _ = writeln!(text, "  optimise: {} on {}, {size}", types.join(" and "), host(study, a.on));
        }
    }
    match &study.front {
        None => {}
        Some(FrontSpec::OverInertia(inertias)) => {
            let (first, last) = (significant(inertias[0], 5), significant(inertias[inertias.len() - 1], 5));
            let _ = writeln!(text, "  front: {} rings from {first} to {last} kg m²", inertias.len());
        }
        Some(FrontSpec::Of { points, measures }) => {
            let labels: Vec<&str> = measures.iter().map(|m| m.label.as_str()).collect();
            let _ = writeln!(text, "  front: {points} points of {}", labels.join(" against "));
        }
    }
    text
}
