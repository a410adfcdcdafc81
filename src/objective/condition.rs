//! Conditions an absorber is judged in: everything works, a cylinder misfires, the cylinders burn unequally, the absorber is cold, hot, aged, locked or
//! lost.

use crate::absorber::{Absorber, Host, Mounted, State};
use crate::engine::Units;

/// State of engine and absorbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub enum Condition {
    /// Everything works.
    Firing,
    /// One cylinder, any of them, compresses and expands without burning.
    Misfire,
    /// The cylinders burn as unequally as the study says.
    UnequalCylinders,
    /// The materials of the absorbers are as cold as the study says.
    Cold,
    /// They are as hot as it says.
    Hot,
    /// They are aged.
    Aged,
    /// They are at the temperature and strain that the motion gives them, where a material says how.
    InOperation,
    /// The rings turn with their hubs: a seized damper, or a spring far too stiff.
    AbsorberLocked,
    /// The rings are gone; the hubs stay.
    AbsorberLost,
}

impl Condition {
    /// The word used in studies, columns and file names.
    pub fn name(self) -> &'static str {
        match self {
            Self::Firing => "firing",
            Self::Misfire => "misfire",
            Self::UnequalCylinders => "unequal_cylinders",
            Self::Cold => "cold",
            Self::Hot => "hot",
            Self::Aged => "aged",
            Self::InOperation => "in_operation",
            Self::AbsorberLocked => "absorber_locked",
            Self::AbsorberLost => "absorber_lost",
        }
    }

    /// The engine of this condition is one whose units are like these.
    pub(crate) fn is_with(self, units: Units) -> bool {
        match self {
            Self::Misfire => matches!(units, Units::Misfiring(_)),
            Self::UnequalCylinders => units == Units::Unequal,
            Self::Firing | Self::Cold | Self::Hot | Self::Aged | Self::InOperation | Self::AbsorberLocked | Self::AbsorberLost => {
                units == Units::Equal
            }
        }
    }

    /// The state of the materials that it is.
    pub(crate) fn material(self) -> Option<State> {
        match self {
            Self::Cold => Some(State::Cold),
            Self::Hot => Some(State::Hot),
            Self::Aged => Some(State::Aged),
            _ => None,
        }
    }

    /// Whether it makes no difference to a design: there are no absorbers, or none whose material it changes.
    pub(crate) fn changes_nothing(self, design: &[Mounted]) -> bool {
        match self {
            Self::Firing | Self::Misfire | Self::UnequalCylinders => false,
            Self::AbsorberLocked | Self::AbsorberLost => design.is_empty(),
            Self::InOperation => !design.iter().any(|m| m.absorber.follows_motion()),
            Self::Cold | Self::Hot | Self::Aged => {
                self.material().is_some_and(|state| design.iter().all(|m| m.absorber.in_state(state).is_none()))
            }
        }
    }

    /// The absorbers of a design in this condition; in operation those of the reference, as their state is another one at every speed. What sat on a lost ring is lost with it.
    pub fn absorbers(self, design: &[Mounted]) -> Vec<Mounted> {
        let locked = |m: &Mounted, ring_inertia| Mounted { absorber: Absorber::Locked { ring_inertia }, ..m.clone() };
        let lost = |m: &Mounted| match m.on {
            Host::Station(_) => locked(m, 0.0),
            Host::Ring(_) => Mounted { hub_inertia: 0.0, ..locked(m, 0.0) },
        };
        match self {
            Self::Firing | Self::Misfire | Self::UnequalCylinders | Self::InOperation => design.to_vec(),
            Self::Cold | Self::Hot | Self::Aged => {
                let state = |m: &Mounted| self.material().and_then(|state| m.absorber.in_state(state));
                design.iter().map(|m| state(m).map_or_else(|| m.clone(), |absorber| Mounted { absorber, ..m.clone() })).collect()
            }
            Self::AbsorberLocked => design.iter().map(|m| locked(m, m.absorber.ring_inertia())).collect(),
            Self::AbsorberLost => design.iter().map(lost).collect(),
        }
    }
}
