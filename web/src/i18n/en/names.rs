//! Texts of point names: codes, marking by hand, matching.

use super::{English, choose};
use crate::i18n::declare;

declare! { names {
    // Identities
    identities: "Point names";
    identities_sentence(named, points, single):
        "{named} {named:observation|observations} of {points} {points:point|points}; {single} {single:point|points} in one photo only.";
    open_marks: "Open measurements…";
    matching: "Matching";
    matched(found, doubtful):
        "{found} {found:observation|observations} of uncoded targets matched; {doubtful} {doubtful:target is|targets are} doubtful and remain unnamed.";
    control: "Control";
    id: "id";
    rays: "rays";
    role: "role";
    role_tie: "tie";
    role_control: "control";
    role_check: "check";
    doubt: "doubt";
    doubt_duplicate(photo): "code read twice in photo {photo}";
    doubt_code_family(photo): "code family unknown in photo {photo}";
    doubt_code_unclear(photo): "code unclear in photo {photo}";
    doubt_occluded(photo): "partly occluded in photo {photo}, so its centre is rough";
    doubt_ambiguous(photo): "several candidates in photo {photo}";
    doubt_disagrees(photo): "disagrees with the other rays in photo {photo}";
    one_ray: "in one photo only";
    no_ray: "not measured";
    points: "Points";
    point: "Point";
    points_column: "points";
    photo: "photo";
    named_of(named, targets): "{named} named of {targets} {targets:target|targets}";
    name_this_target: "Name of this target";
    take_name: "Apply";
    marks: "Measurements";
    snap_radius: "snap radius";
    snapped_sentence(good, all): "{good} of {all} {all:measurement lies|measurements lie} at a measured centre.";
    take_marks(n): "Import {n} {n:measurement|measurements}";
    why_not: "reason";
    unsnapped_no_detection: "no targets were detected in this photo";
    unsnapped_no_target: "no target within the radius";
    unsnapped_contested(points): "as near to the same target as {points}";
    unsnapped_twice: "measured twice in this photo";
    remove_point: "Remove the point";
    remove_observation: "Remove the observation";
    take_part_short: "takes part";
    placed_by_hand: "Placed by hand, with σ 0.5 px.";
    nothing_to_measure: "There is no target to measure here. Alt-click, or \"Place freely\", uses the clicked position.";
    place_freely: "Place freely";
    place_freely_how: "Clicks use the clicked position, with σ 0.5 px; Alt-click does so at any time";
    click_measures: "Click measures, Alt-click places freely";
    name_this_place: "Name of this position";
    no_name: "no name";
    rename_where: "renames";
    in_all_photos(n): "in all {n} {n:photo|photos}";
    in_this_photo(photo): "in photo {photo} only";
    rename_says(n): "Renames the point in all its {n} {n:photo|photos}. Using the name of an existing point merges both points.";
    rename_here_says(photo): "Renames only the observation in photo {photo}; the other photos keep the old name.";
    point_renamed(from, to, n): "Point {from} renamed to {to} in {n} {n:photo|photos}.";
    points_joined(from, to, n): "Points {from} and {to} merged into {to}, in {n} {n:photo|photos}.";
    name_taken_from(before, photo, point):
        "This observation in photo {photo} was point {before} and is now {point}. The other photos keep {before}.";
    name_moved(point, photo): "Point {point} was at another position in photo {photo}; that position has no name now.";
    point_went(point): "Point {point} had no other observation and was removed with it.";
    both_in_photo(from, to, photo): "Photo {photo} shows both {from} and {to}: they cannot be one point.";

    // Measuring by hand
    measuring_by_hand: "Measuring by hand";
    point_by_point: "Point by point";
    point_by_point_how: "Each click measures a point and shows the next photo that should have it (M)";
    click_next_point: "Click the next point.";
    click_point_here(point): "Click point {point} here.";
    point_is_measured_here(point): "Point {point} is measured here.";
    is_it(point, off, reach): "Is this target point {point}? It is {off} px from the predicted position (3σ {reach} px).";
    is_it_of_two(point, off, reach, second):
        "Is this target point {point}? It is {off} px from the predicted position (3σ {reach} px), a second one {second} px.";
    is_it_near(point, off): "Is this target point {point}? It is {off} px from the predicted position; the accuracy of the prediction is known once the photos are adjusted.";
    should_be_near(point): "Point {point} is predicted near here; the accuracy of the prediction is known once the photos are adjusted. Measure here?";
    should_be_here(point, reach): "Point {point} is predicted here, 3σ {reach} px. Measure here?";
    yes: "Yes";
    next_place: "Next photo";
    next_point: "Next point";
    in_all_it_should_be: "The point is measured in every photo that should show it.";
    this_point_in_photos: "This point in its photos";
    predicted: "predicted";
    off_by(px): "{px} px off";
    not_in(n): "not in {n} {n:photo|photos}";
    layers: "Layers";
    layer_ellipses: "ellipses";
    layer_names: "names";
    layer_predicted: "predicted positions";
    layer_epipolar: "epipolar lines";
    layer_residuals: "residuals";
    layer_pixels: "pixel grid, grey values";
    residual_factor: "Magnification of residuals";
    times(n): "{n} times";
    brightness: "brightness";
    picture_contrast: "contrast";
    as_it_is: "Original";
} }
