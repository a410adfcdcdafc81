//! Pressure over crank angle and over swept volume; forces and torque of a cylinder and of the throws.

use super::figure::{Axis, CRANK_DEG, Curve, FORCE, Figure, Look, Panel, Scale, TORQUE, curve};
use super::shown::Shown;
use crate::engine::cycle::Cycle;
use crate::engine::forces::{UnitForces, friction_torque, gas_torque, inertia_torque_per_omega2, unit_forces};
use crate::engine::pressure::sample_angle;
use crate::engine::{Geometry, Pressure, Source};
use crate::input::Study;
use crate::units::{DEG_PER_RAD, PA_PER_BAR};

/// Samples of the pressure between points: one degree.
pub(super) const STRIDE: usize = 10;
const PRESSURE: Axis = Axis { column: "pressure_bar", label: "pressure / bar" };
const VOLUME: Axis = Axis { column: "swept_volume_cm3", label: "swept volume / cm³" };
/// cm³ in a m³.
const CM3: f64 = 1e6;

/// Geometry and pressure of an engine with cylinders.
pub(super) fn cylinder_of(study: &Study) -> Option<(&Geometry, &Pressure)> {
    match &study.engine.source {
        Source::Cylinder { geometry, pressure } => Some((geometry, pressure)),
        Source::Harmonics(_) => None,
    }
}

/// Crank angles of the points, degrees.
pub(super) fn degrees(count: usize) -> impl Iterator<Item = f64> + Clone {
    (0..count).map(|j| sample_angle(j * STRIDE) * DEG_PER_RAD)
}

/// Pressure over the cycle, of every [`STRIDE`]th sample, at some speeds: those that are asked for, or of the tabulated ones the lowest, that of the largest pressure, and the highest.
fn traces(study: &Study, speeds_rpm: &[f64]) -> Option<Vec<(f64, Vec<f64>)>> {
    if !speeds_rpm.is_empty() {
        let cycle = Cycle::new(&study.engine)?;
        let own = |speed: &f64| (*speed, cycle.moments(*speed, STRIDE).iter().map(|m| m.pressure).collect());
        return Some(speeds_rpm.iter().map(own).collect());
    }
    let (geometry, pressure) = cylinder_of(study)?;
    let cylinders = study.engine.layout.firing_deg.len();
    let traces: Vec<Vec<f64>> = pressure.traces(geometry, study.engine.strokes, cylinders);
    let peak = |i: &usize| traces[*i].iter().copied().fold(0.0, f64::max);
    let largest = (0..traces.len()).max_by(|a, b| peak(a).total_cmp(&peak(b)))?;
    let mut chosen = vec![0, largest, traces.len() - 1];
    chosen.sort_unstable();
    chosen.dedup();
    Some(chosen.into_iter().map(|i| (pressure.speeds_rpm()[i], traces[i].iter().copied().step_by(STRIDE).collect())).collect())
}

/// p(theta) and p-V.
pub(super) fn pressure(study: &Study, speeds_rpm: &[f64]) -> Option<Figure> {
    let (geometry, _) = cylinder_of(study)?;
    let traces = traces(study, speeds_rpm)?;
    let over = |x: &dyn Fn(usize) -> f64| -> Vec<Curve> {
        let one = |(speed, trace): &(f64, Vec<f64>)| {
            let points = trace.iter().enumerate().map(|(j, p)| (x(j * STRIDE), p / PA_PER_BAR)).collect();
            Curve { label: format!("{speed} rpm"), look: Look::Line, points }
        };
        traces.iter().map(one).collect()
    };
    let swept = |j: usize| geometry.slider_crank.motion(sample_angle(j)).travel * geometry.piston_area() * CM3;
    Some(Figure {
        name: "cylinder".into(),
        title: format!("{}: cylinder pressure", study.engine.name),
        panels: vec![
            Panel {
                title: "over the cycle".into(),
                x: CRANK_DEG,
                y: PRESSURE,
                curves: over(&|j| sample_angle(j) * DEG_PER_RAD),
                scale: Scale::Own,
            },
            Panel { title: "over the swept volume".into(), x: VOLUME, y: PRESSURE, curves: over(&swept), scale: Scale::Own },
        ],
    })
}

/// Forces of one cylinder at a speed, in its own axes (along it away from the crankshaft, across it), and its torque.
pub(super) fn forces(study: &Study, speed_rpm: f64) -> Option<Figure> {
    let (geometry, _) = cylinder_of(study)?;
    let moments = Cycle::new(&study.engine)?.moments(speed_rpm, STRIDE);
    let unit: Vec<UnitForces> = moments.iter().map(|m| unit_forces(geometry, *m)).collect();
    let n = unit.len();
    let line = |label: &str, f: &dyn Fn(usize) -> f64| curve(label, degrees(n), (0..n).map(f));
    let gas = |j: usize| gas_torque(geometry, moments[j].pressure, moments[j].theta);
    let masses = |j: usize| inertia_torque_per_omega2(geometry, moments[j].theta) * moments[j].omega.powi(2);
    let friction = |j: usize| friction_torque(geometry, moments[j]);
    let panel = |title: &str, y: Axis, curves: Vec<Curve>| Panel { title: title.into(), x: CRANK_DEG, y, curves, scale: Scale::Own };
    Some(Figure {
        name: format!("forces_{speed_rpm}"),
        title: format!("{}: forces of a cylinder at {speed_rpm} rpm", study.engine.name),
        panels: vec![
            panel(
                "along the cylinder, away from the crankshaft",
                FORCE,
                vec![
                    line("gas on piston", &|j| -(moments[j].pressure - geometry.crankcase_pressure) * geometry.piston_area()),
                    line("rod on piston", &|j| unit[j].small_end[0]),
                    line("rod on crankpin", &|j| unit[j].big_end[0]),
                ],
            ),
            panel(
                "across the cylinder",
                FORCE,
                vec![
                    line("rod on piston", &|j| unit[j].small_end[1]),
                    line("rod on crankpin", &|j| unit[j].big_end[1]),
                    line("liner on piston", &|j| unit[j].liner),
                ],
            ),
            panel(
                "torque on the crank",
                TORQUE,
                vec![
                    line("all", &|j| unit[j].torque),
                    line("gas", &gas),
                    line("moving masses", &masses),
                    line("liner friction", &friction),
                ],
            ),
        ],
    })
}

/// Torque of every throw and of all together at a speed.
pub(super) fn torque(study: &Study, shown: &Shown, speed_rpm: f64) -> Option<Figure> {
    let loads = Cycle::new(&study.engine)?.loads(speed_rpm, STRIDE);
    let n = loads.theta.len();
    let line = |t: usize| curve(format!("throw {}", t + 1), degrees(n), loads.torque[t].iter().copied());
    let throws = shown.throws(loads.torque.len()).map(line).collect();
    let sum = curve("all throws", degrees(n), (0..n).map(|j| loads.torque.iter().map(|t| t[j]).sum()));
    let total = Curve { look: Look::Black(0), ..sum };
    let panel = |title: &str, curves| Panel { title: title.into(), x: CRANK_DEG, y: TORQUE, curves, scale: Scale::Own };
    Some(Figure {
        name: format!("torque_{speed_rpm}"),
        title: format!("{}: torque on the crank at {speed_rpm} rpm", study.engine.name),
        panels: vec![panel("each throw", throws), panel("all throws", vec![total])],
    })
}
