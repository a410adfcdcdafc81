//! The criteria, one row each: constant, equivalent shear stress, and a bound of it. Formulas and sources stand in the table of this room's first page.

use super::bound::{Within, pressed, round};
use super::carpinteri;
use super::criterion::{Criterion, Critical, Limits, Path, Row, Shear, Undefined};

impl Criterion {
    /// All of them, in the order of tables.
    pub const ALL: [Self; 12] = [
        Self::MATAKE,
        Self::MCDIARMID,
        Self::DANG_VAN_THESIS,
        Self::DANG_VAN_PLANE,
        Self::DANG_VAN_MESOSCOPIC,
        Self::SINES,
        Self::CROSSLAND,
        Self::KAKUNO_KAWADA,
        Self::KAKUNO_KAWADA_CONSISTENT,
        Self::FINDLEY,
        Self::PAPADOPOULOS,
        Self::CARPINTERI_SPAGNOLI,
    ];

    /// Plane of the largest shear amplitude; its normal stress.
    pub const MATAKE: Self = Self(&Row {
        name: "matake",
        weight: |l| Ok(2.0 * l.torsion / l.bending - 1.0),
        shear: Shear::Planes,
        critical: Critical::Shear,
        normal: true,
        ridges: false,
        stress: |path, k, _| path.largest_shear().map(|s| s.amplitude + k * s.normal_max),
        bound: |w, k, _| w.shear + k.abs() * w.normal,
    });

    /// The same plane; less weight on the normal stress.
    pub const MCDIARMID: Self = Self(&Row { name: "mcdiarmid", weight: |l| Ok(l.torsion / (2.0 * l.tensile)), ..*Self::MATAKE.0 });

    /// Largest shear amplitude; largest hydrostatic stress, not necessarily at the same time.
    pub const DANG_VAN_THESIS: Self = Self(&Row {
        name: "dang_van_thesis",
        weight: |l| Ok(3.0 * l.torsion / l.bending - 1.5),
        shear: Shear::Planes,
        critical: Critical::Shear,
        normal: false,
        ridges: false,
        stress: |path, k, _| path.largest_shear().map(|s| s.amplitude + k * path.hydrostatic().1),
        bound: |w, k, _| w.shear + pressed(w, k),
    });

    /// Shear and hydrostatic stress at the same time, plane by plane.
    pub const DANG_VAN_PLANE: Self = Self(&Row {
        name: "dang_van_plane",
        critical: Critical::DangVan,
        ridges: true,
        stress: |path, _, _| path.searched().map(|f| f.dang_van.as_ref().map_or(0.0, |s| s.value)),
        ..*Self::DANG_VAN_THESIS.0
    });

    /// Tresca stress of the mesoscopic deviator and hydrostatic stress at the same time.
    pub const DANG_VAN_MESOSCOPIC: Self = Self(&Row {
        name: "dang_van_mesoscopic",
        weight: Self::DANG_VAN_THESIS.0.weight,
        shear: Shear::Ball,
        critical: Critical::None,
        normal: false,
        ridges: true,
        stress: |path, k, _| Some(path.mesoscopic(k)),
        bound: |w, k, _| {
            let sum = w.sqrt_j2_amplitude + pressed(w, k);
            w.middle.map_or(sum, |(low, high)| sum.min(w.sqrt_j2_amplitude * round(k) + (k * low).max(k * high) / 3.0))
        },
    });

    /// Mean hydrostatic stress.
    pub const SINES: Self = Self(&Row {
        name: "sines",
        weight: |l| Ok(3.0 * l.torsion / l.repeated_bending - root_3()),
        shear: Shear::Ball,
        critical: Critical::None,
        normal: false,
        ridges: false,
        stress: |path, k, _| Some(path.sqrt_j2_amplitude() + k * mean(path)),
        bound: |w, k, _| w.sqrt_j2_amplitude + pressed(w, k),
    });

    /// Largest hydrostatic stress.
    pub const CROSSLAND: Self = Self(&Row {
        name: "crossland",
        weight: |l| Ok(3.0 * l.torsion / l.bending - root_3()),
        stress: |path, k, _| Some(path.sqrt_j2_amplitude() + k * path.hydrostatic().1),
        ..*Self::SINES.0
    });

    /// Amplitude and mean of the hydrostatic stress, constants as printed.
    pub const KAKUNO_KAWADA: Self = Self(&Row {
        name: "kakuno_kawada",
        weight: Self::CROSSLAND.0.weight,
        stress: |path, k, l| {
            Some(path.sqrt_j2_amplitude() + k * amplitude(path) + (3.0 * l.torsion / l.repeated_bending - root_3()) * mean(path))
        },
        bound: |w, k, l| w.sqrt_j2_amplitude + ranging(w, k) + pressed(w, 3.0 * l.torsion / l.repeated_bending - root_3()),
        ..*Self::SINES.0
    });

    /// The same with the constant that its own calibration asks for.
    pub const KAKUNO_KAWADA_CONSISTENT: Self = Self(&Row {
        name: "kakuno_kawada_consistent",
        stress: |path, k, l| Some(path.sqrt_j2_amplitude() + k * amplitude(path) + consistent(l) * mean(path)),
        bound: |w, k, l| w.sqrt_j2_amplitude + ranging(w, k) + pressed(w, consistent(l)),
        ..*Self::KAKUNO_KAWADA.0
    });

    /// Largest combination over all planes.
    pub const FINDLEY: Self = Self(&Row {
        name: "findley",
        weight: findley,
        shear: Shear::Planes,
        critical: Critical::Findley,
        normal: true,
        ridges: false,
        stress: |path, k, _| path.searched().map(|f| f.findley.as_ref().map_or(0.0, |s| s.value) / (1.0 + k * k).sqrt()),
        bound: |w, k, _| (w.shear + k * w.normal) / (1.0 + k * k).sqrt(),
    });

    /// Mean of the resolved shear amplitude over all planes and directions.
    pub const PAPADOPOULOS: Self = Self(&Row {
        name: "papadopoulos",
        weight: Self::CROSSLAND.0.weight,
        shear: Shear::Mean,
        critical: Critical::None,
        normal: false,
        ridges: false,
        stress: |path, k, _| Some(path.mean_shear() + k * path.hydrostatic().1),
        bound: |w, k, _| w.mean_shear + pressed(w, k),
    });

    /// Plane at an angle from the largest principal stress of the cycle; its normal and shear stress.
    pub const CARPINTERI_SPAGNOLI: Self = Self(&Row {
        name: "carpinteri_spagnoli",
        weight: |l| Ok(l.bending / l.tensile),
        shear: Shear::Planes,
        critical: Critical::Told(carpinteri::critical),
        normal: true,
        ridges: false,
        stress: |path, _, l| Some(carpinteri::critical(&path.history(), l).value),
        bound: |w, _, l| carpinteri::combined((w.normal, w.normal), w.shear, l),
    });
}

fn root_3() -> f64 {
    3f64.sqrt()
}

/// Middle of the range of the hydrostatic stress.
fn mean(path: &dyn Path) -> f64 {
    let (low, high) = path.hydrostatic();
    0.5 * (high + low)
}

/// Half its range.
fn amplitude(path: &dyn Path) -> f64 {
    let (low, high) = path.hydrostatic();
    0.5 * (high - low)
}

/// At least k times half the range of the hydrostatic stress.
fn ranging(w: &Within, k: f64) -> f64 {
    (0.5 * k * (w.hydrostatic.1 - w.hydrostatic.0)).max(0.0)
}

/// l of Kakuno and Kawada by repeated bending.
fn consistent(l: &Limits) -> f64 {
    3.0 * l.torsion / l.repeated_bending - 3.0 * l.torsion / l.bending
}

/// k of Findley by both limits.
fn findley(l: &Limits) -> Result<f64, Undefined> {
    let (f, d) = (l.bending, 2.0 * l.torsion - l.bending);
    if !(0.0..f).contains(&d) {
        let expected = "of at least half, and less than the whole, of";
        return Err(Undefined { criterion: "findley", expected, ratio: l.torsion / f });
    }
    Ok(d / (f * f - d * d).sqrt())
}
