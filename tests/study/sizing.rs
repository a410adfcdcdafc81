//! Slider-crank sizing: worked examples of the literature, and what must hold of every section.

use crate::support::assert_close;
use hartog::fatigue::endurance::{Loading, fatigue_factor, notch_sensitivity};
use hartog::input::{SizingStudy, read_sizing};
use hartog::sizing::section::{Moments, Notch, Strength, Swing};
use hartog::sizing::{Bearings, Bending, Sizes, bodies, crank, eye, rod, size, stepped_shaft};
use std::collections::HashMap;
use std::path::Path;

/// `fialho_validation.csv`: the column `book_or_cad` of an example, by its quantity.
fn book(example: &str) -> HashMap<String, f64> {
    let mut reader = csv::Reader::from_path("studies/published/fialho_validation.csv").expect("a table");
    let rows = reader.records().map(|r| r.expect("a row"));
    rows.filter(|r| &r[1] == example).filter_map(|r| Some((r[3].to_owned(), r[5].parse().ok()?))).collect()
}

const MM: f64 = 1e-3;
const MPA: f64 = 1e6;

/// Source: example 10-1 of \[Norton 2013\], Tables 10 and 11: alternating bending, steady torsion; 1 % (the book rounds q to two digits).
#[test]
fn a_shaft_of_norton() {
    let b = book("norton_10_1");
    let tensile = b["tensile_strength"] * MPA;
    let factor = |kt: f64, torsion| fatigue_factor(kt, notch_sensitivity(b["notch_radius"] * MM, tensile, torsion));
    let notch = Notch { bending: factor(b["kt"], false), torsion: factor(b["kts"], true) };
    assert_close(notch.bending, b["kf"], 0.01, 0.0, "K_f");
    assert_close(notch.torsion, b["kfs"], 0.01, 0.0, "K_fs");
    let bending = Swing { mean: 0.0, amplitude: b["moment_amplitude"] * MM };
    let torsion = Swing { mean: b["torque_mean"] * MM, amplitude: 0.0 };
    let moments = Moments { bending: [bending, Swing::default()], torsion, ..Moments::default() };
    let strength = Strength { fatigue_limit: b["endurance_limit"] * MPA, tensile, shear_yield: tensile };
    let d = moments.fatigue_diameter(&strength, notch, b["safety_factor"]);
    assert_close(d / 0.0254, b["diameter_d2"], 0.01, 0.0, "d2");
    assert_close(moments.margins(&strength, notch, d)[1], b["safety_factor"], 1e-12, 0.0, "the margin of that diameter");
}

/// Source: example 25-4 of \[Bhandari 2010\], Tables 13 and 14 (the printed load is 188495.56 N): t = 7.53 mm; 1 %.
#[test]
fn a_rod_of_bhandari() {
    let b = book("bhandari_25_4");
    let t = rod::buckling_thickness(b["critical_load"], b["yield_strength"] * MPA, b["rod_length"] * MM);
    assert_close(t / MM, b["web_thickness_t"], 0.01, 0.0, "t");
    assert_close(5.0 * t / MM, b["section_height_h"], 0.01, 0.0, "height");
    assert_close(4.0 * t / MM, b["section_width_b"], 0.01, 0.0, "width");
    assert_close(rod::buckling_load(t, b["yield_strength"] * MPA, b["rod_length"] * MM), b["critical_load"], 1e-12, 0.0, "both ways");
}

/// Source: example 25-18 of \[Bhandari 2010\], Tables 15 and 16: reactions, crankpin, flywheel seat and journal for the forces at one crank angle, by the largest
/// shear; 1 %. The book's crankpin leaves out the bending by the tangential force; its journal diameter follows from its data as 54.85 mm, the printed 54.46 does not.
#[test]
fn a_crank_of_bhandari() {
    let b = book("bhandari_25_18");
    let bearings = Bearings {
        before: b["b1"] * MM,
        after: b["b2"] * MM,
        before_flywheel: b["c1"] * MM,
        after_flywheel: b["c2"] * MM,
        flywheel_weight: b["flywheel_weight"],
        belt_tension: b["belt_tension"],
    };
    let (before, after) = crank::shares(&bearings);
    for (share, end) in [(before, "r1"), (after, "r2")] {
        assert_close(share * b["radial_force"], b[&format!("{end}_radial")], 1e-4, 0.0, end);
        assert_close(share * b["tangential_force"], b[&format!("{end}_tangential")], 1e-4, 0.0, end);
    }
    let r = b["crank_radius"] * MM;
    let torque = vec![b["tangential_force"] * r];
    let supported = (&bearings, Bending::OwnBearings);
    let loads = |tangential: f64| crank::ThrowLoads {
        firing_deg: 0.0,
        radial: vec![-b["radial_force"]],
        tangential: vec![tangential],
        torque_before: vec![0.0],
        torque_after: torque.clone(),
    };
    let strength = Strength { fatigue_limit: 1.0, tensile: 1.0, shear_yield: b["allowable_shear"] * MPA };
    let pin = crank::crankpin(&[loads(b["tangential_force"])], 0, supported, r)[0];
    let [radial, tangential] = pin.bending.map(|s| s.mean);
    assert_close(tangential / radial, -b["tangential_force"] / b["radial_force"], 1e-12, 0.0, "both bend the pin");
    let without = Moments { largest: radial.hypot(pin.torsion.mean), ..pin };
    let d = without.static_diameter(&strength, 1.0);
    assert_close(d / MM, b["crankpin_diameter"], 0.01, 0.0, "crankpin");
    assert!(pin.static_diameter(&strength, 1.0) > 1.03 * d, "what the book leaves out");
    let sizes = Sizes { crankpin_length: b["crankpin_length"] * MM, web_thickness: 0.7 * d, ..Sizes::default() };
    assert_close(0.7 * d / MM, b["web_thickness"], 0.01, 0.0, "web thickness");
    assert_close(1.14 * d / MM, b["web_width"], 0.01, 0.0, "web breadth");
    let journal = crank::journals(&[loads(b["tangential_force"])], 0, supported, &sizes)[1].static_diameter(&strength, 1.0);
    assert_close(journal / MM, 54.85, 1e-3, 0.0, "journal, from the data");
    let seat = crank::seat(&torque, &bearings);
    assert_close(seat.static_diameter(&strength, 1.0) / MM, b["flywheel_shaft_diameter"], 0.01, 0.0, "flywheel seat");
}

/// Source: Tables 17 and 18 (D = 20 mm, d = 10 mm, r = 2 mm): 1.2676 by Norton's formula. Theory: no step, no concentration; sharper is worse.
#[test]
fn a_stepped_shaft() {
    let b = book("kt_torsion");
    let (radius, ratio) = (b["notch_radius"] / b["small_diameter"], b["large_diameter"] / b["small_diameter"]);
    assert_close(stepped_shaft::torsion(radius, ratio), b["kt"], 1e-3, 0.0, "K_t");
    for chart in [stepped_shaft::bending, stepped_shaft::torsion] {
        assert_eq!(chart(0.1, 1.0), 1.0);
        assert!(chart(0.01, 1.5) > chart(0.02, 1.5) && chart(0.3, 1.5) >= 1.0);
        assert_eq!(chart(0.5, 1.5), chart(stepped_shaft::LARGEST_RADIUS, 1.5));
        for i in 0..400 {
            let ratio = 1.0 + 0.02 * f64::from(i);
            assert!((chart(0.05, ratio + 1e-9) - chart(0.05, ratio)).abs() < 1e-6, "continuous at {ratio}");
        }
    }
}

/// Source: Tables 19 and 20. Assumptions under which the CAD values follow: density 7.80 g/cm³; the I-section carried up to the arcs of the eyes; eyes as wide as the
/// section; webs as long as throw and breadth together; journals of 17.5 mm (the span less crankpin and webs would leave 20); the rod's inertia is about its big end,
/// the crank's about its centre. 0.5 %, where the thesis's own rod is 3.3 % off.
#[test]
fn masses_against_cad() {
    let b = book("mass_properties");
    let mm = |name: &str| b[name] * MM;
    let sizes = Sizes {
        pin_diameter: mm("piston_pin_diameter"),
        shank_thickness: mm("rod_web_thickness"),
        small_eye_bore: mm("piston_pin_diameter"),
        small_eye_diameter: mm("small_eye_outer_diameter"),
        big_eye_bore: mm("crankpin_diameter"),
        big_eye_diameter: mm("big_eye_outer_diameter"),
        crankpin_diameter: mm("crankpin_diameter"),
        crankpin_length: mm("rod_beam_width"),
        journal_diameter: mm("journal_diameter"),
        web_thickness: mm("web_thickness"),
        web_breadth: mm("web_width"),
        seat_diameter: mm("journal_diameter"),
    };
    let (density, g, g_mm2) = (7800.0, 1e-3, 1e-9);
    let rod = bodies::rod(&sizes, mm("rod_length"), density);
    assert_close(rod.mass / g, b["rod_mass"], 0.005, 0.0, "mass of the rod");
    assert_close(rod.centre / mm("rod_length"), b["rod_cg_ratio"], 0.005, 0.0, "centre of the rod");
    assert_close(rod.inertia_at_reference / g_mm2, b["rod_inertia"], 0.005, 0.0, "inertia of the rod about its big end");
    let r = mm("crank_radius");
    let throw = bodies::throw(&sizes, [17.5 * MM; 2], r, density);
    assert_close(throw.mass / g, b["crank_mass"], 0.005, 0.0, "mass of the crank");
    assert_close(throw.centre / r, b["crank_cg_ratio"], 0.005, 0.0, "centre of the crank");
    assert_close(throw.inertia() / g_mm2, b["crank_inertia"], 0.005, 0.0, "inertia of the crank about its centre");
}

/// Independent: the ring cut at the top and at the side, its bending moment and normal force summed from the pressure in small steps, the moment from the condition that the
/// ends do not turn. Theory: thin rings tend to M = F R (1/2 - 4/pi²).
#[test]
fn an_eye_as_a_ring() {
    for ratio in [1.05, 1.3, 2.0, 3.0] {
        let (inner, outer) = (1.0, ratio);
        let (h, middle): (f64, f64) = (outer - inner, 0.5 * (outer + inner));
        let neutral = h / (outer / inner).ln();
        let e = middle - neutral;
        let n = 2000;
        let step = std::f64::consts::FRAC_PI_2 / f64::from(n);
        let at = |i: i32| (f64::from(i) + 0.5) * step;
        // F = 1: side at psi = pi/2 bears 1/2; pressure 2/pi cos psi per angle
        let sums = |psi: f64| {
            let (mut moment, mut normal) = (-0.5 * middle * (1.0 - psi.sin()), 0.5 * psi.sin());
            for at in (0..n).map(at).filter(|a| *a > psi) {
                let force = 2.0 / std::f64::consts::PI * at.cos() * step;
                moment += middle * force * (at - psi).sin();
                normal += force * (at - psi).sin();
            }
            (moment, normal)
        };
        let all: Vec<(f64, f64)> = (0..n).map(|i| sums(at(i))).collect();
        // the ends do not turn: sum of (M/e - N) vanishes for M = M1 + moment
        let (moment, normal) = all.iter().fold((0.0, 0.0), |a, b| (a.0 + b.0 * step, a.1 + b.1 * step));
        let side = (e * normal - moment) / std::f64::consts::FRAC_PI_2;
        let stress = 0.5 / h + side * (neutral - inner) / (h * e * inner);
        assert_close(eye::stress_concentration(ratio), stress * h * 2.0, 1e-3, 0.0, &format!("ratio {ratio}"));
        if ratio < 1.1 {
            assert_close(side, middle * (0.5 - 4.0 / std::f64::consts::PI.powi(2)), 0.01, 0.0, "a thin ring");
        }
    }
}

/// Printed rounds by their symbol.
fn printed() -> HashMap<String, Vec<f64>> {
    let mut reader = csv::Reader::from_path("studies/published/fialho_iterations.csv").expect("a table");
    let rows = reader.records().map(|r| r.expect("a row"));
    rows.map(|r| (r[0].to_owned(), r.iter().skip(1).map(|v| v.parse().expect("a number")).collect())).collect()
}

pub fn two_stroke() -> SizingStudy {
    read_sizing(Path::new("studies/fialho_two_stroke.toml")).expect("a sizing file")
}

/// Source: Table 26: masses and centres of all five rounds from the printed diameters of the same round, web 0.7 and 1.14 crankpin diameters. The throw to the digits
/// printed; the rod within 5 %, because its I-section reaches the arcs of the eyes here and their bores have the clearance. The inertia of the first throw is in Table 25.
#[test]
fn masses_of_the_printed_rounds() {
    let (p, spec) = (printed(), two_stroke().specification);
    for round in [0, 1, 2, 3, 4] {
        let of = |symbol: &str| p[symbol][round];
        let sizes = Sizes {
            pin_diameter: of("dpp") * MM,
            shank_thickness: of("tb") * MM,
            small_eye_bore: of("diome") * MM,
            small_eye_diameter: of("deome") * MM,
            big_eye_bore: of("dioma") * MM,
            big_eye_diameter: of("deoma") * MM,
            crankpin_diameter: of("dcp") * MM,
            crankpin_length: of("Bb") * MM,
            journal_diameter: of("dmp") * MM,
            web_thickness: 0.7 * of("dcp") * MM,
            web_breadth: 1.14 * of("dcp") * MM,
            seat_diameter: of("dfw") * MM,
        };
        let throw = bodies::throw(&sizes, bodies::journal_lengths(&sizes, &spec.bearings), spec.crank_radius(), spec.density);
        assert_close(throw.mass, of("m2"), 1e-3, 0.0, &format!("mass of throw {}", round + 1));
        assert_close(throw.centre / spec.crank_radius(), of("Cgv"), 1e-3, 0.0, &format!("centre of throw {}", round + 1));
        if round == 0 {
            assert_close(throw.inertia(), 0.000_232_6, 1e-3, 0.0, "inertia of the first throw, Table 25");
        }
        let rod = bodies::rod(&sizes, spec.rod_length, spec.density);
        assert_close(rod.mass, of("m3"), 0.05, 0.0, &format!("mass of rod {}", round + 1));
        assert_close(rod.centre / spec.rod_length, of("Cgb"), 0.05, 0.0, &format!("centre of rod {}", round + 1));
    }
}

/// Source: Table 26. Pin and rod of the last round within 2 %. The crank comes out thinner by 11 to 17 %. Why shows in the first round, which has no notch factors yet: its three diameters follow
/// within 2 % where the largest moment counts as amplitude and as mean, each in full instead of half, and where the tangential force bends nothing. (The pressure at dead centre is an
/// assumption made so that the crankpin does; journal and seat follow.)
#[test]
fn the_printed_two_stroke() {
    let (p, study) = (printed(), two_stroke());
    let spec = &study.specification;
    let sized = size(spec).expect("sizes");
    let last = sized.last();
    for (symbol, ours) in [
        ("B", spec.bore),
        ("l", spec.rod_length),
        ("tb", last.sizes.shank_thickness),
        ("dpp", last.sizes.pin_diameter),
        ("diome", last.sizes.small_eye_bore),
        ("deome", last.sizes.small_eye_diameter),
    ] {
        assert_close(ours / MM, p[symbol][4], 0.02, 0.0, symbol);
    }
    for (symbol, ours) in [("dcp", last.sizes.crankpin_diameter), ("dmp", last.sizes.journal_diameter), ("dfw", last.sizes.seat_diameter)] {
        let off = ours / MM / p[symbol][4] - 1.0;
        assert!((-0.17..-0.10).contains(&off), "{symbol}: {off}");
    }
    let (loads, supported) = (&sized.throws[0][..], (&spec.bearings, spec.bending));
    let first = |symbol: &str| p[symbol][0] * MM;
    let printed_sizes = Sizes { crankpin_length: first("Bb"), web_thickness: 0.7 * first("dcp"), ..Sizes::default() };
    let in_full = |s: Swing| Swing { mean: s.mean.abs() + s.amplitude, amplitude: s.mean.abs() + s.amplitude };
    for (symbol, moments) in [
        ("dcp", crank::crankpin(loads, 0, supported, spec.crank_radius())[0]),
        ("dmp", crank::journals(loads, 0, supported, &printed_sizes)[1]),
        ("dfw", crank::seat(&loads[0].torque_after, &spec.bearings)),
    ] {
        let so = Moments { bending: [in_full(moments.bending[0]), Swing::default()], torsion: in_full(moments.torsion), ..moments };
        let strength = spec.crank.strength(Loading::Bending, first(symbol));
        assert_close(so.fatigue_diameter(&strength, Notch::NONE, spec.design_factor), first(symbol), 0.02, 0.0, symbol);
    }
}

/// Theory: a round section has exactly the factor that it is sized to, the shank and the web at least; moments at the web are the same from both bearings; without friction the mean
/// torque is the work of the gas in a cycle.
#[test]
fn sections_hold_what_they_are_sized_for() {
    for file in ["two_stroke", "four"] {
        let study = read_sizing(Path::new(&format!("studies/fialho_{file}.toml"))).expect("a sizing file");
        let spec = &study.specification;
        let sized = size(spec).expect("sizes");
        let last = sized.last();
        for m in &last.margins {
            let smaller = m.yielding.min(m.fatigue);
            if ["piston_pin", "crankpin", "journal", "flywheel_seat"].contains(&m.section) {
                assert_close(smaller, spec.design_factor, 1e-9, 0.0, m.section);
            }
            assert!(smaller >= spec.design_factor * (1.0 - 1e-9), "{}: {smaller}", m.section);
        }
        assert!(last.buckling_margin >= spec.buckling_factor * (1.0 - 1e-9));
        // what stands behind a margin gives it: Goodman's line of the equivalent moments on the section
        for m in last.margins.iter().filter(|m| m.behind.is_some()) {
            let (behind, d) =
                (m.behind.expect("a round section"), last.sizes.named().iter().find(|n| n.0.starts_with(m.section)).map(|n| n.1));
            let d = d.unwrap_or(if m.section == "piston_pin" { last.sizes.pin_diameter } else { last.sizes.seat_diameter });
            let part = if m.section == "piston_pin" { &spec.pin } else { &spec.crank };
            let section = std::f64::consts::PI * d.powi(3) / 32.0;
            let used = (behind.moments[0] / behind.fatigue_limit + behind.moments[1] / part.tensile) / section;
            assert_close(1.0 / used, m.fatigue, 1e-9, 0.0, m.section);
            let limit = behind.factors.iter().product::<f64>() * (0.5 * part.tensile).min(7e8);
            assert_close(limit, behind.fatigue_limit, 1e-12, 0.0, m.section);
        }
        let (before, after) = crank::shares(&spec.bearings);
        let s = 0.5 * (last.sizes.crankpin_length + last.sizes.web_thickness);
        let from_before = before * (spec.bearings.before + s) - s;
        assert_close(from_before, after * (spec.bearings.after - s), 1e-12, 0.0, "the beam from both ends");
        for cycle in &sized.cycles {
            let mean = |y: &[f64]| y.iter().sum::<f64>() / y.len() as f64;
            let geometry = spec.geometry(last.rod.mass, last.rod.centre, last.rod.inertia());
            let slope = |deg: &f64| geometry.slider_crank.motion(deg.to_radians()).slope;
            let gas: Vec<f64> = cycle.gas.iter().zip(&cycle.crank_deg).map(|(f, deg)| f * slope(deg)).collect();
            let torque = cycle.torque(spec.crank_radius());
            assert_close(mean(&torque), mean(&gas), 1e-9, 1e-9, "energy in is energy out");
            // forces of the rod are the same along and across it as in the axes of the crank
            for i in 0..torque.len() {
                let across = cycle.rod_tension_big[i].hypot(cycle.rod_across_big[i]);
                assert_close(across, cycle.radial[i].hypot(cycle.tangential[i]), 1e-12, 0.0, "one force");
            }
        }
    }
}

/// Theory: the parts of a crank that is given are not sized.
#[test]
fn given_dimensions_stay() {
    let mut study = two_stroke();
    let free = size(&study.specification).expect("sizes").last().sizes;
    study.specification.given.crankpin_diameter = Some(0.045);
    study.specification.given.pin_diameter = Some(0.020);
    let sized = size(&study.specification).expect("sizes");
    let s = sized.last().sizes;
    assert_eq!((s.crankpin_diameter, s.pin_diameter), (0.045, 0.020));
    assert_eq!(s.shank_thickness.to_bits() == free.shank_thickness.to_bits(), s.big_eye_bore == free.big_eye_bore);
    let margin = |name: &str| sized.last().margins.iter().find(|m| m.section == name).map(|m| m.fatigue).expect(name);
    assert!(margin("crankpin") > 1.1 && margin("piston_pin") > 1.1);
}
