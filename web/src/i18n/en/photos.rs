//! Texts of photos and cameras, and of the view of a photo.

use super::{English, choose};
use crate::i18n::declare;

declare! { photos {
    // Photos and cameras
    photos: "Photos";
    photos_sentence(photos, cameras):
        "{photos} {photos:photo|photos}, {cameras} {cameras:camera|cameras}. Photos of the same make, model, size and focal length share a camera.";
    add_photos: "Add photos…";
    on_to_targets: "Targets";
    opening_photos: "Opening photos";
    being_read: "Being read";
    photo_count(n): "{n} {n:photo|photos}";
    rows_damaged(photo, rows): "Photo {photo}: rows {rows} of the file are damaged and were not measured";
    page_measured(photo, number, of): "Photo {photo}: picture {number} of the {of} in the file is measured, the first of full resolution";
    first_page_measured(photo, of): "Photo {photo}: the file has {of} pictures; the first is measured";
    photo_failed(photo, reason): "Photo {photo}: {reason}";
    no_photo_files: "No photo file is here: drop the photos of this project to work on them.";
    photo_file_missing(file): "The file {file} is not here. Drop it on this page to see it.";
    not_taken: "Not taken";
    duplicate_of(file): "the same content as {file}, which is here already";
    same_name_as(photo): "it has the name of photo {photo} of this project; it is not attached before you choose";
    photos_differ(n, names):
        "{n} {n:file|files} with the name of a photo of this project, but other contents: {names}. Add as new photos, or replace the project's photos and remove what was measured in them?";
    photos_unrecorded(n, names):
        "{n} {n:file|files} with the name and size of measured photos: {names}. The project does not record their contents. Are they the same photos?";
    same_photos: "The same photos";
    add_as_new: "Add as new photos";
    replace_photos: "Replace, remove measurements";
    developed_of(file): "the same shot as {file}, which is measured, on the sensor's own samples";
    raw_of(file): "the same shot as {file}, which is here already; in the RAW file the sensor's own samples are measured";
    measure_raw: "Measure the RAW files instead";
    measure_developed: "Measure the developed photos instead";
    unreadable(detail): "the browser could not read the file: {detail}";
    cameras: "Cameras";
    camera: "Camera";
    camera_named(name): "Camera {name}";
    camera_of_their_own: "a camera of their own";
    picked_photos(n): "{n} {n:photo|photos} chosen";
    take_part: "take part in the adjustment";
    remove_from_project: "Remove from the project";
    make_and_model: "make, model";
    focal_length: "focal length";
    film_equivalent(mm): "{mm} mm on 35 mm film";
    not_in_exif: "not in EXIF";
    name: "name";
    name_taken(name): "The name \"{name}\" is empty or in use: names are unique.";
    not_a_length(typed): "\"{typed}\" is no positive number: type one such as 3.19.";
    not_a_count(typed): "\"{typed}\" is no count: type a whole number such as 5.";
    no_sigma(typed): "\"{typed}\" is no standard error: type a number above 0, or nothing.";
    centre_without_sigma: "An observed projection centre needs a standard error on one axis at least.";
    pixel_pitch: "pixel pitch";
    pitch_um(um): "pitch {um} µm";
    pitch_unknown: "pitch unknown, in pixels";
    pitch_hint: "Without a pixel pitch photo coordinates are in pixels; the object points are the same either way.";
    principal_distance: "principal distance, initial";
    unknown: "unknown";

    // Photo view
    photo_view(photo): "Photo {photo}";
    fit: "Fit";
    loupe: "loupe";
    legend_measured: "measured";
    legend_selected: "selected";
    legend_doubtful: "doubtful";
    legend_excluded: "excluded";
} }
