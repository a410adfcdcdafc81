//! A sizing file: operating data, materials, proportions, checked.

use super::engine::{layout, pressure};
use super::fatigue::{reliability, surface};
use super::named::{folder_of, table};
use super::ranges;
use crate::absorber::construction::shape;
use crate::absorber::{Declaration, TYPES, types};
use crate::drivetrain::throw_stiffness::ThrowFormula;
use crate::engine::{Layout, Pressure};
use crate::input::error::{At, Check, InputError, Source};
use crate::input::published::{PublishedExample, PublishedRounds};
use crate::input::schema::bounds::{
    BORE_TO_STROKE, CRANK_TO_ROD, EYE_RATIO, FRACTION_OF_EACH_MODE, FRICTION, INERTIA, LENGTH_MM, POINTS_OF_SIZING, SAFETY_FACTOR,
    TEMPERATURE_OF_STEEL,
};
use crate::input::schema::engine::RawPressure;
use crate::input::schema::sizing::{
    RawBasis, RawBending, RawGiven, RawMechanism, RawPart, RawSizedChain, RawSizing, RawSizingFront, RawTorsion,
};
use crate::input::tables;
use crate::numerics::elementary::Elementary;
use crate::sizing::{Bearings, Bending, Given, Material, Specification};
use crate::units::{M_PER_MM, PA_PER_BAR, PA_PER_MPA, W_PER_KW};
use std::f64::consts::PI;
use std::path::{Path, PathBuf};

/// A sizing file, ready to run.
#[derive(Debug, Clone)]
pub struct SizingStudy {
    /// File name without ending.
    pub name: String,
    /// For titles.
    pub title: String,
    /// What is sized.
    pub specification: Specification,
    /// Of the cylinders.
    pub layout: Layout,
    /// Ascending, rpm.
    pub speeds_rpm: Vec<f64>,
    /// Step between them, rpm.
    pub speed_step_rpm: f64,
    /// Of the chain that is written.
    pub chain: SizedChain,
    /// On the pulley.
    pub absorber: Option<SizedAbsorber>,
    /// Whether torques are those of the chain with its absorber instead of those of a rigid crank.
    pub by_response: bool,
    /// Ring inertias of a front of crank mass, kg m²; the first may be zero.
    pub front: Vec<f64>,
    /// Table of measured pressure, where there is one.
    pub pressure_file: Option<PathBuf>,
    /// Printed rounds to compare with.
    pub published: Option<Vec<PublishedRounds>>,
    /// Worked examples that the functions of sizing are compared with.
    pub examples: Vec<PublishedExample>,
    /// What is unusual about the proportions.
    pub warnings: Vec<String>,
}

/// What the chain has beside the crank.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SizedChain {
    /// kg m².
    pub pulley_inertia: f64,
    /// From the pulley to the first bearing, m.
    pub pulley_distance: f64,
    /// kg m².
    pub flywheel_inertia: f64,
    /// Of the stiffness of a throw.
    pub formula: ThrowFormula,
    /// Damping of the first elastic mode.
    pub fraction_of_critical: f64,
}

/// An absorber that is optimised on the pulley.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SizedAbsorber {
    /// Its type.
    pub kind: &'static Declaration,
    /// kg m².
    pub ring_inertia: f64,
}

/// Ratios of crank radius to rod length, and of bore to stroke, of most engines \[Fialho & Almeida 2019\] section 2.2.1.
const USUAL_CRANK_TO_ROD: (f64, f64) = (1.0 / 5.0, 1.0 / 3.0);
const USUAL_BORE_TO_STROKE: (f64, f64) = (0.75, 1.5);
/// Most speeds: each may be a load case of every round.
const MOST_SPEEDS: usize = 500;
/// Most cylinders.
const MOST_CYLINDERS: usize = 64;

/// Checks a sizing file.
///
/// # Errors
/// [`InputError`] with every mistake found.
pub(crate) fn resolve(path: &Path, source: &Source, raw: &RawSizing) -> Result<SizingStudy, InputError> {
    let mut check = Check::new(source);
    let study = study(&mut check, path, raw);
    match study {
        Some(study) if check.mistakes.is_empty() => Ok(study),
        _ => Err(InputError::sorted(check.mistakes)),
    }
}

fn study(check: &mut Check, path: &Path, raw: &RawSizing) -> Option<SizingStudy> {
    let strokes = *raw.strokes.get_ref();
    if strokes != 2 && strokes != 4 {
        check.wrong(&raw.strokes, format!("found {strokes}, expected 2 or 4 strokes in a cycle"));
        return None;
    }
    let strokes = strokes as u32;
    let folder = folder_of(path);
    let speeds_rpm = ranges::speeds_of(check, &raw.speed_rpm);
    let layout = layout(check, &raw.layout, 180.0 * f64::from(strokes));
    let pressure = pressure(check, &raw.pressure, (folder, strokes));
    if let RawPressure::Harmonics(h) = raw.pressure.get_ref() {
        check.wrong(&h.file, "found torque harmonics, expected a cylinder pressure: sections are sized by forces");
    }
    check.name(&raw.name);
    let mut warnings = Vec::new();
    let published = raw.published.as_ref().and_then(|file| table(check, file, folder, tables::published_rounds));
    let examples = raw.worked_examples.as_ref().and_then(|file| table(check, file, folder, tables::published_examples));
    let specification = specification(check, raw, (strokes, &speeds_rpm), layout.as_ref(), pressure, &mut warnings);
    let layout = layout?;
    if layout.rods_per_throw != 1 || layout.bank_angle_deg.is_some() {
        check.wrong(&raw.name, "found cylinders in a V or opposed, expected them in line: one rod on each throw");
    }
    if layout.firing_deg.len() > MOST_CYLINDERS {
        check.wrong(&raw.name, format!("found {} cylinders, expected at most {MOST_CYLINDERS}", layout.firing_deg.len()));
    }
    let by_response = *raw.torsion.get_ref() == RawTorsion::Response;
    let absorber = raw.absorber.as_ref().and_then(|a| {
        let kind = kind(check, &a.get_ref().kind)?;
        Some(SizedAbsorber { kind, ring_inertia: inertia(check, &a.get_ref().ring_inertia_kg_m2) })
    });
    if speeds_rpm.len() > MOST_SPEEDS {
        let words = format!("found {} speeds, expected at most {MOST_SPEEDS}: each may be a load case", speeds_rpm.len());
        check.wrong(&raw.speed_rpm, words);
    }
    Some(SizingStudy {
        name: path.file_stem().map_or_else(|| "sizing".into(), |s| s.to_string_lossy().into_owned()),
        title: raw.name.get_ref().clone(),
        layout,
        speed_step_rpm: *raw.speed_rpm.get_ref().step.get_ref(),
        speeds_rpm,
        chain: chain(check, &raw.chain),
        by_response,
        front: raw.front.as_ref().map_or_else(Vec::new, |f| front(check, f, raw)),
        absorber,
        pressure_file: match raw.pressure.get_ref() {
            RawPressure::Measured(m) => Some(folder.join(m.file.get_ref())),
            _ => None,
        },
        published,
        examples: examples.unwrap_or_default(),
        specification: specification?,
        warnings,
    })
}

fn kind(check: &mut Check, raw: &At<String>) -> Option<&'static Declaration> {
    // a crank that is not sized yet leaves no room to draw a damper for
    let is_ideal = |t: &&'static Declaration| shape(t).is_none();
    let found = types::find(raw.get_ref()).filter(is_ideal);
    if found.is_none() {
        let known: Vec<String> = TYPES.into_iter().filter(is_ideal).map(|t| format!("`{}`", t.name)).collect();
        check.wrong(raw, format!("found the type `{}`, expected one of {}", raw.get_ref(), known.join(", ")));
    }
    found
}

fn front(check: &mut Check, at: &At<RawSizingFront>, raw: &RawSizing) -> Vec<f64> {
    if raw.absorber.is_none() {
        check.wrong(at, "found [front] without [absorber], expected the type of absorber whose ring goes with the crank's mass");
    }
    let front = at.get_ref();
    let [low, high] = front.ring_inertia_kg_m2.get_ref().as_slice() else {
        let found = front.ring_inertia_kg_m2.get_ref().len();
        check.wrong(&front.ring_inertia_kg_m2, format!("found {found} values, expected two: the smallest and the largest ring inertia"));
        return Vec::new();
    };
    let (a, b) = (inertia(check, low), inertia(check, high));
    if b <= a {
        check.wrong(&front.ring_inertia_kg_m2, format!("found {a} and {b}, expected the smaller inertia first"));
    }
    let points = check.whole(&front.points, &POINTS_OF_SIZING);
    let step = (b / a).power(1.0 / (points - 1) as f64);
    (0..points).map(|i| a * step.powi(i as i32)).collect()
}

/// A length of an engine, m.
fn length(check: &mut Check, raw: &At<f64>) -> f64 {
    check.within(raw, &LENGTH_MM) * M_PER_MM
}

/// An inertia of an engine, kg m².
fn inertia(check: &mut Check, raw: &At<f64>) -> f64 {
    check.within(raw, &INERTIA)
}

fn chain(check: &mut Check, raw: &RawSizedChain) -> SizedChain {
    SizedChain {
        pulley_inertia: inertia(check, &raw.pulley_inertia_kg_m2),
        pulley_distance: length(check, &raw.pulley_distance_mm),
        flywheel_inertia: inertia(check, &raw.flywheel_inertia_kg_m2),
        formula: raw.stiffness_formula.get_ref().0,
        fraction_of_critical: check.within(&raw.fraction_of_critical, &FRACTION_OF_EACH_MODE),
    }
}

fn material(check: &mut Check, raw: &RawPart, reliability_percent: f64) -> Material {
    let [tensile, yields, shear] =
        [&raw.tensile_strength_mpa, &raw.yield_strength_mpa, &raw.shear_yield_strength_mpa].map(|s| check.positive(s));
    if yields > tensile {
        let words = format!("found a yield strength of {yields} MPa, expected one not above the tensile strength, {tensile} MPa");
        check.wrong(&raw.yield_strength_mpa, words);
    }
    if shear > yields {
        let words = format!("found a yield strength in shear of {shear} MPa, expected one not above that in tension, {yields} MPa");
        check.wrong(&raw.shear_yield_strength_mpa, words);
    }
    Material {
        tensile: tensile * PA_PER_MPA,
        yield_strength: yields * PA_PER_MPA,
        shear_yield: shear * PA_PER_MPA,
        surface: surface(raw.surface),
        temperature_c: check.within(&raw.temperature_c, &TEMPERATURE_OF_STEEL),
        reliability_percent,
    }
}

/// Stroke and bore, m.
fn stroke(check: &mut Check, raw: &RawMechanism, (strokes, cylinders, speed_rpm): (u32, usize, f64), ratio: f64) -> f64 {
    // V = pi/4 (ratio S)² S
    let of_volume = |volume: f64| (4.0 * volume / (PI * ratio * ratio)).cube_root();
    match raw.basis.get_ref() {
        RawBasis::StrokeMm(stroke) => length(check, stroke),
        RawBasis::DisplacementCm3(volume) => of_volume(check.positive(volume) * 1e-6 / cylinders as f64),
        RawBasis::Power(p) => {
            let (power, pressure) = (check.positive(&p.power_kw) * W_PER_KW, check.positive(&p.mean_effective_pressure_bar) * PA_PER_BAR);
            let cycles_per_second = speed_rpm / 60.0 / (0.5 * f64::from(strokes));
            of_volume(power / (pressure * cycles_per_second * cylinders as f64))
        }
    }
}

fn specification(
    check: &mut Check,
    raw: &RawSizing,
    (strokes, speeds): (u32, &[f64]),
    layout: Option<&Layout>,
    pressure: Option<Pressure>,
    warnings: &mut Vec<String>,
) -> Option<Specification> {
    let m = &raw.mechanism;
    let firing_deg = layout.map_or_else(|| vec![0.0], |l| l.firing_deg.clone());
    let high = speeds[speeds.len() - 1];
    let bore_to_stroke = check.within(&m.bore_to_stroke, &BORE_TO_STROKE);
    let crank_to_rod = check.within(&m.crank_to_rod, &CRANK_TO_ROD);
    let stroke = stroke(check, m, (strokes, firing_deg.len(), high), bore_to_stroke);
    let mut warn = |x: f64, (a, b): (f64, f64), what: &str, why: &str| {
        if !(a..=b).contains(&x) {
            warnings.push(format!("{what} of {x:.3} is outside {a:.3} to {b:.3}, where most engines are: {why}"));
        }
    };
    warn(
        crank_to_rod,
        USUAL_CRANK_TO_ROD,
        "the ratio of crank radius to rod length",
        "a short rod leans more and presses the liner, a long one is heavy",
    );
    warn(
        bore_to_stroke,
        USUAL_BORE_TO_STROKE,
        "the ratio of bore to stroke",
        "gas forces, and all sections with them, grow with the square of the bore",
    );
    let reliability_percent = reliability(check, &raw.reliability_percent);
    let parts = &raw.material;
    let [pin, rod, crank] = [&parts.piston_pin, &parts.rod, &parts.crank].map(|p| material(check, p, reliability_percent));
    let b = &raw.bearings;
    let mut mm = |value: &At<f64>| length(check, value);
    let [before, after, before_flywheel, after_flywheel] =
        [&b.before_throw_mm, &b.after_throw_mm, &b.before_flywheel_mm, &b.after_flywheel_mm].map(&mut mm);
    let bearings = Bearings {
        before,
        after,
        before_flywheel,
        after_flywheel,
        flywheel_weight: check.not_negative(&b.flywheel_weight_n),
        belt_tension: check.not_negative(&b.belt_tension_n),
    };
    let factor = |check: &mut Check, value: &At<f64>| check.within(value, &SAFETY_FACTOR);
    Some(Specification {
        strokes,
        speeds_rpm: load_speeds(speeds, pressure.as_ref()),
        design_factor: factor(check, &raw.design_factor),
        buckling_factor: factor(check, &raw.buckling_factor),
        bore: bore_to_stroke * stroke,
        stroke,
        rod_length: 0.5 * stroke / crank_to_rod,
        piston_mass: check.not_negative(&m.piston_mass_kg),
        liner_friction: check.within(&m.liner_friction, &FRICTION),
        crankcase_pressure: check.not_negative(&m.crankcase_pressure_bar) * PA_PER_BAR,
        pressure: pressure?,
        firing_deg,
        pin,
        rod,
        crank,
        fillet_radius: length(check, &m.fillet_radius_mm),
        clearance: check.not_negative(&m.eye_clearance_mm) * M_PER_MM,
        least_eye_ratio: check.within(&m.least_eye_ratio, &EYE_RATIO),
        density: check.positive(&m.density_kg_m3),
        bearings,
        bending: match raw.bending {
            RawBending::OwnBearings => Bending::OwnBearings,
            RawBending::AllBearings => Bending::AllBearings,
        },
        given: given(check, &raw.given),
    })
}

/// Speeds at which loads are computed: the ends of the range, and every speed of it where the pressure depends on the speed.
fn load_speeds(speeds: &[f64], pressure: Option<&Pressure>) -> Vec<f64> {
    let (low, high) = (speeds[0], speeds[speeds.len() - 1]);
    let tabulated = pressure.map_or(&[][..], Pressure::speeds_rpm);
    if tabulated.len() < 2 {
        return if high > low { vec![low, high] } else { vec![low] };
    }
    let mut all: Vec<f64> = speeds.iter().copied().chain(tabulated.iter().copied().filter(|s| (low..=high).contains(s))).collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

fn given(check: &mut Check, raw: &RawGiven) -> Given {
    let mut mm = |value: &Option<At<f64>>| value.as_ref().map(|v| length(check, v));
    let mut given = Given {
        pin_diameter: mm(&raw.pin_diameter_mm),
        shank_thickness: mm(&raw.shank_thickness_mm),
        crankpin_diameter: mm(&raw.crankpin_diameter_mm),
        crankpin_length: mm(&raw.crankpin_length_mm),
        journal_diameter: mm(&raw.journal_diameter_mm),
        web_thickness: mm(&raw.web_thickness_mm),
        web_breadth: mm(&raw.web_breadth_mm),
        seat_diameter: mm(&raw.seat_diameter_mm),
        ..Given::default()
    };
    let mut ratio = |value: &Option<At<f64>>| value.as_ref().map(|v| check.within(v, &EYE_RATIO));
    (given.small_eye_ratio, given.big_eye_ratio) = (ratio(&raw.small_eye_ratio), ratio(&raw.big_eye_ratio));
    given
}
