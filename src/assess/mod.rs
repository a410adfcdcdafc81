//! Whole studies: models put together, designs evaluated, optima and fronts found.

pub mod amplitude;
pub mod audit;
pub mod auto;
pub mod calibrate;
pub mod comparison;
pub mod conditions;
pub mod diagram;
pub mod energy;
pub mod evaluate;
pub mod families;
pub mod margins;
pub mod methods;
pub mod model_accuracy;
pub mod multiaxial;
pub mod probe;
pub mod run;
pub mod savings;
pub mod speed_accuracy;
pub mod stability;
pub mod sweeps;
pub mod systems;

pub use calibrate::{Calibration, calibrate};
pub use comparison::{Comparison, compare};
pub use conditions::ConditionResult;
pub use evaluate::{DesignResult, Nature, PeakKind};
pub use margins::{MarginSweep, SmallestMargin};
pub use run::{FrontResult, OptimumResult, Results, Timing, run};
pub use sweeps::Sweeps;

/// Told of progress.
pub trait Progress: Sync {
    /// A stage of `steps` steps begins.
    fn stage(&self, name: &str, steps: usize);
    /// A step is done.
    fn step(&self);
}

/// Says nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Progress for Silent {
    fn stage(&self, _: &str, _: usize) {}
    fn step(&self) {}
}

use crate::study::Study;
use stability::{Cell, Scenario};

/// What `chart` measures whatever the study.
#[derive(Debug)]
pub struct Common {
    /// How cost grows.
    pub growth: Vec<speed_accuracy::Growth>,
    /// Where methods fail.
    pub map: Vec<(Scenario, Vec<Cell>)>,
    /// Energy put in against energy dissipated.
    pub energy: Vec<energy::Balance>,
    /// What a grid without refinement misses.
    pub grid: model_accuracy::ModelError,
}

impl Common {
    /// Measures it.
    pub fn measure(progress: &dyn Progress) -> Self {
        let growth = speed_accuracy::growth(progress);
        let scenarios = stability::scenarios();
        progress.stage("stability and energy", scenarios.len() + 1);
        let map = scenarios
            .into_iter()
            .map(|s| {
                let cells = s.cells();
                progress.step();
                (s, cells)
            })
            .collect();
        Self { growth, map, energy: energy::balances(), grid: model_accuracy::coarse_grid() }
    }

    /// Whether every method does on every scenario what is declared of it.
    pub fn holds(&self) -> bool {
        self.map.iter().flat_map(|m| &m.1).all(Cell::as_declared)
    }
}

/// Everything that `chart` measures with one study.
#[derive(Debug)]
pub struct Chart<'a> {
    /// The study, calibrated where it says so.
    pub study: Study,
    /// Methods with their settings.
    pub methods: speed_accuracy::SpeedAccuracy,
    /// What choosing and skipping save.
    pub savings: Option<savings::Savings>,
    /// What simplifications cost.
    pub models: Vec<model_accuracy::ModelError>,
    /// What is the same for all studies.
    pub common: &'a Common,
}

impl<'a> Chart<'a> {
    /// Measures a study.
    ///
    /// # Errors
    /// [`RunError`] where a design has no finite response.
    pub fn measure(study: &Study, common: &'a Common, progress: &dyn Progress) -> Result<Self, RunError> {
        let (study, _) = calibrate(study, progress)?;
        let methods = speed_accuracy::measure(&study, progress)?;
        progress.stage("random absorbers, simplified models", 2);
        let savings = savings::measure(&study)?;
        progress.step();
        let mut designs: Vec<_> = methods.probes.iter().map(|p| p.1.clone()).collect();
        if designs.is_empty() {
            designs.push(Vec::new());
        }
        let models = model_accuracy::measure(&study, &designs)?;
        progress.step();
        Ok(Self { study, methods, savings, models, common })
    }

    /// Whether skipping changes nothing.
    pub fn holds(&self) -> bool {
        self.savings.as_ref().is_none_or(|s| s.identical && s.same_best)
    }
}

/// A response that does not exist, and whose.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{what}: {error}")]
pub struct RunError {
    /// Design or optimum.
    pub what: String,
    /// Why.
    pub error: crate::response::ResponseError,
}
