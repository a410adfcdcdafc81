//! Names of points, beside them where they cover neither curves nor each other.

use super::canvas::{Area, Drawn, GREY, line, px, text};
use plotters::prelude::*;

/// A place in the drawing.
type Pixel = (i32, i32);

/// A box: left, top, right, bottom.
#[derive(Clone, Copy)]
struct Box4([i32; 4]);

impl Box4 {
    fn holds(self, p: Pixel) -> bool {
        let Self([left, top, right, bottom]) = self;
        (left..=right).contains(&p.0) && (top..=bottom).contains(&p.1)
    }

    fn meets(self, other: Self) -> bool {
        let (Self(a), Self(b)) = (self, other);
        a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
    }

    fn inside(self, other: Self) -> bool {
        other.holds((self.0[0], self.0[1])) && other.holds((self.0[2], self.0[3]))
    }
}

/// Height of a label and width of a letter, units.
const HEIGHT: i32 = 13;
const LETTER: f64 = 6.6;
/// Distances of a label from its point that are tried, units.
const AWAY: [i32; 6] = [8, 14, 24, 38, 56, 80];

/// Points on a curve, so close that no label lies between two of them.
pub(crate) fn along(corners: &[Pixel]) -> impl Iterator<Item = Pixel> + '_ {
    corners.windows(2).flat_map(|w| {
        let steps = ((w[1].0 - w[0].0).abs().max((w[1].1 - w[0].1).abs()) / px(4) as i32).max(1);
        (0..=steps).map(move |i| (w[0].0 + (w[1].0 - w[0].0) * i / steps, w[0].1 + (w[1].1 - w[0].1) * i / steps))
    })
}

/// Draws names beside points (`area`: the whole drawing); `curves`: what they had better not cover; `frame`: what they stay in, left, top, right and bottom.
pub(crate) fn draw(area: &Area, named: &[(String, Pixel)], curves: &[Pixel], frame: [i32; 4]) -> Drawn {
    let unit = px(1) as i32;
    let mut taken: Vec<Box4> = Vec::new();
    for (name, at) in named {
        let (width, height) = ((LETTER * name.chars().count() as f64) as i32 * unit, HEIGHT * unit);
        let around = |away: i32| {
            let d = away * unit;
            // to the right, to the left, above, below, then between
            [(d, -height / 2), (-d - width, -height / 2), (-width / 2, -d - height), (-width / 2, d)]
                .into_iter()
                .chain([(d, -d - height), (d, d), (-d - width, -d - height), (-d - width, d)])
                .map(move |(dx, dy)| (away, (dx, dy)))
        };
        let place = |(dx, dy): Pixel| Box4([at.0 + dx, at.1 + dy, at.0 + dx + width, at.1 + dy + height]);
        let cost = |&(away, by): &(i32, Pixel)| {
            let own = place(by);
            let covered = curves.iter().filter(|p| own.holds(**p)).count() as i32;
            let names = taken.iter().filter(|t| own.meets(**t)).count() as i32;
            let marks = named.iter().filter(|n| n.1 != *at && own.holds(n.1)).count() as i32;
            8 * covered + 200 * names + 100 * marks + away + if own.inside(Box4(frame)) { 0 } else { 1000 }
        };
        let Some((away, by)) = AWAY.into_iter().flat_map(around).min_by_key(cost) else { continue };
        let own = place(by);
        taken.push(own);
        if away > AWAY[1] {
            // far from its point: a thin line leads there
            let near = (at.0.clamp(own.0[0], own.0[2]), at.1.clamp(own.0[1], own.0[3]));
            area.draw(&PathElement::new(vec![*at, near], line(GREY, 6)))?;
        }
        area.draw(&Text::new(name.clone(), (own.0[0], own.0[1]), text(13)))?;
    }
    Ok(())
}
