//! One absorber of a design at one speed, its law left open: what the rest does to its host is solved once, whatever the law.
//!
//! With u0 the angle of the host under the torque of an order and H its receptance, both without the ring, a ring of inertia J on a law S twists by omega² J u0/(S - omega² J (1 + S H)) against its host.

use super::factored::Factored;
use super::lane::LANES;
use super::{Direct, Quantity, ResponseError, Work};
use crate::absorber::mounted::with_law;
use crate::absorber::{ByFactor, Host, Law, Mounted, Operating};
use crate::numerics::{C64, ZERO};
use crate::units::RAD_PER_S_PER_RPM;
use hartog_kernel::kernel;
use rayon::prelude::*;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

/// An order without the ring.
#[derive(Debug, Clone, Copy)]
struct Rest {
    /// u0.
    angle: C64,
    /// H.
    receptance: C64,
    /// A quantity, and what it is per unit torque at the host; nothing where none is asked for.
    output: (C64, C64),
}

/// The rest at the speeds of a grid, for designs of one absorber on a station: the same whatever the absorber but for its hub, which is added.
#[derive(Debug)]
#[doc(hidden)]
pub struct Hosts {
    /// What is known of it besides the angle.
    quantity: Option<Quantity>,
    /// By speed; nothing where the chain resonates.
    stations: BTreeMap<usize, Vec<Option<Vec<Rest>>>>,
}

impl Hosts {
    /// For these designs at the speeds of `direct`.
    pub fn of<'d>(direct: &Direct, quantity: Quantity, designs: impl Iterator<Item = &'d [Mounted]>) -> Self {
        let mut stations = BTreeMap::new();
        for (station, _) in designs.filter_map(single) {
            let host_at = |speed: &f64| host(direct, &[], (station, Some(quantity)), *speed);
            stations.entry(station).or_insert_with(|| direct.grid().speed_rpm.par_iter().map(host_at).collect());
        }
        Self { quantity: Some(quantity), stations }
    }

    /// For designs on a station at the speeds of `direct`, without a quantity.
    pub(crate) fn on_station(direct: &Direct, station: usize) -> Self {
        let each = direct.grid().speed_rpm.iter().map(|speed| host(direct, &[], (station, None), *speed)).collect();
        Self { quantity: None, stations: BTreeMap::from([(station, each)]) }
    }

    /// For a design at a speed of the grid, with these orders.
    fn get(&self, design: &[Mounted], speed: usize, at: &[Operating]) -> Option<Cow<'_, [Rest]>> {
        let (station, hub) = single(design)?;
        let rest = self.stations.get(&station)?.get(speed)?.as_deref()?;
        if hub == 0.0 {
            return Some(Cow::Borrowed(rest));
        }
        rest.iter().zip(at).map(|(rest, at)| rest.with_hub(hub, *at)).collect::<Option<Vec<Rest>>>().map(Cow::Owned)
    }
}

impl Rest {
    /// The same with a hub of inertia J at the host, by its receptance: u0/(1 - omega² J H) and H/(1 - omega² J H); `None` where these are not finite.
    fn with_hub(&self, hub: f64, at: Operating) -> Option<Self> {
        let inertial = hub * at.omega * at.omega;
        let held = 1.0 - inertial * self.receptance;
        let (angle, receptance) = (self.angle / held, self.receptance / held);
        let output = (self.output.0 + self.output.1 * (inertial * angle), self.output.1 * (1.0 + inertial * receptance));
        (angle.is_finite() && receptance.is_finite()).then_some(Self { angle, receptance, output })
    }
}

/// Where an output and what the ring adds to it cancel by more than this, the whole is solved.
const LARGEST_CANCELLATION: f64 = 1e5;

/// The station that carries the only absorber, and the inertia of its hub.
pub(crate) fn single(design: &[Mounted]) -> Option<(usize, f64)> {
    match design {
        [m @ Mounted { on: Host::Station(station), .. }] => Some((*station, m.hub())),
        _ => None,
    }
}

/// One absorber of a design at one speed.
pub(crate) struct OpenLaw<'a> {
    direct: &'a Direct<'a>,
    design: &'a [Mounted],
    index: usize,
    speed_rpm: f64,
    at: Vec<Operating>,
    /// The rest at every order; nothing where the absorber sits on a ring or carries one, or where the rest resonates: the whole is solved then.
    host: Option<Cow<'a, [Rest]>>,
    /// What its outputs are of.
    output: Option<Quantity>,
}

impl<'a> OpenLaw<'a> {
    /// Absorber `index` of a design at a speed; `known`: hosts, and which speed of their grid this is.
    pub fn new(direct: &'a Direct<'a>, (design, index): (&'a [Mounted], usize), speed_rpm: f64, known: Option<(&'a Hosts, usize)>) -> Self {
        let (orders, shaft_speed) = (&direct.system.excitation.orders, speed_rpm * RAD_PER_S_PER_RPM);
        let at: Vec<Operating> = orders.iter().map(|order| Operating { omega: order.omega(speed_rpm), shaft_speed }).collect();
        let alone = !design.iter().any(|m| m.on == Host::Ring(index));
        let solved = || match design[index].on {
            Host::Station(station) if alone => {
                let mut rest = design.to_vec();
                rest[index] = rest[index].locked(0.0);
                host(direct, &rest, (station, None), speed_rpm)
            }
            _ => None,
        };
        let known = known.and_then(|(hosts, speed)| Some((hosts.quantity, hosts.get(design, speed, &at)?)));
        let (output, host) = match known {
            Some((quantity, host)) => (quantity, Some(host)),
            None => (None, solved().map(Cow::Owned)),
        };
        Self { direct, design, index, speed_rpm, at, host, output }
    }

    /// The whole design with a law for the absorber.
    pub fn with(&self, law: &Arc<dyn Law>) -> Vec<Mounted> {
        with_law(self.design, self.index, |_| law.clone())
    }

    /// Twist of the ring for each order, rad.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance.
    pub fn ring_twist(&self, law: &Arc<dyn Law>) -> Result<Vec<C64>, ResponseError> {
        if let Some(host) = &self.host {
            let twist: Vec<C64> = self.on_host(law, host).map(|(twist, _)| twist).collect();
            if twist.iter().all(|y| y.is_finite()) {
                return Ok(twist);
            }
        }
        let quantities = [Quantity::RingTwist(self.index)];
        Ok(self.direct.at_each(&self.with(law), &quantities, &[self.speed_rpm], &mut Work::default())?.swap_remove(0))
    }

    /// A quantity for each order.
    ///
    /// # Errors
    /// As [`Self::ring_twist`].
    pub fn output(&self, law: &Arc<dyn Law>, quantity: Quantity) -> Result<Vec<C64>, ResponseError> {
        let on_host = |host| self.output_on_host(quantity, host, self.on_host(law, host));
        if let Some(found) = self.host.as_deref().and_then(on_host) {
            return Ok(found);
        }
        Ok(self.direct.at_each(&self.with(law), &[quantity], &[self.speed_rpm], &mut Work::default())?.swap_remove(0))
    }

    /// The same from twist and S: what the quantity is without the ring, and what the torque S times the twist adds to it at the host; nothing where these cancel.
    fn output_on_host(&self, quantity: Quantity, host: &[Rest], motion: impl Iterator<Item = (C64, C64)>) -> Option<Vec<C64>> {
        let added = |(rest, (twist, stiffness)): (&Rest, (C64, C64))| {
            let (own, added) = (rest.output.0, rest.output.1 * stiffness * twist);
            let sum = own + added;
            // nothing, too, where it is no number
            (own.norm_sqr() + added.norm_sqr() <= LARGEST_CANCELLATION.powi(2) * sum.norm_sqr()).then_some(sum)
        };
        if self.output != Some(quantity) {
            return None;
        }
        let mut found = Vec::with_capacity(host.len());
        for each in host.iter().zip(motion) {
            found.push(added(each)?);
        }
        Some(found)
    }

    /// Mean power that the law dissipates, W: sum over orders of omega Im S |ring twist|²/2.
    ///
    /// # Errors
    /// As [`Self::ring_twist`].
    pub fn power(&self, law: &Arc<dyn Law>) -> Result<f64, ResponseError> {
        if let Some(host) = &self.host {
            let power: f64 = self.on_host(law, host).zip(&self.at).map(|((twist, s), at)| 0.5 * at.omega * s.im * twist.norm_sqr()).sum();
            if power.is_finite() {
                return Ok(power);
            }
        }
        let twist = self.ring_twist(law)?;
        Ok(self.at.iter().zip(&twist).map(|(at, y)| law.dissipated_power(*at, y.norm_sqr())).sum())
    }

    /// A law by the factor that temperature puts on its material, where that is quicker.
    pub(crate) fn followed<'s>(&'s self, law: &'s dyn Law) -> Option<Followed<'s>> {
        let (host, each) = (self.host.as_deref()?, law.followed_each(&self.at)?);
        let known: Vec<Known> =
            self.at.chunks(LANES).zip(host.chunks(LANES)).map(|(at, host)| Known::new(law.ring_inertia(), at, host)).collect();
        // where there is no order, S is finite
        let stiffness = [(); 3].map(|()| vec![1.0; LANES * known.len()]);
        Some(Followed { open: self, host, each, known, stiffness })
    }

    /// Twist of the ring and S for each order.
    fn on_host<'s>(&'s self, law: &Arc<dyn Law>, host: &'s [Rest]) -> impl Iterator<Item = (C64, C64)> + 's {
        let mut stiffness = vec![ZERO; self.at.len()];
        law.dynamic_stiffness_each(&self.at, &mut stiffness);
        let ring = law.ring_inertia();
        self.at.iter().zip(stiffness).zip(host).map(move |((at, s), rest)| {
            let inertial = ring * at.omega * at.omega;
            (inertial * rest.angle / (s - inertial * (1.0 + s * rest.receptance)), s)
        })
    }
}

/// A law by the factor that temperature puts on its material.
pub(crate) struct Followed<'s> {
    open: &'s OpenLaw<'s>,
    host: &'s [Rest],
    each: ByFactor<'s>,
    known: Vec<Known>,
    /// S of each order: real and imaginary part of its numerator, and its denominator.
    stiffness: [Vec<f64>; 3],
}

impl Followed<'_> {
    fn set(&mut self, log_factor: f64) {
        let orders = self.host.len();
        (self.each)(log_factor, self.stiffness.each_mut().map(|part| &mut part[..orders]));
    }

    /// Mean power, W; it is not finite where the whole has to be solved.
    pub fn power(&mut self, log_factor: f64) -> f64 {
        self.set(log_factor);
        power(&self.known, self.stiffness.each_ref().map(Vec::as_slice))
    }

    /// A quantity for each order; nothing where the whole has to be solved.
    pub fn output(&mut self, log_factor: f64, quantity: Quantity) -> Option<Vec<C64>> {
        self.set(log_factor);
        let twist_and_stiffness = |i: usize| {
            let s = C64::new(self.stiffness[0][i], self.stiffness[1][i]) / self.stiffness[2][i];
            (self.known[i / LANES].twist(i % LANES, s, self.host[i].angle), s)
        };
        self.open.output_on_host(quantity, self.host, (0..self.host.len()).map(twist_and_stiffness))
    }
}

/// What a power needs besides S, for some orders. The twist is w² J u0/(S (1 - w² J H) - w² J): what does not depend on S is computed once. Orders that there are not have no weight.
#[derive(Clone, Copy)]
struct Known {
    /// w (w² J |u0|)²/2.
    weight: [f64; LANES],
    /// 1 - w² J H.
    held: [[f64; LANES]; 2],
    /// w² J.
    inertial: [f64; LANES],
}

impl Known {
    fn new(ring: f64, at: &[Operating], host: &[Rest]) -> Self {
        let mut known = Self { weight: [0.0; LANES], held: [[0.0; LANES]; 2], inertial: [1.0; LANES] };
        for (i, (at, rest)) in at.iter().zip(host).enumerate() {
            let inertial = ring * at.omega * at.omega;
            let held = 1.0 - inertial * rest.receptance;
            known.weight[i] = 0.5 * at.omega * inertial * inertial * rest.angle.norm_sqr();
            (known.held[0][i], known.held[1][i], known.inertial[i]) = (held.re, held.im, inertial);
        }
        known
    }

    /// w² J u0/(S (1 - w² J H) - w² J).
    fn twist(&self, i: usize, s: C64, angle: C64) -> C64 {
        self.inertial[i] * angle / (s * C64::new(self.held[0][i], self.held[1][i]) - self.inertial[i])
    }
}

/// The sum over orders of weight Im S/|S (1 - w² J H) - w² J|²; with S = N/d it is weight d Im N/|N (1 - w² J H) - d w² J|².
#[kernel]
fn power(known: &[Known], stiffness: [&[f64]; 3]) -> f64 {
    let [re, im, below] = stiffness.map(|part| part.as_chunks::<LANES>().0);
    let mut sums = [0.0; LANES];
    for (known, ((re, im), below)) in known.iter().zip(re.iter().zip(im).zip(below)) {
        let [held_re, held_im] = &known.held;
        for i in 0..LANES {
            let (x, y) = (re[i] * held_re[i] - im[i] * held_im[i] - below[i] * known.inertial[i], re[i] * held_im[i] + im[i] * held_re[i]);
            sums[i] += known.weight[i] * below[i] * im[i] / (x * x + y * y);
        }
    }
    sums.iter().sum()
}

/// What a station does for each order, with the rest of a design.
fn host(direct: &Direct, rest: &[Mounted], (station, quantity): (usize, Option<Quantity>), speed_rpm: f64) -> Option<Vec<Rest>> {
    let mut solver = Factored::new(direct.system);
    let one = |order: usize| {
        solver.solve(rest, (order, speed_rpm), &mut Work::default()).ok()?;
        let unit = solver.under_unit(station);
        let output = |x: &[C64]| quantity.map_or(ZERO, |q| solver.output(q, x));
        let (angle, receptance) = (solver.angle(station, &solver.x), solver.angle(station, &unit));
        let found = Rest { angle, receptance, output: (output(&solver.x), output(&unit)) };
        (found.angle.is_finite() && found.receptance.is_finite()).then_some(found)
    };
    (0..direct.system.orders()).map(one).collect()
}
