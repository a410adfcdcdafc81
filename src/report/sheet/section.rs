//! The section of a damper, to scale, with its dimensions: what lies above its axis.

use super::canvas::Canvas;
use crate::absorber::{Medium, SLEEVE};
use crate::analysis::Sheet;
use crate::text::order_sheets::mm;

/// A rectangle of the section: from and to along the axis, inner and outer radius, m, and its colour.
struct Body {
    axial: (f64, f64),
    radial: (f64, f64),
    fill: &'static str,
}

const STEEL: &str = "#d5dbe3";
const RUBBER: &str = "#4a4a4a";
const OIL: &str = "#f2d9a0";
const HOUSING: &str = "#b9c4d3";
const SPRING: &str = "#8fa3b8";

/// What is drawn of a shape.
fn bodies(sheet: &Sheet) -> Vec<Body> {
    let p = &sheet.parts;
    let [inner, outer] = p.ring;
    let (half, ring_half) = (0.5 * p.width, 0.5 * p.ring_width);
    let ring = Body { axial: (-ring_half, ring_half), radial: (inner, outer), fill: STEEL };
    // between hub and ring, as long along the axis as it is
    let inside = |fill: &'static str| {
        let length = 0.5 * p.element_length;
        Body { axial: (-length, length), radial: (0.5 * p.bore, inner), fill }
    };
    match sheet.shape.medium {
        Medium::Oil => {
            let outside = 0.5 * p.outer_diameter;
            let chamber = half - (outside - outer - p.element_length);
            vec![
                Body { axial: (-half, half), radial: (0.5 * p.bore, outside), fill: HOUSING },
                Body { axial: (-chamber, chamber), radial: (inner - p.element_length, outer + p.element_length), fill: OIL },
                ring,
            ]
        }
        Medium::Rubber if sheet.shape.declaration == &SLEEVE => vec![ring, inside(RUBBER)],
        Medium::Rubber => {
            let thickness = (p.width - p.ring_width).max(0.0);
            let faces = if thickness > 1.5 * p.element_length { 2.0 } else { 1.0 };
            let each = thickness / faces;
            let left = if faces > 1.5 { -half + each } else { -half };
            let right = left + p.ring_width;
            let mut list = vec![
                Body { axial: (left, right), radial: (inner, outer), fill: STEEL },
                Body { axial: (right, right + each), radial: (inner, outer), fill: RUBBER },
            ];
            if faces > 1.5 {
                list.push(Body { axial: (-half, left), radial: (inner, outer), fill: RUBBER });
            }
            list
        }
        Medium::Leaves | Medium::Coils => vec![ring, inside(SPRING)],
        Medium::Field => vec![ring],
    }
}

/// Draws it into a box of the page: x, y, width, height, units of the page.
pub(super) fn draw(page: &mut Canvas, sheet: &Sheet, (x, y, width, height): (f64, f64, f64, f64)) {
    let p = &sheet.parts;
    let (outside, clear) = (0.5 * p.outer_diameter, 0.5 * p.bore);
    // the axis below, room for dimensions round it
    let margin = 70.0;
    let scale = ((width - 2.0 * margin) / p.width).min((height - 60.0) / outside);
    let (centre, axis) = (x + 0.5 * width, y + height - 22.0);
    let at = |axial: f64, radius: f64| (centre + scale * axial, axis - scale * radius);
    for body in bodies(sheet) {
        let (left, top) = at(body.axial.0, body.radial.1);
        let (right, bottom) = at(body.axial.1, body.radial.0);
        page.rectangle((left, top, right - left, bottom - top), body.fill);
    }
    let (start, end) = (at(-0.5 * p.width, 0.0), at(0.5 * p.width, 0.0));
    page.line((start.0 - 40.0, start.1), (end.0 + 40.0, end.1), "6 3 1.5 3");
    // width above, diameters at the sides
    let (left, right) = (at(-0.5 * p.width, outside), at(0.5 * p.width, outside));
    page.dimension((left.0, left.1 - 12.0), (right.0, right.1 - 12.0), &mm(p.width));
    let of_radius = |page: &mut Canvas, radius: f64, shift: f64, words: &str| {
        let top = at(0.5 * p.width, radius);
        let foot = at(0.5 * p.width, 0.0);
        page.line((top.0, top.1), (foot.0 + shift, top.1), "");
        page.dimension((foot.0 + shift, foot.1), (foot.0 + shift, top.1), words);
    };
    of_radius(page, clear, 16.0, &format!("⌀ {}", mm(2.0 * clear)));
    of_radius(page, outside, 44.0, &format!("⌀ {}", mm(p.outer_diameter)));
    let ring = at(-0.5 * p.width, p.ring[0]);
    let foot = at(-0.5 * p.width, 0.0);
    page.line(ring, (foot.0 - 16.0, ring.1), "");
    page.dimension((foot.0 - 16.0, foot.1), (foot.0 - 16.0, ring.1), &format!("⌀ {}", mm(2.0 * p.ring[0])));
    page.text((x, y + height), 9.0, &format!("Section above the axis, scale 1 : {:.2}", 96.0 / 0.0254 / scale), false);
}
