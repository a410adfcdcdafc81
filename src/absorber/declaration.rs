//! What hartog is told of a type of absorber, in one place: schema, validation, tables, columns and the variables of optimisers come from it.

use super::closed_forms::EngineMode;
use super::law::Law;
use super::parameter::Parameter;
use std::sync::Arc;

/// A closed-form optimum of a type.
#[derive(Debug, Clone, Copy)]
pub struct ClosedForm {
    /// The word used in studies.
    pub name: &'static str,
    /// Whether searches start from it for every mode, or for the first one only.
    pub every_mode: bool,
    /// Values of the type's parameters for a ring of this inertia (kg m²) on this mode.
    pub values: fn(f64, EngineMode) -> Vec<f64>,
}

/// A type of absorber.
#[derive(Debug)]
pub struct Declaration {
    /// The word used in studies and tables.
    pub name: &'static str,
    /// Its parameters, the ring inertia first.
    pub parameters: &'static [Parameter],
    /// A law with these values.
    pub build: fn(&[f64]) -> Arc<dyn Law>,
    /// Closed-form optima: where searches start.
    pub closed_forms: &'static [ClosedForm],
}

impl PartialEq for Declaration {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Declaration {}

impl Declaration {
    /// Index of a parameter by its key.
    pub fn index(&self, key: &str) -> Option<usize> {
        self.parameters.iter().position(|p| p.key == key)
    }
}
