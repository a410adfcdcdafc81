//! Convex hull of points in a plane.

use crate::numerics::elementary::Elementary;
use multiversion::multiversion;

/// Directions in which extreme points are looked for, round half a turn: with their opposites a polygon of twice as many sides.
const DIRECTIONS: usize = 8;
/// The polygon is that of every so many points.
const EVERY: usize = 3;
/// Points that are looked at together.
const LANES: usize = 16;

/// Indices of the corners of the convex hull, counter-clockwise; points on its sides and repeated ones are left out. One index where all points are one, two where they
/// lie on a line. Andrew's monotone chain \[Andrew 1979\], of the points that the polygon of the extremes in sixteen directions does not hold
/// \[Akl & Toussaint 1978\].
pub fn hull(x: &[f64], y: &[f64]) -> Vec<usize> {
    let mut few_left: Vec<(u64, usize)> = Vec::with_capacity(128);
    // any points will do for the polygon: neighbours say much the same
    let few = |v: &[f64]| v.iter().step_by(EVERY).copied().collect::<Vec<f64>>();
    outside(x, y, &polygon(&few(x), &few(y)), |i| few_left.push((ascending(x[i]), i)));
    few_left.sort_unstable();
    let mut order: Vec<(f64, f64, usize)> = few_left.into_iter().map(|(_, i)| (x[i], y[i], i)).collect();
    for column in order.chunk_by_mut(|a, b| a.0 == b.0) {
        column.sort_unstable_by(|a, b| a.1.total_cmp(&b.1).then(a.2.cmp(&b.2)));
    }
    order.dedup_by(|a, b| a.0 == b.0 && a.1 == b.1);
    if order.len() < 3 {
        return order.into_iter().map(|p| p.2).collect();
    }
    let turns_left =
        |a: &(f64, f64, usize), b: &(f64, f64, usize), c: &(f64, f64, usize)| (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0) > 0.0;
    let mut corners: Vec<(f64, f64, usize)> = Vec::with_capacity(order.len() + 1);
    let mut half = |points: &mut dyn Iterator<Item = &(f64, f64, usize)>| {
        let from = corners.len();
        for p in points {
            while corners.len() >= from + 2 && !turns_left(&corners[corners.len() - 2], &corners[corners.len() - 1], p) {
                corners.pop();
            }
            corners.push(*p);
        }
        // it is the first of the other half
        corners.pop();
    };
    half(&mut order.iter());
    half(&mut order.iter().rev());
    corners.into_iter().map(|p| p.2).collect()
}

/// A whole number that grows with a number.
fn ascending(x: f64) -> u64 {
    // zero has one sign
    let bits = (x + 0.0).to_bits();
    if bits >> 63 == 1 { !bits } else { bits | 1 << 63 }
}

/// Points that are farthest along the directions, which are even in units of the spread, counter-clockwise.
fn polygon(x: &[f64], y: &[f64]) -> Vec<[f64; 2]> {
    let spread = |v: &[f64]| {
        let [(low, high)] = ranges(v, v, &[[1.0, 0.0]]);
        if high > low { 1.0 / (high - low) } else { 1.0 }
    };
    let (sx, sy) = (spread(x), spread(y));
    let directions: [[f64; 2]; DIRECTIONS] = std::array::from_fn(|d| {
        let (sine, cosine) = (std::f64::consts::PI * d as f64 / DIRECTIONS as f64).sine_cosine();
        [cosine * sx, sine * sy]
    });
    let most = ranges(x, y, &directions);
    let mut corners: Vec<[f64; 2]> = Vec::with_capacity(2 * DIRECTIONS);
    let highs = directions.iter().zip(&most).map(|(d, m)| (d, m.1));
    let lows = directions.iter().zip(&most).map(|(d, m)| (d, m.0));
    for (direction, wanted) in highs.chain(lows) {
        let i = first(x, y, *direction, wanted);
        if corners.last() != Some(&[x[i], y[i]]) {
            corners.push([x[i], y[i]]);
        }
    }
    corners
}

fn along([a, b]: [f64; 2], x: f64, y: f64) -> f64 {
    a * x + b * y
}

/// Smallest and largest part of the points along each direction.
#[multiversion(targets("x86_64+avx512f", "x86_64+avx2", "x86_64+avx", "aarch64+neon"))]
fn ranges<const N: usize>(x: &[f64], y: &[f64], directions: &[[f64; 2]; N]) -> [(f64, f64); N] {
    let (xs, ys) = (x.as_chunks::<LANES>(), y.as_chunks::<LANES>());
    let mut all = [(f64::INFINITY, f64::NEG_INFINITY); N];
    for (range, d) in all.iter_mut().zip(directions) {
        let (mut low, mut high) = ([f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]);
        for (x, y) in xs.0.iter().zip(ys.0) {
            for l in 0..LANES {
                let v = along(*d, x[l], y[l]);
                low[l] = if v < low[l] { v } else { low[l] };
                high[l] = if v > high[l] { v } else { high[l] };
            }
        }
        for l in 0..LANES {
            range.0 = if low[l] < range.0 { low[l] } else { range.0 };
            range.1 = if high[l] > range.1 { high[l] } else { range.1 };
        }
        for (x, y) in xs.1.iter().zip(ys.1) {
            let v = along(*d, *x, *y);
            range.0 = if v < range.0 { v } else { range.0 };
            range.1 = if v > range.1 { v } else { range.1 };
        }
    }
    all
}

/// The first point whose part along a direction is this.
#[multiversion(targets("x86_64+avx512f", "x86_64+avx2", "x86_64+avx", "aarch64+neon"))]
fn first(x: &[f64], y: &[f64], d: [f64; 2], wanted: f64) -> usize {
    let (xs, ys) = (x.as_chunks::<LANES>().0, y.as_chunks::<LANES>().0);
    let holds = |(x, y): (&[f64; LANES], &[f64; LANES])| {
        let mut found = false;
        for l in 0..LANES {
            found |= along(d, x[l], y[l]) == wanted;
        }
        found
    };
    let from = LANES * xs.iter().zip(ys).position(holds).unwrap_or(xs.len());
    (from..x.len()).find(|i| along(d, x[*i], y[*i]) == wanted).unwrap_or(0)
}

/// Takes the points that are not strictly inside a convex polygon; a polygon of one corner or of two has no inside.
#[multiversion(targets("x86_64+avx512f", "x86_64+avx2", "x86_64+avx", "aarch64+neon"))]
fn outside(x: &[f64], y: &[f64], polygon: &[[f64; 2]], mut take: impl FnMut(usize)) {
    // corner and step to the next
    let mut sides = [([0.0; 2], [0.0; 2]); 2 * DIRECTIONS];
    let mut count = 0;
    for (i, a) in polygon.iter().enumerate() {
        let b = polygon[(i + 1) % polygon.len()];
        if *a != b {
            sides[count] = (*a, [b[0] - a[0], b[1] - a[1]]);
            count += 1;
        }
    }
    let (xs, ys) = (x.as_chunks::<LANES>(), y.as_chunks::<LANES>());
    for (block, (x, y)) in xs.0.iter().zip(ys.0).enumerate() {
        let mut inside = [f64::INFINITY; LANES];
        for (a, step) in &sides[..count] {
            for l in 0..LANES {
                let left = step[0] * (y[l] - a[1]) - step[1] * (x[l] - a[0]);
                inside[l] = if left < inside[l] { left } else { inside[l] };
            }
        }
        for (l, inside) in inside.iter().enumerate() {
            if *inside <= 0.0 || *inside == f64::INFINITY {
                take(block * LANES + l);
            }
        }
    }
    (xs.0.len() * LANES..x.len()).for_each(take);
}
