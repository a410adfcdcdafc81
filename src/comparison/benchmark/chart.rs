//! Everything that `hartog chart` measures, put together.

use super::crank_ladder::{self, Ladder};
use super::evolution::{self, Evolution};
use super::laws::{self, LawCost};
use super::margin_methods::{self, MarginCost};
use super::proofs::{self, ProofCost};
use super::scenarios::scenarios;
use super::stability::{Cell, Scenario};
use super::{energy, growth, model_accuracy, savings, speed_accuracy};
use crate::analysis::{Progress, RunError, calibrate};
use crate::input::Study;

/// What `chart` measures whatever the study.
#[derive(Debug)]
pub struct Common {
    /// How cost grows.
    pub growth: Vec<growth::Growth>,
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
        let growth = growth::growth(progress);
        let scenarios = scenarios();
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
    /// What margins of its first probe cost, where the study judges the crank.
    pub margins: Vec<MarginCost>,
    /// What laws of absorbers cost.
    pub laws: Vec<LawCost>,
    /// NSGA-II beside its fronts.
    pub fronts: Vec<Evolution>,
    /// Proofs of its optima.
    pub proofs: Vec<ProofCost>,
    /// Models of the crank, where the study computes with a flexible one.
    pub ladder: Option<Ladder>,
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
        progress.stage("random absorbers, simplified models, margins, fronts, laws, proofs, cranks", 7);
        let savings = savings::measure(&study)?;
        progress.step();
        let mut designs: Vec<_> = methods.probes.iter().map(|p| p.1.clone()).collect();
        if designs.is_empty() {
            designs.push(Vec::new());
        }
        let models = model_accuracy::measure(&study, &designs)?;
        progress.step();
        let probe = methods.probes.first().map_or(("none", &[][..]), |p| (p.0.as_str(), p.1.as_slice()));
        let margins = margin_methods::measure(&study, probe)?;
        progress.step();
        let fronts = evolution::measure(&study)?;
        progress.step();
        let laws = laws::measure(&study)?;
        progress.step();
        let proofs = proofs::measure(&study)?;
        progress.step();
        let ladder = crank_ladder::measure(&study, &crank_ladder::FACTORS)?;
        progress.step();
        Ok(Self { study, methods, savings, models, margins, laws, fronts, proofs, ladder, common })
    }

    /// Whether skipping changes nothing.
    pub fn holds(&self) -> bool {
        self.savings.as_ref().is_none_or(|s| s.identical && s.same_best)
    }
}
