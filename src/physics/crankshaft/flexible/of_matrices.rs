//! A crank by the matrices of another program, on its bearings and with its rods.
//!
//! The matrices are of the free crank with hub and flywheel, reduced to points of its bearings, its pins, and both ends, in axes along the crank. What is added here are bearings, the rods on the pins, and what lies before the hub and behind the
//! flywheel. The pull of the rods stiffens each throw across it, as a string from the axis to the pin would: with it rigid rotation about the axis costs nothing.
//!
//! A throw whose pin has no rotation of its own is taken to rotate by the tangential motion of the pin against the axis, between the middles of the journals beside it, over its radius. The torque of a shaft is a twist by the static stiffness of
//! the matrices against it: of the journal there between its first and its last point, where these rotate about the axis; otherwise between the stations, which errs by what forces on the pins bend: some per cent, tens where bearings are missing.

use super::assembled::{Assembled, Carried, dissipation};
use super::imported::ImportedCrank;
use super::matrix_nodes::Nodes;
use super::spec::FlexibleSpec;
use super::throw::Turned;
use crate::crankshaft::Crank;
use crate::drivetrain::Chain;
use crate::rotor::body::Body;
use crate::rotor::shaft::{Answer, Dissipation, Shaft, Six};
use crate::rotor::structure::Unknown;
use crate::rotor::superelement::Superelement;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use std::collections::BTreeMap;
use std::ops::Range;

/// Torsional stiffness of matrices over that of a chain which may be of the same crank.
const STIFFNESS: std::ops::RangeInclusive<f64> = 0.1..=10.0;

/// A unit motion of an unknown of a node.
fn unit(node: usize, k: usize) -> Answer {
    vec![(node, k, 1.0)]
}

/// One motion less another.
fn less(a: &Answer, b: &Answer) -> Answer {
    a.iter().copied().chain(b.iter().map(|(node, k, factor)| (*node, *k, -factor))).collect()
}

/// Puts a crank by matrices together on the stations of a chain; `angles` of its throws, rad, and the mass of each rod on its pin, kg.
///
/// # Errors
/// In words, where chain and matrices do not fit together.
pub(super) fn assemble(
    (crank, chain): (&Crank, &Chain),
    (own, spec, carried): (&ImportedCrank, &FlexibleSpec, Carried),
    throws: Range<usize>,
    (angles, per_rod): (&[f64], f64),
) -> Result<Assembled, String> {
    if carried == Carried::Nothing {
        return Err("the matrices hold hub and flywheel".into());
    }
    if let Some(why) = own.mistaken((crank, chain), &throws, spec.thrust_at) {
        return Err(why);
    }
    let of_chain = own.of_chain((crank, chain), &throws, per_rod);
    if let Some(why) = own.inertia_differs(of_chain) {
        return Err(why);
    }
    let turned = own.turned(crank, angles)?;
    // in turn: what lies before the hub, the nodes of the matrices, what lies behind the flywheel, and modes
    let (before, behind) = (throws.start - 1, chain.len() - throws.end - 1);
    let nodes = Nodes::new(own, (before, behind), turned);
    let last = nodes.modes - behind;
    let directions: Vec<[Vector3<f64>; 2]> =
        angles.iter().enumerate().map(|(t, angle)| Turned { throw: t, angle: *angle }.directions()).collect();
    let rotations = rotations(&nodes, crank, &directions);
    let stations: Vec<usize> = (0..before)
        .chain([nodes.place[&own.hub]])
        .chain(own.pins.iter().map(|pins| nodes.place[&pins[0]]))
        .chain([nodes.place[&own.flywheel]])
        .chain(last..nodes.modes)
        .collect();
    let rotation = |i: usize| rotations.get(&stations[i]).cloned().unwrap_or_else(|| unit(stations[i], 5));
    let mut element = element(&nodes, spec);
    let lengths = lengths((&nodes, spec, &mut element), (chain, &throws, of_chain.stiffness), &rotation)?;
    if carried == Carried::All {
        for (i, station) in chain.stations.iter().enumerate() {
            element.tie(&rotation(i), [station.stiffness_to_ground, 0.0, 0.0]);
        }
        pull(&nodes, &mut element, &directions, (per_rod, crank.rods));
    }
    for (t, (pins, [_, tangential])) in own.pins.iter().zip(&directions).enumerate() {
        // what damps a throw acts on its pin
        let damping = chain.stations[throws.start + t].damping_to_ground / crank.crank_radius.powi(2);
        element.tie(&mean_of_rods(&nodes, pins, tangential), [0.0, 0.0, damping]);
    }
    let places = places(&nodes, (before, behind));
    let mut shaft = Shaft::joined(places, element);
    hold(&mut shaft, &nodes, (before, last));
    rotations.into_iter().for_each(|(node, motion)| shaft.rotate_by(node, motion));
    for i in (0..before).chain(throws.end..chain.len() - 1) {
        let (_, stiffness, dissipation) = &lengths[i];
        shaft.join_in_torsion(stations[i], *stiffness, *dissipation);
    }
    let rods: Vec<Vec<usize>> = own.pins.iter().map(|pins| rod_nodes(pins, crank.rods).map(|n| nodes.place[&n]).collect()).collect();
    carry((&mut shaft, &nodes), (crank, chain, spec), (&stations, &throws), (&rods, per_rod, carried));
    let journals: Vec<Vec<usize>> = own.journals.iter().map(|points| points.iter().map(|n| nodes.place[n]).collect()).collect();
    let translation: Vec<Six> =
        (0..shaft.len()).map(|i| Six::new(f64::from(u8::from(i < shaft.places.len())), 0.0, 0.0, 0.0, 0.0, 0.0)).collect();
    Ok(Assembled {
        mass: shaft.kinetic(&translation, &translation),
        shaft,
        stations,
        shafts: lengths,
        rods,
        webs: Vec::new(),
        sections: Vec::new(),
        rounds: Vec::new(),
        directions,
        bearings: present(crank).map(|b| journals[b].clone()).collect(),
        journals,
        throws,
        balance: Vec::new(),
        written: nodes.written(),
    })
}

/// Node of each rod of a throw.
fn rod_nodes(pins: &[u64], rods: usize) -> impl Iterator<Item = u64> {
    (0..rods).map(|rod| pins[rod.min(pins.len() - 1)])
}

/// Rotations of throws whose pins have none of their own, by their first nodes.
fn rotations(nodes: &Nodes, crank: &Crank, directions: &[[Vector3<f64>; 2]]) -> BTreeMap<usize, Answer> {
    let mut all = BTreeMap::new();
    for (pins, [_, tangential]) in nodes.own.pins.iter().zip(directions) {
        if pins.len() > 1 || !nodes.moves(pins[0], 6) {
            let along = tangential / (crank.crank_radius * pins.len() as f64);
            all.insert(nodes.place[&pins[0]], pins.iter().flat_map(|pin| nodes.against_axis(*pin, &along)).collect());
        }
    }
    all
}

/// Mean motion of the rods of a throw along a direction.
fn mean_of_rods(nodes: &Nodes, pins: &[u64], direction: &Vector3<f64>) -> Answer {
    let share = 1.0 / pins.len() as f64;
    pins.iter().flat_map(|pin| (0..3).map(|k| (nodes.place[pin], k, share * direction[k]))).collect()
}

/// Main journals with a bearing.
fn present(crank: &Crank) -> impl Iterator<Item = usize> {
    (0..=crank.throws()).filter(|b| !crank.missing_bearings.contains(b))
}

/// Twist of a main journal, where its first and last points rotate about the axis.
fn twist_of_journal(nodes: &Nodes, journal: usize) -> Option<Answer> {
    let points = &nodes.own.journals[journal];
    let (first, last) = (points[0], points[points.len() - 1]);
    nodes.own.tells_torque(journal).then(|| less(&unit(nodes.place[&first], 5), &unit(nodes.place[&last], 5)))
}

/// The crank under a torque from the hub to the flywheel, at rest.
struct Twisted {
    motion: DVector<f64>,
}

impl Twisted {
    fn new(nodes: &Nodes) -> Result<Self, String> {
        let structure = &nodes.own.structure;
        let place = |node: u64| structure.unknowns.iter().position(|u| *u == Unknown { node, component: 6 });
        let ends = place(nodes.own.hub).zip(place(nodes.own.flywheel));
        let found = structure.rigid_motions().zip(ends).and_then(|(rigid, ends)| structure.twisted(&rigid, ends));
        Ok(Self { motion: nodes.motion(&found.ok_or("a torque from hub to flywheel does not twist the matrices")?) })
    }

    /// Stiffness against a twist, N m/rad.
    fn stiffness(&self, twist: &Answer, shaft: &str) -> Result<f64, String> {
        // the torque acts on the flywheel, so that rotation grows along the crank
        let per_torque: f64 = -twist.iter().map(|(node, k, factor)| self.motion[6 * node + k] * factor).sum::<f64>();
        if per_torque.is_nan() || per_torque <= 0.0 {
            return Err(format!("a torque from hub to flywheel does not twist the matrices behind {shaft}"));
        }
        Ok(1.0 / per_torque)
    }
}

/// Of each shaft of the chain a twist, its stiffness and how that dissipates; what the shafts of the crank lose by the chain is put on the element.
fn lengths(
    (nodes, spec, element): (&Nodes, &FlexibleSpec, &mut Superelement),
    (chain, throws, of_chain): (&Chain, &Range<usize>, f64),
    rotation: &dyn Fn(usize) -> Answer,
) -> Result<Vec<(Answer, f64, Dissipation)>, String> {
    let twisted = Twisted::new(nodes)?;
    let whole = twisted.stiffness(&less(&rotation(throws.start - 1), &rotation(throws.end)), "the hub")?;
    if !STIFFNESS.contains(&(whole / of_chain)) {
        return Err(format!(
            "from hub to flywheel the matrices have {whole:.4e} N m/rad in torsion with free ends, the chain {of_chain:.4e}: matrices of other units?"
        ));
    }
    let mut all = Vec::new();
    for (i, s) in chain.stations[..chain.len() - 1].iter().enumerate() {
        let (between, own) = (less(&rotation(i), &rotation(i + 1)), dissipation(s));
        if i + 1 < throws.start || i >= throws.end {
            all.push((between, s.stiffness_to_next, own));
            continue;
        }
        let stiffness = twisted.stiffness(&between, &s.name)?;
        element.tie(&between, [0.0, stiffness * own.loss_factor, stiffness * own.time]);
        let (twist, stiffness) = match twist_of_journal(nodes, i + 1 - throws.start) {
            Some(journal) => (journal.clone(), twisted.stiffness(&journal, &s.name)?),
            None => (between, stiffness),
        };
        all.push((twist, stiffness, Dissipation { loss_factor: spec.loss_factor + own.loss_factor, ..own }));
    }
    Ok(all)
}

/// The matrices over the unknowns of the shaft.
fn element(nodes: &Nodes, spec: &FlexibleSpec) -> Superelement {
    let (structure, zeros) = (&nodes.own.structure, Superelement::zeros(nodes.count));
    let stiffness = nodes.scattered(&structure.stiffness);
    let scattered = |x: &Option<DMatrix<f64>>, without: DMatrix<f64>| x.as_ref().map_or(without, |x| nodes.scattered(x));
    Superelement {
        loss: &stiffness * spec.loss_factor,
        stiffness,
        damping: zeros.damping,
        mass: scattered(&structure.mass, zeros.mass),
        gyroscopic: scattered(&structure.gyroscopic, zeros.gyroscopic),
        turning: scattered(&structure.turning, zeros.turning),
    }
}

/// Stiffness of the throws by the pull of their rods.
fn pull(nodes: &Nodes, element: &mut Superelement, directions: &[[Vector3<f64>; 2]], (per_rod, rods): (f64, usize)) {
    for (pins, [_, tangential]) in nodes.own.pins.iter().zip(directions) {
        for pin in rod_nodes(pins, rods) {
            element.pull(&nodes.against_axis(pin, tangential), per_rod);
            // along the axis, where the points of the bearings beside it move along it
            let beside = nodes.beside(nodes.own.structure.places[&pin].z);
            let axial = |node: &usize| nodes.place.iter().any(|(number, place)| place == node && nodes.moves(*number, 3));
            if beside.iter().all(|b| axial(&b.0)) {
                element.pull(&nodes.against_axis(pin, &Vector3::z()), per_rod);
            }
        }
    }
}

/// Places of all nodes but those of modes, in the axes of the engine.
fn places(nodes: &Nodes, (before, behind): (usize, usize)) -> Vec<Vector3<f64>> {
    let place = |n: &u64| nodes.turn * nodes.own.structure.places[n];
    let mut all = vec![place(&nodes.own.hub); before];
    all.extend(nodes.numbers.iter().map(place));
    all.extend(std::iter::repeat_n(place(&nodes.own.flywheel), behind));
    all
}

/// Holds what the matrices do not move; what lies outside them (before the first of two nodes, from the second on) only turns.
fn hold(shaft: &mut Shaft, nodes: &Nodes, (first, last): (usize, usize)) {
    let indices = nodes.indices();
    for node in 0..nodes.count {
        let outside = node < first || (last..nodes.modes).contains(&node);
        shaft.hold(node, std::array::from_fn(|k| if outside { k != 5 } else { !indices.contains(&(6 * node + k)) }));
    }
}

/// Puts rods, bearings, dampers and what only turns on the crank.
fn carry(
    (shaft, nodes): (&mut Shaft, &Nodes),
    (crank, chain, spec): (&Crank, &Chain, &FlexibleSpec),
    (stations, throws): (&[usize], &Range<usize>),
    (rods, per_rod, carried): (&[Vec<usize>], f64, Carried),
) {
    for (station, node) in stations.iter().enumerate() {
        let s = &chain.stations[station];
        if station + 1 < throws.start || station > throws.end {
            shaft.put_polar(*node, s.inertia);
        }
        if !throws.contains(&station) {
            shaft.tie(*node, &Six::new(0.0, 0.0, 0.0, 0.0, 0.0, 1.0), (0.0, s.damping_to_ground));
        }
    }
    if carried == Carried::All {
        for node in rods.iter().flatten() {
            shaft.put(*node, &Body { mass: per_rod, arm: Vector3::zeros(), tensor: Matrix3::zeros() });
        }
        for (place, points) in present(crank).map(|b| &nodes.own.journals[b]).enumerate() {
            for (point, node) in points.iter().enumerate() {
                let own = spec.bearing.point(place, point, points.len());
                shaft.bear(nodes.place[node], (own.stiffness, own.damping));
            }
        }
        let along = Six::new(0.0, 0.0, 1.0, 0.0, 0.0, 0.0);
        shaft.tie(nodes.place[&nodes.own.thrust_node(spec.thrust_at)], &along, (spec.thrust.stiffness, spec.thrust.damping));
    }
    if !spec.rotating {
        shaft.without_rotation();
    }
}
