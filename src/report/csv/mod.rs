//! Tables with the columns of the contract. Numbers in the shortest form that reads back exactly; what does not apply is empty.

pub mod chart;
pub mod fatigue;
pub mod margin;

use super::files::{Folder, WriteError};
use crate::analysis::{Calibration, ConditionResult, DesignResult, Results, Timing};
use crate::input::{ObjectiveSpec, Study, UnitOf};
use crate::objective::{Condition, Peak};
use crate::response::Quantity;
use crate::units::DEG_PER_RAD;
use crate::validation::Comparison;

/// Columns of `designs.csv`, in order.
pub const DESIGN_COLUMNS: [&str; 22] = [
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

struct Table {
    writer: csv::Writer<Vec<u8>>,
}

impl Table {
    fn new(header: &[&str]) -> Self {
        let mut table = Self { writer: csv::Writer::from_writer(Vec::new()) };
        table.row(header.iter().map(|h| (*h).to_owned()));
        table
    }

    fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        // memory does not fail to be written to, and every row has the length of the header
        let written = self.writer.write_record(cells);
        debug_assert!(written.is_ok(), "{written:?}");
    }

    fn save(self, folder: &Folder, name: &str) -> Result<(), WriteError> {
        folder.write(name, &self.writer.into_inner().unwrap_or_default())
    }
}

/// The shortest decimal that reads back exactly.
pub fn number(x: f64) -> String {
    let magnitude = x.abs();
    if x == 0.0 || (1e-5..1e16).contains(&magnitude) { format!("{x}") } else { format!("{x:e}") }
}

fn optional(x: Option<f64>) -> String {
    x.map_or_else(String::new, number)
}

/// A value of the study's (first) objective in the unit of its column.
pub fn in_unit(study: &Study, value: f64) -> f64 {
    in_unit_of(&study.objective, value)
}

/// A value of an objective in the unit of its column; a margin is the inverse of what is made small.
pub fn in_unit_of(objective: &ObjectiveSpec, value: f64) -> f64 {
    match objective.unit {
        UnitOf::Angle => value * DEG_PER_RAD,
        UnitOf::Torque => value,
        UnitOf::Margin => 1.0 / value,
    }
}

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
    let others: Vec<Condition> = study.conditions.iter().copied().filter(|c| *c != Condition::Firing).collect();
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

/// `response.csv`.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn response(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let mut table = Table::new(&["design", "quantity", "order", "speed_rpm", "amplitude"]);
    for sweep in &results.sweeps {
        for quantity in &sweep.quantities {
            let orders = results.system.excitation.orders.iter().map(ToString::to_string);
            let rows = orders.zip(&quantity.orders).chain(std::iter::once(("total".to_owned(), &quantity.total)));
            for (order, amplitudes) in rows {
                for (speed, amplitude) in study.speeds_rpm.iter().zip(amplitudes) {
                    table.row([sweep.design.clone(), quantity.name.clone(), order.clone(), number(*speed), number(*amplitude)]);
                }
            }
        }
    }
    table.save(folder, "response.csv")
}

/// `pareto.csv`.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn pareto(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
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
    header.extend(study.more_objectives.iter().map(|o| o.column.as_str()));
    let mut table = Table::new(&header);
    for front in &results.fronts {
        for (point, others) in front.front.points.iter().zip(&front.others) {
            let a = &point.design[0].absorber;
            let mut row = vec![
                front.declaration.name.to_owned(),
                number(a.ring_inertia()),
                optional(a.stiffness()),
                optional(a.damping()),
                number(in_unit(study, point.value)),
                optional(Some(point.kkt_residual).filter(|r| r.is_finite())),
                (point.excess <= 1e-6).to_string(),
                point.dominated.to_string(),
            ];
            row.extend(study.more_objectives.iter().zip(others).map(|(o, v)| number(in_unit_of(o, *v))));
            table.row(row);
        }
    }
    table.save(folder, "pareto.csv")
}

/// `calibration.csv`: a row a fitted or held input.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn calibration(calibration: &Calibration, folder: &Folder) -> Result<(), WriteError> {
    let header = ["input", "in_file", "fitted", "standard_error", "lower", "upper", "note"];
    let mut table = Table::new(&header);
    for i in &calibration.inputs {
        let cells = [i.free.start, i.value].map(number);
        let error = optional(i.standard_error.filter(|e| e.is_finite()));
        let note = crate::report::text::calibration::known(i.known).to_owned();
        table.row([i.free.input.key().to_owned()].into_iter().chain(cells).chain([
            error,
            number(i.free.lower),
            number(i.free.upper),
            note,
        ]));
    }
    for (input, value) in &calibration.by_hand {
        let empty = || String::new();
        table.row([input.key().to_owned(), number(*value), empty(), empty(), empty(), empty(), "tuned by hand, held".into()]);
    }
    table.save(folder, "calibration.csv")
}

/// `comparison.csv`.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn comparison(engine: &str, comparison: &Comparison, folder: &Folder) -> Result<(), WriteError> {
    let header = ["table", "engine", "design", "quantity", "unit", "published", "computed", "deviation_percent", "role", "note"];
    let mut table = Table::new(&header);
    for e in &comparison.entries {
        table.row([
            e.table.clone(),
            engine.to_owned(),
            e.design.clone(),
            e.quantity.clone(),
            e.unit.clone(),
            optional(e.published),
            optional(e.computed),
            optional(e.deviation_percent()),
            e.role.name().to_owned(),
            e.note.clone(),
        ]);
    }
    table.save(folder, "comparison.csv")
}

/// `timing.csv`: the only table that differs from run to run.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn timing(timing: &[Timing], folder: &Folder) -> Result<(), WriteError> {
    let header = ["stage", "seconds", "evaluations", "direct_solves", "receptance_points", "singular_points", "syntheses"];
    let mut table = Table::new(&header);
    for t in timing {
        let w = &t.work;
        let counts = [w.evaluations, w.direct_solves, w.receptance_points, w.singular_points, w.syntheses];
        table.row([t.stage.clone(), number(t.seconds)].into_iter().chain(counts.map(|c| c.to_string())));
    }
    table.save(folder, "timing.csv")
}
