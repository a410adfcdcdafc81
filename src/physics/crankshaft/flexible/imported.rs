//! Matrices of a crank from another program: what their nodes are, and whether they fit the crank of a study.

use crate::crankshaft::Crank;
use crate::drivetrain::Chain;
use crate::numerics::elementary::Elementary;
use crate::numerics::significant::significant;
use crate::rotor::structure::{Structure, Unknown};
use crate::rotor::structure_checks::OfChain;
use nalgebra::{DMatrix, Vector3};
use std::f64::consts::PI;
use std::ops::Range;

/// By what share the radius of a pin may differ from that of the crank, and by how much its angle, rad.
const RADIUS: f64 = 0.01;
const ANGLE: f64 = 0.02;
/// How far beside the axis what lies on it may be, of the radius of the crank.
const BESIDE: f64 = 0.02;
/// By what share of the mass the forces of turning axes on rigid translation may differ.
const TRANSLATION: f64 = 1e-3;
/// By what share inertia about the axis may differ from that of the stations.
const INERTIA: f64 = 0.3;

/// Matrices of a crank, and what its nodes are.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedCrank {
    /// SI, z along the crank from the hub to the flywheel.
    pub structure: Structure,
    /// Middle of the hub.
    pub hub: u64,
    /// Middle of the flywheel.
    pub flywheel: u64,
    /// Of each throw: its pin, or a node for each rod.
    pub pins: Vec<Vec<u64>>,
    /// Points of each main journal; where there is no bearing they carry nothing.
    pub journals: Vec<Vec<u64>>,
    /// What each unknown is in the files.
    pub written: Vec<Written>,
}

/// An unknown as the files have it: axes along the crank are theirs in turn, lengths may be in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Written {
    /// Its node and component there.
    pub unknown: Unknown,
    /// Its value there over that in SI.
    pub scale: f64,
}

impl ImportedCrank {
    pub(super) fn place(&self, node: u64) -> Vector3<f64> {
        self.structure.places[&node]
    }

    /// What of the nodes cannot be, in words: one that has no place or does not move as it has to.
    pub(super) fn mistaken(&self, (crank, chain): (&Crank, &Chain), throws: &Range<usize>, thrust_at: usize) -> Option<String> {
        let counts = [(self.pins.len(), crank.throws(), "throws with pins"), (self.journals.len(), crank.throws() + 1, "main journals")];
        if let Some((found, wanted, what)) = counts.into_iter().find(|c| c.0 != c.1) {
            return Some(format!("{found} {what}, where the crank has {wanted}"));
        }
        if throws.start == 0 || throws.end == chain.len() {
            return Some("the chain begins or ends with a throw: matrices want stations for hub and flywheel".into());
        }
        if let Some((t, pins)) = self.pins.iter().enumerate().find(|(_, pins)| pins.len() != 1 && pins.len() != crank.rods) {
            return Some(format!("throw {} has {} nodes for its {} rods: one, or one a rod", t + 1, pins.len(), crank.rods));
        }
        if let Some((j, points)) = self.journals.iter().enumerate().find(|j| j.1.len().is_multiple_of(2)) {
            return Some(format!(
                "main journal {} has {} nodes, expected an odd number: the one in the middle is that of the journal",
                j + 1,
                points.len()
            ));
        }
        let ends = [(self.hub, "the hub"), (self.flywheel, "the flywheel")];
        let pins = self.pins.iter().flatten().map(|n| (*n, 1..=3, "a pin"));
        let points = self.journals.iter().flatten().map(|n| (*n, 1..=2, "a point of a journal"));
        let mut wanted = ends.into_iter().map(|(n, what)| (n, 1..=6, what)).chain(pins).chain(points);
        let moves = |node: u64, component: u8| self.structure.unknowns.contains(&Unknown { node, component });
        let lacks = wanted.find_map(|(n, mut components, what)| components.find(|c| !moves(n, *c)).map(|c| (n, c, what)));
        if let Some((node, component, what)) = lacks {
            return Some(format!("node {node}, {what}, has no component {component} in the matrices"));
        }
        if let Some(u) = self.structure.unknowns.iter().find(|u| u.component > 0 && !self.structure.places.contains_key(&u.node)) {
            return Some(format!("node {} has no place", u.node));
        }
        let pairs = [(1, 2), (2, 1), (4, 5), (5, 4)];
        let half = |u: &&Unknown| pairs.iter().any(|p| u.component == p.0 && !moves(u.node, p.1));
        if let Some(u) = self.structure.unknowns.iter().find(half) {
            return Some(format!("node {} moves along or about one axis across the crank and not the other", u.node));
        }
        let thrust = self.thrust_node(thrust_at);
        if !moves(thrust, 3) {
            return Some(format!("node {thrust}, the middle of the thrust bearing, has no component 3 in the matrices"));
        }
        self.out_of_order().or_else(|| self.beside_axis(crank.crank_radius))
    }

    /// In words, two nodes that do not follow each other along the crank.
    fn out_of_order(&self) -> Option<String> {
        let mut order = vec![self.hub];
        for (j, points) in self.journals.iter().enumerate() {
            order.extend(points.iter().chain(self.pins.get(j).into_iter().flatten()));
        }
        order.push(self.flywheel);
        order.windows(2).find(|two| self.place(two[0]).z >= self.place(two[1]).z).map(|two| {
            format!(
                "node {} does not lie before node {} along z: from the hub journals and pins follow each other to the flywheel, points and rods of each in turn",
                two[0], two[1]
            )
        })
    }

    /// In words, a node beside the axis that should be on it.
    fn beside_axis(&self, radius: f64) -> Option<String> {
        let mut on_axis = self.journals.iter().flatten().chain([&self.hub, &self.flywheel]);
        let off = |node: u64| self.place(node).x.hypotenuse(self.place(node).y);
        let found = on_axis.find(|node| off(**node) > BESIDE * radius)?;
        Some(format!("node {found} lies {:.4} mm beside the axis, where journals, hub and flywheel lie on it", off(*found) * 1e3))
    }

    /// Whether the twist of a main journal tells the torque there: its outer points rotate about the axis.
    #[doc(hidden)]
    pub fn tells_torque(&self, journal: usize) -> bool {
        let points = &self.journals[journal];
        let rotates = |node: u64| self.structure.unknowns.contains(&Unknown { node, component: 6 });
        points.len() > 1 && rotates(points[0]) && rotates(points[points.len() - 1])
    }

    /// In words, what turning axes do to rigid translation, where it is not as mass has it: centrifugal forces -m across the axis and none along it, Coriolis forces 2 m.
    #[doc(hidden)]
    pub fn turns_wrongly(&self) -> Option<String> {
        let s = &self.structure;
        let (rigid, mass) = (s.rigid_motions()?, s.mass.as_ref()?);
        let on = |x: &DMatrix<f64>, i: usize, j: usize| (rigid.column(i).transpose() * x * rigid.column(j))[(0, 0)];
        let m = on(mass, 0, 0);
        let wrong = |found: f64, wanted: f64| found.is_nan() || (found - wanted).abs() > TRANSLATION * m;
        let t = s.turning.as_ref()?;
        let along = [on(t, 0, 0), on(t, 1, 1), on(t, 2, 2)];
        if along.iter().zip([-m, -m, 0.0]).any(|(found, wanted)| wrong(*found, wanted)) {
            let [x, y, z] = along.map(|x| significant(x, 5));
            return Some(format!(
                "`turning` has {x}, {y} and {z} kg against translation along x, y and z, expected minus the mass, {}, twice and zero",
                significant(m, 5)
            ));
        }
        let coriolis = on(s.gyroscopic.as_ref()?, 1, 0);
        wrong(coriolis, 2.0 * m).then(|| {
            format!(
                "`gyroscopic` has {} kg between translations along y and x, expected twice the mass, {}",
                significant(coriolis, 5),
                significant(2.0 * m, 5)
            )
        })
    }

    /// Middle point of the thrust bearing.
    pub(super) fn thrust_node(&self, thrust_at: usize) -> u64 {
        let points = &self.journals[thrust_at];
        points[points.len() / 2]
    }

    /// How far the pins are turned from the angles of a layout, rad; in words where radius or angle of one is another.
    pub(super) fn turned(&self, crank: &Crank, angles: &[f64]) -> Result<f64, String> {
        let mut first = None;
        for (t, angle) in angles.iter().enumerate() {
            for node in &self.pins[t] {
                let p = self.place(*node);
                let radius = p.x.hypotenuse(p.y);
                if (radius / crank.crank_radius - 1.0).abs() > RADIUS {
                    let mm = |x: f64| x * 1e3;
                    return Err(format!(
                        "the pin of throw {} is {:.4} mm from the axis, the radius of the crank {:.4} mm",
                        t + 1,
                        mm(radius),
                        mm(crank.crank_radius)
                    ));
                }
                let own = p.y.arctangent(p.x) - angle;
                let off = own - *first.get_or_insert(own);
                let off = off - 2.0 * PI * (off / (2.0 * PI)).round();
                if off.abs() > ANGLE {
                    let deg = off.to_degrees();
                    return Err(format!(
                        "the pin of throw {} stands {deg:.2}° from where the layout has it, seen from throw 1, positive in the direction of rotation",
                        t + 1
                    ));
                }
            }
        }
        Ok(first.unwrap_or(0.0))
    }

    /// What the stations from hub to flywheel have to set beside the matrices: their inertia less that of the rods, of `per_rod` kg each on its pin, and their stiffness.
    #[doc(hidden)]
    pub fn of_chain(&self, (crank, chain): (&Crank, &Chain), throws: &Range<usize>, per_rod: f64) -> OfChain {
        let stations = &chain.stations[throws.start - 1..=throws.end];
        let rods = per_rod * (crank.rods * crank.throws()) as f64 * crank.crank_radius.powi(2);
        let compliance: f64 = stations[..stations.len() - 1].iter().map(|s| 1.0 / s.stiffness_to_next).sum();
        OfChain { inertia: stations.iter().map(|s| s.inertia).sum::<f64>() - rods, stiffness: 1.0 / compliance }
    }

    /// In words, how the inertia about the axis goes with that of the stations, where it is far off.
    pub(super) fn inertia_differs(&self, chain: OfChain) -> Option<String> {
        let rigid = self.structure.rigid_motions()?;
        let own = (rigid.transpose() * self.structure.mass.as_ref()? * rigid)[(5, 5)];
        ((own / chain.inertia - 1.0).abs() > INERTIA).then(|| {
            format!(
                "the matrices have {own:.4} kg m² about the axis, the stations from hub to flywheel without rods {:.4}: matrices of other units, or without hub and flywheel?",
                chain.inertia
            )
        })
    }
}
