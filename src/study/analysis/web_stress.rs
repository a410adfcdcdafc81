//! Loads of the webs of a flexible crank over the speeds of a study, and margins by them in the place of those of a continuous beam.

use super::margins::{MarginSweep, sweep_by};
use super::timing::Clock;
use super::{DesignResult, Progress, RunError};
use crate::absorber::Mounted;
use crate::crankshaft::flexible::{QuasiStatic, WebLoad, WebLoads, in_plane};
use crate::crankshaft::{Margin, section};
use crate::drivetrain::System;
use crate::input::{CrankModel, Study};
use crate::numerics::C64;
use crate::objective::PeakFinder;
use crate::response::{Direct, Grid, Quantity, Response, ResponseError, Work};
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
    /// At each speed of the study; none where it names no multiaxial criterion.
    pub von_mises: Vec<VonMisesAt>,
}

/// The largest equivalent stress of von Mises over the cycle and all fillets at a speed.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct VonMisesAt {
    /// rpm.
    pub speed_rpm: f64,
    /// Pa.
    pub stress: f64,
    /// Its location.
    pub fillet: String,
    /// Crank angle from the firing of the first cylinder, degrees.
    pub crank_deg: f64,
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
    let half_range = |web: usize| {
        let own = all.column(4 * web + WebLoad::Moment as usize);
        0.5 * (own.max() - own.min())
    };
    (0..all.ncols() / 4).map(half_range).collect()
}

/// Told of all loads at the speed of an index, with vibration and without.
type Told<'t> = &'t (dyn Fn(usize, &DMatrix<f64>, &DMatrix<f64>) + Sync);

/// Webs of the flexible crank of a study, cut over some speeds.
struct Cut<'a> {
    study: &'a Study,
    system: &'a System,
    speeds: &'a [f64],
    loads: WebLoads<'a>,
    quasi: Vec<QuasiStatic>,
    direct: Direct<'a>,
}

impl<'a> Cut<'a> {
    /// Nothing on a torsional chain, without `[fatigue]`, or where the torque comes from a table.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing holds the crank.
    fn new(study: &'a Study, system: &'a System, grid: &'a Grid) -> Result<Option<Self>, ResponseError> {
        let flexible = study.on_flexible().filter(|_| study.fatigue.is_some());
        let Some((flexible, crank)) = flexible.zip(system.flexible.as_ref()) else { return Ok(None) };
        let loads = WebLoads::new(&flexible.assembled, study.engine_of_crank(), (crank, &system.excitation));
        let Some(loads) = loads else { return Ok(None) };
        let held = |speed: &f64| loads.quasi_static(*speed).map_err(|_| ResponseError::unbounded(system.excitation.orders[0], *speed));
        let quasi = grid.speed_rpm.par_iter().map(held).collect::<Result<Vec<QuasiStatic>, _>>()?;
        Ok(Some(Self { study, system, speeds: &grid.speed_rpm, loads, quasi, direct: Direct::new(system, grid) }))
    }

    /// Amplitudes of all loads by order at a speed, the absorbers of a design in place.
    fn orders(&self, design: &[Mounted], speed_rpm: f64) -> Result<Vec<Vec<C64>>, ResponseError> {
        let torques_of_order = |n: usize| self.direct.absorber_torques(design, (n, speed_rpm), &mut Work::default());
        let torques = (0..self.system.orders()).map(torques_of_order).collect::<Result<Vec<_>, _>>()?;
        self.loads.orders(speed_rpm, &torques).map_err(|_| ResponseError::unbounded(self.system.excitation.orders[0], speed_rpm))
    }

    /// The margin of a crank that is bent so by a design.
    fn margin(&self, design: &[Mounted], tell: Told) -> Result<Option<Margin>, ResponseError> {
        let (Some(fatigue), Some(crank)) = (&self.study.fatigue, &self.study.crank) else { return Ok(None) };
        let orders = self.speeds.par_iter().map(|s| self.orders(design, *s)).collect::<Result<Vec<_>, _>>()?;
        let webs = |i: usize| {
            let still = self.loads.still(&self.quasi[i]);
            let all = self.loads.vibrating(&self.quasi[i], &still, &orders[i]);
            tell(i, &all, &still);
            (0..2 * crank.throws()).map(|web| in_plane(&all, web)).collect()
        };
        let parts = (self.study.engine_of_crank(), &self.study.chain, crank);
        Ok(Margin::with_webs(parts, fatigue, self.speeds, &self.system.excitation.harmonics, Some(&webs)))
    }

    /// The largest equivalent stress at each speed, under a margin of the same design; none where its study names no multiaxial criterion.
    fn von_mises(&self, margin: &Margin, design: &[Mounted]) -> Result<Vec<VonMisesAt>, ResponseError> {
        let shafts = self.system.chain.len() - 1;
        let quantities: Vec<Quantity> = (0..shafts).map(Quantity::ShaftTorque).collect();
        let sweeps = self.direct.sweep_each(design, &quantities, &mut Work::default())?;
        let (orders, cycle) = (self.system.orders(), self.study.engine.cycle_deg());
        let von_mises_at = |(i, speed_rpm): (usize, &f64)| -> Option<VonMisesAt> {
            let torques: Vec<&[C64]> = sweeps.iter().map(|sweep| &sweep[i * orders..(i + 1) * orders]).collect();
            let most = margin.largest_von_mises(*speed_rpm, &torques)?;
            let fillet = margin.locations[most.location].name.clone();
            let crank_deg = cycle * most.sample.0 as f64 / most.sample.1 as f64;
            Some(VonMisesAt { speed_rpm: *speed_rpm, stress: most.stress, fillet, crank_deg })
        };
        Ok(self.speeds.par_iter().enumerate().filter_map(von_mises_at).collect())
    }
}

/// The largest equivalent stress of a design at some speeds (ascending) on the flexible crank of a study, its main bearings and their damping so many times as large. Nothing where it has none, or names no multiaxial criterion.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance met exactly.
#[doc(hidden)]
pub fn von_mises_on_bearings(
    study: &Study,
    design: &[Mounted],
    (speeds_rpm, stiffness, damping): (&[f64], f64, f64),
) -> Result<Vec<VonMisesAt>, ResponseError> {
    let (Some(flexible), Some(crank)) = (&study.flexible, &study.crank) else { return Ok(Vec::new()) };
    let changed = flexible.with(|spec| spec.bearing = spec.bearing.times(stiffness, damping), (crank, &study.engine, &study.chain));
    let Ok(changed) = changed else { return Ok(Vec::new()) };
    let study = Study {
        flexible: Some(changed),
        crank_model: CrankModel::Flexible,
        speeds_rpm: speeds_rpm.to_vec(),
        conditions: Vec::new(),
        ..study.clone()
    };
    let system = study.system(study.excitation());
    let grid = Grid::new(&study.speeds_rpm, &[]);
    let Some(cut) = Cut::new(&study, &system, &grid)? else { return Ok(Vec::new()) };
    let margin = cut.margin(design, &|_, _, _| {})?;
    margin.map_or_else(|| Ok(Vec::new()), |margin| cut.von_mises(&margin, design))
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
    let Some(dimensions) = study.crank.as_ref().filter(|_| study.on_flexible().is_some() && study.fatigue.is_some()) else {
        return Ok(Vec::new());
    };
    let grid = Grid::new(&study.speeds_rpm, &[]);
    progress.stage("webs of the flexible crank", designs.len());
    let cut = Cut::new(study, finder.system, &grid).map_err(|error| RunError { what: "webs of the crank".into(), error })?;
    let Some(cut) = cut else { return Ok(Vec::new()) };
    let bending = section::web_bending(dimensions.web_breadth, dimensions.bearing_web());
    let webs_of = |d: &&DesignResult| -> Result<WebsOfDesign, ResponseError> {
        let swings: Vec<OnceLock<[Vec<f64>; 2]>> = vec![OnceLock::new(); grid.len()];
        // a speed is asked for once
        let tell = |i: usize, all: &DMatrix<f64>, still: &DMatrix<f64>| _ = swings[i].set([half_ranges(all), half_ranges(still)]);
        let model = cut.margin(&d.absorbers, &tell)?;
        let mut found = WebsOfDesign { design: d.name.clone(), webs: Vec::new(), margins: Vec::new(), von_mises: Vec::new() };
        let Some(model) = model else { return Ok(found) };
        let sweep = sweep_by(&model, finder, &grid, (&d.name, &d.absorbers), &|| {})?;
        found.von_mises = cut.von_mises(&model, &d.absorbers)?;
        let swings: Vec<[Vec<f64>; 2]> = swings.into_iter().filter_map(OnceLock::into_inner).collect();
        found.webs = (0..2 * dimensions.throws()).map(|w| web(w, &swings, (&grid.speed_rpm, bending))).collect();
        found.margins = margins(&sweep, &model, &grid.speed_rpm, sweeps);
        progress.step();
        Ok(found)
    };
    let named = |d: &&DesignResult| webs_of(d).map_err(|error| RunError { what: format!("design `{}`", d.name), error });
    let all = designs.par_iter().map(named).collect();
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
    let smallest_margin = |criterion: usize| {
        let fillets = sweep.fillets.iter().filter(|f| f.criterion == criterion);
        let all = fillets.flat_map(|f| f.used.iter().enumerate().map(move |(i, used)| (used.value, f.name.as_str(), i)));
        let (value, fillet, i) = all.reduce(|m, u| if u.0 > m.0 { u } else { m })?;
        let beam = beam?.smallest(criterion).into_iter().fold(f64::INFINITY, f64::min);
        Some(WebMargin { criterion, margin: 1.0 / value, fillet: fillet.to_owned(), speed_rpm: speeds[i], beam })
    };
    (0..model.criteria.len()).filter(|c| model.criteria[*c].bends_the_whole_crank()).filter_map(smallest_margin).collect()
}
