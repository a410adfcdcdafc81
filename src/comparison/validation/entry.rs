//! A published number beside ours, with its role.

/// What a published number is to the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// An input.
    Given,
    /// Fitted to.
    Calibrated,
    /// Computed without having seen it.
    Predicted,
    /// Contradicts the rest of its source, as our own computation shows.
    Erratum,
    /// No model comes near it; set aside.
    Unexplained,
}

impl Role {
    /// The word in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Given => "given",
            Self::Calibrated => "calibrated",
            Self::Predicted => "predicted",
            Self::Erratum => "erratum",
            Self::Unexplained => "unexplained",
        }
    }
}

/// What kind of quantity a number is: those of one kind share a tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Natural frequency of chain or chain with absorber, Hz.
    Frequency,
    /// Natural frequency that another model gave, Hz.
    OtherModel,
    /// Critical speed, rpm.
    CriticalSpeed,
    /// Absorber stiffness, N m/rad.
    Stiffness,
    /// Absorber damping, N m s/rad.
    Damping,
    /// Amplitude of an order at the hub, degrees.
    Amplitude,
    /// Safety factor of the crank.
    SafetyFactor,
    /// Stress of the crank by our own loads.
    OwnStress,
    /// Safety factor by them.
    OwnMargin,
    /// Multiaxial safety factor, and stress behind it.
    Multiaxial,
    /// Such a factor where the stresses behind it are not printed.
    MultiaxialAlone,
    /// Anything else.
    Other,
}

/// A published number beside ours.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Number of the table, or `text`.
    pub table: String,
    /// Design; empty for what belongs to the engine.
    pub design: String,
    /// What it is.
    pub quantity: String,
    /// Its kind.
    pub kind: Kind,
    /// Its unit.
    pub unit: String,
    /// As printed.
    pub published: Option<f64>,
    /// Ours.
    pub computed: Option<f64>,
    /// Its role.
    pub role: Role,
    /// What a reader should know.
    pub note: String,
}

impl Entry {
    /// (computed - published)/published, per cent; nothing where either is missing or the published one is zero.
    pub fn deviation_percent(&self) -> Option<f64> {
        let (published, computed) = (self.published?, self.computed?);
        (published != 0.0).then(|| 100.0 * (computed / published - 1.0))
    }
}
