//! What is unlikely in a study, in words.

use super::short;
use crate::analysis::plausibility::Implausible;
use crate::units::DEG_PER_RAD;

/// One sentence each, with what may be the reason.
pub(crate) fn implausible(found: &[Implausible]) -> Vec<String> {
    found.iter().map(sentence).collect()
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
        Implausible::OneSpeed(rpm) => format!("the pressure is known at {rpm} rpm only and taken for all speeds of the study"),
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
        Implausible::Tuning { design, absorber, ratio } => format!(
            "the ring of absorber {} of `{design}` swings at {} of the lowest natural frequency of the chain, outside 0.1 to 10: is its stiffness in N m/rad?",
            absorber + 1,
            short(*ratio)
        ),
    }
}
