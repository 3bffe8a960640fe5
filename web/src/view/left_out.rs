//! Data that were not used in the adjustment: one line for the results, and the list with reasons and sizes.

use leptos::prelude::*;
use sightline::adjustment::{LeftOutBy, LeftOutItem, LeftOutKind, LeftOutReason};
use sightline::project::{Project, Role};

use crate::format;
use crate::i18n::text;
use crate::store::{Desk, Step};
use crate::view::components::given::follow;
use crate::view::components::given::given_name;
use crate::view::components::units::length_unit;

/// A coordinate of a control point or of a projection centre, rather than all of it.
fn is_coordinate(item: &LeftOutItem) -> bool {
    item.kind == LeftOutKind::Position || item.kind == LeftOutKind::Control && item.given.is_some()
}

/// So many are named in the sentence.
const NAMED: usize = 3;

/// The names of what was observed, where they are few enough for a sentence.
fn named(items: &[LeftOutItem], kind: LeftOutKind) -> String {
    let all: Vec<_> = items.iter().filter(|item| item.kind == kind && !is_coordinate(item)).collect();
    let name = |item: &&LeftOutItem| match (&item.given, &item.point, &item.photo) {
        (Some(given), ..) => given_name(given),
        (None, Some(point), Some(photo)) => format!("{point} – {photo}"),
        (None, point, photo) => point.clone().or_else(|| photo.clone()).unwrap_or_default(),
    };
    match all.len() {
        1..=NAMED => format!(" ({})", all.iter().map(name).collect::<Vec<_>>().join(", ")),
        _ => String::new(),
    }
}

/// How much of items that were not used, in one sentence; `None` if everything did.
fn sentence(items: &[LeftOutItem], project: &Project) -> Option<String> {
    if items.is_empty() {
        return None;
    }
    let number = |kind| items.iter().filter(|item| item.kind == kind && !is_coordinate(item)).count();
    let control = project.points.iter().filter(|p| p.role == Role::Control && p.xyz.is_some()).count();
    let distances = project.distances.iter().filter(|d| !d.check).count();
    let of = |kind, all: usize, words: fn(String, String) -> String| {
        let n = number(kind);
        (n > 0).then(|| words(format::count(n), format::count(all)) + &named(items, kind))
    };
    let alone = |n: usize, words: fn(String) -> String| (n > 0).then(|| words(format::count(n)));
    let parts = [
        of(LeftOutKind::Observation, project.observations.len(), text::left_of_observations),
        of(LeftOutKind::Control, control, text::left_of_control),
        alone(items.iter().filter(|item| is_coordinate(item)).count(), text::left_of_coordinates),
        of(LeftOutKind::Distance, distances, text::left_of_distances),
        of(LeftOutKind::Photo, project.photos.len(), text::left_of_photos),
        of(LeftOutKind::Point, project.points.len(), text::left_of_points),
        alone(number(LeftOutKind::Parameter), text::left_of_parameters),
    ];
    Some(text::not_used(parts.into_iter().flatten().collect::<Vec<_>>().join(", ")))
}

/// The line beside sigma0; nothing is shown where everything took part.
#[component]
pub fn NotUsed() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let said = Memo::new(move |_| {
        desk.document.with(|d| d.current().and_then(|r| sentence(&r.adjustment.left_out, &r.input)))
    });
    move || {
        said.get().map(|said| {
            view! {
                <p class="not-used" role="status" data-result="not-used">
                    <span>{said}</span>
                    <button class="link" on:click=move |_| desk.go(Step::Adjust)>{text::show_not_used}</button>
                </p>
            }
        })
    }
}

/// The list: what, why, how far off, and what can be done about it.
#[component]
pub fn NotUsedList() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let found = Memo::new(move |_| {
        desk.document.with(|d| {
            let result = d.current()?;
            let items = result.adjustment.left_out.clone();
            sentence(&items, &result.input).map(|said| (items, said))
        })
    });
    let unit = move || desk.document.with(length_unit);
    view! {
        {move || found.get().map(|(items, said)| view! {
            <h2 class="section-head"><span>{text::not_used_head}</span><span class="aside">{items.len()}</span></h2>
            <p class="note">{said}</p>
            <table class="table not-used-list">
                <thead><tr>
                    <th class="left">{text::id}</th><th class="left">{text::photo_or_kind}</th><th class="left">{text::left_out_reason}</th>
                    <th>"px"</th><th>{unit}</th><th>"σ"</th><td class="left"></td>
                </tr></thead>
                <tbody>{items.into_iter().map(|item| view! { <Row item/> }).collect_view()}</tbody>
            </table>
        })}
    }
}

#[component]
fn Row(item: LeftOutItem) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let name = match (&item.given, &item.point, &item.photo) {
        (Some(given), ..) => given_name(given),
        (None, Some(name), _) | (None, None, Some(name)) => name.clone(),
        (None, None, None) => String::new(),
    };
    let label = name.clone();
    let place = match (item.kind, &item.photo) {
        (LeftOutKind::Observation, Some(photo)) => photo.clone(),
        (kind, _) => kind_word(kind).to_owned(),
    };
    let size = item.size.map(|size| format::fixed(size, format::decimals_for(size.abs())));
    let shown = item.clone();
    let show = move |_| {
        let (photo, point) = (shown.photo.clone().unwrap_or_default(), shown.point.clone().unwrap_or_default());
        match (shown.kind, &shown.given) {
            (LeftOutKind::Photo, _) => {
                desk.select_photo(&photo);
                desk.go(Step::Photos);
            }
            (LeftOutKind::Control, None) => {
                desk.select_point(&point);
                desk.go(Step::Control);
            }
            (LeftOutKind::Point, _) => {
                desk.select_point(&point);
                desk.go(Step::Identities);
            }
            (_, given) => follow(desk, &photo, &point, given.as_ref()),
        }
    };
    // Other kinds are taken back where they are mended: at their step.
    let back = match (item.kind, item.photo.clone(), item.point.clone()) {
        (LeftOutKind::Observation, Some(photo), Some(point)) => Some((photo, point)),
        _ => None,
    };
    view! {
        <tr data-left-out=label>
            <td class="left id"><button class="link" title=text::show on:click=show>{name}</button></td>
            <td class="left">{place}</td>
            <td class="left">{reason_word(item.reason)}<small>" " {by_word(item.by)}</small></td>
            <td>{item.size_px.map(|px| format::fixed(px, 2))}</td>
            <td>{size}</td>
            <td>{item.size_sigma.map(|sigma| format::fixed(sigma, 1))}</td>
            <td class="left">{back.map(|(photo, point)| view! {
                <button class="link" on:click=move |_| desk.take_back(&photo, &point)>{text::take_back}</button>
            })}</td>
        </tr>
    }
}

fn kind_word(kind: LeftOutKind) -> &'static str {
    match kind {
        LeftOutKind::Observation => text::image_observation(),
        LeftOutKind::Control => text::control_point_word(),
        LeftOutKind::Distance => text::distance(),
        LeftOutKind::Point => text::object_point_word(),
        LeftOutKind::Photo => text::photo_word(),
        LeftOutKind::Position => text::projection_centre(),
        LeftOutKind::Parameter => text::camera_parameter(),
    }
}

fn by_word(by: LeftOutBy) -> &'static str {
    match by {
        LeftOutBy::Orientation => text::by_orientation(),
        LeftOutBy::Matching => text::by_matching(),
        LeftOutBy::Snooping => text::by_snooping(),
        LeftOutBy::Robust => text::by_robust(),
        LeftOutBy::Document => text::by_document(),
        LeftOutBy::Adjustment => text::by_adjustment(),
    }
}

fn reason_word(reason: LeftOutReason) -> &'static str {
    match reason {
        LeftOutReason::Disagrees => text::out_disagrees(),
        LeftOutReason::PhotoNotOriented => text::out_photo_not_oriented(),
        LeftOutReason::PointNotDetermined => text::out_point_not_determined(),
        LeftOutReason::Undecided => text::out_undecided(),
        LeftOutReason::GrossError => text::out_gross_error(),
        LeftOutReason::Consequence => text::gross_consequence(),
        LeftOutReason::NoWeight => text::out_no_weight(),
        LeftOutReason::Disabled => text::out_disabled(),
        LeftOutReason::PhotoDisabled => text::out_photo_disabled(),
        LeftOutReason::NotMeasured => text::out_not_measured(),
    }
}

#[cfg(test)]
mod tests {
    use sightline::project::Point;

    use super::*;

    fn item(kind: LeftOutKind, photo: Option<&str>, point: Option<&str>) -> LeftOutItem {
        LeftOutItem {
            kind,
            photo: photo.map(str::to_owned),
            point: point.map(str::to_owned),
            given: None,
            by: LeftOutBy::Orientation,
            reason: LeftOutReason::Disagrees,
            size_px: None,
            size: None,
            size_sigma: None,
        }
    }

    #[test]
    fn the_sentence_counts_each_kind_and_is_empty_when_all_took_part() {
        let control = |id: &str| Point { id: id.into(), role: Role::Control, xyz: Some([0.0; 3]), ..Point::default() };
        let project = Project { points: vec![control("1"), control("2")].into(), ..Project::default() };
        assert_eq!(sentence(&[], &project), None);
        let items = [
            item(LeftOutKind::Observation, Some("a"), Some("7")),
            item(LeftOutKind::Observation, Some("b"), Some("7")),
            item(LeftOutKind::Control, None, Some("2")),
        ];
        let said = sentence(&items, &project).expect("a sentence");
        assert!(said.contains("2 of 0 image observations") && said.contains("1 of 2 control points"), "{said}");
        assert!(!said.contains("distances") && !said.contains("photos"), "{said}");
    }
}
