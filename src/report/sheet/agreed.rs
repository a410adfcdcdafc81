//! What a quotation needs that no calculation says: blanks for engine builder and maker, with what is known of each.

use super::block::{Block, row};
use crate::absorber::Medium;
use crate::analysis::Sheet;
use crate::input::Study;
use crate::text::table::significant;
use crate::units::{M_PER_MM, RAD_PER_S_PER_RPM};

/// Balance quality that the unbalance is told for: velocity of the centre of mass, m/s. G 6.3 of ISO 21940-11, an example, nothing is judged by it.
const G_6_3: f64 = 6.3e-3;
const G_MM_PER_KG_M: f64 = 1e6;

/// What is to be agreed on.
pub(super) fn agreed(study: &Study, sheet: &Sheet) -> Block {
    let blank = || "____________".to_owned();
    let p = &sheet.parts;
    let highest = study.speeds_rpm.iter().copied().fold(0.0, f64::max);
    let unbalance = sheet.mass * G_6_3 / (highest * RAD_PER_S_PER_RPM) * G_MM_PER_KG_M;
    let inside = |x: f64| format!("inside {} mm: {}", significant(x / M_PER_MM, 4), blank());
    let mut rows = Vec::new();
    match sheet.shape.medium {
        Medium::Rubber => {
            rows.push(row("Hub: material, bolting, fit on the crank", inside(p.bore)));
            rows.push(row("Rubber: bonded, or pressed in and by how much", blank()));
            rows.push(row("Bonding agent, test of the bond", blank()));
        }
        Medium::Oil => {
            rows.push(row("Flange: bolting, fit on the crank", inside(p.bore)));
            rows.push(row("Bearing of the ring, closure and sealing", blank()));
            rows.push(row("Filling: share of the volume, plug, sampling", blank()));
        }
        Medium::Leaves | Medium::Coils => {
            rows.push(row("Hub: material, bolting, fit on the crank", inside(p.bore)));
            rows.push(row("Springs: steel, peening, preload and seats", blank()));
            rows.push(row("Oil: supply, sealing, its viscosity", blank()));
        }
        Medium::Field => {
            rows.push(row("Carrier: material, bolting, fit on the crank", inside(p.bore)));
            rows.push(row("Rollers or pivots, hardness of the paths", blank()));
            rows.push(row("End stops, lubrication", blank()));
        }
    }
    rows.push(row("Surface protection, marking", blank()));
    rows.push(row(&format!("Balance: {} g mm would be G 6.3 at {highest} rpm", significant(unbalance, 3)), blank()));
    Block { title: "To be agreed", rows }
}
