//! Sentences of errors: what is wrong, where, and what to do.

use super::{English, choose};
use crate::i18n::declare;

declare! { errors {
    recognised(kind): "this is a {kind} file, which is not supported: convert it to JPEG, PNG or TIFF";
    raw_unread(kind): "this is a {kind} file, which is not supported: convert it to DNG (Adobe DNG Converter, dnglab), which keeps the sensor's samples";
    decoder_missing(format, message): "the decoder of {format} files could not be loaded ({message}): it is downloaded with the first such file, which needs a network connection once";
    no_picture: "not a supported image: JPEG, HEIC, camera RAW, PNG, TIFF or BMP is expected";
    broken(detail): "the picture cannot be decoded ({detail}): copy it again from the camera";
    size(width, height, limit): "the picture has {width} × {height} pixels; from 1 to {limit} pixels are supported";
    unknown(kind, name): "there is no {kind} \"{name}\"";
    duplicate(kind, name): "the {kind} \"{name}\" occurs twice: identifiers are unique";
    empty(what): "the project has no {what} to work on";
    initial_values(things): "initial values are missing for {things}";
    not_solved(causes): "the network cannot be solved: {causes}";
    control_disagrees_all(disagreeing):
        "control points {disagreeing} do not fit the photos or each other, and no other control point does: at least four must agree. Check coordinates, axes, unit and names; two may be exchanged";
    control_disagrees(disagreeing, n, agreeing):
        "control points {disagreeing} do not fit the photos and the other control points; {n} do ({agreeing}): at least four, and half of all, must agree. Check coordinates, axes, unit and names";
    stopped: "stopped on request";
    and_more(names, more): "{names} and {more} more";
    no_datum(missing):
        "{missing} of the 7 datum parameters (position, attitude, scale) are not fixed: add control points or a distance, or choose the minimal or the free datum";
    too_few_rays(points): "too few rays for point {points}: measure it in a second photo, give it coordinates or exclude it";
    photo_undetermined(photos):
        "too few points in photo {photos}: measure at least three well-spread points that other photos or the control determine, or exclude the photo";
    not_tied(groups): "groups of photos are not connected ({groups}): measure common points";
    parameter_undetermined(camera, parameters):
        "camera {camera}: the network does not determine {parameters}: hold it, observe it with a standard error, or add convergent photos and photos rotated by 90°";
    combination(things): "the network does not determine a combination of {things}: hold or observe some of them, or add rays";
    all_one_station(photos): "all photos were taken from one place ({photos}): they give neither depth nor principal distance; take photos from other places, or give control points";
    kind_photo: "photo";
    kind_point: "point";
    kind_camera: "camera";
    kind_file: "file";
    kind_line(n): "line {n}";
    kind_field: "field";
    some_photos: "photos";
    some_points: "points";
    some_cameras: "cameras";
    some_parameters: "parameters";
} }
