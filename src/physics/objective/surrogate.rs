//! The peak of a synthesis over speed, or of how much of the crank's strength it uses, from tables alone, for searches that look at many designs: every few
//! speeds first, then the grid speeds round the largest values, then the vertex of a parabola. No direct solution; an estimate of its own error.

use super::measure::{Measure, Over, Within};
use super::point_metric::PointMetric;
use crate::absorber::{Host, Law, Mounted};
use crate::crankshaft::Margin;
use crate::drivetrain::natural;
use crate::numerics::C64;
use crate::numerics::interpolation::Interpolation;
use crate::numerics::synthesis::{Extremes, Samples, Synthesiser};
use crate::response::receptance::{Rows, every};
use crate::response::{Quantity, Receptance, Response, Work};

/// A surrogate peak.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimated {
    /// Half peak-to-peak, rad or N m; share of the strength.
    pub value: f64,
    /// Estimate of its error, relative.
    pub error: f64,
}

/// Finds surrogate peaks of one measure for absorbers on one station.
#[derive(Debug, Clone)]
pub struct Surrogate<'a> {
    measure: Measure,
    margin: Option<&'a Margin>,
    stride: usize,
    speed_rpm: Vec<f64>,
    kink: Vec<bool>,
    orders: usize,
    /// Of every quantity of the measure.
    tables: Vec<Table>,
    /// Indices of the speeds of its coarse rows.
    coarse_index: Vec<usize>,
    synthesiser: Synthesiser,
}

/// Tables of one quantity.
#[derive(Debug, Clone)]
struct Table {
    /// Rows of every so many speeds, and of the last.
    coarse: Rows,
    /// Rows of all speeds.
    fine: Rows,
}

/// The phasors of one quantity of one design, speed by speed, and what is made of them.
struct Curve<'s> {
    rows: &'s Rows,
    metric: PointMetric<'s>,
    mounted: &'s Mounted,
    speed_rpm: &'s [f64],
    synthesiser: &'s Synthesiser,
}

impl Curve<'_> {
    /// The extremes one Newton step or two from known ones.
    fn near(&self, i: usize, from: &Extremes, steps: usize, row: &mut [C64]) -> Extremes {
        self.rows.phasors(self.mounted, i, row);
        (0..steps).fold(*from, |known, _| self.synthesiser.near(row, &known))
    }

    /// Value at a speed of the grid.
    fn value(&self, i: usize, extremes: &Extremes) -> f64 {
        self.metric.value(self.speed_rpm[i], extremes, &[])
    }
}

/// Buffers of one thread, and what the last designs were given up for.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    phasors: Vec<C64>,
    bounds: Vec<f64>,
    values: Vec<f64>,
    samples: Samples,
    row: Vec<C64>,
    /// Quantities and coarse speeds at which designs were given up, the latest first.
    fatal: Vec<(usize, usize)>,
}

/// Local maxima among the coarse speeds that are looked at closely, the largest first, and the share of the largest that they must reach.
const TOPS: usize = 3;
const TOP_SHARE: f64 = 0.9;
/// The sum of magnitudes overstates the synthesis by much the same factor at all speeds: a speed is left out where it would have to overstate this
/// much less than at any speed seen.
const OVERSTATED: f64 = 1.3;
/// A neighbour whose extremes are higher by this share than those followed from the middle is on another branch.
const OTHER_BRANCH: f64 = 1e-6;
/// Weights of the difference between the parabola of single spacing and the quartic, and of that to the parabola of double spacing. A smooth peak errs by the fourth power of
/// the spacing, so that a fifteenth of the second is the error, which the first is where the quartic is right; what is not so smooth needs more.
const DOUBT: f64 = 2.0;
const SAFETY: f64 = 0.5;
/// Error of a value that is not interpolated: rounding.
const ROUNDING: f64 = 1e-9;
/// Beside the ends of the range there is no second parabola.
const BESIDE_END: f64 = 1e-3;
/// Damping ratio of a ring on its hub below which its resonance may hide.
const LEAST_DAMPING: f64 = 0.02;
/// Speeds remembered for giving up early.
const REMEMBERED: usize = 3;

impl<'a> Surrogate<'a> {
    /// Of the synthesis of a quantity, by every `stride`-th speed of the grid; nothing where the quantity has no table without holes.
    pub fn new(receptance: &Receptance, quantity: Quantity, stride: usize) -> Option<Self> {
        Self::of(receptance, &Measure::new(vec![quantity], Over::Synthesis), None, stride)
    }

    /// Of a measure; nothing of one that tables cannot answer for: over a part of the range, or by a criterion that asks for the whole sum.
    pub fn of(receptance: &Receptance, measure: &Measure, margin: Option<&'a Margin>, stride: usize) -> Option<Self> {
        let extremes_decide = match measure.over {
            Over::Synthesis => measure.quantities.len() == 1,
            Over::Margin(criterion) => margin.is_some_and(|m| !m.is_multiaxial(criterion)),
            _ => false,
        };
        if !extremes_decide || measure.within != Within::default() {
            return None;
        }
        let (system, grid) = (receptance.system(), receptance.grid());
        let coarse_index: Vec<usize> = every(stride, grid.len()).collect();
        let table = |q: &Quantity| Some(Table { coarse: receptance.rows(*q, stride)?, fine: receptance.rows(*q, 1)? });
        Some(Self {
            measure: measure.clone(),
            margin,
            stride,
            speed_rpm: grid.speed_rpm.clone(),
            kink: grid.kink.clone(),
            orders: system.orders(),
            tables: measure.quantities.iter().map(table).collect::<Option<_>>()?,
            coarse_index,
            synthesiser: Synthesiser::new(&system.excitation.harmonics),
        })
    }

    /// What it answers for.
    pub(super) fn measure(&self) -> &Measure {
        &self.measure
    }

    /// Every how many grid speeds are looked at first.
    pub fn stride(&self) -> usize {
        self.stride
    }

    /// Whether tables can answer for an absorber: it sits on their station, and its own resonance is not so narrow that it may hide between grid
    /// speeds.
    pub fn takes(&self, mounted: &Mounted) -> bool {
        let hides = |law: &dyn Law| match law.spring_and_damper() {
            Some(s) => {
                let ratio = s.damping / (2.0 * (s.stiffness * law.ring_inertia()).sqrt());
                s.stiffness != 0.0 && (ratio.is_nan() || ratio < LEAST_DAMPING)
            }
            None => law.depends_on_speed() || !natural::own_loss_factor(law).is_none_or(|loss| 0.5 * loss >= LEAST_DAMPING),
        };
        let station = self.tables.first().map(|t| Host::Station(t.fine.station));
        station == Some(mounted.on) && !mounted.absorber.law().is_some_and(|law| hides(law.as_ref()))
    }

    /// The peak of an absorber on the table's station.
    pub fn peak(&self, mounted: &Mounted, s: &mut Scratch, work: &mut Work) -> Estimated {
        self.peak_below(mounted, f64::INFINITY, s, work).unwrap_or(Estimated { value: f64::INFINITY, error: 0.0 })
    }

    fn metric(&self, table: usize) -> PointMetric<'_> {
        PointMetric::of(self.measure.over, self.measure.quantities[table], &self.measure.within, self.margin, None)
    }

    fn coarse_speed(&self, i: usize) -> f64 {
        self.speed_rpm[self.coarse_index[i]]
    }

    /// The peak, or nothing where the values at the coarse speeds show that it lies above `best`: such a design cannot win.
    pub fn peak_below(&self, mounted: &Mounted, best: f64, s: &mut Scratch, work: &mut Work) -> Option<Estimated> {
        if best.is_finite() && self.is_hopeless(mounted, best, s, work) {
            return None;
        }
        let (count, tables) = (self.coarse_index.len(), self.tables.len());
        s.phasors.resize(tables * count * self.orders, C64::ZERO);
        for (table, phasors) in self.tables.iter().zip(s.phasors.chunks_mut((count * self.orders).max(1))) {
            table.coarse.phasors(mounted, 0, phasors);
        }
        work.receptance_points += s.phasors.len() as u64;
        s.bounds.clear();
        s.bounds.extend(s.phasors.chunks(self.orders).map(bound));
        s.values.clear();
        s.values.resize(tables * count, f64::NEG_INFINITY);
        let mut top = 0.0;
        for table in 0..tables {
            let metric = self.metric(table);
            let own = table * count..(table + 1) * count;
            let first = own.clone().fold(own.start, |m, i| if s.bounds[i] > s.bounds[m] { i } else { m });
            let mut share = 0.0;
            for i in std::iter::once(first).chain(own) {
                let speed = self.coarse_speed(i % count);
                let able = s.bounds[i] * share * OVERSTATED;
                if s.values[i] > f64::NEG_INFINITY || (share > 0.0 && metric.at_most(speed, able, able) < top) {
                    continue;
                }
                self.synthesiser.sample(&s.phasors[i * self.orders..(i + 1) * self.orders], &mut s.samples);
                work.syntheses += 1;
                s.values[i] = metric.value(speed, &s.samples.extremes(), &[]);
                if s.values[i] > best {
                    s.fatal.insert(0, (table, i % count));
                    s.fatal.truncate(REMEMBERED);
                    return None;
                }
                top = if s.values[i] > top { s.values[i] } else { top };
                let sampled = s.samples.half_peak_to_peak();
                share = if s.bounds[i] > 0.0 { f64::max(share, sampled / s.bounds[i]) } else { share };
            }
        }
        let is_top = |i: &usize| {
            let own = i / count * count..(i / count + 1) * count;
            let beside = |j: usize| !own.contains(&j) || s.values[*i] >= s.values[j];
            s.values[*i] >= TOP_SHARE * top && beside(i.wrapping_sub(1)) && beside(i + 1)
        };
        let mut tops: Vec<usize> = (0..tables * count).filter(is_top).collect();
        tops.sort_by(|a, b| s.values[*b].total_cmp(&s.values[*a]));
        let mut found = Estimated { value: 0.0, error: 0.0 };
        for &i in tops.iter().take(TOPS) {
            let peak = self.closely((mounted, i / count), self.coarse_index[i % count], s, work);
            if peak.value > found.value {
                found = peak;
            }
        }
        Some(found)
    }

    /// Whether the speeds at which the last designs were given up show the same of this one.
    fn is_hopeless(&self, mounted: &Mounted, best: f64, s: &mut Scratch, work: &mut Work) -> bool {
        s.row.resize(self.orders, C64::ZERO);
        for place in 0..s.fatal.len() {
            let (table, i) = s.fatal[place];
            self.tables[table].coarse.phasors(mounted, i, &mut s.row);
            self.synthesiser.sample(&s.row, &mut s.samples);
            work.receptance_points += self.orders as u64;
            work.syntheses += 1;
            if self.metric(table).value(self.coarse_speed(i), &s.samples.extremes(), &[]) > best {
                s.fatal[..=place].rotate_right(1);
                return true;
            }
        }
        false
    }

    /// Climbs along the grid from speed `start`, then to the vertices of the branches near the top.
    fn closely(&self, (mounted, table): (&Mounted, usize), start: usize, s: &mut Scratch, work: &mut Work) -> Estimated {
        let last = self.speed_rpm.len() - 1;
        let mut row = std::mem::take(&mut s.row);
        row.resize(self.orders, C64::ZERO);
        let (rows, metric) = (&self.tables[table].fine, self.metric(table));
        let curve = Curve { rows, metric, mounted, speed_rpm: &self.speed_rpm, synthesiser: &self.synthesiser };
        // extremes, and the value that they make
        let mut whole = |i: usize| -> (Extremes, f64) {
            rows.phasors(mounted, i, &mut row);
            self.synthesiser.sample(&row, &mut s.samples);
            work.receptance_points += self.orders as u64;
            work.syntheses += 1;
            let extremes = self.synthesiser.near_samples(&s.samples);
            (extremes, curve.value(i, &extremes))
        };
        let none = (Extremes::default(), 0.0);
        let (mut i, mut here) = (start, whole(start));
        let (mut low, mut high) = (None, None);
        // every step climbs
        loop {
            let left = *low.get_or_insert_with(|| if i > 0 { whole(i - 1) } else { none });
            if left.1 > here.1 {
                (high, here, low, i) = (Some(here), left, None, i - 1);
                continue;
            }
            let right = *high.get_or_insert_with(|| if i < last { whole(i + 1) } else { none });
            if right.1 > here.1 {
                (low, here, high, i) = (Some(here), right, None, i + 1);
                continue;
            }
            break;
        }
        let mut found = self.branch(&curve, i, &here.0, &mut row);
        // where a neighbour's extremes lie elsewhere in the cycle, that branch may rise higher between the two speeds
        for (known, at) in [(low, i.wrapping_sub(1)), (high, i + 1)] {
            let Some(known) = known.filter(|k| k.1 > 0.0) else { continue };
            let followed = curve.value(at, &curve.near(at, &here.0, 1, &mut row));
            if known.1 > followed * (1.0 + OTHER_BRANCH) {
                let other = self.branch(&curve, at, &known.0, &mut row);
                if other.value > found.value {
                    found = other;
                }
            }
        }
        s.row = row;
        found
    }

    /// The maximum of one branch of extremes near grid speed `i`: the parabola of 1/v² through the neighbours, exact for a single resonance. Its error
    /// shows against the quartic and the parabola through speeds twice as far.
    fn branch(&self, curve: &Curve, i: usize, known: &Extremes, row: &mut [C64]) -> Estimated {
        let last = self.speed_rpm.len() - 1;
        let mut extremes_at = |i: usize, from: &Extremes| -> (Extremes, f64) {
            let extremes = curve.near(i, from, 2, row);
            (extremes, curve.value(i, &extremes))
        };
        let (middle, value) = extremes_at(i, known);
        if i < 2 || i + 2 > last {
            return Estimated { value, error: if i == 0 || i == last { ROUNDING } else { BESIDE_END } };
        }
        let (left, right) = (extremes_at(i - 1, &middle), extremes_at(i + 1, &middle));
        let (far_left, far_right) = (extremes_at(i - 2, &left.0), extremes_at(i + 2, &right.0));
        let through = |a: usize, b: usize, ends: [f64; 2]| {
            let x = [a, i, b].map(|i| self.speed_rpm[i]);
            let q = [ends[0], value, ends[1]].map(|v| v.powi(-2));
            vertex(x, q).map_or(value, |q| 1.0 / q.sqrt())
        };
        let (near, far) = (through(i - 1, i + 1, [left.1, right.1]), through(i - 2, i + 2, [far_left.1, far_right.1]));
        let quartic = {
            let x = |j: usize| self.speed_rpm[j];
            let mut through = Interpolation::new(x(i), 0.5 * (x(i + 1) - x(i - 1)));
            let known = [(i, value), (i - 1, left.1), (i + 1, right.1), (i - 2, far_left.1), (i + 2, far_right.1)];
            known.into_iter().for_each(|(j, v)| through.push(x(j), v.powi(-2)));
            let lowest = through.lowest(x(i)).filter(|at| (x(i - 1)..=x(i + 1)).contains(at)).map(|at| through.value(at));
            lowest.filter(|q| *q > 0.0).map_or(near, |q| 1.0 / q.sqrt())
        };
        let error = (DOUBT * (near - quartic).abs() + SAFETY * (near - far).abs()) / near + ROUNDING;
        // across a kink of the torque a parabola tells little: the peak is on the kink, or between the values and the parabola
        if self.kink[i] {
            return Estimated { value, error: error + (near / value - 1.0) };
        }
        let kinked = self.kink[i - 2..=i + 2].contains(&true);
        Estimated { value: near, error: if kinked { error + (near / value - 1.0) } else { error } }
    }
}

/// Lowest value of a parabola through three points, where it lies between them.
fn vertex(x: [f64; 3], q: [f64; 3]) -> Option<f64> {
    let (h0, h1) = (x[1] - x[0], x[2] - x[1]);
    let (s0, s1) = ((q[1] - q[0]) / h0, (q[2] - q[1]) / h1);
    let curvature = (s1 - s0) / (h0 + h1);
    let slope = s0 + curvature * h0;
    let place = -0.5 * slope / curvature;
    let lowest = q[1] - 0.25 * slope * slope / curvature;
    (curvature > 0.0 && lowest > 0.0 && (-h0..=h1).contains(&place)).then_some(lowest)
}

/// An upper bound of the sum of magnitudes, at most 8 % above it: a + (sqrt 2 - 1) b for parts a >= b, a chord of the root.
fn bound(phasors: &[C64]) -> f64 {
    let mut sum = 0.0;
    for y in phasors {
        let (re, im) = (y.re.abs(), y.im.abs());
        let (a, b) = if re > im { (re, im) } else { (im, re) };
        sum += a + (std::f64::consts::SQRT_2 - 1.0) * b;
    }
    sum
}
