//! Steady motions of designs with an absorber whose twist is not small, over speed.

use super::canvas::{self, COLOURS, GREY, Stroke, WIDTH, captioned, fill, line, px, text};
use super::legend::{self, Entry, Mark};
use crate::analysis::{LargePoint, LargeTwistOfDesign, Results};
use crate::files::{Folder, WriteError};
use crate::input::Study;
use crate::units::DEG_PER_RAD;
use plotters::prelude::*;

/// `large_twist`: a line a design for motions that may last, dots for those that do not, a thin line for small twist.
pub(crate) fn draw(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let x = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    if results.large_twist.is_empty() || x.0 >= x.1 {
        return Ok(());
    }
    let small = |design: &str| -> Vec<f64> {
        let sweep = results.sweeps.iter().find(|s| s.design == design);
        sweep.and_then(|s| s.quantities.first()).map_or_else(Vec::new, |q| q.total.clone())
    };
    let motions = results.large_twist.iter().flat_map(|d| d.curves.iter().flatten().map(|p| p.twist * DEG_PER_RAD));
    let high = motions.chain(results.large_twist.iter().flat_map(|d| small(&d.design))).fold(0.0, f64::max);
    let small_stroke = |i: usize| Stroke { style: line(COLOURS[i % COLOURS.len()], 8), ..Stroke::dashed(line(BLACK, 8)) };
    let entries_of = |(i, d): (usize, &LargeTwistOfDesign)| {
        let name = d.design.replace('_', " ");
        let own = Stroke::solid(line(COLOURS[i % COLOURS.len()], 20));
        [Entry::curve(&name, own), Entry::curve(format!("{name}, if its twist were small"), small_stroke(i))]
    };
    let mut entries: Vec<Entry> = results.large_twist.iter().enumerate().flat_map(entries_of).collect();
    if results.large_twist.iter().flat_map(|d| d.curves.iter().flatten()).any(|p| p.stable == Some(false)) {
        entries.push(Entry::new("motion that does not last", Mark::Point(fill(GREY, 1.0))));
    }
    canvas::save(folder, "large_twist", (WIDTH, 400 + legend::height(&entries, WIDTH)), |area| {
        let main = legend::below(area, &entries)?;
        let own = captioned(&main, format!("{}: twist at its own amplitude", study.engine.name), text(16))?;
        let mut chart = ChartBuilder::on(&own)
            .margin(px(8))
            .x_label_area_size(px(44))
            .y_label_area_size(px(60))
            .build_cartesian_2d(x.0..x.1, 0.0..1.08 * high)?;
        canvas::mesh!(chart, "speed / rpm", "twist / °", 9, 9);
        for (i, d) in results.large_twist.iter().enumerate() {
            let colour = COLOURS[i % COLOURS.len()];
            canvas::curve(&mut chart, study.speeds_rpm.iter().copied().zip(small(&d.design)), small_stroke(i))?;
            for curve in &d.curves {
                let inside = |p: &&LargePoint| (x.0..=x.1).contains(&p.speed_rpm);
                let point = |p: &LargePoint| (p.speed_rpm, p.twist * DEG_PER_RAD);
                for piece in curve.split(|p| p.stable == Some(false)).filter(|p| !p.is_empty()) {
                    chart.draw_series(LineSeries::new(piece.iter().filter(inside).map(point), line(colour, 20)))?;
                }
                let fleeting = curve.iter().filter(|p| p.stable == Some(false)).filter(inside);
                chart.draw_series(fleeting.map(|p| Circle::new(point(p), px(1), fill(colour, 1.0))))?;
            }
        }
        Ok(())
    })
}
