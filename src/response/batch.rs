//! Direct solution of several points at a time: elimination along the chain from the first station to the last, without exchange of rows.
//!
//! With g_i what ties station i to inertial space (absorbers included) and s_i the shaft after it, the part of the chain up to i has the
//! dynamic stiffness r_i = g_i + s r/(s + r) of the shaft and the part before it, springs in series; the torque that reaches i is
//! f_i = T_i + f s/(s + r). Then theta_last = f/r and, backwards, theta_i - theta_next = (f_i - r_i theta_next)/(s_i + r_i).
//! Where s + r nearly cancels (the part before, held at the next station, resonates) digits are lost: the factor is reported, and the caller solves
//! that point with exchange of rows.

// every loop runs over the lanes of several arrays at once
#![allow(clippy::needless_range_loop)]

use crate::absorber::{Kind, Mounted, Ring};
use crate::drivetrain::Station;
use crate::numerics::C64;
use multiversion::multiversion;

/// Points solved together.
pub const LANES: usize = 8;

/// A complex number of each point.
#[derive(Debug, Clone, Copy)]
pub struct Lane {
    re: [f64; LANES],
    im: [f64; LANES],
}

impl Lane {
    /// Zero at every point.
    pub const ZERO: Self = Self { re: [0.0; LANES], im: [0.0; LANES] };

    /// Of one point.
    pub fn get(&self, lane: usize) -> C64 {
        C64::new(self.re[lane], self.im[lane])
    }

    /// The sum at each point.
    pub fn plus(&self, other: &Self) -> Self {
        let mut sum = *self;
        for l in 0..LANES {
            sum.re[l] += other.re[l];
            sum.im[l] += other.im[l];
        }
        sum
    }

    /// The negative at each point.
    pub fn minus(&self) -> Self {
        Self { re: self.re.map(|x| -x), im: self.im.map(|x| -x) }
    }

    /// Sets that of one point.
    pub fn set(&mut self, lane: usize, value: C64) {
        (self.re[lane], self.im[lane]) = (value.re, value.im);
    }
}

/// Points that are solved together: frequencies and torques in, angles out.
#[derive(Debug, Clone)]
pub struct Block {
    /// Circular frequencies, rad/s.
    pub omega: [f64; LANES],
    /// Torque on each station, N m; solved, its angle, rad.
    pub x: Vec<Lane>,
    /// Solved, the angle of each station less that of the next, rad (nothing for the last). On the way, r.
    pub twist: Vec<Lane>,
    /// Twist of each ring against its hub, rad.
    pub ring: Vec<Lane>,
    /// How much larger the terms were than their sum, at the worst station or ring.
    pub cancelled: [f64; LANES],
    /// 1/(s + r) of each station.
    inverse: Vec<Lane>,
}

impl Block {
    /// For chains of `stations` and `rings` absorbers.
    pub fn new(stations: usize, rings: usize) -> Self {
        let lanes = |n| vec![Lane::ZERO; n];
        Self {
            omega: [0.0; LANES],
            x: lanes(stations),
            twist: lanes(stations),
            ring: lanes(rings),
            cancelled: [0.0; LANES],
            inverse: lanes(stations),
        }
    }

    /// Solves all points.
    pub fn solve(&mut self, stations: &[Station], design: &[Mounted]) {
        ground(self, stations, design);
        eliminate(self, stations);
        follow(self, stations, design);
    }
}

/// What ties the stations to inertial space, absorbers included, into `twist`.
#[multiversion(targets("x86_64+avx512f", "x86_64+avx2", "x86_64+avx", "aarch64+neon"))]
fn ground(b: &mut Block, stations: &[Station], design: &[Mounted]) {
    let omega = b.omega;
    let mut worst = [0.0; LANES];
    for (left, s) in b.twist.iter_mut().zip(stations) {
        for l in 0..LANES {
            left.re[l] = s.stiffness_to_ground - omega[l] * omega[l] * s.inertia;
            left.im[l] = omega[l] * s.damping_to_ground;
        }
    }
    for m in design {
        let (a, left) = (&m.absorber, &mut b.twist[m.station]);
        if a.kind() == Kind::Locked {
            let inertia = m.hub_inertia + a.ring_inertia();
            for l in 0..LANES {
                left.re[l] -= omega[l] * omega[l] * inertia;
            }
            continue;
        }
        let (ring_inertia, stiffness, damping) = (a.ring_inertia(), a.stiffness(), a.damping());
        for l in 0..LANES {
            // -w² J_hub - w² J S/(S - w² J)
            let ring = omega[l] * omega[l] * ring_inertia;
            let (s_im, d_re) = (omega[l] * damping, stiffness - ring);
            let scale = ring / (d_re * d_re + s_im * s_im);
            // near its own resonance an undamped ring turns rounding of the hub's angle into its own
            let cancelled = ring * scale;
            worst[l] = if cancelled > worst[l] { cancelled } else { worst[l] };
            left.re[l] -= omega[l] * omega[l] * m.hub_inertia + scale * (stiffness * d_re + s_im * s_im);
            left.im[l] += scale * s_im * ring;
        }
    }
    b.cancelled = worst;
}

/// From the first station to the last.
#[multiversion(targets("x86_64+avx512f", "x86_64+avx2", "x86_64+avx", "aarch64+neon"))]
fn eliminate(b: &mut Block, stations: &[Station]) {
    let (omega, mut worst) = (b.omega, b.cancelled);
    for i in 0..stations.len() - 1 {
        let shaft = &stations[i];
        let (stiffness, loss, damping) =
            (shaft.stiffness_to_next, shaft.stiffness_to_next * shaft.loss_factor_to_next, shaft.damping_to_next);
        // copies, so that the compiler sees that nothing overlaps
        let (left, reached, mut inverse) = (b.twist[i], b.x[i], Lane::ZERO);
        let (mut next, mut next_reached) = (b.twist[i + 1], b.x[i + 1]);
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
            next.re[l] += q_re * left.re[l] - q_im * left.im[l];
            next.im[l] += q_re * left.im[l] + q_im * left.re[l];
            next_reached.re[l] += q_re * reached.re[l] - q_im * reached.im[l];
            next_reached.im[l] += q_re * reached.im[l] + q_im * reached.re[l];
        }
        (b.inverse[i], b.twist[i + 1], b.x[i + 1]) = (inverse, next, next_reached);
    }
    for l in 0..LANES {
        b.cancelled[l] = worst[l].sqrt();
    }
}

/// From the last station back to the first, then the rings.
#[multiversion(targets("x86_64+avx512f", "x86_64+avx2", "x86_64+avx", "aarch64+neon"))]
fn follow(b: &mut Block, stations: &[Station], design: &[Mounted]) {
    let (omega, last) = (b.omega, stations.len() - 1);
    for l in 0..LANES {
        let (r_re, r_im) = (b.twist[last].re[l], b.twist[last].im[l]);
        let (f_re, f_im) = (b.x[last].re[l], b.x[last].im[l]);
        let size = r_re * r_re + r_im * r_im;
        b.x[last].re[l] = (f_re * r_re + f_im * r_im) / size;
        b.x[last].im[l] = (f_im * r_re - f_re * r_im) / size;
    }
    for i in (0..last).rev() {
        let (left, reached, inverse, next) = (b.twist[i], b.x[i], b.inverse[i], b.x[i + 1]);
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
    for (ring, m) in b.ring.iter_mut().zip(design) {
        let (a, hub) = (&m.absorber, b.x[m.station]);
        if a.kind() == Kind::Locked {
            *ring = Lane::ZERO;
            continue;
        }
        let (ring_inertia, stiffness, damping) = (a.ring_inertia(), a.stiffness(), a.damping());
        for l in 0..LANES {
            let inertia = omega[l] * omega[l] * ring_inertia;
            let (d_re, d_im) = (stiffness - inertia, omega[l] * damping);
            let scale = inertia / (d_re * d_re + d_im * d_im);
            ring.re[l] = scale * (hub.re[l] * d_re + hub.im[l] * d_im);
            ring.im[l] = scale * (hub.im[l] * d_re - hub.re[l] * d_im);
        }
    }
}
