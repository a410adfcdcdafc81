//! Torque of the shafts by orders over speed, motions over the cycle, order spectrum of the torque.

use super::figure::{ANGLE, CRANK_DEG, Curve, Figure, Look, ORDER, Panel, SPEED, Scale, TORQUE, curve};
use super::shown::Shown;
use crate::absorber::Mounted;
use crate::drivetrain::System;
use crate::input::{DesignSpec, Study};
use crate::numerics::C64;
use crate::numerics::elementary::turn;
use crate::numerics::synthesis::Synthesiser;
use crate::response::{Direct, Grid, Quantity, ResponseError, Work};
use crate::units::DEG_PER_RAD;

/// Orders of a shaft that are drawn: those with the largest peaks.
const MAIN_ORDERS: usize = 6;
/// Points of a cycle.
const POINTS: usize = 720;

/// Amplitude of every order of the torque on the first throw at the lowest, the middle and the highest speed.
pub(super) fn spectrum(study: &Study, system: &System) -> Figure {
    let all = &study.speeds_rpm;
    let mut speeds = vec![all[0], all[all.len() / 2], all[all.len() - 1]];
    speeds.dedup();
    let orders = || system.excitation.orders.iter().map(|o| o.value());
    let spectrum_at = |speed: &f64| {
        curve(format!("{speed} rpm"), orders(), (0..system.orders()).map(|n| system.excitation.throw_torque(0, n, *speed).norm()))
    };
    Figure {
        name: "spectrum".into(),
        title: format!("{}: orders of the torque", study.engine.name),
        panels: vec![Panel {
            title: "throw 1".into(),
            x: ORDER,
            y: TORQUE,
            curves: speeds.iter().map(spectrum_at).collect(),
            scale: Scale::Own,
        }],
    }
}

/// Sweep of all shafts: phasors of each.
fn shafts(study: &Study, direct: &Direct, design: &[Mounted]) -> Result<Vec<Vec<C64>>, ResponseError> {
    let shafts: Vec<Quantity> = (0..study.chain.len() - 1).map(Quantity::ShaftTorque).collect();
    direct.at_each(design, &shafts, &study.speeds_rpm, &mut Work::default())
}

/// Torque of every shaft over speed, and that of the two that vibrate most by order. Nothing for a chain without shafts.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance met exactly.
pub(super) fn shaft_torque(
    study: &Study,
    system: &System,
    (design, shown): (&DesignSpec, &Shown),
) -> Result<Option<Figure>, ResponseError> {
    let grid = Grid::new(&study.speeds_rpm, &[]);
    let direct = Direct::new(system, &grid);
    let sweeps = shafts(study, &direct, &design.absorbers)?;
    let (synthesiser, orders) = (Synthesiser::new(&system.excitation.harmonics), system.orders());
    let totals: Vec<Vec<f64>> =
        sweeps.iter().map(|s| s.chunks(orders).map(|y| synthesiser.extremes(y).half_peak_to_peak).collect()).collect();
    let peak = |v: &[f64]| v.iter().copied().fold(0.0, f64::max);
    let mut ranked: Vec<usize> = (0..sweeps.len()).collect();
    ranked.sort_by(|a, b| peak(&totals[*b]).total_cmp(&peak(&totals[*a])));
    ranked.truncate(2);
    let total = |label: String, s: usize| curve(label, study.speeds_rpm.iter().copied(), totals[s].iter().copied());
    let name = |s: usize| study.chain.shaft_name(s).replace('_', " ");
    let one = |s: &usize| {
        let of_order = |n: usize| sweeps[*s].iter().skip(n).step_by(orders).map(|y| y.norm()).collect::<Vec<f64>>();
        let mut main: Vec<usize> = (0..orders).collect();
        main.sort_by(|a, b| peak(&of_order(*b)).total_cmp(&peak(&of_order(*a))));
        if !shown.all_orders {
            main.truncate(MAIN_ORDERS);
        }
        main.sort_unstable();
        let mut curves: Vec<Curve> = main
            .into_iter()
            .map(|n| {
                let order = system.excitation.orders[n];
                Curve { look: Look::Order(order), ..curve(format!("order {order}"), study.speeds_rpm.iter().copied(), of_order(n)) }
            })
            .collect();
        curves.push(Curve { look: Look::Black(0), ..total("all orders".into(), *s) });
        Panel { title: name(*s), x: SPEED, y: TORQUE, curves, scale: Scale::Own }
    };
    let every = (0..sweeps.len()).map(|s| total(name(s), s)).collect();
    let every = Panel { title: "every shaft, all orders".into(), x: SPEED, y: TORQUE, curves: every, scale: Scale::Own };
    let panels: Vec<Panel> = (!ranked.is_empty()).then_some(every).into_iter().chain(ranked.iter().map(one)).collect();
    Ok((!panels.is_empty()).then(|| Figure {
        name: format!("shaft_torque_{}", design.name),
        title: format!("{}: vibratory torque of the shafts, {}", study.engine.name, design.name.replace('_', " ")),
        panels,
    }))
}

/// Twist, angle of the hub and torque of the shaft that vibrates most over the cycle, each design at a speed of its own: that of its largest twist.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance met exactly.
pub(super) fn histories(study: &Study, system: &System) -> Result<Figure, ResponseError> {
    let grid = Grid::new(&study.speeds_rpm, &[]);
    let direct = Direct::new(system, &grid);
    let (synthesiser, orders) = (Synthesiser::new(&system.excitation.harmonics), system.orders());
    let hub = Quantity::Twist { from: study.hub, to: None };
    let half = |y: &[C64]| synthesiser.extremes(y).half_peak_to_peak;
    let mut panels = [("twist", ANGLE), ("angle of the hub", ANGLE), ("torque of the shaft that vibrates most", TORQUE)]
        .map(|(title, y)| Panel { title: title.into(), x: CRANK_DEG, y, curves: Vec::new(), scale: Scale::Own });
    for design in &study.designs {
        let mut quantities = vec![study.twist, hub];
        quantities.extend((0..study.chain.len() - 1).map(Quantity::ShaftTorque));
        let sweeps = direct.at_each(&design.absorbers, &quantities, &study.speeds_rpm, &mut Work::default())?;
        let twists: Vec<f64> = sweeps[0].chunks(orders).map(half).collect();
        let worst = (0..twists.len()).fold(0, |m, i| if twists[i] > twists[m] { i } else { m });
        let phasors_of = |q: usize| &sweeps[q][worst * orders..(worst + 1) * orders];
        let largest = (2..sweeps.len()).max_by(|a, b| half(phasors_of(*a)).total_cmp(&half(phasors_of(*b))));
        let label = format!("{} at {} rpm", design.name.replace('_', " "), study.speeds_rpm[worst]);
        for (panel, (q, scale)) in panels.iter_mut().zip([(Some(0), DEG_PER_RAD), (Some(1), DEG_PER_RAD), (largest, 1.0)]) {
            let Some(q) = q else { continue };
            panel.curves.push(Curve { label: label.clone(), look: Look::Line, points: over_cycle(system, phasors_of(q), scale) });
        }
    }
    let panels = panels.into_iter().filter(|p| !p.curves.is_empty()).collect();
    Ok(Figure { name: "histories".into(), title: format!("{}: motions over the cycle", study.engine.name), panels })
}

/// The sum of all orders over the cycle, order zero left out.
pub(super) fn over_cycle(system: &System, phasors: &[C64], scale: f64) -> Vec<(f64, f64)> {
    let harmonics = &system.excitation.harmonics;
    // crank angle of a cycle: that of the period of the first harmonic
    let whole = 360.0 * f64::from(harmonics[0]) / system.excitation.orders[0].value();
    (0..=POINTS)
        .map(|j| {
            let share = std::f64::consts::TAU * j as f64 / POINTS as f64;
            let sum: f64 = harmonics.iter().zip(phasors).map(|(h, y)| (y * turn(f64::from(*h) * share)).re).sum();
            (whole * j as f64 / POINTS as f64, sum * scale)
        })
        .collect()
}
