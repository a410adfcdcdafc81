//! Evaluates one design on the engine of a shipped study: a tuned absorber on the free end of the in-line six.
//!
//! `cargo run --release --example evaluate`

use hartog::Study;
use hartog::absorber::{Mounted, Tuned};

pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let study = Study::read("studies/villalva_i6.toml")?;
    let free_end = study.chain.find("pulley").ok_or("the study has no such station")?;
    let absorber = Tuned { ring_inertia: 0.076, stiffness: 52e3, damping: 28.0 };
    let design = study.evaluate("mine", vec![Mounted::on_station(free_end, absorber)])?;
    let twist = design.twist.ok_or("nothing excites the chain")?;
    println!("peak twist {:.4}° at {:.0} rpm", twist.value.to_degrees(), twist.speed_rpm);
    println!("frequencies {:.1?} Hz, {:.0} W dissipated at most", &design.frequencies_hz[..3], design.power.unwrap_or(0.0));
    Ok(())
}
