//! Texts of the comparison of two results.

use super::{English, choose};
use crate::i18n::declare;

declare! { comparing {
    beside_before: "Compared with the previous result";
    figures(before, after, redundancy_before, redundancy_after):
        "σ₀ was {before} and is now {after}; the redundancy was {redundancy_before} and is now {redundancy_after}.";
    moved_by(n, rms, unit, beyond, limit):
        "{n} common {n:point|points} moved by {rms} {unit} (rms), {beyond} of them by more than {limit} standard errors.";
    same_system: "Both results are in the system of the same control points.";
    fitted(points, scale):
        "The two results have different coordinate systems. The previous one was transformed to this one by {points} common points that agree (scale {scale}). A movement of the whole network cannot be detected.";
    fitted_rigidly(points):
        "The two results have different coordinate systems. The previous one was transformed to this one by {points} common points that agree, without scale, since both have their own. A movement of the whole network cannot be detected.";
    unlike(common, agreeing):
        "Coordinates are not compared: no similarity transformation fits the two networks. {agreeing} of {common} common {common:point|points} {agreeing:agrees|agree} within the standard errors, too few to find what moved. Check whether points were renamed.";
    unlike_mirrored(common, agreeing):
        "Coordinates are not compared: one network is the mirror image of the other. Unmirrored, {agreeing} of {common} common {common:point|points} {agreeing:agrees|agree} within the standard errors. Check whether an axis of the control points was exchanged or its sign changed.";
    unlike_scale(common, agreeing, scale):
        "Coordinates are not compared: the networks fit only with the earlier lengths times {scale}, although both have their own scale. Unscaled, {agreeing} of {common} common {common:point|points} {agreeing:agrees|agree} within the standard errors. Check whether a distance or its unit changed.";
    apart(common):
        "Coordinates are not compared: the two results have {common} common {common:point|points}, too few or on one line for a transformation.";
    other_units(before, after): "Coordinates are not compared: lengths were in {before} and are in {after}.";
    ratios_independent: "The two results share no observations, so variances add. “× σ” is from a vector test with the covariance of the point, scaled to the limit of a single test.";
    ratios_union: "Standard errors are those of the difference, computed from the observations of both results; shared observations cancel. “× σ” is from a vector test, scaled to the limit of a single test.";
    ratios_mean: "Standard errors are the larger of the two results; “× σ” is the largest of the three axes.";
    gone(n, points): "No longer in this result, {n}: {points}.";
    only_now(n, points): "New in this result, {n}: {points}.";
    unlike_cameras(cameras): "Cameras not compared, since their model or the unit of photo coordinates changed: {cameras}.";
    projection_centres: "Projection centres";
    largest_sigma: "σ";
    times_sigma: "× σ";
    before: "before";
    after: "now";
    cancelled_result_kept: "Cancelled. The previous result is unchanged.";
    cancelled_result_old: "Cancelled. The last result is kept; it belongs to an earlier state of the project.";
    cancelled_no_result: "Cancelled. There is no result yet.";
    residuals_by_photo: "Residuals by photo";
} }
