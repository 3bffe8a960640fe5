//! A table whose cells are chosen, typed into and marked; only the rows in sight are drawn.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;

use leptos::html::{Div, Input};
use leptos::prelude::*;
use sightline::exchange::quoted;

use super::{heading, plain_heading, shown, table_words};
use crate::browser::{event, page};
use crate::edit::cells::Cell;
use crate::edit::sheet::{Col, Sheet, Value};
use crate::i18n::text;
use crate::store::tables::Shared;
use crate::store::{Desk, Marking};

/// Rows drawn beyond what is in sight.
const MARGIN: usize = 10;

/// What is being typed: row of the sheet, column, and what the field begins with where that is not what stands there.
type Typing = Option<(u32, Col, Option<String>)>;

/// Rows as a spreadsheet takes them: the marked ones, or all that are shown.
pub fn copied(desk: Desk, sheet: &Sheet, rows: &[u32]) -> String {
    let marked = untrack(|| desk.marked(sheet.table.kind()));
    let columns = sheet.columns();
    let cell = |row: &u32, col: &Col| quoted(&sheet.value(*row as usize, *col).plain(), '\t').into_owned();
    let line = |row: &u32| columns.iter().map(|c| cell(row, c)).collect::<Vec<_>>().join("\t");
    let mut lines = vec![columns.iter().map(|c| plain_heading(desk, sheet.table, *c)).collect::<Vec<_>>().join("\t")];
    let wanted = |row: &&u32| marked.len() < 2 || marked.contains(&sheet.key(**row as usize));
    lines.extend(rows.iter().filter(wanted).map(line));
    lines.join("\n")
}

#[component]
pub fn Grid(sheet: Memo<Shared>, rows: Memo<Arc<Vec<u32>>>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let frame = NodeRef::<Div>::new();
    let (top, height, row_height) = (RwSignal::new(0.0_f64), RwSignal::new(600.0_f64), RwSignal::new(24.0_f64));
    // The row with the focus, by its place among those shown.
    let at = RwSignal::new(0_usize);
    let typing = RwSignal::new(None as Typing);
    let kind = move || sheet.with(|s| s.0.table.kind());
    let columns = move || sheet.with(|s| s.0.columns());
    let table = move || sheet.with(|s| s.0.table);
    Effect::new(move |_| {
        desk.tables.table.track();
        at.set(0);
        typing.set(None);
        if let Some(element) = frame.get_untracked() {
            element.set_scroll_top(0);
            top.set(0.0);
        }
    });
    let measure = move || {
        if let Some(element) = frame.get_untracked() {
            let (scroll, visible, row) = page::scroll_state(&element, "tbody tr.data");
            top.set(scroll);
            height.set(visible);
            if let Some(row) = row {
                row_height.set(row);
            }
        }
    };
    let window = Memo::new(move |_| {
        let total = rows.with(|rows| rows.len());
        let first = ((top.get() / row_height.get()) as usize).saturating_sub(MARGIN).min(total);
        let last = (first + (height.get() / row_height.get()) as usize + 2 * MARGIN + 2).min(total);
        (first, last)
    });
    let reveal = move |place: usize| {
        measure();
        let Some(element) = frame.get_untracked() else { return };
        let (row, scroll, visible) = (row_height.get_untracked(), top.get_untracked(), height.get_untracked());
        let (from, to) = (place as f64 * row, (place + 2) as f64 * row);
        if from < scroll {
            element.set_scroll_top(from as i32);
        } else if to > scroll + visible {
            element.set_scroll_top((to - visible).ceil() as i32);
        }
    };
    let choose = move |place: usize, how: Marking| {
        let Some(row) = rows.with_untracked(|rows| rows.get(place).copied()) else { return };
        at.set(place);
        sheet.with_untracked(|s| {
            let keys = |rows: &Vec<u32>| rows.iter().map(|row| s.0.key(*row as usize)).collect::<Vec<_>>();
            let order = if how == Marking::Range { rows.with_untracked(|rows| keys(rows)) } else { Vec::new() };
            desk.choose_row(untrack(kind), &s.0.key(row as usize), how, &order);
        });
        reveal(place);
    };
    let col = move || columns().get(desk.tables.col.get()).copied();
    let begin = move |with: Option<String>| {
        let Some(col) = untrack(col).filter(|col| untrack(table).editable(*col)) else { return false };
        let Some(row) = rows.with_untracked(|rows| rows.get(at.get_untracked()).copied()) else { return false };
        let flag = match sheet.with_untracked(|s| s.0.value(row as usize, col)) {
            Value::Flag(on) => Some(on),
            Value::NotUsed => Some(true),
            _ => None,
        };
        if let Some(on) = flag {
            let key = sheet.with_untracked(|s| s.0.key(row as usize));
            desk.set_cell(untrack(table), Cell { key, col, typed: u8::from(!on).to_string() });
        } else {
            typing.set(Some((row, col, with)));
        }
        true
    };
    let focus = move || {
        if let Some(element) = frame.get_untracked() {
            page::focus_in(&element, "table");
        }
    };
    let take = move |typed: String, down: bool| {
        let Some((row, col, _)) = typing.get_untracked() else { return };
        typing.set(None);
        let key = sheet.with_untracked(|s| s.0.key(row as usize));
        let place = at.get_untracked();
        let done = desk.set_cell(untrack(table), Cell { key, col, typed });
        focus();
        if done && down {
            choose((place + 1).min(rows.with_untracked(|r| r.len()).saturating_sub(1)), Marking::Only);
        }
    };
    let mark_all = move || {
        let all = sheet
            .with_untracked(|s| rows.with_untracked(|rows| rows.iter().map(|row| s.0.key(*row as usize)).collect()));
        desk.selection.update(|s| s.mark_all(untrack(kind), all));
    };
    let copy = move || desk.copy_text(sheet.with_untracked(|s| rows.with_untracked(|rows| copied(desk, &s.0, rows))));
    let fill = move || {
        if let Some(col) = untrack(col).filter(|col| untrack(table).editable(*col)) {
            sheet.with_untracked(|s| rows.with_untracked(|rows| desk.fill_down(&s.0, rows, col)));
        }
    };
    let keydown = move |e: leptos::ev::KeyboardEvent| {
        let key = event::key(&e);
        if !key.on_table {
            return;
        }
        let (place, last) = (at.get_untracked(), rows.with_untracked(|r| r.len()).saturating_sub(1));
        let page = ((height.get_untracked() / row_height.get_untracked()) as usize).saturating_sub(2).max(1);
        let how = if key.modifiers.shift { Marking::Range } else { Marking::Only };
        let width = untrack(columns).len();
        let to = match (key.key.as_str(), key.modifiers.control) {
            ("ArrowDown", false) => Some(place + 1),
            ("ArrowUp", false) => Some(place.saturating_sub(1)),
            ("PageDown", false) => Some(place + page),
            ("PageUp", false) => Some(place.saturating_sub(page)),
            ("Home", true) => Some(0),
            ("End", true) => Some(last),
            _ => None,
        };
        if let Some(to) = to {
            choose(to.min(last), how);
        }
        let verb = |verb: &dyn Fn()| {
            verb();
            true
        };
        let used = to.is_some()
            || match (key.key.as_str(), key.modifiers.control) {
                ("ArrowRight", false) => verb(&|| desk.tables.col.update(|c| *c = (*c + 1).min(width - 1))),
                ("ArrowLeft", false) => verb(&|| desk.tables.col.update(|c| *c = c.saturating_sub(1))),
                ("Enter" | "F2" | " ", false) => begin(None),
                ("Delete", false) => verb(&|| desk.delete_rows(untrack(table))),
                ("a" | "A", true) => verb(&mark_all),
                ("c" | "C", true) => verb(&copy),
                ("d" | "D", true) => verb(&fill),
                // The field takes what is pasted: the browser gives it to whatever has the focus.
                ("v" | "V", true) => {
                    page::focus_id("pasted-cells");
                    return;
                }
                // "?" lists the keys everywhere.
                ("?", _) => false,
                (typed, false) if typed.chars().count() == 1 && !key.modifiers.alt => begin(Some(typed.to_owned())),
                _ => false,
            };
        if used {
            e.prevent_default();
            e.stop_propagation();
        }
    };
    let sort_by = move |col: Col| {
        desk.tables.sorting.update(|sorting| {
            *sorting = match *sorting {
                Some((by, false)) if by == col => Some((col, true)),
                Some((by, true)) if by == col => None,
                _ => Some((col, false)),
            };
        });
    };
    let gap = move |rows: usize| format!("{}px", rows as f64 * row_height.get());
    let heads = move || {
        columns().iter().enumerate().map(|(k, &col)| {
            let by = move || desk.tables.sorting.get().filter(|(by, _)| *by == col).map(|(_, descending)| descending);
            let (words, unit) = heading(desk, table(), col);
            view! {
                <th scope="col" class:left=is_words(col) class:sorted=move || by().is_some() class:at=move || desk.tables.col.get() == k
                    aria-sort=move || match by() {
                        Some(true) => "descending",
                        Some(false) => "ascending",
                        None => "none",
                    }>
                    <button type="button" tabindex="-1" on:click=move |_| sort_by(col)>
                        {words} " " <u>{unit}</u>
                        {move || by().map(|descending| view! { <i class="direction" aria-hidden="true">{if descending { "▼" } else { "▲" }}</i> })}
                    </button>
                </th>
            }
        }).collect_view()
    };
    // A row that shows the same after an edit stays as it is.
    let drawn = move || {
        let (first, last) = window.get();
        let shared = sheet.get();
        rows.with(|rows| {
            let places = first..last.min(rows.len());
            places.map(|k| (k, rows[k], fingerprint(&shared.0, rows[k] as usize), shared.clone())).collect::<Vec<_>>()
        })
    };
    view! {
        <div class="scroll table-frame sheet-frame" node_ref=frame on:scroll=move |_| measure() on:pointerenter=move |_| measure()>
            <table class="table" role="grid" tabindex="0" aria-multiselectable="true" aria-label=move || table_words(table())
                aria-rowcount=move || (rows.with(|rows| rows.len()) + 1).to_string() on:keydown=keydown>
                <thead><tr>{heads}</tr></thead>
                <tbody>
                    <tr class="gap" aria-hidden="true" style:height=move || gap(window.get().0)></tr>
                    <For each=drawn key=|(k, row, fingerprint, _)| (*k, *row, *fingerprint)
                        children=move |(k, row, _, shared)| view! {
                            <Line k row shared at typing choose=Callback::new(move |(place, how)| choose(place, how))
                                begin=Callback::new(move |()| { begin(None); }) take=Callback::new(move |(typed, down)| take(typed, down))/>
                        }/>
                    <tr class="gap" aria-hidden="true" style:height=move || gap(rows.with(|rows| rows.len()).saturating_sub(window.get().1))></tr>
                </tbody>
            </table>
        </div>
    }
}

/// Tells whether a row drawn already shows the same.
fn fingerprint(sheet: &Sheet, row: usize) -> u64 {
    let mut hasher = DefaultHasher::new();
    (sheet.key(row), sheet.takes_part(row)).hash(&mut hasher);
    for &col in sheet.table.columns() {
        let value = sheet.value(row, col);
        (shown(&value), value.plain()).hash(&mut hasher);
    }
    hasher.finish()
}

fn is_words(col: Col) -> bool {
    matches!(
        col,
        Col::Id
            | Col::File
            | Col::Camera
            | Col::Model
            | Col::Role
            | Col::Photo
            | Col::Point
            | Col::From
            | Col::To
            | Col::TakesPart
    )
}

/// One row.
#[component]
fn Line(
    k: usize,
    row: u32,
    shared: Shared,
    at: RwSignal<usize>,
    typing: RwSignal<Typing>,
    choose: Callback<(usize, Marking)>,
    begin: Callback<()>,
    take: Callback<(String, bool)>,
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sheet = &shared.0;
    let (table, key) = (sheet.table, StoredValue::new(sheet.key(row as usize)));
    let marked = Memo::new(move |_| desk.selection.with(|s| key.with_value(|key| s.is_marked(table.kind(), key))));
    let focused = Memo::new(move |_| at.get() == k);
    let cells = sheet.columns().into_iter().enumerate().map(|(c, col)| {
        let value = sheet.value(row as usize, col);
        let words = shown(&value);
        let plain = StoredValue::new(value.plain());
        let editable = table.editable(col);
        let here = Memo::new(move |_| {
            typing.with(|t| t.as_ref().filter(|(r, c, _)| (*r, *c) == (row, col)).map(|(_, _, with)| with.clone()))
        });
        let clicked = move |e: leptos::ev::MouseEvent| {
            desk.tables.col.set(c);
            let how = match (e.shift_key(), e.ctrl_key() || e.meta_key()) {
                (true, _) => Marking::Range,
                (_, true) => Marking::Besides,
                _ => Marking::Only,
            };
            // A second click on the cell that has the focus types into it: with a finger there is no double click.
            let again = how == Marking::Only && focused.get_untracked() && marked.get_untracked() && e.detail() > 1;
            choose.run((k, how));
            if again {
                begin.run(());
            }
        };
        view! {
            <td class:left=is_words(col) class:editable=editable class:at=move || focused.get() && desk.tables.col.get() == c
                data-col=format!("{col:?}") on:click=clicked>
                {move || match here.get() {
                    None => words.clone().into_any(),
                    Some(with) => view! {
                        <TypingField value=with.unwrap_or_else(|| plain.get_value()) take cancel=Callback::new(move |()| typing.set(None))/>
                    }.into_any(),
                }}
            </td>
        }
    }).collect_view();
    let off = !sheet.takes_part(row as usize);
    view! {
        <tr class="data" class:marked=marked class:off=off data-key=key.get_value() aria-rowindex=(k + 2).to_string()
            aria-selected=move || marked.get().to_string()>{cells}</tr>
    }
}

/// The field in a cell: Enter takes what is typed and goes down, leaving takes it, Escape does not.
#[component]
fn TypingField(value: String, take: Callback<(String, bool)>, cancel: Callback<()>) -> impl IntoView {
    let input = NodeRef::<Input>::new();
    let done = StoredValue::new(false);
    input.on_load(|input| {
        let _ = input.focus();
        let end = input.value().len() as u32;
        let _ = input.set_selection_range(end, end);
    });
    let finish = move |typed: String, down: bool| {
        if !done.get_value() {
            done.set_value(true);
            take.run((typed, down));
        }
    };
    view! {
        <input type="text" class="value" name="cell" autocomplete="off" aria-label=text::value_of_cell node_ref=input prop:value=value
            on:click=|e| e.stop_propagation()
            on:change=move |e| finish(event::value(&e), false)
            on:blur=move |_| if !done.try_get_value().unwrap_or(true) {
                done.set_value(true);
                cancel.run(());
            }
            on:keydown=move |e| {
                let key = event::key(&e);
                e.stop_propagation();
                match key.key.as_str() {
                    "Enter" if !e.is_composing() => {
                        e.prevent_default();
                        if let Some(input) = input.get_untracked() {
                            finish(input.value(), true);
                        }
                    }
                    "Escape" => {
                        done.set_value(true);
                        cancel.run(());
                    }
                    _ => {}
                }
            }/>
    }
}
