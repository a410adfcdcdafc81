//! Tables with the columns of the contract. Numbers in the shortest form that reads back exactly; what does not apply is empty.

use super::files::{Folder, WriteError};
use crate::absorber::Ring;
use crate::assess::{DesignResult, Results, Timing};
use crate::design::Peak;
use crate::response::Quantity;
use crate::study::{Study, UnitOf};
use crate::units::DEG_PER_RAD;

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

/// An objective in the unit of its column.
pub fn in_unit(study: &Study, value: f64) -> f64 {
    match study.objective.unit {
        UnitOf::Angle => value * DEG_PER_RAD,
        UnitOf::Torque => value,
    }
}

fn design_row(study: &Study, results: &Results, d: &DesignResult) -> Vec<String> {
    let kinds: Vec<&str> = d.absorbers.iter().map(|a| a.absorber.kind().name()).collect();
    let one = d.absorbers.first().filter(|_| d.absorbers.len() == 1).map(|a| a.absorber);
    let total = (!d.absorbers.is_empty()).then(|| d.absorbers.iter().map(|a| a.absorber.ring_inertia()).sum());
    let frequency = |i: usize| optional(d.frequencies_hz.get(i).copied());
    let order = |p: &Option<Peak>| p.map_or_else(String::new, |p| results.system.excitation.orders[p.order].to_string());
    let degrees = |p: &Option<Peak>| optional(p.map(|p| p.value * DEG_PER_RAD));
    let speed = |p: &Option<Peak>| optional(p.map(|p| p.speed_rpm));
    let shaft = d.torque.and_then(|p| match p.quantity {
        Quantity::ShaftTorque(s) => Some(results.system.chain.shaft_name(s)),
        _ => None,
    });
    vec![
        d.name.clone(),
        if kinds.is_empty() { "none".into() } else { kinds.join("+") },
        optional(total),
        optional(one.map(|a| a.stiffness()).filter(|k| k.is_finite())),
        optional(one.map(|a| a.damping())),
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
        shaft.unwrap_or_default(),
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
    let mut table = Table::new(&DESIGN_COLUMNS);
    for d in results.designs.iter().chain(results.optima.iter().map(|o| &o.design)) {
        table.row(design_row(study, results, d));
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
    let header = [
        "absorber",
        "ring_inertia_kg_m2",
        "stiffness_n_m_per_rad",
        "damping_n_m_s_per_rad",
        study.objective.column,
        "kkt_residual",
        "limits_hold",
        "dominated",
    ];
    let mut table = Table::new(&header);
    for front in &results.fronts {
        for point in &front.front.points {
            let a = &point.design.absorber;
            table.row([
                front.kind.name().to_owned(),
                number(a.ring_inertia()),
                number(a.stiffness()),
                number(a.damping()),
                number(in_unit(study, point.value)),
                optional(Some(point.kkt_residual).filter(|r| r.is_finite())),
                (point.excess <= 1e-6).to_string(),
                point.dominated.to_string(),
            ]);
        }
    }
    table.save(folder, "pareto.csv")
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
