//! Front of ring inertia against the objective, with the given designs marked.

use super::canvas::{self, COLOURS, GREY, Stroke, WIDTH, captioned, fill, line, px, text};
use super::labels;
use super::legend::{self, Entry};
use crate::absorber::TYPES;
use crate::analysis::{FrontResult, Results};
use crate::csv::in_unit;
use crate::files::{Folder, WriteError};
use crate::input::{Study, UnitOf};
use crate::optimise::FrontPoint;
use plotters::prelude::*;

/// A colour for each declared type; what is none of them (a locked ring) is grey.
fn colour(type_name: &str) -> RGBColor {
    TYPES.iter().position(|t| t.name == type_name).map_or(GREY, |i| COLOURS[i % COLOURS.len()])
}

/// What no design with a ring of each size is proved to be better than.
fn bounds(study: &Study, front: &FrontResult) -> Vec<(f64, f64)> {
    let bound = |p: &FrontPoint| Some((p.design[0].absorber.ring_inertia(), in_unit(study, p.proof.as_ref()?.lower_bound?)));
    front.front.points.iter().filter_map(bound).collect()
}

/// The scale of the objective.
fn scale(study: &Study, smallest: f64, largest: f64) -> (f64, f64) {
    match study.objective.unit {
        // margins differ little and have no natural zero
        UnitOf::Margin | UnitOf::Life => {
            ((smallest - 0.5 * (largest - smallest)).max(0.0), largest + 0.25 * (largest - smallest).max(1e-3))
        }
        _ => (0.0, canvas::round_up(largest)),
    }
}

pub(crate) fn draw(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let front = |front: &FrontResult| -> Vec<(f64, f64)> {
        front.front.points.iter().map(|p| (p.design[0].absorber.ring_inertia(), in_unit(study, p.value))).collect()
    };
    let lines: Vec<(&str, Vec<(f64, f64)>)> = results.fronts.iter().map(|f| (f.declaration.name, front(f))).collect();
    let proved: Vec<Vec<(f64, f64)>> = results.fronts.iter().map(|f| bounds(study, f)).filter(|b| !b.is_empty()).collect();
    let mut given: Vec<(String, &str, (f64, f64))> = results
        .designs
        .iter()
        .filter_map(|d| match d.absorbers.as_slice() {
            [one] => Some((d.name.clone(), one.absorber.type_name(), (one.absorber.ring_inertia(), in_unit(study, d.objective?)))),
            _ => None,
        })
        .collect();
    given.sort_by(|a, b| b.2.1.total_cmp(&a.2.1));
    let points = || lines.iter().flat_map(|l| l.1.iter()).chain(given.iter().map(|g| &g.2));
    let left = points().map(|p| p.0).fold(f64::INFINITY, f64::min);
    let right = points().map(|p| p.0).fold(0.0, f64::max);
    let none = results.designs.iter().find(|d| d.absorbers.is_empty()).and_then(|d| d.objective).map(|v| in_unit(study, v));
    let floor = results.forced_floor.map(|v| in_unit(study, v));
    let largest = lines.iter().flat_map(|l| l.1.iter()).map(|p| p.1).chain(given.iter().map(|g| g.2.1)).chain(none).fold(0.0, f64::max);
    let smallest = points().map(|p| p.1).chain(none).fold(f64::INFINITY, f64::min);
    let (bottom, top) = scale(study, smallest, largest);
    let unit = match study.objective.unit.suffix().trim() {
        "" => String::new(),
        suffix => format!(" / {suffix}"),
    };
    let stroke = |i: usize, kind: &str| Stroke { style: line(colour(kind), 22), ..Stroke::of(i, 22) };
    let levels = [(none, "no absorber", Stroke::dashed(line(BLACK, 12))), (floor, "quasi-static", Stroke::dashed(line(GREY, 12)))];
    let mut entries: Vec<Entry> = lines
        .iter()
        .enumerate()
        .map(|(i, (kind, _))| Entry::curve(format!("optimum, {}", kind.replace('_', " ")), stroke(i, kind)))
        .collect();
    let thin = line(GREY, 8);
    entries.extend(proved.first().map(|_| Entry::curve("proved: no such ring is better", Stroke::solid(thin))));
    entries.extend(levels.iter().filter(|l| l.0.is_some()).map(|(_, label, stroke)| Entry::curve(*label, *stroke)));
    canvas::save(folder, "pareto", (WIDTH, 440 + legend::height(&entries, WIDTH)), |area| {
        let main = legend::below(area, &entries)?;
        let own = captioned(&main, format!("{}: optimum against ring inertia", study.engine.name), text(16))?;
        let mut chart = ChartBuilder::on(&own)
            .margin(px(8))
            .margin_right(px(20))
            .x_label_area_size(px(40))
            .y_label_area_size(px(62))
            .build_cartesian_2d(
                (left * 0.93..right * 1.08).log_scale().with_key_points(canvas::ticks(left * 0.93, right * 1.08)),
                bottom..top,
            )?;
        canvas::mesh!(chart, "ring inertia / kg m²", format!("{}{unit}", study.objective.label.replace('_', " ")), 20, 9);
        let mut curves: Vec<(i32, i32)> = Vec::new();
        let mut draw = |points: &[(f64, f64)], stroke: Stroke| {
            curves.extend(labels::along(&points.iter().map(|p| chart.backend_coord(p)).collect::<Vec<_>>()));
            canvas::curve(&mut chart, points.iter().copied(), stroke)
        };
        for (i, (kind, points)) in lines.iter().enumerate() {
            draw(points, stroke(i, kind))?;
        }
        for bounds in &proved {
            draw(bounds, Stroke::solid(thin))?;
        }
        for (level, _, stroke) in levels {
            if let Some(level) = level {
                draw(&[(left * 0.93, level), (right * 1.08, level)], stroke)?;
            }
        }
        for (_, kind, at) in &given {
            chart.draw_series(std::iter::once(Circle::new(*at, px(5), fill(colour(kind), 1.0))))?;
        }
        let named: Vec<(String, (i32, i32))> =
            given.iter().map(|(name, _, at)| (name.replace('_', " "), chart.backend_coord(at))).collect();
        let ((x0, y0), (x1, y1)) = (chart.backend_coord(&(left * 0.93, top)), chart.backend_coord(&(right * 1.08, bottom)));
        labels::draw(area, &named, &curves, [x0, y0, x1, y1])
    })
}
