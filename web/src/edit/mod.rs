//! Edits of the document: plain functions on [`Project`](sightline::project::Project), independent of signals and jobs.
//! Each does one thing, returns its side effects, and refuses changes that would damage the document. The desk's actions make them
//! undoable.

pub mod attaching;
pub mod cameras;
pub mod cells;
pub mod control;
pub mod epoch;
pub mod equipment;
pub mod exchange;
pub mod features;
pub mod grids;
pub mod many;
pub mod models;
pub mod naming;
pub mod pairs;
pub mod plan;
pub mod points;
pub mod questions;
pub mod report;
pub mod rig;
pub mod sample;
pub mod scale_bars;
pub mod sheet;
pub mod targets;
#[cfg(test)]
pub mod undoing;
pub mod unit;

use std::cmp::Ordering;

/// Order of names in which numbers count as numbers.
pub fn natural(a: &str, b: &str) -> Ordering {
    let (mut a, mut b) = (a.chars().peekable(), b.chars().peekable());
    loop {
        match (a.peek().copied(), b.peek().copied()) {
            (None, None) => return Ordering::Equal,
            (None, _) => return Ordering::Less,
            (_, None) => return Ordering::Greater,
            (Some(x), Some(y)) if x.is_ascii_digit() && y.is_ascii_digit() => {
                let number = |chars: &mut std::iter::Peekable<std::str::Chars<'_>>| {
                    let mut digits = String::new();
                    while let Some(digit) = chars.next_if(char::is_ascii_digit) {
                        digits.push(digit);
                    }
                    let digits = digits.trim_start_matches('0').to_owned();
                    (digits.len(), digits)
                };
                match number(&mut a).cmp(&number(&mut b)) {
                    Ordering::Equal => {}
                    unequal => return unequal,
                }
            }
            (Some(x), Some(y)) if x == y => {
                a.next();
                b.next();
            }
            (Some(x), Some(y)) => return x.cmp(&y),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_names_count_as_numbers() {
        let mut names = ["IMG_10.jpg", "IMG_9.jpg", "IMG_009b.jpg", "A.jpg", "IMG_1.jpg"];
        names.sort_by(|a, b| natural(a, b));
        assert_eq!(names, ["A.jpg", "IMG_1.jpg", "IMG_9.jpg", "IMG_009b.jpg", "IMG_10.jpg"]);
    }
}
