//! Histories over the cycle that stresses are recovered from: motion of the unknowns of a crank by matrices, loads of the throws of a crank of beams.

use super::shown::Shown;
use crate::absorber::Mounted;
use crate::crankshaft::flexible::{Cut, SectionLoad, WebLoads};
use crate::drivetrain::System;
use crate::input::Study;
use crate::numerics::C64;
use crate::response::{Direct, Grid, ResponseError, Work};
use crate::units::DEG_PER_RAD;
use nalgebra::DMatrix;

/// Histories of loads or unknowns, a column each.
#[derive(Debug, Clone, PartialEq)]
pub struct Histories {
    /// Of a file.
    pub name: String,
    /// Of each column: `node.component` of an unknown, or the name of a load.
    pub columns: Vec<String>,
    /// Crank angle, degrees, then a value of each.
    pub rows: Vec<(f64, Vec<f64>)>,
}

/// What is asked of a crank over the cycle, a column each, and the design that it is with; no name without absorber.
type OfDesign<'s> = (Option<&'s str>, DMatrix<f64>);

/// What is asked of a crank over the cycle, without absorber (no name) and with those of each given design: the mean and the orders of the study with vibration, what lies above them quasi-static.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance met exactly.
fn of_designs<'s>(study: &'s Study, system: &System, loads: &WebLoads, speed_rpm: f64) -> Result<Vec<OfDesign<'s>>, ResponseError> {
    let unbounded = |_| ResponseError::unbounded(system.excitation.orders[0], speed_rpm);
    let quasi = loads.quasi_static(speed_rpm).map_err(unbounded)?;
    let still = loads.still(&quasi);
    let grid = Grid::new(&[speed_rpm], &[]);
    let direct = Direct::new(system, &grid);
    let of = |name: Option<&'s str>, design: &[Mounted]| {
        let torques = |n: usize| direct.absorber_torques(design, (n, speed_rpm), &mut Work::default());
        let torques: Vec<Vec<(usize, C64)>> = (0..system.orders()).map(torques).collect::<Result<_, _>>()?;
        let orders = loads.orders(speed_rpm, &torques).map_err(unbounded)?;
        Ok((name, loads.vibrating(&quasi, &still, &orders)))
    };
    let given = study.designs.iter().filter(|d| !d.absorbers.is_empty());
    std::iter::once(of(None, &[])).chain(given.map(|d| of(Some(&d.name), &d.absorbers))).collect()
}

/// `what_RPM`, with the name of a design before the speed.
fn name(what: &str, design: Option<&str>, speed_rpm: f64) -> String {
    design.map_or_else(|| format!("{what}_{speed_rpm}"), |design| format!("{what}_{design}_{speed_rpm}"))
}

/// Motion of all unknowns at a speed, as the files of the matrices have them: in their units and axes. Nothing of a crank that is not by matrices.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance met exactly.
pub(super) fn unknowns(study: &Study, system: &System, speed_rpm: f64) -> Result<Vec<Histories>, ResponseError> {
    let Some((flexible, crank)) = study.on_flexible().zip(system.flexible.as_ref()) else { return Ok(Vec::new()) };
    let parts = (crank.as_ref(), &system.excitation);
    let Some(motions) = WebLoads::of_unknowns(&flexible.assembled, study.engine_of_crank(), parts) else { return Ok(Vec::new()) };
    let of_design = |(design, all): OfDesign| {
        let row = |(i, theta): (usize, &f64)| (theta * DEG_PER_RAD, all.row(i).iter().copied().collect());
        Histories {
            name: name("unknowns", design, speed_rpm),
            columns: flexible.assembled.written.iter().map(|(u, _)| format!("{}.{}", u.node, u.component)).collect(),
            rows: motions.theta().iter().enumerate().map(row).collect(),
        }
    };
    Ok(of_designs(study, system, &motions, speed_rpm)?.into_iter().map(of_design).collect())
}

/// The loads that a throw is cut free with, by their names.
const OF_THROW: [&str; 8] = ["rear_fx", "rear_fy", "rear_fz", "rear_mx", "rear_my", "rear_mz", "pin_x", "pin_y"];

/// Loads of the throws that are asked for by their numbers, in axes of each (x outwards, y in the direction of rotation, z along the crank to the rear), N and N m: force and moment of what lies behind it, in the middle of its rear
/// bearing, and what of rods and inertia acts between its journals, as a force in the middle of the pin. A throw held at its front is loaded so but for its own inertia along the axis, and for the moments of all of it about the middle of the pin. Nothing of a crank
/// that is not of beams.
///
/// # Errors
/// As [`unknowns`].
pub(super) fn throws(study: &Study, system: &System, shown: &Shown, speed_rpm: f64) -> Result<Vec<Histories>, ResponseError> {
    let (Some(flexible), Some(flexible_crank), Some(crank)) = (study.on_flexible(), system.flexible.as_ref(), study.crank.as_ref()) else {
        return Ok(Vec::new());
    };
    let parts = (flexible_crank.as_ref(), &system.excitation);
    let loads = WebLoads::of_rounds(&flexible.assembled, study.engine_of_crank(), parts).filter(|_| !shown.throws.is_empty());
    let Some(loads) = loads else { return Ok(Vec::new()) };
    let all = of_designs(study, system, &loads, speed_rpm)?;
    let of_throw = |(throw, design, all): (usize, Option<&str>, &DMatrix<f64>)| {
        let to_bearing = 0.5 * crank.journal_lengths[throw + 1];
        let row = |(i, theta): (usize, &f64)| {
            let at = |cut: Cut| -> [f64; 6] { std::array::from_fn(|k| all[(i, SectionLoad::ALL[k].column(throw, cut))]) };
            let ([x, y, z, mx, my, mz], front) = (at(Cut::JournalRear), at(Cut::JournalFront));
            (theta * DEG_PER_RAD, vec![x, y, z, mx + to_bearing * y, my - to_bearing * x, mz, front[0] - x, front[1] - y])
        };
        Histories {
            name: name(&format!("throw_{}_loads", throw + 1), design, speed_rpm),
            columns: OF_THROW.map(str::to_owned).to_vec(),
            rows: loads.theta().iter().enumerate().map(row).collect(),
        }
    };
    let each = shown.throws(crank.throws()).flat_map(|t| all.iter().map(move |(design, all)| (t, *design, all)));
    Ok(each.map(of_throw).collect())
}
