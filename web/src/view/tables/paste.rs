//! Rows pasted from a spreadsheet, with a preview of the changes.

use std::sync::Arc;

use leptos::prelude::*;

use super::{heading, plain_heading};
use crate::browser::event;
use crate::format;
use crate::i18n::text;
use crate::store::Desk;
use crate::store::tables::{Planned, Shared, refusal_words};

/// Changes shown; all are taken.
const SHOWN: usize = 200;

#[component]
pub fn PastePanel(sheet: Memo<Shared>, rows: Memo<Arc<Vec<u32>>>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let plan = desk.tables.plan;
    let counts = move || {
        plan.with(|plan| {
            let all = plan.as_ref().map_or(0, |plan| plan.cells.len());
            let good = plan.as_ref().map_or(0, |plan| plan.cells.iter().filter(|c| c.refusal.is_none()).count());
            (good, all - good, plan.as_ref().map_or(0, |plan| plan.lost))
        })
    };
    let line = move |planned: Planned| {
        let table = sheet.with_untracked(|s| s.0.table);
        let refused = planned.refusal.is_some();
        let why = planned.refusal.map(|refusal| refusal_words(&refusal, &planned.cell.typed));
        view! {
            <tr class:wrong=refused>
                <td class="left id">{planned.cell.key.replace('\u{1f}', ", ")}</td>
                <td class="left">{heading(desk, table, planned.cell.col).0}</td>
                <td class="left">{planned.before}</td>
                <td class="left">{planned.cell.typed}</td>
                <td class="left wide bad">{why}</td>
            </tr>
        }
    };
    view! {
        <textarea id="pasted-cells" class="pasted-cells" rows="2" aria-label=text::paste_cells placeholder=text::paste_cells prop:value=""
            on:input=move |e| {
                let typed = event::value(&e);
                if !typed.trim().is_empty() {
                    sheet.with_untracked(|s| rows.with_untracked(|rows| {
                        desk.plan_paste(&s.0, rows, &typed, |col| plain_heading(desk, s.0.table, col));
                    }));
                }
                event::clear(&e);
            }></textarea>
        <Show when=move || plan.with(Option::is_some)>
            <section class="panel plan" aria-live="polite">
                <h2 class="section-head">
                    <span>{move || { let (good, bad, lost) = counts(); text::plan_counts(format::count(good), format::count(bad), format::count(lost)) }}</span>
                    <button class="link" on:click=move |_| plan.set(None)>{text::discard}</button>
                    <button class="button small primary" data-action="take-plan" disabled=move || counts().0 == 0
                        on:click=move |_| desk.take_plan(sheet.with_untracked(|s| s.0.table))>{text::take_changes}</button>
                </h2>
                <div class="scroll preview" tabindex="0" role="region" aria-label=text::paste>
                    <table class="table"><tbody>
                        {move || plan.with(|plan| plan.as_ref().map(|plan| plan.cells.iter().take(SHOWN).cloned().collect::<Vec<_>>())
                            .unwrap_or_default()).into_iter().map(line).collect_view()}
                    </tbody></table>
                </div>
            </section>
        </Show>
    }
}
