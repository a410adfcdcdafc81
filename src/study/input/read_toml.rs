//! A TOML text as serde reads it. The tree is that of the `toml` crate; here it is handed on by one kind of table and one kind of list, so that what is derived for a
//! type of the schema is compiled once (`toml` itself has three kinds of table: the copies were a twelfth of the time to build this library).

use super::overrides::Overrides;
use serde::de::value::{StrDeserializer, U64Deserializer};
use serde::de::{DeserializeOwned, DeserializeSeed, Deserializer, EnumAccess, Error, IntoDeserializer, MapAccess, SeqAccess};
use serde::de::{Unexpected, VariantAccess, Visitor};
use std::fmt;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeFloat, DeInteger, DeString, DeTable, DeValue};

/// What is wrong with a text, and at which bytes.
#[derive(Debug)]
pub(super) struct Wrong {
    pub message: String,
    pub span: Option<Range<usize>>,
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Wrong {}

impl Error for Wrong {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self { message: message.to_string(), span: None }
    }
}

impl Wrong {
    /// The innermost place stays.
    fn at(mut self, span: Range<usize>) -> Self {
        self.span.get_or_insert(span);
        self
    }
}

/// Reads a text, some of whose keys have other values.
///
/// # Errors
/// The first mistake of grammar, key or type.
pub(super) fn from_str<T: DeserializeOwned>(text: &str, overrides: &Overrides) -> Result<T, Wrong> {
    let table = DeTable::parse(text).map_err(|e| Wrong { message: e.message().to_owned(), span: e.span() })?;
    let span = table.span();
    let mut table = table.into_inner();
    overrides.apply(&mut table, text.len()).map_err(|e| Wrong { message: e.message, span: Some(e.span) })?;
    T::deserialize(Node { value: DeValue::Table(table), span })
}

/// A value and where it stands.
struct Node<'de> {
    value: DeValue<'de>,
    span: Range<usize>,
}

impl<'de> From<Spanned<DeValue<'de>>> for Node<'de> {
    fn from(value: Spanned<DeValue<'de>>) -> Self {
        Self { span: value.span(), value: value.into_inner() }
    }
}

fn signed(i: &DeInteger<'_>) -> Option<i64> {
    i64::from_str_radix(i.as_str(), i.radix()).ok()
}

/// Numbers beyond the largest are none, but infinity is.
fn float(x: &DeFloat<'_>) -> Option<f64> {
    x.as_str().parse().ok().filter(|f: &f64| !f.is_infinite() || x.as_str().contains("inf"))
}

fn unexpected<'a>(value: &'a DeValue<'_>) -> Unexpected<'a> {
    match value {
        DeValue::String(s) => Unexpected::Str(s),
        DeValue::Integer(i) => signed(i).map_or(Unexpected::Other("large integer"), Unexpected::Signed),
        DeValue::Float(x) => float(x).map_or(Unexpected::Other("large number"), Unexpected::Float),
        DeValue::Boolean(b) => Unexpected::Bool(*b),
        DeValue::Array(_) => Unexpected::Seq,
        DeValue::Datetime(_) => Unexpected::Other("date"),
        DeValue::Table(_) => Unexpected::Map,
    }
}

impl<'de> Node<'de> {
    fn table<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        let DeValue::Table(table) = self.value else {
            return Err(Wrong::invalid_type(unexpected(&self.value), &visitor).at(self.span));
        };
        visitor.visit_map(Table { rows: table.into_iter(), value: None }).map_err(|e| e.at(self.span))
    }

    fn list<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        let DeValue::Array(list) = self.value else {
            return Err(Wrong::invalid_type(unexpected(&self.value), &visitor).at(self.span));
        };
        visitor.visit_seq(List(list.into_iter())).map_err(|e| e.at(self.span))
    }

    /// A text, number or truth value.
    fn single<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        match self.value {
            DeValue::String(DeString::Owned(s)) => visitor.visit_string(s),
            DeValue::String(DeString::Borrowed(s)) => visitor.visit_borrowed_str(s),
            DeValue::Integer(i) => match (signed(&i), u64::from_str_radix(i.as_str(), i.radix())) {
                (Some(i), _) => visitor.visit_i64(i),
                (None, Ok(u)) => visitor.visit_u64(u),
                (None, Err(_)) => Err(Wrong::custom(format_args!("found {i}, expected a whole number of at most 19 digits"))),
            },
            DeValue::Float(x) => float(&x).map_or_else(
                || Err(Wrong::custom(format_args!("found {}, expected a number below 1.8e308", x.as_str()))),
                |x| visitor.visit_f64(x),
            ),
            DeValue::Boolean(b) => visitor.visit_bool(b),
            other => Err(Wrong::invalid_type(unexpected(&other), &visitor)),
        }
        .map_err(|e| e.at(self.span))
    }
}

macro_rules! single {
    ($($name:ident)*) => {
        $(fn $name<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
            self.single(visitor)
        })*
    };
}

impl<'de> Deserializer<'de> for Node<'de> {
    type Error = Wrong;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        match self.value {
            DeValue::Table(_) => self.table(visitor),
            DeValue::Array(_) => self.list(visitor),
            _ => self.single(visitor),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Wrong> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_struct<V: Visitor<'de>>(self, _: &'static str, _: &'static [&'static str], visitor: V) -> Result<V::Value, Wrong> {
        self.table(visitor)
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        self.table(visitor)
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Wrong> {
        self.list(visitor)
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Wrong> {
        self.list(visitor)
    }

    /// Only [`At`](super::At) asks for it: its value after the place, see [`place`].
    fn deserialize_tuple_struct<V: Visitor<'de>>(self, _: &'static str, _: usize, visitor: V) -> Result<V::Value, Wrong> {
        let span = self.span.clone();
        visitor.visit_map(Placed(Some(self))).map_err(|e| e.at(span))
    }

    fn deserialize_enum<V: Visitor<'de>>(self, _: &'static str, _: &'static [&'static str], visitor: V) -> Result<V::Value, Wrong> {
        let span = self.span.clone();
        let variant = match self.value {
            DeValue::String(word) => Variant { word, at: span.clone(), value: None },
            DeValue::Table(table) => {
                let mut rows = table.into_iter();
                match (rows.next(), rows.next()) {
                    (Some((key, value)), None) => Variant { at: key.span(), word: key.into_inner(), value: Some(value.into()) },
                    (None, _) => return Err(Wrong::custom("wanted exactly 1 element, found 0 elements").at(span)),
                    _ => return Err(Wrong::custom("wanted exactly 1 element, more than 1 element").at(span)),
                }
            }
            _ => return Err(Wrong::custom("wanted string or table").at(span)),
        };
        visitor.visit_enum(variant).map_err(|e| e.at(span))
    }

    single! {
        deserialize_bool deserialize_i8 deserialize_i16 deserialize_i32 deserialize_i64 deserialize_u8 deserialize_u16 deserialize_u32 deserialize_u64
        deserialize_f32 deserialize_f64 deserialize_char deserialize_str deserialize_string
    }

    serde::forward_to_deserialize_any! { bytes byte_buf unit unit_struct identifier ignored_any }
}

/// A table.
struct Table<'de> {
    rows: toml::map::IntoIter<Spanned<DeString<'de>>, Spanned<DeValue<'de>>>,
    value: Option<Spanned<DeValue<'de>>>,
}

impl<'de> MapAccess<'de> for Table<'de> {
    type Error = Wrong;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Wrong> {
        let Some((key, value)) = self.rows.next() else { return Ok(None) };
        self.value = Some(value);
        let word: StrDeserializer<'_, Wrong> = key.get_ref().as_ref().into_deserializer();
        seed.deserialize(word).map(Some).map_err(|e| e.at(key.span()))
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Wrong> {
        let node = Node::from(self.value.take().ok_or_else(|| Wrong::custom("a value was asked for before its key"))?);
        let span = node.span.clone();
        seed.deserialize(node).map_err(|e| e.at(span))
    }
}

/// A list.
struct List<'de>(std::vec::IntoIter<Spanned<DeValue<'de>>>);

impl<'de> SeqAccess<'de> for List<'de> {
    type Error = Wrong;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Wrong> {
        let Some(node) = self.0.next().map(Node::from) else { return Ok(None) };
        let span = node.span.clone();
        seed.deserialize(node).map(Some).map_err(|e| e.at(span))
    }
}

/// A word of a list of words, or a table of one key that is such a word.
struct Variant<'de> {
    word: DeString<'de>,
    at: Range<usize>,
    value: Option<Node<'de>>,
}

impl<'de> EnumAccess<'de> for Variant<'de> {
    type Error = Wrong;
    type Variant = Behind<'de>;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Behind<'de>), Wrong> {
        let word: StrDeserializer<'_, Wrong> = self.word.as_ref().into_deserializer();
        seed.deserialize(word).map(|v| (v, Behind(self.value))).map_err(|e| e.at(self.at))
    }
}

/// What stands behind the word, if anything.
struct Behind<'de>(Option<Node<'de>>);

impl<'de> Behind<'de> {
    fn node(self, expected: &str) -> Result<Node<'de>, Wrong> {
        self.0.ok_or_else(|| Wrong::invalid_type(Unexpected::UnitVariant, &expected))
    }
}

impl<'de> VariantAccess<'de> for Behind<'de> {
    type Error = Wrong;

    fn unit_variant(self) -> Result<(), Wrong> {
        match self.0 {
            Some(Node { value: DeValue::Table(table), span }) if !table.is_empty() => Err(Wrong::custom("expected empty table").at(span)),
            None | Some(Node { value: DeValue::Table(_), .. }) => Ok(()),
            Some(Node { value, span }) => Err(Wrong::invalid_type(unexpected(&value), &"table").at(span)),
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Wrong> {
        seed.deserialize(self.node("newtype variant")?)
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Wrong> {
        self.node("tuple variant")?.list(visitor)
    }

    fn struct_variant<V: Visitor<'de>>(self, _: &'static [&'static str], visitor: V) -> Result<V::Value, Wrong> {
        self.node("struct variant")?.table(visitor)
    }
}

/// A value behind its place: the first and last byte as the key of a table of one row.
struct Placed<'de>(Option<Node<'de>>);

/// Bits of the last byte; files are shorter.
const BITS: u32 = 32;

/// The place in the key that [`At`](super::At) reads.
pub(super) fn place(key: u64) -> Range<usize> {
    let byte = |b: u64| usize::try_from(b).unwrap_or(usize::MAX);
    byte(key >> BITS)..byte(key & ((1 << BITS) - 1))
}

impl<'de> MapAccess<'de> for Placed<'de> {
    type Error = Wrong;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Wrong> {
        let Some(node) = &self.0 else { return Ok(None) };
        let key = (node.span.start as u64) << BITS | node.span.end as u64;
        let key: U64Deserializer<Wrong> = key.into_deserializer();
        seed.deserialize(key).map(Some)
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Wrong> {
        seed.deserialize(self.0.take().ok_or_else(|| Wrong::custom("a value was asked for twice"))?)
    }
}
