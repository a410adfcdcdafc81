//! Outputs of a chain with two absorbers, over a box of their parameters, as quotients without a pole.
//!
//! A ring of inertia J on a law S (m = -omega² J, hub b = -omega² J_hub) loads its station with n/d, d = S + m, n = S m + b d. Of two of them an output is N/D, and N and D are linear in (d, n) of each:
//! with receptances H, angles u and an output y without them, h per unit torque, D = d1 d2 + n1 d2 H11 + d1 n2 H22 + n1 n2 (H11 H22 - H12 H21), and N has the determinants bordered by u, h and y in
//! their places. Where d and n are linear in each parameter, |N|² and |D|² are polynomials of second degree in each of them, which lie between the least and the largest of their Bernstein coefficients
//! over a box \[Garloff 1986\]. So |N/D| is at least a number wherever |N|² less its square times |D|² has no negative coefficient, whether D vanishes in the box or not.

use super::Quantity;
use super::enclosed::{BaseAtSpeed, Corners, Enclosed, Output, Point};
use crate::absorber::Operating;
use crate::numerics::taylor::{MOST, ROUNDING, Taylor};
use crate::numerics::{C64, I, ZERO};

/// Parameters of an absorber that polynomials are made of, at most.
const VARIABLES: usize = 3;
/// Roundings of a coefficient: of d and n, and of sums of sixteen products of four numbers.
const ROUNDINGS: f64 = 32.0 * ROUNDING;

/// |a|², |b|², and the real and imaginary part of a b*, of two pairs of numbers as one form of both.
fn products(a: [C64; 2], b: [C64; 2]) -> [f64; 4] {
    let mixed = 0.5 * (a[0] * b[1].conj() + b[0] * a[1].conj());
    let square = |i: usize| (a[i] * b[i].conj()).re;
    [square(0), square(1), mixed.re, mixed.im]
}

fn dot(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]
}

/// d and n of an absorber over a box.
#[derive(Debug, Clone, Copy)]
pub struct Loads {
    /// How many parameters are free.
    free: usize,
    /// Bernstein coefficients of the products of d and n, by places of the parameters: lowest, middle, highest, the first fastest.
    coefficients: [[f64; 4]; PLACES],
    /// The products in the middle.
    middle: [f64; 4],
    /// The largest d and n.
    reach: [f64; 2],
}

/// Places of a Bernstein coefficient for so many parameters of second degree.
const PLACES: usize = 3usize.pow(VARIABLES as u32);

impl Loads {
    /// `None` where too many parameters are free, or S is no quotient.
    fn of(absorber: &Corners, at: Operating) -> Option<Self> {
        let (free, count) = (absorber.variables().len(), absorber.len());
        if free > VARIABLES {
            return None;
        }
        let mut corners = [[ZERO; 2]; 1 << VARIABLES];
        for (i, corner) in corners.iter_mut().enumerate().take(count) {
            *corner = absorber.load(i, at)?;
        }
        let mut coefficients = [[0.0; 4]; PLACES];
        for (found, (middle, high)) in coefficients.iter_mut().zip(SIDES).take(3usize.pow(free as u32)) {
            // in the middle place of a parameter one factor is that of its lowest, the other that of its highest value
            let (mut c, mut ways) = (middle, 0.0);
            loop {
                let one = products(corners[high | c], corners[high | (middle & !c)]);
                found.iter_mut().zip(one).for_each(|(a, b)| *a += b);
                ways += 1.0;
                if c == 0 {
                    break;
                }
                c = (c - 1) & middle;
            }
            found.iter_mut().for_each(|a| *a /= ways);
        }
        let own = &corners[..count];
        let middle = [0, 1].map(|i| own.iter().map(|c| c[i]).sum::<C64>() / count as f64);
        // what is linear in each parameter is largest at a corner
        let reach = [0, 1].map(|i| own.iter().map(|c| c[i].norm_sqr()).fold(0.0, f64::max).sqrt());
        Some(Self { free, coefficients, middle: products(middle, middle), reach })
    }

    /// Those that there are.
    fn coefficients(&self) -> &[[f64; 4]] {
        &self.coefficients[..3usize.pow(self.free as u32)]
    }
}

/// Of each place the parameters (a bit each) that are in the middle, and those that are at their highest.
const SIDES: [(usize, usize); PLACES] = {
    let mut sides = [(0, 0); PLACES];
    let mut place = 0;
    while place < PLACES {
        let (mut k, mut rest) = (0, place);
        while k < VARIABLES {
            match rest % 3 {
                1 => sides[place].0 |= 1 << k,
                2 => sides[place].1 |= 1 << k,
                _ => {}
            }
            rest /= 3;
            k += 1;
        }
        place += 1;
    }
    sides
};

/// A real form of the products of the first and of the second absorber.
type Form = [[f64; 4]; 4];

/// a b* of two numbers that are linear in d and n of one absorber, by its products: of d and n the coefficients.
fn by_products(a: [C64; 2], b: [C64; 2]) -> [C64; 4] {
    let (forth, back) = (a[0] * b[1].conj(), a[1] * b[0].conj());
    [a[0] * b[0].conj(), a[1] * b[1].conj(), forth + back, (forth - back) * I]
}

/// Real and imaginary part of a b* of two numbers that are linear in d and n of both absorbers: of d1 d2, n1 d2, d1 n2 and n1 n2 the coefficients.
fn product(a: [C64; 4], b: [C64; 4]) -> [Form; 2] {
    // of d1 and of n1, by the second absorber
    let [a, b] = [a, b].map(|[dd, nd, dn, nn]| [[dd, dn], [nd, nn]]);
    let (forth, back) = (by_products(a[0], b[1]), by_products(a[1], b[0]));
    let both = |of: &dyn Fn(C64, C64) -> C64| [0, 1, 2, 3].map(|i| of(forth[i], back[i]));
    let rows = [by_products(a[0], b[0]), by_products(a[1], b[1]), both(&|x, y| x + y), both(&|x, y| (x - y) * I)];
    [rows.map(|row| row.map(|z| z.re)), rows.map(|row| row.map(|z| z.im))]
}

/// What is linear in d and n of each of two absorbers.
#[derive(Debug, Clone)]
struct Bilinear {
    /// Its square.
    square: Form,
    /// Sizes of its coefficients and what these may be off by: of d1 d2, n1 d2, d1 n2, n1 n2.
    sizes: [f64; 4],
    rests: [f64; 4],
}

impl Bilinear {
    fn new(of: [Taylor; 4]) -> Self {
        let centres = of.map(|y| y.centre);
        let [square, _] = product(centres, centres);
        Self { square, sizes: centres.map(C64::norm), rests: of.map(|y| y.rest) }
    }

    /// Sizes of the products of both by d1 d2, n1 d2, d1 n2 and n1 n2.
    fn loads([a, b]: [&Loads; 2]) -> [f64; 4] {
        [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| a.reach[i] * b.reach[j])
    }

    /// No number of a box is larger.
    fn largest(&self, loads: [&Loads; 2]) -> f64 {
        Self::loads(loads).iter().enumerate().map(|(k, load)| (self.sizes[k] + self.rests[k]) * load).sum()
    }

    /// What it may be off by for its coefficients.
    fn off(&self, loads: [&Loads; 2]) -> f64 {
        dot(&self.rests, &Self::loads(loads))
    }

    /// What a coefficient of its square may be off by, over a box.
    fn lost(&self, loads: [&Loads; 2]) -> f64 {
        let most = self.largest(loads);
        most * (2.0 * self.off(loads) + ROUNDINGS * most)
    }
}

/// An output at an order with two absorbers.
#[derive(Debug, Clone)]
pub struct Quotient {
    numerator: Bilinear,
    denominator: Bilinear,
    /// Real and imaginary part of numerator times conjugate denominator.
    product: [Form; 2],
}

/// Coefficients of a quotient over a box: of the squares of numerator and denominator.
#[derive(Debug, Default)]
pub struct Coefficients {
    numerator: Vec<f64>,
    denominator: Vec<f64>,
}

impl Quotient {
    /// Numerator and denominator by d1 d2, n1 d2, d1 n2 and n1 n2.
    fn new(numerator: [Taylor; 4], denominator: [Taylor; 4]) -> Self {
        let product = product(numerator.map(|y| y.centre), denominator.map(|y| y.centre));
        Self { numerator: Bilinear::new(numerator), denominator: Bilinear::new(denominator), product }
    }

    /// In the middle of a box.
    pub fn middle(&self, [a, b]: [&Loads; 2]) -> C64 {
        let of = |x: &Form| dot(&a.middle, &times(x, &b.middle));
        C64::new(of(&self.product[0]), of(&self.product[1])) / of(&self.denominator.square)
    }

    /// Its size is nowhere below this over a box; leaves the coefficients.
    pub fn least(&self, loads: [&Loads; 2], found: &mut Coefficients) -> f64 {
        let [a, b] = loads;
        let (lost, more) = (self.numerator.lost(loads), self.denominator.lost(loads));
        found.numerator.clear();
        found.denominator.clear();
        let mut least = f64::INFINITY;
        for second in b.coefficients() {
            let (n, d) = (times(&self.numerator.square, second), times(&self.denominator.square, second));
            for first in a.coefficients() {
                let (above, below) = (dot(first, &n) - lost, dot(first, &d) + more);
                found.numerator.push(above);
                found.denominator.push(below);
                least = smaller(least, ratio(above, below));
            }
        }
        if least > 0.0 { least.sqrt() * (1.0 - ROUNDINGS) } else { 0.0 }
    }

    /// The real part of it times a number is nowhere below this over a box: minus infinity where it may have a pole.
    pub fn least_along(&self, loads: [&Loads; 2], by: C64) -> f64 {
        let [a, b] = loads;
        let mut along = self.product[0];
        let turned = along.iter_mut().flatten().zip(self.product[1].iter().flatten());
        turned.for_each(|(re, im)| *re = by.re * *re - by.im * im);
        // of a product each is off by what its factors are
        let (n, d) = (self.numerator.largest(loads), self.denominator.largest(loads));
        let lost = by.norm() * (n * self.denominator.off(loads) + d * self.numerator.off(loads) + ROUNDINGS * n * d);
        let d = self.denominator.lost(loads);
        let mut least = f64::INFINITY;
        for second in b.coefficients() {
            let (p, q) = (times(&along, second), times(&self.denominator.square, second));
            for first in a.coefficients() {
                let (above, below) = (dot(first, &p) - lost, dot(first, &q));
                if below - d <= 0.0 || (below - d).is_nan() {
                    return f64::NEG_INFINITY;
                }
                // of a negative numerator the smaller denominator counts
                let below = if above < 0.0 { below - d } else { below + d };
                least = smaller(least, above / below);
            }
        }
        // with that of a sum of some tens of them
        least - ROUNDINGS * least.abs()
    }
}

/// A form of products at a place of the second absorber.
fn times(form: &Form, second: &[f64; 4]) -> [f64; 4] {
    [0, 1, 2, 3].map(|i| dot(&form[i], second))
}

/// What a nonnegative quantity is at least times another one, by their coefficients.
fn ratio(above: f64, below: f64) -> f64 {
    match (below > 0.0, above >= 0.0) {
        (true, _) => above / below,
        (false, true) => f64::INFINITY,
        (false, false) => f64::NEG_INFINITY,
    }
}

/// The smaller of two numbers; one that is none counts as the smallest.
fn smaller(a: f64, b: f64) -> f64 {
    if b >= a {
        a
    } else if b < a {
        b
    } else {
        f64::NEG_INFINITY
    }
}

impl Coefficients {
    /// A linear function of the parameters (from -1 to 1 each) that is at least one only where the output reaches a size: its value in the middle and its slopes, for variables of these indices.
    pub fn linear(&self, loads: [&Loads; 2], variables: [&[usize]; 2], most: f64) -> (f64, [f64; MOST]) {
        let (first, all) = (loads[0].coefficients().len(), self.numerator.len());
        let square = most * most;
        let values = || self.numerator.iter().zip(&self.denominator).map(|(n, d)| n - square * d).enumerate();
        let places = |i: usize| [(variables[0], i % first), (variables[1], i / first)];
        let mut slopes = [0.0; MOST];
        for (i, value) in values() {
            for (own, place) in places(i) {
                own.iter().enumerate().for_each(|(k, v)| slopes[*v] += side(k, place) * value);
            }
        }
        // a third of all places is on each side
        slopes.iter_mut().for_each(|s| *s /= all as f64 * 2.0 / 3.0);
        let beside = |(own, place): (&[usize], usize)| own.iter().enumerate().map(|(k, v)| side(k, place) * slopes[*v]).sum::<f64>();
        let least = values().map(|(i, value)| value - places(i).map(beside).iter().sum::<f64>()).fold(f64::INFINITY, smaller);
        let size = square * self.denominator.iter().map(|d| d.abs()).sum::<f64>();
        let scale = all as f64 / (2.0 * size.max(f64::MIN_POSITIVE));
        (1.0 + scale * least, slopes.map(|s| scale * s))
    }
}

/// Where a parameter is in a place: -1, 0 or 1.
fn side(parameter: usize, place: usize) -> f64 {
    let (middle, high) = SIDES[place];
    match (high >> parameter & 1, middle >> parameter & 1) {
        (1, _) => 1.0,
        (_, 1) => 0.0,
        _ => -1.0,
    }
}

impl Point {
    /// The quantities of the chain with absorbers at two of its stations; `None` of rings.
    fn quotients(&self, [a, b]: [usize; 2], quantities: &[Quantity]) -> Vec<Option<Quotient>> {
        let (h, u) = (&self.receptances, &self.angles);
        let none = Taylor::constant(ZERO);
        let both = h[a][a].times(&h[b][b]).minus(&h[a][b].times(&h[b][a]));
        let is_one = a == b;
        let denominator = [Taylor::constant(C64::from(1.0)), h[a][a], h[b][b], if is_one { none } else { both }];
        let of = |y: &Taylor, by: &[Taylor]| {
            let with = |i: usize| y.times(&h[i][i]).minus(&by[i].times(&u[i]));
            // the torques of both under u, times their determinant
            let torque = |i: usize, j: usize| h[j][j].times(&u[i]).minus(&h[i][j].times(&u[j]));
            let all = || y.times(&both).minus(&by[a].times(&torque(a, b))).minus(&by[b].times(&torque(b, a)));
            [*y, with(a), with(b), if is_one { none } else { all() }]
        };
        let is_of_ring = |q: &Quantity| matches!(q, Quantity::RingTwist(_));
        let quotient = |(o, q): (&Output, &Quantity)| (!is_of_ring(q)).then(|| Quotient::new(of(&o.own, &o.by), denominator));
        self.outputs.iter().zip(quantities).map(quotient).collect()
    }
}

impl BaseAtSpeed {
    /// The quantities that the base was made for with absorbers at two of its stations, order after order; `None` of rings.
    pub fn quotients(&self, stations: [usize; 2], quantities: &[Quantity]) -> Vec<Vec<Option<Quotient>>> {
        self.points.iter().map(|p| p.quotients(stations, quantities)).collect()
    }

    /// Two absorbers at an order over their box; `None` where there is no polynomial of theirs.
    pub fn loads(&self, [a, b]: &[Corners; 2], order: usize) -> Option<[Loads; 2]> {
        Some([Loads::of(a, self.at[order])?, Loads::of(b, self.at[order])?])
    }
}

/// Two absorbers with parameters of their own, or one; `None` otherwise.
pub fn pair(absorbers: &[Enclosed]) -> Option<[Corners; 2]> {
    let (a, b) = match absorbers {
        [a] => (a.corners()?, Corners::none()),
        [a, b] => (a.corners()?, b.corners()?),
        _ => return None,
    };
    a.variables().iter().all(|i| !b.variables().contains(i)).then_some([a, b])
}
