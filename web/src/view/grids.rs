//! The panel that names the dots of a board of circles.

use std::collections::BTreeMap;

use leptos::prelude::*;
use sightline::matching::{Board, BoardKind, GridNaming, GridOptions, GridOrientation, UnnamedReason};

use super::components::field::Field;
use super::picking::chosen_target;
use crate::browser::event;
use crate::format;
use crate::i18n::{grids, text};
use crate::store::Desk;

fn reason_words(reason: &UnnamedReason) -> String {
    match reason {
        UnnamedReason::NoGrid { targets } => grids::no_grid(targets),
        UnnamedReason::NotThisBoard { dots } => grids::not_this_board(dots),
        UnnamedReason::Ambiguous { dots, places } => grids::ambiguous(dots, places),
        UnnamedReason::SeveralBoards { count } => grids::several_boards(count),
        UnnamedReason::OtherDots { dots, others } => grids::other_dots(dots, others),
        UnnamedReason::Mark { seen } => grids::mark(seen),
        UnnamedReason::Diameter { seen, given } => grids::diameter_apart(seen, given),
    }
}

/// Values that a length field accepts.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Takes {
    /// A length greater than 0.
    Length,
    /// The same, or nothing where it is not known.
    LengthOrNothing,
    /// 0 or greater, or nothing.
    Sigma,
}

/// The sentence why a field's text was refused, and the text.
type RefusedEntry = (fn(&str) -> String, String);

/// The board as it is typed, and the last typed text that was refused: a field shows its earlier value again, with the reason.
#[derive(Clone, Copy)]
struct BoardForm {
    board: RwSignal<Board>,
    /// By the fields' names.
    refused: RwSignal<BTreeMap<&'static str, RefusedEntry>>,
}

impl BoardForm {
    /// With an asymmetric board that is widely used.
    fn new() -> Self {
        let board = Board {
            rows: 11,
            columns: 4,
            pitch: 20.0,
            kind: BoardKind::Asymmetric,
            diameter: None,
            sigma: None,
            mark: None,
        };
        Self { board: RwSignal::new(board), refused: RwSignal::default() }
    }

    fn answer(self, name: &'static str, is_taken: bool, words: fn(&str) -> String, typed: &str) {
        self.refused.update(|all| {
            all.remove(name);
            if !is_taken {
                all.insert(name, (words, typed.trim().to_owned()));
            }
        });
    }

    /// Why a field's text was not taken.
    fn refusal(self, name: &'static str) -> Option<impl IntoView + use<>> {
        let (words, typed) = self.refused.with(|all| all.get(name).cloned())?;
        Some(view! { <small class="warn" role="alert" data-refused=name>{words(&typed)}</small> })
    }
}

/// A number of rows or columns, two or more.
#[component]
fn CountField(
    form: BoardForm,
    read: fn(&Board) -> u32,
    write: fn(&mut Board, u32),
    name: &'static str,
    label: fn() -> &'static str,
) -> impl IntoView {
    view! {
        <label class="field">
            <span>{label}</span>
            <Field value=Signal::derive(move || form.board.with(read).to_string()) commit=move |typed: String| {
                let count = typed.trim().parse().ok().filter(|count| *count >= 2);
                if let Some(count) = count {
                    form.board.update(|b| write(b, count));
                }
                form.answer(name, count.is_some(), |typed: &str| grids::no_count(typed), &typed);
            } attr:class="short" attr:inputmode="numeric" attr:name=name/>
            {move || form.refusal(name)}
        </label>
    }
}

#[component]
fn LengthField(
    form: BoardForm,
    read: fn(&Board) -> Option<f64>,
    write: fn(&mut Board, Option<f64>),
    takes: Takes,
    name: &'static str,
    label: fn() -> &'static str,
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <label class="field">
            <span>{label} " " <u>{move || desk.document.with(|d| d.project.unit.clone())}</u></span>
            <Field value=Signal::derive(move || form.board.with(read).map(format::editable).unwrap_or_default())
                commit=move |typed: String| {
                    let value = format::parse(&typed);
                    let is_taken = match value {
                        Some(value) if takes == Takes::Sigma => value >= 0.0,
                        Some(value) => value > 0.0,
                        None => takes != Takes::Length && typed.trim().is_empty(),
                    };
                    if is_taken {
                        form.board.update(|b| write(b, value));
                    }
                    let words: fn(&str) -> String = match takes {
                        Takes::Sigma => |typed: &str| grids::no_sigma(typed),
                        _ => |typed: &str| grids::no_length(typed),
                    };
                    form.answer(name, is_taken, words, &typed);
                } attr:class="short" attr:inputmode="decimal" attr:name=name/>
            {move || form.refusal(name)}
        </label>
    }
}

/// Rows, columns, pitch and what else is known of the board; then what was named and what was not, and why.
#[component]
pub fn GridPanel() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let form = BoardForm::new();
    let board = form.board;
    let naming = RwSignal::new(None::<GridNaming>);
    let first = Memo::new(move |_| {
        let photo = desk.selection.with(|s| s.photo.clone())?;
        chosen_target(desk).map(|t| (photo, [t.u, t.v], t.id))
    });
    let name = move |_| {
        let first = first.get_untracked().map(|(photo, place, _)| (photo, place));
        desk.name_grid(board.get_untracked(), GridOptions { first: first.into_iter().collect() }, naming);
    };
    view! {
        <section class="panel" data-panel="grid">
            <h2 class="section-head">
                <span>{grids::circle_grid}</span>
                <button class="button small primary" data-action="name-grid" disabled=move || desk.tasks.job.with(Option::is_some) on:click=name>
                    {grids::name_dots}
                </button>
            </h2>
            <div class="fields inline">
                <label class="field">
                    <span>{grids::kind}</span>
                    <select name="grid-kind" on:change=move |e| board.update(|b| b.kind = kind_of(&event::value(&e)))>
                        <option value="asymmetric">{grids::asymmetric}</option>
                        <option value="symmetric">{grids::symmetric}</option>
                    </select>
                </label>
                <CountField form name="grid-rows" label=grids::rows read=|b| b.rows write=|b, n| b.rows = n/>
                <CountField form name="grid-columns" label=grids::columns read=|b| b.columns write=|b, n| b.columns = n/>
                <LengthField form name="grid-pitch" label=grids::pitch takes=Takes::Length read=|b| Some(b.pitch)
                    write=|b, x| b.pitch = x.unwrap_or(b.pitch)/>
                <LengthField form name="grid-sigma" label=grids::sigma takes=Takes::Sigma read=|b| b.sigma write=|b, x| b.sigma = x/>
                <LengthField form name="grid-diameter" label=grids::diameter takes=Takes::LengthOrNothing read=|b| b.diameter
                    write=|b, x| b.diameter = x/>
            </div>
            <p class="hint">{grids::hint}</p>
            <p class="hint" data-grid="first">{move || match first.get() {
                Some((photo, _, target)) => grids::first_is(target, photo),
                None => grids::first_how().to_owned(),
            }}</p>
            {move || naming.get().map(|naming| view! { <Outcome naming/> })}
        </section>
    }
}

fn kind_of(value: &str) -> BoardKind {
    if value == "symmetric" { BoardKind::Symmetric } else { BoardKind::Asymmetric }
}

/// Named dots; for photos without any, the reason.
#[component]
fn Outcome(naming: GridNaming) -> impl IntoView {
    let (named, all) = (naming.named.len(), naming.named.len() + naming.unnamed.len());
    let observations = naming.observations.len();
    let assumed = naming.named.iter().filter(|n| n.orientation == GridOrientation::Assumed).count();
    let before: usize = naming.named.iter().map(|n| n.named_before).sum();
    let prefix = naming.prefix.clone();
    let unnamed = naming.unnamed;
    view! {
        <p role="status" data-grid="result">{move || grids::named_in(named, all, format::count(observations))}</p>
        {(assumed > 0).then(|| view! { <p class="hint warn" data-grid="assumed">{move || grids::assumed(assumed)}</p> })}
        {(before > 0).then(|| view! { <p class="hint warn">{move || grids::named_before(before)}</p> })}
        {(!prefix.is_empty()).then(|| view! { <p class="hint">{move || grids::prefixed(&prefix)}</p> })}
        {(!unnamed.is_empty()).then(|| view! {
            <div class="scroll short-list" tabindex="0" role="region" aria-label=text::why_not>
                <table class="table" data-grid="unnamed">
                    <thead><tr><th class="left">{text::photo}</th><th class="left wide">{text::why_not}</th></tr></thead>
                    <tbody>{unnamed.iter().map(|u| {
                        let reason = u.reason.clone();
                        view! { <tr><td class="left">{u.photo.clone()}</td><td class="left wide warn">{move || reason_words(&reason)}</td></tr> }
                    }).collect_view()}</tbody>
                </table>
            </div>
        })}
    }
}
