//! `response.csv`: amplitudes over speed.

use super::table::{Table, number};
use crate::analysis::Results;
use crate::input::Study;
use crate::report::files::{Folder, WriteError};

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
