//! Actions on the selected rows.

use std::sync::Arc;

use leptos::prelude::*;
use sightline::project::Role;

use super::grid::copied;
use crate::browser::{event, page};
use crate::document::Table;
use crate::format;
use crate::i18n::{Text, text, text::role_word};
use crate::store::Desk;
use crate::store::tables::Shared;

#[component]
pub fn Actions(sheet: Memo<Shared>, rows: Memo<Arc<Vec<u32>>>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let table = Memo::new(move |_| sheet.with(|s| s.0.table));
    let marked = Memo::new(move |_| desk.marked(table.get().kind()).len());
    let naming = RwSignal::new(false);
    let switches = move || !matches!(table.get(), Table::Cameras | Table::Distances | Table::Identities);
    let points = move || matches!(table.get(), Table::Points | Table::Control);
    let col = move || sheet.with(|s| s.0.columns().get(desk.tables.col.get()).copied());
    let merges = move || points() && marked.get() > 1;
    let joins = move || table.get() == Table::Cameras && marked.get() > 1;
    let fills = move || marked.get() > 1 && col().is_some_and(|col| table.get().editable(col));
    let button = move |words: Text, action: &'static str, run: fn(Desk, Table)| {
        view! {
            <button class="button small" type="button" data-action=action on:click=move |_| run(desk, table.get_untracked())>{words}</button>
        }
    };
    view! {
        <div class="sheet-actions" role="group" aria-label=text::marked_rows>
            <span class="count">{move || text::rows_marked(format::count(marked.get()))}</span>
            <Show when=move || marked.with(|n| *n > 0)>
                <Show when=switches>
                    {button(text::exclude, "exclude", |desk, table| desk.switch_rows(table, false))}
                    {button(text::restore, "restore", |desk, table| desk.switch_rows(table, true))}
                </Show>
                <Show when=points>
                    <select name="role" aria-label=text::role on:change=move |e| {
                        match event::value(&e).as_str() {
                            "control" => desk.set_roles(Role::Control),
                            "check" => desk.set_roles(Role::Check),
                            "tie" => desk.set_roles(Role::Tie),
                            _ => {}
                        }
                        event::choose_first(&e);
                    }>
                        <option value="">{text::role}</option>
                        {[(Role::Control, "control"), (Role::Check, "check"), (Role::Tie, "tie")].into_iter().map(|(role, value)| view! {
                            <option value=value>{move || role_word(role)}</option>
                        }).collect_view()}
                    </select>
                    <button class="button small" type="button" data-action="rename" aria-expanded=move || naming.get().to_string()
                        on:click=move |_| naming.update(|on| *on = !*on)>{text::rename_many}</button>
                </Show>
                <Show when=merges>{button(text::merge, "merge", |desk, _| desk.merge_points())}</Show>
                <Show when=move || table.get() == Table::Observations>{button(text::split, "split", |desk, _| desk.split_point())}</Show>
                <Show when=joins>
                    {button(text::join_cameras, "join", |desk, _| desk.join_cameras())}
                </Show>
                <Show when=move || table.get() == Table::Photos><CameraOfPhotos/></Show>
                <Show when=fills>
                    <button class="button small" type="button" data-action="fill" on:click=move |_| if let Some(col) = untrack(col) {
                        sheet.with_untracked(|s| rows.with_untracked(|rows| desk.fill_down(&s.0, rows, col)));
                    }>{text::fill_down}</button>
                </Show>
                {button(text::delete_rows, "delete", |desk, table| desk.delete_rows(table))}
            </Show>
            <button class="button small" type="button" data-action="copy" on:click=move |_| {
                desk.copy_text(sheet.with_untracked(|s| rows.with_untracked(|rows| copied(desk, &s.0, rows))));
            }>{text::copy}</button>
            <button class="button small" type="button" data-action="paste" on:click=|_| page::focus_id("pasted-cells")>{text::paste}</button>
        </div>
        <Show when=move || naming.get() && points() && marked.with(|n| *n > 0)><Naming naming/></Show>
    }
}

/// Photos given to another camera, or to one of their own.
#[component]
fn CameraOfPhotos() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let own = "\u{0}own";
    let cameras = move || desk.document.with(|d| d.project.cameras.iter().map(|c| c.id.clone()).collect::<Vec<_>>());
    view! {
        <select name="camera" aria-label=text::camera on:change=move |e| {
            let photos = untrack(|| desk.marked(crate::store::Kind::Photos));
            match event::value(&e).as_str() {
                "" => {}
                value if value == own => desk.assign_own_camera(&photos),
                camera => desk.assign_camera(&photos, camera),
            }
            event::choose_first(&e);
        }>
            <option value="">{text::camera}</option>
            {move || cameras().into_iter().map(|id| view! { <option value=id.clone()>{id.clone()}</option> }).collect_view()}
            <option value=own>{text::camera_of_their_own}</option>
        </select>
    }
}

/// New names for the marked points: by a pattern, or by the nearest of the control points that were read.
#[component]
fn Naming(naming: RwSignal<bool>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let (pattern, start) = (RwSignal::new("P##".to_owned()), RwSignal::new("1".to_owned()));
    let tolerance = RwSignal::new(String::new());
    let given =
        move || desk.intake.pasted.with(|p| p.as_ref().map(|p| p.table.clone().split().0.len())).filter(|n| *n > 0);
    view! {
        <form class="sheet-form" on:submit=move |e| {
            e.prevent_default();
            if desk.rename_by_pattern(&pattern.get_untracked(), &start.get_untracked()) {
                naming.set(false);
            }
        }>
            <label><span>{text::pattern}</span>
                <input type="text" name="pattern" autocomplete="off" prop:value=pattern on:input=move |e| pattern.set(event::value(&e))/></label>
            <label><span>{text::pattern_start}</span>
                <input type="text" name="start" inputmode="numeric" prop:value=start on:input=move |e| start.set(event::value(&e))/></label>
            <button class="button small primary" type="submit">{text::rename_many}</button>
            <p class="hint">{text::pattern_hint}</p>
        </form>
        {move || match given() {
            Some(n) => view! {
                <form class="sheet-form" on:submit=move |e| {
                    e.prevent_default();
                    if desk.rename_by_nearest(&tolerance.get_untracked()) {
                        naming.set(false);
                    }
                }>
                    <label><span>{text::nearest_tolerance}</span>
                        <input type="text" name="tolerance" inputmode="decimal" prop:value=tolerance on:input=move |e| tolerance.set(event::value(&e))/></label>
                    <button class="button small" type="submit">{move || text::rename_nearest(n)}</button>
                </form>
            }.into_any(),
            None => view! { <p class="hint">{text::nearest_hint}</p> }.into_any(),
        }}
    }
}
