//! Texts of the adjustment, its advice, and questions about what was given.

use super::{English, choose};
use crate::i18n::declare;

declare! { adjusting {
    // Adjustment
    adjustment: "Adjustment";
    bundle_adjustment: "Bundle adjustment";
    adjust_sentence: "Orientation finds initial values, then everything is adjusted together.";
    adjusted_sentence(observations, unknowns, redundancy):
        "{observations} {observations:observation|observations}, {unknowns} unknowns, redundancy {redundancy}.";
    adjust_now: "Adjust";
    adjust_again: "Adjust again";
    adjusting: "Adjusting";
    what_is_estimated: "What is estimated";
    unknowns: "unknowns";
    orientation_of(n): "Orientation of {n} {n:photo|photos}";
    position_and_rotation: "position and rotation, estimated";
    object_points: "Object points";
    points_all(n): "{n} × 3 coordinates";
    points_with_control(n, control): "{n} × 3 coordinates, {control} of them control";
    model_brown: "Brown";
    model_opencv: "OpenCV";
    model_opencv_rational: "OpenCV, rational";
    model_opencv_fisheye: "OpenCV, fisheye";
    of_model(model, words): "{model}: {words}";
    all_estimated(free): "{free} estimated";
    all_held(held): "{held} held";
    estimated_and_held(free, held): "{free} estimated; {held} held";
    estimated: "estimated";
    initial_value: "initial value";
    observed_with: "standard error of the value as an observation; empty: not observed";
    not_observed: "none";
    from_what: "From what";
    observations: "observations";
    image_coordinates: "Image coordinates";
    median_sigma(sigma): "each weighted with its own σ, median {sigma} px";
    control_coordinates: "Control coordinates";
    iterations: "Iterations";
    logarithmic: "logarithmic";
    no_iterations: "Iterations appear here as they are computed.";
    number: "no.";
    largest_step: "largest step";
    damping: "damping";
    converged: "The step fell below its limit: converged.";
    iteration_limit: "The largest number of iterations was reached without convergence: what is shown is not a solution.";
    diverged: "No step lowered the residuals: check identities, control points and initial values.";
    stopped: "Stopped on request.";

    // Advice
    sigmas_optimistic(sigma0): "The standard errors of the image coordinates are too small by {sigma0}";
    sigmas_optimistic_body:
        "σ₀ should be 1. Something that is not modelled is left in the residuals (flatness of targets, light, lens), or the sigmas are too hopeful. Sigmas of the result include σ₀.";
    more_notes(n): "{n} {n:more measurement disagrees|more measurements disagree} with the orientation";
    what_lacks: "Warnings and advice";
    hold(name): "Hold {name}";
    lacks_control: "Give at least three control points, or choose another datum";
    lacks_control_body: "The control datum takes position, attitude and scale from known points that do not lie on one line.";
    n_control(n): "{n} control";
    n_check(n): "{n} check";
    n_distances(n): "{n} {n:distance|distances}";
    no_unit: "no unit";
    lacks_scale: "Give a distance between two points";
    lacks_scale_body: "Neither control nor a distance gives the scale: the size of the result is arbitrary.";
    seen_once(points): "Measure in a second photo: {points}";
    seen_once_body(point, photo): "Point {point} is measured in photo {photo} only. It takes no part; nothing of it is lost.";
    n_points(n): "{n} {n:point|points}";
    n_photos(n): "{n} {n:photo|photos}";
    photo_without_points(photos): "No point is measured in photo {photos}";
    photo_without_points_body:
        "It cannot be oriented and takes no part: detect targets with other options, name some by hand, or leave it out.";
    hold_or_more(name, camera): "Hold {name} of camera {camera}, or add photos that determine it";
    hold_alone_body(name, ratio): "{name} is only {ratio} times its sigma: the network does not tell it from 0.";
    hold_or_more_body(name, ratio, other):
        "{name} is only {ratio} times its sigma and moves with {other}: the network does not determine both.";
    look_at(point, photo): "Look at point {point} in photo {photo}";
    look_at_given(kind, name): "Check the {kind} {name}";
    look_at_body(n, w, alpha):
        "{n} {n:observation exceeds|observations exceed} the critical value {w} of Baarda's w at α {alpha} %. The largest is this one.";
    nothing_lacks: "Every photo is tied and every point determined";
    nothing_lacks_body: "No observation is further off than chance explains, no parameter is left undetermined.";
    c_found(camera, value): "Principal distance of camera {camera} found: {value}";
    c_assumed(camera, value): "Principal distance of camera {camera} started at {value}";
    c_body: "No value was given; this one is only the start of the adjustment.";
    photo_not_oriented(photo): "Photo {photo} could not be oriented";
    photo_no_points: "No point is measured in it: detect with other options or name points by hand.";
    photo_too_few(determined, needed):
        "Only {determined} of its points are known from other photos or control; it takes {needed}.";
    photo_disagrees(determined):
        "Its {determined} {determined:point|points} do not fit together: look for wrong names, or another camera.";
    photo_other_group(group):
        "It belongs to group {group} of photos, which shares too little with the oriented ones.";
    c_weak(camera, value): "The network hardly determines the principal distance of camera {camera} ({value})";
    c_weak_body:
        "Hold it, observe it with a standard error, or add photos that are tilted and rolled against each other.";
    c_undetermined: "undetermined";
    c_changed(camera, given, value):
        "Principal distance of camera {camera}: {given} was given, the photos say {value}";
    c_changed_body: "Another lens, zoom or picture size, most often; else look for wrong names.";
    photo_groups(n): "The photos fall into {n} groups that are not tied to each other";
    photo_groups_body(groups):
        "Measure common points or add photos between them. Only the first group is oriented: {groups}";
    photo_ambiguous(photo): "Two orientations of photo {photo} fit its known points alike";
    photo_ambiguous_body:
        "The one with the smaller residuals was taken. Measure another point outside the plane of the others.";
    point_not_determined(point): "Point {point} has no coordinates";
    point_not_measured: "It was measured in no photo.";
    point_too_few(photos): "It is measured in {photos} {photos:oriented photo|oriented photos}; it takes two.";
    point_parallel(angle): "Its rays meet at {angle}° only: measure it in a photo from another side.";
    point_behind(photo): "It would lie behind the camera of photo {photo}: look for a wrong name.";
    point_disagrees: "Its rays do not meet: look for a wrong name in one of its photos.";
    point_no_coordinates: "It is a control or check point without coordinates.";
    point_undecided(first, second):
        "As many of its rays meet in one place (photos {first}) as in another ({second}): one name for two targets. Decide which is meant.";
    measurement_disagrees(point, photo): "Point {point} in photo {photo} disagrees with the other measurements";
    measurement_disagrees_body: "A wrong name, most often. Look at it, rename or exclude it.";
    behind: "behind";

    // Questions about the input
    exchange_now(how): "Correct by {how}";
    exchanging(first, second): "exchanging {first} and {second}";
    negating(axis): "changing the sign of {axis}";
    mirrored(exchange, exchanged, given):
        "The given coordinates are mirrored: {exchange} makes them fit to {exchanged} instead of {given}";
    mirrored_body: "With the axes as given, coordinates may be wrong though every test passes.";
    mirrored_or_body(others):
        "The photos do not tell this from {others}; each gives the same form. With the axes as given, coordinates may be wrong though every test passes.";
    undecided_axes: "The given points lie in a plane: are the axes right?";
    undecided_axes_body(normal):
        "A mirrored plane fits as well. With these axes the cameras stand on the side ({normal}); if they stood on the other, two axes are exchanged or one has the wrong sign.";
    unit_of_distance(bars): "Distance {bars}: a wrong unit?";
    unit_of_control: "Control points: a wrong unit?";
    unit_of_camera(camera): "Principal distance of camera {camera}: a wrong unit?";
    unit_of_diameters: "Coordinates and target diameters: different units?";
    unit_body(ratio, nearest): "It is {ratio} times what the rest gives; the ratio of two units of length is {nearest}.";
    one_station(photos): "Photos {photos} were taken from one place";
    one_station_body: "They add no depth to each other. Points need a photo from another place.";
    one_station_all: "All photos were taken from one place";
    one_station_all_body: "They show neither depth nor principal distance. Take photos from other places.";
    field_of_view(camera, value): "Camera {camera}: a principal distance of {value} cannot be right";
    field_of_view_body: "The field of view would be impossible; the value was not used.";
    field_of_view_pixels:
        "It would be in pixels, since the camera has no pixel pitch; the value was not used. Give the pitch, or the value in pixels.";
    image_size(camera, photos): "Photos {photos} are larger than the pictures of camera {camera}";
    image_size_body(size):
        "The camera has {size} px. Take the camera of these photos, or the calibration for their size.";
    photo_resized(photo, camera): "Photo {photo} was resized against camera {camera}";
    photo_cropped(photo, camera): "Photo {photo} is cropped against camera {camera}";
    photo_reframed_body: "It was not oriented. Take the original file, or give the photo a camera of its own.";
    photo_other_distance(photo, camera): "Photo {photo} has another principal distance than camera {camera}";
    photo_other_distance_body: "Another zoom or camera. It was not oriented; give the photo a camera of its own.";
} }
