//! The unknowns with their corrections, values and standard errors, block by block.

use leptos::prelude::*;
use sightline::adjust::{Block, BlockKind};
use sightline_protocol::Inquiry;

use super::number;
use crate::format;
use crate::i18n::{inside as words, text};
use crate::store::Desk;
use crate::view::components::visible_rows::VisibleRows;

/// A line of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
enum TableLine {
    /// The head of a block, by its place.
    Head(usize),
    /// An unknown, with its block.
    Unknown(usize, usize),
}

/// Heads and unknowns of all blocks.
fn lines(blocks: &[Block]) -> Vec<TableLine> {
    let of_block = |(k, block): (usize, &Block)| {
        let unknowns = (block.first..block.first + block.size).map(move |unknown| TableLine::Unknown(k, unknown));
        std::iter::once(TableLine::Head(k)).chain(unknowns)
    };
    blocks.iter().enumerate().flat_map(of_block).collect()
}

fn head(block: &Block) -> String {
    let kind = match block.kind {
        BlockKind::Photo => text::photo(),
        BlockKind::Camera => words::camera(),
        BlockKind::Point => words::point(),
    };
    format!("{kind} {}", block.name)
}

#[component]
pub fn Unknowns() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let inside = desk.inside;
    // Not while steps follow each other: the next one is more important.
    Effect::new(move || {
        let step = inside.step.get();
        let known = inside.steps.with(|steps| step < steps.len());
        let asked = inside.sigmas.with_untracked(|found| found.as_ref().is_some_and(|found| found.0 == step));
        if known && !inside.waiting.get() && !asked {
            desk.inquire(Inquiry::Sigmas(step));
        }
    });
    let first = inside.first();
    let all = Memo::new(move |_| first.get().map_or_else(Vec::new, |looked| lines(&looked.normal.blocks)));
    let count = move || first.get().map(|looked| format::count(looked.system.unknowns.len()));
    let visible = VisibleRows::new();
    let window = Memo::new(move |_| visible.range(all.with(Vec::len)));
    visible.frame.on_load(move |_| visible.measure());
    // An unknown that is chosen in a matrix is brought into sight.
    Effect::new(move || {
        let chosen = inside.column.get();
        let at =
            all.with(|all| all.iter().position(|line| matches!(line, TableLine::Unknown(_, k) if Some(*k) == chosen)));
        if let Some(at) = at {
            visible.reveal(at);
        }
    });
    view! {
        <h2 class="section-head"><span>{words::unknowns}</span><span class="aside">{count}</span></h2>
        <div class="unknowns-frame" tabindex="0" node_ref=visible.frame on:scroll=move |_| visible.measure() on:pointerenter=move |_| visible.measure()>
            <table class="table unknowns" aria-label=words::unknowns aria-rowcount=move || (all.with(Vec::len) + 1).to_string()>
                <thead><tr><th class="left"></th><th>{words::correction}</th><th>{words::value}</th><th>"σ"</th><td class="left wide"></td></tr></thead>
                <tbody>
                    <tr class="gap" aria-hidden="true" style:height=move || visible.gap(window.get().0)></tr>
                    <Lines all window/>
                    <tr class="gap" aria-hidden="true" style:height=move || visible.gap(all.with(Vec::len).saturating_sub(window.get().1))></tr>
                </tbody>
            </table>
            <p class="hint">{words::rotations_are} " " <SigmasAre/></p>
        </div>
    }
}

/// The lines in sight. They are written together: one by one each would follow the step by itself.
#[component]
fn Lines(all: Memo<Vec<TableLine>>, window: Memo<(usize, usize)>) -> impl IntoView {
    let inside = expect_context::<Desk>().inside;
    move || {
        let looked = inside.looked()?;
        let step = inside.step.get();
        let sigmas = inside.sigmas.with(|found| found.as_ref().filter(|found| found.0 == step)?.1.clone());
        let chosen = inside.column.get();
        let (state, blocks) = (&looked.state, looked.blocks());
        let line = |line: &TableLine| match *line {
            TableLine::Head(k) => {
                view! { <tr class="data group"><th class="left" colspan="5">{head(&blocks[k])}</th></tr> }.into_any()
            }
            TableLine::Unknown(block, k) => {
                let unknown = &looked.unknowns()[k];
                let short = unknown.name.strip_prefix(&blocks[block].name).unwrap_or(&unknown.name).trim();
                let short = short.replace("rotation", words::rotation());
                let correction = number(state.corrections.get(k).copied().unwrap_or_default());
                let value = state.values.get(k).filter(|_| unknown.unit != "rad").map(|value| format::fixed(*value, 4));
                let sigma = sigmas.as_ref().and_then(|all| all.get(k).copied()).map(number);
                view! {
                    <tr class="data" class:chosen=chosen == Some(k) data-unknown=k.to_string() on:click=move |_| inside.column.set(Some(k))>
                        <td class="left">{short}</td><td><b>{correction}</b></td><td>{value.unwrap_or_default()}</td>
                        <td data-sigma="">{sigma.unwrap_or_default()}</td><td class="left wide">{unknown.unit.clone()}</td>
                    </tr>
                }
                .into_any()
            }
        };
        let (from, to) = window.get();
        Some(all.with(|all| all.get(from..to.min(all.len())).unwrap_or_default().iter().map(line).collect_view()))
    }
}

/// Which standard errors these are.
#[component]
fn SigmasAre() -> impl IntoView {
    let inside = expect_context::<Desk>().inside;
    move || {
        let (step, sigma0) = (inside.step.get(), inside.looked()?.state.sigma0);
        inside.sigmas.with(|found| {
            let (_, sigmas) = found.as_ref().filter(|found| found.0 == step)?;
            Some(match (sigmas, sigma0) {
                (None, _) => words::no_sigmas().to_owned(),
                (Some(_), Some(sigma0)) => words::sigmas_at(number(sigma0)),
                (Some(_), None) => words::sigmas_unscaled().to_owned(),
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_block_has_its_head_before_its_unknowns() {
        let block = |name: &str, kind, first, size| Block { name: name.into(), kind, first, size, eliminated: false };
        let blocks = [block("1", BlockKind::Photo, 0, 2), block("p", BlockKind::Point, 2, 1)];
        let expected = [
            TableLine::Head(0),
            TableLine::Unknown(0, 0),
            TableLine::Unknown(0, 1),
            TableLine::Head(1),
            TableLine::Unknown(1, 2),
        ];
        assert_eq!(lines(&blocks), expected);
    }
}
