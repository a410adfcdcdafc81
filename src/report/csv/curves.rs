//! A table a figure, and Holzer's tables.

use super::table::{Table, number};
use crate::analysis::curves::{Figure, Histories, HolzerRow};
use crate::files::{Folder, WriteError};

/// `<figure>.csv`: a row a point; the columns `x` and `y` are named by the two before them.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn figure(figure: &Figure, folder: &Folder) -> Result<(), WriteError> {
    let mut table = Table::new(&["panel", "curve", "x_quantity", "x", "y_quantity", "y"]);
    for panel in &figure.panels {
        for curve in &panel.curves {
            for (x, y) in &curve.points {
                let words = [&panel.title, &curve.label].map(String::clone);
                let [panel_title, label] = words;
                table.row([panel_title, label, panel.x.column.into(), number(*x), panel.y.column.into(), number(*y)]);
            }
        }
    }
    table.save(folder, &format!("{}.csv", figure.name))
}

/// `holzer.csv`: a row a mode and station.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn holzer(rows: &[HolzerRow], folder: &Folder) -> Result<(), WriteError> {
    let header = [
        "mode",
        "frequency_hz",
        "station",
        "inertia_kg_m2",
        "relative_angle",
        "torque_n_m_per_rad",
        "sum_of_torques_n_m_per_rad",
        "stiffness_to_next_n_m_per_rad",
        "relative_twist",
    ];
    let mut table = Table::new(&header);
    for r in rows {
        let first = [r.mode.to_string(), number(r.frequency_hz), r.station.clone()];
        let rest = [r.inertia, r.angle, r.torque, r.sum, r.stiffness, r.twist].map(number);
        table.row(first.into_iter().chain(rest));
    }
    table.save(folder, "holzer.csv")
}

/// `<name>.csv`: a row a crank angle, a column an unknown of the matrices, in their units, or a load of a throw, N and N m.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn histories(histories: &Histories, folder: &Folder) -> Result<(), WriteError> {
    let header: Vec<&str> = std::iter::once("crank_deg").chain(histories.columns.iter().map(String::as_str)).collect();
    let mut table = Table::new(&header);
    for (deg, values) in &histories.rows {
        table.row(std::iter::once(*deg).chain(values.iter().copied()).map(number));
    }
    table.save(folder, &format!("{}.csv", histories.name))
}
