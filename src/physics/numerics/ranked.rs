//! What is taken from a heap first: the highest rank, of level ones the oldest.

use std::cmp::Ordering;

/// Something with a rank and an age.
pub(crate) trait Ranked {
    /// The highest comes first; of level ones that with the lowest age.
    fn rank(&self) -> (f64, u64);
}

/// It in a heap.
pub(crate) struct ByRank<T>(pub T);

impl<T: Ranked> PartialEq for ByRank<T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<T: Ranked> Eq for ByRank<T> {}

impl<T: Ranked> PartialOrd for ByRank<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<T: Ranked> Ord for ByRank<T> {
    fn cmp(&self, other: &Self) -> Ordering {
        let ((own, age), (its, its_age)) = (self.0.rank(), other.0.rank());
        own.total_cmp(&its).then(its_age.cmp(&age))
    }
}
