//! A crank put together, seen from its bearings, pins and ends: what other programs take of it.

use super::Assembled;
use super::imported::{ImportedCrank, Written};
use crate::rotor::reduction::Reduction;
use crate::rotor::structure::{Structure, Unknown};
use nalgebra::DMatrix;

/// Its matrices over translations of the points of main journals and of the pins, rotations about the axis of the outer points of journals, all motions of hub and flywheel, and `modes` with these held; nodes are numbered from 1. What the chain has before the hub and behind the flywheel is left out.
/// `None` where its mass matrix is not positive definite.
#[doc(hidden)]
pub fn reduced(assembled: &Assembled, modes: usize) -> Option<ImportedCrank> {
    let (shaft, stations) = (&assembled.shaft, &assembled.stations);
    let hub = assembled.throws.start.saturating_sub(1);
    let flywheel = assembled.throws.end.min(stations.len() - 1);
    let outside = |node: &usize| stations[..hub].contains(node) || stations[flywheel + 1..].contains(node);
    let free: Vec<usize> = shaft.free().into_iter().filter(|i| !outside(&(i / 6))).collect();
    let free_unknowns =
        |node: usize, components: std::ops::Range<usize>| components.map(move |k| 6 * node + k).filter(|i| free.contains(i));
    let points = assembled.journals.iter().chain(&assembled.rods).flatten();
    let mut interface: Vec<usize> = points.flat_map(|node| free_unknowns(*node, 0..3)).collect();
    // the twist between them tells the torque there
    let outer = assembled.journals.iter().flat_map(|points| [points[0], points[points.len() - 1]]);
    interface.extend(outer.flat_map(|node| free_unknowns(node, 5..6)));
    interface.extend([stations[hub], stations[flywheel]].into_iter().flat_map(|node| free_unknowns(node, 0..6)));
    interface.sort_unstable();
    interface.dedup();
    let place = |i: &usize| free.iter().position(|f| f == i);
    let own: Vec<usize> = interface.iter().filter_map(place).collect();
    let part = |x: DMatrix<f64>| DMatrix::from_fn(free.len(), free.len(), |i, j| x[(free[i], free[j])]);
    let (mut stiffness, mass) = (part(shaft.stiffness_matrix()), part(shaft.mass_matrix()));
    // the springs to what is left out go with it
    for (station, shaft) in [(hub, hub.checked_sub(1)), (flywheel, Some(flywheel).filter(|s| s + 1 < stations.len()))] {
        let place = free.iter().position(|i| *i == 6 * stations[station] + 5).zip(shaft);
        place.into_iter().for_each(|(i, shaft)| stiffness[(i, i)] -= assembled.shafts[shaft].1);
    }
    let reduction = Reduction::new(&stiffness, &mass, &own, modes)?;
    let named = interface.iter().map(|i| Unknown { node: (i / 6 + 1) as u64, component: (i % 6 + 1) as u8 });
    let modal = (1..=reduction.omega.len()).map(|k| Unknown { node: k as u64, component: 0 });
    // rounding leaves some 1e-16 of asymmetry
    let halves = |x: DMatrix<f64>, sign: f64| (&x + x.transpose() * sign) * 0.5;
    let number = |node: &usize| (*node + 1) as u64;
    let numbers = |all: &[Vec<usize>]| -> Vec<Vec<u64>> { all.iter().map(|nodes| nodes.iter().map(number).collect()).collect() };
    let mut pins = numbers(&assembled.rods);
    pins.iter_mut().for_each(Vec::dedup);
    let structure = Structure {
        unknowns: named.chain(modal).collect(),
        places: interface.iter().map(|i| ((i / 6 + 1) as u64, shaft.places[i / 6])).collect(),
        stiffness: halves(reduction.of(&stiffness), 1.0),
        mass: Some(halves(reduction.of(&mass), 1.0)),
        gyroscopic: Some(halves(reduction.of(&part(shaft.gyroscopic_matrix())), -1.0)),
        turning: Some(halves(reduction.of(&part(shaft.turning_matrix())), 1.0)),
    };
    let (hub, flywheel) = (number(&stations[hub]), number(&stations[flywheel]));
    let written = structure.unknowns.iter().map(|u| Written { unknown: *u, scale: 1.0 }).collect();
    Some(ImportedCrank { structure, written, hub, flywheel, pins, journals: numbers(&assembled.journals) })
}
