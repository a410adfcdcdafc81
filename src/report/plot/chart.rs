//! Speed against accuracy, growth of cost, and the stability map.

use super::canvas::{self, COLOURS, GREY, Stroke, WIDTH, captioned, fill, line, px, text};
use super::legend::{self, Entry, Mark};
use crate::analysis::method_selection::Strategy;
use crate::benchmark::growth::{Growth, SIZES};
use crate::benchmark::methods::Candidate;
use crate::benchmark::speed_accuracy::{Point, Search, SpeedAccuracy};
use crate::benchmark::stability::{Cell, Scenario};
use crate::files::{Folder, WriteError};
use crate::input::Study;
use crate::numerics::elementary::Elementary;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Errors below this are drawn on it: rounding of the reference.
const LEAST_ERROR: f64 = 1e-12;

fn colour(candidate: Candidate) -> RGBColor {
    let index = Candidate::ALL.iter().position(|c| *c == candidate).unwrap_or(0);
    let more = [BLACK, RGBColor(150, 0, 60), RGBColor(0, 90, 80), RGBColor(90, 60, 160), RGBColor(190, 160, 0), GREY];
    COLOURS.iter().chain(&more).nth(index).copied().unwrap_or(GREY)
}

/// Powers of ten between two values.
pub(super) fn decades(low: f64, high: f64) -> Vec<f64> {
    (low.decimal_logarithm().floor() as i32..=high.decimal_logarithm().ceil() as i32)
        .map(|d| 10f64.powi(d))
        .filter(|t| (low..=high).contains(t))
        .collect()
}

/// Points that no other beats in both seconds and error, by seconds.
fn best(points: impl Iterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    let mut sorted: Vec<(f64, f64)> = points.collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut front: Vec<(f64, f64)> = Vec::new();
    for p in sorted {
        if front.last().is_none_or(|f| p.1 < f.1) {
            front.push(p);
        }
    }
    front
}

/// Seconds per design against the error of the peak.
pub fn speed_accuracy(study: &Study, measured: &SpeedAccuracy, folder: &Folder) -> Result<(), WriteError> {
    let points: Vec<(&Point, f64)> =
        measured.points.iter().filter_map(|p| Some((p, p.error.ok()?.max(LEAST_ERROR)))).filter(|p| p.0.seconds > 0.0).collect();
    if points.is_empty() {
        return Ok(());
    }
    let ways = |tables: bool| {
        let own = measured.ways.iter().filter(move |w| matches!(w.strategy, Strategy::Tables(_)) == tables);
        own.map(|w| (w.seconds, w.error.max(LEAST_ERROR))).collect::<Vec<_>>()
    };
    let all = || points.iter().map(|(p, e)| (p.seconds, *e)).chain(ways(true)).chain(ways(false));
    let (fast, slow) = all().fold((f64::INFINITY, 0.0f64), |(a, b), p| (a.min(p.0), b.max(p.0)));
    let worst = points.iter().map(|p| p.1).fold(0.0, f64::max);
    let (x, y) = ((fast / 1.5, slow * 1.5), (LEAST_ERROR / 2.0, worst * 2.0));
    let mut entries: Vec<Entry> = Candidate::ALL
        .iter()
        .filter(|c| points.iter().any(|p| p.0.candidate == **c))
        .map(|c| Entry::curve(c.label(), Stroke::solid(line(colour(*c), 20))))
        .collect();
    entries.push(Entry::curve("best of all", Stroke::solid(line(RGBColor(200, 200, 200), 60))));
    entries.push(Entry::new("14 to 521 speeds", Mark::Point(line(BLACK, 14))));
    entries.push(Entry::new("refined between speeds", Mark::Point(fill(BLACK, 1.0))));
    entries.push(Entry::new("triangles: tables of searches", Mark::Note));
    entries.push(Entry::new("cross: exact, as reported", Mark::Note));
    canvas::save(folder, "speed_accuracy", (WIDTH, 500 + legend::height(&entries, WIDTH)), |area| {
        let main = legend::below(area, &entries)?;
        let own = captioned(&main, format!("{}: cost of one design against the error of its peak twist", study.engine.name), text(15))?;
        let mut chart = ChartBuilder::on(&own).margin(px(8)).x_label_area_size(px(40)).y_label_area_size(px(68)).build_cartesian_2d(
            (x.0..x.1).log_scale().with_key_points(decades(x.0, x.1)),
            (y.0..y.1).log_scale().with_key_points(decades(y.0, y.1)),
        )?;
        canvas::log_axes!(chart, "seconds per design, one thread", "largest error of the peak over the probe designs", &|x| format!(
            "{x:.0e}"
        ));
        chart.draw_series(LineSeries::new(best(all()), line(RGBColor(200, 200, 200), 60)))?;
        let diamond = |p: (f64, f64)| TriangleMarker::new(p, px(5), fill(BLACK, 1.0));
        chart.draw_series(LineSeries::new(ways(true), line(BLACK, 12)))?;
        chart.draw_series(ways(true).into_iter().map(diamond))?;
        chart.draw_series(ways(false).into_iter().map(|p| Cross::new(p, px(5), line(BLACK, 20))))?;
        for candidate in Candidate::ALL {
            let series = |refined: bool| -> Vec<(f64, f64)> {
                let own = points.iter().filter(|p| p.0.candidate == candidate && matches!(p.0.search, Search::Refined(_)) == refined);
                own.map(|(p, e)| (p.seconds, *e)).collect()
            };
            chart.draw_series(LineSeries::new(series(false), line(colour(candidate), 16)))?;
            chart.draw_series(series(false).into_iter().map(|p| Circle::new(p, px(3), line(colour(candidate), 14))))?;
            chart.draw_series(series(true).into_iter().map(|p| Circle::new(p, px(4), fill(colour(candidate), 1.0))))?;
        }
        Ok(())
    })
}

/// Cost of a sweep against stations, orders and speeds.
pub fn growth(measured: &[Growth], folder: &Folder) -> Result<(), WriteError> {
    let all = || measured.iter().flat_map(|g| &g.points);
    let (low, high) = all().fold((f64::INFINITY, 0.0f64), |(a, b), p| (a.min(p.1), b.max(p.1)));
    let (low, high) = (low / 2.0, high * 2.0);
    let legends = |size: &str| -> Vec<Entry> {
        let own = measured.iter().filter(|g| g.size == size);
        own.map(|g| {
            Entry::curve(format!("{}: exponent {:.2}", g.candidate.label(), g.exponent), Stroke::solid(line(colour(g.candidate), 20)))
        })
        .collect()
    };
    let tallest = SIZES.iter().map(|size| legend::height(&legends(size), WIDTH / 2)).max().unwrap_or(0);
    canvas::save(folder, "growth", (WIDTH, 36 + 2 * (280 + tallest)), |area| {
        let titled = canvas::titled(area, "Cost of one sweep of one design, set-up aside")?;
        let panels = titled.split_evenly((2, 2));
        for (panel, size) in panels.iter().zip(SIZES) {
            let own: Vec<_> = measured.iter().filter(|g| g.size == size).collect();
            let (left, right) = own.iter().flat_map(|g| &g.points).fold((f64::INFINITY, 0.0f64), |(a, b), p| (a.min(p.0), b.max(p.0)));
            let ticks: Vec<f64> =
                own.iter().max_by_key(|g| g.points.len()).map_or_else(Vec::new, |g| g.points.iter().map(|p| p.0).collect());
            let above = legend::below(panel, &legends(size))?;
            let mut chart = ChartBuilder::on(&above)
                .margin(px(8))
                .margin_right(px(20))
                .x_label_area_size(px(40))
                .y_label_area_size(px(62))
                .build_cartesian_2d(
                    (left / 1.2..right * 1.2).log_scale().with_key_points(ticks),
                    (low..high).log_scale().with_key_points(decades(low, high)),
                )?;
            canvas::log_axes!(chart, size, "seconds", &|x| canvas::tick(x));
            for g in own {
                chart.draw_series(LineSeries::new(g.points.iter().copied(), line(colour(g.candidate), 18)))?;
                chart.draw_series(g.points.iter().map(|p| Circle::new(*p, px(3), fill(colour(g.candidate), 1.0))))?;
            }
        }
        Ok(())
    })
}

/// Colours of the map: right, rough, wrong, refused, not as declared.
const LEGEND: [(RGBColor, &str); 5] = [
    (RGBColor(196, 230, 206), "right within 0.1 %"),
    (RGBColor(246, 242, 190), "rough, within 10 %"),
    (RGBColor(250, 208, 150), "wrong, and known to be"),
    (RGBColor(205, 222, 242), "refused by name (–)"),
    (RGBColor(226, 70, 60), "not as declared"),
];

/// Method by scenario: right, refused by name, wrong and known to be, or a defect.
pub fn stability(map: &[(Scenario, Vec<Cell>)], folder: &Folder) -> Result<(), WriteError> {
    let columns = map.first().map_or(0, |m| m.1.len()) as u32;
    let (left, top, height) = (196, 170, 24);
    let width = (WIDTH - left - 10) / columns.max(1);
    let entries = LEGEND.map(|(colour, words)| Entry::new(words, Mark::Block(fill(colour, 1.0))));
    let size = (WIDTH, top + map.len() as u32 * height + 12 + legend::height(&entries, WIDTH));
    let [(good, _), (rough, _), (wrong, _), (refused, _), (defect, _)] = LEGEND;
    canvas::save(folder, "stability", size, |area| {
        let centred = |size: u32| text(size).pos(Pos::new(HPos::Center, VPos::Center));
        let pixels = |x: u32, y: u32| (px(x) as i32, px(y) as i32);
        area.draw(&Text::new("Where methods fail: error against a dense solution", pixels(size.0 / 2, 18), centred(16)))?;
        for (row, (scenario, cells)) in map.iter().enumerate() {
            let y = top + row as u32 * height;
            area.draw(&Text::new(scenario.name, pixels(8, y + 7), text(13)))?;
            for (column, cell) in cells.iter().enumerate() {
                let x = left + column as u32 * width;
                if row == 0 {
                    let upwards = text(13).transform(FontTransform::Rotate270).pos(Pos::new(HPos::Left, VPos::Center));
                    area.draw(&Text::new(cell.candidate.label(), pixels(x + width / 2, top - 6), upwards))?;
                }
                let colour = match (cell.as_declared(), cell.word()) {
                    (false, _) => defect,
                    (true, "right") => good,
                    (true, "rough") => rough,
                    (true, "refused") => refused,
                    _ => wrong,
                };
                let words = match &cell.found {
                    Ok(e) if *e < 1e-9 => "exact".into(),
                    Ok(e) if *e < 1e-4 => format!("{e:.0e}"),
                    Ok(e) if *e < 0.01 => format!("{:.1}%", 100.0 * e),
                    Ok(e) if *e < 9.99 => format!("{:.0}%", 100.0 * e),
                    Ok(_) => ">999%".into(),
                    Err(_) => "–".into(),
                };
                area.draw(&Rectangle::new([pixels(x + 1, y + 1), pixels(x + width - 1, y + height - 1)], fill(colour, 1.0)))?;
                area.draw(&Text::new(words, pixels(x + width / 2, y + height / 2), centred(13)))?;
            }
        }
        legend::below(area, &entries)?;
        Ok(())
    })
}
