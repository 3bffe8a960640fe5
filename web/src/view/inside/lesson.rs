//! The pane of lessons: a list of them; a step with its question; the summary, which can be printed.

use std::sync::Arc;

use leptos::html::Aside;
use leptos::prelude::*;
use sightline_lab::teaching::{Lesson, Question};

use crate::browser::{event, page};
use crate::format;
use crate::i18n::inside as words;
use crate::store::Desk;

#[component]
pub fn Lessons() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let lessons = desk.lessons;
    let body = move || match lessons.now.get() {
        None => view! { <List/> }.into_any(),
        Some(lesson) => {
            let last = lesson.steps.len();
            let through = Memo::new(move |_| lessons.step.get() >= last);
            let (head, end) = (lesson.clone(), lesson.clone());
            view! {
                <div class="row lesson-head">
                    <button class="text-button" data-action="all-lessons" on:click=move |_| lessons.now.set(None)>"← " {words::lessons}</button>
                    <span class="aside">{move || if through.get() { words::summary().to_owned() } else { words::step_number(lessons.step.get() + 1, last) }}</span>
                </div>
                <h2>{move || lessons.in_language(&head.title)}</h2>
                {move || if through.get() { view! { <Summary lesson=end.clone()/> }.into_any() } else { view! { <Step/> }.into_any() }}
                <div class="row">
                    <button class="button" data-action="lesson-back" disabled=move || lessons.step.get() == 0
                        on:click=move |_| desk.go_to_lesson_step(lessons.step.get_untracked().saturating_sub(1))>"← " {words::previous}</button>
                    <Show when=move || !through.get()>
                        <button class="button" data-action="lesson-next" class:primary=move || lessons.right.with(|right| right.contains(&lessons.step.get()))
                            on:click=move |_| desk.go_to_lesson_step(lessons.step.get_untracked() + 1)>{words::next} " →"</button>
                    </Show>
                </div>
            }
            .into_any()
        }
    };
    let pane = NodeRef::<Aside>::new();
    Effect::new(move || {
        lessons.now.track();
        lessons.step.track();
        if let Some(pane) = pane.get() {
            pane.set_scroll_top(0);
        }
    });
    view! {
        <aside class="lesson scroll" node_ref=pane aria-label=words::lessons>
            {body}
        </aside>
    }
}

#[component]
fn List() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let lessons = desk.lessons;
    let line = move |lesson: Arc<Lesson>| {
        let (answered, asked) = lessons.progress(&lesson);
        let (begun, id, minutes) = (lesson.clone(), lesson.id.clone(), lesson.minutes);
        view! {
            <li><button data-lesson=id on:click=move |_| desk.begin_lesson(&begun)>
                <b>{lessons.in_language(&lesson.title)}</b>
                <span>{lessons.in_language(&lesson.aim)}</span>
                <small>{words::minutes(minutes)} " · " {words::answered_of(answered, asked)}</small>
            </button></li>
        }
    };
    view! {
        <h2>{words::lessons}</h2>
        <p class="hint">{words::lessons_hint}</p>
        <ul>{move || lessons.all.get().into_iter().map(line).collect_view()}</ul>
        <div class="row">
            <button class="text-button" data-action="lesson-file" on:click=move |_| desk.open_lesson_file()>{words::open_lesson}</button>
            <button class="text-button" data-action="lesson-progress" on:click=move |_| desk.save_lesson_progress()>{words::save_progress}</button>
        </div>
        {move || lessons.refused.get().map(|why| view! { <p class="note warn" role="alert">{words::no_lesson(why)}</p> })}
    }
}

#[component]
fn Step() -> impl IntoView {
    let lessons = expect_context::<Desk>().lessons;
    move || {
        let step = lessons.current()?;
        let text = step.text.clone();
        Some(view! {
            <p class="lesson-text">{move || lessons.in_language(&text)}</p>
            {step.ask.map(|ask| view! { <Ask ask/> })}
        })
    }
}

#[component]
fn Ask(ask: Question) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let lessons = desk.lessons;
    let Question { text, value, tolerance, unit, choices, hint, why } = ask;
    let unreadable = RwSignal::new(false);
    // The data for the answer, and the reasons why it is not available.
    let needed: Vec<String> = value.iter().cloned().chain(choices.iter().map(|choice| choice.when.clone())).collect();
    let (first, all) = (needed.clone(), needed);
    let known = Memo::new(move |_| first.iter().all(|text| matches!(desk.lesson_value(text), Some(Ok(_)))));
    let fault = move || all.iter().find_map(|text| desk.lesson_value(text)?.err());
    let typed = value.map(|expression| {
        let check = move |typed: String| {
            let Some(Ok(right)) = untrack(|| desk.lesson_value(&expression)) else { return };
            let number = format::parse(&typed);
            unreadable.set(number.is_none() && !typed.trim().is_empty());
            if let Some(number) = number {
                // What is typed as shown may lie at the limit, but for rounding.
                desk.answer_lesson((number - right).abs() <= tolerance.unwrap_or_default() + 1e-9 * right.abs());
            }
        };
        view! {
            <label class="row"><span class="visually-hidden">{words::answer}</span>
                <input type="text" inputmode="decimal" name="lesson-answer" autocomplete="off" placeholder=words::answer disabled=move || !known.get()
                    on:change=move |e| check(event::value(&e))/><span>{unit}</span>
                <button class="button" data-action="lesson-check">{words::check}</button></label>
        }
    });
    let chosen = choices.into_iter().map(|choice| {
        let when = choice.when;
        let check = move |_| {
            if let Some(Ok(holds)) = untrack(|| desk.lesson_value(&when)) {
                desk.answer_lesson(holds != 0.0);
            }
        };
        view! {
            <label class="choice"><input type="radio" name="lesson-choice" disabled=move || !known.get() on:change=check/>
                <span>{move || lessons.in_language(&choice.text)}</span></label>
        }
    });
    let chosen = chosen.collect_view();
    view! {
        <fieldset class="ask">
            <legend>{move || lessons.in_language(&text)}</legend>
            {typed}{chosen}
        </fieldset>
        <div role="status">
            {move || match (fault(), unreadable.get(), lessons.answered.get()) {
                (Some(fault), _, _) => Some(view! { <p class="note warn">{words::no_answer(fault)}</p> }.into_any()),
                (_, true, _) => Some(view! { <p class="note warn">{words::not_a_number}</p> }.into_any()),
                (_, _, Some(true)) => Some(view! { <p class="note pass" data-answer="right"><b>{words::right}</b> " " {lessons.in_language(&why)}</p> }.into_any()),
                (_, _, Some(false)) => Some(view! { <p class="note warn" data-answer="wrong"><b>{words::not_right}</b> " " {lessons.in_language(&hint)}</p> }.into_any()),
                _ => None,
            }}
        </div>
    }
}

#[component]
fn Summary(lesson: Arc<Lesson>) -> impl IntoView {
    let lessons = expect_context::<Desk>().lessons;
    let asked = lesson.steps.iter().filter(|step| step.ask.is_some()).count();
    let (id, aim, summary) = (lesson.id.clone(), lesson.aim.clone(), lesson.summary.clone());
    let link = move || format!("#inside/{id}/{}", lessons.state());
    view! {
        <div class="lesson-summary">
            <p class="lesson-text">{move || lessons.in_language(&aim)}</p>
            <p class="lesson-text"><b>{move || lessons.in_language(&summary)}</b></p>
            <p>{move || words::answered_of(lessons.right.with(std::collections::BTreeSet::len), asked)}</p>
            <div class="row">
                <button class="button" data-action="lesson-print" on:click=move |_| page::print()>{words::print_summary}</button>
                <a href=link data-action="lesson-link">{words::state_link}</a>
            </div>
        </div>
    }
}
