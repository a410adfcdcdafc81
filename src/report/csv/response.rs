//! `response.csv`: amplitudes and phases over speed.

use super::table::{Table, number, rounded};
use crate::analysis::Results;
use crate::analysis::sweeps::{self, OrderSweep, QuantitySweep, Swept};
use crate::files::{Folder, Stream, WriteError};
use crate::input::Study;
use crate::reason::reason;
use crate::response::{Quantity, ResponseError};

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

/// `response.csv`: an order is a cos(n theta + phi) with amplitude a and phase phi, theta being the angle of the crank, zero where the first cylinder fires. `step`: told of each quantity.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn response(study: &Study, results: &Results, folder: &Folder, step: &(dyn Fn() + Sync)) -> Result<(), WriteError> {
    let columns = ["design", "condition", "quantity", "where", "unit", "order", "kind", "speed_rpm", "amplitude", "phase_deg"];
    let mut rows = Rows { study, results, table: Table::new(&columns), stream: folder.stream()? };
    let failed = |reason: String| WriteError { path: folder.path().join(NAME), reason };
    for sweep in &results.sweeps {
        let mut left = sweep.quantities.as_slice();
        while !left.is_empty() {
            // orders that are not kept are found again, of some quantities at a time
            let most = sweeps::together(results.system.orders(), study.speeds_rpm.len());
            let count = left.iter().take(most).take_while(|q| q.listed.is_some()).count();
            let (own, rest) = left.split_at(count.max(1));
            let found = rows.listed(&sweep.design, own).map_err(|e| failed(e.to_string()))?;
            for (quantity, orders) in own.iter().zip(found.iter().map(Some).chain(std::iter::repeat(None))) {
                rows.quantity(&sweep.design, quantity, orders.unwrap_or(&quantity.orders)).map_err(|e| failed(reason(&e)))?;
                step();
            }
            left = rest;
        }
    }
    rows.table.move_to(&mut rows.stream).map_err(|e| failed(reason(&e)))?;
    folder.keep(rows.stream, NAME)
}

const NAME: &str = "response.csv";

/// The table as it grows.
struct Rows<'a> {
    study: &'a Study,
    results: &'a Results,
    table: Table,
    stream: Stream,
}

impl Rows<'_> {
    /// The orders of quantities that are listed without being kept.
    fn listed(&self, design: &str, quantities: &[QuantitySweep]) -> Result<Vec<Vec<OrderSweep>>, ResponseError> {
        let listed: Vec<(Swept, Quantity)> = quantities.iter().filter_map(|q| Some((q.of, q.listed?))).collect();
        let all = self.results.designs.iter().chain(self.results.optima.iter().map(|o| &o.design));
        let Some(design) = all.into_iter().find(|d| d.name == design).filter(|_| !listed.is_empty()) else { return Ok(Vec::new()) };
        sweeps::orders((&self.results.system, &self.study.speeds_rpm), &design.absorbers, &listed)
    }

    /// Adds the rows of a quantity, order by order.
    fn quantity(&mut self, design: &str, quantity: &QuantitySweep, orders: &[OrderSweep]) -> std::io::Result<()> {
        for (order, OrderSweep { amplitude, phase_deg }) in self.results.system.excitation.orders.iter().zip(orders) {
            self.put((design, quantity), (&order.to_string(), Kind::Order), amplitude, Some(phase_deg))?;
        }
        self.put((design, quantity), ("", Kind::of_all(quantity)), &quantity.total, None)
    }

    fn put(
        &mut self,
        (design, quantity): (&str, &QuantitySweep),
        (order, kind): (&str, Kind),
        amplitudes: &[f64],
        phases: Option<&[f64]>,
    ) -> std::io::Result<()> {
        for (i, (speed, amplitude)) in self.study.speeds_rpm.iter().zip(amplitudes).enumerate() {
            let phase = phases.map_or_else(String::new, |p| number((1e4 * p[i]).round() / 1e4));
            self.table.row_of([
                design,
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
        self.table.move_to(&mut self.stream)
    }
}
