//! The meaning of each statistic: a sentence, its formula, source and remedy.

use leptos::prelude::*;
use sightline::adjustment::Criteria;

use crate::format;
use crate::i18n::{Text, text};
use crate::store::Desk;

/// A statistic that is explained.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Statistic {
    Sigma0,
    GlobalTest,
    Redundancy,
    RmsResidual,
    RmsSigma,
    RelativeAccuracy,
    CheckRms,
    W,
    RedundancyNumber,
    Detectable,
    Significance,
    Correlation,
}

/// Its name, what it means, its formula, its source, and what to do.
struct Meaning {
    of: Statistic,
    name: Text,
    means: fn(&Criteria) -> String,
    formula: &'static str,
    source: &'static str,
    what_to_do: Text,
}

const MEANINGS: [Meaning; 12] = [
    Meaning {
        of: Statistic::Sigma0,
        name: text::sigma0_name,
        means: |_| text::sigma0_means().into(),
        formula: "σ₀ = √(vᵀPv / r)",
        source: "Mikhail & Ackermann 1976",
        what_to_do: text::sigma0_do,
    },
    Meaning {
        of: Statistic::GlobalTest,
        name: text::global_name,
        means: |_| text::global_means().into(),
        formula: "χ²(2.5 %, r) ≤ vᵀPv ≤ χ²(97.5 %, r)",
        source: "Baarda 1968",
        what_to_do: text::global_do,
    },
    Meaning {
        of: Statistic::Redundancy,
        name: text::redundancy,
        means: |_| text::redundancy_means().into(),
        formula: "r = n − u + d",
        source: "Mikhail & Ackermann 1976",
        what_to_do: text::redundancy_do,
    },
    Meaning {
        of: Statistic::RmsResidual,
        name: text::rms_residual,
        means: |_| text::rms_residual_means().into(),
        formula: "√(Σ v² / n)",
        source: "Luhmann et al. 2020, 4.4",
        what_to_do: text::rms_residual_do,
    },
    Meaning {
        of: Statistic::RmsSigma,
        name: text::rms_sigma,
        means: |_| text::rms_sigma_means().into(),
        formula: "σ = σ₀ √q,  rms = √(Σ σ² / n)",
        source: "Fraser 1984",
        what_to_do: text::rms_sigma_do,
    },
    Meaning {
        of: Statistic::RelativeAccuracy,
        name: text::relative_accuracy,
        means: |_| text::relative_means().into(),
        formula: "1 : (D / σ̄)",
        source: "Fraser 1984",
        what_to_do: text::relative_do,
    },
    Meaning {
        of: Statistic::CheckRms,
        name: text::check_rms,
        means: |_| text::check_rms_means().into(),
        formula: "√(Σ Δ² / 3n)",
        source: "Luhmann et al. 2020, 7.2",
        what_to_do: text::check_rms_do,
    },
    Meaning {
        of: Statistic::W,
        name: text::w_name,
        means: |limits| text::w_means(format::fixed(limits.w, 2)),
        formula: "w = v / (σ √r)",
        source: "Baarda 1968",
        what_to_do: text::w_do,
    },
    Meaning {
        of: Statistic::RedundancyNumber,
        name: text::r_name,
        means: |_| text::r_means().into(),
        formula: "r = (Qv P)ᵢᵢ",
        source: "Förstner 1979",
        what_to_do: text::r_do,
    },
    Meaning {
        of: Statistic::Detectable,
        name: text::mdb_name,
        means: |_| text::mdb_means().into(),
        formula: "∇ = δ₀ σ / √r",
        source: "Baarda 1968",
        what_to_do: text::mdb_do,
    },
    Meaning {
        of: Statistic::Significance,
        name: text::significance_name,
        means: |_| text::significance_means().into(),
        formula: "|value| / σ",
        source: "Fraser 1982",
        what_to_do: text::significance_do,
    },
    Meaning {
        of: Statistic::Correlation,
        name: text::correlation_name,
        means: |limits| text::correlation_means(format::fixed(limits.high_correlation, 2)),
        formula: "ρ = σᵢⱼ / (σᵢ σⱼ)",
        source: "Fraser 1982",
        what_to_do: text::correlation_do,
    },
];

/// The list, with the chosen one open.
#[component]
pub(super) fn Meanings(chosen: RwSignal<Option<Statistic>>) -> impl IntoView {
    let desk = expect_context::<Desk>();
    view! {
        <main class="meanings scroll" tabindex="0" aria-label=text::meanings>
            {MEANINGS.into_iter().map(|meaning| {
                let open = move || chosen.get() == Some(meaning.of);
                view! {
                    <details prop:open=open>
                        <summary>{meaning.name} <code>{meaning.formula}</code></summary>
                        <p>{move || (meaning.means)(&desk.criteria())}</p>
                        <p><b>{text::what_to_do}</b> " " {meaning.what_to_do}</p>
                        <p class="note">{text::source} ": " {meaning.source}</p>
                    </details>
                }
            }).collect_view()}
        </main>
    }
}
