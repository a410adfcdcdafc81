//! Local bending stress of every spot over the working cycle, at every speed of a sweep.

use super::Spot;
use super::loads::{CrankLoads, CrankModel};
use crate::chain::Chain;
use crate::engine::Engine;
use crate::fatigue::Cycle;
use crate::shaft::{Crank, Place};
use rayon::prelude::*;

/// Local bending stress of every spot, Pa, and mean torque of every shaft, N m: a row a speed. Nothing where the torque comes from a table.
pub fn table(
    engine: &Engine,
    chain: &Chain,
    crank: &Crank,
    spots: &[Spot],
    speeds_rpm: &[f64],
) -> Option<(Vec<Vec<Cycle>>, Vec<Vec<f64>>)> {
    let model = CrankModel::new(engine, crank)?;
    let row = |speed: &f64| {
        let loads = model.at(*speed);
        (spots.iter().map(|s| stress(crank, s, &loads)).collect(), mean_torque(chain, &loads))
    };
    Some(speeds_rpm.par_iter().map(row).unzip())
}

fn stress(crank: &Crank, spot: &Spot, loads: &CrankLoads) -> Cycle {
    let own = if spot.allowable.is_some() {
        let [front, pin, rear] = crank.places(spot.throw);
        let at = match spot.place {
            Place::OilBore => pin,
            _ if spot.rear => rear,
            _ => front,
        };
        loads.determinate(spot.throw, at - crank.bearings()[spot.throw])
    } else {
        loads.web(spot.throw, spot.rear)
    };
    // shear pushes the webs of a throw the same way and has opposite signs in them
    let radial = if spot.rear { -spot.radial } else { spot.radial };
    let at = |j: usize| spot.bending[0] * own.moment[j] + spot.bending[1] * own.tangential[j] + radial * own.shear[j];
    let wider = |m: (f64, f64), v: f64| (m.0.min(v), m.1.max(v));
    let (low, high) = (0..own.moment.len()).map(at).fold((f64::INFINITY, f64::NEG_INFINITY), wider);
    Cycle { amplitude: 0.5 * (high - low), mean: 0.5 * (high + low) }
}

/// Mean torque in every shaft: that of all throws before it. What the engine delivers leaves at the last station.
fn mean_torque(chain: &Chain, loads: &CrankLoads) -> Vec<f64> {
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
