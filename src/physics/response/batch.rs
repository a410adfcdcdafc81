//! Direct solution of several points at a time: elimination along the chain from the first station to the last, without exchange of rows.
//!
//! With g_i what ties station i to inertial space (absorbers included) and s_i the shaft after it, the part of the chain up to i has the
//! dynamic stiffness r_i = g_i + s r/(s + r) of the shaft and the part before it, springs in series; the torque that reaches i is
//! f_i = T_i + f s/(s + r). Then theta_last = f/r and, backwards, theta_i - theta_next = (f_i - r_i theta_next)/(s_i + r_i). In a tree every station
//! hands what is before it to the station it leads to, and behind a gear of ratio g the next station has g theta_next, g² r and g f.
//! Where s + r nearly cancels (the part before, held at the next station, resonates) digits are lost: the factor is reported, and the caller solves
//! that point with exchange of rows.

// every loop runs over the lanes of several arrays at once
#![allow(clippy::needless_range_loop)]

use super::lane::{LANES, Lane};
use crate::absorber::{Absorber, Condensed, Host, Mounted, Operating};
use crate::drivetrain::{Chain, Station};
use crate::numerics::C64;
use hartog_kernel::kernel;

/// Points that are solved together: frequencies and torques in, angles out.
#[derive(Debug, Clone)]
pub(crate) struct Block {
    /// Circular frequencies, rad/s.
    pub omega: [f64; LANES],
    /// Speeds of the shaft, rad/s.
    pub shaft_speed: [f64; LANES],
    /// Torque on each station, N m; solved, its angle, rad.
    pub x: Vec<Lane>,
    /// Solved, the twist of the link after each station, rad (nothing for the last). On the way, r.
    pub twist: Vec<Lane>,
    /// Twist of each ring against its hub, rad.
    pub ring: Vec<Lane>,
    /// How much larger the terms were than their sum, at the worst station or ring.
    pub cancelled: [f64; LANES],
    /// 1/(s + r) of each station.
    inverse: Vec<Lane>,
    /// S of each ring on a station that carries no other.
    spring: Vec<Lane>,
    /// Absorbers of each point, where rings carry rings.
    condensed: Vec<Condensed>,
    /// Whether every station leads to the following one.
    is_row: bool,
}

impl Block {
    /// For a chain and `rings` absorbers.
    pub fn new(chain: &Chain, rings: usize) -> Self {
        let stations = chain.len();
        let lanes = |n| vec![Lane::ZERO; n];
        Self {
            omega: [0.0; LANES],
            shaft_speed: [0.0; LANES],
            x: lanes(stations),
            twist: lanes(stations),
            ring: lanes(rings),
            cancelled: [0.0; LANES],
            inverse: lanes(stations),
            spring: lanes(rings),
            condensed: Vec::new(),
            is_row: chain.is_row(),
        }
    }

    /// Solves all points.
    pub fn solve(&mut self, stations: &[Station], design: &[Mounted]) {
        let tiers = design.iter().any(|m| matches!(m.on, Host::Ring(_)));
        self.chain(stations);
        if tiers {
            self.condense(design);
        } else {
            self.springs(design);
            rings(self, design);
        }
        if self.is_row {
            along_row(self, stations);
        } else {
            along_tree(self, stations);
        }
        if tiers {
            self.condensed_twists(design);
        } else {
            twists(self, design);
        }
    }

    fn at(&self, lane: usize) -> Operating {
        Operating { omega: self.omega[lane], shaft_speed: self.shaft_speed[lane] }
    }

    /// S of every ring at every point.
    fn springs(&mut self, design: &[Mounted]) {
        let at: [Operating; LANES] = std::array::from_fn(|lane| self.at(lane));
        for (spring, m) in self.spring.iter_mut().zip(design) {
            let Absorber::Ring(law) = &m.absorber else { continue };
            match law.spring_and_damper() {
                Some(s) => *spring = Lane { re: [s.stiffness; LANES], im: at.map(|at| at.omega * s.damping) },
                None => {
                    let mut s = [C64::ZERO; LANES];
                    law.dynamic_stiffness_each(&at, &mut s);
                    *spring = Lane { re: s.map(|s| s.re), im: s.map(|s| s.im) };
                }
            }
        }
    }

    /// Adds absorbers whose rings carry rings to what ties their stations to inertial space, point by point.
    fn condense(&mut self, design: &[Mounted]) {
        self.condensed.resize(LANES, Condensed::default());
        for lane in 0..LANES {
            let at = self.at(lane);
            let condensed = &mut self.condensed[lane];
            condensed.set(design, at);
            for hub in &condensed.hubs {
                let z = hub.numerator / hub.denominator;
                self.twist[hub.station].re[lane] += z.re;
                self.twist[hub.station].im[lane] += z.im;
            }
            // near its own resonance an undamped ring turns rounding of its host's angle into its own
            let ratio = |i: usize| (condensed.rings[i].twist / condensed.rings[i].host / condensed.denominator(i)).norm_sqr();
            self.cancelled[lane] = (0..design.len()).map(ratio).fold(0.0, f64::max);
        }
    }

    /// Twist of every ring, where rings carry rings.
    fn condensed_twists(&mut self, design: &[Mounted]) {
        for (i, ring) in self.ring.iter_mut().enumerate().take(design.len()) {
            for (lane, condensed) in self.condensed.iter().enumerate() {
                let motion = &condensed.rings[i];
                let hub = &condensed.hubs[motion.hub];
                ring.set(lane, motion.twist * self.x[hub.station].get(lane) / hub.denominator);
            }
        }
    }
}

impl Block {
    /// What ties the stations themselves to inertial space, into `twist`.
    fn chain(&mut self, stations: &[Station]) {
        let omega = self.omega;
        self.cancelled = [0.0; LANES];
        for (left, s) in self.twist.iter_mut().zip(stations) {
            for l in 0..LANES {
                left.re[l] = s.stiffness_to_ground - omega[l] * omega[l] * s.inertia;
                left.im[l] = omega[l] * s.damping_to_ground;
            }
        }
    }
}

/// Adds absorbers to what ties their stations to inertial space.
#[kernel]
fn rings(b: &mut Block, design: &[Mounted]) {
    let omega = b.omega;
    let mut worst = [0.0; LANES];
    for (m, s) in design.iter().zip(&b.spring) {
        let Host::Station(station) = m.on else { continue };
        let left = &mut b.twist[station];
        let ring_inertia = m.absorber.ring_inertia();
        if m.absorber.law().is_none() {
            let inertia = m.hub() + ring_inertia;
            for l in 0..LANES {
                left.re[l] -= omega[l] * omega[l] * inertia;
            }
            continue;
        }
        for l in 0..LANES {
            // -w² J_hub - w² J S/(S - w² J)
            let ring = omega[l] * omega[l] * ring_inertia;
            let (s_re, s_im) = (s.re[l], s.im[l]);
            let d_re = s_re - ring;
            let scale = ring / (d_re * d_re + s_im * s_im);
            // near its own resonance an undamped ring turns rounding of the hub's angle into its own
            let cancelled = ring * scale;
            worst[l] = if cancelled > worst[l] { cancelled } else { worst[l] };
            left.re[l] -= omega[l] * omega[l] * m.hub() + scale * (s_re * d_re + s_im * s_im);
            left.im[l] += scale * s_im * ring;
        }
    }
    b.cancelled = worst;
}

/// Where a station leads and its gear; in a row that is known before the loop runs.
#[inline(always)]
fn joint<const ROW: bool>(stations: &[Station], i: usize) -> (usize, f64) {
    match &stations[i].joint {
        Some(joint) if !ROW => (joint.leads_to, joint.gear),
        _ => (i + 1, 1.0),
    }
}

/// From the leaves to the root.
#[inline(always)]
fn elimination<const ROW: bool>(b: &mut Block, stations: &[Station]) {
    let (omega, mut worst) = (b.omega, b.cancelled);
    for i in 0..stations.len() - 1 {
        let shaft = &stations[i];
        let (stiffness, loss, damping) =
            (shaft.stiffness_to_next, shaft.stiffness_to_next * shaft.loss_factor_to_next, shaft.damping_to_next);
        let (after, gear) = joint::<ROW>(stations, i);
        let square = gear * gear;
        // copies, so that the compiler sees that nothing overlaps
        let (left, reached, mut inverse) = (b.twist[i], b.x[i], Lane::ZERO);
        let (mut next, mut next_reached) = (b.twist[after], b.x[after]);
        for l in 0..LANES {
            let (s_re, s_im) = (stiffness, loss + omega[l] * damping);
            let (p_re, p_im) = (s_re + left.re[l], s_im + left.im[l]);
            let scale = 1.0 / (p_re * p_re + p_im * p_im);
            let cancelled = (s_re * s_re + s_im * s_im) * scale;
            worst[l] = if cancelled > worst[l] { cancelled } else { worst[l] };
            let (i_re, i_im) = (p_re * scale, -p_im * scale);
            (inverse.re[l], inverse.im[l]) = (i_re, i_im);
            // s/(s + r)
            let (q_re, q_im) = (s_re * i_re - s_im * i_im, s_re * i_im + s_im * i_re);
            next.re[l] += square * (q_re * left.re[l] - q_im * left.im[l]);
            next.im[l] += square * (q_re * left.im[l] + q_im * left.re[l]);
            next_reached.re[l] += gear * (q_re * reached.re[l] - q_im * reached.im[l]);
            next_reached.im[l] += gear * (q_re * reached.im[l] + q_im * reached.re[l]);
        }
        (b.inverse[i], b.twist[after], b.x[after]) = (inverse, next, next_reached);
    }
    for l in 0..LANES {
        b.cancelled[l] = worst[l].sqrt();
    }
}

/// From the root back to the leaves.
#[inline(always)]
fn substitution<const ROW: bool>(b: &mut Block, stations: &[Station]) {
    let last = stations.len() - 1;
    for l in 0..LANES {
        let (r_re, r_im) = (b.twist[last].re[l], b.twist[last].im[l]);
        let (f_re, f_im) = (b.x[last].re[l], b.x[last].im[l]);
        let size = r_re * r_re + r_im * r_im;
        b.x[last].re[l] = (f_re * r_re + f_im * r_im) / size;
        b.x[last].im[l] = (f_im * r_re - f_re * r_im) / size;
    }
    for i in (0..last).rev() {
        let (after, gear) = joint::<ROW>(stations, i);
        let (left, reached, inverse, next) = (b.twist[i], b.x[i], b.inverse[i], b.x[after].times(gear));
        let (mut angle, mut twist) = (next, Lane::ZERO);
        for l in 0..LANES {
            let t_re = reached.re[l] - (left.re[l] * next.re[l] - left.im[l] * next.im[l]);
            let t_im = reached.im[l] - (left.re[l] * next.im[l] + left.im[l] * next.re[l]);
            twist.re[l] = t_re * inverse.re[l] - t_im * inverse.im[l];
            twist.im[l] = t_re * inverse.im[l] + t_im * inverse.re[l];
            angle.re[l] += twist.re[l];
            angle.im[l] += twist.im[l];
        }
        (b.x[i], b.twist[i]) = (angle, twist);
    }
}

/// A row of stations, without gears.
#[kernel]
fn along_row(b: &mut Block, stations: &[Station]) {
    elimination::<true>(b, stations);
    substitution::<true>(b, stations);
}

/// A tree, with gears.
#[kernel]
fn along_tree(b: &mut Block, stations: &[Station]) {
    elimination::<false>(b, stations);
    substitution::<false>(b, stations);
}

/// Twist of every ring.
#[kernel]
fn twists(b: &mut Block, design: &[Mounted]) {
    let omega = b.omega;
    for ((ring, m), s) in b.ring.iter_mut().zip(design).zip(&b.spring) {
        let Host::Station(station) = m.on else { continue };
        if m.absorber.law().is_none() {
            *ring = Lane::ZERO;
            continue;
        }
        let (ring_inertia, hub) = (m.absorber.ring_inertia(), b.x[station]);
        for l in 0..LANES {
            let inertia = omega[l] * omega[l] * ring_inertia;
            let (d_re, d_im) = (s.re[l] - inertia, s.im[l]);
            let scale = inertia / (d_re * d_re + d_im * d_im);
            ring.re[l] = scale * (hub.re[l] * d_re + hub.im[l] * d_im);
            ring.im[l] = scale * (hub.im[l] * d_re - hub.re[l] * d_im);
        }
    }
}
