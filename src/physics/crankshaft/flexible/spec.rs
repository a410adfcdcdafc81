//! What a flexible crank is made of beside dimensions and chain.

use super::imported::ImportedCrank;
use super::web_factors::WebFactors;
use crate::crankshaft::Crank;
use crate::drivetrain::throw_stiffness::Step;
use crate::rotor::body::Body;
use crate::rotor::exponential_joint::ExponentialJoint;
use nalgebra::{Matrix3, Vector3};
use std::sync::Arc;

/// Nodes of a main bearing along its journal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BearingNodes {
    /// Its middle.
    One,
    /// A third of its length before its middle, there, and as far behind.
    Three,
}

impl BearingNodes {
    /// Before the middle of a journal of a length, m.
    pub(super) fn before_middle(self, length: f64) -> Vec<f64> {
        if self == Self::Three { vec![-length / 3.0] } else { Vec::new() }
    }

    /// Behind it, m.
    pub(super) fn behind_middle(self, length: f64) -> Vec<f64> {
        if self == Self::Three { vec![length / 3.0] } else { Vec::new() }
    }

    /// How many.
    pub fn count(self) -> usize {
        if self == Self::Three { 3 } else { 1 }
    }
}

/// A bearing: stiffness N/m, damping N s/m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bearing {
    /// N/m.
    pub stiffness: f64,
    /// N s/m.
    pub damping: f64,
}

/// Main bearings as springs and dampers.
#[derive(Debug, Clone, PartialEq)]
pub enum LinearBearings {
    /// All alike: of a bearing, over all its points.
    Alike(Bearing),
    /// Of each point of each bearing that is there.
    Each(Vec<Vec<Bearing>>),
}

impl LinearBearings {
    /// Of a point of a bearing (by its place among those that are there) that has `points`.
    pub fn point(&self, bearing: usize, point: usize, points: usize) -> Bearing {
        match self {
            Self::Alike(b) => Bearing { stiffness: b.stiffness / points as f64, damping: b.damping / points as f64 },
            Self::Each(all) => all[bearing][point],
        }
    }

    /// The same with all stiffnesses and dampings times a factor each.
    #[must_use]
    pub fn times(&self, stiffness: f64, damping: f64) -> Self {
        let scaled = |b: &Bearing| Bearing { stiffness: b.stiffness * stiffness, damping: b.damping * damping };
        match self {
            Self::Alike(b) => Self::Alike(scaled(b)),
            Self::Each(all) => Self::Each(all.iter().map(|points| points.iter().map(scaled).collect()).collect()),
        }
    }
}

/// Main bearings that stiffen with the displacement of the journal ([`ExponentialJoint`]).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointSpec {
    /// Of the oil film over the journal at the reach of the law, Pa.
    pub pressure: f64,
    /// Reach over the diameter of the journal.
    pub clearance_ratio: f64,
    /// Stiffness and damping in the middle over those at the reach.
    pub loose: [f64; 2],
    /// Damping over stiffness at the reach, s.
    pub time: f64,
}

impl JointSpec {
    /// The law at each point of each main bearing that is there, all stiffness and damping times factors.
    pub fn joints(&self, crank: &Crank, nodes: BearingNodes, (stiffness, damping): (f64, f64)) -> Vec<ExponentialJoint> {
        let reach = self.clearance_ratio * crank.journal_diameter;
        let there = (0..=crank.throws()).filter(|b| !crank.missing_bearings.contains(b));
        let joint_at = |b: usize| {
            let size = [crank.journal_diameter, crank.journal_lengths[b]];
            ExponentialJoint::of_journal(self.pressure, size, reach, nodes.count(), (self.loose, self.time)).scaled(stiffness, damping)
        };
        there.flat_map(|b| std::iter::repeat_n(joint_at(b), nodes.count())).collect()
    }
}

/// What is at an end of the crank: the shaft from the end of the outer journal to the middle of the hub or flywheel, and what that weighs.
#[derive(Debug, Clone, PartialEq)]
pub struct End {
    /// From the journal outwards.
    pub shaft: Vec<Step>,
    /// kg.
    pub mass: f64,
    /// About a diameter, kg m².
    pub diametral_inertia: f64,
    /// What it carries beside that.
    pub ring: Option<CarriedRing>,
}

/// The ring of an absorber that its rubber or housing holds across the axis and against tilting, not against rotation about it: whatever absorber a design has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CarriedRing {
    /// kg.
    pub mass: f64,
    /// About a diameter, kg m².
    pub diametral_inertia: f64,
    /// About the axis, kg m²: it turns with the crank, which stiffens tilting.
    pub polar_inertia: f64,
}

impl CarriedRing {
    /// A body on the axis.
    pub(super) fn body(&self) -> Body {
        let tensor = Matrix3::from_diagonal(&Vector3::new(self.diametral_inertia, self.diametral_inertia, self.polar_inertia));
        Body { mass: self.mass, arm: Vector3::zeros(), tensor }
    }
}

/// A crank of beams and bodies, by its dimensions.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamCrank {
    /// Of every web.
    pub web_factors: WebFactors,
    /// Whether these were estimated.
    pub estimated: bool,
    /// kg/m³.
    pub density: f64,
    /// Before the first main bearing; nothing where the chain begins with a throw.
    pub front: Option<End>,
    /// Behind the last one.
    pub rear: Option<End>,
}

/// What the crank itself is computed by.
#[derive(Debug, Clone, PartialEq)]
pub enum CrankBody {
    /// Beams and bodies.
    Beams(BeamCrank),
    /// Matrices of another program.
    Matrices(Arc<ImportedCrank>),
}

/// What the flexible crank needs beside dimensions and chain.
#[derive(Debug, Clone, PartialEq)]
pub struct FlexibleSpec {
    /// Between its bearings, with hub and flywheel.
    pub body: CrankBody,
    /// Of the crank's steel and joints: its stiffness is k (1 + i eta).
    pub loss_factor: f64,
    /// Whether gyroscopic and centrifugal terms count.
    pub rotating: bool,
    /// Main bearings as they are in all that is linear.
    pub bearing: LinearBearings,
    /// The law behind them, where they have one.
    pub joints: Option<JointSpec>,
    /// Of a main bearing.
    pub nodes: BearingNodes,
    /// The main bearing (from 0) that holds the crank along its axis.
    pub thrust_at: usize,
    /// Along the axis.
    pub thrust: Bearing,
}

impl FlexibleSpec {
    /// The crank as beams; `None` by matrices of another program.
    pub fn beams(&self) -> Option<&BeamCrank> {
        match &self.body {
            CrankBody::Beams(own) => Some(own),
            CrankBody::Matrices(_) => None,
        }
    }

    /// The same to be changed.
    pub fn beams_mut(&mut self) -> Option<&mut BeamCrank> {
        match &mut self.body {
            CrankBody::Beams(own) => Some(own),
            CrankBody::Matrices(_) => None,
        }
    }
}
