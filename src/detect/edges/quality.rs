//! Is what was measured a target? The tests after the measurement.
//!
//! Three numbers separate circular targets from letters, corners and texture that happen to carry an ellipse: the rms of
//! the edge points from the ellipse, against what noise alone would do to them; the part of the residuals of the rendered
//! fit that noise does not explain and that differs around the rim, as a share of the contrast (a lens does the same all
//! around); and the longest gap in the outline. A gap is believed to be something in front of a target only when the rest is
//! as good as noise allows, since the bowl of a letter is an ellipse with a gap too.

use super::through::EllipseFit;
use crate::detect::picture::noise::Levels;

/// Largest share of the outline that may be missing in one piece without further demands.
pub(crate) const SMALL_GAP: f64 = 0.1;
/// Largest share of the outline that may be missing at all.
pub(crate) const HIDDEN: f64 = 0.42;
/// Contrast, in standard deviations of the noise, below which noise hides what tells a letter's inside from an ellipse.
pub(crate) const FAINT: f64 = 25.0;
/// Smallest contrast, in standard deviations of the noise, times the minor axis in pixels: what is smaller or fainter has
/// too few pixels that differ from the inside of a letter.
const SHAPELY: f64 = 100.0;
/// Smallest minor axis, in pixels, of a target with a gap.
pub(crate) const GAP_MINOR: f64 = 12.0;
/// Largest unexplained share of the contrast of a target with a gap.
const GAP_MISFIT: f64 = 0.024;

/// Largest unexplained share of the contrast where edges are stairs.
const STAIRS: f64 = 0.2;

/// What noise n does to the steepest place of an edge of contrast C and blur s, in units of n / C: some 1.7, and as much more as
/// leaves room for other profiles. With the blur the fall over two pixels bends less: its steepest place moves by sqrt(6) n over
/// twice its second derivative, 0.8 C / s³, some 1.2 s³ n / C where samples are drawn from four pixels. Out of focus it is about
/// 4 s n / C ([`search_wide`](super::edge::search_wide)).
pub(crate) fn steepest(blur: f64) -> f64 {
    (1.2 * blur.powi(3)).min(4.0 * blur).max(2.8)
}

/// The same of an edge to whose whole profile the shift is fitted ([`refine`](super::edge::refine)): sqrt(2 sqrt(π) s).
pub(crate) fn fitted(blur: f64) -> f64 {
    (1.9 * blur.sqrt()).max(2.8)
}

/// Largest rms distance of edge points from a good outline of semi-minor axis b, in pixels, where noise n moves an edge of contrast
/// C by `spread` n / C. Printing, compression and the picture's grid add up to 1 % of the diameter.
pub(crate) fn expected_scatter(b: f64, levels: &Levels, noise: f64, contrast: f64, spread: f64) -> f64 {
    spread * noise / contrast.max(1e-9) + 0.02 * b + levels.jag()
}

/// Rms of the edge points relative to that: below 1 for a good outline.
fn edge_ratio(ellipse: &EllipseFit, levels: &Levels, noise: f64, contrast: f64, spread: f64) -> f64 {
    ellipse.rms / expected_scatter(ellipse.outline.semi_axes().1, levels, noise, contrast, spread)
}

/// Longest gap; many small ones count as a larger one.
fn gap(ellipse: &EllipseFit) -> f64 {
    ellipse.gap.max(0.6 * ellipse.occluded)
}

/// Whether the outline is large enough for the gap that it has.
pub(crate) fn size_allows(ellipse: &EllipseFit) -> bool {
    gap(ellipse) <= SMALL_GAP || 2.0 * ellipse.outline.semi_axes().1 >= GAP_MINOR
}

/// Whether that may still come true of a first outline from few rays.
pub(crate) fn size_may_allow(ellipse: &EllipseFit) -> bool {
    gap(ellipse) <= 2.0 * SMALL_GAP || 2.0 * ellipse.outline.semi_axes().1 >= 0.9 * GAP_MINOR
}

/// Whether noise leaves enough of the shape to tell a target by.
pub(crate) fn has_shape(ellipse: &EllipseFit, noise: f64, contrast: f64) -> bool {
    contrast * 2.0 * ellipse.outline.semi_axes().1 > SHAPELY * noise
}

/// Whether the outline alone still allows a target.
pub(crate) fn outline_allows(ellipse: &EllipseFit, levels: &Levels, noise: f64, contrast: f64, spread: f64) -> bool {
    let gap_allows = gap(ellipse) <= SMALL_GAP || contrast > 20.0 * noise;
    size_allows(ellipse) && gap_allows && edge_ratio(ellipse, levels, noise, contrast, spread) < 1.1
}

/// Whether outline and fit together are those of a target; `uneven` is the fit's residual less its mean profile.
pub(crate) fn is_target(
    ellipse: &EllipseFit,
    levels: &Levels,
    uneven: f64,
    noise: f64,
    contrast: f64,
    spread: f64,
) -> bool {
    let minor = 2.0 * ellipse.outline.semi_axes().1;
    let misfit = (uneven * uneven - noise * noise).max(0.0).sqrt() / contrast;
    // large targets show every departure of the printed shape and of the lens; on faint ones noise hides both
    let limit = (0.045 + 0.006 * (minor - 10.0)).clamp(0.045, 0.12) * (contrast / (40.0 * noise)).clamp(0.4, 1.0);
    let limit = if levels.stairs { STAIRS } else { limit };
    let edge = edge_ratio(ellipse, levels, noise, contrast, spread);
    edge * edge + (misfit / limit).powi(2) < 1.15 && (gap(ellipse) <= SMALL_GAP || misfit < GAP_MISFIT)
}
