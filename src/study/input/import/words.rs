//! What a head says, in English, German, French and Portuguese.

use super::unit::{self, SURROUNDINGS, Units, known, parts};

const THROW: &[&str] = &["throw", "kropfung", "kroepfung", "maneton", "manivela"];
const DAMPING: &[&str] = &["damp", "dampf", "daempf", "amort"];
const TO_GROUND: &[&str] = &[
    "ground",
    "absolut",
    "absolu",
    "extern",
    "aussen",
    "ausser",
    "aeusser",
    "gehaus",
    "gehaeus",
    "grund",
    "terra",
    "boden",
    "erde",
    "gestell",
    "fundament",
    "housing",
    "frame",
];
const TO_NEXT: &[&str] = &[
    "next", "relativ", "shaft", "intern", "innere", "welle", "folgend", "nachst", "naechst", "arbre", "suivant", "eixo", "seguinte",
    "proxim",
];
const TO_PREVIOUS: &[&str] = &["previous", "preceding", "vorherig", "vorig", "vorgang", "vorgaeng", "precedent", "anterior"];
const STIFFNESS: &[&str] = &["stiff", "steif", "federrate", "federkonst", "drehfeder", "raideur", "rigid"];
const INERTIA: &[&str] = &["inertia", "tragheit", "traegheit", "drehmasse", "inertie", "inercia"];
const STATION: &[&str] = &[
    "station",
    "mass",
    "name",
    "element",
    "node",
    "designation",
    "stelle",
    "bauteil",
    "bezeichnung",
    "benennung",
    "knoten",
    "nom",
    "noeud",
    "estacao",
    "designacao",
    "nome",
];

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    Name,
    Inertia,
    Stiffness,
    DampingToNext,
    LossFactorToNext,
    DampingToGround,
    Throws,
}

/// Whether a damping is named, or a sign stands with its unit (k in German), that may be to the next station or to ground.
pub(super) fn is_damping(words: &str, unit: Option<&str>) -> bool {
    DAMPING.iter().any(|w| words.contains(w)) || has_unit_of(Role::DampingToNext, unit)
}

fn has_unit_of(role: Role, unit: Option<&str>) -> bool {
    unit.is_some_and(|u| known(units(role), u).is_some())
}

/// Whether a (folded) head names a stiffness to ground.
pub(super) fn is_stiffness_to_ground(words: &str) -> bool {
    let has = |list: &[&str]| list.iter().any(|w| words.contains(w));
    has(STIFFNESS) && has(TO_GROUND) && !has(TO_NEXT)
}

/// Whether a (folded) head names what lies before a station.
pub(super) fn is_to_previous(words: &str) -> bool {
    TO_PREVIOUS.iter().any(|w| words.contains(w))
}

/// Whether a (folded) name is that of a row of sums.
pub(super) fn is_sum(words: &str) -> bool {
    let first = words.split(|c: char| !c.is_alphanumeric()).next().unwrap_or("");
    ["sum", "summe", "gesamt", "total", "totals", "somme", "soma"].contains(&first)
}

/// Whether a (folded) head names the ratio of a gear.
pub(super) fn is_ratio(words: &str) -> bool {
    ["ratio", "drehzahlverh", "ubersetzung", "uebersetzung", "rapport", "relacao", "transmiss"].iter().any(|w| words.contains(w))
}

/// How many loss factors one is, where a (folded) head names the loss factor of a shaft, or the relative damping ψ of a coupling \[DIN 740-2\], and whether it is that: the energy lost in a cycle over that stored, 2π loss factors.
pub(super) fn loss_factors(words: &str, unit: Option<&str>) -> Option<(f64, bool)> {
    let (percent, says_psi) = match unit.map(str::trim) {
        None | Some("" | "-" | "–" | "1") => (1.0, false),
        Some("%") => (0.01, false),
        Some("ψ") => (1.0, true),
        Some(_) => return None,
    };
    // a relative damping without a unit is ψ: that of a coupling's maker in N m s/rad has one
    let is_relative = || {
        let is_rel = ["relativ", "verhaltnismass", "verhaeltnismaess"].iter().any(|w| words.contains(w)) || has_word(words, &["rel"]);
        // a dynamic magnifier is 2π/ψ
        is_rel && DAMPING.iter().any(|w| words.contains(w)) && unit.is_some() && !words.contains("magnif")
    };
    let is_psi = says_psi || words.split(|c: char| !c.is_alphanumeric()).any(|word| ["ψ", "psi"].contains(&word)) || is_relative();
    let is_named = ["loss factor", "loss_factor", "verlustfaktor", "facteur de perte", "fator de perda"].iter().any(|w| words.contains(w));
    match (is_named, is_psi) {
        (true, false) => Some((percent, false)),
        (false, true) => Some((percent / std::f64::consts::TAU, true)),
        _ => None,
    }
}

impl Role {
    /// By the (folded) words of a head, without its unit.
    pub(super) fn of(words: &str, unit: Option<&str>) -> Option<Self> {
        let has = |list: &[&str]| list.iter().any(|w| words.contains(w));
        if has(THROW) && !has(INERTIA) && !has(STIFFNESS) && !has(DAMPING) {
            return Some(Self::Throws);
        }
        if loss_factors(words, unit).is_some() {
            return Some(Self::LossFactorToNext);
        }
        if has(DAMPING) {
            let begins = |with: &str| words.split(|c: char| !c.is_alphanumeric()).any(|word| word == with);
            return if has(TO_GROUND) || begins("abs") {
                Some(Self::DampingToGround)
            } else if has(TO_NEXT) || begins("rel") {
                Some(Self::DampingToNext)
            } else {
                None
            };
        }
        // c and k are stiffness and damping in German, damping and stiffness in English: their unit tells
        let is_rate = || has_unit_of(Self::Stiffness, unit);
        let is_damped = || has_unit_of(Self::DampingToNext, unit);
        if is_stiffness_to_ground(words) {
            return None;
        }
        if has(STIFFNESS) || words == "k" && !is_damped() || ["c", "ct", "c_t"].contains(&words) && is_rate() {
            return Some(Self::Stiffness);
        }
        if has(INERTIA) || ["j", "θ", "theta"].contains(&words) {
            return Some(Self::Inertia);
        }
        // a mass in kg is no name
        let weighs = unit.is_some_and(|u| ["kg", "g", "t", "lb"].contains(&u.trim()));
        (has(STATION) && !weighs).then_some(Self::Name)
    }

    /// One to show in a message.
    pub(super) fn example(self) -> &'static str {
        match self {
            Self::Inertia => "Inertia [kg m2]",
            Self::Stiffness => "Stiffness to next [N m/rad]",
            Self::DampingToNext => "Damping to next [N m s/rad]",
            Self::LossFactorToNext => "Loss factor",
            Self::DampingToGround => "Damping to ground [N m s/rad]",
            Self::Name => "Station",
            Self::Throws => "Throws",
        }
    }
}

/// Whether a (folded) head names the angle of the crank.
pub(crate) fn is_angle(words: &str) -> bool {
    named(words, &["angle", "crank", "ca", "deg", "theta", "winkel", "kurbel", "kw", "grad", "angulo", "manivela", "vilebrequin", "phi"])
}

/// Whether a (folded) head names a pressure.
pub(super) fn is_pressure(words: &str) -> bool {
    named(words, &["press", "p", "bar", "pcyl", "pzyl"]) || words.contains("druck")
}

/// What is wrong with what a head says.
pub(crate) struct HeadFault {
    pub expected: &'static str,
    pub help: &'static str,
}

/// Where a head says that pressures are above that of the surroundings.
pub(crate) fn not_absolute(head: &str) -> Option<HeadFault> {
    const GAUGE: [&str; 7] = ["uberdruck", "ueberdruck", "relativ", "gauge", "manometr", "surpression", "sobrepress"];
    let words = parts(head).0;
    let gauge = GAUGE.iter().any(|word| words.contains(word)) || has_word(&words, &["rel", "gage"]);
    gauge.then_some(HeadFault { expected: "absolute pressures", help: SURROUNDINGS })
}

/// Where a head says that angles are before the dead centre of firing, or from another one.
pub(crate) fn not_from_firing(head: &str) -> Option<HeadFault> {
    let lower = head.to_lowercase();
    let squeezed: String = lower.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty()).collect::<Vec<_>>().join(" ");
    if has_word(&lower, &["before", "btdc", "avant", "antes"]) || ["vor ot", "v ot"].iter().any(|words| squeezed.contains(words)) {
        return Some(HeadFault {
            expected: "angles after the firing (top) dead centre",
            help: "angles before it are negative: turn the signs, and the rows with them",
        });
    }
    has_word(&lower, &["ut", "bdc", "pmb", "pmi"]).then_some(HeadFault {
        expected: "angles from the firing (top) dead centre",
        help: "from the bottom dead centre before compression they are 180 degrees more",
    })
}

/// Whether one of these is a word of a text.
fn has_word(text: &str, list: &[&str]) -> bool {
    text.split(|c: char| !c.is_alphanumeric()).any(|word| list.contains(&word))
}

/// Speed, rpm, and load, per cent, of which a (folded) head is: a number before `rpm`, `1/min` and the like, and one before `%`; full load where none is named.
pub(crate) fn speed_and_load(words: &str) -> Option<(f64, f64)> {
    const PER_MINUTE: [&str; 9] = ["rpm", "r/min", "u/min", "upm", "1/min", "min-1", "min⁻¹", "tr/min", "/min"];
    let spaced = words.replace('%', " % ").replace(['_', '='], " ");
    let tokens: Vec<&str> = spaced.split_whitespace().flat_map(apart).filter(|t| !t.is_empty()).collect();
    let before = |is: &dyn Fn(&str) -> bool| {
        let places: Vec<usize> = (1..tokens.len()).filter(|i| is(tokens[*i])).collect();
        match places.as_slice() {
            // whole numbers: `1.600` may be grouped or not
            [one] => Some(Some(f64::from(tokens[one - 1].parse::<u32>().ok()?))),
            [] => Some(None),
            _ => None,
        }
    };
    let speed = before(&|t| PER_MINUTE.contains(&t))??;
    let load = before(&|t| ["%", "percent", "prozent"].contains(&t))?.unwrap_or(FULL);
    Some((speed, load))
}

/// Full load, per cent.
const FULL: f64 = 100.0;

/// A number and what stands behind it without a blank: "1600rpm", but "1/min" as it is.
fn apart(token: &str) -> [&str; 2] {
    let end = token.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(token.len());
    if token[end..].starts_with('/') { [token, ""] } else { token.split_at(end).into() }
}

/// Whether a part of a head is one of these words, or begins with one of more than two letters.
fn named(words: &str, list: &[&str]) -> bool {
    let parts = words.split([' ', '_']).map(|part| part.trim_start_matches('°'));
    parts.filter(|part| !part.is_empty()).any(|part| list.iter().any(|w| part == *w || w.len() > 2 && part.starts_with(w)))
}

/// Units of what a column holds, in SI.
pub(super) fn units(role: Role) -> Units {
    match role {
        Role::Inertia => unit::INERTIA,
        Role::Stiffness => unit::STIFFNESS,
        Role::DampingToNext | Role::DampingToGround => unit::DAMPING,
        Role::Name | Role::Throws | Role::LossFactorToNext => &[],
    }
}
