//! A value by its word, where the words stand with the values themselves.

use schemars::{Schema, json_schema};
use serde::Deserializer;
use serde::de::{Error, Visitor};
use std::fmt::Formatter;

/// One of `all` by its name. The word is taken by a visitor, so that a mistake is found where it stands.
pub(super) fn word<'de, T: Copy, D: Deserializer<'de>>(
    deserializer: D,
    all: impl IntoIterator<Item = T>,
    name: fn(T) -> &'static str,
) -> Result<T, D::Error> {
    deserializer.deserialize_str(Word { all: all.into_iter().collect(), name })
}

/// JSON Schema of one of `all` by its name.
pub(super) fn words<T: Copy>(all: impl IntoIterator<Item = T>, name: fn(T) -> &'static str) -> Schema {
    json_schema!({ "type": "string", "enum": all.into_iter().map(name).collect::<Vec<_>>() })
}

struct Word<T> {
    all: Vec<T>,
    name: fn(T) -> &'static str,
}

impl<T: Copy> Visitor<'_> for Word<T> {
    type Value = T;

    fn expecting(&self, f: &mut Formatter) -> std::fmt::Result {
        f.write_str("a word")
    }

    fn visit_str<E: Error>(self, word: &str) -> Result<T, E> {
        self.all.iter().copied().find(|value| (self.name)(*value) == word).ok_or_else(|| {
            let words: Vec<String> = self.all.iter().map(|value| format!("`{}`", (self.name)(*value))).collect();
            E::custom(format_args!("unknown variant `{word}`, expected one of {}", words.join(", ")))
        })
    }
}

/// Reads a type by its word, and gives the schema its words: all values, the word of one, and what makes the type of it.
macro_rules! by_word {
    ($raw:ident, $title:literal, $all:expr, $name:expr, $into:expr) => {
        impl<'de> serde::Deserialize<'de> for $raw {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                $crate::input::schema::keyword::word(deserializer, $all, $name).map($into)
            }
        }

        impl schemars::JsonSchema for $raw {
            fn inline_schema() -> bool {
                true
            }
            fn schema_name() -> std::borrow::Cow<'static, str> {
                $title.into()
            }
            fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
                $crate::input::schema::keyword::words($all, $name)
            }
        }
    };
}
pub(super) use by_word;
