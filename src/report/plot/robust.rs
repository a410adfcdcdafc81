//! Bands of the twist over speed within tolerances.

use super::canvas::{self, COLOURS, WIDTH, fill, line, px};
use super::legend::{self, Entry, Mark};
use crate::analysis::{Results, RobustOfDesign};
use crate::files::{Folder, WriteError};
use crate::input::Study;
use crate::units::DEG_PER_RAD;
use plotters::prelude::*;

/// `tolerance_band`: a panel for each optimum with the robust one of its family, or for each other design: smallest and largest twist over the corners of the tolerances.
pub(crate) fn draw(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let panels = panels(results);
    let x = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    if panels.is_empty() || x.0 >= x.1 {
        return Ok(());
    }
    let drawn = || panels.iter().flatten().flat_map(|d| &d.band).filter(|b| b.1.is_finite());
    let top = canvas::round_up(drawn().map(|b| b.1 * DEG_PER_RAD).fold(0.0, f64::max));
    canvas::save(folder, "tolerance_band", (WIDTH, 36 + 350 * panels.len() as u32), |area| {
        let titled = canvas::titled(area, &format!("{}: twist within tolerances", study.engine.name))?;
        for (part, designs) in titled.split_evenly((panels.len(), 1)).iter().zip(&panels) {
            let mut entries: Vec<Entry> =
                designs.iter().zip(COLOURS).map(|(d, c)| Entry::new(d.design.replace('_', " "), Mark::Block(fill(c, 0.5)))).collect();
            entries.push(Entry::new("(over all corners of the tolerances)", Mark::Note));
            let main = legend::below(part, &entries)?;
            let mut chart = ChartBuilder::on(&main)
                .margin(px(8))
                .x_label_area_size(px(40))
                .y_label_area_size(px(58))
                .build_cartesian_2d(x.0..x.1, 0.0..top)?;
            canvas::mesh!(chart, "speed / rpm", "twist / °", 9, 7);
            for (d, colour) in designs.iter().zip(COLOURS) {
                let edge = |of: &dyn Fn(&(f64, f64)) -> f64| -> Vec<(f64, f64)> {
                    study.speeds_rpm.iter().zip(&d.band).map(|(s, b)| (*s, (of(b) * DEG_PER_RAD).min(top))).collect()
                };
                let (lower, upper) = (edge(&|b| b.0), edge(&|b| b.1));
                let outline: Vec<(f64, f64)> = lower.iter().copied().chain(upper.iter().rev().copied()).collect();
                chart.draw_series(std::iter::once(Polygon::new(outline, fill(colour, 0.25))))?;
                for points in [lower, upper] {
                    chart.draw_series(LineSeries::new(points, line(colour, 12)))?;
                }
            }
        }
        Ok(())
    })
}

/// Designs that are drawn together.
fn panels(results: &Results) -> Vec<Vec<&RobustOfDesign>> {
    let design_named = |name: &str| results.robust.iter().find(|d| d.design == name);
    let robust = results.optima.iter().filter(|o| o.robust);
    let pairs: Vec<Vec<&RobustOfDesign>> =
        robust.map(|o| [design_named(&o.family), design_named(&o.design.name)].into_iter().flatten().collect()).collect();
    if pairs.is_empty() { results.robust.iter().map(|d| vec![d]).collect() } else { pairs }
}
