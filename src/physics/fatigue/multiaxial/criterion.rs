//! What a criterion is made of, and the verdict of criteria on a history.

use super::bound::Within;
use super::history::History;
use super::invariants::Invariants;
use super::largest_shear::LargestShear;
use super::papadopoulos;
use super::plane::Plane;
use super::search::{self, CriticalPlanes, Grid, Wanted};
use std::borrow::Cow;

/// Fatigue limits of a material, Pa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Tensile strength.
    pub tensile: f64,
    /// f: amplitude in reversed bending.
    pub bending: f64,
    /// t: amplitude in reversed torsion.
    pub torsion: f64,
    /// f0: amplitude in repeated bending (from zero).
    pub repeated_bending: f64,
}

impl Limits {
    /// f0 by Goodman's line, \[Minucci 2010\] eq. (5.2): f/(1 + f/tensile).
    pub fn goodman_repeated(bending: f64, tensile: f64) -> f64 {
        bending / (1.0 + bending / tensile)
    }
}

/// What bounds the amplitude of its shear.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shear {
    /// The ball round the path of the deviator.
    Ball,
    /// The circles of planes.
    Planes,
    /// The mean over planes and directions.
    Mean,
}

/// The critical plane that it asks for.
#[derive(Debug, Clone, Copy)]
#[doc(hidden)]
pub enum Critical {
    /// None.
    None,
    /// That of the largest shear amplitude.
    Shear,
    /// That of Findley's sum, with so many times the normal stress.
    Findley,
    /// That of Dang Van's sum, with so many times the hydrostatic stress.
    DangVan,
    /// One that the path itself tells, with the equivalent shear stress on it.
    Told(fn(&History, &Limits) -> search::Critical),
}

/// What a criterion is made of.
pub(crate) struct Row {
    /// Its word in studies and tables.
    pub name: &'static str,
    /// k: weight of the normal or hydrostatic stress.
    pub weight: fn(&Limits) -> Result<f64, Undefined>,
    /// What bounds the amplitude of its shear.
    pub shear: Shear,
    /// The plane that it asks for.
    pub critical: Critical,
    /// Whether it asks for the normal stress on a plane.
    pub normal: bool,
    /// Whether its peaks over speed may sit on ridges: where it takes distances to the centre of a ball or circle, which moves abruptly.
    pub ridges: bool,
    /// The equivalent shear stress of a path with k, Pa; `None` of a path whose planes are to be searched first.
    pub stress: fn(&dyn Path, f64, &Limits) -> Option<f64>,
    /// At least that of every history within some ranges.
    pub bound: fn(&Within, f64, &Limits) -> f64,
}

/// A criterion: a row of [`Criterion::ALL`].
#[derive(Clone, Copy)]
pub struct Criterion(pub(super) &'static Row);

impl PartialEq for Criterion {
    fn eq(&self, other: &Self) -> bool {
        self.0.name == other.0.name
    }
}

impl Eq for Criterion {}

impl std::fmt::Debug for Criterion {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(self.0.name)
    }
}

/// No constant for these limits.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("{criterion} needs a torsion limit {expected} the bending limit; here it is {ratio:.4} of it")]
pub struct Undefined {
    /// Its word.
    pub criterion: &'static str,
    /// What of it.
    pub expected: &'static str,
    /// Torsion over bending limit.
    pub ratio: f64,
}

/// What a criterion says of a history.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// The criterion.
    pub criterion: Criterion,
    /// What the history may be multiplied by; infinite where it never fails by it.
    pub safety_factor: f64,
    /// Its critical plane.
    pub plane: Option<Plane>,
    /// On that plane, Pa.
    pub shear_amplitude: Option<f64>,
    /// On that plane, Pa.
    pub normal_max: Option<f64>,
    /// Planes that are as critical, in words.
    pub note: String,
}

impl Criterion {
    /// The word in tables.
    pub fn name(self) -> &'static str {
        self.0.name
    }

    /// Whether what it asks of a plane state is found from the corners of its hull only, not from all samples.
    pub(crate) fn asks_for_corners(self) -> bool {
        self.0.shear != Shear::Ball
    }

    /// Whether it asks for a search of all planes even of a plane state.
    pub(crate) fn searches_planes(self) -> bool {
        matches!(self.0.critical, Critical::Findley | Critical::DangVan)
    }

    /// What bounds the amplitude of its shear.
    pub(crate) fn shear(self) -> Shear {
        self.0.shear
    }

    /// Whether it asks for the normal stress on a plane.
    pub(crate) fn asks_for_normal_stress(self) -> bool {
        self.0.normal
    }

    /// Whether its peaks over speed may sit on ridges.
    pub(crate) fn has_ridges(self) -> bool {
        self.0.ridges
    }

    /// Weight of the normal or hydrostatic stress (of its amplitude, for Kakuno and Kawada).
    ///
    /// # Errors
    /// [`Undefined`] where the limits leave no constant.
    pub fn weight(self, l: &Limits) -> Result<f64, Undefined> {
        (self.0.weight)(l)
    }

    /// The equivalent shear stress of a path, Pa; nothing by a criterion that asks for a search of planes.
    ///
    /// # Errors
    /// [`Undefined`] where the limits leave no constant.
    pub(crate) fn stress(self, path: &dyn Path, l: &Limits) -> Result<Option<f64>, Undefined> {
        Ok((self.0.stress)(path, self.weight(l)?, l))
    }

    /// At least the share of the strength (the inverse of the safety factor) that a history within some ranges uses; not negative.
    ///
    /// # Errors
    /// [`Undefined`] where the limits leave no constant.
    pub fn at_most(self, within: &Within, l: &Limits) -> Result<f64, Undefined> {
        Ok((self.0.bound)(within, self.weight(l)?, l).max(0.0) / l.torsion)
    }
}

/// Figures of a path over the cycle that criteria of invariants ask for, Pa.
pub trait Path {
    /// Amplitude of sqrt(J2).
    fn sqrt_j2_amplitude(&self) -> f64;
    /// Smallest and largest hydrostatic stress.
    fn hydrostatic(&self) -> (f64, f64);
    /// Largest Tresca stress about the middle of the deviator's path with `k` times the hydrostatic stress.
    fn mesoscopic(&self, k: f64) -> f64;
    /// Mean resolved shear over all planes and directions.
    fn mean_shear(&self) -> f64;
    /// What the plane of the largest shear bears, where it is known.
    fn largest_shear(&self) -> Option<LargestShear>;
    /// The stresses themselves; of a path that only its corners decide, those.
    fn history(&self) -> Cow<'_, History>;
    /// Critical planes, where they have been searched.
    fn searched(&self) -> Option<&CriticalPlanes> {
        None
    }
}

/// A history whose planes have been searched.
struct Searched<'a> {
    history: &'a History,
    invariants: &'a Invariants,
    found: &'a CriticalPlanes,
}

impl Path for Searched<'_> {
    fn sqrt_j2_amplitude(&self) -> f64 {
        self.invariants.sqrt_j2_amplitude
    }

    fn hydrostatic(&self) -> (f64, f64) {
        let i = self.invariants;
        (i.hydrostatic_mean - i.hydrostatic_amplitude, i.hydrostatic_max())
    }

    fn mesoscopic(&self, k: f64) -> f64 {
        self.invariants.mesoscopic(self.history, k)
    }

    fn mean_shear(&self) -> f64 {
        papadopoulos::mean_shear(self.history)
    }

    fn largest_shear(&self) -> Option<LargestShear> {
        self.found.shear.as_ref().map(|s| LargestShear { amplitude: s.shear_amplitude, normal_max: s.normal_max })
    }

    fn history(&self) -> Cow<'_, History> {
        Cow::Borrowed(self.history)
    }

    fn searched(&self) -> Option<&CriticalPlanes> {
        Some(self.found)
    }
}

/// All criteria for one history.
///
/// # Errors
/// [`Undefined`] where the limits leave no constant for one of them.
pub fn evaluate(history: &History, limits: &Limits, criteria: &[Criterion], grid: Grid) -> Result<(Vec<Verdict>, Invariants), Undefined> {
    let invariants = Invariants::by(history, grid.deviator);
    let weight = |asks: fn(Critical) -> bool| criteria.iter().find(|c| asks(c.0.critical)).map(|c| c.weight(limits)).transpose();
    let wanted = Wanted {
        shear: weight(|c| matches!(c, Critical::Shear))?.is_some(),
        findley: weight(|c| matches!(c, Critical::Findley))?,
        dang_van: weight(|c| matches!(c, Critical::DangVan))?,
    };
    let found = search::search(history, &wanted, grid);
    let path = Searched { history, invariants: &invariants, found: &found };
    let verdict = |criterion: &Criterion| -> Result<Verdict, Undefined> {
        let told;
        let at = match criterion.0.critical {
            Critical::None => None,
            Critical::Told(critical) => {
                told = critical(history, limits);
                Some(&told)
            }
            Critical::Shear => found.shear.as_ref(),
            Critical::Findley => found.findley.as_ref(),
            Critical::DangVan => found.dang_van.as_ref(),
        };
        let stress = if let Critical::Told(_) = criterion.0.critical { at.map(|a| a.value) } else { criterion.stress(&path, limits)? };
        let stress = stress.unwrap_or(0.0);
        Ok(Verdict {
            criterion: *criterion,
            safety_factor: if stress > 0.0 { limits.torsion / stress } else { f64::INFINITY },
            plane: at.map(|a| a.plane),
            shear_amplitude: at.map(|a| a.shear_amplitude),
            normal_max: at.map(|a| a.normal_max),
            note: at.map_or_else(String::new, |a| a.note.clone()),
        })
    };
    let verdicts = criteria.iter().map(verdict).collect::<Result<Vec<_>, _>>()?;
    Ok((verdicts, invariants))
}
