//! The one window: head with the steps, what the step shows, foot; files may be dropped anywhere.

use crate::view::components::title::step_label;
use leptos::html::Button;
use leptos::prelude::*;

use super::components::changes::change_words;
use super::components::icon::{Glyph, Icon};
use super::components::keys;
use super::menu::{FileMenu, MenuGround};
use super::projects::{StorageLine, StorageNotices, kept_words};
use super::results::control_figure;
use super::{help, rooms};
use crate::browser::{event, page};
use crate::document::Document;
use crate::i18n::{self, text};
use crate::store::experiments::from_hash;
use crate::store::persistence::Kept;
use crate::store::{Asking, Desk, Kind, Menu, Step, Theme};
use crate::{format, i18n::language};

/// The desk.
#[component]
pub fn App() -> impl IntoView {
    let desk = Desk::new();
    provide_context(desk);
    Effect::new(move || page::set_root_attribute("data-theme", desk.window.theme.get().name()));
    Effect::new(move || {
        let name = desk.document.with(|d| d.project.name.clone());
        page::set_title(&if name.is_empty() { "Sightline".to_owned() } else { format!("{name} – Sightline") });
    });
    Effect::new(move || desk.drop_stale_notice());
    desk.start_keeping();
    desk.start_predicting();
    page::listen_to_network(move || desk.connection.offline.set(page::is_offline()));
    page::listen_to_start(move |told| match told {
        page::Told::Update => desk.connection.update.set(true),
        page::Told::Network => desk.connection.needs_network.set(true),
        page::Told::Files(files) => desk.take_dropped(files),
    });
    event::listen_to_hash(move || desk.follow_hash());
    event::listen_to_keys(move |key| keys::handle(desk, &key));
    match untrack(|| from_hash(&page::hash())) {
        Some(name) => desk.show_experiment(name),
        // What was open before the page was loaded again comes back when the storage has answered.
        None if desk.expects_to_return() => {}
        None if desk.follow_hash_at_start() => {}
        None => page::set_hash("start"),
    }
    page::warn_before_leaving(move || untrack(|| desk.unsaved()));
    let over = RwSignal::new(false);
    view! {
        <div
            class="desk"
            class:dropping=over
            on:dragover=move |e| {
                e.prevent_default();
                over.set(true);
            }
            on:dragleave=move |_| over.set(false)
            on:drop=move |e| {
                over.set(false);
                desk.take_dropped(event::files_of_drop(&e));
            }
        >
            <Head/>
            <MenuGround/>
            <rooms::Rooms/>
            <Foot/>
            <NoticeBar/>
            <help::Help/>
        </div>
    }
}

#[component]
fn Head() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let name = Memo::new(move |_| desk.document.with(|d| d.project.name.clone()));
    let empty = Memo::new(move |_| desk.document.with(Document::is_empty));
    let state = move || if empty.get() { text::no_project().to_owned() } else { kept_words(desk) };
    let theme = move || match desk.window.theme.get() {
        Theme::Light => text::theme_light(),
        Theme::Dark => text::theme_dark(),
        Theme::Sun => text::theme_sun(),
    };
    // On a phone rarely needed items are in a menu.
    let more = Memo::new(move |_| desk.window.menu.get() == Some(Menu::More));
    let undo_label = move || desk.undoable().map_or(text::undo().to_owned(), |c| text::undo_this(change_words(&c)));
    let redo_label = move || desk.redoable().map_or(text::redo().to_owned(), |c| text::redo_this(change_words(&c)));
    view! {
        <header class="head">
            <button class="mark" aria-label=text::start_page on:click=move |_| desk.go(Step::Start)>
                <svg width="22" height="22" viewBox="0 0 22 22" aria-hidden="true">
                    <circle cx="11" cy="11" r="2"></circle>
                    <path d="M11 1v5.5M11 15.5V21M1 11h5.5M15.5 11H21"></path>
                </svg>
            </button>
            <div class="project">
                <Show when=move || !empty.get() fallback=|| view! { <strong>"Sightline"</strong> }>
                    <input class="project-name" type="text" aria-label=text::project_name placeholder=text::project_name
                        prop:value=name on:change=move |e| desk.rename_project(&event::value(&e))/>
                </Show>
                <span class:bad=move || desk.persistence.kept.with(|kept| matches!(kept, Kept::Failed(..)))>{state}</span>
            </div>
            <nav aria-label=text::steps>
                <ol class="steps">
                    {Step::ROW.into_iter().enumerate().map(|(i, step)| view! { <StepButton step number=i + 1/> }).collect_view()}
                </ol>
            </nav>
            <div class="tools">
                <button
                    class="icon-button"
                    aria-label=undo_label
                    title=undo_label
                    disabled=move || desk.undoable().is_none()
                    on:click=move |_| desk.undo()
                >
                    <Glyph icon=Icon::Undo/>
                </button>
                <button
                    class="icon-button"
                    aria-label=redo_label
                    title=redo_label
                    disabled=move || desk.redoable().is_none()
                    on:click=move |_| desk.redo()
                >
                    <Glyph icon=Icon::Redo/>
                </button>
                <button class="icon-button menu" aria-label=text::more_actions aria-expanded=move || more.get().to_string()
                    on:click=move |_| desk.window.menu.update(|menu| *menu = if menu.is_some() { None } else { Some(Menu::More) })>
                    <Glyph icon=Icon::More/>
                </button>
                <div class="more" class:open=more on:click=move |_| desk.window.menu.update(|menu| { menu.take_if(|menu| *menu == Menu::More); })>
                <FileMenu/>
                <Show when=move || !empty.get()>
                    <button class="text-button to-tables" aria-current=move || (desk.step.get() == Step::Tables).then_some("page")
                        on:click=move |_| desk.go(Step::Tables)>{text::tables}</button>
                </Show>
                <span class="rule"></span>
                <button class="text-button" title=text::keys_title on:click=move |_| desk.window.help.set(true)><span>"?"</span> <span class="visually-hidden">{text::keys_title}</span></button>
                <button
                    class="text-button"
                    aria-label=move || format!("{}, {}", language().other().name(), text::switch_language())
                    on:click=move |_| i18n::set_language(language().other())
                >
                    {move || language().other().name()}
                </button>
                <button
                    class="text-button"
                    aria-label=move || format!("{}, {}", theme(), text::switch_theme())
                    on:click=move |_| desk.set_theme(desk.window.theme.get_untracked().next())
                >
                    {theme}
                </button>
                </div>
            </div>
        </header>
    }
}

/// A step with its one figure.
#[component]
fn StepButton(step: Step, number: usize) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let stale = Memo::new(move |_| {
        matches!(step, Step::Adjust | Step::Results | Step::Report) && desk.document.with(Document::out_of_date)
    });
    let figure = move || {
        desk.document.with(|d| match step {
            Step::Photos if !d.project.photos.is_empty() => format::count(d.project.photos.len()),
            Step::Targets if !d.detections.is_empty() => {
                format::count(d.detections.values().map(|detection| detection.targets.len()).sum())
            }
            Step::Identities if !d.project.points.is_empty() => format::count(d.project.points.len()),
            Step::Control => control_figure(&d.project),
            Step::Adjust | Step::Results | Step::Report if d.out_of_date() => text::out_of_date().to_owned(),
            Step::Adjust => d.current().map_or("–".to_owned(), |r| text::n_iterations(r.adjustment.iterations.len())),
            Step::Results => d
                .current()
                .and_then(|r| r.adjustment.sigma0)
                .map_or("–".to_owned(), |s| format!("σ₀ {}", format::fixed(s, 3))),
            Step::Report if d.current().is_some() => text::report_figure().to_owned(),
            _ => "–".to_owned(),
        })
    };
    let reachable = move || desk.document.with(|d| !d.is_empty());
    // The object is a view of the results.
    let now = move || {
        desk.step.get() == step
            || (step == Step::Results
                && (desk.step.get() == Step::Object || desk.step.get() == Step::Monitoring && reachable()))
    };
    view! {
        <li class:now=now>
            <button
                data-step=step.name()
                aria-current=move || now().then_some("step")
                disabled=move || !reachable()
                on:click=move |_| desk.go(step)
            >
                <b>{number}</b>
                <span class="label">{move || step_label(step)}</span>
                <span class="figure" class:stale=stale>
                    {move || stale.get().then(|| view! { <Glyph icon=Icon::Clock size=12/> " " })}
                    {figure}
                </span>
            </button>
        </li>
    }
}

/// Messages, in a row of their own, until it is dismissed.
#[component]
fn NoticeBar() -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <div class="messages">
        <div class="notices" aria-live="polite">
            {move || desk.messages.notice.get().map(|notice| {
                let icon = if notice.warning { Icon::Warning } else { Icon::Check };
                view! {
                    <div class="notice" class:warning=notice.warning role=if notice.warning { "alert" } else { "status" }>
                        <Glyph icon/>
                        <p>{move || (notice.text)()}</p>
                        <button class="icon-button" aria-label=text::dismiss on:click=move |_| desk.messages.notice.set(None)>
                            <Glyph icon=Icon::Cross size=14/>
                        </button>
                    </div>
                }
            })}
        </div>
        <StorageNotices/>
        {move || desk.messages.asking.get().map(|asking| view! { <Question asking/> })}
        </div>
    }
}

/// A question that something waits for, with its answers.
#[component]
fn Question(asking: Asking) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let first = NodeRef::<Button>::new();
    first.on_load(|button| {
        let _ = button.focus();
    });
    let mut unused = Some(first);
    let choices = asking
        .choices
        .into_iter()
        .map(|(words, take)| {
            let node = unused.take();
            let primary = node.is_some();
            view! {
                <button class="button small" class:primary=primary node_ref=node.unwrap_or_default() on:click=move |_| {
                    desk.messages.asking.set(None);
                    take();
                }>{words}</button>
            }
        })
        .collect_view();
    let text = StoredValue::new_local(asking.text);
    view! {
        <div class="notice warning asking" role="alertdialog" aria-labelledby="asked">
            <Glyph icon=Icon::Warning/>
            <p id="asked">{move || text.with_value(|text| text())}</p>
            {choices}
            <button class="button small" on:click=move |_| desk.messages.asking.set(None)>{text::cancel}</button>
        </div>
    }
}

#[component]
fn Foot() -> impl IntoView {
    let desk = expect_context::<Desk>();
    // A point that went with its last observation is chosen no more.
    let chosen = move || {
        let point = desk.selection.with(|s| s.point.clone())?;
        desk.document.with(|d| d.project.points.iter().any(|p| p.id == point)).then_some(point)
    };
    let rays = move || {
        chosen().map(|point| {
            let rays = desk.document.with(|d| d.project.observations.iter().filter(|o| o.point == point).count());
            text::in_photos(format::count(rays))
        })
    };
    let marked =
        move || Some(desk.marked(Kind::Points).len()).filter(|n| *n > 1).map(|n| text::rows_marked(format::count(n)));
    let place = move || {
        desk.photo_view.cursor.get().map(|[u, v]| format!("u {}   v {} px", format::fixed(u, 1), format::fixed(v, 1)))
    };
    view! {
        <footer class="foot">
            <div class="chosen">
                <Show
                    when=move || chosen().is_some()
                    fallback=|| view! { <span>{|| text::version(env!("CARGO_PKG_VERSION"))}</span> }
                >
                    <span class="dot"></span>
                    <b>{chosen}</b>
                    <span>{rays}</span>
                    <span>{marked}</span>
                </Show>
            </div>
            <div class="read-out">{place}</div>
            <StorageLine/>
            <div class="units">
                {move || text::units(desk.document.with(|d| d.project.unit.clone()))}
            </div>
        </footer>
    }
}
