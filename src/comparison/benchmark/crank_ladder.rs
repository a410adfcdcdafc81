//! Models of the crank from its torsional chain up: what each costs, by how much its twist, margin and optimum err, and where chains fail as bearings get softer.

use crate::absorber::Mounted;
use crate::analysis::{DesignResult, RunError, Silent, run};
use crate::crankshaft::flexible::{BearingNodes, LinearBearings, throw_stiffness};
use crate::drivetrain::Modes;
use crate::input::{CrankModel, FlexibleModel, Size, Study};
use std::time::Instant;

/// A model of the crank.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rung {
    /// The chain of the engine file.
    Chain,
    /// A chain whose throws are as stiff as those of the flexible crank with free ends (CC#2).
    ChainFree,
    /// With ends that do not leave the axis (CC#1).
    ChainGuided,
    /// With journals that are held on the axis.
    ChainHeld,
    /// The flexible crank without what rotation does.
    AtRest,
    /// The flexible crank with one point a bearing.
    OnePoint,
    /// The flexible crank of the engine file: what the others are held against.
    Flexible,
}

impl Rung {
    /// From the simplest up.
    pub const ALL: [Self; 7] =
        [Self::Chain, Self::ChainFree, Self::ChainGuided, Self::ChainHeld, Self::AtRest, Self::OnePoint, Self::Flexible];

    /// In words, for labels.
    pub fn label(self) -> &'static str {
        match self {
            Self::Chain => "chain as given",
            Self::ChainFree => "chain, throws with free ends",
            Self::ChainGuided => "chain, throws with guided ends",
            Self::ChainHeld => "chain, throws held",
            Self::AtRest => "flexible, rotation left out",
            Self::OnePoint => "flexible, one point a bearing",
            Self::Flexible => "flexible",
        }
    }

    /// Whether it is a torsional chain.
    pub fn is_chain(self) -> bool {
        matches!(self, Self::Chain | Self::ChainFree | Self::ChainGuided | Self::ChainHeld)
    }

    /// A study on it; nothing where the study has no such model.
    fn on(self, study: &Study) -> Option<Study> {
        let (flexible, crank) = (study.flexible.as_ref()?, study.crank.as_ref()?);
        let parts = (crank, &study.engine, &study.chain);
        let bent = |model: FlexibleModel| Some(Study { flexible: Some(model), crank_model: CrankModel::Flexible, ..study.clone() });
        let throws = |of: &dyn Fn(&crate::crankshaft::flexible::ThrowStiffness) -> f64| {
            let mut own = Study { crank_model: CrankModel::Chain, ..study.clone() };
            let first = own.chain.stations.iter().position(|s| !s.throws.is_empty())?;
            for t in 0..crank.throws().saturating_sub(1) {
                // from pin to pin as from bearing to bearing
                own.chain.stations[first + t].stiffness_to_next = of(&throw_stiffness(crank, &flexible.spec, t)?);
            }
            own.modes = Modes::new(&own.chain);
            Some(own)
        };
        match self {
            Self::Chain => Some(Study { crank_model: CrankModel::Chain, ..study.clone() }),
            Self::ChainFree => throws(&|k| k.free),
            Self::ChainGuided => throws(&|k| k.guided),
            Self::ChainHeld => throws(&|k| k.held),
            Self::AtRest => bent(flexible.with(|spec| spec.rotating = false, parts).ok()?),
            Self::OnePoint => {
                let alike = flexible.spec.nodes == BearingNodes::Three && matches!(flexible.spec.bearing, LinearBearings::Alike(_));
                bent(flexible.with(|spec| spec.nodes = BearingNodes::One, parts).ok().filter(|_| alike)?)
            }
            Self::Flexible => bent(flexible.clone()),
        }
    }
}

/// What a model costs and by how much it errs against the flexible crank.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RungCost {
    /// The model.
    pub rung: Rung,
    /// Of a run with its search, all threads.
    pub seconds: f64,
    /// Largest relative error of the peak twist of a given design, and of the engine without absorber.
    pub peak: f64,
    /// The same of the smallest margin by the first criterion; none where the study judges no crank.
    pub margin: Option<f64>,
    /// By how much its optimum is worse on the flexible crank than the one found there, relative; none where nothing is searched.
    pub optimum: Option<f64>,
}

/// Error of each model.
pub type Errors = Vec<(Rung, f64)>;

/// What a model came to.
struct ModelOutcome {
    rung: Rung,
    seconds: f64,
    designs: Vec<DesignResult>,
    optimum: Option<Vec<Mounted>>,
}

/// The ladder of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Ladder {
    /// From the simplest model up.
    pub rungs: Vec<RungCost>,
    /// Factors on the stiffness of all bearings, and error of the peak twist of each chain against the flexible crank with those.
    pub bearings: Vec<(f64, Errors)>,
}

/// Factors on the stiffness of all bearings, of a chart.
pub(super) const FACTORS: [f64; 9] = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 100.0, 1000.0];

/// What the ladder asks of a study: its first objective, one absorber of its first type and size, the engine as it should be.
fn asked(study: &Study) -> Study {
    let mut own = study.clone();
    own.conditions.clear();
    own.more_objectives.clear();
    own.catalogues.clear();
    own.duty.clear();
    (own.front, own.robust, own.combined, own.published, own.scatter) = (None, None, None, None, None);
    if let Some(fatigue) = &mut own.fatigue {
        fatigue.criteria.truncate(1);
    }
    if let Some(search) = &mut own.optimise {
        search.absorbers.iter_mut().for_each(|a| {
            a.types.truncate(1);
            if let Size::Each(sizes) = &mut a.size {
                sizes.truncate(1);
            }
        });
    }
    own
}

/// Largest relative error of a value over designs.
fn worst(found: &[DesignResult], reference: &[DesignResult], of: impl Fn(&DesignResult) -> Option<f64>) -> Option<f64> {
    let error = |(a, b): (&DesignResult, &DesignResult)| Some((of(a)? / of(b)? - 1.0).abs());
    found.iter().zip(reference).filter_map(error).reduce(f64::max)
}

fn twist(d: &DesignResult) -> Option<f64> {
    d.twist.map(|p| p.value)
}

/// Measures a study on its flexible crank, the chains against bearings times some factors, too; nothing where it is on the chain.
///
/// # Errors
/// [`RunError`] where a design has no finite response.
pub fn measure(study: &Study, factors: &[f64]) -> Result<Option<Ladder>, RunError> {
    if study.on_flexible().is_none() {
        return Ok(None);
    }
    let own = asked(study);
    let mut found = Vec::new();
    for rung in Rung::ALL {
        let Some(on) = rung.on(&own) else { continue };
        let start = Instant::now();
        let results = run(&on, &Silent)?;
        let optimum = results.optima.iter().find(|o| o.main).map(|o| o.design.absorbers.clone());
        found.push(ModelOutcome { rung, seconds: start.elapsed().as_secs_f64(), designs: results.designs, optimum });
    }
    let Some(reference) = found.iter().find(|f| f.rung == Rung::Flexible).map(|f| &f.designs) else { return Ok(None) };
    let best = |absorbers: &[Mounted]| own.evaluate("optimum", absorbers.to_vec()).map(|d| d.objective);
    let optima = found.iter().map(|f| f.optimum.as_deref().map(best).transpose()).collect::<Result<Vec<_>, _>>()?;
    let optima: Vec<Option<f64>> = optima.into_iter().map(Option::flatten).collect();
    let least = optima.last().copied().flatten();
    let cost = |(f, optimum): (&ModelOutcome, &Option<f64>)| RungCost {
        rung: f.rung,
        seconds: f.seconds,
        peak: worst(&f.designs, reference, twist).unwrap_or(0.0),
        margin: worst(&f.designs, reference, |d| d.margins.first().map(|m| m.margin)),
        optimum: optimum.zip(least).map(|(own, least)| own / least - 1.0),
    };
    let rungs = found.iter().zip(&optima).map(cost).collect();
    Ok(Some(Ladder { rungs, bearings: bearings((&own, factors), &found)? }))
}

/// Errors of the chains as all bearings get softer or stiffer.
fn bearings((study, factors): (&Study, &[f64]), found: &[ModelOutcome]) -> Result<Vec<(f64, Errors)>, RunError> {
    let (Some(flexible), Some(crank)) = (&study.flexible, &study.crank) else { return Ok(Vec::new()) };
    let mut list = Vec::new();
    for factor in factors.iter().copied() {
        let parts = (crank, &study.engine, &study.chain);
        let Ok(model) = flexible.with(|spec| spec.bearing = spec.bearing.times(factor, 1.0), parts) else { continue };
        let mut own = Study { flexible: Some(model), crank_model: CrankModel::Flexible, fatigue: None, ..study.clone() };
        own.leave_searches_out();
        own.limits.clear();
        let reference = run(&own, &Silent)?.designs;
        let chains = found.iter().filter(|f| f.rung.is_chain());
        list.push((factor, chains.filter_map(|f| Some((f.rung, worst(&f.designs, &reference, twist)?))).collect()));
    }
    Ok(list)
}
