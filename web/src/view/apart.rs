//! Lateral colour of a RAW: differences of red and blue from green over the radius.

use leptos::prelude::*;
use sightline::detection::{Colour, ColourApart, ColoursApart as Found};
use sightline::project::LensColour;

use crate::edit::cameras;
use crate::format;
use crate::i18n::text;
use crate::store::Desk;

const WIDTH: f64 = 320.0;
const HEIGHT: f64 = 170.0;
const LEFT: f64 = 44.0;
const RIGHT: f64 = 10.0;
const TOP: f64 = 18.0;
const BOTTOM: f64 = 24.0;

/// Offers the measurement for a photo of a sensor with filters, and shows what came of it.
#[component]
pub fn ColoursApart() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let photo = Memo::new(move |_| {
        let photo = desk.selection.with(|s| s.photo.clone())?;
        let filters = |letters: &String| letters.contains('G') && letters.contains(['R', 'B']);
        let offered = desk.document.with(|d| {
            let measured = d.detections.get(&photo)?.measured.as_ref()?;
            measured.pattern.as_ref().map(filters)
        });
        offered.unwrap_or(false).then_some(photo)
    });
    let known = move || photo.get().and_then(|photo| desk.apart_of(&photo));
    view! {
        <Show when=move || photo.with(Option::is_some)>
            <div class="apart" data-result="apart">
                <h2 class="section-head"><span>{text::colours_apart}</span></h2>
                {move || match known() {
                    None => view! {
                        <p class="note">{text::colours_apart_hint}</p>
                        <button class="button" data-action="colours-apart" on:click=move |_| {
                            if let Some(photo) = photo.get_untracked() {
                                desk.measure_apart(&photo);
                            }
                        }>{text::measure_colours}</button>
                    }.into_any(),
                    Some(apart) => match apart.found {
                        None => view! { <p class="note">{text::measuring_colours}</p> }.into_any(),
                        Some(found) => {
                            let sentences = found.colours.iter().map(sentence).collect::<Vec<_>>();
                            view! {
                                <ul class="note apart-words">
                                    {sentences.into_iter().map(|words| view! { <li>{words}</li> }).collect_view()}
                                </ul>
                                {plot(&found)}
                                {move || photo.get().map(|photo| view! { <Held photo/> })}
                            }.into_any()
                        }
                    },
                }}
            </div>
        </Show>
    }
}

/// Has the photo's camera hold what its photos measured so tell, and says whether it does.
#[component]
fn Held(photo: String) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let camera = Memo::new(move |_| {
        desk.document.with(|d| {
            let id = &d.project.photos.iter().find(|p| p.id == photo)?.camera;
            let told = cameras::measured_apart(&d.project, id).iter().any(|c| c.red.is_some() || c.blue.is_some());
            d.project.cameras.iter().find(|c| c.id == *id && told).map(|c| (id.clone(), !c.colours.is_empty()))
        })
    });
    move || {
        let (id, held) = camera.get()?;
        let (name, key) = (id.clone(), id.clone());
        Some(view! {
            <p class="note">{if held { text::colours_are_held(&name) } else { text::colours_hold_means(&name) }}</p>
            <button class="button" data-action="hold-colours" data-camera=key on:click=move |_| desk.hold_colours(&id)>
                {if held { text::hold_colours_again() } else { text::hold_colours() }}
            </button>
        })
    }
}

pub fn colour_name(colour: LensColour) -> &'static str {
    match colour {
        LensColour::Red => text::site_red(),
        LensColour::Blue => text::site_blue(),
    }
}

fn name(colour: Colour) -> &'static str {
    if colour == Colour::Red { text::site_red() } else { text::site_blue() }
}

fn sentence(apart: &ColourApart) -> String {
    match &apart.lateral {
        None => text::apart_too_few(name(apart.colour), format::count(apart.shifts.len())),
        Some(lateral) => text::apart_at_corner(
            name(apart.colour),
            format!("{}{}", if lateral.at_corner > 0.0 { "+" } else { "" }, format::fixed(lateral.at_corner, 2)),
            format::fixed(lateral.sigma_at_corner, 2),
            format::count(lateral.targets),
        ),
    }
}

/// Outward difference of each target over its radius, and the curve of each colour.
fn plot(found: &Found) -> impl IntoView + use<> {
    let [cu, cv] = found.centre;
    let corner = found.corner.max(1.0);
    let drawn = found.colours.iter().filter_map(|apart| Some((apart.colour, apart.lateral?, &apart.shifts)));
    let drawn: Vec<(Colour, _, Vec<[f64; 2]>)> = drawn
        .map(|(colour, lateral, shifts)| {
            let place = |shift: &sightline::detection::Shift| {
                let (x, y) = (shift.u - cu, shift.v - cv);
                let radius = x.hypot(y).max(1e-9);
                [radius, ((shift.du - lateral.shift_u) * x + (shift.dv - lateral.shift_v) * y) / radius]
            };
            (colour, lateral, shifts.iter().map(place).collect())
        })
        .collect();
    if drawn.is_empty() {
        return None;
    }
    let curve = |lateral: &sightline::detection::Lateral, radius: f64| {
        let share = radius / corner;
        lateral.linear * share + lateral.cubic * share.powi(3)
    };
    // what most targets and both curves need; single ones may lie outside
    let mut sizes: Vec<f64> = drawn.iter().flat_map(|(.., dots)| dots.iter().map(|dot| dot[1].abs())).collect();
    sizes.sort_by(f64::total_cmp);
    let most = sizes.get(sizes.len() * 98 / 100).copied().unwrap_or(0.0);
    let ends = drawn.iter().map(|(_, lateral, _)| curve(lateral, corner).abs());
    let limit = ends.fold(most.max(0.02), f64::max) * 1.1;
    let across = move |radius: f64| LEFT + radius / corner * (WIDTH - LEFT - RIGHT);
    let down = move |value: f64| TOP + (limit - value) / (2.0 * limit) * (HEIGHT - TOP - BOTTOM);
    let step = format::round_below(limit);
    let grid = [-step, 0.0, step].map(|value| {
        view! {
            <line class=if value == 0.0 { "reference" } else { "grid" } x1=LEFT x2=WIDTH - RIGHT y1=down(value) y2=down(value)></line>
            <text class="axis" x=LEFT - 6.0 y=down(value) + 4.0 text-anchor="end">{format::round(value)}</text>
        }
    });
    let lines = drawn
        .into_iter()
        .map(|(colour, lateral, dots)| {
            let class = if colour == Colour::Red { "apart-red" } else { "apart-blue" };
            let path = (0..=40)
                .map(|k| {
                    let radius = corner * f64::from(k) / 40.0;
                    let letter = if k == 0 { 'M' } else { 'L' };
                    format!("{letter}{:.1} {:.1}", across(radius), down(curve(&lateral, radius)))
                })
                .collect::<String>();
            let inside = dots.into_iter().filter(|dot| dot[1].abs() <= limit);
            let dots = inside
                .map(|[radius, value]| {
                    let (x, y) = (across(radius), down(value));
                    // a shape for each, for those who see no difference of colour
                    if colour == Colour::Red {
                        view! { <circle cx=x cy=y r="1.8"></circle> }.into_any()
                    } else {
                        view! { <path class="square" d=format!("M{:.1} {:.1}h3.2v3.2h-3.2z", x - 1.6, y - 1.6)></path> }
                            .into_any()
                    }
                })
                .collect_view();
            view! { <g class=class>{dots}<path class="curve" d=path></path></g> }
        })
        .collect_view();
    Some(view! {
        <svg class="plot" viewBox=format!("0 0 {WIDTH} {HEIGHT}") role="img" aria-label=text::colours_apart>
            {grid.collect_view()}
            <text class="axis" x="0" y="11">{text::apart_outwards}</text>
            <text class="axis" x=WIDTH - RIGHT y=HEIGHT - 6.0 text-anchor="end">{text::apart_radius(format::count(corner.round() as usize))}</text>
            {lines}
        </svg>
    })
}
