//! What scenarios are made of: chains, torques, the in-line six, and what is declared again and again.

use super::stability::Outcome::{self, Refused, Right, Rough};
use super::stability::{RIGHT, Scenario};
use crate::absorber::{Mounted, Tuned};
use crate::drivetrain::{Chain, Station, System};
use crate::engine::HarmonicTable;
use crate::engine::{Engine, Excitation, Layout, Order, Source};
use crate::numerics::C64;
use crate::response::Quantity;

/// Receptance is exact, but near resonances of the chain alone it may cancel up to 1e5 roundings.
pub(super) const EXACT: Outcome = Right(1e-10);
pub(super) const RECEPTANCE: Outcome = Right(1e-9);
pub(super) const NEAR: Outcome = Right(RIGHT);
/// 720 steps a cycle: 30 a period of the highest order, and more than the highest mode allows at the lowest speed.
pub(super) const UNSTABLE: Outcome = Refused("is unstable");
pub(super) const UNCLOSED: Outcome = Refused("does not close");
pub(super) const NOTHING: Outcome = Refused("resonance without damping");
pub(super) const ALONE: [Outcome; 8] = [EXACT, RECEPTANCE, Rough, Rough, Rough, NEAR, Rough, EXACT];
pub(super) const TO_GROUND: Quantity = Quantity::Twist { from: 0, to: None };

pub(super) fn uniform(n: usize, inertia: f64, stiffness: f64, damping_to_ground: f64) -> Chain {
    let station = |i: usize| Station {
        name: format!("s{i}"),
        inertia,
        stiffness_to_next: if i + 1 < n { stiffness } else { 0.0 },
        damping_to_ground,
        throws: if i == 0 { vec![0] } else { Vec::new() },
        ..Station::default()
    };
    Chain { stations: (0..n).map(station).collect() }
}

/// One throw under given harmonics (order, torque amplitude) of a two-stroke.
pub(super) fn harmonics(list: &[(u32, f64)]) -> Excitation {
    let table = HarmonicTable {
        harmonics: list.iter().map(|(o, a)| (Order::from_twice(2 * o), C64::from(*a))).collect(),
        ..HarmonicTable::default()
    };
    let layout = Layout { rods_per_throw: 1, firing_deg: vec![0.0], bank_angle_deg: None, split_pin_deg: 0.0 };
    Excitation::new(&Engine { name: String::new(), strokes: 2, layout, source: Source::Harmonics(table) }, 200.0)
}

/// Speeds of a scenario.
const SPEEDS: usize = 60;

pub(super) fn range(from: f64, to: f64) -> Vec<f64> {
    (0..SPEEDS).map(|i| from + (to - from) * i as f64 / (SPEEDS - 1) as f64).collect()
}

/// The chain of the in-line six of \[Villalva 2014\], Table 4.7, with 9 N m s/rad on every throw, under three orders on throws that fire evenly.
pub(super) fn six() -> System {
    six_under(&[(3, 900.0), (9, 600.0), (12, 300.0)])
}

/// The same under given harmonics (twice the order, torque amplitude).
pub(super) fn six_under(table: &[(u32, f64)]) -> System {
    let inertia = [0.0527, 0.0334, 0.0125, 0.0326, 0.0326, 0.014, 0.0339, 1.165];
    let stiffness = [808e3, 1.27e6, 1.27e6, 1.31e6, 1.27e6, 1.36e6, 2.1e6, 0.0];
    let station = |i: usize| Station {
        name: format!("s{i}"),
        inertia: inertia[i],
        stiffness_to_next: stiffness[i],
        damping_to_ground: if (1..7).contains(&i) { 9.0 } else { 0.0 },
        throws: if (1..7).contains(&i) { vec![i - 1] } else { Vec::new() },
        ..Station::default()
    };
    let source = HarmonicTable {
        harmonics: table.iter().map(|(twice, a)| (Order::from_twice(*twice), C64::from(*a))).collect(),
        ..HarmonicTable::default()
    };
    let layout =
        Layout { rods_per_throw: 1, firing_deg: vec![0.0, 480.0, 240.0, 600.0, 120.0, 360.0], bank_angle_deg: None, split_pin_deg: 0.0 };
    let engine = Engine { name: String::new(), strokes: 4, layout, source: Source::Harmonics(source) };
    System::new(Chain { stations: (0..8).map(station).collect() }, Excitation::new(&engine, 12.0))
}

/// The absorber of the thesis on the first station.
pub(super) fn tuned() -> Mounted {
    Mounted::on_station(0, Tuned { ring_inertia: 0.076, stiffness: 158e3, damping: 34.2 })
}

/// A scenario on the in-line six.
pub(super) fn of_six(name: &'static str, system: System, design: Vec<Mounted>, declared: [Outcome; 8]) -> Scenario {
    Scenario {
        name,
        system,
        design,
        quantity: Quantity::Twist { from: 0, to: Some(7) },
        speeds: range(600.0, 3200.0),
        known: None,
        declared,
        in_time: [Rough, UNSTABLE, UNSTABLE, NEAR],
    }
}
