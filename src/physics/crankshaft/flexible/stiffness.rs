//! Torsional stiffness of one throw, by what its bearings hold.

use super::row::{Material, Row};
use super::spec::{BearingNodes, FlexibleSpec};
use super::throw::{self, Turned};
use crate::crankshaft::Crank;
use crate::numerics::C64;
use crate::rotor::shaft::Turning;
use nalgebra::{DVector, SMatrix, Vector3};

/// Stiffness in rotation from the middle of a bearing to that of the next, N m/rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThrowStiffness {
    /// Both ends free to move across the axis and to tilt (CC#2 of \[Villalva 2014\]).
    pub free: f64,
    /// Both ends held on the axis, free to tilt (CC#1).
    pub guided: f64,
    /// All nodes of both bearings held on the axis and against tilting.
    pub held: f64,
}

/// Of a throw by itself; `None` where it is singular, and for a crank by matrices.
pub fn throw_stiffness(crank: &Crank, spec: &FlexibleSpec, throw: usize) -> Option<ThrowStiffness> {
    let beams = spec.beams()?;
    let material = Material { young_modulus: crank.young_modulus, density: beams.density };
    let mut row = Row::from(Vector3::zeros());
    let nodes = throw::add(&mut row, crank, (material, &beams.web_factors), Turned { throw, angle: 0.0 }, spec.nodes, 0.0);
    let mut shaft = row.shaft();
    shaft.hold(0, [true; 6]);
    let last = row.last();
    let under = |shaft: &crate::rotor::shaft::Shaft, k: usize| {
        let force = DVector::from_fn(6 * shaft.len(), |i, _| C64::from(f64::from(u8::from(i == 6 * last + k))));
        shaft.response(Turning { omega: 0.0, speed: 0.0 }, &force).ok().map(|x| x.map(|x| x.re))
    };
    let mut flexibility = SMatrix::<f64, 6, 6>::zeros();
    for k in 0..6 {
        let x = under(&shaft, k)?;
        (0..6).for_each(|i| flexibility[(i, k)] = x[6 * last + i]);
    }
    let f = |i: usize, j: usize| flexibility[(i, j)];
    // ends that do not leave the axis
    let ends = nalgebra::Matrix2::new(f(0, 0), f(0, 1), f(1, 0), f(1, 1)).try_inverse()?;
    let coupled = nalgebra::Vector2::new(f(0, 5), f(1, 5));
    let guided = f(5, 5) - (coupled.transpose() * ends * coupled)[(0, 0)];
    let mut bearing = nodes.bearing.clone();
    if spec.nodes == BearingNodes::Three {
        bearing.push(1);
    }
    for node in bearing {
        shaft.hold(node, [true, true, false, true, true, false]);
    }
    let held = under(&shaft, 5)?[6 * last + 5];
    Some(ThrowStiffness { free: 1.0 / f(5, 5), guided: 1.0 / guided, held: 1.0 / held })
}
