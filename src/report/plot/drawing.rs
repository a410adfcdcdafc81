//! A dimensioned drawing of piston pin, connecting rod and crank throw, all at one scale.

use super::canvas::{self, Area, Drawn, GREY, line, px, text};
use crate::files::{Folder, WriteError};
use crate::input::SizingStudy;
use crate::sizing::{Sized, bodies};
use crate::units::M_PER_MM;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

const WIDTH: u32 = 1080;
const HEIGHT: u32 = 720;
/// Room for dimensions round a view, units of the drawing.
const MARGIN: f64 = 60.0;
const TITLE: f64 = 46.0;
const BETWEEN: f64 = 120.0;

/// A view: millimetres about an origin that lies at a place of the drawing.
struct View<'a, 'b> {
    area: &'a Area<'b>,
    origin: (f64, f64),
    /// Units of the drawing per mm.
    scale: f64,
}

impl View<'_, '_> {
    fn at(&self, (x, y): (f64, f64)) -> (i32, i32) {
        let to = |v: f64| (v * f64::from(px(1))).round() as i32;
        (to(self.origin.0 + x * self.scale), to(self.origin.1 - y * self.scale))
    }

    fn outline(&self, points: &[(f64, f64)]) -> Drawn {
        let all = points.iter().chain(points.first()).map(|p| self.at(*p)).collect::<Vec<_>>();
        Ok(self.area.draw(&PathElement::new(all, line(BLACK, 14)))?)
    }

    fn rectangle(&self, (x0, y0): (f64, f64), (x1, y1): (f64, f64)) -> Drawn {
        self.outline(&[(x0, y0), (x1, y0), (x1, y1), (x0, y1)])
    }

    fn circle(&self, centre: (f64, f64), diameter: f64) -> Drawn {
        let radius = (0.5 * diameter * self.scale * f64::from(px(1))).round() as u32;
        Ok(self.area.draw(&Circle::new(self.at(centre), radius, line(BLACK, 14)))?)
    }

    fn axis(&self, from: (f64, f64), to: (f64, f64)) -> Drawn {
        const DASHES: usize = 14;
        for i in 0..DASHES {
            let point = |k: f64| (from.0 + (to.0 - from.0) * k, from.1 + (to.1 - from.1) * k);
            let (a, b) = (i as f64 / DASHES as f64, (i as f64 + 0.6) / DASHES as f64);
            self.area.draw(&PathElement::new(vec![self.at(point(a)), self.at(point(b))], line(GREY, 6)))?;
        }
        Ok(())
    }

    /// A dimension between two points, drawn `away` units of the drawing to the side (below, or to the left where it stands upright).
    fn dimension(&self, from: (f64, f64), to: (f64, f64), away: f64, label: &str) -> Drawn {
        let upright = (from.0 - to.0).abs() < (from.1 - to.1).abs();
        let shift = away / self.scale;
        let moved = |p: (f64, f64)| if upright { (from.0.min(to.0) - shift, p.1) } else { (p.0, from.1.min(to.1) - shift) };
        let (a, b) = (moved(from), moved(to));
        let thin = line(GREY, 7);
        for (point, end) in [(from, a), (to, b)] {
            self.area.draw(&PathElement::new(vec![self.at(point), self.at(end)], thin))?;
        }
        self.area.draw(&PathElement::new(vec![self.at(a), self.at(b)], thin))?;
        for (end, other) in [(a, b), (b, a)] {
            let ((x, y), (ox, oy)) = (self.at(end), self.at(other));
            let (size, half) = (px(7) as i32, px(2) as i32);
            let arrow = if upright {
                let s = size * (oy - y).signum();
                vec![(x, y), (x - half, y + s), (x + half, y + s)]
            } else {
                let s = size * (ox - x).signum();
                vec![(x, y), (x + s, y - half), (x + s, y + half)]
            };
            self.area.draw(&Polygon::new(arrow, GREY.filled()))?;
        }
        let ((ax, ay), (bx, by)) = (self.at(a), self.at(b));
        let middle = (i32::midpoint(ax, bx), i32::midpoint(ay, by));
        let (place, anchor) = if upright {
            ((middle.0 - px(4) as i32, middle.1), Pos::new(HPos::Right, VPos::Center))
        } else {
            ((middle.0, middle.1 + px(3) as i32), Pos::new(HPos::Center, VPos::Top))
        };
        // other lines do not cross the number
        let (width, height) = ((px(8) * label.chars().count() as u32) as i32, px(14) as i32);
        let corner = if upright { (place.0 - width, place.1 - height / 2) } else { (place.0 - width / 2, place.1) };
        self.area.draw(&Rectangle::new([corner, (corner.0 + width, corner.1 + height)], WHITE.filled()))?;
        Ok(self.area.draw(&Text::new(label.to_owned(), place, text(13).pos(anchor)))?)
    }

    fn caption(&self, at: (f64, f64), label: &str) -> Drawn {
        let (x, y) = self.at(at);
        Ok(self.area.draw(&Text::new(label.to_owned(), (x, y - px(10) as i32), text(13).pos(Pos::new(HPos::Center, VPos::Bottom))))?)
    }
}

fn mm(x: f64) -> f64 {
    x / M_PER_MM
}

fn label(sign: &str, x: f64) -> String {
    format!("{sign}{:.2}", x)
}

/// Dimensions in mm, as they are drawn.
struct Shape {
    before: f64,
    after: f64,
    radius: f64,
    rod: f64,
    bore: f64,
    pin: f64,
    t: f64,
    eyes: [(f64, f64); 2],
    crankpin: (f64, f64),
    journal: f64,
    web: (f64, f64),
    height: f64,
}

impl Shape {
    fn of(study: &SizingStudy, sized: &Sized) -> Self {
        let (spec, s) = (&study.specification, &sized.last().sizes);
        Self {
            before: mm(spec.bearings.before),
            after: mm(spec.bearings.after),
            radius: mm(spec.crank_radius()),
            rod: mm(spec.rod_length),
            bore: mm(spec.bore),
            pin: mm(s.pin_diameter),
            t: mm(s.shank_thickness),
            eyes: [(mm(s.big_eye_bore), mm(s.big_eye_diameter)), (mm(s.small_eye_bore), mm(s.small_eye_diameter))],
            crankpin: (mm(s.crankpin_diameter), mm(s.crankpin_length)),
            journal: mm(s.journal_diameter),
            web: (mm(s.web_thickness), mm(s.web_breadth)),
            height: mm(bodies::web_height(s, spec.crank_radius())),
        }
    }

    /// Heights of both rows and widths of what stands in them.
    fn extents(&self) -> ([f64; 2], [f64; 2]) {
        let eyes = self.eyes[0].1.max(self.eyes[1].1);
        let first = self.before + self.after + self.web.1;
        let second = self.rod + 0.5 * (self.eyes[0].1 + self.eyes[1].1) + 8.0 * self.t + self.bore;
        ([first, second], [self.height.max(self.journal), eyes.max(10.0 * self.t).max(self.pin)])
    }
}

fn throw_side(view: &View, s: &Shape) -> Drawn {
    let ((d, l), (t, w)) = (s.crankpin, s.web);
    let (inner, outer) = (0.5 * l, 0.5 * l + t);
    let (low, high) = (-0.5 * w, s.radius + 0.5 * w);
    for (from, to) in [(-s.before, -outer), (outer, s.after)] {
        view.rectangle((from, -0.5 * s.journal), (to, 0.5 * s.journal))?;
    }
    view.rectangle((-outer, low), (-inner, high))?;
    view.rectangle((inner, low), (outer, high))?;
    view.rectangle((-inner, s.radius - 0.5 * d), (inner, s.radius + 0.5 * d))?;
    view.axis((-s.before - 4.0, 0.0), (s.after + 4.0, 0.0))?;
    view.axis((-outer - 4.0, s.radius), (outer + 4.0, s.radius))?;
    view.dimension((-s.before, -0.5 * s.journal), (-s.before, 0.5 * s.journal), 14.0, &label("⌀", s.journal))?;
    view.dimension((-outer, s.radius - 0.5 * d), (-outer, s.radius + 0.5 * d), 26.0, &label("⌀", d))?;
    view.dimension((-s.before, low), (0.0, low), 46.0, &label("", s.before))?;
    view.dimension((0.0, low), (s.after, low), 46.0, &label("", s.after))?;
    view.dimension((inner, low), (outer, low), 28.0, &label("", t))?;
    view.dimension((-inner, low), (inner, low), 10.0, &label("", l))?;
    view.caption((0.0, high), "throw")
}

fn throw_end(view: &View, s: &Shape) -> Drawn {
    let w = s.web.1;
    let (low, high) = (-0.5 * w, s.radius + 0.5 * w);
    view.rectangle((-0.5 * w, low), (0.5 * w, high))?;
    view.circle((0.0, 0.0), s.journal)?;
    view.circle((0.0, s.radius), s.crankpin.0)?;
    view.dimension((-0.5 * w, low), (0.5 * w, low), 10.0, &label("", w))?;
    view.dimension((-0.5 * w, 0.0), (-0.5 * w, s.radius), 14.0, &label("", s.radius))?;
    view.caption((0.0, high), "web")
}

fn rod(view: &View, s: &Shape) -> Drawn {
    let [(big_in, big), (small_in, small)] = s.eyes;
    let half = 2.5 * s.t;
    let reach = |d: f64, y: f64| (0.25 * d * d - y * y).max(0.0).sqrt();
    for (centre, diameters) in [(0.0, [big_in, big]), (s.rod, [small_in, small])] {
        diameters.iter().try_for_each(|d| view.circle((centre, 0.0), *d))?;
    }
    for y in [-half, half, -1.5 * s.t, 1.5 * s.t] {
        let (from, to) = (reach(big, y), s.rod - reach(small, y));
        if to > from {
            view.outline(&[(from, y), (to, y)])?;
        }
    }
    view.axis((-0.5 * big - 4.0, 0.0), (s.rod + 0.5 * small + 4.0, 0.0))?;
    let low = -0.5 * big.max(small);
    view.dimension((0.0, low), (s.rod, low), 10.0, &label("", s.rod))?;
    view.dimension((-0.5 * big, low), (0.5 * big, low), 28.0, &label("⌀", big))?;
    view.dimension((-0.5 * big_in, low), (0.5 * big_in, low), 46.0, &label("⌀", big_in))?;
    view.dimension((s.rod - 0.5 * small, low), (s.rod + 0.5 * small, low), 28.0, &label("⌀", small))?;
    view.dimension((s.rod - 0.5 * small_in, low), (s.rod + 0.5 * small_in, low), 46.0, &label("⌀", small_in))?;
    view.caption((0.5 * s.rod, 0.5 * big.max(small)), "rod")
}

fn section(view: &View, s: &Shape) -> Drawn {
    let t = s.t;
    let (b, h, w) = (2.0 * t, 2.5 * t, 0.5 * t);
    let half = [(-b, -h), (b, -h), (b, -1.5 * t), (w, -1.5 * t), (w, 1.5 * t), (b, 1.5 * t), (b, h), (-b, h), (-b, 1.5 * t), (-w, 1.5 * t)];
    let points: Vec<(f64, f64)> = half.into_iter().chain([(-w, -1.5 * t), (-b, -1.5 * t)]).collect();
    view.outline(&points)?;
    view.dimension((-w, -h), (w, -h), 30.0, &label("", t))?;
    view.dimension((-b, -h), (b, -h), 10.0, &label("", 4.0 * t))?;
    view.dimension((-b, -h), (-b, h), 12.0, &label("", 5.0 * t))?;
    view.caption((0.0, h), "shank, 2:1")
}

fn pin(view: &View, s: &Shape) -> Drawn {
    let half = 0.5 * s.bore;
    view.rectangle((-half, -0.5 * s.pin), (half, 0.5 * s.pin))?;
    view.axis((-half - 4.0, 0.0), (half + 4.0, 0.0))?;
    view.dimension((-half, -0.5 * s.pin), (half, -0.5 * s.pin), 10.0, &label("", s.bore))?;
    view.dimension((-half, -0.5 * s.pin), (-half, 0.5 * s.pin), 12.0, &label("⌀", s.pin))?;
    view.caption((0.0, 0.5 * s.pin), "piston pin")
}

/// `drawing.svg` and `.png`.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
pub(crate) fn drawing(study: &SizingStudy, sized: &Sized, folder: &Folder) -> Result<(), WriteError> {
    let s = Shape::of(study, sized);
    let (widths, heights) = s.extents();
    let (wide, high) = (f64::from(WIDTH), f64::from(HEIGHT));
    let across = [(wide - 3.0 * MARGIN - BETWEEN) / widths[0], (wide - 2.0 * MARGIN - 2.0 * BETWEEN) / widths[1]];
    let scale = across[0].min(across[1]).min((high - TITLE - 4.0 * MARGIN) / (heights[0] + heights[1]));
    canvas::save(folder, "drawing", (WIDTH, HEIGHT), |area| {
        let title = format!("{}: dimensions in mm", study.title);
        area.draw(&Text::new(title, ((px(WIDTH) / 2) as i32, px(10) as i32), text(17).pos(Pos::new(HPos::Center, VPos::Top))))?;
        let view = |x: f64, y: f64| View { area, origin: (x, y), scale };
        // first row: the webs reach half a breadth below the axis
        let axis = TITLE + 0.5 * MARGIN + (s.radius + 0.5 * s.web.1) * scale;
        let free = wide - 2.0 * MARGIN - widths[0] * scale - BETWEEN;
        let first = MARGIN + 0.5 * free + s.before * scale;
        throw_side(&view(first, axis), &s)?;
        throw_end(&view(first + s.after * scale + BETWEEN + 0.5 * s.web.1 * scale, axis), &s)?;
        let row = TITLE + 2.5 * MARGIN + (heights[0] + 0.5 * heights[1]) * scale;
        let free = (wide - 2.0 * MARGIN - widths[1] * scale - 2.0 * BETWEEN).max(0.0);
        let left = MARGIN + 0.5 * free + 0.5 * s.eyes[0].1 * scale;
        rod(&view(left, row), &s)?;
        let x = left + (s.rod + 0.5 * s.eyes[1].1) * scale + BETWEEN + 4.0 * s.t * scale;
        section(&View { scale: 2.0 * scale, ..view(x, row) }, &s)?;
        pin(&view(x + (4.0 * s.t + 0.5 * s.bore) * scale + BETWEEN, row), &s)
    })
}
