//! Traditional method: the rod as one mass on the crankpin and one on the piston pin, joined by a strut \[Villalva 2014\] section 3.4.

use super::balance::{Moment, UnitForces, gas_force, torque_of, with_friction};
use crate::engine::Geometry;
use crate::numerics::elementary::Elementary;

/// Forces with the rod's mass shared between its ends as the rotating fraction says. The strut pushes along the rod: R (1, -tan beta) on the piston with
/// R = F_gas + m_oscillating d²s/dt².
pub fn traditional(geometry: &Geometry, at: Moment) -> UnitForces {
    let crank = &geometry.slider_crank;
    let (sine, cosine) = at.theta.sine_cosine();
    let speed2 = at.omega * at.omega;
    // s = r + L - x
    let acceleration = -crank.motion(at.theta).curvature * speed2;
    let gas = gas_force(geometry, at.pressure);
    let tan_beta = crank.lean(at.theta).angle.tangent();
    let wanted = gas + geometry.oscillating_mass() * acceleration;
    let strut = with_friction(geometry, crank.motion(at.theta).slope, wanted, (tan_beta, 0.0));
    let rotating = geometry.rod_rotating_fraction() * geometry.rod_mass * crank.crank_radius * speed2;
    let big_end = [-strut + rotating * cosine, strut * tan_beta + rotating * sine];
    UnitForces {
        small_end: [gas + geometry.piston_mass * acceleration + strut - wanted, -strut * tan_beta],
        big_end,
        liner: strut * tan_beta,
        friction: wanted - strut,
        torque: torque_of(geometry, at.theta, big_end),
    }
}
