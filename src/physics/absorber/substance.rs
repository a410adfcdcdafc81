//! A compound or an oil by its name: the numbers of its law, where they hold, and what else an order needs.

use super::kraus::Kraus;
use super::life::StrainLife;
use super::parts::Medium;
use super::temperature::TemperatureLaw;

/// A compound of rubber, or a grade of silicone oil.
#[derive(Debug, Clone, PartialEq)]
pub struct Substance {
    /// Its name in studies.
    pub name: String,
    /// What it is, in words.
    pub about: String,
    /// Which of the two.
    pub medium: Medium,
    /// Hardness, Shore A, of rubber; kinematic viscosity at 25 °C, mm²/s, of oil.
    pub grade: f64,
    /// Values of the parameters of its law by their keys, at the reference of its temperature and strain.
    pub values: Vec<(&'static str, f64)>,
    /// How it follows temperature.
    pub temperature: TemperatureLaw,
    /// How it follows strain, where that is known.
    pub amplitude: Option<Kraus>,
    /// Cycles of strain that it bears, where that is known.
    pub life: Option<StrainLife>,
    /// kg/m³.
    pub density: f64,
    /// W/(m K).
    pub conductivity: f64,
    /// Highest temperature that it bears for long, °C.
    pub limit: f64,
    /// Per kg, in the currency of its table.
    pub price: f64,
    /// Where its numbers hold.
    pub valid: Valid,
    /// Where each number comes from: key, then role and source.
    pub sources: Vec<(String, String)>,
}

/// Where the numbers of a substance hold: from and to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Valid {
    /// Hz.
    pub frequency_hz: (f64, f64),
    /// °C.
    pub celsius: (f64, f64),
    /// Amplitude of shear strain.
    pub strain: (f64, f64),
}

/// A number that is outside where a substance's numbers hold.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(hidden)]
pub enum Outside {
    /// Hz.
    Frequency(f64),
    /// °C.
    Temperature(f64),
    /// Amplitude of shear strain.
    Strain(f64),
}

impl Substance {
    /// Its value of a parameter.
    pub fn value(&self, key: &str) -> Option<f64> {
        self.values.iter().find(|v| v.0 == key).map(|v| v.1)
    }

    /// Whether its numbers rest on an assumption: those that are no published and no fitted ones.
    #[doc(hidden)]
    pub fn assumed(&self) -> impl Iterator<Item = &str> {
        self.sources.iter().filter(|s| s.1.starts_with("assumed")).map(|s| s.0.as_str())
    }
}

impl Valid {
    /// What of a use is outside of it; strains below the least are none: the law is then that of small ones.
    #[doc(hidden)]
    pub fn outside(&self, frequencies_hz: &[f64], celsius: &[f64], strain: f64) -> Vec<Outside> {
        let within = |x: f64, (low, high): (f64, f64)| (low..=high).contains(&x);
        let mut list = Vec::new();
        list.extend(frequencies_hz.iter().copied().filter(|f| !within(*f, self.frequency_hz)).map(Outside::Frequency));
        list.extend(celsius.iter().copied().filter(|t| !within(*t, self.celsius)).map(Outside::Temperature));
        list.extend((strain > self.strain.1).then_some(Outside::Strain(strain)));
        list
    }
}
