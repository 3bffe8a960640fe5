//! The samples of the photo where it is magnified: asked of the workers for what is in sight and a little more.

use std::sync::Arc;

use leptos::prelude::*;
use sightline_protocol::{ShowValues, Values};

use super::Desk;
use super::lasting::Stop;
use super::pool::Outcome;
use crate::i18n::lasting as words;

/// Rectangles begin and end at multiples of this, so that a small move asks for nothing new.
const GRID: u32 = 16;

/// The rectangle asked for last, and its samples when they are there.
#[derive(Clone, Debug, Default)]
pub struct Asked {
    digest: u64,
    place: [u32; 4],
    values: Option<Arc<Values>>,
}

impl Desk {
    /// The samples of a photo where it is seen: left, top, right, bottom in pixels; as soon as they are there.
    pub fn values(self, photo: &str, sight: [f64; 4]) -> Option<Arc<Values>> {
        let (digest, [width, height]) = self.files.with(|files| files.get(photo).map(|f| (f.digest, f.size)))?;
        let begin = |at: f64| (at.max(0.0) as u32) / GRID * GRID;
        let end = |at: f64, size: u32| ((at.max(0.0).ceil() as u32).div_ceil(GRID) * GRID).min(size);
        let [left, top] = [begin(sight[0]), begin(sight[1])];
        let [right, bottom] = [end(sight[2], width), end(sight[3], height)];
        let place = [left, top, right.saturating_sub(left), bottom.saturating_sub(top)];
        let asked = self.values.get();
        if (asked.digest, asked.place) != (digest, place) {
            self.ask_for_values(photo, digest, place);
            return None;
        }
        asked.values
    }

    fn ask_for_values(self, photo: &str, digest: u64, place: [u32; 4]) {
        let Some(file) = self.files.with_untracked(|files| files.get(photo).map(|f| f.content.clone())) else { return };
        self.values.update_untracked(|asked| *asked = Asked { digest, place, values: None });
        let on_outcome = move |outcome: Outcome<ShowValues>| match outcome {
            Outcome::Progress(nothing) => match nothing {},
            // What cannot be read is told where the photo itself is asked for.
            Outcome::Failed(_) => {}
            Outcome::Done(values, _) => {
                let wanted = self.values.with_untracked(|asked| (asked.digest, asked.place) == (digest, place));
                if wanted {
                    self.values.update(|asked| asked.values = Some(Arc::new(values)));
                }
            }
        };
        let stop = Stop(words::pixels, move || self.values.update_untracked(|asked| *asked = Asked::default()));
        self.ask(stop, ShowValues { digest, place }, vec![file], on_outcome);
    }
}
