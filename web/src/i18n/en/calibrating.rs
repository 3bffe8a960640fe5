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
    object_words: "A board of circles (any size, symmetric or asymmetric), or a printed sheet of codes and dots with its list of coordinates. Either lies flat; it needs to fill the picture in some photos.";
    print: "Print a sheet";
    load_control: "Load its control.csv";
    name_dots: "Name the dots of a board";
    photos: "2 Photos";
    photos_words: "Focus and zoom fixed. From several sides, some tilted by 30 to 45°, some rolled by 90°, the board also in the corners.";
    detect: "Find targets";
    covering: "looking at what the photos cover";
    covered: "Coverage";
    by_radius: "Targets from the middle to the corner";
    by_roll: "Photos by roll about the axis";
    by_tilt: "Photos by tilt against the board";
    not_oriented: "Rolls and tilts are known after the adjustment.";
    reach(percent): "The outermost target is at {percent} % of the corner's radius.";
    covers_all: "Nothing is missing.";
    lack_photos(n): "Only {n} {n:photo|photos} with measurements: take at least 8.";
    lack_radius: "No targets towards the corners: distortion there is extrapolated. Take photos with the board in the corners.";
    lack_cells: "Parts of the picture are without targets: take photos that fill them.";
    lack_roll: "No photo is rolled by 90°: principal point and decentring depend on it. Turn the camera for a few photos.";
    lack_tilt: "All photos look straight at the board: the principal distance cannot be told from the distance. Tilt some by 30 to 45°.";
    result: "3 Result";
    to_adjustment: "Adjustment and parameters";
    to_results: "Results";
    files: "4 Files";
    files_words: "OpenCV, ROS, Kalibr, mrcal, COLMAP, Metashape, MicMac; what a conversion leaves is stated.";
    to_files: "Files for other programs";
    cross: "Cross-validate";
    cross_why: "Calibrates the camera from each half of the photos and compares the halves with what their standard errors allow.";
    crossing: "calibrating each half of the photos";
    agrees(ratio, limit): "The halves agree: they differ by at most {ratio} times their standard error (limit {limit}).";
    larger_noise(ratio, limit): "The halves differ by up to {ratio} times their standard error (limit {limit}), but no more than the residuals explain: the standard errors of the image coordinates are too small.";
    wrong_model(ratio, limit): "The halves differ by up to {ratio} times their standard error (limit {limit}): the camera model is wrong, or camera and object did not stay as they were.";
    predicted: "Predicted";
    observed: "Observed";
    map_words: "Difference of the halves in pixels over the picture, as their standard errors predict it and as it is; both in one scale. Hatched: no target near.";
    up_to(px): "≤ {px} px";
    beyond(px): "> {px} px";
    worst(u, v): "Largest at {u}, {v} px.";
    proposed(degrees, models): "The focal length gives {degrees}° across the diagonal: such lenses mostly need {models}. It is not chosen by itself; compare the models when photos are measured.";
    propose_use(model): "Use {model}";
} }
