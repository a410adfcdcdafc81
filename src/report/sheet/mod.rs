//! `order_<design>.html`, `.pdf` and `.json`: a damper on one page of A4, as it is ordered.

mod agreed;
mod block;
mod canvas;
mod page;
mod section;

use super::files::{Folder, WriteError};
use super::plot::canvas::written_page;
use crate::absorber::Medium;
use crate::analysis::{Results, Sheet};
use crate::input::Study;
use crate::text::allocation::borne;
use serde_json::json;

/// Writes them all; none without a damper by its dimensions.
///
/// # Errors
/// [`WriteError`] where one cannot be written.
pub(super) fn write(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    results.sheets.iter().try_for_each(|sheet| one(study, results, sheet, folder))
}

fn one(study: &Study, results: &Results, sheet: &Sheet, folder: &Folder) -> Result<(), WriteError> {
    let name = format!("order_{}", sheet.design);
    let svg = page::of(study, results, sheet);
    let html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{name}</title>\n<style>@page {{ size: A4; margin: 0 }} body {{ margin: 0; background: #fff }} svg {{ display: block; width: 210mm; height: 297mm; margin: 0 auto }}</style></head>\n<body>\n{svg}\n</body></html>\n"
    );
    folder.write(&format!("{name}.html"), html.as_bytes())?;
    let pdf = written_page(&svg, page::UNITS_PER_INCH);
    let pdf = pdf.ok_or_else(|| WriteError {
        path: folder.path().join(format!("{name}.pdf")),
        reason: "the page could not be written as PDF".into(),
    })?;
    folder.write(&format!("{name}.pdf"), &pdf)?;
    let substance = sheet.substance.as_ref();
    let mut record = json!({
        "format": 1,
        "study": study.name,
        "engine": study.engine.name,
        "order": sheet,
        "compound": substance.map(|s| &s.name),
        "sources": substance.map(|s| s.sources.iter().cloned().collect::<std::collections::BTreeMap<_, _>>()),
        "own_frequency_hz": sheet.on_held_hub.map(|h| h.frequency_hz),
        "outer_diameter_mm": sheet.parts.outer_diameter * 1e3,
        "width_mm": sheet.parts.width * 1e3,
        "bore_mm": sheet.parts.bore * 1e3,
        "ring_mass_kg": sheet.parts.ring_mass,
    });
    let p = &sheet.parts;
    let own = match sheet.shape.medium {
        Medium::Rubber | Medium::Oil => {
            vec![("housing_mass_kg", p.hub_mass), ("housing_inertia_kg_m2", p.hub_inertia), ("sheared_volume_l", p.element_volume * 1e3)]
        }
        Medium::Leaves => vec![("leaf_width_mm", p.element_length * 1e3), ("slot_radius_mm", p.radius * 1e3)],
        Medium::Coils => vec![("coil_outer_diameter_mm", p.element_length * 1e3), ("spring_radius_mm", p.radius * 1e3)],
        Medium::Field => vec![("inertia_with_hub_kg_m2", p.hub_inertia)],
    };
    own.into_iter().for_each(|(key, value)| record[key] = json!(value));
    record["borne_tolerances"] = json!(borne(study, results, &sheet.design));
    folder.write(&format!("{name}.json"), format!("{record:#}\n").as_bytes())
}
