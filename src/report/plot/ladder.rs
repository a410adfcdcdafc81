//! Models of the crank: time against error, and the error of chains as bearings get softer.

use super::canvas::{self, Area, COLOURS, Stroke, WIDTH, captioned, fill, line, px, text};
use super::chart::decades;
use super::legend::{self, Entry, Mark};
use crate::benchmark::crank_ladder::{Ladder, Rung};
use crate::files::{Folder, WriteError};
use crate::input::Study;
use plotters::coord::combinators::WithKeyPoints;
use plotters::prelude::*;

/// Smaller errors are drawn on this.
const LEAST_ERROR: f64 = 1e-6;
/// Height of a panel, units.
const HEIGHT: u32 = 340;

fn colour(rung: Rung) -> RGBColor {
    Rung::ALL.iter().position(|r| *r == rung).and_then(|i| COLOURS.get(i).copied()).unwrap_or(BLACK)
}

/// A logarithmic axis whose numbers are given.
type Keyed = WithKeyPoints<LogCoord<f64>>;

/// A chart with logarithmic axes: ranges of both, and where the lower one has numbers.
fn logarithmic<'a>(
    area: &Area<'a>,
    (x, ticks): ((f64, f64), Vec<f64>),
    y: (f64, f64),
) -> Result<ChartContext<'a, SVGBackend<'a>, Cartesian2d<Keyed, Keyed>>, Box<dyn std::error::Error>> {
    let mut on = ChartBuilder::on(area);
    on.margin(px(8)).margin_right(px(24)).x_label_area_size(px(40)).y_label_area_size(px(62));
    let (across, up) = ((x.0..x.1).log_scale().with_key_points(ticks), (y.0..y.1).log_scale().with_key_points(decades(y.0, y.1)));
    Ok(on.build_cartesian_2d(across, up)?)
}

/// Seconds of a run against what each model errs by: a filled circle for the peak, a ring for the margin, a triangle for the optimum; below, the error of the peak of chains over the stiffness of the bearings.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
pub(crate) fn ladder(study: &Study, ladder: &Ladder, folder: &Folder) -> Result<(), WriteError> {
    let rungs: Vec<_> = ladder.rungs.iter().filter(|r| r.rung != Rung::Flexible).collect();
    let all = || rungs.iter().flat_map(|r| [Some(r.peak), r.margin, r.optimum]).flatten().map(|e| e.max(LEAST_ERROR));
    let of_bearings = || ladder.bearings.iter().flat_map(|b| b.1.iter().map(|e| e.1.max(LEAST_ERROR)));
    let range = |values: &mut dyn Iterator<Item = f64>| {
        let (low, high) = values.fold((f64::INFINITY, 0.0f64), |(a, b), v| (a.min(v), b.max(v)));
        (low / 1.8, high * 1.8)
    };
    if rungs.is_empty() || ladder.bearings.is_empty() {
        return Ok(());
    }
    let (x, y) = (range(&mut ladder.rungs.iter().map(|r| r.seconds)), range(&mut all()));
    let (bearing_x, bearing_y) = (range(&mut ladder.bearings.iter().map(|b| b.0)), range(&mut of_bearings()));
    let mut entries: Vec<Entry> = rungs.iter().map(|r| Entry::new(r.rung.label(), Mark::Point(fill(colour(r.rung), 1.0)))).collect();
    if let Some(own) = ladder.rungs.iter().find(|r| r.rung == Rung::Flexible) {
        entries.push(Entry::curve(format!("time of the flexible crank, {:.1} s", own.seconds), Stroke::dashed(line(BLACK, 12))));
    }
    let title = format!("{}: models of the crank", study.engine.name);
    let height = canvas::title_height(&title) + legend::height(&entries, WIDTH) + 2 * HEIGHT;
    canvas::save(folder, "crank_ladder", (WIDTH, height), |area| {
        let titled = canvas::titled(area, &title)?;
        let rest = legend::below(&titled, &entries)?;
        let (upper, lower) = rest.split_vertically(px(HEIGHT));
        let own = captioned(&upper, "time of a run with its search: error of the peak ●, of the margin ○, of the optimum ▲", text(15))?;
        let mut chart = logarithmic(&own, (x, canvas::ticks(x.0, x.1)), y)?;
        canvas::log_axes!(chart, "time / s", "relative error", &|v| canvas::tick(v));
        for r in &rungs {
            let c = colour(r.rung);
            let point = |e: f64| (r.seconds, e.max(LEAST_ERROR));
            chart.draw_series([Circle::new(point(r.peak), px(5), fill(c, 1.0))])?;
            chart.draw_series(r.margin.map(|e| Circle::new(point(e), px(5), line(c, 18))))?;
            chart.draw_series(r.optimum.map(|e| TriangleMarker::new(point(e), px(6), fill(c, 1.0))))?;
        }
        if let Some(own) = ladder.rungs.iter().find(|r| r.rung == Rung::Flexible) {
            canvas::curve(&mut chart, [(own.seconds, y.0), (own.seconds, y.1)], Stroke::dashed(line(BLACK, 12)))?;
        }
        let own = captioned(&lower, "chains against the flexible crank as its bearings get softer and stiffer", text(15))?;
        let mut chart = logarithmic(&own, (bearing_x, decades(bearing_x.0, bearing_x.1)), bearing_y)?;
        canvas::log_axes!(chart, "stiffness of all bearings over that given", "relative error of the peak", &|v| canvas::tick(v));
        for rung in Rung::ALL.into_iter().filter(|r| r.is_chain()) {
            let point_of = |b: &(f64, Vec<(Rung, f64)>)| b.1.iter().find(|e| e.0 == rung).map(|e| (b.0, e.1.max(LEAST_ERROR)));
            let points: Vec<(f64, f64)> = ladder.bearings.iter().filter_map(point_of).collect();
            canvas::curve(&mut chart, points.iter().copied(), Stroke::solid(line(colour(rung), 16)))?;
            chart.draw_series(points.iter().map(|p| Circle::new(*p, px(3), fill(colour(rung), 1.0))))?;
        }
        Ok(())
    })
}
