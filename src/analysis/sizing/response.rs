//! A crank sized by the torque of its own chain: crank, chain and absorber in turns until they agree.

use super::files;
use super::results::{ByResponse, SizeError, TOLERANCE};
use crate::absorber::Mounted;
use crate::analysis::run::run;
use crate::analysis::{DesignResult, Progress, RunError, Silent};
use crate::drivetrain::System;
use crate::input::{SizedAbsorber, SizingStudy, from_texts};
use crate::numerics::C64;
use crate::response::{Direct, Grid, Quantity, Work};
use crate::sizing::cycle::samples_of_cycle;
use crate::sizing::{Round, Sized, TorqueCase};
use crate::units::HZ_PER_RPM;
use std::f64::consts::PI;
use std::path::Path;

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
    let turns: Vec<Vec<C64>> = orders.iter().map(|o| (0..n).map(|j| C64::cis(o * cycle * j as f64 / n as f64)).collect()).collect();
    let history = |phasors: &[C64]| -> Vec<f64> {
        let mut sum = vec![0.0; n];
        for (y, turns) in phasors.iter().zip(&turns) {
            sum.iter_mut().zip(turns).for_each(|(s, t)| *s += (y * t).re);
        }
        sum
    };
    let case = |(i, speed): (usize, &f64)| TorqueCase {
        speed_rpm: *speed,
        vibratory: phasors.iter().map(|p| history(&p[i * orders.len()..(i + 1) * orders.len()])).collect(),
    };
    Ok(speeds.iter().enumerate().map(case).collect())
}

/// The engine with its best absorber of a type and ring, or without one.
fn best(study: &SizingStudy, crank: &Round, absorber: Option<SizedAbsorber>) -> Result<(DesignResult, System), SizeError> {
    // tables that the file names are looked for beside it
    let path = study.pressure_file.as_deref().unwrap_or(Path::new(&study.name));
    let table = path.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
    let mut of_chain = from_texts(path, &files::study(study, absorber), &files::engine(study, crank, &table))?;
    if absorber.is_some() {
        of_chain.designs.clear();
    }
    let results = run(&of_chain, &Silent)?;
    let optimum = results.optima.iter().find(|o| o.main).map(|o| o.design.clone());
    Ok((optimum.unwrap_or_else(|| results.designs[0].clone()), results.system))
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
    let (mut sized, mut change) = (first, f64::INFINITY);
    let mut of_chain = sized.last().clone();
    for rounds in 1..=MOST_ROUNDS {
        let (design, system) = best(study, &of_chain, absorber)?;
        let cases = torque_cases(study, &system, &speeds(study, &system, &design), &design.absorbers)?;
        change = sized.next(&study.specification, Some(&cases))?.max(of_chain.change_to(sized.last()));
        progress.step();
        if change < TOLERANCE {
            let by_response = ByResponse {
                rounds,
                twist: design.twist.map_or(0.0, |p| p.value),
                torque: design.torque.map_or(0.0, |p| p.value),
                frequency_hz: design.frequencies_hz.first().copied().unwrap_or(0.0),
                absorbers: design.absorbers,
            };
            return Ok((sized, by_response));
        }
        let share = SHARES.iter().rev().find(|s| rounds >= s.0).map_or(1.0, |s| s.1);
        of_chain = of_chain.towards(sized.last(), share, &study.specification);
    }
    Err(SizeError::NotConverged { change, rounds: MOST_ROUNDS })
}
