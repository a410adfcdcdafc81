//! Whether columns of angles and pressures are traces of a cycle.

/// Steps within this share of each other are alike; wide ones are this many times as long, and no more than this share of all.
const SAME_STEP: f64 = 0.05;
const WIDE: f64 = 1.5;
const FEW: f64 = 0.05;
/// Degrees: half the cycle of a four-stroke.
const FULL_TURN: f64 = 360.0;
/// The highest pressure of a trace that begins at the other dead centre is so many times that on the side of firing.
const TURNED: f64 = 2.0;
/// Fewer rows are no trace.
const FEWEST: usize = 24;

/// What is wrong with traces, and where: in the file as a whole, at an angle, or at a pressure.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TraceFault {
    /// Index of the row.
    pub row: Option<usize>,
    /// Index of the trace, where it is a pressure.
    pub trace: Option<usize>,
    pub message: String,
}

/// The first fault of traces over the same angles, degrees; None where they are right: at least 24 rows, ascending, none missing, over one cycle (its last angle may be
/// left out), and absolute pressures.
pub(crate) fn fault(crank_deg: &[f64], traces: &[Vec<f64>], cycle_deg: f64) -> Option<TraceFault> {
    let fault_at = |row: Option<usize>, message: String| Some(TraceFault { row, trace: None, message });
    let rows = crank_deg.len();
    if rows < FEWEST {
        return fault_at(None, format!("found {rows} rows, expected at least {FEWEST} over a cycle"));
    }
    if let Some(i) = crank_deg.windows(2).position(|pair| pair[1] <= pair[0]) {
        return fault_at(Some(i + 1), format!("found {} after {}, expected ascending angles", crank_deg[i + 1], crank_deg[i]));
    }
    if let Some((i, found)) = hole(crank_deg) {
        return fault_at(Some(i), found);
    }
    let widest = crank_deg.windows(2).map(|w| w[1] - w[0]).fold(0.0, f64::max);
    let span = crank_deg[rows - 1] - crank_deg[0];
    if span > cycle_deg + 1e-6 || span + 1.5 * widest < cycle_deg {
        let message = format!("found a cycle of {span} degrees, expected {cycle_deg} (with or without its last angle)");
        return fault_at(Some(rows - 1), message);
    }
    let not_absolute = traces.iter().enumerate().find_map(|(trace, pressures)| {
        let row = pressures.iter().position(|p| *p <= 0.0)?;
        let message = format!("found {}, expected an absolute pressure above zero", pressures[row]);
        Some(TraceFault { row: Some(row), trace: Some(trace), message })
    });
    not_absolute.or_else(|| traces.iter().enumerate().find_map(|trace| turned(crank_deg, trace, cycle_deg)))
}

/// A trace of a four-stroke whose highest pressure is at the change of gas, half a cycle from firing: mean pressures do not tell, but what a cylinder does without burning is that of another stroke.
fn turned(crank_deg: &[f64], (trace, pressures): (usize, &Vec<f64>), cycle_deg: f64) -> Option<TraceFault> {
    let turn = 0.5 * cycle_deg;
    let is_near_firing = |row: usize| ((crank_deg[row] + turn).rem_euclid(cycle_deg) - turn).abs() <= 0.5 * turn;
    let highest = |near: bool| {
        let rows = (0..pressures.len()).filter(|row| is_near_firing(*row) == near);
        rows.max_by(|a, b| pressures[*a].total_cmp(&pressures[*b]))
    };
    let (own, row) = (highest(true)?, highest(false)?);
    let message = format!(
        "found the highest pressure at {} degrees, expected zero degrees at the dead centre of firing: this trace begins at that between exhaust and inlet, so that its angles are {turn} too large",
        crank_deg[row]
    );
    (turn > FULL_TURN - 1.0 && pressures[row] > TURNED * pressures[own]).then_some(TraceFault {
        row: Some(row),
        trace: Some(trace),
        message,
    })
}

/// The row after the first that are missing, and what is found there: one of a few wide steps among steps that are alike.
fn hole(crank_deg: &[f64]) -> Option<(usize, String)> {
    let steps: Vec<f64> = crank_deg.windows(2).map(|w| w[1] - w[0]).collect();
    let mut sorted = steps.clone();
    sorted.sort_by(f64::total_cmp);
    let usual = *sorted.get(sorted.len() / 2)?;
    let alike = steps.iter().filter(|s| (**s / usual - 1.0).abs() < SAME_STEP).count();
    // a table that is finer in a part of the cycle has many steps of either kind
    let few = steps.len() - alike <= (FEW * steps.len() as f64) as usize;
    let found = |i: usize| {
        // units in radian leave rounding
        let [from, to, usual] = [crank_deg[i], crank_deg[i + 1], usual].map(|deg| (1e6 * deg).round() / 1e6);
        (i + 1, format!("found a step from {from} to {to} degrees among steps of {usual}, expected no row to be missing"))
    };
    steps.iter().position(|s| few && *s > WIDE * usual).map(found)
}
