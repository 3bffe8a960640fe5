//! Step 7: the report as it is printed, its texts and its sections.

use leptos::html::Div;
use leptos::prelude::*;
use sightline::project::{Paper, ReportSettings, Section};

use super::components::field::Field;
use super::components::icon::{Glyph, Icon};
use crate::browser::{event, file, paper};
use crate::edit::report::switch;
use crate::format;
use crate::i18n::{Language, Text, object, text};
use crate::store::Desk;
use crate::store::report::report_language;
use crate::view::components::no_result::NoResult;
use crate::view::components::no_result::OutOfDate;
use crate::view::components::title::TitleBar;

#[component]
pub fn Report() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let state = Memo::new(move |_| desk.document.with(|d| (d.result.is_some(), d.out_of_date())));
    view! {
        {move || match state.get() {
            (false, _) => view! { <NoResult/> }.into_any(),
            (true, true) => view! { <OutOfDate/> }.into_any(),
            (true, false) => view! { <Current/> }.into_any(),
        }}
    }
}

#[component]
fn Current() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let host = NodeRef::<Div>::new();
    Effect::new(move || desk.make_report());
    Effect::new(move || {
        let Some(host) = host.get() else { return };
        desk.reports.made.with(|made| match made {
            Some(made) => paper::show(&host, &made.page_style, &made.style, &made.body),
            None => paper::clear(&host),
        });
    });
    on_cleanup(paper::without_page_style);
    let shown = move || desk.reports.made.with(Option::is_some);
    // The print must agree with the fields, so it waits until the pages are made anew.
    let ready = move || shown() && !desk.reports.being_made.get();
    view! {
        <TitleBar title=text::report sentence=Signal::derive(|| text::report_sentence().to_owned())>
            <button class="button" disabled=move || !ready() on:click=move |_| desk.save_report()>{text::save_html}</button>
            <button class="button primary" disabled=move || !ready() on:click=move |_| paper::print()>{text::print_or_pdf}</button>
        </TitleBar>
        <main class="report-step">
            <div class="report-side scroll" tabindex="0" aria-label=text::report_settings>
                <Sections/>
                <Pages/>
                <Cover/>
                <Statements/>
            </div>
            <div class="paper-scroll" tabindex="0" aria-label=text::report_preview>
                {move || desk.reports.failure.get().map(|why| view! {
                    <p class="note bad" role="alert"><Glyph icon=Icon::Warning/> " " {why}</p>
                })}
                <Show when=move || !shown() && desk.reports.failure.with(Option::is_none)>
                    <p class="note" role="status">{text::writing_report}</p>
                </Show>
                <div class="paper" node_ref=host data-ready=move || ready().to_string()></div>
            </div>
        </main>
    }
}

fn settings<T>(desk: Desk, read: impl FnOnce(&ReportSettings) -> T) -> T {
    desk.document.with(|d| read(&d.project.report))
}

#[component]
fn Sections() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let names: [(Section, Text); 15] = [
        (Section::Summary, text::section_summary),
        (Section::Uncertainty, text::section_uncertainty),
        (Section::Observations, text::section_observations),
        (Section::Cameras, text::cameras),
        (Section::Network, text::section_network),
        (Section::Photos, text::photos),
        (Section::Points, text::points),
        (Section::Control, text::section_control),
        (Section::Lengths, text::section_lengths),
        (Section::Statistics, text::section_statistics),
        (Section::Residuals, text::residuals),
        (Section::GrossErrors, text::section_left_out),
        (Section::Features, object::features),
        (Section::Settings, text::section_settings),
        (Section::AllObservations, text::section_all_observations),
    ];
    view! {
        <section>
            <h2 class="section-head"><span>{text::report_sections}</span></h2>
            {names.into_iter().map(|(section, name)| {
                let on = move || settings(desk, |s| s.has(section));
                view! {
                    <label class="tick">
                        <input type="checkbox" prop:checked=on on:change=move |e| {
                            let on = event::checked(&e);
                            desk.edit_report(|s| switch(s, section, on));
                        }/>
                        <span>{name}</span>
                    </label>
                }
            }).collect_view()}
        </section>
    }
}

/// Language and size of the pages.
#[component]
fn Pages() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let language = move || Language::of_pages(settings(desk, report_language));
    let paper = move || match settings(desk, |s| s.paper) {
        Paper::A4 => "a4",
        Paper::Letter => "letter",
    };
    view! {
        <section class="report-fields">
            <label><span>{text::report_language}</span>
                <select name="report-language" prop:value=move || language().tag() on:change=move |e| {
                    let chosen = Language::from_tag(&event::value(&e));
                    desk.edit_report(|s| s.language = Some(chosen.pages()));
                }>
                    {Language::with_pages().map(|own| view! {
                        <option value=own.tag() selected=move || language() == own>{own.name()}</option>
                    }).collect_view()}
                </select>
            </label>
            <label><span>{text::paper_size}</span>
                <select name="paper" prop:value=paper on:change=move |e| {
                    let chosen = if event::value(&e) == "letter" { Paper::Letter } else { Paper::A4 };
                    desk.edit_report(|s| s.paper = chosen);
                }>
                    <option value="a4" selected=move || paper() == "a4">"A4"</option>
                    <option value="letter" selected=move || paper() == "letter">"Letter"</option>
                </select>
            </label>
        </section>
    }
}

/// Contents of the first page.
#[component]
fn Cover() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let field = move |label: Text,
                      name: &'static str,
                      get: fn(&ReportSettings) -> &String,
                      set: fn(&mut ReportSettings, String)| {
        let value = Signal::derive(move || settings(desk, |s| get(s).clone()));
        let commit = move |typed: String| desk.edit_report(|s| set(s, typed.trim().to_owned()));
        view! { <label><span>{label}</span><Field value commit attr:name=name/></label> }
    };
    let has_logo = move || settings(desk, |s| !s.logo.is_empty());
    let choose = move |_| {
        file::choose(".png,.jpg,.jpeg,image/png,image/jpeg", false, move |files| {
            if let Some(file) = files.into_iter().next() {
                desk.take_logo(file);
            }
        });
    };
    view! {
        <section class="report-fields">
            <h2 class="section-head"><span>{text::first_page}</span></h2>
            {field(text::report_title, "report-title", |s| &s.title, |s, typed| s.title = typed)}
            {field(text::measured_by, "operator", |s| &s.operator, |s, typed| s.operator = typed)}
            {field(text::date_of_report, "report-date", |s| &s.date, |s, typed| s.date = typed)}
            <label><span>{text::free_text}</span>
                <textarea name="report-text" rows="3" prop:value=move || settings(desk, |s| s.text.clone())
                    on:change=move |e| { let typed = event::value(&e); desk.edit_report(|s| s.text = typed); }></textarea>
            </label>
            <div class="row">
                <button class="button small" on:click=choose>{text::choose_logo}</button>
                <Show when=has_logo>
                    <button class="link" on:click=move |_| desk.edit_report(|s| s.logo.clear())>{text::remove_logo}</button>
                </Show>
            </div>
        </section>
    }
}

/// Inputs of the accuracy statements.
#[component]
fn Statements() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let unit = Memo::new(move |_| desk.document.with(|d| d.project.unit.clone()));
    let coverage = Signal::derive(move || format::editable(settings(desk, |s| s.coverage_factor)));
    let part = move |read: fn(&ReportSettings) -> Option<f64>| {
        Signal::derive(move || settings(desk, read).map(format::editable).unwrap_or_default())
    };
    let constant = part(|s| s.length_limit.map(|limit| limit.constant));
    let per = part(|s| s.length_limit.and_then(|limit| limit.per));
    view! {
        <section class="report-fields">
            <h2 class="section-head"><span>{text::statements}</span></h2>
            <label><span>{text::coverage_factor}</span>
                <Field value=coverage commit=move |typed: String| desk.set_coverage(&typed) attr:inputmode="decimal" attr:name="coverage"/>
            </label>
            <label><span>{move || text::limit_constant(unit.get())}</span>
                <Field value=constant commit=move |typed: String| desk.set_length_limit(&typed, &per.get_untracked()) attr:inputmode="decimal" attr:name="limit-constant"/>
            </label>
            <label><span>{text::limit_per}</span>
                <Field value=per commit=move |typed: String| desk.set_length_limit(&constant.get_untracked(), &typed) attr:inputmode="decimal" attr:name="limit-per"/>
            </label>
            <p class="note">{text::limit_hint}</p>
        </section>
    }
}
