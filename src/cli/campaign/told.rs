//! What the commands of a campaign tell.

use crate::report::campaign::{Dataset, counted};

/// Exit code: shards are missing.
pub(super) const MISSING: u8 = 3;

/// Hours of a processor, in words.
pub(super) fn processor_time(hours: f64) -> String {
    match hours {
        h if h >= 1.0 => format!("{h:.1} processor-hours"),
        h if h >= 1.0 / 60.0 => format!("{:.1} processor-minutes", 60.0 * h),
        h => format!("{:.1} processor-seconds", 3600.0 * h),
    }
}

/// How many rows came to what.
pub(super) fn rows(dataset: &Dataset) -> String {
    let counts = dataset.counts();
    let all: usize = counts.iter().map(|c| c.1).sum();
    let told: Vec<String> = counts.iter().filter(|c| c.1 > 0).map(|(s, n)| format!("{n} {}", s.word().replace('_', " "))).collect();
    if told.is_empty() { "no rows".to_owned() } else { format!("{}: {}", counted(all, "row"), told.join(", ")) }
}
