//! Handling of gross errors, and the record of the search.

use crate::view::components::given::follow;
use leptos::prelude::*;
use sightline::adjustment::{AdjustOptions, GrossErrorAction, Robust};

use crate::format;
use crate::i18n::{Text, text};
use crate::store::Desk;
use crate::view::components::given::given_kind;
use crate::view::components::given::given_name;

/// A way to treat gross errors.
#[derive(Clone, Copy, Debug)]
struct Treatment {
    snooping: bool,
    robust: Option<Robust>,
    title: Text,
    body: Text,
}

const TREATMENTS: [Treatment; 4] = [
    Treatment { snooping: false, robust: None, title: text::gross_left, body: text::gross_left_body },
    Treatment { snooping: true, robust: None, title: text::gross_snooping, body: text::gross_snooping_body },
    Treatment { snooping: false, robust: Some(Robust::Huber), title: text::gross_huber, body: text::gross_huber_body },
    Treatment { snooping: false, robust: Some(Robust::Tukey), title: text::gross_tukey, body: text::gross_tukey_body },
];

impl Treatment {
    fn chosen(&self, options: &AdjustOptions) -> bool {
        options.snooping == self.snooping && options.robust == self.robust
    }
}

/// The choice between leaving everything in, taking out and weighting down.
#[component]
pub fn GrossErrors() -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <section class="panel">
        <h2 class="section-head"><span>{text::gross_errors}</span></h2>
        <fieldset class="datum">
            <legend class="visually-hidden">{text::gross_errors}</legend>
            {TREATMENTS.into_iter().map(|treatment| {
                let chosen = move || desk.document.with(|d| treatment.chosen(&d.options));
                let choose = move |_| desk.set_options(|options| {
                    options.snooping = treatment.snooping;
                    options.robust = treatment.robust;
                });
                view! {
                    <label class="radio" class:chosen=chosen>
                        <input type="radio" name="gross-errors" prop:checked=chosen on:change=choose/>
                        <span><b>{treatment.title}</b><span>{treatment.body}</span></span>
                    </label>
                }
            }).collect_view()}
        </fieldset>
        </section>
    }
}

/// Observations that were rejected, restored or downweighted, and why.
#[component]
pub fn GrossErrorRecord() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let record = Memo::new(move |_| {
        desk.document.with(|d| d.current().map(|r| r.adjustment.gross_errors.clone()).unwrap_or_default())
    });
    let action = |action| match action {
        GrossErrorAction::Removed => text::gross_removed(),
        GrossErrorAction::Restored => text::gross_restored(),
        GrossErrorAction::Downweighted => text::gross_downweighted(),
        GrossErrorAction::Kept => text::gross_kept(),
    };
    view! {
        <Show when=move || record.with(|r| !r.is_empty())>
            <h2 class="section-head"><span>{text::gross_record}</span><span class="aside">{move || record.with(Vec::len)}</span></h2>
            <table class="table gross-errors">
                <thead><tr>
                    <th class="left">{text::id}</th><th class="left">{text::photo_or_kind}</th><th class="left">{text::gross_action}</th>
                    <th>{text::gross_statistic}</th><th>{text::gross_limit}</th><th>{text::gross_round}</th>
                </tr></thead>
                <tbody>
                    {move || record.get().into_iter().map(|entry| {
                        let consequence = entry.consequence;
                        let name = entry.given.as_ref().map_or_else(|| entry.point.clone(), given_name);
                        let what = entry.given.clone();
                        let photo = entry.photo.clone();
                        let show = move |_| follow(desk, &entry.photo, &entry.point, entry.given.as_ref());
                        view! {
                            <tr>
                                <td class="left id"><button class="link" on:click=show>{name}</button></td>
                                <td class="left">{move || what.as_ref().map_or_else(|| photo.clone(), |what| given_kind(what).to_owned())}</td>
                                <td class="left">{move || action(entry.action)}
                                    {consequence.then(|| view! { <small>" " {text::gross_consequence}</small> })}
                                </td>
                                <td>{format::fixed(entry.statistic, 2)}</td>
                                <td>{format::fixed(entry.limit, 2)}</td>
                                <td>{entry.round}</td>
                            </tr>
                        }
                    }).collect_view()}
                </tbody>
            </table>
        </Show>
    }
}
