//! The chain of an example.

use crate::input::{FoundChain, FoundStation};
use std::fmt::Write;

/// Inertia of the pulley, kg m².
pub(super) const PULLEY: f64 = 0.01;
/// Inertia of a throw, kg m².
const THROW: f64 = 0.02;

/// A text in TOML.
pub(super) fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}

/// One of so many throws, every value an example.
pub(super) fn sample(throws: usize) -> String {
    let mut text = String::from(
        "\n# The chain from the free end to the flywheel: inertias, and the shaft from each to the next. A table does as well, in place of all [[station]]:\n# [chain]\n# file = \"chain.csv\"             # station, inertia_kg_m2, stiffness_to_next_n_m_per_rad, throws\n[[station]]\nname = \"pulley\"\n",
    );
    let _ = write!(text, "inertia_kg_m2 = {PULLEY}\nstiffness_to_next_n_m_per_rad = 3e5\n");
    for t in 1..=throws {
        let _ = write!(
            text,
            "\n[[station]]\nname = \"throw_{t}\"\nthrows = [{t}]\ninertia_kg_m2 = {THROW}\nstiffness_to_next_n_m_per_rad = 9e5\ndamping_to_ground_n_m_s_per_rad = 2      # assumption\n"
        );
    }
    text + "\n[[station]]                      # the last one\nname = \"flywheel\"\ninertia_kg_m2 = 0.9\n"
}

/// A chain of one's own.
pub(super) fn found(chain: &FoundChain) -> String {
    let mut text = String::from("\n# The chain as it was imported.\n");
    for s in &chain.stations {
        let FoundStation { name, inertia, stiffness_to_next, damping_to_next, loss_factor_to_next, damping_to_ground, throws } = s;
        let _ = write!(text, "\n[[station]]\nname = {}\n", quoted(name));
        if !throws.is_empty() {
            let _ = writeln!(text, "throws = {throws:?}");
        }
        let _ = writeln!(text, "inertia_kg_m2 = {}", fourteen_digits(*inertia));
        let others = [
            ("stiffness_to_next_n_m_per_rad", stiffness_to_next),
            ("damping_to_next_n_m_s_per_rad", damping_to_next),
            ("loss_factor_to_next", loss_factor_to_next),
            ("damping_to_ground_n_m_s_per_rad", damping_to_ground),
        ];
        for (key, value) in others.iter().filter(|o| *o.1 > 0.0) {
            let _ = writeln!(text, "{key} = {}", fourteen_digits(**value));
        }
    }
    text
}

/// Fourteen significant digits: what a change of units adds behind them is rounding.
fn fourteen_digits(x: f64) -> f64 {
    format!("{x:.13e}").parse().unwrap_or(x)
}
