//! A table whose cells are chosen, typed into and marked; only the rows in sight are drawn.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;

use leptos::html::Input;
use leptos::prelude::*;
use sightline_exchange::quoted;

use super::{heading, plain_heading, shown, table_words};
use crate::browser::event::Key;
use crate::browser::{event, page};
use crate::document::Table;
use crate::edit::cells::CellEdit;
use crate::edit::sheet::{Col, Sheet, Value};
use crate::i18n::text;
use crate::store::tables::Shared;
use crate::store::{Desk, Marking};
use crate::view::components::visible_rows::VisibleRows;

/// The cell being edited: row of the sheet, column, and what the field begins with where that is not what stands there.
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

/// State of the grid: the row with the focus and the cell that is being typed into.
#[derive(Clone, Copy)]
struct GridState {
    desk: Desk,
    sheet: Memo<Shared>,
    /// Rows of the sheet in the order in which they are shown.
    rows: Memo<Arc<Vec<u32>>>,
    scroll: VisibleRows,
    /// The row with the focus, by its place among those shown.
    at: RwSignal<usize>,
    typing: RwSignal<Typing>,
}

impl GridState {
    fn new(desk: Desk, sheet: Memo<Shared>, rows: Memo<Arc<Vec<u32>>>) -> Self {
        Self { desk, sheet, rows, scroll: VisibleRows::new(), at: RwSignal::new(0), typing: RwSignal::new(None) }
    }

    /// Begins at the top when another table is shown.
    fn follow_table(self) {
        Effect::new(move |_| {
            self.desk.tables.table.track();
            self.at.set(0);
            self.typing.set(None);
            self.scroll.scroll_to_top();
        });
    }

    fn table(self) -> Table {
        self.sheet.with_untracked(|s| s.0.table)
    }

    fn key_of(self, row: u32) -> String {
        self.sheet.with_untracked(|s| s.0.key(row as usize))
    }

    /// Keys of all rows that are shown.
    fn keys<All: FromIterator<String>>(self) -> All {
        self.sheet.with_untracked(|s| {
            self.rows.with_untracked(|rows| rows.iter().map(|row| s.0.key(*row as usize)).collect())
        })
    }

    fn row_at(self, place: usize) -> Option<u32> {
        self.rows.with_untracked(|rows| rows.get(place).copied())
    }

    /// Place of the last row.
    fn last(self) -> usize {
        self.rows.with_untracked(|rows| rows.len()).saturating_sub(1)
    }

    /// The column with the focus, if it can be typed into.
    fn editable_column(self) -> Option<Col> {
        let col = self.desk.tables.col.get_untracked();
        let col = self.sheet.with_untracked(|s| s.0.columns().get(col).copied())?;
        self.table().editable(col).then_some(col)
    }

    fn choose(self, place: usize, how: Marking) {
        let Some(row) = self.row_at(place) else { return };
        self.at.set(place);
        let order: Vec<String> = if how == Marking::Range { self.keys() } else { Vec::new() };
        self.desk.choose_row(self.table().kind(), &self.key_of(row), how, &order);
        self.scroll.reveal(place);
    }

    /// Opens the field in the cell with the focus, with this text if any; a flag is switched at once. Whether the cell can be changed.
    fn begin(self, with: Option<String>) -> bool {
        let Some(col) = self.editable_column() else { return false };
        let Some(row) = self.row_at(self.at.get_untracked()) else { return false };
        let flag = match self.sheet.with_untracked(|s| s.0.value(row as usize, col)) {
            Value::Flag(on) => Some(on),
            Value::NotUsed => Some(true),
            _ => None,
        };
        if let Some(on) = flag {
            let cell = CellEdit { key: self.key_of(row), col, typed: u8::from(!on).to_string() };
            self.desk.set_cell(self.table(), cell);
        } else {
            self.typing.set(Some((row, col, with)));
        }
        true
    }

    /// Takes what was typed; `down` goes on to the next row if it was accepted.
    fn take(self, typed: String, down: bool) {
        let Some((row, col, _)) = self.typing.get_untracked() else { return };
        self.typing.set(None);
        let place = self.at.get_untracked();
        let accepted = self.desk.set_cell(self.table(), CellEdit { key: self.key_of(row), col, typed });
        if let Some(element) = self.scroll.frame.get_untracked() {
            page::focus_in(&element, "table");
        }
        if accepted && down {
            self.choose((place + 1).min(self.last()), Marking::Only);
        }
    }

    fn mark_all(self) {
        let all = self.keys();
        self.desk.selection.update(|s| s.mark_all(self.table().kind(), all));
    }

    fn copy(self) {
        let (desk, rows) = (self.desk, self.rows);
        desk.copy_text(self.sheet.with_untracked(|s| rows.with_untracked(|rows| copied(desk, &s.0, rows))));
    }

    fn fill_down(self) {
        if let Some(col) = self.editable_column() {
            self.sheet.with_untracked(|s| self.rows.with_untracked(|rows| self.desk.fill_down(&s.0, rows, col)));
        }
    }

    fn key(self, e: &leptos::ev::KeyboardEvent) {
        let key = event::key(e);
        if !key.on_table {
            return;
        }
        // The field takes what is pasted: the browser gives it to whatever has the focus.
        if let ("v" | "V", true) = (key.key.as_str(), key.modifiers.control) {
            return page::focus_id("pasted-cells");
        }
        if self.go(&key) || self.act(&key) {
            e.prevent_default();
            e.stop_propagation();
        }
    }

    /// Keys that go to another row.
    fn go(self, key: &Key) -> bool {
        let (place, page) = (self.at.get_untracked(), self.scroll.page());
        let to = match (key.key.as_str(), key.modifiers.control) {
            ("ArrowDown", false) => place + 1,
            ("ArrowUp", false) => place.saturating_sub(1),
            ("PageDown", false) => place + page,
            ("PageUp", false) => place.saturating_sub(page),
            ("Home", true) => 0,
            ("End", true) => self.last(),
            _ => return false,
        };
        self.choose(to.min(self.last()), if key.modifiers.shift { Marking::Range } else { Marking::Only });
        true
    }

    /// All other keys of the grid.
    fn act(self, key: &Key) -> bool {
        let width = self.sheet.with_untracked(|s| s.0.columns().len());
        let col = self.desk.tables.col;
        match (key.key.as_str(), key.modifiers.control) {
            ("ArrowRight", false) => col.update(|c| *c = (*c + 1).min(width - 1)),
            ("ArrowLeft", false) => col.update(|c| *c = c.saturating_sub(1)),
            ("Enter" | "F2" | " ", false) => return self.begin(None),
            ("Delete", false) => self.desk.delete_rows(self.table()),
            ("a" | "A", true) => self.mark_all(),
            ("c" | "C", true) => self.copy(),
            ("d" | "D", true) => self.fill_down(),
            // "?" lists the keys everywhere.
            ("?", _) => return false,
            (typed, false) if typed.chars().count() == 1 && !key.modifiers.alt => {
                return self.begin(Some(typed.to_owned()));
            }
            _ => return false,
        }
        true
    }
}

#[component]
pub fn Grid(sheet: Memo<Shared>, rows: Memo<Arc<Vec<u32>>>) -> impl IntoView {
    let state = GridState::new(expect_context::<Desk>(), sheet, rows);
    state.follow_table();
    let scroll = state.scroll;
    let window = Memo::new(move |_| scroll.range(rows.with(|rows| rows.len())));
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
        <div class="scroll table-frame sheet-frame" node_ref=scroll.frame on:scroll=move |_| scroll.measure() on:pointerenter=move |_| scroll.measure()>
            <table class="table" role="grid" tabindex="0" aria-multiselectable="true" aria-label=move || table_words(sheet.with(|s| s.0.table))
                aria-rowcount=move || (rows.with(|rows| rows.len()) + 1).to_string() on:keydown=move |e| state.key(&e)>
                <thead><tr><Headings sheet/></tr></thead>
                <tbody>
                    <tr class="gap" aria-hidden="true" style:height=move || scroll.gap(window.get().0)></tr>
                    <For each=drawn key=|(k, row, fingerprint, _)| (*k, *row, *fingerprint)
                        children=move |(k, row, _, shared)| view! {
                            <Line k row shared state/>
                        }/>
                    <tr class="gap" aria-hidden="true" style:height=move || scroll.gap(rows.with(|rows| rows.len()).saturating_sub(window.get().1))></tr>
                </tbody>
            </table>
        </div>
    }
}

/// The headings; a click sorts by a column, the second turns the order round, the third ends sorting.
#[component]
fn Headings(sheet: Memo<Shared>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sort_by = move |col: Col| {
        desk.tables.sorting.update(|sorting| {
            *sorting = match *sorting {
                Some((by, false)) if by == col => Some((col, true)),
                Some((by, true)) if by == col => None,
                _ => Some((col, false)),
            };
        });
    };
    move || {
        let (table, columns) = sheet.with(|s| (s.0.table, s.0.columns()));
        columns.iter().enumerate().map(|(k, &col)| {
            let by = move || desk.tables.sorting.get().filter(|(by, _)| *by == col).map(|(_, descending)| descending);
            let (words, unit) = heading(desk, table, col);
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
fn Line(k: usize, row: u32, shared: Shared, state: GridState) -> impl IntoView {
    let GridState { desk, at, typing, .. } = state;
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
            state.choose(k, how);
            if again {
                state.begin(None);
            }
        };
        view! {
            <td class:left=is_words(col) class:editable=editable class:at=move || focused.get() && desk.tables.col.get() == c
                data-col=format!("{col:?}") on:click=clicked>
                {move || match here.get() {
                    None => words.clone().into_any(),
                    Some(with) => view! {
                        <TypingField value=with.unwrap_or_else(|| plain.get_value()) take=Callback::new(move |(typed, down)| state.take(typed, down)) cancel=Callback::new(move |()| typing.set(None))/>
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
