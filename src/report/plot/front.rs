//! Fronts of two measures, with given designs and the knee marked.

use super::canvas::{self, COLOURS, GREY, fill, line, px, text};
use crate::analysis::{Results, TradeoffResult};
use crate::input::{FrontSpec, MeasureSpec, Study, UnitOf};
use crate::report::files::{Folder, WriteError};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Given designs further out than this many ranges of the fronts are not drawn.
const FARTHEST: f64 = 1.0;
/// Distance of marks, pixels.
const APART: i32 = 15;

/// A label of an axis.
fn axis(measure: &MeasureSpec) -> String {
    let label = measure.label.replace('_', " ");
    match measure.unit.suffix().trim() {
        "" => label,
        unit => format!("{label} / {unit}"),
    }
}

/// A pair of values as they are drawn: the second measure to the right, the first upwards.
fn place(measures: [&MeasureSpec; 2], values: [f64; 2]) -> Option<(f64, f64)> {
    let at = (measures[1].unit.shown(values[1]), measures[0].unit.shown(values[0]));
    (at.0.is_finite() && at.1.is_finite()).then_some(at)
}

/// A range that holds some values, with room at both ends; from zero where that is near.
fn range(values: impl Iterator<Item = f64>, unit: UnitOf) -> (f64, f64) {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    let room = 0.08 * (high - low).max(1e-3 * high.abs());
    let bottom = if unit != UnitOf::Margin && low < 0.3 * high { 0.0 } else { low - room };
    (bottom, high + room)
}

/// `front_<first>_<second>`: one plot a pair.
pub(crate) fn draw(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let Some(FrontSpec::Of { measures, .. }) = &study.front else { return Ok(()) };
    results.tradeoffs.iter().try_for_each(|t| one(study, t, [&measures[t.of[0]], &measures[t.of[1]]], folder))
}

fn one(study: &Study, t: &TradeoffResult, measures: [&MeasureSpec; 2], folder: &Folder) -> Result<(), WriteError> {
    let drawn = |values: [f64; 2]| place(measures, values);
    let points = || t.families.iter().flat_map(|f| &f.1.points).filter(|p| !p.dominated).filter_map(|p| drawn(p.values));
    if points().count() == 0 {
        return Ok(());
    }
    let (x, y) = (range(points().map(|p| p.0), measures[1].unit), range(points().map(|p| p.1), measures[0].unit));
    let near = |p: &(f64, f64)| p.0 <= x.1 + FARTHEST * (x.1 - x.0) && p.1 <= y.1 + FARTHEST * (y.1 - y.0) && p.0 >= 0.0 && p.1 >= 0.0;
    let given: Vec<(String, (f64, f64))> =
        t.given.iter().filter_map(|g| Some((g.design.replace('_', " "), drawn(g.values)?))).filter(|g| near(&g.1)).collect();
    let all = || points().chain(given.iter().map(|g| g.1));
    let (x, y) = (range(all().map(|p| p.0), measures[1].unit), range(all().map(|p| p.1), measures[0].unit));
    let name = format!("front_{}_{}", measures[0].word, measures[1].word);
    canvas::save(folder, &name, (900, 560), |area| {
        let (main, side) = area.split_horizontally(area.dim_in_pixel().0 - px(190));
        let mut chart = ChartBuilder::on(&main)
            .caption(format!("{}: what one costs the other", study.engine.name), text(16))
            .margin(px(8))
            .x_label_area_size(px(40))
            .y_label_area_size(px(64))
            .build_cartesian_2d(x.0..x.1, y.0..y.1)?;
        canvas::mesh!(chart, axis(measures[1]), axis(measures[0]), 9, 9);
        let mut entries = Vec::new();
        for (i, (family, front)) in t.families.iter().enumerate() {
            let style = line(COLOURS[i % COLOURS.len()], 20);
            // what another point beats is pale, and the line broken there
            let inside = |p: &(f64, f64)| p.0 <= x.1 && p.1 <= y.1;
            let beaten = front.points.iter().filter(|p| p.dominated).filter_map(|p| drawn(p.values)).filter(inside);
            chart.draw_series(beaten.map(|p| Circle::new(p, px(2), fill(COLOURS[i % COLOURS.len()], 0.3))))?;
            let pieces = front.points.split(|p| p.dominated);
            for piece in pieces.filter(|p| !p.is_empty()) {
                let piece: Vec<(f64, f64)> = piece.iter().filter_map(|p| drawn(p.values)).collect();
                chart.draw_series(piece.iter().map(|p| Circle::new(*p, px(2), fill(COLOURS[i % COLOURS.len()], 1.0))))?;
                chart.draw_series(LineSeries::new(piece, style))?;
            }
            entries.push((family.replace('_', " and "), style));
        }
        for p in t.families.iter().flat_map(|f| &f.1.points).filter(|p| p.knee) {
            if let Some(at) = drawn(p.values) {
                chart.draw_series(std::iter::once(
                    EmptyElement::at(at)
                        + Circle::new((0, 0), px(7), line(BLACK, 16))
                        + Text::new("knee", (px(10) as i32, -(px(14) as i32)), text(12)),
                ))?;
            }
        }
        let mut used: Vec<(i32, i32)> = Vec::new();
        for (name, at) in &given {
            let pixel = chart.backend_coord(at);
            // a label goes below those that are already near
            let taken = used.iter().filter(|u| (u.0 - pixel.0).abs() < 8 * APART && (u.1 - pixel.1).abs() < APART).count() as i32;
            used.push((pixel.0, pixel.1 + taken * APART));
            let (dx, hpos) = if at.0 > 0.5 * (x.0 + x.1) { (-(px(8) as i32), HPos::Right) } else { (px(8) as i32, HPos::Left) };
            let style = text(12).pos(Pos::new(hpos, VPos::Center));
            let mark = EmptyElement::at(*at)
                + Circle::new((0, 0), px(4), fill(GREY, 1.0))
                + Text::new(name.clone(), (dx, px(1) as i32 * taken * APART), style);
            chart.draw_series(std::iter::once(mark))?;
        }
        canvas::legend(&side, &entries)
    })
}
