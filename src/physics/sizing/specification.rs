//! What a slider-crank is sized from, and its dimensions.

use super::section::Strength;
use crate::engine::{Geometry, Kinematics, Pressure, RodModel, SliderCrank};
use crate::fatigue::endurance::{Endurance, Loading, Surface, estimated_limit};

/// Steel of a part and what it is exposed to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Tensile strength, Pa.
    pub tensile: f64,
    /// Yield strength, Pa.
    pub yield_strength: f64,
    /// Yield strength in shear, Pa.
    pub shear_yield: f64,
    /// Finish.
    pub surface: Surface,
    /// °C.
    pub temperature_c: f64,
    /// Per cent, one of those with a factor.
    pub reliability_percent: f64,
}

impl Material {
    /// Fatigue limit of a round section, Pa; axial load has no effect of size \[Norton 2013\] eq. (6.7c).
    pub fn fatigue_limit(&self, loading: Loading, diameter: f64) -> f64 {
        self.endurance(loading, diameter).factors(self.tensile).iter().product::<f64>() * estimated_limit(self.tensile)
    }

    /// What a round section differs in from a specimen.
    pub(super) fn endurance(&self, loading: Loading, diameter: f64) -> Endurance {
        Endurance {
            loading,
            diameter: if loading == Loading::Axial { 0.0 } else { diameter },
            surface: self.surface,
            temperature_c: self.temperature_c,
            reliability_percent: self.reliability_percent,
        }
    }

    /// Strengths of a round section.
    pub fn strength(&self, loading: Loading, diameter: f64) -> Strength {
        Strength { fatigue_limit: self.fatigue_limit(loading, diameter), tensile: self.tensile, shear_yield: self.shear_yield }
    }
}

/// Where a throw and the flywheel are carried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bearings {
    /// From the middle of the bearing before a throw to the middle of its crankpin, m.
    pub before: f64,
    /// From there to the middle of the bearing after it, m.
    pub after: f64,
    /// From the last of them to the flywheel, m.
    pub before_flywheel: f64,
    /// From the flywheel to the bearing beyond it, m.
    pub after_flywheel: f64,
    /// N.
    pub flywheel_weight: f64,
    /// Across the weight, N.
    pub belt_tension: f64,
}

/// What bends the crank.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bending {
    /// Each throw by itself, on the bearings beside it, as in \[IACS UR M53\].
    OwnBearings,
    /// The whole crank on all its bearings, rigid ones.
    AllBearings,
}

/// Dimensions that are not sized but given, m; ratios of eyes are outer to inner diameter.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Given {
    /// Of the piston pin.
    pub pin_diameter: Option<f64>,
    /// Of the web of the rod's I-section, t: it is 5 t high and 4 t wide, its flanges are t thick.
    pub shank_thickness: Option<f64>,
    /// Of the small eye.
    pub small_eye_ratio: Option<f64>,
    /// Of the big eye.
    pub big_eye_ratio: Option<f64>,
    /// Of the crankpin.
    pub crankpin_diameter: Option<f64>,
    /// Of the crankpin; else as wide as the rod.
    pub crankpin_length: Option<f64>,
    /// Of the main journals.
    pub journal_diameter: Option<f64>,
    /// Along the crank; else 0.7 of the crankpin's diameter.
    pub web_thickness: Option<f64>,
    /// Across the throw; else from 1.14 of the crankpin's diameter up.
    pub web_breadth: Option<f64>,
    /// Of the flywheel's seat.
    pub seat_diameter: Option<f64>,
}

/// Operating data, materials and proportions.
#[derive(Debug, Clone, PartialEq)]
pub struct Specification {
    /// 2 or 4.
    pub strokes: u32,
    /// Lowest and highest speed, rpm, or only one.
    pub speeds_rpm: Vec<f64>,
    /// Of every section but the rod's against buckling.
    pub design_factor: f64,
    /// Of the rod against buckling.
    pub buckling_factor: f64,
    /// m.
    pub bore: f64,
    /// m.
    pub stroke: f64,
    /// Between the centres of its eyes, m.
    pub rod_length: f64,
    /// Without its pin's share in anything sized here, kg.
    pub piston_mass: f64,
    /// Coulomb friction between piston and liner.
    pub liner_friction: f64,
    /// Under the piston, Pa absolute.
    pub crankcase_pressure: f64,
    /// In the cylinder.
    pub pressure: Pressure,
    /// Of each throw from the free end on, degrees; one for a single cylinder.
    pub firing_deg: Vec<f64>,
    /// Of the piston pin.
    pub pin: Material,
    /// Of the rod.
    pub rod: Material,
    /// Of the crank.
    pub crank: Material,
    /// Fillets of crankpin and journals, m.
    pub fillet_radius: f64,
    /// Diametral clearance between eyes and pins, m.
    pub clearance: f64,
    /// Smallest ratio of outer to inner diameter of an eye that is sized.
    pub least_eye_ratio: f64,
    /// kg/m³.
    pub density: f64,
    /// Where the crank is carried.
    pub bearings: Bearings,
    /// What bends it.
    pub bending: Bending,
    /// What is not sized.
    pub given: Given,
}

impl Specification {
    /// Where the crank is carried, and what bends it.
    pub(super) fn supported(&self) -> (&Bearings, Bending) {
        (&self.bearings, self.bending)
    }

    /// Half of the stroke, m.
    pub fn crank_radius(&self) -> f64 {
        0.5 * self.stroke
    }

    /// The cylinder unit with a rod of this mass, centre (from the big end) and inertia about it.
    pub fn geometry(&self, rod_mass: f64, centre_from_big_end: f64, inertia: f64) -> Geometry {
        Geometry {
            bore: self.bore,
            slider_crank: SliderCrank { crank_radius: self.crank_radius(), rod_length: self.rod_length, kinematics: Kinematics::Exact },
            piston_mass: self.piston_mass,
            rod_mass,
            rod: RodModel::Body { centre_from_big_end, inertia },
            crankcase_pressure: self.crankcase_pressure,
            liner_friction: self.liner_friction,
        }
    }
}

/// Vibratory torque in the crank at one speed, from the response of the chain instead of that of a rigid crank.
#[derive(Debug, Clone, PartialEq)]
pub struct TorqueCase {
    /// rpm.
    pub speed_rpm: f64,
    /// How much of it counts, 0 (a rigid crank) to 1.
    pub share: f64,
    /// Orders it holds, as periods in a working cycle; what gas and masses have of others is added as on a rigid crank.
    pub harmonics: Vec<u32>,
    /// Without its mean, before the first throw, between throws, after the last one: over the cycle as [`super::cycle::Cycle`] is sampled, N m.
    pub vibratory: Vec<Vec<f64>>,
}

/// Dimensions, m.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct Sizes {
    /// Of the piston pin.
    pub pin_diameter: f64,
    /// t of the rod's I-section.
    pub shank_thickness: f64,
    /// Inner diameter of the small eye.
    pub small_eye_bore: f64,
    /// Outer diameter of the small eye.
    pub small_eye_diameter: f64,
    /// Inner diameter of the big eye.
    pub big_eye_bore: f64,
    /// Outer diameter of the big eye.
    pub big_eye_diameter: f64,
    /// Of the crankpin.
    pub crankpin_diameter: f64,
    /// Of the crankpin.
    pub crankpin_length: f64,
    /// Of the main journals.
    pub journal_diameter: f64,
    /// Along the crank.
    pub web_thickness: f64,
    /// Across the throw.
    pub web_breadth: f64,
    /// Of the flywheel's seat.
    pub seat_diameter: f64,
}

impl Sizes {
    /// By a share of the way to others.
    pub(super) fn towards(&self, other: &Self, share: f64) -> Self {
        let between = |a: f64, b: f64| a + (b - a) * share;
        Self {
            pin_diameter: between(self.pin_diameter, other.pin_diameter),
            shank_thickness: between(self.shank_thickness, other.shank_thickness),
            small_eye_bore: between(self.small_eye_bore, other.small_eye_bore),
            small_eye_diameter: between(self.small_eye_diameter, other.small_eye_diameter),
            big_eye_bore: between(self.big_eye_bore, other.big_eye_bore),
            big_eye_diameter: between(self.big_eye_diameter, other.big_eye_diameter),
            crankpin_diameter: between(self.crankpin_diameter, other.crankpin_diameter),
            crankpin_length: between(self.crankpin_length, other.crankpin_length),
            journal_diameter: between(self.journal_diameter, other.journal_diameter),
            web_thickness: between(self.web_thickness, other.web_thickness),
            web_breadth: between(self.web_breadth, other.web_breadth),
            seat_diameter: between(self.seat_diameter, other.seat_diameter),
        }
    }

    /// All of them with their names.
    pub fn named(&self) -> [(&'static str, f64); 12] {
        [
            ("pin_diameter", self.pin_diameter),
            ("shank_thickness", self.shank_thickness),
            ("small_eye_bore", self.small_eye_bore),
            ("small_eye_diameter", self.small_eye_diameter),
            ("big_eye_bore", self.big_eye_bore),
            ("big_eye_diameter", self.big_eye_diameter),
            ("crankpin_diameter", self.crankpin_diameter),
            ("crankpin_length", self.crankpin_length),
            ("journal_diameter", self.journal_diameter),
            ("web_thickness", self.web_thickness),
            ("web_breadth", self.web_breadth),
            ("seat_diameter", self.seat_diameter),
        ]
    }
}
