//! From a plane uphill to the nearest one with no higher ground round it, at the cost of the few samples that decide.
//!
//! The smallest circle is held by two or three samples and the largest normal stress by one. Near a plane, all that can take over lie close to the circle or to the
//! largest value: steps look at those alone. At the summit all samples are asked again, and those that turn out to matter join.

use super::history::History;
use super::plane::{Amplitude, Plane, PlaneStress, Scratch, resolved};
use crate::numerics::elementary::Elementary;
use std::f64::consts::PI;

/// What is to be large.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Sought {
    /// The shear amplitude.
    Shear,
    /// The shear amplitude and so many times the largest normal stress.
    Findley(f64),
    /// The largest sum over time of shear and so many times the hydrostatic stress.
    DangVan(f64),
}

impl Sought {
    /// Its value on a plane, Pa.
    pub fn value(self, b: &PlaneStress) -> f64 {
        match self {
            Self::Shear => b.shear_amplitude,
            Self::Findley(k) => b.shear_amplitude + k * b.normal_max,
            Self::DangVan(_) => b.dang_van,
        }
    }
}

/// Samples within this share of the circle's radius may come to matter.
const NEAR: f64 = 0.15;
/// The ends of the longest chord lie within this share: it is at least sqrt 3 radii long.
const OF_CHORD: f64 = 0.3;
/// A summit is where all samples say the same as the few, to this share.
const AGREED: f64 = 1e-9;
/// Rounds after which what has been reached must do.
const ROUNDS: usize = 12;
/// The climb ends with steps of this, rad.
const FINEST: f64 = 0.02 * PI / 180.0;
/// With steps of this a summit is known to the share `FLAT`.
const ROUGH: f64 = 0.2 * PI / 180.0;
const FLAT: f64 = 2e-3;
/// Directions of a step. Where the samples that hold the circle change, Dang Van's sum has ridges: the directions turn with every step that finds nothing, so that some
/// run along the ridge.
const DIRECTIONS: usize = 8;
const TURN: f64 = 0.618 * 2.0 * PI / DIRECTIONS as f64;
/// Rings round a summit on which higher ground is looked for, rad, and planes on each. From the heights of a ring that come this close to the summit, the way leads further.
const RINGS: [f64; 4] = [4.0 * PI / 180.0, 2.7 * PI / 180.0, 1.5 * PI / 180.0, 0.5 * PI / 180.0];
const ON_RING: usize = 16;
const CLOSE: f64 = 0.005;

/// A history, and what is sought on its planes.
#[derive(Debug)]
pub(crate) struct Slope<'a> {
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
    fn plane_stress(&mut self, plane: &Plane) -> PlaneStress {
        let dang_van = if let Sought::DangVan(k) = self.sought { Some((k, self.p)) } else { None };
        self.scratch.plane_stress(self.history, plane, self.amplitude, dang_van)
    }

    /// Near a summit, with steps from the first downwards; where all the neighbourhood is looked at, to a summit with no higher ground on `RINGS` round it.
    pub(crate) fn climb(&mut self, start: Plane, first: f64, all_round: bool) -> (Plane, PlaneStress) {
        let sought = self.sought;
        let mut here = (start, self.plane_stress(&start));
        let mut chosen = vec![false; self.history.len()];
        self.choose(&here, &mut chosen);
        let (last, agreed) = if all_round { (FINEST, AGREED) } else { (ROUGH, FLAT) };
        for _ in 0..ROUNDS {
            let indices: Vec<usize> = (0..chosen.len()).filter(|i| chosen[*i]).collect();
            let (history, p) = (self.history.only(&indices), indices.iter().map(|i| self.p[*i]).collect::<Vec<f64>>());
            let mut few = Slope { history: &history, p: &p, sought, amplitude: self.amplitude, scratch: Scratch::default() };
            let start = (here.0, few.plane_stress(&here.0));
            let mut top = few.uphill(start, (first, last));
            if all_round {
                top = few.all_round(top);
            }
            let there = (top.0, self.plane_stress(&top.0));
            let apart = (sought.value(&there.1) - sought.value(&top.1)).abs();
            self.choose(&there, &mut chosen);
            if sought.value(&there.1) > sought.value(&here.1) {
                here = there;
            }
            if apart <= agreed * sought.value(&top.1).abs() {
                break;
            }
        }
        here
    }

    /// Adds the samples that matter on the plane last asked for, or nearly do.
    fn choose(&self, (plane, plane_stress): &(Plane, PlaneStress), chosen: &mut [bool]) {
        let Some(circle) = self.scratch.last() else { return };
        let [u, v] = self.scratch.path();
        let out = |j: usize| (u[j] - circle.centre[0]).hypotenuse(v[j] - circle.centre[1]);
        let near = if self.amplitude == Amplitude::Chord { OF_CHORD } else { NEAR };
        let far = (1.0 - near) * circle.radius;
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
                    *chosen |= *normal >= plane_stress.normal_max - NEAR * circle.radius;
                }
            }
            Sought::DangVan(k) => {
                for (j, chosen) in chosen.iter_mut().enumerate() {
                    *chosen |= out(j) + k * self.p[j] >= plane_stress.dang_van - NEAR * circle.radius;
                }
            }
        }
    }

    /// On wherever a ring round a summit leads to higher ground.
    fn all_round(&mut self, summit: (Plane, PlaneStress)) -> (Plane, PlaneStress) {
        let sought = self.sought;
        let mut here = summit;
        for radius in RINGS {
            let angles = (0..ON_RING).map(|i| (2.0 * PI * i as f64 / ON_RING as f64).sine_cosine());
            let ring: Vec<(Plane, PlaneStress)> = angles
                .map(|(sine, cosine)| here.0.moved(radius * cosine, radius * sine))
                .map(|next| (next, self.plane_stress(&next)))
                .collect();
            let value = |i: usize| sought.value(&ring[i % ON_RING].1);
            let level = sought.value(&here.1);
            // hills of Dang Van's sum may be narrower than a ring: a lower top on it may lead higher
            let enough = if let Sought::DangVan(_) = sought { level - CLOSE * level.abs() } else { level };
            for i in (ON_RING..2 * ON_RING).filter(|i| value(*i) > enough && value(*i) >= value(i - 1) && value(*i) >= value(i + 1)) {
                let top = self.uphill(ring[i % ON_RING].clone(), (0.5 * radius, ROUGH));
                if sought.value(&top.1) > sought.value(&here.1) * (1.0 - FLAT) {
                    let top = self.uphill(top, (0.5 * ROUGH, FINEST));
                    here = if sought.value(&top.1) > sought.value(&here.1) { top } else { here };
                }
            }
        }
        here
    }

    /// From a plane uphill, with steps from the first to the last that shrink where no neighbour is higher.
    fn uphill(&mut self, mut here: (Plane, PlaneStress), (first, last): (f64, f64)) -> (Plane, PlaneStress) {
        let sought = self.sought;
        let (mut step, mut turn) = (first, 0.0);
        while step > last {
            let mut best: Option<(Plane, PlaneStress)> = None;
            for i in 0..DIRECTIONS {
                let (sine, cosine) = (turn + 2.0 * PI * i as f64 / DIRECTIONS as f64).sine_cosine();
                let next = here.0.moved(step * cosine, step * sine);
                let there = self.plane_stress(&next);
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
