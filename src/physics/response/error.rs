//! Why there is no answer.

use crate::engine::Order;
use crate::units::HZ_PER_RPM;

/// No finite answer.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ResponseError {
    /// Nothing limits the amplitude.
    #[error(
        "resonance without damping: order {order} at {speed_rpm:.1} rpm ({frequency_hz:.2} Hz) has no finite amplitude; give the chain \
         (`damping.fraction_of_critical` of the engine file) or the absorber some damping, or keep the resonance out of the speed range"
    )]
    Unbounded {
        /// The order.
        order: Order,
        /// rpm.
        speed_rpm: f64,
        /// Hz.
        frequency_hz: f64,
    },
    /// An absorber is mounted on nothing.
    #[error("absorber {number} cannot be mounted: {why}")]
    NotMounted {
        /// Its number in the design, from 1.
        number: usize,
        /// Why not.
        why: &'static str,
    },
    /// A method cannot take this system.
    #[error("{method} cannot be used here: {why}")]
    NotApplicable {
        /// Its word.
        method: &'static str,
        /// Why not.
        why: &'static str,
    },
    /// A step in time is too long for the highest mode.
    #[error(
        "{method} is unstable at {speed_rpm:.1} rpm: the highest frequency times the step is {product:.2}, expected below {limit:.3}; take \
         more steps or average acceleration"
    )]
    UnstableStep {
        /// Its word.
        method: &'static str,
        /// Highest circular frequency times the step.
        product: f64,
        /// Where stability ends.
        limit: f64,
        /// rpm.
        speed_rpm: f64,
    },
    /// A method would give an answer with too few digits.
    #[error("{method} loses digits: order {order} at {speed_rpm:.1} rpm cancels by a factor of {factor:.0e}; use the direct method")]
    LostDigits {
        /// Its word.
        method: &'static str,
        /// The order.
        order: Order,
        /// rpm.
        speed_rpm: f64,
        /// How much larger the terms are than their sum.
        factor: f64,
    },
}

impl ResponseError {
    /// At an order and speed.
    #[doc(hidden)]
    pub fn unbounded(order: Order, speed_rpm: f64) -> Self {
        Self::Unbounded { order, speed_rpm, frequency_hz: order.value() * speed_rpm * HZ_PER_RPM }
    }
}
