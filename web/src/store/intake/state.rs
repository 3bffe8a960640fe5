//! State of incoming files: what is being read, what was rejected, what waits to be taken.

use std::collections::VecDeque;

use leptos::prelude::*;
use sightline::Error;

use super::super::control::Pasted;
use super::super::distance_list::DistanceFile;
use super::super::identity::Marks;
use super::super::texts::NextList;
use crate::browser::picture::Picture;
use crate::i18n::{errors, interchange, monitoring, text};

/// A photo that is being read; it is added to the project when it has been read completely.
#[derive(Clone)]
pub struct Coming {
    pub name: String,
    /// The preview in its file, and the orientation for display.
    pub picture: Option<(Picture, u8)>,
}

/// A rejected file.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    pub file: String,
    pub reason: Reason,
}

/// Why a file was rejected.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// The engine refused it.
    Engine(Error),
    /// The same content as another photo.
    Duplicate { of: String },
    /// The name of a photo of the project, with other content or content that cannot be compared: the user is asked.
    SameName { of: String },
    /// A developed photo whose RAW file is in the project.
    Developed { of: String },
    /// A RAW file whose developed photo is in the project.
    RawOf { of: String },
    /// The browser could not read it, or its worker was lost.
    Unreadable(String),
    /// The file is empty.
    Empty,
    /// Another project was opened from the same drop.
    AnotherProject,
    /// A text in none of the supported list formats.
    NoList,
    /// A project without an adjustment cannot be an epoch.
    EpochNotAdjusted,
    /// A project that has changed since its adjustment cannot be an epoch.
    EpochOutOfDate,
}

/// Why a file was rejected, as a sentence.
pub fn problem_sentence(reason: &Reason) -> String {
    match reason {
        Reason::Engine(error) => errors::sentence(error),
        Reason::Duplicate { of } => text::duplicate_of(of),
        Reason::SameName { of } => text::same_name_as(of),
        Reason::Developed { of } => text::developed_of(of),
        Reason::RawOf { of } => text::raw_of(of),
        Reason::Unreadable(detail) => text::unreadable(detail),
        Reason::AnotherProject => interchange::another_project().to_owned(),
        Reason::Empty => text::is_empty().to_owned(),
        Reason::NoList => text::is_no_list().to_owned(),
        Reason::EpochNotAdjusted => monitoring::not_adjusted().to_owned(),
        Reason::EpochOutOfDate => monitoring::adjusted_before().to_owned(),
    }
}

/// Signals of incoming files.
#[derive(Clone, Copy, Default)]
pub struct Intake {
    /// Photos that are being read.
    pub coming: RwSignal<Vec<Coming>, LocalStorage>,
    /// Rejected files.
    pub problems: RwSignal<Vec<Problem>>,
    /// Image coordinates of an earlier measurement, to be confirmed by the user.
    pub marks: RwSignal<Option<Marks>>,
    /// List of control points, to be confirmed by the user.
    pub pasted: RwSignal<Option<Pasted>>,
    /// List of distances, to be confirmed by the user.
    pub distances: RwSignal<Option<DistanceFile>>,
    /// Further lists of the same drop: each is shown when the one before is imported or discarded.
    pub next_lists: RwSignal<VecDeque<NextList>>,
}
