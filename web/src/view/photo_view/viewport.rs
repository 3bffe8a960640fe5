//! How the photo lies in its view: fitted, zoomed, or moved to a place that is asked for.

use leptos::prelude::*;

use crate::store::{Desk, ViewCommand};
use crate::view::components::transform::Placement;

/// Zoom and position of the photo.
#[derive(Clone, Copy)]
pub struct Viewport {
    /// Width and height of the view on the screen.
    pub bounds: RwSignal<[f64; 2]>,
    pub placement: RwSignal<Option<Placement>>,
    /// The photo, its size in pixels and its EXIF orientation.
    pub frame: Memo<Option<(String, [f64; 2], u8)>>,
    /// The placement that `fit` set last.
    fitted: StoredValue<Option<Placement>>,
}

impl Viewport {
    pub fn new(desk: Desk, photo: Memo<Option<String>>) -> Self {
        // Size and orientation: from the file, or from the camera where the file is not here.
        let frame = Memo::new(move |_| {
            let photo = photo.get()?;
            let file = desk.photos.files.with(|f| f.get(&photo).map(|f| (f.size, f.info.orientation)));
            let camera = || {
                desk.document.with(|d| {
                    let camera = &d.project.photos.iter().find(|p| p.id == photo)?.camera;
                    d.project.cameras.iter().find(|c| c.id == *camera).map(|c| ([c.width, c.height], 1))
                })
            };
            let (size, orientation) = file.or_else(camera)?;
            Some((photo, size.map(f64::from), orientation))
        });
        Self { bounds: RwSignal::default(), placement: RwSignal::default(), frame, fitted: StoredValue::default() }
    }

    /// Shows the whole photo.
    pub fn fit(self) {
        let [w, h] = self.bounds.get_untracked();
        if let Some((_, size, orientation)) = self.frame.get_untracked().filter(|_| w > 0.0) {
            let whole = Placement::fitted(size, orientation, w, h);
            self.fitted.set_value(Some(whole));
            self.placement.set(Some(whole));
        }
    }

    /// Replaces the placement, if there is one.
    pub fn change(self, change: impl FnOnce(Placement) -> Placement) {
        self.placement.update(|placement| *placement = placement.map(change));
    }

    /// Shows so many screen pixels for a photo pixel; the middle of the view stays.
    pub fn zoom_to(self, scale: f64) {
        let middle = self.middle();
        self.change(|p| p.zoomed(scale / p.scale, middle));
    }

    /// The middle of the view, on the screen.
    pub fn middle(self) -> [f64; 2] {
        self.bounds.get_untracked().map(|side| side / 2.0)
    }

    /// Fits another photo, and a photo that is shown in a view with a size for the first time. After a later change of size a photo
    /// shown whole stays whole, and any other keeps its zoom.
    pub fn keep_fitted(self) {
        Effect::new(move |last: Option<Option<String>>| {
            let [w, _] = self.bounds.get();
            let now = self.frame.get().map(|(photo, ..)| photo);
            if w > 0.0 && last.flatten() != now {
                self.fit();
                now
            } else if w > 0.0 {
                if self.placement.get_untracked().is_some_and(|p| self.fitted.get_value() == Some(p)) {
                    self.fit();
                }
                now
            } else {
                None
            }
        });
    }

    /// Carries out what other parts of the desk ask the view to show. Keys zoom about the cross, if there is one.
    pub fn follow_requests(self, desk: Desk, cross: RwSignal<Option<[f64; 2]>>) {
        let requests = desk.photo_view;
        Effect::new(move |_| {
            let Some(command) = requests.command.get() else { return };
            let centre = cross.get_untracked().unwrap_or_else(|| self.middle());
            match command {
                ViewCommand::Fit => self.fit(),
                ViewCommand::OneToOne => self.zoom_to(1.0),
                ViewCommand::Nearer => self.change(|p| p.zoomed(1.5, centre)),
                ViewCommand::Farther => self.change(|p| p.zoomed(1.0 / 1.5, centre)),
            }
            requests.command.set(None);
        });
        // A selection made elsewhere is brought into view.
        Effect::new(move |_| {
            let Some(pixel) = requests.centre_on.get() else { return };
            let [w, h] = self.bounds.get();
            if w > 0.0 {
                self.change(|p| {
                    let [x, y] = p.to_screen(pixel);
                    let visible = (20.0..w - 20.0).contains(&x) && (20.0..h - 20.0).contains(&y);
                    if visible { p } else { p.centred(pixel, p.scale, w, h) }
                });
                requests.centre_on.set(None);
            }
        });
        // A place looked for is magnified, as far as the photo has pixels for it.
        Effect::new(move |_| {
            let Some((place, reach)) = requests.show_place.get() else { return };
            let [w, h] = self.bounds.get();
            if w > 0.0 && self.frame.get().is_some() {
                self.change(|p| {
                    let scale = (w.min(h) / (2.0 * reach)).clamp(p.scale.min(1.0), 4.0);
                    p.centred(place, scale, w, h)
                });
                requests.show_place.set(None);
            }
        });
    }
}
