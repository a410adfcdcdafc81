//! What a law costs against a plain spring and damper, and what it would cost to take it for one.

use crate::absorber::closed_forms::{EngineMode, h_infinity_ring};
use crate::absorber::{Absorber, Declaration, HARDENING, Mounted, Operating, TYPES, Tuned};
use crate::analysis::timing::{Repeats, median_seconds};
use crate::analysis::{RunError, families, heat::of_design as heat, large_twist, model_check};
use crate::drivetrain::System;
use crate::engine::Excitation;
use crate::input::{OptimiseSpec, Study};
use crate::objective::{Measure, Over, PeakFinder};
use crate::optimise::starts::starts;
use crate::response::{Grid, Hosts, Method, Quantity, Receptance, Work};

/// A type, started by its last closed form on the first mode.
#[derive(Debug, Clone, PartialEq)]
pub struct LawCost {
    /// Its word.
    pub name: &'static str,
    /// Seconds for the refined peak of a design.
    pub seconds: f64,
    /// The same of a spring and damper.
    pub plain: f64,
    /// Relative error of the peak where S is taken for the spring and damper that it is at the frequency of the mode.
    pub error: f64,
}

const REPEATS: Repeats = Repeats { least: 3, most: 31, seconds: 0.1 };

/// Of every type that is no spring and damper, with the ring of the study, and what stiffening springs and heat cost; nothing where it optimises no synthesised quantity.
///
/// # Errors
/// [`RunError`] where a design has no finite peak.
pub fn measure(study: &Study) -> Result<Vec<LawCost>, RunError> {
    let (Some(spec), Some(quantity)) = (&study.optimise, study.objective.measure.synthesised()) else { return Ok(Vec::new()) };
    let excitation = Excitation::new(&study.engine, study.order_limit);
    let modes = families::engine_modes(study, spec, model_check::highest_frequency_hz(study, &excitation.orders));
    let Some(mode) = modes.first().and_then(|m| m.first()).copied() else { return Ok(Vec::new()) };
    let ring = families::main_ring(&spec.absorbers[0]).unwrap_or(0.1 * mode.inertia);
    let system = System::with_modes(study.chain.clone(), study.modes.clone(), excitation);
    let grid = Grid::new(&study.speeds_rpm, &system.excitation.tabulated_rpm);
    let method = Method::Receptance(Receptance::new(&system, &grid, spec.station(0), &[quantity]));
    let finder = PeakFinder::new(&system, &grid, &method, true);
    let mut list = Vec::new();
    for declaration in TYPES {
        let failed = |error| RunError { what: format!("a ring of type `{}`", declaration.name), error };
        let Some((law, constant)) = pair(declaration, ring, mode) else { continue };
        let timed = |absorber: Absorber| -> Result<(f64, f64), RunError> {
            let design = [Mounted::on_station(spec.station(0), absorber)];
            let peak = || peak(&finder, &design, quantity);
            Ok((median_seconds(REPEATS, || peak().map(|_| ())).map_err(failed)?, peak().map_err(failed)?))
        };
        let ((seconds, value), (plain, taken)) = (timed(law)?, timed(constant)?);
        list.push(LawCost { name: declaration.name, seconds, plain, error: (taken / value - 1.0).abs() });
    }
    if study.twist == quantity {
        list.extend(balanced(study, &finder, (spec.station(0), ring), mode)?);
        list.extend(heated(study, spec, &finder, &modes)?);
    }
    Ok(list)
}

/// A spring that is stiffer by a fifth at the twist of its ring, by harmonic balance over the speeds of the study, against the refined peak of the same spring without that.
fn balanced(study: &Study, finder: &PeakFinder, (station, ring): (usize, f64), mode: EngineMode) -> Result<Option<LawCost>, RunError> {
    let failed = |error| RunError { what: format!("a ring of type `{}`", HARDENING.name), error };
    let plain = h_infinity_ring(ring, mode);
    let constant = [Mounted::on_station(station, Tuned { ring_inertia: ring, stiffness: plain.stiffness, damping: plain.damping })];
    let twist = peak(finder, &constant, Quantity::RingTwist(0)).map_err(failed)?;
    let values = [ring, plain.stiffness, plain.damping, 0.2 / (0.75 * twist * twist)];
    let design = [Mounted::on_station(station, Absorber::Ring((HARDENING.build)(&values)))];
    let balance = || large_twist::of_design(study, finder, ("", &design));
    let Some(found) = balance().map_err(failed)?.and_then(|d| d.peak) else { return Ok(None) };
    let seconds = median_seconds(REPEATS, || balance().map(|_| ())).map_err(failed)?;
    let taken = peak(finder, &constant, study.twist).map_err(failed)?;
    let plain = median_seconds(REPEATS, || peak(finder, &constant, study.twist).map(|_| ())).map_err(failed)?;
    Ok(Some(LawCost { name: "hardening, by harmonic balance", seconds, plain, error: (taken / found.twist - 1.0).abs() }))
}

/// The first family of the study whose material says what cools it, at its first closed form: all its temperatures in balance at every speed, on one thread, against its refined peak at the reference
/// temperature.
fn heated(study: &Study, spec: &OptimiseSpec, finder: &PeakFinder, modes: &[Vec<EngineMode>]) -> Result<Option<LawCost>, RunError> {
    let cooled = |m: &Mounted| m.absorber.law().is_some_and(|l| l.material().is_some_and(|material| material.thermal.is_some()));
    let first = |f: &families::Family| starts(&f.space, modes, 0, spec.seed).first().map(|start| f.space.design(&start.1));
    let designs = families::wanted(spec, modes).into_iter().filter_map(|f| Some((f.name.clone(), first(&f)?)));
    let Some((name, design)) = designs.into_iter().find(|d| d.1.iter().any(cooled)) else { return Ok(None) };
    let Ok(one) = rayon::ThreadPoolBuilder::new().num_threads(1).build() else { return Ok(None) };
    let failed = |error| RunError { what: format!("`{name}`"), error };
    // what the chain does to its station is solved once a study, as it is for the plain ring
    let hosts = Hosts::of(&finder.direct, study.twist, std::iter::once(design.as_slice()));
    let balances = || one.install(|| heat(study, finder, &hosts, (&name, &design)));
    let Some(found) = balances().map_err(failed)? else { return Ok(None) };
    let seconds = median_seconds(REPEATS, || balances().map(|_| ())).map_err(failed)?;
    let plain = median_seconds(REPEATS, || peak(finder, &design, study.twist).map(|_| ())).map_err(failed)?;
    let (taken, warm) = (peak(finder, &design, study.twist).map_err(failed)?, found.points.iter().map(|p| p.twist).fold(0.0, f64::max));
    Ok(Some(LawCost { name: "balance of heat", seconds, plain, error: (taken / warm - 1.0).abs() }))
}

fn peak(finder: &PeakFinder, design: &[Mounted], quantity: Quantity) -> Result<f64, crate::response::ResponseError> {
    let measure = Measure::new(vec![quantity], Over::Synthesis);
    Ok(finder.peak(design, &measure, &mut Work::default())?.map_or(0.0, |p| p.value))
}

/// A ring of a type, and the spring and damper that it is at the frequency of a mode; nothing of types that are one at every frequency.
fn pair(declaration: &'static Declaration, ring: f64, mode: EngineMode) -> Option<(Absorber, Absorber)> {
    let values = (declaration.closed_forms.last()?.values)(ring, mode);
    let law = (declaration.build)(&values);
    if law.spring_and_damper().is_some() {
        return None;
    }
    let s = law.dynamic_stiffness(Operating { omega: mode.omega, shaft_speed: mode.omega / 6.0 });
    let constant = Tuned { ring_inertia: ring, stiffness: s.re, damping: s.im / mode.omega };
    Some((Absorber::Ring(law), constant.into()))
}
