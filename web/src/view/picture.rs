//! The picture of the start page: photos of one panel from three places, and what they give.

use leptos::prelude::*;

use crate::i18n::first;

type Quad = [[f64; 2]; 4];

/// Photos: their left upper corners, and the panel's corners in each.
const PHOTOS: [([f64; 2], Quad); 3] = [
    ([4.0, 6.0], [[22.0, 20.0], [78.0, 14.0], [86.0, 52.0], [14.0, 58.0]]),
    ([40.0, 44.0], [[18.0, 14.0], [82.0, 22.0], [76.0, 58.0], [26.0, 54.0]]),
    ([76.0, 82.0], [[28.0, 12.0], [72.0, 12.0], [88.0, 58.0], [12.0, 58.0]]),
];
const PHOTO_SIZE: [f64; 2] = [100.0, 70.0];
/// The panel in the view of the result, and the cameras around it: projection centre and where it looks.
const PANEL: Quad = [[300.0, 40.0], [408.0, 58.0], [388.0, 104.0], [262.0, 82.0]];
const CAMERAS: [[f64; 2]; 4] = [[246.0, 138.0], [318.0, 152.0], [392.0, 146.0], [432.0, 18.0]];

/// Dots on a panel, in four columns and three rows, as a path of strokes without length.
fn dots(q: &Quad, [x0, y0]: [f64; 2]) -> String {
    let mut path = String::new();
    for row in 0..3 {
        for column in 0..4 {
            let (s, t) = (0.12 + 0.76 * f64::from(column) / 3.0, 0.16 + 0.68 * f64::from(row) / 2.0);
            let along =
                |k: usize| (1.0 - t) * ((1.0 - s) * q[0][k] + s * q[1][k]) + t * ((1.0 - s) * q[3][k] + s * q[2][k]);
            path.push_str(&format!("M{:.1} {:.1}h.01", x0 + along(0), y0 + along(1)));
        }
    }
    path
}

fn outline(q: &Quad, [x0, y0]: [f64; 2]) -> String {
    let corner = |[x, y]: &[f64; 2]| format!("{:.1} {:.1}", x0 + x, y0 + y);
    format!("M{}Z", q.iter().map(corner).collect::<Vec<_>>().join("L"))
}

/// A camera as a small pyramid whose base is towards the panel, and rays to three of its dots.
fn camera([x, y]: [f64; 2]) -> (String, String) {
    let middle = [0, 1].map(|k| PANEL.iter().map(|corner| corner[k]).sum::<f64>() / 4.0);
    let length = (middle[0] - x).hypot(middle[1] - y);
    let [dx, dy] = [(middle[0] - x) / length, (middle[1] - y) / length];
    let base = |side: f64| format!("{:.1} {:.1}", x + 15.0 * dx - side * dy, y + 15.0 * dy + side * dx);
    let rays = [PANEL[0], PANEL[1], middle].map(|[u, v]| format!("M{x} {y}L{u:.1} {v:.1}"));
    (format!("M{x} {y}L{}L{}Z", base(8.0), base(-8.0)), rays.concat())
}

#[component]
pub fn Purpose() -> impl IntoView {
    view! {
        <svg class="purpose" viewBox="0 0 440 158" role="img" aria-label=first::picture>
            {PHOTOS.iter().map(|(at, panel)| view! {
                <rect class="photo-frame" x=at[0] y=at[1] width=PHOTO_SIZE[0] height=PHOTO_SIZE[1]></rect>
                <path class="photo-panel" d=outline(panel, *at)></path>
                <path class="photo-dots" d=dots(panel, *at)></path>
            }).collect_view()}
            <path class="leads-to" d="M194 78h30M216 70l8 8-8 8"></path>
            {CAMERAS.iter().map(|at| {
                let (body, rays) = camera(*at);
                view! { <path class="rays" d=rays></path><path class="camera" d=body></path> }
            }).collect_view()}
            <path class="panel-outline" d=outline(&PANEL, [0.0; 2])></path>
            <path class="points" d=dots(&PANEL, [0.0; 2])></path>
        </svg>
    }
}
