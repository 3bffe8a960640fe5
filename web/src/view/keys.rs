//! Keys: a few work wherever no text is being typed, the others act where the focus is.

use leptos::prelude::*;

use super::transform::Placement;
use crate::browser::event::Key;
use crate::store::Desk;

/// Does what a key asks for; true when it was used up.
pub fn handle(desk: Desk, key: &Key) -> bool {
    if key.key == "Escape" {
        desk.escape();
        return false;
    }
    if key.typing {
        return false;
    }
    match (key.key.as_str(), key.modifiers.control, key.modifiers.shift) {
        ("z" | "Z", true, false) => desk.undo(),
        ("z" | "Z", true, true) | ("y" | "Y", true, false) => desk.redo(),
        ("s" | "S", true, with_photos) => desk.save(with_photos),
        _ => return false,
    }
    true
}

/// The keys of the photo, where it has the focus; true when the key was used up.
pub fn in_photo(desk: Desk, key: &Key) -> bool {
    if key.modifiers.control {
        return false;
    }
    match key.key.as_str() {
        "Delete" | "Backspace" => return remove(desk),
        "y" | "Y" => return answer(desk, |desk| desk.take_candidate()),
        "n" | "N" => return answer(desk, |desk| desk.next_place()),
        "p" | "P" if untrack(|| desk.in_series()) => desk.finish_point(),
        "m" | "M" => desk.switch_series(),
        "PageDown" => desk.next_photo(1),
        "PageUp" => desk.next_photo(-1),
        "ArrowLeft" => return nudge(desk, key, [-1.0, 0.0]),
        "ArrowRight" => return nudge(desk, key, [1.0, 0.0]),
        "ArrowUp" => return nudge(desk, key, [0.0, -1.0]),
        "ArrowDown" => return nudge(desk, key, [0.0, 1.0]),
        _ => return false,
    }
    true
}

/// Answers what is asked about the chosen point; without one the key is not used.
fn answer(desk: Desk, verb: fn(Desk)) -> bool {
    let chosen = desk.selection.with_untracked(|s| s.point.is_some());
    if chosen {
        verb(desk);
    }
    chosen
}

fn remove(desk: Desk) -> bool {
    match untrack(|| desk.chosen_observation()) {
        Some(o) => {
            desk.remove_observation(&o.photo, &o.point);
            true
        }
        None => false,
    }
}

/// One pixel; ten with Shift, a tenth with Alt. The step is the one seen on the screen, whatever way the photo lies.
fn nudge(desk: Desk, key: &Key, step: [f64; 2]) -> bool {
    let Some(o) = untrack(|| desk.chosen_observation()) else { return false };
    let size = match (key.modifiers.shift, key.modifiers.alt) {
        (true, _) => 10.0,
        (_, true) => 0.1,
        _ => 1.0,
    };
    let orientation = desk.files.with_untracked(|files| files.get(&o.photo).map_or(1, |f| f.info.orientation));
    let placement = Placement { size: [0.0; 2], orientation, scale: 1.0, shift: [0.0; 2] };
    desk.nudge(placement.to_pixel([step[0] * size, step[1] * size]));
    true
}
