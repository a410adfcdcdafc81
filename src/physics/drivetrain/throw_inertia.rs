//! Polar inertia of a crank throw about the axis of the crank, from its dimensions.

use super::throw_stiffness::{Step, Throw};
use crate::numerics::elementary::Elementary;
use std::f64::consts::PI;

/// A sector of a ring about the axis: a counterweight on one web.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sector {
    /// m.
    pub outer_radius: f64,
    /// m.
    pub inner_radius: f64,
    /// rad.
    pub angle: f64,
    /// m.
    pub thickness: f64,
}

/// What a throw has beside pin, journal and the breadth and thickness of its webs.
#[derive(Debug, Clone, PartialEq)]
pub struct Masses {
    /// kg/m³.
    pub density: f64,
    /// Height of a web, along the throw, m.
    pub web_height: f64,
    /// Centre of a web from the axis, towards the crankpin, m.
    pub web_centre: f64,
    /// On every web.
    pub counterweight: Option<Sector>,
    /// Rings about the axis (flanges, gears, thrust collars), and cuts, which count as negative.
    pub rings: Vec<(Step, bool)>,
}

/// Polar inertia of a round about its own axis, kg m².
fn round(step: &Step, density: f64) -> f64 {
    density * step.length * PI / 32.0 * (step.diameter.powi(4) - step.bore.powi(4))
}

/// Mass of a round, kg.
fn mass(step: &Step, density: f64) -> f64 {
    density * step.length * PI / 4.0 * (step.diameter.powi(2) - step.bore.powi(2))
}

/// Inertia of a throw, kg m²: crankpin off the axis, one journal (half on each side), two webs as prisms, their counterweights, rings and cuts; `rods` adds what of the
/// rods turns with the crankpin, kg.
pub fn throw_inertia(throw: &Throw, masses: &Masses, rods: f64) -> f64 {
    let (r2, density) = (throw.radius.powi(2), masses.density);
    let pin = round(&throw.pin, density) + mass(&throw.pin, density) * r2;
    let (w, h) = (throw.web_breadth, masses.web_height);
    let web = density * throw.web_thickness * w * h * ((w * w + h * h) / 12.0 + masses.web_centre.powi(2));
    let sector = |s: &Sector| 0.25 * density * s.thickness * s.angle * (s.outer_radius.powi(4) - s.inner_radius.powi(4));
    let rings: f64 = masses.rings.iter().map(|(step, cut)| if *cut { -round(step, density) } else { round(step, density) }).sum();
    pin + round(&throw.journal, density) + 2.0 * (web + masses.counterweight.as_ref().map_or(0.0, sector)) + rings + rods * r2
}

/// Mass times distance from the axis of pin and webs of a throw less that of its counterweights, kg m.
pub fn throw_unbalance(throw: &Throw, masses: &Masses) -> f64 {
    let density = masses.density;
    let web = density * throw.web_thickness * throw.web_breadth * masses.web_height * masses.web_centre;
    // first moment of a sector: 2/3 sin(angle/2) (R³ - r³) thickness
    let sector =
        |s: &Sector| density * s.thickness * 2.0 / 3.0 * (0.5 * s.angle).sine() * (s.outer_radius.powi(3) - s.inner_radius.powi(3));
    mass(&throw.pin, density) * throw.radius + 2.0 * (web - masses.counterweight.as_ref().map_or(0.0, sector))
}
