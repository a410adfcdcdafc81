//! Measures as typed: in `[[objective]]`, `[[constraint]]` and `[pareto]` alike. What belongs to one of them only (a limit) is looked at later.

use super::fatigue::RawCriterion;
use crate::input::error::At;
use serde::Deserialize;

#[derive(Debug, Default, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawOver {
    #[default]
    Synthesis,
    Orders,
    Duty,
}

#[derive(Debug, Default, Clone, Copy, Deserialize)]
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
    ($(#[$meta:meta])* $name:ident { $($field:ident: $kind:ty,)* }) => {
        $(#[$meta])*
        #[derive(Debug, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(crate) struct $name {
            $(pub $field: $kind,)*
            pub speed_rpm: Option<At<Vec<At<f64>>>>,
            pub except_rpm: Option<RawPairs>,
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

over_speed!(RawTwist {
    from: At<String>,
    to: At<String>,
    over: Option<RawOver>,
    order: Option<At<f64>>,
    max_deg: Option<At<f64>>,
});
over_speed!(RawAmplitude { station: At<String>, over: Option<RawOver>, order: Option<At<f64>>, max_deg: Option<At<f64>>, });
over_speed!(RawAcceleration { station: At<String>, over: Option<RawOver>, order: Option<At<f64>>, max_rad_per_s2: Option<At<f64>>, });
over_speed!(#[derive(Default)] RawTorque { shaft: Option<At<String>>, over: Option<RawOver>, order: Option<At<f64>>, max_n_m: Option<At<f64>>, });
over_speed!(RawStress {
    shaft: At<String>,
    outer_diameter_mm: At<f64>,
    inner_diameter_mm: Option<At<f64>>,
    over: Option<RawOver>,
    order: Option<At<f64>>,
    max_mpa: Option<At<f64>>,
    iacs_m68: Option<At<RawM68>>,
    korean_register_crank: Option<At<RawKrCrank>>,
});
over_speed!(#[derive(Default)] RawRingTwist { absorber: Option<At<i64>>, over: Option<RawOver>, order: Option<At<f64>>, max_deg: Option<At<f64>>, });
over_speed!(RawStrain {
    absorber: At<i64>,
    mean_radius_mm: At<f64>,
    thickness_mm: At<f64>,
    over: Option<RawOver>,
    order: Option<At<f64>>,
    max_percent: Option<At<f64>>,
});
over_speed!(#[derive(Default)] RawPower { absorber: Option<At<i64>>, over: Option<RawPowerOver>, max_w: Option<At<f64>>, });
over_speed!(RawPowerPerArea {
    absorber: At<i64>,
    area_m2: At<f64>,
    over: Option<RawPowerOver>,
    max_w_per_m2: Option<At<f64>>,
});
over_speed!(#[derive(Default)] RawMargin { criterion: Option<At<RawCriterion>>, min: Option<At<f64>>, });

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawKrCrank {
    pub rated_speed_rpm: At<f64>,
    pub tensile_strength_mpa: At<f64>,
    pub engine: RawKrEngine,
}

#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawKrEngine {
    FourStrokeInLine,
    #[serde(rename = "four_stroke_vee_45_60")]
    FourStrokeVee,
    Other,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawM68 {
    pub rated_speed_rpm: At<f64>,
    pub tensile_strength_mpa: At<f64>,
    pub stress_factor: At<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawLossFactor {
    pub absorber: Option<At<i64>>,
    pub max: Option<At<f64>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawInertia {
    pub absorber: Option<At<i64>>,
    pub max_kg_m2: Option<At<f64>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawBand {
    pub outside_hz: At<Vec<At<f64>>>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawMeasure {
    PeakTwist(RawTwist),
    HubAmplitude(RawAmplitude),
    Acceleration(RawAcceleration),
    VibratoryTorque(RawTorque),
    ShaftStress(RawStress),
    RingTwist(RawRingTwist),
    ElementStrain(RawStrain),
    DissipatedPower(RawPower),
    PowerPerArea(RawPowerPerArea),
    LossFactor(RawLossFactor),
    RingInertia(RawInertia),
    TotalInertia(RawInertia),
    NaturalFrequency(RawBand),
    Margin(RawMargin),
}
