//! A smooth complex function at many fixed points, by Chebyshev polynomials piece by piece: it is computed at a few nodes only.
//!
//! On a piece of half width a, the polynomial through n Chebyshev nodes of a function that is analytic within b on either side of the real axis errs by about rho^-n of the
//! function's size, with rho = b/a + sqrt(1 + (b/a)²) \[Trefethen 2013, chapter 8\].

use super::C64;
use crate::numerics::elementary::Elementary;
use hartog_kernel::kernel;
use std::f64::consts::PI;

/// Nodes of a piece.
const NODES: usize = 12;
/// Points that are evaluated together: enough that the next one need not wait for the last.
const LANES: usize = 16;

/// Fixed points on the real axis, sorted into pieces.
#[derive(Debug, Clone)]
pub(crate) struct Piecewise {
    /// Nodes, piece by piece.
    nodes: Vec<f64>,
    /// Of each block of points its piece, and their places between -1 and 1 in it.
    blocks: Vec<(usize, [f64; LANES])>,
    /// Where the points of the blocks stand in the list, a block after the other; those that only fill a block repeat its first.
    places: Vec<[u32; LANES]>,
    /// Of a value at each node of a piece, what it adds to the coefficients of its polynomial, lowest power first.
    to_powers: [[f64; NODES]; NODES],
}

impl Piecewise {
    /// For some points, in pieces of at most this width; nothing where one of them is not finite.
    pub fn new(points: &[f64], width: f64) -> Option<Self> {
        let (low, high) = points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |m, x| (m.0.min(*x), m.1.max(*x)));
        if !points.iter().all(|x| x.is_finite()) || points.is_empty() {
            return None;
        }
        let pieces = (((high - low) / width).ceil() as usize).max(1);
        let half = (0.5 * (high - low) / pieces as f64).max(f64::MIN_POSITIVE);
        let middle = |piece: usize| low + half * (2 * piece + 1) as f64;
        let nodes = (0..pieces).flat_map(|p| chebyshev().map(|u| middle(p) + half * u)).collect();
        let mut of_piece: Vec<Vec<u32>> = vec![Vec::new(); pieces];
        for (i, x) in points.iter().enumerate() {
            of_piece[(((x - low) / (2.0 * half)) as usize).min(pieces - 1)].push(i as u32);
        }
        let (mut blocks, mut places) = (Vec::new(), Vec::new());
        for (piece, own) in of_piece.iter().enumerate() {
            for block in own.chunks(LANES) {
                let place: [u32; LANES] = std::array::from_fn(|l| block.get(l).copied().unwrap_or(block[0]));
                blocks.push((piece, place.map(|i| (points[i as usize] - middle(piece)) / half)));
                places.push(place);
            }
        }
        Some(Self { nodes, blocks, places, to_powers: to_powers() })
    }

    /// Where the function is computed.
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// Values at the points, from those at the nodes.
    pub fn values(&self, at_nodes: &[C64], out: &mut [C64]) {
        let pieces = coefficients(&self.to_powers, at_nodes);
        evaluate(&pieces, &self.blocks, &self.places, out);
    }
}

/// Of every piece, by parts.
#[kernel]
fn coefficients(to_powers: &[[f64; NODES]; NODES], at_nodes: &[C64]) -> Vec<[[f64; NODES]; 2]> {
    let mut pieces = vec![[[0.0; NODES]; 2]; at_nodes.len() / NODES];
    for ([real, imaginary], values) in pieces.iter_mut().zip(at_nodes.as_chunks::<NODES>().0) {
        for (value, shares) in values.iter().zip(to_powers) {
            real.iter_mut().zip(shares).for_each(|(sum, share)| *sum += share * value.re);
            imaginary.iter_mut().zip(shares).for_each(|(sum, share)| *sum += share * value.im);
        }
    }
    pieces
}

#[kernel]
fn evaluate(pieces: &[[[f64; NODES]; 2]], blocks: &[(usize, [f64; LANES])], places: &[[u32; LANES]], out: &mut [C64]) {
    for ((piece, u), places) in blocks.iter().zip(places) {
        let [real, imaginary] = pieces[*piece].each_ref().map(|coefficients| polynomial(coefficients, u));
        for l in 0..LANES {
            out[places[l] as usize] = C64::new(real[l], imaginary[l]);
        }
    }
}

/// A polynomial at each place.
#[inline(always)]
fn polynomial(coefficients: &[f64; NODES], u: &[f64; LANES]) -> [f64; LANES] {
    let mut sum = [coefficients[NODES - 1]; LANES];
    for c in coefficients[..NODES - 1].iter().rev() {
        // one step for all: lanes of their own are no vector
        sum = std::array::from_fn(|l| sum[l] * u[l] + c);
    }
    sum
}

/// Chebyshev's nodes between -1 and 1.
fn chebyshev() -> [f64; NODES] {
    std::array::from_fn(|j| (PI * (j as f64 + 0.5) / NODES as f64).cosine())
}

/// Values at the nodes to Chebyshev coefficients by their discrete orthogonality, and these to powers: on twelve nodes of a smooth function nothing is lost, as its coefficients fall faster than
/// the powers' weights grow.
fn to_powers() -> [[f64; NODES]; NODES] {
    let mut chebyshev_powers = [[0.0; NODES]; NODES];
    chebyshev_powers[0][0] = 1.0;
    chebyshev_powers[1][1] = 1.0;
    for k in 2..NODES {
        for p in 0..NODES {
            let before = if p > 0 { chebyshev_powers[k - 1][p - 1] } else { 0.0 };
            chebyshev_powers[k][p] = 2.0 * before - chebyshev_powers[k - 2][p];
        }
    }
    let share = |k: usize, j: usize| {
        let weight = if k == 0 { 1.0 } else { 2.0 };
        weight / NODES as f64 * (PI * (k as f64) * (j as f64 + 0.5) / NODES as f64).cosine()
    };
    std::array::from_fn(|j| std::array::from_fn(|p| (0..NODES).map(|k| share(k, j) * chebyshev_powers[k][p]).sum()))
}
