//! Margin of the crank over speed, and the loads along it.

use super::canvas::{self, COLOURS, Drawn, GREY, line, px, text};
use crate::analysis::Results;
use crate::analysis::diagram::{Diagram, Instant};
use crate::crankshaft::loads::InPlanes;
use crate::input::Study;
use crate::report::files::{Folder, WriteError};
use crate::units::{M_PER_MM, N_PER_KN};
use plotters::prelude::*;

/// Margins above this multiple of the smallest are cut off.
const CUT: f64 = 4.0;

/// More panels than this stand in two columns.
const ABREAST: usize = 3;

/// Smallest margin of every design at every speed, a panel a criterion.
pub fn margins(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let Some(model) = &results.margin else { return folder.remove(&["margin.svg", "margin.png"]) };
    let panels = model.criteria.len();
    let columns = if panels > ABREAST { 2 } else { 1 };
    let rows = panels.div_ceil(columns);
    canvas::save(folder, "margin", (880 * columns as u32, 34 + 330 * rows as u32), |area| {
        let titled = canvas::titled(area, &format!("{}: margin of the crank", study.engine.name))?;
        for (c, area) in titled.split_evenly((rows, columns)).iter().take(panels).enumerate() {
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
    let (main, side) = area.split_horizontally(area.dim_in_pixel().0 - px(240));
    let (first, last) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let span = if last > first { first..last } else { first - 1.0..first + 1.0 };
    let name = model.criteria[criterion].name();
    let mut chart = ChartBuilder::on(&main)
        .caption(format!("smallest of all fillets, {}", name.replace('_', " ")), text(14))
        .margin(px(8))
        .x_label_area_size(px(36))
        .y_label_area_size(px(54))
        .build_cartesian_2d(span.clone(), bottom..top)?;
    canvas::mesh!(chart, "speed / rpm", "safety factor", 9, 7);
    let mut entries = Vec::new();
    if let Some(least) = accepted {
        let style = line(GREY, 12);
        chart.draw_series(DashedLineSeries::new([(span.start, least), (span.end, least)], px(6), px(5), style))?;
        entries.push((format!("accepted from {least} (dashed)"), style));
    }
    for (i, (design, values)) in curves.iter().enumerate() {
        let width = if results.is_optimum(design) { 26 } else { 14 };
        let style = if i == 0 && *design == "none" { line(BLACK, 14) } else { line(COLOURS[i % COLOURS.len()], width) };
        if values.len() == 1 {
            chart.draw_series(std::iter::once(Circle::new((first, values[0].min(top)), px(4), style)))?;
        }
        for piece in canvas::clipped(study.speeds_rpm.iter().copied().zip(values.iter().copied()), top) {
            chart.draw_series(LineSeries::new(piece, style))?;
        }
        entries.push((design.replace('_', " "), style));
    }
    canvas::legend(&side, &entries)
}

/// Shear force, bending moment and torque along the crank where its most used web is bent most, and at the other end of that range.
pub fn diagram(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let Some(d) = &results.diagram else { return folder.remove(&["crank.svg", "crank.png"]) };
    let in_planes = |pick: fn(&Instant) -> &InPlanes, unit: f64| -> Vec<Curve> {
        let of = |(i, instant): (usize, &Instant)| {
            let planes = ["in the plane of the throw", "across it"].into_iter().zip(pick(instant)).zip([22, 10]);
            planes
                .map(|((plane, points), width)| Curve::new(format!("{}, {plane}", angle(instant)), points, unit, (i, width)))
                .collect::<Vec<_>>()
        };
        d.instants.iter().enumerate().flat_map(of).collect()
    };
    let shear = in_planes(|i| &i.shear, N_PER_KN);
    let moment = in_planes(|i| &i.moment, 1.0);
    let torque: Vec<Curve> =
        d.instants.iter().enumerate().map(|(i, instant)| Curve::new(angle(instant), &instant.torque, 1.0, (i, 22))).collect();
    canvas::save(folder, "crank", (1000, 40 + 3 * 270), |area| {
        let title = format!(
            "{}: loads along the crank at {:.0} rpm, {} (smallest margin at {})",
            study.engine.name,
            d.speed_rpm,
            d.design.replace('_', " "),
            d.location.replace('_', " ")
        );
        let titled = canvas::titled(area, &title)?;
        let areas = titled.split_evenly((3, 1));
        along(&areas[0], d, "shear force / kN", &shear)?;
        along(&areas[1], d, "bending moment / N m", &moment)?;
        along(&areas[2], d, "torque / N m", &torque)
    })
}

fn angle(instant: &Instant) -> String {
    format!("{:.1}°", instant.crank_deg)
}

/// A curve along the crank, mm.
struct Curve {
    label: String,
    points: Vec<(f64, f64)>,
    style: ShapeStyle,
}

impl Curve {
    fn new(label: String, points: &[(f64, f64)], unit: f64, (colour, width): (usize, u32)) -> Self {
        Self { label, points: points.iter().map(|(x, y)| (x / M_PER_MM, y / unit)).collect(), style: line(COLOURS[colour], width) }
    }
}

fn along(area: &canvas::Area, d: &Diagram, unit: &str, curves: &[Curve]) -> Drawn {
    let (main, side) = area.split_horizontally(area.dim_in_pixel().0 - px(240));
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
        .x_label_area_size(px(34))
        .y_label_area_size(px(66))
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
        chart.draw_series(LineSeries::new(curve.points.iter().copied(), curve.style))?;
    }
    let entries: Vec<(String, ShapeStyle)> = curves.iter().map(|c| (c.label.clone(), c.style)).collect();
    canvas::legend(&side, &entries)
}
