//! Newton and Euler's equations of piston and rod, the rod a rigid body with its own centre and inertia.
//!
//! With S the force of the rod on the piston and Q that of the crank on the rod: m_p s'' = S_x - F_gas + R and 0 = S_y + N for the piston (R: friction), m a_G = Q - S for the
//! rod, and about its centre I beta'' = L (cos beta S_y + sin beta S_x) + a m (cos beta a_Gy + sin beta a_Gx), where a is the distance of the centre from the big
//! end. Derived here: equations (3.76) to (3.84) of \[Villalva 2014\] carry misprints.

use super::balance::{Moment, UnitForces, gas_force, torque_of, with_friction};
use crate::engine::Geometry;
use crate::numerics::elementary::Elementary;

/// Forces with the rod as a rigid body; exact kinematics.
pub fn newton_euler(geometry: &Geometry, at: Moment) -> UnitForces {
    let crank = &geometry.slider_crank;
    let (r, l, a) = (crank.crank_radius, crank.rod_length, geometry.rod_centre());
    let inertia = geometry.two_mass_inertia() + geometry.excess_inertia();
    let (sine, cosine) = at.theta.sine_cosine();
    let lean = crank.lean(at.theta);
    let (sin_beta, cos_beta) = lean.angle.sine_cosine();
    let speed2 = at.omega * at.omega;
    let (rate2, turning) = (lean.slope * lean.slope * speed2, lean.curvature * speed2);
    let centre = [
        -r * speed2 * cosine - a * (sin_beta * turning + cos_beta * rate2),
        -r * speed2 * sine - a * (cos_beta * turning - sin_beta * rate2),
    ];
    let m = geometry.rod_mass;
    let motion = crank.motion(at.theta);
    let wanted = gas_force(geometry, at.pressure) - geometry.piston_mass * motion.curvature * speed2;
    let bending = (inertia * turning - a * m * (cos_beta * centre[1] + sin_beta * centre[0])) / (l * cos_beta);
    // the liner presses with tan beta S_x - bending
    let piston = with_friction(geometry, motion.slope, wanted, (lean.angle.tangent(), -bending));
    let across = bending - lean.angle.tangent() * piston;
    let big_end = [-(m * centre[0] + piston), -(m * centre[1] + across)];
    let torque = torque_of(geometry, at.theta, big_end);
    UnitForces { small_end: [piston, across], big_end, liner: -across, friction: wanted - piston, torque }
}
