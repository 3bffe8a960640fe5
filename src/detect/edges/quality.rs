//! Tests of a measured target.
//!
//! Three numbers separate circular targets from letters, corners and texture that happen to carry an ellipse: the rms of
//! the edge points from the ellipse, against what noise alone would do to them; the part of the residuals of the rendered
//! fit that noise does not explain and that differs around the rim, as a share of the contrast (a lens does the same all
//! around); and the longest gap in the outline. What has a gap is measured by nothing but its edges ([`occlusion`](crate::detect::occlusion)):
//! the bowl of a letter is an ellipse with a gap, too.

use super::ellipse_fit::EllipseFit;
use crate::detect::acceptance::levels::SHAPELY;
use crate::detect::acceptance::{fit, outline as limits};
use crate::detect::picture::noise::GreyStatistics;

/// Scatter of the steepest place of an edge of contrast C and blur s by noise n, in units of n / C. With the blur the fall over two
/// pixels bends less; out of focus it is searched between means ([`search_wide`](super::edge::search_wide)).
pub(crate) fn steepest(blur: f64) -> f64 {
    (limits::SPREAD_CUBE * blur.powi(3)).min(limits::SPREAD_WIDE * blur).max(limits::SPREAD)
}

/// The same of an edge to whose whole profile the shift is fitted ([`refine`](super::edge::refine)).
pub(crate) fn fitted(blur: f64) -> f64 {
    (limits::SPREAD_FITTED * blur.sqrt()).max(limits::SPREAD)
}

/// Largest rms distance of edge points from a good outline of semi-minor axis b, in pixels, where noise n moves an edge of contrast
/// C by `spread` n / C.
pub(crate) fn expected_scatter(b: f64, levels: &GreyStatistics, noise: f64, contrast: f64, spread: f64) -> f64 {
    spread * noise / contrast.max(1e-9) + limits::SHAPE * b + levels.jag()
}

/// Rms of the edge points relative to that: below 1 for a good outline.
fn edge_ratio(ellipse: &EllipseFit, levels: &GreyStatistics, noise: f64, contrast: f64, spread: f64) -> f64 {
    ellipse.rms / expected_scatter(ellipse.outline.semi_axes().1, levels, noise, contrast, spread)
}

/// Longest gap; many small ones count as a larger one.
fn gap(ellipse: &EllipseFit) -> f64 {
    ellipse.gap.max(limits::SCATTERED * ellipse.occluded)
}

/// Whether nearly all of the outline is seen.
pub(crate) fn is_whole(ellipse: &EllipseFit) -> bool {
    gap(ellipse) <= limits::SMALL_GAP
}

/// Whether that may still come true of a first outline from few rays.
pub(crate) fn may_be_whole(ellipse: &EllipseFit) -> bool {
    gap(ellipse) <= limits::GAP_FIRST * limits::SMALL_GAP
}

/// Whether noise leaves enough of the shape to tell a target by.
pub(crate) fn has_shape(ellipse: &EllipseFit, noise: f64, contrast: f64) -> bool {
    contrast * 2.0 * ellipse.outline.semi_axes().1 > SHAPELY * noise
}

/// Whether the outline alone still allows a target.
pub(crate) fn outline_allows(
    ellipse: &EllipseFit,
    levels: &GreyStatistics,
    noise: f64,
    contrast: f64,
    spread: f64,
) -> bool {
    is_whole(ellipse) && edge_ratio(ellipse, levels, noise, contrast, spread) < limits::SCATTER
}

/// Whether outline and fit together are those of a target; `uneven` is the fit's residual less its mean profile.
pub(crate) fn is_target(
    ellipse: &EllipseFit,
    levels: &GreyStatistics,
    uneven: f64,
    noise: f64,
    contrast: f64,
    spread: f64,
) -> bool {
    let minor = 2.0 * ellipse.outline.semi_axes().1;
    let misfit = (uneven * uneven - noise * noise).max(0.0).sqrt() / contrast;
    let [least, growth, most] = fit::MISFIT;
    let limit = (least + growth * (minor - fit::MISFIT_MINOR)).clamp(least, most)
        * (contrast / (fit::MISFIT_FAINT * noise)).min(1.0);
    let limit = if levels.stairs { fit::MISFIT_STAIRS } else { limit };
    let edge = edge_ratio(ellipse, levels, noise, contrast, spread);
    edge * edge + (misfit / limit).powi(2) < fit::TOGETHER
}
