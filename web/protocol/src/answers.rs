//! Results and progress messages of tasks that have no type in the engine.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use sightline::Error;
use sightline::adjustment::{AdjustedPhoto, Adjustment, Iteration};
use sightline::calibration::{DistanceUncertainty, ProjectionUncertainty, ResidualBands};
use sightline::detection::Detection;
use sightline::exif::PhotoInfo;
use sightline::orient::Note;
use sightline::project::{Conversion, Datum, Ignored, Origin, Project};
use sightline_exchange::foreign::ImportedCamera;
use sightline_report::sheets::CodeCount;

use crate::pieces::Piece;
/// How well an adjusted camera predicts pixels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CameraJudged {
    /// Of directions, over the image, after the rotation that takes over most.
    pub uncertainty: ProjectionUncertainty,
    /// By distance.
    pub distance: Option<DistanceUncertainty>,
    /// Why there is none.
    pub why: Option<Error>,
    /// Residuals by column and row.
    pub bands: ResidualBands,
}

/// Files of other programs that were read.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Foreign {
    /// Networks, each with its origin.
    pub networks: Vec<Project>,
    /// Cameras by format.
    pub cameras: Vec<ForeignCameras>,
    /// Names of files that are none of another program's.
    pub others: Vec<String>,
    /// Those of them that are lists of points of instruments, whatever their names end with.
    pub lists: Vec<String>,
    /// Why files were not read.
    pub refused: Vec<Error>,
}

/// Cameras of files of one format.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct ForeignCameras {
    /// Format, files, what was assumed and left out.
    pub origin: Origin,
    /// The cameras.
    pub cameras: Vec<ImportedCamera>,
}

/// Files that were written for another program.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Written {
    /// Names of the files.
    pub names: Vec<String>,
    /// Cameras whose model was converted.
    pub conversions: Vec<Conversion>,
    /// Data that the format cannot hold.
    pub ignored: Vec<Ignored>,
}

/// A photo that is not read yet.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Glanced {
    /// Width and height of the small picture.
    pub small: [u32; 2],
    /// How it has to be turned for showing, 1 to 8.
    pub orientation: u8,
}

/// Metadata of a photo's file.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Opened {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// EXIF.
    pub info: PhotoInfo,
    /// Width and height of the small picture.
    pub small: [u32; 2],
    /// Tells files with the same content.
    pub digest: u64,
    /// SHA-256 of the file, which others can compute too.
    #[serde(default)]
    pub sha256: String,
}

/// A decoded photo.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Shown {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
}

/// Samples of a part of a photo.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Values {
    /// Left, top, columns and rows in pixels, as far as the photo goes.
    pub place: [u32; 4],
    /// Row by row.
    pub samples: Vec<u16>,
}

/// A report in the parts that the page shows and prints.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ReportMade {
    /// Style of printed pages.
    pub page_style: String,
    /// Style of the contents.
    pub style: String,
    /// HTML.
    pub body: String,
}

/// Where the photos of a project stand: cameras and oriented photos, without points and observations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Situated {
    /// Cameras and photos.
    pub project: Project,
    /// Standard errors of the photos and of unit weight, where the measurements determine them.
    pub adjustment: Option<Adjustment>,
}

impl Situated {
    /// Of a project with its adjusted values: what predictions are made from, and no more.
    pub fn of(oriented: Project, adjustment: Option<&Adjustment>) -> Self {
        let project = Project {
            points: Default::default(),
            observations: Default::default(),
            distances: Vec::new(),
            datum: Datum::default(),
            set_aside: Vec::new(),
            ..oriented
        };
        // Of the correlations those of the orientation are needed, the first six.
        let photo = |photo: &AdjustedPhoto| {
            let mut photo = photo.clone();
            if let Some(c) = &mut photo.correlation {
                c.names.truncate(6);
                c.matrix.truncate(6);
                c.matrix.iter_mut().for_each(|row| row.truncate(6));
            }
            photo
        };
        let adjustment = adjustment.map(|a| Adjustment {
            sigma0: a.sigma0,
            photos: a.photos.iter().map(photo).collect(),
            ..Adjustment::default()
        });
        Self { project, adjustment }
    }
}

/// On the way to an adjustment.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Adjusting {
    /// Initial values are available, with notes about them.
    Oriented(Vec<Note>),
    /// An iteration is done.
    Iteration(Iteration),
}

/// The project with its initial values, and the adjustment made from it: their texts come along, the one's pieces before the other's.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Adjusted {
    /// The project that was adjusted.
    pub oriented: Vec<Piece>,
    /// Its result.
    pub adjustment: Vec<Piece>,
}

/// Start of a plan.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum PlanOf {
    /// The network of one of the papers' experiments.
    Example(String),
    /// Whether a project has measurements.
    Project(Box<Project>),
}

/// Sheets of targets, one of them as it looks.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Drawn {
    /// Contents of each sheet.
    pub titles: Vec<String>,
    /// Small pictures of the first sheets.
    pub sketches: Vec<String>,
    /// The sheet that is shown, or the last where there are fewer.
    pub svg: String,
    /// Codes on the sheets.
    pub codes: usize,
    /// Plain dots.
    pub dots: usize,
    /// Pairs of scale-bar ends.
    pub bars: usize,
    /// How many codes the family has at each distance.
    pub counts: Vec<CodeCount>,
    /// Smallest distance of two codes on the sheets.
    pub least_distance: Option<u32>,
    /// Scale of the print across and down.
    pub scale: [f64; 2],
    /// Its standard error.
    pub scale_sigma: f64,
    /// Diameter of the dots on paper, mm.
    pub diameter: f64,
}

/// A photo of the sample project.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SamplePhotoMade {
    /// Metadata of its file.
    pub opened: Opened,
    /// Its targets.
    pub detection: Detection,
}

/// A project file's content, and the names that its photos' bytes belong to.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Unpacked {
    /// All but photos.
    pub content: Content,
    /// Of the photos.
    pub names: Vec<String>,
    /// Where the bytes of each photo begin in the file, and how many they are; nothing for one that was packed.
    pub places: Vec<Option<(u64, u64)>>,
    /// Damaged contents that are left out.
    pub damaged: Vec<Error>,
}

/// Contents of a project file besides photos.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Content {
    /// The document.
    pub project: Project,
    /// Targets by photo.
    pub targets: BTreeMap<String, Detection>,
    /// Of the document.
    pub adjustment: Option<Adjustment>,
}
