//! Texts of what stands beside the path: the comparison with the result before, equipment that outlives a project, work that lasts.

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
}}

declare! { equipment {
    equipment: "Equipment";
    equipment_words: "Calibrated cameras and certified scale bars, kept on this computer and in a file, offered where photos show them.";
    sentence(cameras, calibrations, bars):
        "{cameras} {cameras:camera|cameras} with {calibrations} {calibrations:calibration|calibrations}, {bars} scale {bars:bar|bars}.";
    import_file: "Import a file";
    export_file: "Save as a file";
    kept_cameras: "Cameras";
    kept_bars: "Scale bars";
    no_cameras: "No camera is kept yet. After an adjustment that estimates a camera, keep its calibration below.";
    no_bars: "No scale bar is kept yet. Type what its certificate says: where both ends are coded and seen in two photos, the bar gives its distance by itself.";
    of_this_result: "Of the present result";
    keep_calibration: "Keep this calibration";
    calibration_kept(camera): "The calibration of {camera} is kept on this computer.";
    calibrated_on(date): "calibrated on {date}";
    remove_camera(camera): "Remove the camera {camera}";
    remove_calibration(date): "Remove the calibration of {date}";
    remove_bar(bar): "Remove the scale bar {bar}";
    removed: "Removed from what is kept.";
    put_back: "Put back";
    bar_name: "Name";
    certificate: "Certificate";
    date: "Date";
    date_hint: "2026-05-01";
    keep_bar: "Keep the bar";
    not_kept: "The equipment could not be written to this browser's storage: save it as a file.";
    imported(file, cameras, calibrations, bars):
        "{file}: {cameras} new {cameras:camera|cameras}, {calibrations} {calibrations:calibration|calibrations}, {bars} scale {bars:bar|bars} taken in.";
    known_camera(name, date): "Known camera: {name}, calibrated on {date}. Take it";
    held: "held";
    held_means: "Every parameter stays as it was calibrated.";
    observed: "observed";
    observed_means: "Every parameter is observed with the standard error of its calibration.";
    free: "free";
    free_means: "Every parameter begins as it was calibrated and is estimated.";
    bars_seen(bars): "Scale bars seen in the photos: {bars}.";
    take_bars: "Take their distances";
    bars_taken(bars): "Scale bars seen in the photos gave their distances: {bars}.";
    with_colours(colours): "with differences for {colours}";
    change_calibration(camera): "calibration of {camera} taken";
    change_bars(n): "{n} {n:distance|distances} from scale bars";
}}

declare! { lasting {
    photo: "A photo is being read";
    pixels: "The samples of a photo are being read";
    target: "A target is being measured";
    colours: "The colours of a photo are being measured";
    lens_colours: "What a lens changes for red and blue is being computed";
    situation: "Photos are being oriented, to show where points should be";
    features: "Forms and systems are being measured";
    report: "The report is being made";
    report_stopped: "The report was stopped. It is made again after the next change.";
    plots: "Plots are being drawn";
    comparison: "The results are being compared";
    sheets: "Targets are being drawn";
    file: "A file is being written";
    plan: "The plan is being computed";
}}
