//! How epochs are compared: reference points, levels of the tests, groups and thresholds.

use leptos::prelude::*;
use sightline::monitoring::{ComparisonMethod, Correction, DatumChoice, Group, GroupModel, VarianceChoice};

use crate::browser::event;
use crate::edit::epoch::names_in;
use crate::format;
use crate::i18n::{Text, monitoring as words};
use crate::store::Desk;
use crate::view::components::field::Field;
use crate::view::components::icon::{Glyph, Icon};

/// Common points that are offered to be pressed; of more the names are typed.
const OFFERED: usize = 150;

/// A choice of one of a few values.
#[component]
fn Choice<T: Copy + PartialEq + Send + Sync + 'static>(
    name: &'static str,
    label: Text,
    now: Signal<T>,
    all: Vec<(T, Text)>,
    set: Callback<T>,
) -> impl IntoView {
    let values = StoredValue::new(all.iter().map(|(value, _)| *value).collect::<Vec<_>>());
    view! {
        <label class="option"><span>{label}</span>
            <select name=name on:change=move |e| {
                if let Some(value) = event::value(&e).parse::<usize>().ok().and_then(|k| values.with_value(|all| all.get(k).copied())) {
                    set.run(value);
                }
            }>
                {all.into_iter().enumerate().map(|(k, (value, words))| view! {
                    <option value=k.to_string() selected=move || now.get() == value>{words}</option>
                }).collect_view()}
            </select>
        </label>
    }
}

/// The cameras that all epochs have, each to be shared by them or not.
#[component]
fn SharedCameras() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let options = desk.monitoring.options;
    let names = Memo::new(move |_| {
        // A camera that is shared and not there any more can still be taken off.
        let mut all = desk.monitoring.common_cameras();
        options.with(|o| {
            all.extend(o.shared_cameras.iter().filter(|name| !all.contains(name)).cloned().collect::<Vec<_>>())
        });
        all
    });
    let button = move |name: String| {
        let is_shared = {
            let name = name.clone();
            Signal::derive(move || options.with(|o| o.shared_cameras.contains(&name)))
        };
        let toggled = name.clone();
        view! {
            <button class="button small" type="button" aria-pressed=move || is_shared.get().to_string()
                on:click=move |_| desk.choose_comparison(|o| match o.shared_cameras.iter().position(|n| *n == toggled) {
                    Some(place) => _ = o.shared_cameras.remove(place),
                    None => o.shared_cameras.push(toggled.clone()),
                })>{name}</button>
        }
    };
    view! {
        <h3 class="section-head"><span>{words::shared_cameras}</span></h3>
        <p class="hint">{words::shared_cameras_hint}</p>
        <div class="common-points" data-field="shared-cameras">
            {move || names.get().into_iter().map(button).collect_view()}
            {move || names.with(Vec::is_empty).then(|| view! { <p class="note">{words::shared_cameras_none}</p> })}
        </div>
    }
}

#[component]
pub fn Options() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let monitored = desk.monitoring;
    let options = monitored.options;
    let unit = Signal::derive(move || monitored.unit());
    let percent = |share: f64| format::editable((1e6 * share).round() / 1e4);
    let set_percent =
        move |typed: String, most: f64, set: fn(&mut sightline::monitoring::Options, f64)| match format::parse(&typed)
            .map(|p| p / 100.0)
            .filter(|share| *share > 0.0 && *share <= most)
        {
            Some(share) => desk.choose_comparison(|options| set(options, share)),
            None => desk.warn_here(move || words::percent_refused(&typed)),
        };
    let threshold = move |alarm: bool| {
        let value = options.with(|o| o.thresholds.as_ref().map(|t| if alarm { t.all.alarm } else { t.all.warning }));
        value.map(format::editable).unwrap_or_default()
    };
    let set_threshold = move |alarm: bool, typed: String| match alarm {
        true => desk.set_thresholds(&untrack(|| threshold(false)), &typed),
        false => desk.set_thresholds(&typed, &untrack(|| threshold(true))),
    };
    view! {
        <section class="panel">
            <h2 class="section-head"><span>{words::reference_points}</span></h2>
            <p class="hint">{words::reference_means}</p>
            <Reference/>
        </section>
        <section class="panel">
            <h2 class="section-head"><span>{words::options}</span></h2>
            <div class="option-fields">
                <label class="option" data-field="significance"><span>{words::significance}</span>
                    <Field value=Signal::derive(move || options.with(|o| percent(o.significance)))
                        commit=Callback::new(move |typed| set_percent(typed, 0.5, |o, share| o.significance = share))/></label>
                <label class="option" data-field="power"><span>{words::power}</span>
                    <Field value=Signal::derive(move || options.with(|o| percent(o.power)))
                        commit=Callback::new(move |typed| set_percent(typed, 0.999_999, |o, share| o.power = share))/></label>
                <Choice name="correction" label=words::correction now=Signal::derive(move || options.with(|o| o.correction))
                    all=vec![(Correction::Holm, words::holm as Text), (Correction::Bonferroni, words::bonferroni), (Correction::None, words::no_correction)]
                    set=Callback::new(move |value| desk.choose_comparison(|o| o.correction = value))/>
                <Choice name="variance" label=words::variance now=Signal::derive(move || options.with(|o| o.variance))
                    all=vec![(VarianceChoice::Estimated, words::variance_estimated as Text), (VarianceChoice::Separate, words::variance_separate), (VarianceChoice::Given, words::variance_given)]
                    set=Callback::new(move |value| desk.choose_comparison(|o| o.variance = value))/>
                <Choice name="method" label=words::method now=Signal::derive(move || options.with(|o| o.method))
                    all=vec![(ComparisonMethod::Coordinates, words::method_coordinates as Text), (ComparisonMethod::Joint, words::method_joint)]
                    set=Callback::new(move |value| desk.choose_comparison(|o| o.method = value))/>
                <Choice name="system" label=words::datum now=Signal::derive(move || options.with(|o| o.datum))
                    all=vec![(DatumChoice::Reference, words::datum_reference as Text), (DatumChoice::Given, words::datum_given)]
                    set=Callback::new(move |value| desk.choose_comparison(|o| o.datum = value))/>
            </div>
            <Show when=move || options.with(|o| o.method == ComparisonMethod::Joint || !o.shared_cameras.is_empty())>
                <SharedCameras/>
            </Show>
            <h2 class="section-head"><span>{words::thresholds} " " <span class="id">{unit}</span></span></h2>
            <div class="option-fields">
                <label class="option" data-field="warning"><span>{words::warning}</span>
                    <Field value=Signal::derive(move || threshold(false)) commit=Callback::new(move |typed| set_threshold(false, typed))/></label>
                <label class="option" data-field="alarm"><span>{words::alarm}</span>
                    <Field value=Signal::derive(move || threshold(true)) commit=Callback::new(move |typed| set_threshold(true, typed))/></label>
            </div>
            <Groups/>
        </section>
    }
}

#[component]
fn Reference() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let options = desk.monitoring.options;
    let common = Memo::new(move |_| desk.monitoring.common());
    let offered = move || common.with(|all| all.len() <= OFFERED && !all.is_empty());
    let set_reference = move |names: Vec<String>| {
        desk.choose_comparison(|o| o.reference = Some(names).filter(|names| !names.is_empty()));
    };
    let press = move |name: &str| {
        let mut names = options.with_untracked(|o| o.reference.clone()).unwrap_or_default();
        match names.iter().position(|known| known == name) {
            Some(at) => drop(names.remove(at)),
            None => names.push(name.to_owned()),
        }
        let order = common.get_untracked();
        names.sort_by_key(|name| order.iter().position(|known| known == name));
        set_reference(names);
    };
    view! {
        <div class="option-fields names">
            <label class="option" data-field="reference"><span>{words::reference_points} <small>{words::names_hint}</small></span>
                <Field value=Signal::derive(move || options.with(|o| o.reference.as_ref().map(|names| names.join(", ")).unwrap_or_default()))
                    commit=Callback::new(move |typed: String| set_reference(names_in(&typed)))/></label>
            <label class="option" data-field="ignored"><span>{words::ignored_points} <small>{words::names_hint}</small></span>
                <Field value=Signal::derive(move || options.with(|o| o.ignored.join(", ")))
                    commit=Callback::new(move |typed: String| desk.choose_comparison(|o| o.ignored = names_in(&typed)))/></label>
        </div>
        <Show when=offered>
            <h3>{words::common_points} " " <small>{move || format::count(common.with(Vec::len))} ". " {words::common_words}</small></h3>
            <div class="common-points" role="group" aria-label=words::common_points>
                {move || common.get().into_iter().map(|name| {
                    let (own, key) = (name.clone(), name.clone());
                    let pressed = move || options.with(|o| o.reference.as_ref().is_some_and(|all| all.contains(&own)));
                    view! { <button class="button small" data-common=key.clone() aria-pressed=move || pressed().to_string() on:click=move |_| press(&key)>{name}</button> }
                }).collect_view()}
            </div>
        </Show>
    }
}

/// Groups that are thought to move as one.
#[component]
fn Groups() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let options = desk.monitoring.options;
    let change = move |k: usize, edit: Box<dyn FnOnce(&mut Group)>| {
        desk.choose_comparison(|o| {
            if let Some(group) = o.groups.get_mut(k) {
                edit(group);
            }
        });
    };
    let models: [(GroupModel, Text); 3] = [
        (GroupModel::Rigid, words::rigid),
        (GroupModel::Similarity, words::similarity),
        (GroupModel::Affine, words::affine),
    ];
    let count = Memo::new(move |_| options.with(|o| o.groups.len()));
    let group = move |k: usize| {
        let name =
            Signal::derive(move || options.with(|o| o.groups.get(k).map(|g| g.name.clone()).unwrap_or_default()));
        let points =
            Signal::derive(move || options.with(|o| o.groups.get(k).map(|g| g.points.join(", ")).unwrap_or_default()));
        let model = Signal::derive(move || options.with(|o| o.groups.get(k).map(|g| g.model).unwrap_or_default()));
        view! {
            <div class="option-fields group" data-group-row=k.to_string()>
                <label class="option" data-field="group-name"><span>{words::name}</span>
                    <Field value=name commit=Callback::new(move |typed: String| change(k, Box::new(move |g| g.name = typed.trim().to_owned())))/></label>
                <label class="option" data-field="group-points"><span>{words::points} <small>{words::names_hint}</small></span>
                    <Field value=points commit=Callback::new(move |typed: String| change(k, Box::new(move |g| g.points = names_in(&typed))))/></label>
                <Choice name="model" label=words::method now=model all=models.to_vec() set=Callback::new(move |value| change(k, Box::new(move |g| g.model = value)))/>
                <button class="icon-button small" aria-label=move || words::remove(name.get())
                    on:click=move |_| desk.choose_comparison(|o| drop(o.groups.remove(k)))><Glyph icon=Icon::Cross size=12/></button>
            </div>
        }
    };
    view! {
        <h2 class="section-head"><span>{words::groups}</span>
            <button class="button small" data-action="add-group" on:click=move |_| desk.choose_comparison(|o| {
                let name = (1..).map(words::group_name).find(|name| o.groups.iter().all(|g| g.name != *name)).unwrap_or_default();
                o.groups.push(Group { name, ..Group::default() });
            })>{words::add_group}</button>
        </h2>
        {move || (0..count.get()).map(group).collect_view()}
    }
}
