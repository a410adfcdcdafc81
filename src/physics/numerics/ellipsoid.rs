//! An ellipsoid round points, which says how wide they are along any direction.

/// Steps towards the smallest one: more tell little.
const STEPS: usize = 12;
/// Of points that do not span the space, the ellipsoid is this thick: the square of a share of their reach.
const THIN: f64 = 1e-8;

/// A matrix A such that x' A^-1 x <= 1 for all points x (one slice a coordinate, all of one length, at least one point): along a direction d no point lies farther out than sqrt(d' A d), on
/// either side of the origin. It is close to the ellipsoid of the smallest volume about the origin, by multiplicative steps of the weights of the points \[Titterington 1978\].
pub fn ellipsoid<const D: usize>(points: [&[f64]; D]) -> [[f64; D]; D] {
    let count = points.first().map_or(0, |row| row.len());
    let reach = points.map(|row| row.iter().fold(0.0, |m: f64, x| m.max(x.abs())));
    let unit = reach.map(|r| if r > 0.0 { r } else { 1.0 });
    let scaled_point = |j: usize| -> [f64; D] { std::array::from_fn(|d| points[d][j] / unit[d]) };
    let mut weights = vec![1.0 / count.max(1) as f64; count];
    let (mut moments, mut largest) = ([[0.0; D]; D], 0.0);
    for step in 0..STEPS {
        moments = [[0.0; D]; D];
        for (j, weight) in weights.iter().enumerate() {
            let x = scaled_point(j);
            for a in 0..D {
                for b in 0..D {
                    moments[a][b] += weight * x[a] * x[b];
                }
            }
        }
        (0..D).for_each(|d| moments[d][d] += THIN);
        let root = cholesky(&moments);
        largest = 0.0;
        for (j, weight) in weights.iter_mut().enumerate() {
            let square = square_in(&root, scaled_point(j));
            largest = f64::max(largest, square);
            if step + 1 < STEPS {
                *weight *= square / D as f64;
            }
        }
    }
    std::array::from_fn(|a| std::array::from_fn(|b| largest * unit[a] * unit[b] * moments[a][b]))
}

/// Lower triangle L of M = L L'.
fn cholesky<const D: usize>(m: &[[f64; D]; D]) -> [[f64; D]; D] {
    let mut l = [[0.0; D]; D];
    for i in 0..D {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| l[i][k] * l[j][k]).sum();
            // what rounding leaves of a pivot is no smaller than the thickness
            l[i][j] = if i == j { (m[i][i] - known).max(0.5 * THIN).sqrt() } else { (m[i][j] - known) / l[j][j] };
        }
    }
    l
}

/// x' M^-1 x.
fn square_in<const D: usize>(l: &[[f64; D]; D], x: [f64; D]) -> f64 {
    let mut y = [0.0; D];
    for i in 0..D {
        let known: f64 = (0..i).map(|k| l[i][k] * y[k]).sum();
        y[i] = (x[i] - known) / l[i][i];
    }
    y.iter().map(|y| y * y).sum()
}
