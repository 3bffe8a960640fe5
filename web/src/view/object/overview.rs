//! The object with its photos as a drawing, seen as the 3-D view begins: beside the numbers, and where there is no WebGL.

use leptos::prelude::*;
use sightline::adjustment::Adjustment;
use sightline::depiction::{extent, frustum};
use sightline::project::{Project, Role};

use crate::i18n::object as words;
use crate::store::Desk;

/// Sides of the drawing.
const WIDTH: f64 = 560.0;
const HEIGHT: f64 = 380.0;
const MARGIN: f64 = 16.0;
/// Control and check points have their names, unless they are more than this: those of all points would lie on each other.
const NAMED: usize = 40;
/// Points that are drawn; of more of them every second, third … is.
const MOST: usize = 3000;
/// Photos are drawn this part of the object's size deep.
const DEPTH: f64 = 0.1;
/// A click this near to a point, in units of the drawing, chooses it.
const REACH: f64 = 14.0;
/// To the right and upwards in the drawing: from the front, from the left and from above.
const RIGHT: [f64; 3] = [0.8036, 0.5952, 0.0];
const UP: [f64; 3] = [-0.2930, 0.3955, 0.8705];

fn on(v: [f64; 3]) -> [f64; 2] {
    [RIGHT, UP].map(|axis| (0..3).map(|k| axis[k] * v[k]).sum())
}

/// A point at its place in the drawing.
#[derive(Clone, Debug, PartialEq)]
struct Dot {
    id: String,
    at: [f64; 2],
    given: bool,
}

#[derive(Clone, Debug, Default, PartialEq)]
struct Drawn {
    dots: Vec<Dot>,
    photos: String,
    /// Of the points only every so many-th.
    every: usize,
}

fn drawn(adjustment: &Adjustment, project: &Project) -> Drawn {
    let (_, size) = extent(adjustment.points.iter().map(|p| p.xyz));
    let frusta: Vec<[[f64; 3]; 5]> = adjustment
        .photos
        .iter()
        .filter_map(|photo| {
            let own = project.photos.iter().find(|p| p.id == photo.id)?;
            let camera = project.cameras.iter().find(|c| c.id == own.camera)?;
            frustum(camera, photo.position, photo.rotation, DEPTH * size)
        })
        .collect();
    let all = adjustment.points.iter().map(|p| p.xyz).chain(frusta.iter().flatten().copied());
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for place in all.map(on) {
        for k in 0..2 {
            (low[k], high[k]) = (low[k].min(place[k]), high[k].max(place[k]));
        }
    }
    let side = |k: usize| (high[k] - low[k]).max(f64::MIN_POSITIVE);
    let scale = ((WIDTH - 2.0 * MARGIN) / side(0)).min((HEIGHT - 2.0 * MARGIN) / side(1));
    let at = |xyz: [f64; 3]| {
        let [h, v] = on(xyz);
        [WIDTH / 2.0 + (h - (low[0] + high[0]) / 2.0) * scale, HEIGHT / 2.0 - (v - (low[1] + high[1]) / 2.0) * scale]
    };
    let mut photos = String::new();
    for corners in frusta {
        let [centre, a, b, c, d] = corners.map(|xyz| at(xyz).map(|x| (x * 10.0).round() / 10.0));
        let to = |[x, y]: [f64; 2]| format!("{x} {y}");
        let (centre, a, b, c, d) = (to(centre), to(a), to(b), to(c), to(d));
        photos.push_str(&format!("M{a}L{b}L{c}L{d}ZM{centre}L{a}M{centre}L{b}M{centre}L{c}M{centre}L{d}"));
    }
    let every = adjustment.points.len().div_ceil(MOST).max(1);
    let given: std::collections::HashSet<&str> =
        project.points.iter().filter(|p| p.role != Role::Tie).map(|p| p.id.as_str()).collect();
    // Control and check points are few and are all drawn.
    let chosen = adjustment.points.iter().enumerate().filter(|(k, p)| k % every == 0 || given.contains(p.id.as_str()));
    let dot = |(_, p): (usize, &sightline::adjustment::AdjustedPoint)| Dot {
        id: p.id.clone(),
        at: at(p.xyz),
        given: given.contains(p.id.as_str()),
    };
    Drawn { dots: chosen.map(dot).collect(), photos, every }
}

/// Dots as round caps of lines that are hardly long.
fn path<'a>(dots: impl Iterator<Item = &'a Dot>) -> String {
    dots.map(|dot| format!("M{:.1} {:.1}h0.01", dot.at[0], dot.at[1])).collect()
}

#[component]
pub fn Overview() -> impl IntoView {
    let desk = expect_context::<Desk>();
    let all = Memo::new(move |_| {
        desk.document.with(|d| d.current().map(|r| drawn(&r.adjustment, &r.input)).unwrap_or_default())
    });
    let host = NodeRef::<leptos::svg::Svg>::new();
    let choose = move |e: leptos::ev::MouseEvent| {
        // A drawing smaller than its box is centred.
        let Some(element) = host.get_untracked() else { return };
        let shown = element.get_bounding_client_rect();
        let scale = (shown.width() / WIDTH).min(shown.height() / HEIGHT).max(f64::MIN_POSITIVE);
        let x = (f64::from(e.client_x()) - shown.left() - shown.width() / 2.0) / scale + WIDTH / 2.0;
        let y = (f64::from(e.client_y()) - shown.top() - shown.height() / 2.0) / scale + HEIGHT / 2.0;
        let nearest = all.with_untracked(|all| {
            let distance = |dot: &Dot| (dot.at[0] - x).hypot(dot.at[1] - y);
            let nearest = all.dots.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
            nearest.filter(|dot| distance(dot) < REACH).map(|dot| dot.id.clone())
        });
        if let Some(id) = nearest {
            desk.select_point(&id);
        }
    };
    let chosen = move || {
        let id = desk.selection.with(|s| s.point.clone())?;
        all.with(|all| all.dots.iter().find(|dot| dot.id == id).cloned())
    };
    view! {
        <svg class="overview" node_ref=host viewBox=format!("0 0 {WIDTH} {HEIGHT}") role="img" aria-label=words::overview_label on:click=choose>
            <path class="photos" d=move || all.with(|all| all.photos.clone())></path>
            <path class="dots" d=move || all.with(|all| path(all.dots.iter().filter(|dot| !dot.given)))></path>
            <path class="dots given" d=move || all.with(|all| path(all.dots.iter().filter(|dot| dot.given)))></path>
            {move || all.with(|all| {
                let given = all.dots.iter().filter(|dot| dot.given);
                let few = given.clone().count() <= NAMED;
                given.filter(|_| few).map(|dot| view! { <text x=dot.at[0] + 5.0 y=dot.at[1] - 4.0>{dot.id.clone()}</text> }).collect_view()
            })}
            {move || chosen().map(|dot| view! {
                <circle class="chosen" cx=dot.at[0] cy=dot.at[1] r="6"></circle>
                <text class="chosen" x=dot.at[0] + 9.0 y=dot.at[1] - 6.0>{dot.id.clone()}</text>
            })}
        </svg>
        {move || all.with(|all| (all.every > 1).then(|| view! { <p class="note">{words::every_nth_point(all.every)}</p> }))}
    }
}

#[cfg(test)]
mod tests {
    use sightline::adjustment::AdjustedPoint;

    use super::*;

    #[test]
    fn everything_lies_within_the_drawing_and_up_is_up() {
        let point = |id: &str, xyz: [f64; 3]| AdjustedPoint { id: id.into(), xyz, ..AdjustedPoint::default() };
        let points = vec![point("a", [1e6, 0.0, 0.0]), point("b", [1e6 + 10.0, 0.0, 0.0]), point("c", [1e6, 0.0, 8.0])];
        let shown = drawn(&Adjustment { points, ..Adjustment::default() }, &Project::default());
        assert_eq!(shown.every, 1);
        let [a, b, c] = [0, 1, 2].map(|k: usize| shown.dots[k].at);
        assert!(b[0] > a[0] && c[1] < a[1] && (c[0] - a[0]).abs() < 1e-6, "{a:?} {b:?} {c:?}");
        for [x, y] in [a, b, c] {
            assert!((0.0..=WIDTH).contains(&x) && (0.0..=HEIGHT).contains(&y), "{x} {y}");
        }
        let many = (0..10_000).map(|k| point(&k.to_string(), [f64::from(k), 0.0, 0.0])).collect();
        let shown = drawn(&Adjustment { points: many, ..Adjustment::default() }, &Project::default());
        assert_eq!((shown.every, shown.dots.len()), (4, 2500));
        let unit = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>();
        assert!((unit(RIGHT) - 1.0).abs() < 1e-3 && (unit(UP) - 1.0).abs() < 1e-3);
    }
}
