//! Units as heads of tables write them.

use super::sheet::Sheet;
use crate::input::error::InputError;

/// Units as they are written without spaces and signs, and how many of SI each is.
pub(super) type Units = &'static [(&'static str, f64)];

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    Name,
    Inertia,
    Stiffness,
    DampingToNext,
    DampingToGround,
    Throws,
}

impl Role {
    /// By the words of a head, without its unit.
    pub(super) fn of(words: &str) -> Option<Self> {
        let has = |list: &[&str]| list.iter().any(|w| words.contains(w));
        if has(&["throw"]) && !has(&["inertia", "stiff", "damp"]) {
            return Some(Self::Throws);
        }
        if has(&["damp"]) {
            return if has(&["ground", "absolute", "external"]) {
                Some(Self::DampingToGround)
            } else if has(&["next", "relative", "shaft", "internal"]) {
                Some(Self::DampingToNext)
            } else {
                None
            };
        }
        if has(&["stiff"]) || words == "k" {
            return Some(Self::Stiffness);
        }
        if has(&["inertia"]) || words == "j" {
            return Some(Self::Inertia);
        }
        has(&["station", "mass", "name", "element", "node", "designation"]).then_some(Self::Name)
    }

    /// Units by how many of them are one in SI, each as it is written without spaces and signs.
    pub(super) fn units(self) -> Units {
        match self {
            Self::Inertia => &[("kgm2", 1.0), ("gm2", 1e-3), ("kgcm2", 1e-4), ("kgmm2", 1e-6), ("tm2", 1e3)],
            Self::Stiffness => &[("nm/rad", 1.0), ("knm/rad", 1e3), ("mnm/rad", 1e6)],
            Self::DampingToNext | Self::DampingToGround => &[("nms/rad", 1.0), ("knms/rad", 1e3)],
            Self::Name | Self::Throws => &[],
        }
    }

    /// One to show in a message.
    pub(super) fn example(self) -> &'static str {
        match self {
            Self::Inertia => "Inertia [kg m2]",
            Self::Stiffness => "Stiffness to next [N m/rad]",
            Self::DampingToNext => "Damping to next [N m s/rad]",
            Self::DampingToGround => "Damping to ground [N m s/rad]",
            Self::Name => "Station",
            Self::Throws => "Throws",
        }
    }
}

/// The factor to SI of a column, from the unit in its head.
///
/// # Errors
/// [`InputError`] at the head where it names no unit or another one.
pub(super) fn factor(sheet: &Sheet, column: usize, (units, example): (Units, &str), unit: Option<String>) -> Result<f64, InputError> {
    if units.is_empty() {
        return Ok(1.0);
    }
    let Some(unit) = unit else {
        return Err(sheet.at(1, column, format!("found no unit, expected one in the header, such as `{example}`")));
    };
    let plain: String = unit.to_lowercase().replace('²', "2").chars().filter(|c| c.is_alphanumeric() || ['/', '°'].contains(c)).collect();
    // a milli and a mega differ by their first letter only
    let is_milli = unit.trim_start().starts_with("mN");
    let known = units.iter().find(|(name, _)| *name == plain && !is_milli);
    known.map(|u| u.1).ok_or_else(|| {
        let all = units.iter().map(|u| u.0).collect::<Vec<_>>().join(", ");
        sheet.at(1, column, format!("found the unit `{unit}`, expected one of {all}"))
    })
}

/// Words of a head in small letters, and its unit: in brackets, or behind the words as in our own columns.
pub(super) fn parts(head: &str) -> (String, Option<String>) {
    if let Some((words, rest)) = head.split_once(['[', '(']) {
        return (words.trim().to_lowercase(), Some(rest.trim_end_matches([']', ')', ' ']).to_owned()));
    }
    for (end, unit) in [("_kg_m2", "kg m2"), ("_n_m_s_per_rad", "N m s/rad"), ("_n_m_per_rad", "N m/rad")] {
        if let Some(words) = head.strip_suffix(end) {
            return (words.to_lowercase(), Some(unit.to_owned()));
        }
    }
    match head.split_once(',').or_else(|| head.split_once('/').filter(|(_, unit)| unit.starts_with("kg") || unit.starts_with('N'))) {
        Some((words, unit)) => (words.trim().to_lowercase(), Some(unit.trim().to_owned())),
        None => (head.trim().to_lowercase(), None),
    }
}
