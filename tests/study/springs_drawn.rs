//! Springs of steel and pendulum masses by their dimensions in studies: searches, limits, order sheets.

use crate::construction::six;
use crate::support::assert_close;
use hartog::absorber::Absorber;
use hartog::analysis::Results;

/// Values of the first optimum.
fn found(results: &Results) -> (f64, Vec<f64>) {
    let optimum = &results.optima[0];
    (optimum.optimum.value(), optimum.design.absorbers[0].absorber.law().expect("a law").values())
}

const LEAVES: &str = "types = [\"leaf_springs\"]\nsize.ring_inertia_kg_m2.fixed = 0.076\nouter_diameter_mm.fixed = 270\nring_wall_mm.fixed = 20\nring_density_kg_m3.fixed = 7850\nyoungs_modulus_gpa.fixed = 206\nleaf_over_width.fixed = 0.8\ndamping_factor.fixed = 0.3\ndynamic_ratio.fixed = 1.4\nreference_frequency_hz.fixed = 150\n";

/// Law: where both can express the same, a search by dimensions ends where the search by figures does, to 1e-8: the thickness of leaves against the stiffness of `spring_pack`.
#[test]
fn leaves_end_where_their_stiffness_does() {
    let drawn = six(&format!("{LEAVES}springs.fixed = 24\nleaf_length_mm.fixed = 50\nleaf_thickness_mm.between = [0.5, 10]\n"), "");
    let figures = six(
        "types = [\"spring_pack\"]\nsize.ring_inertia_kg_m2.fixed = 0.076\ndamping_factor.fixed = 0.3\ndynamic_ratio.fixed = 1.4\nreference_frequency_hz.fixed = 150\nstiffness_n_m_per_rad.between = [1e3, 1e7]\n",
        "",
    );
    let [(a, own), (b, of_figures)] = [drawn, figures].map(|s| found(&s.run().expect("damped")));
    assert_close(a, b, 1e-8, 0.0, "peak");
    let law = (hartog::absorber::LEAF_SPRINGS.build)(&own);
    assert_close(law.parts().expect("drawn").factor, of_figures[1], 1e-4, 0.0, "stiffness");
}

/// The same of the active coils of springs and their damper against `tuned`.
#[test]
fn coils_end_where_their_stiffness_does() {
    let drawn = six(
        "types = [\"coil_springs\"]\nsize.ring_inertia_kg_m2.fixed = 0.076\nouter_diameter_mm.fixed = 300\nring_wall_mm.fixed = 15\nring_density_kg_m3.fixed = 7850\nsprings.fixed = 6\nwire_diameter_mm.fixed = 12\nspring_index.fixed = 4\nactive_coils.between = [1, 6]\nshear_modulus_gpa.fixed = 79\n",
        "",
    );
    let figures = six("types = [\"tuned\"]\nsize.ring_inertia_kg_m2.fixed = 0.076\n", "");
    let [(a, own), (b, of_figures)] = [drawn, figures].map(|s| found(&s.run().expect("damped")));
    assert_close(a, b, 1e-8, 0.0, "peak");
    let law = (hartog::absorber::COIL_SPRINGS.build)(&own);
    assert_close(law.parts().expect("drawn").factor, of_figures[1], 1e-4, 0.0, "stiffness");
    assert_close(own[9], of_figures[2], 1e-4, 0.0, "damping");
}

/// The same of the path of pendulum masses and their damping against the order of `pendulum`, whose hub has their inertia about their own centres.
#[test]
fn masses_end_where_their_order_does() {
    let masses = "types = [\"pendulum_masses\"]\nsize.ring_inertia_kg_m2.fixed = 0.03\nouter_diameter_mm.fixed = 270\nmass_height_mm.fixed = 50\nmasses.fixed = 4\nfilled_share.fixed = 0.8\nring_density_kg_m3.fixed = 7850\npath_radius_mm.between = [0.8, 60]\n";
    let drawn = six(masses, "").run().expect("damped");
    let (a, own) = found(&drawn);
    let law = (hartog::absorber::PENDULUM_MASSES.build)(&own);
    let parts = law.parts().expect("drawn");
    let figures =
        six(&format!("types = [\"pendulum\"]\nsize.ring_inertia_kg_m2.fixed = 0.03\nhub_inertia_kg_m2 = {}\n", parts.hub_inertia), "");
    let (b, of_figures) = found(&figures.run().expect("damped"));
    assert_close(a, b, 1e-8, 0.0, "peak");
    assert_close(parts.factor.sqrt(), of_figures[1], 1e-4, 0.0, "order");
    let sheet = &drawn.sheets[0];
    let swing = sheet.swing.expect("a swing");
    let twist = drawn.optima[0].design.loads[0].ring_twist;
    assert_close(swing.arc, parts.radius * twist, 1e-6, 0.0, "arc");
    assert_close(4.0 * swing.each, sheet.mass, 1e-12, 0.0, "masses");
    assert_close(swing.tuning_order, of_figures[1], 1e-4, 0.0, "order on the sheet");
    assert_eq!((sheet.strain, sheet.stress, sheet.static_stiffness, sheet.on_held_hub), (None, None, None, None));
}

/// Law: a search holds the stress by the dimensions, to the 1e-6 that a limit is held to, where the free one does not; both stand on the sheet as 3 E t r/(2 L²) times the twist of the ring. Of three numbers of leaves the most are taken: of the same stiffness, they are thinner, and bear less.
#[test]
fn stress_of_leaves_is_held() {
    let leaves = format!("{LEAVES}springs.each = [18, 24, 30]\nleaf_length_mm.fixed = 50\nleaf_thickness_mm.between = [1, 6]\n");
    let limited = |most: f64| {
        let limits = format!(
            "[[constraint]]\nspring_stress = {{ absorber = 1, max_mpa = {most} }}\n[[constraint]]\nmass = {{ max_kg = 40 }}\n[[constraint]]\nenvelope = {{ absorber = 1, bore_mm = 60, width_mm = 80 }}\n"
        );
        six(&leaves, &limits).run().expect("damped")
    };
    let stress = |r: &Results| {
        let d = &r.optima[0].design;
        let (law, twist) = (d.absorbers[0].absorber.law().expect("a law"), d.loads[0].ring_twist);
        let v = law.values();
        let (slot, length, thickness) = (0.5 * v[1] - v[2], v[4], v[5]);
        let by_formula = 1.5 * 206e3 * thickness * slot / (length * length) * twist;
        assert_close(r.sheets[0].stress.expect("springs") * 1e-6, by_formula, 1e-6, 0.0, "stress on the sheet");
        by_formula
    };
    let free = limited(1e5);
    let most = 0.8 * stress(&free);
    let held = limited(most);
    assert_close(stress(&held), most, 1e-4, 0.0, "the limit is used up");
    assert!(held.optima[0].design.limits.iter().all(|l| *l <= 1.0 + 1e-6), "{:?}", held.optima[0].design.limits);
    assert!(held.optima[0].optimum.value() > free.optima[0].optimum.value());
    let of = |key: &str| held.sheets[0].dimensions.iter().find(|d| d.0 == key).expect("a dimension").1;
    assert_eq!(of("springs"), 30.0);
    let sheet = &held.sheets[0];
    assert!(sheet.spring_mass.is_some_and(|m| m > 0.0) && sheet.sheared_mass.is_none() && sheet.strain.is_none());
    assert_close(sheet.static_stiffness.expect("springs"), sheet.parts.factor, 1e-12, 0.0, "static stiffness");
    assert!(matches!(held.optima[0].design.absorbers[0].absorber, Absorber::Ring(_)));
}
