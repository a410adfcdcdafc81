//! What exists of absorbers: ranges outside which nobody sells the rubber, the oil or the ring. Each end says where it comes from; those that no source states are assumptions, and wide.

/// A property that only so much of exists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[doc(hidden)]
pub enum Property {
    /// Shear modulus of rubber at the ring's own frequency, Pa.
    Modulus,
    /// Loss factor of rubber there.
    LossFactor,
    /// Largest dynamic shear strain of rubber while all cylinders fire.
    Strain,
    /// Kinematic viscosity of silicone oil at low frequency, m²/s.
    Viscosity,
    /// Frequency of the ring on its held hub, Hz.
    OwnFrequency,
}

/// Where an end of a range comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[doc(hidden)]
pub enum Source {
    /// A publication, by its key in the references of the guide.
    Published(&'static str),
    /// No source states it.
    Assumed(&'static str),
}

/// An end of a range.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(hidden)]
pub struct End {
    /// In the unit of the property.
    pub value: f64,
    /// Where it comes from.
    pub source: Source,
}

/// What exists of a property.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(hidden)]
pub struct Range {
    /// The property.
    pub of: Property,
    /// The least that exists.
    pub least: End,
    /// The most.
    pub most: End,
    /// What is usual, where that is narrower.
    pub usual: Option<(f64, f64)>,
}

const fn published(value: f64, key: &'static str) -> End {
    End { value, source: Source::Published(key) }
}

const fn assumed(value: f64, why: &'static str) -> End {
    End { value, source: Source::Assumed(why) }
}

/// The list.
pub(crate) static RANGES: [Range; 5] = [
    Range {
        of: Property::Modulus,
        least: published(0.3e6, "Lindley 1978"),
        most: assumed(5e6, "twice the static modulus of the hardest rubber for springs, as filled rubber has it at some hundred Hz"),
        usual: None,
    },
    Range {
        of: Property::LossFactor,
        least: assumed(0.02, "natural rubber without filler"),
        most: assumed(0.6, "compounds made for damping"),
        usual: Some((0.05, 0.4)),
    },
    Range {
        of: Property::Strain,
        least: assumed(0.0, "a ring may stand still"),
        most: assumed(0.3, "for a short time; for long 0.1 to 0.15"),
        usual: None,
    },
    Range {
        of: Property::Viscosity,
        least: assumed(1e-3, "thinner oil is no damping fluid"),
        most: assumed(2.0, "twice the 1 m²/s up to which dampers are filled [Chmielowiec 2021]"),
        usual: None,
    },
    Range {
        of: Property::OwnFrequency,
        least: assumed(2.0, "the lowest mode of the largest two-stroke engines"),
        most: assumed(2000.0, "above crank modes of small engines"),
        usual: None,
    },
];

/// Density of silicone oil, kg/m³: assumption, 960 to 980 for all viscosities that matter.
pub(crate) const OIL_DENSITY: f64 = 970.0;

/// The range of a property.
#[doc(hidden)]
pub fn range(of: Property) -> &'static Range {
    // the list has every property
    RANGES.iter().find(|r| r.of == of).unwrap_or(&RANGES[0])
}

impl Range {
    /// The end that a value is beyond.
    #[doc(hidden)]
    pub fn beyond(&self, value: f64) -> Option<&End> {
        if value < self.least.value {
            Some(&self.least)
        } else if value > self.most.value {
            Some(&self.most)
        } else {
            None
        }
    }
}
