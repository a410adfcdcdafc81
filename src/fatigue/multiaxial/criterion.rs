//! The criteria, and the verdict of each on a history.

use super::history::History;
use super::invariants::Invariants;
use super::largest_shear::LargestShear;
use super::papadopoulos;
use super::plane::Plane;
use super::search::{self, Found, Grid, Wanted};

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

/// A criterion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Criterion {
    /// Plane of the largest shear amplitude; its normal stress.
    Matake,
    /// The same plane; less weight on the normal stress.
    McDiarmid,
    /// Largest shear amplitude; largest hydrostatic stress, not necessarily at the same time.
    DangVanThesis,
    /// Shear and hydrostatic stress at the same time, plane by plane.
    DangVanPlane,
    /// Tresca stress of the mesoscopic deviator and hydrostatic stress at the same time.
    DangVanMesoscopic,
    /// Mean hydrostatic stress.
    Sines,
    /// Largest hydrostatic stress.
    Crossland,
    /// Amplitude and mean of the hydrostatic stress, constants as printed.
    KakunoKawada,
    /// The same with the constant that its own calibration asks for.
    KakunoKawadaConsistent,
    /// Largest combination over all planes.
    Findley,
    /// Mean of the resolved shear amplitude over all planes and directions.
    Papadopoulos,
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
    /// All of them, in the order of tables.
    pub const ALL: [Self; 11] = [
        Self::Matake,
        Self::McDiarmid,
        Self::DangVanThesis,
        Self::DangVanPlane,
        Self::DangVanMesoscopic,
        Self::Sines,
        Self::Crossland,
        Self::KakunoKawada,
        Self::KakunoKawadaConsistent,
        Self::Findley,
        Self::Papadopoulos,
    ];

    /// The word in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Matake => "matake",
            Self::McDiarmid => "mcdiarmid",
            Self::DangVanThesis => "dang_van_thesis",
            Self::DangVanPlane => "dang_van_plane",
            Self::DangVanMesoscopic => "dang_van_mesoscopic",
            Self::Sines => "sines",
            Self::Crossland => "crossland",
            Self::KakunoKawada => "kakuno_kawada",
            Self::KakunoKawadaConsistent => "kakuno_kawada_consistent",
            Self::Findley => "findley",
            Self::Papadopoulos => "papadopoulos",
        }
    }

    /// Whether what it asks of a plane state is found from the corners of its hull only, not from all samples.
    pub(crate) fn asks_for_corners(self) -> bool {
        !matches!(self, Self::DangVanMesoscopic | Self::Sines | Self::Crossland | Self::KakunoKawada | Self::KakunoKawadaConsistent)
    }

    /// Whether it asks for a search of all planes even of a plane state.
    pub(crate) fn searches_planes(self) -> bool {
        matches!(self, Self::DangVanPlane | Self::Findley)
    }

    /// Whether it asks for the shear amplitude of planes.
    pub(crate) fn is_of_planes(self) -> bool {
        matches!(self, Self::Matake | Self::McDiarmid | Self::Findley | Self::DangVanThesis | Self::DangVanPlane)
    }

    /// Whether it asks for the normal stress on a plane.
    pub(crate) fn asks_for_normal_stress(self) -> bool {
        matches!(self, Self::Matake | Self::McDiarmid | Self::Findley)
    }

    /// Weight of the normal or hydrostatic stress (of its amplitude, for Kakuno and Kawada).
    ///
    /// # Errors
    /// [`Undefined`] where the limits leave no constant.
    pub fn weight(self, l: &Limits) -> Result<f64, Undefined> {
        let (f, t, f0) = (l.bending, l.torsion, l.repeated_bending);
        let root = 3f64.sqrt();
        Ok(match self {
            Self::Matake => 2.0 * t / f - 1.0,
            Self::McDiarmid => t / (2.0 * l.tensile),
            Self::DangVanThesis | Self::DangVanPlane | Self::DangVanMesoscopic => 3.0 * t / f - 1.5,
            Self::Sines => 3.0 * t / f0 - root,
            Self::Crossland | Self::KakunoKawada | Self::KakunoKawadaConsistent | Self::Papadopoulos => 3.0 * t / f - root,
            Self::Findley => {
                let d = 2.0 * t - f;
                if !(0.0..f).contains(&d) {
                    return Err(Undefined {
                        criterion: self.name(),
                        expected: "of at least half, and less than the whole, of",
                        ratio: t / f,
                    });
                }
                d / (f * f - d * d).sqrt()
            }
        })
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
    /// What the plane of the largest shear bears, where it is known without a search of all planes.
    fn largest_shear(&self) -> Option<LargestShear>;
}

impl Path for (&History, &Invariants) {
    fn sqrt_j2_amplitude(&self) -> f64 {
        self.1.sqrt_j2_amplitude
    }

    fn hydrostatic(&self) -> (f64, f64) {
        (self.1.hydrostatic_mean - self.1.hydrostatic_amplitude, self.1.hydrostatic_max())
    }

    fn mesoscopic(&self, k: f64) -> f64 {
        self.1.mesoscopic(self.0, k)
    }

    fn mean_shear(&self) -> f64 {
        papadopoulos::mean_shear(self.0)
    }

    fn largest_shear(&self) -> Option<LargestShear> {
        None
    }
}

impl Criterion {
    /// The equivalent shear stress of a path, Pa; nothing by a criterion that asks for a search of planes.
    ///
    /// # Errors
    /// [`Undefined`] where the limits leave no constant.
    pub(crate) fn by_invariants(self, path: &impl Path, l: &Limits) -> Result<Option<f64>, Undefined> {
        let k = self.weight(l)?;
        let (low, high) = path.hydrostatic();
        let (amplitude, mean) = (0.5 * (high - low), 0.5 * (high + low));
        Ok(Some(match self {
            Self::DangVanMesoscopic => path.mesoscopic(k),
            Self::Sines => path.sqrt_j2_amplitude() + k * mean,
            Self::Crossland => path.sqrt_j2_amplitude() + k * high,
            Self::KakunoKawada => path.sqrt_j2_amplitude() + k * amplitude + Self::Sines.weight(l)? * mean,
            Self::KakunoKawadaConsistent => {
                path.sqrt_j2_amplitude() + k * amplitude + (3.0 * l.torsion / l.repeated_bending - 3.0 * l.torsion / l.bending) * mean
            }
            Self::Papadopoulos => path.mean_shear() + k * high,
            Self::Matake | Self::McDiarmid => return Ok(path.largest_shear().map(|s| s.amplitude + k * s.normal_max)),
            Self::DangVanThesis => return Ok(path.largest_shear().map(|s| s.amplitude + k * high)),
            Self::DangVanPlane | Self::Findley => return Ok(None),
        }))
    }
}

/// All criteria for one history.
///
/// # Errors
/// [`Undefined`] where the limits leave no constant for one of them.
pub fn evaluate(history: &History, limits: &Limits, criteria: &[Criterion], grid: Grid) -> Result<(Vec<Verdict>, Invariants), Undefined> {
    let invariants = Invariants::by(history, grid.deviator);
    let findley = if criteria.contains(&Criterion::Findley) { Criterion::Findley.weight(limits)? } else { 0.0 };
    let dang_van = Criterion::DangVanPlane.weight(limits)?;
    let wanted = |c: &[Criterion]| criteria.iter().any(|w| c.contains(w));
    let wanted = Wanted {
        shear: wanted(&[Criterion::Matake, Criterion::McDiarmid, Criterion::DangVanThesis]),
        findley: wanted(&[Criterion::Findley]).then_some(findley),
        dang_van: wanted(&[Criterion::DangVanPlane]).then_some(dang_van),
    };
    let found = search::search(history, &wanted, grid);
    let mut verdicts = Vec::new();
    for &criterion in criteria {
        verdicts.push(verdict(criterion, history, limits, &invariants, &found)?);
    }
    Ok((verdicts, invariants))
}

fn verdict(criterion: Criterion, history: &History, l: &Limits, i: &Invariants, found: &Found) -> Result<Verdict, Undefined> {
    let k = criterion.weight(l)?;
    let (stress, at) = match criterion {
        Criterion::Matake | Criterion::McDiarmid => {
            (found.shear.as_ref().map_or(0.0, |s| s.shear_amplitude + k * s.normal_max), found.shear.as_ref())
        }
        Criterion::DangVanThesis => {
            (found.shear.as_ref().map_or(0.0, |s| s.shear_amplitude + k * i.hydrostatic_max()), found.shear.as_ref())
        }
        Criterion::DangVanPlane => (found.dang_van.as_ref().map_or(0.0, |s| s.value), found.dang_van.as_ref()),
        Criterion::Findley => (found.findley.as_ref().map_or(0.0, |s| s.value) / (1.0 + k * k).sqrt(), found.findley.as_ref()),
        _ => (criterion.by_invariants(&(history, i), l)?.unwrap_or(0.0), None),
    };
    Ok(Verdict {
        criterion,
        safety_factor: if stress > 0.0 { l.torsion / stress } else { f64::INFINITY },
        plane: at.map(|a| a.plane),
        shear_amplitude: at.map(|a| a.shear_amplitude),
        normal_max: at.map(|a| a.normal_max),
        note: at.map_or_else(String::new, |a| a.note.clone()),
    })
}
