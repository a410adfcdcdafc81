//! Results as text, tables and plots: the only place that writes files.

#![deny(missing_docs)]

#[doc(hidden)]
pub mod campaign;
mod captions;
mod columns;
pub mod csv;
#[doc(hidden)]
pub mod example;
pub mod files;
pub mod formats;
pub(crate) mod journal;
mod lines;
mod manifest;
#[doc(hidden)]
pub mod matrices;
mod names;
mod names_of_commands;
mod page;
mod parquet;
pub mod plot;
mod price_words;
mod reason;
#[doc(hidden)]
pub mod results_json;
mod run_tables;
mod sheet;
mod summary;
mod taken;
pub mod text;

pub use files::Job;
pub use files::{Folder, WriteError};
pub use journal::Journal;
pub use names::{CLASSIFICATION, Names, PAGE, UNFINISHED};
pub use page::write_folder;
pub use summary::{about, about_inputs, about_study};

use hartog_comparison::{benchmark, validation};
use hartog_physics::{absorber, crankshaft, drivetrain, engine, fatigue, numerics, objective, optimise, response, rotor, sizing, units};
use hartog_study::{analysis, input};
use run_tables::RUN_TABLES;

use crate::analysis::classification::Classification;
use crate::analysis::curves::{Curves, Figure};
use crate::analysis::fit_law::LawFit;
use crate::analysis::sizing::{SizingResults, front_figure};
use crate::analysis::{Calibration, Results};
use crate::benchmark::Chart;
use crate::input::{InputFile, SizingStudy, Study};
use crate::validation::Comparison;
use crate::validation::rounds::RoundRow;
use crate::validation::worked_examples::ExampleRow;

/// Steps that [`write_run`] tells of.
#[doc(hidden)]
pub fn steps(results: &Results) -> usize {
    1 + plot::count(results) + results.sweeps.iter().map(|s| s.quantities.len()).sum::<usize>()
}

/// Writes everything a run gives, and tells of each step.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
#[doc(hidden)]
pub fn write_run(
    study: &Study,
    calibration: Option<&Calibration>,
    (results, inputs): (&Results, &[InputFile]),
    folder: &Folder,
    written: &(dyn Fn() + Sync),
) -> Result<(), WriteError> {
    write_calibration(study, calibration, folder)?;
    // the large tables beside the others, the plots and what the page asks of the results; the first failure in this order is told
    let large = || {
        let (response, margin) =
            rayon::join(|| csv::response(study, results, folder, written), || csv::margin::margin(study, results, folder));
        written();
        response.and(margin)
    };
    let plots = || plot::run(study, results, folder, written);
    let rest =
        || (write_tables(study, results, folder), results_json::write(study, inputs, results, folder), page::prepared(study, results));
    let (large, (plots, (tables, record, prepared))) = rayon::join(large, || rayon::join(plots, rest));
    tables.and(large).and(plots).and(record)?;
    sheet::write(study, results, folder)?;
    page::write((study, inputs), results, &prepared, folder)
}

/// Writes the tables of a run but the large ones.
fn write_tables(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    RUN_TABLES.iter().filter(|t| (t.asked)(study)).try_for_each(|t| (t.write)(study, results, folder))?;
    csv::proofs(study, results, folder)
}

/// Writes a calibration, where there is one.
fn write_calibration(study: &Study, calibration: Option<&Calibration>, folder: &Folder) -> Result<(), WriteError> {
    let Some(calibration) = calibration else { return Ok(()) };
    csv::calibration(calibration, folder)?;
    plot::comparison::calibration(study, calibration, folder)
}

/// Writes the page of one engine: table and plots of a comparison.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
#[doc(hidden)]
pub fn write_comparison(
    study: &Study,
    calibration: Option<&Calibration>,
    comparison: &Comparison,
    results: &Results,
    folder: &Folder,
) -> Result<(), WriteError> {
    let engine = study.published.as_ref().map_or("", |p| &p.engine);
    csv::comparison(engine, comparison, folder)?;
    if !comparison.choices.rankings.is_empty() {
        csv::choices(&comparison.choices, folder)?;
    }
    write_calibration(study, calibration, folder)?;
    if comparison.amplitudes.iter().any(|a| a.published.is_some() && a.computed.is_some()) {
        plot::comparison::amplitudes(study, comparison, folder)?;
        plot::comparison::orders(study, comparison, results, folder)?;
    }
    Ok(())
}

/// Writes a figure as a table and a plot.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
#[doc(hidden)]
pub fn write_figure(figure: &Figure, folder: &Folder) -> Result<(), WriteError> {
    csv::curves::figure(figure, folder)?;
    plot::curves::figure(figure, folder)
}

/// Writes a table and a plot a figure, and Holzer's tables.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
#[doc(hidden)]
pub fn write_curves(curves: &Curves, folder: &Folder) -> Result<(), WriteError> {
    curves.figures.iter().try_for_each(|figure| write_figure(figure, folder))?;
    curves.histories.iter().try_for_each(|histories| csv::curves::histories(histories, folder))?;
    csv::curves::holzer(&curves.holzer, folder)
}

/// Writes the table and plot of a law beside what it was fitted to.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
#[doc(hidden)]
pub fn write_fit(fit: &LawFit, folder: &Folder) -> Result<(), WriteError> {
    let figure = fit.figure();
    csv::curves::figure(&figure, folder)?;
    plot::curves::figure(&figure, folder)
}

/// Writes printed rounds of sizing beside ours, where there are some.
///
/// # Errors
/// [`WriteError`] where the file cannot be written.
#[doc(hidden)]
pub fn write_rounds(published: &[RoundRow], folder: &Folder) -> Result<(), WriteError> {
    if published.is_empty() { Ok(()) } else { csv::sizing::comparison(published, folder) }
}

/// Writes results of worked examples beside ours; nothing without any.
///
/// # Errors
/// [`WriteError`] where the file cannot be written.
#[doc(hidden)]
pub fn write_examples(rows: &[ExampleRow], folder: &Folder) -> Result<(), WriteError> {
    if rows.is_empty() { Ok(()) } else { csv::sizing::examples(rows, folder) }
}

/// Writes tables and plots of sizing, and the engine file and study that follow.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
#[doc(hidden)]
pub fn write_sizing(study: &SizingStudy, results: &SizingResults, published: &[RoundRow], folder: &Folder) -> Result<(), WriteError> {
    csv::sizing::rounds(results, folder)?;
    write_rounds(published, folder)?;
    if !results.front.is_empty() {
        csv::sizing::front(&results.front, folder)?;
        plot::curves::figure(&front_figure(study, &results.front), folder)?;
    }
    results.figures.iter().try_for_each(|figure| write_figure(figure, folder))?;
    plot::drawing::drawing(study, &results.sized, folder)?;
    if let Some(table) = &results.files.pressure {
        folder.write("pressure.csv", table.as_bytes())?;
    }
    folder.write("engine.toml", results.files.engine.as_bytes())?;
    folder.write("study.toml", results.files.study.as_bytes())
}

/// Writes the calculation that a classification society asks for.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
#[doc(hidden)]
pub fn write_classification(
    (results, inputs): (&Results, &[InputFile]),
    found: &Classification,
    folder: &Folder,
) -> Result<(), WriteError> {
    let study = &results.study;
    csv::classification(found, folder)?;
    csv::designs(study, results, folder)?;
    csv::values(study, results, folder)?;
    csv::absorbers(results, folder)?;
    csv::response(study, results, folder, &|| {})?;
    if !study.limits.is_empty() {
        csv::limits(study, results, folder)?;
        csv::barred(study, results, folder)?;
        csv::rule_stresses(study, results, folder)?;
    }
    plot::classification(study, results, folder)?;
    page::write_classification(study, inputs, results, found, folder)
}

/// Writes the table and plots of a chart.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
#[doc(hidden)]
pub fn write_chart(chart: &Chart, folder: &Folder) -> Result<(), WriteError> {
    csv::chart::speed_accuracy(chart, folder)?;
    plot::chart::speed_accuracy(&chart.study, &chart.methods, folder)?;
    let models: Vec<_> = std::iter::once(&chart.common.grid).chain(&chart.models).collect();
    plot::models::models(&chart.study, &models, folder)?;
    if let Some(ladder) = &chart.ladder {
        csv::chart::crank_ladder(ladder, folder)?;
        plot::ladder::ladder(&chart.study, ladder, folder)?;
    }
    plot::proofs::draw(&chart.study, &chart.proofs, folder)?;
    plot::chart::growth(&chart.common.growth, folder)?;
    plot::chart::stability(&chart.common.map, folder)
}
