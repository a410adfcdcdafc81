//! An absorber law of one's own: a centrifugal pendulum, tuned to an order instead of a frequency.
//!
//! A point mass m on a circle of radius r about a point at R from the axis has, for small motion, the restoring stiffness of a ring of inertia
//! J = m (R + r)² on a spring k = J n² Omega², with the order n = sqrt(R/r) [Den Hartog 1956, section 5.7]. It holds a station still at order n, at every
//! speed.
//!
//! `cargo run --release --example own_law`

use hartog::Study;
use hartog::absorber::parameter::{DAMPING, RING_INERTIA};
use hartog::absorber::{Declaration, Law, Mounted, Operating, Parameter, Range};
use hartog::numerics::C64;
use std::sync::Arc;

/// A pendulum as the ring that moves like it.
#[derive(Debug, Clone, Copy)]
pub struct Pendulum {
    /// m (R + r)², kg m².
    pub ring_inertia: f64,
    /// sqrt(R/r).
    pub tuning_order: f64,
    /// N m s/rad.
    pub damping: f64,
}

/// What hartog is told of it.
pub static PENDULUM: Declaration = Declaration {
    name: "pendulum",
    parameters: &[
        RING_INERTIA,
        Parameter {
            key: "tuning_order",
            label: "order",
            range: Range::Positive,
            extensive: false,
            dissipative: false,
            bounds: |_| (0.5, 12.0),
            typical: |_| 3.0,
        },
        DAMPING,
    ],
    build: |v| Arc::new(Pendulum { ring_inertia: v[0], tuning_order: v[1], damping: v[2] }),
    closed_forms: &[],
};

impl Law for Pendulum {
    fn declaration(&self) -> &'static Declaration {
        &PENDULUM
    }
    fn values(&self) -> Vec<f64> {
        vec![self.ring_inertia, self.tuning_order, self.damping]
    }
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn dynamic_stiffness(&self, at: Operating) -> C64 {
        let stiffness = self.ring_inertia * (self.tuning_order * at.shaft_speed).powi(2);
        C64::new(stiffness, at.omega * self.damping)
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        let tuned = (self.tuning_order * at.shaft_speed).powi(2);
        vec![C64::from(tuned), C64::from(2.0 * self.ring_inertia * tuned / self.tuning_order), C64::new(0.0, at.omega)]
    }
    fn depends_on_speed(&self) -> bool {
        true
    }
}

pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let study = Study::read("studies/villalva_i6.toml")?;
    let free_end = study.chain.find("pulley").ok_or("the study has no such station")?;
    let pendulum = |order: f64| Mounted::on_station(free_end, Pendulum { ring_inertia: 0.02, tuning_order: order, damping: 0.05 });
    for (name, design) in [("none", vec![]), ("order 3", vec![pendulum(3.0)]), ("orders 3 and 6", vec![pendulum(3.0), pendulum(6.0)])] {
        let twist = study.evaluate(name, design)?.twist.ok_or("nothing excites the chain")?;
        println!("{name}: peak twist {:.4}° at {:.0} rpm", twist.value.to_degrees(), twist.speed_rpm);
    }
    Ok(())
}
