//! The smallest ball that holds a set of points, exactly: a basis of at most D + 1 points is exchanged until no point lies outside.
//!
//! As in linear programming: the farthest point joins the basis, and the smallest ball of those few points is found among the circumballs of their subsets
//! \[Gärtner 1999\]. The radius grows with every exchange, so that the iteration ends.

use multiversion::multiversion;

/// A ball.
#[derive(Debug, Clone, PartialEq)]
pub struct Ball<const D: usize> {
    /// Its centre.
    pub centre: [f64; D],
    /// Its radius.
    pub radius: f64,
    /// Indices of the points that hold it, at most D + 1.
    pub support: Vec<usize>,
}

/// A point farther out than this share of the radius is outside.
const OUTSIDE: f64 = 1e-13;
/// Points of a basis closer to dependence than this are dependent.
const DEPENDENT: f64 = 1e-14;
/// More exchanges than this are rounding.
const MOST_EXCHANGES: usize = 200;

/// The smallest ball of the points with these coordinates (one slice a dimension, all of one length, at least one point).
pub fn smallest_ball<const D: usize>(points: [&[f64]; D]) -> Ball<D> {
    let at = |i: usize| points.map(|c| c[i]);
    let mut ball = Ball { centre: at(0), radius: 0.0, support: vec![0] };
    // a far pair to begin with
    let far = farthest(&points, &ball.centre).0;
    if far != 0 {
        ball = basis(&points, &[0], far).unwrap_or(ball);
    }
    for _ in 0..MOST_EXCHANGES {
        let (far, distance2) = farthest(&points, &ball.centre);
        let reached = ball.radius * (1.0 + OUTSIDE);
        if distance2 <= reached * reached || ball.support.contains(&far) {
            break;
        }
        match basis(&points, &ball.support, far) {
            Some(larger) if larger.radius > ball.radius => ball = larger,
            // rounding: the point lies on the ball
            _ => break,
        }
    }
    ball
}

/// Index and squared distance of the farthest point.
fn farthest<const D: usize>(points: &[&[f64]; D], centre: &[f64; D]) -> (usize, f64) {
    let n = points[0].len();
    let distance2 = |i: usize| (0..D).map(|d| (points[d][i] - centre[d]).powi(2)).sum::<f64>();
    let mut best = (0, distance2(0));
    if D == 2 {
        let most = farthest_in_plane(points[0], points[1], centre[0], centre[1]);
        return ((0..n).find(|i| distance2(*i) >= most).unwrap_or(best.0), most);
    }
    for i in 1..n {
        let d = distance2(i);
        if d > best.1 {
            best = (i, d);
        }
    }
    best
}

/// Largest squared distance in two dimensions, several points at a time.
#[multiversion(targets("x86_64+avx512f", "x86_64+avx2", "x86_64+avx", "aarch64+neon"))]
fn farthest_in_plane(x: &[f64], y: &[f64], cx: f64, cy: f64) -> f64 {
    const LANES: usize = 16;
    let mut most = [0.0f64; LANES];
    let (xs, ys) = (x.as_chunks::<LANES>(), y.as_chunks::<LANES>());
    for (x, y) in xs.0.iter().zip(ys.0) {
        for l in 0..LANES {
            let (dx, dy) = (x[l] - cx, y[l] - cy);
            let d = dx * dx + dy * dy;
            most[l] = if d > most[l] { d } else { most[l] };
        }
    }
    let rest = xs.1.iter().zip(ys.1).map(|(x, y)| (x - cx) * (x - cx) + (y - cy) * (y - cy));
    most.into_iter().chain(rest).fold(0.0, |m, d| if d > m { d } else { m })
}

/// The smallest ball of a basis and one more point, which it holds on its surface.
fn basis<const D: usize>(points: &[&[f64]; D], old: &[usize], new: usize) -> Option<Ball<D>> {
    let at = |i: usize| points.map(|c| c[i]);
    let mut best: Option<Ball<D>> = None;
    for subset in 0..1u32 << old.len() {
        let mut support = vec![new];
        support.extend(old.iter().enumerate().filter(|(k, _)| subset >> k & 1 == 1).map(|(_, i)| *i));
        if support.len() > D + 1 {
            continue;
        }
        let Some((centre, radius)) = circumball(&support.iter().map(|i| at(*i)).collect::<Vec<_>>()) else { continue };
        let inside = |i: &usize| {
            let p = at(*i);
            let d = (0..D).map(|d| (p[d] - centre[d]).powi(2)).sum::<f64>().sqrt();
            d <= radius * (1.0 + 16.0 * OUTSIDE)
        };
        if best.as_ref().is_none_or(|b| radius < b.radius) && old.iter().all(inside) {
            best = Some(Ball { centre, radius, support });
        }
    }
    best
}

/// Centre (in the affine hull) and radius of the ball through these points; nothing where they are dependent.
fn circumball<const D: usize>(points: &[[f64; D]]) -> Option<([f64; D], f64)> {
    let (first, rest) = points.split_first()?;
    let k = rest.len();
    // 2 q_i . (c - p) = |q_i|² with c - p = sum of x_j q_j
    let mut m = [[0.0; 8]; 8];
    for i in 0..k {
        for j in 0..k {
            m[i][j] = 2.0 * (0..D).map(|d| (rest[i][d] - first[d]) * (rest[j][d] - first[d])).sum::<f64>();
        }
        m[i][k] = 0.5 * m[i][i];
    }
    let scale = (0..k).map(|i| m[i][i]).fold(0.0, f64::max);
    for c in 0..k {
        let pivot = (c..k).fold(c, |p, r| if m[r][c].abs() > m[p][c].abs() { r } else { p });
        if m[pivot][c].abs() <= DEPENDENT * scale {
            return None;
        }
        m.swap(c, pivot);
        for r in c + 1..k {
            let factor = m[r][c] / m[c][c];
            for j in c..=k {
                m[r][j] -= factor * m[c][j];
            }
        }
    }
    let mut x = [0.0; 8];
    for c in (0..k).rev() {
        let known: f64 = (c + 1..k).map(|j| m[c][j] * x[j]).sum();
        x[c] = (m[c][k] - known) / m[c][c];
    }
    let mut offset = [0.0; D];
    for (q, x) in rest.iter().zip(x) {
        for d in 0..D {
            offset[d] += x * (q[d] - first[d]);
        }
    }
    let radius = offset.iter().map(|o| o * o).sum::<f64>().sqrt();
    let mut centre = *first;
    for d in 0..D {
        centre[d] += offset[d];
    }
    Some((centre, radius))
}
