//! Loads of the webs of a flexible crank over the speeds of a study, and margins by them in the place of those of a continuous beam.

use super::margins::{MarginSweep, sweep_by};
use super::timing::Clock;
use super::{DesignResult, Progress, RunError};
use crate::crankshaft::flexible::{QuasiStatic, WebLoad, WebLoads, in_plane};
use crate::crankshaft::{Margin, section};
use crate::input::Study;
use crate::numerics::C64;
use crate::objective::PeakFinder;
use crate::response::{Direct, Grid, ResponseError, Work};
use nalgebra::DMatrix;
use rayon::prelude::*;
use std::sync::OnceLock;

/// The webs of a design.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct WebsOfDesign {
    /// Its name.
    pub design: String,
    /// Front and rear of every throw.
    pub webs: Vec<Web>,
    /// By every criterion that bends the whole crank.
    pub margins: Vec<WebMargin>,
}

/// Where the moment in the plane of the throw swings most in the middle of a web.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Web {
    /// From 0.
    pub throw: usize,
    /// Whether it is the one behind the crankpin.
    pub rear: bool,
    /// rpm.
    pub speed_rpm: f64,
    /// Half of the peak-to-peak moment over the cycle, N m.
    pub moment: f64,
    /// The same at that speed without vibration, N m.
    pub still: f64,
    /// What vibration adds at most, over all speeds, to the amplitude of nominal bending stress in the web, Pa: the part of the additional stress of \[IACS UR M53\] that is neither misalignment nor axial.
    pub added: f64,
}

/// The smallest margin of a design by a criterion.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct WebMargin {
    /// Index of the criterion.
    pub criterion: usize,
    /// By the loads of the flexible crank, at the speeds of the study.
    pub margin: f64,
    /// Name of its fillet.
    pub fillet: String,
    /// rpm.
    pub speed_rpm: f64,
    /// By those of the continuous beam, at the same speeds.
    pub beam: f64,
}

impl WebsOfDesign {
    /// The largest of the stresses that vibration adds, Pa.
    #[doc(hidden)]
    pub fn added(&self) -> f64 {
        self.webs.iter().map(|w| w.added).fold(0.0, f64::max)
    }
}

/// Half peak-to-peak of the moment of every web.
fn half_ranges(all: &DMatrix<f64>) -> Vec<f64> {
    let of = |web: usize| {
        let own = all.column(4 * web + WebLoad::Moment as usize);
        0.5 * (own.max() - own.min())
    };
    (0..all.ncols() / 4).map(of).collect()
}

/// Amplitudes of all loads by order at a speed, the absorbers of a design in place.
fn orders(loads: &WebLoads, direct: &Direct, d: &DesignResult, speed_rpm: f64) -> Result<Vec<Vec<C64>>, ResponseError> {
    let of = |n: usize| direct.absorber_torques(&d.absorbers, (n, speed_rpm), &mut Work::default());
    let torques = (0..direct.system.orders()).map(of).collect::<Result<Vec<_>, _>>()?;
    loads.orders(speed_rpm, &torques).map_err(|_| ResponseError::unbounded(direct.system.excitation.orders[0], speed_rpm))
}

/// The design without absorber, the best given one and the best optimum; nothing on a torsional chain, without `[fatigue]`.
///
/// # Errors
/// [`RunError`] where nothing damps a resonance met exactly.
pub(super) fn web_stress(
    (study, finder): (&Study, &PeakFinder),
    sweeps: &[MarginSweep],
    designs: &[&DesignResult],
    (progress, clock): (&dyn Progress, &mut Clock),
) -> Result<Vec<WebsOfDesign>, RunError> {
    let Some((flexible, crank)) = study.on_flexible().zip(finder.system.flexible.as_ref()) else { return Ok(Vec::new()) };
    let (Some(fatigue), Some(dimensions)) = (&study.fatigue, &study.crank) else { return Ok(Vec::new()) };
    let excitation = &finder.system.excitation;
    let Some(loads) = WebLoads::new(&flexible.assembled, study.engine_of_crank(), (crank, excitation)) else { return Ok(Vec::new()) };
    let grid = Grid::new(&study.speeds_rpm, &[]);
    progress.stage("webs of the flexible crank", designs.len());
    let whole = |speed: &f64| {
        loads
            .quasi_static(*speed)
            .map_err(|_| RunError { what: "webs of the crank".into(), error: ResponseError::unbounded(excitation.orders[0], *speed) })
    };
    let quasi = grid.speed_rpm.par_iter().map(whole).collect::<Result<Vec<QuasiStatic>, _>>()?;
    let direct = Direct::new(finder.system, &grid);
    let bending = section::web_bending(dimensions.web_breadth, dimensions.bearing_web());
    let of = |d: &&DesignResult| -> Result<WebsOfDesign, RunError> {
        let failed = |error| RunError { what: format!("design `{}`", d.name), error };
        let orders = grid.speed_rpm.par_iter().map(|s| orders(&loads, &direct, d, *s)).collect::<Result<Vec<_>, _>>().map_err(failed)?;
        let swings: Vec<OnceLock<[Vec<f64>; 2]>> = vec![OnceLock::new(); grid.len()];
        let webs = |i: usize| {
            let still = loads.still(&quasi[i]);
            let all = loads.vibrating(&quasi[i], &still, &orders[i]);
            // a speed is asked for once
            _ = swings[i].set([half_ranges(&all), half_ranges(&still)]);
            (0..2 * dimensions.throws()).map(|web| in_plane(&all, web)).collect()
        };
        let parts = (study.engine_of_crank(), &study.chain, dimensions);
        let model = Margin::with_webs(parts, fatigue, &grid.speed_rpm, &excitation.harmonics, Some(&webs));
        let Some(model) = model else { return Ok(WebsOfDesign { design: d.name.clone(), webs: Vec::new(), margins: Vec::new() }) };
        let sweep = sweep_by(&model, finder, &grid, (&d.name, &d.absorbers), &|| {}).map_err(failed)?;
        let swings: Vec<[Vec<f64>; 2]> = swings.into_iter().filter_map(OnceLock::into_inner).collect();
        progress.step();
        Ok(WebsOfDesign {
            design: d.name.clone(),
            webs: (0..2 * dimensions.throws()).map(|w| web(w, &swings, (&grid.speed_rpm, bending))).collect(),
            margins: margins(&sweep, &model, &grid.speed_rpm, sweeps),
        })
    };
    let all = designs.par_iter().map(of).collect();
    clock.lap("webs of the crank", Work::default());
    all
}

/// A web over the speeds; `swings`: half ranges of all webs with vibration and without at each speed.
fn web(web: usize, swings: &[[Vec<f64>; 2]], (speeds, per_moment): (&[f64], f64)) -> Web {
    let most = (0..swings.len()).fold(0, |m, i| if swings[i][0][web] > swings[m][0][web] { i } else { m });
    let added = swings.iter().map(|[all, still]| per_moment * (all[web] - still[web])).fold(0.0, f64::max);
    let [moment, still] = [0, 1].map(|k| swings[most][k][web]);
    Web { throw: web / 2, rear: web % 2 == 1, speed_rpm: speeds[most], moment, still, added }
}

/// The smallest margins by the criteria that bend the whole crank, beside those of the beam.
fn margins(sweep: &MarginSweep, model: &Margin, speeds: &[f64], beams: &[MarginSweep]) -> Vec<WebMargin> {
    let beam = beams.iter().find(|b| b.design == sweep.design);
    let of = |criterion: usize| {
        let fillets = sweep.fillets.iter().filter(|f| f.criterion == criterion);
        let all = fillets.flat_map(|f| f.used.iter().enumerate().map(move |(i, used)| (used.value, f.name.as_str(), i)));
        let (value, fillet, i) = all.reduce(|m, u| if u.0 > m.0 { u } else { m })?;
        let beam = beam?.smallest(criterion).into_iter().fold(f64::INFINITY, f64::min);
        Some(WebMargin { criterion, margin: 1.0 / value, fillet: fillet.to_owned(), speed_rpm: speeds[i], beam })
    };
    (0..model.criteria.len()).filter(|c| model.criteria[*c].bends_the_whole_crank()).filter_map(of).collect()
}
