//! Displacements as tables: object points, reference points, groups, and items that were not used.

use leptos::prelude::*;
use sightline::axes::ShownAxes;
use sightline::monitoring::{Displacement, GroupModel, Pair, PointRole, Tested};
use sightline_report::epochs::decimals;

use super::unit;
use super::words::{group_error_words, left_out_words, p_words, state_words};
use crate::format;
use crate::i18n::{monitoring as words, name_list, text};
use crate::store::Desk;
use crate::view::components::table::{Cell, Column, CopyButton, NumberTable, Row, Sorting};

fn columns(unit: &str, axes: ShownAxes) -> Vec<Column> {
    let difference = |axis| Column::axis(|| "d", axis).unit(unit.to_owned());
    let [a, b, c] = axes.names();
    let length = |name: fn() -> &'static str| Column::number(name).unit(unit.to_owned());
    vec![
        Column::words(text::id),
        difference(a),
        difference(b),
        difference(c),
        length(words::length),
        length(|| "σ"),
        Column::number(|| "T"),
        Column::number(|| "p"),
        length(words::detectable),
        Column::words(words::judgement),
    ]
}

fn row(axes: ShownAxes, point: &Displacement, decimals: usize, judgement: &'static str, class: &'static str) -> Row {
    let mut cells = vec![Cell::id(&point.id)];
    if let Some(later) = &point.later_id {
        cells[0] = Cell::words(format!("{} ({})", point.id, words::later_name(later))).class("left id");
    }
    cells.extend(axes.shown(point.difference).map(|d| Cell::number(Some(d), decimals)));
    cells.push(Cell::number(Some(point.length), decimals).class("strong"));
    cells.push(Cell::number(point.length_sigma, decimals));
    cells.push(Cell::number(point.test.map(|t| t.statistic), 1));
    let mut p = Cell::words(point.test.map_or("–".to_owned(), |t| p_words(t.p))).class("");
    p.order = point.test.map(|t| t.p);
    cells.push(p);
    cells.push(Cell::number(point.detectable.map(|d| d.worst), decimals));
    cells.push(Cell::words(judgement).class(class));
    Row { key: point.id.clone(), cells, off: false }
}

/// Rows of the points of a kind.
fn rows_of(axes: ShownAxes, pair: &Pair, reference: bool) -> Vec<Row> {
    let decimals = decimals(pair);
    let of_kind = |p: &&Displacement| {
        let was_reference =
            p.role == PointRole::Reference || pair.unstable.contains(&p.id) || pair.stable.contains(&p.id);
        was_reference == reference
    };
    let one = |p: &Displacement| {
        let (judgement, class) = match (p.role, pair.unstable.contains(&p.id)) {
            (PointRole::Reference, _) => (words::in_datum(), "left"),
            (PointRole::Object, true) => (words::out_of_datum(), "left bad"),
            (PointRole::Object, false) if p.test.is_none() => (words::not_tested(), "left"),
            (PointRole::Object, false) if p.moved => (words::moved(), "left warn"),
            (PointRole::Object, false) => (words::stable(), "left"),
        };
        row(axes, p, decimals, judgement, class)
    };
    pair.points.iter().filter(of_kind).map(one).collect()
}

#[component]
fn Displaced(reference: bool, title: fn() -> &'static str) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let monitored = desk.monitoring;
    let sorting = RwSignal::new((!reference).then_some(Sorting { column: 6, descending: true }));
    // The unit stands once in the heading; what is copied has it in every column.
    let unit = Signal::derive(move || monitored.current().map(|ran| unit(&ran)).unwrap_or_default());
    let axes = move || ShownAxes::of(monitored.current().and_then(|ran| ran.found.axes));
    let bare = Signal::derive(move || columns("", axes()));
    let columns = Signal::derive(move || columns(&unit.get(), axes()));
    let rows =
        Memo::new(move |_| monitored.pair().map(|(_, pair)| rows_of(axes(), &pair, reference)).unwrap_or_default());
    let chosen = Signal::derive(move || monitored.point.get());
    let on_choose = Callback::new(move |id: String| monitored.point.set(Some(id)));
    let any = Memo::new(move |_| rows.with(|rows| !rows.is_empty()));
    let height = move || format!("calc({} * var(--row))", rows.with(Vec::len).min(16) + 1);
    view! {
        <Show when=move || any.get()>
            <h2 class="section-head"><span>{title} " " <span class="id">{move || format::count(rows.with(Vec::len))}</span></span>
                <span class="aside">{unit}</span><CopyButton columns rows/></h2>
            <div class="displaced-table" class:reference=reference style:height=height>
                <NumberTable label=title columns=bare rows chosen on_choose sorting/>
            </div>
        </Show>
    }
}

#[component]
pub fn ObjectPoints() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let power = move || desk.monitoring.options.with(|o| format::editable((1e6 * o.power).round() / 1e4));
    view! {
        <Displaced reference=false title=words::object_points/>
        <p class="hint">{move || words::detectable_means(power())}</p>
    }
}

#[component]
pub fn ReferencePoints() -> impl IntoView {
    view! { <Displaced reference=true title=words::reference_points/> }
}

/// How groups moved.
#[component]
pub fn Groups() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let monitored = desk.monitoring;
    move || {
        let (ran, (_, pair)) = monitored.current().zip(monitored.pair())?;
        if pair.groups.is_empty() {
            return None;
        }
        let unit = unit(&ran);
        let decimals = decimals(&pair);
        let list = |tested: &Option<Tested>, factor: f64, decimals: usize, unit: &str| {
            let tested = tested.as_ref()?;
            let one = |(v, s): (&f64, &f64)| {
                format!("{} ± {}", format::fixed(v * factor, decimals), format::fixed(s * factor, decimals))
            };
            let values = tested.value.iter().zip(&tested.sigma).map(one).collect::<Vec<_>>().join(";  ");
            Some(format!("{values} {unit}"))
        };
        let groups = pair.groups.iter().map(|group| {
            let line = |name: &'static str, value: Option<String>| value.map(|value| view! { <dt>{name}</dt><dd>{value}</dd> });
            let test = group.test.as_ref().map(|t| {
                let judged = if t.passed { words::stable() } else { words::moved() };
                format!("T {}, {} {}, p {}: {judged}", format::fixed(t.statistic, 2), words::limit(), format::fixed(t.limit, 2), p_words(t.p))
            });
            let fit = group.fit.as_ref().map(|t| if t.passed { words::fit_yes() } else { words::fit_no() }.to_owned());
            let model = match group.model {
                GroupModel::Rigid => words::rigid(),
                GroupModel::Similarity => words::similarity(),
                GroupModel::Affine => words::affine(),
            };
            let missing = (!group.missing.is_empty()).then(|| words::group_missing(name_list(&group.missing)));
            view! {
                <div class="group-found" data-group=group.name.clone()>
                    <h3>{group.name.clone()} " " <small>{model} ", " {words::points} " " {group.points.len()}</small></h3>
                    {group.error.as_ref().map(|error| view! { <p class="bad">{group_error_words(error)}</p> })}
                    {missing.map(|words| view! { <p class="warn">{words}</p> })}
                    <dl class="pairs">
                        {line(words::translation(), list(&group.translation, 1.0, decimals, &unit))}
                        {line(words::rotation(), list(&group.rotation, 1e3, 3, "mrad"))}
                        {line(words::scale_change(), list(&group.scale, 1e6, 1, "ppm"))}
                        {line(words::strain(), list(&group.strain, 1e6, 1, "ppm"))}
                        {line(words::test(), test)}
                        {line(words::fit(), fit)}
                        {line(words::state(), group.state.map(|s| state_words(s).to_owned()))}
                    </dl>
                </div>
            }
        });
        let groups = groups.collect_view();
        Some(view! { <h2 class="section-head"><span>{words::groups}</span></h2>{groups} })
    }
}

/// Points that were not used, by their reason.
#[component]
pub fn LeftOutPoints() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let monitored = desk.monitoring;
    move || {
        let (_, pair) = monitored.pair()?;
        let all = left_out_words(&pair.left_out).into_iter().map(|words| view! { <li>{words}</li> }).collect_view();
        (!pair.left_out.is_empty()).then(|| view! {
            <h2 class="section-head"><span>{words::left_out} " " <span class="id">{format::count(pair.left_out.len())}</span></span></h2>
            <ul class="pair-notes" data-found="left-out">{all}</ul>
        })
    }
}
