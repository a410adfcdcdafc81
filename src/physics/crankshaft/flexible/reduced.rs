//! A crank put together, seen from its bearings, pins and ends: what other programs take of it.

use super::Assembled;
use crate::rotor::reduction::Reduction;
use crate::rotor::structure::{Structure, Unknown};
use nalgebra::DMatrix;

/// Its matrices over translations of the points of bearings and of the pins, all motions of its ends, and `modes` with these held; nodes are numbered from 1. `None` where its mass matrix is not positive definite.
#[doc(hidden)]
pub fn reduced(assembled: &Assembled, modes: usize) -> Option<Structure> {
    let shaft = &assembled.shaft;
    let free = shaft.free();
    let free_unknowns =
        |node: usize, components: std::ops::Range<usize>| components.map(move |k| 6 * node + k).filter(|i| free.contains(i));
    let points = assembled.bearings.iter().chain(&assembled.rods).flatten();
    let mut interface: Vec<usize> = points.flat_map(|node| free_unknowns(*node, 0..3)).collect();
    let pins = assembled.rods.concat();
    interface.extend(assembled.stations.iter().filter(|node| !pins.contains(node)).flat_map(|node| free_unknowns(*node, 0..6)));
    interface.sort_unstable();
    interface.dedup();
    let place = |i: &usize| free.iter().position(|f| f == i);
    let own: Vec<usize> = interface.iter().filter_map(place).collect();
    let part = |x: DMatrix<f64>| DMatrix::from_fn(free.len(), free.len(), |i, j| x[(free[i], free[j])]);
    let (stiffness, mass) = (part(shaft.stiffness_matrix()), part(shaft.mass_matrix()));
    let reduction = Reduction::new(&stiffness, &mass, &own, modes)?;
    let named = interface.iter().map(|i| Unknown { node: (i / 6 + 1) as u64, component: (i % 6 + 1) as u8 });
    let modal = (1..=reduction.omega.len()).map(|k| Unknown { node: k as u64, component: 0 });
    // rounding leaves some 1e-16 of asymmetry
    let halves = |x: DMatrix<f64>, sign: f64| (&x + x.transpose() * sign) * 0.5;
    Some(Structure {
        unknowns: named.chain(modal).collect(),
        places: interface.iter().map(|i| ((i / 6 + 1) as u64, shaft.places[i / 6])).collect(),
        stiffness: halves(reduction.of(&stiffness), 1.0),
        mass: Some(halves(reduction.of(&mass), 1.0)),
        gyroscopic: Some(halves(reduction.of(&part(shaft.gyroscopic_matrix())), -1.0)),
        turning: Some(halves(reduction.of(&part(shaft.turning_matrix())), 1.0)),
    })
}
