//! Orbits of the journals in their bearings and forces on these, where the crank is flexible.

use super::figure::{Axis, CRANK_DEG, FORCE, Figure, Panel, curve};
use crate::drivetrain::System;
use crate::engine::Source;
use crate::engine::cycle::{crank_fixed, pin_angles, throw_loads};
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

/// Motion of all nodes in axes that turn with the crank: its mean, and each order of the excitation.
struct Motion {
    mean: DVector<f64>,
    orders: Vec<(f64, DVector<C64>)>,
}

/// The mean of what the rods and the unbalance do: the flywheel holds the crank against the mean torque.
fn mean(study: &Study, flexible: &FlexibleModel, speed_rpm: f64) -> Option<Result<DVector<f64>, Singular>> {
    let (engine, assembled) = (&study.engine, &flexible.assembled);
    let Source::Cylinder { geometry, .. } = &engine.source else { return None };
    let speed = speed_rpm * RAD_PER_S_PER_RPM;
    let loads = throw_loads(engine, speed_rpm)?;
    let mut shaft = assembled.shaft.clone();
    let mut force = DVector::from_element(6 * shaft.len(), C64::ZERO);
    for (i, own) in shaft.unbalance().iter().enumerate() {
        (0..6).for_each(|k| force[6 * i + k] += own[k] * speed * speed);
    }
    // counterweights that the stations leave no inertia for pull all the same
    for ((balance, webs), [outwards, _]) in assembled.balance.iter().zip(&assembled.webs).zip(&assembled.directions) {
        for node in webs {
            (0..3).for_each(|k| force[6 * node + k] -= 0.5 * balance.left_out * speed * speed * outwards[k]);
        }
    }
    // the forces of the rods hold all of their own masses
    let on_pin = geometry.rod_rotating_fraction() * geometry.rod_mass + 0.5 * geometry.oscillating_mass();
    let (rods, radius) = (engine.layout.rods_per_throw, geometry.slider_crank.crank_radius);
    for (t, angle) in pin_angles(engine).into_iter().enumerate() {
        for (rod, node) in assembled.rods[t].iter().enumerate() {
            let on = &loads.rod_force[t * rods + rod];
            let each = loads.theta.iter().zip(on).map(|(theta, force)| crank_fixed(*force, theta + angle));
            let sum = each.fold([0.0; 2], |sum, f| [sum[0] + f[0], sum[1] + f[1]]);
            let of = |k: usize| sum[k] / loads.theta.len() as f64;
            let radial = of(0) - on_pin * radius * speed * speed;
            for (direction, value) in assembled.directions[t].iter().zip([radial, of(1)]) {
                (0..3).for_each(|k| force[6 * node + k] += value * direction[k]);
            }
        }
    }
    let last = assembled.stations[assembled.stations.len() - 1];
    shaft.hold(last, [false, false, false, false, false, true]);
    Some(shaft.response(Turning { omega: 0.0, speed }, &force).map(|x| x.map(|x| x.re)))
}

fn motion(study: &Study, system: &System, speed_rpm: f64) -> Option<Result<Motion, ResponseError>> {
    let (flexible, crank) = (study.on_flexible()?, system.flexible.as_ref()?);
    let orders = system.excitation.orders.iter().enumerate().map(|(n, order)| {
        let unbounded = |_| ResponseError::unbounded(*order, speed_rpm);
        Ok((order.value(), crank.motion(&system.excitation, (n, speed_rpm), &[]).map_err(unbounded)?))
    });
    let lowest = system.excitation.orders[0];
    let mean = mean(study, flexible, speed_rpm)?.map_err(|_| ResponseError::unbounded(lowest, speed_rpm));
    Some(orders.collect::<Result<_, _>>().and_then(|orders| Ok(Motion { mean: mean?, orders })))
}

impl Motion {
    /// Displacement and velocity of a node across the axis at a crank angle, in turning axes: m and m/rad.
    fn at(&self, node: usize, theta: f64) -> [[f64; 2]; 2] {
        let one = |k: usize| {
            let i = 6 * node + k;
            self.orders.iter().fold([self.mean[i], 0.0], |[x, rate], (order, q)| {
                let y = q[i] * turn(order * theta);
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
    let Some(motion) = motion(study, system, speed_rpm) else { return Ok(Vec::new()) };
    let (motion, Some(flexible), Some(crank)) = (motion?, study.on_flexible(), study.crank.as_ref()) else { return Ok(Vec::new()) };
    let speed = speed_rpm * RAD_PER_S_PER_RPM;
    let cycle = 180.0 * f64::from(study.engine.strokes);
    let angles: Vec<f64> = (0..=(cycle / STEP_DEG) as usize).map(|i| i as f64 * STEP_DEG).collect();
    let bearing = flexible.spec.bearing;
    let numbers: Vec<usize> = (0..=crank.throws()).filter(|b| !crank.missing_bearings.contains(b)).collect();
    let (mut orbits, mut forces) = (Vec::new(), Vec::new());
    for (number, nodes) in numbers.iter().zip(&flexible.assembled.bearings) {
        let name = format!("bearing {}", number + 1);
        let share = 1.0 / nodes.len() as f64;
        let middle = nodes[nodes.len() / 2];
        let orbit = angles.iter().map(|deg| {
            let theta = deg * RAD_PER_DEG;
            standing(motion.at(middle, theta)[0], theta)
        });
        let orbit: Vec<[f64; 2]> = orbit.collect();
        orbits.push(curve(name.clone(), orbit.iter().map(|o| o[0] * UM), orbit.iter().map(|o| o[1] * UM)));
        // k d + c (d' + Omega e x d), whatever the axes
        let size = |deg: &f64| {
            let sum = nodes.iter().fold([0.0; 2], |sum, node| {
                let [[u, v], [du, dv]] = motion.at(*node, deg * RAD_PER_DEG);
                let (k, c) = (bearing.stiffness * share, bearing.damping * share * speed);
                [sum[0] + k * u + c * (du - v), sum[1] + k * v + c * (dv + u)]
            });
            sum[0].hypotenuse(sum[1])
        };
        forces.push(curve(name, angles.iter().copied(), angles.iter().map(size)));
    }
    let figure = |name: &str, title: &str, panel: Panel| Figure {
        name: format!("{name}_{speed_rpm}"),
        title: format!("{}: {title} at {speed_rpm} rpm, without absorber", study.engine.name),
        panels: vec![panel],
    };
    let panel = |title: &str, x, y, curves| Panel { title: title.into(), x, y, curves, y_top: None };
    Ok(vec![
        figure("orbits", "orbits of the journals", panel("middle of each main bearing, standing still", ACROSS, UP, orbits)),
        figure("bearing_forces", "forces on the main bearings", panel("the flexible crank on its bearings", CRANK_DEG, FORCE, forces)),
    ])
}
