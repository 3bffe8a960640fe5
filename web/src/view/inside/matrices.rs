//! The matrices with one observation explained, the unknowns, and the steps.

use leptos::prelude::*;

use super::NothingYet;
use super::equation::Equation;
use super::iterations::Iterations;
use super::picture::{Picture, Which};
use super::unknowns::Unknowns;
use crate::format;
use crate::i18n::inside as words;
use crate::store::Desk;

#[component]
pub fn Matrices() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let inside = desk.inside;
    let any = Memo::new(move |_| inside.steps.with(|steps| !steps.is_empty()));
    // The observation that a lesson speaks of; further steps leave the one that is chosen.
    Effect::new(move || {
        let wanted = inside.wanted.get().observation.filter(|_| any.get());
        let first = inside.steps.with_untracked(|steps| steps.first().cloned());
        let row = first
            .zip(wanted)
            .and_then(|(looked, name)| looked.system.observations.iter().position(|row| row.name == name));
        if row.is_some() && inside.row.get_untracked() != row {
            desk.choose_equation(row);
        }
    });
    let elimination = move || {
        let looked = inside.looked()?;
        let normal = &looked.normal;
        let (all, kept) = (normal.n.rows, normal.reduced.unknowns.len());
        let fill = &normal.fill_in;
        let count = |count: usize| format::count(count);
        Some(view! {
            <p class="hint">{words::eliminated(count(kept), count(all - kept))}</p>
            <p class="hint">{words::fill_in(count(fill.matrix), count(fill.factor), count(fill.factor_photos_first))}</p>
            {(!normal.null_space.is_empty()).then(|| view! { <p class="hint">{words::singular(normal.null_space.len())}</p> })}
        })
    };
    view! {
        <Show when=move || any.get() fallback=|| view! { <main class="inside"><NothingYet/></main> }>
            <main class="inside">
                <section class="scroll" tabindex="0" aria-label=words::observation><Equation/></section>
                <section class="scroll pictures" tabindex="0" aria-label=words::matrices>
                    <Picture which=Which::A/>
                    <div class="normals"><Picture which=Which::N/><Picture which=Which::S/></div>
                    <div class="legend"><i></i><i></i><i></i><i></i><span>{words::share_of_largest}</span></div>
                    {elimination}
                </section>
                <section class="scroll" tabindex="0" aria-label=words::unknowns><Unknowns/></section>
                <Iterations/>
            </main>
        </Show>
    }
}
