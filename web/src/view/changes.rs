//! What a change did, in words.

use super::tables::table_words;
use crate::i18n::{object as words, text};
use crate::store::document::Change;

pub fn change_words(change: &Change) -> String {
    match change {
        Change::PhotosAdded(n) => text::change_photos_added(n),
        Change::PhotoRemoved(id) => text::change_photo_removed(id),
        Change::PhotoSwitched(id) => text::change_photo_switched(id),
        Change::CameraEdited(id) => text::change_camera_edited(id),
        Change::CameraAssigned { photos, camera } => text::change_camera_assigned(photos, camera),
        Change::TargetsDetected => text::change_detected().to_owned(),
        Change::TargetMeasured(photo) => text::change_measured(photo),
        Change::Named(point) => text::change_named(point),
        Change::Renamed { from, to } => text::change_renamed(from, to),
        Change::Moved { point, photo } => text::change_moved(point, photo),
        Change::ObservationRemoved { point, photo } => text::change_observation_removed(point, photo),
        Change::ObservationSwitched { point, photo } => text::change_observation_switched(point, photo),
        Change::PointRemoved(point) => text::change_point_removed(point),
        Change::MarksTaken(n) => text::change_marks_taken(n),
        Change::Matched(n) => text::change_matched(n),
        Change::ControlTaken(n) => text::change_control_taken(n),
        Change::RoleSet(point) => text::change_role(point),
        Change::ControlEdited(point) => text::change_control_edited(point),
        Change::CentreObserved(photo) => text::change_centre_observed(photo),
        Change::CentreForgotten(photo) => text::change_centre_forgotten(photo),
        Change::DistanceEdited { from, to } => text::change_distance_edited(from, to),
        Change::DistanceAdded { from, to } => text::change_distance_added(from, to),
        Change::DistanceRemoved { from, to } => text::change_distance_removed(from, to),
        Change::DatumChosen => text::change_datum().to_owned(),
        Change::ParametersChosen(camera) => text::change_parameters(camera),
        Change::OptionsChosen => text::change_options().to_owned(),
        Change::Adjusted => text::change_adjusted().to_owned(),
        Change::UnitSet => text::change_unit().to_owned(),
        Change::ReportEdited => text::change_report().to_owned(),
        Change::FeatureMade(id) => words::change_made(id),
        Change::FeatureRemoved(id) => words::change_removed(id),
        Change::FeatureRenamed { from, to } => words::change_renamed(from, to),
        Change::LinesDrawn => words::change_lines().to_owned(),
        Change::Opened => text::change_opened().to_owned(),
        Change::CellsEdited { table, cells } => text::change_cells(cells, table_words(*table)),
        Change::RowsSwitched { table, rows, enabled: false } => text::change_rows_excluded(rows, table_words(*table)),
        Change::RowsSwitched { table, rows, .. } => text::change_rows_restored(rows, table_words(*table)),
        Change::RowsDeleted { table, rows } => text::change_rows_deleted(rows, table_words(*table)),
        Change::RolesSet { points, role } => text::change_roles(points, text::role_word(*role)),
        Change::PointsMerged { points, into } => text::change_merged(points, into),
        Change::PointSplit { point, new } => text::change_split(point, new),
        Change::PointsRenamed(n) => text::change_points_renamed(n),
        Change::CamerasJoined { cameras, into } => text::change_cameras_joined(cameras, into),
        Change::QuestionAnswered { photo } => text::change_question(photo),
    }
}
