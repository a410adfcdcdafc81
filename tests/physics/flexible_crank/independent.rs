//! A flexible crank of its own: every mass a cloud of points whose motion to second order gives inertia, gyroscopic and centrifugal terms by Lagrange's equations; every beam an integral of its strain energy over the exact field of
//! its four end motions; all in one dense matrix, rings included. Nothing of the program's own beams, bodies or assembly is used, but the same engineering model: Timoshenko's beams, web factors, strings for the tension of webs.

use super::plan::{Plan, rod_mass};
use hartog::absorber::{Mounted, Operating};
use hartog::crankshaft::Crank;
use hartog::crankshaft::flexible::{BearingNodes, FlexibleSpec};
use hartog::engine::Source;
use hartog::engine::cycle::{crank_fixed, pin_angles, throw_loads};
use hartog::input::Study;
use nalgebra::{Complex, DMatrix, DVector, Matrix3, Matrix3xX, Matrix4, Vector3};
use std::f64::consts::{PI, TAU};

type C = Complex<f64>;

/// M, G and what the square of the speed multiplies, real stiffness, stiffness times loss, damping, circulatory.
pub struct Model {
    places: Vec<Vector3<f64>>,
    mass: DMatrix<f64>,
    gyro: DMatrix<f64>,
    turning: DMatrix<f64>,
    stiffness: DMatrix<f64>,
    loss: DMatrix<f64>,
    damping: DMatrix<f64>,
    circulatory: DMatrix<f64>,
    pins: Vec<usize>,
    directions: Vec<[Vector3<f64>; 2]>,
    study: Study,
    /// What the parts are made of, for other equations of motion.
    pub points: Vec<Mass>,
    pub polars: Vec<(usize, f64)>,
    pub strings: DMatrix<f64>,
    pub bearings: Vec<[usize; 3]>,
}

/// A point of mass beside a place of the crank that moves by u = N_u q and turns by phi = N_r q of some unknowns.
pub struct Mass {
    pub mass: f64,
    pub place: Vector3<f64>,
    pub beside: Vector3<f64>,
    pub rows: Vec<usize>,
    pub moved: Matrix3xX<f64>,
    pub turned: Matrix3xX<f64>,
}

/// A section: stiffness EA, GJ, EI along y and z, kappa GA, mass per length, squares of y and z per mass.
#[derive(Clone, Copy)]
pub struct Section {
    pub ea: f64,
    pub gj: f64,
    pub ei: [f64; 2],
    pub kga: f64,
    pub mass: f64,
    pub squares: [f64; 2],
}

fn cross(a: Vector3<f64>) -> Matrix3<f64> {
    a.cross_matrix()
}

pub fn round(crank: &Crank, d: f64, density: f64, stiffer: f64) -> Section {
    let (e, g) = (crank.young_modulus * stiffer, crank.young_modulus * stiffer / 2.6);
    let (a, i) = (PI * d * d / 4.0, PI * d.powi(4) / 64.0);
    // Cowper's factor of a solid round, nu 0.3
    let kappa = 7.8 / 8.8;
    Section { ea: e * a, gj: 2.0 * g * i, ei: [e * i; 2], kga: kappa * g * a, mass: density * a, squares: [i / a; 2] }
}

pub fn web_of(crank: &Crank, spec: &FlexibleSpec, density: f64) -> Section {
    let (w, b, e) = (crank.web_thickness, crank.web_breadth, crank.young_modulus);
    let (g, f) = (e / 2.6, spec.beams().expect("beams").web_factors);
    let (l, s) = (w.max(b), w.min(b));
    let torsion = l * s.powi(3) * (1.0 / 3.0 - 0.21 * s / l * (1.0 - (s / l).powi(4) / 12.0));
    Section {
        ea: e * w * b,
        gj: g * torsion * f.twist,
        ei: [e * b * w.powi(3) / 12.0 * f.bending, e * w * b.powi(3) / 12.0 * f.edge],
        kga: 1000.0 * g * w * b,
        mass: density * w * b,
        squares: [w * w / 12.0, b * b / 12.0],
    }
}

/// Field of a bent beam by (v1, slope1, v2, slope2): displacement, rotation, curvature and shear strain at x.
pub fn bent(ei: f64, kga: f64, l: f64, x: f64) -> [[f64; 4]; 4] {
    let ratio = ei / kga;
    let v = |x: f64| [1.0, x, x * x, x * x * x];
    let phi = |x: f64| [0.0, 1.0, 2.0 * x, 3.0 * x * x + 6.0 * ratio];
    let ends = Matrix4::from_rows(&[v(0.0), phi(0.0), v(l), phi(l)].map(|r| nalgebra::RowVector4::from_row_slice(&r)));
    let inverse = ends.try_inverse().expect("a beam");
    let by_ends = |row: [f64; 4]| {
        let r = nalgebra::RowVector4::from_row_slice(&row) * inverse;
        [r[0], r[1], r[2], r[3]]
    };
    [by_ends(v(x)), by_ends(phi(x)), by_ends([0.0, 0.0, 2.0, 6.0 * x]), by_ends([0.0, 0.0, 0.0, -6.0 * ratio])]
}

const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_5),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_23),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_23),
    (0.953_089_922_969_332, 0.118_463_442_528_094_5),
];

impl Model {
    fn add(target: &mut DMatrix<f64>, rows: &[usize], block: &DMatrix<f64>) {
        for (a, i) in rows.iter().enumerate() {
            for (b, j) in rows.iter().enumerate() {
                target[(*i, *j)] += block[(a, b)];
            }
        }
    }

    /// A point of mass m at `place + s`, whose frame moves by u = N_u q and turns by phi = N_r q.
    fn point(&mut self, m: f64, (place, s): (Vector3<f64>, Vector3<f64>), rows: &[usize], (nu, nr): (&Matrix3xX<f64>, &Matrix3xX<f64>)) {
        let a = nu - cross(s) * nr;
        let e = cross(Vector3::z());
        let p = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 0.0));
        let force = p * (place + s) * m;
        let second = Matrix3::identity() * s.dot(&force) - (force * s.transpose() + s * force.transpose()) * 0.5;
        Self::add(&mut self.mass, rows, &(a.transpose() * &a * m));
        Self::add(&mut self.gyro, rows, &(a.transpose() * e * &a * (2.0 * m)));
        Self::add(&mut self.turning, rows, &(nr.transpose() * second * nr - a.transpose() * p * &a * m));
        self.points.push(Mass { mass: m, place, beside: s, rows: rows.to_vec(), moved: nu.clone(), turned: nr.clone() });
    }

    /// A body of points: `squares` are its integrals of squares about its centre along three directions.
    fn body(&mut self, node: usize, m: f64, centre: Vector3<f64>, directions: [Vector3<f64>; 3], squares: [f64; 3]) {
        let rows: Vec<usize> = (0..6).map(|k| 6 * node + k).collect();
        let mut nu = Matrix3xX::zeros(6);
        let mut nr = Matrix3xX::zeros(6);
        (0..3).for_each(|k| (nu[(k, k)], nr[(k, k + 3)]) = (1.0, 1.0));
        for (d, square) in directions.into_iter().zip(squares) {
            for sign in [-1.0, 1.0] {
                let s = centre + d * (sign * (3.0 * square / m).sqrt());
                self.point(m / 6.0, (self.places[node], s), &rows, (&nu, &nr));
            }
        }
    }

    fn beam(&mut self, first: usize, section: Section, (loss, tension): (f64, f64)) {
        let (from, to) = (self.places[first], self.places[first + 1]);
        let l = (to - from).norm();
        let x = (to - from) / l;
        let y = if x.z.abs() > 0.5 { Vector3::x() } else { Vector3::z() };
        let z = x.cross(&y);
        let rows: Vec<usize> = (0..12).map(|k| 6 * first + k).collect();
        let unit = |node: usize, rotation: bool, d: Vector3<f64>| {
            let mut row = DMatrix::<f64>::zeros(1, 12);
            (0..3).for_each(|k| row[(0, 6 * node + 3 * usize::from(rotation) + k)] = d[k]);
            row
        };
        for (xi, weight) in GAUSS {
            let w = weight * l;
            let line = |rotation: bool| unit(0, rotation, x) * (1.0 - xi) + unit(1, rotation, x) * xi;
            let slope = |rotation: bool| (unit(1, rotation, x) - unit(0, rotation, x)) / l;
            let mut k = slope(false).transpose() * slope(false) * section.ea + slope(true).transpose() * slope(true) * section.gj;
            let (mut moved, mut turned) = (x * line(false), x * line(true));
            // along y with rotation about z, along z with rotation about -y
            for (d, about, ei) in [(y, z, section.ei[0]), (z, -y, section.ei[1])] {
                let ends = [unit(0, false, d), unit(0, true, about), unit(1, false, d), unit(1, true, about)];
                let by = |c: [f64; 4]| &ends[0] * c[0] + &ends[1] * c[1] + &ends[2] * c[2] + &ends[3] * c[3];
                let [v, phi, curvature, shear] = bent(ei, section.kga, l, xi * l).map(by);
                k += curvature.transpose() * &curvature * ei + shear.transpose() * &shear * section.kga;
                moved += d * v;
                turned += about * phi;
            }
            Self::add(&mut self.stiffness, &rows, &(&k * w));
            Self::add(&mut self.loss, &rows, &(&k * (w * loss)));
            let m = section.mass * w;
            for (d, square) in [(y, section.squares[0]), (z, section.squares[1])] {
                for sign in [-1.0, 1.0] {
                    let s = d * (sign * (2.0 * square).sqrt());
                    self.point(0.25 * m, (from + x * (xi * l), s), &rows, (&moved, &turned));
                }
            }
        }
        for d in [y, z] {
            let apart = unit(1, false, d) - unit(0, false, d);
            let pulled = apart.transpose() * &apart * (tension / l);
            Self::add(&mut self.turning, &rows, &pulled);
            Self::add(&mut self.strings, &rows, &pulled);
        }
    }

    /// The crank of a study with three nodes a bearing and one rod a throw, put together anew.
    pub fn new(study: &Study) -> Self {
        let (crank, flexible) = (study.crank.as_ref().expect("a crank"), study.flexible.as_ref().expect("flexible"));
        let spec = &flexible.spec;
        assert!(spec.nodes == BearingNodes::Three && crank.rods == 1 && crank.pin_bore == 0.0 && crank.journal_bore == 0.0);
        let Source::Cylinder { geometry, .. } = &study.engine.source else { unreachable!("a cylinder") };
        let rod = rod_mass(geometry);
        let mut plan = Plan::new(study, crank, spec, rod);
        let n = 6 * plan.places.len();
        let zero = || DMatrix::zeros(n, n);
        let mut model = Self {
            places: std::mem::take(&mut plan.places),
            mass: zero(),
            gyro: zero(),
            turning: zero(),
            stiffness: zero(),
            loss: zero(),
            damping: zero(),
            circulatory: zero(),
            pins: plan.pins.clone(),
            directions: plan.directions.clone(),
            study: study.clone(),
            points: Vec::new(),
            polars: plan.polars.clone(),
            strings: zero(),
            bearings: plan.bearings.clone(),
        };
        for (first, (section, tension)) in plan.beams.iter().enumerate() {
            model.beam(first, *section, (spec.loss_factor, *tension));
        }
        for (node, m, centre, directions, squares) in plan.bodies {
            model.body(node, m, centre, directions, squares);
        }
        for (node, polar) in plan.polars {
            model.mass[(6 * node + 5, 6 * node + 5)] += polar;
        }
        let own = spec.bearing.point(0, 0, 3);
        let (k, c) = (own.stiffness, own.damping);
        for node in plan.bearings.iter().flatten().map(|n| 6 * n) {
            for i in 0..2 {
                model.stiffness[(node + i, node + i)] += k;
                model.damping[(node + i, node + i)] += c;
            }
            model.circulatory[(node, node + 1)] -= c;
            model.circulatory[(node + 1, node)] += c;
        }
        let thrust = 6 * plan.bearings[spec.thrust_at][1] + 2;
        model.stiffness[(thrust, thrust)] += spec.thrust.stiffness;
        model.damping[(thrust, thrust)] += spec.thrust.damping;
        for (t, pin) in plan.pins.iter().enumerate() {
            let [_, tangential] = plan.directions[t];
            let c = study.chain.stations[t + 1].damping_to_ground / crank.crank_radius.powi(2);
            for (i, j) in (0..2).flat_map(|i| (0..2).map(move |j| (i, j))) {
                model.damping[(6 * pin + i, 6 * pin + j)] += c * tangential[i] * tangential[j];
            }
        }
        model
    }

    /// Radial and tangential force of the cylinder that fires at 0°, as phasors of an order: from its cycle at every sample.
    fn forces(&self, order: f64, speed: f64) -> [C; 2] {
        let loads = throw_loads(&self.study.engine, speed).expect("a cylinder");
        let first = self.study.engine.layout.firing_deg.iter().position(|deg| *deg == 0.0).expect("one fires at 0°");
        let (n, angle) = (loads.theta.len() as f64, pin_angles(&self.study.engine)[first]);
        let phasor = |k: usize| {
            let one = |(theta, force): (&f64, &[f64; 2])| C::from_polar(2.0 / n * crank_fixed(*force, theta + angle)[k], -order * theta);
            loads.theta.iter().zip(&loads.rod_force[first]).map(one).sum::<C>()
        };
        [phasor(0), phasor(1)]
    }

    /// Angle of the first node about the axis less that of the last.
    pub fn twist(&self, design: &[Mounted], order: f64, speed_rpm: f64) -> C {
        let q = self.motion(design, order, speed_rpm);
        q[5] - q[self.mass.nrows() - 1]
    }

    /// Motion of all nodes, then of the rings.
    pub fn motion(&self, design: &[Mounted], order: f64, speed_rpm: f64) -> DVector<C> {
        let speed = speed_rpm * TAU / 60.0;
        let (omega, n) = (order * speed, self.mass.nrows());
        let rings = design.len();
        let part = |i: usize, j: usize| {
            let re = self.stiffness[(i, j)] - omega * omega * self.mass[(i, j)]
                + speed * speed * self.turning[(i, j)]
                + speed * self.circulatory[(i, j)];
            C::new(re, self.loss[(i, j)] + omega * (self.damping[(i, j)] + speed * self.gyro[(i, j)]))
        };
        let mut all = DMatrix::from_fn(n + rings, n + rings, |i, j| if i < n && j < n { part(i, j) } else { C::new(0.0, 0.0) });
        for (k, mounted) in design.iter().enumerate() {
            let law = mounted.absorber.law().expect("a ring on a law");
            let s = law.dynamic_stiffness(Operating { omega, shaft_speed: speed });
            let (hub, ring) = (5, n + k);
            all[(hub, hub)] += s;
            all[(hub, ring)] -= s;
            all[(ring, hub)] -= s;
            all[(ring, ring)] += s - omega * omega * law.ring_inertia();
        }
        let force = self.on_pins(order, speed_rpm).resize_vertically(n + rings, C::new(0.0, 0.0));
        all.lu().solve(&force).expect("damped")
    }

    /// Forces of the rods on the unknowns of all nodes.
    pub fn on_pins(&self, order: f64, speed_rpm: f64) -> DVector<C> {
        let mut force = DVector::from_element(self.mass.nrows(), C::new(0.0, 0.0));
        let [radial, tangential] = self.forces(order, speed_rpm);
        for (t, pin) in self.pins.iter().enumerate() {
            let turn = C::from_polar(1.0, -order * self.study.engine.layout.firing_deg[t].to_radians());
            for i in 0..2 {
                force[6 * pin + i] += turn * (radial * self.directions[t][0][i] + tangential * self.directions[t][1][i]);
            }
        }
        force
    }

    /// Stiffness, its part that dissipates, and damping of what turns with the crank: all but the bearings.
    pub fn of_the_crank(&self) -> [DMatrix<f64>; 3] {
        let own = self.study.flexible.as_ref().expect("flexible").spec.bearing.point(0, 0, 3);
        let [mut stiffness, loss, mut damping] = [&self.stiffness, &self.loss, &self.damping].map(Clone::clone);
        for i in self.bearings.iter().flatten().flat_map(|n| [6 * n, 6 * n + 1]) {
            stiffness[(i, i)] -= own.stiffness;
            damping[(i, i)] -= own.damping;
        }
        [stiffness, loss, damping]
    }
}
