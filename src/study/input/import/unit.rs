//! Units as heads of tables write them.

use crate::units::{M_PER_IN, N_PER_LBF, PA_PER_BAR, PA_PER_MPA, PA_PER_PSI};
use std::collections::BTreeMap;
use std::sync::RwLock;

/// Units as they are written, and how many of what is wanted each is.
pub(crate) type Units = &'static [(&'static str, f64)];

const DEG_PER_RAD: f64 = 180.0 / std::f64::consts::PI;
/// N m in a lbf in, and in a lbf ft.
const LBF_IN: f64 = N_PER_LBF * M_PER_IN;
const LBF_FT: f64 = 12.0 * LBF_IN;
/// kg in a lb, exact by definition.
const LB: f64 = 0.453_592_37;
/// m/s², by which a kgf is a force.
const STANDARD_GRAVITY: f64 = 9.806_65;

pub(crate) const INERTIA: Units = &[
    ("kg m2", 1.0),
    ("g m2", 1e-3),
    ("kg cm2", 1e-4),
    ("kg mm2", 1e-6),
    ("g cm2", 1e-7),
    ("t m2", 1e3),
    ("N m s2", 1.0),
    ("kgf m s2", STANDARD_GRAVITY),
    ("lb in s2", LBF_IN),
    ("lb ft s2", LBF_FT),
    ("slug ft2", LBF_FT),
    ("lb in2", LB * M_PER_IN * M_PER_IN),
    ("lb ft2", LB * 144.0 * M_PER_IN * M_PER_IN),
];
pub(crate) const STIFFNESS: Units = &[
    ("N m/rad", 1.0),
    ("kN m/rad", 1e3),
    ("MN m/rad", 1e6),
    ("N mm/rad", 1e-3),
    ("N m/deg", DEG_PER_RAD),
    ("kN m/deg", 1e3 * DEG_PER_RAD),
    ("MN m/deg", 1e6 * DEG_PER_RAD),
    ("kgf m/rad", STANDARD_GRAVITY),
    ("lb in/rad", LBF_IN),
    ("lb ft/rad", LBF_FT),
    ("lb in/deg", LBF_IN * DEG_PER_RAD),
    ("lb ft/deg", LBF_FT * DEG_PER_RAD),
];
pub(crate) const DAMPING: Units = &[
    ("N m s/rad", 1.0),
    ("kN m s/rad", 1e3),
    ("N m/rad/s", 1.0),
    ("N m s", 1.0),
    ("N m s/deg", DEG_PER_RAD),
    ("lb in s/rad", LBF_IN),
    ("lb ft s/rad", LBF_FT),
];
/// Stresses, MPa.
pub(crate) const STRESS: Units = &[
    ("MPa", 1.0),
    ("N/mm2", 1.0),
    ("Pa", 1.0 / PA_PER_MPA),
    ("kPa", 1e3 / PA_PER_MPA),
    ("GPa", 1e3),
    ("bar", PA_PER_BAR / PA_PER_MPA),
    ("psi", PA_PER_PSI / PA_PER_MPA),
    ("ksi", 1e3 * PA_PER_PSI / PA_PER_MPA),
];
/// Angles of the crank, degrees, with an example.
pub(crate) const ANGLE: (Units, &str) = (
    &[("deg", 1.0), ("°CA", 1.0), ("CA", 1.0), ("°KW", 1.0), ("KW", 1.0), ("°V", 1.0), ("°vil", 1.0), ("rad", DEG_PER_RAD)],
    "Angle [deg]",
);
/// Absolute pressures, bar, with an example.
pub(crate) const PRESSURE: (Units, &str) = (
    &[
        ("bar", 1.0),
        ("bara", 1.0),
        ("bar abs", 1.0),
        ("mbar", 1e-3),
        ("MPa", 1e6 / PA_PER_BAR),
        ("kPa", 1e3 / PA_PER_BAR),
        ("hPa", 1e2 / PA_PER_BAR),
        ("Pa", 1.0 / PA_PER_BAR),
        ("psi", PA_PER_PSI / PA_PER_BAR),
        ("psia", PA_PER_PSI / PA_PER_BAR),
    ],
    "Pressure [bar]",
);

/// The same parts of units in other words: degrees, pounds of force, and factors in another sequence.
const SAME: [(&str, &str); 17] = [
    ("°", "deg"),
    ("degrees", "deg"),
    ("degree", "deg"),
    ("degres", "deg"),
    ("degre", "deg"),
    ("graus", "deg"),
    ("grad", "deg"),
    ("rad-1", "/rad"),
    ("deg-1", "/deg"),
    ("-", ""),
    ("lbs", "lb"),
    ("lbfin", "lbin"),
    ("lbfft", "lbft"),
    ("inlbf", "lbin"),
    ("ftlbf", "lbft"),
    ("inlb", "lbin"),
    ("ftlb", "lbft"),
];

/// A unit without spaces, powers and signs between its parts, in small letters.
pub(crate) fn plain(unit: &str) -> String {
    let text = folded(&unit.replace("⁻¹", "-1").replace('²', "2"));
    let text: String = text.chars().filter(|c| c.is_alphanumeric() || ['/', '°', '-'].contains(c)).collect();
    // the s of "lb s²" is a second, that of "lbs in²" a plural
    let text = text.replace("lbs2", "lb|s2").replace("lb-s2", "lb|s2");
    SAME.iter().fold(text, |text, (from, to)| text.replace(from, to)).replace('|', "")
}

/// Names of units are no longer.
const LONGEST: usize = 32;

/// The factor of a unit; None where it is none of these.
pub(crate) fn known(units: Units, unit: &str) -> Option<f64> {
    if unit.len() > LONGEST || prefix_of_another(unit).is_some() {
        return None;
    }
    let own = plain(unit);
    units.iter().find(|(name, _)| is_plain(name, &own)).map(|u| u.1)
}

/// Whether a unit of ours is this one, as [`plain`] writes both: each of ours is written so once.
fn is_plain(name: &'static str, own: &str) -> bool {
    static WRITTEN: RwLock<BTreeMap<&'static str, String>> = RwLock::new(BTreeMap::new());
    if let Some(known) = WRITTEN.read().ok().and_then(|all| all.get(name).map(|plain| plain == own)) {
        return known;
    }
    let plain = plain(name);
    let is_own = plain == own;
    if let Ok(mut all) = WRITTEN.write() {
        all.insert(name, plain);
    }
    is_own
}

/// A unit whose first letter means another power of ten than what was meant, with the other: a milli and a mega differ in nothing else.
pub(super) fn prefix_of_another(unit: &str) -> Option<(&'static str, &'static str)> {
    const PAIRS: [(&str, &str); 4] = [("mN", "MN"), ("mn", "MN"), ("mPa", "MPa"), ("Mbar", "mbar")];
    PAIRS.into_iter().find(|p| unit.trim_start().starts_with(p.0))
}

/// What mends a gauge pressure.
pub(super) const SURROUNDINGS: &str = "pressures are absolute: add that of the surroundings, 1.013 bar or 14.7 psi";

/// Whether this is a unit of any column, in brackets or without.
pub(crate) fn is_unit(text: &str) -> bool {
    let text = text.trim();
    let inner = text.strip_prefix(['[', '(']).and_then(|t| t.strip_suffix([']', ')'])).unwrap_or(text);
    [INERTIA, STIFFNESS, DAMPING, ANGLE.0, PRESSURE.0].iter().any(|units| known(units, inner).is_some())
}

/// A power of ten among the words of a head, outside its unit: "×10⁻⁴", "x 10^3", "·1000".
pub(crate) fn scale(words: &str) -> Option<&str> {
    let is_sign = |c: char| ['x', '×', '·', '*', '⋅'].contains(&c);
    let is_one =
        |rest: &str| rest.trim_start().starts_with("10") || rest.trim_start().starts_with("1e") || rest.trim_start().starts_with("1.000");
    let begins = |(i, c): (usize, char)| {
        // an x that ends a word is none
        let alone = !words[..i].ends_with(char::is_alphanumeric);
        (is_sign(c) && alone && is_one(&words[i + c.len_utf8()..])).then_some(&words[i..])
    };
    words.char_indices().find_map(begins).or_else(|| words.find("10^").map(|i| &words[i..])).map(str::trim)
}

/// Letters without their accents, small: ä is a, as Träger and Trager, and Traeger is left as it is.
pub(crate) fn folded(text: &str) -> String {
    let plain = |c: char| match c {
        'à' | 'á' | 'â' | 'ã' | 'ä' => "a".to_owned(),
        'ç' => "c".to_owned(),
        'è' | 'é' | 'ê' | 'ë' => "e".to_owned(),
        'ì' | 'í' | 'î' | 'ï' => "i".to_owned(),
        'ò' | 'ó' | 'ô' | 'õ' | 'ö' => "o".to_owned(),
        'ù' | 'ú' | 'û' | 'ü' => "u".to_owned(),
        'ß' => "ss".to_owned(),
        'œ' => "oe".to_owned(),
        // line ends and wide blanks within a head
        c if c.is_whitespace() => " ".to_owned(),
        // accents that stand behind their letter
        '\u{300}'..='\u{36f}' => String::new(),
        c => c.to_string(),
    };
    text.to_lowercase().chars().map(plain).collect::<String>().trim().to_owned()
}

/// Words of a head, folded, and its unit: in brackets, or behind the words as in our own columns or in those of DIN and ISO 80000 ("Druck / bar").
pub(crate) fn parts(head: &str) -> (String, Option<String>) {
    if let Some((words, unit)) = in_brackets(head) {
        return (folded(words), Some(unit.trim().to_owned()));
    }
    for (end, unit) in [("_kg_m2", "kg m2"), ("_n_m_s_per_rad", "N m s/rad"), ("_n_m_per_rad", "N m/rad"), ("_bar", "bar"), ("_deg", "deg")]
    {
        if let Some(words) = head.strip_suffix(end) {
            return (folded(words), Some(unit.to_owned()));
        }
    }
    // the longest end that is a unit: "Steifigkeit / kN m/rad" before "rad"
    let ends = head.char_indices().filter(|(_, c)| c.is_whitespace() || *c == '/').map(|(i, c)| (&head[..i], &head[i + c.len_utf8()..]));
    let behind =
        || ends.map(|(words, unit)| (words.trim_end_matches('/'), unit)).find(|(words, unit)| !words.trim().is_empty() && is_unit(unit));
    // "Winkel in °KW", "pression en bar"
    let behind_a_word = || [" in ", " en ", " em "].iter().find_map(|word| head.rsplit_once(word));
    match head.split_once(',').or_else(behind_a_word).or_else(behind) {
        Some((words, unit)) => (folded(words), Some(unit.trim().to_owned())),
        None => (folded(head), None),
    }
}

/// What stands before the last brackets of a head, and in them: square ones, else round ones that end it.
fn in_brackets(head: &str) -> Option<(&str, &str)> {
    if let Some((words, rest)) = head.split_once('[') {
        return Some((words, rest.split(']').next().unwrap_or(rest)));
    }
    let first = head.find('(')?;
    // "(to next) (N m/rad)", but also "(N m/(rad/s))"
    let ends_there = |start: &usize| {
        let mut depth = 0;
        let close = head[*start..].char_indices().find(|(_, c)| {
            depth += i32::from(*c == '(') - i32::from(*c == ')');
            depth == 0
        });
        close.is_some_and(|(end, _)| head[*start + end + 1..].trim().is_empty())
    };
    let start = head.match_indices('(').map(|m| m.0).find(ends_there).unwrap_or(first);
    let inner = head[start + 1..].trim_end();
    Some((&head[..start], inner.strip_suffix(')').unwrap_or(inner)))
}
