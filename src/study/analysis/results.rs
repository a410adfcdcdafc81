//! Everything a study gives.

use super::allocation::AllocationOfDesign;
use super::calibrate::Calibration;
use super::catalogue::Ranked;
use super::crank_diagram::Diagram;
use super::crank_models::ByModel;
use super::duty::DutyOfDesign;
use super::equivalent_constants::SimplestLaw;
use super::evaluate::{DesignResult, Nature};
use super::heat::HeatOfDesign;
use super::large_twist::LargeTwistOfDesign;
use super::margins::MarginSweep;
use super::method_selection::Choice;
use super::on_joints::OnJointsOfDesign;
use super::robust::RobustOfDesign;
use super::sensitivities::Sensitivity;
use super::sheets::Sheet;
use super::strain::StrainOfDesign;
use super::sweeps::Sweeps;
use super::timing::Timing;
use super::torsion_case::CaseOfDesign;
use super::web_stress::WebsOfDesign;
use crate::absorber::{Declaration, Deviation};
use crate::crankshaft::Margin;
use crate::drivetrain::System;
use crate::engine::Order;
use crate::input::Study;
use crate::objective::{Condition, holds};
use crate::optimise::{Conflict, Exclusions, Front, Nearby, OnBound, Optimum, Proof, Scan, SecondOrder, Stop, Survey, Tradeoff};

/// An optimum with what is reported of it.
#[derive(Debug, Clone, serde::Serialize)]
pub struct OptimumResult {
    /// How it was found.
    pub optimum: Optimum,
    /// Its numbers.
    pub design: DesignResult,
    /// What makes each row's peak (`None`: another quantity than the reported twist).
    pub natures: Vec<Option<Nature>>,
    /// Load case of each row.
    pub load_cases: Vec<RowCase>,
    /// Whether it is the main size of its type, or the best of all sizes: it has curves, margins and conditions.
    pub main: bool,
    /// Name of its family: that of the optimum by the study's first objective.
    pub family: String,
    /// Index of the objective that it minimises, the first being 0.
    pub objective: usize,
    /// What each limit costs: per cent of the objective that one per cent more of it would bring.
    pub prices: Vec<f64>,
    /// What designs elsewhere say of it.
    pub scan: Scan,
    /// What its whole box says of it, where there are limits.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub survey: Option<Survey>,
    /// What random designs near it say of it.
    pub nearby: Nearby,
    /// That no design within the bounds is better; `None` where that was not asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proof: Option<Proof>,
    /// The same for others to check; `None` where that was not asked for, nothing is proved, or as many boxes do not suffice.
    #[serde(skip)]
    pub exclusions: Option<Exclusions>,
    /// What second order says of it, where peaks keep their places that near.
    pub second_order: Option<SecondOrder>,
    /// Its measures by its parameters.
    pub sensitivities: Vec<Sensitivity>,
    /// Bounds it lies on.
    pub on_bounds: Vec<OnBound>,
    /// The limits that no design of its family holds together.
    pub conflict: Option<Conflict>,
    /// Whether its worst within the tolerances of the study is least.
    pub robust: bool,
    /// What it minimises at the reference: all cylinders fire, materials are at their reference; `None` where that has no finite response.
    pub reference: Option<f64>,
}

impl OptimumResult {
    /// Whether all limits hold as far as the search knows: as drawn, and of an optimum within tolerances at every deviation that it is held against.
    pub fn limits_hold(&self) -> bool {
        self.design.within_limits() && (!self.robust || self.conflict.is_none() && self.optimum.outcome.rows.hold())
    }

    /// Whether first-order conditions are not met, of an optimum with something free that holds its limits: of limits that are missed none are asked.
    #[doc(hidden)]
    pub fn is_unfinished(&self) -> bool {
        let outcome = &self.optimum.outcome;
        self.conflict.is_none() && outcome.stop != Stop::NothingFree && !outcome.meets_first_order()
    }

    /// Whether its search has converged: no step promised a decrease, and first-order conditions are met.
    #[doc(hidden)]
    pub fn has_converged(&self) -> bool {
        self.optimum.outcome.stop == Stop::Converged && !self.is_unfinished()
    }
}

/// Load case of a row of an optimum.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct RowCase {
    /// The condition.
    pub condition: Condition,
    /// The cylinder (from 0) that misfires.
    pub cylinder: Option<usize>,
    /// How the absorbers deviate from what was drawn.
    pub deviation: Option<Deviation>,
}

/// The front of one type.
#[derive(Debug, Clone, serde::Serialize)]
pub struct FrontResult {
    /// The type.
    #[serde(serialize_with = "name_only")]
    pub declaration: &'static Declaration,
    /// The front.
    pub front: Front,
    /// Values of the study's other objectives at each point.
    pub others: Vec<Vec<f64>>,
}

/// What a search found of a compound or oil, at the steps of dimensions.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct CompoundResult {
    /// The type.
    pub kind: &'static str,
    /// The compound or oil, where the study names some.
    pub name: Option<String>,
    /// Steps of dimensions by their keys.
    pub steps: Vec<(&'static str, f64)>,
    /// The study's first objective at its best, SI; of what was left out, the best that was found without limits.
    pub value: f64,
    /// Whether that design holds all limits.
    pub holds: bool,
    /// Whether it was left out: `value` is without limits.
    pub left_out: bool,
    /// Whether it was taken.
    pub chosen: bool,
}

/// What is another one than the study asks for.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Change {
    /// A condition is left out.
    WithoutCondition(Condition),
    /// A limit is left out, by its index.
    WithoutLimit(usize),
    /// A bound that the optimum lies on is where hartog puts it without the study.
    WithoutBound {
        /// Index of the absorber.
        absorber: usize,
        /// Key of the parameter.
        key: &'static str,
        /// The bound of the study.
        bound: f64,
        /// The other one.
        instead: f64,
    },
    /// Every ring has half of its inertia, or of the most that it may have.
    HalfTheRing,
}

/// The optimum of a study that is changed.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Price {
    /// Name of the optimum.
    pub design: String,
    /// What is changed.
    pub change: Change,
    /// The study's first objective of the optimum, the largest in the conditions that it is to hold in, SI; at small twist.
    pub own: f64,
    /// The same of the optimum that was found after the change.
    pub changed: f64,
    /// Whether the optimum holds all limits.
    pub own_holds: bool,
    /// Whether that after the change holds all that are left.
    pub changed_holds: bool,
    /// The compound or oil of that one, of several that the study names.
    pub compound: Option<String>,
}

impl Price {
    /// What is asked costs so much of the objective: its ratio with it to that without it, less one; of half the ring the ratio of that to the whole one. `None` where one of them breaks limits or has no value.
    pub fn cost(&self) -> Option<f64> {
        let (with, without) = if self.change == Change::HalfTheRing { (self.changed, self.own) } else { (self.own, self.changed) };
        Some(with / without - 1.0).filter(|c| self.own_holds && self.changed_holds && c.is_finite())
    }
}

/// A design beside a front.
#[derive(Debug, Clone, serde::Serialize)]
pub struct Beside {
    /// Its name.
    pub design: String,
    /// Its measures, SI.
    pub values: [f64; 2],
}

/// The fronts of one pair of measures.
#[derive(Debug, Clone, serde::Serialize)]
pub struct TradeoffResult {
    /// Indices of the measures of the study's front.
    pub of: [usize; 2],
    /// Types of the absorbers, and the front of each.
    pub families: Vec<(String, Tradeoff)>,
    /// The third measure at each point of each family, where there is one, SI.
    pub third: Vec<Vec<f64>>,
    /// The given designs.
    pub given: Vec<Beside>,
}

fn name_only<S: serde::Serializer>(declaration: &&'static Declaration, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(declaration.name)
}

/// Everything a study gives.
#[derive(Debug, serde::Serialize)]
pub struct Results {
    /// The study as it was run: its inputs calibrated where it asks for that.
    #[serde(skip)]
    pub study: Study,
    /// The fit of those inputs.
    pub calibration: Option<Calibration>,
    /// The system.
    #[serde(skip)]
    pub system: System,
    /// Method of the sweeps.
    pub method: &'static str,
    /// What searches by each objective evaluate designs by, where the method is `auto`.
    pub choices: Vec<Choice>,
    /// Compounds, oils and steps of dimensions that were chosen from.
    pub compounds: Vec<CompoundResult>,
    /// What is asked of optima, and what it costs, where the study wants that.
    pub prices: Vec<Price>,
    /// Absorbers of catalogues, the best first.
    pub catalogue: Vec<Ranked>,
    /// Given designs, and the best of catalogues.
    pub designs: Vec<DesignResult>,
    /// Optima.
    pub optima: Vec<OptimumResult>,
    /// Fronts over ring inertia.
    pub fronts: Vec<FrontResult>,
    /// Fronts of pairs of measures.
    pub tradeoffs: Vec<TradeoffResult>,
    /// Largest value of the objective without absorber if nothing resonated; `None` where it is not a twist.
    pub forced_floor: Option<f64>,
    /// Each objective of the engine without absorber, as optima are judged by it; `None` where it is none of the engine's or has no finite response.
    #[serde(skip)]
    #[doc(hidden)]
    pub bare: Vec<Option<f64>>,
    /// Given designs and main optima, over the study's speeds.
    pub sweeps: Vec<Sweeps>,
    /// The same of optima of other sizes than the main ones, for a page that draws what is ticked.
    #[serde(skip)]
    pub sweeps_of_sizes: Vec<Sweeps>,
    /// The crank, where the study judges it.
    #[serde(skip)]
    pub margin: Option<Margin>,
    /// Margins of the same designs, where the study has `[fatigue]`.
    pub margins: Vec<MarginSweep>,
    /// Loads along the crank at the smallest margin of the best design, by the first criterion.
    pub diagram: Option<Diagram>,
    /// The same designs at the points of the duty, where the study has one.
    pub duty: Vec<DutyOfDesign>,
    /// Temperatures of those whose material says what cools it.
    pub heat: Vec<HeatOfDesign>,
    /// Those whose law is no constant spring and damper: what it would cost to take it for one.
    pub simplest: Vec<SimplestLaw>,
    /// Those whose material follows its strain, at the strain that they have, by each rule.
    pub strain: Vec<StrainOfDesign>,
    /// Motions of those with an absorber whose twist is not small.
    pub large_twist: Vec<LargeTwistOfDesign>,
    /// The same designs within the tolerances of the study, where it has some.
    pub robust: Vec<RobustOfDesign>,
    /// The tolerances that the same designs can bear, where the study asks for that.
    pub allocation: Vec<AllocationOfDesign>,
    /// Dampers by their dimensions, as they are ordered.
    pub sheets: Vec<Sheet>,
    /// Orders that a misfire brings into the torque of the whole engine, where the study looks at one.
    pub appearing: Vec<Order>,
    /// Given designs and main optima by other models of the crank, where the response is that of a flexible one.
    pub crank_models: Vec<ByModel>,
    /// The design without absorber, the best given one and the best optimum on the bearings of the study, where these are not linear.
    pub joints: Vec<OnJointsOfDesign>,
    /// The same designs' webs by the loads of the flexible crank, where the study has `[fatigue]`.
    pub webs: Vec<WebsOfDesign>,
    /// Designs by the torsion case that the study asks for.
    pub torsion_cases: Vec<CaseOfDesign>,
    /// Largest difference between chain and flexible crank that decided which is computed with, over the larger, where the study leaves that open.
    pub crank_difference: Option<f64>,
    /// Times.
    pub timing: Vec<Timing>,
}

impl Results {
    /// Conditions that some design is reported in.
    #[doc(hidden)]
    pub fn conditions(&self) -> impl Iterator<Item = Condition> {
        let all = self.designs.iter().chain(self.optima.iter().map(|o| &o.design));
        let in_operation = all.flat_map(|d| &d.conditions).any(|c| c.condition == Condition::InOperation);
        self.study.conditions.iter().copied().chain(in_operation.then_some(Condition::InOperation))
    }

    /// Whether a name is that of an optimum.
    #[doc(hidden)]
    pub fn is_optimum(&self, name: &str) -> bool {
        self.optima.iter().any(|o| o.design.name == name)
    }

    /// Whether a design holds its limits, as what it is: an optimum within tolerances within these.
    #[doc(hidden)]
    pub fn holds_limits(&self, design: &DesignResult) -> bool {
        let Some(own) = self.optima.iter().find(|o| o.design.name == design.name) else { return design.within_limits() };
        let within = self.robust.iter().find(|r| own.robust && r.design == design.name);
        own.limits_hold() && within.is_none_or(|r| r.limits.iter().all(|worst| holds(worst.value)))
    }

    /// Whether every limit holds for every optimum (where nothing was searched: for the best absorber of the catalogues), and none of those that are shown overheats.
    pub fn limits_hold(&self) -> bool {
        let sold = self.catalogue.first().filter(|_| self.study.optimise.is_none());
        if sold.is_some_and(|best| !holds(best.over_limit)) {
            return false;
        }
        let overheats = |h: &HeatOfDesign| self.is_optimum(&h.design) && h.overheats();
        self.optima.iter().all(|o| self.holds_limits(&o.design)) && !self.heat.iter().any(overheats)
    }
}
