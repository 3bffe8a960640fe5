//! The report of a comparison of epochs, and its sentences, which the desk uses too.
//!
//! Sections: verdict, epochs, tests, stable points, displacements, groups, points over time, points that were left out, settings.

mod notes;

use super::Report;
use super::html::{Html, Table};
use super::number::{count, decimals_for, fixed, maybe};
use super::plots::displacements;
use super::sections::figures;
use super::style;
use super::texts::{Words, words};
use sightline::axes::ShownAxes;
use sightline::monitoring::{
    ComparisonMethod, Correction, Displacement, GroupError, GroupModel, LeftOutPoint, LeftOutPointReason, Monitoring,
    Options, Outcome, Pair, PointRole, ReferenceFrom, Series, Test, Tested, ThresholdState, VarianceUsed, days,
};
use sightline::project::{ReportLanguage, ReportSettings};

pub use notes::{assumed, notes};

/// Days of a mean month: velocities are shown per month.
pub const MONTH: f64 = 30.436_875;
/// Names that are written out on the desk; more are counted.
const NAMED: usize = 12;

/// Names in a row, those beyond a dozen as their number.
pub fn listed(names: &[String], language: ReportLanguage) -> String {
    let shown = names.iter().take(NAMED).cloned().collect::<Vec<_>>().join(", ");
    let more = names.len().saturating_sub(NAMED);
    if more > 0 { format!("{shown} {}", words(language).epochs_and_more(&more)) } else { shown }
}

/// How many object points moved, of how many that were tested.
pub fn counts(pair: &Pair) -> (usize, usize) {
    let object = || pair.points.iter().filter(|p| p.role == PointRole::Object && !pair.unstable.contains(&p.id));
    (object().filter(|p| p.moved).count(), object().filter(|p| p.test.is_some()).count())
}

/// The verdict in one sentence.
pub fn verdict(pair: &Pair, language: ReportLanguage) -> String {
    let w = words(language);
    let (k, n) = counts(pair);
    let (r, u) = (pair.stable.len(), pair.unstable.len());
    let names = listed(&pair.unstable, language);
    match (pair.outcome, n, k) {
        (Outcome::NoStableGroup, ..) => w.epochs_undecided(&(r + u)),
        (Outcome::Congruent, 0, _) => w.epochs_only_stable(&r),
        (Outcome::StableGroup, 0, _) => w.epochs_only_unstable(&u, &names, &r),
        (Outcome::Congruent, _, 0) => w.epochs_still_stable(&n, &r),
        (Outcome::Congruent, ..) => w.epochs_moved_stable(&k, &n, &r),
        (Outcome::StableGroup, _, 0) => w.epochs_still_unstable(&n, &u, &names, &r),
        (Outcome::StableGroup, ..) => w.epochs_moved_unstable(&k, &n, &u, &names, &r),
    }
}

/// Of which epochs the verdict is, how far apart they are, and in which datum.
pub fn particulars(found: &Monitoring, pair: &Pair, language: ReportLanguage) -> String {
    let w = words(language);
    let day = |name: &String| found.epochs.iter().find(|e| e.name == *name).and_then(|e| days(e.date.as_deref()?));
    let apart = day(&pair.to).zip(day(&pair.from)).map(|(b, a)| w.epochs_days_apart(&(b - a).round()));
    let datum = match pair.outcome {
        Outcome::NoStableGroup => w.epochs_undecided_remedy().to_owned(),
        _ => w.epochs_datum_of(&listed(&pair.stable, language)),
    };
    std::iter::once(w.epochs_against(&pair.to, &pair.from)).chain(apart).chain([datum]).collect::<Vec<_>>().join(" ")
}

/// Where the reference points come from, which variance factor and which method the tests use.
pub fn basis(found: &Monitoring, pair: &Pair, language: ReportLanguage) -> String {
    let w = words(language);
    let from = match pair.reference_from {
        ReferenceFrom::Named => w.epochs_from_named(),
        ReferenceFrom::Control => w.epochs_from_control(),
        ReferenceFrom::Datum => w.epochs_from_datum(),
        ReferenceFrom::Common => w.epochs_from_common(),
    };
    let variance = match pair.variance {
        VarianceUsed::Pooled => w.epochs_variance_pooled(&maybe(pair.sigma0, 3)),
        VarianceUsed::Separate => w.epochs_variance_separate_used().to_owned(),
        VarianceUsed::Given => w.epochs_variance_given_used().to_owned(),
    };
    let joint = match (&found.joint, found.method) {
        (Some(all), _) if all.cameras.is_empty() => w.epochs_joint_own(&all.points.len()),
        (Some(all), _) => w.epochs_joint_shared(&all.points.len(), &listed(&all.shared(), language)),
        (None, ComparisonMethod::Joint) => w.epochs_method_joint_used().to_owned(),
        (None, ComparisonMethod::Coordinates) => String::new(),
    };
    format!("{from} {variance} {joint}").trim_end().to_owned()
}

/// Why the movement of a group is not determined.
pub fn group_error(error: &GroupError, language: ReportLanguage) -> String {
    let w = words(language);
    match error {
        GroupError::TooFewPoints { needed, given } => w.epochs_group_too_few(given, needed),
        GroupError::Undetermined => w.epochs_group_undetermined().to_owned(),
        GroupError::NoStableGroup => w.epochs_group_no_stable().to_owned(),
    }
}

/// State by the thresholds.
pub fn state(state: ThresholdState, language: ReportLanguage) -> &'static str {
    let w = words(language);
    match state {
        ThresholdState::Quiet => w.epochs_state_quiet(),
        ThresholdState::Warning => w.epochs_state_warning(),
        ThresholdState::Alarm => w.epochs_state_alarm(),
    }
}

/// Points that were not used, a sentence for each reason.
pub fn left_out(left_out: &[LeftOutPoint], language: ReportLanguage) -> Vec<String> {
    let w = words(language);
    let mut kinds: Vec<(LeftOutPointReason, Vec<String>)> = Vec::new();
    for one in left_out {
        // Which points may be it is told with its name, and makes no kind of its own.
        let (kind, name) = match &one.reason {
            LeftOutPointReason::Ambiguous { epoch, candidates } => {
                let kind = LeftOutPointReason::Ambiguous { epoch: epoch.clone(), candidates: Vec::new() };
                (kind, format!("{} ({})", one.id, candidates.join(", ")))
            }
            other => (other.clone(), one.id.clone()),
        };
        match kinds.iter_mut().find(|(known, _)| *known == kind) {
            Some((_, names)) => names.push(name),
            None => kinds.push((kind, vec![name])),
        }
    }
    let told = |(kind, names): (LeftOutPointReason, Vec<String>)| {
        let (n, names) = (names.len(), listed(&names, language));
        match kind {
            LeftOutPointReason::OnlyIn { epoch } => w.epochs_left_only_in(&n, &epoch, &names),
            LeftOutPointReason::Ignored => w.epochs_left_ignored(&n, &names),
            LeftOutPointReason::NoSigma { epoch } => w.epochs_left_no_sigma(&n, &epoch, &names),
            LeftOutPointReason::NoCounterpart { epoch } => w.epochs_left_no_counterpart(&n, &epoch, &names),
            LeftOutPointReason::Ambiguous { epoch, .. } => w.epochs_left_ambiguous(&n, &epoch, &names),
            LeftOutPointReason::NoIdentity { epoch } => w.epochs_left_no_identity(&n, &epoch, &names),
            LeftOutPointReason::Held => w.epochs_left_held(&n, &names),
        }
    };
    kinds.into_iter().map(told).collect()
}

/// A probability as it is read.
pub fn probability(p: f64) -> String {
    match p {
        p if p < 1e-4 => "< 0.0001".to_owned(),
        p if p < 0.01 => fixed(p, 4),
        p => fixed(p, 2),
    }
}

/// Decimals of displacements: those of their smallest standard error.
pub fn decimals(pair: &Pair) -> usize {
    let sigmas = pair.points.iter().flat_map(|p| p.sigma).filter(|s| *s > 0.0).fold(f64::INFINITY, f64::min);
    if sigmas.is_finite() { decimals_for(sigmas) } else { 3 }
}

/// Speed of a point per month and its standard error along the movement.
pub fn speed(series: &Series) -> Option<(f64, Option<f64>)> {
    let (v, s) = series.velocity.zip(series.velocity_sigma)?;
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let along = || MONTH * (0..3).map(|k| (v[k] * s[k] / length).powi(2)).sum::<f64>().sqrt();
    Some((MONTH * length, (length > 0.0).then(along)))
}

/// The report of a comparison, in the language, on the paper and with the title, operator, date and text of `settings`.
pub fn report(found: &Monitoring, options: &Options, settings: &ReportSettings) -> Report {
    let language = settings.language.unwrap_or_default();
    let w = words(language);
    let pages = Pages { found, options, language, w, unit: found.unit.clone().unwrap_or_default() };
    let title = settings.title.trim();
    let title = if title.is_empty() { w.epochs_report_title() } else { title };
    let tag = match language {
        ReportLanguage::English => "en",
        ReportLanguage::Korean => "ko",
    };
    let mut html = Html::default();
    html.raw(&format!("<article class=\"report\" lang=\"{tag}\">\n"));
    html.open("header", "").element("h1", "", title);
    let who = [(w.operator(), settings.operator.trim()), (w.date(), settings.date.trim())];
    let who = who.into_iter().filter(|(_, value)| !value.is_empty()).map(|(name, value)| format!("{name}: {value}"));
    let who: Vec<String> = who.collect();
    if !who.is_empty() {
        html.element("p", "note", &who.join("   ·   "));
    }
    if !settings.text.trim().is_empty() {
        html.element("p", "said", settings.text.trim());
    }
    html.close("header");
    sections(&pages, &mut html);
    html.close("article");
    Report {
        language: tag,
        title: title.to_owned(),
        page_style: style::pages(settings, title, w.epochs_report_title(), &w.all_sigmas(&pages.unit)),
        style: style::STYLE,
        body: html.finish(),
    }
}

/// Writes a section.
type Write<'a> = fn(&Pages<'a>, &mut Html);

/// The sections with contents, numbered in their order.
fn sections<'a>(pages: &Pages<'a>, html: &mut Html) {
    let w = pages.w;
    let sections: [(&str, &str, Write<'a>); 8] = [
        ("epochs-verdict", w.summary(), Pages::verdict),
        ("epochs", w.epochs_epochs(), Pages::epochs),
        ("epochs-tests", w.statistics(), Pages::tests),
        ("epochs-stable", w.epochs_stable_points(), Pages::stable),
        ("epochs-displacements", w.epochs_displacements(), Pages::displacements),
        ("epochs-groups", w.epochs_groups(), Pages::groups),
        ("epochs-series", w.epochs_series(), Pages::series),
        ("epochs-settings", w.settings(), Pages::settings),
    ];
    let mut number = 0;
    for (name, title, write) in sections {
        let mut content = Html::default();
        write(pages, &mut content);
        let content = content.finish();
        if content.is_empty() {
            continue;
        }
        number += 1;
        html.raw(&format!("<section data-section=\"{name}\">\n"));
        html.element("h2", "", &format!("{number}  {title}")).raw(&content).close("section");
    }
}

struct Pages<'a> {
    found: &'a Monitoring,
    options: &'a Options,
    language: ReportLanguage,
    w: &'static dyn Words,
    unit: String,
}

impl Pages<'_> {
    /// Pairs with the first epoch: those that the verdicts are of.
    fn pairs(&self) -> &[Pair] {
        let n = self.found.epochs.len().saturating_sub(1).min(self.found.pairs.len());
        &self.found.pairs[..n]
    }

    fn verdict(&self, html: &mut Html) {
        for pair in self.pairs().iter().rev() {
            html.element("p", "said", &verdict(pair, self.language));
            html.p(&particulars(self.found, pair, self.language));
            html.list(&notes(pair, self.language));
        }
    }

    fn epochs(&self, html: &mut Html) {
        let w = self.w;
        let mut table = Table::new().words("").words(w.epochs_name()).words(w.date()).number(w.points());
        table = table.number("σ₀").number(w.redundancy()).number("°C");
        for (k, epoch) in self.found.epochs.iter().enumerate() {
            table.row(vec![
                k.to_string(),
                epoch.name.clone(),
                epoch.date.clone().unwrap_or_else(|| "–".into()),
                count(epoch.points),
                maybe(epoch.sigma0, 3),
                maybe(epoch.redundancy, 0),
                maybe(epoch.temperature, 1),
            ]);
        }
        html.table(table);
        let mut all: Vec<String> = Vec::new();
        for note in self.pairs().iter().flat_map(|pair| assumed(self.found, pair, self.language)) {
            if !all.contains(&note) {
                all.push(note);
            }
        }
        if !all.is_empty() {
            html.list(&all);
        }
    }

    fn test_cells(&self, test: &Test) -> Vec<String> {
        vec![
            fixed(test.statistic, 2),
            fixed(test.limit, 2),
            maybe(Some(test.f1), 0),
            test.f2.map_or("∞".to_owned(), |f| count(f.round() as usize)),
            probability(test.p),
            if test.passed { format!("✓ {}", self.w.passed()) } else { format!("✕ {}", self.w.epochs_rejected()) },
        ]
    }

    fn tests(&self, html: &mut Html) {
        let w = self.w;
        for pair in self.pairs() {
            html.h3(&w.epochs_against(&pair.to, &pair.from));
            let mut table = Table::new()
                .words(w.epochs_test())
                .number("T")
                .number(w.limit())
                .number("f₁")
                .number("f₂")
                .number("p")
                .words("");
            let mut row = |name: String, test: &Test| {
                let class = if test.passed { "" } else { "bad" };
                table.row_of(class, [vec![name], self.test_cells(test)].concat());
            };
            if let Some(test) = &pair.variance_test {
                row(w.epochs_variance_test().to_owned(), test);
            }
            if let Some(scale) = &pair.scale {
                row(
                    w.epochs_scale_test(&fixed(1e6 * (scale.value - 1.0), 1), &fixed(1e6 * scale.sigma, 1)),
                    &scale.test,
                );
            }
            if let Some(test) = &pair.global_test {
                row(w.epochs_congruence_all(&(pair.stable.len() + pair.unstable.len())), test);
            }
            for step in &pair.steps {
                row(w.epochs_congruence_without(&step.removed), &step.test);
            }
            html.table(table).note(&basis(self.found, pair, self.language));
        }
    }

    /// A table of displacements.
    fn table(&self, pair: &Pair, chosen: impl Fn(&Displacement) -> bool, html: &mut Html) {
        let (w, unit, d) = (self.w, self.unit.as_str(), decimals(pair));
        let axes = ShownAxes::of(self.found.axes);
        let mut table = Table::new().dense().words("");
        for axis in axes.names() {
            table = table.low(&format!("d{axis}"), "", unit);
        }
        table = table
            .low("|d|", "", unit)
            .low("σ", "", unit)
            .number("T")
            .number("p")
            .low(w.epochs_detectable(), "", unit)
            .words("");
        for point in pair.points.iter().filter(|p| chosen(p)) {
            let (said, class) = match (point.role, pair.unstable.contains(&point.id)) {
                (PointRole::Reference, _) => (w.epochs_in_datum(), ""),
                (PointRole::Object, true) => (w.epochs_out_of_datum(), "bad"),
                (PointRole::Object, false) if point.test.is_none() => (w.epochs_not_tested(), ""),
                (PointRole::Object, false) if point.moved => (w.epochs_moved(), "bad"),
                (PointRole::Object, false) => (w.epochs_stable(), ""),
            };
            let name = match &point.later_id {
                Some(later) => format!("{} ({later})", point.id),
                None => point.id.clone(),
            };
            let mut cells = vec![name];
            cells.extend(axes.shown(point.difference).map(|x| fixed(x, d)));
            cells.extend([fixed(point.length, d), maybe(point.length_sigma, d)]);
            cells.push(maybe(point.test.map(|t| t.statistic), 1));
            cells.push(point.test.map_or("–".to_owned(), |t| probability(t.p)));
            cells.extend([maybe(point.detectable.map(|x| x.worst), d), said.to_owned()]);
            table.row_of(class, cells);
        }
        html.table(table);
    }

    fn stable(&self, html: &mut Html) {
        let w = self.w;
        for pair in self.pairs() {
            html.h3(&w.epochs_against(&pair.to, &pair.from));
            self.table(pair, |p| p.role == PointRole::Reference || pair.unstable.contains(&p.id), html);
            html.p(&match pair.robust_datum.unstable.as_slice() {
                [] => w.epochs_second_opinion_stable().to_owned(),
                names => w.epochs_second_opinion_unstable(&names.join(", ")),
            });
        }
    }

    fn displacements(&self, html: &mut Html) {
        let w = self.w;
        for pair in self.pairs() {
            let object = |p: &Displacement| p.role == PointRole::Object && !pair.unstable.contains(&p.id);
            html.h3(&w.epochs_against(&pair.to, &pair.from));
            figures(html, displacements::plots(pair, &self.unit, decimals(pair), w).iter());
            if pair.points.iter().any(object) {
                self.table(pair, object, html);
            }
            let left = left_out(&pair.left_out, self.language);
            if !left.is_empty() {
                html.p(w.epochs_left_out()).list(&left);
            }
        }
        let percent = |share: f64| maybe(Some((1e6 * share).round() / 1e4), 0);
        html.note(&w.epochs_detectable_means(&percent(self.options.power)));
    }

    fn groups(&self, html: &mut Html) {
        let w = self.w;
        for pair in self.pairs() {
            let d = decimals(pair);
            for group in &pair.groups {
                let model = match group.model {
                    GroupModel::Rigid => w.epochs_rigid(),
                    GroupModel::Similarity => w.epochs_similarity(),
                    GroupModel::Affine => w.epochs_affine(),
                };
                html.h3(&format!("{}: {} ({model})", pair.to, group.name));
                if let Some(error) = &group.error {
                    html.p(&group_error(error, self.language));
                }
                let list = |tested: &Option<Tested>, factor: f64, decimals: usize, unit: &str| {
                    let tested = tested.as_ref()?;
                    let one = |(v, s): (&f64, &f64)| {
                        format!("{} ± {}", fixed(v * factor, decimals), fixed(s * factor, decimals))
                    };
                    Some(format!(
                        "{} {unit}",
                        tested.value.iter().zip(&tested.sigma).map(one).collect::<Vec<_>>().join(";  ")
                    ))
                };
                let test = group.test.as_ref().map(|t| {
                    let said = if t.passed { w.epochs_stable() } else { w.epochs_moved() };
                    format!(
                        "T {}, {} {}, p {}: {said}",
                        fixed(t.statistic, 2),
                        w.limit(),
                        fixed(t.limit, 2),
                        probability(t.p)
                    )
                });
                let fit = group
                    .fit
                    .as_ref()
                    .map(|t| if t.passed { w.epochs_fit_yes() } else { w.epochs_fit_no() }.to_owned());
                let lines = [
                    (w.points(), Some(listed(&group.points, self.language))),
                    (w.epochs_translation(), list(&group.translation, 1.0, d, &self.unit)),
                    (w.epochs_rotation(), list(&group.rotation, 1e3, 3, "mrad")),
                    (w.epochs_scale_change(), list(&group.scale, 1e6, 1, "ppm")),
                    (w.epochs_strain(), list(&group.strain, 1e6, 1, "ppm")),
                    (w.epochs_test(), test),
                    (w.epochs_fit(), fit),
                    (w.epochs_state(), group.state.map(|s| state(s, self.language).to_owned())),
                ];
                let lines = lines.into_iter().filter_map(|(name, value)| Some((name.to_owned(), value?)));
                html.pairs(&lines.collect::<Vec<_>>());
            }
        }
    }

    fn series(&self, html: &mut Html) {
        let (w, unit) = (self.w, self.unit.as_str());
        if self.found.epochs.len() < 3 {
            return;
        }
        html.p(&match self.found.series_datum.as_slice() {
            [] => w.epochs_series_no_datum().to_owned(),
            names => w.epochs_series_datum(&listed(names, self.language)),
        });
        let sigmas = self.found.series.iter().flat_map(|s| &s.values).flat_map(|v| v.sigma).filter(|s| *s > 0.0);
        let smallest = sigmas.fold(f64::INFINITY, f64::min);
        let d = if smallest.is_finite() { decimals_for(smallest) } else { 3 };
        let mut table = Table::new().dense().words("");
        for k in 1..self.found.epochs.len() {
            table = table.low("|d|", &k.to_string(), unit);
        }
        table = table
            .low(w.epochs_velocity(), "", &format!("{unit}/{}", w.epochs_month()))
            .number("σ")
            .number("T")
            .number("p")
            .words("");
        for series in &self.found.series {
            let mut cells = vec![series.id.clone()];
            for epoch in &self.found.epochs[1..] {
                let value = series.values.iter().find(|v| v.epoch == epoch.name);
                cells.push(maybe(value.map(|v| v.difference.iter().map(|x| x * x).sum::<f64>().sqrt()), d));
            }
            let speed = speed(series);
            let sigma = speed.and_then(|(_, s)| s);
            let digits = sigma.filter(|s| *s > 0.0).map_or(3, decimals_for);
            cells.extend([maybe(speed.map(|(v, _)| v), digits), maybe(sigma, digits)]);
            cells.push(maybe(series.velocity_test.map(|t| t.statistic), 1));
            cells.push(series.velocity_test.map_or("–".to_owned(), |t| probability(t.p)));
            cells.push(series.state.map_or("", |s| state(s, self.language)).to_owned());
            let class =
                if matches!(series.state, Some(ThresholdState::Warning | ThresholdState::Alarm)) { "bad" } else { "" };
            table.row_of(class, cells);
        }
        html.table(table).note(w.epochs_series_means());
    }

    fn settings(&self, html: &mut Html) {
        let (w, o) = (self.w, self.options);
        let percent = |share: f64| format!("{} %", maybe(Some((1e6 * share).round() / 1e4), 1));
        let correction = match o.correction {
            Correction::Holm => "Holm",
            Correction::Bonferroni => "Bonferroni",
            Correction::None => w.epochs_none(),
        };
        let mut pairs = vec![
            (w.epochs_significance().to_owned(), percent(o.significance)),
            (w.epochs_power().to_owned(), percent(o.power)),
            (w.epochs_correction().to_owned(), correction.to_owned()),
        ];
        if let Some(t) = &o.thresholds {
            let unit = &self.unit;
            let told = format!("{} {unit}, {} {} {unit}", t.all.warning, w.epochs_state_alarm(), t.all.alarm);
            pairs.push((w.epochs_state_warning().to_owned(), told));
        }
        if !o.ignored.is_empty() {
            pairs.push((w.epochs_ignored().to_owned(), o.ignored.join(", ")));
        }
        pairs.push(("Sightline".to_owned(), env!("CARGO_PKG_VERSION").to_owned()));
        html.pairs(&pairs);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sightline::monitoring::{Limits, Thresholds, compare_epochs};
    use sightline_lab::sample::epochs::epochs;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn the_sample_is_reported_in_both_languages() {
        let thresholds = Some(Thresholds {
            all: Limits { warning: 1.0, alarm: 2.0 },
            points: Default::default(),
            groups: Default::default(),
        });
        let options = Options { thresholds, ..Options::default() };
        let found = compare_epochs(&epochs(&mut |_, _| true).expect("epochs"), &options).expect("a comparison");
        let said = |language| {
            let settings = ReportSettings { language: Some(language), ..ReportSettings::default() };
            report(&found, &options, &settings)
        };
        let english = said(ReportLanguage::English).html();
        for wanted in ["R5 is not stable", "epochs-series", "epochs-stable", "D23", "2026-09-12", "@page"] {
            assert!(english.contains(wanted), "{wanted}");
        }
        assert_eq!(english.matches("<section").count(), 7, "no groups were asked for");
        let korean = said(ReportLanguage::Korean).html();
        assert!(korean.contains("대상점 24점") && korean.contains("lang=\"ko\"") && !korean.contains("not stable"));
        assert!(!english.contains("NaN") && !korean.contains("NaN"));
    }

    #[test]
    fn points_that_were_left_out_are_told_by_their_reasons() {
        let one = |id: &str, reason| LeftOutPoint { id: id.into(), reason };
        let only = || LeftOutPointReason::OnlyIn { epoch: "b".into() };
        let ambiguous = |c: &str| LeftOutPointReason::Ambiguous { epoch: "b".into(), candidates: vec![c.into()] };
        let all = [
            one("1", only()),
            one("2", only()),
            one("u1", ambiguous("u7")),
            one("u2", ambiguous("u8")),
            one("h", LeftOutPointReason::Held),
        ];
        for language in [ReportLanguage::English, ReportLanguage::Korean] {
            let told = left_out(&all, language);
            assert_eq!(told.len(), 3, "{told:?}");
            assert!(told[0].contains("1, 2") && told[1].contains("u1 (u7), u2 (u8)"), "{told:?}");
        }
    }
}
