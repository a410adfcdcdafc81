//! What a flexible crank is made of beside dimensions and chain.

use super::web_factors::WebFactors;
use crate::drivetrain::throw_stiffness::Step;

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

/// What is at an end of the crank: the shaft from the end of the outer journal to the middle of the hub or flywheel, and what that weighs.
#[derive(Debug, Clone, PartialEq)]
pub struct End {
    /// From the journal outwards.
    pub shaft: Vec<Step>,
    /// kg.
    pub mass: f64,
    /// About a diameter, kg m².
    pub diametral_inertia: f64,
}

/// What the flexible crank needs beside dimensions and chain.
#[derive(Debug, Clone, PartialEq)]
pub struct FlexibleSpec {
    /// Of every web.
    pub web_factors: WebFactors,
    /// Whether these were estimated.
    pub estimated: bool,
    /// kg/m³.
    pub density: f64,
    /// Of the crank's steel and joints: its stiffness is k (1 + i eta).
    pub loss_factor: f64,
    /// Whether gyroscopic and centrifugal terms count.
    pub rotating: bool,
    /// Of each main bearing, over all its nodes.
    pub bearing: Bearing,
    /// Of a main bearing.
    pub nodes: BearingNodes,
    /// The main bearing (from 0) that holds the crank along its axis.
    pub thrust_at: usize,
    /// Along the axis.
    pub thrust: Bearing,
    /// Before the first main bearing; nothing where the chain begins with a throw.
    pub front: Option<End>,
    /// Behind the last one.
    pub rear: Option<End>,
}
