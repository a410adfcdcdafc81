//! A plot a figure: panels from top to bottom.

use super::canvas::{self, Drawn, Stroke, WIDTH, captioned, line, px, text};
use super::legend::{self, Entry, Mark};
use crate::analysis::curves::{Curve, Figure, Look, Panel, Scale};
use crate::files::{Folder, WriteError};
use plotters::prelude::*;

/// Height of a panel; its legend comes to it.
const HEIGHT: u32 = 270;

/// Height that comes to a panel whose axes have the same unit.
const TALLER: u32 = 180;

/// A curve of an order has the colour of that order in every plot; others go by their place.
fn stroke(curve: &Curve, place: usize) -> Stroke {
    match curve.look {
        Look::Line | Look::Points => Stroke::of(place, 15),
        Look::Order(order) => Stroke::of_order(order, 14),
        Look::Black(number) => Stroke::black(number, 20),
        Look::Thin => Stroke::solid(line(canvas::GREY, 12)),
    }
}

fn entries(panel: &Panel) -> Vec<Entry> {
    let entry = |(i, c): (usize, &Curve)| match c.look {
        Look::Points => Entry::new(&c.label, Mark::Point(stroke(c, i).style.filled())),
        _ => Entry::curve(&c.label, stroke(c, i)),
    };
    panel.curves.iter().enumerate().map(entry).collect()
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

/// Room round the axes of a panel, units: round all of it, at its right, and for the numbers at the left and below.
const MARGIN: u32 = 8;
const RIGHT: u32 = 24;
const LEFT: u32 = 68;
const BELOW: u32 = 40;

/// A range as wide as asked for, about its middle.
fn widened((low, high): (f64, f64), width: f64) -> (f64, f64) {
    let middle = f64::midpoint(low, high);
    (middle - 0.5 * width, middle + 0.5 * width)
}

/// Ranges of both axes of a panel, whose axes have a width and height.
fn ranges(panel: &Panel, (width, height): (f64, f64)) -> [(f64, f64); 2] {
    let all = || panel.curves.iter().flat_map(|c| &c.points);
    let (x, y) = (all().map(|p| p.0), all().map(|p| p.1));
    match panel.scale {
        Scale::Own => [range(x, 0.0), range(y.chain([0.0]), 0.05)],
        Scale::AtLeast(top) => [range(x, 0.0), range(y.chain([0.0, top]), 0.05)],
        Scale::CutAt(top) => {
            let low = y.fold(0.0, f64::min);
            [range(x, 0.0), (low - 0.05 * (top - low), top)]
        }
        Scale::Equal => {
            let (x, y) = (range(x, 0.05), range(y, 0.05));
            let unit = ((x.1 - x.0) / width).max((y.1 - y.0) / height);
            [widened(x, unit * width), widened(y, unit * height)]
        }
    }
}

/// A panel with its legend below.
pub(super) fn panel(area: &canvas::Area, panel: &Panel) -> Drawn {
    let left = legend::below(area, &entries(panel))?;
    let own = captioned(&left, &panel.title, text(15))?;
    let (width, height) = own.dim_in_pixel();
    let inside = |all: u32, room: u32| f64::from(all.saturating_sub(px(room)).max(1));
    let [(x0, x1), (y0, y1)] = ranges(panel, (inside(width, MARGIN + LEFT + RIGHT), inside(height, 2 * MARGIN + BELOW)));
    let mut chart = ChartBuilder::on(&own)
        .margin(px(MARGIN))
        .margin_right(px(RIGHT))
        .x_label_area_size(px(BELOW))
        .y_label_area_size(px(LEFT))
        .build_cartesian_2d(x0..x1, y0..y1)?;
    canvas::mesh!(chart, panel.x.label, panel.y.label, 9, 6);
    if y0 < 0.0 {
        chart.draw_series(LineSeries::new([(x0, 0.0), (x1, 0.0)], line(canvas::GREY, 7)))?;
    }
    for (i, curve) in panel.curves.iter().enumerate() {
        let stroke = stroke(curve, i);
        let (points, top) = (|| curve.points.iter().copied(), if let Scale::CutAt(top) = panel.scale { top } else { f64::INFINITY });
        if curve.look != Look::Points {
            for piece in canvas::clipped(points(), top).into_iter().filter(|piece| piece.len() > 1) {
                canvas::curve(&mut chart, piece, stroke)?;
            }
        }
        if curve.look == Look::Points || (curve.look == Look::Line && curve.points.len() <= 60) {
            chart.draw_series(points().filter(|p| p.1 <= top).map(|p| Circle::new(p, px(3), stroke.style.filled())))?;
        }
    }
    Ok(())
}

/// `<figure>.svg` and `.png`.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
pub(crate) fn figure(figure: &Figure, folder: &Folder) -> Result<(), WriteError> {
    let height = |p: &Panel| HEIGHT + if p.scale == Scale::Equal { TALLER } else { 0 } + legend::height(&entries(p), WIDTH);
    let heights: Vec<u32> = figure.panels.iter().map(height).collect();
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
