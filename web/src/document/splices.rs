//! Differences between two versions of a table, as replaced rows; either version is restored from the other.

use std::ops::Range;

use serde::{Deserialize, Serialize};

/// Number of rows searched ahead for the next row common to both versions; without one, the rest of the table is one splice. A larger
/// number only makes the search slower.
const AHEAD: usize = 1000;

/// Rows that replace others.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Splice<T> {
    /// Index of the first row, in the version before.
    pub at: usize,
    /// The replaced rows of the version before.
    pub was: Vec<T>,
    /// The replacing rows of the version after.
    pub now: Vec<T>,
}

/// Number of rows in splices.
pub fn rows_in<T>(splices: &[Splice<T>]) -> usize {
    splices.iter().map(|splice| splice.was.len() + splice.now.len()).sum()
}

/// Differences between two versions of a table, in the order of the rows; none if they are equal.
pub fn between<T: Clone + PartialEq>(before: &[T], after: &[T]) -> Vec<Splice<T>> {
    let hunks = hunks(before, after).into_iter();
    let splice =
        |(b, a): (Range<usize>, Range<usize>)| Splice { at: b.start, was: before[b].to_vec(), now: after[a].to_vec() };
    hunks.map(splice).collect()
}

/// The ranges of rows that differ, in both versions.
fn hunks<T: PartialEq>(before: &[T], after: &[T]) -> Vec<(Range<usize>, Range<usize>)> {
    let same = |pairs: &mut dyn Iterator<Item = (&T, &T)>| pairs.take_while(|(b, a)| b == a).count();
    let start = same(&mut before.iter().zip(after));
    let end = same(&mut before[start..].iter().rev().zip(after[start..].iter().rev()));
    let (before_end, after_end) = (before.len() - end, after.len() - end);
    let (mut i, mut k) = (start, start);
    let mut hunks = Vec::new();
    while i < before_end || k < after_end {
        let (b, a) = (&before[i..before_end], &after[k..after_end]);
        let equal = same(&mut b.iter().zip(a));
        if equal > 0 {
            (i, k) = (i + equal, k + equal);
            continue;
        }
        let (left, came) = until_equal(b, a);
        hunks.push((i..i + left, k..k + came));
        (i, k) = (i + left, k + came);
    }
    hunks
}

/// Numbers of rows to skip in both versions until they are equal again, or to their ends.
fn until_equal<T: PartialEq>(before: &[T], after: &[T]) -> (usize, usize) {
    let meet = |i: usize, k: usize| before.get(i).is_some_and(|row| after.get(k) == Some(row));
    for n in 1..=AHEAD.min(before.len().max(after.len())) {
        for (i, k) in [(n, n), (n, 0), (0, n)] {
            if meet(i, k) {
                return (i, k);
            }
        }
    }
    (before.len(), after.len())
}

/// Whether splices can be applied to this version. Those of [`between`] can, unless a row in them does not equal itself (NaN).
pub fn fit<T: PartialEq>(before: &[T], splices: &[Splice<T>]) -> bool {
    splices.iter().all(|splice| before.get(splice.at..splice.at + splice.was.len()) == Some(&splice.was[..]))
}

/// The version after, from the version before.
///
/// # Errors
/// If the splices are of another table.
pub fn forward<T: Clone + PartialEq>(before: &[T], splices: &[Splice<T>]) -> Result<Vec<T>, String> {
    replaced(before, splices.iter().map(|splice| (splice.at, &splice.was[..], &splice.now[..])))
}

/// The version before, from the version after.
///
/// # Errors
/// If the splices are of another table.
pub fn back<T: Clone + PartialEq>(after: &[T], splices: &[Splice<T>]) -> Result<Vec<T>, String> {
    let mut shift = 0_isize;
    let turned = splices.iter().map(|Splice { at, was, now }| {
        let place = at.checked_add_signed(shift).unwrap_or(usize::MAX);
        shift += now.len() as isize - was.len() as isize;
        (place, &now[..], &was[..])
    });
    replaced(after, turned)
}

fn replaced<'a, T: Clone + PartialEq + 'a>(
    rows: &[T],
    splices: impl Iterator<Item = (usize, &'a [T], &'a [T])>,
) -> Result<Vec<T>, String> {
    let mut all = Vec::with_capacity(rows.len());
    let mut done = 0;
    for (at, gone, put) in splices {
        let end = at.saturating_add(gone.len());
        let fits = at >= done && rows.get(at..end) == Some(gone);
        if !fits {
            return Err(format!("rows {at} to {end} are not those that were changed"));
        }
        all.extend_from_slice(&rows[done..at]);
        all.extend_from_slice(put);
        done = end;
    }
    all.extend_from_slice(&rows[done..]);
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_that_does_not_equal_itself_fits_no_splice() {
        let (before, after) = ([1.0, 2.0, 3.0], [1.0, 4.0, 3.0]);
        assert!(fit(&before, &between(&before, &after)));
        let before = [1.0, f64::NAN, 3.0];
        assert!(!fit(&before, &between(&before, &after)));
    }

    #[test]
    fn either_version_is_restored_from_the_other_after_any_change() {
        let mut seed = 5_u64;
        let mut random = move |n: usize| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) as usize % n
        };
        for round in 0..400 {
            // Few different values, so that many rows are equal and the common rows are ambiguous.
            let values = 2 + random(40);
            let before = (0..random(60)).map(|_| random(values)).collect::<Vec<_>>();
            let mut after = before.clone();
            for _ in 0..random(6) {
                let at = random(after.len() + 1);
                match random(4) {
                    0 => after.insert(at, random(values)),
                    1 if at < after.len() => drop(after.remove(at)),
                    2 if at < after.len() => after[at] = random(values),
                    _ => after.truncate(after.len().saturating_sub(random(3))),
                }
            }
            let splices = between(&before, &after);
            assert_eq!(splices.is_empty(), before == after, "round {round}");
            assert_eq!(forward(&before, &splices).unwrap(), after, "round {round}");
            assert_eq!(back(&after, &splices).unwrap(), before, "round {round}");
        }
    }

    #[test]
    fn a_splice_contains_only_changed_rows() {
        let before = (0..10_000).collect::<Vec<_>>();
        let mut after = before.clone();
        after[17] = -1;
        after.retain(|row| row % 1000 != 500);
        let splices = between(&before, &after);
        assert_eq!(rows_in(&splices), 2 + 10);
        assert_eq!(splices.len(), 11);
    }

    #[test]
    fn splices_of_another_table_are_refused() {
        let splices = between(&[1, 2, 3], &[1, 5, 3]);
        assert!(forward(&[1, 4, 3], &splices).is_err());
        assert!(forward(&[1], &splices).is_err());
        assert!(back(&[1, 2, 3], &splices).is_err());
    }
}
