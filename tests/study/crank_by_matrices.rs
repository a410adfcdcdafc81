//! A crank by matrices of another program in an engine file: written by hartog, read again, and what is refused.

use crate::matrices::hartog;
use hartog::input::{InputError, Study};
use std::fs;
use std::path::{Path, PathBuf};

/// Nodes of the exported six.
const ROLES: &str = "hub = 1\nflywheel = 92\npins = [[12], [26], [40], [54], [68], [82]]\njournals = [[4, 5, 6], [18, 19, 20], [32, 33, 34], [46, 47, 48], [60, 61, 62], [74, 75, 76], [88, 89, 90]]\n";

/// A folder with the matrices of the six, free, with so many modes, and a study of it.
fn written(folder: &Path, modes: &str, format: &str) -> PathBuf {
    let out = folder.join("matrices").to_string_lossy().into_owned();
    let (code, told) = hartog(&["studies/villalva_i6_flexible.toml", "--modes", modes, "--to", format, "--out", &out]);
    assert!(code == 0 && told.contains("hub = 1, flywheel = 92, pins = [[12], [26]"), "{told}");
    let path = folder.join("study.toml");
    let text = "engine = \"engine.toml\"\nspeed_rpm = { from = 1000, to = 3000, step = 1000 }\norder_limit = 3\ncrank = \"flexible\"\n[[design]]\nname = \"none\"\n";
    fs::write(&path, text).expect("written");
    path
}

/// The engine file with matrices in the place of beams.
fn engine(folder: &Path, files: &str, roles: &str) {
    let text = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/studies/engines/villalva_i6.toml")).expect("an engine");
    let (start, end) = (text.find("[crank.flexible]").expect("flexible"), text.find("[[station]]").expect("stations"));
    let own = "[crank.flexible]\nloss_factor = 0.01\nbearing = { stiffness_n_per_m = 1.2e9, damping_n_s_per_m = 9e4 }\nthrust_bearing = { bearing = 4, stiffness_n_per_m = 5e8, damping_n_s_per_m = 1e5 }\n[crank.flexible.matrices]\n";
    fs::write(folder.join("engine.toml"), format!("{}{own}{files}{roles}\n{}", &text[..start], &text[end..])).expect("written");
}

fn names(ending: [&str; 4]) -> String {
    let [k, m, g, t] = ending;
    format!(
        "stiffness = \"matrices/stiffness.{k}\"\nmass = \"matrices/mass.{m}\"\ngyroscopic = \"matrices/gyroscopic.{g}\"\nturning = \"matrices/turning.{t}\"\ndof = \"matrices/unknowns.dof\"\nnodes = \"matrices/nodes.csv\"\nunits = \"si\"\n"
    )
}

/// In each format that holds all matrices the crank is the one that was written: its twist without absorber is that of the beams to 1 % (nothing but Guyan's reduction and the pull of the rods lies between), and that of the first
/// format to 1e-6. Its remarks tell that its torsion is stiffer than the chain's or softer, of which the beams' crank is, too.
#[test]
fn a_crank_is_read_where_it_was_written() {
    let twist = |study: &Study| study.run().expect("results").designs[0].twist.as_ref().expect("a twist").value;
    let mut beams = Study::read("studies/villalva_i6_flexible.toml").expect("a study");
    (beams.optimise, beams.front, beams.fatigue) = (None, None, None);
    beams.more_objectives.clear();
    beams.conditions.clear();
    beams.duty.clear();
    beams.designs.retain(|d| d.name == "none");
    (beams.speeds_rpm, beams.order_limit) = (vec![1000.0, 2000.0, 3000.0], 3.0);
    let wanted = twist(&beams);
    let mut first = None;
    for (format, endings) in [("matrix_market", ["mtx"; 4]), ("calculix", ["sti", "mas", "mtx", "mtx"]), ("dmig", ["pch"; 4])] {
        let folder = tempfile::tempdir().expect("a folder");
        let path = written(folder.path(), "0", format);
        engine(folder.path(), &names(endings), ROLES);
        let study = Study::read(&path).unwrap_or_else(|e| panic!("{format}: {e}"));
        let found = twist(&study);
        assert!((found / wanted - 1.0).abs() < 1e-2, "{format}: {found} for {wanted}");
        let own = *first.get_or_insert(found);
        assert!((found / own - 1.0).abs() < 1e-6, "{format}: {found} for {own}");
    }
}

/// What is to be known of matrices is told: that they are large, and that journals of one point say nothing of torque.
#[test]
fn what_matrices_do_not_say_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = written(folder.path(), "120", "matrix_market");
    let told = |roles: &str| {
        engine(folder.path(), &names(["mtx"; 4]), roles);
        Study::read(&path).unwrap_or_else(|e| panic!("{e}")).remarks.join("\n")
    };
    let found = told(ROLES);
    assert!(found.contains("has 227 unknowns") && !found.contains("do not rotate"), "{found}");
    let found = told(&ROLES.replace("[18, 19, 20]", "[19]"));
    assert!(found.contains("outer points of the main journals 2 do not rotate about the axis"), "{found}");
}

/// What cannot be is refused with the node, the throw or the number that it is about.
#[test]
fn what_does_not_fit_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = written(folder.path(), "0", "matrix_market");
    let files = names(["mtx"; 4]);
    let refused = |files: &str, roles: &str| -> String {
        engine(folder.path(), files, roles);
        let error: InputError = Study::read(&path).expect_err("refused");
        error.to_string()
    };
    let cases = [
        ("pins = [[12], [26],", "pins = [[26], [12],", "node 26 does not lie before node 18 along z"),
        ("[68], [82]]", "[68]]", "5 throws with pins, where the crank has 6"),
        ("[88, 89, 90]]", "[88, 89, 91]]", "node 91, a point of a journal, has no component 1"),
        ("hub = 1", "hub = 4", "node 4, the hub, has no component 4"),
        ("hub = 1\nflywheel = 92", "hub = 92\nflywheel = 1", "node 92 does not lie before node 4 along z"),
        ("pins = [[12], [26]", "pins = [[12], [19]", "node 20 does not lie before node 19"),
        ("[18, 19, 20]", "[20, 19, 18]", "node 20 does not lie before node 19 along z"),
        ("[18, 19, 20], [32, 33, 34]", "[32, 33, 34], [18, 19, 20]", "does not lie before node"),
        ("[46, 47, 48]", "[46, 47]", "main journal 4 has 2 nodes, expected an odd number"),
        ("[18, 19, 20]", "[26]", "node 26 does not lie before node 26"),
        (", [88, 89, 90]]", "]", "6 main journals, where the crank has 7"),
        ("[[12], [26]", "[[12, 26, 40], [26]", "throw 1 has 3 nodes for its 1 rods"),
        ("[4, 5, 6]", "[]", "main journal 1 has 0 nodes, expected an odd number"),
    ];
    for (from, to, expected) in cases {
        assert!(ROLES.contains(from), "{from}");
        let found = refused(&files, &ROLES.replace(from, to));
        assert!(found.contains(expected), "{to}: {found}");
    }
    let found = refused(&files.replace("\"si\"", "\"mm_t\""), ROLES);
    assert!(found.contains("its nodes lie within 0.000861 m"), "{found}");
    let found = refused(&files.replace("matrices/mass", "matrices/stiffness"), ROLES);
    assert!(found.contains("its mass matrix is not positive definite"), "{found}");
    let found = refused(&(files.clone() + "axis = \"x\"\n"), ROLES);
    assert!(found.contains("`turning` has -105.19, "), "centrifugal forces tell the axis: {found}");
    // what turning axes do to rigid translation tells matrices that are not meant
    let found = refused(&files.replace("matrices/turning", "matrices/mass"), ROLES);
    assert!(
        found.contains("`turning` has 105.19, 105.19 and 105.19 kg against translation along x, y and z, expected minus the mass"),
        "{found}"
    );
    let gyroscopic = folder.path().join("matrices/gyroscopic.mtx");
    let text = fs::read_to_string(&gyroscopic).expect("a matrix");
    let negative = |l: &str| match l.split(' ').collect::<Vec<_>>()[..] {
        [i, j, x] if !l.starts_with('%') && x.contains('e') => format!("{i} {j} {:e}", -x.parse::<f64>().expect("a number")),
        _ => l.to_owned(),
    };
    fs::write(&gyroscopic, text.lines().map(negative).collect::<Vec<_>>().join("\n")).expect("written");
    let found = refused(&files, ROLES);
    assert!(found.contains("`gyroscopic` has -210.38 kg between translations along y and x, expected twice the mass, 210.38"), "{found}");
    fs::write(&gyroscopic, text).expect("written");
    // half a turn of one throw: another firing order
    let nodes = folder.path().join("matrices/nodes.csv");
    let text = fs::read_to_string(&nodes).expect("nodes");
    let turned: Vec<String> = text
        .lines()
        .map(|l| match l.split(',').collect::<Vec<_>>()[..] {
            ["26", x, y, z] => format!("26,{:e},{:e},{z}", -x.parse::<f64>().expect("x"), -y.parse::<f64>().expect("y")),
            _ => l.to_owned(),
        })
        .collect();
    fs::write(&nodes, turned.join("\n")).expect("written");
    let found = refused(&files, ROLES);
    assert!(found.contains("motion as a rigid body meets a stiffness"), "{found}");
}
