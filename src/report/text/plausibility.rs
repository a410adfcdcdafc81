//! What is unlikely in a study, in words.

use super::short;
use crate::analysis::plausibility::{Implausible, Known};
use crate::input::Study;
use crate::units::DEG_PER_RAD;
use std::fmt::Write;

/// Values of an example that nobody has confirmed: a block for each file, empty without any.
#[doc(hidden)]
pub fn placeholders(study: &Study, in_full: bool) -> String {
    let mut text = String::new();
    for group in study.placeholders.chunk_by(|a, b| a.file == b.file) {
        let file = group[0].file.display();
        let (these, own) = match group.len() {
            1 => ("this value".to_owned(), "is that of an example, not of your engine; put in your own, and delete its name"),
            n => (format!("these {n} values"), "are those of an example, not of your engine; put in your own, and delete their names"),
        };
        let _ = writeln!(text, "warning: {these} of {file} {own} from `placeholder` there:");
        if !in_full {
            let values: Vec<String> = group.iter().map(|p| format!("{} = {}", p.key, p.value)).collect();
            let _ = writeln!(text, "  {}", values.join("; "));
            continue;
        }
        for p in group {
            let _ = writeln!(text, "  {} = {}", p.key, p.value);
        }
    }
    text
}

/// So many are read; more hide the first.
const MOST_TOLD: usize = 20;

/// One sentence each, with what may be the reason; of very many the first, and how many more there are.
#[doc(hidden)]
pub fn implausible(found: &[Implausible]) -> Vec<String> {
    let more = found.len().saturating_sub(MOST_TOLD);
    let rest = (more > 0).then(|| format!("{more} more numbers are as unlikely"));
    found.iter().take(MOST_TOLD).map(sentence).chain(rest).collect()
}

fn known(of: Known) -> &'static str {
    match of {
        Known::Pressure => "the pressure is known",
        Known::Curve => "the curve of torque, power or mean pressure is known",
        Known::Harmonics => "the torque is known",
    }
}

/// What is held at the ends of the speeds at which it is known.
fn held(of: Known, (low, high): (f64, f64), (first, last): (f64, f64)) -> String {
    let below = (first < low).then(|| format!("from {first} to {low} rpm it is taken as at {low} rpm"));
    let above = (last > high).then(|| format!("from {high} to {last} rpm it is taken as at {high} rpm"));
    let parts: Vec<String> = below.into_iter().chain(above).collect();
    format!("{} from {low} to {high} rpm only: {}", known(of), parts.join(", "))
}

fn strong(limit: &str, mpa: f64) -> String {
    format!(
        "the limit \"{limit}\" counts a tensile strength of {} MPa: more than 600 counts for shafts of alloy steel alone, and for no propeller shaft [IACS UR M68, 3]",
        short(mpa)
    )
}

fn rated_above(limit: &str, rated_rpm: f64, highest_rpm: f64) -> String {
    format!(
        "the rule of the limit \"{limit}\" is rated at {} rpm of the crankshaft, above the {} rpm at which the study ends: is the rated speed that of the crankshaft or of the shaft?",
        short(rated_rpm),
        short(highest_rpm)
    )
}

fn throw_inertia(station: usize, inertia: f64, reciprocating: f64) -> String {
    format!(
        "a throw of station {} has {} kg m², its reciprocating masses m r² = {} kg m²: 0.4 to 60 times that is usual; is it in kg m²?",
        station + 1,
        short(inertia),
        short(reciprocating)
    )
}

fn sentence(found: &Implausible) -> String {
    match found {
        Implausible::PeakPressure { speed_rpm, bar } => {
            format!(
                "the pressure of the cylinder peaks at {} bar at {speed_rpm} rpm, outside 5 to 400 bar: is its unit what the column says?",
                short(*bar)
            )
        }
        Implausible::MeanPressure { speed_rpm, bar } => format!(
            "the indicated mean pressure is {} bar at {speed_rpm} rpm, outside 0 to 40 bar: is the pressure in the unit that the column says, and zero degrees at top dead centre of firing?",
            short(*bar)
        ),
        Implausible::PistonSpeed { speed_rpm, metres_per_second } => format!(
            "the mean piston speed is {} m/s at {speed_rpm} rpm, above 30 m/s: `crank_radius_mm` is half the stroke",
            short(*metres_per_second)
        ),
        Implausible::Bore(mm) => format!("the bore is {} mm, below 20 mm: is it in mm?", short(*mm)),
        Implausible::Stroke { stroke_mm, over_bore } => {
            format!(
                "the stroke, {} mm, is {} of the bore: `crank_radius_mm` is half the stroke, `bore_mm` a diameter",
                short(*stroke_mm),
                short(*over_bore)
            )
        }
        Implausible::RodRatio(ratio) => format!(
            "the crank radius is {} of the rod, outside 0.1 to 0.5: `crank_radius_mm` is half the stroke, `rod_length_mm` between the eyes",
            short(*ratio)
        ),
        Implausible::OneSpeed { of, speed_rpm } => {
            format!("{} at {speed_rpm} rpm only and taken for all speeds of the study", known(*of))
        }
        Implausible::Held { of, known_rpm, study_rpm } => held(*of, *known_rpm, *study_rpm),
        Implausible::PistonMass { mass, over_cube } => format!(
            "the piston has {} kg, {} kg/m³ of the cube of the bore, outside 100 to 30000: is its mass in kg, the bore in mm?",
            short(*mass),
            short(*over_cube)
        ),
        Implausible::Fullness { speed_rpm, ratio } => format!(
            "the indicated mean pressure is {} of the peak at {speed_rpm} rpm, above 0.32: are zero degrees of the pressure at top dead centre of firing?",
            short(*ratio)
        ),
        Implausible::Windup(twist) => format!(
            "the gas force of one cylinder would twist a shaft between throws by {}°: is the stiffness of the chain in N m/rad?",
            short(twist * DEG_PER_RAD)
        ),
        Implausible::Ring { ring, chain } => format!(
            "a ring of an optimum may have {} kg m², more than the whole chain with {}: is it in kg m²?",
            short(*ring),
            short(*chain)
        ),
        Implausible::Firing { longest, even } => format!(
            "no cylinder fires for {}° of the cycle, where even firing has {}°: do all cylinders have their angle within the cycle in `firing_deg`?",
            short(*longest),
            short(*even)
        ),
        Implausible::ThrowInertia { station, inertia, reciprocating } => throw_inertia(*station, *inertia, *reciprocating),
        Implausible::Undamped => {
            "nothing damps the chain, so that a resonance without absorber has no finite amplitude: the engine file may say `damping.fraction_of_critical`".into()
        }
        Implausible::NaturalFrequency(hz) => {
            format!(
                "the lowest natural frequency of the chain is {} Hz, outside 1 to 10000 Hz: is its stiffness in N m/rad, its inertia in kg m²?",
                short(*hz)
            )
        }
        Implausible::DampingRatio { mode, ratio } => {
            format!("the damping of mode {} is {} % of critical, above 20 %: shafts have 0.5 to 5 %", mode + 1, short(100.0 * ratio))
        }
        Implausible::RuleEnds { limit, end_rpm, highest_rpm } => {
            format!("the rule of the limit \"{limit}\" ends at {end_rpm} rpm: from there to {highest_rpm} rpm nothing is judged by it")
        }
        Implausible::TensileStrength { limit, mpa } => strong(limit, *mpa),
        Implausible::RatedSpeed { limit, rated_rpm, highest_rpm } => rated_above(limit, *rated_rpm, *highest_rpm),
        Implausible::Tuning { design, absorber, ratio } => format!(
            "the ring of absorber {} of `{design}` swings at {} of the nearest natural frequency of the chain, outside 0.1 to 10: is its stiffness in N m/rad?",
            absorber + 1,
            short(*ratio)
        ),
    }
}
