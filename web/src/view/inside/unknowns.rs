//! The unknowns with their corrections and values, block by block.

use leptos::prelude::*;
use sightline::adjust::BlockKind;

use super::number;
use crate::format;
use crate::i18n::{inside as words, text};
use crate::store::Desk;

/// More unknowns than these are not laid out all at once: the page would stand still. The blocks around the chosen one are shown.
const MOST: usize = 400;

#[component]
pub fn Unknowns() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let inside = desk.inside;
    move || {
        let looked = inside.looked()?;
        let (system, state) = (&looked.system, &looked.state);
        let all = system.unknowns.len();
        let around = if all <= MOST { 0 } else { inside.column.get().unwrap_or(0) };
        let blocks = looked.normal.blocks.iter().filter(|block| {
            all <= MOST || block.first + block.size + MOST / 2 > around && block.first < around + MOST / 2
        });
        let blocks = blocks.map(|block| {
            let kind = match block.kind {
                BlockKind::Photo => text::photo(),
                BlockKind::Camera => words::camera(),
                BlockKind::Point => words::point(),
            };
            let head = format!("{kind} {}", block.name);
            let rows = (block.first..block.first + block.size).map(|k| {
                let unknown = &system.unknowns[k];
                let short = unknown.name.strip_prefix(&block.name).unwrap_or(&unknown.name).trim();
                let short = short.replace("rotation", words::rotation());
                let value = if unknown.unit == "rad" { String::new() } else { format::fixed(unknown.value, 4) };
                let correction = state.corrections.get(k).copied().unwrap_or_default();
                view! {
                    <tr class:chosen=move || inside.column.get() == Some(k) on:click=move |_| inside.column.set(Some(k))>
                        <td class="left">{short}</td><td><b>{number(correction)}</b></td><td>{value}</td><td class="left wide">{unknown.unit.clone()}</td>
                    </tr>
                }
            });
            let rows = rows.collect_view();
            view! { <tr class="group"><th class="left" colspan="4">{head}</th></tr>{rows} }
        });
        let blocks = blocks.collect_view();
        Some(view! {
            <h2 class="section-head"><span>{words::unknowns}</span><span class="aside">{format::count(all)}</span></h2>
            {(all > MOST).then(|| view! { <p class="hint">{words::some_unknowns(MOST)}</p> })}
            <table class="table unknowns">
                <thead><tr><th class="left"></th><th>{words::correction}</th><th>{words::value}</th><td class="left wide"></td></tr></thead>
                <tbody>{blocks}</tbody>
            </table>
            <p class="hint">{words::rotations_are}</p>
        })
    }
}
