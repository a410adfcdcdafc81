#![allow(missing_docs)]
pub mod absorber;
pub mod assess;
pub mod chain;
pub mod design;
pub mod engine;
pub mod numerics;
pub mod optimise;
pub mod response;
pub mod study;
pub mod units;
