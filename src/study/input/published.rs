//! Published or measured numbers to compare with and to calibrate against.

use crate::engine::Order;
use crate::fatigue::Cycle;

/// A natural frequency of the chain.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedFrequency {
    /// Number of the table it stands in.
    pub table: String,
    /// Who computed or measured it.
    pub source: String,
    /// Elastic mode, from 1.
    pub mode: usize,
    /// Hz.
    pub frequency_hz: f64,
}

/// A station of the printed chain.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedStation {
    /// Number of the table it stands in.
    pub table: String,
    /// Index along the chain.
    pub station: usize,
    /// kg m².
    pub inertia: f64,
    /// Stiffness to the next one, N m/rad; `None` of the last.
    pub stiffness: Option<f64>,
}

/// A natural frequency of the crank by itself, free at both ends.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedMode {
    /// Number of the table it stands in.
    pub table: String,
    /// Who computed or measured it.
    pub source: String,
    /// With hub and flywheel; otherwise the bare crank.
    pub attached: bool,
    /// Elastic mode, from 1.
    pub mode: usize,
    /// What kind it is said to be; empty where nothing is.
    pub kind: String,
    /// Hz.
    pub frequency_hz: f64,
}

/// The largest equivalent stress of von Mises over the cycle of a crank in bending, torsion and axial motion at a speed.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedVonMises {
    /// Number of the table it stands in.
    pub table: String,
    /// Index of the design of the study.
    pub design: usize,
    /// rpm.
    pub speed_rpm: f64,
    /// Stiffness and damping of the main bearings over those of the engine.
    pub bearings: [f64; 2],
    /// Pa.
    pub stress: f64,
    /// Its change from that on the bearings of the engine as printed, per cent.
    pub change_percent: Option<f64>,
    /// Where it is said to be; empty where nothing is.
    pub place: String,
}

/// An absorber with the natural frequencies of chain and absorber; `None`: not printed.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedAbsorber {
    /// Number of the table it stands in.
    pub table: String,
    /// Design of the study.
    pub design: String,
    /// kg m².
    pub ring_inertia: Option<f64>,
    /// N m/rad.
    pub stiffness: Option<f64>,
    /// N m s/rad.
    pub damping: Option<f64>,
    /// Elastic modes in order, Hz.
    pub frequencies_hz: Vec<Option<f64>>,
}

/// Amplitude of one order at the hub.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedAmplitude {
    /// Number of the table it stands in.
    pub table: String,
    /// Index of the design of the study.
    pub design: usize,
    /// The order.
    pub order: Order,
    /// rpm.
    pub speed_rpm: f64,
    /// Zero to peak, rad; `None`: not printed.
    pub amplitude: Option<f64>,
}

/// A number of the text.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedQuantity {
    /// What it is.
    pub name: String,
    /// Its unit as printed.
    pub unit: String,
    /// The number, or the words in its place.
    pub value: Result<f64, String>,
}

/// A safety factor of the crank with the stresses it follows from.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedFatigue {
    /// Number of the table it stands in.
    pub table: String,
    /// Index of the design of the study.
    pub design: usize,
    /// How torsion was taken.
    pub torsion_case: String,
    /// Condition of the engine.
    pub condition: String,
    /// Place on the crank.
    pub fillet: String,
    /// Equivalent stress.
    pub cycle: Cycle,
    /// The factor.
    pub safety_factor: f64,
}

/// A largest stress of the crank.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedStress {
    /// Number of the table it stands in.
    pub table: String,
    /// Whose model, or how torsion was taken.
    pub model: String,
    /// Condition of the engine.
    pub condition: String,
    /// Pa.
    pub von_mises: f64,
}

/// Factors of stress concentration at one fillet.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedFactor {
    /// Number of the table it stands in.
    pub table: String,
    /// Place on the crank.
    pub fillet: String,
    /// Of bending.
    pub bending: f64,
    /// Of torsion.
    pub torsion: f64,
}

/// The six criteria of \[Minucci 2010\], in the order of his tables.
#[doc(hidden)]
pub const SIX_CRITERIA: [&str; 6] = ["matake", "mcdiarmid", "dang_van", "sines", "crossland", "kakuno_kawada"];

/// A point of a crank, at a speed where one is given.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedPoint {
    /// Number of the table it stands in.
    pub table: String,
    /// Word of the crank, which need not be the engine's.
    pub crank: String,
    /// rpm, as printed.
    pub speed: String,
    /// Its name.
    pub point: String,
}

impl PublishedPoint {
    /// Whether it is the same place under the same load, in whatever table.
    #[doc(hidden)]
    pub fn is_same(&self, other: &Self) -> bool {
        (&self.crank, &self.speed, &self.point) == (&other.crank, &other.speed, &other.point)
    }
}

/// Multiaxial safety factors at a point, by `SIX_CRITERIA`.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedMultiaxial {
    /// Where.
    pub at: PublishedPoint,
    /// One a criterion.
    pub factors: [f64; 6],
}

/// Critical planes of a point as printed: theta and phi, rad.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedPlanes {
    /// Where.
    pub at: PublishedPoint,
    /// Of the largest shear amplitude.
    pub shear: [f64; 2],
    /// Of Dang Van's criterion.
    pub dang_van: [f64; 2],
}

/// What a stress history comes to at a point, Pa; `None`: not printed.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedHistory {
    /// Where.
    pub at: PublishedPoint,
    /// On the plane where it is largest.
    pub shear_amplitude: Option<f64>,
    /// On that plane.
    pub normal_max: Option<f64>,
    /// Of the invariant.
    pub sqrt_j2_amplitude: f64,
    /// Half the range of the hydrostatic stress.
    pub hydrostatic_amplitude: f64,
    /// Middle of its range.
    pub hydrostatic_mean: f64,
}

/// An absorber that a source recommends for an engine.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedChoice {
    /// Where it is recommended.
    pub table: String,
    /// Index of the design of the study.
    pub design: usize,
    /// Why, in words.
    pub words: String,
}

/// Largest deviations that a comparison is asked to hold, per cent; `None`: nothing asked.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Tolerances {
    /// Natural frequencies.
    pub frequency: Option<f64>,
    /// Critical speeds.
    pub critical_speed: Option<f64>,
    /// Absorber stiffness by the procedure of the source.
    pub stiffness: Option<f64>,
    /// Absorber damping by the procedure of the source.
    pub damping: Option<f64>,
    /// Median of the predicted amplitudes.
    pub amplitude_median: Option<f64>,
    /// Worst predicted amplitude.
    pub amplitude_worst: Option<f64>,
    /// Safety factors from their stresses.
    pub safety_factor: Option<f64>,
    /// Multiaxial safety factors from their stresses.
    pub multiaxial_factor: Option<f64>,
}

/// Tables of one engine.
#[derive(Debug, Clone, PartialEq)]
pub struct Published {
    /// Its word in the tables.
    pub engine: String,
    /// The chain.
    pub chain: Vec<PublishedStation>,
    /// Natural frequencies of the chain.
    pub frequencies: Vec<PublishedFrequency>,
    /// Natural frequencies of the crank by itself.
    pub modes: Vec<PublishedMode>,
    /// Largest equivalent stresses of the flexible crank.
    pub von_mises: Vec<PublishedVonMises>,
    /// Absorbers.
    pub absorbers: Vec<PublishedAbsorber>,
    /// Amplitudes.
    pub amplitudes: Vec<PublishedAmplitude>,
    /// Numbers of the text.
    pub quantities: Vec<PublishedQuantity>,
    /// Safety factors of the crank.
    pub fatigue: Vec<PublishedFatigue>,
    /// Largest stresses of the crank.
    pub stresses: Vec<PublishedStress>,
    /// Factors of stress concentration of the crank.
    pub factors: Vec<PublishedFactor>,
    /// Multiaxial safety factors.
    pub multiaxial: Vec<PublishedMultiaxial>,
    /// Stresses behind them.
    pub histories: Vec<PublishedHistory>,
    /// Critical planes of points.
    pub planes: Vec<PublishedPlanes>,
    /// Which absorbers the source recommends.
    pub choices: Vec<PublishedChoice>,
    /// The publication that the tables are of; empty where it is not said.
    pub source: String,
    /// What is to hold.
    pub tolerances: Tolerances,
}

impl Published {
    /// Whether a table is of anything but natural frequencies.
    #[doc(hidden)]
    pub fn tells_of_responses(&self) -> bool {
        let Self { absorbers, amplitudes, quantities, fatigue, stresses, factors, multiaxial, histories, .. } = self;
        let of_designs = !(absorbers.is_empty() && amplitudes.is_empty() && quantities.is_empty());
        of_designs || !(fatigue.is_empty() && stresses.is_empty() && factors.is_empty() && multiaxial.is_empty() && histories.is_empty())
    }
}

/// A printed quantity of the rounds of sizing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RoundQuantity {
    /// As printed in Table 26 of \[Fialho & Almeida 2019\].
    pub symbol: &'static str,
    /// In words.
    pub words: &'static str,
    /// Unit of the printed values.
    pub unit: &'static str,
}

/// Printed quantities of rounds, in the order of the table.
pub(crate) const ROUND_QUANTITIES: [RoundQuantity; 24] = {
    const fn of(symbol: &'static str, words: &'static str, unit: &'static str) -> RoundQuantity {
        RoundQuantity { symbol, words, unit }
    }
    [
        of("Cgv", "centre of the throw over crank radius", "-"),
        of("Cgb", "centre of the rod over its length", "-"),
        of("m2", "mass of the throw", "kg"),
        of("m3", "mass of the rod", "kg"),
        of("Ig2", "inertia of the throw about its centre", "kg m2"),
        of("Ig3", "inertia of the rod about its big end", "kg m2"),
        of("B", "bore", "mm"),
        of("l", "length of the rod", "mm"),
        of("r", "crank radius", "mm"),
        of("tb", "web of the rod", "mm"),
        of("Hb", "height of the rod", "mm"),
        of("Bb", "width of the rod", "mm"),
        of("dpp", "piston pin", "mm"),
        of("dcp", "crankpin", "mm"),
        of("dmp", "main journal", "mm"),
        of("dfw", "flywheel seat", "mm"),
        of("dioma", "bore of the big eye", "mm"),
        of("deoma", "big eye", "mm"),
        of("diome", "bore of the small eye", "mm"),
        of("deome", "small eye", "mm"),
        of("kfmp", "journal fillet in bending", "-"),
        of("kfsmp", "journal fillet in torsion", "-"),
        of("kfcp", "crankpin fillet in bending", "-"),
        of("kfscp", "crankpin fillet in torsion", "-"),
    ]
};

/// An input or a result of a worked example.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedExample {
    /// Number of the table it stands in.
    pub table: String,
    /// Word of the example.
    pub example: String,
    /// Whether it goes in; otherwise it comes out.
    pub is_input: bool,
    /// What it is.
    pub quantity: String,
    /// Its unit as printed.
    pub unit: String,
    /// The number of the book or the CAD model, or the word in its place.
    pub value: Result<f64, String>,
    /// That of the publication's own program; `None` where it prints none.
    pub program: Option<f64>,
}

/// A row of printed rounds.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedRounds {
    /// What is printed.
    pub quantity: RoundQuantity,
    /// A value a round.
    pub values: Vec<f64>,
}
