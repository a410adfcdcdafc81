//! A chain from the dimensions of its shafts and throws.

use crate::support::assert_close;
use hartog::Study;
use hartog::drivetrain::throw_inertia::{Masses, Sector, throw_inertia, throw_unbalance};
use hartog::drivetrain::throw_stiffness::{Step, Throw, ThrowFormula, stepped_shaft};
use std::f64::consts::PI;
use std::fs;
use std::path::Path;

const STEEL: f64 = 79.3e9;

/// By hand: 100 mm of 50 mm and 60 mm of 40 mm bored 20 mm in series. F = 0.1/0.05⁴ + 0.06/(0.04⁴ - 0.02⁴) = 16000 + 25000 1/m³.
#[test]
fn a_stepped_shaft_by_hand() {
    let steps = [Step { diameter: 0.05, bore: 0.0, length: 0.1 }, Step { diameter: 0.04, bore: 0.02, length: 0.06 }];
    assert_close(stepped_shaft(&steps, STEEL), PI * STEEL / (32.0 * 41000.0), 1e-12, 0.0, "N m/rad");
}

/// A throw of the in-line six of [Villalva 2014], lengths in mm: pin 69 x 46, journal 83 x 42.4, web 15.8 x 101.9, radius 62.
fn throw() -> Throw {
    let step = |diameter: f64, length: f64| Step { diameter: diameter * 1e-3, bore: 0.0, length: length * 1e-3 };
    Throw { pin: step(69.0, 46.0), journal: step(83.0, 42.4), radius: 0.062, web_thickness: 0.0158, web_breadth: 0.1019 }
}

/// By hand, with 83⁴ = 47 458 321, 69⁴ = 22 667 121 and 15.8 x 101.9³ = 16 718 007 mm⁴:
/// Ker Wilson 75.6/83⁴ + 73.6/69⁴ + 31.6/hW³ = 6.7301e-6 mm⁻³; Carter 55.04/83⁴ + 34.5/69⁴ + 93/hW³ = 8.2446e-6;
/// Zimanenko 60.9573/83⁴ + 64.0827/69⁴ + 62 sqrt(62/69)/hW³ = 7.6270e-6. The printed stiffness between throws, 1.27e6 N m/rad by finite elements, is above all.
#[test]
fn a_throw_by_hand() {
    for (formula, by_hand) in [(ThrowFormula::KerWilson, 6.7301e3), (ThrowFormula::Carter, 8.2446e3), (ThrowFormula::Zimanenko, 7.6270e3)] {
        assert_close(formula.flexibility(&throw()), by_hand, 1e-4, 0.0, formula.name());
        assert!((0.9e6..1.27e6).contains(&formula.stiffness(&throw(), STEEL)), "{}", formula.name());
    }
    assert!(ThrowFormula::Bracket.out_of_range(&throw()).is_some(), "its pin and journal overlap by 14 mm");
}

/// Without overlap: pin and journal of 40 mm, radius 60 mm, web 20 x 60: F = 0.03/0.04⁴ + 0.035/0.04⁴ + (3 pi/8)/1.3 0.06/(0.02 0.06³), and the web's
/// angle 2 T R/(E h W³/12) directly. Both sides of the limits of the ranges.
#[test]
fn the_bracket_and_the_ranges() {
    let round = |length: f64| Step { diameter: 0.04, bore: 0.0, length };
    let mut t = Throw { pin: round(0.035), journal: round(0.03), radius: 0.06, web_thickness: 0.02, web_breadth: 0.06 };
    let (young, shear) = (206e9, 206e9 / 2.6);
    let shafts = 32.0 * 0.065 / (PI * shear * 0.04f64.powi(4));
    let webs = 2.0 * 0.06 / (young * 0.02 * 0.06f64.powi(3) / 12.0);
    assert_close(ThrowFormula::Bracket.stiffness(&t, shear), 1.0 / (shafts + webs), 1e-12, 0.0, "bracket");
    assert!(ThrowFormula::Bracket.out_of_range(&t).is_none());
    t.radius = 0.0401;
    assert!(ThrowFormula::Bracket.out_of_range(&t).is_none());
    t.radius = 0.0399;
    assert!(ThrowFormula::Bracket.out_of_range(&t).is_some());
    for (radius, holds) in [(0.0161, true), (0.016, false)] {
        t.radius = radius;
        assert_eq!(ThrowFormula::KerWilson.out_of_range(&t).is_none(), holds, "R of {radius} against 0.2 (D_p + D_j) = 0.016");
    }
}

/// By hand, density 7850: pin 40 x 35 mm (0.34526 kg) at 60 mm, journal 40 x 30 mm, two webs of 20 x 60 x 110 mm (1.0362 kg) at 25 mm, two half rings of 30 to
/// 80 mm, 20 mm thick; a flange of 80 x 10 mm with a cut of 30 x 10 mm; 0.5 kg of rods.
#[test]
fn inertia_and_unbalance_by_hand() {
    let round = |diameter: f64, length: f64| Step { diameter, bore: 0.0, length };
    let t = Throw { pin: round(0.04, 0.035), journal: round(0.04, 0.03), radius: 0.06, web_thickness: 0.02, web_breadth: 0.06 };
    let masses = Masses {
        density: 7850.0,
        web_height: 0.11,
        web_centre: 0.025,
        counterweight: Some(Sector { outer_radius: 0.08, inner_radius: 0.03, angle: PI, thickness: 0.02 }),
        rings: vec![(round(0.08, 0.01), false), (round(0.03, 0.01), true)],
    };
    let pin = 0.345_261 * (0.02f64.powi(2) / 2.0 + 0.06f64.powi(2));
    let journal = 0.295_938 * 0.02f64.powi(2) / 2.0;
    let webs = 2.0 * 1.0362 * ((0.06f64.powi(2) + 0.11f64.powi(2)) / 12.0 + 0.025f64.powi(2));
    let rings = 2.0 * 7850.0 * 0.02 * PI / 4.0 * (0.08f64.powi(4) - 0.03f64.powi(4));
    let flange = 7850.0 * 0.01 * PI / 32.0 * (0.08f64.powi(4) - 0.03f64.powi(4));
    let expected = pin + journal + webs + rings + flange + 0.5 * 0.0036;
    assert_close(throw_inertia(&t, &masses, 0.5), expected, 1e-5, 0.0, "kg m²");
    // a half ring has its first moment 2/3 (R³ - r³) t
    let unbalance = 0.345_261 * 0.06 + 2.0 * (1.0362 * 0.025 - 7850.0 * 0.02 * 2.0 / 3.0 * (0.08f64.powi(3) - 0.03f64.powi(3)));
    assert_close(throw_unbalance(&t, &masses), unbalance, 1e-4, 0.0, "kg m");
}

/// An engine file that leaves its throws to the crank's dimensions; what a station gives wins.
#[test]
fn an_engine_file_without_stiffnesses() {
    let folder = tempfile::tempdir().expect("folder");
    let bad = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_input");
    let text = fs::read_to_string(bad.join("crank_engine.toml")).expect("engine");
    let crank = "stiffness_formula = \"carter\"\nmasses = { density_kg_m3 = 7850, web_height_mm = 110, web_centre_mm = 25 }\n";
    let (head, _) = text.split_at(text.find("[[station]]").expect("station"));
    let stations = "[[station]]\nname = \"hub\"\ninertia_kg_m2 = 0.01\nshaft_to_next = [{ diameter_mm = 40, length_mm = 60 }]\n\
        [[station]]\nname = \"throw_1\"\nthrows = [1]\ndamping_to_ground_n_m_s_per_rad = 1\n\
        [[station]]\nname = \"throw_2\"\nthrows = [2]\ndamping_to_ground_n_m_s_per_rad = 1\nstiffness_to_next_n_m_per_rad = 4e5\n\
        [[station]]\nname = \"flywheel\"\ninertia_kg_m2 = 0.3\n";
    fs::write(folder.path().join("engine.toml"), format!("{head}{crank}{stations}")).expect("written");
    let study = fs::read_to_string(bad.join("crank_study.toml")).expect("study");
    let study = Study::from_toml(&study, folder.path().join("study.toml")).unwrap_or_else(|e| panic!("{e}"));
    let crank = study.crank.as_ref().expect("crank");
    let shear = 206e9 / 2.6;
    let whole = ThrowFormula::Carter.stiffness(&crank.throw(0), shear);
    let nose = stepped_shaft(&[Step { diameter: 0.04, bore: 0.0, length: 0.06 }], shear);
    let chain = &study.chain.stations;
    assert_close(chain[0].stiffness_to_next, 1.0 / (0.5 / whole + 1.0 / nose), 1e-12, 0.0, "half a throw and the nose");
    assert_close(chain[1].stiffness_to_next, whole, 1e-12, 0.0, "from throw to throw");
    assert_close(chain[2].stiffness_to_next, 4e5, 0.0, 0.0, "given");
    // rods turn with the pin: 0.667 of 0.6 kg at 40 mm; the mean of the reciprocating masses is added, since inertias are derived
    let own = throw_inertia(&crank.throw(0), crank.masses.as_ref().expect("masses"), 0.667 * 0.6);
    let reciprocating = 0.5 * (0.5 + 0.333 * 0.6) * 0.04 * 0.04;
    assert!(study.reciprocating.mean && !study.reciprocating.stated);
    assert_close(chain[1].inertia, own + reciprocating, 1e-12, 0.0, "inertia");
}
