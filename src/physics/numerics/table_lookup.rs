//! The position of a value in a sorted table.

/// The interval of `table` (ascending, at least two values) that holds `x`, as its left index and the fraction of the way through
/// it. Outside the table the end interval is extended.
pub fn interval(table: &[f64], x: f64) -> (usize, f64) {
    let i = table.partition_point(|&t| t <= x).clamp(1, table.len() - 1) - 1;
    (i, (x - table[i]) / (table[i + 1] - table[i]))
}

/// The same with the ends held: outside the table the value at its end counts.
pub(crate) fn held(table: &[f64], x: f64) -> (usize, f64) {
    interval(table, x.clamp(table[0], table[table.len() - 1]))
}

/// The left index of the interval of a table (as above) whose steps are nearly even.
pub(crate) fn in_nearly_even(table: &[f64], x: f64) -> usize {
    let last = table.len() - 2;
    let place = (x - table[0]) / (table[last + 1] - table[0]) * (last + 1) as f64;
    let mut i = (place.max(0.0) as usize).min(last);
    while i < last && table[i + 1] <= x {
        i += 1;
    }
    while i > 0 && table[i] > x {
        i -= 1;
    }
    i
}
