//! What each kind of number may be: once, for the schema, for the reader and for the words of a message.

use crate::absorber::Range;
use crate::engine::load::LARGEST_LOAD;
use crate::fatigue::endurance::HOTTEST;
use crate::sizing::eye;
use schemars::Schema;
use serde_json::{Map, Value, json};

/// Smallest and largest size of a number that is not zero: products of a few of them stay finite.
const SMALLEST: f64 = 1e-20;
const LARGEST: f64 = 1e20;

/// A kind of number and its range.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bounds {
    /// What it is, with its article.
    pub what: &'static str,
    low: f64,
    /// Infinite where it is only of a size that can be computed with.
    pub high: f64,
    low_is_in: bool,
    high_is_in: bool,
    /// What follows the numbers in a message: a unit, an example.
    after: &'static str,
}

/// From one number to another, both allowed.
pub(crate) const fn from_to(what: &'static str, low: f64, high: f64, after: &'static str) -> Bounds {
    Bounds { what, low, high, low_is_in: true, high_is_in: true, after }
}

/// From one number to below another.
pub(crate) const fn from_below(what: &'static str, low: f64, high: f64, after: &'static str) -> Bounds {
    Bounds { high_is_in: false, ..from_to(what, low, high, after) }
}

/// Above one number, up to another.
const fn above_to(what: &'static str, low: f64, high: f64, after: &'static str) -> Bounds {
    Bounds { low_is_in: false, ..from_to(what, low, high, after) }
}

/// Between two numbers, neither of them allowed.
const fn above_below(what: &'static str, low: f64, high: f64, after: &'static str) -> Bounds {
    Bounds { low_is_in: false, high_is_in: false, ..from_to(what, low, high, after) }
}

/// From a number on.
const fn at_least(what: &'static str, low: f64) -> Bounds {
    from_to(what, low, f64::INFINITY, "")
}

/// Above a number.
const fn above(what: &'static str, low: f64) -> Bounds {
    above_to(what, low, f64::INFINITY, "")
}

/// Any number above zero.
pub(crate) const POSITIVE: Bounds = above("a number", 0.0);
/// Any number from zero on.
pub(crate) const NOT_NEGATIVE: Bounds = at_least("a number", 0.0);
/// Any number, as far as it can be computed with.
pub(crate) const ANY: Bounds = from_to("a number", -LARGEST, LARGEST, "");
pub(crate) const FRACTION: Bounds = from_to("a fraction", 0.0, 1.0, "");

// speeds, orders and load
pub(crate) const ORDER_LIMIT: Bounds = from_to("an order", 0.5, 200.0, "");
/// One order; those that the engine has are fewer.
pub(crate) const ORDER: Bounds = above_to("an order", 0.0, ORDER_LIMIT.high, "");
pub(crate) const LOAD: Bounds = from_to("a share of full load", 0.0, LARGEST_LOAD, "");
pub(crate) const SHARE_OF_TIME: Bounds = from_to("a share of the time", 0.0, 1.0, "");
pub(crate) const COMBUSTION: Bounds = from_to("a share", -1.0, 1.0, ": -1 is a misfire, 0.05 burns 5 % more than the others");

// engine and its pressure
pub(crate) const FRICTION: Bounds = from_to("a friction coefficient", 0.0, 0.5, "");
pub(crate) const BANK_ANGLE: Bounds = from_to("an angle", 0.0, 180.0, " degrees");
pub(crate) const SIGNED_ANGLE: Bounds = from_to("an angle", -180.0, 180.0, " degrees");
pub(crate) const SECTOR: Bounds = above_to("an angle", 0.0, 360.0, " degrees");
pub(crate) const COMPRESSION_RATIO: Bounds = from_to("a compression ratio", 1.5, 50.0, "");
pub(crate) const HEAT_CAPACITY_RATIO: Bounds = from_to("a ratio of heat capacities", 1.05, 1.67, "");
pub(crate) const PRESSURE_SCALE: Bounds = above_to("a factor", 0.0, 5.0, "");
pub(crate) const BURN_START: Bounds = from_to("an angle", -90.0, 90.0, " degrees round firing dead centre");
pub(crate) const BURN_DURATION: Bounds = from_to("a duration", 1.0, 170.0, " degrees");
pub(crate) const WIEBE_EXPONENT: Bounds = from_to("an exponent", 0.1, 10.0, "");

// damping of the chain
pub(crate) const MAGNIFIER: Bounds = from_to("a dynamic magnifier", 1.0, 1e6, "");
pub(crate) const FRACTION_OF_CRITICAL: Bounds = from_below("a fraction of critical damping", 0.0, 1.0, "");
/// Of every mode of a chain that is sized.
pub(crate) const FRACTION_OF_EACH_MODE: Bounds = above_below("a fraction of critical damping", 0.0, 0.5, "");

// what is calibrated, where the bounds are others than those of the key itself
pub(crate) const FITTED_PRESSURE_SCALE: Bounds = from_to("a factor", 1e-6, 5.0, "");
pub(crate) const FITTED_BOOST: Bounds = from_to("a pressure", 1e-6, 100.0, " bar");
pub(crate) const FITTED_DAMPING: Bounds = from_to("a damping", 0.0, 1e9, "");
pub(crate) const FITTED_LOSS_FACTOR: Bounds = from_to("a loss factor", 0.0, 1.0, "");

// the flexible crank and its bearings
pub(crate) const LOSS_FACTOR: Bounds = from_to("a loss factor", 0.0, 0.5, "");
pub(crate) const WEB_FACTOR: Bounds = from_to("a factor", 1e-3, 1000.0, "");
pub(crate) const BEARING_STIFFNESS: Bounds = from_to("a stiffness", 1e5, 1e13, " N/m");
pub(crate) const OIL_PRESSURE: Bounds = from_to("a pressure", 1e-3, 1000.0, " MPa");
pub(crate) const REACH: Bounds = from_to("a reach", 1e-6, 5e-3, " of the diameter");
pub(crate) const LOOSE_RATIO: Bounds = from_to("a ratio", 1e-6, 1.0, "");
pub(crate) const DAMPING_TIME: Bounds = from_to("a time", 1e-9, 0.1, " s");

// fatigue and limits by rules
pub(crate) const TEMPERATURE_OF_STEEL: Bounds = from_to("a temperature", -60.0, HOTTEST, " °C");
pub(crate) const NOMINAL_FACTOR: Bounds = from_to("a factor of nominal stress", 1.0, 20.0, "");
pub(crate) const M68_STRENGTH: Bounds = from_to("a tensile strength", 400.0, 800.0, " N/mm²: the rule counts no more");
pub(crate) const M68_STRESS_FACTOR: Bounds = from_to("c_K of the rule", 0.1, 1.0, " (1 for an integral flange, 0.6 for a tapered keyway)");
pub(crate) const KR_STRENGTH: Bounds = from_to("a tensile strength", 400.0, 1500.0, " N/mm²");

// sizes
pub(crate) const LENGTH_MM: Bounds = from_to("a length", 1e-2, 1e5, " mm");
pub(crate) const INERTIA: Bounds = from_to("an inertia", 1e-9, 1e9, " kg m²");
pub(crate) const SAFETY_FACTOR: Bounds = from_to("a factor", 1.0, 100.0, "");
pub(crate) const BORE_TO_STROKE: Bounds = from_to("a ratio of bore to stroke", 0.1, 10.0, "");
pub(crate) const CRANK_TO_ROD: Bounds =
    from_below("a ratio of crank radius to rod length", 0.01, 0.95, ": the rod is longer than the crank");
pub(crate) const EYE_RATIO: Bounds = from_to("a ratio of outer to inner diameter", eye::RATIOS.0, eye::RATIOS.1, "");
pub(crate) const RING_DENSITY: Bounds = from_to("a density", 500.0, 25_000.0, " kg/m³");

// materials of absorbers
/// Above absolute zero, and what anything is made for.
pub(crate) const TEMPERATURE: Bounds = from_to("a temperature", -100.0, 400.0, " °C");
pub(crate) const ACTIVATION: Bounds = from_to("an activation energy", 1.0, 500.0, " kJ/mol");
pub(crate) const SHARE_PER_KELVIN: Bounds = from_to("a share per kelvin", 0.0, 0.5, "");
pub(crate) const KRAUS_RATIO: Bounds = from_to("a ratio", 1.0, 100.0, "");
pub(crate) const KRAUS_EXPONENT: Bounds = from_to("an exponent", 0.1, 2.0, "");
pub(crate) const STRAIN: Bounds = from_to("a shear strain", 1e-6, 10.0, ", 0.05 for 5 %");
pub(crate) const CYCLES: Bounds = from_to("a number of cycles", 1.0, LARGEST, "");
pub(crate) const LIFE_EXPONENT: Bounds = from_to("an exponent", 1.0, 30.0, "");
pub(crate) const GLASS_RATIO: Bounds = at_least("a ratio", 1.01);
/// Of a fractional derivative, and of the transition to shear-thinning.
pub(crate) const EXPONENT: Bounds = from_to("a value", 0.05, 1.0, "");
pub(crate) const FLOW_INDEX: Bounds = from_to("a value", 0.0, 0.95, "");
pub(crate) const SHORE_A: Bounds = from_to("a hardness", 20.0, 95.0, " Shore A");
pub(crate) const DENSITY: Bounds = from_to("a density", 500.0, 3000.0, " kg/m³");

// tolerances, proofs and searches
pub(crate) const TOLERANCE: Bounds = from_to("a share", 1e-6, 0.9, ": 0.1 is 10 % more or less");
pub(crate) const SCATTER_OF_HARDNESS: Bounds = from_to("a hardness", 0.1, 20.0, " Shore A");
pub(crate) const SCATTER_OF_VISCOSITY: Bounds = from_to("a share", 0.1, 90.0, " %");
pub(crate) const SCATTER_OF_TEMPERATURE: Bounds = from_to("a temperature", 0.1, 40.0, " K");
pub(crate) const PERCENTILE: Bounds = from_to("per cent of the designs", 1.0, 99.9, "");
pub(crate) const YIELD_PERCENT: Bounds = from_to("per cent of the designs", 50.0, 99.9, "");
pub(crate) const RELATIVE_ERROR: Bounds = from_to("a relative error", 1e-9, 0.1, " (0.001 is 0.1 %)");
pub(crate) const GAP: Bounds = from_to("a gap", 1e-8, 0.5, ", as a share of the value");

impl Bounds {
    /// What a parameter of an absorber may be.
    pub(crate) fn of_parameter(range: Range) -> Self {
        match range {
            Range::Positive => POSITIVE,
            Range::NotNegative => NOT_NEGATIVE,
            Range::Above(low) => above("a value", low),
            Range::Within(low, high) => from_to("a value", low, high, ""),
        }
    }

    /// Whether a number is taken; written so that nan never is.
    pub(crate) fn contains(&self, x: f64) -> bool {
        let above = if self.low_is_in { x >= self.low } else { x > self.low && (self.low != 0.0 || x >= SMALLEST) };
        let below = if self.high_is_in { x <= self.high.min(LARGEST) } else { x < self.high };
        above && below
    }

    /// What a message says is expected.
    pub(crate) fn expected(&self) -> String {
        self.expected_of(self.what)
    }

    /// The same, where a message calls it otherwise.
    pub(crate) fn expected_of(&self, what: &str) -> String {
        let (low, high, after) = (shown(self.low), shown(self.high), self.after);
        if self.high.is_infinite() {
            return match (self.low_is_in, self.low == 0.0) {
                (true, true) => format!("{what} of at least zero, up to {LARGEST:e}"),
                (true, false) => format!("{what} of at least {low}, up to {LARGEST:e}"),
                (false, true) => format!("{what} above zero, from {SMALLEST:e} to {LARGEST:e}"),
                (false, false) => format!("{what} above {low}, up to {LARGEST:e}"),
            };
        }
        match (self.low_is_in, self.high_is_in) {
            (true, true) => format!("{what} from {low} to {high}{after}"),
            (true, false) => format!("{what} from {low} to below {high}{after}"),
            (false, true) => format!("{what} above {low}, at most {high}{after}"),
            (false, false) => format!("{what} above {low}, below {high}{after}"),
        }
    }

    /// The range in the schema of a number.
    pub(super) fn of_number(self) -> impl FnMut(&mut Schema) {
        move |schema| before_examples(schema, self.keywords())
    }

    /// The range in the schema of a list, of each of its numbers.
    pub(super) fn of_list(self) -> impl FnMut(&mut Schema) {
        move |schema| {
            schema.insert("items".into(), self.schema());
        }
    }

    /// The schema of such a number.
    pub(super) fn schema(&self) -> Value {
        let mut map = Map::from_iter([("type".to_owned(), json!("number"))]);
        map.extend(self.keywords());
        Value::Object(map)
    }

    /// The same with words and an example.
    pub(super) fn described(&self, about: &str, example: f64) -> Value {
        let mut schema = self.schema();
        schema["description"] = json!(about);
        schema["examples"] = json!([plain(example)]);
        schema
    }

    /// The range as the schema states it.
    pub(super) fn keywords(&self) -> Vec<(String, Value)> {
        let low = if self.low_is_in { "minimum" } else { "exclusiveMinimum" };
        let high = if self.high_is_in { "maximum" } else { "exclusiveMaximum" };
        let both = [(low, self.low), (high, self.high)].into_iter().filter(|(_, x)| x.is_finite());
        both.map(|(key, x)| (key.to_owned(), plain(x))).collect()
    }
}

/// A kind of whole number and its range, both ends allowed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Whole {
    what: &'static str,
    pub low: i64,
    pub high: i64,
}

const fn whole(what: &'static str, low: i64, high: i64) -> Whole {
    Whole { what, low, high }
}

pub(crate) const SEED: Whole = whole("a whole number", 0, i64::MAX);
pub(crate) const RANDOM_STARTS: Whole = whole("a whole number", 0, 1000);
pub(crate) const BOXES: Whole = whole("a whole number", 0, 1_000_000_000);
pub(crate) const POINTS_OF_FRONT: Whole = whole("a number of points", 2, 10_000);
pub(crate) const POINTS_OF_SIZING: Whole = whole("a number of points", 2, 100);
pub(crate) const SAMPLES: Whole = whole("a whole number of designs", 100, 1_000_000);
pub(crate) const BEST: Whole = whole("how many of the best are wanted,", 1, 100);
pub(crate) const CASES_PER_SHARD: Whole = whole("a whole number", 1, 1_000_000);
pub(crate) const POINTS_OF_SAMPLE: Whole = whole("a whole number", 1, 10_000_000);
pub(crate) const SETS_OF_ENGINES: Whole = whole("a whole number", 0, 1_000_000);

impl Whole {
    /// What a message says is expected.
    pub(crate) fn expected(&self) -> String {
        format!("{} from {} to {}", self.what, self.low, self.high)
    }

    /// The range in the schema of a number.
    pub(super) fn of_number(self) -> impl FnMut(&mut Schema) {
        let high = (self.high < i64::MAX).then(|| ("maximum".to_owned(), json!(self.high)));
        let keywords = [("minimum".to_owned(), json!(self.low))].into_iter().chain(high).collect::<Vec<_>>();
        move |schema| before_examples(schema, keywords.clone())
    }
}

/// Puts a range before the default and the examples of a key, where readers look for it.
fn before_examples(schema: &mut Schema, range: Vec<(String, Value)>) {
    let map = schema.ensure_object();
    let later: Vec<_> = ["examples", "default"].into_iter().filter_map(|key| map.remove_entry(key)).collect();
    map.extend(range.into_iter().chain(later.into_iter().rev()));
}

/// A number of the schema, without a point where it is whole.
fn plain(x: f64) -> Value {
    if x.fract() == 0.0 && x.abs() < 1e15 { json!(x as i64) } else { json!(x) }
}

/// A number of a message.
fn shown(x: f64) -> String {
    if x == 0.0 || (1e-3..1e5).contains(&x.abs()) { format!("{x}") } else { format!("{x:e}") }
}
