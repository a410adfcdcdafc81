//! Keys of files as a list, one by one, and as a page.

use crate::input::keys::{Key, Presence};
use serde_json::Value;
use std::fmt::Write;

/// A value as it stands in a TOML file, on one line.
fn toml(value: &Value) -> String {
    match value {
        Value::Array(list) => format!("[{}]", list.iter().map(toml).collect::<Vec<_>>().join(", ")),
        Value::Object(map) => format!("{{ {} }}", map.iter().map(|(key, v)| format!("{key} = {}", toml(v))).collect::<Vec<_>>().join(", ")),
        Value::Number(n) => match n.as_f64() {
            Some(x) if x != 0.0 && !(1e-4..1e7).contains(&x.abs()) => format!("{x:e}"),
            Some(x) => x.to_string(),
            None => n.to_string(),
        },
        other => other.to_string(),
    }
}

fn takes(key: &Key) -> String {
    let unit = key.unit.map_or_else(String::new, |unit| format!(", {unit}"));
    let default = match (&key.default, key.presence) {
        (Some(value), _) => format!("; without it {}", toml(value)),
        (None, Presence::Optional) => "; optional".into(),
        (None, Presence::OneOf) => "; one of several".into(),
        (None, Presence::Required) => "; required".into(),
    };
    format!("{}{unit}{default}", key.takes)
}

/// A line a key: its path and what it takes.
#[doc(hidden)]
pub fn list(keys: &[Key]) -> String {
    let mut out = String::new();
    for key in keys {
        let _ = writeln!(out, "{}\n    {}", key.path, takes(key));
    }
    out
}

/// All that is known of some keys.
#[doc(hidden)]
pub fn explained(keys: &[&Key]) -> String {
    let mut out = String::new();
    for key in keys {
        let _ = writeln!(out, "{} ({} file)\n    {}\n    {}", key.path, key.file.name(), key.about, takes(key));
        let inner = key.inner();
        if !inner.is_empty() {
            let _ = writeln!(out, "    Its keys: {}", inner.iter().map(|k| format!("`{k}`")).collect::<Vec<_>>().join(", "));
        }
        if let Some(example) = &key.example {
            let _ = writeln!(out, "    {} = {}", key.name(), toml(example));
        }
    }
    out
}

/// A page of all keys in Markdown.
pub fn page(keys: &[Key]) -> String {
    let mut out = String::new();
    let cell = |text: &str| text.replace('|', "\\|");
    for (i, key) in keys.iter().enumerate() {
        if i == 0 || keys[i - 1].file != key.file {
            let _ = write!(
                out,
                "{}# The {} file\n\n| key | what it is | takes | example |\n|---|---|---|---|\n",
                if i > 0 { "\n" } else { "" },
                key.file.name()
            );
        }
        let example = key.example.as_ref().map_or_else(String::new, |e| format!("`{}`", cell(&toml(e))));
        let _ = writeln!(out, "| `{}` | {} | {} | {example} |", key.path, cell(&key.about), cell(&takes(key)));
    }
    out
}
