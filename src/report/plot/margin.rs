//! Margin of the crank over speed, and the loads along it.

use super::canvas::{self, COLOURS, Drawn, GREY, Stroke, WIDTH, captioned, line, px, text};
use super::legend::{self, Entry};
use crate::analysis::Results;
use crate::analysis::crank_diagram::{Diagram, Instant};
use crate::crankshaft::loads::InPlanes;
use crate::files::{Folder, WriteError};
use crate::input::Study;
use crate::units::{M_PER_MM, N_PER_KN};
use plotters::prelude::*;

/// Margins above this multiple of the smallest are cut off.
const CUT: f64 = 4.0;

/// How the least margin that a criterion accepts is drawn.
const ACCEPTED: Stroke =
    Stroke { style: ShapeStyle { color: RGBAColor(110, 110, 110, 1.0), filled: false, stroke_width: 12 }, dash: Some((9, 4)) };

/// More panels than this stand in two columns.
const ABREAST: usize = 3;

/// Smallest margin of every design at every speed, a panel a criterion.
pub fn margins(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let Some(model) = &results.margin else { return Ok(()) };
    let panels = model.criteria.len();
    let columns = if panels > ABREAST { 2 } else { 1 };
    let rows = panels.div_ceil(columns);
    let title = format!("{}: margin of the crank, smallest of all fillets", study.engine.name);
    let mut entries: Vec<Entry> =
        results.margins.iter().enumerate().map(|(i, m)| Entry::curve(m.design.replace('_', " "), stroke(results, i, &m.design))).collect();
    if model.criteria.iter().any(|c| c.acceptable().is_some()) {
        entries.push(Entry::curve("least that is accepted", ACCEPTED));
    }
    canvas::save(folder, "margin", (WIDTH, canvas::title_height(&title) + 270 * rows as u32 + legend::height(&entries, WIDTH)), |area| {
        let titled = canvas::titled(area, &title)?;
        let above = legend::below(&titled, &entries)?;
        for (c, area) in above.split_evenly((rows, columns)).iter().take(panels).enumerate() {
            panel(area, study, results, c)?;
        }
        Ok(())
    })
}

fn panel(area: &canvas::Area, study: &Study, results: &Results, criterion: usize) -> Drawn {
    let Some(model) = &results.margin else { return Ok(()) };
    let curves: Vec<(&str, Vec<f64>)> = results.margins.iter().map(|m| (m.design.as_str(), m.smallest(criterion))).collect();
    let smallest = curves.iter().flat_map(|c| &c.1).copied().fold(f64::INFINITY, f64::min);
    let largest = curves.iter().flat_map(|c| &c.1).copied().filter(|v| v.is_finite()).fold(0.0, f64::max);
    let accepted = model.criteria[criterion].acceptable();
    // margins differ little between designs: the axis spans what there is, with the accepted margin
    let (bottom, top) = if smallest.is_finite() && largest > 0.0 {
        let low = smallest.min(accepted.unwrap_or(smallest));
        let high = largest.min(CUT * smallest).max(accepted.unwrap_or(0.0));
        let room = (high - low).max(0.02 * high);
        ((low - 0.25 * room).max(0.0), high + 0.1 * room)
    } else {
        (0.0, accepted.unwrap_or(1.0) * 1.1)
    };
    let (first, last) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let span = if last > first { first..last } else { first - 1.0..first + 1.0 };
    let name = model.criteria[criterion].name();
    let own = captioned(area, name.replace('_', " "), text(15))?;
    let mut chart = ChartBuilder::on(&own)
        .margin(px(8))
        .margin_right(px(20))
        .x_label_area_size(px(40))
        .y_label_area_size(px(58))
        .build_cartesian_2d(span.clone(), bottom..top)?;
    canvas::mesh!(chart, "speed / rpm", "safety factor", 5, 7);
    if let Some(least) = accepted {
        canvas::curve(&mut chart, [(span.start, least), (span.end, least)], ACCEPTED)?;
    }
    for (i, (design, values)) in curves.iter().enumerate() {
        let stroke = stroke(results, i, design);
        if values.len() == 1 {
            chart.draw_series(std::iter::once(Circle::new((first, values[0].min(top)), px(4), stroke.style)))?;
        }
        for piece in canvas::clipped(study.speeds_rpm.iter().copied().zip(values.iter().copied()), top) {
            canvas::curve(&mut chart, piece, stroke)?;
        }
    }
    Ok(())
}

/// That of a design: black without absorber, broad for an optimum.
fn stroke(results: &Results, i: usize, design: &str) -> Stroke {
    let without = i == 0 && results.designs.first().is_some_and(|d| d.name == design && d.absorbers.is_empty());
    if without { Stroke::solid(line(BLACK, 14)) } else { Stroke::of(i, if results.is_optimum(design) { 26 } else { 14 }) }
}

/// Shear force, bending moment and torque along the crank where its most used web is bent most, and at the other end of that range.
pub fn diagram(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let Some(d) = &results.diagram else { return Ok(()) };
    let in_planes = |pick: fn(&Instant) -> &InPlanes, unit: f64| -> Vec<Curve> {
        let curves_of = |(i, instant): (usize, &Instant)| {
            let planes = ["in the plane of the throw", "across it"].into_iter().zip(pick(instant)).zip([22, 10]);
            planes
                .map(|((plane, points), width)| Curve::new(format!("{}, {plane}", angle(instant)), points, unit, (i, width)))
                .collect::<Vec<_>>()
        };
        d.instants.iter().enumerate().flat_map(curves_of).collect()
    };
    let shear = in_planes(|i| &i.shear, N_PER_KN);
    let moment = in_planes(|i| &i.moment, 1.0);
    let torque: Vec<Curve> =
        d.instants.iter().enumerate().map(|(i, instant)| Curve::new(angle(instant), &instant.torque, 1.0, (i, 22))).collect();
    let title = format!(
        "{}: loads along the crank at {:.0} rpm, {} (smallest margin at {})",
        study.engine.name,
        d.speed_rpm,
        d.design.replace('_', " "),
        d.location.replace('_', " ")
    );
    let panels = [("shear force / kN", &shear), ("bending moment / N m", &moment), ("torque / N m", &torque)];
    let height = |curves: &[Curve]| HEIGHT + legend::height(&entries(curves), WIDTH);
    let all: u32 = panels.iter().map(|p| height(p.1)).sum();
    canvas::save(folder, "crank", (WIDTH, canvas::title_height(&title) + all), |area| {
        let mut rest = canvas::titled(area, &title)?;
        for (unit, curves) in panels {
            let (own, below) = rest.split_vertically(px(height(curves)));
            along(&own, d, unit, curves)?;
            rest = below;
        }
        Ok(())
    })
}

fn angle(instant: &Instant) -> String {
    format!("{:.1}°", instant.crank_deg)
}

/// A curve along the crank, mm.
struct Curve {
    label: String,
    points: Vec<(f64, f64)>,
    stroke: Stroke,
}

/// Height of a panel along the crank; its legend comes to it.
const HEIGHT: u32 = 250;

fn entries(curves: &[Curve]) -> Vec<Entry> {
    curves.iter().map(|c| Entry::curve(&c.label, c.stroke)).collect()
}

impl Curve {
    fn new(label: String, points: &[(f64, f64)], unit: f64, (colour, width): (usize, u32)) -> Self {
        Self {
            label,
            points: points.iter().map(|(x, y)| (x / M_PER_MM, y / unit)).collect(),
            stroke: Stroke { style: line(COLOURS[colour], width), ..Stroke::of(usize::from(width < 20), width) },
        }
    }
}

fn along(area: &canvas::Area, d: &Diagram, unit: &str, curves: &[Curve]) -> Drawn {
    let main = legend::below(area, &entries(curves))?;
    let all = || curves.iter().flat_map(|c| c.points.iter().map(|p| p.1));
    let top = canvas::round_up(1.05 * all().map(f64::abs).fold(0.0, f64::max));
    // bending moments of a pushed crank have one sign only: the frame takes what there is
    let (low, high) = (all().fold(0.0, f64::min), all().fold(0.0, f64::max));
    let (bottom, top) = (
        if low < -0.02 * top { -canvas::round_up(-1.05 * low) } else { 0.0 },
        if high > 0.02 * top { canvas::round_up(1.05 * high) } else { 0.0 },
    );
    let end = d.bearings[d.bearings.len() - 1] / M_PER_MM;
    let mut chart = ChartBuilder::on(&main)
        .margin(px(8))
        .margin_right(px(20))
        .x_label_area_size(px(40))
        .y_label_area_size(px(68))
        .build_cartesian_2d(-0.01 * end..1.01 * end, bottom..top.max(bottom + 1e-9))?;
    canvas::mesh!(chart, "along the crank / mm (bearings dashed, crankpins dotted)", unit, 10, 6);
    for (places, dash) in [(&d.bearings, 7), (&d.pins, 2)] {
        for x in places {
            let x = x / M_PER_MM;
            let ends = [(x, bottom), (x, top)];
            chart.draw_series(DashedLineSeries::new(ends, px(dash), px(4), line(GREY, 8)))?;
        }
    }
    chart.draw_series(LineSeries::new([(-0.01 * end, 0.0), (1.01 * end, 0.0)], line(GREY, 8)))?;
    for curve in curves {
        canvas::curve(&mut chart, curve.points.iter().copied(), curve.stroke)?;
    }
    Ok(())
}
