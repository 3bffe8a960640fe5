//! Texts of equipment that is kept for other projects.

use super::{English, choose};
use crate::i18n::declare;

declare! { equipment {
    equipment: "Equipment";
    equipment_words: "Calibrated cameras and certified scale bars, stored on this computer or in a file, for use in other projects.";
    sentence(cameras, calibrations, bars):
        "{cameras} {cameras:camera|cameras} with {calibrations} {calibrations:calibration|calibrations}, {bars} scale {bars:bar|bars}.";
    import_file: "Import a file";
    export_file: "Save as a file";
    kept_cameras: "Cameras";
    kept_bars: "Scale bars";
    no_cameras: "No camera is stored yet. Estimate a camera in an adjustment, then keep its calibration below.";
    no_bars: "No scale bar is stored yet. Enter the values of its certificate. If both ends are coded and seen in two photos, its distance is used without further input.";
    of_this_result: "From the current result";
    keep_calibration: "Keep this calibration";
    calibration_kept(camera): "The calibration of {camera} is stored on this computer.";
    calibrated_on(date): "calibrated on {date}";
    remove_camera(camera): "Remove the camera {camera}";
    remove_calibration(date): "Remove the calibration of {date}";
    remove_bar(bar): "Remove the scale bar {bar}";
    removed: "Removed from the equipment.";
    put_back: "Put back";
    bar_name: "Name";
    certificate: "Certificate";
    date: "Date";
    date_hint: "2026-05-01";
    keep_bar: "Keep the bar";
    not_kept: "The equipment could not be written to this browser's storage: save it as a file.";
    imported(file, cameras, calibrations, bars):
        "{file}: {cameras} new {cameras:camera|cameras}, {calibrations} {calibrations:calibration|calibrations}, {bars} scale {bars:bar|bars} imported.";
    known_camera(name, date): "Known camera: {name}, calibrated on {date}. Use it";
    held: "held";
    held_means: "Every parameter is held at its calibrated value.";
    observed: "observed";
    observed_means: "Every parameter is observed with the standard error of its calibration.";
    free: "free";
    free_means: "Every parameter is estimated, starting from its calibrated value.";
    bars_seen(bars): "Scale bars seen in the photos: {bars}.";
    take_bars: "Add their distances";
    bars_taken(bars): "Distances added from scale bars seen in the photos: {bars}.";
    change_calibration(camera): "calibration of {camera} used";
    change_bars(n): "{n} {n:distance|distances} from scale bars";
} }
