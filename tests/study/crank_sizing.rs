//! What bends and twists the crank that is sized: on its bearings, from both sides, at every speed.

use crate::sizing::two_stroke;
use crate::support::assert_close;
use hartog::input::read_sizing;
use hartog::sizing::{Bearings, Bending, crank, size};
use std::path::Path;

/// Theory: a crank of one throw is bent alike on its own and on all bearings. Where the first of many throws is loaded in the middle of its span, Clapeyron's equation gives the moment
/// F L (1/4 - 3/16/(2 + sqrt 3)) at the load, met within 1 % with four spans. A crank on all its bearings has thinner crankpins than one whose throws are taken by themselves.
#[test]
fn bending_on_all_bearings() {
    let mut one = two_stroke().specification;
    let own = size(&one).expect("sizes").last().sizes;
    one.bending = Bending::AllBearings;
    assert_eq!(size(&one).expect("sizes").last().sizes, own);
    let bearings = Bearings { before: 0.05, after: 0.05, ..one.bearings };
    let loads = |force: f64| crank::ThrowLoads {
        firing_deg: 0.0,
        radial: vec![force],
        tangential: vec![0.0],
        torque_before: vec![0.0],
        torque_after: vec![0.0],
    };
    let four = [loads(1.0), loads(0.0), loads(0.0), loads(0.0)];
    let at = |bending: Bending| crank::crankpin(&four, 0, (&bearings, bending), 0.03)[0].bending[0].mean;
    assert_close(at(Bending::OwnBearings), 0.1 / 4.0, 1e-12, 0.0, "F L/4");
    // Clapeyron: 4 M1 + M2 = -3/8 F L, M(i-1) + 4 M(i) + M(i+1) = 0; half of M1 acts in the middle of the first span
    let limit = 0.1 * (0.25 - 3.0 / 16.0 / (2.0 + 3.0f64.sqrt()));
    assert_close(at(Bending::AllBearings), limit, 1e-2, 0.0, "a beam on five bearings");
    let mut many = read_sizing(Path::new("studies/fialho_four.toml")).expect("a sizing file").specification;
    let apart = size(&many).expect("sizes").last().sizes;
    many.bending = Bending::AllBearings;
    assert!(size(&many).expect("sizes").last().sizes.crankpin_diameter < apart.crankpin_diameter);
}

/// Theory: a pressure that depends on the speed sizes by its worst speed, wherever that is: the sizes over a range are at least those of each of its speeds alone.
#[test]
fn every_speed_of_a_torque_curve_counts() {
    let folder = tempfile::tempdir().expect("folder");
    let text = std::fs::read_to_string("tests/bad_input/sizing.toml").expect("a file");
    let text = text.replace(
        "speed_rpm = [1000, 6000]\nindicated_mean_pressure_bar = [9, 8]",
        "speed_rpm = [1000, 3000, 6000]\nindicated_mean_pressure_bar = [6, 16, 6]",
    );
    let sizes = |range: &str| {
        let file = folder.path().join("curve.toml");
        let from = "speed_rpm = { from = 1000, to = 6000, step = 500 }";
        assert!(text.contains(from) && text.contains("[6, 16, 6]"));
        std::fs::write(&file, text.replace(from, &format!("speed_rpm = {range}"))).expect("written");
        size(&read_sizing(&file).expect("a sizing file").specification).expect("sizes").last().sizes
    };
    let (all, middle) = (sizes("{ from = 1000, to = 6000, step = 500 }"), sizes("{ from = 3000, to = 3000, step = 1 }"));
    let ends = sizes("{ from = 1000, to = 1000, step = 1 }").pin_diameter.max(sizes("{ from = 6000, to = 6000, step = 1 }").pin_diameter);
    assert!(all.pin_diameter >= middle.pin_diameter * (1.0 - 1e-9) && middle.pin_diameter > 1.1 * ends);
    // the rod of the whole range is heavier and relieves the crankpin a little
    assert!(all.crankpin_diameter >= middle.crankpin_diameter * (1.0 - 5e-3), "{} {}", all.crankpin_diameter, middle.crankpin_diameter);
}

/// Theory: a throw seen from the flywheel is one seen from the free end with its bearings changed over: the journal before it is bent as the one after it was. On a rigid crank the
/// torsion of the crankpin is the same from both sides.
#[test]
fn both_sides_of_a_throw() {
    let sized = size(&two_stroke().specification).expect("sizes");
    let (throws, sizes) = (&sized.throws[0], sized.last().sizes);
    let bearings = |before: f64, after: f64| Bearings { before, after, ..two_stroke().specification.bearings };
    let (uneven, over) = (bearings(0.06, 0.03), bearings(0.03, 0.06));
    let of = |bearings: &Bearings| crank::journals(throws, 0, (bearings, Bending::OwnBearings), &sizes);
    for (a, b) in of(&uneven).iter().zip(of(&over).iter().rev()) {
        for (a, b) in a.bending.iter().zip(&b.bending) {
            assert_close(a.amplitude, b.amplitude, 1e-9, 0.0, "bending, changed over");
        }
    }
    assert!(of(&uneven)[0].bending[0].amplitude > 1.5 * of(&uneven)[1].bending[0].amplitude, "the far bearing bends more");
    for supported in [(&uneven, Bending::OwnBearings), (&uneven, Bending::AllBearings)] {
        let [before, after] = crank::crankpin(throws, 0, supported, 0.0192);
        assert_close(before.torsion.amplitude, after.torsion.amplitude, 1e-9, 0.0, "one torsion");
        assert_close(before.torsion.mean, after.torsion.mean, 1e-9, 0.0, "one torsion");
    }
}

/// Theory: the torque of a chain goes through its webs, too: with ten times the crank's own torque passing from the throws before, a given web has less margin.
#[test]
fn webs_bear_the_torque_of_the_crank() {
    let mut study = read_sizing(Path::new("studies/fialho_four.toml")).expect("a sizing file");
    let free = size(&study.specification).expect("sizes").last().sizes;
    let g = &mut study.specification.given;
    (g.crankpin_diameter, g.journal_diameter) = (Some(free.crankpin_diameter), Some(free.journal_diameter));
    (g.web_breadth, g.web_thickness) = (Some(free.web_breadth), Some(free.web_thickness));
    let web = |throws: usize| {
        let mut spec = study.specification.clone();
        // all cylinders fire together: their torques add up
        spec.firing_deg = vec![0.0; throws];
        size(&spec).expect("sizes").last().margins.iter().find(|m| m.section == "web").map(|m| m.fatigue).expect("a web")
    };
    let (one, four) = (web(1), web(4));
    assert!(four < 0.8 * one, "{four} against {one}");
}
