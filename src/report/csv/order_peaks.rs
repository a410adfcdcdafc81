//! `order_peaks.csv`: the orders that matter to each quantity of a design, the largest first.

use super::table::{Table, number, rounded};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::input::Study;

/// Orders with less than this share of a quantity's largest are left out.
const LEAST: f64 = 0.1;

/// `order_peaks.csv`: of each order the largest amplitude at the speeds of the study, and that speed. It has the quantities that every run keeps by order; shafts, rings and every station stand in `response.csv`.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub(crate) fn order_peaks(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let mut table = Table::new(&["design", "condition", "quantity", "where", "unit", "order", "speed_rpm", "amplitude"]);
    for (design, q) in results.sweeps.iter().flat_map(|s| s.quantities.iter().map(|q| (&s.design, q))) {
        let largest =
            |of: &[f64]| of.iter().copied().zip(&study.speeds_rpm).fold((0.0, 0.0), |m, (a, s)| if a > m.0 { (a, *s) } else { m });
        let orders = results.system.excitation.orders.iter().zip(&q.orders);
        let mut peaks: Vec<(String, (f64, f64))> = orders.map(|(order, sweep)| (order.to_string(), largest(&sweep.amplitude))).collect();
        peaks.sort_by(|a, b| b.1.0.total_cmp(&a.1.0));
        let least = peaks.first().map_or(0.0, |first| LEAST * first.1.0);
        for (order, (amplitude, speed)) in peaks.into_iter().filter(|p| p.1.0 > 0.0 && p.1.0 >= least) {
            let words = [design, q.condition.name(), q.of.name(), &q.place, q.of.unit()].map(str::to_owned);
            table.row(words.into_iter().chain([order, number(speed), rounded(amplitude)]));
        }
    }
    table.save(folder, "order_peaks.csv")
}
