use hartog::assess;
fn main() {
    let path = std::env::args().nth(1).unwrap();
    let study = match hartog::study::read(std::path::Path::new(&path)) {
        Ok(s) => s,
        Err(e) => {
            eprintln!("{e}");
            std::process::exit(2)
        }
    };
    println!("{:?}", study.modes.frequencies_hz());
    let r = assess::run(&study, &assess::Silent).unwrap();
    let deg = hartog::units::DEG_PER_RAD;
    for d in r.designs.iter().chain(r.optima.iter().map(|o| &o.design)) {
        let t = d.twist.unwrap();
        let o = d.order_twist.unwrap();
        let h = d.order_hub.unwrap();
        println!(
            "{:24} {:?} f {:.1?} twist {:.4} @{:.0} order {:.4} {} @{:.0} hub {:.4} {} @{:.0} tq {:?} P {:?}",
            d.name,
            d.absorbers.first().map(|a| a.absorber),
            &d.frequencies_hz[..d.frequencies_hz.len().min(3)],
            t.value * deg,
            t.speed_rpm,
            o.value * deg,
            r.system.excitation.orders[o.order],
            o.speed_rpm,
            h.value * deg,
            r.system.excitation.orders[h.order],
            h.speed_rpm,
            d.torque.map(|t| t.value),
            d.power
        );
    }
    for o in &r.optima {
        println!(
            "{} kkt {:.2e} it {} {:?} agree {}/{} stages {:?}",
            o.design.name,
            o.optimum.outcome.kkt_residual,
            o.optimum.outcome.iterations,
            o.optimum.outcome.stop,
            o.optimum.agreeing(),
            o.optimum.starts.len(),
            o.optimum.stages.minimax.evaluations
        );
        for s in &o.optimum.starts {
            println!("    {:30} {:.5} {:.6} {:.8}", s.name, s.seed * deg, s.searched * deg, s.finished * deg);
        }
        for row in o.optimum.outcome.rows.rows.iter().take(5) {
            println!("      {:.8} @{:.2} {:?} {:?}", row.value * deg, row.peak.speed_rpm, row.gradient, row.peak.place);
        }
    }
    println!("floor {:?}", r.forced_floor.map(|f| f * deg));
    for t in &r.timing {
        println!("{:20} {:.3} {:?}", t.stage, t.seconds, t.work);
    }
    for f in &r.fronts {
        for p in &f.front.points {
            if p.kkt_residual > 1e-5 {
                println!("  bad {:?} {:.8} kkt {:.2e}", p.design.absorber, p.value * deg, p.kkt_residual);
            }
        }
        println!("{:?} worst kkt {:.1e}", f.kind, f.front.points.iter().map(|p| p.kkt_residual).fold(0.0, f64::max));
    }
}
// debug
