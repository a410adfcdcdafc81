//! What each response method costs and how wrong it is: seconds per design against the error of its peak twist.

use super::methods::Candidate;
use crate::absorber::closed_forms::EngineMode;
use crate::absorber::mounted::station_of;
use crate::absorber::{Absorber, Mounted};
use crate::analysis::method_selection::{Considered, STRIDES, Strategy};
use crate::analysis::timing::{Repeats, median_seconds};
use crate::analysis::{Progress, RunError, families, model_check};
use crate::drivetrain::System;
use crate::engine::Excitation;
use crate::input::Study;
use crate::numerics::maximise::maximise;
use crate::numerics::synthesis::Synthesiser;
use crate::objective::surrogate::{Scratch, Surrogate};
use crate::objective::{Measure, Over, PeakFinder};
use crate::optimise::{Slot, Space};
use crate::response::{Direct, Grid, Method, Quantity, Receptance, Response, ResponseError, Work};

/// How the peak over speed is looked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Search {
    /// The largest value on a grid of this many speeds.
    Grid(usize),
    /// The same, then refined by the method itself between speeds.
    Refined(usize),
}

impl Search {
    /// In words.
    pub fn label(self) -> String {
        match self {
            Self::Grid(n) => format!("{n} speeds"),
            Self::Refined(n) => format!("{n} speeds refined"),
        }
    }
}

/// One method with one setting on one study.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// The method.
    pub candidate: Candidate,
    /// Its setting.
    pub search: Search,
    /// Seconds for the peak twist of one design on one thread, the median of repetitions.
    pub seconds: f64,
    /// Largest error of the peak over the probe designs, relative; the refusal where there is one.
    pub error: Result<f64, ResponseError>,
}

/// Methods on one study.
#[derive(Debug, Clone, PartialEq)]
pub struct SpeedAccuracy {
    /// Methods and settings.
    pub points: Vec<Point>,
    /// Strategies of a search: tables at several strides, and exactly.
    pub ways: Vec<Considered>,
    /// The probe designs and their names.
    pub probes: Vec<(String, Vec<Mounted>)>,
}

/// Numbers of speeds tried.
const SPEEDS: [usize; 6] = [14, 27, 53, 105, 261, 521];
/// Of one measurement.
pub(super) const REPEATS: Repeats = Repeats { least: 3, most: 25, seconds: 0.02 };
/// Local maxima that are refined.
const REFINED: usize = 3;
/// Surrogate peaks timed together.
const REPEATED: usize = 20;

/// Probe designs: those of the study with one absorber, and the closed-form optima for the ring of the optimum.
fn probes(study: &Study, excitation: &Excitation) -> Vec<(String, Vec<Mounted>)> {
    let given = study.designs.iter().filter(|d| d.absorbers.len() == 1).map(|d| (d.name.clone(), d.absorbers.clone()));
    let mut list: Vec<_> = given.collect();
    if let Some(spec) = &study.optimise {
        let modes = families::engine_modes(study, spec, model_check::highest_frequency_hz(study, &excitation.orders));
        for types in families::types(spec) {
            let rings = vec![None; types.len()];
            let space = families::family(spec, &families::Choice { types, rings }, &modes);
            if let Some(design) = closed_form(&space, &modes) {
                list.push((
                    format!("closed_form_{}", families::joined(&space.slots.iter().map(|s| s.declaration).collect::<Vec<_>>())),
                    design,
                ));
            }
        }
    }
    list
}

/// Every absorber of a family by a closed form for the first mode, its ring in the middle of its bounds; nothing where a type has none.
fn closed_form(space: &Space, modes: &[Vec<EngineMode>]) -> Option<Vec<Mounted>> {
    let middle = space.design(&space.bounds().iter().map(|b| 0.5 * (b.0 + b.1)).collect::<Vec<_>>());
    let values = |(i, slot): (usize, &Slot)| {
        let form = slot.declaration.closed_forms.iter().rfind(|f| f.every_mode)?;
        Some((form.values)(middle[i].absorber.ring_inertia(), *modes[i].first()?))
    };
    let values: Vec<Vec<f64>> = space.slots.iter().enumerate().map(values).collect::<Option<_>>()?;
    let mounted = |(slot, values): (&Slot, &Vec<f64>)| Mounted {
        on: slot.on,
        hub_inertia: slot.hub_inertia,
        absorber: Absorber::Ring((slot.declaration.build)(values)),
    };
    Some(space.slots.iter().zip(&values).map(mounted).collect())
}

/// Speed and value of the peak of a synthesised quantity by one method, on the method's grid and, with `refine`, between its speeds.
///
/// # Errors
/// Those of the method.
pub fn peak(
    method: &dyn Response,
    synthesiser: &Synthesiser,
    design: &[Mounted],
    quantity: Quantity,
    refine: bool,
    work: &mut Work,
) -> Result<(f64, f64), ResponseError> {
    let mut sweep = Vec::new();
    method.sweep(design, quantity, &mut sweep, work)?;
    let (orders, speeds) = (method.orders().len(), &method.grid().speed_rpm);
    let values: Vec<f64> = sweep.chunks(orders).map(|y| synthesiser.extremes(y).half_peak_to_peak).collect();
    work.syntheses += values.len() as u64;
    let largest = (0..values.len()).fold(0, |m, i| if values[i] > values[m] { i } else { m });
    let mut best = (speeds[largest], values[largest]);
    if !refine {
        return Ok(best);
    }
    let last = values.len() - 1;
    let is_top = |i: &usize| values[*i] >= values[i.saturating_sub(1)] && values[*i] >= values[(i + 1).min(last)];
    let mut tops: Vec<usize> = (0..=last).filter(is_top).collect();
    tops.sort_by(|a, b| values[*b].total_cmp(&values[*a]));
    for &i in tops.iter().take(REFINED) {
        let mut value = |speed: f64| -> Result<f64, ResponseError> {
            let y = method.all_orders_at(design, quantity, speed, work)?;
            work.syntheses += 1;
            Ok(synthesiser.extremes(&y).half_peak_to_peak)
        };
        for (a, b) in [(i.saturating_sub(1), i), (i, (i + 1).min(last))].into_iter().filter(|(a, b)| a < b) {
            let found = maximise(speeds[a], speeds[b], &mut value)?;
            best = if found.1 > best.1 { found } else { best };
        }
    }
    Ok(best)
}

/// Measures a study.
///
/// # Errors
/// [`RunError`] where a probe design has no finite peak.
pub fn measure(study: &Study, progress: &dyn Progress) -> Result<SpeedAccuracy, RunError> {
    let excitation = Excitation::new(&study.engine, study.order_limit);
    let probes = probes(study, &excitation);
    let system = System::with_modes(study.chain.clone(), study.modes.clone(), excitation);
    let synthesiser = Synthesiser::new(&system.excitation.harmonics);
    // the reference: every speed of the study and of the pressure table, refined to rounding by direct solutions
    let grid = Grid::new(&study.speeds_rpm, &system.excitation.tabulated_rpm);
    let direct = Method::Direct(Direct::new(&system, &grid));
    let finder = PeakFinder::new(&system, &grid, &direct, true);
    let measure = Measure::new(vec![study.twist], Over::Synthesis);
    let mut exact = Vec::new();
    for (name, design) in &probes {
        let found = finder.peak(design, &measure, &mut Work::default());
        let failed = |error| RunError { what: format!("design `{name}`"), error };
        exact.push(found.map_err(failed)?.map_or(0.0, |p| p.value));
    }
    progress.stage("speed against accuracy", Candidate::ALL.len());
    let mut points = Vec::new();
    for candidate in Candidate::ALL {
        // what takes long enough at few speeds is not asked for many
        let (grids, refined) = if candidate.in_time() { (4, 2) } else { (SPEEDS.len(), 4) };
        let searches = SPEEDS[..grids].iter().map(|n| Search::Grid(*n)).chain(SPEEDS[1..refined].iter().map(|n| Search::Refined(*n)));
        for search in searches.filter(|_| !probes.is_empty()) {
            points.extend(point(study, &system, &synthesiser, (&probes, &exact), candidate, search));
        }
        progress.step();
    }
    let ways = ways(&system, study, &grid, (&probes, &exact)).map_err(|error| RunError { what: "a probe design".into(), error })?;
    Ok(SpeedAccuracy { points, ways, probes })
}

/// Measured seconds and true errors of the strategies of a search.
fn ways(
    system: &System,
    study: &Study,
    grid: &Grid,
    (probes, exact): (&[(String, Vec<Mounted>)], &[f64]),
) -> Result<Vec<Considered>, ResponseError> {
    let Some(first) = probes.first() else { return Ok(Vec::new()) };
    let station = station_of(&first.1, 0);
    let method = Method::Receptance(Receptance::new(system, grid, station, &[study.twist]));
    let finder = PeakFinder::new(system, grid, &method, true);
    let measure = Measure::new(vec![study.twist], Over::Synthesis);
    let seconds = median_seconds(REPEATS, || finder.peak(&first.1, &measure, &mut Work::default()).map(|_| ()))?;
    // the reference sweeps by direct solutions, this way by receptances
    let mut error = 0.0;
    for ((_, design), exact) in probes.iter().zip(exact) {
        let found = finder.peak(design, &measure, &mut Work::default())?.map_or(0.0, |p| p.value);
        error = f64::max(error, (found / exact - 1.0).abs());
    }
    let mut list = vec![Considered { strategy: Strategy::Exact, seconds, error }];
    let Method::Receptance(receptance) = &method else { return Ok(list) };
    for stride in STRIDES {
        let Some(surrogate) = Surrogate::new(receptance, study.twist, stride) else { continue };
        let (mut scratch, mut work) = (Scratch::default(), Work::default());
        let mut error = 0.0;
        for ((_, design), exact) in probes.iter().zip(exact).filter(|((_, d), _)| d.len() == 1 && surrogate.takes(&d[0])) {
            error = f64::max(error, (surrogate.peak(&design[0], &mut scratch, &mut work).value / exact - 1.0).abs());
        }
        let mut once = || {
            // one is over too soon to be timed
            for _ in 0..REPEATED {
                surrogate.peak(&first.1[0], &mut scratch, &mut work);
            }
            Ok(())
        };
        list.push(Considered { strategy: Strategy::Tables(stride), seconds: median_seconds(REPEATS, &mut once)? / REPEATED as f64, error });
    }
    Ok(list)
}

fn point(
    study: &Study,
    system: &System,
    synthesiser: &Synthesiser,
    (probes, exact): (&[(String, Vec<Mounted>)], &[f64]),
    candidate: Candidate,
    search: Search,
) -> Option<Point> {
    let (count, refine) = match search {
        Search::Grid(n) => (n, false),
        Search::Refined(n) => (n, true),
    };
    let (first, last) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let speeds: Vec<f64> = (0..count).map(|i| first + (last - first) * i as f64 / (count - 1) as f64).collect();
    let grid = Grid::new(&speeds, &[]);
    let method = candidate.build(system, &grid, &probes[0].1, study.twist)?;
    let mut worst = Ok(0.0);
    for ((_, design), exact) in probes.iter().zip(exact) {
        let found = peak(method.as_ref(), synthesiser, design, study.twist, refine, &mut Work::default());
        worst = worst.and_then(|w: f64| found.map(|f| w.max((f.1 / exact - 1.0).abs())));
    }
    let once = || peak(method.as_ref(), synthesiser, &probes[0].1, study.twist, refine, &mut Work::default()).map(|_| ());
    let seconds = median_seconds(REPEATS, once).unwrap_or(f64::NAN);
    Some(Point { candidate, search, seconds, error: worst })
}
