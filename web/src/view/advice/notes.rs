//! Notes of the orientation, as advice.

use sightline::orient::{DistanceSource, Note, PhotoReason, PointReason, ScaleSource, SystemSource};

use super::{Item, ItemText, Target, control_misfit, double_points, exchanged_points, questions};
use crate::format;
use crate::i18n::{name_list, text};
use crate::store::Step;

/// Whether the adjustment has the same advice, with more accurate figures.
pub(super) fn is_said(note: &Note, advice: &[sightline::adjustment::Advice]) -> bool {
    use sightline::adjustment::Advice as A;
    advice.iter().any(|advice| match (note, advice) {
        (Note::ControlMisfit { point, .. }, A::ControlMisfit { point: said, .. }) => point == said,
        (Note::ExchangedPoints { points }, A::ExchangedPoints { points: said }) => points == said,
        (Note::UnitRatio(ratio), A::UnitRatio(said)) => (ratio.of, &ratio.camera) == (said.of, &said.camera),
        (Note::ImplausibleCamera(camera), A::ImplausibleCamera(said)) => camera == said,
        (Note::OneStation(station), A::OneStation(said)) => station == said,
        (Note::MirroredControl(_), A::MirroredControl(_))
        | (Note::UndecidedAxes(_), A::UndecidedAxes(_))
        | (Note::DoublePoints { .. }, A::DoublePoints { .. }) => true,
        _ => false,
    })
}

/// Notes of the orientation.
pub(super) fn note_item(note: &Note, unit: &str) -> Option<Item> {
    let item = |title: String, body: String, target: Target| Item {
        warning: true,
        title,
        body,
        evidence: String::new(),
        target,
    };
    let worded = |(title, body, evidence, target): ItemText| Item { warning: true, title, body, evidence, target };
    Some(match note {
        Note::PrincipalDistance { camera, value, source } => Item {
            warning: false,
            title: match source {
                DistanceSource::KnownPoints => text::c_found(camera, format::compact(*value)),
                DistanceSource::Assumed => text::c_assumed(camera, format::compact(*value)),
            },
            body: text::c_body().to_owned(),
            evidence: String::new(),
            target: Target::Step(Step::Photos),
        },
        Note::PrincipalDistanceWeak { camera, value, sigma } => Item {
            evidence: sigma
                .map_or_else(|| text::c_undetermined().to_owned(), |sigma| format!("± {}", format::compact(sigma))),
            ..item(
                text::c_weak(camera, format::compact(*value)),
                text::c_weak_body().to_owned(),
                Target::Step(Step::Photos),
            )
        },
        Note::PrincipalDistanceChanged { camera, value, given } => item(
            text::c_changed(camera, format::compact(*given), format::compact(*value)),
            text::c_changed_body().to_owned(),
            Target::Step(Step::Photos),
        ),
        Note::Groups { groups } => {
            let lists = groups.iter().map(name_list).collect::<Vec<_>>();
            item(
                text::photo_groups(groups.len()),
                text::photo_groups_body(lists.join(" | ")),
                Target::Step(Step::Identities),
            )
        }
        Note::PhotoAmbiguous { photo, rms_px: [taken, other], .. } => Item {
            evidence: format!("{} / {} px", format::fixed(*taken, 2), format::fixed(*other, 2)),
            ..item(text::photo_ambiguous(photo), text::photo_ambiguous_body().to_owned(), Target::Photo(photo.clone()))
        },
        Note::System { source: SystemSource::Own, scale: ScaleSource::Given } => return None,
        Note::System { scale: ScaleSource::Given, .. } => return None,
        Note::System { scale: ScaleSource::Arbitrary, .. } => return None,
        Note::PhotoNotOriented { photo, reason } => {
            let why = match reason {
                PhotoReason::NoPoints => text::photo_no_points().to_owned(),
                PhotoReason::TooFewPoints { determined, needed } => text::photo_too_few(determined, needed),
                PhotoReason::Disagrees { determined } => text::photo_disagrees(determined),
                PhotoReason::OtherGroup { group } => text::photo_other_group(group),
            };
            item(text::photo_not_oriented(photo), why, Target::Photo(photo.clone()))
        }
        Note::PointNotDetermined { point, reason } => {
            let why = match reason {
                PointReason::NotMeasured => text::point_not_measured().to_owned(),
                PointReason::SeenOnce { photo } => text::seen_once_body(point, photo),
                PointReason::TooFewOrientedPhotos { photos } => text::point_too_few(photos),
                PointReason::NearParallel { angle } => text::point_parallel(format::fixed(angle.to_degrees(), 1)),
                PointReason::BehindCamera { photo } => text::point_behind(photo),
                PointReason::RaysDisagree => text::point_disagrees().to_owned(),
                PointReason::CoordinatesMissing => text::point_no_coordinates().to_owned(),
                PointReason::Undecided { first, second } => text::point_undecided(name_list(first), name_list(second)),
            };
            let target = match reason {
                PointReason::SeenOnce { photo } => Target::Observation { photo: photo.clone(), point: point.clone() },
                _ => Target::Point(point.clone()),
            };
            item(text::point_not_determined(point), why, target)
        }
        Note::MeasurementDisagrees { photo, point, distance_px } => {
            let far = distance_px.map_or_else(|| text::behind().to_owned(), |d| format!("{} px", format::fixed(d, 1)));
            let target = Target::Observation { photo: photo.clone(), point: point.clone() };
            Item {
                evidence: far,
                ..item(text::measurement_disagrees(point, photo), text::measurement_disagrees_body().to_owned(), target)
            }
        }
        Note::ControlMisfit { point, difference, sigma_ratio } => {
            worded(control_misfit(point, difference, *sigma_ratio, unit))
        }
        Note::ExchangedPoints { points } => worded(exchanged_points(points)),
        Note::DoublePoints { pairs } => worded(double_points(pairs)),
        Note::MirroredControl(found) => questions::mirrored(found),
        Note::UndecidedAxes(found) => questions::undecided(found),
        Note::UnitRatio(found) => questions::unit(found),
        Note::OneStation(found) => questions::station(found),
        Note::ImplausibleCamera(found) => questions::camera(found),
        // The document has the value.
        Note::NoScale => return None,
    })
}
