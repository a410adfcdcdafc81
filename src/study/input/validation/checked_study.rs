//! A study as checked.

use super::absorbers::DesignSpec;
use super::calibrate::CalibrateSpec;
use super::catalogue::CatalogueSpec;
use super::flexible_model::FlexibleModel;
use super::inputs::Input;
use super::load::DutyPoint;
use super::material_states::Temperatures;
use super::optimise::{FrontSpec, OptimiseSpec};
use super::placeholders::Placeholder;
use super::robust::RobustSpec;
use crate::crankshaft::{Crank, FatigueSpec};
use crate::drivetrain::{Chain, Modes};
use crate::engine::Engine;
use crate::input::measure::{CombinedSpec, LimitSpec, MeasureSpec};
use crate::input::published::Published;
use crate::input::schema::study::{RawCrankModel, RawMethod};
use crate::objective::Condition;
use crate::response::Quantity;

/// Largest relative error of a peak in a search, where a study says nothing.
pub(super) const DEFAULT_TOLERANCE: f64 = 1e-3;

/// How responses are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ResponseMethod {
    /// The chain once, absorbers as a change of rank one.
    Receptance,
    /// The whole system at every point.
    Direct,
    /// Receptance; searches take the cheapest way that is within tolerance.
    Auto,
}

impl From<RawMethod> for ResponseMethod {
    fn from(raw: RawMethod) -> Self {
        match raw {
            RawMethod::Receptance => Self::Receptance,
            RawMethod::Direct => Self::Direct,
            RawMethod::Auto => Self::Auto,
        }
    }
}

/// What of the crank a study computes with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CrankModel {
    /// Its torsional chain.
    Chain,
    /// In bending, torsion and axial motion on its bearings.
    Flexible,
    /// The chain where that differs by less than the tolerance of the study.
    Auto,
}

impl From<RawCrankModel> for CrankModel {
    fn from(raw: RawCrankModel) -> Self {
        match raw {
            RawCrankModel::Chain => Self::Chain,
            RawCrankModel::Flexible => Self::Flexible,
            RawCrankModel::Auto => Self::Auto,
        }
    }
}

/// What of the moving masses is part of the chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reciprocating {
    /// Half of m r² of each cylinder, their mean inertia, is added to the station of its throw.
    pub mean: bool,
    /// The file says so; otherwise it is the default.
    pub stated: bool,
}

/// A study, ready to run.
#[derive(Debug, Clone)]
pub struct Study {
    /// File name without ending.
    pub name: String,
    /// Cylinders and pressure.
    pub engine: Engine,
    /// Torsional chain.
    pub chain: Chain,
    /// Whether its inertias hold the reciprocating masses.
    pub reciprocating: Reciprocating,
    /// Its undamped modes.
    pub modes: Modes,
    /// Ascending, rpm.
    pub speeds_rpm: Vec<f64>,
    /// Lowest and highest speed at which the engine file tells the torque or pressure, which are held beyond them, rpm; None where they do not depend on speed.
    pub known_rpm: Option<(f64, f64)>,
    /// Highest order.
    pub order_limit: f64,
    /// How responses are computed.
    pub method: ResponseMethod,
    /// Largest relative error of a peak in a search, where the method is `auto`.
    pub tolerance: f64,
    /// Whether peaks are refined between speeds.
    pub refine_peaks: bool,
    /// Whether sweeps keep every station and shaft, order by order.
    pub every_station: bool,
    /// Whether the sweeps have the torque of every shaft in every condition, too.
    pub torque_in_conditions: bool,
    /// Given designs.
    pub designs: Vec<DesignSpec>,
    /// Catalogues of absorbers.
    pub catalogues: Vec<CatalogueSpec>,
    /// Station whose amplitude is reported.
    pub hub: usize,
    /// Twist that is reported.
    pub twist: Quantity,
    /// The (first) objective, which is minimised.
    pub objective: MeasureSpec,
    /// Further objectives, each with optima of the main size of its own.
    pub more_objectives: Vec<MeasureSpec>,
    /// Some measures together, with optima of the main size of their own.
    pub combined: Option<CombinedSpec>,
    /// To hold.
    pub limits: Vec<LimitSpec>,
    /// What to optimise.
    pub optimise: Option<OptimiseSpec>,
    /// Conditions in which designs are to hold their limits where nothing is searched for: those of a search that was left out.
    pub held_without_search: Vec<Condition>,
    /// Tolerances that designs are judged, and optima of the main size sought, within.
    pub robust: Option<RobustSpec>,
    /// Front to follow.
    pub front: Option<FrontSpec>,
    /// Conditions every design is evaluated in; firing always is.
    pub conditions: Vec<Condition>,
    /// Of the conditions `cold` and `hot`.
    pub temperatures: Temperatures,
    /// Of each cylinder in the condition of unequal ones: the share by which burning adds more to its torque.
    pub scatter: Option<Vec<f64>>,
    /// Tables to compare with.
    pub published: Option<Published>,
    /// Inputs to fit to them.
    pub calibrate: Option<CalibrateSpec>,
    /// Dimensions of the crank, where the engine file has them.
    pub crank: Option<Crank>,
    /// The crank in bending, torsion and axial motion, where the engine file has it.
    pub flexible: Option<FlexibleModel>,
    /// What of the crank the response is computed with.
    pub crank_model: CrankModel,
    /// The engine whose pressure bends the crank, where it is not that of the excitation: as in the file, whatever is fitted.
    pub crank_engine: Option<Engine>,
    /// Points at which the engine runs, with their shares of the time.
    pub duty: Vec<DutyPoint>,
    /// How the crank's margin is judged.
    pub fatigue: Option<FatigueSpec>,
    /// Values of an example that nobody has confirmed, those of the engine file first.
    pub placeholders: Vec<Placeholder>,
    /// How its tables were read, where that is not plain: sentences.
    pub remarks: Vec<String>,
    /// Keys that were given other values than its files have, as `KEY=VALUE`.
    pub set: Vec<String>,
}

impl Study {
    /// Conditions in which designs are to be good and to hold their limits.
    #[doc(hidden)]
    pub fn held(&self) -> &[Condition] {
        self.optimise.as_ref().map_or(&self.held_without_search, |o| &o.conditions)
    }

    /// Leaves searches out; designs are judged in the same conditions as before.
    #[doc(hidden)]
    pub fn leave_searches_out(&mut self) {
        self.held_without_search = self.held().to_vec();
        (self.optimise, self.front, self.robust, self.combined) = (None, None, None, None);
        self.more_objectives.clear();
    }

    /// The objectives of the study, the first before the others.
    #[doc(hidden)]
    pub fn objectives(&self) -> impl Iterator<Item = &MeasureSpec> {
        std::iter::once(&self.objective).chain(&self.more_objectives)
    }

    /// An objective: the first, or one of those after it.
    #[doc(hidden)]
    pub fn objective_of(&self, index: usize) -> &MeasureSpec {
        let combined = || self.combined.as_ref().filter(|_| index > self.more_objectives.len()).map(|c| &c.spec);
        index.checked_sub(1).and_then(|i| self.more_objectives.get(i).or_else(combined)).unwrap_or(&self.objective)
    }

    /// All objectives, the first before the others, then what an objective combines besides.
    pub(crate) fn measures_of(&self, index: usize) -> Vec<&MeasureSpec> {
        let mut list: Vec<&MeasureSpec> = self.objectives().collect();
        let combined = self.combined.iter().filter(|_| index > self.more_objectives.len());
        for part in combined.flat_map(|c| &c.parts).map(|p| &p.of) {
            if list.iter().all(|m| m.column != part.column) {
                list.push(part);
            }
        }
        list
    }

    /// Everything that is measured: objectives, what they combine, limits, and axes of fronts.
    #[doc(hidden)]
    pub fn measures(&self) -> impl Iterator<Item = &MeasureSpec> {
        let combined = self.combined.iter().flat_map(|c| &c.parts);
        let limits = combined.chain(&self.limits).map(|l| &l.of);
        let axes = match &self.front {
            Some(FrontSpec::Of { measures, .. }) => measures.as_slice(),
            _ => &[],
        };
        self.objectives().chain(limits).chain(axes)
    }

    /// The engine whose pressure bends the crank.
    pub fn engine_of_crank(&self) -> &Engine {
        self.crank_engine.as_ref().unwrap_or(&self.engine)
    }

    /// The study with other values of some inputs, each in the unit of its key.
    #[must_use]
    pub fn with_inputs(&self, values: &[(Input, f64)]) -> Self {
        let mut study = self.clone();
        for (input, value) in values {
            input.apply(&mut study.engine, &mut study.chain, *value);
        }
        if values.iter().any(|(input, _)| !input.changes_torque()) {
            study.modes = Modes::new(&study.chain);
        }
        study
    }
}
