//! The crank: dimensions, checked against each other.

use super::derived_chain::{self, YOUNG_MODULUS};
use crate::crankshaft::{Crank, OilBore};
use crate::drivetrain::throw_inertia::throw_unbalance;
use crate::engine::{Engine, Source};
use crate::input::error::{At, Check};
use crate::input::schema::bounds::{BEARING_STIFFNESS, SIGNED_ANGLE};
use crate::input::schema::crank::{RawCrank, RawEach};
use crate::units::{M_PER_MM, PA_PER_GPA, RAD_PER_DEG};

/// Spans add up to this, mm.
const EXACT_MM: f64 = 0.01;

/// Keys that may be marked as assumptions.
const KEYS: [&str; 18] = [
    "rod_spacing_mm",
    "pitch_mm",
    "crankpin_diameter_mm",
    "crankpin_length_mm",
    "crankpin_bore_mm",
    "crankpin_fillet_mm",
    "crankpin_recess_mm",
    "journal_diameter_mm",
    "journal_length_mm",
    "journal_bore_mm",
    "journal_fillet_mm",
    "journal_recess_mm",
    "web_thickness_mm",
    "web_breadth_mm",
    "oil_bore",
    "bearing_stiffness_n_per_m",
    "unbalance_kg_m",
    "counterweight_kg_m",
];

/// The crank, or nothing where a mistake leaves none.
pub(crate) fn resolve(check: &mut Check, raw: &At<RawCrank>, engine: &Engine) -> Option<Crank> {
    let Source::Cylinder { geometry, .. } = &engine.source else {
        check.wrong(raw, "found [crank] with torque harmonics, expected it with [geometry] and a cylinder pressure: its loads are forces");
        return None;
    };
    if engine.layout.split_pin_deg != 0.0 {
        let found = "found [crank] with split pins, expected it without: each of its throws has one plane and one crankpin";
        check.wrong_with_help(raw, found, "its studies go without [fatigue] and without objectives and limits of `margin`, too");
        return None;
    }
    let raw = raw.get_ref();
    let before = check.mistakes.len();
    let throws = engine.layout.throws();
    let positive = |check: &mut Check, value: &At<f64>| check.positive(value) * M_PER_MM;
    let optional = |check: &mut Check, value: &Option<At<f64>>| value.as_ref().map_or(0.0, |v| check.not_negative(v)) * M_PER_MM;
    let bore = |check: &mut Check, value: &Option<At<f64>>, diameter: f64| {
        let x = optional(check, value);
        if let Some(v) = value.as_ref().filter(|_| x >= diameter) {
            check.wrong(v, format!("found a bore of {} mm, expected one below the diameter, {} mm", v.get_ref(), diameter / M_PER_MM));
        }
        x
    };
    let pin_diameter = positive(check, &raw.crankpin_diameter_mm);
    let journal_diameter = positive(check, &raw.journal_diameter_mm);
    let pitches = each(check, &raw.pitch_mm, throws, "throws");
    let journal_lengths = each(check, &raw.journal_length_mm, throws + 1, "main bearings");
    let rods = engine.layout.rods_per_throw;
    let pin_length = positive(check, &raw.crankpin_length_mm);
    let mut crank = Crank {
        rods,
        rod_spacing: rod_spacing(check, raw, rods, pin_length),
        crank_radius: geometry.slider_crank.crank_radius,
        pin_diameter,
        pin_bore: bore(check, &raw.crankpin_bore_mm, pin_diameter),
        journal_diameter,
        journal_bore: bore(check, &raw.journal_bore_mm, journal_diameter),
        pin_length,
        journal_lengths,
        web_thickness: positive(check, &raw.web_thickness_mm),
        web_breadth: positive(check, &raw.web_breadth_mm),
        pin_fillet: positive(check, &raw.crankpin_fillet_mm),
        journal_fillet: positive(check, &raw.journal_fillet_mm),
        pin_recess: optional(check, &raw.crankpin_recess_mm),
        journal_recess: optional(check, &raw.journal_recess_mm),
        oil_bore: raw.oil_bore.as_ref().map(|b| OilBore {
            diameter: check.positive(&b.diameter_mm) * M_PER_MM,
            angle: b.angle_deg.as_ref().map_or(0.0, |a| check.within(a, &SIGNED_ANGLE)) * RAD_PER_DEG,
        }),
        missing_bearings: Vec::new(),
        bearing_stiffness: raw.bearing_stiffness_n_per_m.as_ref().map(|k| check.within(k, &BEARING_STIFFNESS)),
        young_modulus: raw.young_modulus_gpa.as_ref().map_or(YOUNG_MODULUS, |e| check.positive(e)) * PA_PER_GPA,
        unbalance: raw.unbalance_kg_m.as_ref().map_or(0.0, |u| check.not_negative(u))
            - raw.counterweight_kg_m.as_ref().map_or(0.0, |c| check.not_negative(c)),
        masses: raw.masses.as_ref().map(|m| derived_chain::masses(check, m)),
        stiffness_formula: raw.stiffness_formula.as_ref().map(|f| f.get_ref().0),
        assumed: Vec::new(),
    };
    if let (Some(masses), None, None) = (&crank.masses, &raw.unbalance_kg_m, &raw.counterweight_kg_m) {
        crank.unbalance = throw_unbalance(&crank.throw(0), masses);
    }
    for key in &raw.assumed {
        if !KEYS.contains(&key.get_ref().as_str()) {
            check.wrong(key, format!("found `{}`, expected a key of [crank]", key.get_ref()));
        }
        crank.assumed.push(key.get_ref().clone());
    }
    missing(check, raw, throws, &mut crank);
    proportions(check, raw, &crank);
    if check.mistakes.len() == before {
        spans(check, raw, &pitches, &crank);
    }
    (check.mistakes.len() == before).then_some(crank)
}

/// Margins depend on the counterweights: they are given, or said to be assumed away.
pub(super) fn check_counterweights(check: &mut Check, crank: &At<RawCrank>, engine: &Engine) {
    let raw = crank.get_ref();
    let of_drawing = raw.masses.as_ref().is_some_and(|m| m.counterweight.is_some());
    if of_drawing || raw.counterweight_kg_m.is_some() || raw.assumed.iter().any(|key| key.get_ref() == "counterweight_kg_m") {
        return;
    }
    let Source::Cylinder { geometry, .. } = &engine.source else { return };
    let rods = engine.layout.rods_per_throw as f64;
    let balanced = rods * geometry.rod_rotating_fraction() * geometry.rod_mass * geometry.slider_crank.crank_radius;
    check.wrong_with_help(
        crank,
        "found a crank without `counterweight_kg_m` in a study of its margins, expected its moment a throw, or its name in `assumed` where there is none",
        format!("{balanced:.4} kg m would balance the rotating mass of the rods; beside `unbalance_kg_m` of pin and webs"),
    );
}

/// Distance between the rods on a pin: side by side unless the file says otherwise.
fn rod_spacing(check: &mut Check, raw: &RawCrank, rods: usize, pin_length: f64) -> f64 {
    let Some(given) = &raw.rod_spacing_mm else { return if rods > 1 { pin_length / rods as f64 } else { 0.0 } };
    let spacing = check.not_negative(given) * M_PER_MM;
    if rods == 1 {
        check.wrong(given, "found a distance between rods with one rod on a throw, expected it for a V only");
    } else if spacing >= pin_length {
        check.wrong(
            given,
            format!("found {} mm between the rods, expected less than the crankpin is long, {} mm", given.get_ref(), pin_length / M_PER_MM),
        );
    }
    spacing
}

/// One value for all, or one each.
fn each(check: &mut Check, raw: &RawEach, count: usize, of: &str) -> Vec<f64> {
    match raw {
        RawEach::All(value) => vec![check.positive(value) * M_PER_MM; count],
        RawEach::Each(list) => {
            if list.get_ref().len() != count {
                check.wrong(list, format!("found {} values, expected one for each of the {count} {of}", list.get_ref().len()));
            }
            let values: Vec<f64> = list.get_ref().iter().map(|v| check.positive(v) * M_PER_MM).collect();
            // a mistake stops the study: the missing values are never used
            values.into_iter().chain(std::iter::repeat(M_PER_MM)).take(count).collect()
        }
    }
}

/// Dimensions that no crank has, whatever the formulas.
fn proportions(check: &mut Check, raw: &RawCrank, crank: &Crank) {
    let mut below = |value: Option<&At<f64>>, x: f64, most: f64, what: &str, of: &str| {
        if let Some(v) = value.filter(|_| x >= most) {
            check.wrong(v, format!("found {what} of {} mm, expected less than {of}, {} mm", v.get_ref(), most / M_PER_MM));
        }
    };
    let (pin, journal, web) = (0.5 * crank.pin_diameter, 0.5 * crank.journal_diameter, 0.5 * crank.web_thickness);
    below(Some(&raw.crankpin_fillet_mm), crank.pin_fillet, pin, "a fillet", "half the crankpin's diameter");
    below(Some(&raw.journal_fillet_mm), crank.journal_fillet, journal, "a fillet", "half the journal's diameter");
    below(raw.crankpin_recess_mm.as_ref(), crank.pin_recess, web, "a recess", "half the web");
    below(raw.journal_recess_mm.as_ref(), crank.journal_recess, web, "a recess", "half the web");
    if let (Some(raw), Some(bore)) = (&raw.oil_bore, crank.oil_bore) {
        below(Some(&raw.diameter_mm), bore.diameter, pin, "a bore", "half the crankpin's diameter");
    }
}

fn missing(check: &mut Check, raw: &RawCrank, throws: usize, crank: &mut Crank) {
    for bearing in &raw.missing_bearings {
        let number = *bearing.get_ref();
        match usize::try_from(number - 1).ok().filter(|b| *b <= throws) {
            None => check.wrong(bearing, format!("found bearing {number}, expected a number from 1 to {}", throws + 1)),
            Some(b) if b == 0 || b == throws => {
                let throw = if b == 0 { 1 } else { throws };
                check.wrong(
                    bearing,
                    format!("found throw {throw} without a bearing on its outer side, expected bearings at both ends of the crank"),
                );
            }
            Some(b) if crank.missing_bearings.contains(&b) => check.wrong(bearing, format!("found bearing {number} a second time")),
            Some(b) => crank.missing_bearings.push(b),
        }
    }
}

fn spans(check: &mut Check, raw: &RawCrank, pitches: &[f64], crank: &Crank) {
    for (throw, pitch) in pitches.iter().enumerate() {
        let sum = crank.pitch(throw) / M_PER_MM;
        let given = pitch / M_PER_MM;
        if (given - sum).abs() <= EXACT_MM {
            continue;
        }
        let words = format!(
            "found a pitch of {given} mm for throw {}, expected {sum:.2} mm: crankpin, two webs and half a journal on each side add up to it",
            throw + 1
        );
        match &raw.pitch_mm {
            RawEach::All(value) => {
                check.wrong(value, words);
                return;
            }
            RawEach::Each(list) => check.wrong(&list.get_ref()[throw], words),
        }
    }
}

/// Keys of dimensions outside the ranges of the formulas for stress concentration, reported where they stand.
pub(crate) fn check_ranges(check: &mut Check, raw: &RawCrank, crank: &Crank) {
    for out in crank.notch().out_of_range() {
        let (low, high) = out.range;
        let at = match out.name {
            "web thickness" => &raw.web_thickness_mm,
            "web breadth" => &raw.web_breadth_mm,
            "crankpin fillet" => &raw.crankpin_fillet_mm,
            "journal fillet" => &raw.journal_fillet_mm,
            "crankpin bore" => raw.crankpin_bore_mm.as_ref().unwrap_or(&raw.crankpin_diameter_mm),
            "journal bore" => raw.journal_bore_mm.as_ref().unwrap_or(&raw.journal_diameter_mm),
            "oil bore" => raw.oil_bore.as_ref().map_or(&raw.crankpin_diameter_mm, |b| &b.diameter_mm),
            _ => &raw.crankpin_diameter_mm,
        };
        let expected = if low.is_finite() { format!("from {low} to {high}") } else { format!("up to {high}") };
        let words = format!(
            "found {:.4} crankpin diameters as {}, expected {expected}: the formulas of IACS UR M53 and FVV hold there only",
            out.value, out.name
        );
        check.wrong_with_help(at, words, "give the study's fillets `factors.given`, and leave `iacs_m53` out of its criteria");
    }
}
