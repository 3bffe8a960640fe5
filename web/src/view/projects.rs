//! The projects on this computer, on the start page; how storage stands, in the foot.

use leptos::html::Input;
use leptos::prelude::*;

use super::components::icon::{Glyph, Icon};
use super::estimated::times;
use super::strip::Thumbnail;
use crate::browser::{event, page};
use crate::format;
use crate::i18n::{language, text};
use crate::store::Desk;
use crate::store::calls::CardOutcome;
use crate::store::persistence::{Kept, uncopied_words, unkept_words};
use crate::store::shelf::Shelved;

/// The list, where there is anything in it.
#[component]
pub fn Projects() -> impl IntoView {
    let desk = expect_context::<Desk>();
    desk.read_shelf();
    // The list is read again now and then: what is open in it stays open.
    let (menu, renaming) = (RwSignal::new(None), RwSignal::new(None));
    let count = Memo::new(move |_| desk.shelf.projects.with(|all| all.as_ref().map_or(0, Vec::len)));
    let rows = move || {
        let all = desk.shelf.projects.get().unwrap_or_default();
        all.into_iter().enumerate().map(|(i, project)| (project, i == 0)).collect::<Vec<_>>()
    };
    view! {
        <div class="shelves">
        <Show when=move || { count.get() > 0 }>
            <section class="shelf" aria-label=text::recent_projects>
                <h2>{text::recent_projects} <span>{move || format::count(count.get())}</span> <small>{text::on_this_computer}</small></h2>
                <div class="shelf-rows"><table>
                    <thead><tr>
                        <td></td>
                        <th class="l">{text::project}</th>
                        <th>{text::column_photos}</th>
                        <th class="wide">{text::column_points}</th>
                        <th>"σ₀"</th>
                        <th class="l wide">{text::column_changed}</th>
                        <th class="wide">"MB"</th>
                        <td></td>
                    </tr></thead>
                    <tbody>
                        // An unchanged row keeps its element, so that a click that began on it also ends on it.
                        <For each=rows key=|(project, first)| (row_key(project), *first) let((project, first))>
                            <ProjectRow project first menu renaming/>
                        </For>
                    </tbody>
                </table></div>
            </section>
        </Show>
        <Bin/>
        </div>
    }
}

/// Contents of the row of a project.
fn row_key(project: &Shelved) -> String {
    let Shelved { id, bytes, card, small, unreadable, damaged } = project;
    format!("{id} {bytes} {} {unreadable} {damaged} {card:?}", small.is_some())
}

/// Projects that were deleted and are there still.
#[component]
fn Bin() -> impl IntoView {
    let desk = expect_context::<Desk>();
    // The one that was deleted just now has a notice of its own.
    let rest = move || {
        let last = desk.shelf.deleted.get().map(|(id, _)| id);
        desk.shelf.bin.get().into_iter().filter(|one| Some(&one.id) != last.as_ref()).collect::<Vec<_>>()
    };
    move || {
        let all = rest();
        (!all.is_empty()).then(|| view! {
            <section class="shelf bin" aria-label=text::deleted_projects>
                <h2>{text::deleted_projects} <span>{format::count(all.len())}</span> <small>{text::deleted_for_a_day}</small></h2>
                <ul>{all.into_iter().map(|Shelved { id, card, .. }| {
                    let name = if card.name.is_empty() { text::without_name().to_owned() } else { card.name };
                    let key = id.clone();
                    view! {
                        <li data-deleted=key>
                            <b>{name}</b>
                            <button class="button small" on:click=move |_| desk.restore_kept(&id)>{text::put_back}</button>
                        </li>
                    }
                }).collect_view()}</ul>
            </section>
        })
    }
}

#[component]
fn ProjectRow(
    project: Shelved,
    first: bool,
    menu: RwSignal<Option<String>>,
    renaming: RwSignal<Option<String>>,
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let Shelved { id, bytes, card, small, unreadable, damaged } = project;
    let key = StoredValue::new(id);
    let is_of =
        move |signal: RwSignal<Option<String>>| signal.with(|of| key.with_value(|key| of.as_ref() == Some(key)));
    let menu_is_open = Memo::new(move |_| is_of(menu));
    let is_renamed = Memo::new(move |_| is_of(renaming));
    let name = StoredValue::new(card.name.clone());
    let step = StoredValue::new(card.step.clone());
    let is_open = move || key.with_value(|key| desk.open_id().as_ref() == Some(key));
    let left_at = move || key.with_value(|key| step.with_value(|step| desk.last_step(key, step)));
    let go_on = move |_| {
        if is_open() {
            return desk.go(left_at());
        }
        desk.open_kept(key.get_value(), left_at());
    };
    let field = NodeRef::<Input>::new();
    field.on_load(|field| {
        let _ = field.focus();
        field.select();
    });
    let shown = move || {
        let name = name.get_value();
        match name.is_empty() {
            _ if unreadable => text::unreadable_project().to_owned(),
            true => text::without_name().to_owned(),
            false => name,
        }
    };
    let sigma0 = card.sigma0.map(|s| format::fixed(s, 3)).unwrap_or_default();
    let outcome = card.outcome;
    let estimated = match card.estimated {
        Some((factor, px)) => format!("{}: {}", text::errors_estimated(), times(factor, None, Some(px))),
        None => text::errors_estimated().to_owned(),
    };
    let busy = move || desk.tasks.job.with(Option::is_some);
    view! {
        <tr data-project=key.get_value()>
            <td class="cover">
                {match small {
                    Some(picture) => view! { <Thumbnail picture orientation=1/> }.into_any(),
                    None => view! { <span class="thumbnail"></span> }.into_any(),
                }}
            </td>
            <td class="l">
                <Show when=move || is_renamed.get() fallback=move || view! { <b class="name">{shown}</b> }>
                    <input type="text" aria-label=text::project_name node_ref=field prop:value=name.get_value()
                        on:keydown=move |e| if event::key(&e).key == "Escape" { renaming.set(None) }
                        on:change=move |e| {
                            renaming.set(None);
                            desk.rename_kept(&key.get_value(), &event::value(&e));
                        }
                        on:blur=move |_| renaming.set(None)/>
                </Show>
                <Show when=is_open><span>{text::open_now}</span></Show>
            </td>
            <td>{format::count(card.photos)}</td>
            <td class="wide">{format::count(card.points)}</td>
            <td class="outcome">{move || match outcome {
                CardOutcome::None => view! { "–" }.into_any(),
                CardOutcome::Passed => view! { <span class="pass"><Glyph icon=Icon::Check size=14/></span> {sigma0.clone()} }.into_any(),
                CardOutcome::Failed => view! { <span class="bad"><Glyph icon=Icon::Cross size=14/></span> {sigma0.clone()} }.into_any(),
                CardOutcome::Estimated => view! { <span>{estimated.clone()}</span> }.into_any(),
                CardOutcome::OutOfDate => view! { <span class="warn"><Glyph icon=Icon::Clock size=14/> {text::out_of_date}</span> }.into_any(),
            }}</td>
            <td class="l wide">{move || if card.changed > 0.0 { page::moment(card.changed, language().tag()) } else { "–".to_owned() }}</td>
            <td class="wide">{format::fixed(bytes / 1e6, 1)}</td>
            <td class="do">
                <button class="button small" class:primary=first disabled=move || busy() || unreadable
                    aria-label=move || text::go_on_with(shown()) on:click=go_on>{text::go_on}</button>
                <button class="icon-button" aria-label=move || text::more_with(shown())
                    aria-expanded=move || menu_is_open.get().to_string()
                    on:click=move |_| menu.set((!menu_is_open.get_untracked()).then(|| key.get_value()))>
                    <Glyph icon=Icon::More/>
                </button>
            </td>
        </tr>
        <Show when=move || menu_is_open.get()>
            <tr class="verbs"><td colspan="8">
                <button class="text-button" disabled=unreadable on:click=move |_| { menu.set(None); renaming.set(Some(key.get_value())); }>{text::rename_project}</button>
                <button class="text-button" disabled=unreadable on:click=move |_| key.with_value(|key| name.with_value(|name| desk.duplicate_kept(key, name)))>{text::duplicate}</button>
                <button class="text-button" disabled=move || busy() || unreadable on:click=move |_| key.with_value(|key| desk.download_kept(key, left_at()))>{text::download}</button>
                {damaged.then(|| view! {
                    <button class="text-button" on:click=move |_| key.with_value(|key| name.with_value(|name| desk.download_damaged(key, name)))>{text::download_damaged}</button>
                })}
                <button class="text-button" disabled=busy on:click=move |_| key.with_value(|key| name.with_value(|name| desk.delete_kept(key, name)))>{text::delete_project}</button>
            </td></tr>
        </Show>
    }
}

/// Messages about the storage that stay while their cause exists: another window, a project deleted just now.
#[component]
pub fn StorageNotices() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let follows = Memo::new(move |_| desk.persistence.kept.with(|kept| *kept == Kept::Following));
    let slow_task = Memo::new(move |_| desk.slow_task());
    view! {
        <Show when=move || follows.get()>
            <div class="notice warning" role="status">
                <Glyph icon=Icon::Warning/>
                <p>{text::open_elsewhere}</p>
                <button class="button small primary" on:click=move |_| desk.take_over()>{text::take_over}</button>
            </div>
        </Show>
        <Show when=move || desk.connection.outdated.get()>
            <div class="notice warning" role="alert">
                <Glyph icon=Icon::Warning/>
                <p>{text::another_build}</p>
                <button class="button small primary" on:click=move |_| page::reload()>{text::reload_page}</button>
            </div>
        </Show>
        <Show when=move || desk.connection.update.get()>
            <div class="notice" role="status">
                <Glyph icon=Icon::Check/>
                <p>{text::update_ready}</p>
                <button class="button small primary" disabled=move || desk.tasks.job.with(Option::is_some)
                    on:click=move |_| page::take_update()>{text::take_update}</button>
                <button class="icon-button" aria-label=text::dismiss on:click=move |_| desk.connection.update.set(false)>
                    <Glyph icon=Icon::Cross size=14/>
                </button>
            </div>
        </Show>
        {move || slow_task.get().map(|words| view! {
            <div class="notice background-task" role="status">
                <p>{words}</p>
                <button class="button small" on:click=move |_| desk.cancel_slow_tasks()>{text::cancel}</button>
            </div>
        })}
        {move || desk.shelf.deleted.get().map(|(_, name)| view! {
            <div class="notice" role="status">
                <Glyph icon=Icon::Check/>
                <p>{move || text::deleted(&name)}</p>
                <button class="button small" on:click=move |_| desk.restore_deleted()>{text::undo}</button>
            </div>
        })}
    }
}

/// How it stands with what is done, in the head.
pub fn kept_words(desk: Desk) -> String {
    match desk.persistence.kept.get() {
        Kept::At(_) if desk.persistence.to_copy.get() > 0 => text::copying_photos(desk.persistence.to_copy.get()),
        Kept::At(clock) if clock.is_empty() => text::not_saved().to_owned(),
        Kept::At(clock) => match desk.not_copied() {
            Some((missed, _)) => text::saved_without_photos(clock, missed),
            None => text::saved_at(clock),
        },
        Kept::Writing => text::writing().to_owned(),
        Kept::Failed(..) => text::not_written().to_owned(),
        Kept::Following => text::following().to_owned(),
        Kept::Starting | Kept::Nowhere => match desk.persistence.saved.get() {
            Some((clock, _)) if desk.unsaved() => text::changed_after(clock),
            Some((clock, _)) => text::saved_at(clock),
            None => text::not_saved().to_owned(),
        },
    }
}

/// Storage used and free, and whether it lasts.
#[component]
pub fn StorageLine() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let words = move || match desk.persistence.kept.get() {
        Kept::Starting => String::new(),
        Kept::Nowhere => text::keeps_nothing().to_owned(),
        Kept::Failed(name, detail) => unkept_words(&name, &detail),
        _ => match (desk.not_copied(), desk.persistence.space.get()) {
            (Some((missed, why)), _) => uncopied_words(missed, &why),
            (None, Some((used, all))) => {
                let lasts = if desk.persistence.persistent.get() { text::lasts() } else { text::may_be_cleared() };
                let network = if desk.connection.needs_network.get() {
                    format!(" · {}", text::needs_network())
                } else {
                    String::new()
                };
                format!("{} · {lasts}{network}", text::space_used(bytes_words(used), bytes_words(all)))
            }
            (None, None) if desk.connection.needs_network.get() => text::needs_network().to_owned(),
            (None, None) => String::new(),
        },
    };
    let alarm = move || {
        desk.persistence.kept.with(|kept| matches!(kept, Kept::Nowhere | Kept::Failed(..)))
            || desk.not_copied().is_some()
    };
    view! {
        <Show when=move || desk.connection.offline.get()><div class="offline"><b>{move || if desk.connection.needs_network.get() { text::no_network_nor_copy() } else { text::no_network() }}</b></div></Show>
        <div class="storage" class:warn=alarm>{words}</div>
    }
}

fn bytes_words(bytes: f64) -> String {
    if bytes >= 1e9 {
        format!("{} GB", format::fixed(bytes / 1e9, 1))
    } else {
        format!("{} MB", format::fixed(bytes / 1e6, 1))
    }
}
