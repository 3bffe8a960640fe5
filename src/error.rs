//! Errors as data: a stable code, the values of the message, and the place.
//!
//! The engine writes English in [`Display`](fmt::Display); the desk matches on the variants and says the same in its
//! user's language. A variant is never renamed, since its code is part of the JavaScript face.

mod degeneracy;
mod picture_kind;
mod reason;

use std::fmt;

use serde::{Deserialize, Serialize};

pub use degeneracy::Degeneracy;
pub use picture_kind::PictureKind;
pub use reason::{Expected, Lack, Names, Number, OtherReason, Reason, Thing};

/// Maximum number of characters of a quoted user text.
const QUOTED: usize = 120;

/// Result of every fallible function of the engine.
pub type Result<T> = std::result::Result<T, Error>;

/// Where in the user's data the error is. Empty fields are unknown or do not apply.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Place {
    /// File name, for what comes from files.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Photo identifier.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub photo: Option<String>,
    /// Point identifier.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub point: Option<String>,
    /// Camera identifier.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<String>,
    /// Line of a text file, counted from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
    /// Field of the document or option, in the spelling of the project format.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub field: Option<String>,
}

impl Place {
    /// A photo.
    pub fn photo(id: impl Into<String>) -> Self {
        Self { photo: Some(id.into()), ..Self::default() }
    }

    /// A point.
    pub fn point(id: impl Into<String>) -> Self {
        Self { point: Some(id.into()), ..Self::default() }
    }

    /// A camera.
    pub fn camera(id: impl Into<String>) -> Self {
        Self { camera: Some(id.into()), ..Self::default() }
    }

    /// A line of a text file, counted from 1.
    pub fn line(line: usize) -> Self {
        Self { line: Some(line), ..Self::default() }
    }

    /// A field, in the spelling of the project format.
    pub fn field(name: impl Into<String>) -> Self {
        Self { field: Some(name.into()), ..Self::default() }
    }

    /// The same place, with the field named.
    #[must_use]
    pub fn with_field(mut self, name: impl Into<String>) -> Self {
        self.field = Some(name.into());
        self
    }

    /// The same place, with the file named.
    #[must_use]
    pub fn with_file(mut self, name: impl Into<String>) -> Self {
        self.file = Some(name.into());
        self
    }
}

/// Cause of a rank defect of the normal equations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "cause", rename_all = "snake_case")]
pub enum Defect {
    /// Position, attitude and scale are not fixed: `missing` of 7 parameters are undetermined.
    NoDatum {
        /// Number of undetermined datum parameters.
        missing: usize,
    },
    /// A point has fewer rays than it needs.
    TooFewRays {
        /// Points concerned.
        points: Vec<String>,
    },
    /// A photo has too few points to be oriented.
    PhotoUndetermined {
        /// Photos concerned.
        photos: Vec<String>,
    },
    /// Groups of photos have too few common points to be connected.
    NotTied {
        /// The groups, each a list of photos.
        groups: Vec<Vec<String>>,
    },
    /// Camera parameters that the network cannot determine.
    ParameterUndetermined {
        /// Camera identifier.
        camera: String,
        /// Names of the parameters.
        parameters: Vec<String>,
    },
    /// A null space without a simpler description: the unknowns in it.
    Combination {
        /// Points taking part.
        points: Vec<String>,
        /// Photos taking part.
        photos: Vec<String>,
        /// Camera parameters taking part, as `camera.parameter`.
        parameters: Vec<String>,
    },
    /// All photos were taken from one place: depth and principal distance are undetermined.
    OneStation {
        /// The photos.
        photos: Vec<String>,
    },
}

/// Damage of an image file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Damage {
    /// The file ends before the picture does.
    EndsEarly,
    /// The file contains no picture.
    NoPicture,
    /// Its header is damaged.
    Header,
    /// Its palette is missing.
    NoPalette,
    /// Its header claims more pixels than its bytes can hold.
    ClaimsTooMuch {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// No row of the picture is certain to be intact.
    NoWholeRow,
    /// These rows are damaged, and all rows are required.
    Rows {
        /// First row, from 0.
        first: u32,
        /// Last row.
        last: u32,
    },
    /// The decoder failed.
    Decoder {
        /// Message of the decoder.
        message: String,
    },
}

/// An error of the engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "code", rename_all = "snake_case")]
pub enum Error {
    /// The file format is not supported.
    UnknownImageFormat {
        /// Recognised kind of file, if any.
        recognised: Option<PictureKind>,
        /// Place.
        at: Place,
    },
    /// The file is damaged or cut short.
    BrokenImage {
        /// Kind of damage.
        reason: Damage,
        /// Place.
        at: Place,
    },
    /// The decoder of a format is a separate file that could not be loaded.
    DecoderMissing {
        /// The format.
        format: String,
        /// Why it could not be loaded.
        message: String,
        /// Place.
        at: Place,
    },
    /// The size of the picture is not supported.
    ImageSize {
        /// Width in pixels.
        width: u64,
        /// Height in pixels.
        height: u64,
        /// Largest number of pixels accepted.
        limit: u64,
        /// Place.
        at: Place,
    },
    /// A document, option or file contains a value that is not allowed there.
    Invalid {
        /// What is wrong and what is expected.
        reason: Reason,
        /// Place.
        at: Place,
    },
    /// A name that does not exist.
    Unknown {
        /// Kind of thing.
        kind: Thing,
        /// Its name.
        name: String,
        /// Place.
        at: Place,
    },
    /// Two things share one identifier.
    Duplicate {
        /// Kind of thing.
        kind: Thing,
        /// The identifier.
        name: String,
        /// Place.
        at: Place,
    },
    /// The project lacks the data for the computation.
    Empty {
        /// The missing kind of items.
        what: Lack,
    },
    /// Initial values are missing.
    MissingInitialValues {
        /// Photos without position or rotation.
        photos: Vec<String>,
        /// Points without coordinates.
        points: Vec<String>,
        /// Cameras without a principal distance.
        cameras: Vec<String>,
    },
    /// The network does not determine all estimated parameters.
    RankDefect {
        /// The causes, most elementary first.
        defects: Vec<Defect>,
    },
    /// Too few control points agree with each other and with the photos to decide which of them are wrong.
    ControlDisagrees {
        /// Control points that agree.
        agreeing: Vec<String>,
        /// Control points whose measurements were all rejected.
        disagreeing: Vec<String>,
    },
    /// The initial orientation failed.
    CannotOrient {
        /// Why there are no initial values.
        reason: Degeneracy,
        /// Photos that stay without orientation.
        photos: Vec<String>,
    },
    /// Stopped by the caller.
    Cancelled,
}

impl Error {
    /// Stable name of the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            Self::UnknownImageFormat { .. } => "unknown_image_format",
            Self::BrokenImage { .. } => "broken_image",
            Self::DecoderMissing { .. } => "decoder_missing",
            Self::ImageSize { .. } => "image_size",
            Self::Invalid { .. } => "invalid",
            Self::Unknown { .. } => "unknown",
            Self::Duplicate { .. } => "duplicate",
            Self::Empty { .. } => "empty",
            Self::MissingInitialValues { .. } => "missing_initial_values",
            Self::RankDefect { .. } => "rank_defect",
            Self::ControlDisagrees { .. } => "control_disagrees",
            Self::CannotOrient { .. } => "cannot_orient",
            Self::Cancelled => "cancelled",
        }
    }

    /// Why, in a sentence without the place; for errors that carry a reason.
    pub fn detail(&self) -> Option<String> {
        match self {
            Self::BrokenImage { reason, .. } => Some(reason.to_string()),
            Self::Invalid { reason, .. } => Some(reason.to_string()),
            Self::CannotOrient { reason, .. } => Some(reason.to_string()),
            _ => None,
        }
    }

    /// Where it is, as far as one place can be named.
    pub fn place(&self) -> Place {
        match self {
            Self::UnknownImageFormat { at, .. }
            | Self::BrokenImage { at, .. }
            | Self::DecoderMissing { at, .. }
            | Self::ImageSize { at, .. }
            | Self::Invalid { at, .. }
            | Self::Unknown { at, .. }
            | Self::Duplicate { at, .. } => at.clone(),
            Self::MissingInitialValues { photos, points, cameras } => Place {
                photo: photos.first().cloned(),
                point: points.first().cloned(),
                camera: cameras.first().cloned(),
                ..Place::default()
            },
            Self::CannotOrient { photos, .. } => Place { photo: photos.first().cloned(), ..Place::default() },
            Self::RankDefect { defects } => defects.first().map(Defect::place).unwrap_or_default(),
            Self::ControlDisagrees { disagreeing, .. } => {
                Place { point: disagreeing.first().cloned(), ..Place::default() }
            }
            Self::Empty { what } => Place::field(what.name()),
            Self::Cancelled => Place::default(),
        }
    }

    /// The same error with the file named, where it has a place.
    #[must_use]
    pub fn in_file(mut self, name: &str) -> Self {
        if let Self::UnknownImageFormat { at, .. }
        | Self::BrokenImage { at, .. }
        | Self::DecoderMissing { at, .. }
        | Self::ImageSize { at, .. }
        | Self::Invalid { at, .. }
        | Self::Unknown { at, .. }
        | Self::Duplicate { at, .. } = &mut self
        {
            at.file = Some(name.to_owned());
        }
        self
    }
}

impl Defect {
    /// The first thing concerned.
    pub fn place(&self) -> Place {
        match self {
            Self::NoDatum { .. } => Place::field("datum"),
            Self::TooFewRays { points } => Place { point: points.first().cloned(), ..Place::default() },
            Self::PhotoUndetermined { photos } | Self::OneStation { photos } => {
                Place { photo: photos.first().cloned(), ..Place::default() }
            }
            Self::NotTied { groups } => {
                Place { photo: groups.get(1).and_then(|g| g.first()).cloned(), ..Place::default() }
            }
            Self::ParameterUndetermined { camera, parameters } => {
                Place { camera: Some(camera.clone()), field: parameters.first().cloned(), ..Place::default() }
            }
            Self::Combination { points, photos, parameters } => Place {
                point: points.first().cloned(),
                photo: photos.first().cloned(),
                field: parameters.first().cloned(),
                ..Place::default()
            },
        }
    }
}

/// Remedy for a file of an unsupported format: convert a RAW file to DNG, which keeps the sensor's samples.
fn remedy(kind: &PictureKind) -> &'static str {
    if kind.is_raw() {
        "convert it to DNG (Adobe DNG Converter, dnglab), which keeps the sensor's samples"
    } else {
        "convert it to JPEG, PNG or TIFF"
    }
}

/// Beginning of a quoted text: a file may be one line of megabytes.
pub fn shortened(text: &str) -> String {
    match text.char_indices().nth(QUOTED) {
        None => text.to_owned(),
        Some((end, _)) => format!("{} …", &text[..end]),
    }
}

/// At most five names, then how many more there are.
pub(crate) fn listed(names: &[String]) -> String {
    let shown = names.iter().take(5).cloned().collect::<Vec<_>>().join(", ");
    match names.len().saturating_sub(5) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = Vec::new();
        let mut add = |name: &str, value: &Option<String>| {
            if let Some(value) = value {
                parts.push(format!("{name} {value}"));
            }
        };
        add("file", &self.file);
        add("camera", &self.camera);
        add("photo", &self.photo);
        add("point", &self.point);
        add("line", &self.line.map(|line| line.to_string()));
        add("field", &self.field);
        f.write_str(&parts.join(", "))
    }
}

impl fmt::Display for Damage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::EndsEarly => f.write_str("the file ends early"),
            Self::NoPicture => f.write_str("it contains no picture"),
            Self::Header => f.write_str("its header is damaged"),
            Self::NoPalette => f.write_str("its palette is missing"),
            Self::ClaimsTooMuch { width, height } => {
                write!(f, "its header claims {width} x {height} pixels, more than its bytes can hold")
            }
            Self::NoWholeRow => f.write_str("no row of it is certain to be intact"),
            Self::Rows { first, last } => write!(f, "rows {first} to {last} are damaged"),
            Self::Decoder { message } => f.write_str(message),
        }
    }
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoDatum { missing } => write!(
                f,
                "{missing} of the 7 datum parameters (position, attitude, scale) are not fixed: add control points or a \
                 distance, or choose the minimal or the free datum"
            ),
            Self::TooFewRays { points } => write!(
                f,
                "too few rays for point {}: measure it in a second photo, give it coordinates or exclude it",
                listed(points)
            ),
            Self::PhotoUndetermined { photos } => write!(
                f,
                "too few points in photo {}: measure at least three well-spread points that other photos or the control \
                 determine, or exclude the photo",
                listed(photos)
            ),
            Self::NotTied { groups } => {
                let names = groups.iter().map(|g| listed(g)).collect::<Vec<_>>().join(" | ");
                write!(f, "groups of photos are not connected ({names}): measure common points")
            }
            Self::ParameterUndetermined { camera, parameters } => write!(
                f,
                "camera {camera}: the network does not determine {}: hold it, observe it with a standard error, or \
                 add convergent photos and photos rotated by 90°",
                listed(parameters)
            ),
            Self::Combination { points, photos, parameters } => {
                f.write_str("the network does not determine a combination of")?;
                for (kind, names) in [("points", points), ("photos", photos), ("parameters", parameters)] {
                    if !names.is_empty() {
                        write!(f, " {kind} {};", listed(names))?;
                    }
                }
                f.write_str(" hold or observe some of them, or add rays")
            }
            Self::OneStation { photos } => write!(
                f,
                "all photos were taken from one place ({}): they give neither depth nor principal distance; take photos from \
                 other places, or give control points",
                listed(photos)
            ),
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownImageFormat { recognised: Some(kind), .. } => {
                write!(f, "this is a {kind} file, which is not supported: {}", remedy(kind))?;
            }
            Self::UnknownImageFormat { .. } => {
                f.write_str("not a supported image: JPEG, PNG, TIFF or BMP of 8 or 16 bits is expected")?;
            }
            Self::BrokenImage { reason, .. } => {
                write!(f, "the picture cannot be decoded ({reason}): copy it again from the camera")?;
            }
            Self::DecoderMissing { format, message, .. } => {
                write!(
                    f,
                    "the decoder of {format} files could not be loaded ({message}): it is downloaded with the first such file, which needs a network connection once"
                )?;
            }
            Self::ImageSize { width, height, limit, .. } => {
                write!(f, "the picture has {width} x {height} pixels; from 1 to {limit} pixels are supported")?;
            }
            Self::Invalid { reason, .. } => reason.fmt(f)?,
            Self::Unknown { kind, name, .. } => write!(f, "there is no {kind} \"{name}\"")?,
            Self::Duplicate { kind, name, .. } => {
                write!(f, "the {kind} \"{name}\" occurs twice: identifiers are unique")?
            }
            Self::Empty { what } => write!(f, "the project has no {what} to work on")?,
            Self::MissingInitialValues { photos, points, cameras } => {
                f.write_str("initial values are missing: orient the project first, or give values for")?;
                for (kind, names) in [("photos", photos), ("points", points), ("cameras", cameras)] {
                    if !names.is_empty() {
                        write!(f, " {kind} {};", listed(names))?;
                    }
                }
            }
            Self::RankDefect { defects } => {
                f.write_str("the network cannot be solved: ")?;
                f.write_str(&defects.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))?;
            }
            Self::ControlDisagrees { agreeing, disagreeing } => {
                write!(
                    f,
                    "control points {} do not fit the photos and the other control points; ",
                    listed(disagreeing)
                )?;
                match agreeing.len() {
                    0 => f.write_str("none does")?,
                    n => write!(f, "only {n} do ({})", listed(agreeing))?,
                }
                f.write_str(": at least four, and half of all, must agree; check coordinates, axes, unit and names")?;
            }
            Self::CannotOrient { reason, photos } => {
                reason.fmt(f)?;
                if !photos.is_empty() {
                    write!(f, " (photos {})", listed(photos))?;
                }
            }
            Self::Cancelled => f.write_str("stopped on request")?,
        }
        let place = match self {
            Self::UnknownImageFormat { .. }
            | Self::BrokenImage { .. }
            | Self::DecoderMissing { .. }
            | Self::ImageSize { .. }
            | Self::Invalid { .. }
            | Self::Unknown { .. }
            | Self::Duplicate { .. } => self.place().to_string(),
            _ => String::new(),
        };
        if place.is_empty() { Ok(()) } else { write!(f, " ({place})") }
    }
}

impl std::error::Error for Error {}
