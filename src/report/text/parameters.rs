//! What the parameters of an optimum ask of who builds it: the loss factor that they imply, and bounds that they lie on.

use super::table::significant;
use crate::analysis::OptimumResult;
use crate::input::Study;
use crate::units::HZ_PER_RAD_PER_S;

/// Loss factors of rubber in torsional absorbers.
const RUBBER: &str = "0.1 to 0.3";
/// A parameter is on a bound where it is nearer than this share of the upper one.
const ON_BOUND: f64 = 1e-9;

/// A line for each.
pub(super) fn parameters(study: &Study, o: &OptimumResult) -> Vec<String> {
    let mut lines = Vec::new();
    for (i, mounted) in o.design.absorbers.iter().enumerate() {
        let which = if o.design.absorbers.len() > 1 { format!("absorber {}: ", i + 1) } else { String::new() };
        if let Some((loss, own)) = mounted.absorber.implied_loss_factor() {
            lines.push(format!(
                "  {which}implied loss factor {} (c omega/k at the ring's own {} Hz); rubber has {RUBBER}",
                significant(loss, 3),
                significant(own * HZ_PER_RAD_PER_S, 4)
            ));
        }
        let spec = study.optimise.as_ref().and_then(|s| s.absorbers.get(i));
        for (key, (low, high)) in spec.into_iter().flat_map(|s| &s.bounds).filter(|b| b.1.1 > b.1.0) {
            let Some(x) = mounted.absorber.value(key) else { continue };
            for (bound, end) in [(low, "lower"), (high, "upper")] {
                if (x - bound).abs() <= ON_BOUND * high.abs() {
                    lines.push(format!(
                        "  {which}`{key}` lies on its {end} bound, {}: beyond it there may be a better one",
                        significant(*bound, 4)
                    ));
                }
            }
        }
    }
    lines
}
