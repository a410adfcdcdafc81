//! A plot a figure: panels from top to bottom.

use super::canvas::{self, Drawn, Stroke, WIDTH, captioned, line, px, text};
use super::legend::{self, Entry};
use crate::analysis::curves::{Curve, Figure, Panel};
use crate::files::{Folder, WriteError};
use plotters::prelude::*;

/// Height of a panel; its legend comes to it.
const HEIGHT: u32 = 270;

/// A curve of an order has the colour of that order in every plot; others go by their place.
fn stroke(curve: &Curve, place: usize) -> Stroke {
    match curve.order {
        Some(order) => Stroke::of_order(order, 14),
        None if curve.label.starts_with("all ") => Stroke::solid(line(BLACK, 20)),
        None => Stroke::of(place, 15),
    }
}

fn entries(panel: &Panel) -> Vec<Entry> {
    panel.curves.iter().enumerate().map(|(i, c)| Entry::curve(&c.label, stroke(c, i))).collect()
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

fn panel(area: &canvas::Area, panel: &Panel) -> Drawn {
    let left = legend::below(area, &entries(panel))?;
    let all = || panel.curves.iter().flat_map(|c| &c.points);
    let ((x0, x1), (y0, y1)) = (range(all().map(|p| p.0), 0.0), range(all().map(|p| p.1).chain([0.0, panel.y_top.unwrap_or(0.0)]), 0.05));
    let own = captioned(&left, &panel.title, text(15))?;
    let mut chart = ChartBuilder::on(&own)
        .margin(px(8))
        .margin_right(px(24))
        .x_label_area_size(px(40))
        .y_label_area_size(px(68))
        .build_cartesian_2d(x0..x1, y0..y1)?;
    canvas::mesh!(chart, panel.x.label, panel.y.label, 9, 6);
    if y0 < 0.0 {
        chart.draw_series(LineSeries::new([(x0, 0.0), (x1, 0.0)], line(canvas::GREY, 7)))?;
    }
    for (i, curve) in panel.curves.iter().enumerate() {
        let stroke = stroke(curve, i);
        canvas::curve(&mut chart, curve.points.iter().copied(), stroke)?;
        if curve.points.len() <= 60 {
            chart.draw_series(curve.points.iter().map(|p| Circle::new(*p, px(3), stroke.style.filled())))?;
        }
    }
    Ok(())
}

/// `<figure>.svg` and `.png`.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
pub(crate) fn figure(figure: &Figure, folder: &Folder) -> Result<(), WriteError> {
    let heights: Vec<u32> = figure.panels.iter().map(|p| HEIGHT + legend::height(&entries(p), WIDTH)).collect();
    canvas::save(folder, &figure.name, (WIDTH, canvas::title_height(&figure.title) + heights.iter().sum::<u32>()), |area| {
        let mut rest = canvas::titled(area, &figure.title)?;
        for (one, height) in figure.panels.iter().zip(&heights) {
            let (own, below) = rest.split_vertically(px(*height));
            panel(&own, one)?;
            rest = below;
        }
        Ok(())
    })
}
