//! What `curves` prints: Holzer's table of the first mode, and which figures there are.

use super::table::{significant, table};
use crate::analysis::curves::{Figure, HolzerRow};

/// Holzer's table of the first mode, and a line a figure.
pub fn curves(figures: &[Figure], holzer: &[HolzerRow]) -> String {
    let mut text = String::new();
    let first: Vec<&HolzerRow> = holzer.iter().filter(|r| r.mode == 1).collect();
    if let Some(row) = first.first() {
        let rows: Vec<Vec<String>> = first
            .iter()
            .map(|r| {
                let numbers = [r.inertia, r.angle, r.torque, r.sum, r.stiffness, r.twist].map(|x| significant(x, 5));
                std::iter::once(r.station.clone()).chain(numbers).collect()
            })
            .collect();
        let header = ["station", "J/kg m²", "angle", "J w² angle", "sum", "k next/N m/rad", "twist"];
        text = format!(
            "Holzer's table of mode 1, {:.2} Hz, for an angle of one (the others are in holzer.csv):\n{}\n",
            row.frequency_hz,
            table(&header, &rows)
        );
    }
    let rows: Vec<Vec<String>> = figures.iter().map(|f| vec![f.name.clone(), f.title.clone()]).collect();
    text + &table(&["figure (.csv, .svg, .png)", "what it shows"], &rows)
}
