//! The samples of the photo where it is magnified: requested from the workers for the visible part with a margin.

use std::sync::Arc;

use leptos::prelude::*;
use sightline_protocol::{ShowValues, Values};

use super::Desk;
use super::background::Stop;
use super::pool::TaskOutcome;
use crate::i18n::background as words;

/// Rectangles begin and end at multiples of this, so that a small move needs no new request.
const GRID: u32 = 16;

/// The rectangle of pixels that was requested last, with its values once a worker has read them.
#[derive(Clone, Debug, Default)]
pub struct PixelRequest {
    digest: u64,
    place: [u32; 4],
    values: Option<Arc<Values>>,
}

impl Desk {
    /// The samples of a photo where it is seen: left, top, right, bottom in pixels; as soon as they are there.
    pub fn values(self, photo: &str, sight: [f64; 4]) -> Option<Arc<Values>> {
        let (digest, [width, height]) = self.photos.files.with(|files| files.get(photo).map(|f| (f.digest, f.size)))?;
        let begin = |at: f64| (at.max(0.0) as u32) / GRID * GRID;
        let end = |at: f64, size: u32| ((at.max(0.0).ceil() as u32).div_ceil(GRID) * GRID).min(size);
        let [left, top] = [begin(sight[0]), begin(sight[1])];
        let [right, bottom] = [end(sight[2], width), end(sight[3], height)];
        let place = [left, top, right.saturating_sub(left), bottom.saturating_sub(top)];
        let asked = self.photos.values.get();
        if (asked.digest, asked.place) != (digest, place) {
            self.ask_for_values(photo, digest, place);
            return None;
        }
        asked.values
    }

    fn ask_for_values(self, photo: &str, digest: u64, place: [u32; 4]) {
        let Some(file) = self.photos.files.with_untracked(|files| files.get(photo).map(|f| f.content.clone())) else {
            return;
        };
        self.photos.values.update_untracked(|asked| *asked = PixelRequest { digest, place, values: None });
        let on_outcome = move |outcome: TaskOutcome<ShowValues>| match outcome {
            TaskOutcome::Progress(nothing) => match nothing {},
            // What cannot be read is reported where the photo itself is requested.
            TaskOutcome::Failed(_) => {}
            TaskOutcome::Done(values, _) => {
                let wanted = self.photos.values.with_untracked(|asked| (asked.digest, asked.place) == (digest, place));
                if wanted {
                    self.photos.values.update(|asked| asked.values = Some(Arc::new(values)));
                }
            }
        };
        let stop =
            Stop(words::pixels, move || self.photos.values.update_untracked(|asked| *asked = PixelRequest::default()));
        self.ask(stop, ShowValues { digest, place }, vec![file], on_outcome);
    }
}
