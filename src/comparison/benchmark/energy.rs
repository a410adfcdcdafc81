//! Energy put in against energy dissipated, method by method, on a chain with an absorber: a check that needs no other method.

use super::methods::Candidate;
use super::scenarios::scenarios;
use super::stability::Scenario;
use crate::absorber::mounted::station_of;
use crate::numerics::C64;
use crate::response::power::{self, Motion, Power, powers};
use crate::response::{Exponential, Grid, Modal, Newmark, Receptance, ResponseError, Work};
use nalgebra::DMatrix;

/// One balance.
#[derive(Debug, Clone, PartialEq)]
pub struct Balance {
    /// Method and setting.
    pub method: &'static str,
    /// Which dampers count, or what the integrator is.
    pub setting: &'static str,
    /// Name of the scenario.
    pub scenario: &'static str,
    /// Largest share of the input that is not dissipated, over the speeds (negative: more is dissipated than put in); the refusal where there is one.
    pub missing: Result<f64, ResponseError>,
}

/// Scenarios that are balanced: a ring with spring and damper, one with a damper, and hysteresis.
const SCENARIOS: [&str; 3] = ["tuned absorber", "viscous absorber", "loss factors"];
/// Of how many speeds of a scenario one is balanced.
const EVERY: usize = 12;
/// Steps of the integrators in a cycle.
const STEPS: usize = 720;
/// Newmark's gamma that damps by itself.
const DISSIPATIVE: f64 = 0.6;

/// All balances.
pub fn balances() -> Vec<Balance> {
    let scenarios = scenarios();
    let chosen = SCENARIOS.iter().filter_map(|name| scenarios.iter().find(|s| s.name == *name));
    chosen.flat_map(of_scenario).collect()
}

fn of_scenario(s: &Scenario) -> Vec<Balance> {
    let speeds: Vec<f64> = s.speeds.iter().copied().step_by(EVERY).collect();
    let grid = Grid::new(&speeds, &[]);
    let mut list = Vec::new();
    let mut put = |method, setting, powers: Result<Vec<Power>, ResponseError>| {
        list.push(Balance { method, setting, scenario: s.name, missing: powers.map(|p| worst(&p)) });
    };
    let mut work = Work::default();
    for candidate in [Candidate::Direct, Candidate::Holzer, Candidate::Dense, Candidate::Reduced(2), Candidate::ClosedForm] {
        if let Some(method) = candidate.build(&s.system, &grid, &s.design, s.quantity) {
            put(candidate.method(), "dampers of the system", powers(method.as_ref(), &s.design, None, &mut work));
        }
    }
    let tables = Receptance::new(&s.system, &grid, station_of(&s.design, 0), &power::quantities(&s.system.chain, s.design.len()));
    put("receptance", "dampers of the system", powers(&tables, &s.design, None, &mut work));
    let modal = Modal::new(&s.system, &grid);
    let (viscous, hysteretic) = modal.own_damping(&s.design);
    let damping_power = |omega: f64, motion: &Motion| {
        let angles = motion.angles(&s.design);
        0.5 * omega * omega * quadratic(&viscous, &angles) + 0.5 * omega * quadratic(&hysteretic, &angles)
    };
    put("modal", "its own damping matrix", powers(&modal, &s.design, Some(&damping_power), &mut work));
    put("modal", "dampers of the system", powers(&modal, &s.design, None, &mut work));
    let mut newmark = |beta: f64, gamma: f64| -> Result<Vec<Power>, ResponseError> {
        let method = Newmark::new(&s.system, &grid, (beta, gamma), STEPS);
        speeds.iter().map(|speed| method.power(&s.design, *speed, &mut work)).collect()
    };
    put("newmark", "average acceleration", newmark(0.25, 0.5));
    put("newmark", "gamma 0.6, dissipative", newmark(0.25 * (0.5 + DISSIPATIVE).powi(2), DISSIPATIVE));
    put("newmark", "gamma 0.4, refused", newmark(0.25, 0.4));
    let exponential = Exponential::new(&s.system, &grid, STEPS);
    put(
        "exponential",
        "integral over the steps",
        speeds.iter().map(|speed| exponential.power(&s.design, *speed, &mut Work::default())).collect(),
    );
    list
}

/// The missing share of largest size.
fn worst(powers: &[Power]) -> f64 {
    powers.iter().map(Power::missing).fold(0.0, |m: f64, v| if v.abs() > m.abs() { v } else { m })
}

/// y* C y of a symmetric matrix.
fn quadratic(matrix: &DMatrix<f64>, y: &[C64]) -> f64 {
    let row = |i: usize| y.iter().enumerate().map(|(j, y)| matrix[(i, j)] * y).sum::<C64>();
    y.iter().enumerate().map(|(i, y)| (y.conj() * row(i)).re).sum()
}
