//! Warnings and advice as sentences: remedy, reason, and the number behind it.

mod grouping;
mod notes;
mod questions;
mod systematic;
mod verdict;

use std::collections::{HashMap, HashSet};

use leptos::prelude::*;
use sightline::adjustment::{Exchange, Given};
use sightline::orient::Note;
use sightline::project::{DatumKind, Parameter, Role};

use super::adjust::parameter_name;
use super::icon::{Glyph, Icon};
use super::results::units::length_unit;
use super::results::{given_kind, given_name};
use super::shell::step_label;
use crate::format;
use crate::i18n::{systematic as words, text};
use crate::store::document::Outcome;
use crate::store::{Desk, Step, axes_here};

use notes::{is_said, note_item};
pub use verdict::VerdictLine;

/// What to go to for more.
#[derive(Clone, Debug, PartialEq)]
enum Target {
    None,
    Point(String),
    Observation {
        photo: String,
        point: String,
    },
    Photo(String),
    /// Where it can be mended.
    Step(Step),
    Hold {
        camera: String,
        parameter: Parameter,
    },
    /// Estimates parameters that are held.
    Estimate {
        camera: String,
        parameters: Vec<Parameter>,
    },
    /// Exchanges axes of everything given; which of several it was is the person's to say.
    Exchange(Vec<Exchange>),
    /// Takes the standard errors as they were given, and adjusts again.
    GivenWeights,
    /// Weighs image coordinates with this standard deviation of what is not modelled, pixels.
    Unmodelled(f64),
}

impl Target {
    /// Labels of buttons with what each goes to: one, or one for each exchange of axes that may have been meant.
    fn buttons(&self) -> Vec<(String, Self)> {
        let label = match self {
            Self::None => return Vec::new(),
            Self::Exchange(all) => {
                let one = |exchange: &Exchange| {
                    (text::exchange_now(questions::exchange_name(*exchange)), Self::Exchange(vec![*exchange]))
                };
                return all.iter().map(one).collect();
            }
            Self::Step(step) => step_label(*step).to_owned(),
            Self::Unmodelled(px) => text::add_unmodelled(format::fixed(*px, 3)),
            Self::GivenWeights => text::given_weights().to_owned(),
            Self::Estimate { parameters, .. } => words::estimate_now(systematic::names(parameters)),
            Self::Hold { parameter, .. } => text::hold(parameter_name(*parameter)),
            _ => text::show().to_owned(),
        };
        vec![(label, self.clone())]
    }
}

#[derive(Clone, Debug, PartialEq)]
struct Item {
    warning: bool,
    title: String,
    body: String,
    evidence: String,
    target: Target,
}

#[component]
pub fn Advice() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let items = Memo::new(move |_| items(desk));
    view! {
        <h2 class="section-head"><span>{text::what_lacks}</span></h2>
        <ul class="advice">
            {move || items.get().into_iter().map(|item| {
                let buttons = item.target.buttons().into_iter().map(|(label, target)| {
                    view! { <button class="link" on:click=move |_| follow(desk, &target)>{label}</button> }
                });
                let buttons = buttons.collect_view();
                view! {
                    <li class:warning=item.warning>
                        <Glyph icon=if item.warning { Icon::Warning } else { Icon::Check }/>
                        <div>
                            <b>{item.title}</b>
                            <p>{item.body}</p>
                            {buttons}
                        </div>
                        <span class="evidence">{item.evidence}</span>
                    </li>
                }
            }).collect_view()}
        </ul>
    }
}

/// What contradicts the photos, a line each beside sigma0, which may not show it.
#[component]
pub fn Contradictions() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let found = Memo::new(move |_| {
        let mut found = desk.document.with(|d| {
            let Some(result) = d.current() else { return Vec::new() };
            let advice = result.adjustment.advice.iter().filter(|advice| advice.contradicts());
            advice.map(|advice| network_item(advice, &result.adjustment.criteria, &length_unit(d))).collect::<Vec<_>>()
        });
        let said = desk.document.with(|d| d.current().map(|r| (r.adjustment.advice.clone(), length_unit(d))));
        if let Some((said, unit)) = said {
            desk.notes.with(|all| {
                let new = all.iter().filter(|note| note.contradicts() && !is_said(note, &said));
                found.extend(new.filter_map(|note| note_item(note, &unit)));
            });
        }
        let mut said = HashSet::new();
        found.retain(|item| said.insert(item.title.clone()));
        found
    });
    move || {
        let items = found.get();
        let show = move |_| desk.go(Step::Adjust);
        (!items.is_empty()).then(|| {
            view! {
                <ul class="contradictions" role="alert">
                    {items.into_iter().map(|item| view! {
                        <li>
                            <Glyph icon=Icon::Warning/>
                            <b>{item.title}</b>
                            <span class="evidence">{item.evidence}</span>
                            <button class="link" on:click=show>{text::show}</button>
                        </li>
                    }).collect_view()}
                </ul>
            }
        })
    }
}

fn follow(desk: Desk, target: &Target) {
    match target {
        Target::None => {}
        Target::Step(step) => desk.go(*step),
        Target::Point(point) => {
            desk.select_point(point);
            desk.go(Step::Identities);
        }
        Target::Observation { photo, point } => {
            desk.select_observation(photo, point);
            desk.go(Step::Identities);
        }
        Target::Photo(photo) => {
            desk.select_photo(photo);
            desk.go(Step::Identities);
        }
        Target::Unmodelled(px) => {
            desk.set_options(|options| options.unmodelled = *px);
            desk.adjust();
        }
        Target::Exchange(all) => all.iter().take(1).for_each(|exchange| desk.exchange_axes(*exchange)),
        Target::GivenWeights => {
            desk.set_options(|options| options.variance_components = None);
            desk.adjust();
        }
        Target::Estimate { camera, parameters } => {
            parameters.iter().for_each(|p| desk.set_free(camera, *p, true));
            desk.adjust();
        }
        Target::Hold { camera, parameter } => {
            desk.set_free(camera, *parameter, false);
            desk.adjust();
        }
    }
}

fn items(desk: Desk) -> Vec<Item> {
    let mut items = Vec::new();
    desk.document.with(|d| {
        let control = d.project.points.iter().filter(|p| p.role == Role::Control && p.xyz.is_some()).count();
        match d.project.datum.kind {
            DatumKind::Control if control < 3 => items.push(Item {
                warning: true,
                title: text::lacks_control().to_owned(),
                body: text::lacks_control_body().to_owned(),
                evidence: text::n_control(control),
                target: Target::Step(Step::Control),
            }),
            DatumKind::Free | DatumKind::Minimal if d.project.distances.is_empty() && control < 2 => items.push(Item {
                warning: true,
                title: text::lacks_scale().to_owned(),
                body: text::lacks_scale_body().to_owned(),
                evidence: String::new(),
                target: Target::Step(Step::Control),
            }),
            _ => {}
        }
        // How often each point is seen, and in which photo first; the photos in which something is.
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
                title: text::seen_once(listed(single.iter().map(|(point, _)| point.as_str()))),
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
                title: text::photo_without_points(listed(empty.iter().map(String::as_str))),
                body: text::photo_without_points_body().to_owned(),
                evidence: text::n_photos(empty.len()),
                target: Target::Photo(photo.clone()),
            });
        }
        if let Some(result) = d.current() {
            let adjustment = &result.adjustment;
            let unit = length_unit(d);
            // What spoils everything else comes first; the scale is told above.
            let (spoils, rest): (Vec<_>, Vec<_>) = adjustment.advice.iter().partition(|a| of_the_input(a));
            let spoils = spoils.into_iter().filter(|a| !matches!(a, sightline::adjustment::Advice::NoScale));
            items.splice(0..0, spoils.map(|advice| network_item(advice, &adjustment.criteria, &unit)));
            let (first, others): (Vec<_>, Vec<_>) = rest.into_iter().partition(|a| of_the_fit(a));
            let first = first.into_iter().filter(|a| !grouping::is_one_of_several(a, &adjustment.advice));
            let with_tested =
                |advice| systematic::with_tested(network_item(advice, &adjustment.criteria, &unit), advice, adjustment);
            items.extend(first.map(with_tested));
            items.extend(grouping::insignificant(&adjustment.advice));
            let others = others.into_iter().filter(|a| !is_correlation(a));
            items.extend(others.map(|advice| network_item(advice, &adjustment.criteria, &unit)));
        }
    });
    // What is said of a point, a photo or a measurement is said once; a step can mend several things.
    let one = |target: &Target| matches!(target, Target::Point(_) | Target::Photo(_) | Target::Observation { .. });
    let said = items.iter().map(|i| i.target.clone()).filter(one).collect::<Vec<_>>();
    let adjusted = desk.document.with(|d| d.current().is_some());
    let advised = desk.document.with(|d| d.current().map(|r| r.adjustment.advice.clone()).unwrap_or_default());
    let unit = desk.document.with(length_unit);
    desk.notes.with(|notes| {
        // Once there is a result its own test says what disagrees.
        let disagrees = |n: &&Note| matches!(n, Note::MeasurementDisagrees { .. });
        let others = notes.iter().filter(|n| !disagrees(n) && !is_said(n, &advised));
        let disagreeing = notes.iter().filter(disagrees).take(if adjusted { 0 } else { 5 });
        let new = grouping::note_items(others.chain(disagreeing), &unit);
        items.extend(new.into_iter().filter(|i| !said.contains(&i.target)));
        let more = notes.iter().filter(disagrees).count().saturating_sub(5);
        if more > 0 && !adjusted {
            let title = text::more_notes(format::count(more));
            let body = text::measurement_disagrees_body().to_owned();
            let target = Target::Step(Step::Identities);
            items.push(Item { warning: true, title, body, evidence: String::new(), target });
        }
    });
    // What says the least of what to do comes last.
    desk.document.with(|d| {
        let Some(Outcome { adjustment: a, .. }) = d.current().map(AsRef::as_ref) else { return };
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

fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let all = names.collect::<Vec<_>>();
    let shown = all.iter().take(8).copied().collect::<Vec<_>>().join(", ");
    if all.len() > 8 { format!("{shown}, …") } else { shown }
}

/// Whether it asks about the input.
fn of_the_input(advice: &sightline::adjustment::Advice) -> bool {
    use sightline::adjustment::Advice as A;
    matches!(
        advice,
        A::MirroredControl(_)
            | A::UndecidedAxes(_)
            | A::UnitRatio(_)
            | A::OneStation(_)
            | A::ImplausibleCamera(_)
            | A::NoScale
    )
}

/// Whether it says what is wrong with the fit, rather than what the network is weak in.
fn of_the_fit(advice: &sightline::adjustment::Advice) -> bool {
    use sightline::adjustment::Advice as A;
    matches!(
        advice,
        A::ResidualPattern { .. }
            | A::SigmasTooSmall { .. }
            | A::UnmodelledAgain { .. }
            | A::Insignificant { .. }
            | A::Suspected { .. }
    )
}

/// Where an observation of another kind than image coordinates was given.
fn step_of(what: &Given) -> Target {
    match what {
        Given::Parameter { .. } => Target::Step(Step::Photos),
        _ => Target::Step(Step::Control),
    }
}

/// A standard deviation of what is not modelled as it is taken over: to a thousandth of a pixel.
fn unmodelled(px: f64) -> Target {
    Target::Unmodelled((px * 1000.0).round() / 1000.0)
}

/// Whether it is a correlation: these are told as one item a camera.
fn is_correlation(advice: &sightline::adjustment::Advice) -> bool {
    matches!(advice, sightline::adjustment::Advice::HighCorrelation { .. })
}

fn correlated_name(name: &str) -> String {
    name.parse::<Parameter>().map_or_else(|_| name.to_owned(), |p| parameter_name(p).to_owned())
}

/// Correlations of camera parameters with elements of photos, as one item. Angles of one photo among themselves are left
/// out: they say how it is turned to the axes, not what the network lacks.
fn camera_against_photos(
    advice: &[sightline::adjustment::Advice],
    criteria: &sightline::adjustment::Criteria,
) -> Option<Item> {
    use sightline::adjustment::Advice;
    let mut photos = Vec::new();
    let mut strongest: Option<(f64, String)> = None;
    for advice in advice {
        let Advice::HighCorrelation { photo: Some(photo), first, second, correlation, .. } = advice else { continue };
        if [first, second].iter().all(|name| name.parse::<Parameter>().is_err()) {
            continue;
        }
        if !photos.contains(photo) {
            photos.push(photo.clone());
        }
        if strongest.as_ref().is_none_or(|(r, _)| correlation.abs() > r.abs()) {
            strongest = Some((*correlation, format!("{} – {}", correlated_name(first), correlated_name(second))));
        }
    }
    let (r, pair) = strongest?;
    Some(Item {
        warning: true,
        title: text::camera_against_photos(photos.len()),
        body: text::camera_against_photos_body(
            format::fixed(criteria.high_correlation, 2),
            listed(photos.iter().map(String::as_str)),
        ),
        evidence: format!("{pair} {}", format::fixed(r, 2)),
        target: photos.first().map_or(Target::None, |photo| Target::Photo(photo.clone())),
    })
}

/// What the engine says of a network that is solvable but weak.
fn network_item(
    advice: &sightline::adjustment::Advice,
    criteria: &sightline::adjustment::Criteria,
    unit: &str,
) -> Item {
    use sightline::adjustment::Advice;
    let pairs = |pairs: &[(String, String)]| {
        let names: Vec<String> = pairs.iter().map(|(a, b)| format!("{a} – {b}")).collect();
        listed(names.iter().map(String::as_str))
    };
    let observation = |all: &[(String, String)]| {
        all.first()
            .map_or(Target::None, |(photo, point)| Target::Observation { photo: photo.clone(), point: point.clone() })
    };
    let (title, body, evidence, target) = match advice {
        Advice::HighCorrelation { camera, first, second, correlation, .. } => {
            let title = text::correlated(correlated_name(first), correlated_name(second));
            // The later of the two is the finer one, and held at less cost.
            let parameter = second.parse::<Parameter>().or_else(|_| first.parse::<Parameter>());
            let hold = |parameter| Target::Hold { camera: camera.clone(), parameter };
            let target = parameter.map_or(Target::Step(Step::Photos), hold);
            (title, text::correlated_body(camera), format::fixed(*correlation, 2), target)
        }
        Advice::LowRedundancy { observations, given } => {
            let title = text::low_redundancy(observations.len() + given.len());
            // What is given by hand first: there a wrong number is easiest to look up.
            let names = given.iter().map(|what| format!("{} {}", given_kind(what), given_name(what)));
            let names: Vec<String> = names.chain(observations.iter().map(|(a, b)| format!("{a} – {b}"))).collect();
            let body = text::low_redundancy_body(listed(names.iter().map(String::as_str)));
            let target = given.first().map_or_else(|| observation(observations), step_of);
            (title, body, format!("r < {}", format::round(criteria.low_redundancy)), target)
        }
        Advice::TwoRays { points } => (
            text::two_rays(listed(points.iter().map(String::as_str))),
            text::two_rays_body().to_owned(),
            text::n_points(points.len()),
            points.first().map_or(Target::None, |point| Target::Point(point.clone())),
        ),
        Advice::NarrowIntersection { points } => (
            text::narrow(listed(points.iter().map(|(point, _)| point.as_str()))),
            text::narrow_body().to_owned(),
            points.first().map(|(_, angle)| format!("{}°", format::fixed(angle.to_degrees(), 1))).unwrap_or_default(),
            points.first().map_or(Target::None, |(point, _)| Target::Point(point.clone())),
        ),
        Advice::BehindCamera { observations } => (
            text::behind_camera(pairs(observations)),
            text::behind_camera_body().to_owned(),
            String::new(),
            observation(observations),
        ),
        Advice::DistanceUnused { distances } => (
            text::distance_unused(pairs(distances)),
            text::distance_unused_body().to_owned(),
            String::new(),
            Target::Step(Step::Control),
        ),
        Advice::ResidualPattern { camera, pattern, photos, p_value, max_px, sigma0, remedy, .. } => {
            return systematic::told(camera, (*pattern, photos), [*max_px, *p_value, *sigma0], remedy);
        }
        Advice::SigmasTooSmall { sigma0, unmodelled: px } => (
            text::sigmas_optimistic(format::fixed(*sigma0, 1)),
            text::sigmas_optimistic_body().to_owned(),
            format!("σ₀ {}", format::fixed(*sigma0, 3)),
            px.map_or(Target::Step(Step::Results), unmodelled),
        ),
        Advice::UnmodelledAgain { sigma0, unmodelled: px } => (
            text::unmodelled_again().to_owned(),
            text::unmodelled_again_body().to_owned(),
            format!("σ₀ {}", format::fixed(*sigma0, 3)),
            unmodelled(*px),
        ),
        Advice::Insignificant { camera, parameter, ratio, with, correlation, .. } => {
            let (name, ratio) = (parameter_name(*parameter), format::fixed(*ratio, 1));
            let with = with.map(parameter_name).zip(*correlation);
            let body = match with {
                Some((other, _)) => text::hold_or_more_body(name, ratio, other),
                None => text::hold_alone_body(name, ratio),
            };
            let evidence = with.map(|(other, r)| format!("{other} {}", format::fixed(r, 2))).unwrap_or_default();
            let target = Target::Hold { camera: camera.clone(), parameter: *parameter };
            (text::hold_or_more(name, camera), body, evidence, target)
        }
        Advice::Suspected { count, observations, given } => {
            let largest = |w: Option<f64>| w.map_or(0.0, f64::abs);
            let (image, other) = (observations.first(), given.first());
            let (of_image, of_other) = (largest(image.map(|o| o.2)), largest(other.map(|g| g.1)));
            let (title, target) = match (image, other) {
                (Some((photo, point, _)), _) if of_image >= of_other => {
                    (text::look_at(point, photo), Target::Observation { photo: photo.clone(), point: point.clone() })
                }
                (_, Some((what, _))) => (text::look_at_given(given_kind(what), given_name(what)), step_of(what)),
                _ => (String::new(), Target::None),
            };
            let limits = (format::fixed(criteria.w, 2), format::round(100.0 * criteria.alpha));
            let body = text::look_at_body(format::count(*count), limits.0, limits.1);
            (title, body, format!("|w| {}", format::fixed(of_image.max(of_other), 2)), target)
        }
        Advice::GrossErrorsUnsettled => {
            let target = Target::Step(Step::Identities);
            (text::unsettled().to_owned(), text::unsettled_body().to_owned(), String::new(), target)
        }
        Advice::WeakPrincipalDistance { camera, parameter, value, sigma, convergence, .. } => (
            text::weak_distance(camera, parameter),
            if convergence.to_degrees() < 20.0 {
                text::weak_distance_parallel().to_owned()
            } else {
                text::weak_distance_body().to_owned()
            },
            format!("{} ± {}", format::fixed(*value, 2), format::fixed(*sigma, 2)),
            parameter
                .parse()
                .map_or(Target::Step(Step::Photos), |parameter| Target::Hold { camera: camera.clone(), parameter }),
        ),
        Advice::VarianceComponentsUnsettled => (
            text::components_unsettled().to_owned(),
            text::components_unsettled_body().to_owned(),
            String::new(),
            Target::GivenWeights,
        ),
        Advice::ControlMisfit { point, difference, sigma_ratio } => {
            control_misfit(point, difference, *sigma_ratio, unit)
        }
        Advice::ExchangedPoints { points } => exchanged_points(points),
        Advice::DoublePoints { pairs: all } => double_points(all),
        Advice::MirroredControl(found) => return questions::mirrored(found),
        Advice::UndecidedAxes(found) => return questions::undecided(found),
        Advice::UnitRatio(found) => return questions::unit(found),
        Advice::OneStation(found) => return questions::station(found),
        Advice::ImplausibleCamera(found) => return questions::camera(found),
        Advice::NoScale => {
            let target = Target::Step(Step::Control);
            (text::lacks_scale().to_owned(), text::lacks_scale_body().to_owned(), String::new(), target)
        }
    };
    Item { warning: true, title, body, evidence, target }
}

type Words = (String, String, String, Target);

/// A control point that is not where the photos see it.
fn control_misfit(point: &str, difference: &[f64; 3], sigma_ratio: f64, unit: &str) -> Words {
    let largest = (0..3).max_by(|&a, &b| difference[a].abs().total_cmp(&difference[b].abs())).unwrap_or_default();
    let size = difference[0].hypot(difference[1]).hypot(difference[2]);
    (
        text::control_misfit(point, format!("{} {unit}", format::compact(size)), axes_here().letter(largest)),
        text::control_misfit_body().to_owned(),
        format!("{} σ", format::fixed(sigma_ratio, 0)),
        Target::Step(Step::Control),
    )
}

/// Two control points that seem exchanged.
fn exchanged_points([a, b]: &[String; 2]) -> Words {
    let body = text::exchanged_points_body().to_owned();
    (text::exchanged_points(a, b), body, String::new(), Target::Step(Step::Control))
}

/// Points that may be one.
fn double_points(pairs: &[(String, String)]) -> Words {
    let names: Vec<String> = pairs.iter().map(|(a, b)| format!("{a} – {b}")).collect();
    let target = pairs.first().map_or(Target::None, |(_, point)| Target::Point(point.clone()));
    let title = text::double_points(listed(names.iter().map(String::as_str)));
    (title, text::double_points_body().to_owned(), format::count(pairs.len()), target)
}

#[cfg(test)]
mod tests;
