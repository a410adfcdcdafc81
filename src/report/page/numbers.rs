//! Numbers for the script: five significant digits, which is more than a screen shows.

use serde_json::Value;

/// One; null where it is not finite.
pub(super) fn digits(x: f64) -> Value {
    if x.is_finite() { format!("{x:.4e}").parse::<f64>().map_or(Value::Null, Value::from) } else { Value::Null }
}

/// Several.
pub(super) fn list(values: &[f64]) -> Value {
    values.iter().map(|v| digits(*v)).collect()
}
