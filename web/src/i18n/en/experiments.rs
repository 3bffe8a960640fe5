//! Texts of the experiments.

use super::{English, choose};
use crate::i18n::declare;

declare! { experiments {
    // The pages
    experiments: "Experiments";
    experiments_words:
        "Three papers from Korea, repeated: their networks are simulated and adjusted here, and compared with the printed figures.";
    running: "Running the experiment";
    run: "Run";
    run_again: "Run again";
    open_as_project: "Open as a project";
    not_run_yet: "The figures, beside those of the paper, appear here after a run of a few seconds. The page stays usable meanwhile.";
    inputs_changed: "The inputs have changed since the last run. Run again to update the figures.";
    ran_in(seconds): "run in {seconds} s";
    vary: "Inputs";
    network: "Network";
    turn: "Turn the network in 3-D";
    turned: "The network in 3-D";
    not_turned(detail): "The 3-D view cannot be shown ({detail}): switch on hardware acceleration or WebGL in the browser.";
    drawing_shown: "network drawn";
    plan: "plan";
    elevation: "elevation";
    assumed: "Assumptions";
    assumed_aside: "not in the paper, or different from it";
    ours: "ours";
    paper: "paper";
    paper_of(what): "{what}, paper";
    independent: "independent";
    difference: "difference";
    figure: "figure";
    figures: "Figures";
    no_paper_figure: "not printed";
    rows(n): "{n} rows";

    // Questions, one an experiment
    kang: "Kang & Yeu 1985";
    kang_question: "How much do more photos improve coordinates?";
    kang_source:
        "Kang, J. M. and Yeu, B. M. (1985), A Study on the 3 Dimensional Precision Analysis of Objects by means of Multiple Close Range Photogrammetry.";
    film: "Film";
    film_question: "How well do fiducial marks and a distortion table correct comparator readings?";
    film_source: "The method of Kang and Yeu (1985), figures 3-2 and 3-3, on simulated readings.";
    lee_calibration: "Lee 1996, calibration";
    lee_calibration_question: "How well does a camera calibrate itself, starting from pixels?";
    lee_source:
        "Lee, J. D. (1996), Effective Application of Close-Range Photogrammetry with Digital Images in Industrial Precise Measurement.";
    lee_structure: "Lee 1996, structure";
    lee_structure_question: "What do convergent photos and a free network improve?";
    sensor: "Sensor or JPEG";
    sensor_question: "How much accuracy do centres and coordinates lose between the sensor and a camera's JPEG?";
    sensor_source: "Our own experiment: each exposure is rendered through lens and colour filters with photon noise, then processed as a camera does it. Six photos, self-calibrated in a free network, compared with the true centres and coordinates.";
    step_sites: "RAW";
    step_demosaiced: "demosaiced";
    step_sharpened: "sharpened";
    step_toned: "toned";
    step_jpeg_92: "JPEG 92";
    step_jpeg_75: "JPEG 75";
    step_of_camera: "measured on";
    error_over_sigma: "error / σ";
    object_rms: "coordinate errors, rms";
    object_sigma: "stated σ, rms";
    over_sites: "ratio to RAW";
    visible: "visible centres";
    t_sensor_steps: "Cost of each processing step";
    c_sensor_centres: "Errors of the centres";
    c_sensor_objects: "Errors and stated standard errors of the coordinates";
    a_sharpening(v): "Sharpening adds {v} % of the difference from the binomial mean of 3 × 3 pixels.";
    kim: "Kim, Hwang & Yun 2015";
    kim_question: "How accurate is a pair of photos, from DLT to intersected points?";
    kim_source:
        "Kim, H. G., Hwang, J. S. and Yun, H. S. (2015), Accuracy Analysis of 3D Position of Close-range Photogrammetry Using Direct Linear Transformation and Self-calibration Bundle Adjustment with Additional Parameters.";

    // Plates of one's own
    plates: "Your own plates";
    plates_words:
        "Describe camera, fiducial marks and distortion table, one per line; then add readings: photo, mark or point, x, y in the machine's millimetres.";
    plates_description: "description of camera and plates";
    plates_files: "Readings from files…";
    plates_scans: "Measured in the scans";
    plates_scans_words:
        "For scanned photos: measure fiducial marks and points under Targets, name the marks as above under Point names, then return here.";
    plates_reduced(photos, observations):
        "{photos} {photos:photo|photos} reduced, {observations} {observations:observation|observations}.";

    // Inputs
    in_distance: "object distance";
    in_mixed: "mixed distances";
    in_combination: "combination";
    in_photos: "number of photos";
    in_overlap: "overlap";
    in_network: "network of the project";
    in_datum: "datum of the project";
    in_image_sigma: "σ of image coordinates, µm";
    in_control_sigma: "σ of control coordinates, mm";
    in_pixel_noise: "noise of the pixels, % of full scale";
    in_rounds: "Monte Carlo runs";
    in_seed: "noise seed";
    in_method: "centres to adjust";
    in_left_out: "photos excluded from the second run";
    left_out_hint: "numbers, separated by spaces";

    // Words for names in cells, on axes and after figures
    all: "all";
    reduced: "with photos excluded";
    control: "control";
    free: "free network";
    observed: "observed";
    unknown: "unknown";
    yes: "yes";
    no: "no";
    greatest: "maximum";
    least: "minimum";
    mean: "mean";
    standard_deviation: "standard deviation";
    rms: "rms";
    similarity: "similarity";
    affine: "affine";
    projective: "projective";
    similarity_corrected: "similarity, lens corrected";
    affine_corrected: "affine, lens corrected";
    projective_corrected: "projective, lens corrected";
    field: "test field";
    planes: "two planes";
    all_photos: "all photos";

    // Words for identifiers of tables and charts
    t_single: "60 networks at one distance";
    t_mixed: "16 networks of mixed distances";
    t_improvement: "Decrease of M₀ and Mₛ compared with two photos";
    t_pairwise: "Models pair by pair (coplanarity) and the bundle";
    t_fiducials: "Residuals at the fiducial marks";
    t_transformations: "Parameters of the transformations";
    t_distortion: "Distortion table and odd polynomial";
    t_reductions: "Bundle adjustment after each correction method";
    t_photos: "Residuals by photo";
    t_parameters: "Camera parameters";
    t_two_rays: "Points seen in two photos only";
    t_estimators: "Centres compared with the truth, best first";
    t_standard_errors: "Standard errors";
    t_free_gain: "Gain of the free network";
    t_check_points: "Check points, photogrammetry minus survey";
    t_statistics: "Statistics of the differences";
    t_orientation: "Exterior orientation";
    t_interior: "Interior orientation";
    c_errors(n): "Standard errors with {n} {n:photo|photos}";
    c_improvement(d): "Improvement at {d} m";
    c_mixed: "Standard errors of mixed distances";
    c_standard_errors(axis): "Standard errors {axis}";
    c_pairwise: "Errors with 3 photos: pair by pair and bundle";
    c_distortion: "Radial distortion";
    c_distortion_error: "Radial distortion, ours minus true value";
    c_way(axis, photo): "{axis} of photo {photo} by iteration";

    // Axes, columns, lines, figures
    photo: "photo";
    point: "point";
    points: "points";
    photos: "photos";
    count: "number compared";
    found: "found";
    overlap_type: "type (overlap)";
    standard_error: "standard error";
    rms_error: "rms error";
    improvement: "improvement";
    distance: "distance";
    observations: "observations m";
    unknowns: "unknowns n";
    equations: "equations";
    datum: "datum";
    parameters: "additional parameters";
    relative: "relative accuracy";
    relative_median: "relative accuracy, median point";
    papers_instrument(mm): "With the paper’s instrument (control sigma {mm} mm)";
    rays: "rays";
    photos_of_run: "photos";
    relative_column: "relative accuracy 1 :";
    method: "method";
    largest: "largest";
    mark: "mark";
    kind: "transformation";
    parameter: "parameter";
    value: "value";
    radius: "radius";
    distortion: "distortion";
    table: "table";
    polynomial: "polynomial";
    residual: "residual";
    corrected: "lens corrected";
    bundle_sigma0: "σ₀ of the bundle";
    marks_sigma0: "σ₀ of the marks";
    planted: "true value (the paper's)";
    error: "error";
    element: "element";
    dlt: "DLT";
    bundle: "bundle";
    statistic: "statistic";
    total: "total";
    iteration: "iteration";
    iterations: "iterations until no change exceeds 0.1 mm";
    check_points: "check points";
    base_fall(base): "decrease of M₀ with B/D from 0.2 to {base}";
    fall_of(what): "decrease of {what}";
    m0_mean(n): "{n} {n:photo|photos} compared with 2, mean decrease of M₀";
    m0_up_to(n): "{n} {n:photo|photos} compared with 2, maximum decrease of M₀";
    m0_least: "minimum decrease of M₀ over types";
    m0_greatest: "maximum decrease of M₀ over types";
    monte_carlo(axis): "Monte Carlo scatter compared with S{axis}";
    residual_axis(axis): "residual {axis}";
    rms_sigma(axis): "rms σ{axis}";
    error_of(what): "error of {what}, in σ";
    gain_of(axis): "gain of the free network in {axis}";
    centre_rms: "centre errors, rms";
    distortion_sigma0: "σ₀ of the polynomial";
    pair_unaided: "pairs, best fit, one run";
    pair_draws: "pairs, parallel axes, 4 runs";
    bundle_draws: "bundle, 4 runs";
    pair_of(axis): "pairs {axis}";
    bundle_of(axis): "bundle {axis}";
    pair_rms_draws: "pairs rms, 4 runs";
    bundle_rms_draws: "bundle rms, 4 runs";
    pair_unaided_rms: "pairs best fit rms";
    pair_unaided_rms_draws: "pairs best fit rms, 4 runs";
    reduced_of(what): "{what}, photos excluded";

    // Assumptions, as sentences
    a_base_line_centre: "The centre of the base line faces the mean of the points: the paper does not state its position.";
    a_overall_means:
        "\"About 15, 35 and up to 50 %\" is taken over the distances of the paper's figures 4-6 to 4-9, 1.4 to 4.0 m: means for 3 and 4 photos, maximum decrease for 5. At 7.0 m more photos improve more.";
    a_pairwise:
        "In the paper, the errors of models formed pair by pair were irregular with distance. With random image errors alone, ours grow with distance as those of the bundle do: the method itself is not irregular. It becomes irregular if the second solution of the relative orientation of a shallow object is chosen.";
    a_sigma0_draws(n): "S₀ is the root mean square of {n} simulated sets of noise for each network, with its σ; the paper has one set of readings.";
    a_film_draws(n): "Figures of each correction method are root mean squares over {n} simulated sets of readings; with a single set, chance decides which method looks better.";
    a_gain_misprint(ours, paper): "The paper's table 5 prints {paper} % for Z in network I; its tables 3 and 4 give {ours} %. This is treated as a misprint and compared with {ours} %.";
    a_readings: "The readings are simulated: plates of the usual kind, read with the σ above. The paper prints none.";
    a_distortion: "The distortion table is simulated with the usual size: the paper shows it only as a drawing.";
    a_film_along(v): "The film shrank to {v} along its length.";
    a_film_across(v): "The film shrank to {v} across its width.";
    a_station_distance(v, paper):
        "Stations are {v} mm away. At the paper's distance of about {paper} mm, this camera sees 1.9 × 1.3 m of the 2.0 × 1.5 m field and fewer targets than the 100 to 119 per photo of its table 1. Farther away it sees more, but still fewer than that.";
    a_field_depth(v): "Targets have depths within {v} mm: the paper only says \"three-dimensional\".";
    a_station_directions: "Stations are on an arc at ±10°, ±30°, ±50°: the paper draws them without figures.";
    a_psf(v): "Lens blur of {v} px (standard deviation).";
    a_pixel_noise(v): "Pixel noise of {v} % of full scale, a constant part and photon noise.";
    a_centroid: "Intensity centroids are adjusted, the better weighting in the paper; other centres can be chosen above.";
    a_base_distance(v, paper):
        "The base line is {v} mm from the wall. At the paper's distance of about {paper} mm, this camera sees 3.7 × 2.5 m of the 6.3 × 3.5 m wall. At 7.4 m network I has the paper's 374 equations, but the photos of II miss the upper and lower rows. Standard errors grow with distance.";
    a_ray_on_wall(v):
        "Our standard errors are two to three times the paper's. Here a ray has an uncertainty of {v} mm on the wall, and six rays reduce it to 0.4 of that at best. With 3 µm, the paper's 0.273 mm for network I needs 21 rays, or a camera at 4.6 m, where a photo covers less than a third of the wall; its 374 equations need 30 of the 38 targets in every photo. The paper's standard errors and equations do not belong to one geometry: compare order and gains, not sizes.";
    a_outer(v):
        "Outer stations of network I are {v} mm from the middle: not in the paper. From 5 000 to 7 500 mm the order III, I, II in depth is the same.";
    a_relief(v): "Targets on pillars are {v} mm in front of the wall: not in the paper.";
    a_observed:
        "The additional parameters are observed with the standard errors of the first experiment's calibration; in the paper they are unknown. The table has both: if they are unknown, four control points in network II improve the calibration, and the free datum lacks this.";
    a_principal_distance(v): "Principal distance {v} mm: not in the paper. The image scale is then about 1 : 1 100.";
    a_survey(v):
        "Surveyed coordinates have errors of {v} mm (1σ): better than the total station's 2 mm + 2 ppm, since they are measured in one room from one set-up.";
    a_diameter(v): "Targets of {v} mm.";
    a_control_places:
        "The 65 control points lie on two planes through the check points: the paper prints only the 15 check points.";
} }
