//! What the webs of the flexible crank carry: against the field of the strains of another model, equilibrium of a throw, and the limit of slow running.

use super::independent::{Model, bent, web_of};
use super::{alone, at_rest, designs, held_at_the_flywheel, under_unit_force};
use hartog::crankshaft::Crank;
use hartog::crankshaft::flexible::{Bearing, BearingNodes, Carried, LinearBearings, WebFactors, WebLoad, WebLoads, assemble};
use hartog::input::Study;
use hartog::response::{Direct, Grid, Work};
use nalgebra::{Complex, DVector, Vector3};

type C = Complex<f64>;

/// Moments and force in the middle of a web whose first node is `first`, from the field of its strains there: E I times curvature, G J times twist and E A times stretch, the mean of both elements. In the order of
/// `WebLoad::ALL`.
fn by_strains(study: &Study, motion: &DVector<C>, first: usize, throw: usize) -> [C; 4] {
    let (crank, flexible) = (study.crank.as_ref().expect("a crank"), study.flexible.as_ref().expect("flexible"));
    let (spec, assembled) = (&flexible.spec, &flexible.assembled);
    let section = web_of(crank, spec, spec.beams().expect("beams").density * assembled.balance[throw].density);
    let [outwards, tangential] = assembled.directions[throw];
    let mut sum = [C::new(0.0, 0.0); 4];
    for (node, at_end) in [(first, true), (first + 1, false)] {
        let (from, to) = (assembled.shaft.places[node], assembled.shaft.places[node + 1]);
        let l = (to - from).norm();
        let x = (to - from) / l;
        let (y, z) = (Vector3::z(), x.cross(&Vector3::z()));
        let along = |node: usize, rotation: usize, d: Vector3<f64>| (0..3).map(|k| motion[6 * node + rotation + k] * d[k]).sum::<C>();
        let slope = |rotation: usize| (along(node + 1, rotation, x) - along(node, rotation, x)) / l;
        let curvature = |d: Vector3<f64>, about: Vector3<f64>, ei: f64| {
            let ends = [along(node, 0, d), along(node, 3, about), along(node + 1, 0, d), along(node + 1, 3, about)];
            let [_, _, curvature, _] = bent(ei, section.kga, l, if at_end { l } else { 0.0 });
            ends.iter().zip(curvature).map(|(q, c)| q * c).sum::<C>() * ei
        };
        // what the part at larger x exerts on that at smaller x, as a vector
        let moment = [(x, slope(3) * section.gj), (z, curvature(y, z, section.ei[0])), (-y, curvature(z, -y, section.ei[1]))];
        let component = |d: Vector3<f64>| moment.iter().map(|(axis, m)| m * axis.dot(&d)).sum::<C>();
        let own = [component(tangential), component(-outwards), slope(0) * section.ea * -x.dot(&outwards), component(Vector3::z())];
        sum.iter_mut().zip(own).for_each(|(sum, own)| *sum += own * 0.5);
    }
    sum.map(|load| load * C::new(1.0, spec.loss_factor))
}

/// Loads of all webs with three designs against those by the strains of the other model, to 1e-6 of the largest of their kind.
pub(super) fn against_its_own(speeds: &[f64], orders: &[f64]) {
    let study = alone();
    let results = study.run().expect("results");
    let grid = Grid::new(&study.speeds_rpm, &[]);
    let direct = Direct::new(&results.system, &grid);
    let model = Model::new(&study);
    let (crank, excitation) = (results.system.flexible.as_ref().expect("flexible"), &results.system.excitation);
    let assembled = &study.flexible.as_ref().expect("flexible").assembled;
    let loads = WebLoads::new(assembled, &study.engine, (crank, excitation)).expect("a cylinder");
    for design in designs(&study) {
        let (mut worst, mut largest) = ([0.0f64; 4], [0.0f64; 4]);
        for speed in speeds {
            let torques = |n: usize| direct.absorber_torques(&design, (n, *speed), &mut Work::default()).expect("damped");
            let found = loads.orders(*speed, &(0..results.system.orders()).map(torques).collect::<Vec<_>>()).expect("damped");
            for order in orders {
                let n = excitation.orders.iter().position(|o| o.value() == *order).expect("an order");
                let motion = model.motion(&design, *order, *speed);
                for (web, first) in assembled.webs.iter().flat_map(|[front, rear]| [*front, rear - 2]).enumerate() {
                    let wanted = by_strains(&study, &motion, first, web / 2);
                    for k in 0..4 {
                        worst[k] = worst[k].max((found[n][4 * web + k] - wanted[k]).norm());
                        largest[k] = largest[k].max(wanted[k].norm());
                    }
                }
            }
        }
        for k in 0..4 {
            assert!(worst[k] < 1e-6 * largest[k], "{:?}: {:e} of {:e}", WebLoad::ALL[k], worst[k], largest[k]);
        }
    }
}

#[test]
fn web_loads_against_a_model_of_its_own() {
    against_its_own(&[2203.7], &[6.0]);
}

#[test]
#[ignore = "a quarter of a minute: twelve speeds, four orders"]
fn web_loads_against_a_model_of_its_own_over_speed() {
    let speeds: Vec<f64> = (0..12).map(|i| 605.3 + 235.0 * f64::from(i)).collect();
    against_its_own(&speeds, &[0.5, 3.0, 4.5, 6.0]);
}

/// Without rotation a throw is in equilibrium: between its webs the moment grows by the shear force times their distance, and a force on the pin adds to the shear, and to the moment by its lever. Exact, whatever the bearings.
#[test]
fn throws_are_in_equilibrium() {
    let study = alone();
    let crank = study.crank.as_ref().expect("a crank");
    let (assembled, shaft) = at_rest(&study);
    let apart = crank.pin_length + crank.web_thickness;
    for (on, kind) in [(2, 0), (2, 1), (4, 0)] {
        let (pin, direction) = (assembled.rods[on][0], assembled.directions[on][kind]);
        let motion = under_unit_force(&shaft, pin, direction);
        for (throw, sections) in assembled.sections.iter().enumerate() {
            let [front, rear] = sections.each_ref().map(|s| WebLoad::ALL.map(|load| s.load(load, &motion, 0.0).re));
            let [outwards, tangential] = [0, 1].map(|d| if throw == on && d == kind { 1.0 } else { 0.0 });
            let close = |found: f64, wanted: f64, what: &str| {
                assert!((found - wanted).abs() < 1e-8, "{throw} {on} {kind} {what}: {found} {wanted}")
            };
            close(rear[2] - front[2], outwards, "shear");
            close(rear[0] - front[0], (front[2] + 0.5 * outwards) * apart, "moment");
            // about the middles of the webs the force on the pin has the lever of half a throw, and the part behind holds against it
            close(rear[3] - front[3], -0.5 * crank.crank_radius * tangential, "edgewise");
        }
    }
}

/// A crank of one slender section with hardly a radius, whose webs are thin and do not bend, on stiff bearings of a point each, is the continuous beam: over the cycle at 1600 rpm the moments without vibration are the beam's to 6 % of the largest,
/// with their signs. What is left is that webs are stiffer than pins.
#[test]
fn slender_crank_is_the_continuous_beam() {
    let study = alone();
    let results = study.run().expect("results");
    let flexible = results.system.flexible.as_ref().expect("flexible");
    let mut crank: Crank = study.crank.clone().expect("a crank");
    let thinner = crank.web_thickness - 2e-3;
    (crank.web_thickness, crank.pin_diameter, crank.journal_diameter) = (2e-3, 0.02, 0.02);
    // twist of a throw bends its pin across, by the radius
    crank.crank_radius = 1e-3;
    crank.pin_length += thinner;
    crank.journal_lengths.iter_mut().for_each(|l| *l += thinner);
    let mut spec = study.flexible.as_ref().expect("flexible").spec.clone();
    (spec.nodes, spec.bearing) = (BearingNodes::One, LinearBearings::Alike(Bearing { stiffness: 1e13, damping: 0.0 }));
    // centrifugal forces of the flywheel would bend so slender a crank
    spec.rotating = false;
    spec.beams_mut().expect("beams").web_factors = WebFactors { bending: 1e6, twist: 1e6, edge: 1e6 };
    let assembled = assemble(&crank, &study.engine, &study.chain, &spec, Carried::All).expect("a crank");
    let loads = WebLoads::new(&assembled, &study.engine, (flexible, &results.system.excitation)).expect("a cylinder");
    let still = loads.still(&loads.quasi_static(1600.0).expect("held"));
    let model = hartog::crankshaft::loads::CrankModel::new(&study.engine, &crank).expect("a cylinder");
    let beam = model.at(1600.0);
    let about_mean = |all: Vec<f64>| {
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        all.into_iter().map(|x| x - mean).collect::<Vec<_>>()
    };
    let (mut worst, mut largest) = (0.0f64, 0.0f64);
    for web in 0..12 {
        let in_plane = beam.web(web / 2, web % 2 == 1);
        for (load, all) in [(WebLoad::Moment, in_plane.moment), (WebLoad::Across, in_plane.tangential)] {
            let (own, other) = (about_mean(still.column(4 * web + load as usize).iter().copied().collect()), about_mean(all));
            // samples of the beam lie closer, by a factor that is not whole: the nearest one before
            let nearest = |j: usize| other[j * other.len() / own.len()];
            for (j, found) in own.iter().enumerate() {
                worst = worst.max((found - nearest(j)).abs());
                largest = largest.max(nearest(j).abs());
            }
        }
    }
    assert!(worst < 0.06 * largest, "{worst} of {largest}");
}

/// At 60 rpm, order 12 at a twelfth of the lowest frequency, hardly anything vibrates: with a flywheel that holds the torque the moments are those of the still crank to 3 % of their largest.
#[test]
fn slow_running_is_still() {
    let study = held_at_the_flywheel();
    let results = study.run().expect("results");
    let (crank, excitation) = (results.system.flexible.as_ref().expect("flexible"), &results.system.excitation);
    let assembled = &study.flexible.as_ref().expect("flexible").assembled;
    let loads = WebLoads::new(assembled, &study.engine, (crank, excitation)).expect("a cylinder");
    let quasi = loads.quasi_static(60.0).expect("held");
    let still = loads.still(&quasi);
    let orders = loads.orders(60.0, &vec![Vec::new(); results.system.orders()]).expect("damped");
    let all = loads.vibrating(&quasi, &still, &orders);
    for column in 0..48 {
        let (a, b) = (all.column(column), still.column(column));
        let worst = a.iter().zip(b.iter()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 0.03 * b.amax(), "web {} load {}: {worst} of {}", column / 4, column % 4, b.amax());
    }
}
