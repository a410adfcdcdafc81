//! A damper by its dimensions in one sentence, and the lines of its order sheet.

use super::judged::value_of;
use super::table::significant;
use crate::absorber::substance::Outside;
use crate::absorber::{HOUSING, SLEEVE, Sheared};
use crate::analysis::sheets::{Band, Holding, Measured};
use crate::analysis::{Results, Sheet};
use crate::input::Study;
use crate::objective::holds;
use crate::units::{M_PER_MM, PA_PER_MPA};

/// A compound or an oil by its name, with its grade.
fn named(sheet: &Sheet) -> String {
    match (&sheet.substance, sheet.shape.sheared) {
        (Some(s), Sheared::Rubber) => format!("{} ({} Shore A)", s.name, s.grade),
        (Some(s), Sheared::Oil) => format!("{} ({} mm²/s)", s.name, s.grade),
        (None, Sheared::Rubber) => "rubber".to_owned(),
        (None, Sheared::Oil) => "silicone oil".to_owned(),
    }
}

pub(crate) fn mm(x: f64) -> String {
    significant(x / M_PER_MM, 4)
}

/// A dimension by its key, mm as it is declared.
fn dimension(sheet: &Sheet, key: &str) -> f64 {
    sheet.dimensions.iter().find(|d| d.0 == key).map_or(0.0, |d| d.1)
}

/// Its sizes: "sleeve 152 x 6.5 x 48 mm" by mean diameter, thickness and length.
fn sizes(sheet: &Sheet) -> String {
    let p = &sheet.parts;
    match sheet.shape.declaration {
        kind if kind == &SLEEVE => {
            let thickness = dimension(sheet, "rubber_thickness_mm");
            let mean = p.bore / M_PER_MM + thickness;
            format!("sleeve {} x {} x {} mm", significant(mean, 4), significant(thickness, 3), mm(p.sheared_length))
        }
        kind if kind == &HOUSING => format!(
            "housing {} x {} mm, gaps {} and {} mm",
            mm(p.outer_diameter),
            mm(p.width),
            significant(dimension(sheet, "radial_gap_mm"), 3),
            significant(dimension(sheet, "axial_gap_mm"), 3)
        ),
        _ => format!("{} {} x {} x {} mm", sheet.kind, mm(2.0 * p.ring[0]), mm(2.0 * p.ring[1]), mm(p.sheared_length)),
    }
}

/// The share that holds all limits, with its interval.
pub(crate) fn holding(h: &Holding) -> String {
    let percent = |x: f64| significant(100.0 * x, 4);
    format!("{} % (95 %: {} to {} %)", percent(h.share), percent(h.between.0), percent(h.between.1))
}

/// The band of the acceptance test.
pub(crate) fn accepted(band: &Band) -> String {
    let unit = match band.of {
        Measured::FrequencyHz => "Hz",
        Measured::DampingNMSPerRad => "N m s/rad",
    };
    match band.between {
        Some((low, high)) => {
            let farther = match band.open {
                (false, false) => "",
                (true, false) => " (less was not looked at)",
                (false, true) => " (more was not looked at)",
                (true, true) => " (beyond it was not looked at)",
            };
            format!("{} to {} {unit}{farther}", significant(low, 4), significant(high, 4))
        }
        None => format!("none: {} {unit} as drawn does not hold all limits with the scatter of the rest", significant(band.drawn, 4)),
    }
}

/// What of a use is outside of where the numbers of its compound or oil hold.
pub(crate) fn outside(sheet: &Sheet) -> Vec<String> {
    let name = sheet.substance.as_ref().map_or("", |s| s.name.as_str());
    let words = |o: &Outside| match o {
        Outside::Frequency(hz) => format!("{} Hz is outside the frequencies at which the numbers of {name} hold", significant(*hz, 4)),
        Outside::Temperature(t) => format!("{} °C is outside the temperatures at which the numbers of {name} hold", significant(*t, 3)),
        Outside::Strain(s) => format!("a strain of {} % is above that up to which the numbers of {name} hold", significant(100.0 * s, 3)),
    };
    sheet.outside.iter().map(words).collect()
}

/// The damper in one sentence.
pub(crate) fn sentence(study: &Study, results: &Results, sheet: &Sheet) -> String {
    let Some(d) = results.designs.iter().chain(results.optima.iter().map(|o| &o.design)).find(|d| d.name == sheet.design) else {
        return String::new();
    };
    let of = &study.objective;
    let judged = results.judged(d).map_or_else(String::new, |j| value_of(of, j.value));
    let none = results.bare.first().copied().flatten().map_or_else(String::new, |v| format!(" (none {})", value_of(of, v)));
    let mut parts = vec![format!("{}, {}, ring {} kg: {judged}{none}", named(sheet), sizes(sheet), significant(sheet.parts.ring_mass, 3))];
    parts.push(format!("{} W", significant(sheet.power, 3)));
    parts.extend(sheet.celsius.map(|c| if c.is_finite() { format!("{} °C", significant(c, 3)) } else { "overheats".to_owned() }));
    let what = if sheet.shape.sheared == Sheared::Oil { "shear of the oil" } else { "strain" };
    parts.push(format!("{what} {} %", significant(100.0 * sheet.strain, 3)));
    let broken: Vec<&str> = study.limits.iter().zip(&d.limits).filter(|(_, r)| !holds(**r)).map(|(l, _)| l.words.as_str()).collect();
    if !study.limits.is_empty() {
        parts.push(if broken.is_empty() { "holds all limits".to_owned() } else { format!("FAILS {}", broken.join("; ")) });
    }
    let mut text = parts.join(", ");
    if let Some(h) = &sheet.holding {
        text.push_str(&format!("; yield {}", holding(h)));
    }
    if let Some(band) = &sheet.acceptance {
        text.push_str(&format!("; accept {}", accepted(band)));
    }
    text
}

/// Stress in MPa.
pub(crate) fn megapascal(stress: f64) -> String {
    significant(stress / PA_PER_MPA, 3)
}
