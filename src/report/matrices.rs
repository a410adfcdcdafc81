//! Matrices of structures for other programs, and what is found of them.

use crate::crankshaft::flexible::imported::ImportedCrank;
use crate::files::{Folder, WriteError};
use crate::rotor::structure::{Structure, Unknown};
use crate::rotor::structure_checks::{Checks, OfChain};
use crate::text::table::significant;
use nalgebra::DMatrix;
use std::fmt::Write;

/// A format that is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MatrixFormat {
    /// Matrix Market, coordinate: `stiffness.mtx` and so on, `unknowns.dof`.
    MatrixMarket,
    /// As CalculiX stores them: `stiffness.sti`, `mass.mas`, `unknowns.dof`.
    Calculix,
    /// Lines node, component, node, component, value of Abaqus.
    Abaqus,
    /// A substructure, stiffness only.
    UserElement,
    /// DMIG in fields of 16 characters, which hold ten digits.
    Dmig,
    /// OP4 as text.
    Op4,
}

/// Names of the files that a structure may have: the matrix, its word, and its ending.
const NAMES: [&str; 4] = ["stiffness", "mass", "gyroscopic", "turning"];

impl MatrixFormat {
    fn ending(self, matrix: usize) -> &'static str {
        match (self, matrix) {
            (Self::MatrixMarket | Self::UserElement | Self::Abaqus, _) => "mtx",
            (Self::Calculix, 0) => "sti",
            (Self::Calculix, 1) => "mas",
            (Self::Calculix, _) => "mtx",
            (Self::Dmig, _) => "pch",
            (Self::Op4, _) => "op4",
        }
    }

    /// Files that any of them may write.
    pub(crate) fn files() -> impl Iterator<Item = String> {
        let all = [Self::MatrixMarket, Self::Calculix, Self::Dmig, Self::Op4];
        let files_of = |f: Self| (0..NAMES.len()).map(move |m| format!("{}.{}", NAMES[m], f.ending(m)));
        all.into_iter().flat_map(files_of).chain(["unknowns.dof".to_owned(), "nodes.csv".to_owned()])
    }
}

/// Entries below the diagonal and on it, column by column; of a matrix that is not symmetric all of them.
fn entries(x: &DMatrix<f64>) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
    let symmetric = is_symmetric(x);
    let rows = move |j: usize| if symmetric { j..x.nrows() } else { 0..x.nrows() };
    (0..x.ncols()).flat_map(move |j| rows(j).map(move |i| (i, j, x[(i, j)]))).filter(|e| e.2 != 0.0)
}

fn is_symmetric(x: &DMatrix<f64>) -> bool {
    (0..x.ncols()).all(|j| (0..j).all(|i| x[(i, j)] == x[(j, i)]))
}

/// A number of Nastran in 16 characters, as many digits as there is room for.
fn field(x: f64) -> String {
    (0..=12).rev().map(|digits| format!("{x:.digits$E}")).find(|text| text.len() <= 16).unwrap_or_else(|| format!("{x:.6E}"))
}

fn text(s: &Structure, x: &DMatrix<f64>, name: &str, format: MatrixFormat) -> String {
    let n = x.nrows();
    let unknown = |i: usize| s.unknowns[i];
    let mut text = String::new();
    match format {
        MatrixFormat::MatrixMarket => {
            let kind = if is_symmetric(x) { "symmetric" } else { "general" };
            _ = writeln!(text, "%%MatrixMarket matrix coordinate real {kind}\n{n} {n} {}", entries(x).count());
            entries(x).for_each(|(i, j, v)| _ = writeln!(text, "{} {} {v:.16e}", i + 1, j + 1));
        }
        // the upper triangle, column by column
        MatrixFormat::Calculix if is_symmetric(x) => {
            let upper = (0..n).flat_map(|j| (0..=j).map(move |i| (i, j, x[(i, j)]))).filter(|e| e.2 != 0.0);
            upper.for_each(|(i, j, v)| _ = writeln!(text, "{} {} {v:.16e}", i + 1, j + 1));
        }
        MatrixFormat::Calculix => entries(x).for_each(|(i, j, v)| _ = writeln!(text, "{} {} {v:.16e}", i + 1, j + 1)),
        MatrixFormat::Abaqus => entries(x).for_each(|(i, j, v)| {
            let (a, b): (Unknown, Unknown) = (unknown(i), unknown(j));
            _ = writeln!(text, "{},{},{},{},{v:.16e}", a.node, a.component, b.node, b.component);
        }),
        MatrixFormat::UserElement => {
            _ = writeln!(text, "** SUBSTRUCTURE\n*USER ELEMENT,NODES={n},LINEAR\n** ELEMENT NODES");
            for nodes in s.unknowns.chunks(10) {
                _ = writeln!(text, "**{}", nodes.iter().map(|u| format!("{:>10},", u.node)).collect::<String>());
            }
            for (k, u) in s.unknowns.iter().enumerate() {
                _ = if k == 0 { writeln!(text, "{:>10}", u.component) } else { writeln!(text, "{:>10},{:>10}", k + 1, u.component) };
            }
            text.push_str("*MATRIX,TYPE=STIFFNESS\n");
            for i in 0..n {
                let row: Vec<String> = (0..=i).map(|j| format!("{:.16E}", x[(i, j)])).collect();
                row.chunks(4).for_each(|c| _ = writeln!(text, "{},", c.join(",")));
            }
        }
        MatrixFormat::Dmig => {
            let word: String = name.chars().take(8).collect::<String>().to_uppercase();
            let form = if is_symmetric(x) { 6 } else { 1 };
            _ = writeln!(text, "DMIG    {word:<8}{:>8}{form:>8}{:>8}{:>8}", 0, 2, 0);
            let mut last = None;
            for (i, j, v) in entries(x) {
                let (row, column) = (unknown(i), unknown(j));
                if last != Some(j) {
                    _ = writeln!(text, "DMIG*   {word:<16}{:>16}{:>16}", column.node, column.component);
                    last = Some(j);
                }
                _ = writeln!(text, "*       {:>16}{:>16}{:>16}", row.node, row.component, field(v));
            }
        }
        MatrixFormat::Op4 => {
            let form = if is_symmetric(x) { 6 } else { 2 };
            let word: String = name.chars().take(8).collect::<String>().to_uppercase();
            _ = writeln!(text, "{n:>8}{n:>8}{form:>8}{:>8}{word:<8}1P,3E24.16", 2);
            for j in 0..n {
                _ = writeln!(text, "{:>8}{:>8}{n:>8}", j + 1, 1);
                let column: Vec<String> = (0..n).map(|i| fortran(x[(i, j)])).collect();
                column.chunks(3).for_each(|c| _ = writeln!(text, "{}", c.concat()));
            }
            _ = writeln!(text, "{:>8}{:>8}{:>8}\n{}", n + 1, 1, 1, fortran(1.0));
        }
    }
    text
}

/// A number in 24 characters.
fn fortran(x: f64) -> String {
    format!("{:>24}", format!("{x:.16E}"))
}

/// Writes a structure, SI.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
#[doc(hidden)]
pub fn write_matrices(s: &Structure, format: MatrixFormat, folder: &Folder) -> Result<(), WriteError> {
    let all = [Some(&s.stiffness), s.mass.as_ref(), s.gyroscopic.as_ref(), s.turning.as_ref()];
    for (m, x) in all.into_iter().enumerate().filter(|(m, _)| format != MatrixFormat::UserElement || *m == 0) {
        let Some(x) = x else { continue };
        folder.write(&format!("{}.{}", NAMES[m], format.ending(m)), text(s, x, NAMES[m], format).as_bytes())?;
    }
    let names: String = s.unknowns.iter().map(|u| format!("{}.{}\n", u.node, u.component)).collect();
    folder.write("unknowns.dof", names.as_bytes())?;
    if s.places.is_empty() {
        return Ok(());
    }
    let places: String = s.places.iter().map(|(node, p)| format!("{node},{:e},{:e},{:e}\n", p.x, p.y, p.z)).collect();
    folder.write("nodes.csv", format!("node,x,y,z\n{places}").as_bytes())
}

/// What its nodes are, as an engine file names them.
#[doc(hidden)]
pub fn roles(crank: &ImportedCrank) -> String {
    let list = |all: &[Vec<u64>]| format!("{all:?}");
    format!(
        "  in an engine file [crank.flexible.matrices] has hub = {}, flywheel = {},\n  pins = {},\n  journals = {}\n",
        crank.hub,
        crank.flywheel,
        list(&crank.pins),
        list(&crank.journals)
    )
}

/// What a structure is found to be.
#[doc(hidden)]
pub fn matrices(s: &Structure, c: &Checks, chain: Option<OfChain>) -> String {
    let modal = s.unknowns.iter().filter(|u| u.component == 0).count();
    let mut text = format!("{} unknowns of {} nodes, {modal} of them of modes\n", s.unknowns.len(), s.nodes());
    let mut line = |words: &str, value: Option<String>| _ = value.map(|value| writeln!(text, "  {words:<34}{value}"));
    let with_unit = |x: f64, unit: &str| format!("{} {unit}", significant(x, 7));
    line("stiffness against rigid motion", c.rigid_residual.map(|x| format!("{x:.1e} of the largest")));
    line("rigid modes", c.rigid_modes.map(|n| n.to_string()));
    line("mass", c.mass.map(|m| with_unit(m[0], "kg")));
    line("centre of mass", c.centre.map(|p| format!("{}, {}, {} m", significant(p.x, 4), significant(p.y, 4), significant(p.z, 6))));
    line("inertia about z", c.polar_inertia.map(|x| with_unit(x, "kg m²")));
    line("  of the chain", chain.map(|own| with_unit(own.inertia, "kg m²")));
    line("torsional stiffness, free ends", c.torsional_stiffness.map(|x| with_unit(x, "N m/rad")));
    line("  of the chain", chain.map(|own| with_unit(own.stiffness, "N m/rad")));
    let hz = |f: &Vec<f64>| f.iter().take(10).map(|x| significant(*x, 6)).collect::<Vec<_>>().join(", ");
    line("elastic frequencies/Hz", c.frequencies_hz.as_ref().map(hz));
    if s.places.is_empty() {
        text.push_str("  without the places of its nodes (--nodes) nothing is told of rigid motion, mass, centre, inertia and torsion\n");
    }
    for objection in c.objections(chain) {
        _ = writeln!(text, "warning: {}", objection);
    }
    text
}
