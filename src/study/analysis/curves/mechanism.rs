//! The slider-crank over the cycle: motion of piston and rod, forces on every crankpin, and its forces by both methods.

use super::cylinder::{STRIDE, cylinder_of, degrees};
use super::figure::{ACCELERATION, ANGLE, Axis, CRANK_DEG, Curve, FORCE, Figure, Panel, SPEED, Scale, TORQUE, TRAVEL, VELOCITY, curve};
use super::shown::Shown;
use crate::engine::Engine;
use crate::engine::cycle::{Cycle, ThrowLoads, axes, crank_fixed, pin_angles};
use crate::engine::forces::{Moment, UnitForces, newton_euler, traditional};
use crate::input::Study;
use crate::numerics::elementary::Elementary;
use crate::units::{DEG_PER_RAD, M_PER_MM, RAD_PER_S_PER_RPM};

const RATE: Axis = Axis { column: "angular_velocity_rad_per_s", label: "angular velocity / rad/s" };
const RATE_CHANGE: Axis = Axis { column: "angular_acceleration_rad_per_s2", label: "angular acceleration / rad/s²" };

fn panel(title: &str, y: Axis, curves: Vec<Curve>) -> Panel {
    Panel { title: title.into(), x: CRANK_DEG, y, curves, scale: Scale::Own }
}

/// Travel from firing dead centre, velocity and acceleration of the piston, and lean of the rod with its rates, at a speed. Nothing where the torque comes from a table.
pub(super) fn kinematics(study: &Study, speed_rpm: f64) -> Option<Figure> {
    let (geometry, _) = cylinder_of(study)?;
    let crank = &geometry.slider_crank;
    let omega = speed_rpm * RAD_PER_S_PER_RPM;
    let theta = Cycle::new(&study.engine)?.theta(STRIDE);
    let line = |label: &str, f: &dyn Fn(f64) -> f64| vec![curve(label, degrees(theta.len()), theta.iter().map(|t| f(*t)))];
    Some(Figure {
        name: format!("kinematics_{speed_rpm}"),
        title: format!("{}: motion of piston and rod at {speed_rpm} rpm", study.engine.name),
        panels: vec![
            panel("piston: travel", TRAVEL, line("piston", &|t| crank.motion(t).travel / M_PER_MM)),
            panel("piston: velocity", VELOCITY, line("piston", &|t| crank.motion(t).slope * omega)),
            panel("piston: acceleration", ACCELERATION, line("piston", &|t| crank.motion(t).curvature * omega * omega)),
            panel("rod: lean", ANGLE, line("rod", &|t| crank.lean(t).angle * DEG_PER_RAD)),
            panel("rod: angular velocity", RATE, line("rod", &|t| crank.lean(t).slope * omega)),
            panel("rod: angular acceleration", RATE_CHANGE, line("rod", &|t| crank.lean(t).curvature * omega * omega)),
        ],
    })
}

/// Forces of the moving masses alone on every crankpin in axes of the engine, N: those of a cylinder whose pressure is that of the crankcase.
fn of_masses(engine: &Engine, loads: &ThrowLoads, unit: &[UnitForces]) -> Vec<Vec<[f64; 2]>> {
    let n = loads.theta.len();
    let on_throw = |throw: usize| {
        let firing = engine.layout.firing_on_throw(throw).iter().zip(axes(engine, throw));
        let own: Vec<(usize, f64)> = firing.map(|(f, axis)| ((f / engine.cycle_deg() * n as f64).round() as usize, axis)).collect();
        let at = |j: usize| {
            own.iter().fold([0.0; 2], |sum, (shift, axis)| {
                let [x, y] = unit[(j + n - shift % n) % n].big_end;
                let (sine, cosine) = axis.sine_cosine();
                [sum[0] + x * cosine - y * sine, sum[1] + x * sine + y * cosine]
            })
        };
        (0..n).map(at).collect()
    };
    (0..engine.layout.throws()).map(on_throw).collect()
}

/// Force on every crankpin over the cycle at a speed: its size, its parts in axes that turn with the crank, and what the moving masses alone do in axes of the engine.
pub(super) fn pin_forces(study: &Study, shown: &Shown, speed_rpm: f64) -> Option<Figure> {
    let (geometry, _) = cylinder_of(study)?;
    let cycle = Cycle::new(&study.engine)?;
    let loads = cycle.loads(speed_rpm, STRIDE);
    let still = |m: Moment| newton_euler(geometry, Moment { pressure: geometry.crankcase_pressure, ..m });
    let unit: Vec<UnitForces> = cycle.moments(speed_rpm, STRIDE).into_iter().map(still).collect();
    let (forces, masses) = (loads.pin_force(), of_masses(&study.engine, &loads, &unit));
    let pins = pin_angles(&study.engine);
    let each = |f: &dyn Fn(usize, usize) -> f64| -> Vec<Curve> {
        let n = loads.theta.len();
        shown.throws(forces.len()).map(|t| curve(format!("throw {}", t + 1), degrees(n), (0..n).map(|j| f(t, j)))).collect()
    };
    let turned = |t: usize, j: usize| crank_fixed(forces[t][j], loads.theta[j] + pins[t]);
    Some(Figure {
        name: format!("pin_forces_{speed_rpm}"),
        title: format!("{}: forces on the crankpins at {speed_rpm} rpm", study.engine.name),
        panels: vec![
            panel("size", FORCE, each(&|t, j| forces[t][j][0].hypotenuse(forces[t][j][1]))),
            panel("radial, outwards", FORCE, each(&|t, j| turned(t, j)[0])),
            panel("tangential, in the direction of rotation", FORCE, each(&|t, j| turned(t, j)[1])),
            panel("moving masses alone, along the middle of the banks", FORCE, each(&|t, j| masses[t][j][0])),
            panel("moving masses alone, across it", FORCE, each(&|t, j| masses[t][j][1])),
        ],
    })
}

/// Force on the crankpin and torque of one cylinder by the method of Newton and Euler and by the traditional one, with gas and of the moving masses alone, at a speed. The two are the same for a rod that is two masses.
pub(super) fn methods(study: &Study, speed_rpm: f64) -> Option<Figure> {
    let (geometry, _) = cylinder_of(study)?;
    let moments = Cycle::new(&study.engine)?.moments(speed_rpm, STRIDE);
    let still = |m: &Moment| Moment { pressure: geometry.crankcase_pressure, ..*m };
    type Method = fn(&crate::engine::Geometry, Moment) -> UnitForces;
    let both: [(&str, Method); 2] = [("Newton-Euler", newton_euler), ("traditional", traditional)];
    let lines = |alone: bool, f: fn(&UnitForces) -> f64| -> Vec<Curve> {
        let at = |m: &Moment| if alone { still(m) } else { *m };
        both.iter()
            .map(|(label, method)| curve(*label, degrees(moments.len()), moments.iter().map(|m| f(&method(geometry, at(m))))))
            .collect()
    };
    Some(Figure {
        name: format!("methods_{speed_rpm}"),
        title: format!("{}: one cylinder by both methods at {speed_rpm} rpm", study.engine.name),
        panels: vec![
            panel("rod on crankpin, along the cylinder", FORCE, lines(false, |u| u.big_end[0])),
            panel("rod on crankpin, across it", FORCE, lines(false, |u| u.big_end[1])),
            panel("torque on the throw", TORQUE, lines(false, |u| u.torque)),
            panel("moving masses alone, along the cylinder", FORCE, lines(true, |u| u.big_end[0])),
            panel("moving masses alone, across it", FORCE, lines(true, |u| u.big_end[1])),
        ],
    })
}

/// Largest forces on the first crankpin, half their ranges, and largest torque of a throw, at the speeds of the study.
pub(super) fn over_speed(study: &Study) -> Option<Figure> {
    let cycle = Cycle::new(&study.engine)?;
    let pins = pin_angles(&study.engine);
    let at = |speed: &f64| {
        let loads = cycle.loads(*speed, STRIDE);
        let first = &loads.pin_force()[0];
        let (mut least, mut most) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for (force, theta) in first.iter().zip(&loads.theta) {
            let turned = crank_fixed(*force, theta + pins[0]);
            for axis in 0..2 {
                least[axis] = least[axis].min(turned[axis]);
                most[axis] = most[axis].max(turned[axis]);
            }
        }
        let largest = [0, 1].map(|axis| most[axis].max(-least[axis]));
        let half = [0, 1].map(|axis| 0.5 * (most[axis] - least[axis]));
        [largest[0], half[0], largest[1], half[1], loads.torque.iter().flatten().copied().fold(0.0, f64::max)]
    };
    let found: Vec<[f64; 5]> = study.speeds_rpm.iter().map(at).collect();
    let line = |label: &str, i: usize| curve(label, study.speeds_rpm.iter().copied(), found.iter().map(|f| f[i]));
    let panel = |title: &str, y: Axis, curves: Vec<Curve>| Panel { title: title.into(), x: SPEED, y, curves, scale: Scale::Own };
    Some(Figure {
        name: "loads_over_speed".into(),
        title: format!("{}: loads of a crankpin over speed", study.engine.name),
        panels: vec![
            panel("radial force", FORCE, vec![line("largest size", 0), line("half its range", 1)]),
            panel("tangential force", FORCE, vec![line("largest size", 2), line("half its range", 3)]),
            panel("torque of a throw", TORQUE, vec![line("largest", 4)]),
        ],
    })
}
