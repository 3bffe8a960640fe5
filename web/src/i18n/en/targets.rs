//! Texts of targets and their detection.

use super::{English, choose};
use crate::i18n::declare;

declare! { targets {
    // Targets
    targets: "Targets";
    target: "Target";
    targets_none_yet: "Bright and dark circular targets are found, measured and, where they carry a ring code, named.";
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
    codes_of_several: "The rings can be read as codes of several families. Which are they?";
    codes_different: "The rings are not all codes of one family, and none was named: choose the family under ring codes.";
    code_candidates: "code unclear, perhaps";
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
    no_steepest(typed): "\"{typed}\" is no angle of a view: type degrees from 0 to 81.";
    click_a_target: "Click a target in the photo to see its centre and sigma.";
    full_axes: "full axes";
    rotation: "rotation";
    contrast: "contrast";
    edge_width: "edge width";
    code_not_read: "code not read";
    code_all_set: "the ring is set all around";
    code_no_code: "its bits are no code of the family";
    code_disturbed: "something lies beside the ring or on it";
    code_between_levels: "a sector lies between light and dark";
    code_other_family: "its sectors may be those of another family, or dots around it";
    code_uncertain: "its ring may look like a code by chance: it is small, blurred or a single arc";
    code_several_families: "it is a code of several families";
    code_unread: "two or more ellipses stand where a ring has its sectors; they are no targets";
    inner_rim: "inner rim, distance of the centres";
    inner_rim_centred: "the centres agree";
    inner_rim_off: "the centres differ by more than their standard errors; the outer rim counts";
    picture_sharpened(percent, radius): "sharpened by {percent} % (radius {radius} px), undone where that hides targets";
    picture_overexposed(percent): "{percent} % over-exposed, left out of the fits";
    picture_black(percent): "{percent} % without light, where nothing shows";
    picture_compressed(percent): "JPEG compression is visible (block borders {percent} % stronger) and counts as noise";
    picture_compressed_uncounted(percent):
        "JPEG compression is visible (block borders {percent} % stronger), which the standard errors of this method do not count: they are too small (measure with least squares)";
    picture_noise(noise): "noise {noise} grey levels, from which the standard errors follow";
    picture_shared_noise(noise, factor):
        "noise {noise} grey levels, shared by neighbouring pixels, which makes the standard errors {factor} times as large";
    picture_sentence(what): "This photo: {what}.";
    measured_on_sites(format, colour, pattern, bits):
        "{format}, {bits} bits: measured on the sensor's own {colour} sites ({pattern}), each by itself.";
    measured_between_sites(format, colour, pattern, bits):
        "{format}, {bits} bits: measured in a picture between the {colour} sites ({pattern}), as this method needs one.";
    measured_noise(read, gain): "Noise estimated from the photo: {read} without light, its variance growing by {gain} per unit of light.";
    measured_light_noise(gain): "Noise estimated from the photo: its variance grows by {gain} per unit of light; without light it cannot be seen here.";
    measured_read_noise(read): "Noise estimated from the photo: {read} in every light.";
    measured_overexposed(percent): "{percent} % over-exposed, left out of the fits.";
    measured_hot(count): "{count} hot sites left out.";
    measured_corrections(names):
        "The file names corrections of its lens ({names}). None was made here: a camera calibrated in corrected pictures is another camera.";
    unread_corrections: "A list of corrections of the lens in the file cannot be read: what it names is not known, and nothing of it was made.";
    corrections_made(names):
        "The camera's note says that it corrected: {names}. Its distortion is what the correction left, not the lens's: calibrate and measure with the same setting; it changes with zoom and focus.";
    corrections_without_distortion(names): "The camera's note says that it corrected: {names}. Distortion is not among them.";
    corrections_of_developed(names):
        "The camera's note asks for corrections of pictures developed from this file: {names}. None was made here: a camera calibrated in corrected pictures is another camera.";
    corrections_off(names): "It says that it left uncorrected: {names}.";
    correction_of(what, tag): "{what} ({tag})";
    correction_auto(what, tag): "{what}, where it knows the lens ({tag})";
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
    colours_apart: "Colours apart";
    colours_apart_hint: "A lens images red and blue a little larger or smaller than green. Measured in all three, the targets show how much.";
    measure_colours: "Measure red and blue";
    measuring_colours: "Measuring red and blue…";
    hold_colours: "Hold in the camera";
    hold_colours_again: "Hold these instead";
    forget_colours: "Add nothing for other colours";
    lens_colour: "colour";
    colour_difference: "difference";
    colours_hold_means(camera): "Camera {camera} can hold these differences: they are added to its parameters, and held, for photos measured in red or blue.";
    colours_are_held(camera): "Camera {camera} holds differences for other colours: they are added to its parameters, and held, for photos measured in red or blue.";
    apart_at_corner(colour, pixels, sigma, count): "{colour}: {pixels} px against green at the corner (standard error {sigma} px), from {count} targets";
    apart_too_few(colour, count): "{colour}: {count} targets in both colours are too few to tell";
    apart_outwards: "px outwards";
    apart_radius(pixels): "radius up to {pixels} px";
    rejected_here: "Rejected in this photo";
    reason_too_small: "too small";
    reason_too_large: "too large";
    reason_not_an_ellipse: "not an ellipse";
    reason_too_flat: "too flat";
    reason_low_contrast: "low contrast";
    reason_touching: "touching another";
    reason_saturated: "saturated";
    reason_at_border: "at the border";
    reason_occluded: "hidden";
    reason_code_ring: "part of a code ring";
    reason_no_fit: "no fit";
} }
