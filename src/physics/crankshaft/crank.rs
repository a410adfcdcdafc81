//! Dimensions of a crank, and the beam and notches that follow from them.

use super::beam::{Beam, Support};
use super::section;
use super::stress_concentration::Geometry as NotchGeometry;
use crate::drivetrain::throw_inertia::Masses;
use crate::drivetrain::throw_stiffness::{Step, Throw, ThrowFormula};

/// Where a fillet or bore runs round.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub enum Place {
    /// Between crankpin and web.
    Crankpin,
    /// Between main journal and web.
    Journal,
    /// Outlet of the oil bore of the crankpin.
    OilBore,
}

impl Place {
    /// The word used in studies and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Crankpin => "crankpin",
            Self::Journal => "journal",
            Self::OilBore => "oil_bore",
        }
    }
}

/// Bore of the crankpin that feeds oil.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OilBore {
    /// m.
    pub diameter: f64,
    /// From the outermost point of the crankpin, rad.
    pub angle: f64,
}

/// Dimensions of a crank, m. All throws are alike but for the lengths of the journals between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Crank {
    /// Half the stroke.
    pub crank_radius: f64,
    /// Outer diameter of the crankpins.
    pub pin_diameter: f64,
    /// Axial bore of the crankpins; zero where solid.
    pub pin_bore: f64,
    /// Outer diameter of the main journals.
    pub journal_diameter: f64,
    /// Axial bore of the journals; zero where solid.
    pub journal_bore: f64,
    /// Between the webs.
    pub pin_length: f64,
    /// Rods side by side on a crankpin.
    pub rods: usize,
    /// Between their middles; zero where they share one.
    pub rod_spacing: f64,
    /// One a main bearing, throws + 1.
    pub journal_lengths: Vec<f64>,
    /// Along the shaft.
    pub web_thickness: f64,
    /// Across the throw.
    pub web_breadth: f64,
    /// Fillet radius of the crankpins.
    pub pin_fillet: f64,
    /// Fillet radius of the journals.
    pub journal_fillet: f64,
    /// Recess of the crankpin fillet into the web.
    pub pin_recess: f64,
    /// Recess of the journal fillet into the web.
    pub journal_recess: f64,
    /// Oil bore of the crankpin.
    pub oil_bore: Option<OilBore>,
    /// Main bearings (from 0) that are missing.
    pub missing_bearings: Vec<usize>,
    /// N/m; `None`: rigid.
    pub bearing_stiffness: Option<f64>,
    /// Pa.
    pub young_modulus: f64,
    /// Mass times distance from the axis of pin and webs of a throw, less that of its counterweights, kg m.
    pub unbalance: f64,
    /// What its inertia needs beside the dimensions, where the file has it.
    pub masses: Option<Masses>,
    /// The formula that stiffnesses not given follow from.
    pub stiffness_formula: Option<ThrowFormula>,
    /// Keys whose values are assumptions.
    pub assumed: Vec<String>,
}

impl Crank {
    /// Dimensions of a throw with the mean of the journals beside it.
    pub fn throw(&self, throw: usize) -> Throw {
        let journal = 0.5 * (self.journal_lengths[throw] + self.journal_lengths[throw + 1]);
        Throw {
            pin: Step { diameter: self.pin_diameter, bore: self.pin_bore, length: self.pin_length },
            journal: Step { diameter: self.journal_diameter, bore: self.journal_bore, length: journal },
            radius: self.crank_radius,
            web_thickness: self.web_thickness,
            web_breadth: self.web_breadth,
        }
    }

    /// Number of throws.
    pub fn throws(&self) -> usize {
        self.journal_lengths.len() - 1
    }

    /// Distance between the bearings of a throw, m.
    #[doc(hidden)]
    pub fn pitch(&self, throw: usize) -> f64 {
        0.5 * (self.journal_lengths[throw] + self.journal_lengths[throw + 1]) + 2.0 * self.web_thickness + self.pin_length
    }

    /// Places of the main bearings along the shaft, the first at zero, m; missing ones included.
    pub fn bearings(&self) -> Vec<f64> {
        let mut at = 0.0;
        let next = (0..self.throws()).map(|t| {
            at += self.pitch(t);
            at
        });
        std::iter::once(0.0).chain(next).collect()
    }

    /// Middle of the front web, of the crankpin and of the rear web of a throw, m.
    pub fn places(&self, throw: usize) -> [f64; 3] {
        let front = self.bearings()[throw] + 0.5 * self.journal_lengths[throw];
        let pin = front + self.web_thickness + 0.5 * self.pin_length;
        [front + 0.5 * self.web_thickness, pin, front + 1.5 * self.web_thickness + self.pin_length]
    }

    /// Middles of the rods on a throw, the first cylinder's first, m.
    #[doc(hidden)]
    pub fn rod_places(&self, throw: usize) -> Vec<f64> {
        let middle = 0.5 * (self.rods as f64 - 1.0);
        (0..self.rods).map(|k| self.places(throw)[1] + (k as f64 - middle) * self.rod_spacing).collect()
    }

    /// Overlap of crankpin and journal, m; negative where there is none.
    pub fn overlap(&self) -> f64 {
        0.5 * (self.pin_diameter + self.journal_diameter) - self.crank_radius
    }

    /// The crank as a beam of the crankpin's section, loaded at the middle of every rod.
    pub fn beam(&self) -> Beam {
        let bearings = self.bearings();
        let present = bearings.iter().enumerate().filter(|(i, _)| !self.missing_bearings.contains(i));
        Beam {
            supports: present.map(|(_, at)| Support { at: *at, stiffness: self.bearing_stiffness }).collect(),
            loads_at: (0..self.throws()).flat_map(|t| self.rod_places(t)).collect(),
            rigidity: self.young_modulus * section::area_moment(self.pin_diameter, self.pin_bore),
        }
    }

    /// Thickness of the web that bears, m: without overlap, a recess deeper than its fillet leaves less of it \[IACS UR M53\] section 2.1.2.
    #[doc(hidden)]
    pub fn bearing_web(&self) -> f64 {
        let undercut = (self.pin_recess - self.pin_fillet).max(0.0);
        if self.overlap() < 0.0 { self.web_thickness - undercut } else { self.web_thickness }
    }

    /// What stress concentration depends on.
    pub fn notch(&self) -> NotchGeometry {
        NotchGeometry {
            pin_diameter: self.pin_diameter,
            journal_diameter: self.journal_diameter,
            overlap: self.overlap(),
            web_thickness: self.bearing_web(),
            web_breadth: self.web_breadth,
            pin_fillet: self.pin_fillet,
            journal_fillet: self.journal_fillet,
            pin_bore: self.pin_bore,
            journal_bore: self.journal_bore,
            pin_recess: self.pin_recess,
            journal_recess: self.journal_recess,
            oil_bore: self.oil_bore.map(|b| b.diameter),
        }
    }
}
