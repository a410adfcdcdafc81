//! How the cost of a sweep grows with stations, orders and speeds.

use super::methods::Candidate;
use super::speed_accuracy::REPEATS;
use crate::absorber::{Mounted, Tuned};
use crate::analysis::Progress;
use crate::analysis::timing::median_seconds;
use crate::drivetrain::{Chain, Joint, Station, System};
use crate::engine::Excitation;
use crate::numerics::C64;
use crate::numerics::elementary::Elementary;
use crate::response::{Grid, Quantity, Work};

/// Cost against a size.
#[derive(Debug, Clone, PartialEq)]
pub struct Growth {
    /// The method.
    pub candidate: Candidate,
    /// Of what: stations, orders or speeds.
    pub size: &'static str,
    /// Size and seconds per sweep of one design.
    pub points: Vec<(f64, f64)>,
    /// Exponent of the cost in the size, fitted to the upper half of the points.
    pub exponent: f64,
}

/// How stations are joined.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Shape {
    Row,
    Tree,
}

/// A chain of alike stations under one throw of a four-stroke with half orders.
fn long_chain(stations: usize, orders: usize, shape: Shape) -> System {
    use crate::engine::HarmonicTable;
    use crate::engine::{Engine, Layout, Order, Source};
    let station = |i: usize| Station {
        name: format!("s{i}"),
        inertia: 0.03,
        stiffness_to_next: if i + 1 < stations { 1.2e6 } else { 0.0 },
        damping_to_ground: 5.0,
        throws: if i == 0 { vec![0] } else { Vec::new() },
        ..Station::default()
    };
    let harmonics = (1..=orders).map(|n| (Order::from_twice(n as u32), C64::from(1e3 / n as f64))).collect();
    let layout = Layout { rods_per_throw: 1, firing_deg: vec![0.0], bank_angle_deg: None, split_pin_deg: 0.0 };
    let engine = Engine {
        name: String::new(),
        strokes: 4,
        layout,
        source: Source::Harmonics(HarmonicTable { harmonics, ..HarmonicTable::default() }),
    };
    let mut chain = Chain { stations: (0..stations).map(station).collect() };
    if shape == Shape::Tree {
        // a row of the even stations with a branch of one station on each, every second behind a gear
        for i in (0..stations.saturating_sub(2)).step_by(2) {
            let joint = |gear: f64| Some(Box::new(Joint { leads_to: i + 2, gear }));
            chain.stations[i].joint = joint(1.0);
            chain.stations[i + 1].joint = joint(if i % 4 == 0 { -2.0 } else { 1.0 });
        }
    }
    System::new(chain, Excitation::new(&engine, orders as f64))
}

/// Sizes of the growth curves: stations, orders, speeds; the others stay at 8, 24 and 200.
const STATIONS: [usize; 7] = [8, 16, 32, 64, 128, 256, 512];
const ORDERS: [usize; 5] = [6, 12, 24, 48, 96];
const COUNTS: [usize; 5] = [50, 100, 200, 400, 800];
/// Chains longer than this are not given to methods whose cost grows faster than the chain.
const LONGEST_DENSE: usize = 64;

/// Stations of a tree instead of a row.
const TREE: &str = "stations of a tree";
/// Sizes of the growth curves, by their names.
#[doc(hidden)]
pub const SIZES: [&str; 4] = ["stations", TREE, "orders", "speeds"];

/// A sweep of the growth curves.
struct Size {
    stations: usize,
    orders: usize,
    speeds: usize,
}

/// Measures how the cost of a sweep grows with stations, orders and speeds.
pub fn growth(progress: &dyn Progress) -> Vec<Growth> {
    let candidates =
        [Candidate::Direct, Candidate::Receptance, Candidate::Reduced(2), Candidate::Modal, Candidate::Holzer, Candidate::Dense];
    let size = |stations, orders, speeds| Size { stations, orders, speeds };
    // fewer points on long chains: the cost of a point is what is asked
    let sweeps: Vec<(&'static str, f64, Size)> = STATIONS
        .iter()
        .map(|n| ("stations", *n as f64, size(*n, 8, 20)))
        .chain(STATIONS.iter().map(|n| (TREE, *n as f64, size(*n, 8, 20))))
        .chain(ORDERS.iter().map(|n| ("orders", *n as f64, size(8, *n, 50))))
        .chain(COUNTS.iter().map(|n| ("speeds", *n as f64, size(8, 24, *n))))
        .collect();
    progress.stage("growth of cost", sweeps.len());
    let mut seconds: Vec<(Candidate, &'static str, f64, f64)> = Vec::new();
    for (what, x, size) in sweeps {
        let system = long_chain(size.stations, size.orders, if what == TREE { Shape::Tree } else { Shape::Row });
        for candidate in candidates {
            let dense = matches!(candidate, Candidate::Dense | Candidate::Modal | Candidate::Reduced(_));
            if !dense || size.stations <= LONGEST_DENSE {
                seconds.extend(sweep_seconds(candidate, &system, size.speeds).map(|s| (candidate, what, x, s)));
            }
        }
        progress.step();
    }
    let mut list = Vec::new();
    for candidate in candidates {
        for size in SIZES {
            let of = seconds.iter().filter(|s| s.0 == candidate && s.1 == size);
            let points: Vec<(f64, f64)> = of.map(|s| (s.2, s.3)).collect();
            if points.len() > 1 {
                list.push(Growth { candidate, size, exponent: exponent(&points), points });
            }
        }
    }
    list
}

/// Seconds of one sweep of one design, set-up aside.
fn sweep_seconds(candidate: Candidate, system: &System, speeds: usize) -> Option<f64> {
    let grid = Grid::new(&(0..speeds).map(|i| 600.0 + 3000.0 * i as f64 / speeds as f64).collect::<Vec<_>>(), &[]);
    let design = [Mounted::on_station(0, Tuned { ring_inertia: 0.02, stiffness: 5e4, damping: 10.0 })];
    let quantity = Quantity::Twist { from: 0, to: Some(system.chain.len() - 1) };
    let method = candidate.build(system, &grid, &design, quantity)?;
    let mut out = Vec::new();
    median_seconds(REPEATS, || method.sweep(&design, quantity, &mut out, &mut Work::default())).ok()
}

/// Slope of the logarithms, by least squares over the upper half of the points: small sizes pay for what does not grow.
fn exponent(points: &[(f64, f64)]) -> f64 {
    let upper: Vec<(f64, f64)> = points[points.len() / 2..].iter().map(|(x, y)| (x.logarithm(), y.logarithm())).collect();
    let upper = if upper.len() < 2 { points.iter().map(|(x, y)| (x.logarithm(), y.logarithm())).collect() } else { upper };
    let n = upper.len() as f64;
    let (mx, my) = (upper.iter().map(|p| p.0).sum::<f64>() / n, upper.iter().map(|p| p.1).sum::<f64>() / n);
    let (sxy, sxx) = upper.iter().fold((0.0, 0.0), |(a, b), p| (a + (p.0 - mx) * (p.1 - my), b + (p.0 - mx).powi(2)));
    sxy / sxx
}
