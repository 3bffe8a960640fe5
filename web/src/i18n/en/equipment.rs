//! Texts of equipment that is kept for other projects.

use super::{English, choose};
use crate::i18n::declare;

declare! { equipment {
    equipment: "Equipment";
    equipment_words: "Calibrated cameras and certified scale bars, kept on this computer and in a file, offered where photos show them.";
    sentence(cameras, calibrations, bars):
        "{cameras} {cameras:camera|cameras} with {calibrations} {calibrations:calibration|calibrations}, {bars} scale {bars:bar|bars}.";
    import_file: "Import a file";
    export_file: "Save as a file";
    kept_cameras: "Cameras";
    kept_bars: "Scale bars";
    no_cameras: "No camera is kept yet. After an adjustment that estimates a camera, keep its calibration below.";
    no_bars: "No scale bar is kept yet. Type what its certificate says: where both ends are coded and seen in two photos, the bar gives its distance by itself.";
    of_this_result: "Of the present result";
    keep_calibration: "Keep this calibration";
    calibration_kept(camera): "The calibration of {camera} is kept on this computer.";
    calibrated_on(date): "calibrated on {date}";
    remove_camera(camera): "Remove the camera {camera}";
    remove_calibration(date): "Remove the calibration of {date}";
    remove_bar(bar): "Remove the scale bar {bar}";
    removed: "Removed from what is kept.";
    put_back: "Put back";
    bar_name: "Name";
    certificate: "Certificate";
    date: "Date";
    date_hint: "2026-05-01";
    keep_bar: "Keep the bar";
    not_kept: "The equipment could not be written to this browser's storage: save it as a file.";
    imported(file, cameras, calibrations, bars):
        "{file}: {cameras} new {cameras:camera|cameras}, {calibrations} {calibrations:calibration|calibrations}, {bars} scale {bars:bar|bars} taken in.";
    known_camera(name, date): "Known camera: {name}, calibrated on {date}. Take it";
    held: "held";
    held_means: "Every parameter stays as it was calibrated.";
    observed: "observed";
    observed_means: "Every parameter is observed with the standard error of its calibration.";
    free: "free";
    free_means: "Every parameter begins as it was calibrated and is estimated.";
    bars_seen(bars): "Scale bars seen in the photos: {bars}.";
    take_bars: "Take their distances";
    bars_taken(bars): "Scale bars seen in the photos gave their distances: {bars}.";
    with_colours(colours): "with differences for {colours}";
    change_calibration(camera): "calibration of {camera} taken";
    change_bars(n): "{n} {n:distance|distances} from scale bars";
} }
