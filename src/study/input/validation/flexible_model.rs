//! The flexible crank of a study: its modes and tables, found once.

use crate::crankshaft::Crank;
use crate::crankshaft::flexible::on_joints::OnJoints;
use crate::crankshaft::flexible::{Assembled, Bearing, Carried, FlexibleSpec, LinearBearings, assemble};
use crate::drivetrain::flexible::{Asked, OnStations};
use crate::drivetrain::modes::Flexible;
use crate::drivetrain::{Chain, FlexibleCrank, Modes};
use crate::engine::{Engine, Excitation};
use crate::rotor::free_modes::{FreeMode, free_modes};
use crate::rotor::shaft::Six;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Highest order on bearings that are not linear.
const ORDERS_ON_JOINTS: f64 = 24.0;
/// Modes that are kept.
const MODES: usize = 32;

/// A crank put together with the chain of a study.
#[derive(Debug, Clone)]
pub struct FlexibleModel {
    /// As the engine file has it.
    pub spec: FlexibleSpec,
    /// Nodes, beams, bodies.
    pub assembled: Assembled,
    /// Modes at rest, once they are asked for.
    modes: Arc<OnceLock<Option<Vec<FreeMode>>>>,
    /// The same as motions of the stations about the axis.
    on_chain: Arc<OnceLock<Option<Modes>>>,
    /// The last tables: those of a study are asked for many times.
    tables: Arc<Mutex<Option<Arc<FlexibleCrank>>>>,
}

impl FlexibleModel {
    pub(super) fn new(spec: FlexibleSpec, assembled: Assembled) -> Self {
        Self { spec, assembled, modes: Arc::default(), on_chain: Arc::default(), tables: Arc::default() }
    }

    /// The same with another specification.
    ///
    /// # Errors
    /// In words, where crank and chain do not fit together.
    #[doc(hidden)]
    pub fn with(&self, change: impl FnOnce(&mut FlexibleSpec), (crank, engine, chain): (&Crank, &Engine, &Chain)) -> Result<Self, String> {
        let mut spec = self.spec.clone();
        change(&mut spec);
        let assembled = assemble(crank, engine, chain, &spec, Carried::All)?;
        Ok(Self::new(spec, assembled))
    }

    /// The crank on its joints, all their stiffness and damping times factors; `None` where the bearings are linear or the torque comes from a table.
    #[doc(hidden)]
    pub fn on_joints<'a>(
        &'a self,
        (crank, engine): (&Crank, &'a Engine),
        excitation: &'a Excitation,
        factors: (f64, f64),
    ) -> Option<OnJoints<'a>> {
        let joints = self.spec.joints?.joints(crank, self.spec.nodes, factors);
        let crank = self.on_stations(crank.crank_radius);
        Some(OnJoints { assembled: &self.assembled, crank, linear: &self.spec.bearing, joints, engine, excitation })
    }

    /// Orders that act on the joints: the last harmonics tell what is left out.
    pub(crate) fn excitation_on_joints(engine: &Engine) -> Excitation {
        Excitation::new(engine, ORDERS_ON_JOINTS).with_radial(engine)
    }

    /// The same with the linear bearings nearest to its joints over cycles without absorber: the means of those at the lowest, a middle and the highest speed.
    ///
    /// # Errors
    /// In words, where no periodic motion is found.
    pub(super) fn with_nearest_bearings(
        &self,
        speeds_rpm: &[f64],
        (crank, engine, chain): (&Crank, &Engine, &Chain),
    ) -> Result<Self, String> {
        let excitation = Self::excitation_on_joints(engine);
        let Some(joints) = self.on_joints((crank, engine), &excitation, (1.0, 1.0)) else { return Ok(self.clone()) };
        let speeds = [speeds_rpm[0], speeds_rpm[speeds_rpm.len() / 2], speeds_rpm[speeds_rpm.len() - 1]];
        let bearings_at =
            |speed: f64| joints.at(speed, &[], None).map(|found| found.joints.equivalent).map_err(|why| format!("{speed} rpm: {why}"));
        let all = speeds.par_iter().map(|speed| bearings_at(*speed)).collect::<Result<Vec<_>, _>>()?;
        let mean = |place: usize, k: usize| all.iter().map(|points| points[place][k]).sum::<f64>() / all.len() as f64;
        let mut place = 0..;
        let mut next = || {
            let place = place.next().unwrap_or(0);
            Bearing { stiffness: mean(place, 0).max(0.0), damping: mean(place, 1).max(0.0) }
        };
        let bearings = self.assembled.bearings.iter().map(|nodes| nodes.iter().map(|_| next()).collect()).collect();
        self.with(|spec| spec.bearing = LinearBearings::Each(bearings), (crank, engine, chain))
    }

    /// Elastic modes of the crank free at both ends, with hub and flywheel or bare, the lowest first; `None` as of [`Self::modes`].
    pub fn free_modes(&self, (crank, engine, chain): (&Crank, &Engine, &Chain), attached: bool) -> Option<Vec<FreeMode>> {
        let carried = if attached { Carried::Ends } else { Carried::Nothing };
        let free = assemble(crank, engine, chain, &self.spec, carried).ok()?;
        let modes = free_modes(&free.shaft, MODES)?;
        Some(modes.into_iter().filter(|m| m.omega > 0.0).collect())
    }

    /// Modes at rest on its bearings; `None` where the mass matrix is not positive definite.
    pub fn modes(&self) -> Option<&[FreeMode]> {
        self.modes.get_or_init(|| free_modes(&self.assembled.shaft, MODES)).as_deref()
    }

    /// The same as motions of stations about the axis.
    fn on_chain(&self, chain: &Chain) -> Option<Modes> {
        let (modes, shaft) = (self.modes()?, &self.assembled.shaft);
        let whole = |shape: &[Six]| DVector::from_fn(6 * shape.len(), |i, _| shape[i / 6][i % 6]);
        let shapes: Vec<DVector<f64>> = modes.iter().map(|m| whole(&m.shape)).collect();
        let all = DMatrix::from_columns(&shapes);
        let modal = |matrix: DMatrix<f64>| all.transpose() * matrix * &all;
        let about_axis = DMatrix::from_fn(chain.len(), modes.len(), |i, j| modes[j].shape[self.assembled.stations[i]][5]);
        let own = Flexible {
            viscous: modal(shaft.damping_matrix()),
            hysteretic: modal(shaft.loss_matrix()),
            torsion: modes.iter().map(|m| m.torsion).collect(),
        };
        Some(Modes::flexible(modes.iter().map(|m| m.omega).collect(), about_axis, own, chain))
    }

    fn on_stations(&self, radius: f64) -> OnStations {
        let assembled = &self.assembled;
        OnStations {
            shaft: assembled.shaft.clone(),
            stations: assembled.stations.clone(),
            lengths: assembled.shafts.clone(),
            rods: assembled.rods.clone(),
            directions: assembled.directions.clone(),
            radius,
        }
    }

    /// Tables for what is asked for: the last ones where they hold that.
    pub(super) fn tables(&self, (crank, engine): (&Crank, &Engine), asked: Asked) -> Arc<FlexibleCrank> {
        let last = || self.tables.lock().unwrap_or_else(PoisonError::into_inner);
        let known = last().as_ref().filter(|tables| tables.hold(&asked)).cloned();
        known.unwrap_or_else(|| {
            // solved in parallel: nothing is locked meanwhile
            let solved = Arc::new(FlexibleCrank::new(self.on_stations(crank.crank_radius), engine, asked));
            *last() = Some(solved.clone());
            solved
        })
    }

    /// Modes at rest as motions of the stations of a chain about the axis; `None` as of [`Self::modes`].
    pub(super) fn modes_of_stations(&self, chain: &Chain) -> Option<Modes> {
        self.on_chain.get_or_init(|| self.on_chain(chain)).clone()
    }
}
