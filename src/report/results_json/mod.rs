//! `results.json`: what a script wants of a run, with its schema.

mod judged;
mod proof;
mod values;

pub(crate) use judged::{judged, verdicts};
pub(crate) use values::values;

use super::files::{Folder, WriteError};
use super::names::RESULTS;
use crate::absorber::{Host, Mounted};
use crate::analysis::{DesignResult, FrontResult, OptimumResult, Results, TradeoffResult};
use crate::input::{FrontSpec, InputFile, MeasureSpec, Placeholder, Study};
use crate::objective::{HELD, holds};
use crate::price_words::{change, costs};
use proof::Proof;
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::Serialize;
use std::collections::BTreeMap;

/// Rises when a key changes its meaning or is no more.
const FORMAT: u32 = 1;

/// What a run of a study found.
#[derive(Debug, Serialize, JsonSchema)]
pub(crate) struct Record {
    /// Version of this format.
    format: u32,
    /// Program and version.
    program: &'static str,
    /// Name of the study.
    study: String,
    /// Name of the engine.
    engine: String,
    /// The files that were read.
    inputs: Vec<Input>,
    /// Keys of the inputs whose values are those of an example that nobody has confirmed, each with its file; absent without any.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    placeholders: Vec<Unconfirmed>,
    /// What optima are best by.
    objective: MeasureName,
    /// Whether every optimum holds every limit, and none overheats.
    limits_hold: bool,
    /// Natural frequencies of the chain without absorber, Hz; rigid rotation is left out.
    chain_frequencies_hz: Vec<f64>,
    /// Given designs, then optima.
    designs: Vec<Design>,
    /// What is known of each optimum besides its design.
    optima: Vec<Optimum>,
    /// Fronts: of the objective over ring inertia, and of pairs of measures.
    fronts: Vec<Front>,
}

/// A file that was read.
#[derive(Debug, Serialize, JsonSchema)]
struct Input {
    path: String,
    bytes: usize,
    /// CRC-32, eight hexadecimal digits.
    crc32: String,
}

/// A value of an example.
#[derive(Debug, Serialize, JsonSchema)]
struct Unconfirmed {
    file: String,
    key: String,
    value: String,
}

/// A measure.
#[derive(Debug, Serialize, JsonSchema)]
struct MeasureName {
    /// Its key in the study.
    measure: String,
    /// In words.
    label: String,
    /// Its unit.
    unit: String,
    /// Of what; empty where it is of all.
    #[serde(rename = "where")]
    place: String,
}

impl MeasureName {
    fn new(m: &MeasureSpec) -> Self {
        Self { measure: m.key.to_owned(), label: m.label.clone(), unit: m.unit.symbol().to_owned(), place: m.place.clone() }
    }
}

/// A design.
#[derive(Debug, Serialize, JsonSchema)]
struct Design {
    name: String,
    /// Whether it was searched for.
    optimum: bool,
    absorbers: Vec<Absorber>,
    /// As in `values.csv`.
    values: Vec<values::Value>,
    /// Limits of the study.
    limits: Vec<Limit>,
    /// The one value that it is judged by; absent where it has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    judged: Option<judged::Judged>,
    /// What is absurd of an optimum, or of the best design where nothing was searched; absent where nothing is.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    verdicts: Vec<judged::Verdict>,
}

/// An absorber.
#[derive(Debug, Serialize, JsonSchema)]
struct Absorber {
    #[serde(rename = "type")]
    kind: String,
    /// The station that carries it.
    #[serde(skip_serializing_if = "Option::is_none")]
    on_station: Option<String>,
    /// Number of the absorber of the design whose ring carries it.
    #[serde(skip_serializing_if = "Option::is_none")]
    on_ring_of: Option<usize>,
    hub_inertia_kg_m2: f64,
    /// By key, as in a study.
    parameters: BTreeMap<String, f64>,
}

/// A limit, and how a design stands to it at the worst of the conditions that an optimum is to hold in.
#[derive(Debug, Serialize, JsonSchema)]
struct Limit {
    #[serde(flatten)]
    of: MeasureName,
    /// Absent where nothing bounds it, and where the design has no such absorber.
    #[serde(skip_serializing_if = "Option::is_none")]
    value: Option<f64>,
    limit: f64,
    held: bool,
}

/// An optimum.
#[derive(Debug, Serialize, JsonSchema)]
struct Optimum {
    /// Name of its design.
    design: String,
    /// What it is best by.
    objective: MeasureName,
    /// At the end of the search; what its design is judged by stands there.
    value: f64,
    converged: bool,
    /// Length of the steepest-descent step, in logarithms of the parameters.
    #[serde(skip_serializing_if = "Option::is_none")]
    kkt_residual: Option<f64>,
    starts: usize,
    starts_agreeing: usize,
    /// Values of other local optima that starts ended in.
    other_optima: Vec<f64>,
    evaluations: u64,
    /// Of each limit: per cent of the objective that one per cent more of it would bring.
    limit_multipliers: Vec<f64>,
    /// Absent where it was not asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    proof: Option<Proof>,
    /// What each condition, limit and bound costs, as in `prices.csv`; absent where the study does not ask for it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    prices: Vec<Price>,
}

/// The optimum without something that is asked of it.
#[derive(Debug, Serialize, JsonSchema)]
struct Price {
    change: String,
    value_after: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    cost_percent: Option<f64>,
    limits_hold_after: bool,
}

/// A front of a family of designs.
#[derive(Debug, Serialize, JsonSchema)]
struct Front {
    /// Types of its absorbers.
    absorbers: String,
    /// Its axes.
    measures: Vec<MeasureName>,
    points: Vec<Point>,
}

/// A point of a front.
#[derive(Debug, Serialize, JsonSchema)]
struct Point {
    /// In the sequence of the measures.
    values: Vec<f64>,
    absorbers: Vec<Absorber>,
    /// Where the front tells of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    limits_hold: Option<bool>,
    /// Of a front over ring inertia: whether a limit is broken, or a lighter ring of the same type does as well. Of a pair of measures: whether another point of any family is no worse in both.
    dominated: bool,
    knee: bool,
}

/// JSON Schema of `results.json`.
#[doc(hidden)]
pub fn json_schema() -> serde_json::Value {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    let mut value = settings.into_generator().root_schema_for::<Record>().to_value();
    if let serde_json::Value::Object(map) = &mut value {
        map.insert("title".into(), "hartog: results.json".into());
    }
    value
}

/// Writes `results.json`.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub(crate) fn write(study: &Study, inputs: &[InputFile], results: &Results, folder: &Folder) -> Result<(), WriteError> {
    folder.write(RESULTS, text(study, inputs, results).as_bytes())
}

/// `results.json`.
#[doc(hidden)]
pub fn text(study: &Study, inputs: &[InputFile], results: &Results) -> String {
    let record = record(study, inputs, results);
    // numbers, words and lists of them: nothing in it can fail
    serde_json::to_string_pretty(&record).map_or_else(|e| e.to_string(), |text| text + "\n")
}

fn record(study: &Study, inputs: &[InputFile], results: &Results) -> Record {
    let input = |f: &InputFile| Input { path: f.path.display().to_string(), bytes: f.bytes, crc32: format!("{:08x}", f.crc32) };
    let unconfirmed = |p: &Placeholder| Unconfirmed { file: p.file.display().to_string(), key: p.key.clone(), value: p.value.clone() };
    let given = results.designs.iter().map(|d| design(study, results, d, false));
    let found = results.optima.iter().map(|o| design(study, results, &o.design, true));
    let over_inertia = results.fronts.iter().map(|f| over_ring_inertia(study, results, f));
    Record {
        format: FORMAT,
        program: concat!("hartog ", env!("CARGO_PKG_VERSION")),
        study: study.name.clone(),
        engine: study.engine.name.clone(),
        inputs: inputs.iter().map(input).collect(),
        placeholders: study.placeholders.iter().map(unconfirmed).collect(),
        objective: MeasureName::new(&study.objective),
        limits_hold: results.limits_hold(),
        chain_frequencies_hz: study.modes.frequencies_hz(),
        designs: given.chain(found).collect(),
        optima: results.optima.iter().map(|o| optimum(study, results, o)).collect(),
        fronts: over_inertia.chain(results.tradeoffs.iter().flat_map(|t| of_pair(study, results, t))).collect(),
    }
}

fn design(study: &Study, results: &Results, d: &DesignResult, optimum: bool) -> Design {
    let limit = |(spec, ratio): (&crate::input::LimitSpec, &f64)| Limit {
        of: MeasureName::new(&spec.of),
        value: Some(spec.of.unit.shown(ratio * spec.limit)).filter(|v| v.is_finite() && results.has_value(d, &spec.of.measure)),
        limit: spec.of.unit.shown(spec.limit),
        held: holds(*ratio),
    };
    Design {
        name: d.name.clone(),
        optimum,
        absorbers: absorbers(results, &d.absorbers),
        values: values(study, results, d),
        limits: study.limits.iter().zip(&d.limits).map(limit).collect(),
        judged: judged::judged(study, results, d),
        verdicts: judged::verdicts(results, d),
    }
}

fn absorbers(results: &Results, design: &[Mounted]) -> Vec<Absorber> {
    let absorber = |m: &Mounted| {
        let (on_station, on_ring_of) = match m.on {
            Host::Station(station) => (Some(results.system.chain.stations[station].name.clone()), None),
            Host::Ring(inner) => (None, Some(inner + 1)),
        };
        let keys = m.absorber.declaration().map_or(&[][..], |d| d.parameters);
        let parameter = |p: &crate::absorber::Parameter| Some((p.key.to_owned(), m.absorber.value(p.key).filter(|v| v.is_finite())?));
        Absorber {
            kind: m.absorber.type_name().to_owned(),
            on_station,
            on_ring_of,
            hub_inertia_kg_m2: m.hub_inertia,
            parameters: keys.iter().filter_map(parameter).collect(),
        }
    };
    design.iter().map(absorber).collect()
}

fn optimum(study: &Study, results: &Results, o: &OptimumResult) -> Optimum {
    let price = |p: &crate::analysis::Price| Price {
        change: change(study, p),
        value_after: study.objective.unit.shown(p.changed),
        cost_percent: costs(study, p),
        limits_hold_after: p.changed_holds,
    };
    let (found, objective) = (&o.optimum, study.objective_of(o.objective));
    Optimum {
        design: o.design.name.clone(),
        objective: MeasureName::new(objective),
        value: objective.unit.shown(found.value()),
        converged: o.has_converged(),
        kkt_residual: Some(found.outcome.kkt_residual).filter(|r| r.is_finite()),
        starts: found.starts.len(),
        starts_agreeing: found.agreeing(),
        other_optima: found.others.iter().map(|l| objective.unit.shown(l.value)).filter(|v| v.is_finite()).collect(),
        evaluations: found.stages.all().evaluations,
        limit_multipliers: o.prices.clone(),
        proof: o.proof.as_ref().map(|p| Proof::new(objective, p)),
        prices: results.prices.iter().filter(|p| p.design == o.design.name).map(price).collect(),
    }
}

fn over_ring_inertia(study: &Study, results: &Results, f: &FrontResult) -> Front {
    let ring = MeasureName { measure: "ring_inertia".into(), label: "ring inertia".into(), unit: "kg m2".into(), place: String::new() };
    let point = |p: &crate::optimise::FrontPoint| Point {
        values: vec![p.design[0].absorber.ring_inertia(), study.objective.unit.shown(p.value)],
        absorbers: absorbers(results, &p.design),
        limits_hold: Some(p.excess <= HELD),
        dominated: p.dominated,
        knee: false,
    };
    Front {
        absorbers: f.declaration.name.to_owned(),
        measures: vec![ring, MeasureName::new(&study.objective)],
        points: f.front.points.iter().filter(|p| p.value.is_finite()).map(point).collect(),
    }
}

fn of_pair<'a>(study: &'a Study, results: &'a Results, t: &'a TradeoffResult) -> impl Iterator<Item = Front> + 'a {
    let measures = match &study.front {
        Some(FrontSpec::Of { measures, .. }) => measures.as_slice(),
        _ => &[],
    };
    let axes: Vec<&MeasureSpec> = t.of.iter().filter_map(|m| measures.get(*m)).collect();
    t.families.iter().map(move |(family, front)| {
        let point = |p: &crate::optimise::TradeoffPoint| Point {
            values: axes.iter().zip(p.values).map(|(m, v)| m.unit.shown(v)).collect(),
            absorbers: absorbers(results, &p.design),
            limits_hold: None,
            dominated: p.dominated,
            knee: p.knee,
        };
        Front {
            absorbers: family.clone(),
            measures: axes.iter().map(|m| MeasureName::new(m)).collect(),
            points: front.points.iter().filter(|p| p.values.iter().all(|v| v.is_finite())).map(point).collect(),
        }
    })
}
