//! What a head says, in English, German, French and Portuguese.

/// Letters without their accents, small: ä is a, as Träger and Trager, and Traeger is left as it is.
pub(super) fn folded(text: &str) -> String {
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

const THROW: &[&str] = &["throw", "kropfung", "kroepfung", "maneton", "manivela"];
const DAMPING: &[&str] = &["damp", "dampf", "daempf", "amort"];
const TO_GROUND: &[&str] = &["ground", "absolut", "absolu", "extern", "aussen", "terra", "boden"];
const TO_NEXT: &[&str] = &[
    "next", "relativ", "shaft", "intern", "innere", "welle", "folgend", "nachst", "naechst", "arbre", "suivant", "eixo", "seguinte",
    "proxim",
];
const STIFFNESS: &[&str] = &["stiff", "steif", "raideur", "rigid"];
const INERTIA: &[&str] = &["inertia", "tragheit", "traegheit", "drehmasse", "inertie", "inercia"];
const STATION: &[&str] = &[
    "station",
    "mass",
    "name",
    "element",
    "node",
    "designation",
    "stelle",
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
    DampingToGround,
    Throws,
}

/// Whether a damping is named that may be to the next station or to ground.
pub(super) fn is_damping(words: &str) -> bool {
    DAMPING.iter().any(|w| words.contains(w))
}

/// Whether a (folded) head names the ratio of a gear.
pub(super) fn is_ratio(words: &str) -> bool {
    ["ratio", "ubersetzung", "uebersetzung", "rapport", "relacao", "transmiss"].iter().any(|w| words.contains(w))
}

impl Role {
    /// By the (folded) words of a head, without its unit.
    pub(super) fn of(words: &str, unit: Option<&str>) -> Option<Self> {
        let has = |list: &[&str]| list.iter().any(|w| words.contains(w));
        if has(THROW) && !has(INERTIA) && !has(STIFFNESS) && !has(DAMPING) {
            return Some(Self::Throws);
        }
        if has(DAMPING) {
            return if has(TO_GROUND) {
                Some(Self::DampingToGround)
            } else if has(TO_NEXT) {
                Some(Self::DampingToNext)
            } else {
                None
            };
        }
        if has(STIFFNESS) || words == "k" {
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
            Self::DampingToGround => "Damping to ground [N m s/rad]",
            Self::Name => "Station",
            Self::Throws => "Throws",
        }
    }
}

/// Whether a (folded) head names the angle of the crank.
pub(super) fn is_angle(words: &str) -> bool {
    named(words, &["angle", "crank", "ca", "deg", "theta", "winkel", "kurbel", "kw", "grad", "angulo", "manivela", "vilebrequin", "phi"])
}

/// Whether a (folded) head names a pressure.
pub(super) fn is_pressure(words: &str) -> bool {
    named(words, &["press", "p", "bar", "pcyl", "pzyl"]) || words.contains("druck")
}

/// Whether a part of a head is one of these words, or begins with one of more than two letters.
fn named(words: &str, list: &[&str]) -> bool {
    let parts = words.split([' ', '_']).map(|part| part.trim_start_matches('°'));
    parts.filter(|part| !part.is_empty()).any(|part| list.iter().any(|w| part == *w || w.len() > 2 && part.starts_with(w)))
}
