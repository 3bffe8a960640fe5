//! A matrix as a picture: where it has entries, how large they are beside the largest of their column, and their numbers where there is room.

use std::sync::Arc;

use leptos::html::Canvas;
use leptos::prelude::*;
use sightline::adjust::{Elimination, Factor, SparseMatrix};
use sightline_protocol::{Inquiry, Looked};

use super::number;
use super::painting::paint;
use crate::browser::canvas::{CanvasElement, SizeWatch, Surface};
use crate::browser::event;
use crate::format;
use crate::i18n::{Text, inside as words};
use crate::store::Desk;
use crate::store::inside::StepShown;

/// Which matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Which {
    A,
    N,
    S,
    L,
}

/// Inputs of a drawing.
pub struct Shown {
    /// The step; of the picture of L the start, for the factor comes later than the step.
    pub looked: StepShown,
    /// Of the picture of L.
    pub factor: Option<Arc<Factor>>,
}

impl Which {
    fn name(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::N => "N",
            Self::S => "S",
            Self::L => "L",
        }
    }

    fn title(self) -> &'static str {
        match self {
            Self::A => words::design_matrix(),
            Self::N => words::normal_matrix(),
            Self::S => words::reduced_matrix(),
            Self::L => words::cholesky_factor(),
        }
    }

    pub fn of(self, shown: &Shown) -> Option<&SparseMatrix> {
        let Shown { looked, factor } = shown;
        match self {
            Self::A => Some(&looked.system.a),
            Self::N => Some(&looked.normal.n),
            Self::S => Some(&looked.normal.reduced.s),
            Self::L => factor.as_ref().map(|factor| &factor.l),
        }
    }

    /// Rows and columns.
    fn size(self, looked: &Looked) -> [usize; 2] {
        let matrix = match self {
            Self::A => &looked.system.a,
            Self::N | Self::L => &looked.normal.n,
            Self::S => &looked.normal.reduced.s,
        };
        [matrix.rows, matrix.columns]
    }

    /// The unknown of a column.
    pub fn unknown(self, shown: &Shown, column: usize) -> usize {
        let of = |unknowns: &[usize]| unknowns.get(column).copied().unwrap_or_default();
        match self {
            Self::S => of(shown.looked.kept()),
            Self::L => shown.factor.as_ref().map_or(column, |factor| of(&factor.order)),
            _ => column,
        }
    }

    /// The column of an unknown, where it has one.
    pub fn column(self, shown: &Shown, unknown: usize) -> Option<usize> {
        let of = |unknowns: &[usize]| unknowns.iter().position(|one| *one == unknown);
        match self {
            Self::S => of(shown.looked.kept()),
            Self::L => shown.factor.as_ref().and_then(|factor| of(&factor.order)),
            _ => Some(unknown),
        }
    }

    fn column_name(self, shown: &Shown, column: usize) -> String {
        let unknown = shown.looked.unknowns().get(self.unknown(shown, column));
        unknown.map(|unknown| unknown.name.clone()).unwrap_or_default()
    }

    fn row_name(self, shown: &Shown, row: usize) -> String {
        match self {
            Self::A => shown.looked.observations().get(row).map(|row| row.name.clone()).unwrap_or_default(),
            _ => self.column_name(shown, row),
        }
    }
}

/// The part of a matrix that is in sight: first row, first column, rows, columns.
pub type Sight = [f64; 4];

/// A closer look shows at least as many rows and columns: a single cell does not determine its position.
const FEWEST: f64 = 4.0;
/// A factor with more entries is not computed for its picture: a dense one of 2000 unknowns takes seconds.
const MOST_ENTRIES: usize = 2_100_000;

/// A matrix and the part of it that is in sight.
#[derive(Clone, Copy)]
struct MatrixView {
    desk: Desk,
    which: Which,
    first: Memo<Option<Arc<Looked>>>,
    /// The part in sight; `None` shows the whole matrix.
    sight: RwSignal<Option<Sight>>,
    /// While the pointer is pressed: where it was pressed, what was in sight then, whether it has been dragged.
    grip: StoredValue<Option<([f64; 2], Sight, bool)>>,
    hovered: RwSignal<Option<[usize; 2]>>,
}

impl MatrixView {
    fn new(desk: Desk, which: Which) -> Self {
        let view = Self {
            desk,
            which,
            first: desk.inside.first(),
            sight: RwSignal::new(None),
            grip: StoredValue::new(None),
            hovered: RwSignal::new(None),
        };
        // Another network has another matrix.
        Effect::new(move |before: Option<bool>| {
            let none = desk.inside.steps.with(Vec::is_empty);
            if before.is_some_and(|before| before != none) {
                view.sight.set(None);
            }
            none
        });
        view
    }

    /// The step that is examined, with the factor of its normal equations if that is shown.
    fn shown(self) -> Option<Shown> {
        let inside = self.desk.inside;
        if self.which != Which::L {
            return Some(Shown { looked: inside.looked()?, factor: None });
        }
        let looked = StepShown::start(self.first.get()?);
        let elimination = inside.elimination.get();
        let factor = inside.factor.get().filter(|found| found.1 == elimination).and_then(|found| found.2);
        Some(Shown { looked, factor })
    }

    /// The whole matrix.
    fn whole(self) -> Sight {
        self.desk.inside.steps.with_untracked(|steps| {
            steps.first().map_or([0.0, 0.0, 1.0, 1.0], |looked| {
                let [rows, columns] = self.which.size(looked);
                [0.0, 0.0, rows.max(1) as f64, columns.max(1) as f64]
            })
        })
    }

    /// The visible part.
    fn now(self) -> Sight {
        self.sight.get_untracked().unwrap_or_else(|| self.whole())
    }

    /// Changes the number of rows and columns in sight about a place, in shares of the picture.
    fn zoom(self, factor: f64, [x, y]: [f64; 2]) {
        let (all, now) = (self.whole(), self.now());
        let rows = (now[2] * factor).clamp(FEWEST.min(all[2]), all[2]);
        let columns = (now[3] * factor).clamp(FEWEST.min(all[3]), all[3]);
        let first_row = (now[0] + y * (now[2] - rows)).clamp(0.0, all[2] - rows);
        let first_column = (now[1] + x * (now[3] - columns)).clamp(0.0, all[3] - columns);
        let near = rows < all[2] || columns < all[3];
        self.sight.set(near.then_some([first_row, first_column, rows, columns]));
    }

    /// Row and column at a place, in shares of the picture.
    fn cell(self, [x, y]: [f64; 2]) -> [usize; 2] {
        let (all, now) = (self.whole(), self.now());
        let place =
            |first: f64, share: f64, count: f64, most: f64| (first + share * count).clamp(0.0, most - 1.0) as usize;
        [place(now[0], y, now[2], all[2]), place(now[1], x, now[3], all[3])]
    }

    fn down(self, at: [f64; 2]) {
        self.grip.set_value(Some((at, self.now(), false)));
    }

    fn moved(self, at: [f64; 2]) {
        self.drag(at);
        self.hovered.set(Some(self.cell(at)));
    }

    fn drag(self, at: [f64; 2]) {
        let Some((from, was, _)) = self.grip.get_value() else { return };
        let all = self.whole();
        let moved = [(at[0] - from[0]).abs(), (at[1] - from[1]).abs()];
        // A hand that clicks moves by a pixel or two.
        if moved[0] + moved[1] < 0.01 || was == all {
            return;
        }
        self.grip.set_value(Some((from, was, true)));
        let row = (was[0] - (at[1] - from[1]) * was[2]).clamp(0.0, all[2] - was[2]);
        let column = (was[1] - (at[0] - from[0]) * was[3]).clamp(0.0, all[3] - was[3]);
        self.sight.set(Some([row, column, was[2], was[3]]));
    }

    fn up(self, at: [f64; 2]) {
        let dragged = self.grip.get_value().is_none_or(|(.., dragged)| dragged);
        self.grip.set_value(None);
        if !dragged {
            self.choose(at);
        }
    }

    /// Chooses the cell at a place on the whole desk.
    fn choose(self, at: [f64; 2]) {
        let [row, column] = self.cell(at);
        let Some(shown) = untrack(|| self.shown()) else { return };
        if self.which == Which::A {
            self.desk.choose_equation(Some(row));
        }
        self.desk.inside.column.set(Some(self.which.unknown(&shown, column)));
    }

    /// Names and value of the cell under the pointer.
    fn read_out(self) -> Option<String> {
        let shown = self.shown()?;
        let [row, column] = self.hovered.get()?;
        let matrix = self.which.of(&shown)?;
        let found = (row < matrix.rows).then(|| matrix.row(row).find(|entry| entry.0 == column)).flatten();
        let value = found.map_or("0".to_owned(), |entry| number(entry.1));
        let cell =
            format!("{} · {}: {value}", self.which.row_name(&shown, row), self.which.column_name(&shown, column));
        let filled = shown.factor.as_ref().is_some_and(|factor| {
            let mut of_row = factor.l.row_starts[row]..factor.l.row_starts[row + 1];
            of_row.any(|k| factor.l.column_indices[k] == column && factor.filled[k])
        });
        Some(if filled { format!("{cell}, {}", words::is_fill_in()) } else { cell })
    }
}

/// Asks for the factor of the step that is examined, unless it has too many entries.
fn ask_for_factor(desk: Desk) {
    let inside = desk.inside;
    Effect::new(move || {
        let (step, elimination) = (inside.step.get(), inside.elimination.get());
        if inside.looked().is_some_and(|looked| entries(&looked, elimination) <= MOST_ENTRIES) {
            desk.inquire(Inquiry::Factor { step, elimination });
        }
    });
}

/// The order of elimination, and why the factor cannot be drawn.
#[component]
fn FactorNotes() -> impl IntoView {
    let inside = expect_context::<Desk>().inside;
    let missing = move || {
        let (elimination, looked) = (inside.elimination.get(), inside.looked()?);
        let many = entries(&looked, elimination);
        let singular =
            inside.factor.with(|found| found.as_ref().is_some_and(|found| found.1 == elimination && found.2.is_none()));
        if many > MOST_ENTRIES {
            Some(words::factor_too_large(format::count(many)))
        } else {
            singular.then(|| words::factor_singular().to_owned())
        }
    };
    let order = |(order, name, said): (Elimination, &'static str, Text)| {
        view! {
            <button class="text-button" data-elimination=name aria-pressed=move || (inside.elimination.get() == order).to_string()
                on:click=move |_| inside.elimination.set(order)>{said}</button>
        }
    };
    let orders: [(Elimination, &str, Text); 2] = [
        (Elimination::PointsFirst, "points", words::points_first),
        (Elimination::PhotosFirst, "photos", words::photos_first),
    ];
    let orders = orders.map(order).collect_view();
    view! {
        <div class="orders">{orders}</div>
        {move || missing().map(|said| view! { <p class="note">{said}</p> })}
    }
}

/// What the next frame paints.
struct NextPainting {
    element: CanvasElement,
    size: [f64; 2],
    shown: Shown,
    sight: Sight,
    /// Row and unknown.
    chosen: (Option<usize>, Option<usize>),
}

#[component]
pub fn Picture(which: Which) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let inside = desk.inside;
    let canvas = NodeRef::<Canvas>::new();
    let matrix_view = MatrixView::new(desk, which);
    if which == Which::L {
        ask_for_factor(desk);
    }
    let shown = move || matrix_view.shown();
    let bounds = RwSignal::new([0.0; 2]);
    let watch = StoredValue::new_local(None);
    canvas.on_load(move |element| {
        watch.set_value(SizeWatch::new(&element, move |_, size| bounds.set(size)));
    });
    // Whatever changes until the next frame is painted once, in that frame.
    let next = StoredValue::new_local(None::<NextPainting>);
    Effect::new(move || {
        let size = bounds.get();
        desk.window.theme.track();
        let chosen = (inside.row.get(), inside.column.get());
        let sight = matrix_view.sight.get().unwrap_or_else(|| matrix_view.whole());
        let (Some(element), Some(shown)) = (canvas.get(), shown()) else { return };
        let job = NextPainting { element, size, shown, sight, chosen };
        if next.try_update_value(|next| next.replace(job)).flatten().is_none() {
            request_animation_frame(move || {
                let Some(job) = next.try_update_value(Option::take).flatten() else { return };
                if let Some(surface) = Surface::new(&job.element, job.size) {
                    paint(&surface, which, &job.shown, job.sight, job.chosen);
                }
            });
        }
    });
    let size = Memo::new(move |_| {
        let shown = shown()?;
        let matrix = which.of(&shown)?;
        let filled = 100.0 * matrix.values.len() as f64 / (matrix.rows * matrix.columns).max(1) as f64;
        Some(words::size_and_share(format::count(matrix.rows), format::count(matrix.columns), format::fixed(filled, 0)))
    });
    let of_factor = (which == Which::L).then(|| view! { <FactorNotes/> });
    view! {
        <figure class="matrix" data-matrix=which.name()>
            <figcaption class="section-head">
                <span><b>{which.name()}</b> " " {move || which.title()}</span>
                <span class="aside">{move || size.get()}</span>
                <span class="zooms">
                    <button class="icon-button small" aria-label=words::zoom_in on:click=move |_| matrix_view.zoom(0.5, [0.5, 0.5])>"+"</button>
                    <button class="icon-button small" aria-label=words::zoom_out on:click=move |_| matrix_view.zoom(2.0, [0.5, 0.5])>"−"</button>
                    <button class="icon-button small" aria-label=words::whole on:click=move |_| matrix_view.sight.set(None)>"↔"</button>
                </span>
            </figcaption>
            {of_factor}
            <canvas node_ref=canvas role="img" aria-label=move || format!("{}, {}", which.title(), size.get().unwrap_or_default())
                on:wheel=move |e| {
                    let wheel = event::wheel(&e);
                    let at = hovered_share(&canvas, wheel.x, wheel.y);
                    matrix_view.zoom(if wheel.dy < 0.0 { 0.8 } else { 1.25 }, at);
                }
                on:pointerdown=move |e| {
                    event::capture(&e);
                    matrix_view.down(event::share(&e));
                }
                on:pointermove=move |e| matrix_view.moved(event::share(&e))
                on:pointerup=move |e| matrix_view.up(event::share(&e))
                on:pointerleave=move |_| matrix_view.hovered.set(None)></canvas>
            <p class="read-out" aria-live="off">{move || matrix_view.read_out().unwrap_or_else(|| if which == Which::A { words::point_at().to_owned() } else { String::new() })}</p>
        </figure>
    }
}

/// Entries of the factor.
fn entries(looked: &Looked, elimination: Elimination) -> usize {
    match elimination {
        Elimination::PointsFirst => looked.normal.fill_in.factor,
        Elimination::PhotosFirst => looked.normal.fill_in.factor_photos_first,
    }
}

fn hovered_share(canvas: &NodeRef<Canvas>, x: f64, y: f64) -> [f64; 2] {
    canvas.get_untracked().map_or([0.5; 2], |element| {
        let (width, height) = (f64::from(element.client_width()), f64::from(element.client_height()));
        [(x / width.max(1.0)).clamp(0.0, 1.0), (y / height.max(1.0)).clamp(0.0, 1.0)]
    })
}
