//! One throw as beams and bodies, from the middle of a bearing to that of the next.

use super::row::{Material, Row};
use super::spec::BearingNodes;
use super::web_factors::WebFactors;
use crate::crankshaft::Crank;
use crate::drivetrain::throw_stiffness::Step;
use crate::numerics::elementary::Elementary;
use crate::rotor::body::Body;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

/// Where a throw stands: its number from 0 and the angle of its pin in turning axes, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turned {
    pub throw: usize,
    pub angle: f64,
}

impl Turned {
    /// Outwards from the axis to the pin, and in the direction of rotation.
    pub(super) fn directions(self) -> [Vector3<f64>; 2] {
        let (sine, cosine) = self.angle.sine_cosine();
        [Vector3::new(cosine, sine, 0.0), Vector3::new(-sine, cosine, 0.0)]
    }
}

/// Nodes of a throw in the row.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Nodes {
    /// Middle of each rod.
    pub rods: Vec<usize>,
    /// Middle of the pin.
    pub pin: usize,
    /// Both webs on the axis.
    pub webs: [usize; 2],
    /// Bearing points of the journal behind the throw, its middle in `middle`.
    pub bearing: Vec<usize>,
    /// Middle of the bearing behind it.
    pub middle: usize,
}

/// Half of a disc of the webs' breadth at the end of a web, beyond the axis on its side: `outwards` towards it.
fn half_disc(crank: &Crank, material: Material, outwards: Vector3<f64>) -> Body {
    let (r, w) = (0.5 * crank.web_breadth, crank.web_thickness);
    let mass = material.density * w * 0.5 * PI * r * r;
    let centre = 4.0 * r / (3.0 * PI);
    let across = 0.25 * mass * r * r;
    Body { mass, arm: outwards * centre, tensor: plate(outwards, (across - mass * centre * centre, across), mass * w * w / 12.0) }
}

/// Tensor of a plate that lies across the axis, by its integrals of squares along `outwards`, across it, and along the axis.
pub(super) fn plate(outwards: Vector3<f64>, (along_outwards, across_outwards): (f64, f64), thick: f64) -> Matrix3<f64> {
    let tangential = Vector3::z().cross(&outwards);
    // about outwards: squares across it and along the axis
    outwards * outwards.transpose() * (across_outwards + thick)
        + tangential * tangential.transpose() * (along_outwards + thick)
        + Vector3::z() * Vector3::z().transpose() * (along_outwards + across_outwards)
}

/// Adds a throw behind the middle of a bearing, whose node is the last of the row. `pin_masses`: of each rod on the pin, kg.
pub(super) fn add(
    row: &mut Row,
    crank: &Crank,
    (material, factors): (Material, &WebFactors),
    turned: Turned,
    nodes: BearingNodes,
    per_rod: f64,
) -> Nodes {
    let Turned { throw, .. } = turned;
    let [outwards, _] = turned.directions();
    let start = row.places[row.last()].z;
    let (before, behind) = (crank.journal_lengths[throw], crank.journal_lengths[throw + 1]);
    let (w, r) = (crank.web_thickness, crank.crank_radius);
    let journal = |length: f64| Step { diameter: crank.journal_diameter, bore: crank.journal_bore, length };
    let pin = Step { diameter: crank.pin_diameter, bore: crank.pin_bore, length: crank.pin_length };
    let (journal, pin) = (material.round(&journal(1.0), 1.0), material.round(&pin, 1.0));
    let light = Material { density: 0.0, ..material };
    let stub = |diameter: f64, bore: f64| light.round(&Step { diameter, bore, length: 1.0 }, 2.0);
    let (journal_stub, pin_stub) = (stub(crank.journal_diameter, crank.journal_bore), stub(crank.pin_diameter, crank.pin_bore));
    let web = material.web((w, crank.web_breadth), factors);
    // half of what is on the pin pulls at each web, and what of the web itself lies outside
    let half_pin = 0.5 * (pin.mass * crank.pin_length + per_rod * crank.rods as f64) * r;
    let disc = half_disc(crank, material, outwards);
    let pull = |inner: f64, outer: f64| {
        // mean over the element of what the web itself pulls, which falls with the square of the distance
        let mean_square = (inner * inner + inner * outer + outer * outer) / 3.0;
        half_pin + disc.mass * (r + disc.arm.norm()) + web.mass * 0.5 * (r * r - mean_square)
    };
    let on_axis = |z: f64| Vector3::new(0.0, 0.0, z);
    let mut z = start + 0.5 * before;
    nodes.behind_middle(before).into_iter().for_each(|offset| {
        row.along(start + offset, journal);
    });
    row.along(z, journal);
    let web_places = |z: f64| [on_axis(z), on_axis(z) + outwards * (0.5 * r), on_axis(z) + outwards * r];
    let front = row.along(z + 0.5 * w, journal_stub);
    let [_, middle, top] = web_places(z + 0.5 * w);
    row.across(middle, web, pull(0.0, 0.5 * r));
    let front_pin = row.across(top, web, pull(0.5 * r, r));
    row.along(z + w, pin_stub);
    z += w;
    let mut rods = Vec::new();
    let middles: Vec<f64> = crank.rod_places(throw).iter().map(|at| at - crank.places(throw)[1]).collect();
    let centre = z + 0.5 * crank.pin_length;
    let mut at_middle = None;
    let mut stops: Vec<(f64, bool)> = middles.iter().map(|m| (*m, true)).collect();
    if !stops.iter().any(|s| s.0 == 0.0) {
        stops.push((0.0, false));
    }
    stops.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (offset, is_rod) in stops {
        let node = if centre + offset > row.places[row.last()].z { row.along(centre + offset, pin) } else { row.last() };
        if is_rod {
            rods.push(node);
        }
        if offset == 0.0 {
            at_middle = Some(node);
        }
    }
    z += crank.pin_length;
    row.along(z, pin);
    let rear_pin = row.along(z + 0.5 * w, pin_stub);
    let [axis, middle, _] = web_places(z + 0.5 * w);
    row.across(middle, web, pull(0.5 * r, r));
    let rear = row.across(axis, web, pull(0.0, 0.5 * r));
    z += w;
    row.along(z, journal_stub);
    let mut bearing: Vec<usize> =
        nodes.before_middle(behind).into_iter().map(|offset| row.along(z + 0.5 * behind + offset, journal)).collect();
    let last = row.along(z + 0.5 * behind, journal);
    bearing.push(last);
    for (node, is_pin) in [(front, false), (front_pin, true), (rear_pin, true), (rear, false)] {
        row.put(node, half_disc(crank, material, if is_pin { outwards } else { -outwards }));
    }
    let pin_node = at_middle.unwrap_or(front_pin);
    rods.iter().for_each(|node| row.put(*node, Body::point(per_rod)));
    Nodes { rods, pin: pin_node, webs: [front, rear], bearing, middle: last }
}
