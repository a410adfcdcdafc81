//! A crank by the matrices of another program, on its bearings and with its rods.
//!
//! The matrices are of the free crank with hub and flywheel, reduced to points of its bearings, its pins, and both ends, in axes along the crank. What is added here are bearings, the rods on the pins, and what lies before the hub and behind the
//! flywheel. The pull of the rods stiffens each throw across it, as a string from the axis to the pin would: with it rigid rotation about the axis costs nothing.
//!
//! A throw whose pin has no rotation of its own is taken to rotate by the tangential motion of the pin against the axis, between the middles of the bearings beside it, over its radius. The torque of a shaft is a twist by the static stiffness of
//! the matrices against it: of the journal between the first and the last point of the bearing there, where these rotate about the axis; otherwise between the stations, which errs by what forces on the pins bend (some per cent).

use super::assembled::{Assembled, Carried};
use super::imported::ImportedCrank;
use super::spec::FlexibleSpec;
use super::throw::Turned;
use crate::crankshaft::Crank;
use crate::drivetrain::{Chain, Station};
use crate::numerics::elementary::Elementary;
use crate::rotor::body::Body;
use crate::rotor::shaft::{Answer, Dissipation, Shaft, Six};
use crate::rotor::structure::Unknown;
use crate::rotor::superelement::Superelement;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use std::collections::BTreeMap;
use std::ops::Range;

/// Where the nodes of the matrices stand among those of a shaft.
struct Nodes<'a> {
    own: &'a ImportedCrank,
    place: BTreeMap<u64, usize>,
    /// First node that holds coordinates of modes.
    modes: usize,
    /// All nodes.
    count: usize,
    /// Turns the axes of the matrices to those of the engine.
    turn: Matrix3<f64>,
}

impl Nodes<'_> {
    /// Index of an unknown of the matrices among those of the shaft; `modal`: how many coordinates of modes come before it.
    fn index(&self, unknown: &Unknown, modal: usize) -> usize {
        match unknown.component {
            0 => 6 * self.modes + modal,
            component => 6 * self.place[&unknown.node] + usize::from(component) - 1,
        }
    }

    /// Indices of all unknowns of the matrices.
    fn indices(&self) -> Vec<usize> {
        let mut modal = 0..;
        let of = |u: &Unknown| self.index(u, if u.component == 0 { modal.next().unwrap_or(0) } else { 0 });
        self.own.structure.unknowns.iter().map(of).collect()
    }

    /// Whether a node moves by a component, from 1.
    fn moves(&self, node: u64, component: u8) -> bool {
        self.own.structure.unknowns.contains(&Unknown { node, component })
    }

    /// A matrix of the structure over the unknowns of the shaft, in the axes of the engine.
    fn scattered(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        let (n, indices) = (6 * self.count, self.indices());
        let mut all = DMatrix::zeros(n, n);
        for (i, row) in indices.iter().enumerate() {
            for (j, column) in indices.iter().enumerate() {
                all[(*row, *column)] = matrix[(i, j)];
            }
        }
        let mut turn = DMatrix::identity(n, n);
        for first in (0..6 * self.modes).step_by(3) {
            turn.fixed_view_mut::<3, 3>(first, first).copy_from(&self.turn);
        }
        &turn * all * turn.transpose()
    }

    /// A motion of the unknowns of the matrices over those of the shaft.
    fn motion(&self, own: &DVector<f64>) -> DVector<f64> {
        let mut all = DVector::zeros(6 * self.count);
        self.indices().iter().zip(own.iter()).for_each(|(index, x)| all[*index] = *x);
        for first in (0..6 * self.modes).step_by(3) {
            let turned = self.turn * all.fixed_rows::<3>(first);
            all.fixed_rows_mut::<3>(first).copy_from(&turned);
        }
        all
    }

    /// Unknowns as the files have them, in the axes of the matrices.
    fn written(&self) -> Vec<(Unknown, Answer)> {
        let back = |index: usize, scale: f64| -> Answer {
            let (node, k) = (index / 6, index % 6);
            if node >= self.modes {
                return vec![(node, k, scale)];
            }
            let first = 3 * (k / 3);
            (0..3).map(|i| (node, first + i, scale * self.turn[(i, k - first)])).filter(|f| f.2 != 0.0).collect()
        };
        self.own.written.iter().zip(self.indices()).map(|(w, index)| (w.unknown, back(index, w.scale))).collect()
    }

    /// Middle points of the bearings beside a throw with their weights at the place of its pin.
    fn beside(&self, z: f64) -> Vec<(usize, f64, f64)> {
        let at = |node: u64| self.own.structure.places[&node].z;
        let middles: Vec<u64> = self.own.bearings.iter().map(|points| points[points.len() / 2]).collect();
        let before = middles.iter().copied().filter(|m| at(*m) <= z).max_by(|a, b| at(*a).total_cmp(&at(*b)));
        let behind = middles.iter().copied().filter(|m| at(*m) > z).min_by(|a, b| at(*a).total_cmp(&at(*b)));
        match (before, behind) {
            (Some(a), Some(b)) => {
                let share = (z - at(a)) / (at(b) - at(a));
                vec![(self.place[&a], 1.0 - share, at(a)), (self.place[&b], share, at(b))]
            }
            (one, other) => one.or(other).map(|m| (self.place[&m], 1.0, at(m))).into_iter().collect(),
        }
    }

    /// Motion of a pin along a direction against the axis beside it.
    fn against_axis(&self, pin: u64, direction: &Vector3<f64>) -> Answer {
        let along = |node: usize, factor: f64| (0..3).map(move |k| (node, k, factor * direction[k])).filter(|f| f.2 != 0.0);
        let beside = self.beside(self.own.structure.places[&pin].z);
        along(self.place[&pin], 1.0).chain(beside.into_iter().flat_map(|(node, weight, _)| along(node, -weight))).collect()
    }
}

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
    if let Some(why) =
        own.mistaken((crank, chain), &throws, spec.thrust_at).or_else(|| own.inertia_differs((crank, chain), &throws, per_rod))
    {
        return Err(why);
    }
    let turned = own.turned(crank, angles)?;
    let (sine, cosine) = turned.sine_cosine();
    let turn = Matrix3::new(cosine, sine, 0.0, -sine, cosine, 0.0, 0.0, 0.0, 1.0);
    // in turn: what lies before the hub, the nodes of the matrices, what lies behind the flywheel, and modes
    let (before, behind) = (throws.start - 1, chain.len() - throws.end - 1);
    let mut numbers: Vec<u64> = own.structure.unknowns.iter().filter(|u| u.component > 0).map(|u| u.node).collect();
    numbers.sort_unstable();
    numbers.dedup();
    let along = |n: &u64| (*n == own.flywheel, *n != own.hub);
    numbers.sort_by(|a, b| along(a).cmp(&along(b)).then(own.place(*a).z.total_cmp(&own.place(*b).z)));
    let modal = own.structure.unknowns.iter().filter(|u| u.component == 0).count();
    let modes = before + numbers.len() + behind;
    let nodes = Nodes {
        own,
        place: numbers.iter().enumerate().map(|(i, n)| (*n, before + i)).collect(),
        modes,
        count: modes + modal.div_ceil(6),
        turn,
    };
    let directions: Vec<[Vector3<f64>; 2]> =
        angles.iter().enumerate().map(|(t, angle)| Turned { throw: t, angle: *angle }.directions()).collect();
    let rotations = rotations(&nodes, crank, &directions);
    let stations: Vec<usize> = (0..before)
        .chain([nodes.place[&own.hub]])
        .chain(own.pins.iter().map(|pins| nodes.place[&pins[0]]))
        .chain([nodes.place[&own.flywheel]])
        .chain(before + numbers.len()..modes)
        .collect();
    let rotation = |i: usize| rotations.get(&stations[i]).cloned().unwrap_or_else(|| unit(stations[i], 5));
    let mut element = element(&nodes, spec);
    let lengths = lengths((&nodes, spec, &mut element), (crank, chain, &throws), &rotation)?;
    for (i, station) in chain.stations.iter().enumerate() {
        element.tie(&rotation(i), [station.stiffness_to_ground, 0.0, 0.0]);
    }
    if carried == Carried::All {
        pull(&nodes, &mut element, &directions, (per_rod, crank.rods));
    }
    let places = places(&nodes, &numbers, (before, behind));
    let mut shaft = Shaft::joined(places, element);
    hold(&mut shaft, &nodes, (before, before + numbers.len()));
    rotations.into_iter().for_each(|(node, motion)| shaft.rotate_by(node, motion));
    for i in (0..before).chain(throws.end..chain.len() - 1) {
        let (_, stiffness, dissipation) = &lengths[i];
        shaft.join_in_torsion(stations[i], *stiffness, *dissipation);
    }
    let rods: Vec<Vec<usize>> = own.pins.iter().map(|pins| rod_nodes(pins, crank.rods).map(|n| nodes.place[&n]).collect()).collect();
    carry((&mut shaft, &nodes), (crank, chain, spec), (&stations, &throws), &directions, (&rods, per_rod, carried));
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
        directions,
        bearings: own.bearings.iter().map(|points| points.iter().map(|n| nodes.place[n]).collect()).collect(),
        balance: Vec::new(),
        written: nodes.written(),
    })
}

/// Node of each rod of a throw.
fn rod_nodes(pins: &[u64], rods: usize) -> impl Iterator<Item = u64> {
    (0..rods).map(|rod| pins[rod.min(pins.len() - 1)])
}

/// Rotations of pins that have none of their own.
fn rotations(nodes: &Nodes, crank: &Crank, directions: &[[Vector3<f64>; 2]]) -> BTreeMap<usize, Answer> {
    let mut all = BTreeMap::new();
    for (pins, [_, tangential]) in nodes.own.pins.iter().zip(directions) {
        for pin in pins.iter().filter(|pin| !nodes.moves(**pin, 6)) {
            let along = tangential / crank.crank_radius;
            all.insert(nodes.place[pin], nodes.against_axis(*pin, &along));
        }
    }
    all
}

/// Twist of the journal in a bearing that is there, where its first and last points rotate about the axis.
fn twist_of_journal(nodes: &Nodes, crank: &Crank, bearing: usize) -> Option<Answer> {
    let before = (0..bearing).filter(|b| !crank.missing_bearings.contains(b)).count();
    let points = nodes.own.bearings.get(before).filter(|_| !crank.missing_bearings.contains(&bearing))?;
    let (first, last) = (points[0], points[points.len() - 1]);
    let both = first != last && [first, last].into_iter().all(|n| nodes.moves(n, 6));
    both.then(|| less(&unit(nodes.place[&first], 5), &unit(nodes.place[&last], 5)))
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

/// How a shaft of the chain dissipates by itself.
fn dissipation(s: &Station) -> Dissipation {
    let time = if s.stiffness_to_next > 0.0 { s.damping_to_next / s.stiffness_to_next } else { 0.0 };
    Dissipation { loss_factor: s.loss_factor_to_next, time }
}

/// Of each shaft of the chain a twist, its stiffness and how that dissipates; what the shafts of the crank lose by the chain is put on the element.
fn lengths(
    (nodes, spec, element): (&Nodes, &FlexibleSpec, &mut Superelement),
    (crank, chain, throws): (&Crank, &Chain, &Range<usize>),
    rotation: &dyn Fn(usize) -> Answer,
) -> Result<Vec<(Answer, f64, Dissipation)>, String> {
    let twisted = Twisted::new(nodes)?;
    let mut all = Vec::new();
    for (i, s) in chain.stations[..chain.len() - 1].iter().enumerate() {
        let (between, own) = (less(&rotation(i), &rotation(i + 1)), dissipation(s));
        if i + 1 < throws.start || i >= throws.end {
            all.push((between, s.stiffness_to_next, own));
            continue;
        }
        let stiffness = twisted.stiffness(&between, &s.name)?;
        element.tie(&between, [0.0, stiffness * own.loss_factor, stiffness * own.time]);
        let (twist, stiffness) = match twist_of_journal(nodes, crank, i + 1 - throws.start) {
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
fn places(nodes: &Nodes, numbers: &[u64], (before, behind): (usize, usize)) -> Vec<Vector3<f64>> {
    let place = |n: &u64| nodes.turn * nodes.own.structure.places[n];
    let mut all = vec![place(&nodes.own.hub); before];
    all.extend(numbers.iter().map(place));
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
    directions: &[[Vector3<f64>; 2]],
    (rods, per_rod, carried): (&[Vec<usize>], f64, Carried),
) {
    for (station, node) in stations.iter().enumerate() {
        let s = &chain.stations[station];
        if station + 1 < throws.start || station > throws.end {
            shaft.put_polar(*node, s.inertia);
        }
        let (motion, damping) = match directions.get(station.wrapping_sub(throws.start)) {
            Some([_, t]) => (Six::new(t.x, t.y, 0.0, 0.0, 0.0, 0.0), s.damping_to_ground / crank.crank_radius.powi(2)),
            None => (Six::new(0.0, 0.0, 0.0, 0.0, 0.0, 1.0), s.damping_to_ground),
        };
        shaft.tie(*node, &motion, (0.0, damping));
    }
    if carried == Carried::All {
        for node in rods.iter().flatten() {
            shaft.put(*node, &Body { mass: per_rod, arm: Vector3::zeros(), tensor: Matrix3::zeros() });
        }
        for (place, points) in nodes.own.bearings.iter().enumerate() {
            for (point, node) in points.iter().enumerate() {
                let own = spec.bearing.point(place, point, points.len());
                shaft.bear(nodes.place[node], (own.stiffness, own.damping));
            }
        }
        let along = Six::new(0.0, 0.0, 1.0, 0.0, 0.0, 0.0);
        shaft.tie(nodes.place[&nodes.own.thrust_node(crank, spec.thrust_at)], &along, (spec.thrust.stiffness, spec.thrust.damping));
    }
    if !spec.rotating {
        shaft.without_rotation();
    }
}
