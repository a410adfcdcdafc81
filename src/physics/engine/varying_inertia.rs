//! The part of a cylinder's inertia that varies with the crank angle, and the torque that a vibration meets by it.
//!
//! A cylinder has the inertia I = J + m r² sin² phi, phi from its dead centre, to the first order in the rod ratio: half of m r² on the average, less
//! dI cos 2 phi with dI as large. Lagrange's equation, I phi'' + I'(phi) phi'²/2, with phi = Omega t + theta is linear in a small theta:
//! I theta'' + I' Omega theta' + I'' Omega² theta/2. A motion theta_n e^{i n phi} then meets torques of the orders n + 2 and n - 2 besides its own.

/// Torque of order n + 2 (`up`) or n - 2 on the left of the equation of motion, N m, per rad of a motion of order n whose cylinder has its dead centre
/// where the crank angle is zero: dI Omega² ((n ± 1)² + 1)/2. `variation`: dI, kg m²; `shaft_speed`: Omega, rad/s.
pub fn secondary_torque(variation: f64, shaft_speed: f64, order: f64, up: bool) -> f64 {
    let beside = if up { order + 1.0 } else { order - 1.0 };
    0.5 * variation * shaft_speed * shaft_speed * (beside * beside + 1.0)
}
