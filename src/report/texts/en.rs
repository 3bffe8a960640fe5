//! The report in English, by which every other language is checked.
//!
//! `{n}` is a value; `{n:photo|photos}` is the word for one or for any other number of them.

use super::declare;

/// This language.
pub struct English;

fn choose<'a>(value: &str, one: &'a str, other: &'a str) -> &'a str {
    if value == "1" { one } else { other }
}

declare! {
    // The report
    report_title: "Bundle adjustment report";
    all_sigmas(unit): "All sigmas 1σ unless said; {unit}";
    operator: "Measured by";
    date: "Date";
    project: "Project";
    chi_squared: "χ², interval";
    redundancy: "redundancy";
    relative_accuracy: "relative accuracy";
    yes: "yes";
    no: "no";

    // Sections
    summary: "Summary";
    uncertainty: "Uncertainty of the coordinates";
    observations_and_unknowns: "Observations and unknowns";
    cameras: "Cameras";
    network: "Network";
    photos: "Photos";
    points: "Points";
    control_check_scale: "Control, check points and scale";
    lengths: "Length measurement errors";
    statistics: "Statistics and tests";
    residuals: "Residuals by photo";
    left_out: "Left out, and why";
    settings: "Settings and inputs";
    all_observations: "All image observations";

    // Summary
    measured(points, photos, cameras): "{points} {points:point was|points were} determined from {photos} {photos:photo|photos} of {cameras} {cameras:camera|cameras} by bundle adjustment.";
    measured_self_calibrating(points, photos, cameras): "{points} {points:point was|points were} determined from {photos} {photos:photo|photos} of {cameras} {cameras:camera|cameras} by self-calibrating bundle adjustment.";
    datum_control(n, points): "The coordinates are those of {n} control {n:point|points}: {points}.";
    datum_free: "The network is free: its coordinates keep the mean position, attitude and size of its initial values (inner constraints over all points).";
    datum_free_chosen(n): "The network is free: its coordinates keep the mean position, attitude and size of the initial values of {n} chosen {n:point|points} (inner constraints).";
    datum_minimal: "The coordinates stand on as few constraints as the network needs; sigmas grow with the distance from them.";
    scale_control: "The scale is that of the control points.";
    scale_distances(n): "{n} measured {n:distance gives|distances give} the scale.";
    scale_none: "No scale: give a distance or control points. Lengths are right relative to each other only and have no unit.";
    test_passed(sigma0, percent): "The standard deviation of unit weight is {sigma0} and passes the global test at {percent} %: the observations agree with the accuracy that was assumed of them.";
    test_too_large(sigma0, percent): "The standard deviation of unit weight is {sigma0} and fails the global test at {percent} %: the observations are worse than was assumed of them. All sigmas here are enlarged by it.";
    test_too_small(sigma0, percent): "The standard deviation of unit weight is {sigma0} and fails the global test at {percent} %: the observations are better than was assumed of them. All sigmas here are reduced by it.";
    standard_errors_estimated(factors): "The standard errors were estimated from the residuals: {factors}. The standard deviation of unit weight is 1 by that, and no global test can tell whether the observations are as good as was assumed of them.";
    not_converged: "The adjustment did not converge: these numbers are not a result.";
    nothing_checked: "The network has no redundancy: nothing checks the observations.";
    known_to(value, k, percent): "A coordinate is known to {value} on average (k = {k}, about {percent} %).";
    least_certain(point, axis, value): "The least certain coordinate is {axis} of point {point}: ± {value}.";
    within_the_network: "This holds within the network, for each coordinate by itself; what is included and what is not stands in the section on uncertainty.";
    no_statistics: "The adjustment was made without statistics: nothing is said about its accuracy.";
    check_points_agree(n, rms): "{n} check {n:point|points}, known beforehand and not used, differ from the result by {rms} (rms over all axes).";
    no_independent_check: "No check points were measured: there is no independent check of these coordinates.";
    nothing_left_out: "No measurement was left out.";
    not_used(parts): "Not used: {parts}.";
    left_of_observations(n, of): "{n} of {of} image observations";
    left_of_control(n, of): "{n} of {of} control points";
    left_of_coordinates(n): "{n} given {n:coordinate|coordinates}";
    left_of_distances(n, of): "{n} of {of} distances";
    left_of_photos(n, of): "{n} of {of} photos";
    left_of_points(n, of): "{n} of {of} object points";
    left_of_parameters(n): "{n} camera {n:parameter|parameters}";
    left_named(names): "Among them: {names}.";
    left_out_short: "not used";
    pixels(n): "{n} px";
    left_out_by: "by";
    image_observation: "image observation";
    control_point: "control point";
    by_orientation: "orientation";
    by_matching: "matching";
    by_snooping: "data snooping";
    by_robust: "robust weights";
    by_document: "document";
    by_adjustment: "adjustment";
    out_gross_error: "gross error";
    out_no_weight: "no weight is left";
    out_photo_disabled: "its photo is switched off in the document";
    out_not_measured: "not measured in a photo that took part";

    // Uncertainty
    gum_statement(u, k, expanded, percent): "The combined standard uncertainty of a coordinate is u = {u} (root mean square over all points and axes). The expanded uncertainty is U = k u = ± {expanded} with the coverage factor k = {k}, for a level of confidence of about {percent} % under a normal distribution. Stated after the Guide to the Expression of Uncertainty in Measurement (JCGM 100:2008, 7.2).";
    gum_included: "Included";
    gum_not_included: "Not included";
    gum_image(sigma): "Image coordinates: a priori standard deviation {sigma} px (median).";
    gum_unmodelled(sigma): "What the camera model leaves over: {sigma} px, added in quadrature to every image coordinate.";
    gum_estimated(factors): "These standard deviations, estimated from the residuals (type A): {factors}.";
    gum_sigma0(sigma0, r): "The agreement of the observations with each other: σ₀ = {sigma0} from {r} degrees of freedom (type A); all sigmas are multiplied by it.";
    gum_cameras(names): "The cameras, estimated together with the points: {names}.";
    gum_control(n, sigma): "{n} control {n:coordinate|coordinates} with their standard deviations of {sigma} (type B).";
    gum_scale(n, sigma): "The scale: {n} {n:distance|distances} with standard deviations of {sigma} (type B).";
    gum_scale_relative(ppm, value): "The distances alone leave the scale uncertain by {ppm} parts per million (1σ): {value} on the largest dimension.";
    gum_no_scale: "The scale: nothing measured gives it, so no length here is traceable.";
    gum_control_held(points): "Errors of control coordinates that are held without a standard deviation ({points}): they go into the result in full.";
    gum_cameras_held(cameras): "Errors of cameras that are held as given: {cameras}.";
    gum_temperature: "Temperature: expansion of the object and of scale bars between the measurement and their reference temperature.";
    gum_targets: "Thickness and mounting of targets: the coordinates are those of target centres, not of the surface below.";
    gum_movement: "Movement and deformation of the object while the photos were taken.";
    gum_systematic: "Systematic errors that all photos share and the camera model cannot express; check points and check lengths show these.";

    // Observations
    counts: "Counts";
    precision_and_checks: "Precision and checks";
    observations: "Observations";
    image_coordinates: "image coordinates";
    control_coordinates: "control coordinates";
    observed_centres: "projection centres";
    distances: "Distances";
    observed_parameters: "camera parameters";
    unknowns: "Unknowns";
    datum_constraints: "Datum constraints";
    iterations: "Iterations";
    rms_sigma_xyz(unit): "RMS σ X, Y, Z ({unit}, 1σ)";
    largest_dimension(unit): "Largest dimension ({unit})";
    largest_sigma(point, axis, unit): "Largest σ, point {point}, {axis} ({unit})";
    rms_residual_px: "RMS of image residuals (px)";
    check_rms(n, unit): "RMS at {n} check {n:point|points} ({unit})";
    over_w(limit): "Observations with |w| > {limit}";

    // Cameras
    camera: "Camera";
    model_brown: "Brown model, correction of the measured point";
    model_opencv: "OpenCV model, distortion of the ideal point";
    pitch_unknown: "unknown";
    camera_line(size, pitch, n): "Sensor grid {size}, pixel {pitch}, {n} {n:photo|photos}.";
    parameter: "parameter";
    value: "value";
    unit: "unit";
    ratio: "|value| / σ";
    held: "held";
    held_at_zero(names): "Not estimated and 0: {names}.";
    correlated(limit, pairs): "Correlations beyond {limit}: {pairs}. Such parameters are known together, not each by itself.";
    principal_distance: "principal distance";
    principal_point: "principal point";
    radial_distortion: "radial distortion";
    decentring_distortion: "decentring distortion";
    affinity: "affinity";
    shear: "shear";
    lateral_colour: "Lateral chromatic aberration";
    lateral_colour_means(corner): "Red and blue against green, positive outwards, at the corner of the picture, {corner} px from its middle. It tells how far another colour than the one measured would lie; no coordinate is corrected by it unless the camera holds a set for that colour.";
    colours_held: "Interior orientation in other colours";
    colours_held_means(photos): "What is added to the parameters above for photos measured in another colour than green or grey; held in the adjustment. Photos measured so: {photos}.";
    colour_without_set(colour, photos): "Measured in another colour, {colour}, for which the camera holds no set, and computed as if in its own: photos {photos}.";
    colour: "colour";
    red: "red";
    blue: "blue";
    at_corner: "at the corner";
    targets: "targets";

    // Network
    network_line(photos, points, mean, fewest): "{photos} {photos:photo sees|photos see} {points} {points:point|points}. A point has {mean} rays on average and {fewest} at least.";
    points_by_rays: "Points by number of rays";
    weakest_points: "Weakest points";
    rays: "rays";
    point: "point";
    weaknesses: "What the network is weak in";
    no_weakness: "Nothing in the network was found weak.";
    weak_correlation(camera, first, second, r): "Camera {camera}: {first} and {second} are strongly correlated (correlation {r}).";
    weak_redundancy(n): "{n} {n:observation is|observations are} hardly checked by others.";
    weak_two_rays(n, points): "{n} {n:point has|points have} two rays only ({points}): an error along the epipolar line stays unseen.";
    weak_narrow(n, points): "The rays of {n} {n:point|points} meet under a narrow angle ({points}).";
    weak_behind(pairs): "Points behind the photo that is said to see them: {pairs}.";
    weak_distance_unused(pairs): "Distances that took no part, since an end is not measured: {pairs}.";
    weak_principal_distance(camera, value, sigma): "Camera {camera}: the photos hardly determine the principal distance, {value} ± {sigma}.";
    weak_unsettled: "The search for gross errors came to no end.";
    weak_components: "The estimation of variance components came to no end.";
    weak_sigmas(sigma0): "The residuals are larger than the standard deviations of the image coordinates say (σ₀ {sigma0}).";
    weak_unmodelled(sigma0): "The unmodelled part belongs to other weights: σ₀ is {sigma0}.";
    weak_insignificant(camera, name, ratio): "Camera {camera}: {name} is {ratio} of its standard deviations and not told from 0.";
    weak_suspected(n, names): "{n} {n:observation is|observations are} suspected of a gross error: {names}.";
    control_misfit(point, size, sigmas, axis): "Control point {point} is {size} ({sigmas} sigma) from where the photos see it, mainly in {axis}.";
    exchanged_points(a, b): "Control points {a} and {b} seem exchanged.";
    double_points(n, pairs): "{n} {n:pair|pairs} of points are nearer to each other than their standard errors tell apart: {pairs}.";
    no_unit: "no unit";
    exchanging(first, second): "exchanging {first} and {second}";
    negating(axis): "changing the sign of {axis}";
    weak_mirrored(exchange, exchanged, given): "The given coordinates are mirrored: {exchange} makes them fit to {exchanged} instead of {given}.";
    weak_undecided(n): "The {n} given points lie in a plane: nothing shows whether their axes are mirrored.";
    weak_unit_control(ratio, nearest): "The control points are {ratio} times the size that the distances give, nearly {nearest}: a wrong unit?";
    weak_unit_distance(bars, ratio, nearest): "Distance {bars} is {ratio} times its length in the network, nearly {nearest}: a wrong unit?";
    weak_unit_camera(camera, ratio, nearest): "Camera {camera}: the given principal distance is {ratio} times that of the photos, nearly {nearest}: a wrong unit?";
    weak_unit_diameter(nearest): "The network and the diameters of its targets differ by about {nearest}: a wrong unit?";
    weak_one_station(photos): "Photos {photos} were taken from one place: they add no depth to each other.";
    weak_one_station_all(n): "All {n} photos were taken from one place: they show neither depth nor principal distance.";
    weak_view(camera, value, angle): "Camera {camera}: a principal distance of {value} means a field of view of {angle}°.";
    weak_view_pixels(camera, value, angle): "Camera {camera}: a principal distance of {value} px means a field of view of {angle}°; in millimetres it needs a pixel pitch.";
    weak_image_size(camera, size, photos, measured): "Camera {camera} has pictures of {size} px, but photos {photos} were measured up to {measured} px.";
    weak_resized(photo, camera, factor): "Photo {photo} was resized: it is {factor} times the size of camera {camera}'s pictures.";
    weak_cropped(photo, camera, offset): "Photo {photo} is a part of a picture of camera {camera}, beginning at {offset} px.";
    weak_other_distance(photo, camera, value): "Photo {photo} was taken at a principal distance of {value}, not that of camera {camera}.";

    // Photos
    photo: "photo";
    file: "file";
    orientation_convention: "Angles ω, φ, κ turn object differences into the camera frame: M = Mκ Mφ Mω; x to the right, y up, the camera looks along −z.";
    projection_centres: "Projection centres";
    angles: "Angles";

    // Points
    role: "role";
    role_tie: "tie";
    role_control: "control";
    role_check: "check";

    // Control, check, scale
    control_held(n, points): "{n} control {n:point is|points are} held as given: {points}.";
    control_observed: "Control coordinates with a standard deviation";
    control_coordinate: "control";
    projection_centre: "projection centre";
    distance: "Distance";
    camera_parameter: "parameter";
    adjusted_minus_given: "Differences are adjusted minus given.";
    kind: "kind";
    difference: "difference";
    given: "given";
    adjusted: "adjusted";
    took_no_part: "took no part";
    check_points: "Check points";
    no_check_points: "There are no check points.";
    mean: "mean";
    rms: "rms";
    check_rms_all(n, rms): "Over all axes of {n} check {n:point|points} the rms is {rms}.";

    // Lengths
    lengths_explained: "Calibrated lengths that took no part in the adjustment, against what was measured: E = measured − calibrated.";
    calibrated: "calibrated";
    measured_length: "measured";
    limit: "limit";
    within: "within";
    beyond: "beyond";
    largest_length_error(value, n): "The largest length measurement error is {value} in size, of {n} {n:length|lengths}.";
    limit_kept(formula): "All of them keep the limit {formula}.";
    limit_broken(formula, n): "{n} {n:length is|lengths are} beyond the limit {formula}.";
    lengths_of_the_guideline: "After VDI/VDE 2634 part 1. Its acceptance test asks for at least seven measuring lines in the measuring volume with five calibrated lengths each; fewer lengths than that show as much as they are.";

    // Statistics
    sigma0_long: "σ₀, standard deviation of unit weight (a priori 1)";
    global_test(percent): "Global test (χ², two-sided, {percent} %)";
    passed: "passed";
    failed: "failed";
    statistic_vpv: "Statistic vᵀPv";
    interval: "Interval";
    critical_w(percent): "Critical value of Baarda’s |w| ({percent} %)";
    critical_tau(percent): "Critical value of Pope’s |τ| ({percent} %)";
    noncentrality(percent): "δ₀ of detectable errors (power {percent} %)";
    mean_redundancy: "Mean redundancy number of image coordinates";
    low_redundancy(limit): "Image coordinates with a redundancy number below {limit}";
    group: "observations of";
    factor: "factor";
    unmodelled_px: "unmodelled (px)";
    variance_components: "Variance components";
    estimated_from_residuals: "standard errors estimated";
    no_verdict: "none, since standard errors were estimated";
    times_a_priori_px(factor, px): "{factor} times the a priori {px} px";
    times_a_priori(factor): "{factor} times the a priori ones";
    and_unmodelled(factor, px): "{factor}, and {px} px that are not modelled";
    not_estimated(group, redundancy, needed): "{group}: not estimated, their a priori standard errors stay. Their redundancy is {redundancy}; a variance needs {needed}.";
    no_residuals(group): "{group}: not estimated, since all their residuals are 0; their a priori standard errors stay.";
    iteration: "iteration";
    step: "largest step";
    largest_w: "Largest test values";
    over: "over";
    by_chance(over, limit, tests, expected): "{over} of the observations exceed {limit}; of {tests} tests {expected} would by chance.";

    // Residuals
    largest: "largest";
    mean_r: "mean r";

    // Left out
    reason: "reason";
    aside_disagrees: "disagrees with the other measurements";
    aside_photo: "its photo could not be oriented";
    aside_point: "its point could not be determined";
    aside_undecided: "as many observations of its point speak for another place; which are right cannot be decided";
    aside_by_hand: "switched off in the document";
    round: "round";
    observation: "observation";
    action: "action";
    statistic: "statistic";
    removed: "left out";
    removed_with: "left out with another";
    restored: "taken back";
    downweighted: "weighted down";
    kept: "found, and kept";
    search_found_nothing: "The search for gross errors found nothing.";
    no_search: "No search for gross errors was asked for.";
    record_of_search: "Record of the search for gross errors";

    // Features
    features: "Features";
    feature: "feature";
    feature_of: "of";
    feature_line: "line";
    feature_plane: "plane";
    feature_circle: "circle";
    feature_sphere: "sphere";
    feature_cylinder: "cylinder";
    feature_distance: "distance";
    feature_angle: "angle";
    feature_diameter: "diameter";
    feature_deviations: "deviations";
    feature_from(id): "from {id}";
    feature_from_given(n): "from {n} given {n:point|points}";
    feature_points(n): "{n} {n:point|points}";
    feature_direction: "direction";
    feature_places: "Where they lie";
    form_rms: "rms";
    smallest_largest: "smallest … largest";
    features_explained: "Forms fitted to the adjusted points by least squares of their orthogonal distances, without weights; standard errors (1σ) from the full covariance of the points. rms, smallest and largest are distances of the points from the form.";
    feature_weak(id, percent): "{id} has no standard errors: the points determine its radius to {percent} % only, or its direction to as many hundredths of a radian, or those of what it is measured from.";
    feature_lacks(id, points): "{id} is without points that this adjustment has not: {points}.";
    feature_failed(id, why): "{id} could not be measured: {why}.";
    lacks_points(given, needed): "this adjustment determines {given} of its points, it needs {needed}";
    lacks_point(name): "point {name} is not determined by this adjustment";
    points_undetermined: "its points lie in one place, on one line, in one plane or too near to it";
    fit_unsettled: "the fit to its points came to no end";
    not_fitted(name): "{name} is not fitted to points";
    built_on_broken(name): "it is built on {name}, which could not be measured";
    lacks_direction: "an angle is between two directions, or at a point between two others";
    feature_not_measured(id): "{id} was defined after this result and has not been measured on it.";
    system_named(id): "Coordinate system {id}";
    system_automatic: "In the object's plane: Z is its normal towards the photos, X its longer extent, the origin its centroid.";
    system_plane_line_point: "By plane, line and point (3-2-1): Z is 0 in the plane, Y on the line, X at the point.";
    system_best_fit: "Best fit to given coordinates.";
    system_fit(sigma, redundancy, scale): "σ₀ of the fit {sigma} from {redundancy} degrees of freedom; scale {scale}.";

    // Plots
    plot_radial(camera): "Radial distortion, camera {camera}";
    plot_radial_says(value, sigma, unit, r, radius_unit, widened): "At the outermost target, r = {r} {radius_unit}, the distortion is {value} ± {sigma} {unit} (1σ). The band is {widened} σ wide; beyond the outermost target nothing but the formula carries the curve.";
    as_estimated: "as estimated";
    balanced: "balanced: 0 at 2/3 of the radius";
    no_target_beyond(r, unit): "no target beyond {r} {unit}";
    plot_decentring(camera): "Decentring distortion, camera {camera}";
    plot_decentring_says(value, sigma, unit, r, radius_unit): "At the outermost target, r = {r} {radius_unit}, the decentring distortion is at most {value} ± {sigma} {unit} (1σ). The band is 2 σ wide.";
    plot_significance(camera): "Significance of parameters, camera {camera}";
    plot_significance_all(limit): "Every parameter of distortion is told from 0: all are beyond {limit} of their standard deviations.";
    plot_significance_says(names, limit): "Not told from 0, below {limit} of their standard deviations: {names}. Hold them, or photograph so that they show.";
    log_ratio: "log₁₀ |value| / σ";
    plot_network_above: "Network from above";
    plot_network_front: "Network from the front";
    plot_network_says(photos, points, factor): "{photos} {photos:station|stations} and {points} {points:point|points}; a line runs from each station to the middle of what it sees. Error ellipses 1σ, {factor} times.";
    plot_rays: "Points by number of rays";
    plot_rays_says(fewest, most, two): "From {fewest} to {most} rays meet in a point. Points with fewer than three: {two}; nothing checks these along the epipolar line.";
    plot_angles: "Points by their largest angle of intersection";
    plot_angles_says(median, least): "Half of the points have rays that meet under {median}° or more (taken as acute); the narrowest meet under {least}°. Below 5° nothing tells the depth.";
    largest_angle: "largest angle, degrees";
    plot_sigmas: "Standard deviations of the points";
    plot_sigmas_says(n, median, top, ratio): "Of {n} points in the order of their largest σ, the middle one has {median} and the last {top}, {ratio} times as much.";
    points_by_size: "points, by their largest σ";
    plot_histogram: "Standardised residuals";
    plot_histogram_says(n, spread, beyond, limit): "{n} test values w; their standard deviation is {spread} (1 where the assumed accuracy is right). The line is the normal distribution; beyond ± {limit} lie {beyond}.";
    number_of: "number";
    plot_normal: "Normal plot of standardised residuals";
    plot_normal_says: "Normal residuals lie on a line; on the dashed one where the assumed accuracy is right. Ends that bend away are gross errors, or tails that are heavier than normal.";
    normal_quantile: "normal quantile";
    plot_convergence: "Convergence";
    plot_convergence_says(n, sigma0): "σ₀ over {n} {n:iteration|iterations}; it ends at {sigma0}.";
    plot_deviations(id): "Deviations from {id}";
    plot_deviations_says(n, rms, low, high, unit): "{n} {n:point|points}: rms {rms}, from {low} to {high} {unit}, each drawn upwards where it is positive.";
    laid_plane: "The plane is seen along its normal.";
    laid_cylinder: "The cylinder is unrolled: height along its axis against the angle about it.";
    laid_sphere: "The sphere is laid flat: latitude against longitude.";
    laid_circle: "Over the angle about the circle's centre.";
    laid_line: "Along the line; a distance from a line has no sign.";
    plot_radius: "Residuals against the radius";
    plot_radius_clean(worst, unit): "Radial part of the residuals over the image radius, and its mean by classes: the means stay within 3 σ of 0 (largest {worst} {unit}), the distortion model leaves nothing over.";
    plot_radius_says(n, worst, unit): "Radial part of the residuals over the image radius, and its mean by classes: in {n} {n:class|classes} the mean is beyond 3 σ of 0 (largest {worst} {unit}). The distortion model leaves something over: free a further parameter of it.";
    plot_all_residuals(camera): "Residuals of all photos in one frame, camera {camera}";
    plot_all_residuals_says(n, photos): "{n} residuals of {photos} {photos:photo|photos} at their places on the sensor: neighbours that point the same way are a pattern of the lens, not noise.";
    plot_residuals(photo): "Residuals, photo {photo}";
    plot_residuals_says(x, y, unit, n): "rms x {x}, y {y} {unit}, {n} {n:point|points}";
    plot_redundancy(camera): "Redundancy numbers over the photo, camera {camera}";
    plot_redundancy_says(mean, low, limit): "The larger the dot, the less an observation is checked by others: the mean of the smaller of r in x and y is {mean}; below {limit} lie {low}.";

    plot_comparison: "Against the adjustment before";
    plot_comparison_says(n, rms, largest, point, limit, beyond, before, after): "{n} points that both have moved by {rms} in the mean (rms); the most by {largest}, point {point}. Beyond {limit} standard errors: {beyond}. σ₀ was {before} and is {after}.";
    points_by_shift: "points, by how far they moved";

    // Settings
    options: "Options";
    software: "Software";
    termination: "End of the iteration";
    converged: "converged";
    iteration_limit: "iteration limit";
    diverged: "diverged";
    stopped: "stopped";
    max_iterations: "Largest number of iterations";
    a_priori_image: "A priori σ of image coordinates";
    residuals_taken: "Residuals";
    residuals_measured: "in the measurement";
    residuals_corrected: "at the corrected place";
    statistics_none: "none";
    statistics_precision: "standard deviations";
    statistics_full: "full";
    snooping: "Data snooping";
    robust: "Robust weights";
    target_diameter: "Common target diameter";
    estimated_parameters: "Camera parameters";
    free: "estimated";
    observed: "observed";
    inputs: "Inputs";
    inputs_explained: "With these inputs, options and version the same numbers come out again. The digest of the document is that of its JSON as exported, without its part “report”; that of a photo is of its file.";
    input: "input";
    the_document: "the document";
    not_recorded: "not recorded";
}
