//! Critical speeds and amplitudes of single orders at the hub.

use super::absorbers::Frequencies;
use super::{Entry, Kind, Role};
use crate::analysis::amplitude::{Near, WINDOW, near};
use crate::analysis::{Calibration, RunError};
use crate::drivetrain::System;
use crate::engine::Order;
use crate::input::{Published, Study};
use crate::response::{Direct, Grid, ResponseError, Work};
use crate::units::{DEG_PER_RAD, HZ_PER_RPM};

/// A published amplitude beside ours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AmplitudeRow {
    /// Index of the design in the study.
    pub design: usize,
    /// The order.
    pub order: Order,
    /// As printed, rpm.
    pub speed_rpm: f64,
    /// As printed, rad.
    pub published: Option<f64>,
    /// Ours near that speed; nothing outside the range of the study.
    pub computed: Option<Near>,
    /// Order with the largest amplitude near that speed.
    pub largest: Option<(Order, Near)>,
    /// Its role.
    pub role: Role,
    /// Whether it is large enough for a percentage.
    pub counts: bool,
}

impl AmplitudeRow {
    /// |computed/published - 1|, per cent.
    pub fn deviation_percent(&self) -> Option<f64> {
        let (published, computed) = (self.published.filter(|p| *p > 0.0)?, self.computed?);
        Some(100.0 * (computed.amplitude / published - 1.0).abs())
    }
}

pub fn rows(
    study: &Study,
    published: &Published,
    calibration: Option<&Calibration>,
    system: &System,
) -> Result<Vec<AmplitudeRow>, RunError> {
    let grid = Grid::new(&study.speeds_rpm, &[]);
    let direct = Direct::new(system, &grid);
    let excluded = study.calibrate.as_ref().map_or(&[][..], |c| &c.excluded);
    let mut rows = Vec::new();
    for (i, p) in published.amplitudes.iter().enumerate() {
        let design = &study.designs[p.design];
        let peak_of_order = |order| near(study, &direct, &design.absorbers, order, p.speed_rpm, &mut Work::default());
        let failed = |error: ResponseError| RunError { what: format!("design `{}`", design.name), error };
        let role = match calibration {
            _ if excluded.contains(&i) => Role::Unexplained,
            Some(c) if c.rows.iter().any(|r| r.row == i) => Role::Calibrated,
            _ => Role::Predicted,
        };
        let mut largest: Option<(Order, Near)> = None;
        if role == Role::Unexplained {
            for order in system.excitation.orders.iter().copied() {
                // what is rigid at any speed would always win
                let found = peak_of_order(order).map_err(failed)?;
                if let Some(n) =
                    found.filter(|n| resonant(system, order, n.speed_rpm) && largest.is_none_or(|l| n.amplitude > l.1.amplitude))
                {
                    largest = Some((order, n));
                }
            }
        }
        rows.push(AmplitudeRow {
            design: p.design,
            order: p.order,
            speed_rpm: p.speed_rpm,
            published: p.amplitude,
            computed: peak_of_order(p.order).map_err(failed)?,
            largest,
            role,
            // a printed 0.10 is large enough for a limit of 0.1 whatever the rounding of the units
            counts: p.amplitude.is_some_and(|a| a >= published.least_amplitude * (1.0 - 1e-9)),
        });
    }
    Ok(rows)
}

/// Whether an order runs well above the rolling of the whole engine: half the first elastic frequency.
fn resonant(system: &System, order: Order, speed_rpm: f64) -> bool {
    system.modes.frequencies_hz().first().is_some_and(|f| order.value() * speed_rpm * HZ_PER_RPM > 0.5 * f)
}

pub fn entries(study: &Study, published: &Published, conventions: &[Frequencies], rows: &[AmplitudeRow]) -> Vec<Entry> {
    let mut entries = Vec::new();
    for (p, row) in published.amplitudes.iter().zip(rows) {
        let design = study.designs[row.design].name.clone();
        let modes = conventions.iter().find(|f| f.design == design);
        let own = study.modes.frequencies_hz();
        let printed_hz = row.order.value() * row.speed_rpm * HZ_PER_RPM;
        let mode = modes.map_or_else(
            || {
                own.iter()
                    .copied()
                    .enumerate()
                    .min_by(|a, b| (a.1 - printed_hz).abs().total_cmp(&(b.1 - printed_hz).abs()))
                    .map(|(i, f)| (i + 1, f))
            },
            |m| m.nearest(printed_hz),
        );
        let entry = |quantity: String, kind, unit: &str, values: (Option<f64>, Option<f64>), role, note| Entry {
            table: p.table.clone(),
            design: design.clone(),
            quantity,
            kind,
            unit: unit.into(),
            published: values.0,
            computed: values.1,
            role,
            note,
        };
        if let Some((mode, hz)) = mode {
            let speed = hz / (HZ_PER_RPM * row.order.value());
            let values = (Some(row.speed_rpm), Some(speed));
            let quantity = format!("order {} critical speed", row.order);
            entries.push(entry(quantity, Kind::CriticalSpeed, "rpm", values, Role::Predicted, format!("meets f{mode}")));
        }
        let Some(amplitude) = row.published else { continue };
        let mut note = match row.computed {
            Some(n) => format!("largest within {:.0} %: at {:.0} rpm", 100.0 * WINDOW, n.speed_rpm),
            None => "outside the speeds or orders of the study".into(),
        };
        if !row.counts {
            note.push_str("; too small for a percentage");
        }
        if let Some((order, n)) = row.largest {
            note = format!(
                "the largest order there is {order}, with {:.2} deg at {:.0} rpm; excluded",
                n.amplitude * DEG_PER_RAD,
                n.speed_rpm
            );
        }
        let values = (Some(amplitude * DEG_PER_RAD), row.computed.map(|n| n.amplitude * DEG_PER_RAD));
        entries.push(entry(format!("order {} hub amplitude", row.order), Kind::Amplitude, "deg", values, row.role, note));
    }
    entries
}
