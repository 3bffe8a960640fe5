//! Which family a photo's rings belong to.
//!
//! A family explains a photo when it reads, or leaves in doubt, every ring that any family reads. Under "auto" a photo's codes are
//! taken when exactly one family explains it. A ring that several families read in the same way tells them not apart: it
//! counts with whatever family the other rings show.
//!
//! What a ring alone leaves uncertain the others settle: among several that are codes beyond doubt one more is no chance, unless it has a
//! number that another one has.

use std::collections::HashMap;

use super::{Reading, read};
use crate::detect::acceptance::code::COMPANY;
use crate::detection::{CodeCandidate, CodeNote, Codes, Target};
use crate::image::{Plane, Sample};
use crate::ring_code::Family;

/// Reads the codes of all targets of a photo in one picture.
pub(crate) fn read_in<T: Sample>(plane: &Plane<T>, targets: &mut [Target], codes: Codes) {
    read_all(targets, codes, |_, target, families| read(plane, target, target.quality.edge_width, families));
}

/// Settles the codes of all targets of a photo, each of which `read` reads as a code of every family; the family that they are of.
pub(crate) fn read_all(
    targets: &mut [Target],
    codes: Codes,
    read: impl Fn(usize, &Target, &[Family]) -> Vec<Reading>,
) -> Option<Family> {
    let families = codes.families();
    if families.is_empty() {
        return None;
    }
    let mut readings: Vec<Vec<Reading>> =
        targets.iter().enumerate().map(|(k, target)| read(k, target, families)).collect();
    let chosen = chosen(&readings, families.len());
    if let Some(family) = chosen {
        settle(&mut readings, family);
    }
    for (target, readings) in targets.iter_mut().zip(readings) {
        enter(target, families, readings, chosen);
    }
    chosen.map(|chosen| families[chosen])
}

/// The family that alone explains all readings.
fn chosen(readings: &[Vec<Reading>], families: usize) -> Option<usize> {
    let rings = readings.iter().filter(|ring| ring.iter().any(|reading| matches!(reading, Reading::Code { .. })));
    let explains =
        |ring: &[Reading], family: usize| matches!(ring[family], Reading::Code { .. } | Reading::Doubtful { .. });
    let reads = |family: usize| readings.iter().any(|ring| matches!(ring[family], Reading::Code { .. }));
    let mut all = (0..families).filter(|family| reads(*family) && rings.clone().all(|ring| explains(ring, *family)));
    let first = all.next()?;
    all.next().is_none().then_some(first)
}

/// Takes the uncertain rings of a family for codes where enough others are.
fn settle(readings: &mut [Vec<Reading>], family: usize) {
    let number_of = |reading: &Reading| match reading {
        Reading::Code { number, .. } => Some(*number),
        Reading::Doubtful { numbers, note: CodeNote::Uncertain, .. } => numbers.first().copied(),
        _ => None,
    };
    let mut times = HashMap::<u32, usize>::new();
    let all = || readings.iter().map(|ring| &ring[family]);
    all().filter_map(number_of).for_each(|number| *times.entry(number).or_default() += 1);
    if all().filter(|reading| matches!(reading, Reading::Code { .. })).count() < COMPANY {
        return;
    }
    for reading in readings.iter_mut().map(|ring| &mut ring[family]) {
        if let Reading::Doubtful { numbers, margin, note: CodeNote::Uncertain } = reading
            && let [number] = numbers[..]
            && times[&number] == 1
        {
            *reading = Reading::Code { number, margin: *margin };
        }
    }
}

/// What a target says of its code.
fn enter(target: &mut Target, families: &[Family], readings: Vec<Reading>, chosen: Option<usize>) {
    target.code = None;
    target.code_family = None;
    target.code_candidates.clear();
    let several = readings.iter().filter(|reading| matches!(reading, Reading::Code { .. })).count() > 1;
    for (k, (family, reading)) in families.iter().zip(readings).enumerate() {
        let mine = chosen.is_none_or(|chosen| chosen == k);
        match reading {
            Reading::Plain => {}
            Reading::Code { number, margin } => {
                if chosen == Some(k) {
                    (target.code, target.code_family) = (Some(number), Some(*family));
                    target.quality.code_margin = Some(margin);
                }
                if chosen != Some(k) || several {
                    target.code_candidates.push(CodeCandidate { family: *family, number, margin });
                }
            }
            // doubts in families that the photo's other rings rule out are none
            Reading::Doubtful { numbers, margin, note } if mine => {
                let candidate = |number| CodeCandidate { family: *family, number, margin: 0.0 };
                target.code_candidates.extend(numbers.into_iter().map(candidate));
                target.quality.code_margin = Some(margin);
                target.quality.code_note = Some(note);
            }
            Reading::Doubtful { .. } => {}
            Reading::NoCode { margin, note } => {
                if chosen == Some(k) || families.len() == 1 {
                    target.quality.code_margin = Some(margin);
                    target.quality.code_note = Some(note);
                }
            }
        }
    }
    if target.code.is_none() && chosen.is_none() && several {
        target.quality.code_note = Some(CodeNote::SeveralFamilies);
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn an_uncertain_ring_is_a_code_among_codes_if_it_is_the_only_one_of_its_number() {
        let code = |number| Reading::Code { number, margin: 0.9 };
        let uncertain = |number| Reading::Doubtful { numbers: vec![number], margin: 0.7, note: CodeNote::Uncertain };
        let other = |number| Reading::Doubtful { numbers: vec![number], margin: 0.7, note: CodeNote::OtherFamily };
        let settled = |certain: u32| {
            let mut readings: Vec<Vec<Reading>> = (1..=certain).map(|number| vec![code(number)]).collect();
            readings
                .extend([uncertain(50), uncertain(1), uncertain(51), uncertain(51), other(52)].map(|one| vec![one]));
            settle(&mut readings, 0);
            readings
                .split_off(certain as usize)
                .into_iter()
                .map(|ring| matches!(ring[0], Reading::Code { .. }))
                .collect::<Vec<_>>()
        };
        assert_eq!(settled(COMPANY as u32), [true, false, false, false, false]);
        assert_eq!(settled(COMPANY as u32 - 1), [false; 5]);
    }
}
