//! What simplifications of the model cost in accuracy: the series for the slider-crank, the order limit, the sampling of the pressure, and a grid of
//! speeds without refinement.

use crate::absorber::Mounted;
use crate::analysis::RunError;
use crate::drivetrain::{Chain, Station, System};
use crate::engine::HarmonicTable;
use crate::engine::pressure::{Measured, SAMPLE_DEG};
use crate::engine::{Engine, Excitation, Kinematics, Layout, Order, Pressure, Source};
use crate::input::Study;
use crate::numerics::C64;
use crate::objective::{Measure, Over, PeakFinder};
use crate::response::{Direct, Grid, Method, Quantity, ResponseError, Work};
use crate::units::RAD_PER_S_PER_RPM;

/// A simplification.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Simplification {
    /// The two-term series of the slider-crank instead of its exact motion, against the ratio of crank radius to rod length.
    TruncatedSeries,
    /// Orders up to a limit, against `MANY_ORDERS`.
    OrderLimit,
    /// Pressure known every so many degrees, linear in between, against `SAMPLE_DEG`.
    PressureSampling,
    /// The largest value on a 10 rpm grid instead of the refined peak of one mode, against its damping ratio.
    CoarseGrid,
}

impl Simplification {
    /// In words, for labels.
    pub fn label(self) -> &'static str {
        match self {
            Self::TruncatedSeries => "truncated slider-crank series, rod ratio",
            Self::OrderLimit => "orders up to",
            Self::PressureSampling => "pressure every, deg",
            Self::CoarseGrid => "10 rpm grid not refined, damping ratio",
        }
    }
}

/// Errors of the peak twist along one simplification.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelError {
    /// What is simplified.
    pub what: Simplification,
    /// Its size and the largest relative error of the peak twist over the probe designs.
    pub points: Vec<(f64, f64)>,
}

const ROD_RATIOS: [f64; 7] = [0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5];
const ORDER_LIMITS: [f64; 5] = [4.0, 6.0, 9.0, 12.0, 24.0];
/// What order limits are compared with.
pub(crate) const MANY_ORDERS: f64 = 48.0;
const SAMPLING_DEG: [f64; 6] = [5.0, 2.0, 1.0, 0.5, 0.2, 0.1];
const DAMPING: [f64; 7] = [0.001, 0.002, 0.003, 0.005, 0.01, 0.02, 0.03];

/// Measures a study on its designs with one absorber.
///
/// # Errors
/// [`RunError`] where a design has no finite peak.
pub fn measure(study: &Study, designs: &[Vec<Mounted>]) -> Result<Vec<ModelError>, RunError> {
    let failed = |error| RunError { what: "a probe design with a simplified model".into(), error };
    let mut list = Vec::new();
    if let Source::Cylinder { geometry, pressure } = &study.engine.source {
        let probe = Probe { study, designs };
        let mut points = Vec::new();
        for ratio in ROD_RATIOS {
            let with = |kinematics| {
                let mut g = geometry.clone();
                (g.slider_crank.rod_length, g.slider_crank.kinematics) = (g.slider_crank.crank_radius / ratio, kinematics);
                Engine { source: Source::Cylinder { geometry: g, pressure: pressure.clone() }, ..study.engine.clone() }
            };
            let peaks = |kinematics| probe.peaks(&with(kinematics), study.order_limit);
            points.push((ratio, worst(&peaks(Kinematics::Truncated).map_err(failed)?, &peaks(Kinematics::Exact).map_err(failed)?)));
        }
        list.push(ModelError { what: Simplification::TruncatedSeries, points });

        let many = probe.peaks(&study.engine, MANY_ORDERS).map_err(failed)?;
        let error = |limit: f64| probe.peaks(&study.engine, limit).map(|p| (limit, worst(&p, &many)));
        let points = ORDER_LIMITS.into_iter().map(error).collect::<Result<_, _>>().map_err(failed)?;
        list.push(ModelError { what: Simplification::OrderLimit, points });

        let finest = probe.peaks(&sampled(&study.engine, SAMPLE_DEG), study.order_limit).map_err(failed)?;
        let error = |deg: f64| probe.peaks(&sampled(&study.engine, deg), study.order_limit).map(|p| (deg, worst(&p, &finest)));
        let points = SAMPLING_DEG.into_iter().filter(|d| *d > SAMPLE_DEG).map(error).collect::<Result<_, _>>().map_err(failed)?;
        list.push(ModelError { what: Simplification::PressureSampling, points });
    }
    Ok(list)
}

fn worst(found: &[f64], exact: &[f64]) -> f64 {
    found.iter().zip(exact).map(|(f, e)| (f / e - 1.0).abs()).fold(0.0, f64::max)
}

struct Probe<'a> {
    study: &'a Study,
    designs: &'a [Vec<Mounted>],
}

impl Probe<'_> {
    /// Refined peak twists of the designs with this engine.
    fn peaks(&self, engine: &Engine, order_limit: f64) -> Result<Vec<f64>, ResponseError> {
        let system = System::with_modes(self.study.chain.clone(), self.study.modes.clone(), Excitation::new(engine, order_limit));
        let grid = Grid::new(&self.study.speeds_rpm, &system.excitation.tabulated_rpm);
        let method = Method::Direct(Direct::new(&system, &grid));
        let finder = PeakFinder::new(&system, &grid, &method, true);
        let measure = Measure::new(vec![self.study.twist], Over::Synthesis);
        let peak = |d: &Vec<Mounted>| Ok(finder.peak(d, &measure, &mut Work::default())?.map_or(0.0, |p| p.value));
        self.designs.iter().map(peak).collect()
    }
}

/// The engine with its pressure known every `step_deg` only, as if measured.
fn sampled(engine: &Engine, step_deg: f64) -> Engine {
    let Source::Cylinder { geometry, pressure } = &engine.source else { return engine.clone() };
    let every = (step_deg / SAMPLE_DEG).round() as usize;
    let trace = |i: usize| pressure.trace(i, geometry, engine.strokes, engine.layout.firing_deg.len());
    let traces: Vec<Vec<f64>> = (0..pressure.speeds_rpm().len()).map(|i| trace(i).into_iter().step_by(every).collect()).collect();
    let measured = Measured {
        speeds_rpm: pressure.speeds_rpm().to_vec(),
        crank_deg: (0..traces[0].len()).map(|j| (j * every) as f64 * SAMPLE_DEG).collect(),
        pressure: traces,
        part_load: Vec::new(),
    };
    Engine { source: Source::Cylinder { geometry: geometry.clone(), pressure: Pressure::Measured(measured) }, ..engine.clone() }
}

/// What a 10 rpm grid misses of one mode at 2005 rpm, in the middle between two speeds, where most is missed. The mode is damped: it has a peak.
pub(crate) fn coarse_grid() -> ModelError {
    let omega = 2005.0 * RAD_PER_S_PER_RPM;
    let error = |damping: f64| {
        let station = Station {
            name: "one".into(),
            inertia: 1.0,
            stiffness_to_ground: omega * omega,
            damping_to_ground: 2.0 * damping * omega,
            throws: vec![0],
            ..Station::default()
        };
        let table = HarmonicTable { harmonics: vec![(Order::from_twice(2), C64::from(1.0))], ..HarmonicTable::default() };
        let layout = Layout { rods_per_throw: 1, firing_deg: vec![0.0], bank_angle_deg: None, split_pin_deg: 0.0 };
        let engine = Engine { name: String::new(), strokes: 2, layout, source: Source::Harmonics(table) };
        let system = System::new(Chain { stations: vec![station] }, Excitation::new(&engine, 1.0));
        let grid = Grid::new(&(0..=100).map(|i| 1500.0 + 10.0 * f64::from(i)).collect::<Vec<_>>(), &[]);
        let method = Method::Direct(Direct::new(&system, &grid));
        let measure = Measure::new(vec![Quantity::Twist { from: 0, to: None }], Over::Synthesis);
        let peak = |refine: bool| {
            let found = PeakFinder::new(&system, &grid, &method, refine).peak(&[], &measure, &mut Work::default());
            found.ok().flatten().map_or(f64::NAN, |p| p.value)
        };
        (damping, 1.0 - peak(false) / peak(true))
    };
    ModelError { what: Simplification::CoarseGrid, points: DAMPING.into_iter().map(error).collect() }
}
