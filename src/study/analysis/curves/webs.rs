//! Moments in the middle of the webs over the cycle, where the crank is flexible.

use super::figure::{CRANK_DEG, Figure, MOMENT, Panel, Scale, curve};
use crate::crankshaft::flexible::{WebLoad, WebLoads};
use crate::drivetrain::System;
use crate::input::Study;
use crate::response::ResponseError;
use crate::units::DEG_PER_RAD;

/// Every so many samples of the cycle, 0.5° apart, are drawn.
const APART: usize = 2;

/// Moments in the plane of the throw, about the web, and edgewise, of the engine without absorber; nothing on a torsional chain.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance met exactly.
pub(super) fn webs(study: &Study, system: &System, speed_rpm: f64) -> Result<Option<Figure>, ResponseError> {
    let (Some(flexible), Some(crank)) = (study.on_flexible(), system.flexible.as_ref()) else { return Ok(None) };
    let excitation = &system.excitation;
    let Some(loads) = WebLoads::new(&flexible.assembled, study.engine_of_crank(), (crank, excitation)) else { return Ok(None) };
    let unbounded = |n: usize| ResponseError::unbounded(excitation.orders[n], speed_rpm);
    let motion = |n: usize| crank.motion(excitation, (n, speed_rpm), &[]).map_err(|_| unbounded(n));
    let motions = (0..system.orders()).map(motion).collect::<Result<Vec<_>, _>>()?;
    let quasi = loads.quasi_static(speed_rpm).map_err(|_| unbounded(0))?;
    let all = loads.vibrating(&quasi, &loads.still(&quasi), &loads.of_motions(speed_rpm, &motions));
    let angles: Vec<f64> = loads.theta().iter().map(|theta| theta * DEG_PER_RAD).collect();
    let panel = |(rear, load, title): (usize, WebLoad, &str)| {
        let line = |throw: usize| {
            let own = all.column(4 * (2 * throw + rear) + load as usize);
            let own: Vec<f64> = own.iter().step_by(APART).copied().collect();
            curve(format!("throw {}", throw + 1), angles.iter().step_by(APART).copied(), own)
        };
        Panel {
            title: format!("{title}, {} webs", ["front", "rear"][rear]),
            x: CRANK_DEG,
            y: MOMENT,
            curves: (0..all.ncols() / 8).map(line).collect(),
            scale: Scale::Own,
        }
    };
    let moments = [
        (WebLoad::Moment, "in the plane of the throw"),
        (WebLoad::Across, "about the direction of the web"),
        (WebLoad::Edgewise, "edgewise, about the direction of the axis"),
    ];
    Ok(Some(Figure {
        name: format!("web_moments_{speed_rpm}"),
        title: format!("{}: moments in the middle of the webs at {speed_rpm} rpm, without absorber", study.engine.name),
        panels: moments.into_iter().flat_map(|(load, title)| [(0, load, title), (1, load, title)]).map(panel).collect(),
    }))
}
