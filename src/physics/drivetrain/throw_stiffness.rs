//! Torsional stiffness of shafts and crank throws from their dimensions.
//!
//! A throw is as stiff as a shaft: k = pi G/(32 F) with F (1/m³) the sum of length over (diameter⁴ - bore⁴), and of what the webs add. The formulas are
//! fits to measured cranks and differ by a fifth and more; each is meant for solid forged cranks with plain webs. Lengths a and b of crankpin and
//! journal between the webs, web thickness h and breadth W, throw radius R, diameters D:
//!
//! - Ker Wilson: (b + 0.4 D_j)/D_j⁴ + (a + 0.4 D_p)/D_p⁴ + (R - 0.2 (D_p + D_j))/(h W³).
//! - Carter: (b + 0.8 h)/D_j⁴ + 0.75 a/D_p⁴ + 1.5 R/(h W³).
//! - Zimanenko: (b + 0.6 h D_j/b)/D_j⁴ + (0.8 a + 0.2 W D_j/R)/D_p⁴ + R sqrt(R/D_p)/(h W³).
//!
//! They are quoted as in the literature after \[Nestorides 1958\] chapter 2; their coefficients have not been checked against a printed copy, and no worked
//! example of them was found. Beside them a bracket without any fit: pin and journal as long as they are between the webs, each web
//! a beam of length R in bending, (3 pi/8) (1/(1 + nu)) R/(h W³) for both; what joins them is taken as rigid, bearings hold nothing.

use std::f64::consts::PI;

/// Poisson's ratio of steel.
const POISSON: f64 = 0.3;

/// Shear modulus of an isotropic material, Pa: E/(2 (1 + nu)).
#[doc(hidden)]
pub fn shear_modulus(young_modulus: f64) -> f64 {
    young_modulus / (2.0 * (1.0 + POISSON))
}

/// A length of round shaft.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// m.
    pub diameter: f64,
    /// m.
    pub bore: f64,
    /// m.
    pub length: f64,
}

impl Step {
    /// Length over the difference of the fourth powers, 1/m³.
    fn flexibility(&self) -> f64 {
        self.length / self.fourth()
    }

    fn fourth(&self) -> f64 {
        self.diameter.powi(4) - self.bore.powi(4)
    }
}

/// Stiffness of steps one after another, N m/rad; infinite without any.
pub fn stepped_shaft(steps: &[Step], shear_modulus: f64) -> f64 {
    stiffness(steps.iter().map(Step::flexibility).sum(), shear_modulus)
}

/// pi G/(32 F), N m/rad.
#[doc(hidden)]
pub fn stiffness(flexibility: f64, shear_modulus: f64) -> f64 {
    PI * shear_modulus / (32.0 * flexibility)
}

/// Dimensions of a throw, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Throw {
    /// Between the webs.
    pub pin: Step,
    /// Between the webs of this throw and the next.
    pub journal: Step,
    /// Of the crankpin from the axis.
    pub radius: f64,
    /// Along the crank.
    pub web_thickness: f64,
    /// Across the throw.
    pub web_breadth: f64,
}

/// A formula for the stiffness of a throw.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ThrowFormula {
    /// Ker Wilson's.
    KerWilson,
    /// Carter's.
    Carter,
    /// Zimanenko's.
    Zimanenko,
    /// Pin, journal and webs as beams, without a fit.
    Bracket,
}

impl ThrowFormula {
    /// All of them, in the order of tables.
    pub const ALL: [Self; 4] = [Self::KerWilson, Self::Carter, Self::Zimanenko, Self::Bracket];

    /// The word used in engine files and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::KerWilson => "ker_wilson",
            Self::Carter => "carter",
            Self::Zimanenko => "zimanenko",
            Self::Bracket => "bracket",
        }
    }

    /// F of a throw from the middle of its crankpin to that of the next, 1/m³.
    pub fn flexibility(self, t: &Throw) -> f64 {
        let (a, b, h, r) = (t.pin.length, t.journal.length, t.web_thickness, t.radius);
        let (dp, dj, w) = (t.pin.diameter, t.journal.diameter, t.web_breadth);
        let (pin, journal, web) = (t.pin.fourth(), t.journal.fourth(), h * w.powi(3));
        match self {
            Self::KerWilson => (b + 0.4 * dj) / journal + (a + 0.4 * dp) / pin + (r - 0.2 * (dp + dj)) / web,
            Self::Carter => (b + 0.8 * h) / journal + 0.75 * a / pin + 1.5 * r / web,
            Self::Zimanenko => (b + 0.6 * h * dj / b) / journal + (0.8 * a + 0.2 * w * dj / r) / pin + r * (r / dp).sqrt() / web,
            // two webs: 2 R/(E h W³/12) = F 32/(pi G)
            Self::Bracket => b / journal + a / pin + 3.0 * PI / (8.0 * (1.0 + POISSON)) * r / web,
        }
    }

    /// Why the formula does not hold for a throw; nothing where it does.
    pub fn out_of_range(self, t: &Throw) -> Option<&'static str> {
        let overlap = 0.5 * (t.pin.diameter + t.journal.diameter) - t.radius;
        match self {
            Self::KerWilson if t.radius <= 0.2 * (t.pin.diameter + t.journal.diameter) => {
                Some("the throw is so short that its web would stiffen the crank: R up to 0.2 (D_p + D_j)")
            }
            Self::Bracket if overlap > 0.0 => Some("crankpin and journal overlap: the webs are no beams of length R"),
            _ => None,
        }
    }

    /// Stiffness of a throw from the middle of its crankpin to that of the next, N m/rad.
    pub fn stiffness(self, t: &Throw, shear_modulus: f64) -> f64 {
        stiffness(self.flexibility(t), shear_modulus)
    }
}
