//! Small parts of photos, for looking at one point in many of them: cut out by the workers, the last ones kept.

use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline_protocol::{ShowPart, Shown};

use super::Desk;
use super::background::Stop;
use super::pool::TaskOutcome;
use crate::browser::picture::Picture;
use crate::i18n::background as words;

/// Parts kept.
const KEPT: usize = 96;
/// Parts begin at multiples of this, so that a place that moves a little keeps its part.
const GRID: f64 = 16.0;

/// A part of a photo in full resolution, requested or read.
#[derive(Clone)]
pub struct PhotoPart {
    digest: u64,
    left: u32,
    top: u32,
    side: u32,
    picture: Option<Picture>,
}

/// A part of a photo, and where its corner is.
#[derive(Clone)]
pub struct Cut {
    pub picture: Picture,
    pub left: f64,
    pub top: f64,
}

impl Desk {
    /// The part of a photo around a place, at least so many pixels to either side, as soon as it is there.
    pub fn part(self, photo: &str, [u, v]: [f64; 2], reach: f64) -> Option<Cut> {
        let (digest, [width, height]) =
            self.photos.files.with(|files| files.get(photo).map(|f| (f.digest, f.size.map(f64::from))))?;
        let side = (2.0 * reach + GRID).min(2048.0);
        let corner = |at: f64, end: f64| (((at - reach) / GRID).floor() * GRID).clamp(0.0, (end - 1.0).max(0.0));
        let (left, top) = (corner(u, width), corner(v, height));
        let (l, t, s) = (left as u32, top as u32, side.ceil() as u32);
        let is = |part: &&PhotoPart| (part.digest, part.left, part.top, part.side) == (digest, l, t, s);
        if let Some(part) = self.photos.parts.with(|all| all.iter().find(is).cloned()) {
            return part.picture.map(|picture| Cut { picture, left, top });
        }
        self.ask_for_part(photo, PhotoPart { digest, left: l, top: t, side: s, picture: None });
        None
    }

    fn ask_for_part(self, photo: &str, part: PhotoPart) {
        let Some(file) = self.photos.files.with_untracked(|files| files.get(photo).map(|f| f.content.clone())) else {
            return;
        };
        let PhotoPart { digest, left, top, side, .. } = part;
        self.photos.parts.update_untracked(|all| {
            all.push(part);
            if all.len() > KEPT {
                all.remove(0);
            }
        });
        let on_outcome = move |outcome: TaskOutcome<ShowPart>| match outcome {
            TaskOutcome::Progress(nothing) => match nothing {},
            // What cannot be shown here is reported where the photo itself is requested.
            TaskOutcome::Failed(_) => {}
            TaskOutcome::Done(Shown { width, height }, bytes) => {
                let Some(bytes) = bytes.into_iter().next().filter(|_| width > 0 && height > 0) else { return };
                spawn_local(async move {
                    if let Ok(picture) = Picture::from_rgba(bytes, width, height).await {
                        let is = |p: &&mut PhotoPart| (p.digest, p.left, p.top, p.side) == (digest, left, top, side);
                        self.photos.parts.update(|all| {
                            if let Some(part) = all.iter_mut().find(is) {
                                part.picture = Some(picture);
                            }
                        });
                    }
                });
            }
        };
        let task = ShowPart { digest, left, top, side };
        // Asked for again when it is wanted again.
        let stopped = move || {
            let is = |p: &PhotoPart| (p.digest, p.left, p.top, p.side) == (digest, left, top, side);
            self.photos.parts.update_untracked(|all| all.retain(|part| !is(part)));
        };
        self.ask_in_turn(Stop(words::photo, stopped), task, vec![file], on_outcome);
    }
}
