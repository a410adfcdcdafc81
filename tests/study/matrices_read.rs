//! What readers of matrices take and refuse: names of unknowns, skew matrices, entries that are missing or come twice, and formats that are not theirs.

use crate::matrices::{files, hartog};
use hartog::input::matrices::{MatrixFiles, structure};
use nalgebra::DMatrix;
use std::fs;
use std::path::{Path, PathBuf};

/// A file with a text.
fn put(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, text).expect("written");
    path
}

/// Names decide: matrices that name their unknowns are put in the sequence of `--dof`, whatever their own; a mass that names some of them only has none at the others; one without names beside a stiffness with its own, and names that
/// do not belong together, are refused.
#[test]
fn unknowns_stand_by_their_names() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str, text: &str| put(folder.path(), name, text);
    at("k.mtx", "9,1,9,1,111.\n9,1,8,1,5.\n8,1,8,1,222.\n");
    let bare = at("m.mas", "1 1 3\n2 2 4\n");
    let read = |mass: Option<&PathBuf>, unknowns: Option<PathBuf>| {
        structure(&MatrixFiles { mass: mass.cloned(), unknowns, ..files(folder.path(), ["k.mtx", "none"]) })
    };
    let dof = at("k.dof", "9.1\n8.1\n");
    let both = read(Some(&bare), Some(dof.clone())).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(both.stiffness, DMatrix::from_row_slice(2, 2, &[111.0, 5.0, 5.0, 222.0]));
    assert_eq!(both.mass, Some(DMatrix::from_row_slice(2, 2, &[3.0, 0.0, 0.0, 4.0])), "in the sequence of --dof");
    let lumped = at("l.mtx", "8,1,8,1,4.\n");
    let alone = read(Some(&lumped), None).unwrap_or_else(|e| panic!("{e}"));
    let eight = alone.unknowns.iter().position(|u| u.node == 8).expect("named");
    let mass = alone.mass.expect("a mass");
    assert_eq!((mass[(eight, eight)], mass[(1 - eight, 1 - eight)]), (4.0, 0.0));
    let longer = at("longer.dof", "9.1\n8.1\n7.1\n");
    let refused = |mass, dof| read(mass, dof).expect_err("names").to_string();
    assert!(refused(None, Some(longer)).contains("found no unknown 7.1 in the stiffness, expected all that --dof names"));
    assert!(refused(Some(&bare), None).contains("found a mass without names of its unknowns"));
    let other = at("o.mtx", "6,1,6,1,4.\n");
    assert!(refused(Some(&other), None).contains("found unknown 6.1 in the mass, expected those that are named by the stiffness"));
    let digits = at("digits.dof", "9.01\n8.1\n");
    assert!(refused(None, Some(digits)).contains("found component `01`"));
}

/// A gyroscopic matrix is minus its mirror image: one triangle of it is completed so, and a symmetric one is refused.
#[test]
fn gyroscopic_matrices_are_skew() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str, text: &str| put(folder.path(), name, text);
    at("k.sti", "1 1 4\n2 2 4\n");
    let dof = at("k.dof", "1.1\n1.2\n");
    let read = |g: &PathBuf| {
        structure(&MatrixFiles {
            rotating: [Some(g.clone()), None],
            unknowns: Some(dof.clone()),
            ..files(folder.path(), ["k.sti", "none"])
        })
    };
    let half = at("g.txt", "1 2 -3\n");
    assert_eq!(read(&half).unwrap_or_else(|e| panic!("{e}")).gyroscopic, Some(DMatrix::from_row_slice(2, 2, &[0.0, -3.0, 3.0, 0.0])));
    for text in ["1 2 3\n2 1 3\n", "%%MatrixMarket matrix coordinate real general\n2 2 1\n1 2 3\n"] {
        let error = read(&at("w.txt", text)).expect_err("no skew matrix").to_string();
        assert!(error.contains("found a gyroscopic matrix that differs from its mirror image"), "{error}");
    }
}

/// A mass that is negative somewhere is told of, wherever nodes are, with exit code 1.
#[test]
fn a_mass_below_zero() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str, text: &str| {
        fs::write(folder.path().join(name), text).expect("written");
        folder.path().join(name).to_string_lossy().into_owned()
    };
    let (k, m, dof) = (at("k.sti", "1 1 4\n1 2 -4\n2 2 4\n"), at("m.mas", "1 1 1\n2 2 -1\n"), at("k.dof", "1.1\n2.1\n"));
    let (code, told) = hartog(&[&k, "--mass", &m, "--dof", &dof]);
    assert!(code == 1 && told.contains("its mass matrix is not positive definite"), "{told}");
}

/// Options that say nothing of what is read are refused by name.
#[test]
fn options_without_use() {
    let study = "studies/villalva_i6_flexible.toml";
    let (code, told) = hartog(&[study, "--units", "mm_t"]);
    assert!(code == 2 && told.contains("found --units with a study, whose crank is computed, expected it without"), "{told}");
    let (code, told) = hartog(&["tests/matrices/sub_throw.mtx", "--modes", "3"]);
    assert!(code == 2 && told.contains("found --modes with matrices, which have their modes"), "{told}");
    let (code, told) = hartog(&["studies/den_hartog.toml"]);
    assert!(code == 2 && told.contains("found an engine without [crank.flexible]"), "{told}");
}

/// What is no matrix of a structure is refused with its line, or its file.
#[test]
fn what_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let header = "%%MatrixMarket matrix coordinate real general\n";
    let cases: [(&str, &str, &str, &str); 20] = [
        (
            "k.mtx",
            "%%MatrixMarket matrix coordinate real general\n2 3 1\n1 1 1\n",
            "1.1\n1.2\n",
            "found 2 rows and 3 columns, expected a square matrix",
        ),
        (
            "k.mtx",
            "%%MatrixMarket matrix coordinate complex general\n2 2 1\n1 1 1 0\n",
            "1.1\n1.2\n",
            "found a matrix of `complex` numbers",
        ),
        ("k.mtx", "%%MatrixMarket matrix coordinate real hermitian\n2 2 1\n1 1 1\n", "1.1\n1.2\n", "found `hermitian`, expected general"),
        ("k.sti", "1 1 4\n1 2 NaN\n2 2 4\n", "1.1\n1.2\n", "k.sti:2:5"),
        ("k.sti", "1 1 4\n1 2 1\n2 2 4\n1 2 3\n", "1.1\n1.2\n", "found row 1, column 2 a second time after line 2"),
        ("k.sti", "1 1 4\n1 2 1\n2 1 2\n2 2 4\n", "1.1\n1.2\n", "found a stiffness that differs from its mirror image by"),
        ("k.sti", "1 1 4\n1 3 1\n2 2 4\n", "1.1\n1.2\n", "found row 1 and column 3, expected at most 2 of each"),
        ("k.sti", "1 1 4\n2 2 4\n", "1.1\n1.7\n", "found component 7, expected 1 to 6"),
        ("k.sti", "1 1 4\n2 2 4\n", "1.1\n1.1\n", "found `1.1` a second time"),
        ("k.sti", "1 1 4\n2 2\n", "1.1\n1.2\n", "found 2 numbers, expected row, column and value"),
        ("k.sti", "1 1 4\n3000 3000 4\n", "1.1\n1.2\n", "larger matrices are to be reduced"),
        ("k.sti", "\n", "1.1\n1.2\n", "found no entry, expected a matrix"),
        ("k.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 4\n2 2 4\n", "1.1\n1.2\n", "found 2 entries, expected 3"),
        ("k.mtx", "%%MatrixMarket matrix array real symmetric\n2 2\n1\n2\n", "1.1\n1.2\n", "found 2 entries, expected 3"),
        (
            "k.mtx",
            "*USER ELEMENT,NODES=2,LINEAR\n** ELEMENT NODES\n**1,1,\n1\n2,2\n*MATRIX,TYPE=STIFFNESS\n1,\n2,\n",
            "",
            "found 2 numbers of `TYPE=STIFFNESS`, expected 3",
        ),
        ("k.pch", "DMIG    K              0       6       3       0\n", "", "found numbers of type 3, expected real ones"),
        ("k.pch", "DMIG    K              0       9       2       0\n", "", "found form 9, expected 1 (square) or 6 (symmetric)"),
        ("k.op4", "       2      -2       6       2K       1P,3E24.16\n", "1.1\n1.2\n", "found a sparse matrix"),
        ("k.op4", "       2       2       6       4K       1P,3E24.16\n", "1.1\n1.2\n", "found numbers of type 4"),
        (
            "k.op4",
            "       2       2       6       2K       1P,3E24.16\n       1       1       3\n  1.0E+00\n",
            "1.1\n1.2\n",
            "found 1 numbers, expected 3",
        ),
    ];
    for (name, text, dof, told) in cases {
        fs::write(folder.path().join(name), text).expect("written");
        let mut read = files(folder.path(), [name, "none"]);
        if !dof.is_empty() {
            fs::write(folder.path().join("unknowns.dof"), dof).expect("written");
            read.unknowns = Some(folder.path().join("unknowns.dof"));
        }
        let error = structure(&read).expect_err(told).to_string();
        assert!(error.contains(told), "{told}: {error}");
    }
    let missing = |nodes: Option<PathBuf>, unknowns: Option<PathBuf>| {
        fs::write(folder.path().join("k.mtx"), format!("{header}2 2 2\n1 1 4\n2 2 4\n")).expect("written");
        fs::write(folder.path().join("unknowns.dof"), "1.1\n2.1\n").expect("written");
        structure(&MatrixFiles { nodes, unknowns, ..files(folder.path(), ["k.mtx", "none"]) }).expect_err("missing").to_string()
    };
    fs::write(folder.path().join("nodes.csv"), "node,x,y,z\n1,0,0,0\n").expect("written");
    let dof = Some(folder.path().join("unknowns.dof"));
    assert!(missing(Some(folder.path().join("nodes.csv")), dof).contains("found no node 2, expected the places of all nodes"));
    fs::write(folder.path().join("nodes.csv"), "node,x,y,z\n1,0,0,0\n2,0,0,1\n2,0,0,2\n").expect("written");
    let dof = Some(folder.path().join("unknowns.dof"));
    assert!(missing(Some(folder.path().join("nodes.csv")), dof).contains("found node 2 a second time"));
    assert!(missing(None, None).contains("found a stiffness without names of its unknowns"));
}
