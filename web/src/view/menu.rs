//! The file menu in the head: actions on projects, and pages outside the steps.

use leptos::html::Button;
use leptos::prelude::*;

use crate::document::Document;
use crate::i18n::{
    calibrating, equipment, experiments, first, inside, interchange, monitoring, planning, printing, text,
};
use crate::store::{Desk, Menu, Step};
use crate::view::components::choosing::choose_project;

/// The button and what it opens; on a phone its items are in the single menu.
#[component]
pub fn FileMenu() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let open = Memo::new(move |_| desk.window.menu.get() == Some(Menu::File));
    let empty = Memo::new(move |_| desk.document.with(Document::is_empty));
    let photos = Memo::new(move |_| desk.document.with(|d| !d.project.photos.is_empty()));
    let button = NodeRef::<Button>::new();
    let item = move |words: crate::i18n::Text, name: &'static str, act: fn(Desk)| {
        view! {
            <button class="text-button" data-file=name on:click=move |_| {
                desk.window.menu.set(None);
                act(desk);
            }>{words}</button>
        }
    };
    let place = move |words: crate::i18n::Text, step: Step, go: fn(Desk)| {
        view! {
            <button class=format!("text-button to-{}", step.name()) aria-current=move || (desk.step.get() == step).then_some("page")
                on:click=move |_| {
                    desk.window.menu.set(None);
                    go(desk);
                }>{words}</button>
        }
    };
    // Closed by the key that closes, the menu gives the focus back.
    let keys = move |e: leptos::ev::KeyboardEvent| {
        if crate::browser::event::key(&e).key == "Escape"
            && open.get_untracked()
            && let Some(button) = button.get()
        {
            let _ = button.focus();
        }
    };
    view! {
        <div class="file" on:keydown=keys>
            <button class="text-button file-button" node_ref=button aria-expanded=move || open.get().to_string() data-action="file"
                on:click=move |_| desk.window.menu.update(|menu| *menu = if *menu == Some(Menu::File) { None } else { Some(Menu::File) })>{first::file}</button>
            <div class="file-menu" class:open=open>
                {item(first::new_project, "new", |desk| desk.new_project())}
                {item(text::open_project, "open", choose_project)}
                <Show when=move || !empty.get()>
                    <button class="text-button" data-file="save" title=text::save_hint on:click=move |e| {
                        desk.window.menu.set(None);
                        desk.save(e.shift_key());
                    }>{text::save}</button>
                    <button class="text-button" data-file="save-all" title=text::save_all_hint on:click=move |_| {
                        desk.window.menu.set(None);
                        desk.save(true);
                    }>{text::save_all}</button>
                </Show>
                <Show when=move || photos.get()>
                    {place(calibrating::calibrate, Step::Calibrate, |desk| desk.go(Step::Calibrate))}
                    {place(interchange::files_for_others, Step::Files, |desk| desk.go(Step::Files))}
                </Show>
                <span class="rule"></span>
                {place(planning::plan, Step::Plan, |desk| desk.go(Step::Plan))}
                {place(printing::targets_to_print, Step::Print, |desk| desk.go(Step::Print))}
                {place(equipment::equipment, Step::Equipment, |desk| desk.go(Step::Equipment))}
                {place(monitoring::monitoring, Step::Monitoring, |desk| desk.show_monitoring())}
                {place(inside::inside, Step::Inside, |desk| desk.go(Step::Inside))}
                {place(experiments::experiments, Step::Experiments, |desk| desk.show_experiment(desk.experiments.shown.get_untracked()))}
            </div>
        </div>
    }
}

/// Layer behind an open menu: a click on it only closes the menu.
#[component]
pub fn MenuGround() -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <Show when=move || desk.window.menu.with(Option::is_some)>
            <div class="menu-ground" aria-hidden="true" on:click=move |_| desk.window.menu.set(None)></div>
        </Show>
    }
}
