//! Result of naming a board's dots.

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};

use crate::error::Number;
use crate::project::{Observation, Point};

/// Options of [`name_grid`](super::name_grid).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct GridOptions {
    /// By photo, the place in pixels of (or next to) the board's first dot, for boards that look the same when turned. One photo is
    /// enough: the same turn against the upright one is then taken in all photos.
    pub first: BTreeMap<String, [f64; 2]>,
}

/// How the first dot of a board was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GridOrientation {
    /// The dots alone decide.
    Unique,
    /// The mark beside the board decides.
    Mark,
    /// [`GridOptions::first`] decides, in this photo or in another one.
    Given,
    /// The board looks the same when turned, and the first corner is unknown: that turn is taken whose rows run to the right
    /// as nearly as they can. Right if the camera was held the same way up in all photos.
    Assumed,
}

/// A photo whose board was named.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NamedGrid {
    /// Identifier of the photo.
    pub photo: String,
    /// Named dots.
    pub dots: usize,
    /// Dots of the board that the photo does not show.
    pub missing: usize,
    /// Dots that were observed under another name before: they keep it.
    pub named_before: usize,
    /// How the first dot was found.
    pub orientation: GridOrientation,
    /// Turns under which the board looks the same, this one included; 1 where the dots decide.
    pub turns: usize,
    /// Whether the position on the board was found from background without dots beside it; false: from the dots themselves.
    pub by_border: bool,
}

/// Why the dots of a photo were not named.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum UnnamedReason {
    /// No dots in rows and columns.
    NoGrid {
        /// Targets of the photo.
        targets: usize,
    },
    /// A grid that the board has no part like.
    NotThisBoard {
        /// Dots of the largest grid.
        dots: usize,
    },
    /// The visible part fits the board at several positions.
    Ambiguous {
        /// Dots of the grid.
        dots: usize,
        /// Places on the board where it may lie.
        places: usize,
    },
    /// Several grids that may be the board.
    SeveralBoards {
        /// How many.
        count: usize,
    },
    /// The photo cuts the board off, or something hides an end of it, and other dots like its own are in the photo: they may be the rest of
    /// it, or this may be another board.
    OtherDots {
        /// Dots of the grid.
        dots: usize,
        /// Other dots of their size.
        others: usize,
    },
    /// The mark at the first corner is not visible, or targets are visible at several of its possible positions.
    Mark {
        /// Places of the mark where a target is seen.
        seen: usize,
    },
    /// The dots are of another size than the board's.
    Diameter {
        /// Diameter of the dots by the pitch, in the unit of the project.
        seen: Number,
        /// Diameter given.
        given: Number,
    },
}

impl fmt::Display for UnnamedReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoGrid { targets } => {
                write!(
                    f,
                    "no grid of dots among the {targets} targets: show at least 3 by 3 neighbouring dots of the board"
                )
            }
            Self::NotThisBoard { dots } => {
                write!(f, "the grid of {dots} dots is no part of this board: check rows, columns and kind")
            }
            Self::Ambiguous { dots, places } => write!(
                f,
                "the {dots} visible dots fit {places} places of the board: take a photo that shows more of its dots or its corners"
            ),
            Self::SeveralBoards { count } => {
                write!(f, "{count} grids in the photo may be the board: cover the others, or take a photo of one board")
            }
            Self::OtherDots { dots, others } => write!(
                f,
                "an end of the grid of {dots} dots is not in the photo and {others} other dots of their size are: show the whole board, or cover what is beside it"
            ),
            Self::Mark { seen } => {
                write!(f, "targets in the places where the corner mark may be: {seen}; exactly one of them is expected")
            }
            Self::Diameter { seen, given } => {
                write!(
                    f,
                    "the dots have a diameter of {seen} by the pitch and the board's are {given}: check pitch, diameter and kind"
                )
            }
        }
    }
}

/// A photo whose dots were not named.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Unnamed {
    /// Identifier of the photo.
    pub photo: String,
    /// Why.
    pub reason: UnnamedReason,
    /// The same as a sentence.
    pub sentence: String,
}

/// Result of [`name_grid`](super::name_grid).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct GridNaming {
    /// Prefix of the names: empty, or "b2-", "b3-" … where the project has other points of these names.
    pub prefix: String,
    /// Dots seen in a photo that the project has no point for, row by row.
    pub points: Vec<Point>,
    /// Observations that the project does not have yet.
    pub observations: Vec<Observation>,
    /// Photos whose board was named, in the order given.
    pub named: Vec<NamedGrid>,
    /// Photos whose dots were not named.
    pub unnamed: Vec<Unnamed>,
}
