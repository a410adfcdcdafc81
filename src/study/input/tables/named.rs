//! Columns whose heads say in other words, and with a unit, what our own keys say: as laboratories and makers of dampers write them, in English, German, French and Portuguese.

use super::shown::shown;
use crate::input::files::remark;
use crate::input::import::unit::{DAMPING, INERTIA, STIFFNESS, STRESS, Units, folded, known, parts, scale};
use crate::units::RAD_PER_DEG;
use std::path::Path;

/// A column that a table may have.
pub(super) struct Named {
    key: &'static str,
    words: Words,
    /// Empty where it has none.
    units: Units,
}

/// What the (folded) words of a head are to be.
enum Words {
    /// One of these stands in them.
    Hold(&'static [&'static str]),
    /// One of these, and one of those.
    Both(&'static [&'static str], &'static [&'static str]),
    /// A component of a stress: a word for stress, or none, and these two axes in either sequence, as letters or numbers.
    Stress(char, char),
}
use Words::{Both, Hold, Stress};

const STIFF: &[&str] = &["stiff", "steif", "federrate", "raideur", "rigid"];
const DAMP: &[&str] = &["damp", "dampf", "daempf", "amort"];
const OF_INERTIA: &[&str] = &["inertia", "tragheit", "traegheit", "inertie", "inercia"];
const LOSS: &[&str] = &["loss factor", "verlustfaktor", "facteur de perte", "fator de perda", "tan δ", "tanδ", "tan delta"];
/// Of one, or in per cent.
const SHARE: Units = &[("", 1.0), ("percent", 0.01)];

/// Of measured stiffness.
pub(super) const MEASURED: [Named; 7] = [
    Named { key: "temperature_c", words: Hold(&["temp"]), units: &[("°C", 1.0), ("C", 1.0), ("deg C", 1.0)] },
    Named { key: "frequency_hz", words: Hold(&["freq"]), units: &[("Hz", 1.0), ("kHz", 1e3)] },
    Named { key: "loss_factor", words: Hold(LOSS), units: SHARE },
    Named {
        key: "loss_angle_deg",
        words: Hold(&["verlustwinkel", "loss angle", "phasenwinkel", "phase angle", "angle de perte", "angulo de perda"]),
        units: &[("deg", 1.0), ("°", 1.0), ("rad", 1.0 / RAD_PER_DEG)],
    },
    Named { key: "damping_n_m_s_per_rad", words: Hold(DAMP), units: DAMPING },
    Named {
        key: "stiffness_magnitude_n_m_per_rad",
        words: Hold(&["|c", "|k", "|s", "betrag", "magnitude", "absolutwert"]),
        units: STIFFNESS,
    },
    Named { key: "stiffness_n_m_per_rad", words: Hold(STIFF), units: STIFFNESS },
];

/// Of the hub of an absorber in a catalogue, in a column of its own.
pub(super) const HUB_INERTIA: &str = "hub_inertia_kg_m2";
/// Of the ring on its held hub: in the place of the stiffness of types whose spring is the same at every frequency.
pub(super) const OWN_FREQUENCY: &str = "own_frequency_hz";

/// Of catalogues.
pub(super) const CATALOGUE: [Named; 8] = [
    Named {
        key: "name",
        words: Hold(&[
            "name",
            "bezeichnung",
            "benennung",
            "designation",
            "designacao",
            "article",
            "artikel",
            "bestell",
            "sachnummer",
            "teilenummer",
        ]),
        units: &[],
    },
    Named { key: "type", words: Hold(&["bauart", "typ", "tipo"]), units: &[] },
    Named { key: "loss_factor", words: Hold(LOSS), units: SHARE },
    Named { key: HUB_INERTIA, words: Both(OF_INERTIA, &["nabe", "hub", "moyeu", "cubo", "primar", "primaer"]), units: INERTIA },
    Named {
        key: OWN_FREQUENCY,
        words: Hold(&["eigenfreq", "own freq", "natural freq", "resonan", "frequence propre", "frequencia propria"]),
        units: &[("Hz", 1.0)],
    },
    Named { key: "ring_inertia_kg_m2", words: Hold(OF_INERTIA), units: INERTIA },
    Named { key: "damping_n_m_s_per_rad", words: Hold(DAMP), units: DAMPING },
    Named { key: "stiffness_n_m_per_rad", words: Hold(STIFF), units: STIFFNESS },
];

const POINT: Named = Named { key: "point", words: Hold(&["punkt", "point", "ponto", "knoten", "node", "noeud", "stelle"]), units: &[] };
/// A component of a stress tensor, as programs of finite elements name them: S11, SXX, σ_x, tau xy.
const fn stress(key: &'static str, a: char, b: char) -> Named {
    Named { key, words: Stress(a, b), units: STRESS }
}
const XX: Named = stress("sxx_mpa", 'x', 'x');
const YY: Named = stress("syy_mpa", 'y', 'y');
const ZZ: Named = stress("szz_mpa", 'z', 'z');
const XY: Named = stress("sxy_mpa", 'x', 'y');
const YZ: Named = stress("syz_mpa", 'y', 'z');
const ZX: Named = stress("szx_mpa", 'z', 'x');

const ANGLE: Named = Named {
    key: "crank_deg",
    words: Hold(&["winkel", "angle", "angulo", "crank", "phi"]),
    units: &[("deg", 1.0), ("°KW", 1.0), ("KW", 1.0), ("°CA", 1.0), ("CA", 1.0)],
};

/// Of loads over the cycle.
pub(super) const LOADS: [Named; 1] = [ANGLE];

/// Of histories of stress.
pub(super) const HISTORY: [Named; 8] = [POINT, ANGLE, XX, YY, ZZ, XY, YZ, ZX];

/// Of stresses per unit load.
pub(super) const UNIT_LOADS: [Named; 8] =
    [POINT, Named { key: "load", words: Hold(&["last", "load", "charge", "carga"]), units: &[] }, XX, YY, ZZ, XY, YZ, ZX];

/// Words that make something else of a column: the inertia of the hub or of the whole damper, a static stiffness or its loss, an angular frequency, the frequency of a damper on its engine.
const OTHERS: [&str; 29] = [
    "gekoppelt",
    "eingebaut",
    "coupled",
    "installed",
    "primar",
    "primaer",
    "stat.",
    "statisch",
    "static",
    "statique",
    "nabe",
    "hub",
    "moyeu",
    "cubo",
    "gehaus",
    "gehaeus",
    "housing",
    "carter",
    "gesamt",
    "total",
    "stiffness loss",
    "loss stiffness",
    "verluststeif",
    "imagin",
    "kreis",
    "winkelfreq",
    "angular",
    "circular",
    "puls",
];

/// The key that a head says in other words, and the factor of its unit; `None` where it is none of these, may be another, or where its unit is not one of the column's.
pub(super) fn key(list: &[Named], head: &str) -> Option<(&'static str, f64)> {
    let (words, unit) = parts(head);
    let own = list.iter().find(|n| n.words.are(&words))?;
    let is_other = own.key != HUB_INERTIA && OTHERS.iter().any(|w| words.contains(w));
    if is_other || scale(&words).is_some() {
        return None;
    }
    let unit = unit.filter(|u| !["", "-", "–", "1"].contains(&u.trim()));
    match (unit, own.units) {
        (None, []) => Some((own.key, 1.0)),
        (None, units) if units.iter().any(|u| u.0.is_empty()) => Some((own.key, 1.0)),
        (Some(unit), units) => known(units, if unit.trim() == "%" { "percent" } else { &unit }).map(|factor| (own.key, factor)),
        (None, _) => None,
    }
}

/// Tells what columns whose heads are not their keys were read as.
pub(super) fn tell<'h>(path: &Path, heads: impl Iterator<Item = (&'h str, &'h str)>) {
    let read: Vec<String> = heads.filter(|(head, key)| head != key).map(|(head, key)| format!("`{}` as `{key}`", shown(head))).collect();
    if !read.is_empty() {
        remark(path, &format!("columns are read: {}", read.join(", ")));
    }
}

impl Words {
    /// Whether the (folded) words of a head are these.
    fn are(&self, words: &str) -> bool {
        let has = |list: &[&str]| list.iter().any(|w| words.contains(w));
        match self {
            Hold(list) => has(list),
            Both(one, other) => has(one) && has(other),
            Stress(a, b) => component(words).is_some_and(|found| found == (*a, *b) || found == (*b, *a)),
        }
    }
}

/// The axes of a component of stress; x, y, z are 1, 2, 3 as well. One letter of a normal stress is both, while one number is that of a principal stress.
fn component(words: &str) -> Option<(char, char)> {
    let plain: String = words.chars().filter(|c| c.is_alphanumeric()).collect();
    let shear = ["schubspannung", "shearstress", "shear", "tau", "τ"];
    let either = ["normalspannung", "normalstress", "spannung", "stress", "contrainte", "tensao", "sigma", "σ", "s", "t"];
    let axes = shear.iter().chain(&either).find_map(|begin| plain.strip_prefix(begin))?;
    let axis = |c: char| match c {
        'x' | '1' => Some('x'),
        'y' | '2' => Some('y'),
        'z' | '3' => Some('z'),
        _ => None,
    };
    let axes_are_letters = axes.chars().all(char::is_alphabetic);
    let axes: Vec<char> = axes.chars().map(axis).collect::<Option<_>>()?;
    match axes.as_slice() {
        [a] => (axes_are_letters && !shear.iter().any(|begin| plain.starts_with(begin))).then_some((*a, *a)),
        [a, b] => Some((*a, *b)),
        _ => None,
    }
}

/// The type of absorber that a word of another language names; the word itself where it is none.
pub(super) fn type_of(word: &str) -> &str {
    // not viscoelastic ones, which are of rubber
    const WORDS: [(&str, &str); 11] = [
        ("gummi", "rubber"),
        ("kautschuk", "rubber"),
        ("elastomer", "rubber"),
        ("caoutchouc", "rubber"),
        ("borracha", "rubber"),
        ("viskos", "viscous"),
        ("visko", "viscous"),
        ("viscous", "viscous"),
        ("visqueu", "viscous"),
        ("viscoso", "viscous"),
        ("abgestimmt", "tuned"),
    ];
    let plain = folded(word);
    WORDS.iter().find(|(begin, _)| plain.starts_with(begin)).map_or(word, |(_, name)| name)
}
