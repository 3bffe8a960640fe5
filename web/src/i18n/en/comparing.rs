//! Texts of the comparison of two results.

use super::{English, choose};
use crate::i18n::declare;

declare! { comparing {
    beside_before: "Beside the result before";
    figures(before, after, redundancy_before, redundancy_after):
        "σ₀ was {before} and is {after}; the redundancy was {redundancy_before} and is {redundancy_after}.";
    moved_by(n, rms, unit, beyond, limit):
        "{n} {n:point|points} in both moved by {rms} {unit} (rms), {beyond} of them by more than {limit} standard errors.";
    same_system: "Both results are in the system of the same control points.";
    fitted(points, scale):
        "Each result is in a system of its own: the one before was laid upon this one by the {points} common points that agree, with the scale {scale}. A movement of the whole is not seen.";
    fitted_rigidly(points):
        "Each result is in a system of its own: the one before was laid upon this one by the {points} common points that agree, without a scale, since both have their own. A movement of the whole is not seen.";
    unlike(common, agreeing):
        "Coordinates are not compared: no similarity lays one network upon the other. Of {common} common {common:point|points} {agreeing} {agreeing:agrees|agree} within the standard errors: too few to tell by them what moved. Were points given other names?";
    unlike_mirrored(common, agreeing):
        "Coordinates are not compared: one network is the mirror image of the other. As they are, {agreeing} of {common} common {common:point|points} {agreeing:agrees|agree} within the standard errors. Was an axis of the control points exchanged or its sign changed?";
    unlike_scale(common, agreeing, scale):
        "Coordinates are not compared: the networks fit with the lengths of the earlier one times {scale}, though both have a scale of their own. As they are, {agreeing} of {common} common {common:point|points} {agreeing:agrees|agree} within the standard errors. Is a distance another one, or its unit?";
    apart(common):
        "Coordinates are not compared: the two results have {common} common {common:point|points}, too few or on a line to lay one upon the other.";
    other_units(before, after): "Coordinates are not compared: lengths were in {before} and are in {after}.";
    ratios_independent: "The two results share no observation: variances add up, and “× σ” is that of a vector test with the covariance of the point, on the limit of a single test.";
    ratios_mean: "Standard errors are the larger ones of both results; “× σ” is the largest on any axis.";
    gone(n, points): "Not in this result any more, {n}: {points}.";
    only_now(n, points): "New in this result, {n}: {points}.";
    unlike_cameras(cameras): "Not compared, since their model or the unit of their photo coordinates changed: {cameras}.";
    projection_centres: "Projection centres";
    largest_sigma: "σ";
    times_sigma: "× σ";
    before: "before";
    after: "now";
    cancelled_result_kept: "Cancelled. The result from before stays as it was.";
    cancelled_result_old: "Cancelled. The last result is kept; it is of the project as it was then.";
    cancelled_no_result: "Cancelled. There is no result yet.";
    residuals_by_photo: "Residuals by photo";
} }
