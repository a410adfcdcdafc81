//! The model as a calibration sees it: amplitudes of the fitted rows from values of the inputs.

use crate::analysis::RunError;
use crate::analysis::amplitude::near;
use crate::drivetrain::System;
use crate::engine::{Excitation, Pressure, Source};
use crate::input::{CalibrateSpec, FreeInput, Input, Study};
use crate::response::{Direct, Grid, ResponseError, Work};
use std::sync::Arc;

/// Amplitudes of the fitted rows for inputs of given values, rad. Torques are kept while only the chain changes.
pub(crate) struct Model<'a> {
    study: &'a Study,
    spec: &'a CalibrateSpec,
    grid: Grid,
    torques: Vec<(Vec<f64>, Arc<Excitation>)>,
    level: Option<&'a Level>,
}

/// Torques at two levels of the pressure of an Otto cycle: without friction torque is linear in it.
pub(super) struct Level {
    scales: [f64; 2],
    torques: [Excitation; 2],
}

impl Level {
    /// Where the level alone is fitted of what changes the torque.
    pub fn of(study: &Study, spec: &CalibrateSpec) -> Option<Self> {
        let Source::Cylinder { geometry, pressure: Pressure::Otto(_) } = &study.engine.source else { return None };
        let mut inputs = spec.inputs.iter().filter(|f| f.input.changes_torque());
        let (Some(FreeInput { input: Input::PressureScale, lower, upper, .. }), None) = (inputs.next(), inputs.next()) else { return None };
        let torque = |scale: f64| Excitation::new(&study.with_inputs(&[(Input::PressureScale, scale)]).engine, study.order_limit);
        let is_linear = geometry.liner_friction == 0.0 && lower < upper;
        is_linear.then(|| Self { scales: [*lower, *upper], torques: [torque(*lower), torque(*upper)] })
    }

    fn at(&self, scale: f64) -> Excitation {
        let ([lower, upper], [low, high]) = (self.scales, &self.torques);
        low.towards(high, (scale - lower) / (upper - lower))
    }
}

/// Torques kept: those of a point and of its neighbours in the first inputs.
const KEPT: usize = 4;

impl<'a> Model<'a> {
    /// Of a study; `level` where its torque is linear.
    pub fn new(study: &'a Study, spec: &'a CalibrateSpec, level: Option<&'a Level>) -> Self {
        Self { study, spec, grid: Grid::new(&study.speeds_rpm, &[]), torques: Vec::new(), level }
    }

    /// With the engine file as it is.
    pub(crate) fn as_in_the_file(&self) -> Result<Vec<f64>, RunError> {
        self.of(self.study, Excitation::new(&self.study.engine, self.study.order_limit))
    }

    /// Of inputs with these values, in their order.
    pub fn amplitudes(&mut self, values: &[f64]) -> Result<Vec<f64>, RunError> {
        let inputs: Vec<(Input, f64)> = self.spec.inputs.iter().map(|f| f.input).zip(values.iter().copied()).collect();
        let study = self.study.with_inputs(&inputs);
        let key: Vec<f64> = inputs.iter().filter(|i| i.0.changes_torque()).map(|i| i.1).collect();
        let torque = match self.torques.iter().find(|t| t.0 == key) {
            Some((_, torque)) => torque.clone(),
            None => {
                let torque = match (self.level, key.as_slice()) {
                    (Some(level), [scale]) => level.at(*scale),
                    _ => Excitation::new(&study.engine, study.order_limit),
                };
                let torque = Arc::new(torque);
                self.torques.truncate(KEPT - 1);
                self.torques.insert(0, (key, torque.clone()));
                torque
            }
        };
        self.of(&study, (*torque).clone())
    }

    fn of(&self, study: &Study, torque: Excitation) -> Result<Vec<f64>, RunError> {
        let system = System::with_modes(study.chain.clone(), study.modes.clone(), torque);
        let direct = Direct::new(&system, &self.grid);
        let Some(published) = &study.published else { return Ok(Vec::new()) };
        let amplitude = |row: &usize| {
            let row = &published.amplitudes[*row];
            let design = &study.designs[row.design];
            let found = near(study, &direct, &design.absorbers, row.order, row.speed_rpm, &mut Work::default());
            let failed = |error: ResponseError| RunError { what: format!("calibration, design `{}`", design.name), error };
            Ok(found.map_err(failed)?.map_or(0.0, |n| n.amplitude))
        };
        self.spec.rows.iter().map(amplitude).collect()
    }
}
