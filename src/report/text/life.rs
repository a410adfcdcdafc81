//! How long what absorbers shear lasts over the duty, in words.

use super::table::{significant, table};
use crate::analysis::{DutyOfDesign, LifeOverDuty, Results};

/// A row an absorber whose material says how many cycles of strain it bears; empty where none does.
#[doc(hidden)]
pub fn life(results: &Results) -> String {
    let row = |(d, life): (&DutyOfDesign, &LifeOverDuty)| -> Option<Vec<String>> {
        let hours = life.hours();
        let worst = life.points.iter().max_by(|a, b| (a.point.share * a.damage_per_h).total_cmp(&(b.point.share * b.damage_per_h)))?;
        let share = worst.point.share * worst.damage_per_h * hours;
        let numbers = if hours.is_finite() {
            [
                significant(hours, 3),
                format!("{}", worst.point.speed_rpm),
                format!("{:.0}", 100.0 * share),
                significant(100.0 * worst.strain, 3),
            ]
        } else {
            [(); 4].map(|()| "-".to_owned())
        };
        Some([d.design.clone(), (life.absorber + 1).to_string()].into_iter().chain(numbers).collect())
    };
    let rows: Vec<Vec<String>> = results.duty.iter().flat_map(|d| d.lives.iter().map(move |l| (d, l))).filter_map(row).collect();
    if rows.is_empty() {
        return String::new();
    }
    let header = ["design", "absorber", "life/h", "most at/rpm", "of damage/%", "strain there/%"];
    format!("Life over the duty, by cycles of strain alone, no better than a factor of three:\n{}", table(&header, &rows))
}
