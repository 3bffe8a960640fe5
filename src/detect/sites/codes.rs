//! Codes are read in light. Under the curve of the search ([`curve`](super::curve)) blurred edges lie elsewhere: white sectors are wider
//! by half a pixel, and a narrow sector of one family is a wider one of another.

use super::curve::Curve;
use crate::decode::Photo;
use crate::detect::code;
use crate::detect::part::Part;
use crate::detection::{Codes, Target};
use crate::image::{Plane, Samples};

/// Side of the window that a target is read in, over its diameter, and pixels beside: all of the widest ring and its ground.
const WINDOW: (f64, usize) = (5.0, 16);

/// Reads the codes of targets that were measured in the picture of the search.
pub(super) fn read_in_light(photo: &Photo, curve: &Curve, targets: &mut [Target], codes: Codes) {
    let Samples::U16(samples) = &photo.grey.samples else { return };
    if codes == Codes::None {
        return;
    }
    let (plane, light) = (Plane::new(photo.grey.width, photo.grey.height, samples), curve.undone());
    targets.iter_mut().for_each(|t| (t.quality.code_margin, t.quality.code_note) = (None, None));
    code::read_all(targets, codes, |_, target, families| {
        let mut part = Part::of(&plane, target.u, target.v, (WINDOW.0 * target.major) as usize + WINDOW.1);
        part.samples.iter_mut().for_each(|sample| *sample = light[(*sample as usize).min(light.len() - 1)]);
        let (u, v) = (target.u - part.left as f64, target.v - part.top as f64);
        let part = Plane::new(part.width, part.height, &part.samples);
        let mut target = Target { u, v, ..target.clone() };
        target.contrast = code::contrast(&part, &target);
        code::read(&part, &target, target.quality.edge_width, families)
    });
}
