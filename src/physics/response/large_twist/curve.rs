//! The curves of steady motions over speed.
//!
//! Speed by speed first, each motion started from those before it. Where that fails, where the determinant of the Jacobian changes sign, or where other starts meet other motions, the curves are followed
//! along their arc instead, through folds.

use super::arc::{Arc, Place};
use super::balance::{Balance, Steady};
use super::linear::Linear;
use super::newton::{MOST_STEPS, Motion};
use super::stability::Stability;
use crate::response::{ResponseError, Work};
use nalgebra::DVector;

/// Speeds between other starts, and these as multiples of the motion at small twist.
const STARTS_EVERY: usize = 10;
const STARTS: [f64; 3] = [1.0, 0.0, 3.0];
/// Motions that the next one is extrapolated from.
const EXTRAPOLATED: usize = 4;
/// Newton's steps from a start nearby.
const NEARBY: usize = 8;
/// The torque grows by no less than this share.
const LEAST_SHARE: f64 = 1e-3;
/// Two motions are the same when they differ by this share.
const SAME: f64 = 1e-6;
/// Stability is looked at at every so many points, and between them where a multiplier might pass one.
const STRIDE: usize = 8;

/// A point of a curve.
#[derive(Debug, Clone)]
pub struct CurvePoint {
    /// The motion.
    pub steady: Steady,
    /// Whether small disturbances die out.
    pub stability: Stability,
    /// Whether its speed is one of those asked for.
    pub asked: bool,
    unknowns: DVector<f64>,
}

/// A connected curve of motions.
#[derive(Debug, Clone)]
pub struct Curve {
    /// In the order of the curve.
    pub points: Vec<CurvePoint>,
    /// Whether it was followed to its ends: out of the range, or back to where it began.
    pub whole: bool,
    /// Whether it has one motion a speed.
    of_speed: bool,
}

impl Balance<'_> {
    /// All curves that are found, at least at the speeds asked for, which ascend.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance of the chain.
    pub fn curves(&self, speeds_rpm: &[f64], work: &mut Work) -> Result<Vec<Curve>, ResponseError> {
        let tables = speeds_rpm.iter().map(|speed| self.linear(*speed)).collect::<Result<Vec<_>, _>>()?;
        let swept = self.swept(&tables, work);
        let mut curves: Vec<Curve> = swept.into_iter().collect();
        let mut found = self.others(&tables, &curves, work);
        if !found.is_empty() || curves.is_empty() {
            // several motions: each curve is followed as a whole
            found = self.others(&tables, &[], work);
            curves.clear();
            for (i, x) in found {
                if !curves.iter().any(|c| c.passes(tables[i].speed_rpm, &x)) {
                    curves.push(self.along((&tables[i], x), speeds_rpm, work)?);
                }
            }
        }
        curves.iter_mut().for_each(|c| self.judge(&mut c.points));
        Ok(curves)
    }

    /// A motion at a speed that nothing is known of: from the one at small twist, or from rest under a torque that grows.
    fn first(&self, linear: &Linear, work: &mut Work) -> Option<Motion> {
        if let Some(found) = self.newton(linear, &self.small(linear), NEARBY, work) {
            return Some(found);
        }
        let (mut share, mut step) = (0.0, 0.25);
        let mut x = DVector::zeros(self.unknowns());
        loop {
            let next: f64 = f64::min(share + step, 1.0);
            let start = if share > 0.0 { &x * (next / share) } else { self.small(&linear.under(next)) };
            match self.newton(&linear.under(next), &start, NEARBY, work) {
                Some(found) if next >= 1.0 => return Some(found),
                Some(found) => (x, share, step) = (found.x, next, 1.5 * step),
                None => step *= 0.5,
            }
            if step < LEAST_SHARE {
                return None;
            }
        }
    }

    /// Motions speed by speed; nothing where one is not found or a fold is passed.
    fn swept(&self, tables: &[Linear], work: &mut Work) -> Option<Curve> {
        let mut found: Vec<Motion> = Vec::with_capacity(tables.len());
        for (i, linear) in tables.iter().enumerate() {
            let next = match &found[i.saturating_sub(EXTRAPOLATED)..] {
                [] => self.first(linear, work)?,
                last => self.newton(linear, &extrapolated(last, &tables[i - last.len()..=i]), NEARBY, work)?,
            };
            if found.last().is_some_and(|last| last.even != next.even) {
                return None;
            }
            found.push(next);
        }
        let points = found.into_iter().zip(tables).map(|(found, linear)| self.point(linear, found.x, true)).collect::<Option<_>>()?;
        Some(Curve { points, whole: true, of_speed: true })
    }

    /// A motion at a speed; nothing where none is found from what is known of small twist.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance of the chain.
    #[doc(hidden)]
    pub fn at(&self, speed_rpm: f64) -> Result<Option<Steady>, ResponseError> {
        let linear = self.linear(speed_rpm)?;
        Ok(self.first(&linear, &mut Work::default()).and_then(|found| self.steady(&linear, &found.x)))
    }

    /// Motions on none of the curves that Newton's method meets from other starts, with the indices of their speeds.
    fn others(&self, tables: &[Linear], curves: &[Curve], work: &mut Work) -> Vec<(usize, DVector<f64>)> {
        let mut list: Vec<(usize, DVector<f64>)> = Vec::new();
        for (i, linear) in tables.iter().enumerate().filter(|(i, _)| i % STARTS_EVERY == 0 || i + 1 == tables.len()) {
            let small = self.small(linear);
            let known: Vec<&DVector<f64>> = curves.iter().flat_map(|c| c.at(linear.speed_rpm)).collect();
            let starts = STARTS.into_iter().map(|factor| &small * factor).chain(self.equivalent(linear)).enumerate();
            // the first is where the curves began
            for (number, start) in starts.skip(usize::from(!curves.is_empty())) {
                if self.is_spent(work) {
                    return list;
                }
                // without any other, a motion is worth more work
                let found = self.newton_beside(linear, &start, &known, MOST_STEPS, work);
                let found = if found.is_none() && number == 0 { self.first(linear, work) } else { found };
                let Some(Motion { x, .. }) = found else { continue };
                let known = |(j, own): &(usize, DVector<f64>)| *j == i && (own - &x).amax() <= SAME * x.amax();
                if !list.iter().any(known) && !curves.iter().any(|c| c.passes(linear.speed_rpm, &x)) {
                    list.push((i, x));
                }
            }
        }
        list
    }

    /// The curve through a motion, both ways.
    fn along(&self, (linear, x): (&Linear, DVector<f64>), speeds: &[f64], work: &mut Work) -> Result<Curve, ResponseError> {
        let range = (speeds[0], speeds[speeds.len() - 1]);
        let mut arc = Arc::new(self, range, &x, work);
        let start = Place::new(x, linear.speed_rpm);
        let ahead = arc.follow(&start, 1.0, speeds)?;
        let behind = if ahead.closed { None } else { Some(arc.follow(&start, -1.0, speeds)?) };
        let whole = ahead.whole && behind.as_ref().is_none_or(|b| b.whole);
        let before = behind.into_iter().flat_map(|b| b.points.into_iter().rev());
        let mut points = Vec::new();
        for (place, asked) in before.chain([(start, true)]).chain(ahead.points) {
            points.extend(self.point(&self.linear(place.speed_rpm)?, place.x, asked));
        }
        Ok(Curve { points, whole, of_speed: false })
    }

    fn point(&self, linear: &Linear, unknowns: DVector<f64>, asked: bool) -> Option<CurvePoint> {
        Some(CurvePoint { steady: self.steady(linear, &unknowns)?, stability: Stability::Unknown, asked, unknowns })
    }

    /// Stability of every point.
    fn judge(&self, points: &mut [CurvePoint]) {
        let Some(last) = points.len().checked_sub(1) else { return };
        let mut ends: Vec<usize> = (0..last).step_by(STRIDE).collect();
        ends.push(last);
        ends.iter().for_each(|i| points[*i].stability = self.stability(&points[*i].steady));
        ends.windows(2).for_each(|pair| self.judge_between(points, pair[0], pair[1]));
    }

    /// Of the points between two whose stability is known: that of both, where no multiplier comes near one.
    fn judge_between(&self, points: &mut [CurvePoint], from: usize, to: usize) {
        if to <= from + 1 {
            return;
        }
        let far = match (points[from].stability, points[to].stability) {
            (Stability::Stable(a), Stability::Stable(b)) => a.max(b) + 2.0 * (a - b).abs() < 1.0,
            (Stability::Unstable(a), Stability::Unstable(b)) => a.min(b) - 2.0 * (a - b).abs() > 1.0,
            (a, b) => a == b,
        };
        if far {
            let known = points[to].stability;
            points[from + 1..to].iter_mut().for_each(|p| p.stability = known);
        } else {
            let middle = (from + to) / 2;
            points[middle].stability = self.stability(&points[middle].steady);
            self.judge_between(points, from, middle);
            self.judge_between(points, middle, to);
        }
    }

    /// The motion at a share of the way between two points of a curve that follow each other; nothing where Newton's method does not find it. Its stability is not looked at.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance of the chain.
    pub fn between(&self, curve: &Curve, (i, j): (usize, usize), share: f64) -> Result<Option<Steady>, ResponseError> {
        let (a, b, work) = (&curve.points[i], &curve.points[j], &mut Work::default());
        let (p, q) = (a.steady.speed_rpm, b.steady.speed_rpm);
        if curve.of_speed {
            let linear = self.linear(p + share * (q - p))?;
            let found = self.newton(&linear, &(&a.unknowns + (&b.unknowns - &a.unknowns) * share), NEARBY, work);
            return Ok(found.and_then(|found| self.steady(&linear, &found.x)));
        }
        let mut arc = Arc::new(self, (p.min(q), p.max(q)), &a.unknowns, work);
        let Some(place) = arc.between((&a.unknowns, p), (&b.unknowns, q), share)? else { return Ok(None) };
        Ok(self.steady(&self.linear(place.speed_rpm)?, &place.x))
    }
}

impl Curve {
    /// Its motions at one of the speeds asked for.
    fn at(&self, speed_rpm: f64) -> impl Iterator<Item = &DVector<f64>> {
        self.points.iter().filter(move |p| p.steady.speed_rpm == speed_rpm).map(|p| &p.unknowns)
    }

    /// Whether a motion at one of the speeds asked for is on it.
    fn passes(&self, speed_rpm: f64, x: &DVector<f64>) -> bool {
        self.at(speed_rpm).any(|own| (own - x).amax() <= SAME * x.amax())
    }
}

/// What the polynomial through motions at some speeds is at the next one, the last.
fn extrapolated(motions: &[Motion], tables: &[Linear]) -> DVector<f64> {
    let speed = |i: usize| tables[i].speed_rpm;
    let last = motions.len();
    let share = |i: usize| (0..last).filter(|j| *j != i).map(|j| (speed(last) - speed(j)) / (speed(i) - speed(j))).product::<f64>();
    motions.iter().enumerate().map(|(i, found)| &found.x * share(i)).fold(DVector::zeros(motions[0].x.len()), |sum, x| sum + x)
}
