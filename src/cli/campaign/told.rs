//! What the commands of a campaign tell.

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
