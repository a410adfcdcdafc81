//! The crank by matrices of another program, against the beams from which they were made.

use super::{alone, designs, six};
use hartog::analysis::Silent;
use hartog::analysis::curves::curves;
use hartog::crankshaft::flexible::imported::ImportedCrank;
use hartog::crankshaft::flexible::{Carried, CrankBody, FlexibleSpec, assemble, reduced};
use hartog::input::Study;
use hartog::response::{Direct, Grid, Quantity, Response, Work};
use hartog::rotor::shaft::Turning;
use nalgebra::{Complex, DMatrix, DVector, Rotation3, Vector3};
use std::sync::Arc;

/// More than there are.
const ALL: usize = 10_000;

/// A study whose flexible crank is changed.
fn with(study: &Study, change: impl FnOnce(&mut FlexibleSpec)) -> Study {
    let (flexible, crank) = (study.flexible.as_ref().expect("flexible"), study.crank.as_ref().expect("a crank"));
    let changed = flexible.with(change, (crank, &study.engine, &study.chain)).expect("a crank");
    Study { flexible: Some(changed), ..study.clone() }
}

/// Its crank, free, with hub and flywheel, by matrices with so many modes.
fn exported(study: &Study, modes: usize) -> ImportedCrank {
    let (flexible, crank) = (study.flexible.as_ref().expect("flexible"), study.crank.as_ref().expect("a crank"));
    let free = assemble(crank, &study.engine, &study.chain, &flexible.spec, Carried::Ends).expect("a crank");
    reduced(&free, modes).expect("positive")
}

fn by_matrices(study: &Study, own: ImportedCrank) -> Study {
    with(study, |spec| spec.body = CrankBody::Matrices(Arc::new(own)))
}

/// Twist from end to end, twist of a throw and torque of a shaft by order at some speeds, none and with a tuned ring.
fn answers(study: &Study) -> Vec<[Complex<f64>; 3]> {
    let results = study.run().expect("results");
    let grid = Grid::new(&study.speeds_rpm, &[]);
    let direct = Direct::new(&results.system, &grid);
    let quantities =
        [Quantity::Twist { from: 0, to: Some(study.chain.len() - 1) }, Quantity::Twist { from: 2, to: Some(5) }, Quantity::ShaftTorque(4)];
    let mut all = Vec::new();
    for design in &designs(study)[..2] {
        for speed in [903.0, 1621.0, 2207.0, 3100.0] {
            for order in [0.5, 3.0, 4.5, 6.0] {
                let index = results.system.excitation.orders.iter().position(|o| o.value() == order).expect("an order");
                let phasor = |q| direct.phasor(design, q, (index, speed), &mut Work::default()).expect("damped");
                all.push(quantities.map(phasor));
            }
        }
    }
    all
}

/// Largest difference of each answer over its largest value.
fn apart(a: &[[Complex<f64>; 3]], b: &[[Complex<f64>; 3]]) -> [f64; 3] {
    std::array::from_fn(|k| {
        let largest = b.iter().map(|y| y[k].norm()).fold(0.0, f64::max);
        a.iter().zip(b).map(|(a, b)| (a[k] - b[k]).norm()).fold(0.0, f64::max) / largest
    })
}

/// What responses are computed at alone.
fn short() -> Study {
    let mut study = alone();
    study.designs.retain(|d| d.name == "tuned_optimal");
    study.speeds_rpm = vec![900.0, 3150.0];
    (study.order_limit, study.refine_peaks) = (6.0, false);
    study
}

/// Motion of all unknowns of the shaft under a unit force on each rod in the direction of rotation, each a sixth of a turn later.
fn motion(study: &Study, at: Turning) -> DVector<Complex<f64>> {
    let assembled = &study.flexible.as_ref().expect("flexible").assembled;
    let mut force = DVector::from_element(6 * assembled.shaft.len(), Complex::new(0.0, 0.0));
    for (t, (rods, [_, tangential])) in assembled.rods.iter().zip(&assembled.directions).enumerate() {
        let phase = Complex::from_polar(1.0, t as f64 * std::f64::consts::FRAC_PI_3);
        rods.iter().for_each(|rod| (0..3).for_each(|k| force[6 * rod + k] += phase * tangential[k]));
    }
    assembled.shaft.response(at, &force).expect("damped")
}

/// Twist from hub to flywheel and torques behind the first and the third throw under these forces.
fn under_forces(study: &Study, at: Turning) -> [Complex<f64>; 3] {
    let (assembled, x) = (&study.flexible.as_ref().expect("flexible").assembled, motion(study, at));
    let torque = |shaft: usize| {
        let (twist, stiffness, dissipation) = &assembled.shafts[shaft];
        let twist: Complex<f64> = twist.iter().map(|(node, k, factor)| x[6 * node + k] * *factor).sum();
        twist * Complex::new(1.0, dissipation.loss_factor) * *stiffness
    };
    let ends = [assembled.stations[0], assembled.stations[assembled.throws.end]].map(|node| x[6 * node + 5]);
    [ends[0] - ends[1], torque(1), torque(3)]
}

/// With all modes a reduction is the whole crank, with two main bearings missing, too. At rest (`rotating = false`) twists are those of the beams to rounding, torques to 3e-3: between the outer points of a journal lies inertia that its middle does not see. Of the V10, whose
/// throws are damped in the middle of the pin and here by the mean of its two rods, to 1e-4. Turning, the pull of the rods, which stiffens each throw as a string from axis to pin and not its webs, is what differs: 3e-3.
#[test]
fn matrices_are_the_crank() {
    let ten = Study { order_limit: 6.0, ..Study::read("studies/villalva_v10_flexible.toml").expect("a study") };
    let mut missing = short();
    missing.crank.as_mut().expect("a crank").missing_bearings = vec![1, 4];
    for (name, study, exact) in [("six", short(), 1e-9), ("without two bearings", missing, 1e-9), ("V10", ten, 1e-4)] {
        let own = exported(&study, ALL);
        for (rotating, tolerance) in [(false, [exact, 3e-3, 3e-3]), (true, [3e-3; 3])] {
            let beams = with(&study, |spec| spec.rotating = rotating);
            let matrices = by_matrices(&beams, own.clone());
            let at = Turning { omega: 1300.0, speed: 290.0 };
            let (found, wanted) = (under_forces(&matrices, at), under_forces(&beams, at));
            for k in 0..3 {
                let error = (found[k] - wanted[k]).norm() / wanted[k].norm();
                assert!(error < tolerance[k], "{name}, {rotating}: {k} {error:e}");
            }
        }
    }
}

/// By orders, without and with a ring, in the tables of a study: with twenty modes twists from end to end and torques are within 3e-3 of the beams', without modes within 1 % (sharp resonances move most). Between throws the tangential motion of the pins against the axis stands for
/// their rotation: 6 %.
#[test]
fn responses_by_matrices() {
    let study = short();
    let wanted = answers(&study);
    for (modes, tolerance) in [(0, 1e-2), (20, 3e-3)] {
        let [twist, of_throws, torque] = apart(&answers(&by_matrices(&study, exported(&study, modes))), &wanted);
        assert!(twist < tolerance && torque < tolerance && of_throws < 0.06, "{modes}: {twist:e} {of_throws:e} {torque:e}");
    }
}

/// In which direction of the crank's own axes the first throw points is no matter: the pins tell it. What stresses are recovered from is in the axes and units of the files: turned as they are, and a thousand times as large in mm.
#[test]
fn turned_axes_are_the_same_crank() {
    let study = short();
    let own = exported(&study, 0);
    let n = own.structure.unknowns.len();
    let rotation = Rotation3::from_axis_angle(&Vector3::z_axis(), 0.7);
    let mut turn = DMatrix::identity(n, n);
    let place = |node: u64, component: u8| own.structure.unknowns.iter().position(|u| (u.node, u.component) == (node, component));
    for (i, u) in own.structure.unknowns.iter().enumerate().filter(|u| u.1.component > 0) {
        let first = if u.component > 3 { 4 } else { 1 };
        for k in 0..3u8 {
            if let Some(j) = place(u.node, first + k) {
                turn[(i, j)] = rotation[(usize::from(u.component - first), usize::from(k))];
            }
        }
    }
    let mut turned = own.clone();
    let rotated = |x: &DMatrix<f64>| &turn * x * turn.transpose();
    let structure = &mut turned.structure;
    for matrix in
        [&mut structure.mass, &mut structure.gyroscopic, &mut structure.turning].into_iter().flatten().chain([&mut structure.stiffness])
    {
        *matrix = rotated(matrix);
    }
    turned.structure.places.values_mut().for_each(|p| *p = rotation * *p);
    turned.written.iter_mut().for_each(|w| w.scale = 1e3);
    let at = Turning { omega: 1300.0, speed: 290.0 };
    let (turned, own) = (by_matrices(&study, turned), by_matrices(&study, own));
    let written = |study: &Study| {
        let (all, x) = (&study.flexible.as_ref().expect("flexible").assembled.written, motion(study, at));
        DVector::from_fn(n, |i, _| all[i].1.iter().map(|(node, k, factor)| x[6 * node + k] * *factor).sum::<Complex<f64>>())
    };
    let (found, wanted) = (written(&turned), turn.map(Complex::from) * written(&own) * Complex::from(1e3));
    assert!((&found - &wanted).norm() < 1e-9 * wanted.norm());
    let (found, wanted) = (under_forces(&turned, at), under_forces(&own, at));
    for k in 0..3 {
        assert!((found[k] - wanted[k]).norm() < 1e-9 * wanted[k].norm(), "{k}: {} {}", found[k], wanted[k]);
    }
}

/// Turning as a rigid body about the axis costs nothing, rods and all: r'(K_s + Kc - Z) r = 0 beside r'Z r, which is the inertia about the axis.
#[test]
fn rigid_rotation_costs_nothing() {
    let study = by_matrices(&short(), exported(&six(), 10));
    let shaft = &study.flexible.as_ref().expect("flexible").assembled.shaft;
    let r = shaft.rigid_rotation();
    let v = DVector::from_fn(6 * r.len(), |i, _| r[i / 6][i % 6]);
    let rest = (v.transpose() * shaft.turning_matrix() * &v)[(0, 0)];
    assert!(rest.abs() < 1e-9 * shaft.kinetic(&r, &r), "{rest}");
}

/// Centrifugal forces of the masses as they are drawn have the sum of those of the beams, and the moment about the middle of the first bearing to 1e-4: axial parts of what is condensed onto pins are left out.
#[test]
fn unbalance_is_that_of_the_beams() {
    let beams = short();
    let sums = |study: &Study| {
        let shaft = &study.flexible.as_ref().expect("flexible").assembled.shaft;
        let all = shaft.unbalance().into_iter().zip(&shaft.places);
        all.fold((Vector3::zeros(), Vector3::zeros()), |(force, moment), (own, place)| {
            let f = Vector3::new(own[0], own[1], own[2]);
            (force + f, moment + place.cross(&f) + Vector3::new(own[3], own[4], 0.0))
        })
    };
    let ((force, moment), (wanted_force, wanted_moment)) = (sums(&by_matrices(&beams, exported(&beams, 3))), sums(&beams));
    let across = |m: Vector3<f64>| Vector3::new(m.x, m.y, 0.0);
    assert!((force - wanted_force).norm() < 1e-9, "{force} {wanted_force}");
    assert!((across(moment) - across(wanted_moment)).norm() < 1e-4 * wanted_moment.norm(), "{moment} {wanted_moment}");
    assert!(wanted_moment.norm() > 0.05, "there is something to compare, kg m²: {wanted_moment}");
}

/// What stresses are recovered from: the orders in the histories of the unknowns are those of the response, without and with a ring, to 3e-5 of the largest (forces are sampled every 0.5°); histories are in units and axes of the files, here those of the structure.
#[test]
fn histories_of_unknowns_hold_the_response() {
    let study = by_matrices(&short(), exported(&short(), 0));
    let speed = 2003.0;
    let found = curves(&study, &[speed], &Silent).expect("damped");
    // shapes of modes show what nodes tell: all 29 move across, the middles of seven journals do not rotate
    let shapes = found.figures.iter().find(|f| f.name == "crank_modes").expect("a figure");
    assert_eq!(shapes.panels[0].curves.iter().map(|c| c.points.len()).collect::<Vec<_>>(), [29, 29, 29, 22]);
    let all = found.histories;
    assert_eq!(all.iter().map(|h| h.name.as_str()).collect::<Vec<_>>(), ["unknowns_2003", "unknowns_tuned_optimal_2003"]);
    let results = study.run().expect("results");
    let grid = Grid::new(&study.speeds_rpm, &[]);
    let direct = Direct::new(&results.system, &grid);
    let twist = Quantity::Twist { from: 0, to: Some(study.chain.len() - 1) };
    for (histories, design) in all.iter().zip(&designs(&study)) {
        let place = |name: &str| histories.columns.iter().position(|u| u == name).expect("an unknown");
        let (hub, flywheel) = (place("1.6"), place("92.6"));
        let wanted: Vec<Complex<f64>> =
            (0..results.system.orders()).map(|n| direct.phasor(design, twist, (n, speed), &mut Work::default()).expect("damped")).collect();
        let largest = wanted.iter().map(|y| y.norm()).fold(0.0, f64::max);
        for (order, wanted) in results.system.excitation.orders.iter().zip(&wanted) {
            let term = |(deg, values): &(f64, Vec<f64>)| {
                Complex::from_polar(1.0, -order.value() * deg.to_radians()) * (values[hub] - values[flywheel])
            };
            let found = histories.rows.iter().map(term).sum::<Complex<f64>>() * (2.0 / histories.rows.len() as f64);
            assert!((found - wanted).norm() < 3e-5 * largest, "{} {order:?}: {found} {wanted}", histories.name);
        }
    }
}
