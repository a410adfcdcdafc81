//! The position of a value in a sorted table.

/// The interval of `table` (ascending, at least two values) that holds `x`, as its left index and the fraction of the way through
/// it. Outside the table the end interval is extended.
pub fn interval(table: &[f64], x: f64) -> (usize, f64) {
    let i = table.partition_point(|&t| t <= x).clamp(1, table.len() - 1) - 1;
    (i, (x - table[i]) / (table[i + 1] - table[i]))
}
