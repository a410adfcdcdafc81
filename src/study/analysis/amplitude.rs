//! Amplitude of one order near a published or measured speed.

use crate::absorber::Mounted;
use crate::engine::Order;
use crate::input::Study;
use crate::numerics::maximise::maximise;
use crate::response::{Direct, Quantity, ResponseError, Work};

/// Half-width of the window in which a peak is looked for, as a share of the speed: the printed speeds follow from natural frequencies, not
/// from the curves, and a damped peak lies below.
#[doc(hidden)]
pub const WINDOW: f64 = 0.03;
/// Points over the window before the largest is refined.
const POINTS: usize = 12;

/// A peak near a speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Near {
    /// Zero to peak, rad.
    pub amplitude: f64,
    /// Where, rpm.
    pub speed_rpm: f64,
}

/// Largest amplitude of an order at the hub of the study within `WINDOW` of a speed and the range of the study; `None` where that is
/// empty or the torque has no such order.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance met exactly.
pub fn near(
    study: &Study,
    direct: &Direct,
    design: &[Mounted],
    order: Order,
    speed_rpm: f64,
    work: &mut Work,
) -> Result<Option<Near>, ResponseError> {
    let (first, last) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let (low, high) = ((speed_rpm * (1.0 - WINDOW)).max(first), (speed_rpm * (1.0 + WINDOW)).min(last));
    let Some(order) = direct.system.excitation.orders.iter().position(|o| *o == order).filter(|_| low <= high) else { return Ok(None) };
    let hub = Quantity::Twist { from: study.hub, to: None };
    let speed_at = |i: usize| low + (high - low) * i as f64 / POINTS as f64;
    let mut value = |speed: f64| direct.order_at(design, hub, order, speed, work).map(|y| y.norm());
    let mut best = (0, f64::NEG_INFINITY);
    for i in 0..=POINTS {
        let v = value(speed_at(i))?;
        if v > best.1 {
            best = (i, v);
        }
    }
    let (speed, refined) = maximise(speed_at(best.0.max(1) - 1), speed_at((best.0 + 1).min(POINTS)), value)?;
    let (amplitude, speed_rpm) = if refined > best.1 { (refined, speed) } else { (best.1, speed_at(best.0)) };
    Ok(Some(Near { amplitude, speed_rpm }))
}
