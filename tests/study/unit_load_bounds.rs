//! Margins by stresses per unit load: bounds spare most points, and never lose the one that decides.

use crate::margin::short;
use crate::support::{assert_close, system};
use hartog::analysis::{Silent, run};
use hartog::crankshaft::{FactorSource, FatigueSpec, FilletSpec, Margin, MarginCriterion, Place, Torque, UnitLoads};
use hartog::fatigue::multiaxial::{Criterion as Multiaxial, Limits};
use hartog::input::Study;
use hartog::numerics::C64;
use hartog::numerics::synthesis::Synthesiser;
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use std::f64::consts::TAU;

/// A tensor per unit load, Pa: of any kind, uniaxial, of shear, or hydrostatic.
fn tensor(random: &mut Xoshiro256PlusPlus, kind: usize) -> [f64; 6] {
    let mut any = || random.random_range(-1e5..1e5);
    match kind {
        0 => [any(), any(), any(), any(), any(), any()],
        1 => [any(), 0.0, 0.0, 0.0, 0.0, 0.0],
        2 => [0.0, 0.0, 0.0, any(), 0.0, any()],
        3 => {
            let p = any();
            [p, p, p, 0.0, 0.0, 0.0]
        }
        _ => [0.0; 6],
    }
}

/// Points with such tensors for each of the four loads, some loads without stress.
fn points(random: &mut Xoshiro256PlusPlus, count: usize) -> Vec<(String, UnitLoads)> {
    let point = |i: usize| {
        let mut own = || {
            let kind = random.random_range(0..5);
            tensor(random, kind)
        };
        let units = UnitLoads { moment: own(), tangential: own(), shear: own().map(|s| 0.03 * s), torque: own() };
        (format!("p{i}"), units)
    };
    (0..count).map(point).collect()
}

const LIMITS: Limits = Limits { tensile: 1500e6, bending: 750e6, torsion: 460e6, repeated_bending: 500e6 };

/// A study judged by such points on the fillets of all crankpins.
fn judged_at(base: &Study, criteria: Vec<MarginCriterion>, fillets: Vec<FilletSpec>) -> FatigueSpec {
    FatigueSpec { criteria, limits: Some(LIMITS), fillets, ..base.fatigue.clone().expect("[fatigue]") }
}

fn fillet(name: &str, throw: Option<usize>, points: Vec<(String, UnitLoads)>) -> FilletSpec {
    FilletSpec { name: name.into(), throw, place: Place::Crankpin, factors: FactorSource::UnitLoads(points) }
}

/// Law: no bound lies below what the whole history says. For random tensors per unit load (any, uniaxial, of shear, hydrostatic, none) on both webs, under the bending of the engine and random torques, the location that
/// bounds leave over is the one whose whole history uses most, by every criterion, to the last bit.
#[test]
fn bounds_lose_no_point() {
    let base = short("villalva_v10_thesis");
    let crank = base.crank.clone().expect("a crank");
    let system = system(&base);
    let harmonics = &system.excitation.harmonics;
    let synthesiser = Synthesiser::new(harmonics);
    let mut random = Xoshiro256PlusPlus::seed_from_u64(47);
    for (criteria, count, cases) in [
        (&[Multiaxial::SINES, Multiaxial::CROSSLAND, Multiaxial::KAKUNO_KAWADA, Multiaxial::KAKUNO_KAWADA_CONSISTENT][..], 80, 12),
        (&[Multiaxial::DANG_VAN_MESOSCOPIC, Multiaxial::PAPADOPOULOS][..], 40, 6),
        (
            &[Multiaxial::MATAKE, Multiaxial::MCDIARMID, Multiaxial::DANG_VAN_THESIS, Multiaxial::DANG_VAN_PLANE, Multiaxial::FINDLEY][..],
            4,
            2,
        ),
    ] {
        let fillets = vec![fillet("pin", Some(2), points(&mut random, count))];
        let spec = judged_at(&base, criteria.iter().map(|c| MarginCriterion::Multiaxial(*c)).collect(), fillets);
        let model = Margin::new(&base.engine, &base.chain, &crank, &spec, &[2000.0, 6500.0], harmonics).expect("a model");
        for case in 0..cases {
            let speed = if case == 0 { 2000.0 } else { random.random_range(2000.0..6500.0) };
            let size = [0.0, 150.0, 1500.0][case % 3];
            let phasors: Vec<C64> =
                harmonics.iter().map(|_| C64::from_polar(size * random.random_range(0.0..1.0), random.random_range(0.0..TAU))).collect();
            let torque = Torque { extremes: synthesiser.extremes(&phasors), phasors: &phasors };
            for (c, criterion) in criteria.iter().enumerate() {
                let found = model.most_used(c, 3, speed, &torque).expect("locations");
                let own = (0..model.locations.len()).filter(|l| model.locations[*l].shaft == 3);
                let most = own.map(|l| model.used(c, l, speed, &torque).value).fold(0.0, f64::max);
                assert_eq!(found.value.to_bits(), most.to_bits(), "{}, case {case}: {} {most}", criterion.name(), found.value);
                let range = model.at_most(c, 3, speed, torque.extremes.half_peak_to_peak, torque.extremes.middle);
                assert!(range >= most, "{}, case {case}: {range} by ranges, {most}", criterion.name());
            }
        }
    }
}

/// Work: of 600 points on one fillet of the six, all speeds and both webs with either shaft, only so many paths are judged in full; every other is spared by a bound.
#[test]
fn bounds_spare_most_points() {
    let mut study = short("villalva_i6_thesis");
    study.refine_peaks = false;
    study.designs.truncate(1);
    let mut random = Xoshiro256PlusPlus::seed_from_u64(53);
    let count = 600;
    let fillets = vec![fillet("pin", Some(0), points(&mut random, count))];
    for (criterion, most) in [
        (Multiaxial::CROSSLAND, 2.0),
        (Multiaxial::SINES, 20.0),
        (Multiaxial::KAKUNO_KAWADA_CONSISTENT, 20.0),
        (Multiaxial::DANG_VAN_MESOSCOPIC, 6.0),
        (Multiaxial::PAPADOPOULOS, 2.0),
    ] {
        study.fatigue = Some(judged_at(&study, vec![MarginCriterion::Multiaxial(criterion)], fillets.clone()));
        let results = run(&study, &Silent).expect("finite");
        for sweep in &results.margins {
            let judged = sweep.judged as f64 / study.speeds_rpm.len() as f64;
            assert!((1.0..=most).contains(&judged), "{}: {judged} of {} paths a speed", criterion.name(), 4 * count);
        }
    }
}

/// Law: a fillet of very many points is told by the worst of them at each speed: the same points on two fillets of 52 each, of which every point is told, have the same margins there.
#[test]
fn many_points_are_told_by_the_worst() {
    let mut study = short("villalva_i6_thesis");
    study.designs.truncate(1);
    study.refine_peaks = false;
    study.speeds_rpm = study.speeds_rpm.into_iter().step_by(10).collect();
    let mut random = Xoshiro256PlusPlus::seed_from_u64(59);
    let all = points(&mut random, 104);
    let run_with = |fillets: Vec<FilletSpec>| {
        let mut own = study.clone();
        own.fatigue = Some(judged_at(&study, vec![MarginCriterion::Multiaxial(Multiaxial::CROSSLAND)], fillets));
        run(&own, &Silent).expect("finite")
    };
    let whole = run_with(vec![fillet("pin", None, all.clone())]);
    let halves = run_with(vec![fillet("a", None, all[..52].to_vec()), fillet("b", None, all[52..].to_vec())]);
    let (many, each) = (&whole.margins[0].fillets, &halves.margins[0].fillets);
    assert_eq!((many.len(), each.len()), (6, 6 * 104), "a row a throw, or a row a point of each");
    let model = whole.margin.as_ref().expect("a model");
    for (throw, own) in many.iter().enumerate() {
        let name = format!("_{}:", throw + 1);
        let same: Vec<_> = each.iter().filter(|f| f.name.contains(&name)).collect();
        assert_eq!(same.len(), 104);
        for (i, used) in own.used.iter().enumerate() {
            let most = same.iter().map(|f| f.used[i].value).fold(0.0, f64::max);
            assert_eq!(used.value.to_bits(), most.to_bits(), "throw {}, speed {i}", throw + 1);
            assert!(model.locations[used.location].name.starts_with(&format!("pin{name}p")));
        }
    }
    let margin = |r: &hartog::Results| r.designs[0].margins[0].margin;
    assert_close(margin(&whole), margin(&halves), 1e-9, 0.0, "the smallest margin");
}
