//! Motion of the unknowns of a crank by matrices over the cycle: what stresses are recovered from.

use crate::absorber::Mounted;
use crate::crankshaft::flexible::WebLoads;
use crate::drivetrain::System;
use crate::input::Study;
use crate::numerics::C64;
use crate::response::{Direct, Grid, ResponseError, Work};
use crate::units::DEG_PER_RAD;

/// Histories of all unknowns, as the files of the matrices have them: in their units and axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Histories {
    /// Of a file.
    pub name: String,
    /// `node.component` of each.
    pub unknowns: Vec<String>,
    /// Crank angle, degrees, then a value of each.
    pub rows: Vec<(f64, Vec<f64>)>,
}

/// Without absorber and with those of each design, at a speed: the mean over the cycle and the orders of the study with vibration, what lies above them quasi-static. Nothing of a crank that is not by matrices.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance met exactly.
pub(super) fn histories(study: &Study, system: &System, speed_rpm: f64) -> Result<Vec<Histories>, ResponseError> {
    let Some((flexible, crank)) = study.on_flexible().zip(system.flexible.as_ref()) else { return Ok(Vec::new()) };
    let (written, excitation) = (&flexible.assembled.written, &system.excitation);
    let Some(motions) = WebLoads::of_unknowns(&flexible.assembled, study.engine_of_crank(), (crank, excitation)) else {
        return Ok(Vec::new());
    };
    let unbounded = |_| ResponseError::unbounded(excitation.orders[0], speed_rpm);
    let quasi = motions.quasi_static(speed_rpm).map_err(unbounded)?;
    let still = motions.still(&quasi);
    let grid = Grid::new(&[speed_rpm], &[]);
    let direct = Direct::new(system, &grid);
    let histories_of = |name: String, design: &[Mounted]| -> Result<Histories, ResponseError> {
        let torques = |n: usize| direct.absorber_torques(design, (n, speed_rpm), &mut Work::default());
        let torques: Vec<Vec<(usize, C64)>> = (0..system.orders()).map(torques).collect::<Result<_, _>>()?;
        let orders = motions.orders(speed_rpm, &torques).map_err(unbounded)?;
        let all = motions.vibrating(&quasi, &still, &orders);
        let row = |(i, theta): (usize, &f64)| (theta * DEG_PER_RAD, all.row(i).iter().copied().collect());
        Ok(Histories {
            name,
            unknowns: written.iter().map(|(u, _)| format!("{}.{}", u.node, u.component)).collect(),
            rows: motions.theta().iter().enumerate().map(row).collect(),
        })
    };
    let given = study.designs.iter().filter(|d| !d.absorbers.is_empty());
    let named = given.map(|d| histories_of(format!("unknowns_{}_{speed_rpm}", d.name), &d.absorbers));
    std::iter::once(histories_of(format!("unknowns_{speed_rpm}"), &[])).chain(named).collect()
}
