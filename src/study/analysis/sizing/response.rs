//! A crank sized by the torque of its own chain: crank, chain and absorber in turns until they agree.

use super::files;
use super::results::{ByResponse, SizeError, TOLERANCE};
use crate::absorber::Mounted;
use crate::analysis::run::run;
use crate::analysis::{DesignResult, Progress, RunError, Silent};
use crate::drivetrain::System;
use crate::input::{SizedAbsorber, SizingStudy};
use crate::numerics::C64;
use crate::numerics::elementary::turn;
use crate::response::{Direct, Grid, Quantity, Work};
use crate::sizing::cycle::samples_of_cycle;
use crate::sizing::{Round, Sized, SizingError, TorqueCase, fit};
use crate::units::HZ_PER_RPM;
use std::f64::consts::PI;

/// Most rounds of sizing and response.
const MOST_ROUNDS: usize = 100;
/// From these rounds on the chain follows the crank by this share only: a crank whose stiffness moves a resonance to and fro would never settle.
const SHARES: [(usize, f64); 3] = [(1, 1.0), (8, 0.5), (30, 0.25)];

/// Speeds of the study, and those at which an order meets a natural frequency: between steps a resonance would come and go with the last digit of the crank.
fn speeds(study: &SizingStudy, system: &System, design: &DesignResult) -> Vec<f64> {
    let (low, high) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let orders = || system.excitation.orders.iter();
    let critical = design.frequencies_hz.iter().flat_map(|f| orders().map(move |o| f / (HZ_PER_RPM * o.value())));
    let peaks = [design.torque, design.twist].into_iter().flatten().map(|p| p.speed_rpm);
    let mut all: Vec<f64> = study.speeds_rpm.iter().copied().chain(critical).chain(peaks).filter(|s| (low..=high).contains(s)).collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

/// Vibratory torque before, between and after the throws over the cycle, at each of these speeds.
fn torque_cases(study: &SizingStudy, system: &System, speeds: &[f64], design: &[Mounted]) -> Result<Vec<TorqueCase>, RunError> {
    let throws = study.specification.firing_deg.len();
    let shafts: Vec<Quantity> = (0..=throws).map(Quantity::ShaftTorque).collect();
    let grid = Grid::new(&study.speeds_rpm, &[]);
    let found = Direct::new(system, &grid).at_each(design, &shafts, speeds, &mut Work::default());
    let phasors = found.map_err(|error| RunError { what: "the chain of the sized crank".into(), error })?;
    let orders: Vec<f64> = system.excitation.orders.iter().map(|o| o.value()).collect();
    let (n, cycle) = (samples_of_cycle(study.specification.strokes), PI * f64::from(study.specification.strokes));
    // e^{i n theta} of each order at each sample
    let turns: Vec<Vec<C64>> = orders.iter().map(|o| (0..n).map(|j| turn(o * cycle * j as f64 / n as f64)).collect()).collect();
    let history = |phasors: &[C64]| -> Vec<f64> {
        let mut sum = vec![0.0; n];
        for (y, turns) in phasors.iter().zip(&turns) {
            sum.iter_mut().zip(turns).for_each(|(s, t)| *s += (y * t).re);
        }
        sum
    };
    let case = |(i, speed): (usize, &f64)| TorqueCase {
        speed_rpm: *speed,
        share: 1.0,
        harmonics: system.excitation.harmonics.clone(),
        vibratory: phasors.iter().map(|p| history(&p[i * orders.len()..(i + 1) * orders.len()])).collect(),
    };
    Ok(speeds.iter().enumerate().map(case).collect())
}

/// The engine with its best absorber of a type and ring, or without one.
fn best(study: &SizingStudy, crank: &Round, absorber: Option<SizedAbsorber>) -> Result<(DesignResult, System), SizeError> {
    let mut of_chain = files::study_of(study, crank, absorber)?;
    if absorber.is_some() {
        of_chain.designs.clear();
    }
    let results = run(&of_chain, &Silent)?;
    let optimum = results.optima.iter().find(|o| o.main).map(|o| o.design.clone());
    Ok((optimum.unwrap_or_else(|| results.designs[0].clone()), results.system))
}

/// The least share of the vibratory torque that is tried where a crank cannot bear all of it.
const LEAST_SHARE: f64 = 1.0 / 64.0;

/// A round under as much of the torque as a crank can bear: the response of a first crank may be a resonance that the last one does not have.
fn next(study: &SizingStudy, sized: &mut Sized, mut cases: Vec<TorqueCase>, part: &mut f64) -> Result<f64, SizingError> {
    loop {
        cases.iter_mut().for_each(|c| c.share = *part);
        match sized.next(&study.specification, Some(&cases)) {
            Err(_) if *part > LEAST_SHARE => *part *= 0.5,
            other => return other,
        }
    }
}

/// Sizes, chain, absorber and torque in turns from a first crank.
///
/// # Errors
/// [`SizeError`] where they do not settle.
pub(super) fn agree(
    study: &SizingStudy,
    first: Sized,
    absorber: Option<SizedAbsorber>,
    progress: &dyn Progress,
) -> Result<(Sized, ByResponse), SizeError> {
    progress.stage("crank and its response", MOST_ROUNDS);
    let (mut sized, mut part, mut last) = (first, 1.0f64, (f64::INFINITY, 0.0));
    let mut of_chain = sized.last().clone();
    for rounds in 1..=MOST_ROUNDS {
        let (design, system) = best(study, &of_chain, absorber)?;
        let cases = torque_cases(study, &system, &speeds(study, &system, &design), &design.absorbers)?;
        let change = next(study, &mut sized, cases, &mut part)?.max(of_chain.change_to(sized.last()));
        progress.step();
        if change < TOLERANCE && part >= 1.0 {
            fit::check(&study.specification, &sized.last().sizes)?;
            let by_response = ByResponse {
                rounds,
                twist: design.twist.map_or(0.0, |p| p.value),
                torque: design.torque.map_or(0.0, |p| p.value),
                frequency_hz: design.frequencies_hz.first().copied().unwrap_or(0.0),
                absorbers: design.absorbers,
            };
            return Ok((sized, by_response));
        }
        last = (change, design.torque.map_or(0.0, |p| p.speed_rpm));
        part = (2.0 * part).min(1.0);
        let share = SHARES.iter().rev().find(|s| rounds >= s.0).map_or(1.0, |s| s.1);
        of_chain = of_chain.towards(sized.last(), share, &study.specification);
    }
    Err(SizeError::NotConverged { change: last.0, rounds: MOST_ROUNDS, speed_rpm: last.1 })
}
