//! Fatigue margin of the crank over the speed range: bending of the webs, which no absorber changes, with the torque of the shafts, which it does.
//!
//! At a speed and location the cycle of stress has amplitude sqrt(b_a² + 3 t_a²) and mean sqrt(b_m² + 3 t_m²), each from the extremes over the working cycle,
//! whatever their phase \[Villalva 2014\] eqs. (7.29), (7.30), \[IACS UR M53\] section 5: never below the stress that phase would leave. Mean bending that
//! presses a fillet together counts as none, unless the study wants it to count as the dissertation does (as tension).
//!
//! A journal carries the torque of the shaft on its side. A crankpin carries one between those on both sides (their mean, where its throw is statically
//! determinate): its fillets are judged with either. Bending across the throw is left out, as in the rule. With a misfire, the vibratory torque is that of the
//! misfiring engine; bending and mean torque stay those of the firing one, which are larger.
//!
//! Multiaxial criteria judge the history itself (`histories`): bending and torque with their phase.

use super::stress_concentration::Formulas;
use super::unit_loads::UnitLoads;
use super::{Crank, Place, TorsionCase};
use crate::fatigue::multiaxial::{self, Limits};
use crate::fatigue::{ClassRule, Criterion, Strength, class_rules};

/// What judges a location, and by which bending.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// Criteria of mean stress and multiaxial ones, with factors of nominal stress: the whole crank on all its bearings.
    Nominal,
    /// Multiaxial criteria, with stresses per unit load: the whole crank on all its bearings.
    UnitLoads,
    /// The class rule: one throw on its own bearings.
    Rule,
    /// The class rule with the whole crank on all its bearings.
    RuleContinuous,
}

impl Family {
    /// All of them, in the order of their numbers.
    pub const ALL: [Self; 4] = [Self::Nominal, Self::UnitLoads, Self::Rule, Self::RuleContinuous];
}

/// A way to judge a cycle of stress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MarginCriterion {
    /// Amplitude and mean, with the factors that the study gives to its fillets.
    MeanStress(Criterion),
    /// The whole history of the stress tensor, with the same factors or with stresses per unit load.
    Multiaxial(multiaxial::Criterion),
    /// The class societies' rule, with its own factors and its own bending: one throw between two bearings, statically determinate.
    IacsM53,
    /// The same with bending of the whole crank on all its bearings: not the rule, but what it leaves out.
    IacsM53Continuous,
}

impl MarginCriterion {
    /// All of them, in the order of tables.
    #[doc(hidden)]
    pub fn all() -> impl Iterator<Item = Self> {
        let multiaxial = multiaxial::Criterion::ALL.map(Self::Multiaxial);
        Criterion::ALL.map(Self::MeanStress).into_iter().chain([Self::IacsM53, Self::IacsM53Continuous]).chain(multiaxial)
    }

    /// The word used in studies and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::MeanStress(c) => c.name(),
            Self::Multiaxial(c) => c.name(),
            Self::IacsM53 => "iacs_m53",
            Self::IacsM53Continuous => "iacs_m53_continuous",
        }
    }

    /// Column of the smallest margin in tables.
    pub fn column(self) -> String {
        format!("margin_{}", self.name())
    }

    /// Whether it is the class societies' rule, with either bending.
    #[doc(hidden)]
    pub fn is_class_rule(self) -> bool {
        matches!(self, Self::IacsM53 | Self::IacsM53Continuous)
    }

    /// Whether it takes the bending of the whole crank on all its bearings, not of one throw by itself.
    #[doc(hidden)]
    pub fn bends_the_whole_crank(self) -> bool {
        self != Self::IacsM53
    }

    /// Which locations it judges.
    pub fn families(self) -> &'static [Family] {
        match self {
            Self::MeanStress(_) => &[Family::Nominal],
            Self::Multiaxial(_) => &[Family::Nominal, Family::UnitLoads],
            Self::IacsM53 => &[Family::Rule],
            Self::IacsM53Continuous => &[Family::RuleContinuous],
        }
    }

    /// Least acceptable margin, where the criterion names one.
    #[doc(hidden)]
    pub fn acceptable(self) -> Option<f64> {
        (self == Self::IacsM53).then_some(class_rules::ACCEPTABLE)
    }
}

/// Where the factors of a fillet come from.
#[derive(Debug, Clone, PartialEq)]
pub enum FactorSource {
    /// Given, of the nominal stress in the round section of pin or journal.
    Given {
        /// Of bending.
        bending: f64,
        /// Of torsion.
        torsion: f64,
    },
    /// Formulas; bending on the section of the web.
    Formulas(Formulas),
    /// Stresses per unit load at some points of the fillet, by name: for multiaxial criteria only.
    UnitLoads(Vec<(String, UnitLoads)>),
}

/// What mean bending counts for criteria of mean stress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeanBending {
    /// With its sign: pressure does not help, and does not harm.
    Signed,
    /// As tension whatever its sign \[Villalva 2014\] eq. (7.29).
    AsTension,
}

/// Fillets of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct FilletSpec {
    /// Name in tables; where it stands for all throws, their numbers are added.
    pub name: String,
    /// One throw (from 0), or all.
    pub throw: Option<usize>,
    /// Crankpin or journal.
    pub place: Place,
    /// Its factors.
    pub factors: FactorSource,
}

impl FilletSpec {
    /// The throws it stands for.
    pub fn throws(&self, crank: &Crank) -> std::ops::Range<usize> {
        self.throw.map_or(0..crank.throws(), |t| t..t + 1)
    }

    /// Its name on one of them.
    pub(crate) fn name_of(&self, throw: usize) -> String {
        if self.throw.is_some() { self.name.clone() } else { format!("{}_{}", self.name, throw + 1) }
    }
}

/// What a study says of fatigue.
#[derive(Debug, Clone, PartialEq)]
pub struct FatigueSpec {
    /// At least one.
    pub criteria: Vec<MarginCriterion>,
    /// Of the part, endurance factors included.
    pub strength: Strength,
    /// Of the part for multiaxial criteria, where there are any.
    pub limits: Option<Limits>,
    /// What mean bending counts for.
    pub mean_bending: MeanBending,
    /// Whether factors are lessened by the notch sensitivity of the material.
    pub notch_sensitivity: bool,
    /// At least one.
    pub fillets: Vec<FilletSpec>,
    /// How torsion is taken at two instants of the cycle, beside the full one; `None` where that is not asked for.
    pub torsion_case: Option<TorsionCase>,
    /// Of the class rule.
    pub rule: ClassRule,
}
