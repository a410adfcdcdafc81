//! Elementary functions that give the same bits on every processor.
//!
//! Those of the standard library are the C library's, which chooses by the processor whether it fuses multiplications with additions: its last digits differ from machine to machine. Square roots are exact everywhere.

use super::C64;

/// Elementary functions of a real number.
pub trait Elementary: Sized {
    /// sin x.
    fn sine(self) -> Self;
    /// cos x.
    fn cosine(self) -> Self;
    /// sin x and cos x.
    fn sine_cosine(self) -> (Self, Self);
    /// tan x.
    fn tangent(self) -> Self;
    /// arcsin x.
    fn arcsine(self) -> Self;
    /// arccos x.
    fn arccosine(self) -> Self;
    /// The angle of the point (x, self), from -pi to pi.
    fn arctangent(self, x: Self) -> Self;
    /// e to the power x.
    fn exponential(self) -> Self;
    /// ln x.
    fn logarithm(self) -> Self;
    /// log10 x.
    fn decimal_logarithm(self) -> Self;
    /// x to any power.
    fn power(self, exponent: Self) -> Self;
    /// sinh x.
    fn hyperbolic_sine(self) -> Self;
    /// arsinh x.
    fn area_hyperbolic_sine(self) -> Self;
    /// The cube root.
    fn cube_root(self) -> Self;
    /// The square root of the sum of two squares.
    fn hypotenuse(self, other: Self) -> Self;
}

impl Elementary for f64 {
    fn sine(self) -> Self {
        libm::sin(self)
    }
    fn cosine(self) -> Self {
        libm::cos(self)
    }
    fn sine_cosine(self) -> (Self, Self) {
        libm::sincos(self)
    }
    fn tangent(self) -> Self {
        libm::tan(self)
    }
    fn arcsine(self) -> Self {
        libm::asin(self)
    }
    fn arccosine(self) -> Self {
        libm::acos(self)
    }
    fn arctangent(self, x: Self) -> Self {
        libm::atan2(self, x)
    }
    fn exponential(self) -> Self {
        libm::exp(self)
    }
    fn logarithm(self) -> Self {
        libm::log(self)
    }
    fn decimal_logarithm(self) -> Self {
        libm::log10(self)
    }
    fn power(self, exponent: Self) -> Self {
        libm::pow(self, exponent)
    }
    fn hyperbolic_sine(self) -> Self {
        libm::sinh(self)
    }
    fn area_hyperbolic_sine(self) -> Self {
        libm::asinh(self)
    }
    fn cube_root(self) -> Self {
        libm::cbrt(self)
    }
    fn hypotenuse(self, other: Self) -> Self {
        libm::hypot(self, other)
    }
}

/// The same of a complex number, on the principal branch.
pub trait ComplexElementary: Sized {
    /// Its angle, from -pi to pi.
    fn angle(self) -> f64;
    /// e to the power z.
    fn exponential(self) -> Self;
    /// ln z.
    fn logarithm(self) -> Self;
    /// z to a real power.
    fn power(self, exponent: f64) -> Self;
    /// The square root.
    fn square_root(self) -> Self;
}

impl ComplexElementary for C64 {
    fn angle(self) -> f64 {
        self.im.arctangent(self.re)
    }
    fn exponential(self) -> Self {
        turn(self.im) * self.re.exponential()
    }
    fn logarithm(self) -> Self {
        // no square of a number near the ends of the range
        let size = self.norm_sqr();
        let real = if (1e-280..1e280).contains(&size) { 0.5 * size.logarithm() } else { self.norm().logarithm() };
        Self::new(real, self.angle())
    }
    fn power(self, exponent: f64) -> Self {
        if exponent == 0.0 {
            return Self::from(1.0);
        }
        if self == Self::default() {
            return Self::from(0.0f64.power(exponent));
        }
        (self.logarithm() * exponent).exponential()
    }
    fn square_root(self) -> Self {
        // the part that does not cancel first
        let half = (0.5 * (self.norm() + self.re.abs())).sqrt();
        match half {
            0.0 => Self::default(),
            half if self.re >= 0.0 => Self::new(half, 0.5 * self.im / half),
            half => Self::new(0.5 * self.im.abs() / half, half.copysign(self.im)),
        }
    }
}

/// cos angle + i sin angle.
pub fn turn(angle: f64) -> C64 {
    let (sine, cosine) = angle.sine_cosine();
    C64::new(cosine, sine)
}
