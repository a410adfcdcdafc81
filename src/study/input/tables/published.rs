//! Published tables. Columns `table` and `engine` may be left out; with `engine`, only the rows of one engine count.

use super::shown::shown;
use super::table::Table;
use crate::engine::Order;
use crate::fatigue::Cycle;
use crate::input::error::InputError;
use crate::input::published::{
    PublishedAbsorber, PublishedAmplitude, PublishedFactor, PublishedFatigue, PublishedFrequency, PublishedQuantity, PublishedStress,
};
use crate::input::schema::bounds::NOMINAL_FACTOR;
use crate::units::{PA_PER_MPA, RAD_PER_DEG};
use std::path::Path;

/// Rows of one engine, with what all published tables share.
pub(super) struct Rows<'a> {
    table: &'a Table,
    pub of_engine: Vec<&'a (u64, Vec<String>)>,
    number: Option<usize>,
}

impl<'a> Rows<'a> {
    pub fn new(table: &'a Table, engine: &str) -> Result<Self, InputError> {
        let column = table.optional("engine");
        let of_engine: Vec<_> = table.rows.iter().filter(|r| column.is_none_or(|c| r.1[c] == engine)).collect();
        if of_engine.is_empty() {
            return Err(table.whole(format!("found no row of engine `{engine}`, expected at least one")));
        }
        Ok(Self { table, of_engine, number: table.optional("table") })
    }

    /// Number of the table a row was copied from.
    pub fn source(&self, line: u64, cells: &[String]) -> Result<String, InputError> {
        self.number.map_or_else(|| Ok(String::new()), |c| self.table.words(line, c, &cells[c]))
    }

    pub fn only(&self, known: &[&str]) -> Result<(), InputError> {
        let found = self.table.header.iter().position(|h| !known.contains(&h.as_str()));
        found.map_or(Ok(()), |i| {
            Err(self.table.at_head(i, format!("found column `{}`, expected only {}", self.table.header[i], known.join(", "))))
        })
    }

    pub fn positive(&self, line: u64, column: usize, cell: &str) -> Result<f64, InputError> {
        let x = self.table.filled(line, column, cell)?;
        if x > 0.0 { Ok(x) } else { Err(self.table.at(line, column, format!("found {x}, expected a number above zero"))) }
    }

    /// Number of a mode, from 1.
    pub fn mode(&self, line: u64, column: usize, cell: &str) -> Result<usize, InputError> {
        let number = self.table.filled(line, column, cell)?;
        if number.fract() == 0.0 && (1.0..=1e6).contains(&number) {
            Ok(number as usize)
        } else {
            Err(self.table.at(line, column, format!("found {number}, expected a number of a mode from 1")))
        }
    }

    fn factor(&self, line: u64, column: usize, cell: &str) -> Result<f64, InputError> {
        let x = self.table.filled(line, column, cell)?;
        let sound = NOMINAL_FACTOR.contains(x);
        if sound { Ok(x) } else { Err(self.table.at(line, column, format!("found {x}, expected {}", NOMINAL_FACTOR.expected()))) }
    }

    fn not_negative(&self, line: u64, column: usize, cell: &str) -> Result<Option<f64>, InputError> {
        match self.table.number(line, column, cell)? {
            Some(x) if x < 0.0 => Err(self.table.at(line, column, format!("found {x}, expected at least zero"))),
            other => Ok(other),
        }
    }
}

/// `torsional_mode, frequency_hz` and optionally `source`.
///
/// # Errors
/// [`InputError`] with row and column.
pub fn frequencies(path: &Path, engine: &str) -> Result<Vec<PublishedFrequency>, InputError> {
    let table = Table::read(path, &["torsional_mode", "frequency_hz"])?;
    let rows = Rows::new(&table, engine)?;
    let (mode, hz, source) = (table.column("torsional_mode")?, table.column("frequency_hz")?, table.optional("source"));
    rows.only(&["table", "engine", "source", "torsional_mode", "frequency_hz"])?;
    let mut list: Vec<PublishedFrequency> = Vec::new();
    for (line, cells) in &rows.of_engine {
        let row = PublishedFrequency {
            table: rows.source(*line, cells)?,
            source: source.map_or_else(|| Ok(String::new()), |s| table.words(*line, s, &cells[s]))?,
            mode: rows.mode(*line, mode, &cells[mode])?,
            frequency_hz: rows.positive(*line, hz, &cells[hz])?,
        };
        if list.iter().any(|r| (&r.table, &r.source, r.mode) == (&row.table, &row.source, row.mode)) {
            return Err(table.at(*line, mode, format!("found mode {} of this table and source a second time", row.mode)));
        }
        list.push(row);
    }
    Ok(list)
}

/// `design, stiffness_n_m_per_rad, ring_inertia_kg_m2, damping_n_m_s_per_rad, f1_hz, f2_hz, f3_hz`; cells may be empty.
///
/// # Errors
/// [`InputError`] with row and column.
pub fn absorbers(path: &Path, engine: &str, designs: &[String]) -> Result<Vec<PublishedAbsorber>, InputError> {
    let table = Table::read(path, &["design", "ring_inertia_kg_m2"])?;
    let rows = Rows::new(&table, engine)?;
    let design = table.column("design")?;
    let values = ["ring_inertia_kg_m2", "stiffness_n_m_per_rad", "damping_n_m_s_per_rad", "f1_hz", "f2_hz", "f3_hz"];
    let mut columns = Vec::new();
    for name in values {
        columns.push(table.column(name)?);
    }
    rows.only(&[&["table", "engine", "design"], values.as_slice()].concat())?;
    let mut list: Vec<PublishedAbsorber> = Vec::new();
    for (line, cells) in &rows.of_engine {
        let mut numbers = Vec::new();
        for &c in &columns {
            let number = rows.not_negative(*line, c, &cells[c])?;
            if table.header[c].ends_with("_hz") && number == Some(0.0) {
                return Err(table.at(*line, c, "found 0, expected a frequency above zero, or an empty cell".into()));
            }
            numbers.push(number);
        }
        let name = designs[known_design(&table, *line, design, &cells[design], designs)?].clone();
        let source = rows.source(*line, cells)?;
        if list.iter().any(|r| r.design == name && r.table == source) {
            return Err(table.at(*line, design, format!("found design `{name}` of this table a second time")));
        }
        let frequencies_hz = numbers.split_off(3);
        let (ring_inertia, stiffness, damping) = (numbers[0], numbers[1], numbers[2]);
        list.push(PublishedAbsorber { table: source, design: name, ring_inertia, stiffness, damping, frequencies_hz });
    }
    Ok(list)
}

fn known_design(table: &Table, line: u64, column: usize, cell: &str, designs: &[String]) -> Result<usize, InputError> {
    designs.iter().position(|d| d == cell).ok_or_else(|| {
        let known = if designs.is_empty() { "which has none".into() } else { designs.join(", ") };
        table.at(line, column, format!("found design `{}`, expected one of the study: {known}", shown(cell)))
    })
}

/// What a study computes: amplitudes elsewhere cannot be compared.
pub struct Reach<'a> {
    /// Names of its designs.
    pub designs: &'a [String],
    /// Lowest and highest speed, rpm.
    pub speeds_rpm: (f64, f64),
    /// Orders of the torque.
    pub orders: &'a [Order],
}

/// `design, order, speed_rpm, hub_amplitude_deg`; the amplitude may be empty, and must be where order or speed lie outside the study.
///
/// # Errors
/// [`InputError`] with row and column.
pub fn amplitudes(path: &Path, engine: &str, reach: &Reach) -> Result<Vec<PublishedAmplitude>, InputError> {
    let designs = reach.designs;
    let table = Table::read(path, &["design", "order", "speed_rpm"])?;
    let rows = Rows::new(&table, engine)?;
    let (design, order) = (table.column("design")?, table.column("order")?);
    let (speed, amplitude) = (table.column("speed_rpm")?, table.column("hub_amplitude_deg")?);
    rows.only(&["table", "engine", "design", "order", "speed_rpm", "hub_amplitude_deg"])?;
    let mut list: Vec<PublishedAmplitude> = Vec::new();
    for (line, cells) in &rows.of_engine {
        let twice = 2.0 * rows.positive(*line, order, &cells[order])?;
        if twice.fract() != 0.0 || twice > 2000.0 {
            return Err(table.at(*line, order, format!("found {}, expected a half or whole order", cells[order])));
        }
        let row = PublishedAmplitude {
            table: rows.source(*line, cells)?,
            design: known_design(&table, *line, design, &cells[design], designs)?,
            order: Order::from_twice(twice as u32),
            speed_rpm: rows.positive(*line, speed, &cells[speed])?,
            amplitude: rows.not_negative(*line, amplitude, &cells[amplitude])?.map(|deg| deg * RAD_PER_DEG),
        };
        if row.amplitude.is_some() {
            let (low, high) = reach.speeds_rpm;
            if !(low..=high).contains(&row.speed_rpm) {
                let message = format!("found an amplitude at {} rpm, expected a speed of the study, {low} to {high} rpm", row.speed_rpm);
                return Err(table.at(*line, speed, message));
            }
            if !reach.orders.contains(&row.order) {
                return Err(table.at(*line, order, format!("found an amplitude of order {}, expected an order of the study", row.order)));
            }
        }
        if list.iter().any(|r| (r.design, r.order, r.speed_rpm) == (row.design, row.order, row.speed_rpm)) {
            return Err(table.at(*line, design, format!("found order {} of `{}` at this speed a second time", row.order, cells[design])));
        }
        list.push(row);
    }
    Ok(list)
}

/// `design, torsion_case, condition, fillet, stress_amplitude_mpa, stress_mean_mpa, safety_factor`.
///
/// # Errors
/// [`InputError`] with row and column.
pub fn fatigue(path: &Path, engine: &str, designs: &[String]) -> Result<Vec<PublishedFatigue>, InputError> {
    let table = Table::read(path, &["design", "torsion_case", "condition", "fillet"])?;
    let rows = Rows::new(&table, engine)?;
    let (design, case, condition, fillet) =
        (table.column("design")?, table.column("torsion_case")?, table.column("condition")?, table.column("fillet")?);
    let (amplitude, mean, factor) =
        (table.column("stress_amplitude_mpa")?, table.column("stress_mean_mpa")?, table.column("safety_factor")?);
    let columns =
        ["table", "engine", "design", "torsion_case", "condition", "fillet", "stress_amplitude_mpa", "stress_mean_mpa", "safety_factor"];
    rows.only(&columns)?;
    let mut list: Vec<PublishedFatigue> = Vec::new();
    for (line, cells) in &rows.of_engine {
        let row = PublishedFatigue {
            table: rows.source(*line, cells)?,
            design: known_design(&table, *line, design, &cells[design], designs)?,
            torsion_case: table.words(*line, case, &cells[case])?,
            condition: table.words(*line, condition, &cells[condition])?,
            fillet: table.words(*line, fillet, &cells[fillet])?,
            cycle: Cycle {
                amplitude: rows.positive(*line, amplitude, &cells[amplitude])? * PA_PER_MPA,
                mean: table.filled(*line, mean, &cells[mean])? * PA_PER_MPA,
            },
            safety_factor: rows.positive(*line, factor, &cells[factor])?,
        };
        let same = |r: &PublishedFatigue| {
            (r.design, &r.torsion_case, &r.condition, &r.fillet) == (row.design, &row.torsion_case, &row.condition, &row.fillet)
        };
        if list.iter().any(same) {
            return Err(table.at(*line, design, "found this design, case, condition and fillet a second time".into()));
        }
        list.push(row);
    }
    Ok(list)
}

/// `model, condition, von_mises_mpa` and optionally `note`.
///
/// # Errors
/// [`InputError`] with row and column.
pub fn stresses(path: &Path, engine: &str) -> Result<Vec<PublishedStress>, InputError> {
    let table = Table::read(path, &["model", "condition", "von_mises_mpa"])?;
    let rows = Rows::new(&table, engine)?;
    let (model, condition, stress) = (table.column("model")?, table.column("condition")?, table.column("von_mises_mpa")?);
    rows.only(&["table", "engine", "model", "condition", "von_mises_mpa", "note"])?;
    let mut list: Vec<PublishedStress> = Vec::new();
    for (line, cells) in &rows.of_engine {
        let row = PublishedStress {
            table: rows.source(*line, cells)?,
            model: table.words(*line, model, &cells[model])?,
            condition: table.words(*line, condition, &cells[condition])?,
            von_mises: rows.positive(*line, stress, &cells[stress])? * PA_PER_MPA,
        };
        if list.iter().any(|r| (&r.model, &r.condition) == (&row.model, &row.condition)) {
            return Err(table.at(*line, model, "found this model and condition a second time".into()));
        }
        list.push(row);
    }
    Ok(list)
}

/// `fillet, bending, torsion`.
///
/// # Errors
/// [`InputError`] with row and column.
pub fn factors(path: &Path, engine: &str) -> Result<Vec<PublishedFactor>, InputError> {
    let table = Table::read(path, &["fillet", "bending", "torsion"])?;
    let rows = Rows::new(&table, engine)?;
    let (fillet, bending, torsion) = (table.column("fillet")?, table.column("bending")?, table.column("torsion")?);
    rows.only(&["table", "engine", "fillet", "bending", "torsion"])?;
    let mut list: Vec<PublishedFactor> = Vec::new();
    for (line, cells) in &rows.of_engine {
        let row = PublishedFactor {
            table: rows.source(*line, cells)?,
            fillet: table.words(*line, fillet, &cells[fillet])?,
            bending: rows.factor(*line, bending, &cells[bending])?,
            torsion: rows.factor(*line, torsion, &cells[torsion])?,
        };
        if !["crankpin", "journal"].contains(&row.fillet.as_str()) {
            return Err(table.at(*line, fillet, format!("found fillet `{}`, expected crankpin or journal", shown(&row.fillet))));
        }
        if list.iter().any(|r| r.fillet == row.fillet) {
            return Err(table.at(*line, fillet, format!("found fillet `{}` a second time", shown(&row.fillet))));
        }
        list.push(row);
    }
    Ok(list)
}

/// `quantity, unit` and a column for each engine; what is no number is kept as words.
///
/// # Errors
/// [`InputError`] with row and column.
pub fn engines(path: &Path, engine: &str) -> Result<Vec<PublishedQuantity>, InputError> {
    let table = Table::read(path, &["quantity", "unit"])?;
    let (name, unit, value) = (table.column("quantity")?, table.column("unit")?, table.column(engine)?);
    let filled = table.rows.iter().filter(|(_, cells)| !cells[value].is_empty());
    let number = |line: u64, cell: &str| -> Result<Option<f64>, InputError> {
        match table.number(line, value, cell) {
            // digits that can be read in two ways are no words
            Err(error) if cell.trim_start_matches(['+', '-']).chars().all(|c| c.is_ascii_digit() || ".,".contains(c)) => Err(error),
            Err(_) => Ok(cell.parse::<f64>().ok().filter(|x| x.is_finite())),
            read => read,
        }
    };
    let row = |(line, cells): &(u64, Vec<String>)| -> Result<PublishedQuantity, InputError> {
        let words = |column: usize| table.words(*line, column, &cells[column]);
        let value = match number(*line, &cells[value])? {
            Some(x) => Ok(x),
            None => Err(words(value)?),
        };
        Ok(PublishedQuantity { name: words(name)?, unit: words(unit)?, value })
    };
    filled.map(row).collect()
}
