//! Loads in the middle of all webs of a flexible crank over the working cycle at a speed, or what else its motion tells.
//!
//! The orders of the excitation are those of the vibrating crank with its absorbers. What lies above them, and the mean, is quasi-static: the same crank on its bearings, turning at that speed, its flywheel held against the torque.

use super::round_section::RoundSection;
use super::web_section::WebSection;
use super::{Assembled, WebLoad, mean_load};
use crate::crankshaft::bending::OTHER_STRIDE;
use crate::crankshaft::loads::InPlane;
use crate::drivetrain::FlexibleCrank;
use crate::engine::cycle::{Cycle, ThrowLoads, pin_angles};
use crate::engine::{Engine, Excitation};
use crate::numerics::C64;
use crate::numerics::block_tridiagonal::Columns;
use crate::numerics::elementary::Elementary;
use crate::numerics::matrix_product::add_product;
use crate::numerics::tridiagonal::Singular;
use crate::rotor::shaft::{Answer, Dissipation, Turning};
use crate::rotor::transfer::Transfer;
use crate::units::RAD_PER_S_PER_RPM;
use nalgebra::{DMatrix, DVector};
use std::sync::OnceLock;

/// What no speed and no absorber changes.
#[derive(Debug)]
pub struct WebLoads<'a> {
    assembled: &'a Assembled,
    /// What is asked, by the motion of all nodes, and how that dissipates.
    asked: Vec<(Answer, Dissipation)>,
    engine: &'a Engine,
    crank: &'a FlexibleCrank,
    excitation: &'a Excitation,
    cycle: Cycle<'a>,
    /// Tables of all loads by order, once they are asked for.
    transfer: OnceLock<Transfer>,
    /// Throw and node of rods, each once.
    pins: Vec<(usize, usize)>,
    /// Crank angle of every sample, rad.
    theta: Vec<f64>,
    /// Cosine of every order (a column each) at every sample, then the sines with a minus sign.
    waves: DMatrix<f64>,
    /// Sine and cosine of the angle of every throw at every sample.
    turns: Vec<Vec<(f64, f64)>>,
}

/// The crank without vibration at a speed.
#[derive(Debug, Clone)]
pub struct QuasiStatic {
    speed_rpm: f64,
    /// What is asked (of webs four loads each) in the mean over the cycle.
    mean: DVector<f64>,
    /// The same per force at every pin, outwards and in the direction of rotation.
    per_force: DMatrix<f64>,
    /// Loads at each order of the excitation.
    orders: Vec<DVector<C64>>,
}

/// Loads of a web over the cycle in the plane of its throw, from those of all webs.
#[doc(hidden)]
pub fn in_plane(all: &DMatrix<f64>, web: usize) -> InPlane {
    let load = |load: WebLoad| all.column(4 * web + load as usize).iter().copied().collect();
    InPlane { moment: load(WebLoad::Moment), shear: load(WebLoad::Shear), tangential: load(WebLoad::Across) }
}

impl<'a> WebLoads<'a> {
    /// Of the webs of a crank put together and its tables, under an excitation with all cylinders alike; `engine`: with the pressure that bends it, quasi-static. `None` where the torque comes from a table, and where its matrices say
    /// nothing of webs.
    pub fn new(assembled: &'a Assembled, engine: &'a Engine, (crank, excitation): (&'a FlexibleCrank, &'a Excitation)) -> Option<Self> {
        let of_section = |s: &WebSection| s.answers.clone().map(|answer| (answer, s.dissipation)).to_vec();
        Self::asking(assembled, assembled.sections.iter().flatten().flat_map(of_section).collect(), (engine, crank, excitation))
    }

    /// Of journals and pins of a crank of beams, cut at the faces of their webs: six loads a section, four sections a throw, in the place of those of webs. `None` as of [`Self::new`].
    #[doc(hidden)]
    pub fn of_rounds(
        assembled: &'a Assembled,
        engine: &'a Engine,
        (crank, excitation): (&'a FlexibleCrank, &'a Excitation),
    ) -> Option<Self> {
        let of_section = |s: &RoundSection| s.answers.clone().map(|answer| (answer, s.dissipation)).to_vec();
        Self::asking(assembled, assembled.rounds.iter().flatten().flat_map(of_section).collect(), (engine, crank, excitation))
    }

    /// Of the unknowns of a crank by matrices, as their files have them, a column each in place of the loads of webs; `None` where the torque comes from a table, and of a crank of beams.
    #[doc(hidden)]
    pub fn of_unknowns(
        assembled: &'a Assembled,
        engine: &'a Engine,
        (crank, excitation): (&'a FlexibleCrank, &'a Excitation),
    ) -> Option<Self> {
        let asked = assembled.written.iter().map(|(_, answer)| (answer.clone(), Dissipation::default()));
        Self::asking(assembled, asked.collect(), (engine, crank, excitation))
    }

    fn asking(
        assembled: &'a Assembled,
        asked: Vec<(Answer, Dissipation)>,
        (engine, crank, excitation): (&'a Engine, &'a FlexibleCrank, &'a Excitation),
    ) -> Option<Self> {
        let cycle = Cycle::new(engine).filter(|_| !asked.is_empty())?;
        let theta = cycle.theta(OTHER_STRIDE);
        let orders: Vec<f64> = excitation.orders.iter().map(|o| o.value()).collect();
        let mut waves = DMatrix::zeros(theta.len(), 2 * orders.len());
        for (n, order) in orders.iter().enumerate() {
            for (j, theta) in theta.iter().enumerate() {
                let (sine, cosine) = (order * theta).sine_cosine();
                (waves[(j, n)], waves[(j, n + orders.len())]) = (cosine, -sine);
            }
        }
        let turns = pin_angles(engine).into_iter().map(|angle| theta.iter().map(|theta| (theta + angle).sine_cosine()).collect());
        let mut pins: Vec<(usize, usize)> =
            assembled.rods.iter().enumerate().flat_map(|(t, nodes)| nodes.iter().map(move |n| (t, *n))).collect();
        pins.dedup();
        Some(Self {
            assembled,
            asked,
            engine,
            crank,
            excitation,
            cycle,
            transfer: OnceLock::new(),
            pins,
            turns: turns.collect(),
            theta,
            waves,
        })
    }

    /// The crank without vibration at a speed.
    ///
    /// # Errors
    /// [`Singular`] where nothing holds it.
    pub fn quasi_static(&self, speed_rpm: f64) -> Result<QuasiStatic, Singular> {
        let mut shaft = self.assembled.shaft.clone();
        let flywheel = self.assembled.stations[self.assembled.stations.len() - 1];
        shaft.hold_rotation(flywheel);
        let columns = 1 + 2 * self.pins.len();
        let mut x = vec![Columns::zeros(columns); shaft.len()];
        let mean = mean_load(self.assembled, &self.cycle, speed_rpm);
        for (i, own) in x.iter_mut().enumerate() {
            (0..6).for_each(|k| own[(k, 0)] = mean[6 * i + k]);
        }
        for (p, (throw, node)) in self.pins.iter().enumerate() {
            for (d, direction) in self.assembled.directions[*throw].iter().enumerate() {
                (0..3).for_each(|k| x[*node][(k, 1 + 2 * p + d)] = C64::from(direction[k]));
            }
        }
        shaft.factored(Turning { omega: 0.0, speed: speed_rpm * RAD_PER_S_PER_RPM })?.solve(&mut x)?;
        let load = |row: usize, column: usize| self.value(row, |node, k| x[node][(k, column)], 0.0).re;
        let rows = self.asked.len();
        let per_force = DMatrix::from_fn(rows, columns - 1, |i, j| load(i, 1 + j));
        let complex = per_force.map(C64::from);
        let orders = (0..self.excitation.orders.len()).map(|n| &complex * self.amplitudes(n, speed_rpm)).collect();
        Ok(QuasiStatic { speed_rpm, mean: DVector::from_fn(rows, |i, _| load(i, 0)), per_force, orders })
    }

    /// Loads of all webs at every order of the excitation at a speed, `torques` of the absorbers on their stations: four a web, N m and N.
    ///
    /// # Errors
    /// [`Singular`] at an undamped resonance.
    pub fn orders(&self, speed_rpm: f64, torques: &[Vec<(usize, C64)>]) -> Result<Vec<Vec<C64>>, Singular> {
        let answers = || self.asked.iter().map(|a| a.0.clone()).collect();
        let transfer = self.transfer.get_or_init(|| self.crank.other_answers(answers()));
        let loads_of_order = |(n, torques): (usize, &Vec<(usize, C64)>)| {
            let mut all = self.crank.answered(transfer, self.excitation, (n, speed_rpm), torques)?;
            let omega = self.excitation.orders[n].omega(speed_rpm);
            all.iter_mut().zip(&self.asked).for_each(|(y, (_, dissipation))| *y *= dissipation.factor(omega));
            Ok(all)
        };
        torques.iter().enumerate().map(loads_of_order).collect()
    }

    /// The same under a motion of all nodes at every order.
    #[doc(hidden)]
    pub fn of_motions(&self, speed_rpm: f64, motions: &[DVector<C64>]) -> Vec<Vec<C64>> {
        let omega = |n: usize| self.excitation.orders[n].omega(speed_rpm);
        let loads_of_order = |(n, motion): (usize, &DVector<C64>)| {
            (0..self.asked.len()).map(|i| self.value(i, |node, k| motion[6 * node + k], omega(n))).collect()
        };
        motions.iter().enumerate().map(loads_of_order).collect()
    }

    /// What is asked at an index, by the motion of the nodes at a frequency.
    fn value(&self, index: usize, motion: impl Fn(usize, usize) -> C64, omega: f64) -> C64 {
        let (answer, dissipation) = &self.asked[index];
        answer.iter().map(|(node, k, factor)| motion(*node, *k) * *factor).sum::<C64>() * dissipation.factor(omega)
    }

    /// Loads of all webs over the cycle without vibration: four columns a web, as [`WebLoad::ALL`], N m and N.
    pub fn still(&self, quasi: &QuasiStatic) -> DMatrix<f64> {
        let mut all = DMatrix::from_fn(self.theta.len(), quasi.mean.len(), |_, load| quasi.mean[load]);
        add_product(&self.forces(quasi.speed_rpm), &quasi.per_force.transpose(), &mut all);
        all
    }

    /// The same with vibration; `still`: without, `orders`: as [`Self::orders`] has them.
    pub fn vibrating(&self, quasi: &QuasiStatic, still: &DMatrix<f64>, orders: &[Vec<C64>]) -> DMatrix<f64> {
        let count = orders.len();
        let change = DMatrix::from_fn(2 * count, still.ncols(), |c, i| {
            let change = orders[c % count][i] - quasi.orders[c % count][i];
            if c < count { change.re } else { change.im }
        });
        let mut all = still.clone();
        add_product(&self.waves, &change, &mut all);
        all
    }

    /// Crank angle of every sample, rad.
    pub fn theta(&self) -> &[f64] {
        &self.theta
    }

    /// Forces on all pins over the cycle less their means: outwards and in the direction of rotation, a column each.
    fn forces(&self, speed_rpm: f64) -> DMatrix<f64> {
        let mut loads = ThrowLoads::default();
        self.cycle.loads_into(speed_rpm, OTHER_STRIDE, &mut loads);
        let rods = self.engine.layout.rods_per_throw;
        let mut all = DMatrix::zeros(self.theta.len(), 2 * self.pins.len());
        for (throw, turns) in self.turns.iter().enumerate() {
            for (rod, node) in self.assembled.rods[throw].iter().enumerate() {
                let Some(pin) = self.pins.iter().position(|p| *p == (throw, *node)) else { continue };
                for (j, ([x, y], (sine, cosine))) in loads.rod_force[throw * rods + rod].iter().zip(turns).enumerate() {
                    all[(j, 2 * pin)] += x * cosine + y * sine;
                    all[(j, 2 * pin + 1)] += y * cosine - x * sine;
                }
            }
        }
        for mut load in all.column_iter_mut() {
            let mean: f64 = load.iter().sum::<f64>() / self.theta.len() as f64;
            load.add_scalar_mut(-mean);
        }
        all
    }

    /// The same forces at an order.
    fn amplitudes(&self, order: usize, speed_rpm: f64) -> DVector<C64> {
        let all = self.crank.on_stations().forces(self.engine, self.excitation, (order, speed_rpm));
        let along = |(throw, node): (usize, usize), d: usize| {
            (0..3).map(|k| all[6 * node + k] * self.assembled.directions[throw][d][k]).sum::<C64>()
        };
        DVector::from_fn(2 * self.pins.len(), |i, _| along(self.pins[i / 2], i % 2))
    }
}
