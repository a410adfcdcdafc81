//! `life.csv`: how long what absorbers shear lasts, at the points of the duty.

use super::table::{Table, number};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};

/// `life.csv`: a row a design, absorber and point of the duty; none where no material says how many cycles of strain it bears.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn life(results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.duty.iter().all(|d| d.lives.is_empty()) {
        return Ok(());
    }
    let header = ["design", "absorber", "speed_rpm", "load_fraction", "share", "strain", "cycles_per_h", "damage_per_h"];
    let mut table = Table::new(&header);
    for (d, life) in results.duty.iter().flat_map(|d| d.lives.iter().map(move |l| (d, l))) {
        for p in &life.points {
            let at = &p.point;
            let numbers = [at.speed_rpm, at.load_fraction, at.share, p.strain, p.cycles_per_h, p.damage_per_h].map(number);
            table.row([d.design.clone(), (life.absorber + 1).to_string()].into_iter().chain(numbers).collect::<Vec<String>>());
        }
    }
    table.save(folder, "life.csv")
}
