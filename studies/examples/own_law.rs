//! An absorber law of one's own: a ring that magnets hold across an air gap, damped by eddy currents.
//!
//! The magnets are a spring of stiffness k. A copper sleeve between them drags like a damper c while its currents follow the motion, and like a spring of stiffness c R/L once they
//! cannot: S = k + i omega c/(1 + i omega L/R), with the resistance R and the inductance L of the sleeve.
//!
//! `cargo run --release --example own_law`

use hartog::Study;
use hartog::absorber::parameter::{DAMPING, RING_INERTIA, STIFFNESS};
use hartog::absorber::{Declaration, Follows, Law, Mounted, Operating, Parameter, Range};
use hartog::numerics::C64;
use std::sync::Arc;

/// Ring on magnets.
#[derive(Debug, Clone, Copy)]
pub struct Magnetic {
    /// kg m².
    pub ring_inertia: f64,
    /// N m/rad.
    pub stiffness: f64,
    /// N m s/rad.
    pub damping: f64,
    /// L/R, s.
    pub time_constant: f64,
}

/// What hartog is told of it.
pub static MAGNETIC: Declaration = Declaration {
    name: "magnetic",
    about: "A ring on magnets with eddy currents.",
    parameters: &[
        RING_INERTIA,
        STIFFNESS,
        DAMPING,
        Parameter {
            key: "time_constant_s",
            label: "L/R/s",
            about: "Time constant of the eddy currents.",
            range: Range::NotNegative,
            extensive: false,
            dissipative: false,
            material: true,
            follows: Follows::Nothing,
            bounds: |_| (0.0, 0.1),
            typical: |_| 1e-3,
        },
    ],
    build: |v| Arc::new(Magnetic { ring_inertia: v[0], stiffness: v[1], damping: v[2], time_constant: v[3] }),
    closed_forms: &[],
};

impl Law for Magnetic {
    fn declaration(&self) -> &'static Declaration {
        &MAGNETIC
    }
    fn values(&self) -> Vec<f64> {
        vec![self.ring_inertia, self.stiffness, self.damping, self.time_constant]
    }
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn dynamic_stiffness(&self, at: Operating) -> C64 {
        self.stiffness + C64::new(0.0, at.omega * self.damping) / C64::new(1.0, at.omega * self.time_constant)
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        let lag = C64::new(1.0, at.omega * self.time_constant);
        let by_time = at.omega * at.omega * self.damping / (lag * lag);
        vec![C64::default(), C64::from(1.0), C64::new(0.0, at.omega) / lag, by_time]
    }
}

pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let study = Study::read("studies/villalva_i6.toml")?;
    let free_end = study.chain.find("pulley").ok_or("the study has no such station")?;
    let ring = |time_constant: f64| {
        Mounted::on_station(free_end, Magnetic { ring_inertia: 0.076, stiffness: 1.0e5, damping: 60.0, time_constant })
    };
    for (name, design) in [("none", vec![]), ("currents that follow", vec![ring(0.0)]), ("currents that lag by 1 ms", vec![ring(1e-3)])] {
        let twist = study.evaluate(name, design)?.twist.ok_or("nothing excites the chain")?;
        println!("{name}: peak twist {:.4}° at {:.0} rpm", twist.value.to_degrees(), twist.speed_rpm);
    }
    Ok(())
}
