//! The worst point, or the one asked for: its shear path with the circle, its path of Dang Van with the limit, and the factors of all criteria.

use super::canvas::{self, COLOURS, Drawn, GREY, Stroke, WIDTH, captioned, fill, line, px, text};
use super::curves;
use super::legend::{self, Entry, Mark};
use crate::analysis::curves::{Axis, Panel, Scale, curve};
use crate::analysis::stress_figures::circle;
use crate::analysis::stress_histories::Summary;
use crate::fatigue::multiaxial::plane::Scratch;
use crate::fatigue::multiaxial::{Criterion, Limits, Verdict};
use crate::files::{Folder, WriteError};
use crate::numerics::elementary::Elementary;
use crate::units::PA_PER_MPA;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Draws the plots of a summary.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
#[doc(hidden)]
pub fn draw(summary: &Summary, limits: &Limits, folder: &Folder) -> Result<(), WriteError> {
    let Some((point, result)) = &summary.critical else { return Ok(()) };
    let verdict = |c: Criterion| result.verdicts.iter().find(|v| v.criterion == c);
    canvas::save(folder, "fatigue", (WIDTH, 36 + 412 + 320), |area| {
        let titled = canvas::titled(
            area,
            &format!("point {}{}", point.name, if summary.asked.is_none() { ": the smallest factor of all points" } else { "" }),
        )?;
        let (upper, right) = titled.split_vertically(px(412));
        let (left, middle) = upper.split_horizontally(px(WIDTH / 2));
        if let Some(v) = verdict(Criterion::MATAKE) {
            shear_path(&left, point, v)?;
        }
        if let Some(v) = verdict(Criterion::DANG_VAN_PLANE) {
            dang_van(&middle, point, v, limits)?;
        }
        factors(&right, &result.verdicts)
    })
}

type Point = crate::input::tables::PointHistory;

fn closed(points: impl Iterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    let mut list: Vec<(f64, f64)> = points.collect();
    list.extend(list.first().copied());
    list
}

fn shear_path(area: &canvas::Area, point: &Point, v: &Verdict) -> Drawn {
    let Some(plane) = v.plane else { return Ok(()) };
    let mut scratch = Scratch::default();
    let around = scratch.circle(&point.history, &plane);
    let [x, y] = scratch.path();
    let path = closed(x.iter().zip(y).map(|(x, y)| (x / PA_PER_MPA, y / PA_PER_MPA)));
    let (x, y): (Vec<f64>, Vec<f64>) = path.into_iter().unzip();
    let panel = Panel {
        title: "shear on the critical plane and its circle".into(),
        x: Axis { column: "shear_phi_mpa", label: "along growing phi / MPa" },
        y: Axis { column: "shear_theta_mpa", label: "along growing theta / MPa" },
        curves: vec![curve("shear over the cycle", x, y), circle("its smallest circle", around.centre, around.radius)],
        scale: Scale::Equal,
    };
    curves::panel(area, &panel)
}

fn dang_van(area: &canvas::Area, point: &Point, v: &Verdict, limits: &Limits) -> Drawn {
    let (Some(plane), Ok(weight)) = (v.plane, Criterion::DANG_VAN_PLANE.weight(limits)) else { return Ok(()) };
    let mut scratch = Scratch::default();
    let circle = scratch.circle(&point.history, &plane);
    let [x, y] = scratch.path();
    let p = point.history.hydrostatic();
    let shear = x.iter().zip(y).map(|(x, y)| (x - circle.centre[0]).hypotenuse(y - circle.centre[1]) / PA_PER_MPA);
    let path = closed(p.iter().map(|p| p / PA_PER_MPA).zip(shear));
    let ends = |of: fn(&(f64, f64)) -> f64| path.iter().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), |m, v| (m.0.min(v), m.1.max(v)));
    let (low, high) = ends(|p| p.0);
    let room = 0.15 * (high - low).max(1.0);
    let (low, high) = ((low - room).min(0.0), (high + room).max(0.0));
    let limit = |p: f64| limits.torsion / PA_PER_MPA - weight * p;
    let top = canvas::round_up(1.05 * limit(low).max(ends(|p| p.1).1));
    let (shown, allowed) = (line(COLOURS[0], 20), Stroke::dashed(line(COLOURS[1], 18)));
    let area = legend::below(area, &[Entry::curve("stress over the cycle", Stroke::solid(shown)), Entry::curve("limit", allowed)])?;
    let own = captioned(&area, "Dang Van, plane: path and limit", text(14))?;
    let mut chart =
        ChartBuilder::on(&own).margin(px(8)).x_label_area_size(px(40)).y_label_area_size(px(60)).build_cartesian_2d(low..high, 0.0..top)?;
    canvas::mesh!(chart, "hydrostatic stress / MPa", "mesoscopic shear / MPa", 6, 7);
    for piece in canvas::clipped([(low, limit(low)), (high, limit(high))].into_iter(), top) {
        canvas::curve(&mut chart, piece.into_iter().filter(|p| p.1 >= 0.0), allowed)?;
    }
    chart.draw_series(LineSeries::new(path, shown))?;
    Ok(())
}

fn factors(area: &canvas::Area, verdicts: &[Verdict]) -> Drawn {
    let finite = verdicts.iter().map(|v| v.safety_factor).filter(|f| f.is_finite());
    let top = canvas::round_up(1.15 * finite.fold(1.0, f64::max));
    let count = verdicts.len() as f64;
    let bar = |plane: bool| fill(if plane { COLOURS[0] } else { COLOURS[2] }, 0.85);
    let area = legend::below(
        area,
        &[Entry::new("on a critical plane", Mark::Block(bar(true))), Entry::new("by invariants", Mark::Block(bar(false)))],
    )?;
    let own = captioned(&area, "factors of all criteria", text(14))?;
    let mut chart = ChartBuilder::on(&own)
        .margin(px(8))
        .x_label_area_size(px(40))
        .y_label_area_size(px(165))
        .build_cartesian_2d(0.0..top, 0.0..count)?;
    chart
        .configure_mesh()
        .x_desc("safety factor")
        .x_labels(6)
        .y_labels(0)
        .axis_desc_style(text(13))
        .label_style(text(13))
        .light_line_style(TRANSPARENT)
        .bold_line_style(line(canvas::PALE, 8))
        .axis_style(line(GREY, 10))
        .x_label_formatter(&|x| canvas::tick(x))
        .draw()?;
    chart.draw_series(LineSeries::new([(1.0, 0.0), (1.0, count)], line(GREY, 10)))?;
    for (i, v) in verdicts.iter().enumerate() {
        let y = count - 1.0 - i as f64;
        let length = v.safety_factor.min(top);
        chart.draw_series(std::iter::once(Rectangle::new([(0.0, y + 0.2), (length, y + 0.8)], bar(v.plane.is_some()))))?;
        let label = text(13).pos(Pos::new(HPos::Right, VPos::Center));
        let name = EmptyElement::at((0.0, y + 0.5)) + Text::new(v.criterion.name().replace('_', " "), (-(px(8) as i32), 0), label);
        chart.draw_series(std::iter::once(name))?;
        let value = text(13).pos(Pos::new(HPos::Left, VPos::Center));
        let words = if v.safety_factor.is_finite() { format!("{:.2}", v.safety_factor) } else { "infinite".into() };
        chart.draw_series(std::iter::once(EmptyElement::at((length, y + 0.5)) + Text::new(words, (px(5) as i32, 0), value)))?;
    }
    Ok(())
}
