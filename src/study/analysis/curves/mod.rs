//! What `hartog curves` shows: everything about engine, chain and crank that lies behind a design, each as a table and a plot.

mod absorber_chart;
mod balance;
mod crank_loads;
mod crank_modes;
mod cylinder;
mod figure;
mod journals;
mod mechanism;
mod modes;
mod responses;
mod shown;
mod stress_loads;
mod torsion;
mod webs;

pub use figure::curve;
pub(crate) use figure::{ACCELERATION, CRANK_DEG, FORCE, MOMENT, TORQUE, TRAVEL, VELOCITY};
pub use figure::{Axis, Curve, Figure, Look, Panel, Scale};
pub use modes::HolzerRow;
pub use modes::holzer;
pub use shown::Shown;
pub use stress_loads::Histories;

use super::calibrate::calibrate;
use super::progress::{Progress, RunError};
use crate::drivetrain::System;
use crate::input::Study;

/// Everything of a study, its inputs calibrated where it asks for that.
#[derive(Debug, Clone, PartialEq)]
pub struct Curves {
    /// Each a table and a plot.
    pub figures: Vec<Figure>,
    /// Holzer's table of the first modes.
    pub holzer: Vec<HolzerRow>,
    /// Motions of a crank by matrices; loads of the throws that are asked for.
    pub histories: Vec<Histories>,
}

/// Speeds at which forces are shown where none is asked for: that of the largest mean torque and the highest.
fn load_cases(study: &Study, system: &System) -> Vec<f64> {
    let (low, high) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let audit = system.excitation.audit.iter().filter(|a| (low..=high).contains(&a.speed_rpm));
    let most = audit.max_by(|a, b| a.mean_torque.total_cmp(&b.mean_torque)).map(|a| a.speed_rpm);
    let mut speeds: Vec<f64> = most.into_iter().chain([high]).collect();
    speeds.dedup();
    speeds
}

/// Gives all panels of some figures the same axis upwards.
fn share_scale(figures: &mut [Figure]) {
    let points = figures.iter().flat_map(|f| &f.panels).flat_map(|p| &p.curves).flat_map(|c| &c.points);
    let top = points.map(|p| p.1).fold(0.0, f64::max);
    figures.iter_mut().flat_map(|f| &mut f.panels).for_each(|p| p.scale = Scale::AtLeast(top));
}

/// All curves; forces at the given speeds, rpm, or else at that of the largest mean torque and at the highest.
///
/// # Errors
/// [`RunError`] where a design has no finite response.
pub fn curves(study: &Study, speeds_rpm: &[f64], progress: &dyn Progress) -> Result<Curves, RunError> {
    curves_of(study, &Shown { speeds_rpm: speeds_rpm.to_vec(), ..Shown::default() }, progress)
}

/// The same, of what is asked for.
///
/// # Errors
/// As [`curves`].
#[doc(hidden)]
pub fn curves_of(study: &Study, shown: &Shown, progress: &dyn Progress) -> Result<Curves, RunError> {
    let speeds_rpm = &shown.speeds_rpm;
    let (mut study, _) = calibrate(study, progress)?;
    study.designs.retain(|d| shown.designs.is_empty() || shown.designs.contains(&d.name));
    let system = study.system(study.excitation());
    let speeds = if speeds_rpm.is_empty() { load_cases(&study, &system) } else { speeds_rpm.clone() };
    progress.stage("curves", speeds.len() + study.designs.len());
    let mut figures: Vec<Figure> = cylinder::pressure(&study, speeds_rpm).into_iter().collect();
    let mut histories = Vec::new();
    for speed in &speeds {
        figures.extend(cylinder::forces(&study, *speed));
        figures.extend(cylinder::torque(&study, shown, *speed));
        figures.extend(mechanism::kinematics(&study, *speed));
        figures.extend(mechanism::pin_forces(&study, shown, *speed));
        figures.extend(mechanism::methods(&study, *speed));
        figures.extend(crank_loads::bearings(&study, *speed));
        figures.extend(crank_loads::crank_loads(&study, shown, *speed));
        let of_crank = |error| RunError { what: "the flexible crank".into(), error };
        let of_shafts = |error| RunError { what: format!("shafts at {speed} rpm"), error };
        figures.extend(torsion::shafts(&study, &system, *speed).map_err(of_shafts)?);
        figures.extend(torsion::cases(&study, &system, *speed).map_err(of_shafts)?);
        figures.extend(journals::journals(&study, &system, *speed).map_err(of_crank)?);
        figures.extend(webs::moments(&study, &system, (shown, *speed)).map_err(of_crank)?);
        histories.extend(stress_loads::unknowns(&study, &system, *speed).map_err(of_crank)?);
        histories.extend(stress_loads::throws(&study, &system, shown, *speed).map_err(of_crank)?);
        progress.step();
    }
    figures.extend(mechanism::over_speed(&study));
    figures.extend(balance::balance(&study, speeds[speeds.len() - 1]));
    if study.modes.elastic().next().is_some() {
        figures.push(modes::campbell(&study, &system));
    }
    figures.extend(crank_modes::crank_modes(&study));
    figures.extend([modes::modes(&study), modes::phase_vectors(&study, &system), responses::spectrum(&study, &system)]);
    let of_study = |error| RunError { what: "a design".into(), error };
    let mut shafts = Vec::new();
    for design in &study.designs {
        let of_design = |error| RunError { what: format!("design `{}`", design.name), error };
        shafts.extend(responses::shaft_torque(&study, &system, (design, shown)).map_err(of_design)?);
        progress.step();
    }
    share_scale(&mut shafts);
    figures.append(&mut shafts);
    if !study.designs.is_empty() {
        figures.push(responses::histories(&study, &system).map_err(of_study)?);
    }
    figures.push(absorber_chart::absorber_chart());
    figures.retain(|f| !f.panels.is_empty());
    Ok(Curves { figures, holzer: modes::holzer(&study), histories })
}
