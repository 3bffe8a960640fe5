//! Codes are read in light. Under the curve of the search ([`curve`](super::curve)) blurred edges lie elsewhere: white sectors are wider
//! by half a pixel, and a narrow sector of one family is a wider one of another.

use super::Searched;
use crate::detect::code;
use crate::detection::{Codes, Target};
use crate::ring_code::Family;

/// Reads the codes of targets that were measured in the picture of the search; the family that they are of.
pub(super) fn read_in_light(searched: &Searched, targets: &mut [Target], codes: Codes) -> Option<Family> {
    if codes == Codes::None {
        return None;
    }
    let (plane, light) = (searched.plane()?, &searched.light);
    let light =
        |level: f64| f64::from(light[(level.round().max(0.0) as usize).min(light.len() - 1)]) / f64::from(u16::MAX);
    targets.iter_mut().for_each(|t| (t.quality.code_margin, t.quality.code_note) = (None, None));
    code::read_all(targets, codes, |_, target, families| code::read_curve(&plane, target, families, light))
}
