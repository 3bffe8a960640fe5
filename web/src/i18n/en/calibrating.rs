//! Texts of calibrating a camera: its path, what photos cover, parts of the photos against each other.

use super::{English, choose};
use crate::i18n::declare;

declare! { calibrating {
    calibration: "Calibration";
    calibrate: "Calibrate a camera";
    calibrate_words: "A board of circles or a printed sheet in photos: interior orientation with its uncertainty, files for other programs";
    sentence(photos, measurements): "{photos} {photos:photo|photos}, {measurements} {measurements:measurement|measurements}.";
    nothing_yet: "From a board or a sheet to a camera file, in four steps.";
    object: "1 Board or sheet";
    object_words: "A board of circles (any size, symmetric or asymmetric), or a printed sheet of codes and dots with its list of coordinates. It must be flat and fill the image in some of the photos.";
    print: "Print a sheet";
    load_control: "Load its control.csv";
    name_dots: "Name the dots of a board";
    photos: "2 Photos";
    photos_words: "Focus and zoom fixed. From several sides, some tilted by 30 to 45°, some rotated by 90°; the board should also reach the corners of the image.";
    detect: "Find targets";
    covering: "computing the coverage";
    covered: "Coverage";
    by_radius: "Targets by distance from the image centre";
    by_roll: "Photos by rotation about the camera axis";
    by_tilt: "Photos by tilt to the board";
    not_oriented: "Rotations and tilts are known after the adjustment.";
    reach(percent): "The outermost target is at {percent} % of the distance from the centre to the corner.";
    covers_all: "Nothing is missing.";
    lack_photos(n): "Only {n} {n:photo|photos} with measurements: take at least 8.";
    lack_radius: "No targets towards the corners: distortion there is extrapolated. Take photos with the board in the corners.";
    lack_cells: "Parts of the image have no targets: take photos that fill them.";
    lack_roll: "No photo is rotated by 90°: such photos determine the principal point and decentring. Rotate the camera for a few photos.";
    lack_tilt: "All photos look straight at the board: the principal distance cannot be separated from the distance to the board. Tilt some by 30 to 45°.";
    result: "3 Result";
    to_adjustment: "Adjustment and parameters";
    to_results: "Results";
    files: "4 Files";
    files_words: "OpenCV, ROS, Kalibr, mrcal, COLMAP, Metashape, MicMac; the remaining difference of each conversion is shown.";
    to_files: "Files for other programs";
    cross: "Cross-validate";
    cross_why: "Calibrates the camera from each half of the photos and compares the halves with what their standard errors allow.";
    crossing: "calibrating each half of the photos";
    agrees(ratio, limit): "The halves agree: they differ by at most {ratio} times their standard error (limit {limit}).";
    larger_noise(ratio, limit): "The halves differ by up to {ratio} times their standard error (limit {limit}), but no more than the residuals explain: the standard errors of the image coordinates are too small.";
    wrong_model(ratio, limit): "The halves differ by up to {ratio} times their standard error (limit {limit}): the camera model is wrong, or the camera or the object changed between the photos.";
    predicted: "Predicted";
    observed: "Observed";
    map_words: "Difference of the halves in pixels over the image: predicted from their standard errors, and observed, on the same colour scale. Hatched: no target nearby.";
    up_to(px): "≤ {px} px";
    beyond(px): "> {px} px";
    worst(u, v): "Largest at {u}, {v} px.";
    proposed(degrees, models): "The focal length gives {degrees}° across the diagonal: such lenses usually need {models}. The model is not changed automatically; compare the models when the photos are measured.";
    propose_use(model): "Use {model}";
} }
