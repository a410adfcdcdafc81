//! Temperatures of absorbers in balance, over speed.

use super::canvas::{self, COLOURS, fill, line, px, text};
use crate::analysis::{HeatOfDesign, Results};
use crate::input::Study;
use crate::report::files::{Folder, WriteError};
use plotters::prelude::*;

/// `heat`: a line a design for what is reached from cold, broken where it overheats; other balances as dots, open where they are not stable; limits as thin lines.
pub(crate) fn draw(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.heat.is_empty() {
        return folder.remove(&["heat.svg", "heat.png"]);
    }
    let all = || results.heat.iter().flat_map(|d| d.points.iter().flat_map(|p| &p.balances).map(|b| b.celsius).chain([d.limit]));
    let (low, high) = all().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    let y = (low - 0.08 * (high - low), high + 0.08 * (high - low));
    let x = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    if x.0 >= x.1 {
        return folder.remove(&["heat.svg", "heat.png"]);
    }
    canvas::save(folder, "heat", (900, 480), |area| {
        let (main, side) = area.split_horizontally(area.dim_in_pixel().0 - px(210));
        let mut chart = ChartBuilder::on(&main)
            .caption(format!("{}: temperature of the absorber in balance of heat", study.engine.name), text(16))
            .margin(px(8))
            .x_label_area_size(px(40))
            .y_label_area_size(px(56))
            .build_cartesian_2d(x.0..x.1, y.0..y.1)?;
        canvas::mesh!(chart, "speed / rpm", "temperature / °C", 9, 9);
        let mut entries = Vec::new();
        for (i, d) in results.heat.iter().enumerate() {
            let colour = COLOURS[i % COLOURS.len()];
            for piece in d.points.split(|p| p.balances.is_empty()).filter(|p| !p.is_empty()) {
                let reached: Vec<(f64, f64)> = piece.iter().filter_map(|p| Some((p.speed_rpm, p.cold_start()?.celsius))).collect();
                chart.draw_series(LineSeries::new(reached, line(colour, 20)))?;
            }
            chart.draw_series(others(d, true).map(|p| Circle::new(p, px(2), fill(colour, 1.0))))?;
            chart.draw_series(others(d, false).map(|p| Circle::new(p, px(2), line(colour, 10))))?;
            chart.draw_series(LineSeries::new([(x.0, d.limit), (x.1, d.limit)], line(colour, 6)))?;
            entries.push((d.design.replace('_', " "), line(colour, 20)));
            entries.push(("  what its material bears".to_owned(), line(colour, 6)));
        }
        canvas::legend(&side, &entries)
    })
}

/// Balances that are not reached from cold.
fn others(d: &HeatOfDesign, stable: bool) -> impl Iterator<Item = (f64, f64)> + '_ {
    let of = move |p: &crate::analysis::HeatAt| {
        let speed = p.speed_rpm;
        let own: Vec<(f64, f64)> = p.balances.iter().skip(1).filter(|b| b.stable == stable).map(|b| (speed, b.celsius)).collect();
        own
    };
    d.points.iter().flat_map(of)
}
