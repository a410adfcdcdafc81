//! Optimises two absorbers together: on Den Hartog's undamped mass, side by side, with a tenth of its inertia between them.
//!
//! `cargo run --release --example optimise`

use hartog::Study;

const STUDY: &str = r#"
engine = "engines/den_hartog.toml"
speed_rpm = { from = 100, to = 2000, step = 10 }
objective = [{ peak_twist = { from = "engine", to = "ground" } }]
order_limit = 1

[optimise]

[[optimise.absorber]]
on.station = "engine"
types = ["tuned"]
size.ring_inertia_kg_m2.fixed = 0.05

[[optimise.absorber]]
on.station = "engine"
types = ["tuned"]
size.ring_inertia_kg_m2.fixed = 0.05
"#;

pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let results = Study::from_toml(STUDY, "studies/two_rings.toml")?.run()?;
    let best = &results.optima[0].optimum;
    println!("peak twist {:.6}°, KKT residual {:.0e}", best.value().to_degrees(), best.outcome.kkt_residual);
    for (i, mounted) in best.design.iter().enumerate() {
        let value = |key: &str| mounted.absorber.value(key).unwrap_or(f64::NAN);
        let (stiffness, damping) = (value("stiffness_n_m_per_rad"), value("damping_n_m_s_per_rad"));
        println!("ring {}: {stiffness:.3} N m/rad, {damping:.4} N m s/rad", i + 1);
    }
    Ok(())
}
