//! A flexible crank in the place of the chain's shafts: what its stations do under the forces of an order, and under torque on a station.

use crate::engine::{Engine, Excitation, Order};
use crate::numerics::elementary::turn;
use crate::numerics::tridiagonal::Singular;
use crate::numerics::{C64, ZERO};
use crate::rotor::shaft::{Answer, Dissipation, Shaft, Turning};
use crate::rotor::transfer::{Load, Point, Transfer};
use crate::units::{RAD_PER_DEG, RAD_PER_S_PER_RPM};
use nalgebra::{DVector, SVector, Vector3};
use std::sync::Arc;

/// A shaft with what of it belongs to the stations of a chain.
#[derive(Debug, Clone)]
pub struct OnStations {
    /// Nodes, beams, bodies, bearings.
    pub shaft: Shaft,
    /// Node of each station.
    pub stations: Vec<usize>,
    /// Of each shaft length: a twist of it, its stiffness against that, N m/rad, and how that dissipates.
    pub lengths: Vec<(Answer, f64, Dissipation)>,
    /// Nodes of the rods of each throw.
    pub rods: Vec<Vec<usize>>,
    /// Outwards and in the direction of rotation, of each throw.
    pub directions: Vec<[Vector3<f64>; 2]>,
    /// Of the throws, m.
    pub radius: f64,
}

/// Which loads tables are asked for.
#[derive(Debug, Clone)]
pub struct Asked {
    /// Orders of the excitation.
    pub orders: Vec<Order>,
    /// rpm.
    pub speeds_rpm: (f64, f64),
    /// Stations that carry absorbers.
    pub hosts: Vec<usize>,
    /// Whether cylinders may differ.
    pub unlike: bool,
}

/// Tables of a flexible crank.
#[derive(Debug)]
pub struct FlexibleCrank {
    crank: OnStations,
    transfer: Transfer,
    hosts: Vec<usize>,
    /// Place of the loads of the first throw alone among all, where there are such.
    alone: Option<usize>,
    orders: Vec<Order>,
    speeds_rpm: (f64, f64),
}

/// An order at a speed.
#[derive(Debug, Clone)]
pub(crate) struct CrankPoint {
    point: Point,
    order: usize,
    speed_rpm: f64,
    /// Answers that are asked for: angles of stations, then torques of shafts; all without.
    rows: Option<Arc<[usize]>>,
}

/// A force on a rod's node.
fn force(direction: Vector3<f64>, factor: C64) -> SVector<C64, 6> {
    SVector::<C64, 6>::from_fn(|i, _| if i < 3 { factor * direction[i] } else { ZERO })
}

impl FlexibleCrank {
    /// Solves the tables.
    pub fn new(crank: OnStations, engine: &Engine, asked: Asked) -> Self {
        let throws = crank.rods.len();
        let loads = |order: &Order| -> Vec<Load> {
            let mut all = vec![alike(&crank, engine, *order, 0), alike(&crank, engine, *order, 1)];
            all.extend(asked.hosts.iter().map(|s| unit_torque(&crank, *s)));
            if asked.unlike {
                all.extend((0..throws).flat_map(|t| [alone(&crank, t, 0), alone(&crank, t, 1)]));
            }
            all
        };
        let angles = crank.stations.iter().map(|node| crank.shaft.rotation(*node));
        let twists = crank.lengths.iter().map(|(twist, _, _)| twist.clone());
        let answers: Vec<Answer> = angles.chain(twists).collect();
        let (low, high) = asked.speeds_rpm;
        let range = (low * RAD_PER_S_PER_RPM, high * RAD_PER_S_PER_RPM);
        let values = asked.orders.iter().map(|o| o.value()).collect();
        let transfer = Transfer::new(crank.shaft.clone(), values, asked.orders.iter().map(loads).collect(), answers, range);
        let alone = asked.unlike.then_some(2 + asked.hosts.len());
        Self { crank, transfer, hosts: asked.hosts, alone, orders: asked.orders, speeds_rpm: asked.speeds_rpm }
    }

    /// Whether the tables hold what is asked for.
    #[doc(hidden)]
    pub fn hold(&self, asked: &Asked) -> bool {
        let speeds = self.speeds_rpm.0 <= asked.speeds_rpm.0 && asked.speeds_rpm.1 <= self.speeds_rpm.1;
        let hosts = asked.hosts.iter().all(|s| self.hosts.contains(s));
        self.orders == asked.orders && speeds && hosts && (self.alone.is_some() || !asked.unlike)
    }

    /// Motion of all nodes at an order of the excitation and a speed, under the forces of an engine and torques on stations; solved for itself.
    ///
    /// # Errors
    /// [`Singular`] at an undamped resonance.
    pub fn motion(
        &self,
        excitation: &Excitation,
        (order, speed_rpm): (usize, f64),
        torques: &[(usize, C64)],
    ) -> Result<DVector<C64>, Singular> {
        let speed = speed_rpm * RAD_PER_S_PER_RPM;
        let loads = self.transfer.loads(order);
        let mut all = forces(&self.crank, [&loads[0], &loads[1]], excitation, (order, speed_rpm));
        for (station, torque) in torques {
            put(&mut all, &unit_torque(&self.crank, *station), *torque);
        }
        self.crank.shaft.response(Turning { omega: self.orders[order].value() * speed, speed }, &all)
    }

    /// The crank itself.
    pub(crate) fn on_stations(&self) -> &OnStations {
        &self.crank
    }

    /// Tables of other answers to the forces of all cylinders alike, in both directions, and to a unit torque on each station that may carry absorbers.
    pub(crate) fn other_answers(&self, answers: Vec<Answer>) -> Transfer {
        let loads = |n: usize| self.transfer.loads(n)[..2 + self.hosts.len()].to_vec();
        let (low, high) = self.speeds_rpm;
        let range = (low * RAD_PER_S_PER_RPM, high * RAD_PER_S_PER_RPM);
        let orders: Vec<f64> = self.orders.iter().map(|o| o.value()).collect();
        Transfer::new(self.crank.shaft.clone(), orders, (0..self.orders.len()).map(loads).collect(), answers, range)
    }

    /// Those answers under the forces of an engine whose cylinders are alike and torques on stations.
    ///
    /// # Errors
    /// [`Singular`] at an undamped resonance.
    pub(crate) fn answered(
        &self,
        transfer: &Transfer,
        excitation: &Excitation,
        (order, speed_rpm): (usize, f64),
        torques: &[(usize, C64)],
    ) -> Result<Vec<C64>, Singular> {
        let speed = speed_rpm * RAD_PER_S_PER_RPM;
        let point = transfer.at(order, speed)?;
        let mut all = vec![ZERO; transfer.answers()];
        let radial = (0, excitation.unit_radial(order, speed_rpm));
        let tangential = (1, excitation.unit_torque(order, speed_rpm) / self.crank.radius);
        [radial, tangential].into_iter().for_each(|load| transfer.add(load, order, (&point, None), &mut all));
        for (station, torque) in torques {
            match self.hosts.iter().position(|s| s == station) {
                Some(host) => transfer.add((2 + host, *torque), order, (&point, None), &mut all),
                None => {
                    let own = transfer.solved(order, speed, &[unit_torque(&self.crank, *station)])?;
                    all.iter_mut().zip(own).for_each(|(sum, y)| *sum += y * torque);
                }
            }
        }
        Ok(all)
    }

    /// An order of the excitation at a speed.
    pub(crate) fn at(&self, (order, speed_rpm): (usize, f64), rows: Option<Arc<[usize]>>) -> Result<CrankPoint, Singular> {
        Ok(CrankPoint { point: self.transfer.at(order, speed_rpm * RAD_PER_S_PER_RPM)?, order, speed_rpm, rows })
    }

    /// Angles of the stations, then torques of the shafts, under the forces of an engine.
    pub(crate) fn under_load(&self, point: &CrankPoint, excitation: &Excitation) -> Vec<C64> {
        let (order, speed) = (point.order, point.speed_rpm);
        let mut all = vec![ZERO; self.crank.stations.len() + self.crank.lengths.len()];
        let mut add = |load: usize, factor: C64| self.transfer.add((load, factor), order, (&point.point, point.rows.as_deref()), &mut all);
        let radius = self.crank.radius;
        add(0, excitation.unit_radial(order, speed));
        add(1, excitation.unit_torque(order, speed) / radius);
        if let Some(alone) = self.alone {
            excitation.radial_changes(order, speed).for_each(|(throw, radial)| add(alone + 2 * throw, radial));
            excitation.changes(order, speed).for_each(|(throw, torque)| add(alone + 2 * throw + 1, torque / radius));
        }
        self.with_torques(all, point)
    }

    /// The same under a unit torque on a station.
    ///
    /// # Errors
    /// [`Singular`] at an undamped resonance.
    pub(crate) fn under_unit(&self, point: &CrankPoint, station: usize) -> Result<Vec<C64>, Singular> {
        let answers = match self.hosts.iter().position(|s| *s == station) {
            Some(place) => {
                let mut all = vec![ZERO; self.crank.stations.len() + self.crank.lengths.len()];
                let load = (2 + place, C64::from(1.0));
                self.transfer.add(load, point.order, (&point.point, point.rows.as_deref()), &mut all);
                all
            }
            None => self.transfer.solved(point.order, point.speed_rpm * RAD_PER_S_PER_RPM, &[unit_torque(&self.crank, station)])?,
        };
        Ok(self.with_torques(answers, point))
    }

    /// Torques of shafts in the place of the twists beside their middles.
    fn with_torques(&self, mut answers: Vec<C64>, point: &CrankPoint) -> Vec<C64> {
        let stations = self.crank.stations.len();
        if point.rows.as_ref().is_some_and(|rows| rows.iter().all(|r| *r < stations)) {
            return answers;
        }
        let omega = self.orders[point.order].omega(point.speed_rpm);
        for (twist, (_, stiffness, dissipation)) in answers[stations..].iter_mut().zip(&self.crank.lengths) {
            *twist *= dissipation.factor(omega) * *stiffness;
        }
        answers
    }
}

/// Unit forces of all cylinders, alike, in the direction of an index.
fn alike(crank: &OnStations, engine: &Engine, order: Order, direction: usize) -> Load {
    let on = |t: usize| crank.rods[t].iter().zip(engine.layout.firing_on_throw(t)).map(move |(node, deg)| (t, *node, *deg));
    let phase = |deg: f64| turn(-order.value() * deg * RAD_PER_DEG);
    (0..crank.rods.len()).flat_map(on).map(|(t, node, deg)| (node, force(crank.directions[t][direction], phase(deg)))).collect()
}

/// Adds a factor times a load to forces and moments on all nodes.
fn put(all: &mut DVector<C64>, load: &Load, factor: C64) {
    load.iter().for_each(|(node, force)| (0..6).for_each(|k| all[6 * node + k] += factor * force[k]));
}

/// Forces and moments on all nodes at an order of an excitation and a speed; `loads`: all cylinders alike, in both directions.
fn forces(crank: &OnStations, loads: [&Load; 2], excitation: &Excitation, (order, speed_rpm): (usize, f64)) -> DVector<C64> {
    let mut all = DVector::from_element(6 * crank.shaft.len(), ZERO);
    put(&mut all, loads[0], excitation.unit_radial(order, speed_rpm));
    put(&mut all, loads[1], excitation.unit_torque(order, speed_rpm) / crank.radius);
    for (throw, radial) in excitation.radial_changes(order, speed_rpm) {
        put(&mut all, &alone(crank, throw, 0), radial);
    }
    for (throw, torque) in excitation.changes(order, speed_rpm) {
        put(&mut all, &alone(crank, throw, 1), torque / crank.radius);
    }
    all
}

impl OnStations {
    /// Forces and moments of an engine on all nodes at an order of its excitation (by its index) and a speed.
    pub(crate) fn forces(&self, engine: &Engine, excitation: &Excitation, (order, speed_rpm): (usize, f64)) -> DVector<C64> {
        let own = excitation.orders[order];
        let loads = [0, 1].map(|direction| alike(self, engine, own, direction));
        forces(self, [&loads[0], &loads[1]], excitation, (order, speed_rpm))
    }
}

/// A unit force on the pin of a throw, shared by its rods, in the direction of an index.
fn alone(crank: &OnStations, throw: usize, direction: usize) -> Load {
    let rods = &crank.rods[throw];
    let share = C64::from(1.0 / rods.len() as f64);
    rods.iter().map(|node| (*node, force(crank.directions[throw][direction], share))).collect()
}

/// A unit torque on a station.
fn unit_torque(crank: &OnStations, station: usize) -> Load {
    let rotation = crank.shaft.rotation(crank.stations[station]).into_iter();
    rotation.map(|(node, k, factor)| (node, SVector::<C64, 6>::from_fn(|i, _| C64::from(if i == k { factor } else { 0.0 })))).collect()
}
