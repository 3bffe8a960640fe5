//! Lateral colour of a RAW: differences of red and blue from green over the radius.

use leptos::prelude::*;
use sightline::detection::{Colour, ColoursApart};

use crate::format;
use crate::i18n::text;
use crate::store::Desk;

/// Shares of the corner's radius that the table lists.
const SHARES: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

const WIDTH: f64 = 320.0;
const HEIGHT: f64 = 170.0;
const LEFT: f64 = 44.0;
const RIGHT: f64 = 10.0;
const TOP: f64 = 18.0;
const BOTTOM: f64 = 24.0;

/// Offers the measurement for a photo of a sensor with colour filters and shows the result.
#[component]
pub fn LateralColour() -> impl IntoView {
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
    let measured_in = move || {
        let photo = photo.get()?;
        desk.document.with(|d| d.detections.get(&photo)?.measured.as_ref()?.colour)
    };
    let known = move || photo.get().and_then(|photo| desk.colours_of(&photo));
    view! {
        <Show when=move || photo.with(Option::is_some)>
            <div class="lateral-colour" data-result="lateral-colour">
                <h2 class="section-head"><span>{text::colours_apart}</span></h2>
                {move || match known() {
                    None => view! {
                        <p class="note">{text::colours_apart_hint}</p>
                        <button class="button" data-action="measure-colours" on:click=move |_| {
                            if let Some(photo) = photo.get_untracked() {
                                desk.measure_colours(&photo);
                            }
                        }>{text::measure_colours}</button>
                    }.into_any(),
                    Some(measurement) => match measurement.found {
                        None => view! { <p class="note">{text::measuring_colours}</p> }.into_any(),
                        Some(found) => {
                            let advice = advice(&found, measured_in());
                            view! {
                                {shifts(&found)}
                                {advice.map(|words| view! { <p class="note lateral-colour-advice">{words}</p> })}
                                {plot(&found)}
                            }.into_any()
                        }
                    },
                }}
            </div>
        </Show>
    }
}

fn name(colour: Colour) -> &'static str {
    if colour == Colour::Red { text::site_red() } else { text::site_blue() }
}

/// Shift of each colour at four radii with its standard error, a row a colour.
fn shifts(found: &ColoursApart) -> impl IntoView + use<> {
    let radii = SHARES.map(|share| format::count((share * found.corner).round() as usize));
    let known = found.colours.iter().filter_map(|apart| Some((apart.colour, apart.lateral?)));
    let rows = known.map(|(colour, lateral)| {
        let cells = SHARES.map(|share| view! { <td>{with_sigma(lateral.at(share))}</td> });
        let key = if colour == Colour::Red { "red" } else { "blue" };
        view! {
            <tr data-colour=key>
                <th class="left">{name(colour)}</th>{cells.collect_view()}<td>{format::count(lateral.targets)}</td>
            </tr>
        }
    });
    let rows = rows.collect::<Vec<_>>();
    let few = found.colours.iter().filter(|apart| apart.lateral.is_none());
    let few = few.map(|apart| text::apart_too_few(name(apart.colour), format::count(apart.shifts.len())));
    view! {
        {(!rows.is_empty()).then(|| view! {
            <table class="table lateral-colour-shifts">
                <thead><tr>
                    <th class="left">{text::apart_radius_px}</th>
                    {radii.map(|radius| view! { <th>{radius}</th> }).collect_view()}
                    <th>{text::apart_targets}</th>
                </tr></thead>
                <tbody>{rows}</tbody>
            </table>
            <p class="note">{text::apart_shift_means}</p>
        })}
        {few.map(|words| view! { <p class="note">{words}</p> }).collect_view()}
    }
}

/// A shift in pixels with its sign, and its standard error.
fn with_sigma([shift, sigma]: [f64; 2]) -> String {
    let decimals = if sigma < 0.005 { 3 } else { 2 };
    let sign = if shift > 0.0 { "+" } else { "" };
    format!("{sign}{} ± {}", format::fixed(shift, decimals), format::fixed(sigma, decimals))
}

/// Recommendation: nothing if no shift is significant or green was measured, otherwise measure in green.
fn advice(found: &ColoursApart, measured: Option<Colour>) -> Option<&'static str> {
    let mut known = found.colours.iter().filter_map(|apart| apart.lateral).peekable();
    known.peek()?;
    Some(match (known.any(|lateral| lateral.significant), measured) {
        (false, _) => text::apart_negligible(),
        (true, Some(Colour::Green)) => text::apart_in_green(),
        (true, _) => text::apart_measure_green(),
    })
}

/// Outward difference of each target over its radius, and the curve of each colour.
fn plot(found: &ColoursApart) -> impl IntoView + use<> {
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
            let class = if colour == Colour::Red { "lateral-colour-red" } else { "lateral-colour-blue" };
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
                    // a shape for each, in addition to the colour
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::i18n::{Language, in_language};
    use sightline::detection::{ColourApart, Lateral};

    fn found(significant: bool) -> ColoursApart {
        let lateral = Lateral {
            shift_u: 0.0,
            shift_v: 0.0,
            linear: 0.8,
            cubic: -0.3,
            at_corner: 0.5,
            sigma_at_corner: 0.02,
            rms: 0.02,
            sigma0: 1.0,
            targets: 30,
            significant,
            covariance: [1e-4, 0.0, 0.0, 0.0, 1e-4, 0.0, 0.0, 2e-4, 0.0, 2e-4],
        };
        let red = ColourApart { colour: Colour::Red, shifts: Vec::new(), lateral: Some(lateral) };
        ColoursApart { centre: [500.0, 400.0], corner: 640.0, colours: vec![red] }
    }

    #[test]
    fn green_is_advised_where_another_channel_was_measured_and_the_shift_is_significant() {
        in_language(Language::English, || {
            let said = |significant, measured| advice(&found(significant), measured);
            assert_eq!(said(false, Some(Colour::Red)), Some(text::apart_negligible()));
            assert_eq!(said(true, Some(Colour::Green)), Some(text::apart_in_green()));
            assert_eq!(said(true, Some(Colour::Red)), Some(text::apart_measure_green()));
            assert_eq!(advice(&ColoursApart::default(), Some(Colour::Red)), None);
        });
    }

    #[test]
    fn a_shift_has_its_sign_and_standard_error() {
        assert_eq!(with_sigma([0.5, 0.02]), "+0.50 ± 0.02");
        assert_eq!(with_sigma([0.0312, 0.0012]), "+0.031 ± 0.001");
    }
}
