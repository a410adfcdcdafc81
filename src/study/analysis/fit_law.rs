//! A law fitted to measured stiffness over frequency and temperature, by least squares of the error over the size of S.
//!
//! At each temperature but the reference a factor moves the parameters that follow temperature: a master curve and its shift at once.

use super::calibrate::statistics::statistics;
use super::curves::{Axis, Figure, Panel, Scale, curve};
use crate::absorber::closed_forms::EngineMode;
use crate::absorber::measured::MeasuredTable;
use crate::absorber::{Declaration, Follows, Law, Operating, Range as Values, Surroundings};
use crate::numerics::C64;
use crate::numerics::elementary::Elementary;
use crate::numerics::least_squares::{Fit, Range, fit};
use crate::numerics::maximise::maximise;
use crate::units::HZ_PER_RAD_PER_S;
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use rayon::prelude::*;
use std::convert::Infallible;
use std::f64::consts::LN_10;
use std::sync::Arc;

const FREQUENCY: Axis = Axis { column: "frequency_hz", label: "frequency / Hz" };
const STORAGE: Axis = Axis { column: "storage_n_m_per_rad", label: "Re S / (N m/rad)" };
const LOSS: Axis = Axis { column: "loss_n_m_per_rad", label: "Im S / (N m/rad)" };
/// Starts at random, besides that of a closed form.
const STARTS: u64 = 40;
/// Share of the factor of temperature by which a start falls per kelvin.
const PER_K: [f64; 3] = [0.0, 0.03, 0.1];
/// Factors of temperature lie between this and its inverse.
const LEAST_FACTOR: f64 = 1e-15;
/// A parameter this near to a bound, in its width, lies on it.
const ON_BOUND: f64 = 1e-3;
/// Sums of squares within this share are the same.
const SAME: f64 = 1e-6;

/// Where c2 of Williams, Landel and Ferry is sought, K above the coldest temperature, and in how many steps of equal ratio.
const C2_ABOVE_COLDEST: (f64, f64) = (0.1, 1e5);
const C2_STEPS: usize = 200;

/// Why no law can be fitted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FitError {
    /// The type is no law in frequency alone.
    #[error("found type `{0}`, expected one whose stiffness follows frequency alone, not the speed of the shaft or a large twist")]
    Type(&'static str),
    /// Nothing of the type follows temperature.
    #[error(
        "found a table of several temperatures and type `{0}`, of which nothing follows temperature, expected one temperature or another type"
    )]
    Temperature(&'static str),
    /// The reference is none of the table.
    #[error(
        "found {found}, expected --reference-c with one of {known} °C, the temperatures of the table: values of the law are those there"
    )]
    Reference {
        /// What was given.
        found: String,
        /// What the table has.
        known: String,
    },
    /// No parameter of that key, or a value that it cannot have.
    #[error("found --hold {0}, expected a parameter of the type and a value that it may have: {1}")]
    Held(String, String),
    /// No search has ended where errors are finite.
    #[error("found no law of type `{0}` whose errors against this table are finite, expected another type or table")]
    NotFinite(&'static str),
    /// Fewer numbers than parameters.
    #[error("found {numbers} numbers for {parameters} parameters, expected more")]
    TooFew {
        /// Two a point.
        numbers: usize,
        /// Of the type, and of temperatures.
        parameters: usize,
    },
}

/// A fitted number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fitted {
    /// The number.
    pub value: f64,
    /// Infinite where the table does not determine it; none where it is held.
    pub standard_error: Option<f64>,
    /// Whether it lies on a bound of the search.
    pub on_bound: bool,
}

/// A point of the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitPoint {
    /// °C; zero where the table has no temperature.
    pub celsius: f64,
    /// Hz.
    pub hz: f64,
    /// N m/rad.
    pub measured: C64,
    /// N m/rad.
    pub fitted: C64,
}

impl FitPoint {
    /// Error over the size of what was measured.
    pub fn error(&self) -> f64 {
        (self.fitted - self.measured).norm() / self.measured.norm()
    }
}

/// A law and how well it fits.
#[derive(Debug, Clone)]
pub struct LawFit {
    /// The type.
    pub declaration: &'static Declaration,
    /// Of its parameters but the ring inertia, in their order.
    pub values: Vec<Fitted>,
    /// Factor of every temperature of the table; the reference has one.
    pub factors: Vec<(f64, Fitted)>,
    /// All points, by temperature, then frequency.
    pub points: Vec<FitPoint>,
    /// How many searches ended in the best, of how many.
    pub agreeing: (usize, usize),
}

/// Share of the stiffness by which a law that describes measurements is off at most: several times what they scatter by.
const DESCRIBES: f64 = 0.2;

impl LawFit {
    /// Root of the mean square of the errors.
    pub fn rms(&self) -> f64 {
        (self.points.iter().map(|p| p.error() * p.error()).sum::<f64>() / self.points.len() as f64).sqrt()
    }

    /// Whether the law describes the measurements: no point of them is off by more than a fifth.
    #[doc(hidden)]
    pub fn describes(&self) -> bool {
        self.worst().is_none_or(|p| p.error() <= DESCRIBES)
    }

    /// c1 and c2, K, of the law of Williams, Landel and Ferry that is nearest to the logarithms of the factors by least squares, and the largest ratio that is left; nothing where it is none.
    #[doc(hidden)]
    pub fn williams_landel_ferry(&self) -> Option<(f64, f64, f64)> {
        let reference = self.factors.iter().find(|f| f.1.standard_error.is_none())?.0;
        let others = self.factors.iter().filter(|f| f.1.standard_error.is_some());
        let points: Vec<(f64, f64)> = others.map(|(c, f)| (c - reference, f.value.logarithm() / LN_10)).collect();
        let coldest = points.iter().map(|p| p.0).fold(0.0, f64::min);
        // with c2 the law is a straight line through zero
        let c2 = |above: f64| above.exponential() - coldest;
        let c1 = |c2: f64| {
            let shape = |dt: f64| dt / (c2 + dt);
            -points.iter().map(|(dt, log)| shape(*dt) * log).sum::<f64>() / points.iter().map(|(dt, _)| shape(*dt).powi(2)).sum::<f64>()
        };
        let off = |c2: f64| {
            let c1 = c1(c2);
            points.iter().map(move |(dt, log)| (log + c1 * dt / (c2 + dt)).abs())
        };
        let nearness = |above: f64| -off(c2(above)).map(|e| e * e).sum::<f64>();
        let (low, high) = C2_ABOVE_COLDEST;
        let logarithm_at = |i: usize| low.logarithm() + (high / low).logarithm() * i as f64 / C2_STEPS as f64;
        let best = (0..=C2_STEPS).max_by(|a, b| nearness(logarithm_at(*a)).total_cmp(&nearness(logarithm_at(*b))))?;
        // at an end the factors have a pole, or fall as an exponential
        let is_inside = points.len() > 1 && best > 0 && best < C2_STEPS;
        let (above, _) = if is_inside {
            maximise(logarithm_at(best - 1), logarithm_at(best + 1), |x| Ok::<f64, Infallible>(nearness(x))).ok()?
        } else {
            return None;
        };
        let (c1, c2) = (c1(c2(above)), c2(above));
        (c1 > 0.0).then(|| (c1, c2, (off(c2).fold(0.0, f64::max) * LN_10).exponential()))
    }

    /// Share per kelvin of the exponential that is nearest to the factors, a straight line of ln a through the reference, and the largest ratio that is left; nothing where the factors do not fall.
    #[doc(hidden)]
    pub fn exponential(&self) -> Option<(f64, f64)> {
        let reference = self.factors.iter().find(|f| f.1.standard_error.is_none())?.0;
        let points: Vec<(f64, f64)> = self.factors.iter().map(|(c, f)| (c - reference, f.value.logarithm())).collect();
        let per_k = -points.iter().map(|(dt, log)| dt * log).sum::<f64>() / points.iter().map(|(dt, _)| dt * dt).sum::<f64>();
        let off = points.iter().map(|(dt, log)| (log + per_k * dt).abs()).fold(0.0, f64::max);
        (per_k.is_finite() && per_k > 0.0).then(|| (per_k, off.exponential()))
    }

    /// What was measured beside the law, over frequency.
    #[doc(hidden)]
    pub fn figure(&self) -> Figure {
        let panel = |title: &str, y: Axis, part: &dyn Fn(C64) -> f64| {
            let points_at = |celsius: f64| self.points.iter().filter(move |p| p.celsius == celsius);
            let pair = |(celsius, _): &(f64, Fitted)| {
                let place = if self.factors.len() > 1 { format!(", {celsius} °C") } else { String::new() };
                let hz = || points_at(*celsius).map(|p| p.hz);
                [
                    curve(format!("measured{place}"), hz(), points_at(*celsius).map(|p| part(p.measured))),
                    curve(format!("law{place}"), hz(), points_at(*celsius).map(|p| part(p.fitted))),
                ]
            };
            Panel { title: title.into(), x: FREQUENCY, y, curves: self.factors.iter().flat_map(pair).collect(), scale: Scale::Own }
        };
        Figure {
            name: "fit".into(),
            title: format!("Measured stiffness and a law of type {}", self.declaration.name),
            panels: vec![panel("storage", STORAGE, &|s| s.re), panel("loss", LOSS, &|s| s.im)],
        }
    }

    /// The point that is worst.
    pub fn worst(&self) -> Option<&FitPoint> {
        self.points.iter().max_by(|a, b| a.error().total_cmp(&b.error()))
    }
}

/// What is sought.
struct Model<'a> {
    declaration: &'static Declaration,
    table: &'a MeasuredTable,
    reference: usize,
    /// Of every parameter but the ring inertia, where it is given.
    held: Vec<Option<f64>>,
}

impl Model<'_> {
    /// Values of the type and factors of the temperatures, from what is free.
    fn all(&self, x: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let mut free = x.iter().copied();
        let values = std::iter::once(1.0).chain(self.held.iter().map(|h| h.unwrap_or_else(|| free.next().unwrap_or(1.0)))).collect();
        let factors = (0..self.table.temperatures_c.len()).map(|t| if t == self.reference { 1.0 } else { free.next().unwrap_or(1.0) });
        (values, factors.collect())
    }

    fn law(&self, values: &[f64], factor: f64) -> Arc<dyn Law> {
        let moved: Vec<f64> = values.iter().zip(self.declaration.followed(factor)).map(|(v, f)| v * f).collect();
        (self.declaration.build)(&moved)
    }

    fn points(&self, x: &[f64]) -> Vec<FitPoint> {
        let (values, factors) = self.all(x);
        let mut list = Vec::new();
        for ((celsius, row), factor) in self.table.temperatures_c.iter().zip(&self.table.stiffness).zip(factors) {
            let law = self.law(&values, factor);
            for (hz, measured) in self.table.frequencies_hz.iter().zip(row) {
                let omega = hz / HZ_PER_RAD_PER_S;
                let fitted = law.dynamic_stiffness(Operating { omega, shaft_speed: omega });
                list.push(FitPoint { celsius: *celsius, hz: *hz, measured: C64::new(measured.0, measured.1), fitted });
            }
        }
        list
    }

    fn residuals(&self, x: &[f64]) -> Result<Vec<f64>, Infallible> {
        let relative = |p: FitPoint| {
            let e = (p.fitted - p.measured) / p.measured.norm();
            [e.re, e.im]
        };
        Ok(self.points(x).into_iter().flat_map(relative).collect())
    }
}

/// Fits a type to a table. `reference_c`: the temperature that the values are for, where the table has several; `held`: parameters that are known.
///
/// # Errors
/// [`FitError`] where that cannot be.
pub fn fit_law(
    table: &MeasuredTable,
    declaration: &'static Declaration,
    reference_c: Option<f64>,
    held: &[(String, f64)],
) -> Result<LawFit, FitError> {
    let temperatures = &table.temperatures_c;
    let (middle, size) = scale_of(table);
    let mode = EngineMode { inertia: size / (middle * middle), omega: middle };
    let surroundings = Surroundings { modes: &[mode], ring_inertia: mode.inertia };
    let parameters = &declaration.parameters[1..];
    let typical: Vec<f64> = declaration.parameters.iter().map(|p| (p.typical)(&surroundings)).collect();
    let law = (declaration.build)(&typical);
    if law.depends_on_speed() || law.large_twist().is_some() {
        return Err(FitError::Type(declaration.name));
    }
    if temperatures.len() > 1 && parameters.iter().all(|p| p.follows == Follows::Nothing) {
        return Err(FitError::Temperature(declaration.name));
    }
    let reference = reference_of(temperatures, reference_c)?;
    let held = parameters_held(declaration, held)?;
    let model = Model { declaration, table, reference, held };
    let free: Vec<usize> = (0..parameters.len()).filter(|i| model.held[*i].is_none()).collect();
    let range = |i: &usize| {
        let p = &parameters[*i];
        let (lower, upper) = (p.bounds)(&surroundings);
        let scale = match p.range {
            Values::Within(low, high) => high - low,
            Values::Above(_) => 1.0,
            Values::Positive | Values::NotNegative => 1e-12 * typical[i + 1],
        };
        Range { lower, upper, scale }
    };
    let of_factor = Range { lower: LEAST_FACTOR, upper: 1.0 / LEAST_FACTOR, scale: LEAST_FACTOR };
    let ranges: Vec<Range> = free.iter().map(range).chain((1..temperatures.len()).map(|_| of_factor)).collect();
    let numbers = 2 * temperatures.len() * table.frequencies_hz.len();
    if numbers <= ranges.len() {
        return Err(FitError::TooFew { numbers, parameters: ranges.len() });
    }
    let kelvin: Vec<f64> =
        temperatures.iter().enumerate().filter(|(t, _)| *t != reference).map(|(_, c)| c - temperatures[reference]).collect();
    let closed = declaration.closed_forms.last().map(|form| (form.values)(mode.inertia, mode));
    let start = |seed: u64| -> Vec<f64> {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let own: Vec<f64> = match (&closed, seed) {
            (Some(values), 0..3) => free.iter().zip(&ranges).map(|(i, r)| values[i + 1].clamp(r.lower, r.upper)).collect(),
            _ => {
                let inside = |r: &Range| {
                    let (low, high) = r.ends();
                    r.value(low + (high - low) * random.random_range(0.05..0.95))
                };
                ranges[..free.len()].iter().map(inside).collect()
            }
        };
        let per_k = PER_K[(seed % PER_K.len() as u64) as usize];
        own.into_iter().chain(kelvin.iter().map(|k| (-per_k * k).exponential())).collect()
    };
    let search = |seed: u64| {
        let Ok(found) = fit(|x| model.residuals(x), &ranges, &start(seed));
        found
    };
    let fits: Vec<Fit> = (0..STARTS).into_par_iter().map(search).collect();
    let is_finite = |f: &&Fit| f.cost().is_finite() && f.jacobian.iter().all(|d| d.is_finite());
    let best = fits.iter().filter(is_finite).min_by(|a, b| a.cost().total_cmp(&b.cost()));
    let best = best.ok_or(FitError::NotFinite(declaration.name))?;
    // of an exact fit only rounding is left
    let exact = 1e-20 * numbers as f64;
    let agreeing = fits.iter().filter(|f| f.cost() <= best.cost() * (1.0 + SAME) + exact).count();
    Ok(told(&model, best, &ranges, (agreeing, fits.len())))
}

/// The fit with standard errors.
fn told(model: &Model, best: &Fit, ranges: &[Range], agreeing: (usize, usize)) -> LawFit {
    let widths: Vec<f64> = ranges.iter().zip(&best.point).map(|(r, x)| r.size(*x)).collect();
    let errors = statistics(&best.jacobian, &best.residuals, &widths, |_, _| 1.0).standard_errors;
    let on_bound = |r: &Range, x: f64| {
        let ((low, high), z) = (r.ends(), r.coordinate(x));
        (z - low).min(high - z) < ON_BOUND * (high - low)
    };
    let fitted = best.point.iter().zip(ranges).zip(errors);
    let mut fitted = fitted.map(|((x, r), e)| Fitted { value: *x, standard_error: e, on_bound: on_bound(r, *x) });
    let known = |value: f64| Fitted { value, standard_error: None, on_bound: false };
    let values = model.held.iter().map(|h| h.map(known).unwrap_or_else(|| fitted.next().unwrap_or(known(1.0)))).collect();
    let temperatures = model.table.temperatures_c.iter().enumerate();
    let factors =
        temperatures.map(|(t, c)| (*c, if t == model.reference { known(1.0) } else { fitted.next().unwrap_or(known(1.0)) })).collect();
    LawFit { declaration: model.declaration, values, factors, points: model.points(&best.point), agreeing }
}

/// Geometric means of frequency, rad/s, and |S|, N m/rad.
fn scale_of(table: &MeasuredTable) -> (f64, f64) {
    let mean = |logarithms: Vec<f64>| (logarithms.iter().sum::<f64>() / logarithms.len() as f64).exponential();
    let omega = mean(table.frequencies_hz.iter().map(|f| (f / HZ_PER_RAD_PER_S).logarithm()).collect());
    (omega, mean(table.stiffness.iter().flatten().map(|s| s.0.hypotenuse(s.1).logarithm()).collect()))
}

fn reference_of(temperatures: &[f64], given: Option<f64>) -> Result<usize, FitError> {
    let known = || temperatures.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
    match given {
        None if temperatures.len() == 1 => Ok(0),
        None => Err(FitError::Reference { found: "several temperatures".into(), known: known() }),
        Some(celsius) => temperatures
            .iter()
            .position(|t| *t == celsius)
            .ok_or_else(|| FitError::Reference { found: format!("--reference-c {celsius}"), known: known() }),
    }
}

fn parameters_held(declaration: &Declaration, held: &[(String, f64)]) -> Result<Vec<Option<f64>>, FitError> {
    let parameters = &declaration.parameters[1..];
    let mut list = vec![None; parameters.len()];
    for (key, value) in held {
        let keys = || parameters.iter().map(|p| p.key).collect::<Vec<_>>().join(", ");
        let place = parameters.iter().position(|p| p.key == key).filter(|i| parameters[*i].range.holds(*value));
        let Some(i) = place else { return Err(FitError::Held(format!("{key}={value}"), keys())) };
        list[i] = Some(*value);
    }
    Ok(list)
}
