//! A drawing surface: SVG with sub-pixel coordinates, its PNG, and the look shared by all plots.

use super::pdf::pdf;
use crate::files::{Folder, WriteError};
use crate::formats::Format;
use crate::numerics::elementary::Elementary;
use plotters::coord::Shift;
use plotters::coord::ranged1d::Ranged;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, register_font};
use std::sync::{Arc, OnceLock};

/// plotters writes whole numbers only: everything is drawn this many times larger than shown.
const SCALE: u32 = 10;
/// Pixels of the PNG per unit of the SVG.
const PNG_ZOOM: f32 = 1.875;
/// Width of a plot, units: it is drawn to be printed 170 mm wide, with text of at least 7 pt.
pub(crate) const WIDTH: u32 = 720;
/// Pixels of the PNG per metre of paper.
const PIXELS_PER_M: u32 = (WIDTH as f32 * PNG_ZOOM / 0.17) as u32;

/// Units per inch of paper.
const UNITS_PER_INCH: f32 = WIDTH as f32 / 0.17 * 0.0254;

/// A drawing area of the SVG backend.
pub(crate) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// What drawing may fail with.
pub(crate) type Drawn = Result<(), Box<dyn std::error::Error>>;

/// Writes a title above what is left of an area, and returns that: the gap between both keeps the title off the frame.
///
/// # Errors
/// Those of drawing.
pub(crate) fn captioned<'a>(
    area: &Area<'a>,
    words: impl Into<String>,
    style: TextStyle<'_>,
) -> Result<Area<'a>, Box<dyn std::error::Error>> {
    let middle = area.dim_in_pixel().0 / 2;
    area.draw(&Text::new(words.into(), (middle as i32, px(5) as i32), style.pos(Pos::new(HPos::Center, VPos::Top))))?;
    Ok(area.margin(px(20), 0, 0, 0))
}

/// Colours that the colour-blind can tell apart (after Okabe and Ito).
pub(crate) const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(120, 94, 60),
];
/// Lines of a grid.
pub(crate) const PALE: RGBColor = RGBColor(225, 225, 225);
/// Secondary text and lines.
pub(crate) const GREY: RGBColor = RGBColor(110, 110, 110);

/// A length in the drawing, from units of the shown size.
pub(crate) const fn px(units: u32) -> u32 {
    units * SCALE
}

/// Text of a size.
pub fn text(size: u32) -> TextStyle<'static> {
    ("DejaVu Sans", px(size)).into_font().color(&BLACK)
}

/// A line of a colour and width in tenths of a unit.
pub fn line(colour: RGBColor, tenths: u32) -> ShapeStyle {
    ShapeStyle { color: colour.to_rgba(), filled: false, stroke_width: tenths }
}

/// How a curve is drawn.
#[derive(Clone, Copy)]
pub(crate) struct Stroke {
    pub style: ShapeStyle,
    /// Length of a dash and of what follows it, units; none of a line that is not broken.
    pub dash: Option<(u32, u32)>,
}

impl Stroke {
    pub(crate) fn solid(style: ShapeStyle) -> Self {
        Self { style, dash: None }
    }

    pub(crate) fn dashed(style: ShapeStyle) -> Self {
        Self { style, dash: DASHES[1] }
    }

    /// That of one of many: its colour, and its dashes, so that it is told apart without colour.
    pub(crate) fn of(place: usize, tenths: u32) -> Self {
        Self { style: line(COLOURS[place % COLOURS.len()], tenths), dash: DASHES[place % DASHES.len()] }
    }

    /// Black, told apart from others by its dashes.
    pub(crate) fn black(number: usize, tenths: u32) -> Self {
        Self { style: line(BLACK, tenths), dash: DASHES[number % DASHES.len()] }
    }

    /// That of an order, the same in every plot.
    pub(crate) fn of_order(order: crate::engine::Order, tenths: u32) -> Self {
        // main orders are often every third or fourth half order: they are to differ
        let twice = (2.0 * order.value()) as usize;
        Self { style: line(of_order(order), tenths), dash: DASHES[(twice + twice / 3) % DASHES.len()] }
    }
}

/// Dashes of curves.
const DASHES: [Option<(u32, u32)>; 3] = [None, Some((9, 4)), Some((3, 3))];

/// Draws a curve.
pub(crate) fn curve<X, Y>(
    chart: &mut ChartContext<'_, SVGBackend<'_>, Cartesian2d<X, Y>>,
    points: impl IntoIterator<Item = (f64, f64)>,
    stroke: Stroke,
) -> Drawn
where
    X: Ranged<ValueType = f64>,
    Y: Ranged<ValueType = f64>,
{
    match stroke.dash {
        None => chart.draw_series(LineSeries::new(points, stroke.style))?,
        Some((dash, gap)) => {
            chart.draw_series(DashedLineSeries::new(points.into_iter().collect::<Vec<_>>(), px(dash), px(gap), stroke.style))?
        }
    };
    Ok(())
}

/// A filled shape.
pub(crate) fn fill(colour: RGBColor, opacity: f64) -> ShapeStyle {
    colour.mix(opacity).filled()
}

/// Axes of a chart with logarithmic scales: descriptions of both, and how the numbers below are written; those beside are powers of ten.
macro_rules! log_axes {
    ($chart:expr, $x:expr, $y:expr, $below:expr) => {
        $chart
            .configure_mesh()
            .x_desc($x)
            .y_desc($y)
            .set_all_tick_mark_size($crate::plot::canvas::px(4))
            .axis_desc_style($crate::plot::canvas::text(14))
            .label_style($crate::plot::canvas::text(13))
            .light_line_style(TRANSPARENT)
            .bold_line_style($crate::plot::canvas::line($crate::plot::canvas::PALE, 8))
            .axis_style($crate::plot::canvas::line($crate::plot::canvas::GREY, 10))
            .x_label_formatter($below)
            .y_label_formatter(&|y| format!("{y:.0e}"))
            .draw()?
    };
}
pub(super) use log_axes;

/// Draws `name.svg` and `name.png`, `width` by `height` units.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
pub(crate) fn save(folder: &Folder, name: &str, (width, height): (u32, u32), draw: impl FnOnce(&Area) -> Drawn) -> Result<(), WriteError> {
    let failed = |reason: String| WriteError { path: folder.path().join(format!("{name}.svg")), reason };
    static FONT: OnceLock<bool> = OnceLock::new();
    let registered = *FONT.get_or_init(|| register_font("DejaVu Sans", FontStyle::Normal, dejavu::sans::regular()).is_ok());
    if !registered {
        return Err(failed("the built-in font could not be read".into()));
    }
    let mut svg = String::new();
    {
        let area = SVGBackend::with_string(&mut svg, (px(width), px(height))).into_drawing_area();
        area.fill(&WHITE).map_err(|e| failed(e.to_string()))?;
        draw(&area).map_err(|e| failed(e.to_string()))?;
        area.present().map_err(|e| failed(e.to_string()))?;
    }
    // shown at its size, drawn ten times as fine
    let drawn = format!("width=\"{}\" height=\"{}\"", px(width), px(height));
    let svg = svg.replacen(&drawn, &format!("width=\"{width}\" height=\"{height}\""), 1);
    folder.write(&format!("{name}.svg"), svg.as_bytes())?;
    let tree = parsed(&svg).ok_or_else(|| failed("the picture could not be read".into()))?;
    let png = rendered(&tree).ok_or_else(|| failed("the picture could not be rendered".into()))?;
    folder.write(&format!("{name}.png"), &png)?;
    if Format::Pdf.is_wanted() {
        let page = pdf(&tree, UNITS_PER_INCH).ok_or_else(|| failed("the picture could not be written as PDF".into()))?;
        folder.write(&format!("{name}.pdf"), &page)?;
    }
    Ok(())
}

/// A picture as a page of PDF at so many of its units per inch.
pub(crate) fn written_page(svg: &str, units_per_inch: f32) -> Option<Vec<u8>> {
    pdf(&parsed(svg)?, units_per_inch)
}

/// A picture with its words laid out in the built-in font.
fn parsed(svg: &str) -> Option<resvg::usvg::Tree> {
    static FONTS: OnceLock<Arc<resvg::usvg::fontdb::Database>> = OnceLock::new();
    let fonts = FONTS.get_or_init(|| {
        let mut fonts = resvg::usvg::fontdb::Database::new();
        fonts.load_font_data(dejavu::sans::regular().to_vec());
        Arc::new(fonts)
    });
    let options = resvg::usvg::Options { fontdb: fonts.clone(), ..resvg::usvg::Options::default() };
    resvg::usvg::Tree::from_str(svg, &options).ok()
}

fn rendered(tree: &resvg::usvg::Tree) -> Option<Vec<u8>> {
    let size = tree.size().to_int_size().scale_by(PNG_ZOOM)?;
    let mut pixels = resvg::tiny_skia::Pixmap::new(size.width(), size.height())?;
    pixels.fill(resvg::tiny_skia::Color::WHITE);
    resvg::render(tree, resvg::tiny_skia::Transform::from_scale(PNG_ZOOM, PNG_ZOOM), &mut pixels.as_mut());
    encoded(&pixels)
}

/// A picture without transparent pixels as PNG with its resolution, compressed lightly: it is written in half the time at twice the size.
fn encoded(pixels: &resvg::tiny_skia::Pixmap) -> Option<Vec<u8>> {
    // a plain loop: millions of pixels
    let mut colours = vec![0; pixels.data().len() / 4 * 3];
    for (to, [r, g, b, _]) in colours.as_chunks_mut::<3>().0.iter_mut().zip(pixels.data().as_chunks::<4>().0) {
        *to = [*r, *g, *b];
    }
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, pixels.width(), pixels.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::Fast);
    encoder.set_pixel_dims(Some(png::PixelDimensions { xppu: PIXELS_PER_M, yppu: PIXELS_PER_M, unit: png::Unit::Meter }));
    encoder.write_header().and_then(|mut writer| writer.write_image_data(&colours)).ok()?;
    Some(out)
}

/// A number for an axis: no needless digits.
pub(crate) fn tick(x: &f64) -> String {
    // a zero has no sign
    let rounded = (x * 1e9).round() / 1e9 + 0.0;
    format!("{rounded}")
}

/// A round number a little above `x`: 1, 1.5, 2, 3, 4, 5, 6 or 8 times a power of ten.
pub(crate) fn round_up(x: f64) -> f64 {
    if x.is_nan() || x <= 0.0 {
        return 1.0;
    }
    let unit = 10f64.power(x.decimal_logarithm().floor());
    [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0].iter().map(|f| f * unit).find(|v| *v >= x).unwrap_or(10.0 * unit)
}

/// 1, 2 and 5 times the powers of ten between two values.
pub(crate) fn ticks(left: f64, right: f64) -> Vec<f64> {
    let decades = left.decimal_logarithm().floor() as i32..=right.decimal_logarithm().ceil() as i32;
    decades.flat_map(|d| [1.0, 2.0, 5.0].map(|m| m * 10f64.powi(d))).filter(|t| (left..right).contains(t)).collect()
}

/// Stretches of a curve below `top`, each ending on it where the curve leaves.
pub(crate) fn clipped(points: impl Iterator<Item = (f64, f64)>, top: f64) -> Vec<Vec<(f64, f64)>> {
    let mut pieces: Vec<Vec<(f64, f64)>> = vec![Vec::new()];
    let mut before: Option<(f64, f64)> = None;
    for (x, y) in points {
        if let Some((x0, y0)) = before
            && (y0 > top) != (y > top)
        {
            let crossing = x0 + (x - x0) * (top - y0) / (y - y0);
            if y > top {
                if let Some(piece) = pieces.last_mut() {
                    piece.push((crossing, top));
                }
                pieces.push(Vec::new());
            } else {
                pieces.push(vec![(crossing, top)]);
            }
        }
        if y <= top
            && let Some(piece) = pieces.last_mut()
        {
            piece.push((x, y));
        }
        before = Some((x, y));
    }
    pieces
}

/// Colour of an order, the same in every plot: the palette twice, the second time darker.
pub(crate) fn of_order(order: crate::engine::Order) -> RGBColor {
    let twice = (2.0 * order.value()) as usize;
    let RGBColor(r, g, b) = COLOURS[twice % COLOURS.len()];
    let darker = |c: u8| if twice / COLOURS.len() % 2 == 1 { (u16::from(c) * 11 / 20) as u8 } else { c };
    RGBColor(darker(r), darker(g), darker(b))
}

/// Axes, grid and labels in the common look: chart, names of both axes, how many labels each has.
macro_rules! mesh {
    ($chart:expr, $x:expr, $y:expr, $nx:expr, $ny:expr) => {
        $chart
            .configure_mesh()
            .x_desc($x)
            .y_desc($y)
            .x_labels($nx)
            .y_labels($ny)
            .set_all_tick_mark_size($crate::plot::canvas::px(4))
            .axis_desc_style($crate::plot::canvas::text(14))
            .label_style($crate::plot::canvas::text(13))
            .light_line_style(TRANSPARENT)
            .bold_line_style($crate::plot::canvas::line($crate::plot::canvas::PALE, 8))
            .axis_style($crate::plot::canvas::line($crate::plot::canvas::GREY, 10))
            .x_label_formatter(&|x| $crate::plot::canvas::tick(x))
            .y_label_formatter(&|y| $crate::plot::canvas::tick(y))
            .draw()?
    };
}
pub(super) use mesh;

/// Letters of a title in a line.
const LETTERS: usize = 74;

fn lines(title: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in title.split(' ') {
        match lines.last_mut() {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) if line.chars().count() + 1 + word.chars().count() <= LETTERS => *line += &format!(" {word}"),
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Height of a title of the whole drawing, units.
pub(crate) fn title_height(title: &str) -> u32 {
    10 + 26 * lines(title).len() as u32
}

/// The area below a title, which takes as many lines as it needs.
pub(crate) fn titled<'a>(area: &Area<'a>, title: &str) -> Result<Area<'a>, Box<dyn std::error::Error>> {
    let mut rest = area.margin(px(6), 0, 0, 0);
    for line in lines(title) {
        rest = rest.titled(&line, text(17))?;
    }
    Ok(rest)
}
