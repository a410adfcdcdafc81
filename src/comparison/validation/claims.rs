//! Sentences of a source that its own tables decide: how far models differ, which resonances are below a limit, forces beside torques, and the pressure that follows from a mechanical efficiency.

use super::amplitudes::{self, AmplitudeRow, accepted_deg};
use super::uncertainty::half_digit;
use super::{Entry, Kind, Role, Uncertainty};
use crate::analysis::RunError;
use crate::drivetrain::System;
use crate::engine::{Excitation, Pressure, Source};
use crate::input::published::{PublishedFrequency, PublishedStress};
use crate::input::{Input, Published, Study};
use crate::units::{DEG_PER_RAD, N_PER_KN};

/// A printed share is contradicted by one that is larger by more than its digit, per cent.
const DIGIT_PERCENT: f64 = 0.5;

fn entry(table: &str, quantity: &str, unit: &str, (claimed, found): (f64, f64), role: Role, note: String) -> Entry {
    Entry {
        table: table.into(),
        design: String::new(),
        quantity: quantity.into(),
        kind: Kind::Other,
        unit: unit.into(),
        published: Some(claimed),
        computed: Some(found),
        uncertainty: Uncertainty::default(),
        role,
        note,
    }
}

fn stated(published: &Published, name: &str) -> Option<f64> {
    published.quantities.iter().find(|q| q.name == name).and_then(|q| q.value.as_ref().ok().copied())
}

/// Every sentence that the tables of the study decide.
///
/// # Errors
/// [`RunError`] where a design has no finite response.
pub fn entries(study: &Study, published: &Published, rows: &[AmplitudeRow]) -> Result<Vec<Entry>, RunError> {
    let mut list: Vec<Entry> = [stresses(published), frequencies(published), resonances(study, published)].into_iter().flatten().collect();
    list.extend(pin_forces(study, published));
    list.extend(efficiency(study, published, rows)?);
    Ok(list)
}

/// Beside a printed largest deviation the one that follows from the tables.
fn beside(name: (&str, &str), quantity: &str, published: &Published, found: f64, from: &str) -> Option<Entry> {
    let claimed = stated(published, name.0)?;
    let role = if found > claimed + DIGIT_PERCENT { Role::Erratum } else { Role::Recomputed };
    Some(entry(name.1, quantity, "%", (claimed, found), role, format!("from {from}")))
}

/// The largest deviation of case C from finite elements.
fn stresses(published: &Published) -> Option<Entry> {
    let of = |model: &str, like: &PublishedStress| published.stresses.iter().find(|s| s.model == model && s.condition == like.condition);
    let elements: Vec<&PublishedStress> = published.stresses.iter().filter(|s| s.model.contains("fem")).collect();
    let off = |s: &&PublishedStress| of("C", s).map(|c| 100.0 * (c.von_mises / s.von_mises - 1.0).abs());
    let found = elements.iter().filter_map(off).reduce(f64::max)?;
    let from = format!("the rows of table {}", elements[0].table);
    beside(("claimed_case_c_deviation", "9"), "largest deviation of case C from the flexible model", published, found, &from)
}

/// The largest deviation of the printed frequencies of other models from those of the chain.
fn frequencies(published: &Published) -> Option<Entry> {
    let own = |f: &PublishedFrequency| published.frequencies.iter().find(|o| o.source.ends_with("cc2") && o.mode == f.mode);
    let elements = || published.frequencies.iter().filter(|f| f.source.contains("fem"));
    let off = |f: &PublishedFrequency| own(f).map(|o| 100.0 * (f.frequency_hz / o.frequency_hz - 1.0).abs());
    let found = elements().filter_map(off).reduce(f64::max)?;
    let table = elements().map(|f| f.table.as_str()).next()?;
    let quantity = "largest deviation of the chain's frequencies from finite elements";
    beside(("claimed_frequency_deviation", "9"), quantity, published, found, &format!("table {table}"))
}

/// The largest printed amplitude of the tuned designs that are said to be below the accepted one.
fn resonances(study: &Study, published: &Published) -> Option<Entry> {
    let section = published.quantities.iter().find(|q| q.name == "claimed_below_hub_amplitude_limit")?;
    let Err(orders) = &section.value else { return None };
    let limit = accepted_deg(published)?;
    let said: Vec<f64> = orders.split(" and ").filter_map(|o| o.trim().parse().ok()).collect();
    let of = |p: &&crate::input::published::PublishedAmplitude| {
        let tuned = study.designs[p.design].absorbers.first().is_some_and(|a| a.absorber.stiffness().is_some_and(|k| k > 0.0));
        tuned && said.contains(&p.order.value())
    };
    let largest = published.amplitudes.iter().filter(of).filter_map(|p| p.amplitude.map(|a| (a * DEG_PER_RAD, p)));
    let (found, row) = largest.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let role = if found > limit { Role::Erratum } else { Role::Recomputed };
    let note = format!("order {} of {} in table {}", row.order, study.designs[row.design].name, row.table);
    Some(entry("6.5.2", &format!("orders {orders} with tuned absorbers, said to be below"), "deg", (limit, found), role, note))
}

/// Printed peaks of pin force that cannot give the printed peaks of torque: no force has more lever than the crank radius.
fn pin_forces(study: &Study, published: &Published) -> Vec<Entry> {
    let Source::Cylinder { geometry, .. } = &study.engine.source else { return Vec::new() };
    let radius = geometry.slider_crank.crank_radius;
    let of = |condition: &str| {
        let force = stated(published, &format!("crankpin_force_{condition}_peak"))?;
        let torque = stated(published, &format!("throw_torque_applied_peak_{condition}"))?;
        let least = torque / radius / N_PER_KN;
        (least > force).then(|| {
            let note = format!("the printed torque of {torque} N m needs that much at the crank radius");
            let quantity = format!("crankpin force {}, at least", condition.replace('_', " "));
            entry("text", &quantity, "kN", (force, least), Role::Erratum, note)
        })
    };
    ["max_torque", "max_power", "max_speed"].iter().filter_map(|c| of(c)).collect()
}

/// The pressure scale that follows from a printed mechanical efficiency beside the fitted one, with what it would make of the printed amplitudes.
fn efficiency(study: &Study, published: &Published, rows: &[AmplitudeRow]) -> Result<Option<Entry>, RunError> {
    let Some(efficiency) = stated(published, "mechanical_efficiency") else { return Ok(None) };
    let Source::Cylinder { pressure: Pressure::Otto(_), .. } = &study.engine.source else { return Ok(None) };
    let Some(fitted) = Input::PressureScale.value(&study.engine, &study.chain) else { return Ok(None) };
    let by_efficiency = 1.0 / efficiency;
    let other = study.with_inputs(&[(Input::PressureScale, by_efficiency)]);
    let system = System::with_modes(other.chain.clone(), other.modes.clone(), Excitation::new(&other.engine, other.order_limit));
    let scaled = amplitudes::rows(&other, published, None, &system)?;
    let ratio = |(own, row): (&AmplitudeRow, &AmplitudeRow)| {
        let counted = row.role == Role::Calibrated;
        Some(own.computed?.amplitude / row.published.filter(|p| *p > 0.0 && counted)?)
    };
    let mut ratios: Vec<f64> = scaled.iter().zip(rows).filter_map(ratio).collect();
    ratios.sort_by(f64::total_cmp);
    let (Some(low), Some(high)) = (ratios.first(), ratios.last()) else { return Ok(None) };
    let note = format!(
        "eq. (3.7) with an efficiency of {efficiency}; amplitudes would be {low:.1} to {high:.1} times the printed ones that are fitted (median {:.1})",
        ratios[ratios.len() / 2]
    );
    let mut found = entry("text", "pressure over brake mean pressure", "-", (by_efficiency, fitted), Role::Unexplained, note);
    found.uncertainty.half_digit = half_digit([efficiency]).map(|half| half / (efficiency * efficiency));
    Ok(Some(found))
}
