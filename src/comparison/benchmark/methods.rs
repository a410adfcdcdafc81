//! The response methods with their settings, as `chart` compares them.

use crate::absorber::Mounted;
use crate::absorber::mounted::station_of;
use crate::drivetrain::System;
use crate::response::{ClosedForm, Dense, Direct, Exponential, Grid, Holzer, Modal, Newmark, Quantity, Receptance, Reduced, Response};

/// A method with a setting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Candidate {
    /// Complex tridiagonal.
    Direct,
    /// Rank-one change of a base solved once.
    Receptance,
    /// One elastic mode and one absorber.
    ClosedForm,
    /// So many elastic modes, absorbers exact.
    Reduced(usize),
    /// Real modes, diagonal damping.
    Modal,
    /// Transfer matrices.
    Holzer,
    /// Newmark, average acceleration, so many steps a cycle.
    Average(usize),
    /// Newmark, linear acceleration.
    Linear(usize),
    /// Newmark, central difference.
    Central(usize),
    /// Matrix exponential, so many steps a cycle.
    Exponential(usize),
    /// Dense LU.
    Dense,
}

/// Steps a cycle of the methods in time.
const STEPS: usize = 720;

impl Candidate {
    /// All that are compared.
    pub const ALL: [Self; 13] = [
        Self::Direct,
        Self::Receptance,
        Self::ClosedForm,
        Self::Reduced(1),
        Self::Reduced(2),
        Self::Reduced(3),
        Self::Modal,
        Self::Holzer,
        Self::Average(STEPS),
        Self::Linear(STEPS),
        Self::Central(STEPS),
        Self::Exponential(STEPS),
        Self::Dense,
    ];

    /// Whether it marches in time.
    pub fn in_time(self) -> bool {
        matches!(self, Self::Average(_) | Self::Linear(_) | Self::Central(_) | Self::Exponential(_))
    }

    /// Word of the method.
    pub fn method(self) -> &'static str {
        match self {
            Self::Direct => "direct",
            Self::Receptance => "receptance",
            Self::ClosedForm => "closed_form",
            Self::Reduced(_) => "reduced",
            Self::Modal => "modal",
            Self::Holzer => "holzer",
            Self::Average(_) | Self::Linear(_) | Self::Central(_) => "newmark",
            Self::Exponential(_) => "exponential",
            Self::Dense => "dense",
        }
    }

    /// Its setting, where it has one.
    pub fn setting(self) -> Option<String> {
        match self {
            Self::Reduced(1) => Some("1 mode".into()),
            Self::Reduced(n) => Some(format!("{n} modes")),
            Self::Average(_) => Some("average".into()),
            Self::Linear(_) => Some("linear".into()),
            Self::Central(_) => Some("central".into()),
            _ => None,
        }
    }

    /// Method and setting, for labels.
    pub fn label(self) -> String {
        let method = self.method().replace('_', " ");
        self.setting().map_or_else(|| method.clone(), |s| format!("{method}, {s}"))
    }

    /// The method for a system; nothing where it has none (a closed form without an elastic mode). `design`: one it is to be used for.
    pub fn build<'a>(self, system: &'a System, grid: &'a Grid, design: &[Mounted], quantity: Quantity) -> Option<Box<dyn Response + 'a>> {
        let station = if design.is_empty() { 0 } else { station_of(design, 0) };
        Some(match self {
            Self::Direct => Box::new(Direct::new(system, grid)),
            Self::Receptance => Box::new(Receptance::new(system, grid, station, &[quantity])),
            Self::ClosedForm => Box::new(ClosedForm::new(system, grid)?),
            Self::Reduced(n) => Box::new(Reduced::new(system, grid, n)),
            Self::Modal => Box::new(Modal::new(system, grid)),
            Self::Holzer => Box::new(Holzer::new(system, grid)),
            Self::Average(steps) => Box::new(Newmark::new(system, grid, (0.25, 0.5), steps)),
            Self::Linear(steps) => Box::new(Newmark::new(system, grid, (1.0 / 6.0, 0.5), steps)),
            Self::Central(steps) => Box::new(Newmark::new(system, grid, (0.0, 0.5), steps)),
            Self::Exponential(steps) => Box::new(Exponential::new(system, grid, steps)),
            Self::Dense => Box::new(Dense::new(system, grid)),
        })
    }
}
