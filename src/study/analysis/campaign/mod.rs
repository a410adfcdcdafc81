//! Campaigns: what each case of many gives.

mod cases;
mod columns;
mod dampers;
mod platform;
mod points;
mod rows;
mod setup;
mod shard;

pub use cases::{Case, Shard};
pub use columns::{Cell, CellKind, Column, columns, compared_by};
pub use points::{Index, indices};
pub use rows::{Row, Status};
pub use shard::{Rows, run_cases};
