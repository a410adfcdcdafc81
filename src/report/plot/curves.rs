//! A plot a figure: panels from top to bottom.

use super::canvas::{self, COLOURS, Drawn, line, px, text};
use crate::analysis::curves::{Curve, Figure, Panel};
use crate::report::files::{Folder, WriteError};
use plotters::prelude::*;

/// Width of a figure and height of a panel.
const WIDTH: u32 = 960;
const HEIGHT: u32 = 290;

/// A curve of an order has the colour of that order in every plot; others go by their place.
fn style(curve: &Curve, place: usize) -> ShapeStyle {
    match curve.order {
        Some(order) => line(canvas::of_order(order), 14),
        None if curve.label.starts_with("all ") => line(BLACK, 20),
        None => line(COLOURS[place % COLOURS.len()], 15),
    }
}

/// Smallest and largest of some numbers, spread where they are one; zero belongs to the range of what crosses it or nearly reaches it.
fn range(values: impl Iterator<Item = f64> + Clone, margin: f64) -> (f64, f64) {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    if !low.is_finite() {
        return (0.0, 1.0);
    }
    let room = if high > low { margin * (high - low) } else { 0.5 * low.abs().max(1.0) };
    (low - room, high + room)
}

fn panel(area: &canvas::Area, panel: &Panel, legend: u32) -> Drawn {
    let (left, side) = area.split_horizontally(area.dim_in_pixel().0 - legend);
    let all = || panel.curves.iter().flat_map(|c| &c.points);
    let ((x0, x1), (y0, y1)) = (range(all().map(|p| p.0), 0.0), range(all().map(|p| p.1).chain([0.0, panel.y_top.unwrap_or(0.0)]), 0.05));
    let mut chart = ChartBuilder::on(&left)
        .caption(&panel.title, text(14))
        .margin(px(8))
        .x_label_area_size(px(36))
        .y_label_area_size(px(64))
        .build_cartesian_2d(x0..x1, y0..y1)?;
    canvas::mesh!(chart, panel.x.label, panel.y.label, 9, 6);
    if y0 < 0.0 {
        chart.draw_series(LineSeries::new([(x0, 0.0), (x1, 0.0)], line(canvas::GREY, 7)))?;
    }
    let mut entries = Vec::new();
    for (i, curve) in panel.curves.iter().enumerate() {
        let style = style(curve, i);
        chart.draw_series(LineSeries::new(curve.points.iter().copied(), style))?;
        if curve.points.len() <= 60 {
            chart.draw_series(curve.points.iter().map(|p| Circle::new(*p, px(3), style.filled())))?;
        }
        entries.push((curve.label.clone(), style));
    }
    canvas::legend(&side, &entries)
}

/// `<figure>.svg` and `.png`.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
pub(crate) fn figure(figure: &Figure, folder: &Folder) -> Result<(), WriteError> {
    // a legend with more entries than a panel is high makes it higher
    let most = figure.panels.iter().map(|p| p.curves.len()).max().unwrap_or(0) as u32;
    let each = HEIGHT.max(40 + 19 * most);
    let count = figure.panels.len();
    // as wide for all panels: their axes line up
    let legend = canvas::legend_width(figure.panels.iter().flat_map(|p| &p.curves).map(|c| c.label.as_str()));
    canvas::save(folder, &figure.name, (WIDTH, 36 + each * count as u32), |area| {
        let titled = canvas::titled(area, &figure.title)?;
        for (area, one) in titled.split_evenly((count, 1)).iter().zip(&figure.panels) {
            panel(area, one, legend)?;
        }
        Ok(())
    })
}
