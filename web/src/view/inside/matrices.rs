//! The matrices with one observation explained, the unknowns, and the steps.

use leptos::prelude::*;

use super::NothingYet;
use super::equation::Equation;
use super::iterations::Iterations;
use super::movement::Movement;
use super::picture::{Picture, Which};
use super::unknowns::Unknowns;
use crate::format;
use crate::i18n::{Text, inside as words};
use crate::store::Desk;

#[component]
pub fn Matrices() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let inside = desk.inside;
    let moves = RwSignal::new(false);
    let any = Memo::new(move |_| inside.steps.with(|steps| !steps.is_empty()));
    // The observation that a lesson refers to; further steps leave the one that is chosen.
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
        let (all, kept) = (normal.n.rows, looked.kept().len());
        let fill = &normal.fill_in;
        let count = |count: usize| format::count(count);
        Some(view! {
            <p class="hint">{words::eliminated(count(kept), count(all - kept))}</p>
            <p class="hint">{words::fill_in(count(fill.matrix), count(fill.factor), count(fill.factor_photos_first))}</p>
            {(!normal.null_space.is_empty()).then(|| view! { <p class="hint">{words::singular(normal.null_space.len())}" "{words::factor_held(normal.null_space.len())}</p> })}
        })
    };
    view! {
        <Show when=move || any.get() fallback=|| view! { <main class="inside"><NothingYet/></main> }>
            <main class="inside">
                <section class="scroll" tabindex="0" aria-label=words::observation><Equation/></section>
                <section class="scroll pictures" tabindex="0" aria-label=words::matrices>
                    <div class="panes">
                        {[("matrices", false, words::matrices as Text), ("movement", true, words::movement)].map(|(name, on, said)| view! {
                            <button class="text-button" data-pane=name aria-pressed=move || (moves.get() == on).to_string()
                                on:click=move |_| moves.set(on)>{said}</button>
                        }).collect_view()}
                    </div>
                    <Show when=move || moves.get() fallback=move || view! {
                        <Legend/>
                        <div><Picture which=Which::A/><Picture which=Which::L/></div>
                        <div class="normals"><Picture which=Which::N/><Picture which=Which::S/></div>
                        {elimination}
                    }><Movement/></Show>
                </section>
                <section class="of-unknowns" aria-label=words::unknowns><Unknowns/></section>
                <Iterations/>
            </main>
        </Show>
    }
}

/// What the colours of the matrices mean.
#[component]
fn Legend() -> impl IntoView {
    let kinds: [(&str, Text); 4] = [
        ("photo", words::of_photos),
        ("camera", words::of_cameras),
        ("point", words::of_points),
        ("filled", words::fill_in_is),
    ];
    let kinds = kinds.map(|(kind, said)| view! { <li><i data-of=kind></i>{said}</li> }).collect_view();
    view! {
        <ul class="legend" aria-label=words::colours_are>{kinds}<li class="shares"><i></i><i></i><i></i><i></i>{words::share_of_largest}</li></ul>
    }
}
