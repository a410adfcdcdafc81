//! Catalogues of compounds and oils.

use crate::support::{assert_close, study, variant};
use std::f64::consts::PI;

/// Source: the closed forms of a gap all round a ring and of a sleeve, worked by hand: a row of oil or rubber with a shape is the damper or spring that viscosity or modulus make there, of the oils of the shipped
/// table and of compounds and oils in one table; what cannot be made of a row is refused by its cell.
#[test]
fn catalogues_of_materials() {
    let s = study("villalva_i6_oils");
    let (r1, r2, w, gap) = (0.075f64, 0.125f64, 0.03f64, 0.4e-3f64);
    let sleeve = |a: f64, b: f64| 4.0 * PI * w * a * a * b * b / (b * b - a * a);
    let shape = PI * (r2.powi(4) - r1.powi(4)) / gap + sleeve(r2, r2 + gap) + sleeve(r1 - gap, r1);
    for d in &s.catalogues[0].designs {
        let grade: f64 = d.name.trim_start_matches("oil_").parse().expect("a grade");
        let values = d.absorbers[0].absorber.law().expect("a law").values();
        assert_close(values[0], 0.076, 1e-15, 0.0, "ring");
        assert_close(values[1], shape * grade * 1e-6 * 970.0, 1e-12, 0.0, &d.name);
        assert_close(values[2], grade * 1e-6 * 970.0 * 4e-5, 1e-3, 0.0, "relaxation time as the table says that it is made");
    }
    let folder = tempfile::tempdir().expect("folder");
    let shaped = |table: &str| {
        std::fs::create_dir_all(folder.path().join("absorbers")).expect("writable");
        std::fs::write(folder.path().join("absorbers/oils.csv"), table).expect("writable");
        let sleeve = "geometry.sleeve = { inner_diameter_mm = 230, outer_diameter_mm = 246, length_mm = 60 }";
        let gap = "geometry.gap = { inner_diameter_mm = 150, outer_diameter_mm = 250, width_mm = 30, gap_mm = 0.4 }";
        hartog::input::read(&variant(folder.path(), "villalva_i6_oils", &[(gap, sleeve)]))
    };
    let header = "name,type,shear_modulus_mpa,loss_factor,viscosity_mm2_per_s,density_kg_per_m3\n";
    let both = shaped(&format!("{header}a,rubber,0.8,0.2,,\nb,viscous,,,30000,970\n")).expect("a catalogue");
    let of = |i: usize| both.catalogues[0].designs[i].absorbers[0].absorber.law().expect("a law").values();
    let shape = 4.0 * PI * 0.06 * (0.115f64 * 0.123).powi(2) / (0.123f64.powi(2) - 0.115f64.powi(2));
    assert_close(of(0)[1], 0.8e6 * shape, 1e-12, 0.0, "k of rubber");
    assert_close(of(1)[1], 30000e-6 * 970.0 * shape, 1e-12, 0.0, "c of oil");
    for (row, what) in [
        ("a,rubber,-0.8,0.2,,", "found -0.8, expected a number above zero"),
        ("a,rubber,,0.2,,", "found an empty cell"),
        ("a,viscous,,,30000,", "found an empty cell"),
        ("a,rubber,0.8,0.2,30000,", "expected an empty cell: `rubber` has no `viscosity_mm2_per_s`"),
    ] {
        let error = shaped(&format!("{header}{row}\n")).expect_err(row).to_string();
        assert!(error.contains(what), "{row}: {error}");
    }
}
