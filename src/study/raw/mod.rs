//! Files as typed: keys, units and choices, nothing checked but grammar and type.

pub mod engine;
pub mod study;
