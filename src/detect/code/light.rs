//! Small targets in linear light, if the grey levels follow a camera's tone curve.
//!
//! Lens and pixels blur light; the curve comes after. Half-way between the levels of an edge of blur σ lies less than half of its light,
//! the share s, and the edge shows σ Φ⁻¹(s) to the dark side of where it is: bright sectors look wider, dark ones narrower. Whether a
//! picture is bent so is not known here; both are read.

use super::outline_of;
use super::radial::{contrast, levels};
use crate::detect::acceptance::code::{TONE, TONE_SMALL};
use crate::detect::measure::Measure;
use crate::detect::outline::Outline;
use crate::detect::picture::noise;
use crate::detect::window::Window;
use crate::detection::{DetectOptions, Polarity, Target};
use crate::image::{Sample, SampleView};
use crate::statistics::distribution::normal_quantile;

/// Level of the most light.
const WHITE: f64 = 60_000.0;
/// Side of the part that a target is read in, over its diameter, and pixels beside: all of the widest ring and its background.
const WINDOW: (f64, usize) = (5.0, 16);

/// The part of a picture that holds a target and its ring, in light, and the target as it is there; `light` is that of a level, of 1.
/// `None` if the target has no contrast.
pub(in crate::detect) fn of<T: Sample>(
    plane: &SampleView<T>,
    target: &Target,
    blur: f64,
    light: impl Fn(f64) -> f64,
) -> Option<(Window<u16>, Target)> {
    let [dot, ground] = levels(plane, target);
    let [dark, bright] = [dot.min(ground), dot.max(ground)].map(&light);
    let share = (light((dot + ground) / 2.0) - dark) / (bright - dark);
    if !(share > 0.0 && share < 1.0) {
        return None;
    }
    let aside = -blur * normal_quantile(share);
    let outline = outline_of(target).grown(if target.polarity == Polarity::Bright { -aside } else { aside });
    let part = part_of(plane, target, light);
    let target =
        in_part(&part, target, Outline { u: target.u - part.left as f64, v: target.v - part.top as f64, ..outline });
    Some((part, target))
}

/// The part of a picture that holds a target and its ring, in light.
fn part_of<T: Sample>(plane: &SampleView<T>, target: &Target, light: impl Fn(f64) -> f64) -> Window<u16> {
    let Window { left, top, width, height, samples } =
        Window::of(plane, target.u, target.v, (WINDOW.0 * target.major) as usize + WINDOW.1);
    let samples = in_light(&samples, |level| (WHITE * light(f64::from(level))).round() as u16);
    Window { left, top, width, height, samples }
}

/// The target with an outline of that part.
fn in_part(part: &Window<u16>, target: &Target, outline: Outline) -> Target {
    let (a, b, angle) = outline.axes();
    let mut target = Target { u: outline.u, v: outline.v, major: 2.0 * a, minor: 2.0 * b, angle, ..target.clone() };
    target.contrast = contrast(&part.plane(), &target);
    target
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

/// Light of a level by the curve that cameras follow about.
fn screen<T: Sample>(level: f64) -> f64 {
    (level / f64::from(T::MAX)).max(0.0).powf(TONE)
}

/// The same where a camera's curve may have bent the levels; `None` if the target is too large for a difference.
pub(super) fn of_screen<T: Sample>(plane: &SampleView<T>, target: &Target, blur: f64) -> Option<(Window<u16>, Target)> {
    (target.minor <= TONE_SMALL).then(|| of(plane, target, blur, screen::<T>)).flatten()
}

/// The same with outline and blur from the edges that the dot has in light: what a sharpening after the curve does to them no curve tells.
/// `None` if there are none.
pub(super) fn measured<T: Sample>(plane: &SampleView<T>, target: &Target) -> Option<(Window<u16>, Target)> {
    let part = part_of(plane, target, screen::<T>);
    let outline = outline_of(target);
    let start = Outline { u: outline.u - part.left as f64, v: outline.v - part.top as f64, ..outline };
    let options = DetectOptions { min_diameter: 1.0, max_diameter: WHITE, ..DetectOptions::default() };
    let mut measure = Measure::new(part.plane(), noise::levels(&part.plane()), &options);
    let found = measure.confirm(&start, target.polarity == Polarity::Bright).ok()?;
    let mut target = in_part(&part, target, found.ellipse.outline);
    target.quality.edge_width = found.blur;
    Some((part, target))
}
