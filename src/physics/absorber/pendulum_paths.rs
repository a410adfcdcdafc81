//! Centrifugal pendulums on paths, with their swing as large as it is.
//!
//! A mass at the distance R from the axis on a path of arc s, symmetric about R0, moves by \[Denman 1992\]
//!
//! ```text
//! s'' + G theta'' - 1/2 (dR²/ds) (Omega + theta')² = -(c_p/m) s',      G² = R² - 1/4 (dR²/ds)²,
//! T = N m (R² theta'' + (dR²/ds) s' (Omega + theta') + G s'' + (dG/ds) s'²).
//! ```
//!
//! The paths are those whose radius of curvature rho falls with the arc: rho² = rho0² - lambda² s², rho0 = R0/(n² + 1): a circle (lambda = 0), the tautochrone (lambda² = n²/(n² + 1): R² = R0² - n² s²,
//! whose frequency does not depend on the swing) and the cycloid (lambda = 1). In a field that grows with the radius the circle softens with the swing and the cycloid stiffens. All is divided by R0, so
//! that the twist is s/R0 and the ring inertia N m R0².

use super::dynamic_stiffness::{Operating, OperatingOver};
use super::large_twist::{Instant, LargeTwist, Reaction};
use super::law::{Declaration, Law};
use super::parameter::{DAMPING, RING_INERTIA};
use super::pendulum::{CLOSED_FORMS, Pendulum, TUNING_ORDER};
use crate::numerics::C64;
use crate::numerics::elementary::Elementary;
use crate::numerics::taylor::Taylor;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Shape of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Path {
    /// A simple pendulum, or one on two rollers in round holes.
    Circle,
    /// Tuned alike at every swing, if the shaft turned uniformly.
    Tautochrone,
    /// Tautochrone of a uniform field.
    Cycloid,
}

/// Pendulums on a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPendulum {
    /// Small swing.
    pub small: Pendulum,
    /// The path.
    pub path: Path,
}

/// A declaration of pendulums on a path.
macro_rules! on_path {
    ($name:ident, $word:literal, $path:expr, $doc:literal) => {
        #[doc = $doc]
        pub static $name: Declaration = Declaration {
            name: $word,
            about: $doc,
            parameters: &[RING_INERTIA, TUNING_ORDER, DAMPING],
            build: |v| {
                let small = Pendulum { ring_inertia: v[0], tuning_order: v[1], damping: v[2] };
                Arc::new(PathPendulum { small, path: $path })
            },
            closed_forms: &CLOSED_FORMS,
        };
    };
}

on_path!(CIRCULAR_PENDULUM, "circular_pendulum", Path::Circle, "Pendulums on circles.");
on_path!(TAUTOCHRONE_PENDULUM, "tautochrone_pendulum", Path::Tautochrone, "Pendulums on tautochrones.");
on_path!(CYCLOIDAL_PENDULUM, "cycloidal_pendulum", Path::Cycloid, "Pendulums on cycloids.");

/// A path at an arc, over R0: R²' and its derivative, Gamma = G/R0 with two derivatives.
#[derive(Debug, Clone, Copy)]
struct OnPath {
    square: f64,
    slope: f64,
    slope_by: f64,
    gamma: f64,
    gamma_by: f64,
    gamma_by2: f64,
}

impl PathPendulum {
    /// rho0 and lambda.
    fn shape(&self) -> (f64, f64) {
        let n2 = self.small.tuning_order * self.small.tuning_order;
        let lambda = match self.path {
            Path::Circle => 0.0,
            Path::Tautochrone => (n2 / (n2 + 1.0)).sqrt(),
            Path::Cycloid => 1.0,
        };
        (1.0 / (n2 + 1.0), lambda)
    }

    /// The direction of the path turns by phi and its end moves by (X, 1 - Y) from the vertex; with Y' = -sin phi, X' = cos phi: R² = X² + Y², R²' = 2 (X cos phi - Y sin phi), G = X sin phi + Y cos phi.
    fn at(&self, arc: f64) -> OnPath {
        let (rho0, lambda) = self.shape();
        let rho = (rho0 * rho0 - lambda * lambda * arc * arc).sqrt();
        let (phi, x, fallen) = if lambda == 0.0 {
            let phi = arc / rho0;
            (phi, rho0 * phi.sine(), rho0 * (1.0 - phi.cosine()))
        } else {
            let psi = (lambda * arc / rho0).arcsine();
            let (sum, difference) = (1.0 / lambda + 1.0, 1.0 / lambda - 1.0);
            // sin(a psi)/a and (1 - cos(a psi))/a, with their limits where a is zero
            let sine = |a: f64| if a == 0.0 { psi } else { (a * psi).sine() / a };
            let versine = |a: f64| if a == 0.0 { 0.0 } else { 2.0 * (0.5 * a * psi).sine().powi(2) / a };
            let half = 0.5 * rho0 / lambda;
            (psi / lambda, half * (sine(sum) + sine(difference)), half * (versine(sum) + versine(difference)))
        };
        let (y, sin, cos) = (1.0 - fallen, phi.sine(), phi.cosine());
        let (curvature, curvature_by) = (1.0 / rho, lambda * lambda * arc / rho.powi(3));
        let (slope, gamma) = (2.0 * (x * cos - y * sin), x * sin + y * cos);
        let slope_by = 2.0 * (1.0 - gamma * curvature);
        let gamma_by = 0.5 * slope * curvature;
        let gamma_by2 = 0.5 * (slope_by * curvature + slope * curvature_by);
        OnPath { square: x * x + y * y, slope, slope_by, gamma, gamma_by, gamma_by2 }
    }
}

impl Law for PathPendulum {
    fn declaration(&self) -> &'static Declaration {
        match self.path {
            Path::Circle => &CIRCULAR_PENDULUM,
            Path::Tautochrone => &TAUTOCHRONE_PENDULUM,
            Path::Cycloid => &CYCLOIDAL_PENDULUM,
        }
    }
    fn values(&self) -> Vec<f64> {
        self.small.values()
    }
    fn ring_inertia(&self) -> f64 {
        self.small.ring_inertia
    }
    fn over(&self, values: &[Taylor], at: &OperatingOver) -> Option<Taylor> {
        self.small.over(values, at)
    }
    fn dynamic_stiffness(&self, at: Operating) -> C64 {
        self.small.dynamic_stiffness(at)
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        self.small.derivatives(at)
    }
    fn depends_on_speed(&self) -> bool {
        true
    }
    fn large_twist(&self) -> Option<&dyn LargeTwist> {
        Some(self)
    }
}

impl LargeTwist for PathPendulum {
    fn reactions(&self, at: &Instant) -> (Reaction, Reaction) {
        let Instant { twist, rate, acceleration, hub_rate, hub_acceleration, shaft_speed } = *at;
        let (j, p, speed) = (self.small.ring_inertia, self.at(twist), shaft_speed + hub_rate);
        let own = Reaction {
            value: j * (acceleration + p.gamma * hub_acceleration - 0.5 * p.slope * speed * speed) + self.small.damping * rate,
            by: [
                j * (p.gamma_by * hub_acceleration - 0.5 * p.slope_by * speed * speed),
                self.small.damping,
                j,
                -j * p.slope * speed,
                j * p.gamma,
            ],
        };
        let torque = Reaction {
            value: j * (p.square * hub_acceleration + p.slope * rate * speed + p.gamma * acceleration + p.gamma_by * rate * rate),
            by: [
                j * (p.slope * hub_acceleration + p.slope_by * rate * speed + p.gamma_by * acceleration + p.gamma_by2 * rate * rate),
                j * (p.slope * speed + 2.0 * p.gamma_by * rate),
                j * p.gamma,
                j * p.slope * rate,
                j * p.square,
            ],
        };
        (own, torque)
    }
    fn is_ring(&self) -> bool {
        false
    }
    fn largest_twist(&self) -> Option<f64> {
        let (rho0, lambda) = self.shape();
        // on a circle half a turn either way: beyond it the mass would pass over the top
        Some(if lambda == 0.0 { PI * rho0 } else { rho0 / lambda })
    }
    fn full_turn(&self) -> Option<f64> {
        let (rho0, lambda) = self.shape();
        (lambda == 0.0).then_some(TAU * rho0)
    }
}
