//! The whole crank put together from beams and bodies.

use super::assembled::{Assembled, Balance, Carried, dissipation};
use super::round_section::round_sections;
use super::row::{Join, Material, Row};
use super::spec::{BeamCrank, BearingNodes, End, FlexibleSpec};
use super::throw::{self, Nodes, Turned, plate};
use super::web_section::WebSection;
use crate::crankshaft::Crank;
use crate::drivetrain::Chain;
use crate::rotor::body::Body;
use crate::rotor::shaft::{Dissipation, Shaft, Six};
use nalgebra::{Matrix3, Vector3};
use std::ops::Range;

/// Square of the radius of gyration of a sector of 120° about its axis over that of its centre: (1/2)/((2/3) sin 60°/(60° in rad))².
const SECTOR: f64 = 1.644_934_066_848_226_4;
/// A counterweight whose centre would be nearer to the axis than this share of the throw's radius is none.
const NEAREST: f64 = 0.4;
/// The steel of a throw may be made less dense down to this share, so that it has the inertia of its station.
const LIGHTEST: f64 = 0.3;
/// Longest element of the shafts at the ends, m.
const LONGEST: f64 = 0.05;

/// Elements of the shaft outside an outer journal, up to the middle of what is on its end.
fn end_shaft(row: &mut Row, material: Material, steps: impl Iterator<Item = crate::drivetrain::throw_stiffness::Step>) {
    for step in steps {
        let (start, pieces) = (row.places[row.last()].z, (step.length / LONGEST).ceil().max(1.0));
        for k in 1..=pieces as usize {
            row.along(start + step.length * k as f64 / pieces, material.round(&step, 1.0));
        }
    }
}

/// Part of a row, with its bodies.
fn part(row: &Row, nodes: Range<usize>) -> Shaft {
    let inside = |(node, body): &(usize, Body)| nodes.contains(node).then(|| (node - nodes.start, body.clone()));
    Row {
        places: row.places[nodes.start..=nodes.end].to_vec(),
        joins: row.joins[nodes.clone()].to_vec(),
        bodies: row.bodies.iter().filter_map(inside).collect(),
    }
    .shaft()
}

/// Inertia about the axis, kg m², of what lies between two nodes.
fn polar(row: &Row, nodes: Range<usize>) -> f64 {
    let shaft = part(row, nodes);
    let rotation = shaft.rigid_rotation();
    shaft.kinetic(&rotation, &rotation)
}

/// Mass times distance from the axis towards the pin, kg m, of what lies between two nodes.
fn moment(row: &Row, nodes: Range<usize>, tangential: Vector3<f64>) -> f64 {
    let shaft = part(row, nodes);
    let translation = vec![Six::new(tangential.x, tangential.y, 0.0, 0.0, 0.0, 0.0); shaft.len()];
    shaft.kinetic(&translation, &shaft.rigid_rotation())
}

/// Nodes of an assembly.
struct Built {
    row: Row,
    stations: Vec<usize>,
    /// First and last node that bends.
    bends: Range<usize>,
    throws: Vec<Nodes>,
    bearings: Vec<Vec<usize>>,
    middles: Vec<usize>,
}

/// All nodes, beams and the bodies of the throws; `densities`: a factor for each throw.
fn build(
    (crank, chain): (&Crank, &Chain),
    (spec, beams): (&FlexibleSpec, &BeamCrank),
    throws: &Range<usize>,
    (angles, per_rod): (&[f64], f64),
    densities: &[f64],
) -> Built {
    let material = Material { young_modulus: crank.young_modulus, density: beams.density };
    let (first, last) = (crank.journal_lengths[0], crank.journal_lengths[crank.throws()]);
    let length = |end: &Option<End>| end.as_ref().map_or(0.0, |e| e.shaft.iter().map(|s| s.length).sum());
    let spring = |station: usize| {
        let s = &chain.stations[station];
        (s.stiffness_to_next, dissipation(s))
    };
    let mut row = Row::from(Vector3::new(0.0, 0.0, -0.5 * first - length(&beams.front)));
    let mut stations = vec![0];
    // stations before the hub only turn
    for station in 0..throws.start.saturating_sub(1) {
        let (stiffness, dissipation) = spring(station);
        stations.push(row.turning(stiffness, dissipation));
    }
    let bends_from = row.last();
    if throws.start == 0 {
        stations.clear();
    }
    end_shaft(&mut row, material, beams.front.iter().flat_map(|e| e.shaft.iter().rev().copied()));
    let journal = material.round(&crank.throw(0).journal, 1.0);
    let mut bearing: Vec<usize> = spec.nodes.before_middle(first).into_iter().map(|offset| row.along(offset, journal)).collect();
    bearing.push(row.along(0.0, journal));
    let (mut bearings, mut middles, mut nodes) = (vec![bearing], vec![row.last()], Vec::new());
    for (t, density) in densities.iter().enumerate() {
        let own = Material { density: beams.density * density, ..material };
        let turned = Turned { throw: t, angle: angles[t] };
        let found = throw::add(&mut row, crank, (own, &beams.web_factors), turned, spec.nodes, per_rod);
        stations.push(found.pin);
        bearings.push(found.bearing.clone());
        middles.push(found.middle);
        nodes.push(found);
    }
    let start = row.places[row.last()].z;
    for offset in spec.nodes.behind_middle(last).into_iter().chain([0.5 * last]) {
        row.along(start + offset, journal);
    }
    if spec.nodes == BearingNodes::Three {
        for (bearing, middle) in bearings.iter_mut().zip(&middles) {
            bearing.push(middle + 1);
        }
    }
    end_shaft(&mut row, material, beams.rear.iter().flat_map(|e| e.shaft.iter().copied()));
    let bends = bends_from..row.last();
    if throws.end < chain.len() {
        stations.push(row.last());
    }
    for station in throws.end..chain.len().saturating_sub(1) {
        let (stiffness, dissipation) = spring(station);
        stations.push(row.turning(stiffness, dissipation));
    }
    // losses of the crank's own steel, and between its stations those of the chain's shafts
    for join in &mut row.joins {
        if let Join::Beam(_, dissipation) = join {
            dissipation.loss_factor = spec.loss_factor;
        }
    }
    for (shaft, ends) in stations.windows(2).enumerate().filter(|(i, _)| i + 1 >= throws.start && *i < throws.end) {
        let (_, own) = spring(shaft);
        for join in &mut row.joins[ends[0]..ends[1]] {
            if let Join::Beam(_, dissipation) = join {
                *dissipation = Dissipation { loss_factor: own.loss_factor + spec.loss_factor, time: own.time };
            }
        }
    }
    Built { row, stations, bends, throws: nodes, bearings, middles }
}

/// Puts a crank of beams together on the stations of a chain; `angles` of its throws, rad, and the mass of each rod on its pin, kg.
pub(super) fn assemble(
    (crank, chain): (&Crank, &Chain),
    (beams, spec, carried): (&BeamCrank, &FlexibleSpec, Carried),
    throws: Range<usize>,
    (angles, per_rod): (&[f64], f64),
) -> Result<Assembled, String> {
    let on_pin = per_rod * crank.rods as f64 * crank.crank_radius.powi(2);
    let drawn = build((crank, chain), (spec, beams), &throws, (angles, per_rod), &vec![1.0; crank.throws()]);
    let between = |t: usize| drawn.middles[t]..drawn.middles[t + 1];
    let mut balance: Vec<Balance> = Vec::new();
    for t in 0..crank.throws() {
        let (steel, station) = (polar(&drawn.row, between(t)) - on_pin, chain.stations[throws.start + t].inertia);
        let lacks = station - steel - on_pin;
        let density = if lacks < 0.0 { 1.0 + lacks / steel } else { 1.0 };
        if density < LIGHTEST {
            return Err(format!(
                "throw {}: pin, webs and journals have {steel:.4} kg m² and what is on the pin {on_pin:.4}, its station {station:.4} in all",
                t + 1
            ));
        }
        balance.push(Balance { steel, on_pin, station, counterweight: 0.0, density, left_out: 0.0 });
    }
    let densities: Vec<f64> = balance.iter().map(|b| b.density).collect();
    let on_rods = if carried == Carried::All { per_rod } else { 0.0 };
    let mut built = build((crank, chain), (spec, beams), &throws, (angles, on_rods), &densities);
    let directions: Vec<_> = angles.iter().enumerate().map(|(t, angle)| Turned { throw: t, angle: *angle }.directions()).collect();
    let mut polars = Vec::new();
    for (t, balance) in balance.iter_mut().enumerate() {
        let lacks = (balance.station - balance.steel - on_pin).max(0.0);
        let [outwards, tangential] = directions[t];
        let nodes = built.middles[t]..built.middles[t + 1];
        let needed = moment(&built.row, nodes, tangential) - on_rods * crank.rods as f64 * crank.crank_radius - crank.unbalance;
        let centre = lacks / (SECTOR * needed);
        let webs = built.throws[t].webs;
        if needed > 0.0 && centre >= NEAREST * crank.crank_radius {
            balance.counterweight = needed / centre;
            let mass = 0.5 * balance.counterweight;
            let spread = 0.5 * mass * (SECTOR - 1.0) * centre * centre;
            let tensor = plate(-outwards, (spread, spread), mass * crank.web_thickness.powi(2) / 12.0);
            webs.into_iter().for_each(|node| built.row.put(node, Body { mass, arm: -outwards * centre, tensor }));
        } else {
            balance.left_out = needed.max(0.0);
            polars.extend(webs.map(|node| (node, 0.5 * lacks)));
        }
    }
    finished((crank, chain), (spec, beams, carried), (built, polars), throws, (directions, balance))
}

/// The webs of a throw cut in their middle.
fn sections(row: &Row, [front, rear]: [usize; 2], directions: &[Vector3<f64>; 2]) -> [WebSection; 2] {
    [front, rear - 2].map(|first| WebSection::new(first, &row.joins[first..first + 2], directions))
}

/// Puts hub and flywheel on their nodes; returns the rings that they carry.
fn put_ends(
    (crank, chain): (&Crank, &Chain),
    (beams, carried): (&BeamCrank, Carried),
    built: &mut Built,
    throws: &Range<usize>,
) -> Result<Vec<(usize, Body)>, String> {
    let last = built.middles[crank.throws()];
    let sides = [
        (beams.front.as_ref(), throws.start.checked_sub(1), built.bends.start..built.middles[0]),
        (beams.rear.as_ref(), Some(throws.end).filter(|s| *s < chain.len()), last..built.bends.end),
    ];
    let mut rings = Vec::new();
    for (end, station, nodes) in sides {
        let Some((end, station)) = end.zip(station) else { continue };
        let (own, inertia) = (polar(&built.row, nodes), chain.stations[station].inertia);
        if own >= inertia {
            return Err(format!("the shaft to {} has {own:.4} kg m² by itself, its station {inertia:.4}", chain.stations[station].name));
        }
        if carried == Carried::Nothing {
            continue;
        }
        let tensor = Matrix3::from_diagonal(&Vector3::new(end.diametral_inertia, end.diametral_inertia, inertia - own));
        built.row.put(built.stations[station], Body { mass: end.mass, arm: Vector3::zeros(), tensor });
        rings.extend(end.ring.map(|ring| (built.stations[station], ring.body())));
    }
    Ok(rings)
}

/// Hub and flywheel, bearings, ties to the ground, and what only turns.
fn finished(
    (crank, chain): (&Crank, &Chain),
    (spec, beams, carried): (&FlexibleSpec, &BeamCrank, Carried),
    (mut built, polars): (Built, Vec<(usize, f64)>),
    throws: Range<usize>,
    (directions, balance): (Vec<[Vector3<f64>; 2]>, Vec<Balance>),
) -> Result<Assembled, String> {
    let rings = put_ends((crank, chain), (beams, carried), &mut built, &throws)?;
    let mut shaft = built.row.shaft();
    rings.iter().for_each(|(node, body)| shaft.carry(*node, body));
    polars.into_iter().for_each(|(node, inertia)| shaft.put_polar(node, inertia));
    for (station, node) in built.stations.iter().enumerate() {
        let s = &chain.stations[station];
        let about_axis = Six::new(0.0, 0.0, 0.0, 0.0, 0.0, 1.0);
        let beside = throws.start.saturating_sub(1)..(throws.end + 1).min(chain.len());
        if !beside.contains(&station) {
            shaft.put_polar(*node, s.inertia);
            shaft.hold(*node, [true, true, true, true, true, false]);
        }
        if carried == Carried::All {
            shaft.tie(*node, &about_axis, (s.stiffness_to_ground, 0.0));
        }
        let (motion, damping) = match directions.get(station.wrapping_sub(throws.start)) {
            // what damps a throw acts on its pin
            Some([_, t]) => (Six::new(t.x, t.y, 0.0, 0.0, 0.0, 0.0), s.damping_to_ground / crank.crank_radius.powi(2)),
            None => (about_axis, s.damping_to_ground),
        };
        shaft.tie(*node, &motion, (0.0, damping));
    }
    let present: Vec<usize> = (0..=crank.throws()).filter(|b| !crank.missing_bearings.contains(b)).collect();
    for (place, bearing) in present.iter().enumerate().filter(|_| carried == Carried::All) {
        let nodes = &built.bearings[*bearing];
        for (point, node) in nodes.iter().enumerate() {
            let own = spec.bearing.point(place, point, nodes.len());
            shaft.bear(*node, (own.stiffness, own.damping));
        }
    }
    if carried == Carried::All {
        let along = Six::new(0.0, 0.0, 1.0, 0.0, 0.0, 0.0);
        shaft.tie(built.middles[spec.thrust_at], &along, (spec.thrust.stiffness, spec.thrust.damping));
    }
    if !spec.rotating {
        shaft.without_rotation();
    }
    let translation = vec![Six::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0); shaft.len()];
    let torsion = |first: usize| {
        let (stiffness, dissipation) = built.row.joins[first].torsion();
        (vec![(first, 5, 1.0), (first + 1, 5, -1.0)], stiffness, dissipation)
    };
    // the middle of the bearing between two throws; beside hub and flywheel the journal there
    let shafts = (0..chain.len() - 1).map(|i| match (i + 1).checked_sub(throws.start) {
        Some(b) if b <= crank.throws() => torsion(built.middles[b].min(built.row.joins.len() - 1)),
        _ => torsion(built.stations[i]),
    });
    Ok(Assembled {
        shafts: shafts.collect(),
        sections: built.throws.iter().zip(&directions).map(|(t, d)| sections(&built.row, t.webs, d)).collect(),
        rounds: built.throws.iter().zip(&directions).map(|(t, d)| round_sections(&built.row, t.webs, d)).collect(),
        rods: built.throws.iter().map(|t| t.rods.clone()).collect(),
        webs: built.throws.iter().map(|t| t.webs).collect(),
        bearings: present.iter().map(|b| built.bearings[*b].clone()).collect(),
        journals: built.bearings,
        throws,
        mass: shaft.kinetic(&translation, &translation),
        stations: built.stations,
        written: Vec::new(),
        directions,
        balance,
        shaft,
    })
}
