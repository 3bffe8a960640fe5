//! Which family a photo's rings belong to.
//!
//! A family explains a photo when it reads, or leaves in doubt, every ring that any family reads. Under "auto" a photo's codes are
//! taken when exactly one family explains it. A ring that several families read in the same way tells them not apart: it
//! counts with whatever family the other rings show.

use super::{Reading, read};
use crate::detection::{CodeCandidate, CodeNote, Codes, Target};
use crate::image::{Plane, Sample};
use crate::ring_code::Family;

/// Reads the codes of all targets of a photo in one picture.
pub(crate) fn read_in<T: Sample>(plane: &Plane<T>, targets: &mut [Target], codes: Codes) {
    read_all(targets, codes, |_, target, families| read(plane, target, target.quality.edge_width, families));
}

/// Settles the codes of all targets of a photo, each of which `read` reads as a code of every family.
pub(crate) fn read_all(targets: &mut [Target], codes: Codes, read: impl Fn(usize, &Target, &[Family]) -> Vec<Reading>) {
    let families = codes.families();
    if families.is_empty() {
        return;
    }
    let readings: Vec<Vec<Reading>> = targets.iter().enumerate().map(|(k, target)| read(k, target, families)).collect();
    let chosen = chosen(&readings, families.len());
    for (target, readings) in targets.iter_mut().zip(readings) {
        enter(target, families, readings, chosen);
    }
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
