//! `margin.csv`, and the columns that margins add to other tables.

use super::table::{Table, number, optional, rounded};
use crate::analysis::{DesignResult, Results};
use crate::files::{Folder, WriteError};
use crate::input::Study;
use crate::reason::reason;
use crate::units::PA_PER_MPA;

/// Columns of the smallest margins in `designs.csv`: three a criterion.
pub fn columns(study: &Study) -> Vec<String> {
    let criteria = study.fatigue.iter().flat_map(|f| &f.criteria);
    criteria.flat_map(|c| [c.column().to_owned(), format!("{}_speed_rpm", c.column()), format!("{}_fillet", c.column())]).collect()
}

/// Their cells for one design.
pub fn cells(study: &Study, results: &Results, d: &DesignResult) -> Vec<String> {
    let criteria = study.fatigue.as_ref().map_or(0, |f| f.criteria.len());
    let cells = |c: usize| {
        let found = d.margins.iter().find(|m| m.criterion == c);
        let name = found.zip(results.margin.as_ref()).map(|(m, model)| model.locations[m.used.location].name.clone());
        [optional(found.map(|m| m.margin)), optional(found.map(|m| m.speed_rpm)), name.unwrap_or_default()]
    };
    (0..criteria).flat_map(cells).collect()
}

/// `margin.csv`: a row a design, speed, fillet (the worse of its two webs, and the worst point of those with very many) and criterion. Stresses are equivalent ones (by von Mises; by a
/// multiaxial criterion the shear stress held against the torsion limit); the class rule and multiaxial criteria have no mean.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn margin(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let Some(model) = &results.margin else { return Ok(()) };
    let header = ["design", "speed_rpm", "fillet", "criterion", "amplitude_mpa", "mean_mpa", "safety_factor"];
    let (mut table, mut stream) = (Table::new(&header), folder.stream()?);
    let failed = |e: std::io::Error| WriteError { path: folder.path().join("margin.csv"), reason: reason(&e) };
    for sweep in &results.margins {
        for fillet in &sweep.fillets {
            let criterion = model.criteria[fillet.criterion];
            for (speed, used) in study.speeds_rpm.iter().zip(&fillet.used) {
                let mean = Some(used.cycle.mean / PA_PER_MPA)
                    .filter(|_| !model.is_class_rule(fillet.criterion) && !model.is_multiaxial(fillet.criterion));
                // without any stress the margin has no limit
                let factor = Some(1.0 / used.value).filter(|n| n.is_finite());
                table.row([
                    sweep.design.clone(),
                    number(*speed),
                    model.locations[used.location].name.clone(),
                    criterion.name().to_owned(),
                    rounded(used.cycle.amplitude / PA_PER_MPA),
                    mean.map_or_else(String::new, rounded),
                    factor.map_or_else(|| "infinite".into(), rounded),
                ]);
            }
            table.move_to(&mut stream).map_err(failed)?;
        }
    }
    table.move_to(&mut stream).map_err(failed)?;
    folder.keep(stream, "margin.csv")
}
