//! `response.csv`: amplitudes and phases over speed.

use super::table::{Table, number, rounded};
use crate::analysis::Results;
use crate::analysis::sweeps::{OrderSweep, QuantitySweep, Swept};
use crate::input::Study;
use crate::report::files::{Folder, WriteError};

/// What the amplitude of a row is of.
#[derive(Clone, Copy)]
enum Kind {
    /// One order.
    Order,
    /// All orders: half peak-to-peak.
    Synthesis,
    /// All orders: their sum.
    Sum,
}

impl Kind {
    fn name(self) -> &'static str {
        match self {
            Self::Order => "order",
            Self::Synthesis => "synthesis",
            Self::Sum => "sum",
        }
    }

    /// Of all orders.
    fn of_all(quantity: &QuantitySweep) -> Self {
        if quantity.of == Swept::DissipatedPower { Self::Sum } else { Self::Synthesis }
    }
}

/// `response.csv`: an order is a cos(n theta + phi) with amplitude a and phase phi, theta being the angle of the crank, zero where the first cylinder fires.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn response(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let mut table =
        Table::new(&["design", "condition", "quantity", "where", "unit", "order", "kind", "speed_rpm", "amplitude", "phase_deg"]);
    for sweep in &results.sweeps {
        for quantity in &sweep.quantities {
            let mut put = |order: &str, kind: Kind, amplitudes: &[f64], phases: Option<&[f64]>| {
                for (i, (speed, amplitude)) in study.speeds_rpm.iter().zip(amplitudes).enumerate() {
                    let phase = phases.map_or_else(String::new, |p| number((1e4 * p[i]).round() / 1e4));
                    table.row_of([
                        &sweep.design,
                        quantity.condition.name(),
                        quantity.of.name(),
                        &quantity.place,
                        quantity.of.unit(),
                        order,
                        kind.name(),
                        &number(*speed),
                        &rounded(*amplitude),
                        &phase,
                    ]);
                }
            };
            for (order, OrderSweep { amplitude, phase_deg }) in results.system.excitation.orders.iter().zip(&quantity.orders) {
                put(&order.to_string(), Kind::Order, amplitude, Some(phase_deg));
            }
            put("", Kind::of_all(quantity), &quantity.total, None);
        }
    }
    table.save(folder, "response.csv")
}
