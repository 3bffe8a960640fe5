//! Small targets in light, where the picture's levels are a camera's tone curve of it.
//!
//! Lens and pixels blur light; the curve comes after. Half-way between the levels of an edge of blur σ lies less than half of its light,
//! the share s, and the edge shows σ Φ⁻¹(s) to the dark side of where it is: bright sectors look wider, dark ones narrower. Whether a
//! picture is bent so is not known here; both are read.

use super::outline_of;
use super::radial::{contrast, levels};
use crate::detect::acceptance::code::{TONE, TONE_SMALL};
use crate::detect::part::Part;
use crate::detection::{Polarity, Target};
use crate::image::{Plane, Sample};
use crate::statistics::distribution::normal_quantile;

/// Level of the most light.
const WHITE: f64 = 60_000.0;
/// Side of the part that a target is read in, over its diameter, and pixels beside: all of the widest ring and its ground.
const WINDOW: (f64, usize) = (5.0, 16);

/// The part of a picture that holds a target and its ring, in light, and the target as it is there; `light` is that of a level, of 1.
/// None where the target has no contrast.
pub(in crate::detect) fn of<T: Sample>(
    plane: &Plane<T>,
    target: &Target,
    blur: f64,
    light: impl Fn(f64) -> f64,
) -> Option<(Part<u16>, Target)> {
    let [dot, ground] = levels(plane, target);
    let [dark, bright] = [dot.min(ground), dot.max(ground)].map(&light);
    let share = (light((dot + ground) / 2.0) - dark) / (bright - dark);
    if !(share > 0.0 && share < 1.0) {
        return None;
    }
    let aside = -blur * normal_quantile(share);
    let outline = outline_of(target).grown(if target.polarity == Polarity::Bright { -aside } else { aside });
    let Part { left, top, width, height, samples } =
        Part::of(plane, target.u, target.v, (WINDOW.0 * target.major) as usize + WINDOW.1);
    let samples = in_light(&samples, |level| (WHITE * light(f64::from(level))).round() as u16);
    let part = Part { left, top, width, height, samples };
    let (a, b, angle) = outline.axes();
    let (u, v) = (target.u - left as f64, target.v - top as f64);
    let mut target = Target { u, v, major: 2.0 * a, minor: 2.0 * b, angle, ..target.clone() };
    target.contrast = contrast(&part.plane(), &target);
    Some((part, target))
}

/// Samples through a curve, of which a table is made where that is less work.
fn in_light<T: Sample>(samples: &[T], curve: impl Fn(u32) -> u16) -> Vec<u16> {
    let levels = || samples.iter().map(|sample| sample.level());
    let (first, last) = levels().fold((u32::MAX, 0), |(first, last), level| (first.min(level), last.max(level)));
    if (last.saturating_sub(first) as usize) < samples.len() {
        let table: Vec<u16> = (first..=last).map(curve).collect();
        return levels().map(|level| table[(level - first) as usize]).collect();
    }
    levels().map(curve).collect()
}

/// The same where a camera's curve may have bent the levels; none where the target is too large for a difference.
pub(super) fn of_screen<T: Sample>(plane: &Plane<T>, target: &Target, blur: f64) -> Option<(Part<u16>, Target)> {
    let light = |level: f64| (level / f64::from(T::MAX)).max(0.0).powf(TONE);
    (target.minor <= TONE_SMALL).then(|| of(plane, target, blur, light)).flatten()
}
