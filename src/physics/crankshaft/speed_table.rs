//! Places in a table whose rows belong to speeds.

/// A speed in the table: rows on both sides, and the fraction of the way between them.
#[derive(Debug, Clone, Copy)]
pub struct At {
    /// Row below.
    pub low: usize,
    /// Row above.
    pub high: usize,
    /// 0 to 1.
    pub fraction: f64,
}

impl At {
    /// Linear between the two rows.
    pub fn between(self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.fraction
    }
}
