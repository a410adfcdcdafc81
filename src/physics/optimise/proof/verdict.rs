//! What a proof says.

/// What a proof may cost, and how close it is to come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Share of the optimum below which no design is to be proved to lie.
    pub gap: f64,
    /// Boxes, at most.
    pub boxes: u64,
}

/// A box of designs: free parameters with their values, as keys and ranges.
pub type Ranges = Vec<(&'static str, f64, f64)>;

/// What was proved of an optimum.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Proof {
    /// No design within the bounds (that holds all limits) is below it, in the unit of the objective, positive; `None` where no design holds all limits, or nothing is proved.
    pub lower_bound: Option<f64>,
    /// At no speed is the optimum above it, nor beyond a limit by more than the gap; `None` where that is not proved.
    pub upper_bound: Option<f64>,
    /// Boxes that were looked at.
    pub boxes: u64,
    /// Better designs that were found in them, each of which led to a better optimum.
    pub better: usize,
    /// What came of it.
    pub verdict: Verdict,
}

/// How a proof ends.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// No design is below the optimum by more than the gap.
    Proved,
    /// No design holds all limits.
    Impossible,
    /// The boxes did not suffice, or what the rest is worse by has no enclosure; the box that says least.
    Open(Ranges),
    /// There is none.
    None(Reason),
}

impl Verdict {
    /// The word used in tables.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Proved => "proved",
            Self::Impossible => "impossible",
            Self::Open(_) => "open",
            Self::None(_) => "none",
        }
    }
}

/// Why there is no proof.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// The objective is a sum of others, or a mean over the duty.
    Sum,
    /// The objective has no enclosure.
    Objective,
    /// The law of a type has none.
    Law,
    /// More parameters are free than models have variables.
    Parameters,
    /// Absorbers on rings.
    Absorbers,
    /// Tolerances.
    Tolerances,
    /// A better design is known, but the search does not go on from there.
    Unfinished,
    /// Nothing may vary.
    NothingFree,
    /// Its value is zero.
    Zero,
}

impl Reason {
    /// In words, after "not proved: ".
    pub fn words(self) -> &'static str {
        match self {
            Self::Sum => "the objective is a sum or a mean",
            Self::Objective => "the objective has no enclosure",
            Self::Law => "the type of absorber has no enclosure",
            Self::Parameters => "more than six parameters are free",
            Self::Absorbers => "an absorber sits on a ring",
            Self::Tolerances => "within tolerances",
            Self::Unfinished => "a better design is known, from which the search does not go on",
            Self::NothingFree => "nothing is free",
            Self::Zero => "it is zero",
        }
    }
}

impl Proof {
    /// There is none, for a reason.
    #[doc(hidden)]
    pub fn none(reason: Reason) -> Self {
        Self { lower_bound: None, upper_bound: None, boxes: 0, better: 0, verdict: Verdict::None(reason) }
    }
}

/// What a proof finds.
pub(super) enum Found {
    /// A lower bound, where there is one, and how it ends.
    Ended(Option<f64>, Verdict),
    /// A point whose design is better than the optimum.
    Better(Vec<f64>),
}
