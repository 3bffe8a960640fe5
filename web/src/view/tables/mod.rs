//! The tables of the document, beside the path: seven of them, one at a time, with the photo of what is chosen.

mod actions;
mod grid;
mod paste;

use crate::view::components::changes::table_words;
use std::sync::Arc;

use leptos::prelude::*;

use super::identities::NamedPhoto;
use crate::browser::event;
use crate::document::Table;
use crate::edit::sheet::{Col, Sheet, Value};
use crate::format;
use crate::i18n::{Text, text, text::role_word};
use crate::store::Desk;
use crate::store::tables::{Condition, Shared};
use crate::view::components::title::TitleBar;
use crate::view::components::units::length_unit;

use actions::Actions;
use grid::Grid;
use paste::PastePanel;

/// A column's heading, and its unit where it has one.
pub fn heading(desk: Desk, table: Table, col: Col) -> (String, String) {
    let unit = || desk.document.with_untracked(length_unit);
    let axes = desk.document.with_untracked(|d| d.project.shown_axes());
    let (words, unit): (&str, String) = match col {
        Col::Id => (text::id(), String::new()),
        Col::File => (text::file(), String::new()),
        Col::Camera => (text::camera(), String::new()),
        Col::TakesPart => (text::take_part_short(), String::new()),
        Col::Count if table == Table::Cameras => (text::photos(), String::new()),
        Col::Count => (text::points_column(), String::new()),
        Col::Width => (text::width(), "px".into()),
        Col::Height => (text::height(), "px".into()),
        Col::Pitch => (text::pixel_pitch(), "µm".into()),
        Col::Distance => (text::principal_distance(), String::new()),
        Col::Model => (text::model(), String::new()),
        Col::Rays => (text::rays(), String::new()),
        Col::Role => (text::role(), String::new()),
        Col::X => (axes.letter(0), unit()),
        Col::Y => (axes.letter(1), unit()),
        Col::Z => (axes.letter(2), unit()),
        Col::SigmaX => return (format!("σ{}", axes.letter(0)), unit()),
        Col::SigmaY => return (format!("σ{}", axes.letter(1)), unit()),
        Col::SigmaZ => return (format!("σ{}", axes.letter(2)), unit()),
        Col::Diameter => (text::diameter(), unit()),
        Col::Photo => (text::photo(), String::new()),
        Col::Point => (text::point_column(), String::new()),
        Col::U => ("u", "px".into()),
        Col::V => ("v", "px".into()),
        Col::Sigma if table == Table::Distances => ("σ", unit()),
        Col::Sigma => ("σ", "px".into()),
        Col::ResidualX => ("vx", "px".into()),
        Col::ResidualY => ("vy", "px".into()),
        Col::W => ("w", String::new()),
        Col::Redundancy => ("r", String::new()),
        Col::From => (text::from_point(), String::new()),
        Col::To => (text::to_point(), String::new()),
        Col::Length => (text::length(), unit()),
        Col::Target => (text::target_column(), String::new()),
        Col::Code => (text::code(), String::new()),
        Col::Contrast => (text::contrast(), String::new()),
    };
    (words.to_owned(), unit)
}

/// A heading as a spreadsheet has it.
fn plain_heading(desk: Desk, table: Table, col: Col) -> String {
    let (words, unit) = heading(desk, table, col);
    if unit.is_empty() { words } else { format!("{words} [{unit}]") }
}

/// A value as people read it.
pub fn shown(value: &Value) -> String {
    match value {
        Value::Nothing => String::new(),
        Value::Words(words) => words.clone(),
        Value::Count(n) => format::count(*n),
        Value::Number(value, decimals) => format::fixed(*value, *decimals),
        Value::Flag(true) => "✓".into(),
        Value::Flag(false) => "–".into(),
        Value::NotUsed => text::not_used_cell().to_owned(),
        Value::Role(role) => role_word(*role).to_owned(),
    }
}

fn condition_words(condition: Condition) -> Text {
    match condition {
        Condition::All => text::all_rows,
        Condition::FewRays => text::few_rays,
        Condition::LargeW => text::large_w,
        Condition::Excluded => text::legend_excluded,
        Condition::Unnamed => text::no_name,
        Condition::Marked => text::marked_rows,
    }
}

#[component]
pub fn Tables() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let table = desk.tables.table;
    let sheet = Memo::new(move |_| Shared(Arc::new(desk.document.with(|d| Sheet::new(table.get(), d)))));
    let rows = Memo::new(move |_| Arc::new(sheet.with(|sheet| desk.shown_rows(&sheet.0))));
    let sentence = move || {
        let (all, shown) = (sheet.with(|sheet| sheet.0.len()), rows.with(|rows| rows.len()));
        text::rows_shown(format::count(shown), format::count(all))
    };
    view! {
        <TitleBar title=text::tables sentence=Signal::derive(sentence)/>
        <main class="tables">
            <section class="sheet">
                <nav class="tabs" aria-label=text::tables>
                    {Table::ALL.into_iter().map(|one| view! {
                        <button type="button" data-table=format!("{one:?}") aria-current=move || (table.get() == one).then_some("true")
                            on:click=move |_| desk.show_table(one)>{move || table_words(one)}</button>
                    }).collect_view()}
                </nav>
                <div class="sheet-filter">
                    <input type="search" name="filter" autocomplete="off" aria-label=text::filter_text placeholder=text::filter_text
                        prop:value=move || desk.tables.text.get() on:input=move |e| desk.tables.text.set(event::value(&e))/>
                    <div class="conditions" role="group" aria-label=text::conditions>
                        {move || Condition::of(table.get()).iter().map(|&condition| view! {
                            <button type="button" data-condition=format!("{condition:?}")
                                aria-pressed=move || (desk.tables.condition.get() == condition).to_string()
                                on:click=move |_| desk.tables.condition.set(condition)>{condition_words(condition)}</button>
                        }).collect_view()}
                    </div>
                </div>
                <Grid sheet rows/>
                <PastePanel sheet rows/>
                <Actions sheet rows/>
            </section>
            <NamedPhoto/>
        </main>
    }
}
