//! The largest order of the in-line six under unit torques in phase, on a plain grid: optima against a search over stiffness and damping by dense solutions of the chain.

use crate::support::{assert_close, scanned, study, system};
use hartog::absorber::TUNED;
use hartog::analysis::families;
use hartog::drivetrain::{Chain, Modes};
use hartog::engine::{HarmonicTable, Order, Source};
use hartog::numerics::{C64, I};
use hartog::objective::{Condition, Over, PeakFinder};
use hartog::optimise::{LoadCase, Problem, search, starts};
use hartog::response::{Grid, Method, Receptance};
use nalgebra::{DMatrix, DVector};

/// An order at a speed: circular frequency, angle of the host and its receptance, twist of the crank and what a torque at the host adds to it.
struct At {
    omega: f64,
    host: [C64; 2],
    twist: [C64; 2],
}

/// By a dense solution of the chain under 1 N m at every throw.
fn at(chain: &Chain, omega: f64) -> At {
    let n = chain.len();
    let mut a = DMatrix::<C64>::zeros(n, n);
    let (mut torque, mut unit) = (DVector::<C64>::zeros(n), DVector::<C64>::zeros(n));
    for (i, s) in chain.stations.iter().enumerate() {
        a[(i, i)] += C64::from(s.stiffness_to_ground - omega * omega * s.inertia) + I * omega * s.damping_to_ground;
        torque[i] = C64::from(s.throws.len() as f64);
        if i + 1 < n {
            let k = s.stiffness_to_next * C64::new(1.0, s.loss_factor_to_next) + I * omega * s.damping_to_next;
            for (p, q, sign) in [(i, i, 1.0), (i + 1, i + 1, 1.0), (i, i + 1, -1.0), (i + 1, i, -1.0)] {
                a[(p, q)] += k * sign;
            }
        }
    }
    unit[0] = C64::from(1.0);
    let lu = a.full_piv_lu();
    let (x, u) = (lu.solve(&torque).expect("damped"), lu.solve(&unit).expect("damped"));
    At { omega, host: [x[0], u[0]], twist: [x[0] - x[n - 1], u[0] - u[n - 1]] }
}

/// Law: the optimum of the largest order on the grid is that of a search by dense solutions, to 1e-8, and nothing in the whole plane of stiffness and damping is lower; rings of 0.2 to 3 times the pulley.
#[test]
fn optima_of_the_largest_order_on_a_grid() {
    let mut s = study("villalva_i6");
    s.speeds_rpm = (30..=160).map(|i| 20.0 * f64::from(i)).collect();
    s.engine.layout.firing_deg.fill(0.0);
    let orders: Vec<Order> = system(&s).excitation.orders.clone();
    let harmonics = orders.iter().map(|o| (*o, C64::from(1.0))).collect();
    s.engine.source = Source::Harmonics(HarmonicTable { harmonics, over_speed: Vec::new(), masses: None });
    let mut stations = s.chain.stations.clone();
    stations.iter_mut().filter(|s| !s.throws.is_empty()).for_each(|s| s.damping_to_ground = 2.0);
    s.chain = Chain { stations };
    s.modes = Modes::new(&s.chain);
    let sys = system(&s);
    let points: Vec<At> =
        s.speeds_rpm.iter().flat_map(|speed| sys.excitation.orders.iter().map(|o| at(&s.chain, o.omega(*speed)))).collect();
    let largest = |ring: f64, k: f64, c: f64| -> f64 {
        let of = |p: &At| {
            let (stiffness, inertial) = (C64::new(k, p.omega * c), ring * p.omega * p.omega);
            let z = stiffness * inertial / (stiffness - inertial);
            (p.twist[0] + p.twist[1] * z * p.host[0] / (1.0 - p.host[1] * z)).norm_sqr()
        };
        points.iter().map(of).fold(0.0, f64::max).sqrt()
    };
    // over the logarithms of stiffness and damping
    let least = |ring: f64, [k0, k1]: [f64; 2], [c0, c1]: [f64; 2]| {
        scanned(k0.ln(), k1.ln(), &|k| scanned(c0.ln(), c1.ln(), &|c| largest(ring, k.exp(), c.exp())).1).1
    };
    let grid = Grid::new(&s.speeds_rpm, &[]);
    let method = Method::Receptance(Receptance::new(&sys, &grid, 0, &[s.twist]));
    let finder = PeakFinder::new(&sys, &grid, &method, false);
    let load_cases = [LoadCase::new(Condition::Firing, &finder)];
    let family = s.optimise.as_ref().expect("optimises");
    let modes = families::engine_modes(&s, family, 1e4);
    s.objective.measure.over = Over::Orders;
    let objective = [s.objective.measure.in_si()];
    for share in [0.2, 1.0, 3.0] {
        let ring = share * s.chain.stations[0].inertia;
        let space = families::family(family, &families::Choice { types: vec![&TUNED], rings: vec![Some(ring)] }, &modes);
        let problem = Problem { load_cases: &load_cases, space, objectives: &objective, weights: &[], limits: &[], memory: None };
        let list = starts::starts(&problem.space, &modes, 8, 1);
        let found = search::optimise(&problem, &list, search::Finish::All, &|| {}).expect("damped");
        let own = &found.design[0].absorber;
        let (k, c) = (own.stiffness().expect("a spring"), own.damping().expect("a damper"));
        assert_close(found.value(), largest(ring, k, c), 1e-10, 0.0, "the value of the design");
        assert_close(found.value(), least(ring, [k / 1.5, 1.5 * k], [c / 3.0, 3.0 * c]), 1e-8, 0.0, &format!("{share} of the pulley"));
        let anywhere = least(ring, [1e2, 1e7], [1e-2, 1e4]);
        assert!(found.value() <= anywhere * (1.0 + 1e-8), "{share} of the pulley: {} against {anywhere}", found.value());
    }
}
