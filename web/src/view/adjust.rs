//! Step 5: unknowns and observations, the iterations, warnings and advice.

use std::collections::HashSet;

use leptos::prelude::*;
use sightline::adjustment::{AdjustedPhoto, NotEstimated, Termination, VarianceComponent, VarianceComponents};
use sightline::project::{Camera, DatumKind, Parameter, Project, Role};
pub use sightline_report::names::{parameter_name, parameter_unit};

use super::advice::Advice;
use super::components::field::Field;
use super::components::icon::{Glyph, Icon};
use super::control::DatumChoice;
use super::estimated::group_name;
use super::gross_errors::{GrossErrorRecord, GrossErrors};
use super::left_out::NotUsedList;
use super::models::{ModelComparison, ModelMenu};
use super::origin::ProjectOrigin;
use super::plots::Convergence;
use crate::browser::event;
use crate::format;
use crate::i18n::{comparing, first, inside, text};
use crate::store::inside::Network;
use crate::store::{Desk, Step};
use crate::view::components::title::TitleBar;

/// First action if no target has a name in two photos.
#[component]
fn NothingToAdjust() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let nothing = Memo::new(move |_| {
        desk.document.with(|d| {
            let mut rays = std::collections::HashMap::<&str, usize>::new();
            d.project.observations.iter().filter(|o| o.enabled).for_each(|o| *rays.entry(&o.point).or_default() += 1);
            rays.values().all(|n| *n < 2)
        })
    });
    view! {
        <Show when=move || nothing.get()>
            <div class="empty-state" data-empty="observations">
                <p>{first::no_observations}</p>
                <button class="button primary" on:click=move |_| desk.go(Step::Identities)>{first::name_points} <Glyph icon=Icon::Arrow/></button>
            </div>
        </Show>
    }
}

#[component]
pub fn Adjust() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sentence = move || {
        desk.document.with(|d| match d.current() {
            Some(r) => {
                let a = &r.adjustment;
                text::adjusted_sentence(
                    format::count(a.observations_count),
                    format::count(a.unknowns),
                    format::count(a.redundancy),
                )
            }
            None => text::adjust_sentence().to_owned(),
        })
    };
    let done = Memo::new(move |_| desk.document.with(|d| d.current().is_some()));
    view! {
        <TitleBar title=text::bundle_adjustment sentence=Signal::derive(sentence)>
            <button class="button" class:primary=move || !done.get() on:click=move |_| desk.adjust()>
                {move || if done.get() { text::adjust_again() } else { text::adjust_now() }}
            </button>
            <button class="button" data-action="inside" on:click=move |_| desk.open_inside(Network::Document)>{inside::inside}</button>
            <Show when=move || done.get()>
                <button class="button primary" on:click=move |_| desk.go(Step::Results)>{text::results} <Glyph icon=Icon::Arrow/></button>
            </Show>
        </TitleBar>
        <main class="adjust">
            <section class="scroll" tabindex="0" aria-label=text::what_is_estimated><NothingToAdjust/><ProjectOrigin/><Estimated/><FromWhat/><DatumChoice/><GrossErrors/></section>
            <section class="scroll" tabindex="0" aria-label=text::iterations><Iterations/><PhotoResiduals/><NotUsedList/><GrossErrorRecord/></section>
            <section class="scroll" tabindex="0" aria-label=text::what_lacks><Advice/></section>
        </main>
    }
}

/// Coordinates of control points that the datum holds: no standard error, no unknown.
fn fixed_axes(project: &Project) -> usize {
    if project.datum.kind != DatumKind::Control {
        return 0;
    }
    let control = project.points.iter().filter(|p| p.role == Role::Control);
    control.map(|p| p.sigma.unwrap_or_default().iter().filter(|s| s.is_none_or(|s| s == 0.0)).count()).sum()
}

#[component]
fn Estimated() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let photos = Memo::new(move |_| desk.document.with(|d| d.project.photos.iter().filter(|p| p.enabled).count()));
    let points = Memo::new(move |_| {
        desk.document.with(|d| {
            let control = d.project.points.iter().filter(|p| p.role == Role::Control).count();
            let held = d.project.datum.kind == DatumKind::Control;
            (d.project.points.len(), control, held, 3 * d.project.points.len() - fixed_axes(&d.project))
        })
    });
    let cameras =
        Memo::new(move |_| desk.document.with(|d| d.project.cameras.iter().map(|c| c.id.clone()).collect::<Vec<_>>()));
    view! {
        <h2 class="section-head"><span>{text::what_is_estimated}</span><span class="aside">{text::unknowns}</span></h2>
        <table class="table words">
            <tbody>
                <tr>
                    <td class="left"><b>{move || text::orientation_of(photos.get())}</b><small>{text::position_and_rotation}</small></td>
                    <td class="large">{move || format::count(6 * photos.get())}</td>
                </tr>
                {move || cameras.get().into_iter().map(|id| view! { <CameraWords id/> }).collect_view()}
                <tr>
                    <td class="left">
                        <b>{text::object_points}</b>
                        <small>{move || {
                            let (points, control, held, _) = points.get();
                            if held { text::points_with_control(format::count(points), format::count(control)) } else { text::points_all(format::count(points)) }
                        }}</small>
                    </td>
                    <td class="large">{move || format::count(points.get().3)}</td>
                </tr>
            </tbody>
        </table>
    }
}

/// Which parameters of a camera are estimated: in words, and to be chosen.
#[component]
fn CameraWords(id: String) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let id = StoredValue::new(id);
    let camera =
        Memo::new(move |_| desk.document.with(|d| d.project.cameras.iter().find(|c| c.id == id.get_value()).cloned()));
    let words = move || {
        camera.with(|c| {
            let Some(c) = c else { return String::new() };
            let estimated = c.estimated();
            let names = |wanted: bool| {
                let all =
                    c.interior.parameters().iter().filter(|p| estimated.contains(p) == wanted && **p != Parameter::F);
                all.map(|p| parameter_name(*p)).collect::<Vec<_>>().join(", ")
            };
            let words = match (names(true), names(false)) {
                (free, held) if held.is_empty() => text::all_estimated(free),
                (free, held) if free.is_empty() => text::all_held(held),
                (free, held) => text::estimated_and_held(free, held),
            };
            text::of_model(text::model_name(&c.interior), words)
        })
    };
    let count = move || camera.with(|c| c.as_ref().map_or(0, |c| c.estimated().len()));
    let parameters =
        Memo::new(move |_| camera.with(|c| c.as_ref().map(|c| c.interior.parameters().to_vec()).unwrap_or_default()));
    view! {
        <tr>
            <td class="left">
                <details>
                    <summary><b>{move || text::camera_named(id.get_value())}</b><small>{words}</small></summary>
                    <div class="fields"><ModelMenu camera=id.get_value()/></div>
                    <table class="table parameters">
                        <thead><tr><th class="left">{text::estimated}</th><th>{text::initial_value}</th><th title=text::observed_with>"σ"</th><td class="left wide"></td></tr></thead>
                        <tbody>
                            {move || parameters.get().into_iter().map(|p| view! { <ParameterRow camera=id.get_value() p/> }).collect_view()}
                        </tbody>
                    </table>
                </details>
            </td>
            <td class="large">{move || format::count(count())}</td>
        </tr>
        <ModelComparison camera=id.get_value()/>
    }
}

#[component]
fn ParameterRow(camera: String, p: Parameter) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let id = StoredValue::new(camera);
    let with = move |read: fn(&Camera, Parameter) -> String| {
        desk.document
            .with(|d| d.project.cameras.iter().find(|c| c.id == id.get_value()).map(|c| read(c, p)).unwrap_or_default())
    };
    let free = move || {
        desk.document.with(|d| d.project.cameras.iter().any(|c| c.id == id.get_value() && c.estimated().contains(&p)))
    };
    view! {
        <tr>
            <td class="left">
                <label class="tick">
                    <input type="checkbox" data-parameter=p.name() prop:checked=free on:change=move |e| desk.set_free(&id.get_value(), p, event::checked(&e))/>
                    <span>{parameter_name(p)}</span>
                </label>
            </td>
            <td>
                <Field value=Signal::derive(move || with(|c, p| c.interior.get(p).map(format::editable).unwrap_or_default()))
                    commit=move |typed: String| desk.set_initial(&id.get_value(), p, &typed)
                    attr:inputmode="decimal" attr:class="value" attr:aria-label=move || format!("{} {}", text::initial_value(), parameter_name(p))/>
            </td>
            <td>
                <Field value=Signal::derive(move || with(|c, p| c.sigma.get(&p).copied().map(format::editable).unwrap_or_default()))
                    commit=move |typed: String| desk.observe_parameter(&id.get_value(), p, &typed)
                    attr:inputmode="decimal" attr:class="value sigma" attr:data-sigma=p.name() attr:placeholder=text::not_observed
                    attr:aria-label=move || format!("σ {}", parameter_name(p))/>
            </td>
            <td class="left wide">{move || with(parameter_unit)}</td>
        </tr>
    }
}

#[component]
fn FromWhat() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let counts = Memo::new(move |_| {
        desk.document.with(|d| {
            let on = d.project.photos.iter().filter(|p| p.enabled).map(|p| p.id.as_str()).collect::<HashSet<_>>();
            let image = d.project.observations.iter().filter(|o| o.enabled && on.contains(o.photo.as_str()));
            let mut sigmas = image.clone().flat_map(|o| o.sigma.both()).collect::<Vec<_>>();
            sigmas.sort_by(f64::total_cmp);
            let median = sigmas.get(sigmas.len() / 2).copied();
            let control = d
                .project
                .points
                .iter()
                .filter(|p| p.role == Role::Control && d.project.datum.kind == DatumKind::Control)
                .count();
            (2 * image.count(), median, 3 * control - fixed_axes(&d.project), d.project.distances.len())
        })
    });
    view! {
        <h2 class="section-head"><span>{text::from_what}</span><span class="aside">{text::observations}</span></h2>
        <table class="table words">
            <tbody>
                <tr>
                    <td class="left">
                        <b>{text::image_coordinates}</b>
                        <small>{move || counts.get().1.map(|m| text::median_sigma(format::fixed(m, format::decimals_for(m))))}</small>
                        <label class="option" title=text::unmodelled_why>
                            <span>{text::unmodelled}</span>
                            <Field value=Signal::derive(move || desk.document.with(|d| format::editable(d.options.unmodelled))) commit=move |typed: String| desk.set_unmodelled(&typed)
                                attr:class="short" attr:inputmode="decimal" attr:name="unmodelled" attr:aria-description=text::unmodelled_why/>
                        </label>
                        <label class="option" title=text::target_diameter_why>
                            <span>{move || text::target_diameter(desk.document.with(|d| d.project.unit.clone()))}</span>
                            <Field value=Signal::derive(move || desk.document.with(|d| d.options.target_diameter.map(format::editable).unwrap_or_default())) commit=move |typed: String| desk.set_target_diameter(&typed)
                                attr:class="short" attr:inputmode="decimal" attr:name="target-diameter" attr:aria-description=text::target_diameter_why/>
                        </label>
                    </td>
                    <td class="large">{move || format::count(counts.get().0)}</td>
                </tr>
                <tr><td class="left"><b>{text::control_coordinates}</b></td><td class="large">{move || format::count(counts.get().2)}</td></tr>
                <tr><td class="left"><b>{text::distances}</b></td><td class="large">{move || format::count(counts.get().3)}</td></tr>
            </tbody>
        </table>
        <label class="tick" title=text::components_why>
            <input type="checkbox" name="variance-components" prop:checked=move || desk.document.with(|d| d.options.variance_components.is_some())
                on:change=move |e| {
                    let all = VarianceComponents { per_camera: false, unmodelled: false };
                    let wanted = event::checked(&e).then_some(all);
                    desk.set_options(|options| options.variance_components = wanted);
                }/>
            <span>{text::components}</span>
        </label>
        <Components/>
    }
}

/// The estimated variance components of the result, one a line.
#[component]
fn Components() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let found = Memo::new(move |_| {
        desk.document.with(|d| d.current().map(|r| r.adjustment.variance_components.clone()).unwrap_or_default())
    });
    let line = |component: VarianceComponent| {
        let name = group_name(&component.group);
        let factor = match (component.factor_sigma, component.not_estimated) {
            (Some(sigma), _) => format!("× {} ± {}", format::fixed(component.factor, 3), format::fixed(sigma, 3)),
            (None, Some(NotEstimated::LittleRedundancy { needed })) => {
                text::not_estimated(format::fixed(component.redundancy, 1), format::fixed(needed, 0))
            }
            (None, Some(NotEstimated::NoResiduals)) => text::no_residuals().to_owned(),
            (None, None) => "× 1".to_owned(),
        };
        view! { <tr><td class="left">{name}</td><td class="large">{factor}</td></tr> }
    };
    view! {
        <Show when=move || found.with(|list| !list.is_empty())>
            <table class="table words variance-components" aria-label=text::components>
                <tbody>{move || found.get().into_iter().map(line).collect_view()}</tbody>
            </table>
        </Show>
    }
}

#[component]
fn Iterations() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let unit = Memo::new(move |_| desk.document.with(|d| d.project.unit.clone()));
    let ending = move || {
        let running = desk.tasks.job.with(Option::is_some);
        let termination = desk.document.with(|d| d.current().map(|r| r.adjustment.termination));
        match termination {
            _ if running => None,
            None => None,
            Some(Termination::Converged) => Some((text::converged(), false)),
            Some(Termination::IterationLimit) => Some((text::iteration_limit(), true)),
            Some(Termination::Diverged) => Some((text::diverged(), true)),
            Some(Termination::Stopped) => Some((text::stopped(), true)),
        }
    };
    view! {
        <h2 class="section-head"><span>{text::iterations}</span><span class="aside">"σ₀, " {text::logarithmic}</span></h2>
        <Convergence iterations=Signal::derive(move || desk.processing.iterations.get())/>
        <Show when=move || desk.processing.iterations.with(|i| !i.is_empty()) fallback=|| view! { <p class="note">{text::no_iterations}</p> }>
            <table class="table iterations">
                <thead><tr><th>{text::number}</th><th>"σ₀"</th><th>{text::largest_step} " " <u>{unit}</u></th><th>{text::damping}</th></tr></thead>
                <tbody>
                    {move || {
                        let all = desk.processing.iterations.get();
                        let last = all.len();
                        all.into_iter().enumerate().map(|(i, it)| view! {
                            <tr class:chosen=i + 1 == last>
                                <td>{i + 1}</td>
                                <td><b>{format::compact(it.sigma0)}</b></td>
                                <td>{format::compact(it.step)}</td>
                                <td>{if it.damping == 0.0 { "0".to_owned() } else { format::compact(it.damping) }}</td>
                            </tr>
                        }).collect_view()
                    }}
                </tbody>
            </table>
        </Show>
        {move || ending().map(|(words, bad)| view! { <p class="note" class:warn=bad>{words}</p> })}
    }
}

/// Rms of the residuals photo by photo, the largest first: what the iterations have left.
#[component]
fn PhotoResiduals() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let rows = Memo::new(move |_| {
        desk.document.with(|d| {
            let Some(result) = d.current() else { return Vec::new() };
            let in_pixels = |p: &AdjustedPhoto| [p.rms_x / p.pixel[0], p.rms_y / p.pixel[1]];
            let all = result.adjustment.photos.iter().map(|p| (p.id.clone(), p.points, in_pixels(p)));
            let mut all = all.collect::<Vec<_>>();
            all.sort_by(|a, b| b.2[0].hypot(b.2[1]).total_cmp(&a.2[0].hypot(a.2[1])));
            all
        })
    });
    let largest = move || rows.with(|all| all.first().map_or(1.0, |(.., [x, y])| x.hypot(*y)).max(f64::MIN_POSITIVE));
    let row = move |(id, points, [x, y]): (String, usize, [f64; 2])| {
        let (photo, key) = (id.clone(), id.clone());
        let bar = 4.0 + 56.0 * x.hypot(y) / largest();
        view! {
            <tr data-photo-residuals=key>
                <td class="left"><button class="link" on:click=move |_| {
                    desk.select_photo(&photo);
                    desk.go(Step::Identities);
                }>{id}</button></td>
                <td>{format::count(points)}</td><td>{format::fixed(x, 3)}</td><td>{format::fixed(y, 3)}</td>
                <td class="left wide"><i class="bar-cell" style:width=format!("{bar:.0}px")></i></td>
            </tr>
        }
    };
    view! {
        <Show when=move || desk.tasks.job.with(Option::is_none) && rows.with(|rows| !rows.is_empty())>
            <h2 class="section-head"><span>{comparing::residuals_by_photo}</span></h2>
            <table class="table photo-residuals">
                <thead><tr>
                    <th class="left">{text::photo}</th><th>{text::points_column}</th><th>{text::rms_x} " " <u>"px"</u></th><th>{text::rms_y} " " <u>"px"</u></th><td class="left wide"></td>
                </tr></thead>
                <tbody>{move || rows.get().into_iter().map(row).collect_view()}</tbody>
            </table>
        </Show>
    }
}
