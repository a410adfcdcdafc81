//! Campaigns: what each case of many gives.

mod cases;
mod columns;
mod points;
mod rows;
mod setup;
mod shard;

pub use cases::{Case, Shard};
pub use columns::{Cell, CellKind, Column, columns, index_of};
pub use points::{Index, indices};
pub use rows::{Row, Status};
pub use shard::{Rows, run_cases};
