//! What pins and journals of the flexible crank carry at the faces of their webs: against the strains of another model, equilibrium of a throw, and the limit of slow running.

use super::independent::{Model, bent, round};
use super::{alone, at_rest, curves, held_at_the_flywheel, under_unit_force};
use hartog::analysis::Silent;
use hartog::analysis::curves::{Shown, curves_of};
use hartog::crankshaft::flexible::{Cut, SectionLoad, WebLoads};
use hartog::engine::cycle::{crank_fixed, pin_angles, throw_loads};
use hartog::input::Study;
use nalgebra::{Complex, DVector, Vector3};

type C = Complex<f64>;

/// First node of the round beam beside each cut of a throw, and whether it is cut at its end.
fn beams([front, rear]: [usize; 2]) -> [(usize, bool); 4] {
    [(front - 2, true), (front + 3, false), (rear - 4, true), (rear + 1, false)]
}

/// Force and moment at an end of a round beam along the crank by the field of its strains there: E A times stretch, kappa G A times shear, E I times curvature, G J times twist. In the order of `SectionLoad::ALL`.
fn by_strains(study: &Study, motion: &DVector<C>, throw: usize, cut: Cut) -> [C; 6] {
    let (crank, flexible) = (study.crank.as_ref().expect("a crank"), study.flexible.as_ref().expect("flexible"));
    let (node, at_end) = beams(flexible.assembled.webs[throw])[cut as usize];
    let is_pin = matches!(cut, Cut::PinFront | Cut::PinRear);
    let section = round(crank, if is_pin { crank.pin_diameter } else { crank.journal_diameter }, 0.0, 1.0);
    let [outwards, tangential] = flexible.assembled.directions[throw];
    let along = |node: usize, rotation: usize, d: Vector3<f64>| (0..3).map(|k| motion[6 * node + rotation + k] * d[k]).sum::<C>();
    let l = (flexible.assembled.shaft.places[node + 1] - flexible.assembled.shaft.places[node]).norm();
    let slope = |rotation: usize| (along(node + 1, rotation, Vector3::z()) - along(node, rotation, Vector3::z())) / l;
    // bending that moves along d, its slope about z x d
    let bending = |d: Vector3<f64>| {
        let about = Vector3::z().cross(&d);
        let ends = [along(node, 0, d), along(node, 3, about), along(node + 1, 0, d), along(node + 1, 3, about)];
        let [_, _, curvature, shear] = bent(section.ei[0], section.kga, l, if at_end { l } else { 0.0 });
        let sum = |by: [f64; 4]| ends.iter().zip(by).map(|(q, c)| q * c).sum::<C>();
        (sum(shear) * section.kga, sum(curvature) * section.ei[0])
    };
    let ((outward, about_tangential), (across, about_inward)) = (bending(outwards), bending(tangential));
    let all = [outward, across, slope(0) * section.ea, -about_inward, about_tangential, slope(3) * section.gj];
    all.map(|load| load * C::new(1.0, flexible.spec.loss_factor))
}

/// All six loads of all 24 sections by the motion of a model of its own, to 1e-9 of the largest of their kind.
#[test]
fn loads_are_those_of_strains() {
    let study = alone();
    let results = study.run().expect("results");
    let model = Model::new(&study);
    let (crank, excitation) = (results.system.flexible.as_ref().expect("flexible"), &results.system.excitation);
    let assembled = &study.flexible.as_ref().expect("flexible").assembled;
    let loads = WebLoads::of_rounds(assembled, &study.engine, (crank, excitation)).expect("a cylinder");
    let (order, speed) = (4.5, 2203.7);
    let n = excitation.orders.iter().position(|o| o.value() == order).expect("an order");
    let motion = model.motion(&[], order, speed);
    let motions: Vec<DVector<C>> = (0..results.system.orders()).map(|_| motion.clone()).collect();
    let found = &loads.of_motions(speed, &motions)[n];
    let (mut worst, mut largest) = ([0.0f64; 6], [0.0f64; 6]);
    for throw in 0..6 {
        for cut in Cut::ALL {
            let wanted = by_strains(&study, &motion, throw, cut);
            for k in 0..6 {
                worst[k] = worst[k].max((found[6 * (4 * throw + cut as usize) + k] - wanted[k]).norm());
                largest[k] = largest[k].max(wanted[k].norm());
            }
        }
    }
    for k in 0..6 {
        assert!(worst[k] < 1e-9 * largest[k], "{:?}: {:e} of {:e}", SectionLoad::ALL[k], worst[k], largest[k]);
    }
}

/// A throw that does not turn is in equilibrium between its cuts under a force on a pin: forces differ by it, moments by its lever and by that of the shear, torques by the radius. Exact, whatever the bearings.
#[test]
fn throws_are_in_equilibrium() {
    let study = alone();
    let crank = study.crank.as_ref().expect("a crank");
    let (assembled, shaft) = at_rest(&study);
    let results = study.run().expect("results");
    let parts = (results.system.flexible.as_deref().expect("flexible"), &results.system.excitation);
    let loads = WebLoads::of_rounds(&assembled, &study.engine, parts).expect("a cylinder");
    let half = 0.5 * crank.pin_length + crank.web_thickness;
    for (on, kind) in [(2, 0), (2, 1), (4, 0)] {
        let (pin, direction) = (assembled.rods[on][0], assembled.directions[on][kind]);
        let motion = under_unit_force(&shaft, pin, direction);
        let all = &loads.of_motions(0.0, &vec![motion; results.system.orders()])[0];
        for throw in 0..6 {
            let of = |cut: Cut| -> [f64; 6] { std::array::from_fn(|k| all[6 * (4 * throw + cut as usize) + k].re) };
            let (front, rear) = (of(Cut::JournalFront), of(Cut::JournalRear));
            let pin: [f64; 2] = std::array::from_fn(|d| if throw == on && d == kind { 1.0 } else { 0.0 });
            let close = |left: f64, what: &str| assert!(left.abs() < 1e-8, "{throw} {on} {kind} {what}: {left}");
            // on the part between: what lies behind pulls at its rear, the opposite of what it does itself on the part before at its front
            (0..2).for_each(|d| close(rear[d] - front[d] + pin[d], "force"));
            close(rear[2] - front[2], "axial");
            close(rear[5] - front[5] + crank.crank_radius * pin[1], "torque");
            // moments about the front cut
            close(rear[3] - front[3] - 2.0 * half * rear[1] - half * pin[1], "about outwards");
            close(rear[4] - front[4] + 2.0 * half * rear[0] + half * pin[0], "about tangential");
        }
    }
}

/// At 60 rpm hardly anything vibrates and inertia is small: the forces on pins that `hartog curves` tells of are those of the rods, to 3 % of the largest, and torques in the middle of bearings grow by them times the radius.
#[test]
fn slow_running_tells_the_forces_of_rods() {
    let mut study = held_at_the_flywheel();
    let radius = study.crank.as_ref().expect("a crank").crank_radius;
    study.designs.clear();
    let shown = Shown { speeds_rpm: vec![60.0], throws: vec![1, 2], ..Shown::default() };
    let found = curves_of(&study, &shown, &Silent).expect("damped").histories;
    assert_eq!(found.iter().map(|h| h.name.as_str()).collect::<Vec<_>>(), ["throw_2_loads_60", "throw_3_loads_60"]);
    assert!(curves(&study, &[60.0], &Silent).expect("damped").histories.is_empty(), "only what is asked for");
    let loads = throw_loads(&study.engine, 60.0).expect("a cylinder");
    let of = |h: usize, name: &str| -> Vec<f64> {
        let column = found[h].columns.iter().position(|c| c == name).expect("a load");
        found[h].rows.iter().map(|r| r.1[column]).collect()
    };
    let every = loads.theta.len() / found[1].rows.len();
    let angle = pin_angles(&study.engine)[2];
    let rods: Vec<[f64; 2]> =
        loads.theta.iter().zip(&loads.rod_force[2]).step_by(every).map(|(theta, force)| crank_fixed(*force, theta + angle)).collect();
    for (d, name) in ["pin_x", "pin_y"].into_iter().enumerate() {
        let largest = rods.iter().map(|f| f[d].abs()).fold(0.0, f64::max);
        let worst = rods.iter().zip(of(1, name)).map(|(rod, found)| (rod[d] - found).abs()).fold(0.0, f64::max);
        assert!(worst < 0.03 * largest, "{name}: {worst} of {largest}");
    }
    let (before, behind) = (of(0, "rear_mz"), of(1, "rear_mz"));
    let largest = behind.iter().map(|t| t.abs()).fold(0.0, f64::max);
    let grows = before.iter().zip(&behind).zip(&rods).map(|((a, b), rod)| (b - a + radius * rod[1]).abs()).fold(0.0, f64::max);
    assert!(grows < 0.03 * largest, "{grows} of {largest}");
}

/// What the loads of a throw leave out, of the six at 2200 rpm (the guide says so): along the axis the throw's own inertia, up to 660 of 4,380 N; of the bending at its front journal in its plane, as equilibrium without it has it, 14 %.
#[test]
fn what_loads_of_throws_leave_out() {
    let mut study = alone();
    study.designs.clear();
    let shown = Shown { speeds_rpm: vec![2200.0], throws: vec![1, 2], ..Shown::default() };
    let found = curves_of(&study, &shown, &Silent).expect("damped");
    let of = |h: usize, name: &str| -> Vec<f64> {
        let column = found.histories[h].columns.iter().position(|c| c == name).expect("a load");
        found.histories[h].rows.iter().map(|r| r.1[column]).collect()
    };
    let largest = |all: &[f64]| all.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    let along: Vec<f64> = of(0, "rear_fz").iter().zip(of(1, "rear_fz")).map(|(a, b)| a - b).collect();
    let both = (largest(&along), largest(&of(1, "rear_fz")));
    assert!((both.0 / 660.0 - 1.0).abs() < 0.01 && (both.1 / 4380.0 - 1.0).abs() < 0.01, "{both:?}");
    let crank = study.crank.as_ref().expect("a crank");
    let (half, to_bearing) = (0.5 * crank.pin_length + crank.web_thickness, 0.5 * crank.journal_lengths[3]);
    let (moment, force, pin) = (of(1, "rear_my"), of(1, "rear_fx"), of(1, "pin_x"));
    let front = |i: usize| moment[i] + (to_bearing + 2.0 * half) * force[i] + half * pin[i];
    let figure = found.figures.iter().find(|f| f.name == "journal_moments_2200").expect("a figure");
    let panel = figure.panels.iter().find(|p| p.title == "bending in the plane of the throw, journals before the throw").expect("a panel");
    let drawn = &panel.curves.iter().find(|c| c.label == "throw 3").expect("a throw").points;
    let every = moment.len() / drawn.len();
    let apart: Vec<f64> = drawn.iter().enumerate().map(|(j, p)| front(every * j) - p.1).collect();
    let all: Vec<f64> = drawn.iter().map(|p| p.1).collect();
    let share = largest(&apart) / largest(&all);
    assert!((share / 0.14 - 1.0).abs() < 0.05, "{share}");
}
