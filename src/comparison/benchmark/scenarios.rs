//! The systems that methods are tried on, with what each pair is declared to come to.

use super::law_scenarios::laws_on_six;
use super::scenario_parts::{
    ALONE, EXACT, NEAR, NOTHING, RECEPTANCE, TO_GROUND, UNCLOSED, UNSTABLE, harmonics, of_six, range, six, six_under, tuned, uniform,
};
use super::stability::Outcome::{Refused, Right, Rough, Wrong};
use super::stability::Scenario;
use crate::absorber::{Mounted, Tuned, Undamped, Viscous};
use crate::drivetrain::{Chain, Joint, Station, System};
use crate::numerics::C64;
use crate::numerics::elementary::ComplexElementary;
use crate::response::Quantity;
use crate::units::RAD_PER_S_PER_RPM;

/// Angle of the first of `n` equal inertias in a row (inertia, stiffness between, damping to ground), per torque on it: cosh(mu (n - 1/2))/(2 k sinh(mu n) sinh(mu/2)),
/// with 2 cosh(mu) = 2 + (i w c - w² J)/k. Written with decaying exponentials.
fn first_of_uniform(n: usize, (inertia, stiffness, damping): (f64, f64, f64), omega: f64, torque: f64) -> C64 {
    let half = (C64::new(-omega * omega * inertia, omega * damping) / (4.0 * stiffness)).square_root();
    // sinh(mu/2) = half, and the branch that decays along the chain
    let mu = 2.0 * (half + (half * half + 1.0).square_root()).logarithm();
    let mu = if mu.re < 0.0 { -mu } else { mu };
    let n = n as f64;
    let (one, decay) = (C64::from(1.0), |x: f64| (-mu * x).exponential());
    torque * decay(0.5) * (one + decay(2.0 * n - 1.0))
        / (stiffness * ((0.5 * mu).exponential() - (-0.5 * mu).exponential()) * (one - decay(2.0 * n)))
}

/// The in-line six with another chain.
fn changed(change: impl Fn(&mut Chain)) -> System {
    let base = six();
    let mut chain = base.chain.clone();
    change(&mut chain);
    System::new(chain, base.excitation)
}

/// The in-line six with a camshaft of two stations behind a gear of -1/2, and a pump behind one of 3/2, both on the second station.
fn branched() -> System {
    let base = six();
    let row = &base.chain.stations;
    let side = |name: &str, inertia: f64, stiffness: f64| Station {
        name: name.into(),
        inertia,
        stiffness_to_next: stiffness,
        damping_to_next: 0.5,
        ..Station::default()
    };
    // the pulley, the camshaft, the pump, then the row from the second station on
    let mut stations = vec![row[0].clone(), side("cam end", 0.004, 4e3), side("cam gear", 0.01, 9e4), side("pump", 0.006, 2e4)];
    stations.extend_from_slice(&row[1..]);
    for (from, leads_to, gear) in [(0, 4, 1.0), (2, 4, -0.5), (3, 4, 1.5)] {
        stations[from].joint = Some(Box::new(Joint { leads_to, gear }));
    }
    System::new(Chain { stations }, base.excitation)
}

/// All scenarios.
pub fn scenarios() -> Vec<Scenario> {
    [absorbers_of_six(), laws_on_six(), changed_chains(), trees(), small_and_long_chains()].concat()
}

/// The in-line six with absorbers of every kind.
fn absorbers_of_six() -> Vec<Scenario> {
    let second = six().modes.omega[2];
    let parallel = vec![Mounted::on_station(0, Tuned { ring_inertia: 0.03, stiffness: 50e3, damping: 10.0 }); 2];
    vec![
        of_six("no absorber", six(), vec![], ALONE),
        of_six("tuned absorber", six(), vec![tuned()], [EXACT, RECEPTANCE, Wrong(0.1), Rough, Rough, NEAR, Wrong(0.1), EXACT]),
        of_six(
            "viscous absorber",
            six(),
            vec![Mounted::on_station(0, Viscous { ring_inertia: 0.076, damping: 105.1 })],
            [EXACT, RECEPTANCE, Rough, Rough, Rough, NEAR, Wrong(0.5), EXACT],
        ),
        of_six(
            "two equal rings side by side",
            six(),
            parallel,
            [EXACT, RECEPTANCE, Refused("it takes one absorber"), Rough, Rough, NEAR, Wrong(0.1), EXACT],
        ),
        Scenario {
            speeds: range(3000.0, 3200.0),
            in_time: [Rough; 4],
            ..of_six(
                "small ring, the second mode rules",
                six_under(&[(24, 300.0)]),
                vec![Mounted::on_station(0, Tuned { ring_inertia: 0.0076, stiffness: 0.0076 * second * second, damping: 3.0 })],
                [EXACT, RECEPTANCE, Wrong(0.5), Wrong(0.5), Rough, Rough, Wrong(0.1), EXACT],
            )
        },
        of_six(
            "ring without damper",
            six(),
            vec![Mounted::on_station(0, Undamped { ring_inertia: 0.02, stiffness: 60e3 })],
            [EXACT, RECEPTANCE, Wrong(0.2), Wrong(0.1), Rough, NEAR, Rough, EXACT],
        ),
        of_six(
            "ring held by nothing",
            six(),
            vec![Mounted::on_station(0, Tuned { ring_inertia: 0.076, stiffness: 0.0, damping: 0.0 })],
            ALONE,
        ),
    ]
}

/// Absorbers out of all proportion, and chains with odd links.
fn changed_chains() -> Vec<Scenario> {
    let lossy = changed(|c| c.stations[..7].iter_mut().for_each(|s| s.loss_factor_to_next = 0.02));
    let damper = changed(|c| (c.stations[6].stiffness_to_next, c.stations[6].damping_to_next) = (0.0, 500.0));
    let cut = changed(|c| c.stations[6].stiffness_to_next = 0.0);
    let mut massless = six();
    massless.chain.stations[3].inertia = 0.0;
    let massless = System::new(massless.chain, massless.excitation);
    vec![
        Scenario {
            in_time: [Refused("a body has no inertia"); 4],
            ..of_six(
                "a station without inertia",
                massless,
                vec![tuned()],
                [EXACT, RECEPTANCE, Wrong(0.2), Rough, Rough, Rough, Wrong(0.1), EXACT],
            )
        },
        Scenario {
            name: "one station, free",
            system: System::new(uniform(1, 1.0, 0.0, 0.0), harmonics(&[(1, 1.0), (2, 0.5)])),
            design: vec![Mounted::on_station(0, Viscous { ring_inertia: 0.1, damping: 3.0 })],
            quantity: TO_GROUND,
            speeds: range(500.0, 1500.0),
            known: None,
            declared: [EXACT, RECEPTANCE, Refused("no elastic mode"), EXACT, EXACT, EXACT, Rough, EXACT],
            in_time: [NEAR; 4],
        },
        of_six(
            "loose ring, 1e-12 of an inertia",
            six(),
            vec![Mounted::on_station(0, Tuned { ring_inertia: 1e-12, stiffness: 1e-7, damping: 1e-10 })],
            ALONE,
        ),
        of_six(
            "heavy ring, 1000 kg m²",
            six(),
            vec![Mounted::on_station(0, Tuned { ring_inertia: 1e3, stiffness: 158e3, damping: 34.2 })],
            [EXACT, RECEPTANCE, Wrong(0.5), Rough, Rough, Rough, Wrong(0.1), EXACT],
        ),
        Scenario {
            in_time: [UNCLOSED, UNSTABLE, UNSTABLE, NEAR],
            ..of_six(
                "spring of 1e12 N m/rad",
                six(),
                vec![Mounted::on_station(0, Tuned { ring_inertia: 0.076, stiffness: 1e12, damping: 0.0 })],
                [Right(1e-6), Right(1e-6), Wrong(0.1), Rough, Rough, NEAR, Rough, Right(1e-6)],
            )
        },
        Scenario {
            in_time: [Refused("loss factors have no meaning"); 4],
            ..of_six("loss factors", lossy, vec![tuned()], [EXACT, RECEPTANCE, Wrong(0.1), Rough, Rough, NEAR, Wrong(0.1), EXACT])
        },
        Scenario {
            quantity: Quantity::Twist { from: 0, to: Some(6) },
            ..of_six("a damper for a link", damper, vec![], [EXACT, RECEPTANCE, Wrong(0.5), Wrong(0.1), Rough, Rough, Wrong(0.5), EXACT])
        },
        Scenario {
            quantity: Quantity::Twist { from: 0, to: Some(6) },
            ..of_six(
                "a link of nothing",
                cut,
                vec![],
                [EXACT, RECEPTANCE, Wrong(0.1), Rough, Rough, Rough, Wrong(0.1), Refused("neither stiffness nor damping")],
            )
        },
    ]
}

/// Branches and gears.
fn trees() -> Vec<Scenario> {
    vec![Scenario {
        quantity: Quantity::Twist { from: 0, to: Some(10) },
        in_time: [Refused("geared shafts"); 4],
        ..of_six(
            "branches and gears",
            branched(),
            vec![tuned(), Mounted::on_station(1, Viscous { ring_inertia: 0.004, damping: 3.0 })],
            [EXACT, RECEPTANCE, Refused("one absorber"), Wrong(0.5), Wrong(0.1), Rough, Wrong(0.5), Refused("no branches, no gears")],
        )
    }]
}

/// Few stations with a solution in closed form, and many.
fn small_and_long_chains() -> Vec<Scenario> {
    let mut one = uniform(1, 1.0, 0.0, 2.0);
    one.stations[0].stiffness_to_ground = 1e4;
    let mut halves = uniform(4, 0.1, 1e6, 20.0);
    halves.stations[1].stiffness_to_next = 1e2;
    let long = vec![2000.0, 7000.0, 11_000.0];
    let mut pole = uniform(1, 1.0, 0.0, 0.0);
    pole.stations[0].stiffness_to_ground = (1200.0 * RAD_PER_S_PER_RPM).powi(2);
    vec![
        Scenario {
            name: "Den Hartog's two masses",
            system: System::new(one, harmonics(&[(1, 1.0)])),
            design: vec![Mounted::on_station(0, Tuned { ring_inertia: 0.1, stiffness: 826.0, damping: 3.0 })],
            quantity: TO_GROUND,
            speeds: range(500.0, 1500.0),
            known: None,
            declared: [EXACT, RECEPTANCE, EXACT, EXACT, EXACT, EXACT, Wrong(0.5), EXACT],
            in_time: [NEAR; 4],
        },
        Scenario {
            name: "close modes",
            system: System::new(halves, harmonics(&[(1, 100.0), (2, 50.0)])),
            design: vec![],
            quantity: Quantity::Twist { from: 0, to: Some(1) },
            speeds: range(30_000.0, 60_000.0),
            known: None,
            declared: [EXACT, RECEPTANCE, Wrong(0.3), Wrong(0.3), Wrong(0.3), EXACT, EXACT, Refused("holzer loses digits")],
            in_time: [NEAR; 4],
        },
        Scenario {
            name: "100 stations, far above resonance",
            system: System::new(uniform(100, 0.01, 1e5, 0.5), harmonics(&[(1, 100.0)])),
            design: vec![],
            quantity: Quantity::Twist { from: 0, to: Some(99) },
            speeds: vec![100_000.0, 120_000.0],
            known: None,
            declared: [EXACT, RECEPTANCE, Wrong(0.5), Wrong(0.5), Wrong(0.5), Wrong(0.5), Right(1e-6), Refused("holzer loses digits")],
            in_time: [NEAR; 4],
        },
        Scenario {
            name: "400 stations",
            system: System::new(uniform(400, 0.01, 1e5, 0.5), harmonics(&[(1, 100.0)])),
            design: vec![],
            quantity: TO_GROUND,
            speeds: long.clone(),
            known: Some(long.iter().map(|s| first_of_uniform(400, (0.01, 1e5, 0.5), s * RAD_PER_S_PER_RPM, 100.0)).collect()),
            declared: [EXACT, EXACT, Wrong(0.5), Wrong(0.5), Wrong(0.5), Wrong(0.5), Right(1e-9), EXACT],
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
            in_time: [UNCLOSED, UNSTABLE, UNSTABLE, NEAR],
        },
        Scenario {
            name: "undamped resonance, met exactly",
            system: System::new(pole, harmonics(&[(1, 1.0)])),
            design: vec![],
            quantity: TO_GROUND,
            speeds: vec![1200.0],
            known: None,
            declared: [NOTHING; 8],
            in_time: [NOTHING; 4],
        },
    ]
}
