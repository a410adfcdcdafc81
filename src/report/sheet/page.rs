//! The page: what stands on it, and where.

use super::agreed::agreed;
use super::block::{Block, row};
use super::canvas::Canvas;
use super::section;
use crate::absorber::Medium;
use crate::analysis::{DesignResult, Results, Sheet};
use crate::input::Study;
use crate::objective::{Condition, holds};
use crate::optimise::Scatter;
use crate::text::allocation::borne;
use crate::text::limits::worth;
use crate::text::order_sheets::{accepted, holding, megapascal, outside, sentence};
use crate::text::prices;
use crate::text::scattered;
use crate::text::table::significant;
use crate::units::{DEG_PER_RAD, of_key};

/// Units of the page: those of CSS.
pub(super) const UNITS_PER_INCH: f32 = 96.0;
/// A4.
const WIDTH: f64 = 793.7;
const HEIGHT: f64 = 1122.5;
/// Edge of the page.
const EDGE: f64 = 45.0;
/// Height of a line of text.
const LINE: f64 = 14.0;
/// Limits that have room.
const MOST_LIMITS: usize = 12;
/// Width of a letter of a table, with room to spare.
const LETTER: f64 = 5.2;
/// Letters of a sentence in a line of the whole width.
const LETTERS: usize = 118;

/// A sentence in lines of at most so many letters.
fn wrapped(words: &str, letters: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in words.split(' ') {
        match lines.last_mut() {
            Some(last) if last.is_empty() => last.push_str(word),
            Some(last) if last.chars().count() + 1 + word.chars().count() <= letters => *last += &format!(" {word}"),
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// The page of a damper.
pub(super) fn of(study: &Study, results: &Results, sheet: &Sheet) -> String {
    let mut page = Canvas::default();
    let design = results.designs.iter().chain(results.optima.iter().map(|o| &o.design)).find(|d| d.name == sheet.design);
    let medium = sheet.shape.medium;
    let mut y = EDGE + 14.0;
    page.text((EDGE, y), 18.0, &format!("Torsional vibration damper for {}", study.engine.name), true);
    y += 18.0;
    page.text((EDGE, y), 10.0, &format!("Design {} of study {}; hartog {}", sheet.design, study.name, env!("CARGO_PKG_VERSION")), false);
    y += 20.0;
    for line in wrapped(&sentence(study, results, sheet), LETTERS) {
        page.text((EDGE, y), 11.0, &line, true);
        y += 15.0;
    }
    for line in outside(sheet) {
        page.text((EDGE, y), 10.0, &format!("OUTSIDE: {line}"), true);
        y += LINE;
    }
    y += 6.0;
    let half = 0.5 * (WIDTH - 2.0 * EDGE);
    section::draw(&mut page, sheet, (EDGE, y, half - 10.0, 330.0));
    let mut right = y + 6.0;
    for block in [dimensions(sheet), parts(sheet, medium)] {
        right = put_block(&mut page, (EDGE + half + 10.0, right), half - 10.0, &block);
    }
    y = right.max(y + 345.0) + 4.0;
    let mut columns = [y, y];
    let blocks = [stiffness(sheet, medium), loads(sheet), acceptance(sheet), made(study, results, (sheet, medium)), agreed(study, sheet)];
    for (i, block) in blocks.iter().filter(|b| !b.rows.is_empty()).enumerate() {
        let column = i % 2;
        let x = EDGE + column as f64 * (half + 10.0);
        columns[column] = put_block(&mut page, (x, columns[column]), half - 10.0, block);
    }
    y = columns[0].max(columns[1]);
    if let Some(d) = design {
        y = put_block(&mut page, (EDGE, y), WIDTH - 2.0 * EDGE, &limits(study, results, d));
    }
    let optimum = results.optima.iter().find(|o| o.design.name == sheet.design);
    if let Some(costs) = optimum.and_then(|o| prices::line(study, results, o)) {
        for line in wrapped(costs.trim_start(), LETTERS) {
            page.text((EDGE, y), 9.5, &line, false);
            y += LINE;
        }
    }
    page.text((EDGE, y + 10.0), 11.0, "Assumptions", true);
    y += 24.0;
    let lines: Vec<String> = assumptions(sheet).iter().flat_map(|a| wrapped(a, 135)).collect();
    let room = ((HEIGHT - EDGE - 58.0 - y) / 12.0).max(1.0) as usize;
    for (i, line) in lines.iter().enumerate().take(room) {
        let cut = i + 1 == room && lines.len() > room;
        page.text((EDGE, y), 9.0, if cut { "… and more: the .json beside this page has all sources" } else { line }, false);
        y += 12.0;
    }
    title_block(&mut page);
    page.svg((WIDTH, HEIGHT))
}

/// A table; returns where it ends.
fn put_block(page: &mut Canvas, (x, mut y): (f64, f64), width: f64, block: &Block) -> f64 {
    y += 10.0;
    page.text((x, y), 11.0, block.title, true);
    y += 4.0;
    page.line((x, y), (x + width, y), "");
    y += 12.0;
    for (name, value) in &block.rows {
        page.text((x, y), 9.5, name, false);
        // what has no room beside its name stands below it
        let letters = (width / LETTER) as usize;
        let beside = name.chars().count() + value.chars().count() < letters;
        if !beside {
            y += LINE - 1.0;
        }
        for line in if beside { vec![value.clone()] } else { wrapped(value, letters) } {
            page.anchored((x + width, y), 9.5, &line, (false, "end"));
            y += LINE - 1.0;
        }
    }
    y + 4.0
}

/// Boxes that the maker fills in.
fn title_block(page: &mut Canvas) {
    let names = ["Drawn", "Checked", "Date", "Drawing number", "Revision", "Maker"];
    let (top, each) = (HEIGHT - EDGE - 40.0, (WIDTH - 2.0 * EDGE) / names.len() as f64);
    for (i, name) in names.iter().enumerate() {
        let x = EDGE + i as f64 * each;
        page.rectangle((x, top, each, 40.0), "#ffffff");
        page.text((x + 4.0, top + 11.0), 8.0, name, false);
    }
}

fn dimensions(sheet: &Sheet) -> Block {
    let declared = sheet.shape.declaration.parameters;
    let one = |(key, value): &(&'static str, f64)| {
        let about = declared.iter().find(|p| p.key == *key).map_or(*key, |p| p.about.trim_end_matches('.'));
        let about = about.split(':').next().unwrap_or(about);
        let unit = of_key(key).map_or_else(String::new, |unit| format!(" {unit}"));
        row(about, format!("{}{unit}", significant(*value, 5)))
    };
    let p = &sheet.parts;
    let mut rows: Vec<_> = sheet.dimensions.iter().map(one).collect();
    rows.push(row("Width of the ring", mm(p.ring_width)));
    rows.push(row("Width of all", mm(p.width)));
    rows.push(row("Free diameter inside", mm(p.bore)));
    Block { title: "Dimensions", rows }
}

fn parts(sheet: &Sheet, medium: Medium) -> Block {
    let p = &sheet.parts;
    let kg = |x: f64| format!("{} kg", significant(x, 4));
    let moved = if medium == Medium::Field { "Masses together" } else { "Ring" };
    let mut rows = vec![row(moved, format!("{}, {} kg m²", kg(p.ring_mass), significant(sheet.ring_inertia, 5)))];
    if p.hub_mass > 0.0 {
        rows.push(row("Housing", format!("{}, {} kg m²", kg(p.hub_mass), significant(p.hub_inertia, 5))));
    }
    let name = sheet.substance.as_ref().map_or_else(|| "not named".to_owned(), |s| format!("{} ({})", s.name, s.about));
    match medium {
        Medium::Rubber => {
            rows.push(row("Compound", name));
            rows.extend(sheet.substance.as_ref().map(|s| row("Hardness", format!("{} Shore A", s.grade))));
            rows.extend(sheet.sheared_mass.map(|m| row("Rubber", kg(m))));
        }
        Medium::Oil => {
            rows.push(row("Oil", name));
            rows.extend(sheet.substance.as_ref().map(|s| row("Viscosity at 25 °C", format!("{} mm²/s", s.grade))));
            let litres = significant(p.element_volume * 1e3, 4);
            rows.extend(sheet.sheared_mass.map(|m| row("Volume of oil", format!("{litres} l ({})", kg(m)))));
        }
        Medium::Leaves => {
            rows.push(row("Width of a leaf", mm(p.element_length)));
            rows.push(row("Radius of the slots", mm(p.radius)));
            rows.extend(sheet.spring_mass.map(|m| row("Leaves together", kg(m))));
        }
        Medium::Coils => {
            rows.push(row("Outer diameter of a coil", mm(p.element_length)));
            rows.push(row("Radius of the axes of the springs", mm(p.radius)));
            rows.extend(sheet.spring_mass.map(|m| row("Springs together", kg(m))));
        }
        Medium::Field => rows.extend(sheet.swing.into_iter().flat_map(|s| {
            [
                row("Each mass", kg(s.each)),
                row("Radius of its centre", mm(s.centre_radius)),
                row("About their own centres, with the hub", format!("{} kg m²", significant(p.hub_inertia, 4))),
            ]
        })),
    }
    rows.push(row("All together", kg(sheet.mass)));
    Block { title: "Parts", rows }
}

/// A length.
fn mm(x: f64) -> String {
    format!("{} mm", significant(x * 1e3, 4))
}

fn stiffness(sheet: &Sheet, medium: Medium) -> Block {
    let mut rows = Vec::new();
    rows.extend(sheet.static_stiffness.map(|k| row("Static stiffness", format!("{} N m/rad", significant(k, 5)))));
    rows.extend(sheet.damping.map(|c| row("Damping at low speed", format!("{} N m s/rad", significant(c, 5)))));
    rows.extend(sheet.swing.map(|s| row("Tuned to the order", significant(s.tuning_order, 5))));
    if let Some(own) = sheet.on_held_hub.filter(|_| medium == Medium::Rubber || medium.is_spring()) {
        rows.push(row("Ring on its held hub, at the reference", format!("{} Hz", significant(own.frequency_hz, 5))));
        rows.push(row("Loss factor there", significant(own.loss_factor, 3)));
    }
    for p in &sheet.at_peak {
        let name = if p.condition == Condition::Firing { "reference".to_owned() } else { p.condition.name().replace('_', " ") };
        let k = format!("{} N m/rad, loss factor {}", significant(p.stiffness, 4), significant(p.loss_factor, 3));
        rows.push(row(&format!("At {} Hz, {name}", significant(p.frequency_hz, 4)), k));
    }
    Block { title: "Dynamic stiffness", rows }
}

fn loads(sheet: &Sheet) -> Block {
    let p = &sheet.parts;
    let radius = 0.5 * p.outer_diameter;
    // both faces and the rim
    let surface = 2.0 * std::f64::consts::PI * radius * (radius + p.width);
    let is_spring = sheet.shape.medium.is_spring();
    let mut rows = Vec::new();
    rows.extend(sheet.strain.map(|s| row("Largest shear strain, worst of the conditions", format!("{} %", significant(100.0 * s, 3)))));
    let of_stress = if is_spring { "Largest stress of the springs, worst of the conditions" } else { "Shear stress of it at the stiffest" };
    rows.extend(sheet.stress.map(|s| row(of_stress, format!("{} MPa", megapascal(s)))));
    rows.extend(sheet.swing.into_iter().flat_map(|s| {
        [
            row("Largest arc to each side, worst of the conditions", mm(s.arc)),
            row("Angle of the path", format!("{}°", significant(s.angle * DEG_PER_RAD, 3))),
            row("Radius that its corners come to", mm(s.reach)),
        ]
    }));
    rows.push(row("Largest heat, worst of the conditions", format!("{} W", significant(sheet.power, 4))));
    rows.push(row("Over its own surface", format!("{} W/m²", significant(sheet.power / surface, 4))));
    rows.extend(sheet.celsius.map(|c| {
        row("Highest temperature in operation", if c.is_finite() { format!("{} °C", significant(c, 4)) } else { "overheats".into() })
    }));
    rows.extend(sheet.substance.as_ref().map(|s| row("What the material bears", format!("{} °C", significant(s.limit, 4)))));
    let title = match sheet.shape.medium {
        Medium::Rubber | Medium::Oil => "Strain and heat",
        Medium::Leaves | Medium::Coils => "Stress and heat",
        Medium::Field => "Swing and heat",
    };
    Block { title, rows }
}

fn acceptance(sheet: &Sheet) -> Block {
    let Some(band) = &sheet.acceptance else { return Block { title: "Acceptance test", rows: Vec::new() } };
    let what = match band.of {
        crate::analysis::sheets::Measured::FrequencyHz => "Own frequency of the ring, hub held, at the reference",
        crate::analysis::sheets::Measured::DampingNMSPerRad => "Braking torque over slow speed",
    };
    let mut rows = vec![row(what, String::new()), row("accepted", accepted(band)), row("as drawn", significant(band.drawn, 5))];
    rows.extend(sheet.substance.as_ref().map(|s| row("at", format!("{} °C", significant(s.temperature.reference(), 3)))));
    Block { title: "Acceptance test", rows }
}

fn made(study: &Study, results: &Results, (sheet, medium): (&Sheet, Medium)) -> Block {
    let mut rows = Vec::new();
    if let Some(spec) = &study.robust {
        let own = |s: &&Scatter| match s {
            Scatter::Share(key, _) | Scatter::Amount(key, _) => sheet.dimensions.iter().any(|d| d.0 == *key),
            Scatter::Hardness(_) => medium == Medium::Rubber,
            Scatter::Viscosity(_) => medium == Medium::Oil,
            Scatter::Temperature(_) => sheet.substance.is_some(),
        };
        rows.extend(spec.scatter().iter().filter(own).map(|s| row("Tolerance", scattered(s))));
    }
    rows.extend(borne(study, results, &sheet.design).into_iter().map(|t| row("What the limits bear", t)));
    if let Some(h) = &sheet.holding {
        rows.push(row("Yield: limits hold, but those on sizes", holding(h)));
        rows.extend(h.broken.map(|l| row("broken most", study.limits[l].words.clone())));
    }
    Block { title: "As made", rows }
}

fn limits(study: &Study, results: &Results, d: &DesignResult) -> Block {
    let optimum = results.optima.iter().find(|o| o.design.name == d.name && o.conflict.is_none());
    let one = |(i, (limit, ratio)): (usize, (&crate::input::LimitSpec, &f64))| {
        let verdict = if holds(*ratio) { "holds" } else { "FAILS" };
        let used = match (ratio.is_finite(), limit.of.measure.within.factors.is_empty()) {
            (false, _) => format!("{verdict}: no value"),
            (true, false) => format!("{verdict}: {:.1} % used", 100.0 * ratio),
            (true, true) => {
                let value = limit.of.unit.shown(ratio * limit.limit);
                format!("{verdict}: {}{}, {:.1} % used", significant(value, 4), limit.of.unit.suffix(), 100.0 * ratio)
            }
        };
        let worth = optimum.and_then(|o| worth(limit, o.prices[i])).map_or_else(String::new, |worth| format!("; {worth}"));
        row(&limit.words, used + &worth)
    };
    let mut rows: Vec<_> = study.limits.iter().zip(&d.limits).enumerate().map(one).collect();
    if rows.len() > MOST_LIMITS {
        let more = rows.split_off(MOST_LIMITS).len();
        rows.push(row(&format!("and {more} more, in limits.csv"), String::new()));
    }
    Block { title: "Limits, in the conditions of the study", rows }
}

/// What is left out of a drawing.
fn of_drawing(medium: Medium) -> &'static str {
    match medium {
        Medium::Rubber | Medium::Oil => {
            "The inertia of what is sheared is left out; sections are rectangular, without fillets; the hub that carries it is another part."
        }
        Medium::Leaves => {
            "Leaves are beams of small deflection, clamped in the hub, their ends guided in slots of the ring without friction; stress concentration at the clamp, centrifugal force and the inertia of the leaves are left out; the hub is another part."
        }
        Medium::Coils => {
            "No spring comes loose: what they are set by is not in the stress, which is that of the twist, with Wahl's factor of curvature; friction at the ring, centrifugal force and the inertia of the springs are left out; the hub is another part."
        }
        Medium::Field => {
            "Masses are sectors without bores for their rollers, whose inertia is left out; each moves along its path without turning, all in step, by the law of small swing; gravity is left out; the hub is another part."
        }
    }
}

fn assumptions(sheet: &Sheet) -> Vec<String> {
    let mut list = vec![of_drawing(sheet.shape.medium).to_owned()];
    if let Some(s) = &sheet.substance {
        let assumed: Vec<&str> = s.assumed().collect();
        if !assumed.is_empty() {
            list.push(format!("Of {} these numbers are assumptions of its table: {}.", s.name, assumed.join(", ")));
        }
        if let (Some(kraus), Some(strain)) = (&s.amplitude, sheet.strain) {
            let (storage, loss) = kraus.factors(strain.max(1e-6));
            list.push(format!(
                "The modulus is that at a strain of {} %; at {} % it would be {} times as large, the loss modulus {} times (Payne effect).",
                significant(100.0 * kraus.reference, 3),
                significant(100.0 * strain, 3),
                significant(storage, 3),
                significant(loss, 3)
            ));
        }
    }
    list
}
