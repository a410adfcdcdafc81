//! Columns whose heads say in other words, and with a unit, what our own keys say: as laboratories and makers of dampers write them, in English, German, French and Portuguese.

use crate::input::import::unit::{DAMPING, INERTIA, STIFFNESS, Units, folded, known, parts, scale};

/// A column that a table may have.
pub(super) struct Named {
    key: &'static str,
    /// One of these stands in a (folded) head.
    words: &'static [&'static str],
    /// Empty where it has none.
    units: Units,
}

const STIFF: &[&str] = &["stiff", "steif", "federrate", "raideur", "rigid"];
const DAMP: &[&str] = &["damp", "dampf", "daempf", "amort"];
const LOSS: &[&str] = &["loss factor", "verlustfaktor", "facteur de perte", "fator de perda", "tan δ", "tanδ", "tan delta"];
/// Of one, or in per cent.
const SHARE: Units = &[("", 1.0), ("percent", 0.01)];

/// Of measured stiffness.
pub(super) const MEASURED: [Named; 5] = [
    Named { key: "temperature_c", words: &["temp"], units: &[("°C", 1.0), ("C", 1.0), ("deg C", 1.0)] },
    Named { key: "frequency_hz", words: &["freq"], units: &[("Hz", 1.0), ("kHz", 1e3)] },
    Named { key: "loss_factor", words: LOSS, units: SHARE },
    Named { key: "damping_n_m_s_per_rad", words: DAMP, units: DAMPING },
    Named { key: "stiffness_n_m_per_rad", words: STIFF, units: STIFFNESS },
];

/// Of catalogues.
pub(super) const CATALOGUE: [Named; 6] = [
    Named { key: "name", words: &["name", "bezeichnung", "benennung", "designation", "designacao", "article", "artikel"], units: &[] },
    Named { key: "type", words: &["bauart", "typ", "tipo"], units: &[] },
    Named { key: "loss_factor", words: LOSS, units: SHARE },
    Named { key: "ring_inertia_kg_m2", words: &["inertia", "tragheit", "traegheit", "inertie", "inercia"], units: INERTIA },
    Named { key: "damping_n_m_s_per_rad", words: DAMP, units: DAMPING },
    Named { key: "stiffness_n_m_per_rad", words: STIFF, units: STIFFNESS },
];

/// Words that make something else of a column: the inertia of the hub or of the whole damper, the loss of a stiffness, an angular frequency.
const OTHERS: [&str; 19] = [
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
    if OTHERS.iter().any(|w| words.contains(w)) || scale(&words).is_some() {
        return None;
    }
    let own = list.iter().find(|n| n.words.iter().any(|w| words.contains(w)))?;
    let unit = unit.filter(|u| !["", "-", "–", "1"].contains(&u.trim()));
    match (unit, own.units) {
        (None, []) => Some((own.key, 1.0)),
        (None, units) if units.iter().any(|u| u.0.is_empty()) => Some((own.key, 1.0)),
        (Some(unit), units) => known(units, if unit.trim() == "%" { "percent" } else { &unit }).map(|factor| (own.key, factor)),
        (None, _) => None,
    }
}

/// The type of absorber that a word of another language names; the word itself where it is none.
pub(super) fn type_of(word: &str) -> &str {
    // not viscoelastic ones, which are of rubber
    const WORDS: [(&str, &str); 10] = [
        ("gummi", "rubber"),
        ("kautschuk", "rubber"),
        ("elastomer", "rubber"),
        ("caoutchouc", "rubber"),
        ("borracha", "rubber"),
        ("viskos", "viscous"),
        ("viscous", "viscous"),
        ("visqueu", "viscous"),
        ("viscoso", "viscous"),
        ("abgestimmt", "tuned"),
    ];
    let plain = folded(word);
    WORDS.iter().find(|(begin, _)| plain.starts_with(begin)).map_or(word, |(_, name)| name)
}
