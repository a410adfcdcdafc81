//! Tables of sizing.

use super::table::{Table, number, optional};
use crate::analysis::sizing::{FrontPoint, SizingResults};
use crate::files::{Folder, WriteError};
use crate::sizing::Round;
use crate::sizing::rod::TAPER;
use crate::units::{DEG_PER_RAD, M_PER_MM, PA_PER_MPA};
use crate::validation::rounds::{EXPLAINED, RoundRow, reason};
use crate::validation::worked_examples::ExampleRow;

/// Quantities of a round with their units.
fn quantities(round: &Round) -> Vec<(String, &'static str, f64)> {
    let mut list: Vec<(String, &'static str, f64)> =
        round.sizes.named().iter().map(|(name, value)| ((*name).to_owned(), "mm", value / M_PER_MM)).collect();
    let height = 5.0 * round.sizes.shank_thickness / M_PER_MM;
    list.push(("shank_width".into(), "mm", 0.8 * height));
    list.push(("shank_height".into(), "mm", height));
    list.push(("shank_height_at_small_eye".into(), "mm", TAPER.0 * height));
    list.push(("shank_height_at_big_eye".into(), "mm", TAPER.1 * height));
    for (name, body) in [("rod", round.rod), ("throw", round.throw)] {
        list.push((format!("{name}_mass"), "kg", body.mass));
        list.push((format!("{name}_centre"), "mm", body.centre / M_PER_MM));
        list.push((format!("{name}_inertia_about_centre"), "kg m2", body.inertia()));
        list.push((format!("{name}_inertia_about_reference"), "kg m2", body.inertia_at_reference));
    }
    for (name, notch) in [("crankpin", round.crankpin_notch), ("journal", round.journal_notch)] {
        list.push((format!("{name}_notch_factor_bending"), "1", notch.bending));
        list.push((format!("{name}_notch_factor_torsion"), "1", notch.torsion));
    }
    for m in &round.margins {
        list.push((format!("{}_margin_yielding", m.section), "1", m.yielding));
        list.push((format!("{}_margin_fatigue", m.section), "1", m.fatigue));
    }
    list.push(("rod_shank_margin_buckling".into(), "1", round.buckling_margin));
    for (m, behind) in round.margins.iter().filter_map(|m| Some((m, m.behind?))) {
        for (name, factor) in ["load", "size", "surface", "temperature", "reliability"].iter().zip(behind.factors) {
            list.push((format!("{}_{name}_factor", m.section), "1", factor));
        }
        list.push((format!("{}_fatigue_limit", m.section), "MPa", behind.fatigue_limit / PA_PER_MPA));
        list.push((format!("{}_moment_amplitude", m.section), "N m", behind.moments[0]));
        list.push((format!("{}_moment_mean", m.section), "N m", behind.moments[1]));
    }
    list
}

/// `sizing.csv`: a row a round and quantity; a margin of what bears nothing is empty.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub(crate) fn rounds(results: &SizingResults, folder: &Folder) -> Result<(), WriteError> {
    let mut table = Table::new(&["round", "quantity", "unit", "value"]);
    for (i, round) in results.sized.rounds.iter().enumerate() {
        for (quantity, unit, value) in quantities(round) {
            table.row([(i + 1).to_string(), quantity, unit.into(), if value.is_finite() { number(value) } else { String::new() }]);
        }
    }
    table.save(folder, "sizing.csv")
}

/// `sizing_comparison.csv`: a row a printed value.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub(crate) fn comparison(rows: &[RoundRow], folder: &Folder) -> Result<(), WriteError> {
    let mut table = Table::new(&["symbol", "quantity", "unit", "round", "published", "computed", "deviation_percent", "note"]);
    for r in rows {
        let words = [r.quantity.symbol, r.quantity.words, r.quantity.unit].map(str::to_owned);
        let numbers = [number(r.published), number(r.computed), number(r.deviation_percent())];
        let note = if r.deviation_percent().abs() > EXPLAINED { reason(r.quantity.symbol) } else { "" };
        table.row(words.into_iter().chain([r.round.to_string()]).chain(numbers).chain([note.to_owned()]));
    }
    table.save(folder, "sizing_comparison.csv")
}

/// `sizing_examples.csv`: a row a result of a worked example.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub(crate) fn examples(rows: &[ExampleRow], folder: &Folder) -> Result<(), WriteError> {
    let header = ["table", "example", "quantity", "unit", "published", "program", "computed", "deviation_percent", "half_digit", "note"];
    let mut table = Table::new(&header);
    for r in rows {
        let words = [&r.table, &r.example, &r.quantity, &r.unit].map(Clone::clone);
        let numbers = [number(r.book), optional(r.program), optional(r.computed), optional(r.deviation_percent()), number(r.half_digit)];
        table.row(words.into_iter().chain(numbers).chain([r.note.to_owned()]));
    }
    table.save(folder, "sizing_examples.csv")
}

/// `sizing_front.csv`: a row a ring.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub(crate) fn front(points: &[FrontPoint], folder: &Folder) -> Result<(), WriteError> {
    let header = [
        "ring_inertia_kg_m2",
        "crank_mass_kg",
        "crankpin_diameter_mm",
        "journal_diameter_mm",
        "web_breadth_mm",
        "seat_diameter_mm",
        "f1_hz",
        "peak_twist_deg",
        "peak_torque_n_m",
        "rounds",
    ];
    let mut table = Table::new(&header);
    for p in points {
        let values = [
            p.ring_inertia,
            p.crank_mass,
            p.crankpin_diameter / M_PER_MM,
            p.journal_diameter / M_PER_MM,
            p.web_breadth / M_PER_MM,
            p.seat_diameter / M_PER_MM,
            p.response.frequency_hz,
            p.response.twist * DEG_PER_RAD,
            p.response.torque,
        ];
        table.row(values.map(number).into_iter().chain([p.response.rounds.to_string()]));
    }
    table.save(folder, "sizing_front.csv")
}
