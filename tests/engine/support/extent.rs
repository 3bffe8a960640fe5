//! How far tests over many seeded cases go. `cargo xtask test` runs the daily part, `cargo xtask test all` everything: it sets
//! SIGHTLINE_EXTENT to `all` and runs ignored tests too.

use std::env::var;

/// The number of cases to run: `daily`, or `all` of them. A test's limits must hold for both.
pub fn cases(daily: usize, all: usize) -> usize {
    if is_all() { all } else { daily }
}

/// The first `daily` of a list of cases, or all of them.
pub fn of<T>(list: &[T], daily: usize) -> &[T] {
    &list[..cases(daily, list.len())]
}

fn is_all() -> bool {
    var("SIGHTLINE_EXTENT").is_ok_and(|extent| extent == "all")
}
