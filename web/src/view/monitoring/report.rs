//! The report of a comparison, as it is printed.

use leptos::html::Div;
use leptos::prelude::*;

use crate::browser::paper;
use crate::i18n::text;
use crate::store::Desk;

#[component]
pub fn EpochsReport() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let made = desk.monitoring.report;
    let host = NodeRef::<Div>::new();
    Effect::new(move || desk.report_epochs());
    Effect::new(move || {
        let Some(host) = host.get() else { return };
        made.with(|made| match made {
            Some(made) => paper::show(&host, &made.page_style, &made.style, &made.body),
            None => paper::clear(&host),
        });
    });
    on_cleanup(paper::without_page_style);
    let ready = move || made.with(Option::is_some);
    view! {
        <main class="report-step epochs-report">
            <div class="report-side"><button class="button primary" data-action="print-epochs" disabled=move || !ready() on:click=move |_| paper::print()>{text::print_or_pdf}</button></div>
            <div class="paper-scroll" tabindex="0" aria-label=text::report_preview>
                <Show when=move || !ready()><p class="note" role="status">{text::writing_report}</p></Show>
                <div class="paper" node_ref=host data-ready=move || ready().to_string()></div>
            </div>
        </main>
    }
}
