//! From a plane uphill to the nearest one with no higher ground round it, at the cost of the few samples that decide.
//!
//! The smallest circle is held by two or three samples and the largest normal stress by one. Near a plane, all that can take over lie close to the circle or to the
//! largest value: steps look at those alone. At the summit all samples are asked again, and those that turn out to matter join.

use super::history::History;
use super::plane::{Amplitude, Borne, Plane, Scratch, resolved};
use std::f64::consts::PI;

/// What is to be large.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sought {
    /// The shear amplitude.
    Shear,
    /// The shear amplitude and so many times the largest normal stress.
    Findley(f64),
    /// The largest sum over time of shear and so many times the hydrostatic stress.
    DangVan(f64),
}

impl Sought {
    /// Its value on a plane, Pa.
    pub fn value(self, b: &Borne) -> f64 {
        match self {
            Self::Shear => b.shear_amplitude,
            Self::Findley(k) => b.shear_amplitude + k * b.normal_max,
            Self::DangVan(_) => b.dang_van,
        }
    }
}

/// Samples within this share of the circle's radius may come to matter.
const NEAR: f64 = 0.15;
/// A summit is where all samples say the same as the few, to this share.
const AGREED: f64 = 1e-9;
/// Rounds after which what has been reached must do.
const ROUNDS: usize = 12;
/// The climb ends with steps of this, rad.
const FINEST: f64 = 0.02 * PI / 180.0;
/// Directions of a step. Where the samples that hold the circle change, Dang Van's sum has ridges: the directions turn with every step that finds nothing, so that some
/// run along the ridge.
const DIRECTIONS: usize = 8;
const TURN: f64 = 0.618 * 2.0 * PI / DIRECTIONS as f64;
/// Rings round a summit on which higher ground is looked for, rad, and planes on each.
const RINGS: [f64; 3] = [4.0 * PI / 180.0, 1.5 * PI / 180.0, 0.5 * PI / 180.0];
const ON_RING: usize = 16;

/// A history, and what is sought on its planes.
#[derive(Debug)]
pub struct Slope<'a> {
    /// All samples.
    pub history: &'a History,
    /// Its hydrostatic stress.
    pub p: &'a [f64],
    /// What is to be large.
    pub sought: Sought,
    /// How the amplitude of shear is taken.
    pub amplitude: Amplitude,
    /// Buffers.
    pub scratch: Scratch,
}

impl Slope<'_> {
    fn borne(&mut self, plane: &Plane) -> Borne {
        let dang_van = if let Sought::DangVan(k) = self.sought { Some((k, self.p)) } else { None };
        self.scratch.borne(self.history, plane, self.amplitude, dang_van)
    }

    /// To a summit, with steps from the first downwards.
    pub fn climb(&mut self, start: Plane, first: f64) -> (Plane, Borne) {
        let sought = self.sought;
        let mut here = (start, self.borne(&start));
        let mut chosen = vec![false; self.history.len()];
        self.choose(&here, &mut chosen);
        for _ in 0..ROUNDS {
            let indices: Vec<usize> = (0..chosen.len()).filter(|i| chosen[*i]).collect();
            let (history, p) = (self.history.only(&indices), indices.iter().map(|i| self.p[*i]).collect::<Vec<f64>>());
            let mut few = Slope { history: &history, p: &p, sought, amplitude: self.amplitude, scratch: Scratch::default() };
            let top = few.summit(here.0, first);
            let there = (top.0, self.borne(&top.0));
            let agreed = (sought.value(&there.1) - sought.value(&top.1)).abs() <= AGREED * sought.value(&top.1).abs();
            self.choose(&there, &mut chosen);
            if sought.value(&there.1) > sought.value(&here.1) {
                here = there;
            }
            if agreed {
                break;
            }
        }
        here
    }

    /// Adds the samples that matter on the plane last asked for, or nearly do.
    fn choose(&self, (plane, borne): &(Plane, Borne), chosen: &mut [bool]) {
        let Some(circle) = self.scratch.last() else { return };
        let [u, v] = self.scratch.path();
        let out = |j: usize| (u[j] - circle.centre[0]).hypot(v[j] - circle.centre[1]);
        let far = (1.0 - NEAR) * circle.radius;
        for (j, chosen) in chosen.iter_mut().enumerate() {
            *chosen |= out(j) >= far;
        }
        match self.sought {
            Sought::Shear => {}
            Sought::Findley(_) => {
                let n = plane.normal();
                let mut normal = Vec::new();
                self.history.project(&resolved(&n, &n), &mut normal);
                for (normal, chosen) in normal.iter().zip(chosen) {
                    *chosen |= *normal >= borne.normal_max - NEAR * circle.radius;
                }
            }
            Sought::DangVan(k) => {
                for (j, chosen) in chosen.iter_mut().enumerate() {
                    *chosen |= out(j) + k * self.p[j] >= borne.dang_van - NEAR * circle.radius;
                }
            }
        }
    }

    /// Uphill, then on wherever a ring round the summit has higher ground.
    fn summit(&mut self, start: Plane, first: f64) -> (Plane, Borne) {
        let sought = self.sought;
        let start = (start, self.borne(&start));
        let mut here = self.uphill(start, first);
        for radius in RINGS {
            let ring = (0..ON_RING).map(|i| (2.0 * PI * i as f64 / ON_RING as f64).sin_cos());
            let best = ring
                .map(|(sine, cosine)| {
                    let next = here.0.moved(radius * cosine, radius * sine);
                    (next, self.borne(&next))
                })
                .reduce(|m, r| if sought.value(&r.1) > sought.value(&m.1) { r } else { m });
            if let Some(higher) = best.filter(|b| sought.value(&b.1) > sought.value(&here.1)) {
                here = self.uphill(higher, 0.5 * radius);
            }
        }
        here
    }

    /// From a plane uphill, with steps that shrink where no neighbour is higher.
    fn uphill(&mut self, mut here: (Plane, Borne), first: f64) -> (Plane, Borne) {
        let sought = self.sought;
        let (mut step, mut turn) = (first, 0.0);
        while step > FINEST {
            let mut best: Option<(Plane, Borne)> = None;
            for i in 0..DIRECTIONS {
                let (sine, cosine) = (turn + 2.0 * PI * i as f64 / DIRECTIONS as f64).sin_cos();
                let next = here.0.moved(step * cosine, step * sine);
                let there = self.borne(&next);
                if sought.value(&there) > sought.value(&best.as_ref().unwrap_or(&here).1) {
                    best = Some((next, there));
                }
            }
            match best {
                Some(higher) => here = higher,
                None => (step, turn) = (0.5 * step, turn + TURN),
            }
        }
        here
    }
}
