//! The chosen point in every photo, the doubtful ones first: where it is measured, and where it should be.

use leptos::html::Canvas;
use leptos::prelude::*;
use sightline::matching::PhotoPrediction;

use crate::browser::canvas::{SizeWatch, Surface};
use crate::format;
use crate::i18n::text;
use crate::store::Desk;
use crate::view::components::transform::Placement;

/// Photos shown at most; the list is ordered by doubt.
const MOST: usize = 24;
/// Photo pixels to either side, at least and at most.
const REACH: [f64; 2] = [12.0, 160.0];

/// One photo of the point.
#[derive(Clone, Debug, PartialEq)]
struct Inset {
    photo: String,
    /// Its centre.
    at: [f64; 2],
    measured: bool,
    /// Outline of the target: full axes and angle.
    outline: Option<[f64; 3]>,
    /// Where it should be, with the ellipse of three standard errors.
    predicted: Option<([f64; 2], Option<[f64; 3]>)>,
    off_px: Option<f64>,
    doubt: f64,
}

/// Insets of the selected point, the most doubtful first.
fn insets(desk: Desk) -> Vec<Inset> {
    let Some(point) = desk.selection.with(|s| s.point.clone()) else { return Vec::new() };
    let prediction = desk.prediction();
    let predicted = |photo: &str| -> Option<&PhotoPrediction> {
        prediction.as_ref().and_then(|p| p.photos.iter().find(|p| p.photo == photo))
    };
    let mut all = desk.document.with(|d| {
        let of_photo = |photo: &sightline::project::Photo| {
            let known = predicted(&photo.id);
            let place = known.and_then(|p| Some((p.place?, p.ellipse(3.0))));
            let observation = d.project.observations.iter().find(|o| o.photo == photo.id && o.point == point);
            let (at, doubt) = match (observation, known) {
                (Some(o), known) => ([o.u, o.v], known.and_then(|p| p.off_sigmas.or(p.off_px)).unwrap_or(0.0)),
                (None, Some(p)) if p.inside => (p.place?, f64::INFINITY),
                _ => return None,
            };
            let target = observation.and_then(|o| d.detections.get(&photo.id)?.target(o.target?));
            Some(Inset {
                photo: photo.id.clone(),
                at,
                measured: observation.is_some(),
                outline: target.map(|t| [t.major, t.minor, t.angle]),
                predicted: place,
                off_px: known.and_then(|p| p.off_px),
                doubt,
            })
        };
        d.project.photos.iter().filter_map(of_photo).collect::<Vec<_>>()
    });
    all.sort_by(|a, b| b.doubt.total_cmp(&a.doubt));
    all.truncate(MOST);
    all
}

/// The strip of insets below the photo.
#[component]
pub fn Insets() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let all = Memo::new(move |_| insets(desk));
    let hidden = Memo::new(move |_| {
        let prediction = desk.prediction()?;
        let out = prediction.photos.iter().filter(|p| p.measured.is_none() && p.place.is_some() && !p.inside);
        let photos = out.map(|p| p.photo.clone()).collect::<Vec<_>>();
        (!photos.is_empty()).then_some(photos)
    });
    view! {
        <Show when=move || all.with(|all| !all.is_empty())>
            <ul class="insets" aria-label=text::this_point_in_photos>
                <For each=move || all.get() key=|inset| format!("{inset:?}") children=move |inset| view! { <InsetView inset/> }/>
                {move || hidden.get().map(|photos| view! {
                    <li class="hidden-in"><b>{text::not_in(photos.len())}</b><span>{photos.join(" ")}</span></li>
                })}
            </ul>
        </Show>
    }
}

#[component]
fn InsetView(inset: Inset) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let canvas = NodeRef::<Canvas>::new();
    let bounds = RwSignal::new([0.0_f64; 2]);
    let watch = StoredValue::new_local(None);
    canvas.on_load(move |element| {
        watch.set_value(SizeWatch::new(&element, move |_, size| bounds.set(size)));
    });
    let drawn = inset.clone();
    Effect::new(move |_| {
        desk.window.theme.track();
        let size = bounds.get();
        let Some(surface) = canvas.get().filter(|_| size[0] > 0.0).and_then(|element| Surface::new(&element, size))
        else {
            return;
        };
        draw(desk, &surface, &drawn);
    });
    let Inset { photo, measured, off_px, .. } = inset;
    let words = match (measured, off_px) {
        (false, _) => text::predicted().to_owned(),
        (true, Some(off)) => text::off_by(format::fixed(off, 2)),
        (true, None) => text::legend_measured().to_owned(),
    };
    let id = StoredValue::new(photo.clone());
    let chosen = move || desk.selection.with(|s| id.with_value(|id| s.photo.as_ref() == Some(id)));
    let open = move |_| match desk.selection.with_untracked(|s| s.point.clone()).filter(|_| measured) {
        Some(point) => desk.select_observation(&id.get_value(), &point),
        None => desk.look_for_point(&id.get_value()),
    };
    view! {
        <li class:chosen=chosen>
            <button type="button" data-inset=id.get_value() aria-pressed=move || chosen().to_string() on:click=open>
                <canvas node_ref=canvas></canvas>
                <span><b>{photo}</b>" "<i class:warn=!measured>{words}</i></span>
            </button>
        </li>
    }
}

fn draw(desk: Desk, surface: &Surface, inset: &Inset) {
    let size = inset.outline.map_or(0.0, |o| 1.2 * o[0]);
    let spread = inset.predicted.map_or(0.0, |(place, e)| {
        let apart = (place[0] - inset.at[0]).hypot(place[1] - inset.at[1]);
        1.2 * (apart + e.map_or(0.0, |e| e[0]).min(4.0 * REACH[0].max(size)))
    });
    let reach = REACH[0].max(size).max(spread).min(REACH[1]);
    let Some(cut) = desk.part(&inset.photo, inset.at, reach) else { return };
    let (photo, orientation) = desk.photos.files.with_untracked(|files| {
        files.get(&inset.photo).map_or(([0.0; 2], 1), |f| (f.size.map(f64::from), f.info.orientation))
    });
    let start = Placement { size: photo, orientation, scale: 1.0, shift: [0.0; 2] };
    let scale = surface.width.min(surface.height) / (2.0 * reach);
    let placement = start.centred(inset.at, scale, surface.width, surface.height);
    let [a, b, c, d, e, f] = placement.affine();
    let map = [a, b, c, d, a * cut.left + c * cut.top + e, b * cut.left + d * cut.top + f];
    surface.picture(&cut.picture, map, placement.scale >= 2.0);
    let accent = surface.token("--p-accent");
    if let Some((place, ellipse)) = inset.predicted {
        let [x, y] = placement.to_screen(place);
        surface.pen(&accent, 1.25, &[4.0, 3.0]);
        match ellipse {
            Some([p, q, angle]) => {
                surface.ellipse(x, y, (p * scale).max(2.0), (q * scale).max(2.0), placement.angle_on_screen(angle));
            }
            // How far off it may be is not known: a place and no ellipse.
            None => {
                surface.line(x - 8.0, y - 8.0, x + 8.0, y + 8.0);
                surface.line(x - 8.0, y + 8.0, x + 8.0, y - 8.0);
            }
        }
    }
    if inset.measured {
        let [x, y] = placement.to_screen(inset.at);
        surface.pen(&accent, 1.5, &[]);
        if let Some([major, minor, angle]) = inset.outline {
            let half = |axis: f64| (axis / 2.0 * scale).max(2.0);
            surface.ellipse(x, y, half(major), half(minor), placement.angle_on_screen(angle));
        } else {
            surface.line(x - 8.0, y, x + 8.0, y);
            surface.line(x, y - 8.0, x, y + 8.0);
        }
    }
}
