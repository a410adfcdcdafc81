//! Stress concentration at the fillet of a stepped round shaft, as fitted formulas K_t = A (r/d)^b \[Norton 2013\] figures C-2 and C-3, after Peterson.

use crate::numerics::elementary::Elementary;

/// D/d, A and b in bending.
const BENDING: [(f64, f64, f64); 11] = [
    (1.01, 0.919_38, -0.170_32),
    (1.02, 0.960_48, -0.177_11),
    (1.03, 0.980_61, -0.183_81),
    (1.05, 0.981_37, -0.196_53),
    (1.07, 0.975_27, -0.209_58),
    (1.10, 0.951_20, -0.237_57),
    (1.20, 0.970_98, -0.217_96),
    (1.50, 0.938_36, -0.257_59),
    (2.00, 0.908_79, -0.285_98),
    (3.00, 0.893_34, -0.308_60),
    (6.00, 0.878_68, -0.332_43),
];

/// D/d, A and b in torsion.
const TORSION: [(f64, f64, f64); 4] =
    [(1.09, 0.903_37, -0.126_92), (1.20, 0.834_25, -0.216_49), (1.33, 0.848_97, -0.231_61), (2.00, 0.863_31, -0.238_65)];

/// Largest r/d of the charts: sharper fillets only are of interest, a larger radius is taken as this one.
pub const LARGEST_RADIUS: f64 = 0.3;

/// Linear in D/d between the rows and from one at D = d to the first; beyond the last row as there.
fn factor(rows: &[(f64, f64, f64)], radius: f64, ratio: f64) -> f64 {
    let radius = radius.min(LARGEST_RADIUS);
    let row_factor = |row: &(f64, f64, f64)| (row.1 * radius.power(row.2)).max(1.0);
    let last = rows[rows.len() - 1];
    if ratio >= last.0 {
        return row_factor(&last);
    }
    let above = rows.iter().position(|r| r.0 > ratio).unwrap_or(0);
    let (low, high) = if above == 0 {
        ((1.0, 1.0), (rows[0].0, row_factor(&rows[0])))
    } else {
        ((rows[above - 1].0, row_factor(&rows[above - 1])), (rows[above].0, row_factor(&rows[above])))
    };
    low.1 + (high.1 - low.1) * ((ratio - low.0) / (high.0 - low.0)).max(0.0)
}

/// In bending. `radius`: fillet over the small diameter, 0.01 to 0.3; `ratio`: large over small diameter.
pub fn bending(radius: f64, ratio: f64) -> f64 {
    factor(&BENDING, radius, ratio)
}

/// In torsion; as [`bending`].
pub fn torsion(radius: f64, ratio: f64) -> f64 {
    factor(&TORSION, radius, ratio)
}
