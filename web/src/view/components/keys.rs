//! Keys: a few work wherever no text is being typed, the others act where the focus is.

use leptos::prelude::*;

use super::transform::Placement;
use crate::browser::event::Key;
use crate::store::{Desk, Step, ViewCommand};

/// Performs the action of a key; returns whether it was handled.
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
        _ => return single(desk, key),
    }
    true
}

/// Keys of a single letter, which can be switched off.
fn single(desk: Desk, key: &Key) -> bool {
    let open = desk.document.with_untracked(|d| !d.is_empty());
    if !letters(desk, key) {
        return false;
    }
    if key.key == "?" {
        desk.window.help.set(true);
        return true;
    }
    if matches!(key.key.as_str(), "t" | "T") && open {
        desk.go(Step::Tables);
        return true;
    }
    in_measuring(desk) && measuring(desk, key)
}

/// Whether keys of a single letter act now.
fn letters(desk: Desk, key: &Key) -> bool {
    !key.modifiers.control
        && !key.modifiers.alt
        && desk.window.single_keys.get_untracked()
        && !desk.window.help.get_untracked()
}

/// Whether this is a step in which photos are measured.
fn in_measuring(desk: Desk) -> bool {
    matches!(desk.step.get_untracked(), Step::Targets | Step::Identities | Step::Tables)
}

/// Actions for the selected point and its photos.
fn measuring(desk: Desk, key: &Key) -> bool {
    match key.key.as_str() {
        "y" | "Y" if untrack(|| desk.asked_question()).is_some() => desk.answer_yes(None),
        "n" | "N" if untrack(|| desk.asked_question()).is_some() => desk.answer_no(),
        "d" | "D" => desk.next_question(),
        "y" | "Y" => return answer(desk, |desk| desk.take_candidate()),
        "n" | "N" => return answer(desk, |desk| desk.next_place()),
        "p" | "P" if untrack(|| desk.in_series()) => desk.finish_point(),
        "m" | "M" => desk.switch_series(),
        "f" | "F" | "0" => desk.photo_view.command.set(Some(ViewCommand::Fit)),
        "1" => desk.photo_view.command.set(Some(ViewCommand::OneToOne)),
        "+" | "=" => desk.photo_view.command.set(Some(ViewCommand::Nearer)),
        "-" => desk.photo_view.command.set(Some(ViewCommand::Farther)),
        _ => return false,
    }
    true
}

/// The keys of a table of numbers, where it has the focus itself; true when the key was used up.
pub fn in_table(desk: Desk, key: &Key) -> bool {
    key.on_table && in_measuring(desk) && exclude(desk, key)
}

/// Excludes or restores the chosen observation: where it is seen, and from nowhere else.
fn exclude(desk: Desk, key: &Key) -> bool {
    if !matches!(key.key.as_str(), "x" | "X") || !letters(desk, key) {
        return false;
    }
    match untrack(|| desk.chosen_observation()) {
        Some(o) => {
            desk.switch_observation(&o.photo, &o.point, !o.enabled);
            true
        }
        None => false,
    }
}

/// The keys of the photo, where it has the focus; true when the key was used up.
pub fn in_photo(desk: Desk, key: &Key) -> bool {
    if key.modifiers.control {
        return false;
    }
    match key.key.as_str() {
        "Delete" | "Backspace" => return remove(desk),
        "x" | "X" => return exclude(desk, key),
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
    let orientation = desk.photos.files.with_untracked(|files| files.get(&o.photo).map_or(1, |f| f.info.orientation));
    let placement = Placement { size: [0.0; 2], orientation, scale: 1.0, shift: [0.0; 2] };
    desk.nudge(placement.to_pixel([step[0] * size, step[1] * size]));
    true
}
