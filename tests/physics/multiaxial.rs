//! Multiaxial criteria: closed forms under bending and torsion, calibration, axes, tables.

use crate::support::assert_close;
use hartog::fatigue::multiaxial::invariants::{self, Invariants};
use hartog::fatigue::multiaxial::plane::{Amplitude, Plane, Scratch};
use hartog::fatigue::multiaxial::{Criterion, Grid, History, Limits, evaluate, papadopoulos};
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The steel of \[Minucci 2010\] with a torsion limit at which no constant vanishes, and its repeated bending limit by Goodman.
pub const STEEL: Limits = Limits { tensile: 1100e6, bending: 720e6, torsion: 450e6, repeated_bending: 435.164_835_164_835e6 };

/// Bending (xx) and torsion (xy): means, amplitudes and the phase between them, 720 samples.
pub fn bending_and_torsion(mean: (f64, f64), amplitude: (f64, f64), phase: f64) -> History {
    History::new((0..720).map(|j| {
        let a = TAU * f64::from(j) / 720.0;
        [mean.0 + amplitude.0 * a.sin(), 0.0, 0.0, mean.1 + amplitude.1 * (a - phase).sin(), 0.0, 0.0]
    }))
}

fn factor(history: &History, criterion: Criterion, limits: &Limits) -> f64 {
    evaluate(history, limits, &[criterion], Grid::default()).expect("constants").0[0].safety_factor
}

/// Closed forms \[Papadopoulos et al. 1997\]: with amplitudes s and t and phase d, sqrt(J2)_a² = (A + sqrt(A² - B))/2 with A = s²/3 + t², B = 4 s² t² sin² d/3 (the longer half
/// axis of an ellipse); hydrostatic amplitude s/3; Papadopoulos' mean shear sqrt(s²/3 + t²), whatever the phase. Invariants to 1e-6 of samples that meet the extremes, the
/// mean shear to 1e-3.
#[test]
fn harmonic_bending_and_torsion() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(2);
    for case in 0..40 {
        let mut r = |low: f64, high: f64| random.random_range(low..high);
        let (s, t) = (r(50e6, 400e6), r(20e6, 300e6));
        let (mean, phase) = ((r(-200e6, 300e6), r(-100e6, 100e6)), if case % 4 == 0 { FRAC_PI_2 } else { r(0.0, PI) });
        let history = bending_and_torsion(mean, (s, t), phase);
        let i = Invariants::of(&history);
        let (a, b) = (s * s / 3.0 + t * t, 4.0 / 3.0 * (s * t * phase.sin()).powi(2));
        let j2 = (0.5 * (a + (a * a - b).max(0.0).sqrt())).sqrt();
        // the longer axis may lie between two samples: (half a degree)²/2
        assert_close(i.sqrt_j2_amplitude, j2, 4e-5, 0.0, "sqrt(J2)");
        assert_close(i.hydrostatic_amplitude, s / 3.0, 1e-6, 0.0, "hydrostatic amplitude");
        assert_close(i.hydrostatic_mean, mean.0 / 3.0, 1e-6, 1.0, "hydrostatic mean");
        assert_close(papadopoulos::mean_shear(&history), a.sqrt(), 1e-3, 0.0, "mean shear");
        let crossland = STEEL.torsion / (j2 + (3.0 * STEEL.torsion / STEEL.bending - 3f64.sqrt()) * (s + mean.0) / 3.0);
        if crossland > 0.0 {
            assert_close(factor(&history, Criterion::CROSSLAND, &STEEL), crossland, 4e-5, 0.0, "Crossland");
        }
    }
    // where samples meet the axes of the ellipse exactly, so do the invariants
    for (s, t) in [(300e6, 0.0), (0.0, 200e6), (300e6, 100e6)] {
        let i = Invariants::of(&bending_and_torsion((50e6, 0.0), (s, t), FRAC_PI_2));
        assert_close(i.sqrt_j2_amplitude, (s / 3f64.sqrt()).max(t), 1e-6, 0.0, "in quadrature");
        let i = Invariants::of(&bending_and_torsion((50e6, 0.0), (s, t), 0.0));
        assert_close(i.sqrt_j2_amplitude, (s * s / 3.0 + t * t).sqrt(), 1e-6, 0.0, "in phase");
    }
}

/// What a criterion is calibrated with gives a factor of one: reversed torsion and reversed bending for all, but for Sines (bending has no mean), McDiarmid (calibrated in torsion) and
/// repeated bending for Sines and the consistent Kakuno-Kawada; the printed constant of the latter misses repeated bending.
#[test]
fn calibration_gives_one() {
    let torsion = bending_and_torsion((0.0, 0.0), (0.0, STEEL.torsion), 0.0);
    let bending = bending_and_torsion((0.0, 0.0), (STEEL.bending, 0.0), 0.0);
    let repeated = bending_and_torsion((STEEL.repeated_bending, 0.0), (STEEL.repeated_bending, 0.0), 0.0);
    // that of Carpinteri and Spagnoli is calibrated with neither: below
    for c in Criterion::ALL.into_iter().filter(|c| *c != Criterion::CARPINTERI_SPAGNOLI) {
        assert_close(factor(&torsion, c, &STEEL), 1.0, 1e-3, 0.0, &format!("{} in torsion", c.name()));
        if ![Criterion::SINES, Criterion::MCDIARMID].contains(&c) {
            assert_close(factor(&bending, c, &STEEL), 1.0, 1e-3, 0.0, &format!("{} in bending", c.name()));
        }
    }
    for c in [Criterion::SINES, Criterion::KAKUNO_KAWADA_CONSISTENT] {
        assert_close(factor(&repeated, c, &STEEL), 1.0, 1e-6, 0.0, &format!("{} in repeated bending", c.name()));
    }
    let printed = factor(&repeated, Criterion::KAKUNO_KAWADA, &STEEL);
    assert!((printed - 1.0).abs() > 0.02, "the printed constant misses its own calibration: {printed}");
}

/// Closed forms by \[Carpinteri & Spagnoli 2001\]: with d = 3/2 (1 - (t/f)²) 45° the plane bears of a bending stress s the amplitudes s cos² d and s sin d cos d, of a torsion T those of T cos 2d and T sin 2d;
/// both limits are met exactly where t/f is 1/sqrt 3, and within 6 % between 1/sqrt 3 and 0.8 in bending. A mean stress in bending counts f/R times.
#[test]
fn carpinteri_and_spagnoli_in_bending_and_torsion() {
    for ratio in [1.0 / 3f64.sqrt(), 0.625, 0.7, 0.8, 1.0] {
        let steel = Limits { torsion: ratio * STEEL.bending, ..STEEL };
        let d: f64 = 1.5 * (1.0 - ratio * ratio) * FRAC_PI_2 / 2.0;
        let of = |normal: f64, shear: f64| (normal.powi(2) + (shear / ratio).powi(2)).sqrt() / steel.bending;
        let (s, mean, t) = (0.6 * steel.bending, 100e6, 0.5 * steel.torsion);
        let bending = of((s + steel.bending / steel.tensile * mean) * d.cos().powi(2), s * d.sin() * d.cos());
        let found = factor(&bending_and_torsion((mean, 0.0), (s, 0.0), 0.0), Criterion::CARPINTERI_SPAGNOLI, &steel);
        assert_close(found, 1.0 / bending, 1e-9, 0.0, &format!("bending, {ratio}"));
        let torsion = of(t * (2.0 * d).cos(), t * (2.0 * d).sin());
        let found = factor(&bending_and_torsion((0.0, 0.0), (0.0, t), 0.0), Criterion::CARPINTERI_SPAGNOLI, &steel);
        assert_close(found, 1.0 / torsion, 1e-9, 0.0, &format!("torsion, {ratio}"));
    }
}

/// Source: tests of Nishihara and Kawamoto on hard steel (f = 313.9 MPa, t = 196.2 MPa, R = 704 MPa), amplitudes of bending and torsion (MPa) at the endurance limit by their phase (degrees), as papers on such criteria
/// cite them after \[Papadopoulos et al. 1997\]; assumption: they were not read again in the source. Papadopoulos' criterion is within 6.5 %, that of Carpinteri and Spagnoli within 12 %.
#[test]
fn endurance_limits_of_hard_steel() {
    let steel = Limits { tensile: 704e6, bending: 313.9e6, torsion: 196.2e6, repeated_bending: Limits::goodman_repeated(313.9e6, 704e6) };
    let tests = [
        (138.1, 167.1, 0.0),
        (140.4, 169.9, 30.0),
        (145.7, 176.3, 60.0),
        (150.2, 181.7, 90.0),
        (245.3, 122.6, 0.0),
        (249.7, 124.8, 30.0),
        (252.4, 126.2, 60.0),
        (258.0, 129.0, 90.0),
        (299.1, 62.8, 0.0),
        (304.5, 63.9, 90.0),
    ];
    for (bending, torsion, phase) in tests {
        let history = bending_and_torsion((0.0, 0.0), (bending * 1e6, torsion * 1e6), f64::to_radians(phase));
        for (criterion, tolerance) in [(Criterion::PAPADOPOULOS, 0.065), (Criterion::CARPINTERI_SPAGNOLI, 0.12)] {
            let found = factor(&history, criterion, &steel);
            assert!((found - 1.0).abs() < tolerance, "{bending}, {torsion}, {phase}°, {}: {found}", criterion.name());
        }
    }
}

/// Source: \[Minucci 2010\] Tables 6.3 and 6.7 with his printed scalars (sqrt(J2)_a, hydrostatic amplitude and mean, MPa), t = 0.577 f and f0 by Goodman: Sines, Crossland and
/// Kakuno-Kawada as printed give his factors to their one decimal. (At point 1-3 his sqrt(J2)_a, 160, is below his shear amplitude, 174.5, which cannot be: he takes the largest of
/// pairwise circles, not the ball.)
#[test]
fn printed_scalars_give_the_printed_factors() {
    let steel = Limits { torsion: 0.577 * 720e6, repeated_bending: Limits::goodman_repeated(720e6, 1100e6), ..STEEL };
    let weight = |c: Criterion| c.weight(&steel).expect("a constant");
    for (point, [j2, amplitude, mean], printed) in [
        ("1-3 at 1700 rpm", [160.0, 85.7, 52.4], [1.9, 2.6, 1.9]),
        ("4-4 at 1700 rpm", [99.8, 135.4, 118.9], [1.8, 4.2, 1.8]),
        ("4 of the six", [114.5, 60.4, -15.7], [4.3, 3.6, 4.3]),
        ("1 of the six", [91.3, 77.2, 35.0], [3.2, 4.6, 3.2]),
    ] {
        let t = steel.torsion / 1e6;
        let sines = t / (j2 + weight(Criterion::SINES) * mean);
        let crossland = t / (j2 + weight(Criterion::CROSSLAND) * (amplitude + mean));
        let kakuno = t / (j2 + weight(Criterion::KAKUNO_KAWADA) * amplitude + weight(Criterion::SINES) * mean);
        for (own, printed) in [sines, crossland, kakuno].into_iter().zip(printed) {
            assert_close(own, printed, 0.0, 0.06, point);
        }
    }
}

/// `hartog fatigue` from a file with a repeated end of the cycle: the table of the contract, the same bytes at one and two threads, the factors of the library.
#[test]
fn a_table_of_histories() {
    let place = tempfile::tempdir().expect("folder");
    let mut random = Xoshiro256PlusPlus::seed_from_u64(12);
    let histories: Vec<History> = (0..12).map(|_| wild(&mut random, 72)).collect();
    let mut table = "point,crank_deg,sxx_mpa,syy_mpa,szz_mpa,sxy_mpa,syz_mpa,szx_mpa\n".to_owned();
    for (i, h) in histories.iter().enumerate() {
        for j in 0..=72 {
            let cells: Vec<String> = h.tensor(j % 72).iter().map(|s| format!("{}", s / 1e6)).collect();
            table.push_str(&format!("p{i},{},{}\n", 10 * j, cells.join(",")));
        }
    }
    std::fs::write(place.path().join("h.csv"), table).expect("written");
    let material = "tensile_strength_mpa = 1100\nbending_fatigue_limit_mpa = 720\ntorsion_fatigue_limit_mpa = 450\n";
    std::fs::write(place.path().join("m.toml"), material).expect("written");
    let run = |threads: &str| {
        let mut command = assert_cmd::Command::cargo_bin("hartog").expect("built");
        let arguments = ["fatigue", "h.csv", "--material", "m.toml", "--out", threads, "--threads", threads];
        command.current_dir(place.path()).args(arguments).assert().code(0);
        std::fs::read_to_string(place.path().join(threads).join("fatigue.csv")).expect("a table")
    };
    let (one, two) = (run("1"), run("2"));
    assert_eq!(one, two);
    let columns = "point,criterion,safety_factor,plane_theta_deg,plane_phi_deg,shear_amplitude_mpa,normal_max_mpa,sqrt_j2_amplitude_mpa,\
                   hydrostatic_amplitude_mpa,hydrostatic_mean_mpa,hydrostatic_max_mpa,note";
    assert_eq!(one.lines().next(), Some(columns));
    assert_eq!(one.lines().count(), 1 + 12 * Criterion::ALL.len());
    let limits = Limits { repeated_bending: Limits::goodman_repeated(720e6, 1100e6), ..STEEL };
    for (i, h) in histories.iter().enumerate() {
        let (verdicts, _) = evaluate(h, &limits, &Criterion::ALL, Grid::default()).expect("constants");
        for v in verdicts {
            let row = one.lines().find(|l| l.starts_with(&format!("p{i},{},", v.criterion.name()))).expect("a row");
            let factor: f64 = row.split(',').nth(2).expect("a factor").parse().expect("a number");
            assert_close(factor, v.safety_factor, 1e-9, 0.0, row);
        }
    }
}

/// Law: `--unit-loads` with `--loads` gives the table that the same histories, added up by hand, give: superposition is linear.
#[test]
fn superposition_of_unit_loads() {
    let place = tempfile::tempdir().expect("folder");
    let mut random = Xoshiro256PlusPlus::seed_from_u64(14);
    let names = ["x_1", "y_1", "torque_1"];
    let units: Vec<Vec<[f64; 6]>> =
        (0..5).map(|_| (0..3).map(|_| std::array::from_fn(|_| random.random_range(-0.02..0.02))).collect()).collect();
    let loads: Vec<[f64; 3]> = (0..72).map(|_| std::array::from_fn(|_| random.random_range(-3e3..9e3))).collect();
    let header = "sxx_mpa,syy_mpa,szz_mpa,sxy_mpa,syz_mpa,szx_mpa";
    let cells = |v: &[f64]| v.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let (mut unit, mut load) = (format!("point,load,{header}\n"), format!("crank_deg,{}\n", names.join(",")));
    let mut history = format!("point,crank_deg,{header}\n");
    for (i, point) in units.iter().enumerate() {
        for (name, tensor) in names.iter().zip(point) {
            unit += &format!("p{i},{name},{}\n", cells(tensor));
        }
        for (j, loads) in loads.iter().enumerate() {
            let sum: [f64; 6] = std::array::from_fn(|c| point.iter().zip(loads).map(|(t, l)| t[c] * l).sum());
            history += &format!("p{i},{},{}\n", 10 * j, cells(&sum));
        }
    }
    (0..72).for_each(|j| load += &format!("{},{}\n", 10 * j, cells(&loads[j])));
    let material = "tensile_strength_mpa = 1100\nbending_fatigue_limit_mpa = 720\ntorsion_fatigue_limit_mpa = 450\n";
    for (name, text) in [("u.csv", unit.as_str()), ("l.csv", &load), ("h.csv", &history), ("m.toml", material)] {
        std::fs::write(place.path().join(name), text).expect("written");
    }
    let run = |out: &str, arguments: &[&str]| {
        let mut command = assert_cmd::Command::cargo_bin("hartog").expect("built");
        command.current_dir(place.path()).arg("fatigue").args(arguments).args(["--material", "m.toml", "--out", out]).assert().code(0);
        let table = std::fs::read_to_string(place.path().join(out).join("fatigue.csv")).expect("a table");
        let factor = |line: &str| line.split(',').nth(2).and_then(|f| f.parse::<f64>().ok()).expect("a factor");
        table.lines().skip(1).map(factor).collect::<Vec<f64>>()
    };
    let (own, by_hand) = (run("u", &["--unit-loads", "u.csv", "--loads", "l.csv"]), run("h", &["h.csv"]));
    assert_eq!(own.len(), 5 * Criterion::ALL.len());
    for (own, by_hand) in own.iter().zip(&by_hand) {
        // rounding may choose another of two level planes
        assert_close(*own, *by_hand, 1e-6, 0.0, "a factor");
    }
}

/// A history that no symmetry helps: three harmonics with random phases in every component.
pub fn wild(random: &mut Xoshiro256PlusPlus, samples: usize) -> History {
    let mut component = || -> Vec<(f64, f64, f64)> {
        [1.0, 2.0, 5.0].map(|h| (random.random_range(-100e6..100e6) / h, h, random.random_range(0.0..TAU))).to_vec()
    };
    let parts: Vec<Vec<(f64, f64, f64)>> = (0..6).map(|_| component()).collect();
    let mean: Vec<f64> = (0..6).map(|_| random.random_range(-80e6..80e6)).collect();
    let at = |k: usize, a: f64| mean[k] + parts[k].iter().map(|(x, h, phase)| x * (h * a + phase).sin()).sum::<f64>();
    History::new((0..samples).map(|j| TAU * j as f64 / samples as f64).map(|a| std::array::from_fn(|k| at(k, a))))
}

/// Law: the amplitude of sqrt(J2) is never below the shear amplitude of any plane (the circle is a shadow of the ball); the longest chord is never above the circle, nor below
/// sqrt(3)/2 of it; the largest circle of two dimensions is never above the ball, nor below sqrt(2/5) of it, and does lie below the shear amplitude of a plane, as in \[Minucci 2010\].
#[test]
fn shadows_are_smaller() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(6);
    let mut below = 0;
    for _ in 0..60 {
        let h = wild(&mut random, 90);
        let ball = Invariants::of(&h).sqrt_j2_amplitude;
        let pairs = Invariants::by(&h, invariants::Amplitude::Pairs).sqrt_j2_amplitude;
        assert!(pairs <= ball * (1.0 + 1e-12) && pairs >= 0.4f64.sqrt() * ball);
        let mut scratch = Scratch::default();
        for _ in 0..40 {
            let plane = Plane { theta: random.random_range(0.0..TAU), phi: random.random_range(0.0..PI) };
            let circle = scratch.plane_stress(&h, &plane, Amplitude::Circle, None).shear_amplitude;
            let chord = scratch.plane_stress(&h, &plane, Amplitude::Chord, None).shear_amplitude;
            assert!(circle <= ball * (1.0 + 1e-12));
            below += usize::from(pairs < circle);
            assert!(chord <= circle * (1.0 + 1e-12) && chord >= 0.5 * 3f64.sqrt() * circle * (1.0 - 1e-12));
        }
    }
    assert!(below > 0, "circles of two dimensions lie below the shear of a plane");
}

/// A history in axes turned by a rotation (rows: the new axes in the old ones).
fn turned(history: &History, r: &[[f64; 3]; 3]) -> History {
    let at_sample = |j: usize| {
        let [xx, yy, zz, xy, yz, zx] = history.tensor(j);
        let s = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
        let at = |a: usize, b: usize| -> f64 { (0..3).map(|i| (0..3).map(|k| r[a][i] * s[i][k] * r[b][k]).sum::<f64>()).sum() };
        [at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(1, 2), at(2, 0)]
    };
    History::new((0..history.len()).map(at_sample))
}

/// Law: turning the axes changes no factor: invariants by less than 1e-6, planes by less than their tolerance of 1e-3, Papadopoulos by less than 1e-3.
#[test]
fn axes_do_not_matter() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(8);
    for _ in 0..8 {
        let h = wild(&mut random, 120);
        let (a, b, c) = (random.random_range(0.0..TAU), random.random_range(0.0..TAU), random.random_range(0.0..TAU));
        let z = |t: f64| [[t.cos(), t.sin(), 0.0], [-t.sin(), t.cos(), 0.0], [0.0, 0.0, 1.0]];
        let x = |t: f64| [[1.0, 0.0, 0.0], [0.0, t.cos(), t.sin()], [0.0, -t.sin(), t.cos()]];
        let turned = turned(&turned(&turned(&h, &z(a)), &x(b)), &z(c));
        let (before, _) = evaluate(&h, &STEEL, &Criterion::ALL, Grid::default()).expect("constants");
        let (after, _) = evaluate(&turned, &STEEL, &Criterion::ALL, Grid::default()).expect("constants");
        for (x, y) in before.iter().zip(&after) {
            let invariants = [
                Criterion::SINES,
                Criterion::CROSSLAND,
                Criterion::KAKUNO_KAWADA,
                Criterion::KAKUNO_KAWADA_CONSISTENT,
                Criterion::DANG_VAN_MESOSCOPIC,
            ];
            let tolerance = match x.criterion {
                c if invariants.contains(&c) => 1e-6,
                // which of nearly level planes wins decides their normal stress
                c if [Criterion::MATAKE, Criterion::MCDIARMID].contains(&c) => 5e-3,
                _ => 1e-3,
            };
            assert_close(y.safety_factor, x.safety_factor, tolerance, 0.0, x.criterion.name());
        }
    }
}

/// Both sides of Findley's interval: torsion limits from half to the whole of the bending limit, and no others.
#[test]
fn constants_have_intervals() {
    let with = |share: f64| Criterion::FINDLEY.weight(&Limits { torsion: share * STEEL.bending, ..STEEL });
    assert!(with(0.5).is_ok() && with(0.999).is_ok());
    assert!(with(0.4999).is_err() && with(1.0).is_err());
    let crossland = Criterion::CROSSLAND.weight(&Limits { torsion: 0.577 * STEEL.bending, ..STEEL }).expect("a constant");
    assert!(crossland.abs() < 2e-3, "near zero, as a user should know");
}

/// Law: the smallest circle holds the whole path and is met by it on more than half of its rim, or at both ends of a diameter.
#[test]
fn circle_round_the_path_of_the_deviator() {
    let point = |j: usize| {
        let t = std::f64::consts::TAU * j as f64 / 36.0;
        [40.0 * t.sin(), 100.0 + 160.0 * t.cos(), 0.0, 60.0 * t.sin() + 15.0 * (2.0 * t).cos(), 0.0, 0.0].map(|s| s * 1e6)
    };
    let history = History::new((0..36).map(point));
    let pair = invariants::largest_pair(&history);
    let distance = |j: usize| (pair.path[0][j] - pair.centre[0]).hypot(pair.path[1][j] - pair.centre[1]);
    let on_rim: Vec<f64> = (0..36)
        .filter(|j| distance(*j) > pair.radius * (1.0 - 1e-9))
        .map(|j| (pair.path[1][j] - pair.centre[1]).atan2(pair.path[0][j] - pair.centre[0]))
        .collect();
    assert!((0..36).all(|j| distance(j) <= pair.radius * (1.0 + 1e-9)), "inside");
    let mut sorted = on_rim.clone();
    sorted.sort_by(f64::total_cmp);
    let turn = std::f64::consts::TAU;
    let gaps = sorted.iter().zip(sorted.iter().skip(1).copied().chain(sorted.first().map(|a| a + turn))).map(|(a, b)| b - a);
    assert!(on_rim.len() >= 2 && gaps.fold(0.0, f64::max) <= 0.5 * turn + 1e-6, "{on_rim:?}");
}
