//! A matrix as a picture: where it has entries, how large they are beside the largest of their column, and their numbers where there is room.

use leptos::html::Canvas;
use leptos::prelude::*;
use sightline::adjust::SparseMatrix;
use sightline_protocol::Looked;

use super::number;
use crate::browser::canvas::{SizeWatch, Surface};
use crate::browser::event;
use crate::format;
use crate::i18n::inside as words;
use crate::store::Desk;

/// Which matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Which {
    A,
    N,
    S,
}

impl Which {
    fn name(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::N => "N",
            Self::S => "S",
        }
    }

    fn title(self) -> &'static str {
        match self {
            Self::A => words::design_matrix(),
            Self::N => words::normal_matrix(),
            Self::S => words::reduced_matrix(),
        }
    }

    fn of(self, looked: &Looked) -> &SparseMatrix {
        match self {
            Self::A => &looked.system.a,
            Self::N => &looked.normal.n,
            Self::S => &looked.normal.reduced.s,
        }
    }

    /// The unknown of a column.
    fn unknown(self, looked: &Looked, column: usize) -> usize {
        match self {
            Self::S => looked.normal.reduced.unknowns.get(column).copied().unwrap_or_default(),
            _ => column,
        }
    }

    fn column_name(self, looked: &Looked, column: usize) -> String {
        looked.system.unknowns.get(self.unknown(looked, column)).map(|unknown| unknown.name.clone()).unwrap_or_default()
    }

    fn row_name(self, looked: &Looked, row: usize) -> String {
        match self {
            Self::A => looked.system.observations.get(row).map(|row| row.name.clone()).unwrap_or_default(),
            _ => self.column_name(looked, row),
        }
    }
}

/// The part of a matrix that is in sight: first row, first column, rows, columns.
type Sight = [f64; 4];

/// CSS pixels that a cell needs for its number.
const NUMBER: [f64; 2] = [56.0, 16.0];
/// A closer look shows at least as many rows and columns: a single cell says nothing of its place.
const FEWEST: f64 = 4.0;
/// More blocks than these would be more lines than cells.
const MOST_LINES: usize = 80;

#[component]
pub fn Picture(which: Which) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let inside = desk.inside;
    let canvas = NodeRef::<Canvas>::new();
    let sight = RwSignal::new(None::<Sight>);
    let hovered = RwSignal::new(None::<[usize; 2]>);
    let whole = move || {
        inside.steps.with_untracked(|steps| {
            steps.first().map_or([0.0, 0.0, 1.0, 1.0], |looked| {
                let matrix = which.of(looked);
                [0.0, 0.0, matrix.rows.max(1) as f64, matrix.columns.max(1) as f64]
            })
        })
    };
    // Another network has another matrix.
    Effect::new(move |before: Option<bool>| {
        let none = inside.steps.with(Vec::is_empty);
        if before.is_some_and(|before| before != none) {
            sight.set(None);
        }
        none
    });
    let bounds = RwSignal::new([0.0; 2]);
    let watch = StoredValue::new_local(None);
    canvas.on_load(move |element| {
        watch.set_value(SizeWatch::new(&element, move |_, size| bounds.set(size)));
    });
    Effect::new(move || {
        let size = bounds.get();
        desk.theme.track();
        let chosen = (inside.row.get(), inside.column.get());
        let (Some(element), Some(looked)) = (canvas.get(), inside.looked()) else { return };
        if let Some(surface) = Surface::new(&element, size) {
            paint(&surface, which, &looked, sight.get().unwrap_or_else(whole), chosen);
        }
    });
    let zoom = move |factor: f64, [x, y]: [f64; 2]| {
        let all = whole();
        let now = sight.get_untracked().unwrap_or(all);
        let rows = (now[2] * factor).clamp(FEWEST.min(all[2]), all[2]);
        let columns = (now[3] * factor).clamp(FEWEST.min(all[3]), all[3]);
        let first_row = (now[0] + y * (now[2] - rows)).clamp(0.0, all[2] - rows);
        let first_column = (now[1] + x * (now[3] - columns)).clamp(0.0, all[3] - columns);
        let near = rows < all[2] || columns < all[3];
        sight.set(near.then_some([first_row, first_column, rows, columns]));
    };
    let cell = move |[x, y]: [f64; 2]| {
        let now = sight.get_untracked().unwrap_or_else(whole);
        let all = whole();
        let place =
            |first: f64, share: f64, count: f64, most: f64| (first + share * count).clamp(0.0, most - 1.0) as usize;
        [place(now[0], y, now[2], all[2]), place(now[1], x, now[3], all[3])]
    };
    let grip = StoredValue::new(None::<([f64; 2], Sight, bool)>);
    let drag = move |at: [f64; 2]| {
        let Some((from, was, _)) = grip.get_value() else { return };
        let all = whole();
        let moved = [(at[0] - from[0]).abs(), (at[1] - from[1]).abs()];
        // A hand that clicks moves by a pixel or two.
        if moved[0] + moved[1] < 0.01 || was == all {
            return;
        }
        grip.set_value(Some((from, was, true)));
        let row = (was[0] - (at[1] - from[1]) * was[2]).clamp(0.0, all[2] - was[2]);
        let column = (was[1] - (at[0] - from[0]) * was[3]).clamp(0.0, all[3] - was[3]);
        sight.set(Some([row, column, was[2], was[3]]));
    };
    let choose = move |at: [f64; 2]| {
        let [row, column] = cell(at);
        let Some(looked) = untrack(|| inside.looked()) else { return };
        if which == Which::A {
            desk.choose_equation(Some(row));
        }
        inside.column.set(Some(which.unknown(&looked, column)));
    };
    let size = move || {
        inside.looked().map(|looked| {
            let matrix = which.of(&looked);
            let filled = 100.0 * matrix.values.len() as f64 / (matrix.rows * matrix.columns).max(1) as f64;
            words::size_and_share(format::count(matrix.rows), format::count(matrix.columns), format::fixed(filled, 0))
        })
    };
    let read_out = move || {
        let looked = inside.looked()?;
        let [row, column] = hovered.get()?;
        let matrix = which.of(&looked);
        let found = (row < matrix.rows).then(|| matrix.row(row).find(|entry| entry.0 == column)).flatten();
        let value = found.map_or("0".to_owned(), |entry| number(entry.1));
        Some(format!("{} · {}: {value}", which.row_name(&looked, row), which.column_name(&looked, column)))
    };
    view! {
        <figure class="matrix" data-matrix=which.name()>
            <figcaption class="section-head">
                <span><b>{which.name()}</b> " " {move || which.title()}</span>
                <span class="aside">{size}</span>
                <span class="zooms">
                    <button class="icon-button small" aria-label=words::zoom_in on:click=move |_| zoom(0.5, [0.5, 0.5])>"+"</button>
                    <button class="icon-button small" aria-label=words::zoom_out on:click=move |_| zoom(2.0, [0.5, 0.5])>"−"</button>
                    <button class="icon-button small" aria-label=words::whole on:click=move |_| sight.set(None)>"↔"</button>
                </span>
            </figcaption>
            <canvas node_ref=canvas role="img" aria-label=move || format!("{}, {}", which.title(), size().unwrap_or_default())
                on:wheel=move |e| {
                    let wheel = event::wheel(&e);
                    let at = hovered_share(&canvas, wheel.x, wheel.y);
                    zoom(if wheel.dy < 0.0 { 0.8 } else { 1.25 }, at);
                }
                on:pointerdown=move |e| {
                    event::capture(&e);
                    grip.set_value(Some((event::share(&e), sight.get_untracked().unwrap_or_else(whole), false)));
                }
                on:pointermove=move |e| {
                    let at = event::share(&e);
                    drag(at);
                    hovered.set(Some(cell(at)));
                }
                on:pointerup=move |e| {
                    let dragged = grip.get_value().is_none_or(|(.., dragged)| dragged);
                    grip.set_value(None);
                    if !dragged {
                        choose(event::share(&e));
                    }
                }
                on:pointerleave=move |_| hovered.set(None)></canvas>
            <p class="read-out" aria-live="off">{move || read_out().unwrap_or_else(|| words::point_at().to_owned())}</p>
        </figure>
    }
}

fn hovered_share(canvas: &NodeRef<Canvas>, x: f64, y: f64) -> [f64; 2] {
    canvas.get_untracked().map_or([0.5; 2], |element| {
        let (width, height) = (f64::from(element.client_width()), f64::from(element.client_height()));
        [(x / width.max(1.0)).clamp(0.0, 1.0), (y / height.max(1.0)).clamp(0.0, 1.0)]
    })
}

/// Red, green and blue of a token such as `#0b5fa8`.
fn colour(surface: &Surface, token: &str) -> [f64; 3] {
    let text = surface.token(token);
    let part = |k: usize| text.get(1 + 2 * k..3 + 2 * k).and_then(|hex| u8::from_str_radix(hex, 16).ok());
    std::array::from_fn(|k| f64::from(part(k).unwrap_or(128)))
}

/// Tints by share of the column's largest entry.
const TINTS: [f64; 4] = [0.25, 0.45, 0.7, 1.0];

fn paint(surface: &Surface, which: Which, looked: &Looked, sight: Sight, chosen: (Option<usize>, Option<usize>)) {
    let matrix = which.of(looked);
    let [row0, column0, rows, columns] = sight;
    let (width, height) = ((surface.width * surface.ratio()) as usize, (surface.height * surface.ratio()) as usize);
    if width == 0 || height == 0 {
        return;
    }
    let (paper, ink) = (colour(surface, "--paper"), colour(surface, "--data-a"));
    let mut largest = vec![f64::MIN_POSITIVE; matrix.columns];
    for (column, value) in matrix.column_indices.iter().zip(&matrix.values) {
        largest[*column] = largest[*column].max(value.abs());
    }
    // The strongest tint of all entries that a pixel covers: of a large matrix none must get lost.
    let mut tints = vec![0u8; width * height];
    let span = |at: f64, first: f64, count: f64, pixels: usize| {
        let low = ((at - first) / count * pixels as f64).max(0.0) as usize;
        let high = ((at + 1.0 - first) / count * pixels as f64).ceil().max(0.0) as usize;
        // A gap between cells where they are large enough for one.
        let gap = usize::from(pixels as f64 / count > 5.0);
        (low.min(pixels - 1), high.saturating_sub(gap).clamp(low.min(pixels - 1) + 1, pixels))
    };
    let first = row0.floor() as usize;
    let last = ((row0 + rows).ceil() as usize).min(matrix.rows);
    for row in first..last {
        let (top, bottom) = span(row as f64, row0, rows, height);
        for (column, value) in matrix.row(row) {
            if ((column + 1) as f64) <= column0 || column as f64 >= column0 + columns {
                continue;
            }
            let share = value.abs() / largest[column];
            let tint = 1 + u8::from(share > 0.05) + u8::from(share > 0.25) + u8::from(share > 0.6);
            let (left, right) = span(column as f64, column0, columns, width);
            for line in tints[top * width..bottom * width].chunks_exact_mut(width) {
                line[left..right].iter_mut().for_each(|pixel| *pixel = tint.max(*pixel));
            }
        }
    }
    let of = |tint: u8| -> [u8; 4] {
        let share = if tint == 0 { 0.0 } else { TINTS[usize::from(tint) - 1] };
        let mixed = std::array::from_fn::<f64, 3, _>(|k| paper[k] + share * (ink[k] - paper[k]));
        [mixed[0] as u8, mixed[1] as u8, mixed[2] as u8, 255]
    };
    let palette: [[u8; 4]; 5] = std::array::from_fn(|tint| of(tint as u8));
    let rgba: Vec<u8> = tints.iter().flat_map(|tint| palette[usize::from(*tint)]).collect();
    surface.raster(&rgba, width as u32, height as u32);
    let x = |column: f64| (column - column0) / columns * surface.width;
    let y = |row: f64| (row - row0) / rows * surface.height;
    let blocks = &looked.normal.blocks;
    if blocks.len() <= MOST_LINES {
        surface.pen(&surface.token("--line"), 1.0, &[]);
        for block in blocks {
            let at = match which {
                Which::S => looked.normal.reduced.unknowns.iter().position(|unknown| *unknown == block.first),
                _ => Some(block.first),
            };
            let Some(at) = at.filter(|at| *at > 0) else { continue };
            surface.line(x(at as f64), 0.0, x(at as f64), surface.height);
            if which != Which::A {
                surface.line(0.0, y(at as f64), surface.width, y(at as f64));
            }
        }
    }
    surface.pen(&surface.token("--accent"), 2.0, &[]);
    let (row, column) = chosen;
    if let Some(row) = row.filter(|_| which == Which::A) {
        surface.rectangle(0.0, y(row as f64) - 1.0, surface.width, (surface.height / rows).max(2.0) + 2.0);
    }
    let column = column.and_then(|unknown| match which {
        Which::S => looked.normal.reduced.unknowns.iter().position(|kept| *kept == unknown),
        _ => Some(unknown),
    });
    if let Some(column) = column {
        surface.rectangle(x(column as f64) - 1.0, 0.0, (surface.width / columns).max(2.0) + 2.0, surface.height);
        if which != Which::A {
            surface.rectangle(0.0, y(column as f64) - 1.0, surface.width, (surface.height / rows).max(2.0) + 2.0);
        }
    }
    if surface.width / columns >= NUMBER[0] && surface.height / rows >= NUMBER[1] {
        let in_sight = (first..last).flat_map(|row| matrix.row(row).map(move |(column, value)| (row, column, value)));
        let texts: Vec<_> = in_sight
            .map(|(row, column, value)| (number(value), [x(column as f64 + 0.5), y(row as f64 + 0.5)]))
            .filter(|(_, [x, y])| *x > 0.0 && *x < surface.width && *y > 0.0 && *y < surface.height)
            .collect();
        let all = texts.iter().map(|(text, place)| (text.as_str(), *place));
        surface.values(all, &surface.token("--ink"), &surface.token("--paper"));
    }
}
