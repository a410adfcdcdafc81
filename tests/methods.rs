//! Every response method on every problem, with the outcome each pair declares: right within a tolerance, refused by name, or wrong by at least
//! some share. The reference is the dense LU of the whole system with rings as bodies of their own. A new method needs its outcomes only.

use crate::responses::dense;
use crate::support::{on, one_throw, study, system, uniform_chain};
use hartog::absorber::{Kind, Mounted};
use hartog::engine::Excitation;
use hartog::numerics::C64;
use hartog::response::{ClosedForm, Direct, Grid, Holzer, Modal, Quantity, Receptance, Reduced, Response, ResponseError, System, Work};
use hartog::units::RAD_PER_S_PER_RPM;

/// What a method makes of a problem; errors are the largest difference over the largest value.
#[derive(Debug, Clone, Copy)]
enum Outcome {
    /// Within this error.
    Right(f64),
    /// With an error that says this.
    Refused(&'static str),
    /// Off by at least this, and known to be.
    Wrong(f64),
}
use Outcome::{Refused, Right, Wrong};

struct Problem {
    name: &'static str,
    system: System,
    design: Vec<Mounted>,
    quantity: Quantity,
    speeds: Vec<f64>,
    /// Outcome of each of [`METHODS`].
    outcomes: [Outcome; 8],
}

const METHODS: [&str; 8] =
    ["direct", "receptance", "closed_form", "reduced, one mode", "reduced, two modes", "reduced, all modes", "modal", "holzer"];

fn method<'a>(index: usize, system: &'a System, grid: &'a Grid, p: &Problem) -> Box<dyn Response + 'a> {
    let station = p.design.first().map_or(0, |m| m.station);
    match index {
        0 => Box::new(Direct::new(system, grid)),
        1 => Box::new(Receptance::new(system, grid, station, &[p.quantity])),
        2 => Box::new(ClosedForm::new(system, grid).expect("an elastic mode")),
        3 => Box::new(Reduced::new(system, grid, 1)),
        4 => Box::new(Reduced::new(system, grid, 2)),
        5 => Box::new(Reduced::new(system, grid, usize::MAX / 2)),
        6 => Box::new(Modal::new(system, grid)),
        _ => Box::new(Holzer::new(system, grid)),
    }
}

/// Largest difference to the dense solution over the largest value.
fn error(method: &dyn Response, p: &Problem) -> Result<f64, ResponseError> {
    let mut found = Vec::new();
    method.sweep(&p.design, p.quantity, &mut found, &mut Work::default())?;
    if found.iter().any(|y| !y.is_finite()) {
        return Ok(f64::NAN);
    }
    let (n, mut worst, mut largest) = (p.system.orders(), 0.0f64, 0.0f64);
    for (i, speed) in p.speeds.iter().enumerate() {
        for order in 0..n {
            let x = dense(&p.system, &p.design, order, *speed);
            let exact = match p.quantity {
                Quantity::Twist { from, to } => x[from] - to.map_or(C64::default(), |to| x[to]),
                _ => unreachable!("twists are compared"),
            };
            worst = worst.max((found[i * n + order] - exact).norm());
            largest = largest.max(exact.norm());
        }
    }
    Ok(worst / largest)
}

/// Speeds round the resonances of a study.
fn range(from: f64, to: f64) -> Vec<f64> {
    (0..60).map(|i| from + (to - from) * f64::from(i) / 59.0).collect()
}

fn problems() -> Vec<Problem> {
    let six = study("villalva_i6");
    let hub = |sys: &System| Quantity::Twist { from: 0, to: Some(sys.chain.len() - 1) };
    let of_six = |name, design: Vec<Mounted>, outcomes| {
        let system = system(&six);
        Problem { name, quantity: hub(&system), system, design, speeds: range(600.0, 3200.0), outcomes }
    };
    // the receptance is exact, but near resonances of the chain alone it cancels up to 1e5 roundings
    let (exact, receptance) = (Right(1e-10), Right(1e-9));
    let mut list = vec![
        of_six("six without absorber", vec![], [exact, receptance, Wrong(0.05), Right(0.03), Right(0.01), exact, Wrong(0.03), exact]),
        of_six(
            "six with its published tuned absorber",
            vec![on(0, Kind::Tuned, 0.076, 158e3, 34.2)],
            [exact, receptance, Wrong(0.05), Right(0.06), Right(0.02), exact, Wrong(0.1), exact],
        ),
        of_six(
            "six with its published viscous absorber",
            vec![on(0, Kind::Viscous, 0.076, 0.0, 105.1)],
            [exact, receptance, Wrong(0.1), Right(0.03), Right(0.01), exact, Wrong(0.3), exact],
        ),
        of_six(
            "six with two absorbers",
            vec![on(0, Kind::Tuned, 0.04, 80e3, 20.0), on(3, Kind::Viscous, 0.02, 0.0, 30.0)],
            [exact, receptance, Refused("it takes one absorber"), Right(0.04), Right(0.01), exact, Wrong(0.05), exact],
        ),
    ];
    // one station on a spring with a tuned ring: closed form and one mode are the whole truth
    let mut one = uniform_chain(1, 1.0, 0.0);
    (one.stations[0].stiffness_to_ground, one.stations[0].damping_to_ground) = (1e4, 2.0);
    list.push(Problem {
        name: "Den Hartog's two masses",
        system: System::new(one.clone(), one_throw(&[(2, 1.0)])),
        design: vec![on(0, Kind::Tuned, 0.1, 826.0, 3.0)],
        quantity: Quantity::Twist { from: 0, to: None },
        speeds: range(500.0, 1500.0),
        outcomes: [exact, receptance, exact, exact, exact, exact, Wrong(0.01), exact],
    });
    // hysteretic shafts, and a link that is a damper only
    let mut lossy = six.chain.clone();
    for s in &mut lossy.stations[..7] {
        s.loss_factor_to_next = 0.02;
    }
    let excitation = || Excitation::new(&six.engine, six.order_limit);
    list.push(Problem {
        name: "loss factors",
        quantity: Quantity::Twist { from: 0, to: Some(7) },
        system: System::new(lossy, excitation()),
        design: vec![on(0, Kind::Tuned, 0.076, 158e3, 34.2)],
        speeds: range(600.0, 3200.0),
        outcomes: [exact, receptance, Wrong(0.05), Right(0.05), Right(0.015), exact, Wrong(0.1), exact],
    });
    let mut coupled = six.chain.clone();
    (coupled.stations[6].stiffness_to_next, coupled.stations[6].damping_to_next) = (0.0, 500.0);
    list.push(Problem {
        name: "a damper for a link",
        quantity: Quantity::Twist { from: 0, to: Some(6) },
        system: System::new(coupled.clone(), excitation()),
        design: vec![],
        speeds: range(600.0, 3200.0),
        outcomes: [exact, receptance, Wrong(0.05), Wrong(0.05), Wrong(0.01), exact, Wrong(0.05), exact],
    });
    coupled.stations[6].damping_to_next = 0.0;
    list.push(Problem {
        name: "a link of nothing",
        quantity: Quantity::Twist { from: 0, to: Some(6) },
        system: System::new(coupled, excitation()),
        design: vec![],
        speeds: range(600.0, 3200.0),
        outcomes: [exact, receptance, Wrong(0.05), Right(0.01), Right(0.02), exact, Wrong(0.1), Refused("neither stiffness nor damping")],
    });
    // two equal halves through a soft spring: modes close to each other, one of them alone knows half of the truth
    let mut halves = uniform_chain(4, 0.1, 1e6);
    halves.stations[1].stiffness_to_next = 1e2;
    for s in &mut halves.stations {
        s.damping_to_ground = 20.0;
    }
    list.push(Problem {
        name: "close modes",
        system: System::new(halves, one_throw(&[(2, 100.0), (4, 50.0)])),
        design: vec![],
        quantity: Quantity::Twist { from: 0, to: Some(1) },
        speeds: range(30_000.0, 60_000.0),
        outcomes: [exact, receptance, Wrong(0.3), Wrong(0.3), Wrong(0.3), exact, exact, Refused("holzer loses digits")],
    });
    // far above the resonances of its shafts a long chain lets nothing through: Holzer's marches grow without end
    let mut long = uniform_chain(300, 0.01, 1e5);
    for s in &mut long.stations {
        s.damping_to_ground = 0.5;
    }
    list.push(Problem {
        name: "three hundred stations",
        system: System::new(long, one_throw(&[(2, 100.0)])),
        design: vec![],
        quantity: Quantity::Twist { from: 0, to: Some(299) },
        speeds: vec![100_000.0, 120_000.0],
        outcomes: [exact, receptance, Wrong(0.5), Wrong(0.5), Wrong(0.5), exact, Right(1e-6), Refused("holzer loses digits")],
    });
    // a resonance that nothing damps, met exactly: no number is right
    let mut pole = uniform_chain(1, 1.0, 0.0);
    pole.stations[0].stiffness_to_ground = (1200.0 * RAD_PER_S_PER_RPM).powi(2);
    let nothing = Refused("resonance without damping");
    list.push(Problem {
        name: "undamped resonance",
        system: System::new(pole, one_throw(&[(2, 1.0)])),
        design: vec![],
        quantity: Quantity::Twist { from: 0, to: None },
        speeds: vec![1200.0],
        outcomes: [nothing; 8],
    });
    list
}

#[test]
fn every_method_on_every_problem() {
    let mut failed = Vec::new();
    for p in problems() {
        let grid = Grid::new(&p.speeds, &[]);
        for (i, outcome) in p.outcomes.iter().enumerate() {
            let m = method(i, &p.system, &grid, &p);
            let found = error(m.as_ref(), &p);
            let holds = match (outcome, &found) {
                (Right(tolerance), Ok(e)) => e <= tolerance,
                (Wrong(least), Ok(e)) => e >= least,
                (Refused(words), Err(e)) => e.to_string().contains(words),
                _ => false,
            };
            println!("{:<42} {:<20} {:?}: {found:?}", p.name, METHODS[i], outcome);
            if !holds {
                failed.push(format!("{}, {}: {outcome:?}, found {found:?}", p.name, METHODS[i]));
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}
