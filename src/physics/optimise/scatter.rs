//! What the making of absorbers scatters.

/// What the making of absorbers scatters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scatter {
    /// A parameter by its key, a share more or less.
    Share(&'static str, f64),
    /// A parameter by its key, an amount in its unit more or less.
    Amount(&'static str, f64),
    /// Hardness of rubber, Shore A more or less: its modulus follows by Gent's relation.
    Hardness(f64),
    /// Viscosity of oil, a share more or less: the relaxation time is tied to it.
    Viscosity(f64),
    /// Temperature of a compound or oil, K more or less: what follows it changes by the factor of its law about its reference.
    Temperature(f64),
}

impl Scatter {
    /// So many times as much.
    pub fn times(self, factor: f64) -> Self {
        match self {
            Self::Share(key, share) => Self::Share(key, share * factor),
            Self::Amount(key, amount) => Self::Amount(key, amount * factor),
            Self::Hardness(amount) => Self::Hardness(amount * factor),
            Self::Viscosity(share) => Self::Viscosity(share * factor),
            Self::Temperature(kelvin) => Self::Temperature(kelvin * factor),
        }
    }

    /// Share, or amount in the unit of its key.
    pub fn width(self) -> f64 {
        let (Self::Share(_, x) | Self::Amount(_, x) | Self::Hardness(x) | Self::Viscosity(x) | Self::Temperature(x)) = self;
        x
    }
}

/// Young's modulus of rubber by its hardness but for a factor \[Gent 1958\]: (56 + 7.62336 S)/(254 - 2.54 S).
pub(super) fn modulus_of_hardness(shore_a: f64) -> f64 {
    (56.0 + 7.623_36 * shore_a) / (254.0 - 2.54 * shore_a)
}

/// Softest and hardest rubber that the relation is used for, Shore A.
pub(super) const HARDNESS: (f64, f64) = (10.0, 95.0);
