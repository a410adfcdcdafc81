//! The polynomial through a growing list of points, in Newton's form, and its lowest place.

/// Points, at most.
const MOST: usize = 16;
/// Steps towards the lowest place, and the last of them as a share of the scale.
const STEPS: usize = 30;
const SETTLED: f64 = 1e-13;

/// A polynomial through points that come one by one.
#[derive(Debug, Clone, Copy)]
pub struct Interpolation {
    origin: f64,
    scale: f64,
    /// In units of the scale from the origin.
    places: [f64; MOST],
    coefficients: [f64; MOST],
    count: usize,
}

impl Interpolation {
    /// Of no points yet; places are taken from `origin` in units of `scale`, about their distance.
    pub fn new(origin: f64, scale: f64) -> Self {
        Self { origin, scale, places: [0.0; MOST], coefficients: [0.0; MOST], count: 0 }
    }

    /// One more point, at another place than those before; none beyond sixteen.
    pub fn push(&mut self, x: f64, value: f64) {
        if self.count == MOST {
            return;
        }
        let u = (x - self.origin) / self.scale;
        let (mut known, mut product) = (0.0, 1.0);
        for (place, coefficient) in self.places[..self.count].iter().zip(&self.coefficients) {
            known += coefficient * product;
            product *= u - place;
        }
        (self.places[self.count], self.coefficients[self.count]) = (u, (value - known) / product);
        self.count += 1;
    }

    /// Its value at a place.
    pub fn value(&self, x: f64) -> f64 {
        let u = (x - self.origin) / self.scale;
        self.places[..self.count].iter().zip(&self.coefficients).rev().fold(0.0, |value, (place, c)| value * (u - place) + c)
    }

    /// First and second derivative.
    fn slope_and_bend(&self, u: f64) -> (f64, f64) {
        let (mut value, mut slope, mut bend) = (0.0, 0.0, 0.0);
        for (place, coefficient) in self.places[..self.count].iter().zip(&self.coefficients).rev() {
            let d = u - place;
            (value, slope, bend) = (value * d + coefficient, slope * d + value, bend * d + 2.0 * slope);
        }
        (slope, bend)
    }

    /// Where it is lowest near `from`, by Newton's method; nothing where that does not settle, or bends downwards.
    pub fn lowest(&self, from: f64) -> Option<f64> {
        let mut u = (from - self.origin) / self.scale;
        for _ in 0..STEPS {
            let (slope, bend) = self.slope_and_bend(u);
            if bend.is_nan() || bend <= 0.0 {
                return None;
            }
            let step = (-slope / bend).clamp(-1.0, 1.0);
            u += step;
            if step.abs() < SETTLED {
                break;
            }
        }
        Some(self.origin + u * self.scale)
    }
}
