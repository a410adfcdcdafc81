//! Mass, centre and inertia of rod and crank throw from their dimensions.

use super::specification::{Bearings, Sizes};
use crate::numerics::quadrature::gauss_legendre;
use std::f64::consts::PI;

/// Points of the quadrature over a web or flange: the arcs are smooth there.
const POINTS: usize = 24;

/// A body in its plane of motion.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct Body {
    /// kg.
    pub mass: f64,
    /// Of the centre from the reference point (centre of the big end, axis of the crank), m.
    pub centre: f64,
    /// About the reference point, kg m².
    pub inertia_at_reference: f64,
}

impl Body {
    /// About the centre, kg m².
    pub fn inertia(&self) -> f64 {
        self.inertia_at_reference - self.mass * self.centre * self.centre
    }

    /// Adds a part with its centre at `place` and its inertia about that.
    fn add(&mut self, mass: f64, place: f64, inertia: f64) {
        let total = self.mass + mass;
        if total > 0.0 {
            self.centre = (self.mass * self.centre + mass * place) / total;
        }
        self.mass = total;
        self.inertia_at_reference += inertia + mass * place * place;
    }

    fn add_ring(&mut self, density: f64, (outer, inner, width): (f64, f64, f64), place: f64) {
        let mass = density * PI / 4.0 * (outer * outer - inner * inner) * width;
        self.add(mass, place, mass * (outer * outer + inner * inner) / 8.0);
    }
}

/// The rod about the centre of its big end: two rings as wide as the I-section, and the I-section between them, carried up to their arcs.
pub fn rod(sizes: &Sizes, length: f64, density: f64) -> Body {
    let t = sizes.shank_thickness;
    let width = 4.0 * t;
    let mut body = Body::default();
    body.add_ring(density, (sizes.big_eye_diameter, sizes.big_eye_bore, width), 0.0);
    body.add_ring(density, (sizes.small_eye_diameter, sizes.small_eye_bore, width), length);
    let (big, small) = (0.5 * sizes.big_eye_diameter, 0.5 * sizes.small_eye_diameter);
    let arc = |radius: f64, y: f64| (radius * radius - y * y).max(0.0).sqrt();
    // strips along the rod at a height y: the web is t thick, the flanges are 4 t wide
    for (from, to, thickness) in [(0.0, 1.5 * t, t), (1.5 * t, 2.5 * t, width)] {
        for (x, share) in gauss_legendre(POINTS) {
            let (y, weight) = (0.5 * (from + to) + 0.5 * (to - from) * x, 0.5 * (to - from) * share);
            let (start, end) = (arc(big, y), length - arc(small, y));
            let strip = (end - start).max(0.0);
            let mass = 2.0 * density * thickness * strip * weight;
            body.add(mass, 0.5 * (start + end), mass * (strip * strip / 12.0 + y * y));
        }
    }
    body
}

/// Length of a web: from half its breadth before the axis to half its breadth beyond the crankpin, m.
pub fn web_height(sizes: &Sizes, crank_radius: f64) -> f64 {
    crank_radius + sizes.web_breadth
}

/// Lengths of the journals of a throw up to the middles of their bearings, m: below zero where webs and crankpin leave no room.
pub fn journal_lengths(sizes: &Sizes, bearings: &Bearings) -> [f64; 2] {
    [bearings.before, bearings.after].map(|b| b - 0.5 * sizes.crankpin_length - sizes.web_thickness)
}

/// A throw about the axis of the crank: crankpin, two webs as prisms, journals of these lengths.
pub fn throw(sizes: &Sizes, journals: [f64; 2], crank_radius: f64, density: f64) -> Body {
    let mut body = Body::default();
    body.add_ring(density, (sizes.crankpin_diameter, 0.0, sizes.crankpin_length), crank_radius);
    journals.iter().for_each(|length| body.add_ring(density, (sizes.journal_diameter, 0.0, *length), 0.0));
    let (w, h) = (sizes.web_breadth, web_height(sizes, crank_radius));
    let webs = 2.0 * density * sizes.web_thickness * w * h;
    body.add(webs, 0.5 * crank_radius, webs * (w * w + h * h) / 12.0);
    body
}
