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

/// Rows of a catalogue with a material are ranked as given designs of the same material are judged, cold, hot and in operation; a limit on the temperature holds for what is tuned anew, and is refused where no row says what cools it.
#[test]
fn rows_follow_temperature() {
    let folder = tempfile::tempdir().expect("folder");
    let engine = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/engines/villalva_i6.toml");
    let material = "temperature.exponential = { per_k = 0.006, reference_c = 40, between_c = [-30, 120] }\n\
                    cooling = { air_c = 50, hub_c = 80, to_air.disc = { diameter_mm = 170, width_mm = 30 }, to_hub_w_per_k = 1.5, limit_c = 120 }\n";
    let study = |of_rows: &str, limit: &str| {
        std::fs::write(folder.path().join("c.csv"), ROWS).expect("writable");
        let text = format!(
            "engine = '{}'\nspeed_rpm = {{ from = 800, to = 3200, step = 50 }}\norder_limit = 6\nconditions = [\"cold\", \"hot\"]\n\
             temperatures = {{ cold_c = -20, hot_c = 90 }}\n[[objective]]\npeak_twist = {{ from = \"pulley\", to = \"flywheel\" }}\n{limit}\
             [[design]]\nname = \"given\"\n[[design.absorber]]\non.station = \"pulley\"\n\
             type.rubber = {{ ring_inertia_kg_m2 = 0.04, stiffness_n_m_per_rad = 30000, loss_factor = 0.2 }}\n[design.absorber.material]\n{material}\
             [[catalogue]]\nfile = \"c.csv\"\non.station = \"pulley\"\nbest = 2\nfree = {{ stiffness_n_m_per_rad = 0.4 }}\n{of_rows}",
            engine.display()
        );
        hartog::input::Study::from_toml(&text, folder.path().join("study.toml"))
    };
    const ROWS: &str =
        "name,type,ring_inertia_kg_m2,stiffness_n_m_per_rad,loss_factor\nr1,rubber,0.04,30000,0.2\nr2,rubber,0.04,60000,0.2\n";
    let with = format!("[catalogue.material.rubber]\n{material}");
    let limit = "[[constraint]]\ntemperature = { absorber = 1, max_c = 90 }\n";
    let results = study(&with, limit).unwrap_or_else(|e| panic!("{e}")).run().expect("damped");
    let design = |name: &str| results.designs.iter().find(|d| d.name == name).expect("shown");
    let (given, sold) = (design("given"), design("r1"));
    assert_eq!((given.objective, &given.limits), (sold.objective, &sold.limits));
    assert_eq!(given.conditions.len(), 3, "cold, hot and in operation");
    let ranked = results.catalogue.iter().find(|r| r.design == "r1").expect("ranked");
    assert_eq!((ranked.objective, ranked.over_limit), (sold.objective, sold.limits.iter().copied().fold(0.0, f64::max)));
    assert_eq!(ranked.nearest_limit, Some(0), "the limit that it breaks");
    assert!(!sold.within_limits() && design("r1_retuned").within_limits());
    let refused = |of_rows: &str, limit: &str, told: &str| {
        let error = study(of_rows, limit).expect_err(told).to_string();
        assert!(error.contains(told), "{error}");
    };
    refused("", limit, "cool");
    refused(&with.replace("rubber", "viscous"), "", "found a material of type `viscous`, expected one of rubber");
    refused(&format!("{with}properties.loss_factor.fixed = 0.2\n"), "", "found properties of the material of a catalogue");
    let shape = "geometry.sleeve = { inner_diameter_mm = 118, outer_diameter_mm = 130, length_mm = 25 }\n";
    refused(&format!("{shape}{with}{shape}"), "", "found what is sheared a second time");
}
