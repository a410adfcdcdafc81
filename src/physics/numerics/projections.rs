//! How far numbers reach, and points of a plane along directions.

/// Points that are looked at together.
pub(super) const LANES: usize = 16;

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
#[cfg_attr(not(feature = "baseline"), multiversion::multiversion(targets("x86_64+avx512f", "x86_64+avx2", "x86_64+avx", "aarch64+neon")))]
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

/// Smallest and largest number; infinities of opposite sign where there is none.
#[cfg_attr(not(feature = "baseline"), multiversion::multiversion(targets("x86_64+avx512f", "x86_64+avx2", "x86_64+avx", "aarch64+neon")))]
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
