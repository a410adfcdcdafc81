//! The critical planes: a coarse hemisphere with few samples, then every plane on it that could win is followed to its summit.

use super::climb::{Slope, Sought};
use super::history::History;
use super::invariants;
use super::plane::{Amplitude, Plane, PlaneStress, Scratch};
use crate::numerics::elementary::Elementary;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::LazyLock;

/// How planes are searched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// `None`: a coarse hemisphere, refined; else every so many rad in both angles, and no more, as the thesis did with 15 degrees.
    pub step: Option<f64>,
    /// How the amplitude of shear is taken.
    pub amplitude: Amplitude,
    /// How the amplitude of the deviator is taken.
    pub deviator: invariants::Amplitude,
}

impl Default for Grid {
    fn default() -> Self {
        Self { step: None, amplitude: Amplitude::Circle, deviator: invariants::Amplitude::Ball }
    }
}

/// What is searched for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wanted {
    /// The largest shear amplitude.
    pub shear: bool,
    /// The largest shear amplitude with so many times the largest normal stress.
    pub findley: Option<f64>,
    /// The largest sum over time of shear and so many times the hydrostatic stress.
    pub dang_van: Option<f64>,
}

/// A critical plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Critical {
    /// The plane.
    pub plane: Plane,
    /// What was to be large, Pa.
    pub value: f64,
    /// Pa.
    pub shear_amplitude: f64,
    /// Pa.
    pub normal_max: f64,
    /// Other planes as critical, in words.
    pub note: String,
}

/// Critical planes.
#[derive(Debug, Clone, PartialEq)]
pub struct CriticalPlanes {
    /// Of shear amplitude.
    pub shear: Option<Critical>,
    /// Of Findley's sum.
    pub findley: Option<Critical>,
    /// Of Dang Van's sum, plane by plane.
    pub dang_van: Option<Critical>,
}

/// Spacing of the coarse hemisphere, rad.
const COARSE: f64 = 5.0 * PI / 180.0;
/// Samples that are enough to tell hills from valleys.
const SAMPLES: usize = 180;
/// Planes between those of the coarse hemisphere, in its spacing along the two directions of each.
const BETWEEN: [(f64, f64); 4] = [(0.25, 0.25), (-0.25, 0.25), (-0.25, -0.25), (0.25, -0.25)];
/// Of planes closer than this to each other only the highest is followed, rad.
const NEIGHBOURS: f64 = 0.7 * COARSE;
/// A summit stands at most this share above the coarse plane nearest to it, seen with few samples: stress on a plane turns with twice the angle.
const RISE: f64 = 0.06;
/// More hills than this are parts of a ridge, as the planes at 45° to a single normal stress are: so many are climbed,
const MOST: usize = 24;
/// and so many of the highest looked at all round.
const ALL_ROUND: usize = 6;
/// Hills this much lower than the highest are looked at all round: a higher one may hide beside them.
const HIDDEN: f64 = 0.004;
/// Planes whose values differ by less than this share are as critical as each other.
pub(super) const LEVEL: f64 = 1e-4;
/// Summits closer than this are one, rad.
const SAME: f64 = 0.5 * PI / 180.0;

/// Planes of the coarse hemisphere.
static HEMISPHERE: LazyLock<Vec<Plane>> = LazyLock::new(|| {
    let rings = (FRAC_PI_2 / COARSE).round() as usize;
    let mut planes = vec![Plane { theta: 0.0, phi: 0.0 }];
    for ring in 1..=rings {
        let phi = FRAC_PI_2 * ring as f64 / rings as f64;
        // on the equator half a turn is enough
        let (turn, share) = if ring == rings { (PI, 0.5) } else { (2.0 * PI, 1.0) };
        let count = (share * 2.0 * PI * phi.sine() / COARSE).round() as usize;
        planes.extend((0..count).map(|i| Plane { theta: turn * i as f64 / count as f64, phi }));
    }
    planes
});

/// The planes with no higher one closer than so many rad, highest first.
fn tops(mut seen: Vec<(Plane, f64)>, near: f64) -> Vec<Plane> {
    seen.sort_by(|a, b| b.1.total_cmp(&a.1));
    let normals: Vec<[f64; 3]> = seen.iter().map(|s| s.0.normal()).collect();
    let level = near.cosine();
    let far = |a: &[f64; 3], b: &[f64; 3]| (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]).abs() < level;
    (0..seen.len()).filter(|i| normals[..*i].iter().all(|n| far(n, &normals[*i]))).map(|i| seen[i].0).collect()
}

/// Angle between two planes, rad.
fn apart(a: &Plane, b: &Plane) -> f64 {
    let (a, b) = (a.normal(), b.normal());
    let dot: f64 = (0..3).map(|d| a[d] * b[d]).sum();
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    cross.iter().map(|c| c * c).sum::<f64>().sqrt().arctangent(dot.abs())
}

/// Planes every `step` in both angles over the sphere, as the thesis takes them.
fn every(step: f64) -> Vec<Plane> {
    let count = (PI / step).round() as usize;
    (0..count).flat_map(|i| (0..=count).map(move |j| Plane { theta: i as f64 * step, phi: j as f64 * step })).collect()
}

/// Finds what is wanted.
pub fn search(history: &History, wanted: &Wanted, grid: Grid) -> CriticalPlanes {
    let none = CriticalPlanes { shear: None, findley: None, dang_van: None };
    if *wanted == (Wanted { shear: false, findley: None, dang_van: None }) {
        return none;
    }
    let p = history.hydrostatic();
    let stride = if grid.step.is_some() { 1 } else { (history.len() / SAMPLES).max(1) };
    let (few, few_p) = (history.every(stride), p.iter().step_by(stride).copied().collect::<Vec<f64>>());
    let own: Vec<Plane>;
    let planes: &[Plane] = match grid.step {
        None => &HEMISPHERE,
        Some(step) => {
            own = every(step);
            &own
        }
    };
    let mut scratch = Scratch::default();
    let few_dang_van = wanted.dang_van.map(|k| (k, few_p.as_slice()));
    let all: Vec<PlaneStress> = planes.iter().map(|plane| scratch.plane_stress(&few, plane, grid.amplitude, few_dang_van)).collect();
    let mut largest = |sought: Sought| {
        let critical = |(plane, b): (Plane, PlaneStress)| {
            let PlaneStress { shear_amplitude, normal_max, .. } = b;
            Critical { plane, value: sought.value(&b), shear_amplitude, normal_max, note: String::new() }
        };
        let values: Vec<f64> = all.iter().map(|b| sought.value(b)).collect();
        let top = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if grid.step.is_some() {
            let level = (0..planes.len()).filter(|i| values[*i] >= top - LEVEL * top.abs());
            return choose(level.map(|i| critical((planes[i], all[i].clone()))).collect());
        }
        // what stands close to the top is looked at twice as closely
        let mut seen: Vec<(Plane, f64)> = Vec::new();
        for (plane, value) in planes.iter().zip(&values).filter(|v| *v.1 >= top - RISE * top.abs()) {
            seen.push((*plane, *value));
            for (a, b) in BETWEEN {
                let next = plane.moved(a * COARSE, b * COARSE);
                seen.push((next, sought.value(&scratch.plane_stress(&few, &next, grid.amplitude, few_dang_van))));
            }
        }
        let candidates = tops(seen, NEIGHBOURS);
        let mut slope = Slope { history, p: &p, sought, amplitude: grid.amplitude, scratch: Scratch::default() };
        let mut hills: Vec<(Plane, PlaneStress)> =
            candidates.iter().take(MOST).map(|plane| slope.climb(*plane, 0.25 * COARSE, false)).collect();
        let top = hills.iter().map(|h| sought.value(&h.1)).fold(f64::NEG_INFINITY, f64::max);
        let high = hills.iter().filter(|h| sought.value(&h.1) >= top - HIDDEN * top.abs()).map(|h| (h.0, sought.value(&h.1)));
        let mut summits: Vec<(Plane, PlaneStress)> =
            tops(high.collect(), SAME).iter().take(ALL_ROUND).map(|plane| slope.climb(*plane, 0.05 * COARSE, true)).collect();
        // the others are known roughly: near a summit they are that summit again
        hills.retain(|h| summits.iter().all(|s| apart(&s.0, &h.0) > NEIGHBOURS));
        summits.append(&mut hills);
        choose(summits.into_iter().map(critical).collect())
    };
    CriticalPlanes {
        shear: wanted.shear.then(|| largest(Sought::Shear)).flatten(),
        findley: wanted.findley.and_then(|k| largest(Sought::Findley(k))),
        dang_van: wanted.dang_van.and_then(|k| largest(Sought::DangVan(k))),
    }
}

/// The highest summit; of level ones that with the larger normal stress, and a word about the others.
fn choose(mut summits: Vec<Critical>) -> Option<Critical> {
    let top = summits.iter().map(|s| s.value).reduce(f64::max)?;
    summits.retain(|s| s.value >= top - LEVEL * top.abs());
    summits.sort_by(|a, b| b.normal_max.total_cmp(&a.normal_max));
    let mut different: Vec<Critical> = Vec::new();
    for s in summits {
        if different.iter().all(|d| apart(&d.plane, &s.plane) > SAME) {
            different.push(s);
        }
    }
    let others = different.len() - 1;
    let mut chosen = different.swap_remove(0);
    // what is reported as the value is the highest, whichever plane is named
    chosen.value = chosen.value.max(top);
    if others > 0 {
        chosen.note = format!(
            "{others} other plane{} as critical; the one with the larger normal stress is named",
            if others == 1 { "" } else { "s" }
        );
    }
    Some(chosen)
}
