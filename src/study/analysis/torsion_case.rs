//! Margins at two instants of the cycle by a torsion case of \[Villalva 2014\] beside those over the full cycle, over speed.

use super::{DesignResult, RunError};
use crate::absorber::Mounted;
use crate::crankshaft::critical_locations::{nominal, shafts_at_bearings};
use crate::crankshaft::loads::CrankModel;
use crate::crankshaft::torsion_cases::{AtInstants, Instants, PerLoad, TorsionCase, stresses};
use crate::crankshaft::{Crank, FactorSource, FatigueSpec, FilletSpec, Margin, MarginCriterion, Place, Torque, Used};
use crate::drivetrain::{Chain, System};
use crate::fatigue::{Criterion, Strength};
use crate::input::Study;
use crate::numerics::synthesis::Extremes;
use crate::objective::PeakFinder;
use crate::response::{Direct, Grid, Method, Quantity, Response, ResponseError, Work};

/// The two places.
pub(crate) const PLACES: [Place; 2] = [Place::Crankpin, Place::Journal];

/// A design at one speed and place.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct CaseAtSpeed {
    /// rpm.
    pub speed_rpm: f64,
    /// At the two instants.
    pub at: AtInstants,
    /// Safety factors by Goodman at crankpin and journal.
    pub safety_factors: [f64; 2],
    /// The smallest over the full cycle at any crankpin and any journal; `None` without Goodman among the criteria of the study.
    pub full_cycle: [Option<f64>; 2],
}

/// A design by a torsion case over speed.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct CaseOfDesign {
    /// Its name.
    pub design: String,
    /// One a speed.
    pub speeds: Vec<CaseAtSpeed>,
}

impl CaseOfDesign {
    /// The speed with the smallest factor at a place (0: crankpins, 1: journals).
    #[doc(hidden)]
    pub fn smallest(&self, place: usize) -> Option<&CaseAtSpeed> {
        self.speeds.iter().min_by(|a, b| a.safety_factors[place].total_cmp(&b.safety_factors[place]))
    }
}

/// Extremes of the torque of every shaft at the speeds of a grid: a row a shaft.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance.
#[doc(hidden)]
pub fn torques(system: &System, design: &[Mounted], grid: &Grid) -> Result<Vec<Vec<Extremes>>, ResponseError> {
    let method = Method::Direct(Direct::new(system, grid));
    let finder = PeakFinder::new(system, grid, &method, false);
    let shafts: Vec<Quantity> = (0..system.chain.len() - 1).map(Quantity::ShaftTorque).collect();
    let sweeps = finder.method.sweep_each(design, &shafts, &mut Work::default())?;
    Ok(sweeps.iter().map(|s| finder.extremes(s)).collect())
}

/// The crank as the source has it: both rods of a V at the middle of the pin.
#[doc(hidden)]
pub fn in_the_middle(crank: &Crank) -> Crank {
    Crank { rod_spacing: 0.0, ..crank.clone() }
}

/// Vibratory torque at every bearing from that of the shafts: a bearing between neighbouring throws carries the torque of the shaft there. Nothing where the throws do not follow each other along the chain.
#[doc(hidden)]
pub fn at_bearings(chain: &Chain, throws: usize, shafts: &[Extremes]) -> Option<Vec<f64>> {
    Some(shafts_at_bearings(chain, throws)?.into_iter().map(|s| shafts[s].half_peak_to_peak).collect())
}

/// The most used location at a place over the full cycle, with its name.
#[doc(hidden)]
pub fn most_used(model: &Margin, criterion: usize, place: Place, speed_rpm: f64, torques: &[Extremes]) -> Option<(String, Used)> {
    let own = model.locations.iter().enumerate().filter(|(i, s)| s.place == place && model.judges(criterion, *i));
    let used =
        own.map(|(i, s)| (s.name.clone(), model.used(criterion, i, speed_rpm, &Torque { extremes: torques[s.shaft], phasors: &[] })));
    used.reduce(|m, u| if u.1.value > m.1.value { u } else { m })
}

/// Stresses per load of the first fillet with factors at each place; `None` where a place has none.
#[doc(hidden)]
pub fn per_load(crank: &Crank, spec: &FatigueSpec) -> Option<[PerLoad; 2]> {
    let of = |place: Place| {
        let own = spec.fillets.iter().filter(|f| f.place == place);
        let per_load = |f: &FilletSpec| {
            let on_web = matches!(f.factors, FactorSource::Formulas(_));
            nominal(crank, spec, f).map(|n| PerLoad { bending: n.bending, on_web, torsion: n.torsion })
        };
        own.filter_map(per_load).next()
    };
    Some([of(PLACES[0])?, of(PLACES[1])?])
}

/// Designs by the case that the study asks for; nothing where it asks for none.
///
/// # Errors
/// [`RunError`] where a design has no finite response.
pub(crate) fn by_case(study: &Study, firing: &PeakFinder, shown: &[&DesignResult]) -> Result<Vec<CaseOfDesign>, RunError> {
    let asked = study.fatigue.as_ref().and_then(|f| Some((f, f.torsion_case?)));
    let (Some((spec, case)), Some(crank)) = (asked, &study.crank) else { return Ok(Vec::new()) };
    let crank = in_the_middle(crank);
    let engine = study.engine_of_crank();
    let (Some(per_load), Some(model)) = (per_load(&crank, spec), CrankModel::thesis(engine, &crank)) else { return Ok(Vec::new()) };
    let instants: Vec<Instants> = study.speeds_rpm.iter().map(|speed| Instants::new(engine, &model.at(*speed))).collect();
    let goodman = spec.criteria.iter().position(|c| *c == MarginCriterion::MeanStress(Criterion::Goodman));
    let full = firing.margin.zip(goodman);
    let grid = Grid::new(&study.speeds_rpm, &[]);
    if shafts_at_bearings(&study.chain, crank.throws()).is_none() {
        return Ok(Vec::new());
    }
    let design = |d: &&DesignResult| {
        let torques =
            torques(firing.system, &d.absorbers, &grid).map_err(|error| RunError { what: format!("design `{}`", d.name), error })?;
        let speeds = study.speeds_rpm.iter().zip(&instants).enumerate().map(|(i, (speed, at))| {
            let shafts: Vec<Extremes> = torques.iter().map(|t| t[i]).collect();
            let vibratory = at_bearings(&study.chain, crank.throws(), &shafts).unwrap_or_default();
            at_speed((case, at, *speed), &vibratory, (per_load, spec.strength), |place| {
                full.and_then(|(model, goodman)| Some(1.0 / most_used(model, goodman, place, *speed, &shafts)?.1.value))
            })
        });
        Ok(CaseOfDesign { design: d.name.clone(), speeds: speeds.collect() })
    };
    shown.iter().map(design).collect()
}

fn at_speed(
    (case, at, speed_rpm): (TorsionCase, &Instants, f64),
    vibratory: &[f64],
    (per_load, strength): ([PerLoad; 2], Strength),
    full_cycle: impl Fn(Place) -> Option<f64>,
) -> CaseAtSpeed {
    let at = stresses(case, at, vibratory, per_load, strength);
    let safety_factors = at.cycles.map(|c| Criterion::Goodman.safety_factor(c, strength));
    CaseAtSpeed { speed_rpm, at, safety_factors, full_cycle: PLACES.map(full_cycle) }
}
