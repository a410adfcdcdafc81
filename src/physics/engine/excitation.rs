//! Torque of every throw as complex amplitudes of engine orders, at any speed.

use super::forces::{Moment, friction_torque, gas_force, inertia_torque_per_omega2};
use super::pressure::{each_revolution, sample_angle, samples};
use super::{Engine, Geometry, HarmonicTable, Order, Source, radial};
use crate::numerics::elementary::turn;
use crate::numerics::harmonics::Analyser;
use crate::numerics::{C64, ZERO, table_lookup};
use crate::units::{RAD_PER_DEG, RAD_PER_S_PER_RPM};

/// What the pressure means at one tabulated speed, for checking it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Audit {
    /// rpm.
    pub speed_rpm: f64,
    /// Net work over displaced volume, Pa.
    pub indicated_mean_pressure: f64,
    /// Pa absolute.
    pub peak_pressure: f64,
    /// Order zero of all throws together, N m.
    pub mean_torque: f64,
    /// Brake torque the pressure model was given, N m, where it was.
    pub brake_torque: Option<f64>,
}

/// How the units of an engine differ from each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Units {
    /// All alike.
    Equal,
    /// One (from 0) compresses and expands without burning.
    Misfiring(usize),
    /// Each burns with its own share.
    Unequal,
    /// None burns.
    Motored,
}

impl Units {
    /// The unit (from 0) that misfires.
    pub fn misfiring(self) -> Option<usize> {
        match self {
            Self::Misfiring(cylinder) => Some(cylinder),
            Self::Equal | Self::Unequal | Self::Motored => None,
        }
    }
}

/// What units that differ add to the torque of a throw.
#[derive(Debug, Clone, PartialEq)]
struct Change {
    throw: usize,
    /// At each tabulated speed (one row) and order, N m.
    torque: Vec<Vec<C64>>,
    /// The same of the radial force, N, where that is known.
    radial: Vec<Vec<C64>>,
}

/// Torque and radial force of a motored unit less those of a firing one, by tabulated speed and order, N m and N.
#[derive(Debug, Clone, PartialEq)]
pub struct MotoredChange {
    torque: Vec<Vec<C64>>,
    radial: Vec<Vec<C64>>,
}

/// Radial force of one unit, as its torque.
#[derive(Debug, Clone, PartialEq)]
struct Radial {
    /// N.
    gas: Vec<Vec<C64>>,
    /// Per (rad/s)².
    inertia: Vec<C64>,
}

impl Radial {
    fn gas_of((geometry, strokes): (&Geometry, u32), analyser: &Analyser, traces: &[(f64, Vec<f64>)]) -> Vec<Vec<C64>> {
        let masses = radial::of_masses(geometry, strokes);
        traces.iter().map(|(speed, trace)| analyser.analyse(&radial::of_gas(geometry, &masses, trace, *speed))).collect()
    }
}

/// Order amplitudes of the torque on each throw.
#[derive(Debug, Clone, PartialEq)]
pub struct Excitation {
    /// Orders that are present, ascending.
    pub orders: Vec<Order>,
    /// Their number of periods in a working cycle.
    pub harmonics: Vec<u32>,
    /// Speeds at which the gas torque is tabulated, rpm; empty where nothing depends on speed.
    pub tabulated_rpm: Vec<f64>,
    /// Complex torque amplitude of one unit at each tabulated speed (one row) and order, N m.
    gas: Vec<Vec<C64>>,
    /// The same of the moving masses, per (rad/s)².
    inertia: Vec<C64>,
    /// Sum of the firing phases of the units on each throw (one row) for each order.
    phases: Vec<Vec<C64>>,
    /// How the units differ.
    pub units: Units,
    /// What those that differ change, throw by throw.
    changes: Vec<Change>,
    /// Beside the torque, where a flexible crank asks for it.
    radial: Option<Radial>,
    /// One row a tabulated speed.
    pub audit: Vec<Audit>,
}

/// Travel of the piston per crank angle at every sample of a cycle, m/rad: the lever of its force.
fn levers(geometry: &Geometry, strokes: u32) -> Vec<f64> {
    each_revolution(strokes, |theta| geometry.slider_crank.motion(theta).slope)
}

/// Torque of the gas and of liner friction over a cycle. Friction depends on the inertia forces at `speed_rpm` and, between tabulated speeds, is
/// interpolated with the gas.
fn torque_without_inertia((geometry, levers): (&Geometry, &[f64]), trace: &[f64], speed_rpm: f64) -> Vec<f64> {
    let omega = speed_rpm * RAD_PER_S_PER_RPM;
    let torque_at = |(j, (&pressure, lever)): (usize, (&f64, &f64))| {
        let friction = friction_torque(geometry, Moment { pressure, theta: sample_angle(j), omega });
        gas_force(geometry, pressure) * lever + friction
    };
    trace.iter().zip(levers).enumerate().map(torque_at).collect()
}

impl Excitation {
    /// Samples the torque of a cylinder at each tabulated speed and keeps the orders up to `order_limit`.
    pub fn new(engine: &Engine, order_limit: f64) -> Self {
        match &engine.source {
            Source::Harmonics(table) => Self::from_table(engine, table, order_limit),
            Source::Cylinder { .. } => Self::from_cylinder(engine, order_limit),
        }
    }

    fn from_table(engine: &Engine, table: &HarmonicTable, order_limit: f64) -> Self {
        let inertia = inertia_of(engine, table, order_limit);
        let is_there = |o: &Order| {
            let moves = inertia.iter().any(|i| i.0 == *o);
            moves || table.amplitudes(*o).iter().any(|c| *c != ZERO)
        };
        let orders: Vec<Order> = Order::up_to(order_limit, engine.strokes).into_iter().filter(is_there).collect();
        let rows = table.over_speed.len().max(1);
        let amplitudes: Vec<Vec<C64>> = orders.iter().map(|o| table.amplitudes(*o)).collect();
        // a table of a whole throw: only its first unit counts
        let units = |throw| match table.masses {
            Some(_) => engine.layout.firing_on_throw(throw).to_vec(),
            None => vec![engine.layout.firing_on_throw(throw)[0]],
        };
        Self {
            harmonics: orders.iter().map(|o| o.per_cycle(engine.strokes)).collect(),
            tabulated_rpm: table.speeds_rpm(),
            gas: (0..rows).map(|row| amplitudes.iter().map(|a| a[row]).collect()).collect(),
            inertia: orders.iter().map(|o| inertia.iter().find(|i| i.0 == *o).map_or(ZERO, |i| i.1)).collect(),
            phases: (0..engine.layout.throws()).map(|t| phases(&units(t), &orders)).collect(),
            audit: Vec::new(),
            units: Units::Equal,
            changes: Vec::new(),
            radial: None,
            orders,
        }
    }

    /// A share of the way from this torque to that of an engine which differs from it only by what its gas torque is linear in; the audit stays that of this one.
    #[doc(hidden)]
    pub fn towards(&self, other: &Self, share: f64) -> Self {
        let row = |(a, b): (&Vec<C64>, &Vec<C64>)| a.iter().zip(b).map(|(a, b)| a + (b - a) * share).collect();
        let gas = |a: &[Vec<C64>], b: &[Vec<C64>]| a.iter().zip(b).map(row).collect();
        let radial = self.radial.as_ref().zip(other.radial.as_ref());
        let radial = radial.map(|(a, b)| Radial { gas: gas(&a.gas, &b.gas), inertia: a.inertia.clone() });
        Self { gas: gas(&self.gas, &other.gas), radial, ..self.clone() }
    }

    /// With the radial forces on the pins, too; without a change where the torque comes from a table.
    #[must_use]
    #[doc(hidden)]
    pub fn with_radial(mut self, engine: &Engine) -> Self {
        let Source::Cylinder { geometry, pressure } = &engine.source else { return self };
        let analyser = Analyser::new(samples(engine.strokes), &self.harmonics);
        let traces = pressure.traces(geometry, engine.strokes, engine.layout.firing_deg.len());
        let traces: Vec<(f64, Vec<f64>)> = pressure.speeds_rpm().iter().copied().zip(traces).collect();
        self.radial = Some(Radial {
            gas: Radial::gas_of((geometry, engine.strokes), &analyser, &traces),
            inertia: analyser.analyse(&radial::of_masses(geometry, engine.strokes)),
        });
        self
    }

    /// What a unit of this engine loses when it does not fire; nothing where the torque comes from a table.
    pub fn motored_change(&self, engine: &Engine) -> Option<MotoredChange> {
        let Source::Cylinder { geometry, pressure } = &engine.source else { return None };
        let analyser = Analyser::new(samples(engine.strokes), &self.harmonics);
        let levers = levers(geometry, engine.strokes);
        let change = |(index, fired): (usize, &Vec<C64>)| -> Vec<C64> {
            let trace = pressure.motored(index, geometry, engine.strokes);
            let torque = torque_without_inertia((geometry, &levers), &trace, pressure.speeds_rpm()[index]);
            analyser.analyse(&torque).iter().zip(fired).map(|(m, f)| m - f).collect()
        };
        let motored = |index: usize| (pressure.speeds_rpm()[index], pressure.motored(index, geometry, engine.strokes));
        let radial = self.radial.as_ref().map_or_else(Vec::new, |fired| {
            let traces: Vec<(f64, Vec<f64>)> = (0..fired.gas.len()).map(motored).collect();
            let own = Radial::gas_of((geometry, engine.strokes), &analyser, &traces);
            own.iter().zip(&fired.gas).map(|(m, f)| m.iter().zip(f).map(|(m, f)| m - f).collect()).collect()
        });
        Some(MotoredChange { torque: self.gas.iter().enumerate().map(change).collect(), radial })
    }

    /// The same engine with `cylinder` (from 0) misfiring. The others keep their load.
    #[must_use]
    pub fn misfiring(&self, engine: &Engine, cylinder: usize, change: &MotoredChange) -> Self {
        let misfire_change = |table: &[Vec<C64>]| self.of_cylinder(engine, cylinder, 1.0, table);
        let changes = vec![Change {
            throw: cylinder / engine.layout.rods_per_throw,
            torque: misfire_change(&change.torque),
            radial: misfire_change(&change.radial),
        }];
        Self { units: Units::Misfiring(cylinder), changes, ..self.clone() }
    }

    /// The same engine whose cylinders burn unequally: what burning adds to the torque of a motored cylinder is larger by `scatter` (one share a
    /// cylinder; -1 is a misfire).
    ///
    /// # Panics
    /// Where `scatter` has another length than the engine has cylinders.
    #[must_use]
    pub fn unequal(&self, engine: &Engine, scatter: &[f64], change: &MotoredChange) -> Self {
        assert_eq!(scatter.len(), engine.layout.firing_deg.len(), "one share a cylinder");
        let rods = engine.layout.rods_per_throw;
        let changes = scatter.chunks(rods).enumerate().map(|(throw, shares)| {
            let together = |table: &[Vec<C64>]| {
                let mut all = vec![vec![ZERO; self.orders.len()]; table.len()];
                for (rod, share) in shares.iter().enumerate() {
                    let of_cylinder = self.of_cylinder(engine, throw * rods + rod, -share, table);
                    all.iter_mut().flatten().zip(of_cylinder.iter().flatten()).for_each(|(sum, c)| *sum += c);
                }
                all
            };
            Change { throw, torque: together(&change.torque), radial: together(&change.radial) }
        });
        Self { units: Units::Unequal, changes: changes.collect(), ..self.clone() }
    }

    /// The same engine with no cylinder burning: all compress and expand.
    #[must_use]
    pub fn motored(&self, engine: &Engine, change: &MotoredChange) -> Self {
        Self { units: Units::Motored, ..self.unequal(engine, &vec![-1.0; engine.layout.firing_deg.len()], change) }
    }

    /// A share of the change from firing to motored, at the firing angle of a cylinder.
    fn of_cylinder(&self, engine: &Engine, cylinder: usize, share: f64, table: &[Vec<C64>]) -> Vec<Vec<C64>> {
        let phase = phases(&[engine.layout.firing_deg[cylinder]], &self.orders);
        let at_angle = |row: &Vec<C64>| row.iter().zip(&phase).map(|(c, p)| c * p * share).collect();
        table.iter().map(at_angle).collect()
    }

    fn from_cylinder(engine: &Engine, order_limit: f64) -> Self {
        let Source::Cylinder { geometry, pressure } = &engine.source else { unreachable!("called for cylinders only") };
        let orders = Order::up_to(order_limit, engine.strokes);
        let harmonics: Vec<u32> = orders.iter().map(|o| o.per_cycle(engine.strokes)).collect();
        let (n, cylinders) = (samples(engine.strokes), engine.layout.firing_deg.len());
        let analyser = Analyser::new(n, &harmonics);
        let levers = levers(geometry, engine.strokes);
        let mut torques = Vec::new();
        let mut audit = Vec::new();
        let traces = pressure.traces(geometry, engine.strokes, cylinders);
        for (index, (&speed_rpm, trace)) in pressure.speeds_rpm().iter().zip(traces).enumerate() {
            let torque = torque_without_inertia((geometry, &levers), &trace, speed_rpm);
            let mean = torque.iter().sum::<f64>() / n as f64;
            torques.push(torque);
            audit.push(Audit {
                speed_rpm,
                indicated_mean_pressure: mean * engine.cycle_deg() * RAD_PER_DEG / geometry.displacement(),
                peak_pressure: trace.iter().copied().fold(f64::NEG_INFINITY, f64::max),
                mean_torque: mean * cylinders as f64,
                brake_torque: pressure.brake_torque(index),
            });
        }
        torques.push(each_revolution(engine.strokes, |theta| inertia_torque_per_omega2(geometry, theta)));
        let mut gas = analyser.analyse_each(&torques.iter().map(Vec::as_slice).collect::<Vec<_>>());
        Self {
            inertia: gas.pop().unwrap_or_default(),
            phases: (0..engine.layout.throws()).map(|t| phases(engine.layout.firing_on_throw(t), &orders)).collect(),
            tabulated_rpm: pressure.speeds_rpm().to_vec(),
            orders,
            harmonics,
            gas,
            audit,
            units: Units::Equal,
            changes: Vec::new(),
            radial: None,
        }
    }

    /// Number of throws.
    pub fn throws(&self) -> usize {
        self.phases.len()
    }

    /// Complex torque amplitude of one firing unit, N m, before its firing phase. Gas torque is linear between the tabulated speeds and held at their
    /// ends, inertia torque exact in the square of the speed.
    pub fn unit_torque(&self, order: usize, speed_rpm: f64) -> C64 {
        let gas = self.between(&self.gas, order, speed_rpm);
        let omega = speed_rpm * RAD_PER_S_PER_RPM;
        gas + self.inertia[order] * (omega * omega)
    }

    /// The same of all orders at once.
    pub(crate) fn unit_torques(&self, speed_rpm: f64) -> Vec<C64> {
        let omega2 = (speed_rpm * RAD_PER_S_PER_RPM).powi(2);
        let with_inertia = |gas: C64, inertia: &C64| gas + inertia * omega2;
        if self.gas.len() == 1 {
            return self.gas[0].iter().zip(&self.inertia).map(|(g, i)| with_inertia(*g, i)).collect();
        }
        let (i, fraction) = table_lookup::held(&self.tabulated_rpm, speed_rpm);
        let between = self.gas[i].iter().zip(&self.gas[i + 1]).map(|(a, b)| a + (b - a) * fraction);
        between.zip(&self.inertia).map(|(g, i)| with_inertia(g, i)).collect()
    }

    /// Linear between the tabulated speeds, held at their ends.
    fn between(&self, table: &[Vec<C64>], order: usize, speed_rpm: f64) -> C64 {
        if table.len() == 1 {
            return table[0][order];
        }
        let (i, fraction) = table_lookup::held(&self.tabulated_rpm, speed_rpm);
        table[i][order] + (table[i + 1][order] - table[i][order]) * fraction
    }

    /// What units that differ add to the torque of their throws (from 0), N m.
    pub(crate) fn changes(&self, order: usize, speed_rpm: f64) -> impl Iterator<Item = (usize, C64)> {
        self.changes.iter().map(move |c| (c.throw, self.between(&c.torque, order, speed_rpm)))
    }

    /// Radial force of one firing unit on its pin, N, before its firing phase, as [`Self::unit_torque`]; zero where it is not known.
    pub(crate) fn unit_radial(&self, order: usize, speed_rpm: f64) -> C64 {
        let Some(radial) = &self.radial else { return ZERO };
        let omega = speed_rpm * RAD_PER_S_PER_RPM;
        self.between(&radial.gas, order, speed_rpm) + radial.inertia[order] * (omega * omega)
    }

    /// What units that differ add to the radial force on their throws (from 0), N.
    pub(crate) fn radial_changes(&self, order: usize, speed_rpm: f64) -> impl Iterator<Item = (usize, C64)> {
        let known = self.changes.iter().filter(|c| !c.radial.is_empty());
        known.map(move |c| (c.throw, self.between(&c.radial, order, speed_rpm)))
    }

    /// Sum of the firing phases of the units on `throw` (from 0) at the order of index `order`.
    pub fn phase(&self, throw: usize, order: usize) -> C64 {
        self.phases[throw][order]
    }

    /// Complex torque amplitude of a throw, N m.
    pub fn throw_torque(&self, throw: usize, order: usize, speed_rpm: f64) -> C64 {
        let equal = self.unit_torque(order, speed_rpm) * self.phases[throw][order];
        self.changes(order, speed_rpm).filter(|c| c.0 == throw).fold(equal, |sum, c| sum + c.1)
    }
}

/// Below this share of the largest an order of the moving masses is rounding.
const ROUNDING: f64 = 1e-9;

/// Orders of the torque of the masses beside a table of the gas, per (rad/s)²; none where the table holds all.
fn inertia_of(engine: &Engine, table: &HarmonicTable, order_limit: f64) -> Vec<(Order, C64)> {
    let Some(masses) = &table.masses else { return Vec::new() };
    let orders = Order::up_to(order_limit, engine.strokes);
    let harmonics: Vec<u32> = orders.iter().map(|o| o.per_cycle(engine.strokes)).collect();
    let torque = each_revolution(engine.strokes, |theta| inertia_torque_per_omega2(masses, theta));
    let found = Analyser::new(torque.len(), &harmonics).analyse(&torque);
    let largest = found.iter().map(|c| c.norm()).fold(0.0, f64::max);
    orders.into_iter().zip(found).filter(|(_, c)| c.norm() > ROUNDING * largest).collect()
}

/// Sum of e^{-i n phi} over the firing angles phi (degrees), for each order n.
fn phases(firing_deg: &[f64], orders: &[Order]) -> Vec<C64> {
    orders
        .iter()
        .map(|o| {
            let sum: C64 = firing_deg.iter().map(|deg| turn(-o.value() * deg * RAD_PER_DEG)).sum();
            // units that cancel leave nothing but rounding: an exact zero keeps such orders out of every result
            if sum.norm() < 1e-12 { ZERO } else { sum }
        })
        .collect()
}
