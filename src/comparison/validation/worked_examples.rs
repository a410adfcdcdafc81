//! Worked examples of books and of a CAD model, by the functions that size a slider-crank: from their printed inputs to their printed results.

use super::uncertainty::half_digit;
use crate::fatigue::endurance::{Endurance, Loading, Surface, estimated_limit, fatigue_factor, notch_sensitivity};
use crate::input::published::PublishedExample;
use crate::numerics::elementary::Elementary;
use crate::sizing::section::{Moments, Notch, Strength, Swing};
use crate::sizing::{Bearings, Bending, Sizes, bodies, crank, rod, stepped_shaft};
use crate::units::{M_PER_IN, M_PER_MM, PA_PER_MPA};

/// kg in a g, and kg m² in a g mm².
const KG_PER_G: f64 = 1e-3;
const KG_M2_PER_G_MM2: f64 = 1e-9;
/// Density that the CAD model's masses follow from, kg/m³: assumption.
const DENSITY: f64 = 7800.0;
/// Length of the CAD model's journals, mm, that its masses follow from: assumption.
const CAD_JOURNAL_MM: f64 = 17.5;
/// Web of a crank over its crankpin: thickness and breadth \[Bhandari 2010\] section 25.
const WEB: [f64; 2] = [0.7, 1.14];

/// A result beside ours.
#[derive(Debug, Clone, PartialEq)]
pub struct ExampleRow {
    /// Number of the table.
    pub table: String,
    /// The example.
    pub example: String,
    /// What it is.
    pub quantity: String,
    /// Its unit.
    pub unit: String,
    /// Of the book or the CAD model.
    pub book: f64,
    /// Of the publication's own program; `None` where it prints none.
    pub program: Option<f64>,
    /// Ours; `None` where an input is missing or no function of ours gives it.
    pub computed: Option<f64>,
    /// Half of the last digit of the book.
    pub half_digit: f64,
    /// What a reader should know.
    pub note: &'static str,
}

impl ExampleRow {
    /// (computed - book)/book, per cent; `None` without ours.
    pub fn deviation_percent(&self) -> Option<f64> {
        self.computed.map(|computed| 100.0 * (computed / self.book - 1.0))
    }
}

/// Inputs of an example by name: numbers in their printed units, and words.
struct Inputs<'a>(Vec<&'a PublishedExample>);

impl Inputs<'_> {
    fn value(&self, name: &str) -> Option<f64> {
        self.0.iter().find(|r| r.quantity == name).and_then(|r| r.value.as_ref().ok().copied())
    }

    fn word(&self, name: &str) -> Option<&str> {
        self.0.iter().find(|r| r.quantity == name).and_then(|r| r.value.as_ref().err().map(String::as_str))
    }

    fn mm(&self, name: &str) -> Option<f64> {
        self.value(name).map(|v| v * M_PER_MM)
    }

    fn mpa(&self, name: &str) -> Option<f64> {
        self.value(name).map(|v| v * PA_PER_MPA)
    }
}

/// What is said of a result without ours.
const NOT_COMPUTED: &str = "an input is missing, or no function of ours gives it";

/// Named results in the units of their tables.
type Found = Vec<(&'static str, f64)>;

/// Every printed result beside ours.
pub fn worked_examples(published: &[PublishedExample]) -> Vec<ExampleRow> {
    let mut rows = Vec::new();
    let mut names: Vec<&str> = published.iter().map(|p| p.example.as_str()).collect();
    names.dedup();
    for name in names {
        let of_example = |input: bool| published.iter().filter(move |p| p.example == *name && p.is_input == input);
        let found = found(name, &Inputs(of_example(true).collect())).unwrap_or_default();
        for p in of_example(false) {
            let Ok(book) = &p.value else { continue };
            let computed = found.iter().find(|f| f.0 == p.quantity).map(|f| f.1);
            let alike = published.iter().filter(|o| !o.is_input && (&o.table, &o.unit) == (&p.table, &p.unit));
            rows.push(ExampleRow {
                table: p.table.clone(),
                example: p.example.clone(),
                quantity: p.quantity.clone(),
                unit: p.unit.clone(),
                book: *book,
                program: p.program,
                computed,
                half_digit: half_digit(alike.filter_map(|o| o.value.as_ref().ok().copied())).unwrap_or(0.0),
                note: if computed.is_some() { note(&p.example, &p.quantity) } else { NOT_COMPUTED },
            });
        }
    }
    rows
}

fn found(name: &str, inputs: &Inputs) -> Option<Found> {
    match name {
        "norton_6_1" => endurance(inputs),
        "norton_10_1" => shaft(inputs),
        "bhandari_25_4" => buckling(inputs),
        "bhandari_25_18" => throw(inputs),
        "kt_torsion" => step(inputs),
        "mass_properties" => masses(inputs),
        "piston_pin" => piston_pin(inputs),
        "first_round" => first_round(inputs),
        _ => None,
    }
}

/// Why ours differ from what is printed.
fn note(example: &str, quantity: &str) -> &'static str {
    match (example, quantity) {
        ("bhandari_25_18", "journal_diameter") => "from the data of the book; its own diameter does not follow from them",
        ("bhandari_25_18", "r2_tangential") => "the program's 3235.7 is a misprint",
        ("norton_10_1", _) => "the book rounds the sensitivities to two digits",
        ("piston_pin", "endurance_limit") => "the printed limit is that of the pass before, of a pin of 16.99 mm",
        ("first_round", "rod_inertia") => "ours is about the big end; the printed one fits no reference point",
        ("first_round", "rod_mass" | "rod_cg_ratio") => "the I-section reaches the arcs of the eyes here",
        _ => "",
    }
}

/// Factors of a part and its limit \[Norton 2013\] example 6-1.
fn endurance(i: &Inputs) -> Option<Found> {
    let tensile = i.mpa("tensile_strength")?;
    let part = Endurance {
        loading: if i.word("loading")? == "axial" { Loading::Axial } else { Loading::Bending },
        diameter: i.mm("equivalent_diameter")?,
        surface: match i.word("surface_finish")? {
            "ground" => Surface::Ground,
            "machined" => Surface::Machined,
            "hot_rolled" => Surface::HotRolled,
            _ => Surface::Forged,
        },
        temperature_c: i.value("temperature")?,
        reliability_percent: i.value("reliability")?,
    };
    let [load, size, surface, temperature, reliability] = part.factors(tensile);
    let limit = estimated_limit(tensile) * load * size * surface * temperature * reliability;
    Some(vec![
        ("c_load", load),
        ("c_size", size),
        ("c_surface", surface),
        ("c_temperature", temperature),
        ("c_reliability", reliability),
        ("endurance_limit", limit / PA_PER_MPA),
    ])
}

/// A shaft under alternating bending and steady torsion \[Norton 2013\] example 10-1.
fn shaft(i: &Inputs) -> Option<Found> {
    let (tensile, radius) = (i.mpa("tensile_strength")?, i.mm("notch_radius")?);
    let sensitivity = [false, true].map(|torsion| notch_sensitivity(radius, tensile, torsion));
    let notch = Notch { bending: fatigue_factor(i.value("kt")?, sensitivity[0]), torsion: fatigue_factor(i.value("kts")?, sensitivity[1]) };
    let bending = Swing { mean: 0.0, amplitude: i.mm("moment_amplitude")? };
    let torsion = Swing { mean: i.mm("torque_mean")?, amplitude: 0.0 };
    let moments = Moments { bending: [bending, Swing::default()], torsion, ..Moments::default() };
    let strength = Strength { fatigue_limit: i.mpa("endurance_limit")?, tensile, shear_yield: tensile };
    let diameter = moments.fatigue_diameter(&strength, notch, i.value("safety_factor")?);
    Some(vec![
        ("notch_sensitivity_bending", sensitivity[0]),
        ("notch_sensitivity_torsion", sensitivity[1]),
        ("kf", notch.bending),
        ("kfs", notch.torsion),
        ("diameter_d2", diameter / M_PER_IN),
    ])
}

/// The I-section of a rod \[Bhandari 2010\] example 25-4.
fn buckling(i: &Inputs) -> Option<Found> {
    let t = rod::buckling_thickness(i.value("critical_load")?, i.mpa("yield_strength")?, i.mm("rod_length")?) / M_PER_MM;
    Some(vec![("web_thickness_t", t), ("section_height_h", 5.0 * t), ("section_width_b", 4.0 * t)])
}

/// A crank on its bearings, by the largest shear \[Bhandari 2010\] example 25-18. The book's crankpin leaves out the bending by the tangential force.
fn throw(i: &Inputs) -> Option<Found> {
    let bearings = Bearings {
        before: i.mm("b1")?,
        after: i.mm("b2")?,
        before_flywheel: i.mm("c1")?,
        after_flywheel: i.mm("c2")?,
        flywheel_weight: i.value("flywheel_weight")?,
        belt_tension: i.value("belt_tension")?,
    };
    let (radial, tangential, radius) = (i.value("radial_force")?, i.value("tangential_force")?, i.mm("crank_radius")?);
    let torque = vec![tangential * radius];
    let loads = [crank::ThrowLoads {
        firing_deg: 0.0,
        radial: vec![-radial],
        tangential: vec![tangential],
        torque_before: vec![0.0],
        torque_after: torque.clone(),
    }];
    let supported = (&bearings, Bending::OwnBearings);
    let strength = Strength { fatigue_limit: 1.0, tensile: 1.0, shear_yield: i.mpa("allowable_shear")? };
    let pin = crank::crankpin(&loads, 0, supported, radius)[0];
    let d = Moments { largest: pin.bending[0].mean.hypotenuse(pin.torsion.mean), ..pin }.static_diameter(&strength, 1.0);
    let sizes = Sizes { crankpin_length: i.mm("crankpin_length")?, web_thickness: WEB[0] * d, ..Sizes::default() };
    let journal = crank::journals(&loads, 0, supported, &sizes)[1].static_diameter(&strength, 1.0);
    let seat = crank::seat(&torque, &bearings).static_diameter(&strength, 1.0);
    let (before, after) = crank::shares(&bearings);
    let [mm_d, mm_journal, mm_seat] = [d, journal, seat].map(|x| x / M_PER_MM);
    Some(vec![
        ("r1_radial", before * radial),
        ("r1_tangential", before * tangential),
        ("r2_radial", after * radial),
        ("r2_tangential", after * tangential),
        ("crankpin_diameter", mm_d),
        ("flywheel_shaft_diameter", mm_seat),
        ("journal_diameter", mm_journal),
        ("web_width", WEB[1] * mm_d),
        ("web_thickness", WEB[0] * mm_d),
    ])
}

/// A stepped shaft in torsion.
fn step(i: &Inputs) -> Option<Found> {
    let small = i.value("small_diameter")?;
    Some(vec![("kt", stepped_shaft::torsion(i.value("notch_radius")? / small, i.value("large_diameter")? / small))])
}

/// Masses of a CAD model. Under the assumptions named above; the I-section is carried up to the arcs of the eyes, eyes are as wide as the section, webs as long as throw and breadth together; the rod's
/// inertia is about its big end, the crank's about its centre.
fn masses(i: &Inputs) -> Option<Found> {
    let sizes = Sizes {
        pin_diameter: i.mm("piston_pin_diameter")?,
        shank_thickness: i.mm("rod_web_thickness")?,
        small_eye_bore: i.mm("piston_pin_diameter")?,
        small_eye_diameter: i.mm("small_eye_outer_diameter")?,
        big_eye_bore: i.mm("crankpin_diameter")?,
        big_eye_diameter: i.mm("big_eye_outer_diameter")?,
        crankpin_diameter: i.mm("crankpin_diameter")?,
        crankpin_length: i.mm("rod_beam_width")?,
        journal_diameter: i.mm("journal_diameter")?,
        web_thickness: i.mm("web_thickness")?,
        web_breadth: i.mm("web_width")?,
        seat_diameter: i.mm("journal_diameter")?,
    };
    let (length, radius) = (i.mm("rod_length")?, i.mm("crank_radius")?);
    let rod = bodies::rod(&sizes, length, DENSITY);
    let throw = bodies::throw(&sizes, [CAD_JOURNAL_MM * M_PER_MM; 2], radius, DENSITY);
    Some(vec![
        ("crank_mass", throw.mass / KG_PER_G),
        ("crank_inertia", throw.inertia() / KG_M2_PER_G_MM2),
        ("crank_cg_ratio", throw.centre / radius),
        ("rod_mass", rod.mass / KG_PER_G),
        ("rod_inertia", rod.inertia_at_reference / KG_M2_PER_G_MM2),
        ("rod_cg_ratio", rod.centre / length),
    ])
}

/// The piston pin of the two-stroke, by Goodman.
fn piston_pin(i: &Inputs) -> Option<Found> {
    let tensile = i.mpa("tensile_strength")?;
    let bending = Swing { mean: i.mm("moment_mean")?, amplitude: i.mm("moment_amplitude")? };
    let moments = Moments { bending: [bending, Swing::default()], ..Moments::default() };
    let strength = Strength { fatigue_limit: i.mpa("endurance_limit_used")?, tensile, shear_yield: tensile };
    let diameter = moments.fatigue_diameter(&strength, Notch::NONE, i.value("design_factor")?);
    let part = Endurance {
        loading: Loading::Bending,
        diameter,
        surface: Surface::Forged,
        temperature_c: i.value("temperature")?,
        reliability_percent: i.value("reliability")?,
    };
    let factors = part.factors(tensile);
    let [load, _, surface, temperature, reliability] = factors;
    let limit = factors.iter().product::<f64>() * estimated_limit(tensile);
    Some(vec![
        ("diameter", diameter / M_PER_MM),
        ("endurance_limit", limit / PA_PER_MPA),
        ("c_load", load),
        ("c_surface", surface),
        ("c_temperature", temperature),
        ("c_reliability", reliability),
    ])
}

/// Throw and rod of the two-stroke from the printed diameters of its first round.
fn first_round(i: &Inputs) -> Option<Found> {
    let pin = i.mm("crankpin_diameter")?;
    let sizes = Sizes {
        pin_diameter: i.mm("piston_pin_diameter")?,
        shank_thickness: i.mm("rod_web_thickness")?,
        small_eye_bore: i.mm("small_eye_bore")?,
        small_eye_diameter: i.mm("small_eye_outer_diameter")?,
        big_eye_bore: i.mm("big_eye_bore")?,
        big_eye_diameter: i.mm("big_eye_outer_diameter")?,
        crankpin_diameter: pin,
        crankpin_length: i.mm("rod_width")?,
        journal_diameter: i.mm("journal_diameter")?,
        web_thickness: WEB[0] * pin,
        web_breadth: WEB[1] * pin,
        seat_diameter: i.mm("flywheel_seat_diameter")?,
    };
    let bearings = Bearings {
        before: i.mm("b1")?,
        after: i.mm("b2")?,
        before_flywheel: i.mm("b1")?,
        after_flywheel: i.mm("b2")?,
        flywheel_weight: 0.0,
        belt_tension: 0.0,
    };
    let (radius, length) = (i.mm("crank_radius")?, i.mm("rod_length")?);
    let throw = bodies::throw(&sizes, bodies::journal_lengths(&sizes, &bearings), radius, DENSITY);
    let rod = bodies::rod(&sizes, length, DENSITY);
    Some(vec![
        ("crank_mass", throw.mass),
        ("rod_mass", rod.mass),
        ("crank_inertia", throw.inertia()),
        ("rod_inertia", rod.inertia_at_reference),
        ("crank_cg_ratio", throw.centre / radius),
        ("rod_cg_ratio", rod.centre / length),
    ])
}
