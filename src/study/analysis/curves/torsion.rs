//! Torque of the crank at one speed: of every shaft over the cycle, and along the crank at two instants by the torsion cases.

use super::crank_loads::PLACE;
use super::figure::{ANGLE, CRANK_DEG, Curve, FORCE, Figure, Look, MOMENT, Panel, Scale, TORQUE};
use super::responses::over_cycle;
use crate::analysis::torsion_case::{at_bearings, in_the_middle, torques};
use crate::crankshaft::Crank;
use crate::crankshaft::TorsionCase;
use crate::crankshaft::critical_locations::shafts_at_bearings;
use crate::crankshaft::loads::{CrankLoads, CrankModel};
use crate::crankshaft::torsion_cases::Instants;
use crate::drivetrain::System;
use crate::input::Study;
use crate::response::{Direct, Grid, Quantity, ResponseError, Work};
use crate::units::{DEG_PER_RAD, M_PER_MM};

/// Vibratory torque and twist of every shaft over the cycle at a speed, a panel each a design.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance met exactly.
pub(super) fn shafts(study: &Study, system: &System, speed_rpm: f64) -> Result<Option<Figure>, ResponseError> {
    let grid = Grid::new(&[speed_rpm], &[]);
    let direct = Direct::new(system, &grid);
    let count = study.chain.len() - 1;
    let of = |quantity: fn(usize) -> Quantity| (0..count).map(quantity).collect::<Vec<Quantity>>();
    let twist = |s: usize| Quantity::Twist { from: s, to: Some(s + 1) };
    let (mut torque, mut twists) = (Vec::new(), Vec::new());
    for design in &study.designs {
        let words = design.name.replace('_', " ");
        for (quantities, y, scale, panels) in
            [(of(Quantity::ShaftTorque), TORQUE, 1.0, &mut torque), (of(twist), ANGLE, DEG_PER_RAD, &mut twists)]
        {
            let found = direct.at_each(&design.absorbers, &quantities, &[speed_rpm], &mut Work::default())?;
            let line = |(s, phasors): (usize, &Vec<_>)| Curve {
                label: study.chain.shaft_name(s).replace('_', " "),
                look: Look::Line,
                points: over_cycle(system, phasors, scale),
            };
            let what = if scale == 1.0 { "vibratory torque" } else { "twist" };
            let curves = found.iter().enumerate().map(line).collect();
            panels.push(Panel { title: format!("{what}, {words}"), x: CRANK_DEG, y, curves, scale: Scale::Own });
        }
    }
    torque.append(&mut twists);
    Ok((count > 0 && !torque.is_empty()).then(|| Figure {
        name: format!("shafts_{speed_rpm}"),
        title: format!("{}: shafts over the cycle at {speed_rpm} rpm", study.engine.name),
        panels: torque,
    }))
}

/// Corners of the torque along the crank: in the front half of every throw from the bearing before it to its pin, in the rear half from there on.
fn steps(crank: &Crank, halves: &[[f64; 2]]) -> Vec<(f64, f64)> {
    let bearings = crank.bearings();
    let corner = |x: f64, y: f64| (x / M_PER_MM, y);
    let of_throw = |(t, [front, rear]): (usize, &[f64; 2])| {
        let pin = crank.places(t)[1];
        [corner(bearings[t], *front), corner(pin, *front), corner(pin, *rear), corner(bearings[t + 1], *rear)]
    };
    halves.iter().enumerate().flat_map(of_throw).collect()
}

/// Shear force and bending moment at the two instants of the torsion cases in the planes of the first throw, then the torque along the crank: all cases of the first design, and the case of the study of every design.
/// Nothing where the study asks for no case.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance met exactly.
pub(super) fn cases(study: &Study, system: &System, speed_rpm: f64) -> Result<Option<Figure>, ResponseError> {
    let asked = study.fatigue.as_ref().and_then(|f| f.torsion_case);
    let (Some(case), Some(crank)) = (asked, &study.crank) else { return Ok(None) };
    let (crank, engine) = (in_the_middle(crank), study.engine_of_crank());
    let Some(model) = CrankModel::thesis(engine, &crank) else { return Ok(None) };
    if shafts_at_bearings(&study.chain, crank.throws()).is_none() {
        return Ok(None);
    }
    let loads = model.at(speed_rpm);
    let instants = Instants::new(engine, &loads);
    let grid = Grid::new(&[speed_rpm], &[]);
    let vibratory = study.designs.iter().map(|d| {
        let found = torques(system, &d.absorbers, &grid)?;
        let shafts: Vec<_> = found.iter().map(|row| row[0]).collect();
        Ok(at_bearings(&study.chain, crank.throws(), &shafts).unwrap_or_default())
    });
    let vibratory: Vec<Vec<f64>> = vibratory.collect::<Result<_, ResponseError>>()?;
    let mut panels = along(&loads, &instants);
    for (i, (words, sign)) in INSTANTS.into_iter().zip([1.0, -1.0]).enumerate() {
        let torque = |label: String, case: TorsionCase, vibratory: &[f64]| Curve {
            label,
            look: Look::Line,
            points: steps(&crank, &case.halves(&instants.applied[i], vibratory, sign)),
        };
        let panel = |title: String, curves| Panel { title, x: PLACE, y: TORQUE, curves, scale: Scale::Own };
        if let (Some(first), Some(design)) = (vibratory.first(), study.designs.first()) {
            let all = TorsionCase::ALL.map(|c| torque(format!("case {}", c.name()), c, first));
            panels.push(panel(format!("torque {words}, {}", design.name.replace('_', " ")), all.to_vec()));
        }
        let each = study.designs.iter().zip(&vibratory).map(|(d, v)| torque(d.name.replace('_', " "), case, v));
        panels.push(panel(format!("torque {words}, case {}", case.name()), each.collect()));
    }
    Ok(Some(Figure {
        name: format!("torsion_cases_{speed_rpm}"),
        title: format!("{}: the crank at two instants of the cycle at {speed_rpm} rpm", study.engine.name),
        panels,
    }))
}

/// The two instants.
const INSTANTS: [&str; 2] = ["at the largest load", "at the smallest load"];

/// Shear force and bending moment along the crank at both instants, in the plane of the first throw and across it.
fn along(loads: &CrankLoads, instants: &Instants) -> Vec<Panel> {
    let at = |i: usize| loads.along(instants.samples[i], 0);
    let both = [at(0), at(1)];
    let label = |i: usize| format!("{}, {:.0}°", INSTANTS[i], instants.theta[i] * DEG_PER_RAD);
    let curves = |of: &dyn Fn(usize) -> Vec<(f64, f64)>| -> Vec<Curve> {
        let line =
            |i: usize| Curve { label: label(i), look: Look::Line, points: of(i).into_iter().map(|(x, y)| (x / M_PER_MM, y)).collect() };
        vec![line(0), line(1)]
    };
    let panel = |title: &str, y, of: &dyn Fn(usize) -> Vec<(f64, f64)>| Panel {
        title: title.into(),
        x: PLACE,
        y,
        curves: curves(of),
        scale: Scale::Own,
    };
    vec![
        panel("shear force in the plane of throw 1", FORCE, &|i| both[i].0[0].clone()),
        panel("shear force across it", FORCE, &|i| both[i].0[1].clone()),
        panel("bending moment in the plane of throw 1", MOMENT, &|i| both[i].1[0].clone()),
        panel("bending moment across it", MOMENT, &|i| both[i].1[1].clone()),
    ]
}
