//! A beam from a node to the next: Timoshenko's, with the exact shape functions of its bending.

use super::{Real, across, cross, gyroscopic, tilting};
use nalgebra::{Matrix3, SMatrix, Vector3};

/// A matrix over both nodes of a beam.
type Pair = SMatrix<f64, 12, 12>;
/// Motion of a point or a section by those of the nodes.
type Motion = SMatrix<f64, 3, 12>;

/// Section of a beam with local axes x along it, y and z across it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    /// E A, N.
    pub axial: f64,
    /// kappa G A, N; infinite without shear deformation.
    pub shear: f64,
    /// E I of bending along y (I: integral of y²) and along z, N m².
    pub bending: [f64; 2],
    /// G J, N m².
    pub torsion: f64,
    /// rho A, kg/m.
    pub mass: f64,
    /// rho times the integrals of z² and y²: inertia against rotation about y and about z, kg m.
    pub rotary: [f64; 2],
}

/// A beam between two nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct Beam {
    /// What it is made of.
    pub section: Section,
    /// m.
    pub length: f64,
    /// Local axes in rows, the first along the beam.
    pub axes: Matrix3<f64>,
    /// Tension per square of the speed, kg m.
    pub tension: f64,
}

/// Its matrices in turning axes: K, M, G, and K_s + Kc - Z.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct OnNodes {
    pub stiffness: Pair,
    pub mass: Pair,
    pub gyroscopic: Pair,
    pub turning: Pair,
}

/// Gauss–Legendre points in (0, 1) and their weights; four are exact for products of two cubics.
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_92),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_05),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_05),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_92),
];

impl Beam {
    /// 12 E I/(kappa G A L²) of bending along y and along z.
    fn phi(&self) -> [f64; 2] {
        self.section.bending.map(|ei| 12.0 * ei / (self.section.shear * self.length * self.length))
    }

    /// Bending along y, then along z, of end displacements and slopes, as places and signs in the local vector.
    const PLANES: [([usize; 4], f64); 2] = [([1, 5, 7, 11], 1.0), ([2, 4, 8, 10], -1.0)];

    /// K in local axes.
    fn local_stiffness(&self) -> Pair {
        let (s, l) = (&self.section, self.length);
        let mut k = Pair::zeros();
        for (i, value) in [(0, s.axial / l), (3, s.torsion / l)] {
            (k[(i, i)], k[(i + 6, i + 6)], k[(i, i + 6)], k[(i + 6, i)]) = (value, value, -value, -value);
        }
        for ((places, sign), (ei, phi)) in Self::PLANES.into_iter().zip(s.bending.into_iter().zip(self.phi())) {
            let (a, b) = (6.0 * l * sign, l * l);
            let rows = [
                [12.0, a, -12.0, a],
                [a, (4.0 + phi) * b, -a, (2.0 - phi) * b],
                [-12.0, -a, 12.0, -a],
                [a, (2.0 - phi) * b, -a, (4.0 + phi) * b],
            ];
            let scale = ei / (l * l * l * (1.0 + phi));
            for (i, row) in places.iter().zip(rows) {
                places.iter().zip(row).for_each(|(j, value)| k[(*i, *j)] += scale * value);
            }
        }
        k
    }

    /// Displacement and rotation of the section at xi (0 to 1) by the local motions of the nodes.
    fn shapes(&self, xi: f64) -> [Motion; 2] {
        let (mut moved, mut turned) = (Motion::zeros(), Motion::zeros());
        for (row, place) in [(&mut moved, 0), (&mut turned, 3)] {
            (row[(0, place)], row[(0, place + 6)]) = (1.0 - xi, xi);
        }
        let (l, x2, x3) = (self.length, xi * xi, xi * xi * xi);
        for (plane, ((places, sign), phi)) in Self::PLANES.into_iter().zip(self.phi()).enumerate() {
            let m = 1.0 / (1.0 + phi);
            let along = [
                1.0 - 3.0 * x2 + 2.0 * x3 + phi * (1.0 - xi),
                l * (xi - 2.0 * x2 + x3 + 0.5 * phi * (xi - x2)) * sign,
                3.0 * x2 - 2.0 * x3 + phi * xi,
                l * (x3 - x2 - 0.5 * phi * (xi - x2)) * sign,
            ];
            let slope = [
                6.0 * (x2 - xi) / l * sign,
                1.0 - 4.0 * xi + 3.0 * x2 + phi * (1.0 - xi),
                6.0 * (xi - x2) / l * sign,
                3.0 * x2 - 2.0 * xi + phi * xi,
            ];
            for (i, place) in places.into_iter().enumerate() {
                moved[(plane + 1, place)] = m * along[i];
                turned[(2 - plane, place)] = m * slope[i];
            }
        }
        [moved, turned]
    }

    /// In turning axes.
    fn turned(&self, local: Pair) -> Pair {
        let all = self.transformation();
        all.transpose() * local * all
    }

    /// Local from turning axes, both nodes.
    fn transformation(&self) -> Pair {
        let mut all = Pair::zeros();
        (0..4).for_each(|i| all.fixed_view_mut::<3, 3>(3 * i, 3 * i).copy_from(&self.axes));
        all
    }

    /// Its matrices.
    pub(crate) fn matrices(&self) -> OnNodes {
        let (s, to_local, back) = (&self.section, self.transformation(), self.axes.transpose());
        let rotary = Matrix3::from_diagonal(&Vector3::new(s.rotary[0] + s.rotary[1], s.rotary[0], s.rotary[1]));
        let tensor = back * rotary * self.axes;
        let e = Vector3::z();
        let (mut mass, mut gyro, mut turning) = (Pair::zeros(), Pair::zeros(), Pair::zeros());
        for (xi, weight) in GAUSS {
            let [moved, turned] = self.shapes(xi).map(|shapes| back * shapes * to_local);
            let w = weight * self.length;
            let product = |left: &Motion, middle: Matrix3<f64>, right: &Motion| left.transpose() * middle * right;
            mass += (product(&moved, Matrix3::identity() * s.mass, &moved) + product(&turned, tensor, &turned)) * w;
            gyro += (product(&moved, cross(e) * (2.0 * s.mass), &moved) + product(&turned, gyroscopic(&tensor), &turned)) * w;
            turning += (product(&turned, tilting(&tensor), &turned) - product(&moved, across() * s.mass, &moved)) * w;
        }
        OnNodes { stiffness: self.turned(self.local_stiffness()), mass, gyroscopic: gyro, turning: turning + self.turned(self.string()) }
    }

    /// What the part of the shaft behind its first and its second end exerts on the part before it, in turning axes: force, then moment, by the motions of both nodes.
    pub(crate) fn through_ends(&self) -> [SMatrix<f64, 6, 12>; 2] {
        let stiffness = self.turned(self.local_stiffness());
        [-stiffness.fixed_rows::<6>(0), stiffness.fixed_rows::<6>(6).into_owned()]
    }

    /// N/L [1 -1; -1 1] on both transverse motions.
    fn string(&self) -> Pair {
        let mut k = Pair::zeros();
        let value = self.tension / self.length;
        for i in [1, 2] {
            (k[(i, i)], k[(i + 6, i + 6)], k[(i, i + 6)], k[(i + 6, i)]) = (value, value, -value, -value);
        }
        k
    }
}

/// Blocks of a matrix over two nodes: of the first, of the second, of the first by the second.
pub(crate) fn blocks(pair: &Pair) -> [Real; 3] {
    let block = |i: usize, j: usize| pair.fixed_view::<6, 6>(i, j).into_owned();
    [block(0, 0), block(6, 6), block(0, 6)]
}
