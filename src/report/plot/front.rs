//! Fronts of two measures, with given designs and the knee marked.

use super::canvas::{self, COLOURS, GREY, Stroke, WIDTH, captioned, fill, line, px, text};
use super::labels;
use super::legend::{self, Entry, Mark};
use crate::analysis::{Results, TradeoffResult};
use crate::captions::types_of;
use crate::files::{Folder, WriteError};
use crate::input::{FrontSpec, MeasureSpec, Study, UnitOf};
use plotters::prelude::*;

/// Given designs further out than this many ranges of the fronts are not drawn.
const FARTHEST: f64 = 1.0;

/// Hours whose damage stands for a life, which has no end where nothing is sheared.
const HOURS: f64 = 1000.0;

/// A label of an axis.
fn axis(measure: &MeasureSpec) -> String {
    let label = measure.label.replace('_', " ");
    if measure.unit == UnitOf::Life {
        return format!("{label}: share used up in {HOURS} h / %");
    }
    match measure.unit.suffix().trim() {
        "" => label,
        unit => format!("{label} / {unit}"),
    }
}

/// A pair of values as they are drawn: the second measure to the right, the first upwards.
fn place(measures: [&MeasureSpec; 2], values: [f64; 2]) -> Option<(f64, f64)> {
    let drawn = |i: usize| if measures[i].unit == UnitOf::Life { 100.0 * HOURS * values[i] } else { measures[i].unit.shown(values[i]) };
    let at = (drawn(1), drawn(0));
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
    let stroke = |i: usize| Stroke::of(i, 20);
    let mut entries: Vec<Entry> = t.families.iter().enumerate().map(|(i, (family, _))| Entry::curve(types_of(family), stroke(i))).collect();
    entries.push(Entry::new("knee", Mark::Point(line(BLACK, 16))));
    if t.families.iter().flat_map(|f| &f.1.points).any(|p| p.dominated) {
        entries.push(Entry::new("another is no worse", Mark::Point(fill(COLOURS[0], 0.3))));
    }
    if !given.is_empty() {
        entries.push(Entry::new("given design", Mark::Point(fill(GREY, 1.0))));
    }
    canvas::save(folder, &name, (WIDTH, 440 + legend::height(&entries, WIDTH)), |area| {
        let main = legend::below(area, &entries)?;
        let own = captioned(&main, format!("{}: what one costs the other", study.engine.name), text(16))?;
        let mut chart = ChartBuilder::on(&own)
            .margin(px(8))
            .margin_right(px(20))
            .x_label_area_size(px(44))
            .y_label_area_size(px(68))
            .build_cartesian_2d(x.0..x.1, y.0..y.1)?;
        canvas::mesh!(chart, axis(measures[1]), axis(measures[0]), 9, 9);
        let mut curves: Vec<(i32, i32)> = Vec::new();
        for (i, (_, front)) in t.families.iter().enumerate() {
            let colour = COLOURS[i % COLOURS.len()];
            // what another point beats is pale, and the line broken there
            let inside = |p: &(f64, f64)| p.0 <= x.1 && p.1 <= y.1;
            let beaten = front.points.iter().filter(|p| p.dominated).filter_map(|p| drawn(p.values)).filter(inside);
            chart.draw_series(beaten.map(|p| Circle::new(p, px(2), fill(colour, 0.3))))?;
            let pieces = front.points.split(|p| p.dominated);
            for piece in pieces.filter(|p| !p.is_empty()) {
                let piece: Vec<(f64, f64)> = piece.iter().filter_map(|p| drawn(p.values)).collect();
                curves.extend(labels::along(&piece.iter().map(|p| chart.backend_coord(p)).collect::<Vec<_>>()));
                chart.draw_series(piece.iter().map(|p| Circle::new(*p, px(2), fill(colour, 1.0))))?;
                canvas::curve(&mut chart, piece, stroke(i))?;
            }
        }
        for p in t.families.iter().flat_map(|f| &f.1.points).filter(|p| p.knee) {
            if let Some(at) = drawn(p.values) {
                chart.draw_series(std::iter::once(Circle::new(at, px(7), line(BLACK, 16))))?;
            }
        }
        chart.draw_series(given.iter().map(|g| Circle::new(g.1, px(4), fill(GREY, 1.0))))?;
        let named: Vec<(String, (i32, i32))> = given.iter().map(|(name, at)| (name.clone(), chart.backend_coord(at))).collect();
        let ((x0, y0), (x1, y1)) = (chart.backend_coord(&(x.0, y.1)), chart.backend_coord(&(x.1, y.0)));
        labels::draw(area, &named, &curves, [x0, y0, x1, y1])
    })
}
