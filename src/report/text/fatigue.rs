//! What `hartog fatigue` prints: the worst points by each criterion.

use super::margin::factor;
use super::table::{aligned, dash, significant};
use crate::analysis::stress_histories::Summary;
use crate::fatigue::multiaxial::{Criterion, Limits};
use crate::units::{DEG_PER_RAD, PA_PER_MPA};
use std::fmt::Write;

/// Crossland's constant below this hardly counts mean stress.
const SMALL: f64 = 0.05;

/// The worst points, and what to know of the constants.
#[doc(hidden)]
pub fn summary(summary: &Summary, limits: &Limits) -> String {
    let mut rows = Vec::new();
    for worst in &summary.worst {
        let Some((name, v)) = worst.first() else { continue };
        let next: Vec<String> = worst[1..].iter().map(|(name, v)| format!("{name} {}", factor(v.safety_factor))).collect();
        rows.push(vec![
            v.criterion.name().to_owned(),
            name.clone(),
            factor(v.safety_factor),
            dash(v.plane.map(|p| format!("{:.1}", p.theta * DEG_PER_RAD))),
            dash(v.plane.map(|p| format!("{:.1}", p.phi * DEG_PER_RAD))),
            dash(v.shear_amplitude.map(|s| significant(s / PA_PER_MPA, 4))),
            dash(v.normal_max.map(|s| significant(s / PA_PER_MPA, 4))),
            next.join(", "),
        ]);
    }
    let header = ["criterion", "worst point", "factor", "theta/°", "phi/°", "shear/MPa", "normal/MPa", "next"];
    let mut text = aligned(&header, &rows, |c| c < 2 || c == 7);
    text.push_str("  plane: normal (sin phi cos theta, sin phi sin theta, cos phi); shear: amplitude; normal: largest\n");
    if let Ok(k) = Criterion::CROSSLAND.weight(limits)
        && k.abs() < SMALL
    {
        let _ = writeln!(
            text,
            "  With this torsion limit ({:.3} of the bending limit) Crossland's constant is {k:.4}: hydrostatic stress hardly counts in it.",
            limits.torsion / limits.bending
        );
    }
    text
}
