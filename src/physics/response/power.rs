//! Mean power that the torques put in and that the dampers take out: equal in a steady motion, whatever the method, or the method is wrong.

use super::{Quantity, Response, ResponseError, Work};
use crate::absorber::{Host, Mounted, Operating};
use crate::drivetrain::Chain;
use crate::numerics::{C64, I, ZERO};
use crate::units::RAD_PER_S_PER_RPM;

/// Over a working cycle, W.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Power {
    /// Put in by the torques.
    pub input: f64,
    /// Taken out by dampers and hysteresis.
    pub dissipated: f64,
}

impl Power {
    /// What is missing of the input in what is dissipated, as a share of the input.
    pub fn missing(&self) -> f64 {
        (self.input - self.dissipated) / self.input
    }
}

/// Phasors of all bodies at one speed and order.
pub struct Motion {
    /// Angle of each station, rad.
    pub stations: Vec<C64>,
    /// Twist of each shaft length, rad.
    pub shafts: Vec<C64>,
    /// Twist of each ring, rad.
    pub rings: Vec<C64>,
}

impl Motion {
    /// Angles of the stations and, after them, of the rings: that of what carries the hub and the twist.
    pub fn angles(&self, design: &[Mounted]) -> Vec<C64> {
        let ring = |index: usize| {
            let (mut angle, mut at) = (self.rings[index], index);
            loop {
                match design[at].on {
                    Host::Station(station) => return angle + self.stations[station],
                    Host::Ring(inner) => {
                        angle += self.rings[inner];
                        at = inner;
                    }
                }
            }
        };
        self.stations.iter().copied().chain((0..design.len()).map(ring)).collect()
    }
}

/// What a method's own model dissipates, W, given circular frequency (rad/s) and phasors.
pub(crate) type Dissipated<'a> = &'a dyn Fn(f64, &Motion) -> f64;

/// Quantities that `powers` asks a method for, for tables.
pub fn quantities(chain: &Chain, rings: usize) -> Vec<Quantity> {
    let angles = (0..chain.len()).map(|from| Quantity::Twist { from, to: None });
    let twists = (0..chain.len() - 1).map(|from| Quantity::Twist { from, to: Some(chain.next(from)) });
    angles.chain(twists).chain((0..rings).map(Quantity::RingTwist)).collect()
}

/// Power at each grid speed from the phasors of a method, with the dampers of the system: sum over orders of Re(conj(T) i w theta)/2 against
/// w² c |theta|²/2 for dampers and w eta k |twist|²/2 for hysteresis; with `own`, against that.
///
/// # Errors
/// Those of the method.
#[doc(hidden)]
pub fn powers(method: &dyn Response, design: &[Mounted], own: Option<Dissipated>, work: &mut Work) -> Result<Vec<Power>, ResponseError> {
    let (system, n) = (method.system(), method.system().chain.len());
    let sweeps = method.sweep_each(design, &quantities(&system.chain, design.len()), work)?;
    let orders = method.orders().len();
    let mut torque = vec![ZERO; n];
    // twists between stations are referred to the crankshaft, those of links are not
    let ratios = system.chain.speed_ratios().unwrap_or_else(|| vec![1.0; n]);
    let motion_at = |point: usize| Motion {
        stations: sweeps[..n].iter().map(|s| s[point]).collect(),
        shafts: sweeps[n..2 * n - 1].iter().zip(&ratios).map(|(s, ratio)| s[point] * *ratio).collect(),
        rings: sweeps[2 * n - 1..].iter().map(|s| s[point]).collect(),
    };
    let mut list = Vec::new();
    for (i, &speed_rpm) in method.grid().speed_rpm.iter().enumerate() {
        let mut power = Power::default();
        for order in method.orders() {
            let omega = system.excitation.orders[order].omega(speed_rpm);
            let bodies = motion_at(i * orders + order);
            system.torque(order, speed_rpm, &mut torque);
            power.input += torque.iter().zip(&bodies.stations).map(|(t, y)| 0.5 * (t.conj() * I * omega * y).re).sum::<f64>();
            power.dissipated += match own {
                Some(own) => own(omega, &bodies),
                None => physical(method, design, Operating { omega, shaft_speed: speed_rpm * RAD_PER_S_PER_RPM }, &bodies),
            };
        }
        list.push(power);
    }
    Ok(list)
}

/// What the dampers of chain and absorbers take out, W.
fn physical(method: &dyn Response, design: &[Mounted], at: Operating, bodies: &Motion) -> f64 {
    let omega = at.omega;
    let viscous = |c: f64, y: &C64| 0.5 * c * omega * omega * y.norm_sqr();
    let stations = &method.system().chain.stations;
    let ground: f64 = stations.iter().zip(&bodies.stations).map(|(s, y)| viscous(s.damping_to_ground, y)).sum();
    let shaft = |(s, y): (&crate::drivetrain::Station, &C64)| {
        viscous(s.damping_to_next, y) + 0.5 * omega * s.stiffness_to_next * s.loss_factor_to_next * y.norm_sqr()
    };
    let shafts: f64 = stations.iter().zip(&bodies.shafts).map(shaft).sum();
    let rings: f64 = design.iter().zip(&bodies.rings).filter_map(|(m, y)| Some(m.absorber.law()?.dissipated_power(at, y.norm_sqr()))).sum();
    ground + shafts + rings
}
