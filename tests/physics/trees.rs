//! Chains with branches and gears: published frequencies, and every exact method against the dense one.

use crate::support::{Kind, assert_close, on, one_throw};
use hartog::Study;
use hartog::absorber::Mounted;
use hartog::analysis::Silent;
use hartog::analysis::curves::curves;
use hartog::drivetrain::{Chain, Joint, Modes, Station, System};
use hartog::response::{Dense, Direct, Grid, Quantity, Receptance, Response, Work};
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use std::f64::consts::{PI, TAU};
use std::fs;

/// A study of an engine file with these stations; the torque is a table.
fn study(stations: &str) -> Result<Study, String> {
    let folder = tempfile::tempdir().expect("folder");
    let engine =
        "name = \"tree\"\nstrokes = 2\n[layout.in_line]\nfiring_order = [1]\nfiring_deg = [0]\n[pressure.harmonics]\nfile = \"h.csv\"\n";
    fs::write(folder.path().join("engine.toml"), format!("{engine}{stations}")).expect("written");
    fs::write(folder.path().join("h.csv"), "order,amplitude_n_m,phase_deg\n1,100,0\n2,50,0\n").expect("written");
    let text = "engine = \"engine.toml\"\nspeed_rpm = { from = 100, to = 200, step = 10 }\n[[design]]\nname = \"none\"\n";
    Study::from_toml(text, folder.path().join("study.toml")).map_err(|e| e.to_string())
}

fn frequencies_hz(stations: &str) -> Vec<f64> {
    study(stations).unwrap_or_else(|e| panic!("{e}")).modes.frequencies_hz()
}

fn station(name: &str, inertia: f64, rest: &str) -> String {
    format!("[[station]]\nname = \"{name}\"\ninertia_kg_m2 = {inertia:e}\n{rest}\n")
}

/// By hand: two free shafts in a mesh of stiffness k (on the pinion's shaft) and ratio g: omega² = k (1/J_pinion + g²/J_wheel).
#[test]
fn two_geared_shafts_by_hand() {
    let (pinion, wheel, k, g) = (0.02, 0.5, 3e4, -3.5);
    let mesh = format!("next = \"wheel\"\ngear_ratio_to_next = {g}\nstiffness_to_next_n_m_per_rad = {k:e}");
    let found = frequencies_hz(&(station("wheel", wheel, "throws = [1]") + &station("pinion", pinion, &mesh)));
    assert_eq!(found.len(), 1);
    assert_close(found[0], (k * (1.0 / pinion + g * g / wheel)).sqrt() / TAU, 1e-12, 0.0, "Hz");
}

/// A station that a rigid mesh makes one body with another is refused by that other's name, with what gives the mesh a torque.
#[test]
fn a_station_of_a_rigid_mesh_is_named_by_its_body() {
    let folder = tempfile::tempdir().expect("folder");
    let engine =
        "name = \"tree\"\nstrokes = 2\n[layout.in_line]\nfiring_order = [1]\nfiring_deg = [0]\n[pressure.harmonics]\nfile = \"h.csv\"\n";
    let stations = station("crank", 0.1, "throws = [1]\nstiffness_to_next_n_m_per_rad = 1e4")
        + &station("pinion", 0.02, "gear_ratio_to_next = 3")
        + &station("wheel", 0.5, "");
    fs::write(folder.path().join("engine.toml"), format!("{engine}{stations}")).expect("written");
    fs::write(folder.path().join("h.csv"), "order,amplitude_n_m,phase_deg\n1,100,0\n").expect("written");
    let text = "engine = \"engine.toml\"\nspeed_rpm = { from = 100, to = 200, step = 10 }\n[[objective]]\npeak_twist = { from = \"crank\", to = \"pinion\" }\n[[design]]\nname = \"none\"\n";
    let error = Study::from_toml(text, folder.path().join("study.toml")).expect_err("no station of that name").to_string();
    assert!(
        error.contains("found station `pinion`, expected `wheel`: their mesh is rigid, so that both are one body of that name"),
        "{error}"
    );
    assert!(error.contains("give `pinion` a `stiffness_to_next_n_m_per_rad`"), "{error}");
}

/// Source: [Friswell et al. 2010] Dynamics of Rotating Machines, chapter 9, a motor that drives two rotors through equal gears in a rigid mesh:
/// 425.4, 634.1, 3247.2 Hz, and section 9.6.3, four gears: 10.304, 20.479, 24.423 Hz. All printed digits.
#[test]
fn published_geared_systems() {
    let motor = station("motor", 400e-6, "throws = [1]\nnext = \"first\"\nstiffness_to_next_n_m_per_rad = 1e4");
    let first = station("first", 25e-6, "next = \"rotor_1\"\nstiffness_to_next_n_m_per_rad = 5e3");
    let second = station("second", 25e-6, "next = \"first\"\ngear_ratio_to_next = -1");
    let rotors = station("rotor_2", 700e-6, "next = \"second\"\nstiffness_to_next_n_m_per_rad = 5e3") + &station("rotor_1", 700e-6, "");
    let found = frequencies_hz(&(motor + &first + &second + &rotors));
    let printed: Vec<String> = found.iter().map(|f| format!("{f:.1}")).collect();
    assert_eq!(printed, ["425.4", "634.1", "3247.2"]);

    // shafts of 2.5 m, 200 mm and 3.5 m, 250 mm in 68 GPa: k = G pi d^4/(32 L); wheels of 0.5 and 0.8 m
    let shaft = |length: f64, d: f64| 68e9 * PI * d.powi(4) / (32.0 * length);
    let (k1, k2) = (shaft(2.5, 0.2), shaft(3.5, 0.25));
    let link = |to: &str, k: f64| format!("next = \"{to}\"\nstiffness_to_next_n_m_per_rad = {k:e}");
    let mesh = |to: &str, ratio: f64| format!("next = \"{to}\"\ngear_ratio_to_next = {ratio}");
    let stations = station("driver", 3200.0, &format!("throws = [1]\n{}", link("wheel_1", k1)))
        + &station("wheel_1", 200.0, "")
        + &station("wheel_2", 200.0, &mesh("wheel_1", -1.0))
        + &station("wheel_3", 800.0, &mesh("wheel_1", -0.5 / 0.8))
        + &station("wheel_4", 800.0, &mesh("wheel_2", -0.5 / 0.8))
        + &station("load_1", 450.0, &link("wheel_3", k2))
        + &station("load_2", 450.0, &link("wheel_4", k2));
    let printed: Vec<String> = frequencies_hz(&stations).iter().map(|f| format!("{f:.3}")).collect();
    assert_eq!(printed, ["10.304", "20.479", "24.423"]);
}

/// Source: [Gunter & Chen 2001] pp. 388-392, a marine steam turbine: propeller, and two turbines of two gear stages each: 177.7, 220.2 and
/// 1282.6 cycles a minute. Inertias in lbf in s², stiffness in lbf in/rad; gear ratios by the radii.
#[test]
fn marine_steam_turbine() {
    let si = 0.112_98;
    let link = |to: &str, k: f64| format!("next = \"{to}\"\nstiffness_to_next_n_m_per_rad = {:e}", k * si);
    let mesh = |to: &str, ratio: f64| format!("next = \"{to}\"\ngear_ratio_to_next = {ratio}");
    let stations = station("propeller", 2.454e6 * si, &format!("throws = [1]\n{}", link("bull_gear", 826e6)))
        + &station("bull_gear", 0.826e6 * si, "")
        + &station("low_pinion", 1e-9, &mesh("bull_gear", -9.4094))
        + &station("low_wheel", 1.283e4 * si, &link("low_pinion", 203.94e6))
        + &station("low_second_pinion", 1e-9, &mesh("low_wheel", -40.0424 / 9.4094))
        + &station("low_turbine", 1.509e4 * si, &link("low_second_pinion", 30.51e6))
        + &station("high_pinion", 1e-9, &mesh("bull_gear", -9.4094))
        + &station("high_wheel", 2.723e4 * si, &link("high_pinion", 24.17e6))
        + &station("high_second_pinion", 1e-9, &mesh("high_wheel", -78.2365 / 9.4094))
        + &station("high_turbine", 2.612e2 * si, &link("high_second_pinion", 14.26e6));
    let printed: Vec<String> = frequencies_hz(&stations).iter().take(3).map(|f| format!("{:.1}", 60.0 * f)).collect();
    println!("{printed:?}");
    assert_eq!(printed, ["177.7", "220.2", "1282.6"]);
}

/// A random tree: each station leads to any later one, some behind gears; damped everywhere.
pub fn random_tree(rng: &mut Xoshiro256PlusPlus, n: usize) -> Chain {
    let station = |i: usize, rng: &mut Xoshiro256PlusPlus| {
        let last = i + 1 == n;
        let geared = !last && rng.random_bool(0.3);
        Station {
            name: format!("s{i}"),
            inertia: rng.random_range(0.01..0.1),
            stiffness_to_next: if last { 0.0 } else { 10f64.powf(rng.random_range(4.0..6.5)) },
            damping_to_next: if last { 0.0 } else { rng.random_range(0.0..5.0) },
            loss_factor_to_next: if last { 0.0 } else { rng.random_range(0.0..0.05) },
            damping_to_ground: rng.random_range(0.0..3.0),
            joint: (!last).then(|| {
                let ratio = rng.random_range(0.3..3.0) * if rng.random_bool(0.5) { -1.0 } else { 1.0 };
                Box::new(Joint { leads_to: rng.random_range(i + 1..n), gear: if geared { ratio } else { 1.0 } })
            }),
            throws: if i == n / 2 { vec![0] } else { Vec::new() },
            ..Station::default()
        }
    };
    Chain { stations: (0..n).map(|i| station(i, rng)).collect() }
}

/// Law: elimination along the tree and the update by receptance equal the dense solution, absorbers anywhere, for stations, links, twists and rings.
/// 40 trees of 2 to 30 stations; the tolerance is of the largest value of the sweep.
#[test]
fn trees_equal_the_dense_solution() {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(7);
    for case in 0..40 {
        let n = rng.random_range(2..30);
        let chain = random_tree(&mut rng, n);
        let system = System::new(chain, one_throw(&[(2, 100.0), (4, 60.0), (6, 30.0)]));
        let grid = Grid::new(&(0..25).map(|i| 300.0 + 240.0 * f64::from(i)).collect::<Vec<_>>(), &[]);
        let hub = rng.random_range(0..n);
        let design = if case % 3 == 0 { Vec::new() } else { vec![on(hub, Kind::Tuned, 0.02, 3e4, 8.0)] };
        let two = [design.clone(), vec![on(rng.random_range(0..n), Kind::Viscous, 0.01, 0.0, 4.0)]].concat();
        let (a, b) = (rng.random_range(0..n), rng.random_range(0..n - 1));
        let mut quantities =
            vec![Quantity::Twist { from: a, to: None }, Quantity::ShaftTorque(b), Quantity::Twist { from: b, to: Some(n - 1) }];
        quantities.extend((!design.is_empty()).then_some(Quantity::RingTwist(0)));
        let tables = Receptance::new(&system, &grid, hub, &quantities);
        for quantity in quantities {
            let same = |method: &dyn Response, design: &[Mounted]| {
                let (mut exact, mut found) = (Vec::new(), Vec::new());
                Dense::new(&system, &grid).sweep(design, quantity, &mut exact, &mut Work::default()).expect("damped");
                method.sweep(design, quantity, &mut found, &mut Work::default()).expect("damped");
                let largest = exact.iter().map(|y| y.norm()).fold(0.0, f64::max);
                let worst = exact.iter().zip(&found).map(|(x, y)| (x - y).norm()).fold(0.0, f64::max);
                assert_close(worst, 0.0, 0.0, 1e-9 * largest, &format!("{}, tree {case} of {n}, {quantity:?}", method.name()));
            };
            let direct = Direct::new(&system, &grid);
            same(&direct, &design);
            same(&direct, &two);
            same(&tables, &design);
            // the way with a factored matrix, which every single point takes
            let (mut one, order) = (Work::default(), 1);
            let at = direct.order_at(&design, quantity, order, 1500.0, &mut one).expect("damped");
            let dense = Dense::new(&system, &grid).phasor(&design, quantity, (order, 1500.0), &mut one).expect("damped");
            assert_close((at - dense).norm(), 0.0, 0.0, 1e-9 * dense.norm().max(1e-12), "one point");
        }
    }
}

/// Law: where a branch resonates while the station that carries it stands still, elimination along the tree breaks down; the answer does not. Two equal
/// undamped branches on a station at their own frequency hold it still.
#[test]
fn a_resonating_branch_is_solved() {
    let branch = |name: &str| Station {
        name: name.into(),
        inertia: 0.1,
        stiffness_to_next: 1e5,
        joint: Some(Box::new(Joint { leads_to: 2, gear: 1.0 })),
        ..Station::default()
    };
    let hub = Station { name: "hub".into(), inertia: 1.0, stiffness_to_next: 1e5, throws: vec![0], ..Station::default() };
    let end = Station { name: "end".into(), inertia: 1.0, damping_to_ground: 5.0, ..Station::default() };
    let mut second = branch("b");
    second.inertia = 0.2;
    let system = System::new(Chain { stations: vec![branch("a"), second, hub, end] }, one_throw(&[(2, 100.0)]));
    // order 1 at omega = sqrt(k/J) = 1000 rad/s
    let speed = 1000.0 * 60.0 / TAU;
    let grid = Grid::new(&[speed], &[]);
    let (mut direct, mut dense) = (Vec::new(), Vec::new());
    let work = &mut Work::default();
    for quantity in [Quantity::ShaftTorque(0), Quantity::Twist { from: 0, to: None }, Quantity::ShaftTorque(2)] {
        Direct::new(&system, &grid).sweep(&[], quantity, &mut direct, work).expect("bounded");
        Dense::new(&system, &grid).sweep(&[], quantity, &mut dense, work).expect("bounded");
        assert_close((direct[0] - dense[0]).norm(), 0.0, 0.0, 1e-9 * (1.0 + dense[0].norm()), &format!("{quantity:?}"));
    }
}

/// Law: a gear of ratio one is a shaft, and a tree written in another order is the same.
#[test]
fn a_gear_of_one_is_a_shaft() {
    let names = ["a", "b", "c", "d"];
    let inertia = [0.01, 0.02, 0.03, 0.5];
    let throw = |i: usize| if i == 1 { "throws = [1]\n" } else { "" };
    let row: String = (0..4)
        .map(|i| station(names[i], inertia[i], &format!("{}{}", throw(i), if i < 3 { "stiffness_to_next_n_m_per_rad = 1e5" } else { "" })))
        .collect();
    let geared = row.replacen("stiffness_to_next_n_m_per_rad = 1e5", "stiffness_to_next_n_m_per_rad = 1e5\ngear_ratio_to_next = 1", 1);
    let turned: String = [2usize, 0, 3, 1]
        .into_iter()
        .map(|i| {
            let next = if i < 3 { format!("next = \"{}\"\nstiffness_to_next_n_m_per_rad = 1e5", names[i + 1]) } else { String::new() };
            station(names[i], inertia[i], &format!("{}{next}", throw(i)))
        })
        .collect();
    let expected = frequencies_hz(&row);
    for other in [&geared, &turned] {
        for (a, b) in frequencies_hz(other).iter().zip(&expected) {
            assert_close(*a, *b, 1e-12, 0.0, "Hz");
        }
    }
    assert!(study(&turned).expect("a row").chain.is_row(), "a row in any order is a row");
}

/// Law: each free part of a tree has one rigid mode, with gears, too.
#[test]
fn rigid_modes_of_trees() {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(3);
    for _ in 0..20 {
        let n = rng.random_range(3..20);
        let mut chain = random_tree(&mut rng, n);
        let cut = rng.random_range(0..n - 1);
        assert_eq!(Modes::new(&chain).rigid, 1);
        chain.stations[cut].stiffness_to_next = 0.0;
        let modes = Modes::new(&chain);
        assert_eq!(modes.rigid, 2);
        assert!(modes.omega[2] > 1.0, "elastic");
    }
}

/// Damping of the whole chain as engineers state it: a dynamic magnifier M is a loss factor 1/M, a fraction of critical is that of the first mode, Rayleigh's
/// alpha and beta give alpha/(2 omega) + beta omega/2 in every mode.
#[test]
fn damping_of_the_whole_chain() {
    let stations = station("a", 0.02, "throws = [1]\nstiffness_to_next_n_m_per_rad = 1e5")
        + &station("b", 0.05, "stiffness_to_next_n_m_per_rad = 3e5")
        + &station("c", 0.9, "");
    let with = |damping: &str| study(&format!("[damping]\n{damping}\n{stations}")).unwrap_or_else(|e| panic!("{e}"));
    assert_close(with("dynamic_magnifier = 20").chain.stations[0].loss_factor_to_next, 0.05, 1e-12, 0.0, "loss factor");
    let modes = with("fraction_of_critical = 0.02").modes;
    assert_close(modes.damping_ratio(1), 0.02, 1e-9, 0.0, "first mode");
    assert_close(modes.damping_ratio(2), 0.02 * modes.omega[2] / modes.omega[1], 1e-9, 0.0, "second mode");
    let modes = with("rayleigh = { inertia_per_s = 3, stiffness_s = 2e-6 }").modes;
    for mode in modes.elastic() {
        let omega = modes.omega[mode];
        assert_close(modes.damping_ratio(mode), 1.5 / omega + 1e-6 * omega, 1e-9, 0.0, "Rayleigh");
    }
    let twice = study(&format!("[damping]\ndynamic_magnifier = 20\nfraction_of_critical = 0.02\n{stations}")).expect_err("two");
    assert!(twice.contains("expected one of `dynamic_magnifier`, `fraction_of_critical` and `rayleigh`"), "{twice}");
    let percent = study(&format!("[damping]\nfraction_of_critical = 2\n{stations}")).expect_err("per cent");
    assert!(percent.contains("2 % is 0.02"), "{percent}");
}

/// A chain in a table is the chain in the engine file; mistakes have row and column.
#[test]
fn a_chain_from_a_table() {
    let written = station("a", 0.02, "throws = [1]\nstiffness_to_next_n_m_per_rad = 1e5\nloss_factor_to_next = 0.03")
        + &station("b", 0.05, "next = \"c\"\ngear_ratio_to_next = -2\nstiffness_to_next_n_m_per_rad = 3e5")
        + &station("c", 0.9, "damping_to_ground_n_m_s_per_rad = 2");
    let header = "station,inertia_kg_m2,stiffness_to_next_n_m_per_rad,throws,loss_factor_to_next,damping_to_ground_n_m_s_per_rad,next,gear_ratio_to_next";
    let folder = tempfile::tempdir().expect("folder");
    let read = |rows: &str| {
        let engine = "name = \"tree\"\nstrokes = 2\n[layout.in_line]\nfiring_order = [1]\nfiring_deg = [0]\n[pressure.harmonics]\nfile = \"h.csv\"\n\
            [chain]\nfile = \"chain.csv\"\n";
        fs::write(folder.path().join("engine.toml"), engine).expect("written");
        fs::write(folder.path().join("h.csv"), "order,amplitude_n_m,phase_deg\n1,100,0\n").expect("written");
        fs::write(folder.path().join("chain.csv"), format!("{header}\n{rows}")).expect("written");
        let text = "engine = \"engine.toml\"\nspeed_rpm = { from = 100, to = 200, step = 10 }\n[[design]]\nname = \"none\"\n";
        Study::from_toml(text, folder.path().join("study.toml")).map_err(|e| e.to_string())
    };
    let table = read("a,0.02,1e5,1,0.03,,,\nb,0.05,3e5,,,,c,-2\nc,0.9,,,,2,,\n").unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(table.chain, study(&written).unwrap_or_else(|e| panic!("{e}")).chain);
    let wrong = read("a,0.02,-1,1,0.03,,,\nb,0.05,,,,2,,\n").expect_err("negative");
    assert!(
        wrong.contains("found -1, expected at least zero") && wrong.contains("row 2") && wrong.contains("stiffness_to_next"),
        "{wrong}"
    );
    let lost = read("a,0.02,1e5,1,0.03,,d,\nb,0.05,,,,2,,\n").expect_err("unknown");
    assert!(lost.contains("found `d`, no station of this file"), "{lost}");
}

/// Law: Holzer's table closes on a tree with gears, too: each link carries its stiffness times its twist, nothing is left behind the root; and a node is where the
/// angle changes its sign as seen through the gear.
#[test]
fn holzer_closes_on_a_tree() {
    let text = station("a", 0.02, "throws = [1]\nnext = \"b\"\nstiffness_to_next_n_m_per_rad = 1e5")
        + &station("b", 0.05, "next = \"c\"\nstiffness_to_next_n_m_per_rad = 3e5")
        + &station("c", 0.9, "")
        + &station("d", 0.01, "next = \"b\"\ngear_ratio_to_next = -2\nstiffness_to_next_n_m_per_rad = 2e4");
    let study = study(&text).unwrap_or_else(|e| panic!("{e}"));
    let found = curves(&study, &[], &Silent).expect("curves");
    let largest = found.holzer.iter().map(|r| r.sum.abs()).fold(0.0, f64::max);
    assert!(largest > 0.0);
    for r in &found.holzer {
        let carried = if r.station == "c" { 0.0 } else { r.stiffness * r.twist };
        assert_close(r.sum, carried, 1e-9, 1e-9 * largest, &format!("mode {}, {}", r.mode, r.station));
    }
    let modes = found.figures.iter().find(|f| f.name == "modes").expect("modes");
    assert_eq!(modes.panels.len(), 3);
    for (number, panel) in modes.panels.iter().enumerate() {
        // mode n of a tree has n nodes
        let label = &panel.curves[0].label;
        assert_eq!(label.split("nodes at ").nth(1).expect("nodes").split(", ").count(), number + 1, "{label}");
    }
}

/// Law: a gear of the ratio g = speed of a station over that of the next (negative of an outer pair, which turns the shafts in opposite directions) is the chain without gear whose inertias, stiffnesses and dampings beyond it are g² times
/// as large: angles beyond it are g times those, torques 1/g, so that an outer pair turns their sign, and twists referred to the crankshaft are the same. Keys and page say the ratio that way round, and the schema takes negative ones.
#[test]
fn a_gear_is_the_chain_reduced_to_one_speed() {
    let chain = |g: f64, geared: bool| {
        let (reduced, gear) = if geared { (1.0, format!("gear_ratio_to_next = {g}\n")) } else { (g * g, String::new()) };
        let text = station(
            "fan",
            0.004 * reduced,
            &format!("damping_to_ground_n_m_s_per_rad = {}\nstiffness_to_next_n_m_per_rad = {}", 0.3 * reduced, 2e4 * reduced),
        ) + &station(
            "cam",
            0.003 * reduced,
            &format!(
                "next = \"hub\"\n{gear}stiffness_to_next_n_m_per_rad = {}\ndamping_to_next_n_m_s_per_rad = {}",
                4e4 * reduced,
                2.0 * reduced
            ),
        ) + &station("hub", 0.01, "next = \"crank\"\nstiffness_to_next_n_m_per_rad = 1e5")
            + &station("crank", 0.02, "throws = [1]\ndamping_to_ground_n_m_s_per_rad = 2\nstiffness_to_next_n_m_per_rad = 2e5")
            + &station("flywheel", 0.3, "");
        study(&text).unwrap_or_else(|e| panic!("{e}"))
    };
    for g in [-2.0, 0.4, -0.7] {
        let (geared, plain) = (chain(g, true), chain(g, false));
        assert_close(geared.chain.total_inertia(), plain.chain.total_inertia(), 1e-12, 0.0, "all inertias at the speed of the crank");
        let all = |s: &Study, quantity: Quantity| -> Vec<_> {
            let system = crate::support::system(s);
            let grid = Grid::new(&[900.0, 2400.0, 6100.0], &[]);
            let mut found = Vec::new();
            Direct::new(&system, &grid).sweep(&[], quantity, &mut found, &mut Work::default()).expect("damped");
            found
        };
        let (fan, cam, hub, flywheel) = (0, 1, 2, 4);
        let angle = |from| Quantity::Twist { from, to: None };
        let twist = |from, to| Quantity::Twist { from, to: Some(to) };
        let cases = [
            (angle(hub), 1.0),
            (angle(cam), g),
            (angle(fan), g),
            (Quantity::ShaftTorque(fan), 1.0 / g),
            (Quantity::ShaftTorque(cam), 1.0 / g),
        ];
        for (quantity, factor) in
            cases.into_iter().chain([(twist(hub, flywheel), 1.0), (twist(fan, flywheel), 1.0), (twist(fan, cam), 1.0)])
        {
            for (found, reduced) in all(&geared, quantity).iter().zip(all(&plain, quantity)) {
                assert_close(
                    (found - reduced * factor).norm(),
                    0.0,
                    0.0,
                    1e-9 * reduced.norm() * factor.abs(),
                    &format!("{quantity:?}, ratio {g}"),
                );
            }
        }
    }
    let key =
        hartog::input::keys::keys(hartog::input::FileKind::Engine).into_iter().find(|k| k.name() == "gear_ratio_to_next").expect("a key");
    assert!(key.about.starts_with("Speed of this station over that of the next, negative where"), "{}", key.about);
    assert_eq!(key.takes, "a number, from -1000 to -0.001 or from 0.001 to 1000");
}
