//! The smallest ball that holds a set of points, exactly: a basis of at most D + 1 points is exchanged until no point lies outside.
//!
//! As in linear programming: the farthest point joins the basis, and the smallest ball of those few points is found among the circumballs of their subsets
//! \[Gärtner 1999\]. The radius grows with every exchange, so that the iteration ends.

use hartog_kernel::kernel;

/// A ball with the points that hold it: the first `count` of the basis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball<const D: usize> {
    /// Its centre.
    pub centre: [f64; D],
    /// Its radius.
    pub radius: f64,
    basis: [usize; MOST],
    count: usize,
}

impl<const D: usize> Ball<D> {
    /// Indices of the points that hold it, at most D + 1.
    pub fn support(&self) -> &[usize] {
        &self.basis[..self.count]
    }
}

/// A point farther out than this share of the radius is outside.
const OUTSIDE: f64 = 1e-13;
/// Points of a basis closer to dependence than this are dependent.
const DEPENDENT: f64 = 1e-14;
/// More exchanges than this are rounding.
const MOST_EXCHANGES: usize = 200;

/// Room for a basis in up to six dimensions, and one more point.
const MOST: usize = 8;

/// The smallest ball of the points with these coordinates (one slice a dimension, all of one length, at least one point; at most six dimensions).
pub fn smallest_ball<const D: usize>(points: [&[f64]; D]) -> Ball<D> {
    smallest_ball_from(points, &[])
}

/// The same ball, found sooner where most of the points that hold it are known: indices of points, at most D + 1; others than those only cost time.
pub(crate) fn smallest_ball_from<const D: usize>(points: [&[f64]; D], known: &[usize]) -> Ball<D> {
    let first = known.first().copied().unwrap_or(0);
    let mut ball = Ball { centre: points.map(|c| c[first]), radius: 0.0, basis: [first; MOST], count: 1 };
    for new in known.iter().skip(1) {
        let reached = ball.radius * (1.0 + OUTSIDE);
        if distance2(&points, &ball.centre, *new) > reached * reached {
            ball = exchange(&points, &ball, *new).unwrap_or(ball);
        }
    }
    for _ in 0..MOST_EXCHANGES {
        let (far, distance2) = farthest(&points, &ball.centre);
        let reached = ball.radius * (1.0 + OUTSIDE);
        if distance2 <= reached * reached || ball.support().contains(&far) {
            break;
        }
        match exchange(&points, &ball, far) {
            Some(larger) if larger.radius > ball.radius => ball = larger,
            // rounding: the point lies on the ball
            _ => break,
        }
    }
    ball
}

fn distance2<const D: usize>(points: &[&[f64]; D], centre: &[f64; D], i: usize) -> f64 {
    (0..D).map(|d| (points[d][i] - centre[d]) * (points[d][i] - centre[d])).sum()
}

/// Index and squared distance of the farthest point.
fn farthest<const D: usize>(points: &[&[f64]; D], centre: &[f64; D]) -> (usize, f64) {
    if D == 2 {
        return farthest_in_plane(points[0], points[1], [centre[0], centre[1]]);
    }
    let mut best = (0, f64::NEG_INFINITY);
    for i in 0..points[0].len() {
        let d = distance2(points, centre, i);
        if d > best.1 {
            best = (i, d);
        }
    }
    best
}

/// Points looked at together.
const LANES: usize = 16;

/// The same in two dimensions: the distance first, then the point that has it.
#[kernel]
fn farthest_in_plane(x: &[f64], y: &[f64], centre: [f64; 2]) -> (usize, f64) {
    let distance2 = |x: f64, y: f64| (x - centre[0]) * (x - centre[0]) + (y - centre[1]) * (y - centre[1]);
    let (xs, ys) = (x.as_chunks::<LANES>(), y.as_chunks::<LANES>());
    let mut lanes = [f64::NEG_INFINITY; LANES];
    for (x, y) in xs.0.iter().zip(ys.0) {
        for l in 0..LANES {
            let d = distance2(x[l], y[l]);
            lanes[l] = if d > lanes[l] { d } else { lanes[l] };
        }
    }
    let rest = xs.1.iter().zip(ys.1).map(|(x, y)| distance2(*x, *y));
    let most = lanes.into_iter().chain(rest).fold(f64::NEG_INFINITY, |m, d| if d > m { d } else { m });
    let has = |(x, y): (&[f64; LANES], &[f64; LANES])| {
        let mut any = false;
        for l in 0..LANES {
            any |= distance2(x[l], y[l]) == most;
        }
        any
    };
    let from = LANES * xs.0.iter().zip(ys.0).position(has).unwrap_or(xs.0.len());
    ((from..x.len()).find(|i| distance2(x[*i], y[*i]) == most).unwrap_or(0), most)
}

/// The smallest ball of a basis and one more point, which it holds on its surface.
fn exchange<const D: usize>(points: &[&[f64]; D], ball: &Ball<D>, new: usize) -> Option<Ball<D>> {
    let point_at = |i: usize| points.map(|c| c[i]);
    let old = ball.support();
    let mut best: Option<Ball<D>> = None;
    for subset in 0..1u32 << old.len() {
        let mut basis = [new; MOST];
        let mut count = 1;
        for (k, i) in old.iter().enumerate() {
            if subset >> k & 1 == 1 {
                basis[count] = *i;
                count += 1;
            }
        }
        if count > D + 1 {
            continue;
        }
        let mut places = [[0.0; D]; MOST];
        for (place, i) in places.iter_mut().zip(&basis[..count]) {
            *place = point_at(*i);
        }
        let Some((centre, radius)) = circumball(&places[..count]) else { continue };
        let reached = radius * (1.0 + 16.0 * OUTSIDE);
        let inside = |i: &usize| distance2(points, &centre, *i) <= reached * reached;
        if best.as_ref().is_none_or(|b| radius < b.radius) && old.iter().all(inside) {
            best = Some(Ball { centre, radius, basis, count });
        }
    }
    best
}

/// Centre (in the affine hull) and radius of the ball through these points; nothing where they are dependent.
fn circumball<const D: usize>(points: &[[f64; D]]) -> Option<([f64; D], f64)> {
    let (first, rest) = points.split_first()?;
    let k = rest.len();
    if let [second] = rest {
        let centre: [f64; D] = std::array::from_fn(|d| 0.5 * (first[d] + second[d]));
        let radius = (0..D).map(|d| (first[d] - centre[d]) * (first[d] - centre[d])).sum::<f64>().sqrt();
        return Some((centre, radius));
    }
    if let [a, b] = rest {
        return through_three(first, a, b);
    }
    // 2 q_i . (c - p) = |q_i|² with c - p = sum of x_j q_j
    let mut m = [[0.0; MOST]; MOST];
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
            let row = m[c];
            let factor = m[r][c] / row[c];
            m[r].iter_mut().zip(row).for_each(|(value, pivot)| *value -= factor * pivot);
        }
    }
    let mut x = [0.0; MOST];
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

/// The same through three points.
fn through_three<const D: usize>(p: &[f64; D], a: &[f64; D], b: &[f64; D]) -> Option<([f64; D], f64)> {
    let (mut aa, mut bb, mut ab) = (0.0, 0.0, 0.0);
    for d in 0..D {
        aa += (a[d] - p[d]) * (a[d] - p[d]);
        bb += (b[d] - p[d]) * (b[d] - p[d]);
        ab += (a[d] - p[d]) * (b[d] - p[d]);
    }
    let mut rows = [[2.0 * aa, 2.0 * ab, aa], [2.0 * ab, 2.0 * bb, bb]];
    let scale = rows[0][0].max(rows[1][1]);
    if rows[1][0].abs() > rows[0][0].abs() {
        rows.swap(0, 1);
    }
    // eliminated with a pivot: points on the surface must stay there where two of them are close together
    let factor = rows[1][0] / rows[0][0];
    let (pivot, rest) = (rows[1][1] - factor * rows[0][1], rows[1][2] - factor * rows[0][2]);
    if rows[0][0].abs().min(pivot.abs()) <= DEPENDENT * scale {
        return None;
    }
    let y = rest / pivot;
    let x = (rows[0][2] - rows[0][1] * y) / rows[0][0];
    let offset: [f64; D] = std::array::from_fn(|d| x * (a[d] - p[d]) + y * (b[d] - p[d]));
    let radius = offset.iter().map(|o| o * o).sum::<f64>().sqrt();
    Some((std::array::from_fn(|d| p[d] + offset[d]), radius))
}
