//! The law behind a drawing: that of what carries the ring, as strong as the drawing makes it.

use super::shape::Shape;
use crate::absorber::dynamic_stiffness::Operating;
use crate::absorber::law::Law;
use crate::absorber::parts::Medium;
use crate::absorber::{Carreau, FractionalZener, Pendulum, SpringPack, Tuned};
use crate::numerics::{C64, ImaginaryPower};
use crate::units::PA_PER_MPA;

/// The law of what carries the ring; of rubber and oil with the power of the frequency in it: one point costs less by it.
#[derive(Debug, Clone)]
pub(super) enum Own {
    Rubber(FractionalZener, ImaginaryPower),
    Oil(Carreau, ImaginaryPower),
    Leaves(SpringPack),
    Coils(Tuned),
    Pendulums(Pendulum),
}

impl Own {
    /// Of a shape with these values, whose drawing comes to this factor.
    pub fn new(shape: &Shape, values: &[f64], factor: f64) -> Self {
        let ring_inertia = values[0];
        let of = |i: usize| values[shape.dimensions + i];
        match shape.medium {
            Medium::Rubber => {
                let (glass_ratio, relaxation_time, exponent) = (of(1), of(2), of(3));
                let stiffness = factor * of(0) * PA_PER_MPA;
                let law = FractionalZener { ring_inertia, stiffness, glass_ratio, relaxation_time, exponent };
                Self::Rubber(law, ImaginaryPower::new(exponent))
            }
            Medium::Oil => {
                let (relaxation_time, transition, flow_index) = (of(1), of(2), of(3));
                let law = Carreau { ring_inertia, damping: factor * of(0), relaxation_time, transition, flow_index };
                Self::Oil(law, ImaginaryPower::new(transition))
            }
            Medium::Leaves => {
                let (damping_factor, dynamic_ratio, reference_frequency) = (of(0), of(1), of(2));
                Self::Leaves(SpringPack { ring_inertia, stiffness: factor, damping_factor, dynamic_ratio, reference_frequency })
            }
            Medium::Coils => Self::Coils(Tuned { ring_inertia, stiffness: factor, damping: of(0) }),
            // studies refuse a path that tunes to no order; tolerances may come to one
            Medium::Field => Self::Pendulums(Pendulum { ring_inertia, tuning_order: factor.max(0.0).sqrt(), damping: of(0) }),
        }
    }

    pub fn law(&self) -> &dyn Law {
        match self {
            Self::Rubber(law, _) => law,
            Self::Oil(law, _) => law,
            Self::Leaves(law) => law,
            Self::Coils(law) => law,
            Self::Pendulums(law) => law,
        }
    }

    pub fn dynamic_stiffness(&self, at: Operating) -> C64 {
        match self {
            Self::Rubber(law, power) => law.stiffness_of(power.branchless(at.omega * law.relaxation_time)),
            Self::Oil(law, power) => law.stiffness_of(at.omega, power.of(at.omega * law.relaxation_time)),
            Self::Leaves(law) => law.dynamic_stiffness(at),
            Self::Coils(law) => law.dynamic_stiffness(at),
            Self::Pendulums(law) => law.dynamic_stiffness(at),
        }
    }

    /// Derivatives of S by the values, from that of the factor by each dimension.
    pub fn derivatives(&self, at: Operating, (shape, values): (&Shape, &[f64]), factor: (f64, &[f64])) -> Vec<C64> {
        let own = self.law().derivatives(at);
        // what is sheared has a modulus or viscosity, by which the factor is multiplied
        let by_strength = |unit: f64| Some(own[1] * factor.0 * unit);
        let (by_factor, by_strength) = match self {
            Self::Rubber(..) => (own[1] * values[shape.dimensions] * PA_PER_MPA, by_strength(PA_PER_MPA)),
            Self::Oil(..) => (own[1] * values[shape.dimensions], by_strength(1.0)),
            Self::Leaves(_) | Self::Coils(_) => (own[1], None),
            // S is proportional to the square of the order
            Self::Pendulums(law) if law.tuning_order == 0.0 => (C64::ZERO, None),
            Self::Pendulums(_) => (C64::from(values[0] * at.shaft_speed * at.shaft_speed), None),
        };
        let mut list: Vec<C64> = factor.1.iter().take(shape.dimensions).map(|d| by_factor * d).collect();
        list[0] += own[0];
        list.into_iter().chain(by_strength).chain(own[2..].iter().copied()).collect()
    }
}
