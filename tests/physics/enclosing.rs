//! Smallest enclosing balls and convex hulls.

use crate::support::assert_close;
use hartog::numerics::enclosing::{Ball, smallest_ball};
use hartog::numerics::hull::hull;
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use std::f64::consts::TAU;

fn columns<const D: usize>(points: &[[f64; D]]) -> Vec<Vec<f64>> {
    (0..D).map(|d| points.iter().map(|p| p[d]).collect()).collect()
}

fn ball<const D: usize>(points: &[[f64; D]]) -> Ball<D> {
    let c = columns(points);
    smallest_ball(std::array::from_fn(|d| c[d].as_slice()))
}

/// Analytic answers, to 1e-10 of the size: one point, repeated points, two points, points on a line, an acute and an obtuse triangle, a circle of many points, a simplex in
/// five dimensions, its face, and cospherical points.
#[test]
fn balls_with_known_answers() {
    assert_eq!(ball(&[[3.0, 4.0]]).radius, 0.0);
    assert_eq!(ball(&[[3.0, 4.0]; 7]).radius, 0.0);
    assert_close(ball(&[[0.0, 0.0], [6.0, 8.0], [0.0, 0.0], [6.0, 8.0]]).radius, 5.0, 1e-12, 0.0, "two points, twice");
    let line: Vec<[f64; 2]> = (0..50).map(|i| [f64::from(i % 17), 2.0 * f64::from(i % 17)]).collect();
    let b = ball(&line);
    assert_close(b.radius, 8.0 * 5f64.sqrt(), 1e-12, 0.0, "a line");
    assert_close(b.centre[0], 8.0, 1e-12, 0.0, "its middle");
    let side = 3f64.sqrt();
    assert_close(ball(&[[0.0, 0.0], [side, 0.0], [0.5 * side, 1.5]]).radius, 1.0, 1e-12, 0.0, "an acute triangle");
    assert_close(ball(&[[0.0, 0.0], [10.0, 0.0], [4.0, 1.0]]).radius, 5.0, 1e-12, 0.0, "an obtuse triangle");
    let circle: Vec<[f64; 2]> = (0..721).map(|i| TAU * f64::from(i) / 720.0).map(|a| [7.0 + 2.0 * a.cos(), -1.0 + 2.0 * a.sin()]).collect();
    let b = ball(&circle);
    assert_close(b.radius, 2.0, 1e-10, 0.0, "cocircular points");
    assert_close(b.centre[0], 7.0, 1e-10, 0.0, "their centre");
    // the unit vectors of five dimensions and the origin: the face of the unit vectors holds the ball, radius sqrt(1 - 1/5)
    let mut simplex = vec![[0.0; 5]];
    simplex.extend((0..5).map(|d| std::array::from_fn(|i| if i == d { 1.0 } else { 0.0 })));
    assert_close(ball(&simplex).radius, 0.8f64.sqrt(), 1e-12, 0.0, "a simplex");
    let cross: Vec<[f64; 5]> =
        (0..10).map(|k| std::array::from_fn(|i| if i == k % 5 { if k < 5 { 3.0 } else { -3.0 } } else { 0.0 })).collect();
    assert_close(ball(&cross).radius, 3.0, 1e-12, 0.0, "cospherical points in five dimensions");
    let five: Vec<[f64; 5]> = (0..200).map(|i| std::array::from_fn(|d| f64::from(i) * [1.0, -2.0, 0.5, 0.0, 3.0][d])).collect();
    assert_close(ball(&five).radius, 0.5 * 199.0 * (1.0f64 + 4.0 + 0.25 + 9.0).sqrt(), 1e-12, 0.0, "a line in five dimensions");
}

fn check_ball<const D: usize>(points: &[[f64; D]]) {
    let b = ball(points);
    let distance = |p: &[f64; D]| (0..D).map(|d| (p[d] - b.centre[d]).powi(2)).sum::<f64>().sqrt();
    assert!(b.support().len() <= D + 1);
    for p in points {
        assert!(distance(p) <= b.radius * (1.0 + 1e-10), "a point lies outside");
    }
    if b.support().len() > 1 {
        for out in b.support() {
            let rest: Vec<[f64; D]> = b.support().iter().filter(|i| *i != out).map(|i| points[*i]).collect();
            assert!(ball(&rest).radius < b.radius, "a point of the support can be dropped");
        }
    }
}

/// Law, on 10⁴ random sets of points in two and five dimensions, some of them repeated, on a grid or thin: every point lies inside and no point of the support can be dropped.
#[test]
fn balls_of_random_points() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(1);
    for case in 0..5000 {
        let n = random.random_range(2..60);
        let thin = if case % 3 == 0 { 1e-6 } else { 1.0 };
        let coarse = case % 4 == 1;
        let mut value = |d: usize| {
            let x: f64 = random.random_range(-1.0..1.0);
            (if coarse { (4.0 * x).round() } else { x }) * if d == 0 { 1.0 } else { thin }
        };
        let plane: Vec<[f64; 2]> = (0..n).map(|_| std::array::from_fn(&mut value)).collect();
        let five: Vec<[f64; 5]> = (0..n).map(|_| std::array::from_fn(&mut value)).collect();
        check_ball(&plane);
        check_ball(&five);
    }
}

/// Law: the hull has corners only, in order, and holds every point; one point and points on a line leave one and two corners.
#[test]
fn hulls() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(15);
    assert_eq!(hull(&[2.0; 5], &[1.0; 5]).len(), 1);
    assert_eq!(hull(&[0.0, 1.0, 2.0, 3.0], &[1.0, 3.0, 5.0, 7.0]).len(), 2);
    assert_eq!(hull(&[0.0, 1.0, 1.0, 0.0, 0.5, 1.0], &[0.0, 0.0, 1.0, 1.0, 0.5, 0.5]).len(), 4);
    for case in 0..500 {
        let n = random.random_range(3..200);
        let mut value = |size: f64| if case % 3 == 0 { random.random_range(-3i32..4).into() } else { random.random_range(-size..size) };
        let (x, y): (Vec<f64>, Vec<f64>) = (0..n).map(|_| (value(1.0), value(1e8))).unzip();
        check_hull(&x, &y);
    }
    // long smooth paths, most of whose points lie next to the hull or well inside; far from zero, too
    for case in 0..24 {
        let mut value = |low: f64, high: f64| random.random_range(low..high);
        let (second, turn, far) = (value(0.0, 0.8), value(0.0, 6.0), if case % 2 == 0 { 0.0 } else { 1e6 });
        let at = |j: i32| TAU * f64::from(j) / 720.0;
        let x: Vec<f64> = (0..720).map(|j| far + at(j).cos() + second * (3.0 * at(j) + turn).sin()).collect();
        let y: Vec<f64> = (0..720).map(|j| 1e8 * (at(j).sin() + second * (5.0 * at(j)).cos())).collect();
        check_hull(&x, &y);
    }
}

fn check_hull(x: &[f64], y: &[f64]) {
    let corners = hull(x, y);
    for (i, a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        let (dx, dy) = (x[b] - x[*a], y[b] - y[*a]);
        for p in 0..x.len() {
            let left = dx * (y[p] - y[*a]) - dy * (x[p] - x[*a]);
            assert!(left >= -1e-12 * 1e8, "a point outside");
            assert!(!corners.contains(&p) || p == *a || p == b || left > 0.0, "no corner");
        }
    }
}
