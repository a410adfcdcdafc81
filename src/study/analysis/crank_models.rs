//! The twist of designs by other models of the crank: what its chain and its bearings are worth.

use super::timing::Clock;
use super::{DesignResult, Progress, RunError};
use crate::absorber::Mounted;
use crate::input::{CrankModel, Study};
use crate::objective::measure::{Measure, Within};
use crate::objective::{Over, PeakFinder};
use crate::response::{Direct, Grid, Method, ResponseError, Work};
use rayon::prelude::*;

/// A model of the crank.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Modelled {
    /// Its torsional chain.
    Chain,
    /// In bending, torsion and axial motion on its bearings.
    Flexible,
    /// The same with every main bearing half as stiff.
    BearingsHalved,
    /// And twice as stiff.
    BearingsDoubled,
}

impl Modelled {
    /// All of them, in the order of tables.
    pub const ALL: [Self; 4] = [Self::Chain, Self::Flexible, Self::BearingsHalved, Self::BearingsDoubled];

    /// The word in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Chain => "chain",
            Self::Flexible => "flexible",
            Self::BearingsHalved => "bearings_halved",
            Self::BearingsDoubled => "bearings_doubled",
        }
    }

    /// The study on this model.
    fn on(self, study: &Study) -> Option<Study> {
        let (flexible, crank) = (study.flexible.as_ref()?, study.crank.as_ref()?);
        let parts = (crank, &study.engine, &study.chain);
        let model = match self {
            Self::Chain => return Some(Study { crank_model: CrankModel::Chain, ..study.clone() }),
            Self::Flexible => flexible.clone(),
            Self::BearingsHalved => flexible.with(|spec| spec.bearing = spec.bearing.times(0.5, 1.0), parts).ok()?,
            Self::BearingsDoubled => flexible.with(|spec| spec.bearing = spec.bearing.times(2.0, 1.0), parts).ok()?,
        };
        Some(Study { flexible: Some(model), crank_model: CrankModel::Flexible, ..study.clone() })
    }
}

/// The largest twist of a design by each model.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct ByModel {
    /// Its name.
    pub design: String,
    /// Model, largest half peak-to-peak twist (rad), and its speed (rpm).
    pub twist: Vec<(Modelled, f64, f64)>,
}

impl ByModel {
    /// The factor between the twists on chain and flexible crank, above one, where it is larger than bearings make it: the two are then not of one engine.
    #[doc(hidden)]
    pub fn far_apart(&self) -> Option<f64> {
        let ratio = self.of(Modelled::Chain)? / self.of(Modelled::Flexible)?;
        Some(ratio.max(1.0 / ratio)).filter(|r| *r > ALIKE)
    }

    /// The twist by a model, rad.
    pub fn of(&self, model: Modelled) -> Option<f64> {
        self.twist.iter().find(|t| t.0 == model).map(|t| t.1)
    }
}

/// Twists of one engine by both models differ by less than this factor: bearings make some tens of per cent.
const ALIKE: f64 = 2.0;

/// A largest twist, rad, and its speed, rpm.
type Twist = (f64, f64);

/// The twist that a study reports, by synthesis.
fn twist(study: &Study) -> Measure {
    Measure { quantities: vec![study.twist], over: Over::Synthesis, within: Within::default() }
}

/// The largest twist of designs by a model; nothing where the study has no flexible crank.
fn by(study: &Study, model: Modelled, designs: &[(&str, &[Mounted])]) -> Result<Option<Vec<Twist>>, (String, ResponseError)> {
    let Some(mut study) = model.on(study) else { return Ok(None) };
    // tables of cylinders that all fire
    study.conditions.clear();
    let system = study.system(study.excitation());
    let kinks: &[f64] = if study.refine_peaks { &system.excitation.tabulated_rpm } else { &[] };
    let grid = Grid::new(&study.speeds_rpm, kinks);
    let method = Method::Direct(Direct::new(&system, &grid));
    let finder = PeakFinder::new(&system, &grid, &method, study.refine_peaks);
    let measure = twist(&study);
    let peak = |(name, design): &(&str, &[Mounted])| {
        let found = finder.peak(design, &measure, &mut Work::default()).map_err(|error| ((*name).to_owned(), error))?;
        Ok(found.map_or((0.0, 0.0), |p| (p.value, p.speed_rpm)))
    };
    designs.par_iter().map(peak).collect::<Result<Vec<_>, _>>().map(Some)
}

/// Designs by every model, where the study computes with its flexible crank.
///
/// # Errors
/// [`RunError`] where one has no finite response.
pub(crate) fn by_models(
    study: &Study,
    shown: &[&DesignResult],
    (progress, clock): (&dyn Progress, &mut Clock),
) -> Result<Vec<ByModel>, RunError> {
    if study.on_flexible().is_none() {
        return Ok(Vec::new());
    }
    let designs: Vec<(&str, &[Mounted])> = shown.iter().map(|d| (d.name.as_str(), d.absorbers.as_slice())).collect();
    let mut all: Vec<ByModel> = designs.iter().map(|d| ByModel { design: d.0.to_owned(), twist: Vec::new() }).collect();
    progress.stage("other models of the crank", Modelled::ALL.len());
    for model in Modelled::ALL {
        let found = by(study, model, &designs).map_err(|(what, error)| RunError { what: format!("{what} ({})", model.name()), error })?;
        for (of, (value, speed)) in all.iter_mut().zip(found.into_iter().flatten()) {
            of.twist.push((model, value, speed));
        }
        progress.step();
    }
    clock.lap("other models of the crank", Work::default());
    Ok(all)
}

/// Settles what a study computes with that leaves it open: the chain where its twist differs from that of the flexible crank by no more than the tolerance of searches. Returns the largest difference, over the
/// larger of both, in the twist of the given designs and of the engine without absorber.
///
/// # Errors
/// [`RunError`] where one of them has no finite response.
pub(crate) fn choose(study: &mut Study) -> Result<Option<f64>, RunError> {
    if study.crank_model != CrankModel::Auto {
        return Ok(None);
    }
    let bare: (&str, &[Mounted]) = ("no absorber", &[]);
    let given = study.designs.iter().map(|d| (d.name.as_str(), d.absorbers.as_slice()));
    let designs: Vec<(&str, &[Mounted])> = std::iter::once(bare).chain(given).collect();
    let largest_twists = |model| by(study, model, &designs).map_err(|(what, error)| RunError { what, error });
    let Some((chain, flexible)) = largest_twists(Modelled::Chain)?.zip(largest_twists(Modelled::Flexible)?) else { return Ok(None) };
    let apart = |(a, b): (&(f64, f64), &(f64, f64))| if a.0.max(b.0) > 0.0 { (a.0 - b.0).abs() / a.0.max(b.0) } else { 0.0 };
    let difference = chain.iter().zip(&flexible).map(apart).fold(0.0, f64::max);
    study.crank_model = if difference <= study.tolerance { CrankModel::Chain } else { CrankModel::Flexible };
    Ok(Some(difference))
}
