//! Moments of webs, pins and journals over the cycle, where the crank is flexible.

use super::figure::{Axis, CRANK_DEG, Figure, MOMENT, Panel, Scale, TORQUE, curve};
use super::shown::Shown;
use crate::crankshaft::flexible::{Cut, SectionLoad, WebLoad, WebLoads};
use crate::drivetrain::System;
use crate::input::Study;
use crate::response::ResponseError;
use crate::units::DEG_PER_RAD;
use nalgebra::DMatrix;

/// Every so many samples of the cycle, 0.5° apart, are drawn.
const APART: usize = 2;

/// Of the engine without absorber: moments of webs in the plane of the throw, about the web, and edgewise; moments of pins and journals at the faces of their webs. Nothing on a torsional chain.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance met exactly.
pub(super) fn moments(study: &Study, system: &System, (shown, speed_rpm): (&Shown, f64)) -> Result<Vec<Figure>, ResponseError> {
    let (Some(flexible), Some(crank)) = (study.on_flexible(), system.flexible.as_ref()) else { return Ok(Vec::new()) };
    let excitation = &system.excitation;
    let (engine, parts) = (study.engine_of_crank(), (crank.as_ref(), excitation));
    let (webs, rounds) = (WebLoads::new(&flexible.assembled, engine, parts), WebLoads::of_rounds(&flexible.assembled, engine, parts));
    let (Some(of_webs), Some(of_rounds)) = (webs, rounds) else { return Ok(Vec::new()) };
    let unbounded = |n: usize| ResponseError::unbounded(excitation.orders[n], speed_rpm);
    let motion = |n: usize| crank.motion(excitation, (n, speed_rpm), &[]).map_err(|_| unbounded(n));
    let motions = (0..system.orders()).map(motion).collect::<Result<Vec<_>, _>>()?;
    let over_cycle = |loads: &WebLoads| {
        let quasi = loads.quasi_static(speed_rpm).map_err(|_| unbounded(0))?;
        Ok(loads.vibrating(&quasi, &loads.still(&quasi), &loads.of_motions(speed_rpm, &motions)))
    };
    let angles: Vec<f64> = of_webs.theta().iter().map(|theta| theta * DEG_PER_RAD).collect();
    let panel = |title: String, y: Axis, all: &DMatrix<f64>, column: &dyn Fn(usize) -> usize| {
        let line = |throw: usize| {
            let own: Vec<f64> = all.column(column(throw)).iter().step_by(APART).copied().collect();
            curve(format!("throw {}", throw + 1), angles.iter().step_by(APART).copied(), own)
        };
        let curves = shown.throws(flexible.assembled.webs.len()).map(line).collect();
        Panel { title, x: CRANK_DEG, y, curves, scale: Scale::Own }
    };
    let all = over_cycle(&of_webs)?;
    let in_webs = [
        (WebLoad::Moment, "in the plane of the throw"),
        (WebLoad::Across, "about the direction of the web"),
        (WebLoad::Edgewise, "edgewise, about the direction of the axis"),
    ];
    let web = |(load, title): (WebLoad, &str)| {
        [(0, "front"), (1, "rear")].map(|(rear, side)| {
            panel(format!("{title}, {side} webs"), MOMENT, &all, &|throw| WebLoad::ALL.len() * (2 * throw + rear) + load as usize)
        })
    };
    let webs = Figure {
        name: format!("web_moments_{speed_rpm}"),
        title: format!("{}: moments in the middle of the webs at {speed_rpm} rpm, without absorber", study.engine.name),
        panels: in_webs.into_iter().flat_map(web).collect(),
    };
    let all = over_cycle(&of_rounds)?;
    let at_faces = [
        (Cut::PinFront, "pins, front"),
        (Cut::PinRear, "pins, rear"),
        (Cut::JournalFront, "journals before the throw"),
        (Cut::JournalRear, "journals behind the throw"),
    ];
    let loads = [
        (SectionLoad::AboutTangential, "bending in the plane of the throw", MOMENT),
        (SectionLoad::AboutOutwards, "bending across it", MOMENT),
        (SectionLoad::Torque, "torque", TORQUE),
    ];
    let round = |(load, title, axis): (SectionLoad, &str, Axis)| {
        at_faces.map(|(cut, place)| panel(format!("{title}, {place}"), axis, &all, &|throw| load.column(throw, cut)))
    };
    let rounds = Figure {
        name: format!("journal_moments_{speed_rpm}"),
        title: format!(
            "{}: moments of pins and journals at the faces of their webs at {speed_rpm} rpm, without absorber",
            study.engine.name
        ),
        panels: loads.into_iter().flat_map(round).collect(),
    };
    Ok(vec![webs, rounds])
}
