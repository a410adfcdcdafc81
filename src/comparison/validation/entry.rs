//! A published number beside ours, with its role.

/// What a published number is to the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// An input.
    Given,
    /// Fitted to.
    Calibrated,
    /// By our own loads and models, without having seen it.
    Predicted,
    /// From other printed numbers of the same source.
    Recomputed,
    /// Fitted with as many free inputs as there are numbers: it proves nothing.
    FittedExactly,
    /// What another program or model gave for another model of the same engine.
    OtherModel,
    /// Contradicts the rest of its source, as our own computation shows.
    Erratum,
    /// No model comes near it; set aside.
    Unexplained,
}

impl Role {
    /// All, in the order of tables.
    pub const ALL: [Self; 8] = [
        Self::Predicted,
        Self::Recomputed,
        Self::Calibrated,
        Self::FittedExactly,
        Self::OtherModel,
        Self::Erratum,
        Self::Unexplained,
        Self::Given,
    ];

    /// The word in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Given => "given",
            Self::Calibrated => "calibrated",
            Self::Predicted => "predicted",
            Self::Recomputed => "recomputed",
            Self::FittedExactly => "fitted, no freedom left",
            Self::OtherModel => "other model",
            Self::Erratum => "erratum",
            Self::Unexplained => "unexplained",
        }
    }
}

/// How many standard errors an interval has on either side: 95 % of a normal distribution.
const STANDARD_ERRORS: f64 = 2.0;

/// Conversions of units and back may leave this share of a number.
const ROUNDING: f64 = 1e-9;

/// What kind of quantity a number is: those of one kind share a tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Natural frequency of chain or chain with absorber, Hz.
    Frequency,
    /// Natural frequency that another model gave, Hz.
    OtherModel,
    /// Natural frequency of the crank by itself, Hz.
    CrankMode,
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
    /// Largest resonance of one order at the hub, degrees, that a limit of the source is for.
    Accepted,
    /// Largest vibratory torque of a shaft at a speed, N m.
    VibratoryTorque,
    /// Stress of the crank by our own loads.
    OwnStress,
    /// Largest stress of the crank over the full cycle, by our own loads and the chain's torque.
    FullCycleStress,
    /// The same on the flexible crank, on its own bearings.
    FlexibleStress,
    /// Safety factor by them and the method of the source.
    OwnMargin,
    /// Safety factor by them over the full cycle.
    FullCycleMargin,
    /// Multiaxial safety factor, and stress behind it.
    Multiaxial,
    /// Such a factor where the stresses behind it are not printed.
    MultiaxialAlone,
    /// Angle of a printed plane, degrees.
    PlaneAngle,
    /// Anything else.
    Other,
}

impl Kind {
    /// Whether designs are ranked by it.
    pub(super) fn is_ranked(self) -> bool {
        matches!(self, Self::Amplitude | Self::VibratoryTorque) || self.is_margin()
    }

    /// Whether more of it is better.
    pub(super) fn is_margin(self) -> bool {
        matches!(self, Self::OwnMargin | Self::FullCycleMargin)
    }
}

/// How well a published number and ours are known, in their unit.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Uncertainty {
    /// Half of the last printed digit; `None` where nothing is printed.
    pub half_digit: Option<f64>,
    /// Standard error of ours that follows from those of the fitted inputs; `None` where it follows from no fitted input.
    pub standard_error: Option<f64>,
}

impl Uncertainty {
    /// Half the width of the interval that both leave: half of the last printed digit and two standard errors; `None` where nothing is printed.
    pub(super) fn half_width(&self) -> Option<f64> {
        Some(self.half_digit? + STANDARD_ERRORS * self.standard_error.unwrap_or(0.0))
    }
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
    /// How well both are known.
    pub uncertainty: Uncertainty,
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

    /// Whether ours is the printed number within the uncertainty of both; `None` where one is missing.
    #[doc(hidden)]
    pub fn is_within(&self) -> Option<bool> {
        let (published, computed) = (self.published?, self.computed?);
        let rounding = ROUNDING * published.abs();
        Some((computed - published).abs() <= self.uncertainty.half_width()? + rounding)
    }
}
