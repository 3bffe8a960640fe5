//! Keys that work wherever no text is being typed.

use leptos::prelude::*;

use super::transform::Placement;
use crate::browser::event::Key;
use crate::store::{Desk, Step};

/// Does what a key asks for; true when it was used up.
pub fn handle(desk: Desk, key: &Key) -> bool {
    if key.key == "Escape" {
        desk.escape();
        return false;
    }
    if key.typing {
        return false;
    }
    let in_photo = matches!(desk.step.get_untracked(), Step::Targets | Step::Identities | Step::Control);
    match (key.key.as_str(), key.modifiers.control, key.modifiers.shift) {
        ("z" | "Z", true, false) => desk.undo(),
        ("z" | "Z", true, true) | ("y" | "Y", true, false) => desk.redo(),
        ("s" | "S", true, with_photos) => desk.save(with_photos),
        ("Delete" | "Backspace", false, _) if in_photo => return remove(desk),
        ("PageDown", false, _) => desk.next_photo(1),
        ("PageUp", false, _) => desk.next_photo(-1),
        ("ArrowLeft", false, _) if in_photo => return nudge(desk, key, [-1.0, 0.0]),
        ("ArrowRight", false, _) if in_photo => return nudge(desk, key, [1.0, 0.0]),
        ("ArrowUp", false, _) if in_photo => return nudge(desk, key, [0.0, -1.0]),
        ("ArrowDown", false, _) if in_photo => return nudge(desk, key, [0.0, 1.0]),
        _ => return false,
    }
    true
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
