//! What the tables hold, in the words in which `guide/outputs.md` tells of their files.

use super::run_tables::RUN_TABLES;
use crate::absorber::TYPES;

/// Stems of names of files that no row of [`RUN_TABLES`] is for, and what is in them.
const CAPTIONS: [(&str, &str); 16] = [
    ("tolerance_band", "designs within the tolerances of the study"),
    ("calibration", "fitted inputs with standard errors"),
    ("margin", "cycle of stress and safety factor of the crank for each design, speed, fillet and criterion"),
    ("response", "amplitude and phase of each order, and half peak-to-peak of all together, against speed"),
    ("timing", "time and work by stage"),
    ("comparison", "published values beside computed ones"),
    ("choices", "designs by every measure that is printed for several: as printed, as computed, and the places by both"),
    ("holzer", "Holzer's tables of the first modes"),
    ("fatigue", "safety factors of every point by each criterion"),
    ("fatigue_history", "stress of the point that is drawn over the cycle"),
    ("fatigue_points", "safety factors of all points beside each other"),
    ("speed_accuracy", "seconds per design and error of the peak, for each response method"),
    ("sizing", "what each round of sizing found"),
    ("sizing_comparison", "printed rounds of sizing beside ours"),
    ("sizing_examples", "worked examples of books beside ours"),
    ("sizing_front", "masses of the crank against the response"),
];

/// The caption of a table by the stem of its name; that stem in words where there is none.
pub(super) fn caption(stem: &str) -> String {
    let of_runs = RUN_TABLES.iter().map(|t| (t.stem, t.about));
    let known = of_runs.chain(CAPTIONS).find(|c| c.0 == stem);
    let words = known.map_or_else(|| stem.replace('_', " "), |c| c.1.to_owned());
    words.chars().take(1).flat_map(char::to_uppercase).chain(words.chars().skip(1)).collect()
}

/// Types of a family, whose names are joined by `_` and may hold one.
pub(crate) fn types_of(family: &str) -> String {
    let (mut rest, mut list) = (family, Vec::new());
    while !rest.is_empty() {
        let begins = |name: &&str| rest.strip_prefix(name).is_some_and(|behind| behind.is_empty() || behind.starts_with('_'));
        let name = TYPES.iter().map(|t| t.name).filter(begins).max_by_key(|name| name.len()).unwrap_or(rest);
        list.push(name);
        rest = rest[name.len()..].trim_start_matches('_');
    }
    list.join(" and ")
}
