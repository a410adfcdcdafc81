//! Everything that is reported of one design.

use super::evaluation_plan::{EvaluationPlan, asked, shafts};
use super::margins::{self, SmallestMargin};
use super::required_material::{MadeOf, made_of};
use super::{BarredRange, ConditionResult, RuleStress, RunError, StillBroken, barred, conditions};
use crate::absorber::Mounted;
use crate::drivetrain::{System, natural};
use crate::input::Study;
use crate::numerics::C64;
use crate::objective::{Condition, DesignPeaks, Measure, Over, Peak, PeakFinder, Place, holds};
use crate::response::{Quantity, ResponseError, Unamplified, Work, quasi_static};

/// What makes a peak.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub enum PeakKind {
    /// An order is amplified by a resonance.
    Resonant,
    /// Forced: no order is amplified much.
    Forced,
    /// At the lowest or highest speed.
    EndOfRange,
}

/// A peak set against the quasi-static response at its speed.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Nature {
    /// What makes it.
    pub kind: PeakKind,
    /// The peak over the quasi-static value.
    pub over_static: f64,
    /// Index of the order that adds most to its quasi-static value.
    pub order: usize,
    /// That order over its quasi-static value.
    pub amplification: f64,
}

/// A peak is resonant where the order that adds most is amplified at least this much and adds at least a fifth of the peak.
const RESONANT: f64 = 1.5;
const SHARE: f64 = 0.2;

/// Sets peaks against the quasi-static response of the chain.
#[derive(Debug, Clone)]
pub(crate) struct Classifier {
    quantity: Quantity,
    /// Per torque at each station.
    per_torque: Vec<f64>,
}

impl Classifier {
    /// For one quantity.
    pub fn new(system: &System, quantity: Quantity) -> Self {
        Self { quantity, per_torque: quasi_static(system, quantity) }
    }

    /// Phasors of the quasi-static response at one speed.
    fn phasors(&self, system: &System, speed_rpm: f64) -> Vec<C64> {
        let mut torque = vec![C64::default(); system.chain.len()];
        (0..system.orders())
            .map(|n| {
                system.torque(n, speed_rpm, &mut torque);
                torque.iter().zip(&self.per_torque).map(|(t, s)| t * s).sum()
            })
            .collect()
    }

    /// What makes this peak of a design; `None` for a peak of another quantity, and on a flexible crank, which forces without torque bend, too.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    pub(crate) fn nature(&self, finder: &PeakFinder, design: &[Mounted], peak: &Peak) -> Result<Option<Nature>, ResponseError> {
        if peak.quantity != self.quantity || peak.place == Place::Nowhere || finder.system.flexible.is_some() {
            return Ok(None);
        }
        let still = self.phasors(finder.system, peak.speed_rpm);
        let mut moving = vec![C64::default(); still.len()];
        finder.direct.at(design, self.quantity, peak.speed_rpm, &mut moving, &mut Work::default())?;
        let orders = if peak.extremes.is_some() { 0..still.len() } else { peak.order..peak.order + 1 };
        let adds = |n: usize| moving[n].norm() - still[n].norm();
        let order = orders.fold(peak.order, |m, n| if adds(n) > adds(m) { n } else { m });
        let reference = if peak.extremes.is_some() { finder.synthesis(&still)[0] } else { still[peak.order].norm() };
        let amplification = moving[order].norm() / still[order].norm();
        if !(amplification.is_finite() && reference > 0.0) {
            // the torque does not push any elastic mode: there is nothing to compare with
            return Ok(None);
        }
        let kind = match peak.place {
            Place::End => PeakKind::EndOfRange,
            Place::Interior if amplification >= RESONANT && adds(order) >= SHARE * peak.value => PeakKind::Resonant,
            Place::Interior | Place::Nowhere => PeakKind::Forced,
        };
        Ok(Some(Nature { kind, over_static: peak.value / reference, order, amplification }))
    }
}

/// Largest value over the grid if no mode were amplified: what would be left if nothing resonated.
pub(crate) fn floor(finder: &PeakFinder, quantity: Quantity, over: Over) -> f64 {
    let system = finder.system;
    let unamplified = Unamplified::new(system, quantity);
    let mut torque = vec![C64::default(); system.chain.len()];
    let mut work = vec![];
    for &speed in &finder.grid.speed_rpm {
        for n in 0..system.orders() {
            system.torque(n, speed, &mut torque);
            work.push(unamplified.phasor(&torque, system.excitation.orders[n].omega(speed)));
        }
    }
    match over {
        Over::Orders => work.iter().map(|y| y.norm()).fold(0.0, f64::max),
        Over::Order(order) => {
            let index = finder.system.excitation.orders.iter().position(|o| *o == order);
            let largest_of_order = |n| work.iter().skip(n).step_by(finder.system.orders()).map(|y| y.norm()).fold(0.0, f64::max);
            index.map_or(0.0, largest_of_order)
        }
        Over::Statistic(s) => work.chunks(system.orders()).map(|y| (s.0.value)(y)).fold(0.0, f64::max),
        Over::Synthesis
        | Over::Mean
        | Over::AtDuty(_)
        | Over::Margin(_)
        | Over::Power
        | Over::Temperature
        | Over::MeanPower
        | Over::Damage
        | Over::Strain
        | Over::SpringStress
        | Over::Property(_) => finder.synthesis(&work).into_iter().fold(0.0, f64::max),
    }
}

/// What one absorber of a design bears where everything works, SI.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct AbsorberLoad {
    /// Largest mean power that it dissipates, W.
    pub power: f64,
    /// Largest synthesised twist of its ring, rad.
    pub ring_twist: f64,
    /// What it would have to be made of, where its geometry is given.
    pub made_of: Option<MadeOf>,
}

/// Numbers of one design, SI.
#[derive(Debug, Clone, serde::Serialize)]
pub struct DesignResult {
    /// Its name.
    pub name: String,
    /// Its absorbers.
    pub absorbers: Vec<Mounted>,
    /// Without rigid modes and the engine's own damping, Hz, ascending.
    pub frequencies_hz: Vec<f64>,
    /// Synthesised twist.
    pub twist: Option<Peak>,
    /// Largest order of the twist.
    pub order_twist: Option<Peak>,
    /// Largest order of the hub's amplitude.
    pub order_hub: Option<Peak>,
    /// Synthesised vibratory torque of all shafts.
    pub torque: Option<Peak>,
    /// Largest mean power dissipated by the absorbers together, W.
    pub power: Option<f64>,
    /// Largest synthesised ring twist, rad.
    pub ring_twist: Option<f64>,
    /// The same of each absorber by itself.
    pub loads: Vec<AbsorberLoad>,
    /// The study's objective, the largest over the conditions that an optimum is to hold in; nothing where no steady motion at its own amplitude is known at some speed.
    pub objective: Option<f64>,
    /// The same at the reference: all cylinders fire, materials are at their reference, twist is small.
    pub reference: Option<f64>,
    /// Value of each limited measure over its limit, the largest over the same conditions.
    pub limits: Vec<f64>,
    /// The same where everything works.
    pub limits_firing: Vec<f64>,
    /// Ranges of speed that rules bar, of limits that it breaks.
    pub barred: Vec<BarredRange>,
    /// Where it breaks them outside those.
    pub still_broken: Vec<StillBroken>,
    /// The largest stress over each limit by a rule.
    pub rule_stresses: Vec<RuleStress>,
    /// Smallest margin of the crank by each criterion of the study.
    pub margins: Vec<SmallestMargin>,
    /// In the other conditions of the study that make a difference to it.
    pub conditions: Vec<ConditionResult>,
}

impl DesignResult {
    /// Whether every limit holds, of a design that has an objective: without a steady motion at some speed there is none.
    #[doc(hidden)]
    pub fn within_limits(&self) -> bool {
        self.objective.is_some() && self.limits.iter().all(|l| holds(*l))
    }

    /// Whether a measure says something of the design.
    #[doc(hidden)]
    pub fn has(&self, measure: &Measure) -> bool {
        measure.is_of(self.absorbers.len())
    }
}

/// Evaluates one design. `finders`: of the engine as it should be, then with each cylinder misfiring where a condition asks for it.
///
/// # Errors
/// [`RunError`] where nothing damps a resonance, with the condition.
pub fn evaluate(
    finders: &[PeakFinder],
    name: &str,
    design: &[Mounted],
    wanted: &EvaluationPlan,
    work: &mut Work,
) -> Result<DesignResult, RunError> {
    let firing = firing(&finders[0], name, design, wanted, work);
    let (mut result, mut own_limits) = firing.map_err(|error| RunError { what: name.to_owned(), error })?;
    let mut conditions = conditions::in_conditions(finders, name, design, wanted, work)?;
    let mut asked: Vec<(f64, &Vec<f64>)> = vec![(result.objective.unwrap_or(0.0), &own_limits)];
    // a condition that makes no difference to the design is that of firing
    let judged_in = wanted.judged_in(design);
    asked.extend(conditions.iter().filter(|c| judged_in.contains(&c.condition)).map(|c| (c.objective, &c.limits)));
    let differs = |held: &Condition| conditions.iter().any(|c| c.condition == *held);
    if judged_in.iter().all(differs) {
        asked.remove(0);
    }
    result.objective = Some(asked.iter().map(|a| a.0).fold(0.0, f64::max));
    result.limits = (0..own_limits.len()).map(|l| asked.iter().map(|a| a.1[l]).fold(0.0, f64::max)).collect();
    let failed = |error| RunError { what: name.to_owned(), error };
    result.barred = barred::ranges(finders, design, wanted, &result.limits).map_err(failed)?;
    result.still_broken = barred::still_broken(finders, design, wanted, &result.limits, &result.barred).map_err(failed)?;
    let excepted = barred::excepted(finders, design, wanted).map_err(failed)?;
    for b in &excepted {
        let own = conditions.iter_mut().find(|c| c.condition == b.condition).map_or(&mut own_limits, |c| &mut c.limits);
        let used = barred::over_allowed(&wanted.limits[b.limit], b);
        own[b.limit] = own[b.limit].max(used);
        result.limits[b.limit] = result.limits[b.limit].max(used);
    }
    result.barred.extend(excepted.into_iter().filter(|b| !holds(b.ratio)));
    result.rule_stresses = barred::rule_stresses(finders, design, wanted).map_err(failed)?;
    result.conditions = conditions;
    result.limits_firing = own_limits;
    Ok(result)
}

/// The design where everything works, and each limited measure over its limit.
fn firing(
    finder: &PeakFinder,
    name: &str,
    design: &[Mounted],
    wanted: &EvaluationPlan,
    work: &mut Work,
) -> Result<(DesignResult, Vec<f64>), ResponseError> {
    let measure_of = |quantities: Vec<Quantity>, over: Over| Measure::new(quantities, over);
    let rings: Vec<Quantity> = (0..design.len()).map(Quantity::RingTwist).collect();
    let (twist, torque) = (measure_of(vec![wanted.twist], Over::Synthesis), measure_of(shafts(finder), Over::Synthesis));
    let (ring_twist, power) = (measure_of(rings.clone(), Over::Synthesis), measure_of(rings, Over::Power));
    let measures = [&twist, &torque, &ring_twist, &power].into_iter().chain(wanted.asked()).chain(wanted.margins);
    let peaks = &mut DesignPeaks::new(finder, design, measures);
    let twist = peaks.peak(&twist, work)?;
    let order_twist = peaks.peak(&measure_of(vec![wanted.twist], Over::Orders), work)?;
    let order_hub = peaks.peak(&measure_of(vec![Quantity::Twist { from: wanted.hub, to: None }], Over::Orders), work)?;
    let torque = if torque.quantities.is_empty() { None } else { peaks.peak(&torque, work)? };
    let mut largest = |measure: &Measure| -> Result<Option<f64>, ResponseError> {
        if design.is_empty() { Ok(None) } else { Ok(Some(peaks.peak(measure, work)?.map_or(0.0, |p| p.value))) }
    };
    let (ring_twist, power) = (largest(&ring_twist)?, largest(&power)?);
    let (objective, limits) = asked(peaks, wanted, work)?;
    let loads = loads(peaks, work)?;
    let result = DesignResult {
        name: name.to_owned(),
        absorbers: design.to_vec(),
        frequencies_hz: natural::frequencies_hz(&finder.system.chain, &finder.system.modes, design),
        twist,
        order_twist,
        order_hub,
        torque,
        power,
        ring_twist,
        loads,
        objective: Some(objective),
        reference: Some(objective),
        limits: Vec::new(),
        limits_firing: Vec::new(),
        barred: Vec::new(),
        still_broken: Vec::new(),
        rule_stresses: Vec::new(),
        margins: margins::smallest_of(peaks, wanted.margins, work)?,
        conditions: Vec::new(),
    };
    Ok((result, limits))
}

/// What each absorber bears.
fn loads(peaks: &mut DesignPeaks, work: &mut Work) -> Result<Vec<AbsorberLoad>, ResponseError> {
    let design = peaks.design;
    let one = |i: usize| {
        let mut largest = |over: Over| -> Result<f64, ResponseError> {
            Ok(peaks.peak(&Measure::new(vec![Quantity::RingTwist(i)], over), work)?.map_or(0.0, |p| p.value))
        };
        let (power, ring_twist) = (largest(Over::Power)?, largest(Over::Synthesis)?);
        Ok(AbsorberLoad { power, ring_twist, made_of: made_of(&design[i].absorber, ring_twist) })
    };
    (0..design.len()).map(one).collect()
}

/// Largest value of the objective if nothing resonated, where it is a twist.
pub(super) fn forced_floor(study: &Study, finder: &PeakFinder) -> Option<f64> {
    match study.objective.measure.quantities.as_slice() {
        [q] if study.objective.is_twist && study.objective.measure.over != Over::Mean && finder.system.flexible.is_none() => {
            Some(floor(finder, *q, study.objective.measure.over))
        }
        _ => None,
    }
}
