//! The open questions: the list of them, and the one that is asked over its photo, with one key an answer.

use leptos::html::Input;
use leptos::prelude::*;
use sightline::matching::Doubt;

use super::marking::Keyed;
use crate::browser::event;
use crate::edit::questions::Question;
use crate::format;
use crate::i18n::text;
use crate::store::Desk;

fn reason(question: &Question) -> String {
    match question.reason {
        Doubt::DuplicateCode => text::doubt_duplicate(&question.photo),
        Doubt::CodeFamily => text::doubt_code_family(&question.photo),
        Doubt::CodeUnclear => text::doubt_code_unclear(&question.photo),
        Doubt::Occluded => text::doubt_occluded(&question.photo),
        Doubt::Ambiguous => text::doubt_ambiguous(&question.photo),
        Doubt::Disagrees => text::doubt_disagrees(&question.photo),
    }
}

/// The question that is asked, above the photo.
#[component]
pub fn QuestionBar() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let asked = Memo::new(move |_| desk.asked_question());
    let other = NodeRef::<Input>::new();
    let typed = RwSignal::new(String::new());
    Effect::new(move |_| {
        asked.track();
        typed.set(String::new());
    });
    let sentence = move || {
        asked.get().map(|q| {
            let place = desk.questions().iter().position(|other| *other == q).map_or(0, |at| at + 1);
            let count = text::question_of(place, desk.questions().len());
            let words = match &q.point {
                Some(point) => text::is_this(point),
                None => text::which_is_this().to_owned(),
            };
            view! { <b>{words}</b> " " {reason(&q)} ". " <span class="quiet">{count}</span> }
        })
    };
    view! {
        <Show when=move || asked.with(Option::is_some)>
            <form class="question marking" aria-label=text::questions on:submit=move |e| {
                e.prevent_default();
                desk.answer_yes(Some(&typed.get_untracked()));
            }>
                <p>{sentence}</p>
                <Show when=move || asked.with(|q| q.as_ref().is_some_and(|q| q.point.is_some()))>
                    <Keyed words=text::yes key="Y" primary=true action="yes" on_click=Callback::new(move |()| desk.answer_yes(None))/>
                </Show>
                <Keyed words=text::no key="N" action="no" on_click=Callback::new(move |()| desk.answer_no())/>
                <label><span>{text::other}</span>
                    <input type="text" id="other-name" autocomplete="off" node_ref=other prop:value=typed on:input=move |e| typed.set(event::value(&e))/>
                </label>
                <Keyed words=text::next_question key="D" action="next-question" on_click=Callback::new(move |()| desk.next_question())/>
            </form>
        </Show>
    }
}

/// How many questions there are, and the way to the first.
#[component]
pub fn QuestionList() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let all = Memo::new(move |_| desk.questions());
    view! {
        <Show when=move || all.with(|all| !all.is_empty())>
            <section class="panel questions">
                <h2 class="section-head">
                    <span>{text::questions} " " <span class="id">{move || format::count(all.with(Vec::len))}</span></span>
                    <button class="button small" data-action="questions" on:click=move |_| desk.next_question()>{text::answer_them} " " <kbd>"D"</kbd></button>
                </h2>
                <ul class="scroll short-list" tabindex="0" aria-label=text::questions>
                    {move || all.get().into_iter().take(200).map(|q| {
                        let words = match &q.point {
                            Some(point) => text::is_this(point),
                            None => text::which_is_this().to_owned(),
                        };
                        let why = reason(&q);
                        let chosen = { let q = q.clone(); move || desk.measuring.question.with(|now| now.as_ref() == Some(&q)) };
                        view! {
                            <li class:chosen=chosen><button class="link" on:click=move |_| desk.ask_question(q.clone())>{words}</button> <span>{why}</span></li>
                        }
                    }).collect_view()}
                </ul>
            </section>
        </Show>
    }
}
