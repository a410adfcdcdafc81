//! Limits of a material for multiaxial criteria.

use crate::fatigue::multiaxial::{Criterion, Limits};
use crate::input::error::{At, Check, InputError, Source};
use crate::input::schema::material::RawMaterialFile;
use crate::units::PA_PER_MPA;

/// Checks a material file: strengths in their order, and a constant for every criterion.
///
/// # Errors
/// [`InputError`] with every mistake found.
pub(crate) fn resolve(source: &Source, raw: &RawMaterialFile) -> Result<Limits, InputError> {
    let mut check = Check::new(source);
    let tensile = check.positive(&raw.tensile_strength_mpa);
    let below = |check: &mut Check, value: &At<f64>, what: &str, most: f64, of: &str| {
        let x = check.positive(value);
        if x > most {
            check.wrong(value, format!("found a {what} of {x} MPa, expected one not above the {of}, {most} MPa"));
        }
        x
    };
    if let Some(y) = &raw.yield_strength_mpa {
        below(&mut check, y, "yield strength", tensile, "tensile strength");
    }
    let bending = below(&mut check, &raw.bending_fatigue_limit_mpa, "bending fatigue limit", tensile, "tensile strength");
    let torsion = below(&mut check, &raw.torsion_fatigue_limit_mpa, "torsion fatigue limit", bending, "bending fatigue limit");
    let repeated = raw.repeated_bending_fatigue_limit_mpa.as_ref();
    let repeated = repeated.map(|r| below(&mut check, r, "repeated bending fatigue limit", bending, "bending fatigue limit"));
    let limits = Limits {
        tensile: tensile * PA_PER_MPA,
        bending: bending * PA_PER_MPA,
        torsion: torsion * PA_PER_MPA,
        repeated_bending: repeated.unwrap_or_else(|| Limits::goodman_repeated(bending, tensile)) * PA_PER_MPA,
    };
    if check.mistakes.is_empty() {
        for criterion in Criterion::ALL {
            if let Err(undefined) = criterion.weight(&limits) {
                check.wrong(&raw.torsion_fatigue_limit_mpa, format!("found {torsion} MPa: {undefined}"));
            }
        }
    }
    if check.mistakes.is_empty() { Ok(limits) } else { Err(InputError::sorted(check.mistakes)) }
}
