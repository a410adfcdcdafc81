//! From what is sheared to stiffness and damping: S = B G* with the complex shear modulus G* of rubber, or i omega eta* of oil, and a factor B of shape, m³.

use std::f64::consts::PI;

/// What is sheared between hub and ring, lengths in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Geometry {
    /// A cylindrical sleeve between two radii: B = 4 pi L r1² r2²/(r2² - r1²).
    Sleeve {
        /// Inner radius.
        inner: f64,
        /// Outer radius.
        outer: f64,
        /// Length.
        length: f64,
    },
    /// Flat rings between faces: B = (pi/2)(r2⁴ - r1⁴)/t a face.
    Faces {
        /// Inner radius.
        inner: f64,
        /// Outer radius.
        outer: f64,
        /// Thickness of each.
        thickness: f64,
        /// How many there are.
        count: f64,
    },
    /// Wedges whose thickness is a share kappa of the radius, sheared alike everywhere: B = (2 pi/3)(r2³ - r1³)/kappa a face.
    Wedges {
        /// Inner radius.
        inner: f64,
        /// Outer radius.
        outer: f64,
        /// kappa.
        slope: f64,
        /// How many there are.
        count: f64,
    },
    /// Oil in a gap all round a ring in its housing: on both faces, at the rim and at the bore.
    Gap {
        /// Bore of the ring.
        inner: f64,
        /// Rim of the ring.
        outer: f64,
        /// Width of the ring.
        width: f64,
        /// Gap.
        gap: f64,
    },
}

/// B of a sleeve.
fn sleeve(inner: f64, outer: f64, length: f64) -> f64 {
    4.0 * PI * length * (inner * outer).powi(2) / (outer * outer - inner * inner)
}

/// B of a face.
fn face(inner: f64, outer: f64, thickness: f64) -> f64 {
    0.5 * PI * (outer.powi(4) - inner.powi(4)) / thickness
}

impl Geometry {
    /// B, m³.
    pub fn factor(&self) -> f64 {
        match *self {
            Self::Sleeve { inner, outer, length } => sleeve(inner, outer, length),
            Self::Faces { inner, outer, thickness, count } => count * face(inner, outer, thickness),
            Self::Wedges { inner, outer, slope, count } => count * 2.0 * PI / 3.0 * (outer.powi(3) - inner.powi(3)) / slope,
            Self::Gap { inner, outer, width, gap } => {
                2.0 * face(inner, outer, gap) + sleeve(outer, outer + gap, width) + sleeve(inner - gap, inner, width)
            }
        }
    }

    /// Largest shear strain per twist, 1/rad.
    pub fn strain_per_twist(&self) -> f64 {
        match *self {
            Self::Sleeve { inner, outer, .. } => 2.0 * outer * outer / (outer * outer - inner * inner),
            Self::Faces { outer, thickness, .. } => outer / thickness,
            Self::Wedges { slope, .. } => 1.0 / slope,
            Self::Gap { outer, gap, .. } => {
                let rim = 2.0 * (outer + gap).powi(2) / ((outer + gap).powi(2) - outer * outer);
                rim.max(outer / gap)
            }
        }
    }
}

/// Inertia of a ring of rectangular section, kg m²: pi rho w (r2⁴ - r1⁴)/2.
#[doc(hidden)]
pub fn ring_inertia(inner: f64, outer: f64, width: f64, density: f64) -> f64 {
    density * width * face(inner, outer, 1.0)
}
