//! Convex hull of points in a plane.

use multiversion::multiversion;

/// Indices of the corners of the convex hull, counter-clockwise; points on its sides and repeated ones are left out. One index where all points are one, two where they
/// lie on a line. Andrew's monotone chain \[Andrew 1979\], of the points that the octagon of the extremes in eight directions does not hold
/// \[Akl & Toussaint 1978\].
pub fn hull(x: &[f64], y: &[f64]) -> Vec<usize> {
    let mut order = outside(x, y, &octagon(x, y));
    order.sort_unstable_by(|a, b| x[*a].total_cmp(&x[*b]).then(y[*a].total_cmp(&y[*b])));
    order.dedup_by(|a, b| x[*a] == x[*b] && y[*a] == y[*b]);
    if order.len() < 3 {
        return order;
    }
    let turns_left = |a: usize, b: usize, c: usize| (x[b] - x[a]) * (y[c] - y[a]) - (y[b] - y[a]) * (x[c] - x[a]) > 0.0;
    let half = |points: &mut dyn Iterator<Item = usize>| {
        let mut chain: Vec<usize> = Vec::new();
        for p in points {
            while chain.len() >= 2 && !turns_left(chain[chain.len() - 2], chain[chain.len() - 1], p) {
                chain.pop();
            }
            chain.push(p);
        }
        // it is the first of the other half
        chain.pop();
        chain
    };
    let mut corners = half(&mut order.iter().copied());
    corners.extend(half(&mut order.iter().rev().copied()));
    corners
}

/// Points that are farthest along eight directions, in units of the spread, counter-clockwise.
fn octagon(x: &[f64], y: &[f64]) -> Vec<[f64; 2]> {
    let spread = |v: &[f64]| {
        let (low, high) = v.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |m, v| (m.0.min(*v), m.1.max(*v)));
        if high > low { 1.0 / (high - low) } else { 1.0 }
    };
    let (sx, sy) = (spread(x), spread(y));
    let directions = [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [-1.0, 1.0], [-1.0, 0.0], [-1.0, -1.0], [0.0, -1.0], [1.0, -1.0]];
    let mut corners: Vec<[f64; 2]> = Vec::new();
    for [a, b] in directions {
        let i = farthest(x, y, [a * sx, b * sy]);
        if corners.last() != Some(&[x[i], y[i]]) {
            corners.push([x[i], y[i]]);
        }
    }
    corners
}

/// Index of a point that is farthest along a direction.
#[multiversion(targets("x86_64+avx512f", "x86_64+avx2", "x86_64+avx", "aarch64+neon"))]
fn farthest(x: &[f64], y: &[f64], [a, b]: [f64; 2]) -> usize {
    const LANES: usize = 16;
    let along = |x: &f64, y: &f64| a * x + b * y;
    let mut most = [f64::NEG_INFINITY; LANES];
    let (xs, ys) = (x.as_chunks::<LANES>(), y.as_chunks::<LANES>());
    for (x, y) in xs.0.iter().zip(ys.0) {
        for l in 0..LANES {
            let v = along(&x[l], &y[l]);
            most[l] = if v > most[l] { v } else { most[l] };
        }
    }
    let rest = xs.1.iter().zip(ys.1).map(|(x, y)| along(x, y));
    let most = most.into_iter().chain(rest).fold(f64::NEG_INFINITY, |m, v| if v > m { v } else { m });
    x.iter().zip(y).position(|(x, y)| along(x, y) == most).unwrap_or(0)
}

/// Indices of the points that are not strictly inside a convex polygon.
fn outside(x: &[f64], y: &[f64], polygon: &[[f64; 2]]) -> Vec<usize> {
    let mut inside = vec![f64::INFINITY; x.len()];
    for (i, a) in polygon.iter().enumerate() {
        let b = polygon[(i + 1) % polygon.len()];
        if *a != b {
            left_of(x, y, *a, b, &mut inside);
        }
    }
    (0..x.len()).filter(|i| inside[*i] <= 0.0 || inside[*i] == f64::INFINITY).collect()
}

/// Lowers every value to how far its point lies left of a line.
#[multiversion(targets("x86_64+avx512f", "x86_64+avx2", "x86_64+avx", "aarch64+neon"))]
fn left_of(x: &[f64], y: &[f64], a: [f64; 2], b: [f64; 2], inside: &mut [f64]) {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    for ((inside, x), y) in inside.iter_mut().zip(x).zip(y) {
        let left = dx * (y - a[1]) - dy * (x - a[0]);
        *inside = if left < *inside { left } else { *inside };
    }
}
