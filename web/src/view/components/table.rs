//! A table of numbers: sorted by its headings, only the rows in sight are drawn, keys and clicks choose a row, and the whole
//! can be copied into a spreadsheet.

use std::borrow::Cow;
use std::cmp::Ordering;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;

use leptos::prelude::*;
use sightline_exchange::quoted;

use super::icon::{Glyph, Icon};
use super::keys;
use super::visible_rows::VisibleRows;
use sightline::axes::ShownAxes;

use crate::browser::event;
use crate::edit::natural;
use crate::format;
use crate::i18n::text;
use crate::store::{Desk, Kind, Marking};

/// A heading: a word or a symbol, with its unit.
#[derive(Clone)]
pub struct Column {
    pub name: fn() -> &'static str,
    /// The letter of an axis behind the name, as in ΔX.
    pub axis: &'static str,
    /// The letter set low after the name, as in σ with X.
    pub low: &'static str,
    pub unit: String,
    pub left: bool,
}

impl Column {
    pub fn number(name: fn() -> &'static str) -> Self {
        Self { name, axis: "", low: "", unit: String::new(), left: false }
    }

    pub fn words(name: fn() -> &'static str) -> Self {
        Self { left: true, ..Self::number(name) }
    }

    /// A coordinate, or with a sign before its letter what is of one.
    pub fn axis(sign: fn() -> &'static str, axis: &'static str) -> Self {
        Self { axis, ..Self::number(sign) }
    }

    /// Three coordinates and their standard errors in the order of the user.
    pub fn coordinates(axes: ShownAxes, unit: &str) -> impl Iterator<Item = Self> + use<'_> {
        let plain = axes.names().map(|axis| Self::axis(|| "", axis).unit(unit));
        plain.into_iter().chain(axes.names().map(|axis| Self::number(|| "σ").low(axis).unit(unit)))
    }

    pub fn low(self, low: &'static str) -> Self {
        Self { low, ..self }
    }

    pub fn unit(self, unit: impl Into<String>) -> Self {
        Self { unit: unit.into(), ..self }
    }
}

/// Content of a cell. It is formatted when it is drawn or copied, since most rows of a large table are never visible.
#[derive(Clone, Debug, PartialEq)]
enum Content {
    Words(String),
    Count(usize),
    /// With its decimals.
    Number(Option<f64>, usize),
}

/// A cell: what is shown, what is copied, and what is sorted by.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    content: Content,
    pub order: Option<f64>,
    /// Words shown instead of a number; the number is copied.
    pub instead: Option<&'static str>,
    pub class: &'static str,
    /// A bar beside the number, 0 to 1.
    pub bar: Option<f64>,
}

impl Cell {
    fn new(content: Content, order: Option<f64>) -> Self {
        Self { content, order, instead: None, class: "", bar: None }
    }

    pub fn words(words: impl Into<String>) -> Self {
        Self { class: "left", ..Self::new(Content::Words(words.into()), None) }
    }

    pub fn id(id: &str) -> Self {
        Self { class: "left id", ..Self::words(id) }
    }

    pub fn count(n: usize) -> Self {
        Self::new(Content::Count(n), Some(n as f64))
    }

    pub fn number(value: Option<f64>, decimals: usize) -> Self {
        Self::new(Content::Number(value, decimals), value)
    }

    /// As it is shown.
    pub fn shown(&self) -> Cow<'_, str> {
        match (self.instead, &self.content) {
            (Some(words), _) => words.into(),
            (None, Content::Words(words)) => words.into(),
            (None, Content::Count(n)) => format::count(*n).into(),
            (None, Content::Number(value, decimals)) => format::maybe(*value, *decimals).into(),
        }
    }

    /// As it is copied.
    pub fn plain(&self) -> Cow<'_, str> {
        match &self.content {
            Content::Words(words) => words.into(),
            Content::Count(n) => n.to_string().into(),
            Content::Number(value, _) => value.map(|v| v.to_string()).unwrap_or_default().into(),
        }
    }

    pub fn class(self, class: &'static str) -> Self {
        Self { class, ..self }
    }
}

/// A row; its key is what choosing it chooses.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    pub key: String,
    pub cells: Vec<Cell>,
    /// It is not used.
    pub off: bool,
}

/// Sorted by a column, largest first or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sorting {
    pub column: usize,
    pub descending: bool,
}

fn compare(a: &Row, b: &Row, sorting: Sorting) -> Ordering {
    let cells = (a.cells.get(sorting.column), b.cells.get(sorting.column));
    let (Some(x), Some(y)) = cells else { return Ordering::Equal };
    let order = match (x.order, y.order) {
        (Some(x), Some(y)) => x.total_cmp(&y),
        (None, None) => natural(&x.plain(), &y.plain()),
        // What has no number comes last either way.
        (Some(_), None) => return Ordering::Less,
        (None, Some(_)) => return Ordering::Greater,
    };
    let order = if sorting.descending { order.reverse() } else { order };
    order.then_with(|| natural(&a.key, &b.key))
}

impl Row {
    /// Tells whether a row drawn already shows the same.
    fn fingerprint(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.key.hash(&mut hasher);
        self.off.hash(&mut hasher);
        for cell in &self.cells {
            (cell.shown(), cell.class, cell.bar.map(f64::to_bits)).hash(&mut hasher);
        }
        hasher.finish()
    }
}

/// Places of the rows in the order of a sorting.
fn order_of(rows: &[Row], sorting: Option<Sorting>) -> Vec<usize> {
    let mut order = (0..rows.len()).collect::<Vec<_>>();
    if let Some(sorting) = sorting {
        // Most rows differ in one number, which is looked up once: a large table is sorted without reading its rows.
        let number = |row: &Row| row.cells.get(sorting.column).and_then(|cell| cell.order);
        let numbers = rows.iter().map(number).collect::<Vec<_>>();
        order.sort_by(|&a, &b| match (numbers[a], numbers[b]) {
            (Some(x), Some(y)) if x != y => {
                if sorting.descending {
                    y.total_cmp(&x)
                } else {
                    x.total_cmp(&y)
                }
            }
            _ => compare(&rows[a], &rows[b], sorting),
        });
    }
    order
}

/// The row that a key goes to from the present one.
fn neighbour(key: &str, at: Option<usize>, rows: usize, page: usize) -> Option<usize> {
    let last = rows.checked_sub(1)?;
    let to = match (key, at) {
        ("Home", _) | ("ArrowDown" | "PageDown", None) => 0,
        ("End", _) | ("ArrowUp" | "PageUp", None) => last,
        ("ArrowDown", Some(at)) => at + 1,
        ("ArrowUp", Some(at)) => at.saturating_sub(1),
        ("PageDown", Some(at)) => at + page,
        ("PageUp", Some(at)) => at.saturating_sub(page),
        _ => return None,
    };
    Some(to.min(last))
}

#[component]
pub fn NumberTable(
    label: fn() -> &'static str,
    #[prop(into)] columns: Signal<Vec<Column>>,
    #[prop(into)] rows: Signal<Vec<Row>>,
    #[prop(into)] chosen: Signal<Option<String>>,
    on_choose: Callback<String>,
    sorting: RwSignal<Option<Sorting>>,
    #[prop(default = "")] class: &'static str,
    /// Opens what a row is about: a double click, Enter on the chosen row, or the arrow at its end.
    #[prop(optional, into)]
    on_open: Option<Callback<String>>,
    /// Kind of its rows: many of them can be marked, with Control and Shift.
    #[prop(optional, into)]
    kind: Option<Kind>,
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    // The places of the rows in the order in which they stand.
    let sorted = Memo::new(move |_| Arc::new(rows.with(|rows| order_of(rows, sorting.get()))));
    let count = move || sorted.with(|order| order.len());
    let key_at = move |at: usize| {
        let row = sorted.with_untracked(|order| order.get(at).copied());
        row.and_then(|row| rows.with_untracked(|rows| rows.get(row).map(|row| row.key.clone())))
    };
    let keys = move || {
        let order = sorted.get_untracked();
        rows.with_untracked(|rows| {
            order.iter().filter_map(|&row| rows.get(row)).map(|row| row.key.clone()).collect::<Vec<_>>()
        })
    };
    let scroll = VisibleRows::new();
    let window = Memo::new(move |_| scroll.range(count()));
    let place = move |key: &str| {
        let order = sorted.get();
        rows.with(|rows| order.iter().position(|&row| rows.get(row).is_some_and(|row| row.key == key)))
    };
    // A row chosen anywhere is brought into sight; a sorted table begins at its top, with what it is sorted for.
    let sorted_first = sorting.with_untracked(Option::is_some);
    Effect::new(move |shown: Option<bool>| {
        let key = chosen.get();
        if scroll.frame.get().is_none() {
            return false;
        }
        if let Some(at) = key.and_then(|key| untrack(|| place(&key))).filter(|_| shown == Some(true) || !sorted_first) {
            scroll.reveal(at);
        }
        true
    });
    let choose = move |key: String, how: Marking| match kind {
        Some(kind) if how != Marking::Only => {
            let order = keys();
            desk.choose_row(kind, &key, how, &order);
        }
        _ => on_choose.run(key),
    };
    let keydown = move |e: leptos::ev::KeyboardEvent| {
        let at = chosen.get_untracked().and_then(|key| untrack(|| place(&key)));
        let rows = untrack(count);
        let key = event::key(&e);
        if let (true, "Enter", Some(open), Some(row)) =
            (key.on_table, key.key.as_str(), on_open, chosen.get_untracked())
        {
            e.prevent_default();
            return open.run(row);
        }
        let to = if key.on_table { neighbour(&key.key, at, rows, scroll.page()) } else { None };
        if let Some(row) = to.and_then(key_at) {
            e.prevent_default();
            choose(row, if key.modifiers.shift { Marking::Range } else { Marking::Only });
        }
        if let (true, "a" | "A", true, Some(kind)) = (key.on_table, key.key.as_str(), key.modifiers.control, kind) {
            e.prevent_default();
            desk.selection.update(|s| s.mark_all(kind, keys().into_iter().collect()));
        }
        if keys::in_table(desk, &key) {
            e.prevent_default();
        }
    };
    view! {
        <div class="scroll table-frame" node_ref=scroll.frame on:scroll=move |_| scroll.measure() on:pointerenter=move |_| scroll.measure()>
            <table class=format!("table {class}") aria-label=label role="grid" aria-multiselectable=kind.map(|_| "true") tabindex="0" on:keydown=keydown
                aria-rowcount=move || (count() + 1).to_string()>
                <thead>
                    <tr>
                        <Headings columns sorting/>
                        {on_open.map(|_| view! { <th class="open"><span class="visually-hidden">{text::show}</span></th> })}
                    </tr>
                </thead>
                <tbody>
                    <tr class="gap" aria-hidden="true" style:height=move || scroll.gap(window.get().0)></tr>
                    <For
                        each=move || {
                            let (first, last) = window.get();
                            let order = sorted.get();
                            let seen = &order[first.min(order.len())..last.min(order.len())];
                            rows.with(|rows| seen.iter().filter_map(|&row| rows.get(row).cloned()).collect::<Vec<_>>())
                        }
                        key=Row::fingerprint
                        children=move |row| view! { <TableRow row chosen choose=Callback::new(move |(key, how)| choose(key, how)) on_open kind/> }
                    />
                    <tr class="gap" aria-hidden="true" style:height=move || scroll.gap(count().saturating_sub(window.get().1))></tr>
                </tbody>
            </table>
        </div>
    }
}

/// The headings; a click sorts by a column, another one turns the order round.
#[component]
fn Headings(columns: Signal<Vec<Column>>, sorting: RwSignal<Option<Sorting>>) -> impl IntoView {
    let sort_by = move |column: usize| {
        sorting.update(|sorting| {
            *sorting = match *sorting {
                Some(s) if s.column == column && s.descending => Some(Sorting { column, descending: false }),
                Some(s) if s.column == column => None,
                _ => Some(Sorting { column, descending: !columns.with_untracked(|c| c[column].left) }),
            };
        });
    };
    move || {
        let heading = |(i, column): (usize, Column)| {
            let by = move || sorting.get().filter(|s| s.column == i);
            view! {
                <th
                    class:left=column.left
                    class:sorted=move || by().is_some()
                    aria-sort=move || match by() {
                        Some(s) => if s.descending { "descending" } else { "ascending" },
                        None => "none",
                    }
                    scope="col"
                >
                    <button on:click=move |_| sort_by(i)>
                        {column.name}{column.axis}<sub>{column.low}</sub>" "<u>{column.unit.clone()}</u>
                        {move || by().map(|s| view! {
                            <i class="direction" aria-hidden="true">{if s.descending { "▼" } else { "▲" }}</i>
                        })}
                    </button>
                </th>
            }
        };
        columns.get().into_iter().enumerate().map(heading).collect_view()
    }
}

#[component]
fn TableRow(
    row: Row,
    chosen: Signal<Option<String>>,
    choose: Callback<(String, Marking)>,
    on_open: Option<Callback<String>>,
    kind: Option<Kind>,
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let key = StoredValue::new(row.key.clone());
    let is_chosen = Memo::new(move |_| chosen.with(|c| c.as_ref().is_some_and(|c| key.with_value(|key| key == c))));
    let is_marked = Memo::new(move |_| {
        kind.is_some_and(|kind| desk.selection.with(|s| key.with_value(|key| s.is_marked(kind, key))))
    });
    let clicked = move |e: leptos::ev::MouseEvent| {
        let how = match (e.shift_key(), e.ctrl_key() || e.meta_key()) {
            (true, _) => Marking::Range,
            (_, true) => Marking::Besides,
            _ => Marking::Only,
        };
        choose.run((key.get_value(), how));
    };
    view! {
        <tr
            class="data"
            class:marked=is_marked
            class:chosen=is_chosen
            class:off=row.off
            data-key=row.key
            aria-selected=move || (is_chosen.get() || is_marked.get()).to_string()
            on:click=clicked
            on:dblclick=move |_| if let Some(open) = on_open { open.run(key.get_value()) }
        >
            {row.cells.into_iter().map(|cell| view! {
                <td class=cell.class>
                    {cell.shown().into_owned()}
                    {cell.bar.map(|bar| view! { <i class="bar-cell" style:width=format!("{:.0}px", 4.0 + 36.0 * bar)></i> })}
                </td>
            }).collect_view()}
            {on_open.map(|open| view! {
                <td class="open">
                    <button class="link" tabindex="-1" aria-label=text::show on:click=move |e| {
                        e.stop_propagation();
                        open.run(key.get_value());
                    }><Glyph icon=Icon::Arrow size=14/></button>
                </td>
            })}
        </tr>
    }
}

/// Copies a table as a spreadsheet takes it: tabs, '.' for decimals, no grouping.
pub fn to_tsv(columns: &[Column], rows: &[Row]) -> String {
    let heading = columns.iter().map(|c| {
        let unit = if c.unit.is_empty() { String::new() } else { format!(" [{}]", c.unit) };
        format!("{}{}{}{unit}", (c.name)(), c.axis, c.low)
    });
    let cells = |row: &Row| row.cells.iter().map(|c| quoted(&c.plain(), '\t').into_owned()).collect::<Vec<_>>();
    let mut lines = vec![heading.collect::<Vec<_>>().join("\t")];
    lines.extend(rows.iter().map(|row| cells(row).join("\t")));
    lines.join("\n")
}

#[component]
pub fn CopyButton(#[prop(into)] columns: Signal<Vec<Column>>, #[prop(into)] rows: Signal<Vec<Row>>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <button class="link" on:click=move |_| {
            desk.copy_text(columns.with_untracked(|c| rows.with_untracked(|r| to_tsv(c, r))));
        }>
            <Glyph icon=Icon::Copy size=14/> {text::copy}
        </button>
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(key: &str, value: Option<f64>) -> Row {
        Row { key: key.into(), cells: vec![Cell::id(key), Cell::number(value, 3)], off: false }
    }

    #[test]
    fn rows_without_a_number_come_last_either_way() {
        let mut rows = [row("a", None), row("b", Some(-2.0)), row("c", Some(3.0))];
        for descending in [true, false] {
            rows.sort_by(|a, b| compare(a, b, Sorting { column: 1, descending }));
            assert_eq!(rows[2].key, "a");
            assert_eq!(rows[0].key, if descending { "c" } else { "b" });
        }
    }

    #[test]
    fn identifiers_sort_by_their_numbers() {
        let mut rows = [row("10", None), row("9", None)];
        rows.sort_by(|a, b| compare(a, b, Sorting { column: 0, descending: false }));
        assert_eq!(rows[0].key, "9");
    }

    #[test]
    fn keys_go_to_neighbours_and_stay_in_the_table() {
        assert_eq!(neighbour("ArrowDown", None, 5, 3), Some(0));
        assert_eq!(neighbour("ArrowUp", Some(0), 5, 3), Some(0));
        assert_eq!(neighbour("PageDown", Some(3), 5, 3), Some(4));
        assert_eq!(neighbour("End", Some(1), 5, 3), Some(4));
        assert_eq!(neighbour("Backspace", Some(1), 5, 3), None);
        assert_eq!(neighbour("ArrowDown", None, 0, 3), None);
    }

    #[test]
    fn copies_have_plain_numbers() {
        let cell = Cell::number(Some(-1234.5), 1);
        assert_eq!((&*cell.shown(), &*cell.plain()), ("\u{2212}1\u{2009}234.5", "-1234.5"));
        let unchecked = Cell { instead: Some("unchecked"), ..cell };
        assert_eq!((&*unchecked.shown(), &*unchecked.plain()), ("unchecked", "-1234.5"));
        let names = ["\"a\" b", "two\tparts", "a b"];
        let copied = to_tsv(&[], &names.map(|name| row(name, Some(1.5))));
        assert_eq!(copied, "\n\"\"\"a\"\" b\"\t1.5\n\"two\tparts\"\t1.5\na b\t1.5");
        assert_eq!(sightline_exchange::pasted(&copied).iter().map(|r| &*r.fields[0]).collect::<Vec<_>>(), names);
    }
}
