//! Proofs that nothing within the bounds is better: against closed forms, brute force and tampering.

use crate::limits::{TwoMasses, What, with};
use crate::proof_tables::proved;
use crate::support::{assert_close, h_infinity_peak, study};
use hartog::absorber::{Declaration, MAXWELL, RUBBER, TUNED, VISCOUS};
use hartog::analysis::families;
use hartog::input::{LimitSpec, ProveSpec, Size, Study};
use hartog::objective::{Condition, PeakFinder};
use hartog::optimise::proof::settle;
use hartog::optimise::{Effort, LoadCase, Problem, Verdict, search, starts};
use hartog::response::{Grid, Method, Receptance, Work};

/// Den Hartog's problem with one ring of a type, whose optimum is to be proved to a gap.
fn two_masses(masses: TwoMasses, kind: &'static Declaration, gap: f64) -> Study {
    let mut s = with(masses, What::Twist, &[]);
    let o = s.optimise.as_mut().expect("optimises");
    (o.absorbers[0].types, o.absorbers[0].size) = (vec![kind], Size::Each(vec![masses.ring]));
    o.prove = ProveSpec { effort: Effort { gap, boxes: 1_000_000 }, all: true, file: false };
    s
}

/// Source: [Nishihara & Asami 2002] for spring and damper and, with the same amplitude, for a ring in oil of one relaxation time; sqrt(2 (1 + mu)/mu) for rubber, (2 + mu)/mu for a viscous ring. For mass
/// ratios from 0.01 to 1 the closed form is proved to a gap of 1e-6: the lower bound is not above it, and no further below. Damped primary masses, for which there is no closed form: against golden sections.
#[test]
fn closed_forms_are_proved() {
    let gap = 1e-6;
    let proved = |masses: TwoMasses, kind: &'static Declaration, exact: f64| {
        let found = two_masses(masses, kind, gap).run().unwrap_or_else(|e| panic!("{e}")).optima.remove(0);
        let proof = found.proof.expect("asked for");
        let what = format!("{} at {masses:?}: {proof:?}", kind.name);
        assert_eq!((&proof.verdict, proof.better), (&Verdict::Proved, 0), "{what}");
        let bound = proof.lower_bound.expect("a bound");
        assert!(bound <= exact && bound >= exact * (1.0 - gap - 1e-8), "{what} against {exact}");
        let upper = proof.upper_bound.expect("an upper bound");
        assert!(upper >= exact * (1.0 - 1e-8) && upper <= exact * (1.0 + gap + 2e-8), "{what} against {exact}");
    };
    for ring in [0.01, 0.1, 1.0] {
        let masses = TwoMasses { damping_ratio: 0.0, ring };
        let spring = 1e-4 * h_infinity_peak(ring);
        proved(masses, &TUNED, spring);
        proved(masses, &MAXWELL, spring);
        proved(masses, &RUBBER, 1e-4 * (2.0 * (1.0 + ring) / ring).sqrt());
        proved(masses, &VISCOUS, 1e-4 * (2.0 + ring) / ring);
    }
    for (damping_ratio, ring) in [(0.02, 0.1), (0.05, 0.3)] {
        let masses = TwoMasses { damping_ratio, ring };
        proved(masses, &TUNED, masses.minimise(&|p| masses.peak(p, What::Twist)).1);
    }
}

/// What finders and problems of a study live in.
fn with_problem(s: &Study, check: impl FnOnce(&Problem, &[(String, Vec<f64>)])) {
    let sys = crate::support::system(s);
    let grid = Grid::new(&s.speeds_rpm, &[]);
    let method = Method::Receptance(Receptance::new(&sys, &grid, 0, &[s.twist]));
    let finder = PeakFinder::new(&sys, &grid, &method, true);
    let load_cases = [LoadCase::new(Condition::Firing, &finder)];
    let spec = s.optimise.as_ref().expect("optimises");
    let modes = families::engine_modes(s, spec, 1e4);
    let objective = [s.objective.measure.in_si()];
    let Size::Each(rings) = &spec.absorbers[0].size else { panic!("held rings") };
    let choice = families::Choice { types: vec![spec.absorbers[0].types[0]], rings: vec![Some(rings[0])] };
    let space = families::family(spec, &choice, &modes);
    let problem = Problem { load_cases: &load_cases, space, objectives: &objective, weights: &[], limits: &[], memory: None };
    let list = starts::starts(&problem.space, &modes, 4, 1);
    check(&problem, &list);
}

/// Law: an optimum that is moved until it is 1e-5 worse is refuted: a box holds something better, and the search from there ends at the optimum, which is proved.
#[test]
fn what_is_no_optimum_is_refuted() {
    for ring in [0.01, 0.1, 1.0] {
        let s = two_masses(TwoMasses { damping_ratio: 0.0, ring }, &TUNED, 1e-6);
        with_problem(&s, |problem, list| {
            let best = search::optimise(problem, list, search::Finish::All, &|| {}).expect("damped");
            let mut moved = best.clone();
            let mut step = 1e-7;
            while moved.value() < best.value() * (1.0 + 1e-5) {
                moved.outcome.point[1] = best.outcome.point[1] + step;
                moved.outcome.rows = problem.rows(&moved.outcome.point, &mut Work::default()).expect("damped");
                step *= 1.2;
            }
            moved.design = problem.space.design(&moved.outcome.point);
            assert!(moved.value() < best.value() * (1.0 + 2e-5));
            let proof = settle(problem, &mut moved, Effort { gap: 1e-6, boxes: 1_000_000 });
            assert_eq!(proof.verdict, Verdict::Proved);
            assert!(proof.better >= 1);
            assert_close(moved.value(), 1e-4 * h_infinity_peak(ring), 1e-8, 0.0, "the optimum again");
        });
    }
}

/// The shipped six and V10, tuned and viscous, by twist and by Goodman's margin: proved to 1e-4.
#[test]
fn shipped_engines_are_proved() {
    for name in ["villalva_i6", "villalva_v10"] {
        let results = &proved(name).1;
        assert_eq!(results.optima.len(), 4, "tuned and viscous, by twist and by margin");
        for o in &results.optima {
            let proof = o.proof.as_ref().expect("asked for");
            assert_eq!((&proof.verdict, proof.better), (&Verdict::Proved, 0), "{name}: {}", o.design.name);
            assert_close(proof.lower_bound.expect("a bound"), o.optimum.value() * (1.0 - 1e-4), 1e-12, 0.0, &o.design.name);
            let upper = proof.upper_bound.expect("an upper bound") / o.optimum.value();
            assert!((1.0..=1.0 + 1.001e-4).contains(&upper), "{}: {upper}", o.design.name);
            assert!(proof.boxes < 1500, "{}: {} boxes", o.design.name, proof.boxes);
        }
    }
}

/// Law: limits that no design holds are proved to conflict: the amplitude of Den Hartog's problem is nowhere below that of its optimum; one that is 1e-4 above it is held.
#[test]
fn impossible_limits_are_proved() {
    let (masses, least) = (TwoMasses { damping_ratio: 0.0, ring: 0.1 }, h_infinity_peak(0.1) * 1e-4);
    let asked = |share: f64| {
        let mut s = with(masses, What::RingTwist, &[(What::Twist, share * least)]);
        s.optimise.as_mut().expect("optimises").prove = ProveSpec { effort: Effort { gap: 1e-3, boxes: 200_000 }, all: true, file: false };
        s.run().unwrap_or_else(|e| panic!("{e}")).optima.remove(0)
    };
    let impossible = asked(1.0 - 1e-4);
    assert_eq!(impossible.proof.expect("asked for").verdict, Verdict::Impossible);
    assert!(impossible.conflict.is_some() && !impossible.design.within_limits());
    let possible = asked(1.0 + 1e-4);
    assert!(possible.design.within_limits());
    assert_eq!(possible.proof.expect("asked for").verdict, Verdict::Proved);
}

/// Law: orders may cancel in the twist of a ring, also where nothing is known of one of them: beside a resonance of chain and undamped ring a design has 1.0965e-3° in the second ring, and no bound is above it.
#[test]
fn orders_that_cancel_in_a_ring_are_not_left_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let put = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("written");
    put(
        "engine.toml",
        "name = \"one mass\"\nstrokes = 2\n[layout.in_line]\nfiring_order = [1]\nfiring_deg = [0]\n[pressure.harmonics]\nfile = \"torque.csv\"\n\
         [[station]]\nname = \"a\"\ninertia_kg_m2 = 1.0\nthrows = [1]\nstiffness_to_ground_n_m_per_rad = 1e4\n",
    );
    put("torque.csv", "order,amplitude_n_m,phase_deg\n1,1,0\n3,2.6985e-05,-2.69542\n");
    let head = "engine = \"engine.toml\"\nspeed_rpm = { from = 582.897, to = 582.897006, step = 6e-6 }\norder_limit = 3\n\
                objective = [{ ring_twist = { absorber = 2 } }]\n";
    let [first, second, damping] = [0.067_740_995_681_509_85, 0.000_221_270_531_734_785_46, 0.011_496_175_091_205_82];
    let searched = format!(
        "[optimise]\nrandom_starts = 0\nprove = {{ gap = 1e-3, boxes = 5000 }}\n\
         [[optimise.absorber]]\non.station = \"a\"\ntypes = [\"undamped\"]\nsize.ring_inertia_kg_m2.fixed = {first}\n\
         stiffness_n_m_per_rad.between = [517.9123144077729, 8286.597030524366]\n\
         [[optimise.absorber]]\non.station = \"a\"\ntypes = [\"tuned\"]\nsize.ring_inertia_kg_m2.fixed = {second}\n\
         stiffness_n_m_per_rad.between = [7.016659154465966, 7.018062556463451]\ndamping_n_m_s_per_rad.fixed = {damping}\n"
    );
    let given = format!(
        "[[design]]\nname = \"beside\"\n[[design.absorber]]\non.station = \"a\"\n\
         type.undamped = {{ ring_inertia_kg_m2 = {first}, stiffness_n_m_per_rad = 2071.6492576310916 }}\n[[design.absorber]]\non.station = \"a\"\n\
         type.tuned = {{ ring_inertia_kg_m2 = {second}, stiffness_n_m_per_rad = 7.018062556463451, damping_n_m_s_per_rad = {damping} }}\n"
    );
    let run = |name: &str, text: &str| {
        put(name, &format!("{head}{text}"));
        hartog::input::read(&folder.path().join(name)).unwrap_or_else(|e| panic!("{e}")).run().expect("damped")
    };
    let least = run("given.toml", &given).designs[0].objective.expect("a twist");
    assert_close(least, 1.0965e-3f64.to_radians(), 1e-4, 0.0, "the design beside the resonance");
    let proof = run("searched.toml", &searched).optima[0].proof.clone().expect("asked for");
    assert!(proof.lower_bound.is_none_or(|bound| bound <= least), "{proof:?}");
}

/// Law: of the six with two rubber rings, six parameters free, no design holds its limits on heat and strain and 0.1° of twist: that is proved, and how far the twist alone would have to be loosened is told; loosened by that
/// a design holds all of them.
#[test]
#[ignore = "a minute: two searches with six free parameters"]
fn impossible_limits_of_the_six_are_proved() {
    let with_limit = |twist: f64| {
        let mut s = study("villalva_i6_limits");
        s.front = None;
        s.limits.push(LimitSpec {
            of: s.objective.clone(),
            words: format!("twist at most {twist}°"),
            limit: twist.to_radians(),
            rule: None,
        });
        s.optimise.as_mut().expect("optimises").prove = ProveSpec { effort: Effort { gap: 1e-2, boxes: 2000 }, all: true, file: false };
        s.run().unwrap_or_else(|e| panic!("{e}")).optima.remove(0)
    };
    let impossible = with_limit(0.1);
    assert_eq!(impossible.proof.expect("asked for").verdict, Verdict::Impossible);
    let parties = impossible.conflict.expect("a conflict").parties;
    let loosened = parties.iter().find(|p| p.limit == 3).and_then(|p| p.loosened).expect("the others hold");
    let possible = with_limit(0.1 * loosened * (1.0 + 1e-6));
    assert!(possible.design.within_limits() && loosened > 2.0, "{loosened}");
}

/// Source: [Nishihara & Asami 2002]. Every point of the front over the mass ratio is proved to be the closed form.
#[test]
fn fronts_are_proved() {
    let mut s = study("den_hartog");
    let o = s.optimise.as_mut().expect("optimises");
    (o.absorbers[0].types, o.prove) = (vec![&TUNED], ProveSpec { effort: Effort { gap: 1e-5, boxes: 100_000 }, all: true, file: false });
    let results = s.run().unwrap_or_else(|e| panic!("{e}"));
    let points = &results.fronts[0].front.points;
    assert_eq!(points.len(), 25);
    for p in points {
        let exact = 1e-4 * h_infinity_peak(p.design[0].absorber.ring_inertia());
        let proof = p.proof.as_ref().expect("asked for");
        let bound = proof.lower_bound.expect("a bound");
        assert!(bound <= exact && bound >= exact * (1.0 - 1.1e-5), "{proof:?} against {exact}");
    }
}

/// Law: speeds beside the sweep say nothing. A lossless ring on a lossless mass, from 1000 to 1100 rpm: designs whose resonance lies just below the sweep are large there and small within it. By the closed form k = 13.23 N m/rad
/// has 0.05561°, below the local optimum at 0.0593° that starts end in; no bound is above it, and the proof finds it.
#[test]
fn speeds_beside_the_sweep_exclude_nothing() {
    let folder = tempfile::tempdir().expect("writable");
    let text = "engine = \"engines/den_hartog.toml\"\nspeed_rpm = { from = 1000, to = 1100, step = 25 }\norder_limit = 1\n[[objective]]\n\
        peak_twist = { from = \"engine\", to = \"ground\" }\n[optimise]\nrandom_starts = 0\nprove = { gap = 1e-3, boxes = 20000 }\n\
        [[optimise.absorber]]\non.station = \"engine\"\ntypes = [\"undamped\"]\nsize.ring_inertia_kg_m2.fixed = 0.001\nstiffness_n_m_per_rad.between = [1e-3, 13.6]\n";
    let study = crate::support::variant(folder.path(), "den_hartog", &[]).with_file_name("own.toml");
    std::fs::write(&study, text).expect("writable");
    let found = Study::read(&study).unwrap_or_else(|e| panic!("{e}")).run().unwrap_or_else(|e| panic!("{e}")).optima.remove(0);
    let proof = found.proof.expect("asked for");
    // |1/(k0 - w² - k J w²/(k - J w²))| of the two masses at both ends of the sweep
    let amplitude = |rpm: f64| {
        let w2 = (rpm * std::f64::consts::PI / 30.0).powi(2);
        (1.0 / (1e4 - w2 - 13.23 * 1e-3 * w2 / (13.23 - 1e-3 * w2))).abs()
    };
    let known = f64::max(amplitude(1000.0), amplitude(1100.0));
    assert!(proof.lower_bound.expect("a bound") <= known, "{proof:?} against {known}");
    // the starts miss it; a box of the proof leads there
    assert!(proof.better >= 1 && found.optimum.value() <= known * (1.0 + 1e-4), "{} against {known}", found.optimum.value());
}
