//! The features panel: what is measured, with its standard errors; new ones from what is chosen; coordinate systems; lines.

use leptos::prelude::*;
use sightline::adjustment::{FeatureResidual, MeasuredFeature, Quantity};
use sightline::project::FeatureKind;
use sightline_report::plots::deviations_name;

use super::Chosen;
use super::systems::Systems;
use crate::browser::event;
use crate::document::keys::Kind;
use crate::edit::features::named;
use crate::format;
use crate::i18n::{Text, errors, object as words, text};
use crate::store::Desk;
use crate::view::components::drawing::Drawing;
use crate::view::components::icon::{Glyph, Icon};
use crate::view::components::table::{Cell, Column, CopyButton, NumberTable, Row, Sorting};
use crate::view::components::units::length_unit;

const KINDS: [(&str, Text); 8] = [
    ("distance", words::kind_distance),
    ("angle", words::kind_angle),
    ("line", words::kind_line),
    ("plane", words::kind_plane),
    ("circle", words::kind_circle),
    ("sphere", words::kind_sphere),
    ("cylinder", words::kind_cylinder),
    ("deviations", words::kind_deviations),
];

const SYSTEMS: [(&str, Text); 3] = [
    ("automatic", words::system_automatic),
    ("plane_line_point", words::system_plane_line_point),
    ("best_fit", words::system_best_fit),
];

fn word_of(kind: &str) -> &'static str {
    KINDS.iter().find(|(name, _)| *name == kind).map_or("", |(_, word)| word())
}

#[component]
pub fn Features() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let chosen = expect_context::<Chosen>();
    let count = move || desk.document.with(|d| d.project.features.len());
    let stale = Memo::new(move |_| desk.document.with(|d| d.features_out_of_date()));
    // What was measured on an earlier state is measured again as soon as it is examined.
    Effect::new(move |_| {
        if stale.get() {
            desk.measure_features();
        }
    });
    let make = move |kind: &'static str| {
        let (points, picked) = (chosen.points.get_untracked(), chosen.features.get_untracked());
        if let Some(id) = desk.make_feature(kind, &points, &picked) {
            chosen.features.set(vec![id]);
        }
    };
    let lay = move |kind: &'static str| {
        desk.make_system(kind, &chosen.points.get_untracked(), &chosen.features.get_untracked());
    };
    let typed = move |typed: String| {
        let (found, unknown) = desk.document.with_untracked(|d| named(&d.project, &typed));
        if !unknown.is_empty() {
            let list = unknown.join(", ");
            desk.warn_here(move || words::unknown_points(&list));
        }
        let marked = found.iter().cloned().collect();
        if let [only] = &found[..] {
            desk.select_point(only);
        }
        chosen.points.set(found);
        desk.selection.update(|s| s.mark_all(Kind::Points, marked));
    };
    view! {
        <section class="measured" aria-label=words::features>
            <h2 class="section-head">
                <span>{words::features} " " <span class="id">{count}</span></span>
                <span class="aside">
                    {move || stale.get().then(|| view! { <span class="warn"><Glyph icon=Icon::Clock size=12/> " " {text::out_of_date}</span> " " })}
                    "± 1σ "
                    {[("dxf", "DXF"), ("ply", "PLY"), ("gltf", "glTF")].map(|(format, name)| view! {
                        <button class="link" data-export=format on:click=move |_| desk.export(format)>{name}</button>
                    }).collect_view()}
                </span>
            </h2>
            <FeatureList/>
            <div class="make">
                <label class="chosen-points">
                    <span>{words::chosen_points}</span>
                    <input type="text" name="chosen-points" placeholder=words::chosen_points_hint
                        prop:value=move || chosen.points.with(|all| shortened(all))
                        on:change=move |e| typed(event::value(&e))/>
                </label>
                <div class="row" role="group" aria-label=words::new_feature>
                    <span>{words::new_feature}</span>
                    {KINDS.map(|(kind, word)| view! { <button class="link" data-make=kind on:click=move |_| make(kind)>{word}</button> }).collect_view()}
                </div>
                <div class="row" role="group" aria-label=words::new_system>
                    <span>{words::new_system}</span>
                    {SYSTEMS.map(|(kind, word)| view! { <button class="link" data-lay=kind on:click=move |_| lay(kind)>{word}</button> }).collect_view()}
                </div>
                <Lines/>
            </div>
            <Detail/>
            <Systems/>
        </section>
    }
}

/// Names of points with commas, ranges not folded: what is typed back means the same.
fn shortened(points: &[String]) -> String {
    points.join(", ")
}

/// A feature as a line of the list.
#[derive(Clone, PartialEq)]
struct Line {
    id: String,
    kind: &'static str,
    of: String,
    measured: Option<MeasuredFeature>,
}

fn lines(desk: Desk) -> Vec<Line> {
    desk.document.with(|d| {
        let fresh = !d.features_out_of_date();
        let measured = |id: &str| {
            let all = &d.current()?.adjustment.features;
            all.iter().find(|f| f.id == id).cloned()
        };
        let line = |f: &sightline::project::Feature| Line {
            id: f.id.clone(),
            kind: f.kind.name(),
            of: made_of(&f.kind),
            measured: measured(&f.id).filter(|_| fresh),
        };
        d.project.features.iter().map(line).collect()
    })
}

fn made_of(kind: &FeatureKind) -> String {
    use sightline::project::End;
    let end = |end: &End| match end {
        End::Point(id) | End::Feature(id) => id.clone(),
    };
    match kind {
        FeatureKind::Distance { from, to } => format!("{} – {}", end(from), end(to)),
        FeatureKind::Angle { from, at: Some(at), to } => format!("{} – {} – {}", end(from), end(at), end(to)),
        FeatureKind::Angle { from, at: None, to } => format!("{} – {}", end(from), end(to)),
        FeatureKind::Deviations { feature: Some(feature), .. } => words::from_feature(feature),
        FeatureKind::Deviations { given, .. } => words::n_points(given.len()),
        other => words::n_points(other.points().len()),
    }
}

/// The one figure of a feature: what it is, value, sigma, unit.
fn figure(f: &MeasuredFeature, unit: &str) -> (&'static str, String, String, String) {
    let degrees = f.quantity == Some(Quantity::Angle);
    let scale = |x: f64| if degrees { x.to_degrees() } else { x };
    match (f.quantity, f.value) {
        (Some(quantity), Some(value)) => {
            let sigma = f.sigma.map(scale);
            let decimals = sigma.filter(|s| *s > 0.0).map_or(3, format::decimals_for);
            let word = match quantity {
                Quantity::Distance => words::quantity_distance(),
                Quantity::Angle => words::quantity_angle(),
                Quantity::Diameter => words::quantity_diameter(),
            };
            let sigma = sigma.map(|s| format!("± {}", format::fixed(s, decimals))).unwrap_or_default();
            (word, format::fixed(scale(value), decimals), sigma, if degrees { "°".into() } else { unit.to_owned() })
        }
        _ => {
            let decimals = f.rms.map_or(3, |r| format::decimals_for(r).max(3));
            (words::quantity_rms(), format::maybe(f.rms, decimals), String::new(), unit.to_owned())
        }
    }
}

#[component]
fn FeatureList() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let chosen = expect_context::<Chosen>();
    let all = Memo::new(move |_| lines(desk));
    let unit = Memo::new(move |_| desk.document.with(length_unit));
    let pick = move |id: String, more: bool| {
        chosen.features.update(|all| {
            let place = all.iter().position(|f| *f == id);
            match (more, place) {
                (true, Some(place)) => {
                    all.remove(place);
                }
                (true, None) => all.push(id.clone()),
                (false, Some(_)) if all.len() == 1 => all.clear(),
                (false, _) => *all = vec![id.clone()],
            }
        });
    };
    view! {
        <Show when=move || !all.with(Vec::is_empty) fallback=|| view! { <p class="hint">{words::no_features}</p> }>
            <ul class="feature-list">
                {move || all.get().into_iter().map(|line| {
                    let id = line.id.clone();
                    let is = {
                        let id = id.clone();
                        move || chosen.features.with(|all| all.contains(&id))
                    };
                    let pressed = is.clone();
                    let key = id.clone();
                    let fault = line.measured.as_ref().and_then(|m| m.error.clone());
                    let figures = line.measured.as_ref().filter(|m| m.error.is_none()).map(|m| figure(m, &unit.get()));
                    let missing = line.measured.as_ref().map(|m| m.missing.join(", ")).filter(|m| !m.is_empty());
                    let misfit = line.measured.as_ref().and_then(|m| Some((m.misfit?, m.rms?))).map(|(share, rms)| {
                        let rms = format!("{} {}", format::compact(rms), unit.get());
                        words::hardly_forms(word_of(line.kind), rms.trim(), format::fixed(100.0 * share, 0))
                    });
                    let weak = line.measured.as_ref().and_then(|m| m.weak).map(|w| format::fixed(100.0 * w, 0));
                    view! {
                        <li class:chosen=is>
                            <button class="feature" data-feature=key aria-pressed=move || pressed().to_string()
                                on:click=move |e| pick(id.clone(), e.shift_key() || e.ctrl_key() || e.meta_key())>
                                <b class="letter">{line.id.clone()}</b>
                                <span class="what">{word_of(line.kind)}<small>{line.of.clone()}</small></span>
                                {match (figures, fault) {
                                    (Some((word, value, sigma, unit)), _) => view! {
                                        <span class="quantity">{word}</span><b class="value">{value}</b>
                                        <span class="sigma">{sigma}</span><span class="unit">{unit}</span>
                                    }.into_any(),
                                    (None, Some(error)) => view! { <span class="fault">{errors::sentence(&error)}</span> }.into_any(),
                                    (None, None) => view! { <span class="quantity">{text::out_of_date}</span> }.into_any(),
                                }}
                                {misfit.map(|said| view! { <small class="warn missing" data-misfit="true">{said}</small> })}
                                {weak.map(|percent| view! { <small class="warn missing">{words::weakly_determined(percent)}</small> })}
                                {missing.map(|names| view! { <small class="warn missing">{words::missing_points(names)}</small> })}
                            </button>
                        </li>
                    }
                }).collect_view()}
            </ul>
        </Show>
    }
}

/// Deviations of the points of a feature.
fn residual_rows(feature: &MeasuredFeature) -> Vec<Row> {
    let decimals = feature.rms.map_or(3, |r| format::decimals_for(r).max(3));
    let row = |r: &FeatureResidual| Row {
        key: r.point.clone(),
        cells: vec![Cell::id(&r.point), Cell::number(Some(r.value), decimals), Cell::number(r.sigma, decimals)],
        off: false,
    };
    feature.residuals.iter().map(row).collect()
}

/// Coordinates of a feature, and their standard errors.
fn position(feature: &MeasuredFeature) -> Option<(String, String)> {
    let sigma = feature.sigma_position?;
    let decimals = format::decimals_for(sigma.into_iter().fold(f64::INFINITY, f64::min));
    let row = |all: [f64; 3]| all.map(|x| format::fixed(x, decimals)).join("\u{2003}");
    Some((row(feature.position?), row(sigma)))
}

/// Direction of a feature with its standard error.
fn direction(feature: &MeasuredFeature) -> Option<String> {
    let sigma = feature.sigma_direction.map(|s| format!(" ± {}°", format::compact(s.to_degrees()))).unwrap_or_default();
    Some(format!("{}{sigma}", feature.direction?.map(|x| format::fixed(x, 6)).join("\u{2003}")))
}

/// RMS and range of the deviations.
fn range(feature: &MeasuredFeature) -> Option<String> {
    let ([low, high], rms) = (feature.range?, feature.rms?);
    let decimals = format::decimals_for(rms).max(3);
    Some(words::range(format::fixed(rms, decimals), format::fixed(low, decimals), format::fixed(high, decimals)))
}

/// The feature chosen last: its name, its position and direction, the residuals of its points.
#[component]
fn Detail() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let chosen = expect_context::<Chosen>();
    let feature = Memo::new(move |_| {
        let id = chosen.features.with(|all| all.last().cloned())?;
        lines(desk).into_iter().find(|line| line.id == id)
    });
    let measured = Memo::new(move |_| feature.get().and_then(|line| line.measured));
    let unit = Memo::new(move |_| desk.document.with(length_unit));
    let sorting = RwSignal::new(None::<Sorting>);
    let columns = Signal::derive(move || {
        vec![
            Column::words(text::id),
            Column::number(words::deviation).unit(unit.get()),
            Column::number(|| "σ").unit(unit.get()),
        ]
    });
    let rows = Memo::new(move |_| measured.with(|m| m.as_ref().map(residual_rows).unwrap_or_default()));
    let point = Signal::derive(move || desk.selection.with(|s| s.point.clone()));
    let on_choose = Callback::new(move |id: String| desk.select_point(&id));
    let deviates = Memo::new(move |_| rows.with(|rows| rows.len() >= 3));
    Effect::new(move || {
        if deviates.get() {
            desk.make_plots();
        }
    });
    let plot = Memo::new(move |_| {
        let name = feature.with(|f| f.as_ref().map(|line| deviations_name(&line.id)))?;
        desk.reports.plots.with(|all| all.iter().find(|plot| plot.name == name).cloned())
    });
    view! {
        {move || feature.with(|f| f.as_ref().map(|line| line.id.clone())).map(|id| {
            let (from, gone) = (id.clone(), id.clone());
            view! {
                <div class="detail">
                    <h2 class="section-head">
                        <span>
                            <input class="feature-name" type="text" aria-label=words::feature_name prop:value=id
                                on:change=move |e| {
                                    let to = event::value(&e);
                                    if desk.rename_feature(&from, &to) {
                                        chosen.features.set(vec![to.trim().to_owned()]);
                                    }
                                }/>
                        </span>
                        <span class="aside">
                            <CopyButton columns rows/>
                            <button class="link" data-action="remove-feature" on:click=move |_| {
                                chosen.features.set(Vec::new());
                                desk.remove_feature(&gone);
                            }>{words::remove}</button>
                        </span>
                    </h2>
                    <dl class="facts">
                        {move || measured.with(|m| m.as_ref().and_then(position)).map(|(p, sigma)| view! {
                            <dt>{words::position} " " <u>{unit}</u></dt><dd>{p}</dd><dt>"± 1σ"</dt><dd>{sigma}</dd>
                        })}
                        {move || measured.with(|m| m.as_ref().and_then(direction)).map(|d| view! { <dt>{words::direction}</dt><dd>{d}</dd> })}
                        {move || measured.with(|m| m.as_ref().and_then(range)).map(|r| view! { <dt>{words::form}  " " <u>{unit}</u></dt><dd>{r}</dd> })}
                    </dl>
                    {move || plot.get().map(|plot| view! { <div class="drawings"><Drawing plot/></div> })}
                    <Show when=move || !rows.with(Vec::is_empty)>
                        <NumberTable label=words::show_deviations columns rows chosen=point on_choose sorting/>
                    </Show>
                </div>
            }
        })}
    }
}

/// As colour fields have it.
fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn from_hex(text: &str) -> Option<[u8; 3]> {
    let n = u32::from_str_radix(text.strip_prefix('#').filter(|digits| digits.len() == 6)?, 16).ok()?;
    let [_, r, g, b] = n.to_be_bytes();
    Some([r, g, b])
}

/// Lines between the chosen points, in a layer.
#[component]
fn Lines() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let chosen = expect_context::<Chosen>();
    let layer = RwSignal::new(String::new());
    let count = move || desk.document.with(|d| d.project.lines.len());
    let layers = move || {
        desk.document.with(|d| {
            let of = |id: &str| d.project.lines.iter().filter(|l| l.layer == id).count();
            d.project.layers.iter().map(|l| (l.id.clone(), l.colour, of(&l.id))).collect::<Vec<_>>()
        })
    };
    let join = move || desk.join_points(&chosen.points.get_untracked(), layer.get_untracked().trim());
    view! {
        <div class="row" role="group" aria-label=words::lines>
            <span>{words::lines} " " <span class="id">{count}</span></span>
            <button class="link" data-action="join" on:click=move |_| join()>{words::join}</button>
            <button class="link" data-action="part" on:click=move |_| desk.part_points(&chosen.points.get_untracked())>{words::part}</button>
            {move || layers().into_iter().map(|(id, colour, count)| {
                let (key, label, name) = (id.clone(), id.clone(), id.clone());
                view! {
                    <label class="layer-colour">
                        <input type="color" data-layer=key aria-label=move || words::layer_colour(&label) prop:value=hex(colour)
                            on:change=move |e| {
                                if let Some(colour) = from_hex(&event::value(&e)) {
                                    desk.recolour_layer(&id, colour);
                                }
                            }/>
                        " " {name} " " <span class="id">{count}</span>
                    </label>
                }
            }).collect_view()}
            <label class="layer-name"><span>{words::layer}</span> <input class="layer" type="text" prop:value=layer on:change=move |e| layer.set(event::value(&e))/></label>
        </div>
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_read_as_they_are_written() {
        assert_eq!(hex([0, 110, 200]), "#006ec8");
        assert_eq!(from_hex("#006ec8"), Some([0, 110, 200]));
        assert!(from_hex("red").is_none() && from_hex("#12345").is_none());
    }

    #[test]
    fn figures_have_the_digits_of_their_sigma() {
        let f = MeasuredFeature {
            quantity: Some(Quantity::Diameter),
            value: Some(323.91743),
            sigma: Some(0.0061),
            ..MeasuredFeature::default()
        };
        let (_, value, sigma, unit) = figure(&f, "mm");
        assert_eq!((value.as_str(), sigma.as_str(), unit.as_str()), ("323.9174", "± 0.0061", "mm"));
        let f = MeasuredFeature { quantity: Some(Quantity::Angle), value: Some(0.5), sigma: Some(1e-4), ..f };
        assert_eq!(figure(&f, "mm").3, "°");
        let form = MeasuredFeature { rms: Some(0.0194), ..MeasuredFeature::default() };
        assert_eq!(figure(&form, "m").1, "0.019");
    }
}
