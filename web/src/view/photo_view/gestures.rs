//! Pointers, the wheel and keys over the photo: zoom, pan, clicks, and a cross that the arrow keys move.

use std::collections::BTreeMap;

use leptos::ev::{KeyboardEvent, PointerEvent, WheelEvent};
use leptos::prelude::*;

use super::Click;
use super::viewport::Viewport;
use crate::browser::event::{self, Key, Pointer};
use crate::store::Desk;
use crate::view::components::keys;
use crate::view::components::transform::Placement;

/// Movement of the pointer in pixels above which a press is a drag, not a click.
const STILL: f64 = 4.0;
/// How far a click of a mouse and a tap of a finger reach, in screen pixels.
const REACH: [f64; 2] = [12.0, 22.0];

/// State of the input to the photo view.
#[derive(Clone, Copy)]
pub struct Gestures {
    desk: Desk,
    viewport: Viewport,
    on_click: Callback<Click>,
    /// Position of the pointer or of the cross on the screen.
    pub at: RwSignal<Option<[f64; 2]>>,
    /// The cross on the screen, once the arrow keys have been used: Enter is a click there.
    pub cross: RwSignal<Option<[f64; 2]>>,
    /// Whether the space bar is held: dragging pans and never clicks.
    pub space: RwSignal<bool>,
    /// Pointers that are pressed.
    pointers: StoredValue<BTreeMap<i32, Pointer>>,
    /// Path of the pointer since it was pressed, in screen pixels.
    travelled: StoredValue<f64>,
}

/// The pixel at a place of the screen, and whether it lies on the photo.
fn pixel_at(placement: Placement, at: [f64; 2]) -> ([f64; 2], bool) {
    let [u, v] = placement.to_pixel(at);
    ([u, v], (0.0..=placement.size[0]).contains(&u) && (0.0..=placement.size[1]).contains(&v))
}

impl Gestures {
    pub fn new(desk: Desk, viewport: Viewport, on_click: Callback<Click>) -> Self {
        Self {
            desk,
            viewport,
            on_click,
            at: RwSignal::default(),
            cross: RwSignal::default(),
            space: RwSignal::default(),
            pointers: StoredValue::default(),
            travelled: StoredValue::default(),
        }
    }

    fn click(self, placement: Placement, at: [f64; 2], reach: f64, alt: bool) {
        let ([u, v], inside) = pixel_at(placement, at);
        let free = alt || self.desk.measuring.placing.get_untracked();
        self.on_click.run(Click { u, v, reach: reach / placement.scale, inside, free });
    }

    /// Shows the coordinates of a place on the screen.
    fn follow(self, placement: Placement, at: [f64; 2]) {
        let (pixel, inside) = pixel_at(placement, at);
        self.desk.photo_view.cursor.set(inside.then_some(pixel));
    }

    pub fn key(self, e: &KeyboardEvent, held: bool) {
        let key = event::key(e);
        let used = if key.key == " " {
            self.space.set(held);
            true
        } else {
            held && !key.modifiers.control && (keys::in_photo(self.desk, &key) || self.steer(&key))
        };
        if used {
            e.prevent_default();
        }
    }

    /// Moves the cross, or clicks there; whether the key does either.
    fn steer(self, key: &Key) -> bool {
        let [w, h] = self.viewport.bounds.get_untracked();
        let Some(p) = self.viewport.placement.get_untracked() else { return false };
        let at = self.cross.get_untracked().unwrap_or([w / 2.0, h / 2.0]);
        let step = match (key.modifiers.shift, key.modifiers.alt) {
            (true, _) => 64.0,
            (_, true) => 1.0,
            _ => 12.0,
        };
        let by = match key.key.as_str() {
            "ArrowLeft" => [-step, 0.0],
            "ArrowRight" => [step, 0.0],
            "ArrowUp" => [0.0, -step],
            "ArrowDown" => [0.0, step],
            "Enter" => {
                self.click(p, at, REACH[0], key.modifiers.alt);
                return true;
            }
            _ => return false,
        };
        let at = [(at[0] + by[0]).clamp(0.0, w), (at[1] + by[1]).clamp(0.0, h)];
        self.cross.set(Some(at));
        self.at.set(Some(at));
        self.follow(p, at);
        true
    }

    pub fn down(self, e: &PointerEvent) {
        let pointer = event::pointer(e);
        self.cross.set(None);
        event::capture(e);
        let may_click = pointer.button == 0 && !self.space.get_untracked();
        self.travelled.set_value(if may_click { 0.0 } else { f64::INFINITY });
        self.pointers.update_value(|all| {
            all.insert(pointer.id, pointer);
        });
    }

    pub fn moved(self, e: &PointerEvent) {
        let pointer = event::pointer(e);
        self.at.set(Some([pointer.x, pointer.y]));
        if let Some(p) = self.viewport.placement.get_untracked() {
            self.follow(p, [pointer.x, pointer.y]);
        }
        self.pointers.update_value(|all| {
            let Some(before) = all.insert(pointer.id, pointer).filter(|_| e.buttons() != 0) else {
                all.remove(&pointer.id);
                return;
            };
            let step = [pointer.x - before.x, pointer.y - before.y];
            self.travelled.update_value(|t| *t += step[0].hypot(step[1]));
            if self.travelled.get_value() < STILL {
                return;
            }
            let other = all.values().find(|p| p.id != pointer.id).copied();
            self.viewport.change(|p| match other {
                // Two fingers: zoom by their distance about the one at rest.
                Some(other) => {
                    let spread = |p: &Pointer| (p.x - other.x).hypot(p.y - other.y).max(1.0);
                    p.zoomed(spread(&pointer) / spread(&before), [other.x, other.y])
                }
                None => p.shifted(step),
            });
        });
    }

    pub fn up(self, e: &PointerEvent) {
        let pointer = event::pointer(e);
        self.cancel(e);
        if self.travelled.get_value() < STILL
            && pointer.button == 0
            && let Some(p) = self.viewport.placement.get_untracked()
        {
            self.click(p, [pointer.x, pointer.y], REACH[usize::from(pointer.touch)], pointer.modifiers.alt);
        }
    }

    pub fn cancel(self, e: &PointerEvent) {
        self.pointers.update_value(|all| {
            all.remove(&event::pointer(e).id);
        });
    }

    pub fn leave(self) {
        self.desk.photo_view.cursor.set(None);
        self.at.set(None);
    }

    pub fn wheel(self, e: &WheelEvent) {
        let wheel = event::wheel(e);
        self.viewport.change(|p| {
            if wheel.zoom {
                p.zoomed((-wheel.dy * 0.0022).exp(), [wheel.x, wheel.y])
            } else {
                p.shifted([-wheel.dx, -wheel.dy])
            }
        });
    }
}
