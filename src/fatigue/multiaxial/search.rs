//! The critical planes: a coarse hemisphere, then every plane on it that could win is followed to its summit.

use super::history::History;
use super::plane::{Amplitude, Borne, Plane, Scratch};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::LazyLock;

/// How planes are searched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// `None`: a coarse hemisphere, refined; else every so many rad in both angles, and no more, as the thesis did with 15 degrees.
    pub step: Option<f64>,
    /// How the amplitude of shear is taken.
    pub amplitude: Amplitude,
}

impl Default for Grid {
    fn default() -> Self {
        Self { step: None, amplitude: Amplitude::Circle }
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
pub struct Found {
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
/// Neighbours on it lie within this multiple of the spacing.
const NEAR: f64 = 1.6;
/// A summit stands at most this share above the coarse plane nearest to it, seen with few samples: stress on a plane turns with twice the angle.
const RISE: f64 = 0.08;
/// The climb ends with steps of this, rad: the value is then known to its square.
const FINEST: f64 = 0.02 * PI / 180.0;
/// With few samples steps of this are fine enough, rad,
const ROUGH: f64 = 0.3 * PI / 180.0;
/// and values err by less than this share.
const FEW: f64 = 0.02;
/// Planes whose values differ by less than this share are as critical as each other.
const LEVEL: f64 = 1e-4;
/// Summits closer than this are one, rad.
const SAME: f64 = 0.5 * PI / 180.0;

/// Planes of the coarse hemisphere with the indices of their neighbours.
static HEMISPHERE: LazyLock<(Vec<Plane>, Vec<Vec<usize>>)> = LazyLock::new(|| {
    let rings = (FRAC_PI_2 / COARSE).round() as usize;
    let mut planes = vec![Plane { theta: 0.0, phi: 0.0 }];
    for ring in 1..=rings {
        let phi = FRAC_PI_2 * ring as f64 / rings as f64;
        // on the equator half a turn is enough
        let (turn, share) = if ring == rings { (PI, 0.5) } else { (2.0 * PI, 1.0) };
        let count = (share * 2.0 * PI * phi.sin() / COARSE).round() as usize;
        planes.extend((0..count).map(|i| Plane { theta: turn * i as f64 / count as f64, phi }));
    }
    let near = |a: &Plane| (0..planes.len()).filter(|i| (1e-9..NEAR * COARSE).contains(&apart(a, &planes[*i]))).collect();
    let neighbours = planes.iter().map(near).collect();
    (planes, neighbours)
});

/// Angle between two planes, rad.
fn apart(a: &Plane, b: &Plane) -> f64 {
    let (a, b) = (a.normal(), b.normal());
    let dot: f64 = (0..3).map(|d| a[d] * b[d]).sum();
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    cross.iter().map(|c| c * c).sum::<f64>().sqrt().atan2(dot.abs())
}

/// Planes every `step` in both angles over the sphere, as the thesis takes them.
fn every(step: f64) -> Vec<Plane> {
    let count = (PI / step).round() as usize;
    (0..count).flat_map(|i| (0..=count).map(move |j| Plane { theta: i as f64 * step, phi: j as f64 * step })).collect()
}

/// Finds what is wanted.
pub fn search(history: &History, wanted: &Wanted, grid: Grid) -> Found {
    let p = history.hydrostatic();
    let mut scratch = Scratch::default();
    let dang_van = wanted.dang_van.map(|k| (k, p.as_slice()));
    let mut borne = |plane: &Plane| scratch.borne(history, plane, grid.amplitude, dang_van);
    if !(wanted.shear || wanted.findley.is_some() || wanted.dang_van.is_some()) {
        return Found { shear: None, findley: None, dang_van: None };
    }
    let own: Vec<Plane>;
    let planes: &[Plane] = match grid.step {
        None => &HEMISPHERE.0,
        Some(step) => {
            own = every(step);
            &own
        }
    };
    let stride = if grid.step.is_some() { 1 } else { (history.len() / SAMPLES).max(1) };
    let (few, few_p) = (history.every(stride), p.iter().step_by(stride).copied().collect::<Vec<f64>>());
    let few_dang_van = wanted.dang_van.map(|k| (k, few_p.as_slice()));
    let mut few_scratch = Scratch::default();
    let all: Vec<Borne> = planes.iter().map(|plane| few_scratch.borne(&few, plane, grid.amplitude, few_dang_van)).collect();
    let mut on_few = |plane: &Plane| few_scratch.borne(&few, plane, grid.amplitude, few_dang_van);
    let mut largest = |value: &dyn Fn(&Borne) -> f64| {
        let critical = |(plane, b): (Plane, Borne)| {
            let Borne { shear_amplitude, normal_max, .. } = b;
            Critical { plane, value: value(&b), shear_amplitude, normal_max, note: String::new() }
        };
        let values: Vec<f64> = all.iter().map(value).collect();
        let top = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if grid.step.is_some() {
            let level = (0..planes.len()).filter(|i| values[*i] >= top - LEVEL * top.abs());
            return choose(level.map(|i| critical((planes[i], all[i].clone()))).collect());
        }
        let is_top = |i: &usize| HEMISPHERE.1[*i].iter().all(|n| values[*i] >= values[*n]);
        let candidates = (0..planes.len()).filter(is_top).filter(|i| values[*i] >= top - RISE * top.abs());
        // with few samples first: most hills turn out too low
        let mut hills: Vec<(Plane, Borne)> = Vec::new();
        for i in candidates {
            let hill = climb((planes[i], all[i].clone()), (0.5 * COARSE, ROUGH), value, &mut on_few);
            if hills.iter().all(|h| apart(&h.0, &hill.0) > SAME) {
                hills.push(hill);
            }
        }
        let top = hills.iter().map(|h| value(&h.1)).fold(f64::NEG_INFINITY, f64::max);
        hills.retain(|h| value(&h.1) >= top - FEW * top.abs());
        let summits = hills.into_iter().map(|(plane, _)| {
            let start = (plane, borne(&plane));
            critical(climb(start, (4.0 * ROUGH, FINEST), value, &mut borne))
        });
        choose(summits.collect())
    };
    Found {
        shear: wanted.shear.then(|| largest(&|b| b.shear_amplitude)).flatten(),
        findley: wanted.findley.and_then(|k| largest(&|b| b.shear_amplitude + k * b.normal_max)),
        dang_van: wanted.dang_van.and_then(|_| largest(&|b| b.dang_van)),
    }
}

/// Rings round a summit on which higher ground is looked for, rad, and planes on each: where the path's extremes change hands, ridges have kinks that steps along two
/// directions do not follow.
const RINGS: [f64; 3] = [4.0 * PI / 180.0, 1.5 * PI / 180.0, 0.5 * PI / 180.0];
const ON_RING: usize = 16;

/// To a summit with no higher ground round it, with steps from the first to the last.
fn climb(
    start: (Plane, Borne),
    (first, last): (f64, f64),
    value: &dyn Fn(&Borne) -> f64,
    borne: &mut dyn FnMut(&Plane) -> Borne,
) -> (Plane, Borne) {
    let mut here = uphill(start, (first, last), value, borne);
    for radius in RINGS.into_iter().filter(|r| *r < 2.0 * first && *r > last) {
        let ring = (0..ON_RING).map(|i| (2.0 * PI * i as f64 / ON_RING as f64).sin_cos());
        let best = ring
            .map(|(sine, cosine)| {
                let next = here.0.moved(radius * cosine, radius * sine);
                (next, borne(&next))
            })
            .reduce(|m, r| if value(&r.1) > value(&m.1) { r } else { m });
        if let Some(higher) = best.filter(|b| value(&b.1) > value(&here.1)) {
            here = uphill(higher, (0.5 * radius, last), value, borne);
        }
    }
    here
}

/// From a plane uphill, with steps that shrink where no neighbour is higher.
fn uphill(
    (mut plane, mut here): (Plane, Borne),
    (mut step, last): (f64, f64),
    value: &dyn Fn(&Borne) -> f64,
    borne: &mut dyn FnMut(&Plane) -> Borne,
) -> (Plane, Borne) {
    let mut height = value(&here);
    while step > last {
        let mut best: Option<(Plane, Borne, f64)> = None;
        let d = step * std::f64::consts::FRAC_1_SQRT_2;
        for (a, b) in [(step, 0.0), (0.0, step), (-step, 0.0), (0.0, -step), (d, d), (-d, d), (-d, -d), (d, -d)] {
            let next = plane.moved(a, b);
            let there = borne(&next);
            let v = value(&there);
            if v > best.as_ref().map_or(height, |b| b.2) {
                best = Some((next, there, v));
            }
        }
        match best {
            Some((next, there, v)) => (plane, here, height) = (next, there, v),
            None => step *= 0.5,
        }
    }
    (plane, here)
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
