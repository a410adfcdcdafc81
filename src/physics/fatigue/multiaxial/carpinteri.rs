//! The critical plane of \[Carpinteri & Spagnoli 2001\] as \[Carpinteri et al. 2011\] take it: its normal lies at an angle from the direction of the largest principal stress at the instant when that is
//! largest over the cycle, towards the direction of the smallest. The angle is 45° for torsion limits of 1/sqrt 3 of the bending limit, where shear decides, and none for equal limits, where cracks open by
//! normal stress.

use super::criterion::Limits;
use super::history::History;
use super::plane::{Plane, Scratch, resolved};
use super::search::Critical;
use crate::numerics::elementary::Elementary;
use nalgebra::Matrix3;
use std::f64::consts::{FRAC_PI_4, PI};

/// Instants whose largest principal stress is less by no more than this share count alike: the plane that is used more decides.
const ALIKE: f64 = 1e-9;
/// Directions of a turn, 2° apart: a stress on the plane turns with twice the angle, 6e-4 within half a step.
const ROUND: usize = 180;

/// Angle between the normal of the plane and the direction of the largest principal stress, rad: 3/2 (1 - (t/f)²) 45°, from none to 45° outside the limits it is made for.
pub(super) fn angle(l: &Limits) -> f64 {
    (1.5 * (1.0 - (l.torsion / l.bending).powi(2))).clamp(0.0, 1.0) * FRAC_PI_4
}

/// Instants whose largest principal stress is less by no more than this share are looked at exactly: more than what [`largest`] may be off by.
const NEAR: f64 = 1e-6;

/// The largest principal stress by the angle of Lode, to 1e-8 where two principal stresses are level.
fn largest([xx, yy, zz, xy, yz, zx]: [f64; 6]) -> f64 {
    let p = (xx + yy + zz) / 3.0;
    let (a, b, c) = (xx - p, yy - p, zz - p);
    let j2 = 0.5 * (a * a + b * b + c * c) + xy * xy + yz * yz + zx * zx;
    if j2 == 0.0 {
        return p;
    }
    let j3 = a * (b * c - yz * yz) - xy * (xy * c - yz * zx) + zx * (xy * yz - b * zx);
    let root = (j2 / 3.0).sqrt();
    p + 2.0 * root * ((0.5 * j3 / root / root / root).clamp(-1.0, 1.0).arccosine() / 3.0).cosine()
}

/// Principal stresses with their directions, the largest first.
fn principal([xx, yy, zz, xy, yz, zx]: [f64; 6]) -> [(f64, [f64; 3]); 3] {
    let found = Matrix3::new(xx, xy, zx, xy, yy, yz, zx, yz, zz).symmetric_eigen();
    let mut all = [0, 1, 2].map(|i| (found.eigenvalues[i], [0, 1, 2].map(|d| found.eigenvectors[(d, i)])));
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    all
}

/// Whether the two smaller principal stresses are level.
fn are_level([(most, _), (middle, _), (least, _)]: &[(f64, [f64; 3]); 3]) -> bool {
    middle - least <= ALIKE * (most - least)
}

/// Directions that the normal may lean towards: that of the smallest principal stress, either way; all round where the two smaller ones are level, as in bending alone.
fn towards(stresses: &[(f64, [f64; 3]); 3]) -> Vec<[f64; 3]> {
    let [_, (_, second), (_, third)] = stresses;
    let count = if are_level(stresses) { ROUND } else { 2 };
    let direction = |i: usize| {
        let (sine, cosine) = (2.0 * PI * i as f64 / count as f64).sine_cosine();
        [0, 1, 2].map(|d| cosine * third[d] + if count > 2 { sine * second[d] } else { 0.0 })
    };
    (0..count).map(direction).collect()
}

/// The plane with its equivalent shear stress, Pa: t/f times sqrt((N_a + f N_m/R)² + (f/t)² C_a²) with amplitude N_a and mean N_m of the normal stress and amplitude C_a of the shear stress there, tensile
/// strength R. A mean pressure takes nothing off. Of several planes the one that is used most.
pub(super) fn critical(history: &History, l: &Limits) -> Critical {
    let roughly: Vec<f64> = (0..history.len()).map(|j| largest(history.tensor(j))).collect();
    let top = roughly.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let size = history.components.iter().flatten().fold(0.0, |m: f64, s| m.max(s.abs()));
    let near = (0..history.len()).filter(|j| roughly[*j] >= top - NEAR * size);
    let all: Vec<[(f64, [f64; 3]); 3]> = near.map(|j| principal(history.tensor(j))).collect();
    let top = all.iter().map(|p| p[0].0).fold(f64::NEG_INFINITY, f64::max);
    let (sine, cosine) = angle(l).sine_cosine();
    let mut scratch = Scratch::default();
    let mut evaluate_plane = |normal: [f64; 3]| {
        let plane = Plane::of(normal);
        let n = plane.normal();
        let (low, high) = history.range(&resolved(&n, &n));
        let shear_amplitude = scratch.circle(history, &plane).radius;
        let value = combined((0.5 * (high - low), 0.5 * (high + low)), shear_amplitude, l);
        Critical { plane, value, shear_amplitude, normal_max: high, note: String::new() }
    };
    let mut instants: Vec<&[(f64, [f64; 3]); 3]> = all.iter().filter(|p| p[0].0 >= top - ALIKE * top.abs()).collect();
    // instants of the same directions, as those of a stress that only grows, are one
    instants.dedup_by(|b, a| a.map(|s| s.1) == b.map(|s| s.1) && are_level(a) == are_level(b));
    let mut most: Option<Critical> = None;
    for stresses in instants {
        for direction in towards(stresses) {
            let found = evaluate_plane([0, 1, 2].map(|d| cosine * stresses[0].1[d] + sine * direction[d]));
            if most.as_ref().is_none_or(|m| found.value > m.value) {
                most = Some(found);
            }
        }
    }
    most.unwrap_or_else(|| evaluate_plane([1.0, 0.0, 0.0]))
}

/// Of amplitude and mean of the normal stress, and amplitude of the shear stress.
pub(super) fn combined((amplitude, mean): (f64, f64), shear: f64, l: &Limits) -> f64 {
    let normal = amplitude + l.bending * mean.max(0.0) / l.tensile;
    (l.torsion / l.bending * normal).hypotenuse(shear)
}
