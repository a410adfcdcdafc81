//! Matrices of structures from and for other programs: reductions against the whole, every format there and back, what is found of a bar against closed forms, and what is refused.

use crate::support::assert_close;
use hartog::crankshaft::flexible::{Carried, assemble, reduced};
use hartog::input::matrices::{MatrixFiles, UnitSystem, structure};
use hartog::rotor::free_modes::free_modes;
use hartog::rotor::reduction::Reduction;
use hartog::rotor::structure::{CrankAxis, Structure, Unknown};
use hartog::rotor::structure_checks::Objection;
use nalgebra::{DMatrix, SymmetricEigen, Vector3};
use std::fs;
use std::path::Path;
use std::process::Command;

const FORMATS: [&str; 6] = ["matrix_market", "calculix", "abaqus", "user_element", "dmig", "op4"];

pub fn files(folder: &Path, [stiffness, mass]: [&str; 2]) -> MatrixFiles {
    let there = |name: &str| Some(folder.join(name)).filter(|p| p.is_file());
    MatrixFiles {
        stiffness: folder.join(stiffness),
        mass: there(mass),
        rotating: [None, None],
        unknowns: there("unknowns.dof"),
        nodes: there("nodes.csv"),
        units: UnitSystem::Si,
    }
}

/// Runs `hartog matrices`; its exit code, and all that it prints.
pub fn hartog(arguments: &[&str]) -> (i32, String) {
    let output =
        Command::new(env!("CARGO_BIN_EXE_hartog")).current_dir(env!("CARGO_MANIFEST_DIR")).arg("matrices").args(arguments).output();
    let output = output.expect("runs");
    let text = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    (output.status.code().expect("ends"), text.split_whitespace().collect::<Vec<_>>().join(" "))
}

/// A straight bar along z of Euler's beams: all motions of its nodes, by the stiffness of textbooks and masses at the nodes. 1 m long, 50 mm thick, of steel.
fn bar() -> Structure {
    let (n, length, d, e, rho) = (5usize, 1.0f64, 0.05f64, 2.05e11f64, 7850.0);
    let (l, area, second, g) =
        (length / (n - 1) as f64, std::f64::consts::PI * d * d / 4.0, std::f64::consts::PI * d.powi(4) / 64.0, e / 2.6);
    let (mut k, mut m) = (DMatrix::zeros(6 * n, 6 * n), DMatrix::zeros(6 * n, 6 * n));
    let mut add = |rows: &[usize], block: &[[f64; 4]; 4], scale: f64| {
        for (a, i) in rows.iter().enumerate() {
            rows.iter().enumerate().for_each(|(b, j)| k[(*i, *j)] += scale * block[a][b]);
        }
    };
    let bent = |s: f64| {
        let (a, b) = (6.0 * l * s, l * l);
        [[12.0, a, -12.0, a], [a, 4.0 * b, -a, 2.0 * b], [-12.0, -a, 12.0, -a], [a, 2.0 * b, -a, 4.0 * b]]
    };
    let pulled = [[1.0, -1.0, 0.0, 0.0], [-1.0, 1.0, 0.0, 0.0], [0.0; 4], [0.0; 4]];
    for i in 0..n - 1 {
        let at = |c: usize| 6 * i + c;
        // u bends with fy, v with -fx
        add(&[at(0), at(4), at(6), at(10)], &bent(1.0), e * second / l.powi(3));
        add(&[at(1), at(3), at(7), at(9)], &bent(-1.0), e * second / l.powi(3));
        add(&[at(2), at(8), at(2), at(8)], &pulled, e * area / l);
        add(&[at(5), at(11), at(5), at(11)], &pulled, 2.0 * g * second / l);
        for node in [i, i + 1] {
            let half = rho * area * l / 2.0;
            (0..3).for_each(|c| m[(6 * node + c, 6 * node + c)] += half);
            let inertia = half * d * d / 16.0;
            (3..5).for_each(|c| m[(6 * node + c, 6 * node + c)] += inertia);
            m[(6 * node + 5, 6 * node + 5)] += 2.0 * inertia;
        }
    }
    let unknown = |i: usize| Unknown { node: (i / 6 + 1) as u64, component: (i % 6 + 1) as u8 };
    Structure {
        unknowns: (0..6 * n).map(unknown).collect(),
        places: (0..n).map(|i| ((i + 1) as u64, Vector3::new(0.0, 0.0, l * i as f64))).collect(),
        stiffness: k,
        mass: Some(m),
        gyroscopic: None,
        turning: None,
    }
}

/// Units of a file over SI: of lengths, of matrices, and of an unknown.
type Scale<'a> = (f64, f64, &'a dyn Fn(&Unknown) -> f64);

/// Writes a structure as Matrix Market by hand, with names and places; `d`: units of unknowns, `length` of places, `scale` of matrices.
fn written(folder: &Path, s: &Structure, (length, scale, d): Scale) {
    let text = |x: &DMatrix<f64>| {
        let n = x.nrows();
        let all = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j))).filter(|(i, j)| x[(*i, *j)] != 0.0);
        let lines: Vec<String> =
            all.map(|(i, j)| format!("{} {} {:.17e}", i + 1, j + 1, scale * d(&s.unknowns[i]) * x[(i, j)] * d(&s.unknowns[j]))).collect();
        format!("%%MatrixMarket matrix coordinate real symmetric\n% by hand\n{n} {n} {}\n{}\n", lines.len(), lines.join("\n"))
    };
    fs::write(folder.join("k.mtx"), text(&s.stiffness)).expect("written");
    fs::write(folder.join("m.mtx"), text(s.mass.as_ref().expect("a mass"))).expect("written");
    let names: String = s.unknowns.iter().map(|u| format!("{}.{}\n", u.node, u.component)).collect();
    fs::write(folder.join("unknowns.dof"), names).expect("written");
    let nodes: String = s.places.iter().map(|(n, p)| format!("{n},{},{},{}\n", length * p.x, length * p.y, length * p.z)).collect();
    fs::write(folder.join("nodes.csv"), format!("node,x,y,z\n{nodes}")).expect("written");
}

fn close(a: &DMatrix<f64>, b: &DMatrix<f64>, tolerance: f64, what: &str) {
    assert_eq!(a.shape(), b.shape(), "{what}");
    assert!((a - b).amax() <= tolerance * b.amax(), "{what}: {:e}", (a - b).amax() / b.amax());
}

/// Law: with all modes a Craig–Bampton reduction loses nothing; the fewer modes, the higher its frequencies, none below the true ones; mass and rigid motion are kept exactly.
#[test]
fn reductions_come_down_to_the_whole() {
    let n = 14;
    let random = DMatrix::from_fn(n, n, |i, j| ((i * 7 + j * 13 + i * j * 3) % 11) as f64 / 11.0 - 0.4);
    let stiffness = &random * random.transpose() + DMatrix::identity(n, n) * 0.5;
    let mass = DMatrix::from_diagonal(&nalgebra::DVector::from_fn(n, |i, _| 1.0 + 0.1 * i as f64));
    let squares = |k: &DMatrix<f64>, m: &DMatrix<f64>| {
        let l = m.clone().cholesky().expect("positive").l().try_inverse().expect("regular");
        let mut all: Vec<f64> = SymmetricEigen::new(&l * k * l.transpose()).eigenvalues.iter().copied().collect();
        all.sort_by(f64::total_cmp);
        all
    };
    let whole = squares(&stiffness, &mass);
    let mut last = f64::INFINITY;
    for modes in 0..=n - 4 {
        let reduction = Reduction::new(&stiffness, &mass, &[0, 3, 7, 12], modes).expect("held");
        let own = squares(&reduction.of(&stiffness), &reduction.of(&mass));
        let error: f64 = own.iter().zip(&whole).take(4).map(|(a, b)| a / b - 1.0).sum();
        assert!(error >= -1e-12 && error <= last * (1.0 + 1e-9) + 1e-12, "{modes}: {error} after {last}");
        last = error;
    }
    assert!(last.abs() < 1e-10, "all modes: {last}");
}

/// The six of the thesis, free, with hub and flywheel: reduced to bearings, pins and ends its first five elastic frequencies are those of all its nodes to 1 % without modes and 1e-4 with twenty, always from above; mass and inertia are
/// kept to 1e-12.
#[test]
fn a_reduced_crank_keeps_its_frequencies() {
    let study = hartog::input::read(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/studies/villalva_i6_flexible.toml"))).expect("a study");
    let (flexible, crank) = (study.flexible.as_ref().expect("flexible"), study.crank.as_ref().expect("a crank"));
    let assembled = assemble(crank, &study.engine, &study.chain, &flexible.spec, Carried::Ends).expect("a crank");
    let whole: Vec<f64> =
        free_modes(&assembled.shaft, 12).expect("modes").iter().map(|m| m.omega / std::f64::consts::TAU).filter(|f| *f > 1.0).collect();
    let inertia = assembled.shaft.kinetic(&assembled.shaft.rigid_rotation(), &assembled.shaft.rigid_rotation());
    for (modes, tolerance) in [(0, 1e-2), (20, 1e-4)] {
        let checks = reduced(&assembled, modes).expect("positive").structure.checks();
        assert_eq!(checks.rigid_modes, Some(6));
        assert!(checks.rigid_residual.expect("places") < 1e-9 && checks.negative == 0);
        for (own, f) in checks.frequencies_hz.expect("modes").iter().zip(&whole).take(5) {
            let error = own / f - 1.0;
            assert!((-1e-6..tolerance).contains(&error), "{modes} modes: {own} for {f} Hz");
        }
        assert_close(checks.mass.expect("places")[0], assembled.mass, 1e-12, 0.0, "mass");
        assert_close(checks.polar_inertia.expect("places"), inertia, 1e-12, 0.0, "inertia");
    }
}

/// By closed forms: mass rho A L, centre in the middle, inertia about the axis of the masses at the nodes, G J/L of torsion, six rigid modes; the same in mm, t and s, and with the axis along x.
#[test]
fn a_bar_is_what_it_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let bar = bar();
    let (area, second) = (std::f64::consts::PI * 0.05f64.powi(2) / 4.0, std::f64::consts::PI * 0.05f64.powi(4) / 64.0);
    let mm = |u: &Unknown| if u.component < 4 { 1e-3 } else { 1.0 };
    for (units, how) in
        [(UnitSystem::Si, (1.0, 1.0, &(|_: &Unknown| 1.0) as &dyn Fn(&Unknown) -> f64)), (UnitSystem::MmTonne, (1e3, 1e3, &mm))]
    {
        written(folder.path(), &bar, how);
        let found = structure(&MatrixFiles { units, ..files(folder.path(), ["k.mtx", "m.mtx"]) }).unwrap_or_else(|e| panic!("{e}"));
        close(&found.stiffness, &bar.stiffness, 1e-12, "stiffness");
        close(found.mass.as_ref().expect("a mass"), bar.mass.as_ref().expect("a mass"), 1e-12, "mass");
        let checks = found.checks();
        assert_eq!(checks.rigid_modes, Some(6));
        checks.mass.expect("places").iter().for_each(|m| assert_close(*m, 7850.0 * area, 1e-12, 0.0, "mass"));
        assert!((checks.centre.expect("places") - Vector3::new(0.0, 0.0, 0.5)).amax() < 1e-12);
        assert_close(checks.polar_inertia.expect("places"), 2.0 * 7850.0 * second, 1e-12, 0.0, "inertia");
        assert_close(checks.torsional_stiffness.expect("ends"), 2.05e11 / 2.6 * 2.0 * second, 1e-9, 0.0, "torsion");
        assert!(checks.rigid_residual.expect("places") < 1e-12);
    }
    // the crank along x: x becomes z
    let along_x = bar.along(CrankAxis::Y);
    assert_eq!(along_x.along(CrankAxis::X), bar, "one way and back");
    assert!(along_x.places.values().all(|p| p.y == 0.0 && p.z == 0.0));
    written(folder.path(), &along_x, (1.0, 1.0, &|_| 1.0));
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (k, m, dof, nodes) = (at("k.mtx"), at("m.mtx"), at("unknowns.dof"), at("nodes.csv"));
    let all = [k.as_str(), "--mass", &m, "--dof", &dof, "--nodes", &nodes];
    let (code, told) = hartog(&[&all[..], &["--axis", "x"]].concat());
    assert!(code == 0 && told.contains("0, 0, 0.500000 m"), "{told}");
    let (code, told) = hartog(&all);
    assert!(code == 1 && told.contains("is that the axis of the crank (axis)?"), "{told}");
}

/// A bar and the crank of the six in every format, there and back: to 1e-12, of DMIG to 1e-9, whose fields of 16 characters hold ten digits. A substructure has no mass.
#[test]
fn every_format_round_trips() {
    let folder = tempfile::tempdir().expect("a folder");
    let bar = bar();
    written(folder.path(), &bar, (1.0, 1.0, &|_| 1.0));
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (k, m, dof, nodes) = (at("k.mtx"), at("m.mtx"), at("unknowns.dof"), at("nodes.csv"));
    let own = [k.as_str(), "--mass", &m, "--dof", &dof, "--nodes", &nodes];
    let crank = ["studies/villalva_i6_flexible.toml", "--modes", "3"];
    let mut cranks: Vec<Structure> = Vec::new();
    for format in FORMATS {
        let tolerance = if format == "dmig" { 1e-9 } else { 1e-12 };
        for (name, arguments) in [("bar", &own[..]), ("crank", &crank[..])] {
            let out = folder.path().join(format!("{name}_{format}"));
            let (code, told) = hartog(&[arguments, &["--to", format, "--out", &out.to_string_lossy()]].concat());
            assert_eq!(code, 0, "{told}");
            let names = match format {
                "calculix" => ["stiffness.sti", "mass.mas"],
                "dmig" => ["stiffness.pch", "mass.pch"],
                "op4" => ["stiffness.op4", "mass.op4"],
                _ => ["stiffness.mtx", "mass.mtx"],
            };
            let named = !["abaqus", "user_element", "dmig"].contains(&format);
            let read = MatrixFiles { unknowns: named.then(|| out.join("unknowns.dof")), ..files(&out, names) };
            let found = structure(&read).unwrap_or_else(|e| panic!("{format} {name}: {e}"));
            assert_eq!(found.mass.is_none(), format == "user_element");
            if name == "crank" {
                cranks.push(found);
                continue;
            }
            // Abaqus and DMIG name unknowns in their own sequence
            assert_eq!(found.unknowns, bar.unknowns, "{format}");
            close(&found.stiffness, &bar.stiffness, tolerance, format);
            found.mass.iter().for_each(|m| close(m, bar.mass.as_ref().expect("a mass"), tolerance, format));
        }
    }
    let first = cranks[0].clone();
    for (format, other) in FORMATS.iter().zip(&cranks) {
        let place = |u: &Unknown| other.unknowns.iter().position(|o| o == u).expect("an unknown");
        let order: Vec<usize> = first.unknowns.iter().map(place).collect();
        let sorted = DMatrix::from_fn(order.len(), order.len(), |i, j| other.stiffness[(order[i], order[j])]);
        close(&sorted, &first.stiffness, if *format == "dmig" { 1e-9 } else { 1e-12 }, format);
    }
}

/// A substructure that CalculiX wrote of a solid throw, its end faces rigid: twelve unknowns of four nodes, as its comments name them; a free throw, symmetric.
#[test]
fn a_substructure_of_calculix() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/matrices/sub_throw.mtx");
    let read = |units| {
        structure(&MatrixFiles { stiffness: path.clone(), mass: None, rotating: [None, None], unknowns: None, nodes: None, units })
            .unwrap_or_else(|e| panic!("{e}"))
    };
    let found = read(UnitSystem::MmTonne);
    let nodes: Vec<u64> = found.unknowns.iter().step_by(3).map(|u| u.node).collect();
    assert_eq!((found.unknowns.len(), nodes), (12, vec![4274, 4275, 4276, 4277]));
    assert_close(found.stiffness[(0, 0)], 0.774_930_057_047_1e11, 1e-13, 0.0, "N/m of N/mm");
    assert_close(read(UnitSystem::Si).stiffness[(3, 1)], -0.928_443_088_375_7e8, 1e-13, 0.0, "the second number of the fourth row");
}

/// A row of springs that only turn: its torsional stiffness is that of the springs in series, though four of the six rigid motions are none of its. Read in other units it lies within too little; held somewhere it has no torsional
/// stiffness to tell of; a negative spring is told of, whatever masses are.
#[test]
fn what_is_unlikely_is_told() {
    let springs = |count: usize, k: f64, ground: f64| {
        let mut stiffness = DMatrix::zeros(count, count);
        for i in 0..count - 1 {
            for (a, b, sign) in [(i, i, 1.0), (i + 1, i + 1, 1.0), (i, i + 1, -1.0), (i + 1, i, -1.0)] {
                stiffness[(a, b)] += sign * k;
            }
        }
        stiffness[(0, 0)] += ground;
        Structure {
            unknowns: (0..count).map(|i| Unknown { node: i as u64 + 1, component: 6 }).collect(),
            places: (0..count).map(|i| (i as u64 + 1, Vector3::new(0.0, 0.0, 0.1 * i as f64))).collect(),
            stiffness,
            mass: None,
            gyroscopic: None,
            turning: None,
        }
    };
    for count in [2, 3, 6, 11] {
        let found = springs(count, 5e5, 0.0).checks();
        assert_close(found.torsional_stiffness.expect("free"), 5e5 / (count - 1) as f64, 1e-9, 0.0, "springs in series");
        assert!(found.objections(None).is_empty() && found.mass.is_none() && found.centre.is_none());
    }
    assert_eq!(springs(4, 5e5, 1e5).checks().torsional_stiffness, None);
    let mut small = springs(4, 5e5, 0.0);
    small.places.values_mut().for_each(|p| *p *= 1e-3);
    assert!(matches!(small.checks().objections(None)[..], [Objection::Extent(_)]));
    assert!(springs(4, -5e5, 0.0).checks().objections(None).contains(&Objection::NegativeStiffness(3)));
}
