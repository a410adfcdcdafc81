//! Measures as typed: in `[[objective]]`, `[[constraint]]` and `[pareto]` alike. What belongs to one of them only (a limit) is looked at later.

use super::bounds::{KR_STRENGTH, M68_STRENGTH, M68_STRESS_FACTOR, NOT_NEGATIVE, ORDER, POSITIVE};
use super::fatigue::RawCriterion;
use super::keyword::by_word;
use super::measure_of_construction::{RawCost, RawEnvelope, RawMass, RawVolume};
use crate::input::error::At;
use crate::objective::{STATISTICS, Statistic};
use schemars::JsonSchema;
use serde::Deserialize;

/// What of the orders a measure is of.
#[derive(Debug, Default, Clone, Copy)]
pub(crate) enum RawOver {
    #[default]
    Synthesis,
    Orders,
    Duty,
    Statistic(Statistic),
}

impl RawOver {
    fn all() -> impl Iterator<Item = Self> {
        [Self::Synthesis, Self::Orders, Self::Duty].into_iter().chain(STATISTICS.map(Self::Statistic))
    }

    fn name(self) -> &'static str {
        match self {
            Self::Synthesis => "synthesis",
            Self::Orders => "orders",
            Self::Duty => "duty",
            Self::Statistic(Statistic(row)) => row.name,
        }
    }
}

by_word!(RawOver, "RawOver", RawOver::all(), RawOver::name, std::convert::identity);

#[derive(Debug, Default, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawPowerOver {
    #[default]
    Speed,
    Duty,
}

/// Pairs of numbers: ranges of speed (rpm), or speeds with factors.
pub(crate) type RawPairs = At<Vec<At<Vec<At<f64>>>>>;

/// Where a measure counts, as typed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RawWithin<'a> {
    pub speed_rpm: Option<&'a At<Vec<At<f64>>>>,
    pub except_rpm: Option<&'a RawPairs>,
    pub factor_by_speed: Option<&'a RawPairs>,
}

/// A measure over speed: its own keys, and those that all of them have.
macro_rules! over_speed {
    ($(#[$meta:meta])* $name:ident { $($(#[$about:meta])* $field:ident: $kind:ty,)* }) => {
        $(#[$meta])*
        #[derive(Debug, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        pub(crate) struct $name {
            $($(#[$about])* pub $field: $kind,)*
            /// Part of the speeds that counts: the lowest and the highest.
            #[schemars(transform = POSITIVE.of_list(), extend("minItems" = 2, "maxItems" = 2, "examples" = [[1000, 2500]]))]
            pub speed_rpm: Option<At<Vec<At<f64>>>>,
            /// Ranges of speed that do not count.
            #[schemars(extend("examples" = [[[1400, 1500]]]))]
            pub except_rpm: Option<RawPairs>,
            /// Speeds with a factor on the limit, linear between them.
            #[schemars(extend("examples" = [[[1000, 1], [3000, 0.5]]]))]
            pub factor_by_speed: Option<RawPairs>,
        }

        impl $name {
            pub fn within(&self) -> RawWithin<'_> {
                RawWithin {
                    speed_rpm: self.speed_rpm.as_ref(),
                    except_rpm: self.except_rpm.as_ref(),
                    factor_by_speed: self.factor_by_speed.as_ref(),
                }
            }
        }
    };
}

/// A measure of the orders of a quantity: with what is made of them between its own keys and its limit.
macro_rules! of_orders {
    ($(#[$meta:meta])* $name:ident { $($own:tt)* } limited { $($limit:tt)* }) => {
        over_speed!($(#[$meta])* $name {
            $($own)*
            /// Over the sum of orders, the largest order, the root mean square, or the mean over the duty.
            #[schemars(extend("default" = "synthesis", "examples" = ["orders"]))]
            over: Option<RawOver>,
            /// One order only.
            #[schemars(transform = ORDER.of_number(), extend("examples" = [6]))]
            order: Option<At<f64>>,
            $($limit)*
        });
    };
}

of_orders!(RawTwist {
    /// The first station.
    #[schemars(extend("examples" = ["pulley"]))]
    from: At<String>,
    /// The second station, or `ground`.
    #[schemars(extend("examples" = ["flywheel"]))]
    to: At<String>,
} limited {
    /// Largest value allowed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.4]))]
    max_deg: Option<At<f64>>,
});
of_orders!(RawAmplitude {
    /// The station.
    #[schemars(extend("examples" = ["pulley"]))]
    station: At<String>,
} limited {
    /// Largest value allowed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.4]))]
    max_deg: Option<At<f64>>,
});
of_orders!(RawVelocity {
    /// The station.
    #[schemars(extend("examples" = ["pulley"]))]
    station: At<String>,
} limited {
    /// Largest value allowed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [10]))]
    max_rad_per_s: Option<At<f64>>,
});
of_orders!(RawAcceleration {
    /// The station.
    #[schemars(extend("examples" = ["pulley"]))]
    station: At<String>,
} limited {
    /// Largest value allowed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [2000]))]
    max_rad_per_s2: Option<At<f64>>,
});
of_orders!(#[derive(Default)] RawTorque {
    /// The station before the shaft; without it the largest of all shafts.
    #[schemars(extend("examples" = ["throw_3"]))]
    shaft: Option<At<String>>,
} limited {
    /// Largest value allowed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [900]))]
    max_n_m: Option<At<f64>>,
});
of_orders!(RawStress {
    /// The station before the shaft.
    #[schemars(extend("examples" = ["throw_6"]))]
    shaft: At<String>,
    /// Outer diameter of its section.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [72]))]
    outer_diameter_mm: At<f64>,
    /// Inner diameter of its section.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 0, "examples" = [20]))]
    inner_diameter_mm: Option<At<f64>>,
} limited {
    /// Largest value allowed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [40]))]
    max_mpa: Option<At<f64>>,
    /// Limit by IACS UR M68, over speed.
    #[schemars(extend("examples" = [{"rated_speed_rpm": 2500, "tensile_strength_mpa": 600, "stress_factor": 1}]))]
    iacs_m68: Option<At<RawM68>>,
    /// Limit by the Korean Register's rule for cranks, over speed.
    #[schemars(extend("examples" = [{"rated_speed_rpm": 2500, "tensile_strength_mpa": 900, "engine": "four_stroke_in_line"}]))]
    korean_register_crank: Option<At<RawKrCrank>>,
});
of_orders!(#[derive(Default)] RawRingTwist {
    /// The absorber by its number; without it the largest of all.
    #[schemars(extend("minimum" = 1, "examples" = [1]))]
    absorber: Option<At<i64>>,
} limited {
    /// Largest value allowed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [3]))]
    max_deg: Option<At<f64>>,
});
of_orders!(RawStrain {
    /// The absorber by its number.
    #[schemars(extend("minimum" = 1, "examples" = [1]))]
    absorber: At<i64>,
    /// Mean radius of the element.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [95]))]
    mean_radius_mm: At<f64>,
    /// Its thickness.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [5]))]
    thickness_mm: At<f64>,
} limited {
    /// Largest value allowed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [10]))]
    max_percent: Option<At<f64>>,
});
over_speed!(#[derive(Default)] RawPower {
    /// The absorber by its number; without it the sum of all.
    #[schemars(extend("minimum" = 1, "examples" = [1]))]
    absorber: Option<At<i64>>,
    /// The worst speed, or the mean over the duty.
    #[schemars(extend("default" = "speed", "examples" = ["duty"]))]
    over: Option<RawPowerOver>,
    /// Largest value allowed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [150]))]
    max_w: Option<At<f64>>,
});
over_speed!(RawPowerPerArea {
    /// The absorber by its number.
    #[schemars(extend("minimum" = 1, "examples" = [1]))]
    absorber: At<i64>,
    /// Area that heat leaves by.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.05]))]
    area_m2: At<f64>,
    /// The worst speed, or the mean over the duty.
    #[schemars(extend("default" = "speed", "examples" = ["duty"]))]
    over: Option<RawPowerOver>,
    /// Largest value allowed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [5000]))]
    max_w_per_m2: Option<At<f64>>,
});
of_orders!(RawSpringStress {
    /// The absorber by its number.
    #[schemars(extend("minimum" = 1, "examples" = [1]))]
    absorber: At<i64>,
    /// Stress of the springs per twist of the ring, from their drawing; without it that of `leaf_springs` or `coil_springs` by their dimensions.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [180]))]
    mpa_per_deg: Option<At<f64>>,
} limited {
    /// Largest value allowed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [400]))]
    max_mpa: Option<At<f64>>,
});
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawLifeOf {
    /// The absorber by its number; its material says how many cycles of strain it bears.
    #[schemars(extend("minimum" = 1, "examples" = [1]))]
    pub absorber: At<i64>,
    /// Least life over the duty.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [8000]))]
    pub min_h: Option<At<f64>>,
}
over_speed!(RawTemperature {
    /// The absorber by its number; its material says what cools it.
    #[schemars(extend("minimum" = 1, "examples" = [1]))]
    absorber: At<i64>,
    /// Largest value allowed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [110]))]
    max_c: Option<At<f64>>,
});
over_speed!(RawOwnStrain {
    /// The absorber by its number; a type by its dimensions.
    #[schemars(extend("minimum" = 1, "examples" = [1]))]
    absorber: At<i64>,
    /// Largest value allowed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [12]))]
    max_percent: Option<At<f64>>,
});

over_speed!(#[derive(Default)] RawMargin {
    /// The criterion; without it the first of `[fatigue]`.
    #[schemars(extend("examples" = ["goodman"]))]
    criterion: Option<At<RawCriterion>>,
    /// Least margin.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [1.5]))]
    min: Option<At<f64>>,
});

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawKrCrank {
    /// Rated speed of the crankshaft.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [2500]))]
    pub rated_speed_rpm: At<f64>,
    /// Tensile strength.
    #[schemars(transform = KR_STRENGTH.of_number(), extend("examples" = [900]))]
    pub tensile_strength_mpa: At<f64>,
    /// Kind of engine.
    #[schemars(extend("examples" = ["four_stroke_in_line"]))]
    pub engine: RawKrEngine,
}

#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawKrEngine {
    FourStrokeInLine,
    #[serde(rename = "four_stroke_vee_45_60")]
    FourStrokeVee,
    Other,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [{ "required": ["rated_speed_rpm"] }, { "required": ["rated_shaft_speed_rpm"] }]))]
pub(crate) struct RawM68 {
    /// Rated speed of the crankshaft, of a shaft behind a gear, too; or `rated_shaft_speed_rpm`.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [2500]))]
    pub rated_speed_rpm: Option<At<f64>>,
    /// Rated speed of the shaft itself, which behind a gear is another one than that of the crankshaft; in place of `rated_speed_rpm`.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [500]))]
    pub rated_shaft_speed_rpm: Option<At<f64>>,
    /// Specified minimum tensile strength, as the rule counts it: at most 800 of alloy steel, 600 of carbon and carbon-manganese steel and of any propeller shaft.
    #[schemars(transform = M68_STRENGTH.of_number(), extend("examples" = [600]))]
    pub tensile_strength_mpa: At<f64>,
    /// c_K of the rule: 1 for an intermediate shaft with an integral flange or a shrink fit, 0.6 with a tapered keyway, 0.45 with a cylindrical one, 0.5 with a radial hole, 0.3 with a longitudinal slot; 0.85 for a thrust shaft; 0.55 for a propeller shaft near its propeller, 0.8 forward of it.
    #[schemars(transform = M68_STRESS_FACTOR.of_number(), extend("examples" = [1]))]
    pub stress_factor: At<f64>,
}

#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawLossFactor {
    /// The absorber by its number; without it the largest of all.
    #[schemars(extend("minimum" = 1, "examples" = [1]))]
    pub absorber: Option<At<i64>>,
    /// Largest value allowed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.25]))]
    pub max: Option<At<f64>>,
}

#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawInertia {
    /// The absorber by its number; without it all together.
    #[schemars(extend("minimum" = 1, "examples" = [1]))]
    pub absorber: Option<At<i64>>,
    /// Largest value allowed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.1]))]
    pub max_kg_m2: Option<At<f64>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawBand {
    /// Band that natural frequencies keep out of.
    #[schemars(transform = NOT_NEGATIVE.of_list(), extend("examples" = [[180, 220]]))]
    pub outside_hz: At<Vec<At<f64>>>,
}

#[expect(clippy::large_enum_variant, reason = "a study has few of them")]
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawMeasure {
    /// Twist between two stations.
    PeakTwist(RawTwist),
    /// Amplitude of a station.
    HubAmplitude(RawAmplitude),
    /// Angular velocity of a station about its mean.
    Velocity(RawVelocity),
    /// Angular acceleration of a station.
    Acceleration(RawAcceleration),
    /// Vibratory torque of a shaft.
    VibratoryTorque(RawTorque),
    /// Nominal torsional stress of a shaft.
    ShaftStress(RawStress),
    /// Twist between ring and hub.
    RingTwist(RawRingTwist),
    /// Shear strain of an absorber's element.
    ElementStrain(RawStrain),
    /// Shear strain of the rubber of an absorber, by its dimensions; oil has none that counts, springs and pendulums have none.
    Strain(RawOwnStrain),
    /// Stress of an absorber's springs by the twist of its ring: bending of leaves at the clamp, shear of coils.
    SpringStress(RawSpringStress),
    /// Life of what an absorber shears, over the duty.
    Life(RawLifeOf),
    /// Power that absorbers turn to heat.
    DissipatedPower(RawPower),
    /// Dissipated power over the area it leaves by.
    PowerPerArea(RawPowerPerArea),
    /// Temperature that an absorber reaches from cold.
    Temperature(RawTemperature),
    /// Loss factor at the tuned frequency.
    LossFactor(RawLossFactor),
    /// Inertia of the ring.
    RingInertia(RawInertia),
    /// Inertia of ring and hub.
    TotalInertia(RawInertia),
    /// Mass of an absorber, by its dimensions.
    Mass(RawMass),
    /// Volume of the cylinder that an absorber fills, by its dimensions.
    Volume(RawVolume),
    /// Cost of an absorber, a function of its masses and its diameter.
    Cost(RawCost),
    /// Room for an absorber: a limit for each of its sizes that is given.
    Envelope(RawEnvelope),
    /// Natural frequencies kept out of a band.
    NaturalFrequency(RawBand),
    /// Smallest margin of the crank.
    Margin(RawMargin),
}
