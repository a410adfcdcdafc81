//! One round: every section of pin, rod and crank under the loads of the masses of the last round.

use super::bodies::{self, Body};
use super::crank;
use super::cycle::Cycle;
use super::failure::{SizingError, WIDEST_WEB};
use super::load_cases::Loads;
use super::rod::{self, ShankLoads};
use super::section::{Moments, Notch, Strength, Swing, least};
use super::specification::{Material, Sizes, Specification};
use super::web::WebLoads;
use super::{eye, piston_pin, stepped_shaft, web};
use crate::fatigue::endurance::{Loading, fatigue_factor, notch_sensitivity};
use rayon::prelude::*;

/// Web thickness and least breadth over the diameter of the crankpin \[Fialho & Almeida 2019\] eqs. (52) and (53).
const WEB: (f64, f64) = (0.7, 1.14);
/// Width of the rod over t.
const ROD_WIDTH: f64 = 4.0;

/// Margins of a section.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Margin {
    /// Its name.
    pub section: &'static str,
    /// Against yielding, the smallest of all throws and speeds.
    pub yielding: f64,
    /// For infinite life.
    pub fatigue: f64,
    /// What stands behind that; `None` of sections that are not round.
    pub behind: Option<Behind>,
}

/// What stands behind the margin of a round section for infinite life, of the throw and speed with the smallest.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Behind {
    /// Of load, size, surface, temperature and reliability \[Norton 2013\] chapter 6.
    pub factors: [f64; 5],
    /// With all of them, Pa.
    pub fatigue_limit: f64,
    /// Equivalent moments of amplitude and mean, N m.
    pub moments: [f64; 2],
}

/// What one round comes to.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Round {
    /// Dimensions.
    pub sizes: Sizes,
    /// About the centre of its big end.
    pub rod: Body,
    /// One throw about the axis of the crank.
    pub throw: Body,
    /// Fatigue notch factors of the crankpin's fillet.
    pub crankpin_notch: Notch,
    /// Of the journal's.
    pub journal_notch: Notch,
    /// Of every section, with the forces and notch factors of this round.
    pub margins: Vec<Margin>,
    /// Factor against buckling of the shank.
    pub buckling_margin: f64,
}

impl Round {
    /// A crank and rod between this one and another, by a share of the way.
    #[doc(hidden)]
    pub fn towards(&self, other: &Self, share: f64, spec: &Specification) -> Self {
        let sizes = self.sizes.towards(&other.sizes, share);
        Self {
            rod: bodies::rod(&sizes, spec.rod_length, spec.density),
            throw: bodies::throw(&sizes, bodies::journal_lengths(&sizes, &spec.bearings), spec.crank_radius(), spec.density),
            sizes,
            ..other.clone()
        }
    }

    /// Largest relative change of dimensions, masses and inertias to another round.
    #[doc(hidden)]
    pub fn change_to(&self, other: &Self) -> f64 {
        let values = |r: &Self| -> Vec<f64> {
            let bodies = [r.rod, r.throw].map(|b| [b.mass, b.centre, b.inertia_at_reference]);
            r.sizes.named().iter().map(|n| n.1).chain(bodies.into_iter().flatten()).collect()
        };
        values(self).iter().zip(values(other)).map(|(a, b)| (b - a).abs() / b.abs()).fold(0.0, f64::max)
    }

    /// Sections that have less than the design factor, or less than the factor against buckling: their dimensions were given.
    #[doc(hidden)]
    pub fn short_of(&self, spec: &Specification) -> Vec<&'static str> {
        let short = |found: f64, factor: f64| found < factor * (1.0 - 1e-9);
        let of_factor = self.margins.iter().filter(|m| short(m.yielding.min(m.fatigue), spec.design_factor)).map(|m| m.section);
        of_factor.chain(short(self.buckling_margin, spec.buckling_factor).then_some("rod_shank against buckling")).collect()
    }
}

/// A round section under the moments of all throws and speeds.
struct RoundSection<'a> {
    name: &'static str,
    moments: Vec<Moments>,
    material: &'a Material,
    notch: Notch,
    /// Whether it yields in bending alone, by its yield strength.
    in_bending: bool,
}

impl RoundSection<'_> {
    fn strength(&self, diameter: f64) -> Strength {
        let strength = self.material.strength(Loading::Bending, diameter);
        // the largest shear of pure bending is half of the stress
        if self.in_bending { Strength { shear_yield: 0.5 * self.material.yield_strength, ..strength } } else { strength }
    }

    /// The least diameter from a first one on that holds, or the given one.
    fn diameter(&self, factor: f64, given: Option<f64>, first: f64) -> f64 {
        let needed = |d: f64| {
            let strength = self.strength(d);
            let diameter_for = |m: &Moments| m.static_diameter(&strength, factor).max(m.fatigue_diameter(&strength, self.notch, factor));
            self.moments.iter().map(diameter_for).fold(0.0, f64::max)
        };
        given.unwrap_or_else(|| least(needed, first))
    }

    fn margin(&self, diameter: f64) -> Margin {
        let strength = self.strength(diameter);
        let all = self.moments.iter().map(|m| m.margins(&strength, self.notch, diameter));
        let [yielding, fatigue] = all.fold([f64::INFINITY; 2], |a, b| [a[0].min(b[0]), a[1].min(b[1])]);
        let used = |m: &&Moments| m.margins(&strength, self.notch, diameter)[1];
        let worst = self.moments.iter().min_by(|a, b| used(a).total_cmp(&used(b)));
        let behind = worst.map(|m| Behind {
            factors: self.material.endurance(Loading::Bending, diameter).factors(self.material.tensile),
            fatigue_limit: strength.fatigue_limit,
            moments: m.equivalent(self.notch),
        });
        Margin { section: self.name, yielding, fatigue, behind }
    }
}

/// What a round takes of the one before.
#[derive(Debug, Clone, Copy)]
pub(super) struct Before {
    /// Of crankpin and journal.
    pub notches: [Notch; 2],
    /// Diameters of crankpin and journal from which theirs are sought, m.
    pub first: [f64; 2],
}

/// An end of the rod.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum End {
    Small,
    Big,
}

/// Sizes every section under these loads, with the notch factors of the round before.
///
/// # Errors
/// [`SizingError`] where a section has no dimension that holds.
pub(super) fn round(
    spec: &Specification,
    (cycles, throws): &Loads,
    Before { notches: [crankpin_notch, journal_notch], first }: Before,
) -> Result<Round, SizingError> {
    let (given, factor, radius) = (&spec.given, spec.design_factor, spec.crank_radius());
    let section = |name, moments, material, notch, in_bending| RoundSection { name, moments, material, notch, in_bending };
    let pin_moments = cycles.iter().map(|c| piston_pin::moments(c, spec.bore)).collect();
    let pin = section("piston_pin", pin_moments, &spec.pin, Notch::NONE, true);
    let pin_diameter = pin.diameter(factor, given.pin_diameter, 0.0);
    let shank = cycles.iter().map(ShankLoads::of).collect::<Vec<_>>();
    let shank_thickness = given.shank_thickness.unwrap_or_else(|| shank_thickness(spec, &shank));
    let all = || throws.iter().flat_map(|case| (0..case.len()).map(move |throw| (case, throw)));
    let crankpin_moments = all().flat_map(|(case, throw)| crank::crankpin(case, throw, spec.supported(), radius)).collect();
    let crankpin = section("crankpin", crankpin_moments, &spec.crank, crankpin_notch, false);
    let crankpin_diameter = crankpin.diameter(factor, given.crankpin_diameter, first[0]);
    let mut sizes = Sizes {
        pin_diameter,
        shank_thickness,
        crankpin_diameter,
        crankpin_length: given.crankpin_length.unwrap_or(ROD_WIDTH * shank_thickness),
        web_thickness: given.web_thickness.unwrap_or(WEB.0 * crankpin_diameter),
        web_breadth: given.web_breadth.unwrap_or(WEB.1 * crankpin_diameter),
        small_eye_bore: pin_diameter + spec.clearance,
        big_eye_bore: crankpin_diameter + spec.clearance,
        small_eye_diameter: 0.0,
        big_eye_diameter: 0.0,
        journal_diameter: 0.0,
        seat_diameter: 0.0,
    };
    let rooms = [("before", spec.bearings.before), ("after", spec.bearings.after)];
    if let Some((side, room)) = rooms.into_iter().find(|r| r.1 <= 0.5 * sizes.crankpin_length + sizes.web_thickness) {
        return Err(SizingError::NoRoom { crankpin_length: sizes.crankpin_length, web_thickness: sizes.web_thickness, side, room });
    }
    let journal_moments = all().flat_map(|(case, throw)| crank::journals(case, throw, spec.supported(), &sizes)).collect();
    let journal = section("journal", journal_moments, &spec.crank, journal_notch, false);
    sizes.journal_diameter = journal.diameter(factor, given.journal_diameter, first[1]);
    let last = throws.iter().filter_map(|t| t.last());
    let seat_moments = last.map(|t| crank::seat(&t.torque_after, &spec.bearings)).collect();
    let seat = section("flywheel_seat", seat_moments, &spec.crank, Notch::NONE, false);
    sizes.seat_diameter = seat.diameter(factor, given.seat_diameter, 0.0);
    let places: Vec<_> = all().collect();
    let webs: Vec<WebLoads> =
        places.par_iter().flat_map_iter(|(case, throw)| web::loads(case, *throw, spec.supported(), radius, &sizes)).collect();
    if given.web_breadth.is_none() {
        // no shoulder is lower than what stands on it
        sizes.web_breadth = sizes.web_breadth.max(sizes.journal_diameter);
        sizes.web_breadth = web_breadth(spec, &webs, &sizes)?;
    }
    let small = eye(spec, cycles, End::Small, sizes.small_eye_bore, shank_thickness)?;
    let big = eye(spec, cycles, End::Big, sizes.big_eye_bore, shank_thickness)?;
    (sizes.small_eye_diameter, sizes.big_eye_diameter) = (small.0, big.0);
    let mut margins = vec![pin.margin(sizes.pin_diameter), shank_margin(spec, &shank, shank_thickness), small.1, big.1];
    margins.extend([crankpin.margin(crankpin_diameter), journal.margin(sizes.journal_diameter), seat.margin(sizes.seat_diameter)]);
    margins.push(web_margin(spec, webs.iter(), &sizes));
    let compression = shank.iter().map(|s| s.compression).fold(0.0, f64::max);
    Ok(Round {
        rod: bodies::rod(&sizes, spec.rod_length, spec.density),
        throw: bodies::throw(&sizes, bodies::journal_lengths(&sizes, &spec.bearings), radius, spec.density),
        crankpin_notch: notch(spec, sizes.crankpin_diameter, &sizes),
        journal_notch: notch(spec, sizes.journal_diameter, &sizes),
        buckling_margin: rod::buckling_load(shank_thickness, spec.rod.yield_strength, spec.rod_length) / compression,
        margins,
        sizes,
    })
}

fn shank_thickness(spec: &Specification, loads: &[ShankLoads]) -> f64 {
    let thickness_for = |l: &ShankLoads| {
        let [yielding, fatigue] = rod::axial_thickness(l, &spec.rod, spec.design_factor);
        let buckling = rod::buckling_thickness(spec.buckling_factor * l.compression, spec.rod.yield_strength, spec.rod_length);
        buckling.max(yielding).max(fatigue)
    };
    loads.iter().map(thickness_for).fold(0.0, f64::max)
}

fn shank_margin(spec: &Specification, loads: &[ShankLoads], thickness: f64) -> Margin {
    let needed = loads.iter().map(|l| rod::axial_thickness(l, &spec.rod, 1.0));
    let [yielding, fatigue] = needed.fold([0.0f64; 2], |a, b| [a[0].max(b[0]), a[1].max(b[1])]).map(|t| (thickness / t).powi(2));
    Margin { section: "rod_shank", yielding, fatigue, behind: None }
}

/// Fatigue factors of a fillet: the web as a shoulder, as high as it is in bending and as wide as it is in torsion.
fn notch(spec: &Specification, diameter: f64, sizes: &Sizes) -> Notch {
    let radius = spec.fillet_radius / diameter;
    let height = bodies::web_height(sizes, spec.crank_radius());
    let notch_factor = |kt: f64, torsion: bool| fatigue_factor(kt, notch_sensitivity(spec.fillet_radius, spec.crank.tensile, torsion));
    Notch {
        bending: notch_factor(stepped_shaft::bending(radius, height / diameter), false),
        torsion: notch_factor(stepped_shaft::torsion(radius, sizes.web_breadth / diameter), true),
    }
}

fn web_margin<'a>(spec: &Specification, webs: impl Iterator<Item = &'a WebLoads>, sizes: &Sizes) -> Margin {
    let all = webs.map(|loads| web::margins(loads, (sizes.web_breadth, sizes.web_thickness), &spec.crank));
    let [yielding, fatigue] = all.fold([f64::INFINITY; 2], |a, b| [a[0].min(b[0]), a[1].min(b[1])]);
    Margin { section: "web", yielding, fatigue, behind: None }
}

/// Webs whose margin is within this of the smallest are looked at while the breadth is sought; the others are looked at again in the end.
const NEAR: f64 = 1.25;

/// The narrowest web from 1.14 crankpin diameters on that holds.
fn web_breadth(spec: &Specification, webs: &[WebLoads], sizes: &Sizes) -> Result<f64, SizingError> {
    let smaller = |webs: &[&WebLoads], breadth: f64| {
        let m = web_margin(spec, webs.iter().copied(), &Sizes { web_breadth: breadth, ..*sizes });
        m.yielding.min(m.fatigue)
    };
    let all: Vec<&WebLoads> = webs.iter().collect();
    let mut low = sizes.web_breadth;
    loop {
        let each: Vec<f64> = all.par_iter().map(|w| smaller(&[*w], low)).collect();
        let worst = each.iter().copied().fold(f64::INFINITY, f64::min);
        if worst >= spec.design_factor * (1.0 - 1e-12) {
            return Ok(low);
        }
        let near: Vec<&WebLoads> = all.iter().zip(&each).filter(|(_, m)| **m <= NEAR * worst).map(|(w, _)| *w).collect();
        let mut high = WIDEST_WEB * sizes.crankpin_diameter;
        if smaller(&near, high) < spec.design_factor {
            return Err(SizingError::Web { thickness: sizes.web_thickness });
        }
        while high - low > 1e-13 * high {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if smaller(&near, middle) >= spec.design_factor { high = middle } else { low = middle }
        }
        low = high;
    }
}

/// Outer diameter of an eye, and its margins. The ring bears what pulls; what presses goes straight into the shank, than which the eye is no lower.
fn eye(spec: &Specification, cycles: &[Cycle], end: End, bore: f64, shank_thickness: f64) -> Result<(f64, Margin), SizingError> {
    let (given, name, taper) = match end {
        End::Small => (spec.given.small_eye_ratio, "small_eye", rod::TAPER.0),
        End::Big => (spec.given.big_eye_ratio, "big_eye", rod::TAPER.1),
    };
    let (width, height) = (ROD_WIDTH * shank_thickness, rod::HEIGHT * shank_thickness * taper);
    let history = |c: &Cycle| -> Vec<f64> {
        let tension = match end {
            End::Small => &c.rod_tension_small,
            End::Big => &c.rod_tension_big,
        };
        tension.iter().map(|f| f.max(0.0)).collect()
    };
    let limit = spec.rod.fatigue_limit(Loading::Axial, 0.0);
    // area of strength: force over stress
    let fatigue = |c: &Cycle| {
        let swing = Swing::of(history(c));
        swing.amplitude / limit + swing.mean / spec.rod.tensile
    };
    let fatigue = cycles.iter().map(fatigue).fold(0.0, f64::max);
    let yielding = cycles.iter().flat_map(history).fold(0.0, f64::max) / spec.rod.yield_strength;
    let needed = spec.design_factor * fatigue.max(yielding);
    let ratio = match given {
        Some(ratio) => ratio,
        None => {
            eye::least_ratio(needed, bore, width, spec.least_eye_ratio.max(height / bore)).ok_or(SizingError::Eye { eye: name, bore })?
        }
    };
    let per_area = eye::stress_concentration(ratio) / ((ratio - 1.0) * bore * width);
    let margin = |area: f64| if area > 0.0 { 1.0 / (per_area * area) } else { f64::INFINITY };
    Ok((ratio * bore, Margin { section: name, yielding: margin(yielding), fatigue: margin(fatigue), behind: None }))
}
