//! Bending of the webs over the working cycle, at every speed of a sweep.

use super::Spot;
use crate::chain::Chain;
use crate::engine::Engine;
use crate::engine::cycle::{Cycle as EngineCycle, ThrowLoads, crank_fixed, pin_angles};
use crate::fatigue::Cycle;
use crate::shaft::{Crank, Place, elements};
use crate::units::RAD_PER_S_PER_RPM;
use rayon::prelude::*;

/// Every so many samples of the pressure, 0.2° apart: a largest value is met within 1e-4 of itself.
const STRIDE: usize = 2;

/// Moment and shear force at a section of a throw per force on every throw.
struct Influence {
    moment: Vec<f64>,
    shear: Vec<f64>,
}

/// Loads in the plane of a throw at one of its sections: a sample each.
struct InPlane {
    moment: Vec<f64>,
    shear: Vec<f64>,
    tangential: Vec<f64>,
}

/// Local bending stress of every spot and mean torque of every shaft, a row a speed; nothing where the torque comes from a table.
pub fn table(
    engine: &Engine,
    chain: &Chain,
    crank: &Crank,
    spots: &[Spot],
    speeds_rpm: &[f64],
) -> Option<(Vec<Vec<Cycle>>, Vec<Vec<f64>>)> {
    let cycle = EngineCycle::new(engine)?;
    let angles = pin_angles(engine);
    let beam = crank.beam();
    let reactions = elements::reactions(&beam)?;
    let section = |throw: usize, which: usize| {
        let x = crank.places(throw)[which];
        Influence { moment: beam.moment_at(&reactions, x), shear: beam.shear_at(&reactions, x) }
    };
    // front web and rear web of every throw
    let webs: Vec<[Influence; 2]> = (0..crank.throws()).map(|t| [section(t, 0), section(t, 2)]).collect();
    let row = |speed: &f64| {
        let loads = cycle.loads(*speed, STRIDE);
        let forces = with_unbalance(&loads, crank, &angles, *speed);
        let local: Vec<Cycle> = spots
            .iter()
            .map(|s| {
                let own = if s.allowable.is_some() {
                    determinate(crank, s, &forces[s.throw], &loads.theta, angles[s.throw])
                } else {
                    continuous(&webs[s.throw][usize::from(s.rear)], &forces, &loads.theta, angles[s.throw])
                };
                // shear pushes the webs of a throw the same way and has opposite signs in them
                let sign = if s.rear { -1.0 } else { 1.0 };
                let stress = |j: usize| s.bending[0] * own.moment[j] + s.bending[1] * own.tangential[j] + sign * s.radial * own.shear[j];
                let (low, high) =
                    (0..own.moment.len()).map(stress).fold((f64::INFINITY, f64::NEG_INFINITY), |m, v| (m.0.min(v), m.1.max(v)));
                Cycle { amplitude: 0.5 * (high - low), mean: 0.5 * (high + low) }
            })
            .collect();
        (local, mean_torque(chain, &loads))
    };
    Some(speeds_rpm.par_iter().map(row).unzip())
}

/// Forces on the throws in axes of the engine, what turns with the crank included.
fn with_unbalance(loads: &ThrowLoads, crank: &Crank, angles: &[f64], speed_rpm: f64) -> Vec<Vec<[f64; 2]>> {
    let outward = crank.unbalance * (speed_rpm * RAD_PER_S_PER_RPM).powi(2);
    let add = |(throw, forces): (usize, &Vec<[f64; 2]>)| {
        let turned = forces.iter().zip(&loads.theta).map(|([x, y], theta)| {
            let (sine, cosine) = (theta + angles[throw]).sin_cos();
            [x + outward * cosine, y + outward * sine]
        });
        turned.collect()
    };
    loads.pin_force.iter().enumerate().map(add).collect()
}

/// Of the whole crank on all its bearings.
fn continuous(influence: &Influence, forces: &[Vec<[f64; 2]>], theta: &[f64], angle: f64) -> InPlane {
    let mut own = InPlane { moment: Vec::new(), shear: Vec::new(), tangential: Vec::new() };
    for (j, theta) in theta.iter().enumerate() {
        let (mut moment, mut shear) = ([0.0; 2], [0.0; 2]);
        for (throw, force) in forces.iter().enumerate() {
            for axis in 0..2 {
                moment[axis] += influence.moment[throw] * force[j][axis];
                shear[axis] += influence.shear[throw] * force[j][axis];
            }
        }
        let [radial, tangential] = crank_fixed(moment, theta + angle);
        own.moment.push(radial);
        own.tangential.push(tangential);
        own.shear.push(crank_fixed(shear, theta + angle)[0]);
    }
    own
}

/// Of one throw on its own two bearings \[IACS UR M53\] section 2.1.1: at the middle of the web, or of the crankpin for its oil bore.
fn determinate(crank: &Crank, spot: &Spot, forces: &[[f64; 2]], theta: &[f64], angle: f64) -> InPlane {
    let start = crank.bearings()[spot.throw];
    let pitch = crank.pitch(spot.throw);
    let [front, pin, rear] = crank.places(spot.throw).map(|x| x - start);
    let at = match (spot.place, spot.rear) {
        (Place::OilBore, _) => pin,
        (_, false) => front,
        (_, true) => rear,
    };
    // reaction before the section, with the sign of the beam: -F (pitch - pin)/pitch
    let before = -(pitch - pin) / pitch;
    let moment = before * at + (at - pin).max(0.0);
    let shear = if at > pin { before + 1.0 } else { before };
    let mut own = InPlane { moment: Vec::new(), shear: Vec::new(), tangential: Vec::new() };
    for (force, theta) in forces.iter().zip(theta) {
        let [radial, tangential] = crank_fixed(*force, theta + angle);
        own.moment.push(moment * radial);
        own.tangential.push(moment * tangential);
        own.shear.push(shear * radial);
    }
    own
}

/// Mean torque in every shaft: that of all throws before it, N m.
fn mean_torque(chain: &Chain, loads: &ThrowLoads) -> Vec<f64> {
    let mut sum = 0.0;
    let mean = |throw: &usize| loads.torque[*throw].iter().sum::<f64>() / loads.theta.len() as f64;
    let mut shafts = Vec::new();
    for station in &chain.stations {
        sum += station.throws.iter().map(mean).sum::<f64>();
        shafts.push(sum);
    }
    shafts.pop();
    shafts
}
