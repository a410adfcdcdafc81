//! Torque of one cylinder on its throw by the traditional method: gas force and reciprocating mass, the rod split in two masses.

use super::Geometry;

/// Torque of the gas on the crank, N m, positive in the direction of rotation: (p - p_crankcase) A dx/dtheta (virtual work; the same as
/// F sin(theta + beta)/cos(beta) r of \[Villalva 2014\] eq. (3.74)). `pressure` in Pa absolute, `theta` in rad from firing dead centre.
pub fn gas_torque(geometry: &Geometry, pressure: f64, theta: f64) -> f64 {
    (pressure - geometry.crankcase_pressure) * geometry.piston_area() * geometry.slider_crank.motion(theta).slope
}

/// Torque of the reciprocating mass at constant speed, divided by the square of the speed: -m x'' x', kg m² (N m per (rad/s)²)
/// \[Villalva 2014\] eq. (3.69), where the double angle takes a cosine, not the printed sine.
pub fn inertia_torque_per_omega2(geometry: &Geometry, theta: f64) -> f64 {
    let motion = geometry.slider_crank.motion(theta);
    -geometry.oscillating_mass() * motion.curvature * motion.slope
}
