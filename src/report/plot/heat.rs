//! Temperatures of absorbers in balance, over speed.

use super::canvas::{self, COLOURS, GREY, Stroke, WIDTH, captioned, fill, line, px, text};
use super::legend::{self, Entry, Mark};
use crate::analysis::{HeatOfDesign, Results};
use crate::files::{Folder, WriteError};
use crate::input::Study;
use plotters::prelude::*;

/// `heat`: a line a design for what is reached from cold, broken where it overheats; other balances as dots, open where they are not stable; limits as thin lines.
pub(crate) fn draw(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.heat.is_empty() {
        return Ok(());
    }
    let all = || results.heat.iter().flat_map(|d| d.points.iter().flat_map(|p| &p.balances).map(|b| b.celsius).chain([d.limit]));
    let (low, high) = all().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    let y = (low - 0.08 * (high - low), high + 0.08 * (high - low));
    let x = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    if x.0 >= x.1 {
        return Ok(());
    }
    let name = |d: &HeatOfDesign| d.design.replace('_', " ");
    let bears = |i: usize| Stroke { style: line(COLOURS[i % COLOURS.len()], 7), ..Stroke::dashed(line(BLACK, 7)) };
    let entries_of = |(i, d): (usize, &HeatOfDesign)| {
        [
            Entry::curve(name(d), Stroke::solid(line(COLOURS[i % COLOURS.len()], 20))),
            Entry::curve(format!("{}: what its material bears", name(d)), bears(i)),
        ]
    };
    let mut entries: Vec<Entry> = results.heat.iter().enumerate().flat_map(entries_of).collect();
    if results.heat.iter().any(|d| others(d, false).next().is_some()) {
        entries.push(Entry::new("balance that is not stable", Mark::Point(line(GREY, 10))));
    }
    canvas::save(folder, "heat", (WIDTH, 400 + legend::height(&entries, WIDTH)), |area| {
        let main = legend::below(area, &entries)?;
        let own = captioned(&main, format!("{}: temperature of the absorber in balance of heat", study.engine.name), text(16))?;
        let mut chart = ChartBuilder::on(&own)
            .margin(px(8))
            .x_label_area_size(px(44))
            .y_label_area_size(px(60))
            .build_cartesian_2d(x.0..x.1, y.0..y.1)?;
        canvas::mesh!(chart, "speed / rpm", "temperature / °C", 9, 9);
        for (i, d) in results.heat.iter().enumerate() {
            let colour = COLOURS[i % COLOURS.len()];
            for piece in d.points.split(|p| p.balances.is_empty()).filter(|p| !p.is_empty()) {
                let reached: Vec<(f64, f64)> = piece.iter().filter_map(|p| Some((p.speed_rpm, p.cold_start()?.celsius))).collect();
                chart.draw_series(LineSeries::new(reached, line(colour, 20)))?;
            }
            chart.draw_series(others(d, true).map(|p| Circle::new(p, px(2), fill(colour, 1.0))))?;
            chart.draw_series(others(d, false).map(|p| Circle::new(p, px(2), line(colour, 10))))?;
            canvas::curve(&mut chart, [(x.0, d.limit), (x.1, d.limit)], bears(i))?;
        }
        Ok(())
    })
}

/// Balances that are not reached from cold.
fn others(d: &HeatOfDesign, stable: bool) -> impl Iterator<Item = (f64, f64)> + '_ {
    let balances_of = move |p: &crate::analysis::HeatAt| {
        let speed = p.speed_rpm;
        let own: Vec<(f64, f64)> = p.balances.iter().skip(1).filter(|b| b.stable == stable).map(|b| (speed, b.celsius)).collect();
        own
    };
    d.points.iter().flat_map(balances_of)
}
