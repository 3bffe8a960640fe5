//! Texts of targets and their detection.

use super::{English, choose};
use crate::i18n::declare;

declare! { targets {
    // Targets
    targets: "Targets";
    target: "Target";
    targets_none_yet: "Bright and dark circular targets are detected and measured; targets with ring codes are named automatically.";
    targets_sentence(targets, coded, photos):
        "{targets} {targets:target|targets} in {photos} {photos:photo|photos}, {coded} of them coded.";
    targets_coded(targets, coded): "{targets} {targets:target|targets}, {coded} coded";
    detect: "Detect targets";
    detect_again: "Detect again";
    detecting: "Detecting";
    polarity: "targets";
    polarity_both: "bright and dark";
    polarity_bright: "bright on dark";
    polarity_dark: "dark on bright";
    channel: "channel";
    channel_grey: "grey";
    channel_red: "red";
    channel_green: "green";
    channel_blue: "blue";
    codes: "ring codes";
    codes_auto: "automatic";
    codes_none: "none";
    codes_of(family): "Codes: {family}.";
    codes_of_several: "The rings fit codes of several families. Choose the family.";
    codes_different: "The rings do not belong to one code family, so none was named. Choose the family under ring codes.";
    code_candidates: "code unclear, candidates";
    method: "method";
    method_least_squares: "least squares";
    method_ellipse: "ellipse on edges";
    method_intensity: "intensity centroid";
    method_gradient: "gradient centroid";
    diameter: "diameter";
    diameter_from: "smallest diameter in pixels";
    diameter_to: "largest diameter in pixels";
    steepest: "steepest view";
    steepest_view: "largest angle between the line of sight and a target's normal, in degrees";
    no_steepest(typed): "\"{typed}\" is not a viewing angle: type degrees from 0 to 81.";
    click_a_target: "Click a target in the photo to see its centre and σ.";
    full_axes: "full axes";
    rotation: "rotation";
    contrast: "contrast";
    edge_width: "edge width";
    code_not_read: "code not read";
    code_all_set: "the ring has no gap";
    code_no_code: "its bits are not a code of the family";
    code_disturbed: "something is next to the ring or on it";
    code_between_levels: "a sector is neither bright nor dark";
    code_other_family: "its sectors may belong to another family, or be dots around it";
    code_uncertain: "its ring may resemble a code by chance: it is small, blurred or a single arc";
    code_several_families: "its code exists in several families";
    code_unread: "two or more ellipses lie where a ring has its sectors; they do not count as targets";
    inner_rim: "inner edge, distance of the centres";
    inner_rim_centred: "the centres agree";
    inner_rim_off: "the centres differ by more than their standard errors; the outer edge is used";
    picture_sharpened(percent, radius): "sharpened by {percent} % (radius {radius} px), reversed where it hides targets";
    picture_overexposed(percent): "{percent} % saturated, excluded from the fits";
    picture_black(percent): "{percent} % black, without detections";
    picture_compressed(percent): "JPEG compression is visible (block borders {percent} % stronger) and counts as noise";
    picture_compressed_uncounted(percent):
        "JPEG compression is visible (block borders {percent} % stronger); with this method the standard errors ignore it and are too small (use least squares)";
    picture_noise(noise): "noise {noise} grey levels, used for the standard errors";
    picture_shared_noise(noise, factor):
        "noise {noise} grey levels, correlated between neighbouring pixels, which makes the standard errors {factor} times as large";
    picture_sentence(what): "This photo: {what}.";
    measured_on_sites(format, colour, pattern, bits):
        "{format}, {bits} bits: measured on the sensor's own {colour} pixels ({pattern}), without interpolation.";
    measured_between_sites(format, colour, pattern, bits):
        "{format}, {bits} bits: measured on an image interpolated between the {colour} pixels ({pattern}), as this method requires.";
    measured_noise(read, gain): "Noise estimated from the photo: {read} without light; the variance grows by {gain} per unit of light.";
    measured_light_noise(gain): "Noise estimated from the photo: the variance grows by {gain} per unit of light; the noise without light cannot be estimated from this photo.";
    measured_read_noise(read): "Noise estimated from the photo: {read} at every brightness.";
    measured_overexposed(percent): "{percent} % saturated, excluded from the fits.";
    measured_hot(count): "{count} hot pixels excluded.";
    measured_corrections(names):
        "The file lists lens corrections ({names}). None is applied here: a camera calibrated with corrected images is a different camera.";
    unread_corrections: "A list of lens corrections in the file cannot be read. None of them is applied.";
    corrections_made(names):
        "According to the camera's metadata it corrected: {names}. The distortion is what this correction left over, not that of the lens, and changes with zoom and focus: calibrate and measure with the same setting.";
    corrections_without_distortion(names): "According to the camera's metadata it corrected: {names}. Distortion was not corrected.";
    corrections_of_developed(names):
        "The camera's metadata requests corrections of images developed from this file: {names}. None is applied here: a camera calibrated with corrected images is a different camera.";
    corrections_off(names): "According to the metadata not corrected: {names}.";
    correction_of(what, tag): "{what} ({tag})";
    correction_auto(what, tag): "{what}, if the lens is known ({tag})";
    aberration_distortion: "distortion";
    aberration_lateral_colour: "lateral colour";
    aberration_vignetting: "vignetting";
    aberration_diffraction: "diffraction";
    site_red: "red";
    site_green: "green";
    site_blue: "blue";
    site_cyan: "cyan";
    site_magenta: "magenta";
    site_yellow: "yellow";
    site_white: "unfiltered";
    site_emerald: "emerald";
    colours_apart: "Lateral colour";
    colours_apart_hint: "A lens images red and blue slightly larger or smaller than green. Targets measured in all three channels show the difference.";
    measure_colours: "Measure red and blue";
    measuring_colours: "Measuring red and blue…";
    apart_radius_px: "radius, px";
    apart_targets: "targets";
    apart_shift_means: "Shift relative to green in px, positive outwards, with its standard error.";
    apart_negligible: "The shift is negligible: at no radius does it exceed both three standard errors and 0.02 px. Nothing needs to be done.";
    apart_in_green: "This photo was measured in green, so its coordinates are free of this shift. Measure all photos of the camera in green.";
    apart_measure_green: "Image coordinates are not corrected for this shift. Set the channel to green and measure all photos of the camera again, so that one interior orientation describes them.";
    apart_too_few(colour, count): "{colour}: {count} targets in both channels are too few for an estimate";
    apart_outwards: "px outwards";
    apart_radius(pixels): "radius up to {pixels} px";
    rejected_here: "Rejected in this photo";
    reason_too_small: "too small";
    reason_too_large: "too large";
    reason_not_an_ellipse: "not an ellipse";
    reason_too_flat: "too flat";
    reason_low_contrast: "low contrast";
    reason_touching: "touching another feature";
    reason_saturated: "saturated";
    reason_at_border: "at the border";
    reason_occluded: "occluded";
    occluded_share(share): "{share} % of its rim: measured by the rest, and used only if you name it";
    occluded_here(n): "{n} partly occluded {n:target is|targets are} drawn dashed and used only if you name {n:it|them}.";
    reason_code_ring: "part of a code ring";
    reason_no_fit: "no fit";
} }
