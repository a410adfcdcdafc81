//! A measure as a study names it: with its unit, and its names in tables and titles.

use crate::fatigue::shaft_rules::{HIGHEST_BARRED, ShaftRule};
use crate::objective::{AtExceptedSpeeds, Limit, Measure};
use crate::response::Rate;
use crate::units::{DEG_PER_RAD, M_PER_MM, PA_PER_MPA, RAD_PER_DEG};

/// m³ per litre.
const M3_PER_LITRE: f64 = 1e-3;

/// Unit a measure is reported in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum UnitOf {
    /// Degrees (rad inside).
    Angle,
    /// rad/s or rad/s².
    Motion(Rate),
    /// N m.
    Torque,
    /// Nominal shear stress of a section, MPa (N m inside).
    Stress {
        /// Polar section modulus, m³.
        section_modulus: f64,
    },
    /// Shear strain of the element of a ring, per cent (rad inside).
    Strain {
        /// Strain per twist of the ring, 1/rad: mean radius over thickness.
        per_twist: f64,
    },
    /// Stress of a spring, MPa (rad inside; Pa where it is by dimensions).
    SpringStress {
        /// Pa per rad of twist; one where it is Pa.
        per_twist: f64,
    },
    /// W.
    Power,
    /// W/m² (W inside).
    PowerPerArea {
        /// m².
        area: f64,
    },
    /// °C.
    Temperature,
    /// kg m².
    Inertia,
    /// Shear strain, per cent.
    Percent,
    /// kg.
    Mass,
    /// Litres (m³ inside).
    Volume,
    /// Any currency.
    Currency,
    /// mm (m inside).
    Length,
    /// mm, of which the inverse is limited (1/m inside).
    Bore,
    /// None.
    Ratio,
    /// None: a safety factor, of which the inverse is minimised.
    Margin,
    /// Hours, of which the inverse is minimised: the damage of one.
    Life,
}

impl UnitOf {
    /// A value inside as it is reported.
    pub fn shown(self, value: f64) -> f64 {
        match self {
            Self::Angle => value * DEG_PER_RAD,
            Self::Stress { section_modulus } => value / section_modulus / PA_PER_MPA,
            Self::Strain { per_twist } => 100.0 * value * per_twist,
            Self::SpringStress { per_twist } => value * per_twist / PA_PER_MPA,
            Self::PowerPerArea { area } => value / area,
            Self::Percent => 100.0 * value,
            Self::Volume => value / M3_PER_LITRE,
            Self::Length => value / M_PER_MM,
            Self::Bore => 1.0 / (value * M_PER_MM),
            Self::Motion(_)
            | Self::Torque
            | Self::Power
            | Self::Temperature
            | Self::Inertia
            | Self::Mass
            | Self::Currency
            | Self::Ratio => value,
            Self::Margin | Self::Life => 1.0 / value,
        }
    }

    /// A value as it is reported as it is inside.
    pub fn inside(self, shown: f64) -> f64 {
        match self {
            Self::Angle => shown * RAD_PER_DEG,
            Self::Stress { section_modulus } => shown * PA_PER_MPA * section_modulus,
            Self::Strain { per_twist } => 0.01 * shown / per_twist,
            Self::SpringStress { per_twist } => shown * PA_PER_MPA / per_twist,
            Self::PowerPerArea { area } => shown * area,
            Self::Percent => 0.01 * shown,
            Self::Volume => shown * M3_PER_LITRE,
            Self::Length => shown * M_PER_MM,
            Self::Bore => 1.0 / (shown * M_PER_MM),
            Self::Motion(_)
            | Self::Torque
            | Self::Power
            | Self::Temperature
            | Self::Inertia
            | Self::Mass
            | Self::Currency
            | Self::Ratio => shown,
            Self::Margin | Self::Life => 1.0 / shown,
        }
    }

    /// A ratio of two values inside as the ratio of the values that are reported: its inverse for a margin and a life.
    #[doc(hidden)]
    pub fn ratio(self, inside: f64) -> f64 {
        if self.is_inverse() { 1.0 / inside } else { inside }
    }

    /// Whether more of it is better: inside it is the inverse.
    #[doc(hidden)]
    pub fn is_inverse(self) -> bool {
        matches!(self, Self::Margin | Self::Life | Self::Bore)
    }

    /// Behind a number: with a space where it takes one.
    #[doc(hidden)]
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Angle => "°",
            Self::Motion(rate) => rate.suffix(),
            Self::Torque => " N m",
            Self::Stress { .. } | Self::SpringStress { .. } => " MPa",
            Self::Strain { .. } | Self::Percent => " %",
            Self::Mass => " kg",
            Self::Volume => " l",
            Self::Length | Self::Bore => " mm",
            Self::Power => " W",
            Self::PowerPerArea { .. } => " W/m²",
            Self::Temperature => " °C",
            Self::Inertia => " kg m²",
            Self::Life => " h",
            Self::Ratio | Self::Margin | Self::Currency => "",
        }
    }

    /// In a column of its own.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Angle => "deg",
            Self::Motion(rate) => rate.unit(),
            Self::Torque => "N m",
            Self::Stress { .. } | Self::SpringStress { .. } => "MPa",
            Self::Strain { .. } | Self::Percent => "%",
            Self::Mass => "kg",
            Self::Volume => "l",
            Self::Length | Self::Bore => "mm",
            Self::Power => "W",
            Self::PowerPerArea { .. } => "W/m2",
            Self::Temperature => "degC",
            Self::Inertia => "kg m2",
            Self::Life => "h",
            Self::Ratio | Self::Margin | Self::Currency => "1",
        }
    }
}

/// A measure of a study: an objective, what is limited, or an axis of a front.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasureSpec {
    /// The measure.
    pub measure: Measure,
    /// Its key in the study.
    pub key: &'static str,
    /// What of the system it is of, in words; nothing where it is of all.
    pub place: String,
    /// Its column in tables, unit included.
    pub column: String,
    /// In words, for titles.
    pub label: String,
    /// Its unit.
    pub unit: UnitOf,
    /// Whether it is a twist.
    pub is_twist: bool,
    /// A word for names of optima.
    pub word: String,
}

/// A limit of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct LimitSpec {
    /// What is limited.
    pub of: MeasureSpec,
    /// In words.
    pub words: String,
    /// Of the measure, inside.
    pub limit: f64,
    /// The society's rule that it is of.
    pub rule: Option<LimitOfRule>,
}

/// What a society's rule says beside its curve over speed.
#[derive(Debug, Clone, PartialEq)]
pub struct LimitOfRule {
    /// The rule.
    pub rule: ShaftRule,
    /// Speed that the curve is in units of, rpm.
    pub rated_rpm: f64,
    /// Largest stress in a barred range, which is passed through quickly, over the limit; `None` where that is not judged.
    pub transient: Option<f64>,
    /// Speeds that the study excepts, rpm: ranges that are to be barred.
    pub excepted: Vec<(f64, f64)>,
}

/// Several measures as one objective.
#[derive(Debug, Clone, PartialEq)]
pub struct CombinedSpec {
    /// The measures with their targets.
    pub parts: Vec<LimitSpec>,
    /// Of each; none where the largest in units of its target counts.
    pub weights: Vec<f64>,
    /// What comes of them: a number without unit.
    pub spec: MeasureSpec,
}

impl LimitOfRule {
    /// Whether a range up to a speed, rpm, reaches above that up to which ranges may be barred in normal firing.
    pub(crate) fn is_too_high(&self, to_rpm: f64) -> bool {
        to_rpm > HIGHEST_BARRED * self.rated_rpm
    }
}

impl LimitSpec {
    /// As optimisers take it: of a rule, too, what it allows at the speeds that the study excepts. There the stress for passing through is the limit; where a range reaches above that up to which ranges may be barred in normal
    /// firing, that for continuous running is, in service.
    #[doc(hidden)]
    pub fn to_limit(&self) -> Limit {
        let mut excepted = Vec::new();
        if let Some(rule) = &self.rule {
            let (high, all) = (self.excepted().into_iter().filter(|r| rule.is_too_high(r.1)).collect(), self.excepted());
            let at = |ranges: Vec<(f64, f64)>, limit, in_service| {
                let measure = self.within(ranges);
                (!measure.within.ranges.is_empty()).then_some(AtExceptedSpeeds { measure, limit, in_service })
            };
            excepted.extend(at(high, self.limit, true));
            excepted.extend(rule.transient.and_then(|most| at(all, self.limit * most, false)));
        }
        Limit { measure: self.of.measure.clone(), limit: self.limit, excepted, engine: None }
    }

    /// Its measure in other ranges of speed.
    pub(crate) fn within(&self, ranges: Vec<(f64, f64)>) -> Measure {
        let mut measure = self.of.measure.clone();
        measure.within.ranges = ranges;
        measure
    }

    /// Ranges of speed, rpm, that a study excepts from a rule, as far as its curve goes: beyond its ends the rule says nothing.
    pub(crate) fn excepted(&self) -> Vec<(f64, f64)> {
        let Some(rule) = &self.rule else { return Vec::new() };
        let curve = &self.of.measure.within.factors;
        let (first, last) = (curve.first().map_or(0.0, |f| f.0), curve.last().map_or(f64::INFINITY, |f| f.0));
        let covered = rule.excepted.iter().map(|(from, to)| (from.max(first), to.min(last)));
        covered.filter(|(from, to)| from < to).collect()
    }
}
