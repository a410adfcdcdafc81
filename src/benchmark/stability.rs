//! Where methods fail: every method on every scenario, with the outcome each pair declares.
//!
//! The reference is the dense LU of the whole system, or a solution in closed form. The same limits hold for every pair: right within a thousandth (closer where a method is
//! exact), rough within a tenth, wrong beyond. What a pair comes to must be what is declared of it; anything else is a defect.

use super::methods::Candidate;
use crate::absorber::{Mounted, Tuned, Undamped, Viscous};
use crate::drivetrain::{Chain, Station, System};
use crate::engine::excitation::HarmonicTable;
use crate::engine::{Engine, Excitation, Layout, Order, Source};
use crate::numerics::C64;
use crate::response::{Dense, Grid, Quantity, Response, ResponseError, Work};
use crate::units::RAD_PER_S_PER_RPM;

/// What a method is declared to make of a scenario; errors are the largest difference over the largest value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outcome {
    /// Within this error, at most [`RIGHT`].
    Right(f64),
    /// Between [`RIGHT`] and [`ROUGH`].
    Rough,
    /// An error that says this.
    Refused(&'static str),
    /// Off by at least this, at least [`ROUGH`], and known to be.
    Wrong(f64),
}
use Outcome::{Refused, Right, Rough, Wrong};

/// Largest error of a right answer: the default tolerance of a study.
pub const RIGHT: f64 = 1e-3;
/// Largest error of a rough one.
pub const ROUGH: f64 = 0.1;

/// A system with a known solution.
#[derive(Debug, Clone)]
pub struct Scenario {
    /// In a few words.
    pub name: &'static str,
    /// Chain and torque.
    pub system: System,
    /// Absorbers.
    pub design: Vec<Mounted>,
    /// A twist.
    pub quantity: Quantity,
    /// rpm.
    pub speeds: Vec<f64>,
    /// Phasors speed by speed, where they are known without a solution; else the dense LU is the reference.
    pub known: Option<Vec<C64>>,
    /// Declared for the methods in frequency of [`Candidate::ALL`], but the reference.
    pub declared: [Outcome; 8],
    /// Declared for those in time: average and linear acceleration, central difference, exponential.
    pub in_time: [Outcome; 4],
}

/// What a method made of a scenario.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// The method.
    pub candidate: Candidate,
    /// As declared.
    pub declared: Outcome,
    /// Error found, or the refusal.
    pub found: Result<f64, ResponseError>,
}

impl Cell {
    /// What it came to, whatever was declared: right, rough, wrong or refused.
    pub fn word(&self) -> &'static str {
        match &self.found {
            Err(_) => "refused",
            Ok(e) if *e <= RIGHT => "right",
            Ok(e) if *e <= ROUGH => "rough",
            Ok(_) => "wrong",
        }
    }

    /// Whether it came as declared.
    pub fn as_declared(&self) -> bool {
        match (&self.declared, &self.found) {
            (Right(tolerance), Ok(e)) => *e <= tolerance.min(RIGHT),
            (Rough, Ok(_)) => self.word() == "rough",
            (Wrong(least), Ok(e)) => *e >= least.max(ROUGH),
            (Refused(words), Err(e)) => e.to_string().contains(words),
            _ => false,
        }
    }
}

impl Scenario {
    /// Every method on it.
    pub fn cells(&self) -> Vec<Cell> {
        let grid = Grid::new(&self.speeds, &[]);
        let mut exact = Vec::new();
        let reference = match &self.known {
            Some(known) => {
                exact.clone_from(known);
                Ok(())
            }
            None => Dense::new(&self.system, &grid).sweep(&self.design, self.quantity, &mut exact, &mut Work::default()),
        };
        let largest = exact.iter().map(|y| y.norm()).fold(0.0, f64::max);
        let error = |candidate: Candidate| -> Result<f64, ResponseError> {
            let Some(method) = candidate.build(&self.system, &grid, &self.design, self.quantity) else {
                return Err(ResponseError::NotApplicable { method: candidate.method(), why: "there is no elastic mode" });
            };
            let mut found = Vec::new();
            method.sweep(&self.design, self.quantity, &mut found, &mut Work::default())?;
            reference?;
            let difference = found.iter().zip(&exact).map(|(a, b)| (a - b).norm());
            // the largest that is not a number is not a number
            Ok(difference.fold(0.0, |m: f64, d| if d > m || d.is_nan() { d } else { m }) / largest)
        };
        let pairs = Candidate::ALL.into_iter().zip(self.declared.into_iter().chain(self.in_time));
        pairs.map(|(candidate, declared)| Cell { candidate, declared, found: error(candidate) }).collect()
    }
}

fn uniform(n: usize, inertia: f64, stiffness: f64, damping_to_ground: f64) -> Chain {
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
fn harmonics(list: &[(u32, f64)]) -> Excitation {
    let table = HarmonicTable { harmonics: list.iter().map(|(o, a)| (Order::from_twice(2 * o), C64::from(*a))).collect() };
    let layout = Layout { rods_per_throw: 1, firing_deg: vec![0.0], bank_angle_deg: None };
    Excitation::new(&Engine { name: String::new(), strokes: 2, layout, source: Source::Harmonics(table) }, 200.0)
}

/// Speeds of a scenario.
const SPEEDS: usize = 60;

fn range(from: f64, to: f64) -> Vec<f64> {
    (0..SPEEDS).map(|i| from + (to - from) * i as f64 / (SPEEDS - 1) as f64).collect()
}

/// The chain of the in-line six of \[Villalva 2014\], Table 4.7, with 9 N m s/rad on every throw, under three orders on throws that fire evenly.
fn six() -> System {
    six_under(&[(3, 900.0), (9, 600.0), (12, 300.0)])
}

/// The same under given harmonics (twice the order, torque amplitude).
fn six_under(table: &[(u32, f64)]) -> System {
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
    let source = HarmonicTable { harmonics: table.iter().map(|(twice, a)| (Order::from_twice(*twice), C64::from(*a))).collect() };
    let layout = Layout { rods_per_throw: 1, firing_deg: vec![0.0, 480.0, 240.0, 600.0, 120.0, 360.0], bank_angle_deg: None };
    let engine = Engine { name: String::new(), strokes: 4, layout, source: Source::Harmonics(source) };
    System::new(Chain { stations: (0..8).map(station).collect() }, Excitation::new(&engine, 12.0))
}

/// Angle of the first of `n` equal inertias in a row (inertia, stiffness between, damping to ground), per torque on it: cosh(mu (n - 1/2))/(2 k sinh(mu n) sinh(mu/2)),
/// with 2 cosh(mu) = 2 + (i w c - w² J)/k. Written with decaying exponentials.
fn first_of_uniform(n: usize, (inertia, stiffness, damping): (f64, f64, f64), omega: f64, torque: f64) -> C64 {
    let half = (C64::new(-omega * omega * inertia, omega * damping) / (4.0 * stiffness)).sqrt();
    // sinh(mu/2) = half, and the branch that decays along the chain
    let mu = 2.0 * (half + (half * half + 1.0).sqrt()).ln();
    let mu = if mu.re < 0.0 { -mu } else { mu };
    let n = n as f64;
    let (one, decay) = (C64::from(1.0), |x: f64| (-mu * x).exp());
    torque * decay(0.5) * (one + decay(2.0 * n - 1.0)) / (2.0 * stiffness * (0.5 * mu).sinh() * (one - decay(2.0 * n)))
}

/// All scenarios.
pub fn scenarios() -> Vec<Scenario> {
    // receptance is exact, but near resonances of the chain alone it may cancel up to 1e5 roundings
    let (exact, receptance, near) = (Right(1e-10), Right(1e-9), Right(RIGHT));
    // 720 steps a cycle: 30 a period of the highest order, and more than the highest mode allows at the lowest speed
    let (unstable, unclosed) = (Refused("is unstable"), Refused("does not close"));
    let hub = Quantity::Twist { from: 0, to: Some(7) };
    let tuned = Mounted::on_station(0, Tuned { ring_inertia: 0.076, stiffness: 158e3, damping: 34.2 });
    let alone = [exact, receptance, Rough, Rough, Rough, near, Rough, exact];
    let of_six = |name, system: System, design: Vec<Mounted>, declared| Scenario {
        name,
        system,
        design,
        quantity: hub,
        speeds: range(600.0, 3200.0),
        known: None,
        declared,
        in_time: [Rough, unstable, unstable, near],
    };
    let changed = |change: &dyn Fn(&mut Chain)| {
        let base = six();
        let mut chain = base.chain.clone();
        change(&mut chain);
        System::new(chain, base.excitation)
    };
    let lossy = changed(&|c| c.stations[..7].iter_mut().for_each(|s| s.loss_factor_to_next = 0.02));
    let damper = changed(&|c| (c.stations[6].stiffness_to_next, c.stations[6].damping_to_next) = (0.0, 500.0));
    let cut = changed(&|c| c.stations[6].stiffness_to_next = 0.0);
    let mut one = uniform(1, 1.0, 0.0, 2.0);
    one.stations[0].stiffness_to_ground = 1e4;
    let mut halves = uniform(4, 0.1, 1e6, 20.0);
    halves.stations[1].stiffness_to_next = 1e2;
    let mut massless = six();
    massless.chain.stations[3].inertia = 0.0;
    let massless = System::new(massless.chain, massless.excitation);
    let second = six().modes.omega[2];
    let long = vec![2000.0, 7000.0, 11_000.0];
    let mut pole = uniform(1, 1.0, 0.0, 0.0);
    pole.stations[0].stiffness_to_ground = (1200.0 * RAD_PER_S_PER_RPM).powi(2);
    let to_ground = Quantity::Twist { from: 0, to: None };
    let nothing = Refused("resonance without damping");
    let parallel = vec![Mounted::on_station(0, Tuned { ring_inertia: 0.03, stiffness: 50e3, damping: 10.0 }); 2];
    vec![
        of_six("no absorber", six(), vec![], alone),
        of_six("tuned absorber", six(), vec![tuned.clone()], [exact, receptance, Wrong(0.1), Rough, Rough, near, Wrong(0.1), exact]),
        of_six(
            "viscous absorber",
            six(),
            vec![Mounted::on_station(0, Viscous { ring_inertia: 0.076, damping: 105.1 })],
            [exact, receptance, Rough, Rough, Rough, near, Wrong(0.5), exact],
        ),
        of_six(
            "two equal rings side by side",
            six(),
            parallel,
            [exact, receptance, Refused("it takes one absorber"), Rough, Rough, near, Wrong(0.1), exact],
        ),
        Scenario {
            speeds: range(3000.0, 3200.0),
            in_time: [Rough; 4],
            ..of_six(
                "small ring, the second mode rules",
                six_under(&[(24, 300.0)]),
                vec![Mounted::on_station(0, Tuned { ring_inertia: 0.0076, stiffness: 0.0076 * second * second, damping: 3.0 })],
                [exact, receptance, Wrong(0.5), Wrong(0.5), Rough, Rough, Wrong(0.1), exact],
            )
        },
        of_six(
            "ring without damper",
            six(),
            vec![Mounted::on_station(0, Undamped { ring_inertia: 0.02, stiffness: 60e3 })],
            [exact, receptance, Wrong(0.2), Wrong(0.1), Rough, near, Rough, exact],
        ),
        of_six("ring held by nothing", six(), vec![Mounted::on_station(0, Tuned { ring_inertia: 0.076, stiffness: 0.0, damping: 0.0 })], alone),
        Scenario {
            in_time: [Refused("a body has no inertia"); 4],
            ..of_six(
                "a station without inertia",
                massless,
                vec![tuned.clone()],
                [exact, receptance, Wrong(0.2), Rough, Rough, Rough, Wrong(0.1), exact],
            )
        },
        Scenario {
            name: "one station, free",
            system: System::new(uniform(1, 1.0, 0.0, 0.0), harmonics(&[(1, 1.0), (2, 0.5)])),
            design: vec![Mounted::on_station(0, Viscous { ring_inertia: 0.1, damping: 3.0 })],
            quantity: to_ground,
            speeds: range(500.0, 1500.0),
            known: None,
            declared: [exact, receptance, Refused("no elastic mode"), exact, exact, exact, Rough, exact],
            in_time: [near; 4],
        },
        of_six("loose ring, 1e-12 of an inertia", six(), vec![Mounted::on_station(0, Tuned { ring_inertia: 1e-12, stiffness: 1e-7, damping: 1e-10 })], alone),
        of_six(
            "heavy ring, 1000 kg m²",
            six(),
            vec![Mounted::on_station(0, Tuned { ring_inertia: 1e3, stiffness: 158e3, damping: 34.2 })],
            [exact, receptance, Wrong(0.5), Rough, Rough, Rough, Wrong(0.1), exact],
        ),
        Scenario {
            in_time: [unclosed, unstable, unstable, near],
            ..of_six(
                "spring of 1e12 N m/rad",
                six(),
                vec![Mounted::on_station(0, Tuned { ring_inertia: 0.076, stiffness: 1e12, damping: 0.0 })],
                [Right(1e-6), Right(1e-6), Wrong(0.1), Rough, Rough, near, Rough, Right(1e-6)],
            )
        },
        Scenario {
            in_time: [Refused("loss factors have no meaning"); 4],
            ..of_six("loss factors", lossy, vec![tuned.clone()], [exact, receptance, Wrong(0.1), Rough, Rough, near, Wrong(0.1), exact])
        },
        Scenario {
            quantity: Quantity::Twist { from: 0, to: Some(6) },
            ..of_six("a damper for a link", damper, vec![], [exact, receptance, Wrong(0.5), Wrong(0.1), Rough, Rough, Wrong(0.5), exact])
        },
        Scenario {
            quantity: Quantity::Twist { from: 0, to: Some(6) },
            ..of_six(
                "a link of nothing",
                cut,
                vec![],
                [exact, receptance, Wrong(0.1), Rough, Rough, Rough, Wrong(0.1), Refused("neither stiffness nor damping")],
            )
        },
        Scenario {
            name: "Den Hartog's two masses",
            system: System::new(one, harmonics(&[(1, 1.0)])),
            design: vec![Mounted::on_station(0, Tuned { ring_inertia: 0.1, stiffness: 826.0, damping: 3.0 })],
            quantity: to_ground,
            speeds: range(500.0, 1500.0),
            known: None,
            declared: [exact, receptance, exact, exact, exact, exact, Wrong(0.5), exact],
            in_time: [near; 4],
        },
        Scenario {
            name: "close modes",
            system: System::new(halves, harmonics(&[(1, 100.0), (2, 50.0)])),
            design: vec![],
            quantity: Quantity::Twist { from: 0, to: Some(1) },
            speeds: range(30_000.0, 60_000.0),
            known: None,
            declared: [exact, receptance, Wrong(0.3), Wrong(0.3), Wrong(0.3), exact, exact, Refused("holzer loses digits")],
            in_time: [near; 4],
        },
        Scenario {
            name: "100 stations, far above resonance",
            system: System::new(uniform(100, 0.01, 1e5, 0.5), harmonics(&[(1, 100.0)])),
            design: vec![],
            quantity: Quantity::Twist { from: 0, to: Some(99) },
            speeds: vec![100_000.0, 120_000.0],
            known: None,
            declared: [exact, receptance, Wrong(0.5), Wrong(0.5), Wrong(0.5), Wrong(0.5), Right(1e-6), Refused("holzer loses digits")],
            in_time: [near; 4],
        },
        Scenario {
            name: "1000 stations",
            system: System::new(uniform(1000, 0.01, 1e5, 0.5), harmonics(&[(1, 100.0)])),
            design: vec![],
            quantity: to_ground,
            speeds: long.clone(),
            known: Some(long.iter().map(|s| first_of_uniform(1000, (0.01, 1e5, 0.5), s * RAD_PER_S_PER_RPM, 100.0)).collect()),
            declared: [exact, exact, Wrong(0.5), Wrong(0.5), Wrong(0.5), Wrong(0.5), Right(1e-9), exact],
            in_time: [Refused("too large"); 4],
        },
        Scenario {
            name: "stiffness ratio of 1e9",
            system: System::new(
                Chain {
                    stations: (0..4)
                        .map(|i| Station { stiffness_to_next: [1e3, 1e12, 1e6, 0.0][i], ..uniform(4, 0.1, 1.0, 1.0).stations[i].clone() })
                        .collect(),
                },
                harmonics(&[(1, 100.0)]),
            ),
            design: vec![],
            quantity: Quantity::Twist { from: 0, to: Some(3) },
            speeds: range(500.0, 5000.0),
            known: None,
            declared: [Right(1e-6); 8],
            in_time: [unclosed, unstable, unstable, near],
        },
        Scenario {
            name: "undamped resonance, met exactly",
            system: System::new(pole, harmonics(&[(1, 1.0)])),
            design: vec![],
            quantity: to_ground,
            speeds: vec![1200.0],
            known: None,
            declared: [nothing; 8],
            in_time: [nothing; 4],
        },
    ]
}
