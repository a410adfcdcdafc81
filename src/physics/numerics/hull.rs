//! Convex hull of points in a plane.

use crate::numerics::elementary::Elementary;
use crate::numerics::projections::{LANES, along, extents, range};
use hartog_kernel::kernel;

/// Directions in which extreme points are looked for, round half a turn: with their opposites a polygon of twice as many sides.
const DIRECTIONS: usize = 8;
/// The polygon is that of every so many points.
const EVERY: usize = 3;
/// Corners of the polygon closer than this share of the spread are one.
const NEAR: f32 = 1e-3;
/// A point is inside the polygon where the parallelograms of all its sides and the point are larger than this, of a spread of 1: several times their rounding.
const INSIDE: f32 = 2e-6;

/// Indices of the corners of the convex hull, counter-clockwise; points on its sides and repeated ones are left out. One index where all points are one, two where they
/// lie on a line. Andrew's monotone chain \[Andrew 1979\], of the points that the polygon of the extremes in sixteen directions does not hold
/// \[Akl & Toussaint 1978\].
pub fn hull(x: &[f64], y: &[f64]) -> Vec<usize> {
    let mut few_left: Vec<(u64, usize)> = Vec::with_capacity(128);
    let (u, v) = (of_spread(x), of_spread(y));
    // any points will do for the polygon: neighbours say much the same
    let few = |v: &[f32]| v.chunks(EVERY).map(|c| c[0]).collect::<Vec<f32>>();
    outside(&u, &v, &polygon(&few(&u), &few(&v)), |i| few_left.push((ascending(x[i]), i)));
    few_left.sort_unstable();
    let mut order: Vec<Point> = few_left.into_iter().map(|(_, i)| (x[i], y[i], i)).collect();
    for column in order.chunk_by_mut(|a, b| a.0 == b.0) {
        column.sort_unstable_by(|a, b| a.1.total_cmp(&b.1).then(a.2.cmp(&b.2)));
    }
    order.dedup_by(|a, b| a.0 == b.0 && a.1 == b.1);
    if order.len() < 3 {
        return order.into_iter().map(|p| p.2).collect();
    }
    let mut corners: Vec<Point> = Vec::with_capacity(order.len() + 1);
    half(order.iter(), &mut corners);
    half(order.iter().rev(), &mut corners);
    corners.into_iter().map(|p| p.2).collect()
}

/// A point with its index.
type Point = (f64, f64, usize);

/// Adds the corners of one half of the hull, but for the last: it is the first of the other half.
fn half<'a>(points: impl Iterator<Item = &'a Point>, corners: &mut Vec<Point>) {
    let turns_left = |a: &Point, b: &Point, c: &Point| (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0) > 0.0;
    let from = corners.len();
    for p in points {
        while corners.len() >= from + 2 && !turns_left(&corners[corners.len() - 2], &corners[corners.len() - 1], p) {
            corners.pop();
        }
        corners.push(*p);
    }
    corners.pop();
}

/// A whole number that grows with a number.
fn ascending(x: f64) -> u64 {
    // zero has one sign
    let bits = (x + 0.0).to_bits();
    if bits >> 63 == 1 { !bits } else { bits | 1 << 63 }
}

/// Shares of the spread, from the smallest number: with few digits, which are enough to leave out points that are well inside.
#[kernel]
fn of_spread(numbers: &[f64]) -> Vec<f32> {
    let (least, most) = range(numbers);
    let scale = if most - least > f64::MIN_POSITIVE { 1.0 / (most - least) } else { 1.0 };
    numbers.iter().map(|v| ((v - least) * scale) as f32).collect()
}

/// Points that are farthest along directions even round half a turn, counter-clockwise.
fn polygon(x: &[f32], y: &[f32]) -> Vec<[f32; 2]> {
    let directions: [[f32; 2]; DIRECTIONS] = std::array::from_fn(|d| {
        let (sine, cosine) = (std::f64::consts::PI * d as f64 / DIRECTIONS as f64).sine_cosine();
        [cosine as f32, sine as f32]
    });
    let most = extents(x, y, &directions);
    let mut corners: Vec<[f32; 2]> = Vec::with_capacity(2 * DIRECTIONS);
    let highs = directions.iter().zip(&most).map(|(d, m)| (d, m.1));
    let lows = directions.iter().zip(&most).map(|(d, m)| (d, m.0));
    let apart = |a: &[f32; 2], b: &[f32; 2]| (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) > NEAR;
    for (direction, wanted) in highs.chain(lows) {
        let i = first(x, y, *direction, wanted);
        let corner = [x[i], y[i]];
        if corners.last().is_none_or(|last| apart(last, &corner)) {
            corners.push(corner);
        }
    }
    while corners.len() > 1 && !apart(&corners[0], &corners[corners.len() - 1]) {
        corners.pop();
    }
    corners
}

/// The first point whose part along a direction is this.
#[kernel]
fn first(x: &[f32], y: &[f32], d: [f32; 2], wanted: f32) -> usize {
    let (xs, ys) = (x.as_chunks::<LANES>().0, y.as_chunks::<LANES>().0);
    let holds = |(x, y): (&[f32; LANES], &[f32; LANES])| {
        let mut found = false;
        for l in 0..LANES {
            found |= along(d, x[l], y[l]) == wanted;
        }
        found
    };
    let from = LANES * xs.iter().zip(ys).position(holds).unwrap_or(xs.len());
    (from..x.len()).find(|i| along(d, x[*i], y[*i]) == wanted).unwrap_or(0)
}

/// Takes the points that are not well inside a convex polygon; a polygon of one corner or of two has no inside.
#[kernel]
fn outside(x: &[f32], y: &[f32], polygon: &[[f32; 2]], mut take: impl FnMut(usize)) {
    // corner and step to the next
    let mut sides = [([0.0f32; 2], [0.0f32; 2]); 2 * DIRECTIONS];
    let count = if polygon.len() < 3 { 0 } else { polygon.len() };
    for (i, side) in sides[..count].iter_mut().enumerate() {
        let (a, b) = (polygon[i], polygon[(i + 1) % count]);
        *side = (a, [b[0] - a[0], b[1] - a[1]]);
    }
    let (xs, ys) = (x.as_chunks::<LANES>(), y.as_chunks::<LANES>());
    for (block, (x, y)) in xs.0.iter().zip(ys.0).enumerate() {
        let mut inside = [f32::INFINITY; LANES];
        for (a, step) in &sides[..count] {
            for l in 0..LANES {
                let left = step[0] * (y[l] - a[1]) - step[1] * (x[l] - a[0]);
                inside[l] = if left < inside[l] { left } else { inside[l] };
            }
        }
        for (l, inside) in inside.iter().enumerate() {
            if *inside <= INSIDE || *inside == f32::INFINITY {
                take(block * LANES + l);
            }
        }
    }
    (xs.0.len() * LANES..x.len()).for_each(take);
}
