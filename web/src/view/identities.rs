//! Step 3: point names, by codes, by earlier measurements, by clicks or by geometry.

use std::collections::HashMap;

use leptos::prelude::*;
use sightline::matching::{Doubt, UnsnappedReason};
use sightline::project::{Observation, Role};

use super::components::field::Field;
use super::components::icon::{Glyph, Icon};
use super::components::table::{Cell, Column, CopyButton, NumberTable, Row, Sorting};
use super::grids::GridPanel;
use super::insets::Insets;
use super::loupe::Loupe;
use super::marking::MarkingBar;
use super::photo_view::{Click, Mark, PhotoView, Style};
use super::picking::{Question, chosen_target, pick, spot_mark};
use super::questions::{QuestionBar, QuestionList};
use super::strip::Strip;
use crate::browser::{event, file};
use crate::format;
use crate::i18n::{first, grids, text, text::role_word};
use crate::store::texts::ListKind;
use crate::store::{Desk, Kind, Step};
use crate::view::components::title::TitleBar;

#[component]
pub fn Identities() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sentence = move || {
        let (named, points, single) = desk.document.with(|d| {
            let mut rays = HashMap::<&str, usize>::new();
            for o in d.project.observations.iter().filter(|o| o.enabled) {
                *rays.entry(&o.point).or_default() += 1;
            }
            (d.project.observations.len(), rays.len(), rays.values().filter(|n| **n == 1).count())
        });
        text::identities_sentence(format::count(named), format::count(points), format::count(single))
    };
    let has_uncoded = Memo::new(move |_| {
        desk.document.with(|d| {
            !d.project.observations.is_empty()
                && d.detections.values().any(|d| d.targets.iter().any(|t| t.code.is_none()))
        })
    });
    let grid_open = RwSignal::new(false);
    let has_dots = Memo::new(move |_| {
        desk.document.with(|d| d.detections.values().any(|d| d.targets.iter().any(|t| t.code.is_none())))
    });
    view! {
        <TitleBar title=text::identities sentence=Signal::derive(sentence)>
            <button class="button" on:click=move |_| choose_marks(desk)>{text::open_marks}</button>
            <Show when=move || has_dots.get()>
                <button class="button" data-action="grid" title=grids::how aria-expanded=move || grid_open.get().to_string()
                    on:click=move |_| grid_open.update(|open| *open = !*open)>{grids::circle_grid}</button>
            </Show>
            <Show when=move || has_uncoded.get()>
                <button class="button" data-action="match" title=first::match_how disabled=move || desk.tasks.job.with(Option::is_some)
                    on:click=move |_| desk.match_uncoded()>{first::match_targets}</button>
            </Show>
            <button class="button primary" on:click=move |_| desk.go(Step::Control)>{text::control} <Glyph icon=Icon::Arrow/></button>
        </TitleBar>
        <main class="identities">
            <Strip/>
            <NamedPhoto/>
            <div class="columns" on:pointerdown=move |_| desk.ask_no_more()>
                <Show when=move || grid_open.get() && has_dots.get()><GridPanel/></Show>
                <NothingNamed/>
                <QuestionList/>
                <PointsTable/>
                <MarksPanel/>
                <PointPanel/>
                <Insets/>
            </div>
        </main>
    }
}

/// Next action if no point has a name yet.
#[component]
fn NothingNamed() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let state = Memo::new(move |_| {
        desk.document.with(|d| {
            let targets = d.detections.values().map(|detection| detection.targets.len()).sum::<usize>();
            d.project.observations.is_empty().then_some(targets)
        })
    });
    view! {
        {move || state.get().map(|targets| match targets {
            0 => view! {
                <div class="empty-state" data-empty="targets">
                    <p>{first::no_targets}</p>
                    <button class="button primary" on:click=move |_| desk.go(Step::Targets)>{text::targets} <Glyph icon=Icon::Arrow/></button>
                </div>
            }.into_any(),
            n => view! {
                <div class="empty-state" data-empty="codes">
                    <p>{move || first::no_codes(n)}</p>
                    <button class="button" on:click=move |_| if !desk.measuring.series.with_untracked(Option::is_some) { desk.switch_series() }>{text::point_by_point}</button>
                </div>
            }.into_any(),
        })}
    }
}

fn choose_marks(desk: Desk) {
    file::choose(".txt,.csv,.dat,text/plain", false, move |files| {
        if let Some(file) = files.into_iter().next() {
            desk.read_text(file, ListKind::Marks);
        }
    });
}

/// The photo with names, a question for the target that has none, and the loupe.
#[component]
pub fn NamedPhoto() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let marks = Signal::derive(move || named_marks(desk));
    let summary = Signal::derive(move || {
        let Some(photo) = desk.selection.with(|s| s.photo.clone()) else { return String::new() };
        let (named, targets) = desk.document.with(|d| {
            let named = d.project.observations.iter().filter(|o| o.photo == photo).count();
            (named, d.detections.get(&photo).map_or(0, |d| d.targets.len()))
        });
        text::named_of(format::count(named), format::count(targets))
    });
    let on_click = Callback::new(move |click: Click| pick(desk, click));
    let target = Signal::derive(move || {
        if let Some(t) = chosen_target(desk) {
            return Some([t.u, t.v, t.major, t.minor, t.angle]);
        }
        let at = desk.selection.with(|s| s.spot).or_else(|| desk.chosen_observation().map(|o| [o.u, o.v]));
        at.map(|[u, v]| [u, v, 0.0, 0.0, 0.0])
    });
    view! {
        <PhotoView marks strokes=Signal::derive(Vec::new) summary on_click over=view! {
            <Show when=move || target.with(Option::is_some)>
                <div class="docked-loupe"><Loupe target/></div>
            </Show>
        }.into_any()>
            <Question/>
            <MarkingBar/>
            <QuestionBar/>
        </PhotoView>
    }
}

/// Targets with the names they have; observations that lie on no target; doubtful places.
fn named_marks(desk: Desk) -> Vec<Mark> {
    let (photo, point, chosen) = desk.selection.with(|s| (s.photo.clone(), s.point.clone(), s.target));
    let Some(photo) = photo else { return Vec::new() };
    desk.document.with(|d| {
        let here = d.project.observations.iter().filter(|o| o.photo == photo);
        let (on_targets, free): (Vec<_>, Vec<_>) = here.partition(|o| o.target.is_some());
        let mut named: HashMap<Option<u32>, &Observation> = on_targets.into_iter().map(|o| (o.target, o)).collect();
        let doubtful = d.doubtful.iter().filter(|x| x.photo == photo).filter_map(|x| x.target).collect::<Vec<_>>();
        let style = |o: Option<&Observation>, target: Option<u32>, selected: bool, occluded: bool| match o {
            _ if selected => Style::Selected,
            Some(o) if Some(&o.point) == point.as_ref() => Style::Selected,
            Some(o) if !o.enabled => Style::Rejected,
            _ if target.is_some_and(|id| doubtful.contains(&id)) => Style::Doubtful,
            None if occluded => Style::Hidden,
            _ => Style::Measured,
        };
        let mut marks = Vec::new();
        for (i, t) in d.detections.get(&photo).iter().flat_map(|d| d.targets.iter().enumerate()) {
            let o = named.remove(&Some(t.id));
            marks.push(Mark {
                u: t.u,
                v: t.v,
                major: t.major,
                minor: t.minor,
                angle: t.angle,
                label: o.map(|o| o.point.clone()),
                strong: t.code.is_some(),
                style: style(o, Some(t.id), chosen == Some(i), t.occluded),
            });
        }
        for o in named.into_values().chain(free) {
            let style = style(Some(o), None, false, false);
            let label = Some(o.point.clone());
            marks.push(Mark { u: o.u, v: o.v, major: 0.0, minor: 0.0, angle: 0.0, label, strong: false, style });
        }
        marks.extend(spot_mark(desk));
        marks
    })
}

/// Why a point is in doubt, in a few words.
fn doubt_words(desk: Desk) -> HashMap<String, String> {
    let mut words = HashMap::new();
    desk.document.with(|d| {
        for doubtful in d.doubtful.iter() {
            let reason = match doubtful.reason {
                Doubt::DuplicateCode => text::doubt_duplicate(&doubtful.photo),
                Doubt::CodeFamily => text::doubt_code_family(&doubtful.photo),
                Doubt::CodeUnclear => text::doubt_code_unclear(&doubtful.photo),
                Doubt::Occluded => text::doubt_occluded(&doubtful.photo),
                Doubt::Ambiguous => text::doubt_ambiguous(&doubtful.photo),
                Doubt::Disagrees => text::doubt_disagrees(&doubtful.photo),
            };
            for point in &doubtful.points {
                words.entry(point.clone()).or_insert_with(|| reason.clone());
            }
        }
    });
    words
}

#[component]
fn PointsTable() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let sorting = RwSignal::new(None::<Sorting>);
    let columns = Signal::derive(move || {
        let unit = desk.document.with(|d| d.project.unit.clone());
        let [a, b, c] = desk.axes().names();
        vec![
            Column::words(text::id),
            Column::number(text::rays),
            Column::words(text::role),
            Column::axis(|| "", a).unit(unit.clone()),
            Column::axis(|| "", b).unit(unit.clone()),
            Column::axis(|| "", c).unit(unit),
            Column::words(text::doubt),
        ]
    });
    let rows = Memo::new(move |_| {
        let (doubts, axes) = (doubt_words(desk), desk.axes());
        let mut rows: Vec<Row> = desk.document.with(|d| {
            let mut rays = HashMap::<&str, (usize, usize)>::new();
            for o in &d.project.observations {
                let count = rays.entry(&o.point).or_default();
                count.0 += usize::from(o.enabled);
                count.1 += 1;
            }
            let adjusted: HashMap<&str, [f64; 3]> = d
                .current()
                .map(|r| r.adjustment.points.iter().map(|p| (p.id.as_str(), p.xyz)).collect())
                .unwrap_or_default();
            let row = |p: &sightline::project::Point| {
                let (n, all) = rays.get(p.id.as_str()).copied().unwrap_or_default();
                let xyz = adjusted.get(p.id.as_str()).copied().or(p.xyz);
                let doubt = match doubts.get(&p.id) {
                    Some(words) => words.clone(),
                    None if n == 1 && p.role == Role::Tie => text::one_ray().to_owned(),
                    None if n == 0 => text::no_ray().to_owned(),
                    None => String::new(),
                };
                let mut cells = vec![Cell::id(&p.id), Cell::count(n), Cell::words(role_word(p.role))];
                cells.extend(axes.order().map(|k| Cell::number(xyz.map(|x| x[k]), 3)));
                cells.push(Cell::words(doubt).class("left wide warn"));
                Row { key: p.id.clone(), cells, off: all > 0 && n == 0 }
            };
            d.project.points.iter().map(row).collect()
        });
        if sorting.get().is_none() {
            // Doubtful ones first.
            rows.sort_by_key(|row| row.cells.last().is_some_and(|c| c.shown().is_empty()));
        }
        rows
    });
    let chosen = Signal::derive(move || desk.selection.with(|s| s.point.clone()));
    view! {
        <section class="panel grow">
            <h2 class="section-head">
                <span>{text::points} " " <span class="id">{move || format::count(rows.with(Vec::len))}</span></span>
                <CopyButton columns rows/>
            </h2>
            <NumberTable label=text::points columns rows chosen on_choose=Callback::new(move |id: String| desk.select_point(&id)) sorting kind=Kind::Points/>
        </section>
    }
}

/// Marks of an earlier measurement: how many snap, which do not and why, and taking them.
#[component]
fn MarksPanel() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let snapped = Memo::new(move |_| desk.snapped());
    let reason = |r: &UnsnappedReason| match r {
        UnsnappedReason::NoDetection => text::unsnapped_no_detection().to_owned(),
        UnsnappedReason::NoTarget => text::unsnapped_no_target().to_owned(),
        UnsnappedReason::Contested { points } => text::unsnapped_contested(points.join(", ")),
        UnsnappedReason::MarkedTwice => text::unsnapped_twice().to_owned(),
    };
    view! {
        {move || snapped.get().map(|(marks, snapped)| {
            let (all, good) = (marks.marks.len(), snapped.observations.len());
            let unsnapped = snapped.unsnapped.clone();
            let some = !unsnapped.is_empty();
            view! {
                <section class="panel marks">
                    <h2 class="section-head">
                        <span>{text::marks} " " <span class="id">{marks.file.clone()}</span></span>
                        <button class="link" on:click=move |_| desk.intake.marks.set(None)>{text::discard}</button>
                        <button class="button small primary" disabled=good == 0 on:click=move |_| desk.take_marks(&snapped)>
                            {move || text::take_marks(format::count(good))}
                        </button>
                    </h2>
                    <div class="fields inline">
                        <label class="field">
                            <span>{text::snap_radius} " " <u>"px"</u></span>
                            <Field value=Signal::stored(format::editable(marks.radius)) commit=move |typed: String| {
                                if let Some(radius) = format::parse(&typed).filter(|r| *r > 0.0) {
                                    desk.intake.marks.update(|m| if let Some(m) = m { m.radius = radius });
                                }
                            } attr:inputmode="decimal"/>
                        </label>
                        <p class="hint">{move || text::snapped_sentence(format::count(good), format::count(all))}</p>
                    </div>
                    <Show when=move || some>
                        <div class="scroll short-list" tabindex="0" role="region" aria-label=text::why_not>
                            <table class="table">
                                <thead><tr><th class="left">{text::id}</th><th class="left">{text::photo}</th><th>"u " <u>"px"</u></th><th>"v " <u>"px"</u></th><th class="left wide">{text::why_not}</th></tr></thead>
                                <tbody>
                                    {unsnapped.iter().take(500).map(|u| view! {
                                        <tr>
                                            <td class="left id">{u.mark.point.clone()}</td>
                                            <td class="left">{u.mark.photo.clone()}</td>
                                            <td>{format::fixed(u.mark.u, 1)}</td>
                                            <td>{format::fixed(u.mark.v, 1)}</td>
                                            <td class="left wide warn">{reason(&u.reason)}</td>
                                        </tr>
                                    }).collect_view()}
                                </tbody>
                            </table>
                        </div>
                    </Show>
                </section>
            }
        })}
    }
}

/// The chosen point: its name and its observations, each to be excluded or taken away.
#[component]
pub fn PointPanel() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let point = Memo::new(move |_| desk.selection.with(|s| s.point.clone()));
    let observations = Memo::new(move |_| {
        let Some(point) = point.get() else { return Vec::new() };
        desk.document.with(|d| d.project.observations.iter().filter(|o| o.point == point).cloned().collect())
    });
    let count = Memo::new(move |_| observations.with(Vec::len));
    // The photo that is shown, where renaming there alone is another thing than renaming everywhere.
    let here = Memo::new(move |_| {
        let photo = desk.selection.with(|s| s.photo.clone())?;
        (count.get() > 1 && observations.with(|all| all.iter().any(|o| o.photo == photo))).then_some(photo)
    });
    let only_here = RwSignal::new(false);
    // Another point starts with the plain meaning.
    Effect::new(move |_| {
        point.track();
        only_here.set(false);
    });
    let scope = move || here.get().filter(|_| only_here.get());
    let rename = move |typed: String| {
        let Some(id) = point.get_untracked() else { return };
        match untrack(scope) {
            Some(photo) => desk.rename_in_photo(&photo, &id, &typed),
            None => desk.rename_point(&id, &typed),
        };
    };
    let says = move || match scope() {
        Some(photo) => text::rename_here_says(photo),
        None => text::rename_says(format::count(count.get())),
    };
    view! {
        <Show when=move || point.with(Option::is_some)>
            <section class="panel point">
                <h2 class="section-head">
                    <span>{text::point} " " <span class="id">{point}</span></span>
                    <button class="link bad" on:click=move |_| if let Some(id) = point.get_untracked() { desk.remove_point(&id) }>{text::remove_point}</button>
                </h2>
                <div class="fields inline">
                    <label class="field">
                        <span>{text::name}</span>
                        <Field value=Signal::derive(move || point.get().unwrap_or_default()) commit=move |typed: String| rename(typed) attr:name="point-name"/>
                    </label>
                    <Show when=move || here.with(Option::is_some)>
                        <label class="field">
                            <span>{text::rename_where}</span>
                            <select name="rename-where" on:change=move |e| only_here.set(event::value(&e) == "here")>
                                <option value="all" selected=move || !only_here.get()>{move || text::in_all_photos(format::count(count.get()))}</option>
                                <option value="here" selected=only_here>{move || text::in_this_photo(here.get().unwrap_or_default())}</option>
                            </select>
                        </label>
                    </Show>
                    <p class="hint whole">{says}</p>
                </div>
                <div class="scroll short-list">
                    <table class="table">
                        <thead><tr>
                            <th class="left">{text::photo}</th><th>"u " <u>"px"</u></th><th>"v " <u>"px"</u></th><th>"σ " <u>"px"</u></th>
                            <th class="left">{text::take_part_short}</th><td></td>
                        </tr></thead>
                        <tbody>
                            {move || observations.get().into_iter().map(|o| view! { <ObservationRow o/> }).collect_view()}
                        </tbody>
                    </table>
                </div>
            </section>
        </Show>
    }
}

#[component]
fn ObservationRow(o: Observation) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let [su, sv] = o.sigma.both();
    let (u, v) = (o.u, o.v);
    let enabled = o.enabled;
    let o = StoredValue::new(o);
    let chosen = move || desk.selection.with(|s| s.photo == o.with_value(|o| Some(o.photo.clone())));
    view! {
        <tr class:chosen=chosen class:off=!enabled>
            <td class="left id">
                <button class="link" on:click=move |_| o.with_value(|o| desk.select_observation(&o.photo, &o.point))>{o.with_value(|o| o.photo.clone())}</button>
            </td>
            <td>{format::fixed(u, 3)}</td>
            <td>{format::fixed(v, 3)}</td>
            <td>{format::fixed(su.hypot(sv) / 2f64.sqrt(), 3)}</td>
            <td class="left">
                <input type="checkbox" aria-label=text::take_part_short prop:checked=enabled
                    on:change=move |e| o.with_value(|o| desk.switch_observation(&o.photo, &o.point, event::checked(&e)))/>
            </td>
            <td>
                <button class="icon-button small" aria-label=text::remove_observation title=text::remove_observation
                    on:click=move |_| o.with_value(|o| desk.remove_observation(&o.photo, &o.point))>
                    <Glyph icon=Icon::Cross size=12/>
                </button>
            </td>
        </tr>
    }
}
