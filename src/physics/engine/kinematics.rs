//! Motion of the piston of a centric slider-crank.

use crate::numerics::elementary::Elementary;

/// Which law relates piston travel to crank angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kinematics {
    /// The rigid mechanism.
    Exact,
    /// The two-term series of the theses, \[Villalva 2014\] eqs. (3.63) to (3.65): off by terms of the order of (r/L)^3.
    Truncated,
}

/// A crank and a rod; the piston moves towards the crankshaft from firing dead centre at angle zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SliderCrank {
    /// Half the stroke, m.
    pub crank_radius: f64,
    /// Between the eyes, m; longer than the crank radius.
    pub rod_length: f64,
    /// The law used.
    pub kinematics: Kinematics,
}

/// Piston travel from dead centre and its derivatives with respect to the crank angle, m, m/rad and m/rad².
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PistonMotion {
    /// x(theta).
    pub travel: f64,
    /// dx/dtheta: the lever of the piston force on the crank.
    pub slope: f64,
    /// d²x/dtheta².
    pub curvature: f64,
}

/// Lean of the rod and its derivatives with respect to the crank angle, rad, 1 and 1/rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lean {
    /// beta(theta), with L sin beta = r sin theta.
    pub angle: f64,
    /// dbeta/dtheta.
    pub slope: f64,
    /// d²beta/dtheta².
    pub curvature: f64,
}

impl SliderCrank {
    /// Lean of the rod, exact. `theta` in rad from firing dead centre.
    pub fn lean(&self, theta: f64) -> Lean {
        let (sine, cosine) = theta.sine_cosine();
        let ratio = self.crank_radius / self.rod_length;
        let sin_beta = ratio * sine;
        let cos_beta = (1.0 - sin_beta * sin_beta).sqrt();
        let slope = ratio * cosine / cos_beta;
        Lean { angle: sin_beta.arcsine(), slope, curvature: sin_beta / cos_beta * (slope * slope - 1.0) }
    }

    /// Travel x = r (1 - cos theta) + L (1 - cos beta) with L sin beta = r sin theta, and its exact derivatives; or the truncated series with
    /// its own derivatives. `theta` in rad from firing dead centre.
    pub fn motion(&self, theta: f64) -> PistonMotion {
        let (r, l) = (self.crank_radius, self.rod_length);
        let (sine, cosine) = theta.sine_cosine();
        match self.kinematics {
            Kinematics::Exact => {
                let ratio = r / l;
                let sin_beta = ratio * sine;
                let cos_beta = (1.0 - sin_beta * sin_beta).sqrt();
                // dbeta/dtheta
                let rate = ratio * cosine / cos_beta;
                // 1 - cos beta without cancellation near dead centre
                let shortening = l * sin_beta * sin_beta / (1.0 + cos_beta);
                PistonMotion {
                    travel: r * (1.0 - cosine) + shortening,
                    slope: r * (sine + cosine * sin_beta / cos_beta),
                    curvature: r * (cosine - sine * sin_beta / cos_beta + cosine * rate / (cos_beta * cos_beta)),
                }
            }
            Kinematics::Truncated => {
                let ratio = r / l;
                let (sine2, cosine2) = (2.0 * theta).sine_cosine();
                PistonMotion {
                    travel: r * (1.0 - cosine) + 0.25 * r * ratio * (1.0 - cosine2),
                    slope: r * (sine + 0.5 * ratio * sine2),
                    curvature: r * (cosine + ratio * cosine2),
                }
            }
        }
    }
}
