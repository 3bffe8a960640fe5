//! Texts of monitoring: epochs, their comparison, displacements, points over time.

use super::{English, choose};
use crate::i18n::declare;

declare! { monitoring {
    monitoring: "Monitoring";
    monitoring_words: "Which points of an object moved between epochs, by how much, and how significant it is.";
    sentence: "Displacements between epochs, tested against stable reference points.";
    sample: "Open the sample with three epochs";
    sample_words: "A simulated dam face: targets moved by 3 and by 10 standard errors, and one reference point is not stable.";
    simulated: "simulated";
    comparing: "Comparing epochs";
    compare: "Compare";
    setup: "Epochs and options";
    displacements: "Displacements";
    over_time: "Point over time";

    // Epochs
    new_epoch: "New epoch";
    new_epoch_words: "A new project with the names, control points, scale bars, roles and cameras of this one; only photos are needed.";
    next_epoch_photos(name): "Epoch of {name}: names, control points, scale bars, roles and cameras are kept. Drop the photos of this epoch.";
    compare_with(name): "Compare with {name}";
    first_is_gone(name): "Epoch 0, {name}, is not stored in this browser or has no current adjustment. Add its project file here.";
    epochs: "Epochs";
    add_files: "Add files";
    add_project: "Add a project of this browser";
    choose_project: "Choose a project";
    files_words: "Project files, lists of points with standard errors (NAME, X, Y, Z, sX, sY, sZ) and covariance matrices can be dropped here.";
    two_needed: "Add at least two epochs. The first one is epoch 0; all others are compared with it.";
    number: "No.";
    name: "Name";
    date: "Date";
    points: "Points";
    source: "Source";
    kept_project: "this browser";
    list_of_points: "list";
    with_matrix(file): "list with the covariance matrix {file}";
    redundancy: "Redundancy";
    unit: "Unit";
    temperature: "Temperature °C";
    own_scale: "Own scale";
    details_hint: "σ₀ and redundancy of a list are those of its adjustment; without them, its standard errors count as exact.";
    control_kept: "Control points measured again in each epoch";
    raise(name): "Move {name} up";
    remove(name): "Remove {name}";
    date_refused(typed): "“{typed}” is not a date. Write it as 2026-03-14 or 2026-03-14T09:30.";
    number_refused(typed): "“{typed}” is not a positive number.";
    not_taken: "Not accepted as epochs";
    not_adjusted: "This project has not been adjusted: open it, adjust it, and add it again.";
    adjusted_before: "This project has changed since its last adjustment: open it, adjust it again, and add it again.";
    not_compared: "The epochs were not compared.";

    // Options
    options: "Options";
    reference_points: "Reference points";
    reference_means: "Points assumed to be stable; this is tested. Without names: the control points, else the datum points, else all common points.";
    ignored_points: "Ignored points";
    names_hint: "Names, separated by commas";
    common_points: "Common points";
    common_words: "Click a name to make it a reference point; click again to undo.";
    significance: "Error probability of each test, %";
    correction: "Correction for the number of points";
    holm: "Holm";
    bonferroni: "Bonferroni";
    no_correction: "none";
    power: "Power of detectable displacements, %";
    variance: "Variance factor";
    variance_estimated: "pooled if equal";
    variance_separate: "one for each epoch";
    variance_given: "σ₀ = 1, a priori errors trusted";
    method: "Method";
    method_coordinates: "coordinates of separate adjustments";
    method_joint: "joint, stable points in common";
    shared_cameras: "Cameras shared by all epochs";
    shared_cameras_hint: "Without a choice each epoch has its own cameras. Share a camera only if focus and zoom were not changed; this is tested.";
    shared_cameras_none: "The epochs have no camera of the same name, or one of them is a list of points: no camera can be shared.";
    datum: "System";
    datum_reference: "transformed on the reference points";
    datum_given: "as given, not transformed";
    thresholds: "Thresholds of displacement";
    warning: "Warning";
    alarm: "Alarm";
    thresholds_refused: "Thresholds must be positive lengths, and the warning at most the alarm.";
    percent_refused(typed): "“{typed}” is not a percentage in the permitted range.";
    groups: "Groups that move as one";
    add_group: "Add a group";
    group_name(n): "Group {n}";
    rigid: "rigid body";
    similarity: "rigid body and scale";
    affine: "homogeneous strain as well";

    // Verdict
    largest: "Largest displacement";
    of_point(id): "point {id}, 1σ";
    detectable_median: "Detectable, median";
    at_power(p, a): "power {p} %, α {a}";
    out_of_date: "Epochs or options have changed";
    out_of_date_words: "No numbers are shown until the epochs are compared again.";
    against_first: "Against epoch 0";
    is_reference: "epoch 0";
    n_moved(n): "{n} moved";
    none_moved: "none";
    no_statement: "no statement";

    // Tests
    tests: "Tests";
    level(a): "α {a} %";
    test: "Test";
    limit: "Limit";
    variance_test: "Variance factors F";
    scale_test(ppm, sigma): "Scale {ppm} ± {sigma} ppm";
    congruence_all(n): "Congruence, all {n}";
    congruence_without(id): "without {id}";
    passed: "passed";
    failed: "rejected";
    elimination: "Backward elimination";
    elimination_aside: "Ω of the removed point, T of the rest";
    second_opinion: "Second opinion";
    second_opinion_aside: "L1 datum: smallest sum of displacements";
    all_stable: "All reference points are stable in this datum.";
    unstable_are(names): "Not stable in this datum: {names}.";
    notes: "Notes";

    // Notes of the engine

    // Points
    object_points: "Object points";
    moved: "moved";
    stable: "stable";
    not_tested: "not tested";
    in_datum: "datum";
    out_of_datum: "out";
    detectable: "Detect.";
    detectable_means(p): "Detect.: displacement that is detected with power {p} %. Stable means that no larger displacement is proven.";
    later_name(id): "later {id}";
    length: "Length";
    judgement: "Result";
    translation: "Translation";
    rotation: "Rotation";
    scale_change: "Scale";
    strain: "Strain";
    fit: "Fit";
    fit_yes: "fits the model";
    fit_no: "does not fit the model";
    group_missing(names): "Not in both epochs: {names}.";
    left_out: "Not compared";

    // Picture
    oblique: "Home";
    top: "Top";
    front: "Front";
    side: "Side";
    picture: "Displacements and error ellipses, seen along the chosen direction";
    exaggeration: "Displacements";
    ellipses(percent): "ellipses {percent} %";
    legend_moved: "moved";
    legend_stable: "stable";
    legend_reference: "reference";
    legend_out: "reference, not stable";
    drawing: "Drawing (DXF)";
    scene: "Arrows (glTF)";
    in_photos: "In the photos";
    not_drawn(names, times): "Displacements × {times} that end outside the view of the camera are not drawn: {names}. Choose a smaller factor in Monitoring.";
    layer_displacements(times): "Displacements × {times}";
    table_file: "Table (CSV)";
    all_file: "All (JSON)";

    // Over time
    components(id): "{id}, displacement against epoch 0";
    bars: "bars 1σ";
    velocity_of(id): "{id}, velocity";
    per_month: "per month (30.44 days), straight line, 1σ";
    velocity_moves(id, v, s, unit): "{id} moves with {v} ± {s} {unit} a month.";
    velocity_still(id, v, s, unit): "No velocity of {id} is significant: {v} ± {s} {unit} a month.";
    velocity_none: "A velocity needs three dated epochs in the datum of the same stable reference points.";
    three_needed: "A point over time needs three epochs.";
    series_datum(names): "All epochs in the datum of {names}.";
    series_no_datum: "Fewer than four reference points are stable in all epochs: each displacement is in the datum of its own pair.";
    state_warning: "warning";
    state_alarm: "alarm";
    without_date: "without a date";
    all_points: "All points";
    velocity: "Velocity";
    state: "State";
    since_first: "Displacement since epoch 0";
    not_in_epoch: "not in this epoch";
    moves: "moves";
    compared_length: "Thresholds are compared with the length of the last displacement, significant or not.";
}}
