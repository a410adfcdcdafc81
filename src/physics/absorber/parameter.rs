//! What a type of absorber may be given: its parameters, as studies, tables and optimisers see them.

use super::closed_forms::EngineMode;

/// What values of a parameter make sense.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Range {
    /// Above zero.
    Positive,
    /// Above this number.
    Above(f64),
    /// At least zero.
    NotNegative,
    /// From the one to the other.
    Within(f64, f64),
}

impl Range {
    /// Whether a value makes sense.
    #[doc(hidden)]
    pub fn holds(self, x: f64) -> bool {
        x.is_finite()
            && match self {
                Self::Positive => x > 0.0,
                Self::NotNegative => x >= 0.0,
                Self::Above(least) => x > least,
                Self::Within(low, high) => (low..=high).contains(&x),
            }
    }

    /// The value in it that is nearest to one of the right sign.
    #[doc(hidden)]
    pub fn nearest(self, x: f64) -> f64 {
        match self {
            Self::Positive | Self::NotNegative => x,
            Self::Above(least) => x.max(least * (1.0 + 1e-9)),
            Self::Within(low, high) => x.clamp(low, high),
        }
    }
}

/// How a parameter follows the factor by which temperature changes a material.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Follows {
    /// Not at all.
    Nothing,
    /// It is multiplied by it.
    Factor,
    /// It is divided by it.
    Inverse,
}

/// What a search is told of the engine: modes that an absorber may be tuned to, the lowest first.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings<'a> {
    /// Elastic modes that move the absorber's station; may be empty.
    pub modes: &'a [EngineMode],
    /// Inertia of the ring (its largest), kg m².
    pub ring_inertia: f64,
}

impl Surroundings<'_> {
    /// The first mode; without any, 100 rad/s is as good as any.
    pub fn first(&self) -> EngineMode {
        self.modes.first().copied().unwrap_or(EngineMode { inertia: self.ring_inertia, omega: 100.0 })
    }

    /// Highest of the circular frequencies, rad/s.
    pub(crate) fn highest(&self) -> f64 {
        self.modes.iter().map(|m| m.omega).fold(self.first().omega, f64::max)
    }

    /// Frequency that typical values belong to: that of the first mode, rad/s.
    pub fn typical(&self) -> f64 {
        self.modes.first().map_or(1.0, |m| m.omega)
    }
}

/// A parameter of a type of absorber.
#[derive(Debug, Clone, Copy)]
pub struct Parameter {
    /// Its key in studies and its column in tables, unit included.
    pub key: &'static str,
    /// The head of its column in printed tables.
    pub label: &'static str,
    /// What it is, in a sentence.
    pub about: &'static str,
    /// Values that make sense.
    pub range: Range,
    /// Whether it grows with the ring where the tuning is kept.
    pub extensive: bool,
    /// Whether nothing is dissipated where it is zero.
    pub dissipative: bool,
    /// Whether it is a property of a material: a study has to give its value, or its bounds.
    pub material: bool,
    /// How it follows temperature, where an absorber says how its material does.
    pub follows: Follows,
    /// Lower and upper bound of a search, where a study gives none: wide enough to lock the ring and to let it loose.
    pub bounds: fn(&Surroundings) -> (f64, f64),
    /// A typical value; a thousandth of it acts like zero.
    pub typical: fn(&Surroundings) -> f64,
}

/// A property of a material that temperature leaves as it is.
pub(super) const fn of_material(
    (key, label, about): (&'static str, &'static str, &'static str),
    range: Range,
    bounds: fn(&Surroundings) -> (f64, f64),
    typical: fn(&Surroundings) -> f64,
) -> Parameter {
    Parameter { key, label, about, range, extensive: false, dissipative: false, material: true, follows: Follows::Nothing, bounds, typical }
}

/// Inertia of the ring; a study always gives its bounds.
pub const RING_INERTIA: Parameter = Parameter {
    key: "ring_inertia_kg_m2",
    label: "ring/kg m²",
    about: "Inertia of the ring.",
    range: Range::Positive,
    extensive: true,
    dissipative: false,
    material: false,
    follows: Follows::Nothing,
    bounds: |s| (s.ring_inertia, s.ring_inertia),
    typical: |s| s.ring_inertia,
};

/// Stiffness of a spring, up to 10⁴ times that tuned to the highest mode.
pub const STIFFNESS: Parameter = Parameter {
    key: "stiffness_n_m_per_rad",
    label: "k/N m/rad",
    about: "Stiffness of the spring.",
    range: Range::NotNegative,
    extensive: true,
    dissipative: false,
    material: false,
    follows: Follows::Nothing,
    bounds: |s| (0.0, 1e4 * s.ring_inertia * s.highest() * s.highest()),
    typical: |s| s.ring_inertia * s.typical() * s.typical(),
};

/// Damping of a viscous damper, up to 10³ times that of the best one without a spring.
pub const DAMPING: Parameter = Parameter {
    key: "damping_n_m_s_per_rad",
    label: "c/N m s/rad",
    about: "Damping of the damper.",
    range: Range::NotNegative,
    extensive: true,
    dissipative: true,
    material: false,
    follows: Follows::Nothing,
    bounds: |s| (0.0, 1e3 * super::closed_forms::viscous_damping(s.ring_inertia, s.first())),
    typical: |s| s.ring_inertia * s.typical(),
};
