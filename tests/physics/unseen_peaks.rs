//! Peaks that a coarse range of speeds may not show: small rings, lightly damped, whose resonances lie between two speeds or beside those of the crank.

use crate::support::{Kind, assert_close, on, study, system};
use hartog::absorber::{FractionalKelvin, Maxwell, Mounted, Rubber};
use hartog::drivetrain::{Chain, Station, System};
use hartog::engine::{Engine, Excitation, HarmonicTable, Layout, Order, Source};
use hartog::numerics::C64;
use hartog::numerics::synthesis::Synthesiser;
use hartog::objective::{Measure, Over, PeakFinder};
use hartog::response::{Direct, Grid, JointReceptance, Method, Quantity, Response, Work};
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use std::f64::consts::TAU;

pub(crate) const LOW: f64 = 600.0;
pub(crate) const HIGH: f64 = 3200.0;
/// Speeds of the reference, rpm apart.
const DENSE: f64 = 0.5;
/// Local maxima of dense values that stand below the largest by no more than this share are searched.
const NEAR_LARGEST: f64 = 0.05;

/// Orders 0.5 to 12, each of the torque that `amplitude` gives for its number, on throws that fire together at these angles.
fn excitation(firing_deg: Vec<f64>, mut amplitude: impl FnMut(u32) -> C64) -> Excitation {
    let harmonics = (1..=24).map(|n| (Order::from_twice(n), amplitude(n))).collect();
    let table = HarmonicTable { harmonics, ..HarmonicTable::default() };
    let layout = Layout { rods_per_throw: 1, firing_deg, bank_angle_deg: None, split_pin_deg: 0.0 };
    Excitation::new(&Engine { name: "unit".into(), strokes: 4, layout, source: Source::Harmonics(table) }, 12.0)
}

/// A pulley, throws and a flywheel: inertia, stiffness to the next and damping to the ground of each.
fn chain(stations: &[[f64; 3]]) -> Chain {
    let last = stations.len() - 1;
    let station = |(i, [inertia, stiffness_to_next, damping_to_ground]): (usize, &[f64; 3])| Station {
        name: format!("s{i}"),
        inertia: *inertia,
        stiffness_to_next: *stiffness_to_next,
        damping_to_ground: *damping_to_ground,
        throws: if (1..last).contains(&i) { vec![i - 1] } else { Vec::new() },
        ..Station::default()
    };
    Chain { stations: stations.iter().enumerate().map(station).collect() }
}

/// A six in line whose throws all turn with one newton metre in every order, at once.
pub(crate) fn unit_six() -> System {
    let stations = [
        [0.0527, 808e3, 0.0],
        [0.0334, 1270e3, 2.0],
        [0.0125, 1270e3, 2.0],
        [0.0326, 1310e3, 2.0],
        [0.0326, 1270e3, 2.0],
        [0.014, 1360e3, 2.0],
        [0.0339, 2100e3, 2.0],
        [1.165, 0.0, 0.0],
    ];
    System::new(chain(&stations), excitation(vec![0.0; 6], |_| C64::from(1.0)))
}

fn log_uniform(random: &mut impl Rng, low: f64, high: f64) -> f64 {
    low * (high / low).powf(random.random_range(0.0..1.0))
}

pub(crate) fn random_system(random: &mut impl Rng) -> System {
    let throws = random.random_range(2..=7);
    let mut stations = vec![[log_uniform(random, 0.02, 0.1), log_uniform(random, 3e5, 3e6), 0.0]];
    for _ in 0..throws {
        stations.push([log_uniform(random, 0.01, 0.05), log_uniform(random, 5e5, 3e6), log_uniform(random, 0.2, 8.0)]);
    }
    stations.push([log_uniform(random, 0.3, 2.0), 0.0, 0.0]);
    let firing = (0..throws).map(|_| 60.0 * f64::from(random.random_range(0u8..12))).collect();
    let fall = random.random_range(0.0..1.5);
    System::new(chain(&stations), excitation(firing, |n| C64::from_polar(f64::from(n).powf(-fall), random.random_range(0.0..TAU))))
}

/// One to three small rings at either end, of several laws, from lightly to heavily damped, tuned to what the orders excite.
pub(crate) fn random_design(random: &mut impl Rng, last: usize) -> Vec<Mounted> {
    let rings = random.random_range(1..=3);
    let one = |_| {
        let ring_inertia = log_uniform(random, 5e-4, 2e-2);
        let omega = TAU * random.random_range(40.0..640.0);
        let (stiffness, ratio) = (ring_inertia * omega * omega, log_uniform(random, 2e-3, 0.5));
        let station = if random.random_bool(0.7) { 0 } else { last };
        match random.random_range(0..8) {
            0 => Mounted::on_station(station, Rubber { ring_inertia, stiffness, loss_factor: 2.0 * ratio }),
            1 => {
                let law =
                    FractionalKelvin { ring_inertia, stiffness, relaxation_time: ratio / omega, exponent: random.random_range(0.2..0.9) };
                Mounted::on_station(station, law)
            }
            2 => {
                let relaxation_time = random.random_range(0.3..10.0) / omega;
                Mounted::on_station(station, Maxwell { ring_inertia, damping: stiffness * relaxation_time, relaxation_time })
            }
            3 => on(station, Kind::Viscous, ring_inertia, 0.0, 2.0 * ratio * ring_inertia * omega),
            _ => on(station, Kind::Tuned, ring_inertia, stiffness, 2.0 * ratio * ring_inertia * omega),
        }
    };
    (0..rings).map(one).collect()
}

/// The largest value between two places, by golden section.
fn golden(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let share = 0.5 * (5f64.sqrt() - 1.0);
    let (mut a, mut b) = (high - share * (high - low), low + share * (high - low));
    let (mut at_a, mut at_b) = (f(a), f(b));
    for _ in 0..30 {
        if at_a > at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - share * (high - low);
            at_a = f(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + share * (high - low);
            at_b = f(b);
        }
    }
    at_a.max(at_b)
}

/// The largest value by dense ones, each local maximum near the largest searched by golden section.
fn largest(speeds: &[f64], values: &[f64], least: f64, f: impl Fn(f64) -> f64) -> f64 {
    let last = values.len() - 1;
    let top = values.iter().copied().fold(0.0, f64::max);
    (0..=last)
        .filter(|i| values[*i] >= least && (*i == 0 || values[*i] >= values[i - 1]) && (*i == last || values[*i] >= values[i + 1]))
        .map(|i| golden(speeds[i.saturating_sub(1)], speeds[(i + 1).min(last)], &f))
        .fold(top, f64::max)
}

/// The largest half peak-to-peak value and the largest order by direct solutions every half rpm: none of the search of peaks is used.
fn reference(sys: &System, design: &[Mounted], quantity: Quantity) -> [f64; 2] {
    let speeds: Vec<f64> = (0..=((HIGH - LOW) / DENSE) as usize).map(|i| LOW + DENSE * i as f64).collect();
    let grid = Grid::new(&speeds, &sys.excitation.tabulated_rpm);
    let (direct, synthesiser, orders) = (Direct::new(sys, &grid), Synthesiser::new(&sys.excitation.harmonics), sys.orders());
    let mut sweep = Vec::new();
    direct.sweep(design, quantity, &mut sweep, &mut Work::default()).expect("damped");
    let at = |speed: f64| direct.all_orders_at(design, quantity, speed, &mut Work::default()).expect("damped");
    let sum = |y: &[C64]| y.iter().map(|y| y.norm()).sum::<f64>();
    let mut values = vec![0.0; grid.len()];
    let mut first: Vec<usize> = (0..grid.len()).collect();
    let bounds: Vec<f64> = sweep.chunks(orders).map(sum).collect();
    first.sort_by(|a, b| bounds[*b].total_cmp(&bounds[*a]));
    let mut top = 0.0;
    for i in first {
        // the sum of magnitudes bounds the sum
        if bounds[i] > (1.0 - NEAR_LARGEST) * top {
            values[i] = synthesiser.extremes(&sweep[i * orders..(i + 1) * orders]).half_peak_to_peak;
            top = f64::max(top, values[i]);
        }
    }
    let total = largest(&grid.speed_rpm, &values, (1.0 - NEAR_LARGEST) * top, |speed| synthesiser.extremes(&at(speed)).half_peak_to_peak);
    let top = sweep.iter().map(|y| y.norm()).fold(0.0, f64::max);
    let order = |n: usize| {
        let values: Vec<f64> = sweep.iter().skip(n).step_by(orders).map(|y| y.norm()).collect();
        let at = |speed: f64| direct.phasor(design, quantity, (n, speed), &mut Work::default()).expect("damped").norm();
        largest(&grid.speed_rpm, &values, (1.0 - NEAR_LARGEST) * top, at)
    };
    [total, (0..orders).map(order).fold(0.0, f64::max)]
}

/// The same as the search finds it at this step.
fn found(sys: &System, design: &[Mounted], quantity: Quantity, step: f64, joint: bool) -> [f64; 2] {
    let speeds: Vec<f64> = (0..=((HIGH - LOW) / step) as usize).map(|i| LOW + step * i as f64).collect();
    let grid = Grid::new(&speeds, &sys.excitation.tabulated_rpm);
    let method = if joint {
        Method::Joint(JointReceptance::new(sys, &grid, &[0, sys.chain.len() - 1], &[quantity]))
    } else {
        Method::Direct(Direct::new(sys, &grid))
    };
    let finder = PeakFinder::new(sys, &grid, &method, true);
    [Over::Synthesis, Over::Orders].map(|over| {
        let measure = Measure::new(vec![quantity], over);
        finder.peak(design, &measure, &mut Work::default()).expect("damped").expect("excited").value
    })
}

/// Random designs of one to three small rings from a seed, on shipped engines, on one of unit torques and on random ones.
pub(crate) fn each_random_design(seed: u64, count: usize, mut see: impl FnMut(usize, &System, Quantity, &[Mounted])) {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let shipped = ["villalva_i6_thesis", "mendes_mwm6"].map(|name| {
        let s = study(name);
        (system(&s), s.twist)
    });
    for i in 0..count {
        let built;
        let (sys, quantity) = match i % 4 {
            0 => (&shipped[i / 4 % 2].0, shipped[i / 4 % 2].1),
            k => {
                built = if k == 1 { unit_six() } else { random_system(&mut random) };
                (&built, Quantity::Twist { from: 0, to: Some(built.chain.len() - 1) })
            }
        };
        let design = random_design(&mut random, sys.chain.len() - 1);
        see(i, sys, quantity, &design);
    }
}

/// Designs from a seed, each held against the reference at 10 and 20 rpm: relative errors by synthesis and by orders.
fn errors(seed: u64, count: usize) -> Vec<(String, f64)> {
    let mut list = Vec::new();
    each_random_design(seed, count, |i, sys, quantity, design| {
        let exact = reference(sys, design, quantity);
        for step in [10.0, 20.0] {
            let peaks = found(sys, design, quantity, step, i % 8 > 3);
            for (k, over) in ["synthesis", "orders"].into_iter().enumerate() {
                list.push((format!("seed {seed}, design {i}, {step} rpm, {over}: {design:?}"), peaks[k] / exact[k] - 1.0));
            }
        }
    });
    list
}

/// How many errors lie in each decade, and the designs of the largest.
fn told(errors: &[(String, f64)]) {
    for (from, to) in [(1e-2, 1.0), (1e-3, 1e-2), (1e-4, 1e-3), (1e-5, 1e-4), (1e-6, 1e-5), (1e-7, 1e-6), (1e-9, 1e-7), (0.0, 1e-9)] {
        let within = |kind: &str| errors.iter().filter(|e| e.0.contains(kind) && (from..to).contains(&e.1.abs())).count();
        println!("{from:e} to {to:e}: {} by synthesis, {} by orders", within("synthesis"), within("orders"));
    }
    errors.iter().filter(|e| e.1.abs() > 1e-6).take(40).for_each(|e| println!("{:e}: {}", e.1, e.0));
}

/// Two designs, the ends of a search each, whose peaks were once missed between two speeds.
pub(crate) fn once_missed(sys: &System) -> [[Mounted; 2]; 2] {
    let last = sys.chain.len() - 1;
    let by_order = [
        on(0, Kind::Tuned, 0.008432, 15_163.503_804_381_366, 4.468_486_924_054_663),
        on(last, Kind::Tuned, 0.002108, 31_841.160_629_874_674, 0.084_779_537_625_207_11),
    ];
    let by_sum = [
        on(0, Kind::Tuned, 0.003_484_506_188_805_030_3, 9_194.824_331_296_324, 0.408_557_520_395_495_03),
        on(0, Kind::Tuned, 0.000_802_266_264_850_353_7, 1_476.382_760_384_157, 0.159_451_819_604_502_03),
    ];
    [by_order, by_sum]
}

/// Order 12 of the first has tops at 3088 and at 3105.7 rpm, of which neither 3100 nor 3110 rpm is higher than its neighbours: at 19b2337 its peak was 0.64 % too low at steps of 10 rpm.
/// The sum of the second was 2.6e-4 too low at 20 rpm. Reference: dense direct solutions and golden section.
#[test]
fn tops_in_neighbouring_intervals() {
    let sys = unit_six();
    let quantity = Quantity::Twist { from: 0, to: Some(sys.chain.len() - 1) };
    let [by_order, by_sum] = once_missed(&sys);
    for (design, known) in [(by_order, [None, Some(0.003_795_3)]), (by_sum, [None, None])] {
        let exact = reference(&sys, &design, quantity);
        for step in [10.0, 20.0] {
            for joint in [false, true] {
                let peaks = found(&sys, &design, quantity, step, joint);
                for k in 0..2 {
                    assert_close(peaks[k], exact[k], 1e-6, 0.0, &format!("step {step}, {design:?}"));
                    // as printed to five digits by a step of 1 rpm
                    known[k].into_iter().for_each(|known: f64| assert_close(peaks[k].to_degrees(), known, 1e-4, 0.0, "degrees"));
                }
            }
        }
    }
}

/// Random designs of one to three small rings on shipped engines and on random ones: peaks at steps of 10 and 20 rpm equal dense direct solutions, refined, to 1e-6.
fn hold(seed: u64, count: usize) {
    let all = errors(seed, count);
    told(&all);
    let off: Vec<_> = all.iter().filter(|e| e.1.abs() > 1e-6).collect();
    assert!(off.is_empty(), "{} of {} are off: {:?}", off.len(), all.len(), off.first());
}

#[test]
fn peaks_of_small_rings_do_not_depend_on_the_step() {
    hold(7, 12);
}

#[test]
#[ignore = "2,000 designs, some minutes"]
fn two_thousand_designs_of_small_rings() {
    hold(1, 2000);
}
