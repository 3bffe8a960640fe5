//! Texts of the first hour: the start page, the menu of files, pages with nothing on them yet, verdicts.

use super::{English, choose};
use crate::i18n::declare;

declare! { first {
    purpose: "Measure 3-D coordinates from photos, with their standard errors";
    drop_photos: "Drop photos anywhere on this page to start a project, or open a project file. Nothing leaves this computer.";
    picture: "Photos of targets from several places give the targets' coordinates and the camera positions";
    new_project: "New project";
    project: "Project";
    file: "File";
    without_photos: "Start without photos";
    papers: "Examples from published papers";
    no_photos: "No photos yet";
    drop_here: "Drop the photos of one object anywhere on this page, or choose them. The best result needs photos from at least three places, some with the camera rotated by 90°.";
    detection_options: "Detection options";
    placing_on: "Placing freely: each click places the point where you click. Esc ends.";
    no_codes(targets): "No point has a name: no codes were found in {targets} {targets:target|targets}. Click a target to name it by hand in three or more photos. After orientation, “Match” names the others.";
    no_targets: "No targets yet. Detect targets in the photos first.";
    no_observations: "Nothing to adjust yet: no target has a point name in two or more photos.";
    name_points: "Name points";
    verdict_passed(sigma0): "The residuals agree with the standard errors (σ₀ {sigma0}). Next: look at the warnings, then write the report.";
    verdict_contradicted(cause): "The photos agree with each other, but not with the given values: {cause}.";
    cause_given(kind, name): "{kind} {name} does not fit";
    verdict_failed(sigma0, cause): "Global test failed: residuals are {sigma0} times as large as the standard errors predict. Most likely cause: {cause}.";
    verdict_too_large(sigma0): "Global test failed: residuals are only {sigma0} times as large as the standard errors predict. The standard errors are too large: enter smaller ones or estimate them from the residuals.";
    verdict_estimated: "Standard errors were estimated from the residuals, so no global test checks them. Next: look at the warnings, then write the report.";
    verdict_no_redundancy: "This result cannot be checked: there are as many unknowns as observations. Measure more points in more photos, or add control points.";
    verdict: "Verdict";
    figures: "Figures of the result";
    control_point: "control point";
    cause_gross_errors(n, point, photo): "{n} {n:observation|observations} with a gross error, the largest of point {point} in photo {photo}";
    cause_model(camera): "the distortion of camera {camera} is neither known nor estimated";
    cause_image_sigma: "image coordinates are less accurate than their standard errors";
    look_at_it: "Show it";
    estimate_distortion: "Choose parameters";
    change_weights: "Change weights";
    warnings(n): "{n} {n:warning|warnings}";
    photos_not_oriented(n, photos): "{n} photos could not be oriented: {photos}";
    points_not_determined(n, points): "{n} points have no coordinates: {points}";
    insignificant(names, camera): "{names} of camera {camera}: not significantly different from 0";
    insignificant_body(name): "They are correlated: hold {name} first and adjust again. Photos rotated by 90° and from different distances determine them.";
    correlations(n, camera): "{n} pairs of parameters of camera {camera} are strongly correlated";
    correlations_body(pairs): "{pairs}. Coordinates are hardly affected. Photos rotated by 90° and from different distances separate them.";
    match_targets: "Match";
    match_how: "Names targets by their predicted positions in the oriented photos, adjusts, and repeats until nothing is added";
    matched_all(found, doubtful, rounds): "{found} {found:observation|observations} matched in {rounds} {rounds:round|rounds} and adjusted. {doubtful} {doubtful:target|targets} remain doubtful and unnamed.";
    match_nothing(doubtful): "Nothing to match: every target that can be named has a name. {doubtful} {doubtful:target is|targets are} doubtful.";
    match_stopped(rounds): "Stopped after {rounds} rounds while matching still added observations. Check the newest points before you use the result.";
}}
