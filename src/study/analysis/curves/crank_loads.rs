//! Loads of the main bearings over the cycle; shear force, bending moment and torque along the crank when each of its throws is loaded most.

use super::cylinder::STRIDE;
use super::figure::{Axis, CRANK_DEG, Curve, FORCE, Figure, Look, MOMENT, Panel, Scale, TORQUE, curve};
use super::shown::Shown;
use crate::crankshaft::loads::{self, CrankModel};
use crate::input::Study;
use crate::numerics::elementary::Elementary;
use crate::units::DEG_PER_RAD;

pub(super) const PLACE: Axis = Axis { column: "place_mm", label: "place along the crank / mm" };
/// mm in a m.
const MM: f64 = 1e3;

/// One load case a throw: the instant of its largest rod force at a speed. Nothing without `[crank]`.
pub(super) fn crank_loads(study: &Study, shown: &Shown, speed_rpm: f64) -> Option<Figure> {
    let crank = study.crank.as_ref()?;
    let model = CrankModel::new(study.engine_of_crank(), crank)?;
    let loads = model.at(speed_rpm);
    let size = |t: usize, j: usize| {
        let [x, y] = loads.on_throw(t, j);
        x.hypotenuse(y)
    };
    let worst = |t: usize| (0..loads.theta.len()).fold(0, |m, j| if size(t, j) > size(t, m) { j } else { m });
    let (mut shear, mut moment, mut across, mut torque) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for t in shown.throws(crank.throws()) {
        let j = worst(t);
        let (v, m) = loads.along(j, t);
        let named = |points: &[(f64, f64)]| Curve {
            label: format!("throw {} at {:.0}°", t + 1, loads.theta[j] * DEG_PER_RAD),
            look: Look::Line,
            points: points.iter().map(|(x, y)| (x * MM, *y)).collect(),
        };
        shear.push(named(&v[0]));
        moment.push(named(&m[0]));
        across.push(named(&m[1]));
        // what the throws before a place put in
        let mut sum = 0.0;
        let mut steps = vec![(0.0, 0.0)];
        for s in 0..crank.throws() {
            let x = crank.places(s)[1];
            steps.push((x, sum));
            sum += loads.torque[s][j];
            steps.push((x, sum));
        }
        steps.push((crank.bearings()[crank.throws()], sum));
        torque.push(named(&steps));
    }
    let panel = |title: &str, y: Axis, curves: Vec<Curve>| Panel { title: title.into(), x: PLACE, y, curves, scale: Scale::Own };
    Some(Figure {
        name: format!("crank_loads_{speed_rpm}"),
        title: format!("{}: the crank at {speed_rpm} rpm when each throw is loaded most", study.engine.name),
        panels: vec![
            panel("shear force in the plane of that throw", FORCE, shear),
            panel("bending moment in the plane of that throw", MOMENT, moment),
            panel("bending moment across it", MOMENT, across),
            panel("torque of the throws before a place, without vibration", TORQUE, torque),
        ],
    })
}

/// Size of the force on every main bearing at a speed; nothing without `[crank]`.
pub(super) fn bearings(study: &Study, speed_rpm: f64) -> Option<Figure> {
    let crank = study.crank.as_ref()?;
    let model = CrankModel::new(study.engine_of_crank(), crank)?;
    let loaded = model.at(speed_rpm);
    let every = STRIDE / loads::STRIDE;
    let angles = || loaded.theta.iter().step_by(every).map(|t| t * DEG_PER_RAD);
    let forces: Vec<Vec<[f64; 2]>> = (0..loaded.theta.len()).step_by(every).map(|j| loaded.bearing_forces(j)).collect();
    let numbers = (0..=crank.throws()).filter(|b| !crank.missing_bearings.contains(b));
    let size = |i: usize, b: usize| curve(format!("bearing {}", b + 1), angles(), forces.iter().map(move |f| f[i][0].hypotenuse(f[i][1])));
    let curves = numbers.enumerate().map(|(i, b)| size(i, b)).collect();
    Some(Figure {
        name: format!("bearings_{speed_rpm}"),
        title: format!("{}: loads of the main bearings at {speed_rpm} rpm", study.engine.name),
        panels: vec![Panel { title: "the crank a continuous beam".into(), x: CRANK_DEG, y: FORCE, curves, scale: Scale::Own }],
    })
}
