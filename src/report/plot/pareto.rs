//! Front of ring inertia against the objective, with the given designs marked.

use super::canvas::{self, COLOURS, GREY, fill, line, px, text};
use crate::absorber::TYPES;
use crate::analysis::Results;
use crate::input::{Study, UnitOf};
use crate::numerics::elementary::Elementary;
use crate::report::csv::in_unit;
use crate::report::files::{Folder, WriteError};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// A colour for each declared type; what is none of them (a locked ring) is grey.
fn colour(type_name: &str) -> RGBColor {
    TYPES.iter().position(|t| t.name == type_name).map_or(GREY, |i| COLOURS[i % COLOURS.len()])
}

pub(crate) fn draw(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let front = |front: &crate::analysis::FrontResult| -> Vec<(f64, f64)> {
        front.front.points.iter().map(|p| (p.design[0].absorber.ring_inertia(), in_unit(study, p.value))).collect()
    };
    let lines: Vec<(&str, Vec<(f64, f64)>)> = results.fronts.iter().map(|f| (f.declaration.name, front(f))).collect();
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
    // margins differ little and have no natural zero
    let (bottom, top) = match study.objective.unit {
        UnitOf::Margin => ((smallest - 0.5 * (largest - smallest)).max(0.0), largest + 0.25 * (largest - smallest).max(1e-3)),
        _ => (0.0, canvas::round_up(largest)),
    };
    let unit = match study.objective.unit.suffix().trim() {
        "" => String::new(),
        suffix => format!(" / {suffix}"),
    };
    canvas::save(folder, "pareto", (900, 560), |area| {
        let (main, side) = area.split_horizontally(area.dim_in_pixel().0 - px(170));
        let mut chart = ChartBuilder::on(&main)
            .caption(format!("{}: optimum against ring inertia", study.engine.name), text(16))
            .margin(px(8))
            .x_label_area_size(px(36))
            .y_label_area_size(px(58))
            .build_cartesian_2d(
                (left * 0.93..right * 1.08).log_scale().with_key_points(canvas::ticks(left * 0.93, right * 1.08)),
                bottom..top,
            )?;
        canvas::mesh!(chart, "ring inertia / kg m²", format!("{}{unit}", study.objective.label.replace('_', " ")), 20, 9);
        let mut entries = Vec::new();
        for (kind, points) in &lines {
            chart.draw_series(LineSeries::new(points.iter().copied(), line(colour(kind), 22)))?;
            entries.push((format!("optimum, {}", kind), line(colour(kind), 22)));
        }
        for (level, label, style) in [(none, "no absorber", line(BLACK, 12)), (floor, "forced floor", line(GREY, 12))] {
            if let Some(level) = level {
                chart.draw_series(DashedLineSeries::new([(left * 0.93, level), (right * 1.08, level)], px(7), px(5), style))?;
                entries.push((format!("{label} (dashed)"), style));
            }
        }
        for (i, (name, kind, at)) in given.iter().enumerate() {
            // names are set to the side with more room; those of designs close together below each other
            let room = (at.0.logarithm() - left.logarithm()) / (right.logarithm() - left.logarithm());
            let (dx, side) = if room > 0.5 { (-(px(9) as i32), HPos::Right) } else { (px(9) as i32, HPos::Left) };
            let near = given[..i]
                .iter()
                .filter(|g| (g.2.1 - at.1).abs() < 0.035 * (top - bottom) && (g.2.0 / at.0).logarithm().abs() < 0.3)
                .count();
            let style = text(12).pos(Pos::new(side, VPos::Center));
            let dy = -(px(6) as i32) + (px(15) * near as u32) as i32;
            let marker = EmptyElement::at(*at)
                + Circle::new((0, 0), px(5), fill(colour(kind), 1.0))
                + Text::new(name.replace('_', " "), (dx, dy), style);
            chart.draw_series(std::iter::once(marker))?;
        }
        canvas::legend(&side, &entries)
    })
}
