//! What the parameters of an optimum ask of who builds it: the loss factor that they imply, and bounds that they lie on.

use super::table::significant;
use super::verdict::rubber_loss;
use crate::analysis::OptimumResult;
use crate::drivetrain::natural;
use crate::units::HZ_PER_RAD_PER_S;

/// A smaller gain, per cent of the objective, is rounding.
const WORTH_SAYING: f64 = 1e-6;

/// A line for each.
pub(super) fn parameters(o: &OptimumResult) -> Vec<String> {
    let mut lines = Vec::new();
    for (i, mounted) in o.design.absorbers.iter().enumerate() {
        let which = if o.design.absorbers.len() > 1 { format!("absorber {}: ", i + 1) } else { String::new() };
        if let Some((loss, own)) = mounted.absorber.implied_loss_factor() {
            lines.push(format!(
                "  {which}implied loss factor {} (c omega/k at the ring's own {} Hz); rubber has {}",
                significant(loss, 3),
                significant(own * HZ_PER_RAD_PER_S, 4),
                rubber_loss()
            ));
        } else if let Some(law) = mounted.absorber.law()
            && let (Some(own), Some(loss)) = (natural::own(&**law), natural::own_loss_factor(&**law))
        {
            let hint =
                if mounted.absorber.value("loss_factor").is_some() { format!("; rubber has {}", rubber_loss()) } else { String::new() };
            let hz = significant(own * HZ_PER_RAD_PER_S, 4);
            lines.push(format!("  {which}the ring on its held hub has {hz} Hz and there a loss factor of {}{hint}", significant(loss, 3)));
        }
    }
    lines.extend(bounds(o));
    lines
}

/// Bounds that it lies on, a line each.
#[doc(hidden)]
pub fn bounds(o: &OptimumResult) -> Vec<String> {
    let mut lines = Vec::new();
    for hit in &o.on_bounds {
        let Some(declaration) = o.design.absorbers[hit.absorber].absorber.declaration() else { continue };
        let which = if o.design.absorbers.len() > 1 { format!("absorber {}: ", hit.absorber + 1) } else { String::new() };
        let (key, end) = (declaration.parameters[hit.parameter].key, if hit.upper { "upper" } else { "lower" });
        let price = match hit.price {
            Some(price) if price > WORTH_SAYING => {
                format!(": one per cent further, all else tuned anew, would improve the objective by {} %", significant(price, 2))
            }
            Some(_) => ": further out nothing would improve".to_owned(),
            None => String::new(),
        };
        lines.push(format!("  {which}`{key}` lies on its {end} bound, {}{price}", significant(hit.bound, 4)));
    }
    lines
}
