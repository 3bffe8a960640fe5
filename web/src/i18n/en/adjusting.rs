//! Texts of the adjustment, its advice, and questions about what was given.

use super::{English, choose};
use crate::i18n::declare;

declare! { adjusting {
    // Adjustment
    adjustment: "Adjustment";
    bundle_adjustment: "Bundle adjustment";
    adjust_sentence: "Orientation gives initial values; the bundle adjustment then estimates all unknowns together.";
    adjusted_sentence(observations, unknowns, redundancy):
        "{observations} {observations:observation|observations}, {unknowns} unknowns, redundancy {redundancy}.";
    adjust_now: "Adjust";
    adjust_again: "Adjust again";
    adjusting: "Adjusting";
    what_is_estimated: "Estimated parameters";
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
    observed_with: "a priori standard error; empty: not observed";
    not_observed: "none";
    from_what: "Observations used";
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
    converged: "Converged: the step is below its limit.";
    iteration_limit: "Not converged after the maximum number of iterations: the values shown are not a solution.";
    diverged: "Diverged: no step reduced the residuals. Check point names, control points and initial values.";
    stopped: "Stopped on request.";

    // Advice
    sigmas_optimistic(sigma0): "The standard errors of the image coordinates are too small by a factor of {sigma0}";
    sigmas_optimistic_body:
        "σ₀ should be 1. Either the residuals contain an effect that is not modelled (target flatness, light, lens), or the given standard errors are too small. Standard errors of the result include σ₀.";
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
    lacks_scale_body: "Neither control points nor a distance give the scale: the size of the result is arbitrary.";
    seen_once(points): "Measure in a second photo: {points}";
    seen_once_body(point, photo): "Point {point} is measured in photo {photo} only and does not take part in the adjustment. The measurement is kept.";
    n_points(n): "{n} {n:point|points}";
    n_photos(n): "{n} {n:photo|photos}";
    photo_without_points(photos): "No point is measured in photo {photos}";
    photo_without_points_body:
        "It cannot be oriented. Detect targets with other options, name targets by hand, or exclude the photo.";
    hold_or_more(name, camera): "Hold {name} of camera {camera}, or add photos that determine it";
    hold_alone_body(name, ratio): "{name} is only {ratio} times its standard error: not significantly different from 0.";
    hold_or_more_body(name, ratio, other):
        "{name} is only {ratio} times its standard error and correlated with {other}: the network does not determine both.";
    look_at(point, photo): "Check point {point} in photo {photo}";
    look_at_given(kind, name): "Check the {kind} {name}";
    look_at_body(n, w, alpha):
        "{n} {n:observation exceeds|observations exceed} the critical value {w} of Baarda's w at α {alpha} %. This one is the largest.";
    nothing_lacks: "All photos are connected and all points are determined";
    nothing_lacks_body: "No observation exceeds the critical value, and all parameters are determined.";
    c_found(camera, value): "Principal distance of camera {camera} found: {value}";
    c_assumed(camera, value): "Principal distance of camera {camera} started at {value}";
    c_body: "No value was given. This one is only the initial value of the adjustment.";
    photo_not_oriented(photo): "Photo {photo} could not be oriented";
    photo_no_points: "No point is measured in it. Detect with other options or name points by hand.";
    photo_too_few(determined, needed):
        "Only {determined} of its points are known from other photos or control points; {needed} are needed.";
    photo_disagrees(determined):
        "Its {determined} {determined:point does|points do} not fit together. Check for wrong point names or another camera.";
    photo_other_group(group):
        "It belongs to photo group {group}, which has too few points in common with the oriented photos.";
    c_weak(camera, value): "The principal distance of camera {camera} is weakly determined ({value})";
    c_weak_body:
        "Hold it, observe it with a standard error, or add convergent photos and photos rotated by 90°.";
    c_undetermined: "undetermined";
    c_changed(camera, given, value):
        "Principal distance of camera {camera}: {given} given, {value} estimated from the photos";
    c_changed_body: "Usual cause: another lens, zoom or image size. Otherwise check for wrong point names.";
    photo_groups(n): "The photos form {n} groups that are not connected";
    photo_groups_body(groups):
        "Measure common points or add photos between them. Only the first group is oriented: {groups}";
    photo_ambiguous(photo): "Two orientations of photo {photo} fit its known points equally well";
    photo_ambiguous_body:
        "The one with the smaller residuals is used. Measure another point outside the plane of the others.";
    point_not_determined(point): "Point {point} has no coordinates";
    point_not_measured: "It was measured in no photo.";
    point_too_few(photos): "It is measured in {photos} {photos:oriented photo|oriented photos}; two are needed.";
    point_parallel(angle): "Its rays intersect at only {angle}°. Measure it in a photo from another side.";
    point_behind(photo): "It would lie behind the camera of photo {photo}. Check its name there.";
    point_disagrees: "Its rays do not intersect. Check its name in each of its photos.";
    point_no_coordinates: "It is a control or check point without coordinates.";
    point_undecided(first, second):
        "Its rays intersect at two positions, equally many at each (photos {first} and {second}): two targets have the same name. Rename one of them.";
    measurement_disagrees(point, photo): "Point {point} in photo {photo} disagrees with the other measurements";
    measurement_disagrees_body: "Usual cause: a wrong name. Check it, then rename or exclude it.";
    behind: "behind";

    // Questions about the input
    exchange_now(how): "Correct by {how}";
    exchanging(first, second): "exchanging {first} and {second}";
    negating(axis): "changing the sign of {axis}";
    mirrored(exchange, exchanged, given):
        "The given coordinates are mirrored: {exchange} reduces the misfit from {given} to {exchanged}";
    mirrored_body: "With the axes as given, coordinates can be wrong although all tests pass.";
    mirrored_or_body(others):
        "The photos cannot distinguish this from {others}; each gives the same shape. With the axes as given, coordinates can be wrong although all tests pass.";
    undecided_axes: "The given points lie in a plane: are the axes right?";
    undecided_axes_body(normal):
        "A mirrored plane fits equally well. With these axes, the cameras are on the side ({normal}). If they were on the other side, two axes are exchanged or one has the wrong sign.";
    unit_of_distance(bars): "Distance {bars}: a wrong unit?";
    unit_of_control: "Control points: a wrong unit?";
    unit_of_camera(camera): "Principal distance of camera {camera}: a wrong unit?";
    unit_of_diameters: "Coordinates and target diameters: different units?";
    unit_body(ratio, nearest): "It is {ratio} times the value from the other data; two units of length have the ratio {nearest}.";
    one_station(photos): "Photos {photos} were taken from one place";
    one_station_body: "They give no depth. Add photos of their points from other places.";
    one_station_all: "All photos were taken from one place";
    one_station_all_body: "They give neither depth nor principal distance. Take photos from other places.";
    field_of_view(camera, value): "Camera {camera}: a principal distance of {value} cannot be right";
    field_of_view_body: "The field of view would be impossible. The value was not used.";
    field_of_view_pixels:
        "The camera has no pixel pitch, so the value would be in pixels. It was not used. Give the pitch, or the value in pixels.";
    image_size(camera, photos): "Photos {photos} are larger than the image size of camera {camera}";
    image_size_body(size):
        "The camera has {size} px. Use the camera of these photos, or a calibration for their size.";
    photo_resized(photo, camera): "Photo {photo} was resized relative to camera {camera}";
    photo_cropped(photo, camera): "Photo {photo} was cropped relative to camera {camera}";
    photo_reframed_body: "It was not oriented. Use the original file, or give the photo a camera of its own.";
    photo_other_distance(photo, camera): "Photo {photo} has another principal distance than camera {camera}";
    photo_other_distance_body: "Another zoom, focus or camera. It was not oriented. Give the photo a camera of its own.";
} }
