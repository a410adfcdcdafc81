//! `designs.csv`: a row a design.

use super::margin;
use super::table::{Table, in_unit, optional};
use crate::analysis::{ConditionResult, DesignResult, Results};
use crate::files::{Folder, WriteError};
use crate::input::Study;
use crate::objective::{Condition, Peak};
use crate::response::Quantity;
use crate::units::DEG_PER_RAD;

/// Columns of `designs.csv`, in order.
pub(crate) const DESIGN_COLUMNS: [&str; 22] = [
    "design",
    "absorber",
    "ring_inertia_kg_m2",
    "stiffness_n_m_per_rad",
    "damping_n_m_s_per_rad",
    "f1_hz",
    "f2_hz",
    "f3_hz",
    "peak_twist_deg",
    "peak_twist_speed_rpm",
    "peak_order_twist_deg",
    "peak_order_twist_order",
    "peak_order_twist_speed_rpm",
    "peak_order_hub_deg",
    "peak_order_hub_order",
    "peak_order_hub_speed_rpm",
    "peak_torque_n_m",
    "peak_torque_shaft",
    "dissipated_power_w",
    "ring_twist_deg",
    "objective",
    "objective_value",
];

fn shaft_of(results: &Results, torque: Option<Peak>) -> String {
    match torque.map(|p| p.quantity) {
        Some(Quantity::ShaftTorque(s)) => results.system.chain.shaft_name(s),
        _ => String::new(),
    }
}

/// Cells of one condition: empty where it makes no difference to the design.
fn condition_cells(study: &Study, results: &Results, condition: Condition, c: Option<&ConditionResult>) -> Vec<String> {
    let twist = c.and_then(|c| c.twist);
    let torque = c.and_then(|c| c.torque);
    let mut cells = Vec::new();
    if condition == Condition::Misfire {
        cells.push(c.and_then(|c| c.cylinder).map_or_else(String::new, |c| (c + 1).to_string()));
    }
    cells.extend([
        optional(twist.map(|p| p.value * DEG_PER_RAD)),
        optional(twist.map(|p| p.speed_rpm)),
        twist.map_or_else(String::new, |p| results.system.excitation.orders[p.order].to_string()),
        optional(torque.map(|p| p.value)),
        shaft_of(results, torque),
        optional(c.map(|c| in_unit(study, c.objective))),
    ]);
    cells
}

fn design_row(study: &Study, results: &Results, d: &DesignResult) -> Vec<String> {
    let types: Vec<&str> = d.absorbers.iter().map(|a| a.absorber.type_name()).collect();
    let one = d.absorbers.first().filter(|_| d.absorbers.len() == 1).map(|a| &a.absorber);
    let total = (!d.absorbers.is_empty()).then(|| d.absorbers.iter().map(|a| a.absorber.ring_inertia()).sum());
    let frequency = |i: usize| optional(d.frequencies_hz.get(i).copied());
    let order = |p: &Option<Peak>| p.map_or_else(String::new, |p| results.system.excitation.orders[p.order].to_string());
    let degrees = |p: &Option<Peak>| optional(p.map(|p| p.value * DEG_PER_RAD));
    let speed = |p: &Option<Peak>| optional(p.map(|p| p.speed_rpm));
    vec![
        d.name.clone(),
        if types.is_empty() { "none".into() } else { types.join("+") },
        optional(total),
        optional(one.and_then(|a| a.stiffness())),
        optional(one.and_then(|a| a.damping())),
        frequency(0),
        frequency(1),
        frequency(2),
        degrees(&d.twist),
        speed(&d.twist),
        degrees(&d.order_twist),
        order(&d.order_twist),
        speed(&d.order_twist),
        degrees(&d.order_hub),
        order(&d.order_hub),
        speed(&d.order_hub),
        optional(d.torque.map(|p| p.value)),
        shaft_of(results, d.torque),
        optional(d.power),
        optional(d.ring_twist.map(|t| t * DEG_PER_RAD)),
        study.objective.column.to_owned(),
        optional(d.objective.map(|v| in_unit(study, v))),
    ]
}

/// `designs.csv`.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn designs(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let others: Vec<Condition> = results.conditions().filter(|c| *c != Condition::Firing).collect();
    let mut header: Vec<String> = DESIGN_COLUMNS.map(str::to_owned).to_vec();
    for condition in &others {
        if *condition == Condition::Misfire {
            header.push("misfire_cylinder".into());
        }
        let columns =
            ["peak_twist_deg", "peak_twist_speed_rpm", "peak_twist_order", "peak_torque_n_m", "peak_torque_shaft", "objective_value"];
        header.extend(columns.map(|c| format!("{}_{c}", condition.name())));
    }
    header.extend(margin::columns(study));
    let mut table = Table::new(&header.iter().map(String::as_str).collect::<Vec<_>>());
    for d in results.designs.iter().chain(results.optima.iter().map(|o| &o.design)) {
        let mut row = design_row(study, results, d);
        for condition in &others {
            row.extend(condition_cells(study, results, *condition, d.conditions.iter().find(|c| c.condition == *condition)));
        }
        row.extend(margin::cells(study, results, d));
        table.row(row);
    }
    table.save(folder, "designs.csv")
}
