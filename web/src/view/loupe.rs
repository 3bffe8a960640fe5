//! The docked loupe: the pixels around the pointer, or around what is selected, with sub-pixel centre and outline.

use leptos::html::Canvas;
use leptos::prelude::*;

use crate::browser::canvas::{SizeWatch, Surface};
use crate::i18n::text;
use crate::store::Desk;
use crate::view::components::transform::Placement;

/// Photo pixels across the loupe.
const FIELD: f64 = 21.0;

#[component]
pub fn Loupe(
    /// The selected target: centre, full axes, angle.
    #[prop(into)]
    target: Signal<Option<[f64; 5]>>,
) -> impl IntoView {
    let desk = expect_context::<Desk>();
    let canvas = NodeRef::<Canvas>::new();
    let bounds = RwSignal::new([0.0_f64; 2]);
    let watch = StoredValue::new_local(None);
    canvas.on_load(move |element| {
        watch.set_value(SizeWatch::new(&element, move |_, size| bounds.set(size)));
    });
    // Large targets are shown whole.
    let field = move || target.get().map_or(FIELD, |t| FIELD.max(t[2] * 1.6));
    Effect::new(move |_| {
        desk.window.theme.track();
        let size_here = bounds.get();
        let side = size_here[0];
        let Some(element) = canvas.get().filter(|_| side > 0.0) else { return };
        let Some(surface) = Surface::new(&element, size_here) else { return };
        let Some(photo) = desk.selection.with(|s| s.photo.clone()) else { return };
        let target = target.get();
        let Some(centre) = desk.photo_view.cursor.get().or(target.map(|t| [t[0], t[1]])) else { return };
        let Some(picture) = desk.picture(&photo) else { return };
        let orientation = desk.photos.files.with(|files| files.get(&photo).map_or(1, |f| f.info.orientation));
        let shown = picture.size();
        let file = desk.photos.files.with(|files| files.get(&photo).map(|f| f.size.map(f64::from)));
        let size = file.unwrap_or(shown);
        let start = Placement { size, orientation, scale: 1.0, shift: [0.0; 2] };
        let placement = start.centred(centre, side / field(), surface.width, surface.height);
        let [a, b, c, d, e, f] = placement.affine();
        let (sx, sy) = (size[0] / shown[0], size[1] / shown[1]);
        surface.pyramid(&picture, [a * sx, b * sx, c * sy, d * sy, e, f], true);
        let accent = surface.token("--p-accent");
        if let Some([u, v, major, minor, angle]) = target {
            let [x, y] = placement.to_screen([u, v]);
            surface.pen(&accent, 2.0, &[]);
            if major > 0.0 {
                let half = |axis: f64| axis / 2.0 * placement.scale;
                surface.ellipse(x, y, half(major), half(minor), placement.angle_on_screen(angle));
            }
            surface.pen(&accent, 1.0, &[]);
            surface.line(x, 0.0, x, surface.height);
            surface.line(0.0, y, surface.width, y);
        } else {
            let (x, y) = (surface.width / 2.0, surface.height / 2.0);
            surface.pen(&accent, 1.0, &[]);
            surface.line(x - 8.0, y, x + 8.0, y);
            surface.line(x, y - 8.0, x, y + 8.0);
        }
    });
    let factor = move || {
        let side = bounds.get()[0];
        if side > 0.0 { format!("{} ×", crate::format::fixed(side / field(), 0)) } else { String::new() }
    };
    view! {
        <div class="loupe">
            <canvas node_ref=canvas role="img" aria-label=text::loupe></canvas>
            <div class="loupe-foot"><span>{text::loupe} " " {factor}</span></div>
        </div>
    }
}
