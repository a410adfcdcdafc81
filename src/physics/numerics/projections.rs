//! How far numbers reach, and points of a plane or of four dimensions along directions.

use hartog_kernel::kernel;

/// Points that are looked at together.
pub(crate) const LANES: usize = 16;

/// The largest of some numbers, a power of two of them, by halving.
#[inline(always)]
pub(super) fn largest<T: Copy + PartialOrd, const N: usize>(mut lanes: [T; N]) -> T {
    let mut half = N / 2;
    while half > 0 {
        for l in 0..half {
            lanes[l] = if lanes[l + half] > lanes[l] { lanes[l + half] } else { lanes[l] };
        }
        half /= 2;
    }
    lanes[0]
}

/// Part of a point along a direction.
pub(super) fn along([a, b]: [f32; 2], x: f32, y: f32) -> f32 {
    a * x + b * y
}

/// Smallest and largest part of the points along each direction.
#[kernel]
pub(crate) fn extents<const N: usize>(x: &[f32], y: &[f32], directions: &[[f32; 2]; N]) -> [(f32, f32); N] {
    let (xs, ys) = (x.as_chunks::<LANES>(), y.as_chunks::<LANES>());
    let mut all = [(f32::INFINITY, f32::NEG_INFINITY); N];
    for (range, d) in all.iter_mut().zip(directions) {
        // the same operation for both ends: compilers mix up lanes of different ones
        let (mut low, mut high) = ([f32::NEG_INFINITY; LANES], [f32::NEG_INFINITY; LANES]);
        for (x, y) in xs.0.iter().zip(ys.0) {
            for l in 0..LANES {
                let v = along(*d, x[l], y[l]);
                low[l] = if -v > low[l] { -v } else { low[l] };
                high[l] = if v > high[l] { v } else { high[l] };
            }
        }
        *range = (-largest(low), largest(high));
        for (x, y) in xs.1.iter().zip(ys.1) {
            let v = along(*d, *x, *y);
            range.0 = if v < range.0 { v } else { range.0 };
            range.1 = if v > range.1 { v } else { range.1 };
        }
    }
    all
}

/// Half the range of points of four dimensions along each direction, of which there is a whole number of lanes: a row a dimension. They are looked at together, so that no lane has to wait for another.
#[kernel]
pub(crate) fn half_ranges(points: &[[f32; 4]], directions: &[Vec<f32>; 4], out: &mut Vec<f32>) {
    let [a, b, c, d] = directions;
    let (a, b, c, d) = (a.as_chunks::<LANES>().0, b.as_chunks::<LANES>().0, c.as_chunks::<LANES>().0, d.as_chunks::<LANES>().0);
    out.clear();
    for i in 0..a.len() {
        let (a, b, c, d) = (a[i], b[i], c[i], d[i]);
        // the same operation for both ends: compilers mix up lanes of different ones
        let (mut low, mut high) = ([f32::NEG_INFINITY; LANES], [f32::NEG_INFINITY; LANES]);
        for p in points {
            for l in 0..LANES {
                let v = p[0] * a[l] + p[1] * b[l] + p[2] * c[l] + p[3] * d[l];
                low[l] = if -v > low[l] { -v } else { low[l] };
                high[l] = if v > high[l] { v } else { high[l] };
            }
        }
        for l in 0..LANES {
            low[l] = 0.5 * (low[l] + high[l]);
        }
        out.extend_from_slice(&low);
    }
}

/// Sums of rows, each with its weight.
#[kernel]
pub(crate) fn combined<const N: usize>(rows: &[Vec<f32>; N], weights: &[f32; N], out: &mut Vec<f32>) {
    out.clear();
    out.resize(rows[0].len(), 0.0);
    for (row, weight) in rows.iter().zip(weights) {
        for (sum, x) in out.iter_mut().zip(row) {
            *sum += weight * x;
        }
    }
}

/// Smallest and largest number; infinities of opposite sign where there is none.
#[kernel]
pub(crate) fn range(numbers: &[f64]) -> (f64, f64) {
    let (whole, rest) = numbers.as_chunks::<LANES>();
    let (mut low, mut high) = ([f64::NEG_INFINITY; LANES], [f64::NEG_INFINITY; LANES]);
    for chunk in whole {
        for l in 0..LANES {
            low[l] = if -chunk[l] > low[l] { -chunk[l] } else { low[l] };
            high[l] = if chunk[l] > high[l] { chunk[l] } else { high[l] };
        }
    }
    let least = rest.iter().fold(-largest(low), |m, v| if *v < m { *v } else { m });
    (least, rest.iter().fold(largest(high), |m, v| if *v > m { *v } else { m }))
}
