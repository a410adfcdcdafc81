//! Sections: what moments and torques are divided by.

use std::f64::consts::PI;

/// Area moment of a round section, m⁴ \[Villalva 2014\] p. 151.
pub(crate) fn area_moment(diameter: f64, bore: f64) -> f64 {
    PI / 64.0 * (diameter.powi(4) - bore.powi(4))
}

/// Bending stress at the surface of a round section per moment, 1/m³: D/(2 I).
pub fn bending(diameter: f64, bore: f64) -> f64 {
    0.5 * diameter / area_moment(diameter, bore)
}

/// Shear stress at the surface of a round section per torque, 1/m³: D/(2 J).
pub fn torsion(diameter: f64, bore: f64) -> f64 {
    0.25 * diameter / area_moment(diameter, bore)
}

/// Bending stress of a web per moment, 1/m³: 6/(B W²) \[IACS UR M53\] section 2.1.2.1.
pub fn web_bending(breadth: f64, thickness: f64) -> f64 {
    6.0 / (breadth * thickness * thickness)
}

/// Compressive stress of a web per radial force, 1/m²: 1/(B W).
pub fn web_compression(breadth: f64, thickness: f64) -> f64 {
    1.0 / (breadth * thickness)
}
