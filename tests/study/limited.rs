//! Optima under limits against every design of a grid over their own bounds: what holds a limit on heat may fall apart (a stiff lossy part, a soft part, a nearly locked part), and the best of one part is
//! not the best of all.

use crate::support::system;
use hartog::absorber::types::TYPES;
use hartog::absorber::{Absorber, Declaration, Mounted, Range, Surroundings};
use hartog::analysis::{self, OptimumResult, Silent};
use hartog::input::{LimitSpec, Size, Study};
use hartog::objective::{Measure, Over, PeakFinder, Property};
use hartog::response::{Grid, Method, Quantity, Receptance, Work};
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use rayon::prelude::*;
use std::path::Path;

/// Limits hold to this share.
const HELD: f64 = 1e-6;

pub fn read(name: &str) -> Study {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/limited").join(format!("{name}.toml"));
    hartog::input::read(&path).unwrap_or_else(|e| panic!("{e}"))
}

/// Free parameters of a study with one absorber of one type: key, bounds, and index in its declaration; values of the others.
struct Free {
    declaration: &'static Declaration,
    held: Vec<f64>,
    free: Vec<(usize, f64, f64)>,
}

impl Free {
    fn of(study: &Study) -> Self {
        let absorber = &study.optimise.as_ref().expect("optimises").absorbers[0];
        let declaration = absorber.types[0];
        let Size::Each(sizes) = &absorber.size else { panic!("a size") };
        let material = absorber.materials.iter().find(|m| m.0 == declaration).map(|m| &m.1);
        let (mut held, mut free) = (vec![sizes[0]], Vec::new());
        for (i, p) in declaration.parameters.iter().enumerate().skip(1) {
            let own = material.iter().flat_map(|m| &m.properties).chain(&absorber.bounds).find(|b| b.0 == p.key);
            let (low, high) = own.expect("every parameter is bounded").1;
            held.push(low);
            if low < high {
                free.push((i, low, high));
            }
        }
        Self { declaration, held, free }
    }

    fn design(&self, on: usize, at: &[f64]) -> Vec<Mounted> {
        let mut values = self.held.clone();
        for ((i, low, high), x) in self.free.iter().zip(at) {
            // logarithmic where the bounds are decades apart
            values[*i] = if *low > 0.0 { low * (high / low).powf(*x) } else { low + (high - low) * x };
        }
        vec![Mounted::on_station(on, Absorber::Ring((self.declaration.build)(&values)))]
    }
}

/// Lowest objective that holds all limits, of a grid over the bounds (so many points along one free parameter, and along each of two) and what moves of each free parameter, ever smaller, make of its best; nothing where no design of it holds them.
fn best_of_grid(study: &Study, points: (usize, usize)) -> Option<f64> {
    let free = Free::of(study);
    let sys = system(study);
    let grid = Grid::new(&study.speeds_rpm, &sys.excitation.tabulated_rpm);
    let on = study.optimise.as_ref().expect("optimises").station(0);
    let method = Method::Receptance(Receptance::new(&sys, &grid, on, &[study.twist]));
    let finder = PeakFinder::new(&sys, &grid, &method, study.refine_peaks);
    let value = |at: &[f64]| -> Option<f64> {
        let design = free.design(on, at);
        let peak = |m: &Measure| finder.peak(&design, m, &mut Work::default()).ok().map(|p| p.map_or(0.0, |p| p.value));
        for l in &study.limits {
            if peak(&l.of.measure)? > l.limit {
                return None;
            }
        }
        peak(&study.objective.measure)
    };
    let n = if free.free.len() == 1 { points.0 } else { points.1 };
    let point = |k: usize| -> Vec<f64> { (0..free.free.len()).map(|d| (k / n_pow(n, d) % n) as f64 / (n - 1) as f64).collect() };
    let mut list: Vec<(f64, Vec<f64>)> =
        (0..n_pow(n, free.free.len())).into_par_iter().filter_map(|k| Some((value(&point(k))?, point(k)))).collect();
    list.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut seeds: Vec<(f64, Vec<f64>)> = Vec::new();
    for one in list {
        let far = |s: &(f64, Vec<f64>)| s.1.iter().zip(&one.1).any(|(a, b)| (a - b).abs() > 0.1);
        if seeds.len() < 3 && seeds.iter().all(far) {
            seeds.push(one);
        }
    }
    let refined = |(mut best, mut at): (f64, Vec<f64>)| {
        let mut step = 1.0 / (n - 1) as f64;
        while step > 1e-8 {
            let mut moved = false;
            for direction in 0..4 * at.len() {
                let mut to = at.clone();
                let sign = if direction % 2 == 0 { step } else { -step };
                to[direction / 2 % at.len()] += sign;
                if direction >= 2 * at.len() {
                    // both at once, either way
                    to[(direction / 2 + 1) % at.len()] += if at.len() == 1 { 0.0 } else { sign.abs() };
                }
                if to.iter().all(|x| (0.0..=1.0).contains(x))
                    && let Some(found) = value(&to)
                    && found < best
                {
                    (best, at, moved) = (found, to, true);
                }
            }
            if !moved {
                step *= 0.5;
            }
        }
        best
    };
    seeds.into_iter().map(refined).reduce(f64::min)
}

fn n_pow(n: usize, d: usize) -> usize {
    n.pow(u32::try_from(d).expect("few"))
}

pub fn optimum(study: &Study) -> OptimumResult {
    analysis::run(study, &Silent).unwrap_or_else(|e| panic!("{e}")).optima.remove(0)
}

/// What is wrong with an optimum, by the best of the grid: nothing where it is not beaten by more than 1e-6.
fn beaten(study: &Study, points: (usize, usize)) -> Result<f64, String> {
    let own = optimum(study);
    let (value, holds) = (own.optimum.value(), own.conflict.is_none() && own.optimum.outcome.rows.excess() <= HELD);
    match best_of_grid(study, points) {
        Some(best) if !holds => Err(format!("no design was found, and {best} holds the limits")),
        Some(best) if best < value * (1.0 - 1e-6) => Err(format!("{value} is beaten by {best}, {:.1e}", 1.0 - best / value)),
        Some(best) => Ok(best / value),
        None => Ok(f64::INFINITY),
    }
}

/// Law: the best of a feasible set in parts. Five studies whose optima were missed by 0.02 to 35 %, once in one dimension, or were said not to exist. No design of a grid over their own bounds that holds
/// the limits is lower by more than 1e-6; the grid is refined by moves of its own.
#[test]
fn no_design_of_a_grid_beats_an_optimum_under_limits() {
    for name in ["one_damping", "two_limits", "rubber", "soft_rubber", "spring_pack"] {
        if let Err(wrong) = beaten(&read(name), (250, 16)) {
            panic!("{name}: {wrong}");
        }
    }
}

/// Law: a limit is judged in operation, too, where heat softens the rubber, and the search is of both. The optimum of the reference breaks the limit there by 1 % and more; the one that is found lies on it, in
/// operation, and no design of a grid over its own bounds that holds the limit is cooler.
#[test]
#[ignore = "a minute"]
fn limits_are_searched_in_operation() {
    let mut s = read("in_operation");
    s.speeds_rpm = s.speeds_rpm.iter().copied().step_by(6).collect();
    let found = s.run().expect("damped");
    let own = &found.optima[0];
    assert!(found.limits_hold(), "{:?}", own.design.limits);
    let on_its_limit = own.design.limits[0];
    assert!(on_its_limit > 1.0 - 1e-6, "{on_its_limit}");
    let in_operation = own.load_cases.iter().filter(|c| c.condition == hartog::objective::Condition::InOperation).count();
    assert!(in_operation > 0, "a peak in operation is among its rows");
    let (low, high) = (0.5 * own.optimum.design[0].absorber.law().expect("a ring").values()[1], 2.0);
    s.designs = (0..9)
        .flat_map(|i| (0..3).map(move |j| (i, j)))
        .map(|(i, j)| {
            let values = [0.05, low * f64::powf(2.0 * high, f64::from(i) / 8.0), 0.15 + 0.07 * f64::from(j)];
            let law = own.optimum.design[0].absorber.law().expect("a ring").rebuilt(&values);
            hartog::input::DesignSpec { name: format!("d{i}_{j}"), absorbers: vec![Mounted::on_station(0, Absorber::Ring(law))] }
        })
        .collect();
    s.optimise = None;
    let others = s.run().expect("damped").designs;
    let held: Vec<f64> = others.iter().filter(|d| d.limits.iter().all(|l| *l <= 1.0 + HELD)).filter_map(|d| d.objective).collect();
    assert!(!held.is_empty() && held.len() < others.len(), "some of {} hold it: {}", others.len(), held.len());
    let value = own.optimum.value();
    assert!(held.iter().all(|other| *other >= value * (1.0 - 1e-6)), "{held:?} against {value}");
}

/// The same where a study without limits asks for it: the value that is minimised is the one that the design is judged by, and lower than that of the optimum of the reference.
#[test]
fn an_optimum_is_searched_in_operation_where_a_study_asks_for_it() {
    let mut s = read("in_operation");
    (s.speeds_rpm, s.order_limit, s.refine_peaks) = (s.speeds_rpm.iter().copied().step_by(6).collect(), 3.0, false);
    let twist = s.limits.remove(0).of;
    (s.objective, s.limits) = (twist, Vec::new());
    let judged = |s: &Study| {
        let found = optimum(s);
        (found.optimum.value(), found.design.objective.expect("judged"))
    };
    let (value, reference) = judged(&s);
    assert!(reference > value * 1.05, "{reference} against {value}");
    s.optimise.as_mut().expect("optimises").in_operation = true;
    let (value, own) = judged(&s);
    assert!((value / own - 1.0).abs() < 1e-9 && own < reference * 0.99, "{value}, {own} against {reference}");
}

/// A random engine with one absorber, whose type and free parameters are drawn, without limits.
fn random_study(random: &mut Xoshiro256PlusPlus) -> Study {
    let throws = random.random_range(1..=8usize);
    let strokes = if random.random_bool(0.7) { 4 } else { 2 };
    let cycle = 180.0 * f64::from(strokes);
    let firing: Vec<String> = (0..throws).map(|i| format!("{}", cycle * i as f64 / throws as f64)).collect();
    let mut order: Vec<usize> = (1..=throws).collect();
    for i in 0..throws {
        order.swap(i, random.random_range(i..throws));
    }
    let (low, high) = if random.random_bool(0.5) { (600, 1800) } else { (1500, 3600) };
    let mut text = format!(
        "name = \"r\"\nstrokes = {strokes}\n[geometry]\nbore_mm = {}\ncrank_radius_mm = {}\nrod_length_mm = {}\npiston_mass_kg = {}\nrod_mass_kg = 1.5\nrod_rotating_fraction = 0.66\n[layout]\nin_line = {{ firing_order = {order:?}, firing_deg = [{}] }}\n[pressure]\nwiebe = {{ speed_rpm = [{low}, {high}], indicated_mean_pressure_bar = [{}, {}], boost_bar = 1.6, compression_ratio = 15, burn_start_deg = -6, burn_duration_deg = 60 }}\n",
        random.random_range(70.0..160.0),
        random.random_range(35.0..80.0),
        random.random_range(200.0..350.0),
        random.random_range(0.3..3.0),
        firing.join(", "),
        random.random_range(8.0..14.0),
        random.random_range(8.0..18.0),
    );
    let stiffness = 10f64.powf(random.random_range(5.3..6.4));
    for i in 0..throws + 2 {
        text += &format!("[[station]]\nname = \"s{i}\"\n");
        let last = i == throws + 1;
        text += &format!("inertia_kg_m2 = {}\n", if last { random.random_range(0.5..3.0) } else { random.random_range(0.01..0.15) });
        if !last {
            text += &format!("stiffness_to_next_n_m_per_rad = {}\n", stiffness * random.random_range(0.6..1.6));
            text += &format!("damping_to_next_n_m_s_per_rad = {}\n", random.random_range(0.0..4.0));
        }
        if (1..=throws).contains(&i) {
            text += &format!("throws = [{i}]\ndamping_to_ground_n_m_s_per_rad = {}\n", random.random_range(0.3..5.0));
        }
    }
    let over = if random.random_bool(0.6) { "synthesis" } else { "orders" };
    let objective = if random.random_bool(0.7) {
        format!("peak_twist = {{ from = \"s0\", to = \"s{}\", over = \"{over}\" }}", throws + 1)
    } else {
        format!("hub_amplitude = {{ station = \"s0\", over = \"{over}\" }}")
    };
    let study = format!(
        "engine = \"engine.toml\"\norder_limit = {}\n[speed_rpm]\nfrom = {low}\nto = {high}\nstep = 25\n[[objective]]\n{objective}\n[[design]]\nname = \"none\"\n[optimise]\nseed = {}\nabsorber = [{{ on = {{ station = \"s{}\" }}, types = [\"tuned\"], size = {{ ring_inertia_kg_m2 = {{ fixed = {} }} }} }}]\n",
        random.random_range(3..=8),
        random.random_range(1..1000),
        if random.random_bool(0.7) { 0 } else { random.random_range(0..=throws) },
        10f64.powf(random.random_range(-2.5..-0.4)),
    );
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("engine.toml"), text).expect("written");
    std::fs::write(folder.path().join("study.toml"), study).expect("written");
    let mut study = hartog::input::read(&folder.path().join("study.toml")).unwrap_or_else(|e| panic!("{e}"));
    free_parameters(&mut study, random);
    study
}

/// Draws the type, one or two free parameters and their bounds; the others are held at what is typical.
fn free_parameters(study: &mut Study, random: &mut Xoshiro256PlusPlus) {
    let searched: Vec<&'static Declaration> = TYPES.iter().copied().filter(|t| !["hardening", "two_stage"].contains(&t.name)).collect();
    let declaration = searched[random.random_range(0..searched.len())];
    let omega = study.modes.omega[1];
    let engine = hartog::absorber::closed_forms::EngineMode { inertia: study.chain.total_inertia(), omega };
    let spec = study.optimise.as_mut().expect("optimises");
    let absorber = &mut spec.absorbers[0];
    let Size::Each(sizes) = &absorber.size else { panic!("a size") };
    let ring = sizes[0];
    let modes = [engine];
    let surroundings = Surroundings { modes: &modes, ring_inertia: ring };
    let count = declaration.parameters.len() - 1;
    let first = random.random_range(0..count);
    let second = if random.random_bool(0.6) { random.random_range(0..count) } else { first };
    absorber.types = vec![declaration];
    absorber.bounds.clear();
    let typical = declaration.closed_forms.first().map(|form| (form.values)(ring, engine));
    for (i, p) in declaration.parameters.iter().enumerate().skip(1) {
        let middle = typical.as_ref().map_or_else(|| (p.typical)(&surroundings), |v| v[i]);
        let (low, high) = match p.key {
            _ if i - 1 != first && i - 1 != second => (middle, middle),
            "loss_factor" => (0.03, 0.3),
            "damping_factor" => (0.05, 0.5),
            "fractional_exponent" | "transition_exponent" | "flow_index" => (0.2, 0.8),
            "tuning_order" => (0.5, 12.0),
            "dynamic_ratio" => (1.1, 2.0),
            "glass_ratio" => (3.0, 3000.0),
            _ => (middle * 10f64.powf(random.random_range(-2.0..-0.5)), middle * 10f64.powf(random.random_range(0.5..2.0))),
        };
        // beyond its range a parameter is of no law of that type
        let (low, high) = if let Range::Within(a, b) = p.range { (low.clamp(a, b), high.clamp(a, b)) } else { (low, high) };
        absorber.bounds.push((p.key, (low, high)));
    }
}

/// One or two limits on what an optimum without them has, at 30 to 98 % of that.
fn limit(study: &mut Study, random: &mut Xoshiro256PlusPlus) {
    let free = optimum(study);
    let sys = system(study);
    let grid = Grid::new(&study.speeds_rpm, &sys.excitation.tabulated_rpm);
    let on = study.optimise.as_ref().expect("optimises").station(0);
    let method = Method::Receptance(Receptance::new(&sys, &grid, on, &[study.twist]));
    let finder = PeakFinder::new(&sys, &grid, &method, true);
    let ring = || vec![Quantity::RingTwist(0)];
    let kinds = [
        Measure::new(ring(), Over::Power),
        Measure::new(ring(), Over::Synthesis),
        Measure::new((0..study.chain.len() - 1).map(Quantity::ShaftTorque).collect(), Over::Synthesis),
        Measure::new(ring(), Over::Property(Property::LossFactor)),
    ];
    let (first, second) = (random.random_range(0..4), random.random_range(0..4));
    for kind in if random.random_bool(0.5) || first == second { vec![first] } else { vec![first, second] } {
        let value = finder.peak(&free.optimum.design, &kinds[kind], &mut Work::default()).expect("damped").map_or(0.0, |p| p.value);
        let limit = value * random.random_range(0.3..0.98);
        if limit > 0.0 && limit.is_finite() {
            let of = hartog::input::MeasureSpec { measure: kinds[kind].clone(), ..study.objective.clone() };
            study.limits.push(LimitSpec { of, words: format!("limit {kind}"), limit, rule: None });
        }
    }
}

fn checked(seeds: std::ops::Range<u64>) {
    let mut wrong = Vec::new();
    let (mut limited, mut impossible) = (0, 0);
    let count = seeds.end - seeds.start;
    for seed in seeds {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let mut study = random_study(&mut random);
        if analysis::run(&study, &Silent).is_err() {
            continue;
        }
        limit(&mut study, &mut random);
        if study.limits.is_empty() {
            continue;
        }
        limited += 1;
        let free = Free::of(&study);
        let words = study.limits.iter().map(|l| l.words.clone()).collect::<Vec<_>>().join(", ");
        match beaten(&study, (2000, 60)) {
            Ok(ratio) => impossible += usize::from(ratio.is_infinite()),
            Err(what) => {
                println!("seed {seed}, {}, {} free, {words}: {what}", free.declaration.name, free.free.len());
                wrong.push(seed);
            }
        }
    }
    println!(
        "{limited} of {count} engines with a limit; of {impossible} no design of the grid holds the limits; {} beaten: {wrong:?}",
        wrong.len()
    );
    assert!(limited > 0 && wrong.is_empty(), "{wrong:?}");
}

/// The same of 500 random engines of one to eight throws, each with one absorber of any type that is searched, one or two free parameters and one or two limits (dissipated power, ring twist, torque, loss
/// factor): none is beaten by more than 1e-6, none is called impossible that is possible. `HARTOG_SEEDS=17..18` asks for others.
#[test]
#[ignore = "half an hour"]
fn no_grid_beats_an_optimum_of_random_engines_under_limits() {
    let seeds = std::env::var("HARTOG_SEEDS").ok().and_then(|s| {
        let (from, to) = s.split_once("..")?;
        Some(from.parse().ok()?..to.parse().ok()?)
    });
    checked(seeds.unwrap_or(0..500));
}

/// Law: a point of a front over inertia is no worse than the optimum for its ring, searched by itself over all bounds. Under limits a heavier ring may do worse than a lighter one, and the branch that is followed need not be the
/// best: at 88d4460 the eighth of twelve points lay 1.6 % above, by all speeds and orders of the study, of which fewer are looked at here.
#[test]
fn a_front_under_limits_is_no_worse_than_its_optima() {
    let mut study = read("front");
    (study.speeds_rpm, study.order_limit, study.refine_peaks) = (study.speeds_rpm.iter().copied().step_by(3).collect(), 6.0, false);
    let front = analysis::run(&study, &Silent).unwrap_or_else(|e| panic!("{e}")).fronts.swap_remove(0).front;
    assert!(front.points.iter().any(|p| p.dominated), "a heavier ring does worse");
    for point in front.points.iter().skip(5).take(4) {
        let mut own = study.clone();
        own.front = None;
        own.conditions.clear();
        own.designs.truncate(1);
        let ring = point.design[0].absorber.ring_inertia();
        own.optimise.as_mut().expect("optimises").absorbers[0].size = Size::Each(vec![ring]);
        let optima = analysis::run(&own, &Silent).unwrap_or_else(|e| panic!("{e}")).optima;
        let best = optima[0].design.objective.expect("a value");
        assert!(point.value <= best * (1.0 + 1e-6), "{ring} kg m²: {} on the front, {best} alone", point.value);
    }
}
