//! Absorbers of a design condensed onto their stations at one frequency.
//!
//! A ring of inertia J on a law S, with dynamic stiffness m = -omega² J + (what sits on it) to inertial space, gives its host
//! z = -omega² J_hub + S m/(S + m); its twist against the host is -m/(S + m) of the host's angle. All are kept as fractions: they stay finite where
//! an undamped ring resonates (the host stands still) and where one that sits on another does.

use super::construction::hub_derivatives;
use super::dynamic_stiffness::Operating;
use super::mounted::{Absorber, Host, Mounted};
use crate::numerics::C64;

/// Dynamic stiffness that an absorber, with all that sits on its ring, adds to what carries it: z = numerator/denominator, N m/rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fraction {
    /// With its sign and the hub.
    pub numerator: C64,
    /// S + m, times the denominators of the absorbers on the ring.
    pub denominator: C64,
    /// m times those denominators: minus the twist of the ring per angle of the host, times the denominator.
    inertial: C64,
    /// S (one for a locked ring).
    stiffness: C64,
    /// Product of the denominators of the absorbers on the ring.
    carried: C64,
}

/// An absorber on a station.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Hub {
    /// Index of the absorber in the design.
    pub absorber: usize,
    /// Index of the station.
    pub station: usize,
    /// Numerator of z.
    pub numerator: C64,
    /// Denominator of z.
    pub denominator: C64,
}

/// An absorber of the design as seen from the hub on the station below it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ring {
    /// Index of that hub among the hubs.
    pub hub: usize,
    /// Angle of the absorber's host over its own denominator, per angle of the station over the hub's denominator.
    pub host: C64,
    /// Twist of the ring per angle of the station over the hub's denominator.
    pub twist: C64,
}

/// A design at one frequency.
#[derive(Debug, Clone, Default)]
pub(crate) struct Condensed {
    /// What acts on the stations, in the order of the design.
    pub hubs: Vec<Hub>,
    /// Every absorber, in the order of the design.
    pub rings: Vec<Ring>,
    fractions: Vec<Fraction>,
}

impl Condensed {
    /// Condenses a design.
    pub fn new(design: &[Mounted], at: Operating) -> Self {
        let mut condensed = Self::default();
        condensed.set(design, at);
        condensed
    }

    /// The same in place.
    pub fn set(&mut self, design: &[Mounted], at: Operating) {
        self.hubs.clear();
        self.rings.clear();
        self.fractions.clear();
        self.fractions.extend((0..design.len()).map(|i| fraction(design, i, at)));
        for (i, m) in design.iter().enumerate() {
            if let Host::Station(station) = m.on {
                let f = &self.fractions[i];
                self.hubs.push(Hub { absorber: i, station, numerator: f.numerator, denominator: f.denominator });
            }
        }
        for i in 0..design.len() {
            let (hub, host) = self.path(design, i);
            self.rings.push(Ring { hub, host, twist: host * -self.fractions[i].inertial });
        }
    }

    /// Hub below an absorber, and its host's angle over its denominator per unknown of that hub.
    fn path(&self, design: &[Mounted], index: usize) -> (usize, C64) {
        match design[index].on {
            Host::Station(_) => (self.hubs.iter().position(|h| h.absorber == index).unwrap_or_default(), C64::from(1.0)),
            Host::Ring(inner) => {
                let (hub, host) = self.path(design, inner);
                let others = (0..design.len()).filter(|j| *j != index && design[*j].on == Host::Ring(inner));
                let beside = others.fold(C64::from(1.0), |p, j| p * self.fractions[j].denominator);
                (hub, host * self.fractions[inner].stiffness * beside)
            }
        }
    }

    /// Angle of an absorber's host per angle of the station: by division, for places where no denominator vanishes.
    pub(crate) fn host_per_station(&self, design: &[Mounted], index: usize) -> C64 {
        match design[index].on {
            Host::Station(_) => C64::from(1.0),
            Host::Ring(inner) => {
                let f = &self.fractions[inner];
                self.host_per_station(design, inner) * (f.stiffness * f.carried / f.denominator)
            }
        }
    }

    /// Denominator of an absorber's z.
    pub(crate) fn denominator(&self, index: usize) -> C64 {
        self.fractions[index].denominator
    }

    /// Derivatives of an absorber's z with respect to its parameters (ring inertia first), times the square of its denominator.
    pub(crate) fn gradient_times_denominator2(&self, design: &[Mounted], index: usize, at: Operating) -> Vec<C64> {
        let f = &self.fractions[index];
        let passed = f.stiffness * f.carried;
        let by_inertia = passed * passed * (-at.omega * at.omega);
        let Absorber::Ring(law) = &design[index].absorber else { return vec![by_inertia] };
        let by_stiffness = f.inertial * f.inertial;
        let mut list: Vec<C64> = law.derivatives(at).into_iter().map(|d| by_stiffness * d).collect();
        list[0] += by_inertia;
        let by_hub = f.denominator * f.denominator * (-at.omega * at.omega);
        list.iter_mut().zip(hub_derivatives(law.as_ref())).for_each(|(d, by)| *d += by_hub * by);
        list
    }
}

fn fraction(design: &[Mounted], index: usize, at: Operating) -> Fraction {
    let m = &design[index];
    let omega2 = at.omega * at.omega;
    let ring = omega2 * m.absorber.ring_inertia();
    let (mut inertial, mut carried) = (C64::from(-ring), C64::from(1.0));
    for outer in (0..design.len()).filter(|j| design[*j].on == Host::Ring(index)) {
        let f = fraction(design, outer, at);
        inertial = inertial * f.denominator + f.numerator * carried;
        carried *= f.denominator;
    }
    let hub = omega2 * m.hub();
    match &m.absorber {
        Absorber::Locked { .. } => Fraction {
            numerator: inertial - carried * hub,
            denominator: carried,
            inertial: C64::from(0.0),
            stiffness: C64::from(1.0),
            carried,
        },
        Absorber::Ring(law) => {
            let s = law.dynamic_stiffness(at);
            let denominator = s * carried + inertial;
            Fraction { numerator: s * inertial - denominator * hub, denominator, inertial, stiffness: s, carried }
        }
    }
}
