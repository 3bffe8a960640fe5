//! All items of a document, in the order in which they are shown.

use std::collections::{HashMap, HashSet};

use sightline::adjustment::Advice;
use sightline::orient::Note;
use sightline::project::{DatumKind, Role};

use leptos::prelude::*;

use super::{
    Item, Step, Target, camera_against_photos, grouping, is_correlation, is_said, network_item, of_the_fit,
    of_the_input, systematic,
};
use crate::document::{AdjustmentResult, Document};
use crate::format;
use crate::i18n::{name_list, text};
use crate::store::Desk;
use crate::view::components::units::length_unit;

pub(super) fn items(desk: Desk) -> Vec<Item> {
    let (mut items, adjusted) = desk.document.with(|d| {
        let mut items = Vec::new();
        items.extend(datum_item(d));
        items.extend(observation_items(d));
        if let Some(result) = d.current() {
            let (first, others) = network_items(result, &length_unit(d));
            items.splice(0..0, first);
            items.extend(others);
        }
        (items, d.current().is_some())
    });
    // A note on a point, photo or observation that has an item is left out; of steps there may be several items.
    let one = |target: &Target| matches!(target, Target::Point(_) | Target::Photo(_) | Target::Observation { .. });
    let said = items.iter().map(|i| i.target.clone()).filter(one).collect::<Vec<_>>();
    let notes = desk.processing.notes.with(|notes| desk.document.with(|d| orientation_items(d, notes)));
    items.extend(notes.into_iter().filter(|i| !said.contains(&i.target)));
    items.extend(desk.processing.notes.with(|notes| if adjusted { None } else { more_disagreements(notes) }));
    // Items with the least specific remedy come last.
    desk.document.with(|d| {
        let Some(AdjustmentResult { adjustment: a, .. }) = d.current().map(AsRef::as_ref) else { return };
        items.extend(camera_against_photos(&a.advice, &a.criteria));
        items.extend(grouping::correlations(&a.advice, &a.criteria));
    });
    if items.is_empty() && adjusted {
        items.push(Item {
            warning: false,
            title: text::nothing_lacks().to_owned(),
            body: text::nothing_lacks_body().to_owned(),
            evidence: String::new(),
            target: Target::None,
        });
    }
    items
}

/// Missing constraints of the datum.
fn datum_item(d: &Document) -> Option<Item> {
    let control = d.project.points.iter().filter(|p| p.role == Role::Control && p.xyz.is_some()).count();
    match d.project.datum.kind {
        DatumKind::Control if control < 3 => Some(Item {
            warning: true,
            title: text::lacks_control().to_owned(),
            body: text::lacks_control_body().to_owned(),
            evidence: text::n_control(control),
            target: Target::Step(Step::Control),
        }),
        DatumKind::Free | DatumKind::Minimal if d.project.distances.is_empty() && control < 2 => Some(Item {
            warning: true,
            title: text::lacks_scale().to_owned(),
            body: text::lacks_scale_body().to_owned(),
            evidence: String::new(),
            target: Target::Step(Step::Control),
        }),
        _ => None,
    }
}

/// Tie points observed in one photo only, and photos without observations.
fn observation_items(d: &Document) -> Vec<Item> {
    let mut items = Vec::new();
    // Number of observations of each point with the photo of the first; photos with observations.
    let mut rays = HashMap::<&str, (usize, &str)>::new();
    let mut seeing = HashSet::new();
    for o in d.project.observations.iter().filter(|o| o.enabled) {
        rays.entry(&o.point).or_insert((0, &o.photo)).0 += 1;
        seeing.insert(o.photo.as_str());
    }
    let tie = d.project.points.iter().filter(|p| p.role == Role::Tie);
    let single = tie.filter_map(|p| match rays.get(p.id.as_str()) {
        Some((1, photo)) => Some((p.id.clone(), (*photo).to_owned())),
        _ => None,
    });
    let single = single.collect::<Vec<_>>();
    if let Some((point, photo)) = single.first() {
        items.push(Item {
            warning: true,
            title: text::seen_once(name_list(single.iter().map(|(point, _)| point.as_str()))),
            body: text::seen_once_body(point, photo),
            evidence: text::n_points(single.len()),
            target: Target::Observation { photo: photo.clone(), point: point.clone() },
        });
    }
    let empty = d.project.photos.iter().filter(|p| p.enabled && !seeing.contains(p.id.as_str()));
    let empty = empty.map(|p| p.id.clone()).collect::<Vec<_>>();
    if let Some(photo) = empty.first() {
        items.push(Item {
            warning: true,
            title: text::photo_without_points(name_list(&empty)),
            body: text::photo_without_points_body().to_owned(),
            evidence: text::n_photos(empty.len()),
            target: Target::Photo(photo.clone()),
        });
    }
    items
}

/// Advice of the adjustment: what comes before all other items, and what comes after them.
fn network_items(result: &AdjustmentResult, unit: &str) -> (Vec<Item>, Vec<Item>) {
    let adjustment = &result.adjustment;
    let item = |advice: &Advice| network_item(advice, &adjustment.criteria, unit);
    // Faults of the input spoil everything else and come first; the missing scale has an item already.
    let (input, rest): (Vec<_>, Vec<_>) = adjustment.advice.iter().partition(|a| of_the_input(a));
    let first = input.into_iter().filter(|a| !matches!(a, Advice::NoScale)).map(item).collect();
    let (fit, others): (Vec<_>, Vec<_>) = rest.into_iter().partition(|a| of_the_fit(a));
    let fit = fit.into_iter().filter(|a| !grouping::is_one_of_several(a, &adjustment.advice));
    let mut then: Vec<Item> = fit.map(|advice| systematic::with_tested(item(advice), advice, adjustment)).collect();
    then.extend(grouping::insignificant(&adjustment.advice));
    then.extend(others.into_iter().filter(|a| !is_correlation(a)).map(item));
    (first, then)
}

/// Disagreeing measurements of which notes are shown.
const DISAGREEING: usize = 5;

fn disagrees(note: &Note) -> bool {
    matches!(note, Note::MeasurementDisagrees { .. })
}

/// Notes of the orientation.
fn orientation_items(d: &Document, notes: &[Note]) -> Vec<Item> {
    let result = d.current();
    let advice = result.map(|r| r.adjustment.advice.as_slice()).unwrap_or_default();
    // The tests of a result find disagreeing measurements themselves.
    let most = if result.is_some() { 0 } else { DISAGREEING };
    let others = notes.iter().filter(|n| !disagrees(n) && !is_said(n, advice));
    let disagreeing = notes.iter().filter(|n| disagrees(n)).take(most);
    grouping::note_items(others.chain(disagreeing), &length_unit(d))
}

/// How many disagreeing measurements have no note of their own.
fn more_disagreements(notes: &[Note]) -> Option<Item> {
    let more = notes.iter().filter(|n| disagrees(n)).count().saturating_sub(DISAGREEING);
    (more > 0).then(|| Item {
        warning: true,
        title: text::more_notes(format::count(more)),
        body: text::measurement_disagrees_body().to_owned(),
        evidence: String::new(),
        target: Target::Step(Step::Identities),
    })
}
