//! A damper by its dimensions in one sentence, and the lines of its order sheet.

use super::judged::value_of;
use super::table::significant;
use crate::absorber::substance::Outside;
use crate::absorber::{Medium, SLEEVE};
use crate::analysis::sheets::{Band, Holding, Measured};
use crate::analysis::{Results, Sheet};
use crate::input::Study;
use crate::objective::holds;
use crate::units::{DEG_PER_RAD, M_PER_MM, PA_PER_MPA};

/// What carries the ring: a compound or an oil by its name, with its grade.
fn named(sheet: &Sheet) -> String {
    let grade = |unit: &str| sheet.substance.as_ref().map(|s| format!("{} ({} {unit})", s.name, s.grade));
    match sheet.shape.medium {
        Medium::Rubber => grade("Shore A").unwrap_or_else(|| "rubber".to_owned()),
        Medium::Oil => grade("mm²/s").unwrap_or_else(|| "silicone oil".to_owned()),
        Medium::Leaves | Medium::Coils => "springs of steel".to_owned(),
        Medium::Field => "centrifugal pendulums".to_owned(),
    }
}

pub(crate) fn mm(x: f64) -> String {
    significant(x / M_PER_MM, 4)
}

/// A dimension by its key, mm as it is declared.
fn dimension(sheet: &Sheet, key: &str) -> f64 {
    sheet.dimensions.iter().find(|d| d.0 == key).map_or(0.0, |d| d.1)
}

/// How many: whole numbers as they are.
fn count(x: f64) -> String {
    if x.fract() == 0.0 { x.to_string() } else { significant(x, 3) }
}

/// Its sizes: "sleeve 152 x 6.5 x 48 mm" by mean diameter, thickness and length.
fn sizes(sheet: &Sheet) -> String {
    let p = &sheet.parts;
    let of = |key: &str, digits: i32| significant(dimension(sheet, key), digits);
    match sheet.shape.medium {
        Medium::Oil => format!(
            "housing {} x {} mm, gaps {} and {} mm",
            mm(p.outer_diameter),
            mm(p.width),
            of("radial_gap_mm", 3),
            of("axial_gap_mm", 3)
        ),
        Medium::Rubber if sheet.shape.declaration == &SLEEVE => {
            let thickness = dimension(sheet, "rubber_thickness_mm");
            let mean = p.bore / M_PER_MM + thickness;
            format!("sleeve {} x {} x {} mm", significant(mean, 4), significant(thickness, 3), mm(p.element_length))
        }
        Medium::Rubber => format!("{} {} x {} x {} mm", sheet.kind, mm(2.0 * p.ring[0]), mm(2.0 * p.ring[1]), mm(p.element_length)),
        Medium::Leaves => {
            format!(
                "{} leaves {} x {} x {} mm",
                count(dimension(sheet, "springs")),
                of("leaf_length_mm", 4),
                of("leaf_thickness_mm", 3),
                mm(p.element_length)
            )
        }
        Medium::Coils => format!(
            "{} coil springs of {} mm wire, {} mm outside, {} active coils",
            count(dimension(sheet, "springs")),
            of("wire_diameter_mm", 3),
            mm(p.element_length),
            count(dimension(sheet, "active_coils"))
        ),
        Medium::Field => sheet.swing.map_or_else(String::new, |s| {
            format!(
                "{} masses of {} kg at {} mm, paths of {} mm, order {}",
                count(dimension(sheet, "masses")),
                significant(s.each, 3),
                mm(s.centre_radius),
                of("path_radius_mm", 4),
                significant(s.tuning_order, 4)
            )
        }),
    }
}

/// What of it moves against the hub.
fn moved(sheet: &Sheet) -> &'static str {
    if sheet.shape.medium == Medium::Field { "together" } else { "ring" }
}

/// What its twist makes in it.
fn borne_by_it(sheet: &Sheet) -> Option<String> {
    let strain = sheet.strain.map(|s| format!("{} %", significant(100.0 * s, 3)));
    match sheet.shape.medium {
        Medium::Rubber => strain.map(|s| format!("strain {s}")),
        Medium::Oil => strain.map(|s| format!("shear of the oil {s}")),
        Medium::Leaves | Medium::Coils => sheet.stress.map(|s| format!("stress of the springs {} MPa", megapascal(s))),
        Medium::Field => sheet.swing.map(|s| format!("swing {} mm, {}°", mm(s.arc), significant(s.angle * DEG_PER_RAD, 3))),
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
    let mut parts =
        vec![format!("{}, {}, {} {} kg: {judged}{none}", named(sheet), sizes(sheet), moved(sheet), significant(sheet.parts.ring_mass, 3))];
    parts.push(format!("{} W", significant(sheet.power, 3)));
    parts.extend(sheet.celsius.map(|c| if c.is_finite() { format!("{} °C", significant(c, 3)) } else { "overheats".to_owned() }));
    parts.extend(borne_by_it(sheet));
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
