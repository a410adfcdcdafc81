//! Loads of the main bearings of a study's crank at its highest speed.

use crate::crankshaft::loads::CrankModel;
use crate::engine::cycle::crank_fixed;
use crate::input::Study;
use crate::numerics::elementary::Elementary;

/// Load of a main bearing over the working cycle, the crank a continuous beam.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(hidden)]
pub struct BearingLoad {
    /// Number of the bearing, from 1.
    pub number: usize,
    /// Largest, N.
    pub largest: f64,
    /// Crank angle of the largest, rad.
    pub theta: f64,
    /// Its direction from the middle of the banks in the direction of rotation, rad.
    pub towards: f64,
    /// What turns with the crank: the mean in crank-fixed axes, N.
    pub turning: f64,
}

/// The loads at the highest speed; nothing without `[crank]` or without a cylinder pressure.
#[doc(hidden)]
pub fn bearing_loads(study: &Study) -> Option<Vec<BearingLoad>> {
    let crank = study.crank.as_ref()?;
    let model = CrankModel::new(study.engine_of_crank(), crank)?;
    let loads = model.at(study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let numbers = (0..=crank.throws()).filter(|b| !crank.missing_bearings.contains(b));
    let n = loads.theta.len();
    let forces: Vec<Vec<[f64; 2]>> = (0..n).map(|j| loads.bearing_forces(j)).collect();
    let load = |(i, number): (usize, usize)| {
        let size = |j: usize| forces[j][i][0].hypotenuse(forces[j][i][1]);
        let worst = (0..n).fold(0, |m, j| if size(j) > size(m) { j } else { m });
        let [x, y] = forces[worst][i];
        // what turns with the crank stays in the mean of crank-fixed axes
        let turning = (0..n).map(|j| crank_fixed(forces[j][i], loads.theta[j])).fold([0.0; 2], |s, f| [s[0] + f[0], s[1] + f[1]]);
        BearingLoad {
            number: number + 1,
            largest: size(worst),
            theta: loads.theta[worst],
            towards: y.arctangent(x),
            turning: turning[0].hypotenuse(turning[1]) / n as f64,
        }
    };
    Some(numbers.enumerate().map(load).collect())
}
