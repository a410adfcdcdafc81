//! The loads of a web over the cycle by a few of their samples, within a known distance of the others: what many points on the web share.

use crate::numerics::ellipsoid::ellipsoid;
use crate::numerics::polyline::polyline;
use crate::numerics::projections::range;

/// Samples closer to the polyline than this share of half the range of every load are left out.
const NEAR: f64 = 0.005;
/// Corners are looked at together, so many at a time: the first one fills up the last of them.
pub(super) const LANES: usize = 8;

/// L loads of a web over the cycle, each about the middle of its range.
#[derive(Debug, Clone)]
pub(super) struct LoadPath<const L: usize> {
    /// The middles.
    pub middle: [f64; L],
    /// Corners of a polyline, less the middles: a row a load.
    pub corners: [Vec<f64>; L],
    /// The polyline differs from no sample by more than this in each load.
    pub off: [f64; L],
}

impl<const L: usize> LoadPath<L> {
    /// Of the loads at every sample: a row each.
    pub fn of(rows: [&[f64]; L]) -> Self {
        let ends = rows.map(range);
        let (mut chosen, off) = polyline(rows, ends.map(|(low, high)| NEAR * 0.5 * (high - low)));
        chosen.resize(chosen.len().next_multiple_of(LANES), chosen[0]);
        let middle = ends.map(|(low, high)| 0.5 * (low + high));
        let corners = std::array::from_fn(|l| chosen.iter().map(|j| rows[l][*j] - middle[l]).collect());
        Self { middle, corners, off }
    }

    /// The same where the last load lies so many times as far from a value.
    pub fn risen(&self, rise: f64, from: f64) -> Self {
        let mut risen = self.clone();
        let last = L - 1;
        risen.middle[last] = from + rise * (self.middle[last] - from);
        risen.off[last] *= rise;
        risen.corners[last].iter_mut().for_each(|load| *load *= rise);
        risen
    }

    /// A matrix A: along the polyline d . loads is never farther from that of the middles than the root of d' A d.
    pub fn ellipsoid(&self) -> [[f64; L]; L] {
        ellipsoid(self.corners.each_ref().map(Vec::as_slice))
    }

    /// At least how far something that is linear in the loads differs between a sample and the polyline, by its size per unit of each load.
    pub fn apart(&self, sizes: impl Iterator<Item = f64>) -> f64 {
        self.off.iter().zip(sizes).map(|(off, size)| off * size).sum()
    }
}
