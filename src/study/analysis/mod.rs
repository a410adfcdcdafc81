//! Whole studies: calibration, designs evaluated, optima and fronts found, margins.

pub mod allocation;
pub mod amplitude;
pub mod barred;
pub mod bearings;
#[doc(hidden)]
pub mod buildable;
pub mod calibrate;
#[doc(hidden)]
pub mod campaign;
mod catalogue;
mod catalogue_retuning;
pub mod classification;
#[doc(hidden)]
pub mod compounds;
pub mod conditions;
#[doc(hidden)]
pub mod crank_at_speed;
pub mod crank_diagram;
pub mod crank_models;
pub mod curves;
mod duty;
mod equivalent_constants;
pub mod evaluate;
pub mod evaluation_plan;
pub mod families;
pub mod fit_law;
#[doc(hidden)]
pub mod heat;
mod inertia_fronts;
#[doc(hidden)]
pub mod judged;
mod jumps;
#[doc(hidden)]
pub mod large_twist;
mod large_twist_measures;
mod life;
mod limits_within;
mod looked_over;
pub mod margins;
pub mod method_selection;
pub mod model_check;
pub mod on_joints;
#[doc(hidden)]
pub mod plausibility;
mod prices;
#[doc(hidden)]
pub mod problem_of;
pub mod progress;
#[doc(hidden)]
pub mod reciprocating;
mod required_material;
pub mod results;
#[doc(hidden)]
pub mod robust;
pub mod run;
mod search_in_operation;
#[doc(hidden)]
pub mod searches;
pub mod sensitivities;
#[doc(hidden)]
pub mod sheets;
pub mod sizing;
mod strain;
#[doc(hidden)]
pub mod stress_figures;
pub mod stress_histories;
pub mod sweeps;
pub mod systems;
mod tables_for_searches;
pub mod timing;
pub mod timing_probe;
#[doc(hidden)]
pub mod torsion_case;
mod tradeoffs;
#[doc(hidden)]
pub mod verdict;
mod web_stress;

pub use crate::response::operation::MOST_STRAIN;
pub use crate::response::operation::{Balance, Rule};
pub use allocation::{Allocated, AllocationOfDesign};
pub use barred::{BarredRange, Objection, RuleStress, StillBroken};
pub use calibrate::{Calibrated, Calibration, calibrate};
pub use catalogue::Ranked;
pub use conditions::ConditionResult;
pub use crank_models::{ByModel, Modelled};
pub use duty::points as duty_points;
pub use duty::{DutyOfDesign, DutyResult};
pub use equivalent_constants::SimplestLaw;
pub use evaluate::{AbsorberLoad, DesignResult, Nature, PeakKind};
pub use heat::{HeatAt, HeatOfDesign};
pub use large_twist::{LargePoint, LargeTwistOfDesign};
pub use large_twist_measures::AtLargeTwist;
pub use life::{LifeAt, LifeOverDuty};
pub use margins::{MarginSweep, SmallestMargin};
pub use on_joints::{AtSpeedOnJoints, FoundOnJoints, OnJointsOfDesign};
pub use progress::{Error, Progress, RunError, Silent};
pub use required_material::MadeOf;
pub use required_material::over_states;
pub use results::{Beside, Change, CompoundResult, FrontResult, OptimumResult, Price, Results, RowCase, TradeoffResult};
pub use robust::{Percentile, RobustOfDesign, Worst};
pub use run::run;
pub use sensitivities::Sensitivity;
pub use sheets::Sheet;
pub use strain::{StrainAt, StrainOfDesign};
pub use sweeps::Sweeps;
pub use timing::Timing;
pub use torsion_case::{CaseAtSpeed, CaseOfDesign};
pub use web_stress::{VonMisesAt, Web, WebMargin, WebsOfDesign, von_mises_on_bearings};
