//! What several views share; it uses none of them.

pub mod changes;
pub mod choosing;
pub mod coordinates;
pub mod drawing;
pub mod field;
pub mod given;
pub mod icon;
pub mod keys;
pub mod no_result;
pub mod parameters;
pub mod progress;
pub mod table;
pub mod title;
pub mod transform;
pub mod units;
pub mod visible_rows;
