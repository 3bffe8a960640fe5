//! Warnings and advice as sentences: remedy, reason, and the number behind it.

mod grouping;
mod items;
mod notes;
mod questions;
mod systematic;
mod verdict;

use std::collections::HashSet;

use leptos::prelude::*;
use sightline::adjustment::{Exchange, Given};
use sightline::project::Parameter;

use super::components::icon::{Glyph, Icon};
use crate::format;
use crate::i18n::{name_list, systematic as words, text};
use crate::store::{Desk, Step, axes_here};
use crate::view::components::given::given_kind;
use crate::view::components::given::given_name;
use crate::view::components::parameters::parameter_name;
use crate::view::components::title::step_label;
use crate::view::components::units::length_unit;

use items::items;
use notes::{is_said, note_item};
pub use verdict::VerdictLine;

/// Link to more information.
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
    /// Exchanges the axes of all given values; the user chooses among several exchanges.
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

/// Contradictions between photos and given values, one line each beside sigma0, which may not show them.
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
            desk.processing.notes.with(|all| {
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

/// Whether it concerns the fit rather than a weakness of the network.
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

/// Whether it is a correlation: these are shown as one item per camera.
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
        body: text::camera_against_photos_body(format::fixed(criteria.high_correlation, 2), name_list(&photos)),
        evidence: format!("{pair} {}", format::fixed(r, 2)),
        target: photos.first().map_or(Target::None, |photo| Target::Photo(photo.clone())),
    })
}

/// The engine's advice on a network that is solvable but weak.
fn network_item(
    advice: &sightline::adjustment::Advice,
    criteria: &sightline::adjustment::Criteria,
    unit: &str,
) -> Item {
    use sightline::adjustment::Advice;
    let pairs = |pairs: &[(String, String)]| {
        let names: Vec<String> = pairs.iter().map(|(a, b)| format!("{a} – {b}")).collect();
        name_list(names)
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
            let body = text::low_redundancy_body(name_list(names));
            let target = given.first().map_or_else(|| observation(observations), step_of);
            (title, body, format!("r < {}", format::round(criteria.low_redundancy)), target)
        }
        Advice::TwoRays { points } => (
            text::two_rays(name_list(points)),
            text::two_rays_body().to_owned(),
            text::n_points(points.len()),
            points.first().map_or(Target::None, |point| Target::Point(point.clone())),
        ),
        Advice::NarrowIntersection { points } => (
            text::narrow(name_list(points.iter().map(|(point, _)| point.as_str()))),
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
            return systematic::sentences(camera, (*pattern, photos), [*max_px, *p_value, *sigma0], remedy);
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

type ItemText = (String, String, String, Target);

/// A control point that is not where the photos see it.
fn control_misfit(point: &str, difference: &[f64; 3], sigma_ratio: f64, unit: &str) -> ItemText {
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
fn exchanged_points([a, b]: &[String; 2]) -> ItemText {
    let body = text::exchanged_points_body().to_owned();
    (text::exchanged_points(a, b), body, String::new(), Target::Step(Step::Control))
}

/// Points that may be one.
fn double_points(pairs: &[(String, String)]) -> ItemText {
    let names: Vec<String> = pairs.iter().map(|(a, b)| format!("{a} – {b}")).collect();
    let target = pairs.first().map_or(Target::None, |(_, point)| Target::Point(point.clone()));
    let title = text::double_points(name_list(names));
    (title, text::double_points_body().to_owned(), format::count(pairs.len()), target)
}

#[cfg(test)]
mod tests;
