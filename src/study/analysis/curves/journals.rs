//! Orbits of the journals in their bearings and forces on these, where the crank is flexible.

use super::figure::{Axis, CRANK_DEG, FORCE, Figure, Panel, Scale, curve};
use crate::crankshaft::flexible::mean_load;
use crate::crankshaft::flexible::on_joints::OnJoints;
use crate::drivetrain::System;
use crate::engine::cycle::Cycle;
use crate::input::{FlexibleModel, Study};
use crate::numerics::C64;
use crate::numerics::elementary::{Elementary, turn};
use crate::numerics::tridiagonal::Singular;
use crate::response::ResponseError;
use crate::rotor::shaft::Turning;
use crate::units::{RAD_PER_DEG, RAD_PER_S_PER_RPM};
use nalgebra::DVector;

const ACROSS: Axis = Axis { column: "along_um", label: "along the middle of the banks / µm" };
const UP: Axis = Axis { column: "across_um", label: "across it / µm" };
/// µm in a m.
const UM: f64 = 1e6;
/// Degrees of the crank between samples.
const STEP_DEG: f64 = 1.0;

/// Motion of the points of the bearings across the axis, in axes that turn with the crank: the mean, and each order. m.
struct Motion {
    mean: Vec<[f64; 2]>,
    orders: Vec<(f64, Vec<[C64; 2]>)>,
}

/// The mean of what the rods and the unbalance do: the flywheel holds the crank against the mean torque.
fn mean(study: &Study, flexible: &FlexibleModel, speed_rpm: f64) -> Option<Result<DVector<f64>, Singular>> {
    let assembled = &flexible.assembled;
    let force = mean_load(assembled, &Cycle::new(&study.engine)?, speed_rpm);
    let mut shaft = assembled.shaft.clone();
    let last = assembled.stations[assembled.stations.len() - 1];
    shaft.hold_rotation(last);
    let at = Turning { omega: 0.0, speed: speed_rpm * RAD_PER_S_PER_RPM };
    Some(shaft.response(at, &force).map(|x| x.map(|x| x.re)))
}

/// On linear bearings.
fn linear(study: &Study, system: &System, speed_rpm: f64) -> Option<Result<Motion, ResponseError>> {
    let (flexible, crank) = (study.on_flexible()?, system.flexible.as_ref()?);
    let nodes = flexible.assembled.bearings.concat();
    let orders = system.excitation.orders.iter().enumerate().map(|(n, order)| {
        let unbounded = |_| ResponseError::unbounded(*order, speed_rpm);
        let all = crank.motion(&system.excitation, (n, speed_rpm), &[]).map_err(unbounded)?;
        Ok((order.value(), nodes.iter().map(|node| [all[6 * node], all[6 * node + 1]]).collect()))
    });
    let lowest = system.excitation.orders[0];
    let mean = mean(study, flexible, speed_rpm)?.map_err(|_| ResponseError::unbounded(lowest, speed_rpm));
    let of_points = |all: DVector<f64>| nodes.iter().map(|node| [all[6 * node], all[6 * node + 1]]).collect();
    Some(orders.collect::<Result<_, _>>().and_then(|orders| Ok(Motion { mean: of_points(mean?), orders })))
}

/// On bearings with a law of their own; `None` where they are linear or no motion on them is found.
fn on_joints(study: &Study, joints: &OnJoints, speed_rpm: f64) -> Option<Motion> {
    let found = joints.at(speed_rpm, &[], None).ok()?.joints;
    let points = |y: &DVector<C64>| (0..joints.joints.len()).map(|p| [y[2 * p], y[2 * p + 1]]).collect::<Vec<_>>();
    let order = |m: usize| m as f64 * 2.0 / f64::from(study.engine.strokes);
    let mean = points(&found.answers[0]).into_iter().map(|z| z.map(|x| x.re)).collect();
    Some(Motion { mean, orders: found.answers.iter().enumerate().skip(1).map(|(m, y)| (order(m), points(y))).collect() })
}

impl Motion {
    /// Displacement and velocity of a point at a crank angle, in turning axes: m and m/rad.
    fn at(&self, point: usize, theta: f64) -> [[f64; 2]; 2] {
        let one = |k: usize| {
            self.orders.iter().fold([self.mean[point][k], 0.0], |[x, rate], (order, q)| {
                let y = q[point][k] * turn(order * theta);
                [x + y.re, rate - order * y.im]
            })
        };
        let ([u, du], [v, dv]) = (one(0), one(1));
        [[u, v], [du, dv]]
    }
}

/// In axes of the engine.
fn standing([x, y]: [f64; 2], theta: f64) -> [f64; 2] {
    let (sine, cosine) = theta.sine_cosine();
    [x * cosine - y * sine, x * sine + y * cosine]
}

/// Orbits of the journals in the middle of their bearings, and the forces on these over the cycle, of the engine without absorber; nothing on a torsional chain.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance met exactly.
pub(super) fn journals(study: &Study, system: &System, speed_rpm: f64) -> Result<Vec<Figure>, ResponseError> {
    let Some((flexible, crank)) = study.on_flexible().zip(study.crank.as_ref()) else { return Ok(Vec::new()) };
    let excitation = FlexibleModel::excitation_on_joints(&study.engine);
    let joints = flexible.on_joints((crank, &study.engine), &excitation, (1.0, 1.0));
    let found = joints.as_ref().and_then(|joints| on_joints(study, joints, speed_rpm));
    let (law, motion) = match (found, linear(study, system, speed_rpm)) {
        (Some(own), _) => (joints.as_ref().map(|j| &j.joints), own),
        (None, Some(motion)) => (None, motion?),
        (None, None) => return Ok(Vec::new()),
    };
    let on = match (&law, &joints) {
        (Some(_), _) => "on bearings that stiffen with displacement",
        (None, Some(_)) => "on linear bearings: on the law of its own no motion was found",
        (None, None) => "on its bearings",
    };
    let speed = speed_rpm * RAD_PER_S_PER_RPM;
    let cycle = 180.0 * f64::from(study.engine.strokes);
    let angles: Vec<f64> = (0..=(cycle / STEP_DEG) as usize).map(|i| i as f64 * STEP_DEG).collect();
    let numbers: Vec<usize> = (0..=crank.throws()).filter(|b| !crank.missing_bearings.contains(b)).collect();
    let (mut orbits, mut forces, mut first) = (Vec::new(), Vec::new(), 0);
    for (place, (number, nodes)) in numbers.iter().zip(&flexible.assembled.bearings).enumerate() {
        let name = format!("bearing {}", number + 1);
        let orbit = angles.iter().map(|deg| {
            let theta = deg * RAD_PER_DEG;
            standing(motion.at(first + nodes.len() / 2, theta)[0], theta)
        });
        let orbit: Vec<[f64; 2]> = orbit.collect();
        orbits.push(curve(name.clone(), orbit.iter().map(|o| o[0] * UM), orbit.iter().map(|o| o[1] * UM)));
        let size = |deg: &f64| {
            let sum = (0..nodes.len()).fold([0.0; 2], |sum, point| {
                let [[u, v], [du, dv]] = motion.at(first + point, deg * RAD_PER_DEG);
                // d' + Omega e x d: the velocity standing still, whatever the axes
                let velocity = [speed * (du - v), speed * (dv + u)];
                let own = match law {
                    Some(joints) => joints[first + point].at([u, v], velocity).force,
                    None => {
                        let own = flexible.spec.bearing.point(place, point, nodes.len());
                        [0, 1].map(|k| own.stiffness * [u, v][k] + own.damping * velocity[k])
                    }
                };
                [sum[0] + own[0], sum[1] + own[1]]
            });
            sum[0].hypotenuse(sum[1])
        };
        forces.push(curve(name, angles.iter().copied(), angles.iter().map(size)));
        first += nodes.len();
    }
    let figure = |name: &str, title: &str, panel: Panel| Figure {
        name: format!("{name}_{speed_rpm}"),
        title: format!("{}: {title} at {speed_rpm} rpm, without absorber", study.engine.name),
        panels: vec![panel],
    };
    let panel = |title: &str, (x, y), curves, scale| Panel { title: title.into(), x, y, curves, scale };
    Ok(vec![
        figure(
            "orbits",
            "orbits of the journals",
            panel("middle of each main bearing, standing still", (ACROSS, UP), orbits, Scale::Equal),
        ),
        figure(
            "bearing_forces",
            "forces on the main bearings",
            panel(&format!("the flexible crank {on}"), (CRANK_DEG, FORCE), forces, Scale::Own),
        ),
    ])
}
