//! The types a study may name.

use super::carreau::CARREAU;
use super::construction::{COIL_SPRINGS, DISC, HOUSING, LEAF_SPRINGS, PENDULUM_MASSES, SLEEVE, WEDGE};
use super::fractional_kelvin::FRACTIONAL_KELVIN;
use super::fractional_zener::FRACTIONAL_ZENER;
use super::hardening::HARDENING;
use super::law::{ClosedForm, Declaration};
use super::maxwell::MAXWELL;
use super::pendulum::PENDULUM;
use super::pendulum_paths::{CIRCULAR_PENDULUM, CYCLOIDAL_PENDULUM, TAUTOCHRONE_PENDULUM};
use super::rubber::RUBBER;
use super::spring_pack::SPRING_PACK;
use super::tuned::TUNED;
use super::two_stage::TWO_STAGE;
use super::undamped::UNDAMPED;
use super::viscous::VISCOUS;

/// All of them, in the order of lists and messages.
pub static TYPES: [&Declaration; 22] = [
    &TUNED,
    &VISCOUS,
    &UNDAMPED,
    &RUBBER,
    &FRACTIONAL_KELVIN,
    &FRACTIONAL_ZENER,
    &MAXWELL,
    &CARREAU,
    &SPRING_PACK,
    &HARDENING,
    &TWO_STAGE,
    &PENDULUM,
    &CIRCULAR_PENDULUM,
    &TAUTOCHRONE_PENDULUM,
    &CYCLOIDAL_PENDULUM,
    &SLEEVE,
    &DISC,
    &WEDGE,
    &HOUSING,
    &LEAF_SPRINGS,
    &COIL_SPRINGS,
    &PENDULUM_MASSES,
];

/// Types that are given only: searches are of small twists, where these are other types.
#[doc(hidden)]
pub static GIVEN_ONLY: [&Declaration; 2] = [&HARDENING, &TWO_STAGE];

/// A type by its word.
pub fn find(name: &str) -> Option<&'static Declaration> {
    TYPES.into_iter().find(|t| t.name == name)
}

/// Keys of all parameters, each once.
#[doc(hidden)]
pub fn parameter_keys() -> Vec<&'static str> {
    let mut keys = Vec::new();
    for p in TYPES.into_iter().flat_map(|t| t.parameters) {
        if !keys.contains(&p.key) {
            keys.push(p.key);
        }
    }
    keys
}

/// Words of all closed forms, each once.
#[doc(hidden)]
pub fn closed_form_names() -> Vec<&'static str> {
    let mut names = Vec::new();
    for form in TYPES.into_iter().flat_map(|t| t.closed_forms).filter(|f| f.is_optimum) {
        if !names.contains(&form.name) {
            names.push(form.name);
        }
    }
    names
}

/// A closed form by its word, with the first type that has it.
#[doc(hidden)]
pub fn closed_form(name: &str) -> Option<(&'static Declaration, &'static ClosedForm)> {
    TYPES.into_iter().find_map(|t| t.closed_forms.iter().find(|c| c.is_optimum && c.name == name).map(|c| (t, c)))
}
