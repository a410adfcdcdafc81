//! Conditions an absorber is judged in: everything works, a cylinder misfires, the cylinders burn unequally, the absorber is cold, hot, aged, locked or
//! lost.

use crate::absorber::{Host, Mounted, State};
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
    /// No cylinder burns: the fuel is cut off.
    Overrun,
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

/// How the cylinders burn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[doc(hidden)]
pub enum Burning {
    /// All alike.
    Alike,
    /// All but one, each of them in turn.
    AllButOne,
    /// As unequally as the study says.
    Unequally,
    /// None.
    NotAtAll,
}

/// What becomes of the absorbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Absorbers {
    AsGiven,
    InState(State),
    InOperation,
    Locked,
    Lost,
}

impl Condition {
    /// Those that a study may name, in the order of its words; in operation an absorber is where its material says how.
    #[doc(hidden)]
    pub const NAMED: [Self; 9] = [
        Self::Firing,
        Self::Misfire,
        Self::UnequalCylinders,
        Self::Overrun,
        Self::Cold,
        Self::Hot,
        Self::Aged,
        Self::AbsorberLocked,
        Self::AbsorberLost,
    ];

    /// Its word, how the cylinders burn, and what becomes of the absorbers.
    fn row(self) -> (&'static str, Burning, Absorbers) {
        match self {
            Self::Firing => ("firing", Burning::Alike, Absorbers::AsGiven),
            Self::Misfire => ("misfire", Burning::AllButOne, Absorbers::AsGiven),
            Self::UnequalCylinders => ("unequal_cylinders", Burning::Unequally, Absorbers::AsGiven),
            Self::Overrun => ("overrun", Burning::NotAtAll, Absorbers::AsGiven),
            Self::Cold => ("cold", Burning::Alike, Absorbers::InState(State::Cold)),
            Self::Hot => ("hot", Burning::Alike, Absorbers::InState(State::Hot)),
            Self::Aged => ("aged", Burning::Alike, Absorbers::InState(State::Aged)),
            Self::InOperation => ("in_operation", Burning::Alike, Absorbers::InOperation),
            Self::AbsorberLocked => ("absorber_locked", Burning::Alike, Absorbers::Locked),
            Self::AbsorberLost => ("absorber_lost", Burning::Alike, Absorbers::Lost),
        }
    }

    /// The word used in studies, columns and file names.
    pub fn name(self) -> &'static str {
        self.row().0
    }

    /// How the cylinders burn.
    #[doc(hidden)]
    pub fn burning(self) -> Burning {
        self.row().1
    }

    /// Whether an absorber works in it.
    #[doc(hidden)]
    pub fn has_absorbers(self) -> bool {
        !matches!(self.row().2, Absorbers::Locked | Absorbers::Lost)
    }

    /// The engine of this condition is one whose units are like these.
    #[doc(hidden)]
    pub fn is_with(self, units: Units) -> bool {
        match self.burning() {
            Burning::Alike => units == Units::Equal,
            Burning::AllButOne => matches!(units, Units::Misfiring(_)),
            Burning::Unequally => units == Units::Unequal,
            Burning::NotAtAll => units == Units::Motored,
        }
    }

    /// The state of the materials that it is.
    #[doc(hidden)]
    pub fn material(self) -> Option<State> {
        if let Absorbers::InState(state) = self.row().2 { Some(state) } else { None }
    }

    /// Whether it is service with all cylinders firing alike and absorbers as they are: what rules call normal firing.
    #[doc(hidden)]
    pub fn is_service(self) -> bool {
        matches!(self, Self::Firing | Self::InOperation)
    }

    /// Whether what is limited here, or `in_service` only, counts.
    #[doc(hidden)]
    pub fn counts(self, in_service: bool) -> bool {
        !in_service || self.is_service()
    }

    /// Whether it makes no difference to a design: there are no absorbers, or none whose material it changes.
    #[doc(hidden)]
    pub fn changes_nothing(self, design: &[Mounted]) -> bool {
        match self.row().2 {
            Absorbers::AsGiven => false,
            Absorbers::Locked | Absorbers::Lost => design.is_empty(),
            Absorbers::InOperation => !design.iter().any(|m| m.absorber.follows_motion()),
            Absorbers::InState(state) => design.iter().all(|m| m.absorber.in_state(state).is_none()),
        }
    }

    /// The absorbers of a design in this condition; in operation those of the reference, as their state is another one at every speed. What sat on a lost ring is lost with it.
    pub fn absorbers(self, design: &[Mounted]) -> Vec<Mounted> {
        let lost = |m: &Mounted| match m.on {
            Host::Station(_) => m.locked(0.0),
            Host::Ring(_) => Mounted { hub_inertia: 0.0, ..m.locked(0.0) },
        };
        match self.row().2 {
            Absorbers::AsGiven | Absorbers::InOperation => design.to_vec(),
            Absorbers::InState(state) => {
                let changed =
                    |m: &Mounted| Mounted { absorber: m.absorber.in_state(state).unwrap_or_else(|| m.absorber.clone()), ..m.clone() };
                design.iter().map(changed).collect()
            }
            Absorbers::Locked => design.iter().map(|m| m.locked(m.absorber.ring_inertia())).collect(),
            Absorbers::Lost => design.iter().map(lost).collect(),
        }
    }
}
