//! Critical speeds and amplitudes of single orders at the hub.

use super::absorbers::Frequencies;
use super::uncertainty::half_digit;
use super::{Entry, Kind, Role, Uncertainty};
use crate::analysis::amplitude::{Near, WINDOW, near};
use crate::analysis::{Calibration, RunError};
use crate::drivetrain::System;
use crate::engine::Order;
use crate::input::{Published, Study};
use crate::response::{Direct, Grid, ResponseError, Work};
use crate::units::{DEG_PER_RAD, HZ_PER_RPM, RAD_PER_DEG};

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
    /// Half of its last printed digit, rad.
    pub half_digit: f64,
}

impl AmplitudeRow {
    /// |computed/published - 1|, per cent.
    pub fn deviation_percent(&self) -> Option<f64> {
        let (published, computed) = (self.published.filter(|p| *p > 0.0)?, self.computed?);
        Some(100.0 * (computed.amplitude / published - 1.0).abs())
    }

    /// What of it the printed digits leave: none where ours rounds to the printed number.
    pub fn beyond_digits_percent(&self) -> Option<f64> {
        let published = self.published?;
        self.deviation_percent().map(|d| (d - 100.0 * self.half_digit / published).max(0.0))
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
    let of_table = |table: &str| {
        let alike = published.amplitudes.iter().filter(move |p| p.table == *table);
        alike.filter_map(|p| p.amplitude).map(|a| a * DEG_PER_RAD).collect::<Vec<f64>>()
    };
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
            half_digit: half_digit(of_table(&p.table)).unwrap_or(0.0) * RAD_PER_DEG,
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
            uncertainty: Uncertainty::default(),
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

/// The amplitude of one order at the hub that the source accepts, degrees; `None` where it states none.
pub(super) fn accepted_deg(published: &Published) -> Option<f64> {
    published.quantities.iter().find(|q| q.name == "recommended_hub_amplitude_limit").and_then(|q| q.value.as_ref().ok().copied())
}

/// The largest printed resonance of every design and ours of the same orders, beside what the source accepts.
pub(super) fn acceptance(study: &Study, published: &Published, rows: &[AmplitudeRow]) -> Vec<Entry> {
    let Some(limit) = accepted_deg(published) else { return Vec::new() };
    let word = |x: f64| if x <= limit { "holds" } else { "breaks" };
    let entry = |(i, design): (usize, &crate::input::DesignSpec)| {
        let of_design = || rows.iter().filter(|r| r.design == i && r.role != Role::Unexplained && r.published.is_some());
        let printed = of_design().filter_map(|r| r.published).reduce(f64::max)? * DEG_PER_RAD;
        let own = of_design().filter_map(|r| r.computed).map(|n| n.amplitude).reduce(f64::max)? * DEG_PER_RAD;
        let fitted = of_design().any(|r| r.role == Role::Calibrated);
        Some(Entry {
            table: "text".into(),
            design: design.name.clone(),
            quantity: "largest resonance at the hub".into(),
            kind: Kind::Accepted,
            unit: "deg".into(),
            published: Some(printed),
            computed: Some(own),
            uncertainty: Uncertainty { half_digit: of_design().map(|r| r.half_digit * DEG_PER_RAD).reduce(f64::max), standard_error: None },
            role: if fitted { Role::Calibrated } else { Role::Predicted },
            note: format!(
                "of the orders and speeds printed; the printed one {} the accepted {limit} deg, ours {} it",
                word(printed),
                word(own)
            ),
        })
    };
    study.designs.iter().enumerate().filter_map(entry).collect()
}
