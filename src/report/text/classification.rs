//! Critical speeds in the terminal.

use super::{dash, short, table};
use crate::analysis::classification::Classification;
use crate::units::DEG_PER_RAD;

/// Critical speeds within the range, the largest first.
#[doc(hidden)]
pub fn criticals(c: &Classification) -> String {
    let mut inside: Vec<_> = c.criticals.iter().filter_map(|k| Some((&k.of, k.in_range?))).collect();
    inside.sort_by(|a, b| b.1.equilibrium.total_cmp(&a.1.equilibrium));
    let row = |(of, own): &(&crate::analysis::classification::VectorSum, crate::analysis::classification::InRange)| {
        vec![
            format!("{:.0}", of.speed_rpm),
            of.order.to_string(),
            of.mode.to_string(),
            format!("{:.4}", of.sum),
            short(own.torque),
            short(own.equilibrium * DEG_PER_RAD),
            dash(own.resonance.map(|r| short(r * DEG_PER_RAD))),
        ]
    };
    let rows: Vec<Vec<String>> = inside.iter().take(MOST).map(row).collect();
    let header = ["rpm", "order", "mode", "vector sum", "T of a throw/N m", "equilibrium/°", "in resonance/°"];
    format!("Critical speeds of the chain without absorber, {} of {} in range:\n{}", rows.len(), inside.len(), table(&header, &rows))
}

/// Rows printed.
const MOST: usize = 12;
