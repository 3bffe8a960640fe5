//! Data that were not used: a line beside sigma0 and a table with sizes.

use std::borrow::Cow;
use std::collections::HashSet;

use crate::context::{Context, listed};
use crate::html::{Html, Table};
use crate::number::{count, decimals_for, fixed, maybe};
use sightline::adjustment::{Advice, LeftOutBy, LeftOutItem, LeftOutKind, LeftOutReason};
use sightline::project::{Role, SetAsideBy, SetAsideReason};

/// So many are named in the summary.
const NAMED: usize = 6;

/// Everything that was not used.
pub struct LeftOut<'a> {
    items: Vec<Cow<'a, LeftOutItem>>,
}

impl<'a> LeftOut<'a> {
    /// What the result lists. Image observations that were not used according to the result but are not listed, since it was made before there was a
    /// list, are taken from the document.
    pub fn of(context: &Context<'a>) -> Self {
        let (project, adjustment) = (context.project, context.adjustment);
        let mut items: Vec<Cow<LeftOutItem>> = adjustment.left_out.iter().map(Cow::Borrowed).collect();
        let pair = |item: &LeftOutItem| Some((item.photo.clone()?, item.point.clone()?));
        let of_images = adjustment.left_out.iter().filter(|item| item.kind == LeftOutKind::Observation);
        let listed: HashSet<(String, String)> = of_images.filter_map(pair).collect();
        for found in adjustment.observations.iter().filter(|found| !found.enabled) {
            if listed.contains(&(found.photo.clone(), found.point.clone())) {
                continue;
            }
            let aside = project.set_aside.iter().find(|s| s.photo == found.photo && s.point == found.point);
            let (by, reason) = match aside {
                Some(aside) => {
                    let by = match aside.by {
                        SetAsideBy::Orientation => LeftOutBy::Orientation,
                        SetAsideBy::Matching => LeftOutBy::Matching,
                    };
                    let reason = match aside.reason {
                        SetAsideReason::Disagrees => LeftOutReason::Disagrees,
                        SetAsideReason::PhotoNotOriented => LeftOutReason::PhotoNotOriented,
                        SetAsideReason::PointNotDetermined => LeftOutReason::PointNotDetermined,
                        SetAsideReason::Undecided => LeftOutReason::Undecided,
                    };
                    (by, reason)
                }
                None => {
                    let removed =
                        adjustment.gross_errors.iter().any(|e| e.photo == found.photo && e.point == found.point);
                    let by_hand = (LeftOutBy::Document, LeftOutReason::Disabled);
                    if removed { (LeftOutBy::Snooping, LeftOutReason::GrossError) } else { by_hand }
                }
            };
            items.push(Cow::Owned(LeftOutItem {
                kind: LeftOutKind::Observation,
                photo: Some(found.photo.clone()),
                point: Some(found.point.clone()),
                given: None,
                by,
                reason,
                size_px: None,
                size: None,
                size_sigma: None,
            }));
        }
        Self { items }
    }

    fn number(&self, kind: LeftOutKind) -> usize {
        self.items.iter().filter(|item| item.kind == kind && !is_coordinate(item)).count()
    }

    /// Whether there is anything.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// How much of what, in one sentence.
    pub fn sentence(&self, context: &Context) -> String {
        let (words, project) = (context.words, context.project);
        if self.is_empty() {
            return words.nothing_left_out().to_owned();
        }
        let control = project.points.iter().filter(|p| p.role == Role::Control && p.xyz.is_some()).count();
        let distances = project.distances.iter().filter(|d| !d.check).count();
        let coordinates = self.items.iter().filter(|item| is_coordinate(item)).count();
        let of =
            |n: usize, of: usize, words: &dyn Fn(&str, &str) -> String| (n > 0).then(|| words(&count(n), &count(of)));
        let parts = [
            of(self.number(LeftOutKind::Observation), project.observations.len(), &|n, of| {
                words.left_of_observations(&n, &of)
            }),
            of(self.number(LeftOutKind::Control), control, &|n, of| words.left_of_control(&n, &of)),
            of(coordinates, coordinates, &|n, _| words.left_of_coordinates(&n)),
            of(self.number(LeftOutKind::Distance), distances, &|n, of| words.left_of_distances(&n, &of)),
            of(self.number(LeftOutKind::Photo), project.photos.len(), &|n, of| words.left_of_photos(&n, &of)),
            of(self.number(LeftOutKind::Point), project.points.len(), &|n, of| words.left_of_points(&n, &of)),
            of(self.number(LeftOutKind::Parameter), 0, &|n, _| words.left_of_parameters(&n)),
        ];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        words.not_used(&parts.join(", "))
    }

    /// The most important items by name: photos, control points and distances, then the largest measurements.
    fn named(&self, context: &Context) -> Vec<String> {
        let is_whole = |item: &&Cow<LeftOutItem>| {
            let kinds = [LeftOutKind::Photo, LeftOutKind::Control, LeftOutKind::Distance];
            kinds.contains(&item.kind) && !is_coordinate(item)
        };
        let whole = self.items.iter().filter(is_whole);
        let whole = whole.map(|item| format!("{} {}", kind(context, item.kind), name(context, item)));
        let mut sized: Vec<&LeftOutItem> =
            self.items.iter().map(|item| &**item).filter(|item| item.size_px.is_some()).collect();
        let size = |item: &LeftOutItem| item.size_sigma.or(item.size_px).unwrap_or_default();
        sized.sort_by(|a, b| size(b).total_cmp(&size(a)));
        let sized = sized.iter().map(|item| {
            let px = context.words.pixels(&fixed(item.size_px.unwrap_or_default(), 1));
            format!("{} ({px})", name(context, item))
        });
        whole.chain(sized).take(NAMED).collect()
    }
}

/// A coordinate of a control point or of a projection centre, rather than all of it.
fn is_coordinate(item: &LeftOutItem) -> bool {
    item.kind == LeftOutKind::Position || item.kind == LeftOutKind::Control && item.given.is_some()
}

/// An item by its names.
fn name(context: &Context, item: &LeftOutItem) -> String {
    match (&item.given, &item.point, &item.photo) {
        (Some(given), ..) => context.given_name(given),
        (None, Some(point), Some(photo)) => format!("{point} – {photo}"),
        (None, Some(name), None) | (None, None, Some(name)) => name.clone(),
        (None, None, None) => String::new(),
    }
}

/// Summary: counts, the most important items by name, and points that may be identical.
pub fn summary(context: &Context, html: &mut Html) {
    let words = context.words;
    let left_out = LeftOut::of(context);
    html.p(&left_out.sentence(context));
    let named = left_out.named(context);
    if !named.is_empty() {
        html.p(&words.left_named(&listed(named.iter().map(String::as_str), NAMED)));
    }
    for advice in &context.adjustment.advice {
        if let Advice::DoublePoints { .. } = advice {
            html.p(&super::network::sentence(context, advice));
        }
    }
}

/// The list.
pub fn write(context: &Context, html: &mut Html) {
    let words = context.words;
    let left_out = LeftOut::of(context);
    html.p(&left_out.sentence(context));
    if left_out.is_empty() {
        return;
    }
    let mut table = Table::new().words(words.kind()).words("").words(words.left_out_by()).words(words.reason());
    table = table.low(words.difference(), "", "px").low(words.difference(), "", context.unit).number("σ");
    for item in &left_out.items {
        let decimals = item.size.map_or(0, |size| decimals_for(size).max(context.decimals.min(6)));
        table.row(vec![
            kind(context, item.kind).to_owned(),
            name(context, item),
            by(context, item.by).to_owned(),
            reason(context, item.reason).to_owned(),
            maybe(item.size_px, 2),
            maybe(item.size, decimals),
            maybe(item.size_sigma, 1),
        ]);
    }
    html.table(table);
}

fn kind(context: &Context, kind: LeftOutKind) -> &'static str {
    let words = context.words;
    match kind {
        LeftOutKind::Observation => words.image_observation(),
        LeftOutKind::Control => words.control_point(),
        LeftOutKind::Distance => words.distance(),
        LeftOutKind::Point => words.point(),
        LeftOutKind::Photo => words.photo(),
        LeftOutKind::Position => words.projection_centre(),
        LeftOutKind::Parameter => words.camera_parameter(),
    }
}

fn by(context: &Context, by: LeftOutBy) -> &'static str {
    let words = context.words;
    match by {
        LeftOutBy::Orientation => words.by_orientation(),
        LeftOutBy::Matching => words.by_matching(),
        LeftOutBy::Snooping => words.by_snooping(),
        LeftOutBy::Robust => words.by_robust(),
        LeftOutBy::Document => words.by_document(),
        LeftOutBy::Adjustment => words.by_adjustment(),
    }
}

fn reason(context: &Context, reason: LeftOutReason) -> &'static str {
    let words = context.words;
    match reason {
        LeftOutReason::Disagrees => words.aside_disagrees(),
        LeftOutReason::PhotoNotOriented => words.aside_photo(),
        LeftOutReason::PointNotDetermined => words.aside_point(),
        LeftOutReason::Undecided => words.aside_undecided(),
        LeftOutReason::GrossError => words.out_gross_error(),
        LeftOutReason::Consequence => words.removed_with(),
        LeftOutReason::NoWeight => words.out_no_weight(),
        LeftOutReason::Disabled => words.aside_by_hand(),
        LeftOutReason::PhotoDisabled => words.out_photo_disabled(),
        LeftOutReason::NotMeasured => words.out_not_measured(),
    }
}
