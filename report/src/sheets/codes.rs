//! Selects the codes to print: those named, or those with the largest mutual distance.

use crate::reason::ReportReason;
use std::sync::OnceLock;

use serde::{Deserialize, Serialize};

use sightline::error::{Error, Place, Result, shortened};
use sightline::ring_code::{CodesByDistance, Family, distance, spread};

/// How many codes of a family are so far from each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct CodeCount {
    /// Sectors that must be misread before one passes for another: with one less of them hidden none does.
    pub distance: u32,
    /// How many.
    pub count: usize,
}

/// How many codes a family has at each mutual distance, the largest first; the last entry is the whole family.
pub fn counts(family: Family) -> Vec<CodeCount> {
    order(family).counts.iter().map(|&(distance, count)| CodeCount { distance, count }).collect()
}

/// The order of a family, which takes a while and is made once.
fn order(family: Family) -> &'static CodesByDistance {
    static ORDERS: [OnceLock<CodesByDistance>; 8] = [const { OnceLock::new() }; 8];
    ORDERS[family as usize].get_or_init(|| spread(family))
}

/// The numbers to print, each once: `wanted` as "1-20, 35", or as many as `count` from the family's order, then `more` that
/// follow in that order.
///
/// # Errors
/// [`Error::Invalid`] if it is not a list of numbers, or for numbers that the family does not have.
pub fn numbers(family: Family, wanted: &str, count: usize, more: usize) -> Result<(Vec<u32>, Vec<u32>)> {
    let all = family.codes().len();
    let first = if wanted.trim().is_empty() {
        if count > all {
            let reason = ReportReason::SheetTooManyCodes { wanted: count, family: all }.into();
            return Err(Error::Invalid { reason, at: Place::field("codes") });
        }
        if count == 0 { Vec::new() } else { order(family).numbers[..count].to_vec() }
    } else {
        listed(wanted, all)?
    };
    if first.len() + more > all {
        let reason = ReportReason::SheetTooManyCodes { wanted: first.len() + more, family: all }.into();
        return Err(Error::Invalid { reason, at: Place::field("bars") });
    }
    if more == 0 {
        return Ok((first, Vec::new()));
    }
    let mut taken = vec![false; all + 1];
    first.iter().for_each(|number| taken[*number as usize] = true);
    let rest = order(family).numbers.iter().copied().filter(|n| !taken[*n as usize]).take(more);
    let rest = rest.collect();
    Ok((first, rest))
}

fn listed(wanted: &str, all: usize) -> Result<Vec<u32>> {
    let at = || Place::field("numbers");
    let mut seen = vec![false; all + 1];
    let mut found = Vec::new();
    for part in wanted.split([',', ';', ' ', '\n', '\t']).filter(|part| !part.is_empty()) {
        let broken =
            || Error::Invalid { reason: ReportReason::SheetNumbers { text: shortened(part) }.into(), at: at() };
        let number = |text: &str| text.trim().parse::<u32>().ok().filter(|n| *n > 0);
        let (low, high) = match part.split_once(['-', '–']) {
            Some((low, high)) => (number(low), number(high)),
            None => (number(part), number(part)),
        };
        let (low, high) = low.zip(high).filter(|(low, high)| low <= high).ok_or_else(broken)?;
        if high as usize > all {
            let reason = ReportReason::SheetNumberUnknown { number: high, family: all }.into();
            return Err(Error::Invalid { reason, at: at() });
        }
        for number in low..=high {
            if !std::mem::replace(&mut seen[number as usize], true) {
                found.push(number);
            }
        }
    }
    Ok(found)
}

/// Smallest mutual distance of codes given by their numbers. Among more than a thousand it is taken from the family's order.
pub fn least_distance(family: Family, numbers: &[u32]) -> Option<u32> {
    let codes = family.codes();
    let code = |number: &u32| codes[*number as usize - 1];
    if numbers.len() > 1000 {
        let order = order(family);
        let mut place = vec![0; codes.len() + 1];
        order.numbers.iter().enumerate().for_each(|(k, number)| place[*number as usize] = k);
        let last = numbers.iter().map(|number| place[*number as usize]).max()?;
        return order.counts.iter().find(|(_, count)| last < *count).map(|(distance, _)| *distance);
    }
    let pairs = numbers.iter().enumerate().flat_map(|(k, a)| numbers[..k].iter().map(move |b| (a, b)));
    pairs.map(|(a, b)| distance(code(a), code(b), family.bits())).min()
}
