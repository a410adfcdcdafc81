//! `comparison.csv`, `choices.csv` and `calibration.csv`.

use super::table::{Table, number, optional};
use crate::analysis::Calibration;
use crate::files::{Folder, WriteError};
use crate::validation::{Choices, Comparison};

/// `calibration.csv`: a row a fitted or held input.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn calibration(calibration: &Calibration, folder: &Folder) -> Result<(), WriteError> {
    let header = ["input", "in_file", "fitted", "standard_error", "lower", "upper", "note"];
    let mut table = Table::new(&header);
    for i in &calibration.inputs {
        let cells = [i.free.start, i.value].map(number);
        let error = optional(i.standard_error.filter(|e| e.is_finite()));
        let note = crate::text::calibration::known(i.known).to_owned();
        table.row([i.free.input.key().to_owned()].into_iter().chain(cells).chain([
            error,
            number(i.free.lower),
            number(i.free.upper),
            note,
        ]));
    }
    for (input, value) in &calibration.by_hand {
        let empty = || String::new();
        table.row([input.key().to_owned(), number(*value), empty(), empty(), empty(), empty(), "tuned by hand, held".into()]);
    }
    table.save(folder, "calibration.csv")
}

/// `comparison.csv`.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn comparison(engine: &str, comparison: &Comparison, folder: &Folder) -> Result<(), WriteError> {
    let header = [
        "table",
        "engine",
        "design",
        "quantity",
        "unit",
        "published",
        "computed",
        "deviation_percent",
        "role",
        "note",
        "half_digit",
        "standard_error",
        "within_uncertainty",
    ];
    let mut table = Table::new(&header);
    for e in &comparison.entries {
        table.row([
            e.table.clone(),
            engine.to_owned(),
            e.design.clone(),
            e.quantity.clone(),
            e.unit.clone(),
            optional(e.published),
            optional(e.computed),
            optional(e.deviation_percent()),
            e.role.name().to_owned(),
            e.note.clone(),
            optional(e.uncertainty.half_digit),
            optional(e.uncertainty.standard_error),
            e.is_within().map_or_else(String::new, |within| within.to_string()),
        ]);
    }
    table.save(folder, "comparison.csv")
}

/// `choices.csv`: a row a design and measure, as printed and as computed.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn choices(choices: &Choices, folder: &Folder) -> Result<(), WriteError> {
    let header = ["quantity", "unit", "design", "published", "computed", "published_place", "computed_place", "recommended_in"];
    let mut table = Table::new(&header);
    for ranking in &choices.rankings {
        for placed in &ranking.designs {
            let recommended: Vec<&str> =
                choices.chosen.iter().filter(|c| c.design == placed.design).map(|c| c.choice.table.as_str()).collect();
            table.row([
                ranking.quantity.clone(),
                ranking.unit.clone(),
                placed.design.clone(),
                number(placed.published),
                number(placed.computed),
                ranking.place(placed, |p| p.published).to_string(),
                ranking.place(placed, |p| p.computed).to_string(),
                recommended.join(", "),
            ]);
        }
    }
    table.save(folder, "choices.csv")
}
