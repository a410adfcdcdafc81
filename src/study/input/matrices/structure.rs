//! A structure from its files: matrices put together, compared and brought into SI.

use super::lines::{Lines, Raw};
use super::{abaqus, coordinate, dmig, op4, user_element};
use crate::input::error::{InputError, Source};
use crate::input::tables::Table;
use crate::rotor::structure::{Structure, Unknown};
use nalgebra::{DMatrix, Vector3};
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

/// Relative difference of an entry and its mirror image that is rounding.
const SYMMETRIC: f64 = 1e-6;

/// Which matrix a file is read for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Stiffness,
    Mass,
    Gyroscopic,
    Turning,
}

impl Kind {
    fn name(self) -> &'static str {
        match self {
            Self::Stiffness => "stiffness",
            Self::Mass => "mass",
            Self::Gyroscopic => "gyroscopic matrix",
            Self::Turning => "turning matrix",
        }
    }

    /// What an entry is of its mirror image.
    fn mirrored(self) -> f64 {
        if self == Self::Gyroscopic { -1.0 } else { 1.0 }
    }
}

/// What a file says, by its own form.
fn raw(lines: &Lines, kind: Kind) -> Result<Raw, InputError> {
    let upper = lines.text().to_uppercase();
    let first = upper.lines().find(|l| !l.trim().is_empty()).unwrap_or("");
    if first.starts_with("%%MATRIXMARKET") {
        coordinate::matrix_market(lines)
    } else if upper.contains("*USER ELEMENT") {
        user_element::read(lines, if kind == Kind::Mass { "MASS" } else { "STIFFNESS" })
    } else if upper.lines().any(|l| l.starts_with("DMIG")) {
        dmig::read(lines)
    } else if op4::is_header(first) {
        op4::read(lines)
    } else if first.contains(',') || first.starts_with('*') {
        abaqus::read(lines)
    } else {
        coordinate::triplets(lines)
    }
}

/// Unknowns in their sequence.
#[derive(Debug, Clone, Copy)]
enum Named<'a> {
    /// Not yet.
    Not,
    /// In a file of their own: what a matrix without names is of.
    ByFile(&'a [Unknown]),
    /// By the stiffness, in a sequence that says nothing of other matrices.
    ByStiffness(&'a [Unknown]),
}

impl Named<'_> {
    fn by(self) -> &'static str {
        match self {
            Self::Not => "nothing",
            Self::ByFile(_) => "--dof",
            Self::ByStiffness(_) => "the stiffness",
        }
    }
}

/// Reads a matrix over unknowns in their sequence, which is that of its file where there is none yet.
fn read(path: &Path, kind: Kind, named: Named) -> Result<(DMatrix<f64>, Vec<Unknown>), InputError> {
    let source = Source::read(path)?;
    let lines = Lines { source: &source };
    let raw = raw(&lines, kind)?;
    let unknowns = match (&raw.unknowns, named) {
        (None, Named::ByFile(known)) => known.to_vec(),
        (None, Named::Not | Named::ByStiffness(_)) => {
            let message = format!(
                "found a {} without names of its unknowns, expected them in a file of their own (--dof, in an engine file `dof`): a line each, `node.component`",
                kind.name()
            );
            return Err(InputError::of_file(path, message));
        }
        (Some(own), named) => {
            if let Some(twice) = own.iter().enumerate().find(|(i, u)| own[..*i].contains(u)) {
                let (node, component) = (twice.1.node, twice.1.component);
                return Err(InputError::of_file(path, format!("found unknown {node}.{component} a second time, expected each once")));
            }
            match named {
                Named::Not => own.clone(),
                Named::ByFile(known) | Named::ByStiffness(known) => known.to_vec(),
            }
        }
    };
    let values = placed(&lines, path, &raw, (kind, &unknowns))?;
    // what a file names itself stands by its names
    let Some(own) = &raw.unknowns else { return Ok((values, unknowns)) };
    let place = |u: &Unknown| unknowns.iter().position(|o| o == u);
    let places: Vec<Option<usize>> = own.iter().map(place).collect();
    if let Some((u, _)) = own.iter().zip(&places).find(|p| p.1.is_none()) {
        let message =
            format!("found unknown {}.{} in the {}, expected those that are named by {}", u.node, u.component, kind.name(), named.by());
        return Err(InputError::of_file(path, message));
    }
    if let (Kind::Stiffness, Some(lacks)) = (kind, unknowns.iter().find(|u| !own.contains(u))) {
        let message =
            format!("found no unknown {}.{} in the stiffness, expected all that {} names", lacks.node, lacks.component, named.by());
        return Err(InputError::of_file(path, message));
    }
    // where a mass names some of them only, the others have none
    let mut all = DMatrix::zeros(unknowns.len(), unknowns.len());
    for (i, row) in places.iter().enumerate() {
        for (j, column) in places.iter().enumerate() {
            if let (Some(row), Some(column)) = (row, column) {
                all[(*row, *column)] = values[(i, j)];
            }
        }
    }
    Ok((all, unknowns))
}

/// The matrix in the sequence of its file: one triangle is mirrored.
fn placed(lines: &Lines, path: &Path, raw: &Raw, (kind, known): (Kind, &[Unknown])) -> Result<DMatrix<f64>, InputError> {
    let size = raw.unknowns.as_ref().map_or(known.len(), Vec::len);
    if raw.entries.is_empty() && raw.size.is_none() {
        let message = "found no entry, expected a matrix: Matrix Market, rows of `row column value`, a substructure, DMIG or OP4";
        return Err(InputError::of_file(path, message));
    }
    if let Some(e) = raw.entries.iter().find(|e| e.row.max(e.column) >= size) {
        let (row, column) = (e.row + 1, e.column + 1);
        let found = format!("found row {row} and column {column}, expected at most {size} of each, as many as there are unknowns");
        return Err(lines.wrong(e.line, "", found));
    }
    if let Some(own) = raw.size.filter(|own| *own != size) {
        return Err(InputError::of_file(path, format!("found a matrix of {own} rows, expected {size}, one an unknown")));
    }
    let mut seen: HashMap<(usize, usize), usize> = HashMap::new();
    for e in &raw.entries {
        if let Some(line) = seen.insert((e.row, e.column), e.line) {
            let (row, column) = (e.row + 1, e.column + 1);
            return Err(lines.wrong(
                e.line,
                "",
                format!("found row {row}, column {column} a second time after line {line}, expected each once"),
            ));
        }
    }
    // of a sequence of unknowns of its own one triangle may lie on both sides of the diagonal
    let is_one = !raw.is_full && raw.entries.iter().all(|e| e.row == e.column || !seen.contains_key(&(e.column, e.row)));
    let mut values = DMatrix::zeros(size, size);
    for e in &raw.entries {
        values[(e.row, e.column)] = e.value;
        if is_one && e.row != e.column {
            values[(e.column, e.row)] = kind.mirrored() * e.value;
        }
    }
    let off = (&values - values.transpose() * kind.mirrored()).amax() / values.amax().max(f64::MIN_POSITIVE);
    if off > SYMMETRIC {
        let (name, wanted) = (kind.name(), if kind == Kind::Gyroscopic { "minus it" } else { "the same" });
        let message = format!("found a {name} that differs from its mirror image by {off:.1e} of its largest entry, expected {wanted}");
        return Err(InputError::of_file(path, message));
    }
    Ok((&values + values.transpose() * kind.mirrored()) * 0.5)
}

/// Units in which a finite-element program computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnitSystem {
    /// m, kg, N, s.
    Si,
    /// mm, t, N, s.
    MmTonne,
}

impl UnitSystem {
    /// Value of an unknown in these units over that in SI: 1000 of translations in mm, 1 of rotations; a mode keeps its unit mass.
    #[doc(hidden)]
    pub fn scale(self, unknown: &Unknown) -> f64 {
        match (self, unknown.component) {
            (Self::Si, _) | (Self::MmTonne, 4..=6) => 1.0,
            (Self::MmTonne, 0) => 1.0 / 1e-3_f64.sqrt(),
            (Self::MmTonne, _) => 1e3,
        }
    }
}

/// Files of a structure.
#[derive(Debug, Clone)]
#[doc(hidden)]
pub struct MatrixFiles {
    /// K.
    pub stiffness: PathBuf,
    /// M.
    pub mass: Option<PathBuf>,
    /// G and K_s + Kc - Z of turning axes.
    pub rotating: [Option<PathBuf>; 2],
    /// A line an unknown: node and component.
    pub unknowns: Option<PathBuf>,
    /// Columns node, x, y, z.
    pub nodes: Option<PathBuf>,
    /// Of all files.
    pub units: UnitSystem,
}

/// Reads a structure, in SI.
///
/// # Errors
/// [`InputError`] at the line that is not understood, and where matrices are not square, not symmetric, or of other unknowns than each other.
#[doc(hidden)]
pub fn structure(files: &MatrixFiles) -> Result<Structure, InputError> {
    let named = files.unknowns.as_deref().map(unknowns).transpose()?;
    let (stiffness, unknowns) = read(&files.stiffness, Kind::Stiffness, named.as_deref().map_or(Named::Not, Named::ByFile))?;
    let of_others = if named.is_some() { Named::ByFile(&unknowns) } else { Named::ByStiffness(&unknowns) };
    let other = |path: Option<&PathBuf>, kind: Kind| path.map(|path| read(path, kind, of_others).map(|found| found.0)).transpose();
    let mass = other(files.mass.as_ref(), Kind::Mass)?;
    let gyroscopic = other(files.rotating[0].as_ref(), Kind::Gyroscopic)?;
    let turning = other(files.rotating[1].as_ref(), Kind::Turning)?;
    let (length, scale) = match files.units {
        UnitSystem::Si => (1.0, 1.0_f64),
        UnitSystem::MmTonne => (1e-3, 1e-3),
    };
    let places = files.nodes.as_deref().map(|path| places(path, &unknowns, length)).transpose()?.unwrap_or_default();
    // K_SI = 1e-3 D K D of N, mm, t and s
    let d: Vec<f64> = unknowns.iter().map(|u| files.units.scale(u)).collect();
    let si = |x: DMatrix<f64>| DMatrix::from_fn(d.len(), d.len(), |i, j| scale * d[i] * x[(i, j)] * d[j]);
    let [mass, gyroscopic, turning] = [mass, gyroscopic, turning].map(|x| x.map(si));
    Ok(Structure { stiffness: si(stiffness), mass, gyroscopic, turning, unknowns, places })
}

/// Names of unknowns: lines `node.component`, or both with a blank or a comma between.
fn unknowns(path: &Path) -> Result<Vec<Unknown>, InputError> {
    let source = Source::read(path)?;
    let lines = Lines { source: &source };
    let mut all: Vec<Unknown> = Vec::new();
    for (line, text) in lines.all().filter(|l| !l.1.trim().is_empty() && !l.1.trim_start().starts_with('#')) {
        let mut parts = text.split(|c: char| c == '.' || c == ',' || c.is_whitespace()).filter(|p| !p.is_empty());
        let (Some(node), Some(component), None) = (parts.next(), parts.next(), parts.next()) else {
            return Err(lines.wrong(line, text.trim(), format!("found `{}`, expected `node.component`", text.trim())));
        };
        // 7.01 may be meant as 7.1 or 7.10
        if component.len() > 1 {
            return Err(lines.wrong(line, text.trim(), format!("found component `{component}`, expected a digit from 0 to 6")));
        }
        let unknown = Unknown { node: lines.whole(line, node)?, component: lines.component(line, component)? };
        if all.contains(&unknown) {
            return Err(lines.wrong(line, text.trim(), format!("found `{}` a second time, expected each unknown once", text.trim())));
        }
        all.push(unknown);
    }
    if all.is_empty() {
        return Err(InputError::of_file(path, "found no unknown, expected a line each, `node.component`"));
    }
    Ok(all)
}

/// Places of nodes, m.
fn places(path: &Path, unknowns: &[Unknown], length: f64) -> Result<BTreeMap<u64, Vector3<f64>>, InputError> {
    let table = Table::read(path, &["node", "x", "y", "z"])?;
    let columns = ["node", "x", "y", "z"].map(|name| table.column(name));
    let [node, x, y, z] = columns;
    let (node, axes) = (node?, [x?, y?, z?]);
    let mut all = BTreeMap::new();
    for (line, cells) in &table.rows {
        let number = table.filled(*line, node, &cells[node])?;
        if number.fract() != 0.0 || !(0.0..1e15).contains(&number) {
            return Err(table.at(*line, node, format!("found `{}`, expected the number of a node", cells[node])));
        }
        let mut place = Vector3::zeros();
        for (k, column) in axes.iter().enumerate() {
            place[k] = length * table.filled(*line, *column, &cells[*column])?;
        }
        if all.insert(number as u64, place).is_some() {
            return Err(table.at(*line, node, format!("found node {number} a second time, expected each once")));
        }
    }
    if let Some(missing) = unknowns.iter().find(|u| u.component > 0 && !all.contains_key(&u.node)) {
        return Err(table.whole(format!("found no node {}, expected the places of all nodes that the matrices move", missing.node)));
    }
    Ok(all)
}
