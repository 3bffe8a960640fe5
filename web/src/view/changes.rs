//! What a change did, in words.

use crate::i18n::{planning, text};
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
        Change::PlanEdited => planning::change_plan().to_owned(),
        Change::StationMoved(id) => planning::change_station_moved(id),
        Change::StationAdded(id) => planning::change_station_added(id),
        Change::StationRemoved(id) => planning::change_station_removed(id),
        Change::PlanMade(n) => planning::change_plan_made(n),
        Change::Opened => text::change_opened().to_owned(),
    }
}
