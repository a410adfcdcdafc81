//! Critical planes against brute-force searches.

use crate::multiaxial::{STEEL, bending_and_torsion, wild};
use crate::support::assert_close;
use hartog::fatigue::multiaxial::outline::{self, Row};
use hartog::fatigue::multiaxial::papadopoulos::mean_shear;
use hartog::fatigue::multiaxial::plane::{Amplitude, Plane, Scratch};
use hartog::fatigue::multiaxial::plane_state::Circle;
use hartog::fatigue::multiaxial::{Criterion, Grid, History, PlaneState, evaluate};
use hartog::numerics::hull::hull;
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Planes every so many degrees over half the sphere, azimuth by as much over the sine of the other angle.
fn hemisphere(step_deg: f64) -> impl Iterator<Item = Plane> {
    let rings = (90.0 / step_deg).round() as usize;
    (0..=rings).flat_map(move |i| {
        let phi = FRAC_PI_2 * i as f64 / rings as f64;
        let count = ((360.0 * phi.sin() / step_deg).round() as usize).max(1);
        (0..count).map(move |j| Plane { theta: TAU * j as f64 / count as f64, phi })
    })
}

/// Factors by planes every `step` degrees (azimuth by `step` over the sine of the other angle): Matake's and McDiarmid's plane with the largest shear, Dang Van, Findley.
fn brute_force(history: &History, step_deg: f64) -> [f64; 5] {
    let weight = |c: Criterion| c.weight(&STEEL).expect("a constant");
    let (k_findley, k_dv) = (weight(Criterion::FINDLEY), weight(Criterion::DANG_VAN_PLANE));
    let p = history.hydrostatic();
    let mut scratch = Scratch::default();
    let (mut shear, mut normal, mut dang_van, mut findley) = (0.0, f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY);
    for plane in hemisphere(step_deg) {
        let b = scratch.plane_stress(history, &plane, Amplitude::Circle, Some((k_dv, &p)));
        if b.shear_amplitude > shear {
            (shear, normal) = (b.shear_amplitude, b.normal_max);
        }
        dang_van = f64::max(dang_van, b.dang_van);
        findley = f64::max(findley, b.shear_amplitude + k_findley * b.normal_max);
    }
    let p_max = p.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let t = STEEL.torsion;
    [
        t / (shear + weight(Criterion::MATAKE) * normal),
        t / (shear + weight(Criterion::MCDIARMID) * normal),
        t / (shear + k_dv * p_max),
        t / dang_van,
        t * (1.0 + k_findley * k_findley).sqrt() / findley,
    ]
}

const ON_PLANES: [Criterion; 5] =
    [Criterion::MATAKE, Criterion::MCDIARMID, Criterion::DANG_VAN_THESIS, Criterion::DANG_VAN_PLANE, Criterion::FINDLEY];

/// Critical planes of harmonic and of wild histories against a brute-force search in steps of half a degree: shear amplitudes and sums to 1e-3. The normal stress on the plane of the
/// largest shear (Matake, McDiarmid) depends on which of nearly level planes wins: those two are compared where the search agrees on the plane's shear to 1e-4.
#[test]
fn critical_planes_against_brute_force() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(4);
    let histories: Vec<History> = (0..10)
        .map(|i| if i % 2 == 0 { wild(&mut random, 180) } else { bending_and_torsion((80e6, -30e6), (200e6, 150e6), f64::from(i) * 0.3) })
        .collect();
    let off: Vec<[f64; 5]> = histories
        .par_iter()
        .map(|h| {
            let (verdicts, _) = evaluate(h, &STEEL, &ON_PLANES, Grid::default()).expect("constants");
            let brute = brute_force(h, 0.5);
            std::array::from_fn(|i| verdicts[i].safety_factor / brute[i] - 1.0)
        })
        .collect();
    for o in &off {
        for (c, o) in ON_PLANES.iter().zip(o).skip(2) {
            assert!(o.abs() < 1e-3 && *o < 1e-5, "{}: {o:e}", c.name());
        }
    }
}

/// Harmonic bending and torsion at any phase and mean against a search in steps of a tenth of a degree, to 1e-3. Two planes are always level there, and the search meets the one or
/// the other first: for Matake and McDiarmid ours is that with the larger normal stress, whose factor is the smaller.
#[test]
#[ignore = "half a minute"]
fn harmonic_histories_against_a_tenth_of_a_degree() {
    let cases: Vec<f64> = (0..8).map(|i| 0.2 * f64::from(i)).collect();
    cases.par_iter().for_each(|phase| {
        let h = bending_and_torsion((80e6 * phase, -30e6), (200e6, 150e6 - 40e6 * phase), *phase);
        let (verdicts, _) = evaluate(&h, &STEEL, &ON_PLANES, Grid::default()).expect("constants");
        let brute = brute_force(&h, 0.1);
        for (v, brute) in verdicts.iter().zip(brute) {
            let off = v.safety_factor / brute - 1.0;
            println!("phase {phase:.1}: {} {off:e}, {}", v.criterion.name(), v.note);
            let larger_normal = [Criterion::MATAKE, Criterion::MCDIARMID].contains(&v.criterion) && !v.note.is_empty() && off < 0.0;
            assert!(larger_normal || off.abs() < 1e-3, "{} at phase {phase}: {off:e}", v.criterion.name());
        }
    });
}

/// Shear amplitude and largest normal stress of the planes of largest shear: the best of a search in steps of one degree, each followed on finer grids of 21 by 21 planes to 0.007 degrees.
fn planes_of_largest_shear(history: &History) -> Vec<(f64, f64)> {
    let mut scratch = Scratch::default();
    let mut shear = |plane: &Plane| scratch.plane_stress(history, plane, Amplitude::Circle, None);
    let all: Vec<(Plane, f64)> = hemisphere(1.0).map(|plane| (plane, shear(&plane).shear_amplitude)).collect();
    let top = all.iter().map(|a| a.1).fold(0.0, f64::max);
    let mut best: Vec<(Plane, f64)> = all.into_iter().filter(|a| a.1 > 0.998 * top).collect();
    best.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut hills: Vec<Plane> = Vec::new();
    for (plane, _) in best {
        let apart = |a: &Plane| a.normal().iter().zip(plane.normal()).map(|(a, b)| a * b).sum::<f64>().abs() < 2f64.to_radians().cos();
        if hills.iter().all(apart) {
            hills.push(plane);
        }
    }
    let finer = |mut centre: Plane| {
        for step in [0.07f64, 0.007] {
            let grid = (0..441).map(|i| (f64::from(i % 21 - 10), f64::from(i / 21 - 10)));
            let planes = grid.map(|(a, b)| centre.moved((a * step).to_radians(), (b * step).to_radians()));
            let values: Vec<(Plane, f64)> = planes.map(|p| (p, shear(&p).shear_amplitude)).collect();
            centre = values.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).expect("planes").0;
        }
        let b = shear(&centre);
        (b.shear_amplitude, b.normal_max)
    };
    hills.into_iter().map(finer).collect()
}

/// All criteria on 4160 points of 721 angles against a search in steps of one degree: nothing that it found is missed by more than 0.1 %. What is found may be worse than what the
/// grid met, which misses ridges of Dang Van's sum by up to 0.4 %. Matake and McDiarmid ask for the normal stress on the plane of the largest shear, which changes by up to 2 % of the shear within
/// the grid's half degree: for them the grid's best planes are followed to their summits. The shear found is theirs to 0.02 % (of planes level to 0.01 % the one with the larger normal stress is named); where it is that level along a ridge, the normal stress depends on the place on
/// the ridge, and the factor by up to 0.5 %. The thesis dropped to twelve points for want of time. Prints the time of both.
#[test]
#[ignore = "five minutes"]
fn four_thousand_points_against_brute_force() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(10);
    let histories: Vec<History> = (0..4160).map(|_| wild(&mut random, 721)).collect();
    let start = std::time::Instant::now();
    let found: Vec<_> = histories.par_iter().map(|h| evaluate(h, &STEEL, &Criterion::ALL, Grid::default()).expect("constants").0).collect();
    println!("all criteria: {:.1} s", start.elapsed().as_secs_f64());
    let start = std::time::Instant::now();
    let brute: Vec<[f64; 5]> = histories.par_iter().map(|h| brute_force(h, 1.0)).collect();
    println!("brute force: {:.1} s", start.elapsed().as_secs_f64());
    let largest: Vec<Vec<(f64, f64)>> = histories.par_iter().map(planes_of_largest_shear).collect();
    let (mut missed, mut better) = ([0.0f64; 5], [0.0f64; 5]);
    let mut lower = 0.0f64;
    for ((verdicts, brute), largest) in found.iter().zip(&brute).zip(&largest) {
        let top = largest.iter().map(|l| l.0).fold(0.0, f64::max);
        lower = lower.max(1.0 - verdicts[0].shear_amplitude.expect("a plane") / top);
        for (i, c) in ON_PLANES.iter().enumerate() {
            let own = verdicts.iter().find(|v| v.criterion == *c).expect("evaluated").safety_factor;
            let off = if i < 2 {
                let k = c.weight(&STEEL).expect("a constant");
                let level = largest.iter().filter(|l| l.0 > top * (1.0 - 2e-4));
                let off = level.map(|(shear, normal)| own * (shear + k * normal) / STEEL.torsion - 1.0);
                off.min_by(|a, b| a.abs().total_cmp(&b.abs())).expect("a plane")
            } else {
                own / brute[i] - 1.0
            };
            missed[i] = missed[i].max(off);
            better[i] = better[i].max(-off);
        }
    }
    println!("missed at most {missed:?}, better by at most {better:?}; shear lower by at most {lower:e}");
    assert!(lower < 2e-4, "a plane of larger shear: {lower:e}");
    for (i, c) in ON_PLANES.iter().enumerate() {
        let on_ridges = i < 2;
        assert!(missed[i] < if on_ridges { 5e-3 } else { 1e-3 }, "{}: {:e}", c.name(), missed[i]);
        assert!(!on_ridges || better[i] < 5e-3, "{}: {:e}", c.name(), better[i]);
    }
}

/// Law: on a plane state of one normal stress and its shear no plane has a larger circle than that which the chord of the path or the ascent finds. Against a search of the general history in steps of one
/// degree followed to 0.007 degrees: the grid's best shear is reached, and exceeded by no more than its steps allow; of planes level to 1e-4 the
/// largest normal stress is named, to 1 % of the shear because the search takes planes closer than two degrees for one.
#[test]
fn largest_shear_of_plane_states() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(12);
    let mut draw = |low: f64, high: f64| rand::Rng::random_range(&mut random, low..high);
    let states: Vec<(Vec<f64>, Vec<f64>)> = (0..60)
        .map(|case| {
            let (size, turn) = (draw(0.1, 3.0), draw(0.0, TAU));
            let at = |j: usize| TAU * j as f64 / 72.0;
            match case % 4 {
                // an ellipse, two harmonics, points anywhere, a triangle of nearly equal sides
                0 => (0..72).map(|j| (100e6 * at(j).cos(), 60e6 * size * (at(j) + turn).cos())).unzip(),
                1 => (0..72).map(|j| (80e6 * at(j).cos() + 40e6, 50e6 * size * (2.0 * at(j) + turn).cos() + 30e6 * at(j).sin())).unzip(),
                2 => (0..6).map(|_| (draw(-100e6, 150e6), size * draw(-80e6, 60e6))).unzip(),
                _ => (0..3)
                    .map(|j| (at(24 * j) + turn, draw(0.97, 1.03)))
                    .map(|(angle, far)| (100e6 * far * angle.cos(), 50e6 * far * angle.sin()))
                    .unzip(),
            }
        })
        .collect();
    let (mut circles, mut off) = (0, 0.0f64);
    for (normal, shear) in &states {
        let found = PlaneState::of(normal.clone(), shear.clone()).largest_shear();
        let history = History::new(normal.iter().zip(shear).map(|(s, t)| [*s, 0.0, 0.0, *t, 0.0, 0.0]));
        let all = planes_of_largest_shear(&history);
        let top = all.iter().map(|a| a.0).fold(0.0, f64::max);
        let share = found.amplitude / top - 1.0;
        assert!(share > -1e-4, "a plane of larger shear: {share:e}");
        assert!(share < 1e-6, "more than any plane has: {share:e}");
        off = off.max(-share);
        let nearest = all.iter().filter(|a| a.0 >= top * (1.0 - 2e-4)).map(|a| (found.normal_max - a.1).abs() / top);
        assert!(nearest.fold(f64::INFINITY, f64::min) < 1e-2, "{found:?} {all:?}");
        let pairs = (0..normal.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let chord = pairs.map(|(i, j)| (0.5 * (normal[i] - normal[j])).hypot(shear[i] - shear[j])).fold(0.0, f64::max);
        circles += usize::from(found.amplitude > 0.5 * chord * 1.001);
    }
    println!("{circles} of {} are held by three points; lower by at most {off:e}", states.len());
    assert!(circles > 8, "both ways are asked: {circles}");
}

/// Law: the circle of a path is that of the corners of its hull. Long smooth paths, whose circle neighbouring samples hold, some of them nearly flat: the same radius to 1e-12 from all samples
/// and from corners, no sample outside it by more than 1e-12 of it, and the same factor by Dang Van to 1e-6: a centre is right to the root of that. Outlines bound all of it.
#[test]
fn circles_of_smooth_paths() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(41);
    for case in 0..800 {
        let flat = if case % 3 == 0 { 1e-3 } else { 1.0 };
        let mut wave = |size: f64| -> Vec<f64> {
            let parts: Vec<[f64; 2]> = (0..5).map(|_| [random.random_range(-size..size), random.random_range(0.0..TAU)]).collect();
            let at = |j: i32| TAU * f64::from(j) / 720.0;
            (0..720).map(|j| (1..).zip(&parts).map(|(h, [a, turn])| a * (f64::from(h) * at(j) + turn).cos()).sum()).collect()
        };
        let (normal, shear) = (wave(200e6), wave(100e6 * flat));
        let whole = PlaneState::of(normal.clone(), shear.clone());
        let corners = hull(&normal, &shear);
        let pick = |values: &[f64]| -> Vec<f64> { corners.iter().map(|i| values[*i]).collect() };
        let own = PlaneState::of(pick(&normal), pick(&shear));
        let (circle, expected) = (whole.circle(), own.circle());
        assert_close(circle.radius, expected.radius, 1e-12, 0.0, &format!("radius, case {case}"));
        let out = |(s, t): (&f64, &f64)| ((s - circle.centre[0]) / 3f64.sqrt()).hypot(t - circle.centre[1]);
        let farthest = normal.iter().zip(&shear).map(out).fold(0.0, f64::max);
        assert!(farthest <= circle.radius * (1.0 + 1e-12), "case {case}: a sample outside");
        if case % 100 == 0 {
            let history = History::new(normal.iter().zip(&shear).map(|(s, t)| [*s, 0.0, 0.0, *t, 0.0, 0.0]));
            let (verdicts, _) = evaluate(&history, &STEEL, &[Criterion::DANG_VAN_MESOSCOPIC], Grid::default()).expect("defined");
            let k = 3.0 * STEEL.torsion / STEEL.bending - 1.5;
            let tresca = |(s, t): (&f64, &f64)| {
                let (s0, t0) = (s - circle.centre[0], t - circle.centre[1]);
                (0.25 * s0 * s0 + t0 * t0).sqrt() + k * s / 3.0
            };
            let stress = normal.iter().zip(&shear).map(tresca).fold(f64::NEG_INFINITY, f64::max);
            assert_close(STEEL.torsion / stress, verdicts[0].safety_factor, 1e-6, 0.0, &format!("Dang Van, case {case}"));
        }
        bounded_by_outline(&format!("case {case}"), (&normal, &shear), &circle);
    }
}

/// The outline of a path holds it and what it bears where its torque is a twentieth larger, and four times as large: circle, mean shear and sums of the criteria that ask for them; and says no more than its 32 sides may: a
/// radius larger by the cosine of half the angle between two of them, a mean shear larger by twice as much.
fn bounded_by_outline(what: &str, (normal, shear): (&[f64], &[f64]), circle: &Circle) {
    let load: Vec<f64> = shear.iter().map(|t| t / -3e4).collect();
    let bounds = |rise: f64| outline::within(&Row::of(normal), (-3e4, &Row::of(&load)), rise);
    let ([own, little], [_, much]) = (bounds(1.05), bounds(4.0));
    for (rise, within) in [1.0, 1.05, 4.0].iter().zip(&[own, little, much]) {
        let (sides, rounding) = (1.0 / (rise * PI / 32.0).cos(), 1e-5);
        let risen: Vec<f64> = shear.iter().map(|t| rise * t).collect();
        let own = if *rise == 1.0 { *circle } else { PlaneState::of(normal.to_vec(), risen.clone()).circle() };
        let over = within.sqrt_j2_amplitude / own.radius;
        assert!((1.0..sides + rounding).contains(&over), "{what}: radius {over}");
        let (low, high) = within.middle.expect("a plane state");
        assert!(low <= own.centre[0] && own.centre[0] <= high, "{what}: centre {low} {} {high}", own.centre[0]);
        let history = History::new(normal.iter().zip(&risen).map(|(s, t)| [*s, 0.0, 0.0, *t, 0.0, 0.0]));
        let over = within.mean_shear / mean_shear(&history);
        assert!((1.0..1.02 * rise).contains(&over), "{what}: mean shear {over}");
        let (verdicts, _) = evaluate(&history, &STEEL, &SUMS, Grid::default()).expect("defined");
        for v in verdicts {
            let bound = v.criterion.at_most(within, &STEEL).expect("defined");
            assert!(bound >= 1.0 / v.safety_factor * (1.0 - 1e-12), "{what}: {} {bound}", v.criterion.name());
        }
    }
}

/// Criteria whose bounds ask for what an outline says.
const SUMS: [Criterion; 4] = [Criterion::CROSSLAND, Criterion::SINES, Criterion::DANG_VAN_MESOSCOPIC, Criterion::PAPADOPOULOS];
