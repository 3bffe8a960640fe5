//! Small targets in light, where the picture's levels are a camera's tone curve of it.
//!
//! Lens and pixels blur light; the curve comes after. Half-way between the levels of an edge of blur σ lies less than half of its light,
//! the share s, and the edge shows σ Φ⁻¹(s) to the dark side of where it is: bright sectors look wider, dark ones narrower. Whether a
//! picture is bent so is not known here; both are read.

use super::{contrast, outline_of};
use crate::detect::acceptance::code::{TONE, TONE_SMALL};
use crate::detect::part::Part;
use crate::detection::{Polarity, Target};
use crate::image::{Plane, Sample};
use crate::statistics::distribution::normal_quantile;

/// Level of the most light.
const WHITE: f64 = 60_000.0;
/// Side of the part that a target is read in, over its diameter, and pixels beside: all of the widest ring and its ground.
const WINDOW: (f64, usize) = (5.0, 16);

/// The window around a target that holds its ring.
pub(in crate::detect) fn around<T: Sample>(plane: &Plane<T>, target: &Target) -> Part<T> {
    Part::of(plane, target.u, target.v, (WINDOW.0 * target.major) as usize + WINDOW.1)
}

/// A target's window in light, and the target as it is there; none where it is too large for a difference.
pub(super) fn of<T: Sample>(plane: &Plane<T>, target: &Target, blur: f64) -> Option<(Part<u16>, Target)> {
    if target.minor > TONE_SMALL {
        return None;
    }
    let [dot, ground] = super::radial::levels(plane, target).map(|level| light(level / f64::from(T::MAX)));
    let [dark, bright] = if dot < ground { [dot, ground] } else { [ground, dot] };
    let between = ((dark.powf(1.0 / TONE) + bright.powf(1.0 / TONE)) / 2.0).powf(TONE);
    let share = (between - dark) / (bright - dark);
    if !(share > 0.0 && share < 0.5) {
        return None;
    }
    let aside = -blur * normal_quantile(share);
    let outline = outline_of(target).grown(if target.polarity == Polarity::Bright { -aside } else { aside });
    let part = around(plane, target);
    let samples = part.samples.iter().map(|s| (WHITE * light(f64::from(s.level()) / f64::from(T::MAX))).round() as u16);
    let part =
        Part { left: part.left, top: part.top, width: part.width, height: part.height, samples: samples.collect() };
    let (a, b, angle) = outline.axes();
    let mut target = Target {
        u: target.u - part.left as f64,
        v: target.v - part.top as f64,
        major: 2.0 * a,
        minor: 2.0 * b,
        angle,
        ..target.clone()
    };
    target.contrast = contrast(&part.plane(), &target);
    Some((part, target))
}

fn light(level: f64) -> f64 {
    level.max(0.0).powf(TONE)
}
