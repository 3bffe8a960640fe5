//! Determines the code family of a photo's rings.
//!
//! A family explains a photo when it reads, or leaves in doubt, every ring that any family reads. Under "auto" a photo's codes are
//! taken when exactly one family explains it. A ring that several families read in the same way cannot distinguish them: it
//! counts with whatever family the other rings show.
//!
//! A ring whose arcs all end on a coarser grid is of a family of fewer sectors, or by chance a code (one in 20 of 12 sectors, in
//! 80 of 16): the rings beside it tell which.
//!
//! What a ring alone leaves uncertain the others settle: among several that are codes beyond doubt one more is no chance, unless it has a
//! number that another one has.

use std::collections::HashMap;

use super::{CodeReading, read};
use crate::detect::acceptance::code::COMPANY;
use crate::detection::{CodeCandidate, CodeNote, Codes, Target};
use crate::image::{Sample, SampleView};
use crate::ring_code::Family;

/// Reads the codes of all targets of a photo in one picture.
pub(crate) fn read_in<T: Sample>(plane: &SampleView<T>, targets: &mut [Target], codes: Codes) {
    let size = plane.width.max(plane.height);
    read_all(targets, codes, |_, target, families| read(plane, size, target, target.quality.edge_width, families));
}

/// Settles the codes of all targets of a photo, each of which `read` reads as a code of every family; the family that they are of.
pub(crate) fn read_all(
    targets: &mut [Target],
    codes: Codes,
    mut read: impl FnMut(usize, &Target, &[Family]) -> Vec<CodeReading>,
) -> Option<Family> {
    let families = codes.families();
    if families.is_empty() {
        return None;
    }
    let mut readings: Vec<Vec<CodeReading>> =
        targets.iter().enumerate().map(|(k, target)| read(k, target, families)).collect();
    let chosen = chosen(&readings, families.len());
    if let Some(family) = chosen {
        settle_coarse(&mut readings, family, families.len() == 1);
        settle(&mut readings, family);
    }
    for (target, readings) in targets.iter_mut().zip(readings) {
        enter(target, families, readings, chosen);
    }
    chosen.map(|chosen| families[chosen])
}

/// The family that alone explains all readings.
fn chosen(readings: &[Vec<CodeReading>], families: usize) -> Option<usize> {
    let rings = readings.iter().filter(|ring| ring.iter().any(|reading| matches!(reading, CodeReading::Code { .. })));
    let explains = |ring: &[CodeReading], family: usize| {
        matches!(
            ring[family],
            CodeReading::Code { .. } | CodeReading::Doubtful { .. } | CodeReading::Coarse { number: Some(_), .. }
        )
    };
    let reads = |family: usize| readings.iter().any(|ring| matches!(ring[family], CodeReading::Code { .. }));
    let mut all = (0..families).filter(|family| reads(*family) && rings.clone().all(|ring| explains(ring, *family)));
    let first = all.next()?;
    all.next().is_none().then_some(first)
}

/// Takes the rings of a family that lie on a coarser grid for codes where so few do, against those that lie on its own grid alone, that they
/// are its codes by chance; where its user has named the family one such code tells that its sheets are in the photo.
fn settle_coarse(readings: &mut [Vec<CodeReading>], family: usize, is_named: bool) {
    let count = |is: fn(&CodeReading) -> bool| readings.iter().filter(|ring| is(&ring[family])).count();
    let fine = count(|reading| matches!(reading, CodeReading::Code { .. }));
    let coarse = count(|reading| matches!(reading, CodeReading::Coarse { .. }));
    let expected = fine / COMPANY + usize::from(is_named && fine > 0);
    if coarse > expected {
        return;
    }
    for reading in readings.iter_mut().map(|ring| &mut ring[family]) {
        if let CodeReading::Coarse { number: Some(number), margin } = *reading {
            *reading = CodeReading::Code { number, margin };
        }
    }
}

/// Takes the uncertain rings of a family for codes where enough others are.
fn settle(readings: &mut [Vec<CodeReading>], family: usize) {
    let number_of = |reading: &CodeReading| match reading {
        CodeReading::Code { number, .. } => Some(*number),
        CodeReading::Doubtful { numbers, note: CodeNote::Uncertain, .. } => numbers.first().copied(),
        _ => None,
    };
    let mut times = HashMap::<u32, usize>::new();
    let all = || readings.iter().map(|ring| &ring[family]);
    all().filter_map(number_of).for_each(|number| *times.entry(number).or_default() += 1);
    if all().filter(|reading| matches!(reading, CodeReading::Code { .. })).count() < COMPANY {
        return;
    }
    for reading in readings.iter_mut().map(|ring| &mut ring[family]) {
        if let CodeReading::Doubtful { numbers, margin, note: CodeNote::Uncertain } = reading
            && let [number] = numbers[..]
            && times[&number] == 1
        {
            *reading = CodeReading::Code { number, margin: *margin };
        }
    }
}

/// Result of reading a target's code.
fn enter(target: &mut Target, families: &[Family], readings: Vec<CodeReading>, chosen: Option<usize>) {
    target.code = None;
    target.code_family = None;
    target.code_candidates.clear();
    let several = readings.iter().filter(|reading| matches!(reading, CodeReading::Code { .. })).count() > 1;
    for (k, (family, reading)) in families.iter().zip(readings).enumerate() {
        match reading {
            CodeReading::Plain => {}
            CodeReading::Code { number, margin } => {
                if chosen == Some(k) {
                    (target.code, target.code_family) = (Some(number), Some(*family));
                    target.quality.code_margin = Some(margin);
                }
                if chosen != Some(k) || several {
                    target.code_candidates.push(CodeCandidate { family: *family, number, margin });
                }
            }
            CodeReading::Doubtful { numbers, margin, note } => {
                let candidate = |number| CodeCandidate { family: *family, number, margin: 0.0 };
                target.code_candidates.extend(numbers.into_iter().map(candidate));
                // what this photo rules out other photos may show to be the family of all; it explains nothing here
                if chosen.is_none_or(|chosen| chosen == k) {
                    target.quality.code_margin = Some(margin);
                    target.quality.code_note = Some(note);
                }
            }
            CodeReading::Coarse { number, margin } => {
                if let Some(number) = number {
                    target.code_candidates.push(CodeCandidate { family: *family, number, margin: 0.0 });
                }
                if chosen.is_none_or(|chosen| chosen == k) {
                    target.quality.code_margin = Some(margin);
                    target.quality.code_note = Some(CodeNote::OtherFamily);
                }
            }
            CodeReading::NoCode { margin, note } => {
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
    use crate::matching::{PhotoTargets, name_coded};

    #[test]
    fn an_uncertain_ring_is_a_code_among_codes_if_it_is_the_only_one_of_its_number() {
        let code = |number| CodeReading::Code { number, margin: 0.9 };
        let uncertain =
            |number| CodeReading::Doubtful { numbers: vec![number], margin: 0.7, note: CodeNote::Uncertain };
        let other = |number| CodeReading::Doubtful { numbers: vec![number], margin: 0.7, note: CodeNote::OtherFamily };
        let settled = |certain: u32| {
            let mut readings: Vec<Vec<CodeReading>> = (1..=certain).map(|number| vec![code(number)]).collect();
            readings
                .extend([uncertain(50), uncertain(1), uncertain(51), uncertain(51), other(52)].map(|one| vec![one]));
            settle(&mut readings, 0);
            readings
                .split_off(certain as usize)
                .into_iter()
                .map(|ring| matches!(ring[0], CodeReading::Code { .. }))
                .collect::<Vec<_>>()
        };
        assert_eq!(settled(COMPANY as u32), [true, false, false, false, false]);
        assert_eq!(settled(COMPANY as u32 - 1), [false; 5]);
    }

    #[test]
    fn rings_on_a_coarser_grid_are_codes_among_many_that_are_not() {
        let taken = |fine: u32, coarse: u32, none: usize, is_named: bool| {
            let mut readings: Vec<Vec<CodeReading>> =
                (0..fine).map(|number| vec![CodeReading::Code { number, margin: 0.9 }]).collect();
            let on_grid = |number| vec![CodeReading::Coarse { number, margin: 0.8 }];
            readings.extend((0..coarse).map(|number| on_grid(Some(100 + number))));
            readings.extend((0..none).map(|_| on_grid(None)));
            settle_coarse(&mut readings, 0, is_named);
            readings.iter().filter(|ring| matches!(ring[0], CodeReading::Code { .. })).count() as u32 - fine
        };
        for is_named in [false, true] {
            assert_eq!([taken(0, 4, 4, is_named), taken(0, 1, 0, is_named), taken(4, 4, 0, is_named)], [0; 3]);
            assert_eq!([taken(4, 1, 0, is_named), taken(40, 2, 3, is_named)], [1, 2]);
        }
        assert_eq!([taken(1, 1, 0, false), taken(1, 1, 0, true), taken(1, 1, 1, true)], [0, 1, 0]);
    }

    /// A photo whose targets read like this, and the family that it shows.
    fn photo(rings: &[&[(Family, CodeReading)]]) -> (Option<Family>, Vec<Target>) {
        let mut targets: Vec<_> = rings.iter().map(|_| crate::matching::target(10.0, 20.0, Some(1))).collect();
        let family = read_all(&mut targets, Codes::Auto, |k, _, families| {
            let reading = |family: &Family| rings[k].iter().find(|(own, _)| own == family).map(|(_, r)| r.clone());
            families.iter().map(|family| reading(family).unwrap_or(CodeReading::Plain)).collect()
        });
        (family, targets)
    }

    #[test]
    fn doubts_in_families_that_a_photo_rules_out_count_among_all_photos() {
        let code = |number| CodeReading::Code { number, margin: 0.9 };
        let doubtful = |numbers| CodeReading::Doubtful { numbers, margin: 0.3, note: CodeNote::BetweenLevels };
        for [own, other] in [[Family::Ring12, Family::Ring20], [Family::Metashape20, Family::Metashape12]] {
            let both = [(own, code(5)), (other, doubtful(vec![70, 77]))];
            let (family, first) = photo(&[&both, &[(other, doubtful(vec![80]))]]);
            assert_eq!(family, Some(own));
            let [ring, unclear] = &first[..] else { panic!("{first:?}") };
            assert_eq!((ring.code, ring.code_family, ring.quality.code_note), (Some(5), Some(own), None));
            assert_eq!(ring.quality.code_margin, Some(0.9));
            let candidates: Vec<_> = ring.code_candidates.iter().map(|c| (c.family, c.number, c.margin)).collect();
            assert_eq!(candidates, [(other, 70, 0.0), (other, 77, 0.0)]);
            // the photo's own family sees no ring there
            assert_eq!((unclear.code, unclear.quality.code_note, unclear.quality.code_margin), (None, None, None));
            assert_eq!((unclear.code_candidates[0].family, unclear.code_candidates[0].number), (other, 80));

            let (family, second) = photo(&[&[(other, code(9))]]);
            assert_eq!(family, Some(other));
            let named = |photos: &[&Vec<Target>]| {
                let photo = |(k, targets): (usize, &&Vec<Target>)| PhotoTargets {
                    photo: k.to_string(),
                    targets: targets.to_vec(),
                };
                name_coded(&photos.iter().enumerate().map(photo).collect::<Vec<_>>(), None)
            };
            assert_eq!(named(&[&first]).family, Some(own));
            let coded = named(&[&first, &second]);
            assert_eq!((coded.family, coded.observations.len()), (Some(other), 1));
            let asked: Vec<_> = coded.doubtful.iter().map(|d| d.points.join(" ")).collect();
            assert_eq!(asked, ["70 77", "80"]);
            // what is no ring of the other family is left unexplained
            let (_, apart) = photo(&[&both, &[(own, code(6))]]);
            let coded = named(&[&apart, &second]);
            assert!(coded.family.is_none() && coded.families.is_empty(), "{coded:?}");
        }
    }
}
