//! Whether parts that hold their loads go together.

use super::failure::SizingError;
use super::rod::{HEIGHT, TAPER};
use super::specification::{Sizes, Specification};

/// Largest fillet over the radius of its pin: beyond it the web leaves the pin no length of its own.
const LARGEST_FILLET: f64 = 0.5;

/// Where two dimensions are sized to be one.
const SAME: f64 = 1.0 + 1e-9;

/// What does not go together, as mm.
///
/// # Errors
/// [`SizingError::DoesNotFit`] with both dimensions.
#[doc(hidden)]
pub fn check(spec: &Specification, s: &Sizes) -> Result<(), SizingError> {
    let smallest_pin = s.crankpin_diameter.min(s.journal_diameter);
    // (what is, what it must be below, both in words)
    let rules = [
        (s.pin_diameter, spec.bore, "the piston pin", "the bore"),
        (s.small_eye_diameter, spec.bore, "the small eye", "the bore"),
        (0.5 * (s.big_eye_diameter + s.small_eye_diameter), spec.rod_length, "the radii of both eyes", "the length of the rod"),
        (4.0 * s.shank_thickness, s.crankpin_length * SAME, "the width of the rod", "the length of the crankpin"),
        (TAPER.0 * HEIGHT * s.shank_thickness, s.small_eye_diameter * SAME, "the shank's height at the small eye", "that eye"),
        (TAPER.1 * HEIGHT * s.shank_thickness, s.big_eye_diameter * SAME, "the shank's height at the big eye", "that eye"),
        (spec.fillet_radius, LARGEST_FILLET * 0.5 * smallest_pin, "the fillet", "a quarter of its pin's diameter"),
        (spec.clearance, s.pin_diameter.min(s.crankpin_diameter), "the clearance of the eyes", "the pin in it"),
        (s.crankpin_diameter, s.web_breadth * SAME, "the crankpin", "the breadth of the web"),
        (s.journal_diameter, s.web_breadth * SAME, "the journal", "the breadth of the web"),
    ];
    match rules.into_iter().find(|r| r.0 > r.1) {
        None => Ok(()),
        Some((is, most, what, of)) => Err(SizingError::DoesNotFit(format!(
            "found {:.2} mm for {what}, expected less than {of}, {:.2} mm: give another dimension, proportion or steel",
            1e3 * is,
            1e3 * most
        ))),
    }
}
