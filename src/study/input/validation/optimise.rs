//! What is to be optimised, and the front.

use super::absorbers::{engine_mode, hosts, only_one_follows, root};
use super::family::{AbsorberSpec, family, ordered};
use super::material_states::Known;
use crate::absorber::Host;
use crate::drivetrain::{Chain, Modes};
use crate::engine::{Engine, Source};
use crate::input::error::{At, Check};
use crate::input::measure::MeasureSpec;
use crate::input::schema::absorber::RawOptimised;
use crate::input::schema::bounds::{self, BOXES, COMBUSTION, GAP, POINTS_OF_FRONT, SEED};
use crate::input::schema::measure::RawMeasure;
use crate::input::schema::prove::{EFFORT, RawProveOptima};
use crate::input::schema::study::{RawAgainst, RawCondition, RawOptimise, RawStudy};
use crate::numerics::elementary::Elementary;
use crate::objective::Condition;
use crate::objective::condition::Burning;
use crate::optimise::Effort;

/// More optima than this are a mistake in the file: each takes a search of its own.
const MOST_OPTIMA: usize = 1000;

/// What is proved of optima.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProveSpec {
    /// How closely.
    pub effort: Effort,
    /// Whether it is asked of all of them: of several absorbers, of every size and of fronts, too.
    pub all: bool,
    /// Whether proofs are written for others to check.
    pub file: bool,
}

/// What to optimise.
#[derive(Debug, Clone, PartialEq)]
pub struct OptimiseSpec {
    /// Of the random starts.
    pub seed: u64,
    /// How many starts are random.
    pub random_starts: usize,
    /// The absorbers, at least one.
    pub absorbers: Vec<AbsorberSpec>,
    /// Conditions it is to hold in; at least firing or a misfire.
    pub conditions: Vec<Condition>,
    /// Whether it is searched in operation, too, where there are no limits.
    pub in_operation: bool,
    /// Whether optima are sought without each condition, limit and bound in turn.
    pub prices: bool,
    /// What is proved of optima.
    pub prove: ProveSpec,
    /// Whether compounds, oils and steps that cannot be best are searched, too.
    #[doc(hidden)]
    pub search_all: bool,
}

impl OptimiseSpec {
    /// Station below an absorber.
    pub fn station(&self, index: usize) -> usize {
        let hosts: Vec<Option<Host>> = self.absorbers.iter().map(|a| Some(a.on)).collect();
        // checked where the study was read
        root(&hosts, index).unwrap_or_default()
    }
}

/// How many starts are random where a study says nothing.
pub(super) const RANDOM_STARTS: usize = 4;

/// A front.
#[derive(Debug, Clone, PartialEq)]
pub enum FrontSpec {
    /// Of the objective against these ring inertias, ascending, kg m².
    OverInertia(Vec<f64>),
    /// Of each pair of two or three measures.
    Of {
        /// About how many points of each pair and family.
        points: usize,
        /// The measures.
        measures: Vec<MeasureSpec>,
    },
}

/// What words of `of` mean.
pub(super) type ByWord<'a> = &'a dyn Fn(&mut Check, &At<Vec<At<String>>>) -> Option<Vec<MeasureSpec>>;

/// Conditions as listed, each once; a misfire needs a cylinder pressure.
pub fn conditions(check: &mut Check, list: &At<Vec<At<RawCondition>>>, engine: &Engine) -> Vec<Condition> {
    let mut conditions = Vec::new();
    for raw in list.get_ref() {
        let condition = raw.get_ref().0;
        let name = condition.name();
        if condition.burning() != Burning::Alike && matches!(engine.source, Source::Harmonics(_)) {
            check.wrong(raw, format!("found `{name}` with torque harmonics, which are of cylinders that fire alike, expected it with a cylinder pressure only"));
        }
        if conditions.contains(&condition) {
            check.wrong(raw, format!("found condition `{name}` a second time, expected each once"));
        }
        conditions.push(condition);
    }
    if conditions.is_empty() {
        let all = Condition::NAMED.map(Condition::name).join(", ");
        check.wrong(list, format!("found an empty list, expected at least one condition: {all}"));
    }
    conditions
}

/// Shares by which cylinders burn more or less than the others; needed by the condition that uses it, and by nothing else.
pub(super) fn scatter(check: &mut Check, study: &RawStudy, engine: &Engine, conditions: &[Condition]) -> Option<Vec<f64>> {
    let is_used = conditions.contains(&Condition::UnequalCylinders);
    let Some(raw) = &study.scatter else {
        let lists = study.conditions.iter().chain(study.optimise.iter().flat_map(|o| &o.conditions));
        if let Some(unequal) = lists.flat_map(|l| l.get_ref()).find(|c| c.get_ref().0 == Condition::UnequalCylinders) {
            check.wrong(unequal, "found `unequal_cylinders` without [scatter], expected a share for each cylinder in `combustion` there");
        }
        return None;
    };
    if !is_used {
        check.wrong(raw, "found [scatter], which no condition uses, expected `unequal_cylinders` among the `conditions`");
    }
    let list = &raw.get_ref().combustion;
    let (found, cylinders) = (list.get_ref().len(), engine.layout.firing_deg.len());
    if found != cylinders {
        check.wrong(list, format!("found {found} values, expected one for each of the {cylinders} cylinders"));
    }
    Some(list.get_ref().iter().map(|share| check.within(share, &COMBUSTION)).collect())
}

pub(crate) fn resolve(
    check: &mut Check,
    study: &RawStudy,
    engine: &Engine,
    (chain, modes): (&Chain, &Modes),
    known: Known,
) -> Option<OptimiseSpec> {
    let raw = study.optimise.as_ref()?;
    under_limits(check, raw, &study.constraint);
    let seed = raw.seed.as_ref().map_or(1, |s| check.whole(s, &SEED));
    let random_starts = raw.random_starts.as_ref().map_or(RANDOM_STARTS, |n| check.whole(n, &bounds::RANDOM_STARTS) as usize);
    let list = raw.absorber.get_ref();
    if list.is_empty() {
        check.wrong(&raw.absorber, "found no [[optimise.absorber]], expected at least one");
        return None;
    }
    let hosts = hosts(check, chain, &list.iter().map(|a| (a.name.as_ref(), &a.on)).collect::<Vec<_>>());
    let absorbers = list.iter().enumerate().map(|(i, a)| family(check, a, hosts[i].zip(root(&hosts, i)), (chain, modes), known));
    let absorbers: Vec<Option<AbsorberSpec>> = absorbers.collect();
    only_one_follows(check, list.iter().map(|a| a.material.values().map(At::get_ref).collect()));
    let optima = absorbers.iter().flatten().map(AbsorberSpec::choices).fold(1, usize::saturating_mul);
    if optima > MOST_OPTIMA {
        check.wrong(&raw.absorber, format!("found {optima} combinations of types and sizes, expected at most {MOST_OPTIMA}"));
    }
    alternatives(check, list, absorbers.iter().flatten());
    let conditions = raw.conditions.as_ref().map_or_else(|| vec![Condition::Firing], |c| conditions(check, c, engine));
    if let Some(list) = &raw.conditions
        && !conditions.iter().any(|c| c.has_absorbers())
    {
        let working: Vec<String> = Condition::NAMED.iter().filter(|c| c.has_absorbers()).map(|c| format!("`{}`", c.name())).collect();
        check.wrong(list, format!("found no condition in which an absorber works, expected one of {} among them", working.join(", ")));
    }
    let in_operation = raw.in_operation.as_ref().is_some_and(|o| *o.get_ref());
    Some(OptimiseSpec {
        seed,
        random_starts,
        absorbers: absorbers.into_iter().collect::<Option<_>>()?,
        conditions,
        in_operation,
        prices: raw.prices.unwrap_or(false),
        prove: prove(check, raw.prove.as_ref()),
        search_all: false,
    })
}

fn prove(check: &mut Check, raw: Option<&At<RawProveOptima>>) -> ProveSpec {
    let Some(raw) = raw.map(At::get_ref) else { return ProveSpec { effort: EFFORT, all: false, file: false } };
    ProveSpec { effort: effort(check, (raw.gap.as_ref(), raw.boxes.as_ref())), all: true, file: raw.file.unwrap_or(false) }
}

pub(super) fn effort(check: &mut Check, (gap, boxes): (Option<&At<f64>>, Option<&At<i64>>)) -> Effort {
    Effort {
        gap: gap.map_or(EFFORT.gap, |gap| check.within(gap, &GAP)),
        boxes: boxes.map_or(EFFORT.boxes, |boxes| check.whole(boxes, &BOXES)),
    }
}

/// Most compounds and oils, with the steps of dimensions, of one type.
const MOST_ALTERNATIVES: usize = 200;

/// Compounds, oils and steps are chosen for one absorber at a time.
fn alternatives<'s>(check: &mut Check, list: &[RawOptimised], specs: impl Iterator<Item = &'s AbsorberSpec>) {
    let most = specs.map(AbsorberSpec::alternatives).max().unwrap_or(0);
    let Some(at) = list.iter().flat_map(|a| a.material.values()).find(|m| m.get_ref().of.as_ref().is_some_and(|o| o.get_ref().len() > 1))
    else {
        if let Some(raw) = list.first().filter(|_| most > MOST_ALTERNATIVES || most > 1 && list.len() > 1) {
            check.wrong(
                &raw.types,
                format!("found {most} steps of dimensions, expected at most {MOST_ALTERNATIVES}, and steps of one absorber alone"),
            );
        }
        return;
    };
    if list.len() > 1 {
        check.wrong(
            at,
            "found several compounds or oils beside another absorber, expected one each: they are chosen for one absorber alone",
        );
    }
    if most > MOST_ALTERNATIVES {
        check.wrong(at, format!("found {most} combinations of compounds or oils and steps, expected at most {MOST_ALTERNATIVES}"));
    }
}

/// Limits are judged in operation: a search that leaves it out may find what does not hold them there.
fn under_limits(check: &mut Check, raw: &RawOptimise, limits: &[At<RawMeasure>]) {
    if let Some(no) = raw.in_operation.as_ref().filter(|o| !*o.get_ref() && !limits.is_empty()) {
        check.wrong(no, "found `false` beside [[constraint]], expected `true` or nothing: limits are judged in operation, so that the search looks there, too");
    }
}

pub(super) fn front(
    check: &mut Check,
    study: &RawStudy,
    optimise: Option<&OptimiseSpec>,
    (chain, modes): (&Chain, &Modes),
    by_word: ByWord,
) -> Option<FrontSpec> {
    let raw = study.pareto.as_ref()?;
    if study.optimise.is_none() {
        check.wrong(raw, "found [pareto] without [optimise], expected what is to be optimised");
    }
    let points = check.whole(&raw.get_ref().points, &POINTS_OF_FRONT);
    let against = match (&raw.get_ref().against, &raw.get_ref().of) {
        (Some(against), None) => against,
        (None, Some(words)) => return Some(FrontSpec::Of { points: points as usize, measures: by_word(check, words)? }),
        _ => {
            check.wrong(raw, "found both or neither of `against` and `of`, expected a range of rings or the measures of a front");
            return None;
        }
    };
    if optimise.is_some_and(|o| o.absorbers.len() > 1) {
        check.wrong(
            raw,
            "found [pareto] with several absorbers, expected one: a front over the inertia of one ring among others is not defined; `of` takes any number",
        );
    }
    let (RawAgainst::RingInertia(pair) | RawAgainst::InertiaRatio(pair)) = against;
    let (a, b) = ordered(check, pair, false);
    let unit = match against {
        RawAgainst::RingInertia(_) => 1.0,
        RawAgainst::InertiaRatio(_) => {
            let (spec, family) = (optimise?, &optimise?.absorbers[0]);
            let Some(mode) = engine_mode(chain, modes, spec.station(0), family.whole_chain) else {
                check.wrong(raw, "no elastic mode moves the absorber's station, expected `against.ring_inertia_kg_m2` instead of a ratio");
                return None;
            };
            mode.inertia
        }
    };
    // equal ratios: the light rings, where the front is steep, get as many points as the heavy ones
    let inertias = (0..points).map(|i| a * unit * (b / a).power(i as f64 / (points - 1) as f64)).collect();
    Some(FrontSpec::OverInertia(inertias))
}
