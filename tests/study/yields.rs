//! Yield and acceptance band of a damper by its dimensions, against a million and a hundred thousand dampers.

use crate::construction::{SLEEVE, six};
use crate::support::system;
use hartog::Study;
use hartog::absorber::{Absorber, Mounted, Operating, TemperatureLaw};
use hartog::analysis::Sheet;
use hartog::analysis::sheets::Holding;
use hartog::objective::PeakFinder;
use hartog::optimise::{Scatter, Tolerances};
use hartog::response::{Grid, Method, Receptance, Work};
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use std::f64::consts::TAU;
use std::ops::Range;

/// Tolerance of the thickness, mm.
const THICKNESS: f64 = 0.3;

/// A sleeve of VMQ 60 under limits on strain, %, and twist, °, and the sheet of its order.
fn ordered((strain, twist): (f64, f64), distribution: &str) -> (Study, Sheet) {
    let limits = format!(
        "[[constraint]]\nstrain = {{ absorber = 1, max_percent = {strain} }}\n[[constraint]]\npeak_twist = {{ from = \"pulley\", to = \"flywheel\", max_deg = {twist} }}\n[[design]]\nname = \"drawn\"\n[[design.absorber]]\non.station = \"pulley\"\ntype.sleeve = {{ ring_inertia_kg_m2 = 0.076, outer_diameter_mm = 265, ring_wall_mm = 15, rubber_thickness_mm = 12, length_over_width = 0.9, ring_density_kg_m3 = 7200 }}\nmaterial.of = [\"vmq_60\"]\n[robust]\nsearch = false\nprocess = {{ rubber_thickness_mm = {THICKNESS}, hardness_shore_a = 5 }}\nsampling = {{ percentile = 90, samples = 4000, distribution = \"{distribution}\" }}\n"
    );
    let mut study = six(&format!("{SLEEVE}rubber_thickness_mm.fixed = 12\nmaterial.sleeve.of = [\"vmq_60\"]\n"), &limits);
    // nothing is searched for: the sheet is of the given design
    let robust = study.robust.take();
    study.leave_searches_out();
    study.robust = robust;
    // fewer speeds and orders, and peaks at these speeds alone: a million dampers take a few minutes
    (study.speeds_rpm, study.order_limit, study.refine_peaks) = ((18..=32).map(|i| 100.0 * f64::from(i)).collect(), 6.0, false);
    let mut results = study.run().expect("damped");
    (study, results.sheets.remove(0))
}

/// The damper with this share of the tolerance of its thickness and of five points of hardness, by Gent's relation.
fn made(drawn: &[Mounted], (thickness, hardness): (f64, f64)) -> Vec<Mounted> {
    let law = drawn[0].absorber.law().expect("a law");
    let gent = |h: f64| (56.0 + 7.623_36 * h) / (254.0 - 2.54 * h);
    let mut values = law.values();
    values[3] += THICKNESS * thickness;
    let share: f64 = if hardness >= 0.0 { gent(65.0) / gent(60.0) } else { gent(55.0) / gent(60.0) };
    values[6] *= share.powf(hardness.abs());
    let mut design = drawn.to_vec();
    design[0].absorber = Absorber::Ring(law.rebuilt(&values));
    design
}

/// Law: so many kelvin warmer, a compound has the time that its law of temperature says (Williams, Landel and Ferry, about the reference), at either end and between, whatever else scatters; its modulus at low frequency stays. Colder ones are stiffer.
#[test]
fn temperature_scatters_by_its_law() {
    let (study, _) = ordered((13.6, 0.51), "uniform");
    let drawn = &study.designs.iter().find(|d| d.name == "drawn").expect("drawn").absorbers;
    let law = drawn[0].absorber.law().expect("a law");
    let substance = law.material().and_then(|m| m.substance.clone()).expect("a compound");
    let TemperatureLaw::Wlf { c1, c2, .. } = substance.temperature else { unreachable!("rubber") };
    let tolerances = Tolerances::scattered_of(drawn, &[Scatter::Temperature(20.0), Scatter::Share("relaxation_time_s", 0.1)]);
    assert_eq!(tolerances.edges(), 2);
    for (x, share) in [(1.0, 1.0), (-1.0, 0.0), (1.0, -1.0), (0.0, 0.5)] {
        let factors = &tolerances.at(&[x, share]).factors[0];
        let place = law.declaration().index("relaxation_time_s").expect("a time");
        let (warmer, wlf) = (20.0 * x, |t: f64| 10f64.powf(-c1 * t / (c2 + t)));
        assert!((factors[place] / (wlf(warmer) * (1.0 + 0.1 * share)) - 1.0).abs() < 1e-12, "{x} {share}: {}", factors[place]);
        assert!((0..factors.len()).filter(|i| *i != place).all(|i| factors[i] == 1.0), "{factors:?}");
    }
    let at = |x: f64| {
        let made = tolerances.at(&[x, 0.0]).of(drawn);
        let omega = 150.0 * TAU;
        made[0].absorber.law().expect("a law").dynamic_stiffness(Operating { omega, shaft_speed: omega }).re
    };
    assert!(at(-1.0) > at(0.0) && at(0.0) > at(1.0));
}

/// What of so many dampers counts, by a finder of the study.
fn of_each<T: Send>(study: &Study, n: Range<u64>, f: impl Fn(&dyn Fn(&[Mounted]) -> bool, u64) -> T + Sync) -> Vec<T> {
    let sys = system(study);
    let grid = Grid::new(&study.speeds_rpm, &sys.excitation.tabulated_rpm);
    let method = Method::Receptance(Receptance::new(&sys, &grid, study.hub, &[study.twist]));
    let finder = PeakFinder::new(&sys, &grid, &method, study.refine_peaks);
    let holds = |design: &[Mounted]| {
        study.limits.iter().all(|l| {
            let peak = finder.peak(design, &l.of.measure, &mut Work::default()).expect("damped").expect("excited");
            peak.value / l.limit <= 1.0 + 1e-6
        })
    };
    let half = n.start + (n.end - n.start) / 2;
    let part = |part: Range<u64>| part.map(|i| f(&holds, i)).collect::<Vec<T>>();
    std::thread::scope(|s| {
        let first = s.spawn(|| part(n.start..half));
        let mut rest = part(half..n.end);
        let mut all = first.join().expect("done");
        all.append(&mut rest);
        all
    })
}

/// A normal deviate within three standard deviations, over these.
fn normal(generator: &mut impl Rng) -> f64 {
    loop {
        let x = (-2.0 * (1.0 - generator.random::<f64>()).ln()).sqrt() * (TAU * generator.random::<f64>()).cos() / 3.0;
        if x.abs() <= 1.0 {
            return x;
        }
    }
}

/// Independent: the yield of 4000 draws lies within its interval against so many plain ones of another generator, where many fail and where few do, which is by importance.
fn against(plain: u64, (limits, distribution, by_importance): ((f64, f64), &str, bool)) -> Holding {
    let (study, sheet) = ordered(limits, distribution);
    let holding = sheet.holding.expect("a yield");
    assert_eq!(holding.by_importance, by_importance, "{holding:?}");
    let drawn = study.designs.iter().find(|d| d.name == "drawn").expect("drawn").absorbers.clone();
    let is_normal = distribution == "normal";
    let held = of_each(&study, 0..plain, |holds, i| {
        let mut own = Xoshiro256PlusPlus::seed_from_u64(1_000_003 * i + 17);
        let mut draw = || if is_normal { normal(&mut own) } else { own.random_range(-1.0..=1.0) };
        let point = (draw(), draw());
        holds(&made(&drawn, point))
    });
    let share = held.iter().filter(|h| **h).count() as f64 / plain as f64;
    println!("{distribution}, {limits:?}: {share} of {plain} hold all limits; {holding:?}");
    // the plain ones have an error of their own: three standard errors, and where none fails three in all may have been missed
    let own = 3.0 * (share * (1.0 - share) / plain as f64).sqrt() + 3.0 / plain as f64;
    assert!(holding.between.0 - own <= share && share <= holding.between.1 + own, "{share} against {holding:?}");
    assert!(holding.between.1 - holding.between.0 < 0.03, "{holding:?}");
    holding
}

/// Where few fail the yield is by importance, with an interval below 0.6 of that of as many plain draws.
#[test]
fn yield_by_importance() {
    let holding = against(3_000, ((14.3, 0.535), "normal", true));
    let (width, fails) = (holding.between.1 - holding.between.0, 1.0 - holding.share);
    let plain = 2.0 * 1.96 * (fails * holding.share / holding.samples as f64).sqrt();
    assert!(fails > 0.0 && fails < 0.02 && width < 0.6 * plain, "{holding:?}, plain {plain}");
}

/// The same against a million, for many and few that fail: six orders and 15 speeds.
#[test]
#[ignore = "half an hour"]
fn yield_against_a_million() {
    against(1_000_000, ((13.6, 0.51), "uniform", false));
    against(1_000_000, ((14.3, 0.535), "normal", true));
}

/// Independent: a hundred thousand dampers within the acceptance band hold all limits, whatever their thickness within its tolerance; of those outside a share does not.
#[test]
#[ignore = "two minutes"]
fn acceptance_of_a_hundred_thousand() {
    let (study, sheet) = ordered((13.6, 0.51), "uniform");
    let (low, high) = sheet.acceptance.expect("a band").between.expect("as drawn it holds");
    let drawn = study.designs.iter().find(|d| d.name == "drawn").expect("drawn").absorbers.clone();
    let found = of_each(&study, 0..200_000, |holds, i| {
        let mut own = Xoshiro256PlusPlus::seed_from_u64(7_000_003 * i + 5);
        let design = made(&drawn, (own.random_range(-1.0..=1.0), own.random_range(-1.6..=1.6)));
        let law = design[0].absorber.law().expect("a law");
        let frequency = hartog::drivetrain::natural::own(law.as_ref()).expect("a frequency") / TAU;
        ((low..=high).contains(&frequency), holds(&design))
    });
    let inside = found.iter().filter(|f| f.0).count();
    let outside_broken = found.iter().filter(|f| !f.0 && !f.1).count();
    println!("{low} to {high} Hz: {inside} inside, {} outside, {outside_broken} of these break a limit", found.len() - inside);
    assert!(inside >= 50_000, "{inside} inside");
    assert!(found.iter().all(|f| !f.0 || f.1), "{} inside break a limit", found.iter().filter(|f| f.0 && !f.1).count());
    assert!(outside_broken > (found.len() - inside) / 5, "{outside_broken}");
}
