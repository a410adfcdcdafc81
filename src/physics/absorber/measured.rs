//! Ring on what was measured: stiffness and loss stiffness over frequency, and temperature where the table has it.
//!
//! S' and S'' are straight between the points in logarithms of value and frequency, and in temperature. Outside the table nothing is known: studies that reach beyond it are refused when they are read;
//! searches for natural motions, which may, take the nearest end.

use super::dynamic_stiffness::Operating;
use super::law::{Declaration, Law};
use super::material_state::State;
use super::parameter::{Follows, Parameter, RING_INERTIA, Range};
use crate::numerics::C64;
use crate::numerics::elementary::Elementary;
use std::sync::Arc;

/// A table of measurements on a grid.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredTable {
    /// Ascending, Hz; at least two.
    pub frequencies_hz: Vec<f64>,
    /// Ascending, °C; a single one where the table has none.
    pub temperatures_c: Vec<f64>,
    /// S' and S'' by temperature, then frequency, N m/rad, above zero.
    pub stiffness: Vec<Vec<(f64, f64)>>,
}

/// Index of the interval of an ascending list that holds a value, and where in it; an end where it lies outside.
fn place(list: &[f64], x: f64) -> (usize, f64) {
    if list.len() < 2 {
        return (0, 0.0);
    }
    let i = list.partition_point(|l| *l <= x).clamp(1, list.len() - 1) - 1;
    (i, ((x - list[i]) / (list[i + 1] - list[i])).clamp(0.0, 1.0))
}

impl MeasuredTable {
    /// S at a frequency, Hz, and a temperature, °C.
    pub fn at(&self, hz: f64, celsius: f64) -> C64 {
        let (t, share) = place(&self.temperatures_c, celsius);
        let i = self.frequencies_hz.partition_point(|f| *f <= hz).clamp(1, self.frequencies_hz.len() - 1) - 1;
        let ends = [self.frequencies_hz[i], self.frequencies_hz[i + 1]];
        let along = ((hz.max(f64::MIN_POSITIVE) / ends[0]).logarithm() / (ends[1] / ends[0]).logarithm()).clamp(0.0, 1.0);
        let row = |t: usize| {
            let (a, b) = (self.stiffness[t][i], self.stiffness[t][i + 1]);
            let between = |a: f64, b: f64| a.logarithm() + along * (b / a).logarithm();
            (between(a.0, b.0), between(a.1, b.1))
        };
        let low = row(t);
        let high = if share > 0.0 { row(t + 1) } else { low };
        C64::new((low.0 + share * (high.0 - low.0)).exponential(), (low.1 + share * (high.1 - low.1)).exponential())
    }
}

/// Ring on measured stiffness.
#[derive(Debug, Clone)]
pub struct Measured {
    /// kg m².
    pub ring_inertia: f64,
    /// On the measured values, above zero: one as they were measured.
    pub scale: f64,
    /// °C.
    pub celsius: f64,
    /// The measurements.
    pub table: Arc<MeasuredTable>,
    /// Temperatures of the states, °C.
    pub cold: Option<f64>,
    /// °C.
    pub hot: Option<f64>,
}

const SCALE: Parameter = Parameter {
    key: "stiffness_scale",
    label: "scale",
    about: "Factor on the measured stiffness.",
    range: Range::Positive,
    extensive: true,
    dissipative: false,
    material: true,
    follows: Follows::Nothing,
    bounds: |_| (1.0, 1.0),
    typical: |_| 1.0,
};

/// Ring on measured stiffness. A study gives it by a file; without one it is a spring of 1 N m/rad, which no study can ask for.
pub(crate) static MEASURED: Declaration = Declaration {
    name: "measured",
    about: "A ring on measured stiffness.",
    parameters: &[RING_INERTIA, SCALE],
    build: |v| {
        let stiffness = vec![vec![(1.0, f64::MIN_POSITIVE); 2]];
        let table = MeasuredTable { frequencies_hz: vec![1.0, 2.0], temperatures_c: vec![0.0], stiffness };
        Arc::new(Measured { ring_inertia: v[0], scale: v[1], celsius: 0.0, table: Arc::new(table), cold: None, hot: None })
    },
    closed_forms: &[],
};

impl Law for Measured {
    fn declaration(&self) -> &'static Declaration {
        &MEASURED
    }
    fn values(&self) -> Vec<f64> {
        vec![self.ring_inertia, self.scale]
    }
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn dynamic_stiffness(&self, at: Operating) -> C64 {
        self.scale * self.table.at(at.omega * crate::units::HZ_PER_RAD_PER_S, self.celsius)
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        vec![C64::default(), self.dynamic_stiffness(at) / self.scale]
    }
    fn rebuilt(&self, values: &[f64]) -> Arc<dyn Law> {
        Arc::new(Self { ring_inertia: values[0], scale: values[1], ..self.clone() })
    }
    fn in_state(&self, state: State) -> Option<Arc<dyn Law>> {
        let celsius = match state {
            State::Cold => self.cold?,
            State::Hot => self.hot?,
            State::Aged => return None,
        };
        (self.table.temperatures_c.len() > 1).then(|| Arc::new(Self { celsius, ..self.clone() }) as Arc<dyn Law>)
    }
}
