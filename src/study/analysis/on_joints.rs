//! Designs on bearings that are not linear: what the search found on linear ones near to them, computed on the law itself.

use super::timing::Clock;
use super::{DesignResult, Progress};
use crate::crankshaft::flexible::on_joints::{NoMotion, OnBoth};
use crate::input::{FlexibleModel, Study};
use crate::numerics::C64;
use crate::numerics::synthesis::Synthesiser;
use crate::response::{Quantity, Work};
use rayon::prelude::*;

/// A design on its joints and on linear bearings at a speed.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct AtSpeedOnJoints {
    /// rpm.
    pub speed_rpm: f64,
    /// Half peak-to-peak twist that the study reports, rad, on linear bearings with the same orders.
    pub linear: f64,
    /// The same on the joints, with what was found on the way.
    pub joints: Result<FoundOnJoints, String>,
}

/// A motion on joints.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct FoundOnJoints {
    /// rad.
    pub twist: f64,
    /// Largest displacement in a bearing over the reach of its law.
    pub displacement: f64,
    /// Largest displacement of the upper sixth of the harmonics over the reach: what is left out is several times as large.
    pub last: f64,
    /// Steps of Newton's method.
    pub steps: usize,
    /// Stages from linear bearings to the joints.
    pub stages: usize,
}

/// A design on its joints.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct OnJointsOfDesign {
    /// Its name.
    pub design: String,
    /// At the speed of its largest twist on linear bearings, and beside it.
    pub speeds: Vec<AtSpeedOnJoints>,
}

impl OnJointsOfDesign {
    /// The largest twist on linear bearings and on joints at its speeds, rad; `None` where one was not found.
    #[doc(hidden)]
    pub fn largest(&self) -> Option<(f64, f64)> {
        let linear = self.speeds.iter().map(|s| s.linear).fold(0.0, f64::max);
        let joints = self.speeds.iter().map(|s| s.joints.as_ref().ok().map(|f| f.twist)).collect::<Option<Vec<f64>>>()?;
        Some((linear, joints.into_iter().fold(0.0, f64::max)))
    }
}

/// Speeds beside that of the largest twist, in units of it.
const BESIDE: [f64; 3] = [1.0, 0.97, 1.03];

/// Half peak-to-peak of the twist of a study, from answers by harmonic.
fn twist(study: &Study, answers: &[nalgebra::DVector<C64>], stations: usize) -> f64 {
    let Quantity::Twist { from, to } = study.twist else { return 0.0 };
    let between = |y: &nalgebra::DVector<C64>| y[stations + from] - to.map_or_else(C64::default, |to| y[stations + to]);
    let harmonics: Vec<u32> = (1..answers.len() as u32).collect();
    let phasors: Vec<C64> = answers[1..].iter().map(between).collect();
    Synthesiser::new(&harmonics).extremes(&phasors).half_peak_to_peak
}

/// Designs on their joints; nothing where the bearings of the study are linear.
pub(crate) fn on_joints(study: &Study, shown: &[&DesignResult], (progress, clock): (&dyn Progress, &mut Clock)) -> Vec<OnJointsOfDesign> {
    let Some((flexible, crank)) = study.on_flexible().zip(study.crank.as_ref()) else { return Vec::new() };
    let excitation = FlexibleModel::excitation_on_joints(&study.engine);
    let Some(joints) = flexible.on_joints((crank, &study.engine), &excitation, (1.0, 1.0)) else { return Vec::new() };
    progress.stage("bearings that are not linear", shown.len());
    let (low, high) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let solve_at = |d: &DesignResult, speed_rpm: f64, nearby: &mut Option<OnBoth>| {
        let words = |why: NoMotion| why.to_string();
        let (linear, own) = match joints.at(speed_rpm, &d.absorbers, nearby.as_ref()) {
            Ok(found) => {
                let b = &found.joints;
                let own = FoundOnJoints {
                    twist: twist(study, &b.answers, joints.stations()),
                    displacement: b.largest,
                    last: b.last,
                    steps: b.steps,
                    stages: b.stages,
                };
                let linear = twist(study, &found.linear, joints.stations());
                *nearby = Some(found);
                (linear, Ok(own))
            }
            Err(why) => (f64::NAN, Err(words(why))),
        };
        AtSpeedOnJoints { speed_rpm, linear, joints: own }
    };
    let solve_design = |d: &&DesignResult| {
        let peak = d.twist.map_or(high, |p| p.speed_rpm);
        let mut speeds: Vec<f64> = Vec::new();
        for speed in BESIDE.map(|share| (share * peak).clamp(low, high)) {
            if !speeds.contains(&speed) {
                speeds.push(speed);
            }
        }
        // from the largest twist to what is beside it
        let mut nearby = None;
        let mut found: Vec<AtSpeedOnJoints> = speeds.into_iter().map(|s| solve_at(d, s, &mut nearby)).collect();
        found.sort_by(|a, b| a.speed_rpm.total_cmp(&b.speed_rpm));
        let found = OnJointsOfDesign { design: d.name.clone(), speeds: found };
        progress.step();
        found
    };
    let all = shown.par_iter().map(solve_design).collect();
    clock.lap("bearings that are not linear", Work::default());
    all
}

/// The design without absorber, the given one with the smallest objective and the best optimum.
pub(super) fn of_note<'r>(designs: &'r [DesignResult], optima: impl Iterator<Item = &'r DesignResult>) -> Vec<&'r DesignResult> {
    fn lowest<'r>(all: impl Iterator<Item = &'r DesignResult>) -> Option<&'r DesignResult> {
        let objective_of = |d: &DesignResult| d.objective.unwrap_or(f64::INFINITY);
        all.reduce(|a, b| if objective_of(b) < objective_of(a) { b } else { a })
    }
    let none = designs.iter().find(|d| d.absorbers.is_empty());
    none.into_iter().chain(lowest(designs.iter().filter(|d| !d.absorbers.is_empty()))).chain(lowest(optima)).collect()
}
