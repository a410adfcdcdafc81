//! Torsional vibration absorbers: a ring coupled to a station. One file a type.

mod locked;
pub mod seeds;
mod tuned;
mod undamped;
mod viscous;

pub use locked::Locked;
pub use tuned::Tuned;
pub use undamped::Undamped;
pub use viscous::Viscous;

use crate::numerics::C64;

/// What hartog needs to know of an absorber type with one ring.
pub trait Ring {
    /// Inertia of the ring, kg m².
    fn ring_inertia(&self) -> f64;
    /// Stiffness between hub and ring, N m/rad; infinite where the ring is locked.
    fn stiffness(&self) -> f64;
    /// Damping between hub and ring, N m s/rad.
    fn damping(&self) -> f64;
    /// The same absorber with other values; those the type does not have are left out.
    fn with(&self, ring_inertia: f64, stiffness: f64, damping: f64) -> Self;
}

/// The types of absorber.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// Spring only.
    Undamped,
    /// Spring and damper.
    Tuned,
    /// Damper only.
    Viscous,
    /// Seized: a dead inertia.
    Locked,
}

impl Kind {
    /// The word used in studies and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Undamped => "undamped",
            Self::Tuned => "tuned",
            Self::Viscous => "viscous",
            Self::Locked => "locked",
        }
    }

    /// An absorber of this type; values it does not have are left out.
    pub fn build(self, ring_inertia: f64, stiffness: f64, damping: f64) -> Absorber {
        match self {
            Self::Undamped => Absorber::Undamped(Undamped { ring_inertia, stiffness }),
            Self::Tuned => Absorber::Tuned(Tuned { ring_inertia, stiffness, damping }),
            Self::Viscous => Absorber::Viscous(Viscous { ring_inertia, damping }),
            Self::Locked => Absorber::Locked(Locked { ring_inertia }),
        }
    }
}

/// An absorber of any type.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Absorber {
    /// Spring only.
    Undamped(Undamped),
    /// Spring and damper.
    Tuned(Tuned),
    /// Damper only.
    Viscous(Viscous),
    /// Seized: a dead inertia.
    Locked(Locked),
}

macro_rules! each {
    ($self:expr, $a:ident => $body:expr) => {
        match $self {
            Absorber::Undamped($a) => $body,
            Absorber::Tuned($a) => $body,
            Absorber::Viscous($a) => $body,
            Absorber::Locked($a) => $body,
        }
    };
}

impl Absorber {
    /// Its type.
    pub fn kind(&self) -> Kind {
        match self {
            Self::Undamped(_) => Kind::Undamped,
            Self::Tuned(_) => Kind::Tuned,
            Self::Viscous(_) => Kind::Viscous,
            Self::Locked(_) => Kind::Locked,
        }
    }
}

impl Ring for Absorber {
    fn ring_inertia(&self) -> f64 {
        each!(self, a => a.ring_inertia())
    }
    fn stiffness(&self) -> f64 {
        each!(self, a => a.stiffness())
    }
    fn damping(&self) -> f64 {
        each!(self, a => a.damping())
    }
    fn with(&self, ring_inertia: f64, stiffness: f64, damping: f64) -> Self {
        self.kind().build(ring_inertia, stiffness, damping)
    }
}

/// An absorber on a station of the chain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mounted {
    /// Index of the station that carries the hub.
    pub station: usize,
    /// Inertia of hub or housing, added to the station, kg m².
    pub hub_inertia: f64,
    /// The absorber.
    pub absorber: Absorber,
}

/// Dynamic stiffness that an absorber adds to its station, as a fraction: z = numerator/denominator, N m/rad. The fraction stays finite
/// where an undamped ring resonates (denominator zero: the hub stands still).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DynamicStiffness {
    /// -omega² (J_ring S + J_hub denominator).
    pub numerator: C64,
    /// S - omega² J_ring, with S = k + i omega c.
    pub denominator: C64,
    /// Twist of the ring against the hub per hub angle, times the denominator: omega² J_ring.
    pub ring: f64,
}

impl Mounted {
    /// z(omega) = -omega² J_hub - omega² J_ring S/(S - omega² J_ring): the ring obeys -omega² J theta_ring = S (theta_hub - theta_ring).
    pub fn dynamic_stiffness(&self, omega: f64) -> DynamicStiffness {
        let a = &self.absorber;
        if a.kind() == Kind::Locked {
            let inertia = a.ring_inertia() + self.hub_inertia;
            return DynamicStiffness { numerator: C64::from(-omega * omega * inertia), denominator: C64::from(1.0), ring: 0.0 };
        }
        let s = C64::new(a.stiffness(), omega * a.damping());
        let ring = omega * omega * a.ring_inertia();
        let denominator = s - ring;
        DynamicStiffness { numerator: -ring * s - denominator * (omega * omega * self.hub_inertia), denominator, ring }
    }

    /// Derivatives of z with respect to ring inertia, stiffness and damping, times the square of the denominator.
    pub fn gradient_times_denominator2(&self, omega: f64) -> [C64; 3] {
        let a = &self.absorber;
        if a.kind() == Kind::Locked {
            return [C64::from(-omega * omega), C64::ZERO, C64::ZERO];
        }
        let s = C64::new(a.stiffness(), omega * a.damping());
        let inertia = -omega * omega * a.ring_inertia();
        let by_stiffness = C64::from(inertia * inertia);
        [s * s * (-omega * omega), by_stiffness, by_stiffness * C64::new(0.0, omega)]
    }
}
