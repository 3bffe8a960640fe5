//! Full pictures for the photo view, decoded by the workers when they are asked for; the last few are kept.

use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline_protocol::ShowPhoto;

use super::background::Stop;
use super::pool::{Failure, TaskOutcome};
use super::{Desk, Until};
use crate::browser::page;
use crate::browser::picture::Pyramid;
use crate::i18n::background as words;
use crate::i18n::{errors, text};

/// Decoded pictures kept: a photo of 24 megapixels takes 128 MB with its levels.
const KEPT: usize = 3;

/// How long they wait for a view to show photos again, in milliseconds.
const WAITING_MS: i32 = 20_000;

/// A photo's picture, requested or decoded.
#[derive(Clone)]
pub struct PhotoPicture {
    photo: String,
    digest: u64,
    picture: Option<Pyramid>,
}

impl Desk {
    /// The picture of a photo, as soon as it is there; the small one serves meanwhile.
    pub fn picture(self, photo: &str) -> Option<Pyramid> {
        let digest = self.photos.files.with(|files| files.get(photo).map(|file| file.digest))?;
        let is = |shown: &&PhotoPicture| shown.photo == photo && shown.digest == digest;
        if let Some(shown) = self.photos.pictures.with(|all| all.iter().find(is).cloned()) {
            return shown.picture;
        }
        self.ask_for_picture(photo.to_owned(), digest);
        None
    }

    /// A view shows photos from now on.
    pub fn begin_showing(self) {
        self.photos.showing.update_value(|views| *views += 1);
    }

    /// It does not any more: without another view that does, the pictures are let go after a while.
    pub fn end_showing(self) {
        self.photos.showing.update_value(|views| *views -= 1);
        page::after(WAITING_MS, move || {
            if self.photos.showing.get_value() == 0 {
                self.photos.pictures.set(Vec::new());
            }
        });
    }

    fn ask_for_picture(self, photo: String, digest: u64) {
        let Some(file) = self.photos.files.with_untracked(|files| files.get(&photo).map(|f| f.content.clone())) else {
            return;
        };
        self.photos.pictures.update_untracked(|all| {
            all.push(PhotoPicture { photo: photo.clone(), digest, picture: None });
            if all.len() > KEPT {
                all.remove(0);
            }
        });
        let on_outcome = move |outcome: TaskOutcome<ShowPhoto>| match outcome {
            TaskOutcome::Done(plan, bytes) => {
                let photo = photo.clone();
                spawn_local(async move {
                    match Pyramid::from_tiles(plan, bytes).await {
                        Ok(picture) => self.photos.pictures.update(|all| {
                            if let Some(shown) = all.iter_mut().find(|s| s.photo == photo && s.digest == digest) {
                                shown.picture = Some(picture);
                            }
                        }),
                        Err(detail) => self
                            .say(true, Until::NextWork, move || text::photo_failed(&photo, text::unreadable(&detail))),
                    }
                });
            }
            TaskOutcome::Failed(Failure::Refused(error)) => {
                let photo = photo.clone();
                self.say(true, Until::NextWork, move || text::photo_failed(&photo, errors::sentence(&error)));
            }
            TaskOutcome::Failed(Failure::Unreadable(detail) | Failure::Lost(detail)) => {
                let photo = photo.clone();
                self.say(true, Until::NextWork, move || text::photo_failed(&photo, text::unreadable(&detail)));
            }
            TaskOutcome::Progress(nothing) => match nothing {},
        };
        // Asked for again when the photo is shown again.
        let stopped = move || {
            self.photos.pictures.update_untracked(|all| all.retain(|s| s.digest != digest || s.picture.is_some()))
        };
        self.ask(Stop(words::photo, stopped), ShowPhoto {}, vec![file], on_outcome);
    }
}
