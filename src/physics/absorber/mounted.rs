//! Absorbers and where they sit: on stations of the chain, or on the ring of another absorber.

use super::law::{Declaration, Law};
use super::material::Material;
use super::material_state::State;
use serde::ser::{Serialize, SerializeMap, Serializer};
use std::sync::Arc;

/// A ring with its law, or one that has seized.
#[derive(Debug, Clone)]
pub enum Absorber {
    /// A ring that moves against its hub.
    Ring(Arc<dyn Law>),
    /// A ring that turns with its hub: an inertia, kg m²; nothing where it is zero.
    Locked {
        /// kg m².
        ring_inertia: f64,
    },
}

impl PartialEq for Absorber {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            // tables and branches are no values
            (Self::Ring(a), Self::Ring(b)) => {
                a.declaration() == b.declaration() && a.values() == b.values() && format!("{a:?}") == format!("{b:?}")
            }
            (Self::Locked { ring_inertia: a }, Self::Locked { ring_inertia: b }) => a == b,
            _ => false,
        }
    }
}

impl Serialize for Absorber {
    /// The type with its values by their keys.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let values = match self {
            Self::Ring(law) => law.declaration().parameters.iter().map(|p| p.key).zip(law.values()).collect(),
            Self::Locked { ring_inertia } => vec![(super::parameter::RING_INERTIA.key, *ring_inertia)],
        };
        let mut map = serializer.serialize_map(Some(1 + values.len()))?;
        map.serialize_entry("type", self.type_name())?;
        for (key, value) in &values {
            map.serialize_entry(key, value)?;
        }
        map.end()
    }
}

impl<L: Law + 'static> From<L> for Absorber {
    fn from(law: L) -> Self {
        Self::Ring(Arc::new(law))
    }
}

impl Absorber {
    /// Inertia of the ring, kg m².
    pub fn ring_inertia(&self) -> f64 {
        match self {
            Self::Ring(law) => law.ring_inertia(),
            Self::Locked { ring_inertia } => *ring_inertia,
        }
    }

    /// The law, where the ring moves.
    pub fn law(&self) -> Option<&Arc<dyn Law>> {
        match self {
            Self::Ring(law) => Some(law),
            Self::Locked { .. } => None,
        }
    }

    /// The same in a state of its material; nothing where that changes nothing.
    #[doc(hidden)]
    pub fn in_state(&self, state: State) -> Option<Self> {
        self.law()?.in_state(state).map(Self::Ring)
    }

    /// Whether its material says how its state follows from the motion.
    #[doc(hidden)]
    pub fn follows_motion(&self) -> bool {
        self.law().and_then(|law| law.material()).is_some_and(Material::follows_motion)
    }

    /// The type, where the ring moves.
    pub fn declaration(&self) -> Option<&'static Declaration> {
        self.law().map(|law| law.declaration())
    }

    /// The word used in studies and tables.
    #[doc(hidden)]
    pub fn type_name(&self) -> &'static str {
        self.declaration().map_or("locked", |d| d.name)
    }

    /// Stiffness of the spring, N m/rad: zero where there is none, nothing where the ring is locked or its stiffness is no single number.
    pub fn stiffness(&self) -> Option<f64> {
        let constant = self.law().and_then(|law| law.spring_and_damper());
        constant.map(|s| s.stiffness).or_else(|| self.value(super::parameter::STIFFNESS.key))
    }

    /// Damping of the viscous damper, N m s/rad: zero where there is none, nothing where the law has no such number.
    pub fn damping(&self) -> Option<f64> {
        match self {
            Self::Locked { .. } => Some(0.0),
            Self::Ring(law) => law.spring_and_damper().map(|s| s.damping).or_else(|| self.value(super::parameter::DAMPING.key)),
        }
    }

    /// Loss factor c omega/k of spring and damper together at the ring's own frequency sqrt(k/J), c/sqrt(k J), with that frequency, rad/s: what a spring without a damper would
    /// need. Nothing where the law is no spring with a damper.
    #[doc(hidden)]
    pub fn implied_loss_factor(&self) -> Option<(f64, f64)> {
        let both = self.law()?.spring_and_damper()?;
        let own = (both.stiffness / self.ring_inertia()).sqrt();
        (own > 0.0 && own.is_finite()).then(|| (both.damping * own / both.stiffness, own))
    }

    /// The value of a parameter by its key, where the type has it.
    pub fn value(&self, key: &str) -> Option<f64> {
        match self {
            Self::Ring(law) => law.declaration().index(key).map(|i| law.values()[i]),
            Self::Locked { ring_inertia } => (key == super::parameter::RING_INERTIA.key).then_some(*ring_inertia),
        }
    }
}

/// What carries the hub of an absorber.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize)]
pub enum Host {
    /// A station of the chain, by its index.
    Station(usize),
    /// The ring of another absorber, by its index in the design.
    Ring(usize),
}

/// An absorber in its place.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Mounted {
    /// What carries the hub.
    pub on: Host,
    /// Inertia of hub or housing, added to what carries it, kg m²; beside that of a housing that follows from dimensions.
    pub hub_inertia: f64,
    /// The absorber.
    pub absorber: Absorber,
}

impl Mounted {
    /// An absorber without hub inertia on a station.
    pub fn on_station(station: usize, absorber: impl Into<Absorber>) -> Self {
        Self { on: Host::Station(station), hub_inertia: 0.0, absorber: absorber.into() }
    }

    /// An absorber without hub inertia on the ring of another one of the design.
    pub fn on_ring(inner: usize, absorber: impl Into<Absorber>) -> Self {
        Self { on: Host::Ring(inner), hub_inertia: 0.0, absorber: absorber.into() }
    }

    /// Inertia of hub or housing, that of its dimensions with it, kg m².
    #[doc(hidden)]
    pub fn hub(&self) -> f64 {
        self.hub_inertia + self.absorber.law().map_or(0.0, |law| law.hub_inertia())
    }

    /// The same with its ring locked, of another inertia (kg m²) if need be: hub and housing stay.
    #[must_use]
    pub(crate) fn locked(&self, ring_inertia: f64) -> Self {
        Self { on: self.on, hub_inertia: self.hub(), absorber: Absorber::Locked { ring_inertia } }
    }

    /// The same with a hub or housing, kg m².
    #[must_use]
    pub fn with_hub(self, hub_inertia: f64) -> Self {
        Self { hub_inertia, ..self }
    }
}

/// A design with the law of one absorber changed; the same where that is locked.
#[doc(hidden)]
pub fn with_law(design: &[Mounted], index: usize, change: impl FnOnce(&Arc<dyn Law>) -> Arc<dyn Law>) -> Vec<Mounted> {
    let mut changed = design.to_vec();
    if let Absorber::Ring(law) = &design[index].absorber {
        changed[index].absorber = Absorber::Ring(change(law));
    }
    changed
}

/// Station that carries an absorber of a design, through the rings between.
pub fn station_of(design: &[Mounted], index: usize) -> usize {
    let mut at = index;
    // a design is a tree: no path is longer than it
    for _ in 0..=design.len() {
        match design[at].on {
            Host::Station(station) => return station,
            Host::Ring(inner) => at = inner,
        }
    }
    unreachable!("rings that carry each other are refused where a design is made")
}

/// Whether every absorber on a ring finds one, and none carries itself.
#[doc(hidden)]
pub fn is_tree(design: &[Mounted]) -> bool {
    (0..design.len()).all(|i| {
        let mut at = i;
        for _ in 0..=design.len() {
            match design[at].on {
                Host::Station(_) => return true,
                Host::Ring(inner) if inner < design.len() => at = inner,
                Host::Ring(_) => return false,
            }
        }
        false
    })
}
