//! The in-line six with a ring of every law that is no constant spring and damper: methods in frequency take them, those in time refuse them by name.

use super::scenario_parts::{EXACT, NEAR, RECEPTANCE, of_six, six};
use super::stability::Outcome::{self, Refused, Rough, Wrong};
use super::stability::Scenario;
use crate::absorber::{
    Absorber, Branch, CARREAU, Declaration, FRACTIONAL_KELVIN, FRACTIONAL_ZENER, MAXWELL, Mounted, PENDULUM, Prony, RUBBER, SPRING_PACK,
};

/// Modes with diagonal damping, and steps in time.
const REFUSED: Outcome = Refused("depends on frequency or speed");

/// Stiffness and relaxation time of the branches of a Prony series.
const PRONY_BRANCHES: [(f64, f64); 6] =
    [(1.49e3, 80e-3), (1.94e3, 16e-3), (3.28e3, 3.2e-3), (5.14e3, 0.64e-3), (8.68e3, 0.128e-3), (20.2e3, 25.6e-6)];

/// Values as in `studies/villalva_i6_laws.toml`.
pub(super) fn laws_on_six() -> Vec<Scenario> {
    let ring = 0.076;
    let scenario = |name: &'static str, absorber: Absorber, one_mode: Outcome| {
        let design = vec![Mounted::on_station(0, absorber)];
        let declared = [EXACT, RECEPTANCE, one_mode, Rough, Rough, NEAR, REFUSED, EXACT];
        Scenario { in_time: [REFUSED; 4], ..of_six(name, six(), design, declared) }
    };
    let law = |name: &'static str, declaration: &'static Declaration, values: &[f64], one_mode: Outcome| {
        scenario(name, Absorber::Ring((declaration.build)(values)), one_mode)
    };
    let branch = |(stiffness, relaxation_time)| Branch { stiffness, relaxation_time };
    let prony = Prony {
        ring_inertia: ring,
        stiffness: 16.8e3,
        branches: PRONY_BRANCHES.into_iter().map(branch).collect(),
        stiffness_scale: 1.0,
        time_scale: 1.0,
    };
    vec![
        law("rubber of one loss factor", &RUBBER, &[ring, 80e3, 0.2], Wrong(0.1)),
        law("rubber, fractional Kelvin", &FRACTIONAL_KELVIN, &[ring, 50e3, 3.6e-4, 0.3], Wrong(0.1)),
        law("rubber, fractional Zener", &FRACTIONAL_ZENER, &[ring, 15e3, 500.0, 3.7e-13, 0.3], Wrong(0.1)),
        scenario("rubber, Prony series", prony.into(), Wrong(0.1)),
        law("oil, Maxwell", &MAXWELL, &[ring, 250.0, 3e-3], Wrong(0.1)),
        law("oil, Carreau", &CARREAU, &[ring, 350.0, 1e-2, 0.8, 0.3], Wrong(0.1)),
        law("leaf springs in oil", &SPRING_PACK, &[ring, 45e3, 0.4, 1.3, 150.0], Wrong(0.1)),
        law("pendulums of order 3", &PENDULUM, &[ring, 3.0, 0.2], Rough),
    ]
}
