//! Samples of a curve that are enough to draw it: the polyline through them is nowhere far from the others.

/// Indices of some samples of a curve (one row a coordinate, all of one length, at least one sample), ascending, the first and the last among them, such that the polyline through them,
/// walked evenly from index to index, differs from no sample by more than `near` in any coordinate; and how far it differs in each. A coordinate that does not change counts for nothing.
/// The sample that is farthest off joins, on each side of it anew \[Douglas & Peucker 1973\].
pub fn polyline<const D: usize>(rows: [&[f64]; D], near: [f64; D]) -> (Vec<usize>, [f64; D]) {
    let last = rows.first().map_or(0, |row| row.len().saturating_sub(1));
    let scale = near.map(|n| if n > 0.0 { 1.0 / n } else { 0.0 });
    let (mut chosen, mut off) = (vec![0], [0.0_f64; D]);
    let mut parts = vec![(0, last)];
    while let Some((a, b)) = parts.pop() {
        let (mut far, mut farthest, mut largest) = (a, 0.0, [0.0_f64; D]);
        for j in a + 1..b {
            let share = (j - a) as f64 / (b - a) as f64;
            let mut own = 0.0;
            for d in 0..D {
                let row = rows[d];
                let apart = (row[j] - (row[a] + (row[b] - row[a]) * share)).abs();
                largest[d] = largest[d].max(apart);
                own = f64::max(own, apart * scale[d]);
            }
            if own > farthest {
                (far, farthest) = (j, own);
            }
        }
        if farthest > 1.0 {
            // the part before is looked at first, so that indices ascend
            parts.extend([(far, b), (a, far)]);
        } else {
            (0..D).for_each(|d| off[d] = off[d].max(largest[d]));
            if b > a {
                chosen.push(b);
            }
        }
    }
    (chosen, off)
}
