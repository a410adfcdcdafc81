//! The printed chain: beside that of the engine file, and its stiffness between throws beside the formulas for throws.

use super::{Entry, Kind, Role, Uncertainty};
use crate::drivetrain::throw_stiffness::{ThrowFormula, shear_modulus};
use crate::input::{Published, Study};

/// One entry a formula that holds; nothing without `[crank]` or without natural frequencies of the printed chain.
pub fn entries(study: &Study, published: &Published) -> Vec<Entry> {
    let Some(crank) = study.crank.as_ref().filter(|_| !published.frequencies.is_empty()) else { return Vec::new() };
    let stations = &study.chain.stations;
    let between = |i: &usize| !stations[*i].throws.is_empty() && stations.get(i + 1).is_some_and(|s| !s.throws.is_empty());
    let mut printed: Vec<f64> = (0..stations.len()).filter(between).map(|i| stations[i].stiffness_to_next).collect();
    printed.sort_by(f64::total_cmp);
    let Some(median) = printed.get(printed.len() / 2) else { return Vec::new() };
    let throw = crank.throw(0);
    let modulus = shear_modulus(crank.young_modulus);
    let holds = |formula: &ThrowFormula| formula.out_of_range(&throw).is_none();
    let entry = |formula: ThrowFormula| {
        Entry {
        table: "chain".into(),
        design: String::new(),
        quantity: format!("stiffness between throws by {}", formula.name()),
        kind: Kind::Other,
        unit: "N m/rad".into(),
        published: Some(*median),
        computed: Some(formula.stiffness(&throw, modulus)),
        uncertainty: Uncertainty::default(),
        role: Role::Predicted,
        note: "published: the median of the chain; lengths of pin and journal and the web are assumptions, and formulas differ by a fifth among themselves".into(),
    }
    };
    ThrowFormula::ALL.into_iter().filter(holds).map(entry).collect()
}

/// The printed chain beside that of the engine file.
pub fn printed(study: &Study, published: &Published) -> Vec<Entry> {
    let stations = &study.chain.stations;
    let mut list = Vec::new();
    for p in &published.chain {
        let own = stations.get(p.station);
        let name = own.map_or_else(|| format!("station {}", p.station), |s| s.name.clone());
        let next = stations.get(p.station + 1).map_or_else(|| format!("station {}", p.station + 1), |s| s.name.clone());
        let values = [
            (format!("inertia of {name}"), "kg m2", Some(p.inertia), own.map(|s| s.inertia)),
            (format!("stiffness from {name} to {next}"), "N m/rad", p.stiffness, own.map(|s| s.stiffness_to_next)),
        ];
        list.extend(values.into_iter().filter(|v| v.2.is_some()).map(|(quantity, unit, published, computed)| Entry {
            table: p.table.clone(),
            design: String::new(),
            quantity,
            kind: Kind::Other,
            unit: unit.into(),
            published,
            computed,
            uncertainty: Uncertainty::default(),
            role: Role::Given,
            note: "input of the engine file".into(),
        }));
    }
    list
}
