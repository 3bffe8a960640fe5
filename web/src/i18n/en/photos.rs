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
    being_read: "Reading";
    photo_count(n): "{n} {n:photo|photos}";
    rows_damaged(photo, rows): "Photo {photo}: rows {rows} of the file are damaged and were not measured";
    page_measured(photo, number, of): "Photo {photo}: the file has {of} pictures; picture {number}, the first at full resolution, is measured";
    first_page_measured(photo, of): "Photo {photo}: the file has {of} pictures; the first is measured";
    photo_failed(photo, reason): "Photo {photo}: {reason}";
    no_photo_files: "The photo files are missing. Drop the photos of this project here.";
    photo_file_missing(file): "The file {file} is missing. Drop it on this page to see it.";
    not_taken: "Not added";
    duplicate_of(file): "same content as {file}, which is already in the project";
    same_name_as(photo): "same name as photo {photo} of this project; it is attached only if you choose so";
    photos_differ(n, names):
        "{n} {n:file has|files have} the name of a photo of this project, but other contents: {names}. Add as new photos, or replace the project's photos and delete their measurements?";
    photos_unrecorded(n, names):
        "{n} {n:file has|files have} the name and size of measured photos: {names}. The project does not record their contents. Are they the same photos?";
    same_photos: "The same photos";
    add_as_new: "Add as new photos";
    replace_photos: "Replace, delete measurements";
    developed_of(file): "same exposure as {file}, whose RAW samples are measured";
    raw_of(file): "same exposure as {file}, which is already in the project; measuring the RAW file uses the sensor's own samples";
    measure_raw: "Measure the RAW files instead";
    measure_developed: "Measure the developed photos instead";
    unreadable(detail): "the browser could not read the file: {detail}";
    cameras: "Cameras";
    camera: "Camera";
    camera_named(name): "Camera {name}";
    camera_of_their_own: "a new camera";
    picked_photos(n): "{n} {n:photo|photos} selected";
    take_part: "used in the adjustment";
    remove_from_project: "Remove from the project";
    make_and_model: "make, model";
    focal_length: "focal length";
    film_equivalent(mm): "{mm} mm on 35 mm film";
    not_in_exif: "not in EXIF";
    name: "name";
    name_taken(name): "The name \"{name}\" is empty or in use: names are unique.";
    not_a_length(typed): "\"{typed}\" is not a positive number: type one such as 3.19.";
    not_a_count(typed): "\"{typed}\" is not a count: type a whole number such as 5.";
    no_sigma(typed): "\"{typed}\" is not a standard error: type a number above 0, or nothing.";
    centre_without_sigma: "An observed projection centre needs a standard error on at least one axis.";
    pixel_pitch: "pixel pitch";
    pitch_um(um): "pitch {um} µm";
    pitch_unknown: "pitch unknown, in pixels";
    pitch_hint: "Without a pixel pitch, photo coordinates are in pixels; the object points are the same either way.";
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
