//! What page and workers say to each other. Pictures and files travel beside these as bytes.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use sightline::Error;
use sightline::adjustment::{AdjustOptions, Adjustment, Iteration};
use sightline::detection::{DetectOptions, Detection, Target};
use sightline::exif::PhotoInfo;
use sightline::experiments::{Experiment, ExperimentOptions};
use sightline::matching::{Matching, PhotoTargets};
use sightline::orient::Note;
use sightline::project::Project;

/// Work for a worker. The files it needs come with it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Request {
    /// Look into a photo: size, EXIF, a small picture.
    Open { max_side: u32 },
    /// Decode a photo for the screen.
    Picture,
    /// Find the targets of a photo.
    Detect { options: DetectOptions },
    /// Measure at one place of a photo; by the file's digest a worker knows the photo that it decoded last.
    Measure { digest: u64, u: f64, v: f64, options: DetectOptions },
    /// Orient what is not oriented and adjust; progress per iteration.
    Adjust { project: Box<Project>, options: AdjustOptions },
    /// Name uncoded targets by the geometry of the photos, which are oriented and adjusted first where they are not.
    Match { project: Box<Project>, targets: Vec<PhotoTargets> },
    /// Write a project file, with the photos that come along under these names.
    Pack { content: Box<Content>, names: Vec<String> },
    /// Read a project file.
    Unpack,
    /// Run one of the papers' experiments; progress per step.
    Experiment { name: String, options: ExperimentOptions },
    /// Render a photo of the sample project and find its targets.
    SamplePhoto { name: String, max_side: u32 },
}

/// A worker's answer; every request ends with exactly one that is not progress.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Answer {
    /// The worker takes requests.
    Ready,
    /// A photo was looked into; the small picture's bytes come along.
    Opened(Box<Opened>),
    /// A decoded photo, its bytes alongside.
    Picture { width: u32, height: u32 },
    /// Targets of a photo.
    Detected(Box<Detection>),
    /// What was measured at one place.
    Measured(Option<Box<Target>>),
    /// Progress: the initial values are there, with what there is to say about them.
    Oriented { notes: Vec<Note> },
    /// Progress: an iteration is done.
    Iteration(Iteration),
    /// Progress: so many steps are done.
    Step { done: usize, of: usize },
    /// What an experiment gave.
    Experiment(Box<Experiment>),
    /// The project with its initial values, and the adjustment made from it.
    Adjusted { oriented: Box<Project>, adjustment: Box<Adjustment> },
    /// A photo of the sample project: its file's bytes and those of the small picture come along.
    SamplePhoto { opened: Box<Opened>, detection: Box<Detection> },
    /// A project file's bytes come along.
    Packed,
    /// A project, with the bytes of the photos that these names belong to.
    Unpacked { content: Box<Content>, names: Vec<String> },
    /// Names for uncoded targets.
    Matched(Box<Matching>),
    /// The engine refused.
    Failed(Box<Error>),
    /// A file could not be read, or a message not understood.
    Unreadable { detail: String },
}

impl Answer {
    /// Whether more answers to the same request will follow.
    pub fn is_progress(&self) -> bool {
        matches!(self, Self::Oriented { .. } | Self::Iteration(_) | Self::Step { .. })
    }
}

/// What a photo's file says.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Opened {
    /// Width and height in pixels.
    pub size: [u32; 2],
    pub info: PhotoInfo,
    /// Width and height of the small picture.
    pub small: [u32; 2],
    /// Tells files with the same content.
    pub digest: u64,
}

/// What a project file holds besides photos.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Content {
    pub project: Project,
    /// Targets by photo.
    pub targets: BTreeMap<String, Detection>,
    pub adjustment: Option<Adjustment>,
}
