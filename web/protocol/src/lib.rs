//! Messages between page and workers. A task, its progress messages and its result belong together by
//! type; pictures and files travel beside these as bytes.

mod answers;
mod inside;
mod pieces;

use std::collections::BTreeMap;
use std::io::{Read, Seek};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use sightline::adjustment::{AdjustOptions, Adjustment, Measured};
use sightline::calibration::{ComparedModel, Coverage, CrossOptions, CrossValidation, ModelConversion, ModelsOptions};
use sightline::comparison::Comparison;
use sightline::detection::{ColoursApart, DetectOptions, Detection, Target};
use sightline::matching::{
    Board, GridNaming, GridOptions, Matching, PhotoTargets, PhotoVectors, PredictOptions, Prediction,
};
use sightline::monitoring::{Epoch, Monitoring, Options as MonitoringOptions, Pair};
use sightline::orient::Note;
use sightline::project::{Camera, Plan, Project, ReportSettings};
pub use sightline::tiles::Pyramid;
use sightline::{Error, Result};
use sightline_exchange::foreign::CameraOptions;
use sightline_lab::experiments::{Experiment, ExperimentOptions};
use sightline_plan::{Criterion, Made, MakeOptions, Prediction as PlanPrediction, Suggested};
use sightline_report::plots::Plot;
use sightline_report::sheets::SheetOptions;

pub use answers::{
    Adjusted, Adjusting, CameraJudged, Content, Drawn, Foreign, ForeignCameras, Glanced, Opened, PlanOf, ReportMade,
    SamplePhotoMade, Shown, Situated, Unpacked, Values, Written,
};
pub use inside::{Found, Inquiry, InsideOf, Looked, Places, factor_bytes, factor_from, matrices, matrices_from};
pub use pieces::{Long, Piece, from_pieces, written};

/// Work for a worker. The files it needs come with it.
pub trait Task: Serialize + DeserializeOwned + 'static {
    /// Text while it is running.
    type Progress: Serialize + DeserializeOwned + 'static;
    /// Its end.
    type Answer: Serialize + DeserializeOwned + 'static;
}

/// A worker's word on a task; every task ends with exactly one that is not progress.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Said<P, A> {
    /// It goes on.
    Progress(P),
    /// It is done.
    Done(A),
    /// The engine refused.
    Refused(Box<Error>),
    /// A file that came with it could not be read.
    Unreadable(String),
}

/// Message to a task.
pub type SaidTo<T> = Said<<T as Task>::Progress, <T as Task>::Answer>;

/// Progress of a task without progress messages.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Nothing {}

/// Sends progress of a task.
pub type Progress<'a, P> = &'a mut dyn FnMut(P);
/// Sends a word on a task, with the bytes that belong to it.
pub type Say<'a> = &'a mut dyn FnMut(Vec<u8>, Vec<Vec<u8>>);
/// A file that came with a task.
pub enum Given {
    /// Its bytes.
    Whole(Vec<u8>),
    /// Read where it is, in pieces: it may be larger than all memory.
    Stream(Box<dyn Stream>),
}

/// A file that is read in pieces.
pub trait Stream: Read + Seek {}
impl<S: Read + Seek> Stream for S {}

/// The answer to a task, with the bytes that belong to it.
pub type Served<A> = Result<(A, Vec<Vec<u8>>)>;

/// The worker of a task, with its files.
pub trait Service<T: Task> {
    /// Does it.
    ///
    /// # Errors
    /// Those of the engine.
    fn serve(&self, task: T, files: Vec<Given>, progress: Progress<T::Progress>) -> Served<T::Answer>;
}

/// The tasks with their types, by the part of the workers' module that does them; the request that carries any of them; and the way of
/// each to its own service.
macro_rules! tasks {
    ($(
        $(#[$about:meta])*
        $part:ident { $($(#[$doc:meta])* $task:ident $fields:tt => $progress:ty, $answer:ty;)* }
    )*) => {
        $(
            $(
                $(#[$doc])*
                #[derive(Clone, Debug, Serialize, Deserialize)]
                pub struct $task $fields

                impl Task for $task {
                    type Progress = $progress;
                    type Answer = $answer;
                }

                impl From<$task> for Request {
                    fn from(task: $task) -> Self {
                        Self::$part($part::$task(Box::new(task)))
                    }
                }
            )*

            $(#[$about])*
            #[derive(Clone, Debug, Serialize, Deserialize)]
            #[expect(missing_docs, reason = "each is the task of its name")]
            pub enum $part {
                $($task(Box<$task>),)*
            }

            impl $part {
                /// Tag by which a worker recognises a request before reading it.
                pub const NAME: &str = stringify!($part);

                /// Has the task done; `say` gets each word on it, written, with the bytes that belong to it.
                pub fn serve<S>(self, by: &S, files: Vec<Given>, say: Say)
                where
                    $(S: Service<$task>,)*
                {
                    match self {
                        $(Self::$task(task) => serve(by, *task, files, say),)*
                    }
                }
            }
        )*

        /// Any task.
        #[derive(Clone, Debug)]
        #[expect(missing_docs, reason = "each is a part of the tasks")]
        pub enum Request {
            $($part($part),)*
        }

        impl Request {
            /// The name of its part, and the request as bytes.
            pub fn written(&self) -> (&'static str, Vec<u8>) {
                match self {
                    $(Self::$part(request) => ($part::NAME, to_bytes(request)),)*
                }
            }
        }
    };
}

impl Request {
    /// Whether its files are read in pieces: they may be too large to be held, or little of them is wanted.
    pub fn streams(&self) -> bool {
        matches!(self, Self::Photos(Photos::Glance(_)) | Self::Networks(Networks::Pack(_) | Networks::Unpack(_)))
    }

    /// Whether it takes what no other photo takes: it works on a document, or makes a whole photo ready for the screen.
    pub fn is_apart(&self) -> bool {
        let document = matches!(self, Self::Networks(Networks::Pack(_) | Networks::Unpack(_) | Networks::Adjust(_)));
        document || matches!(self, Self::Photos(Photos::ShowPhoto(_)))
    }
}

impl Photos {
    /// Whether the bytes of its answer are pictures of tiles ([`Pyramid`]): the worker makes of them what a canvas draws, for
    /// that holds up whoever does it.
    pub fn draws(&self) -> bool {
        matches!(self, Self::ShowPhoto(_))
    }
}

/// The word that a file of a task could not be read.
pub fn unreadable(detail: String) -> Vec<u8> {
    to_bytes(&Said::<Nothing, Nothing>::Unreadable(detail))
}

fn serve<T: Task>(by: &impl Service<T>, task: T, files: Vec<Given>, say: Say) {
    let outcome =
        by.serve(task, files, &mut |progress| say(to_bytes::<SaidTo<T>>(&Said::Progress(progress)), Vec::new()));
    match outcome {
        Ok((answer, bytes)) => say(to_bytes::<SaidTo<T>>(&Said::Done(answer)), bytes),
        Err(error) => say(to_bytes::<SaidTo<T>>(&Said::Refused(Box::new(error))), Vec::new()),
    }
}

/// A message as bytes: a long text would be turned into JavaScript's form and back on the way.
pub fn to_bytes<M: Serialize>(message: &M) -> Vec<u8> {
    to_text(message).into_bytes()
}

/// A message from its bytes.
///
/// # Errors
/// Where they are another message's: what was found.
pub fn from_bytes<M: DeserializeOwned>(bytes: &[u8]) -> std::result::Result<M, String> {
    serde_json::from_slice(bytes).map_err(|error| error.to_string())
}

/// A message as text.
pub fn to_text<M: Serialize>(message: &M) -> String {
    // Fails for types that JSON has no form for, which no message holds; the other side tells an empty text.
    serde_json::to_string(message).unwrap_or_default()
}

/// A message from its text.
///
/// # Errors
/// Where the text is another message's: what was found.
pub fn from_text<M: DeserializeOwned>(text: &str) -> std::result::Result<M, String> {
    // One way for both: what reads a document is large.
    from_bytes(text.as_bytes())
}

tasks! {
    /// Tasks of a photo.
    Photos {
        /// Find the picture that is embedded in a photo's file, without reading the file; its bytes come along.
        Glance { /** Longest side of the small picture. */ pub max_side: u32 } => Nothing, Option<Glanced>;
        /// Look into a photo: size, EXIF, a small picture, whose bytes come along.
        Open { /** Longest side of the small picture. */ pub max_side: u32 } => Nothing, Opened;
        /// Decode a photo for the screen; the bytes of its tiles come along, level by level.
        ShowPhoto {} => Nothing, Pyramid;
        /// The samples of a rectangle of a photo as they are stored.
        ShowValues {
            /** Of the file. */ pub digest: u64,
            /** Left, top, columns and rows in pixels. */ pub place: [u32; 4],
        } => Nothing, Values;
        /// Find the targets of a photo.
        Detect { /** How. */ pub options: DetectOptions } => Nothing, Detection;
        /// Measure the targets of a photo in every colour.
        MeasureColours { /** How. */ pub options: DetectOptions } => Nothing, ColoursApart;
        /// Measure at one place of a photo; by the file's digest a worker knows the photos that it decoded last.
        Measure {
            /** Of the file. */ pub digest: u64,
            /** Pixels to the right. */ pub u: f64,
            /** Pixels down. */ pub v: f64,
            /** How. */ pub options: DetectOptions,
        } => Nothing, Option<Target>;
        /// Cut a part out of a photo, for the screen; its bytes come along.
        ShowPart {
            /** Of the file. */ pub digest: u64,
            /** First column. */ pub left: u32,
            /** First row. */ pub top: u32,
            /** Columns and rows. */ pub side: u32,
        } => Nothing, Shown;
    }

    /// Tasks after the detection and all others: few in a session, but they use most of the engine.
    Networks {
        /// Orient what is not oriented and adjust; progress per iteration. The project's text is given as files, in pieces; those of what is oriented and
        /// of the adjustment come along in pieces.
        Adjust { /** The project, a file each. */ pub project: Vec<Piece>, /** How. */ pub options: AdjustOptions } => Adjusting, Adjusted;
        /// Give a camera another model.
        ConvertCamera {
            /** The camera, and its photos as far as they have interior orientations of their own. */ pub project: Project,
            /** Which. */ pub camera: String,
            /** Name of the model. */ pub model: String,
        } => Nothing, (Project, ModelConversion);
        /// Adjust a network with every camera model, oriented first where it is not.
        CompareModels { /** The network. */ pub project: Project, /** Whose, and how. */ pub options: ModelsOptions } => Nothing, Vec<ComparedModel>;
        /// Calibrate a camera from parts of the photos and compare the parts; the network is oriented first where it is not.
        CrossValidate { /** The network. */ pub project: Project, /** Whose, and how. */ pub options: CrossOptions } => Nothing, CrossValidation;
        /// How well an adjusted camera predicts where a point appears, by place and by distance, and its residuals by column and row.
        JudgeCamera {
            /** Oriented, as it was adjusted. */ pub project: Project,
            /** With standard errors of the camera. */ pub adjustment: Adjustment,
            /** Which. */ pub camera: String,
        } => Nothing, CameraJudged;
        /// Coverage of the image by the targets of a camera's photos.
        CoverPhotos { /** The photos. */ pub project: Project, /** Of which camera. */ pub camera: String } => Nothing, Coverage;
        /// Measure the features of a project at the values that an adjustment with these options gave it.
        MeasureFeatures { /** With the adjusted values. */ pub project: Project, /** Of the adjustment. */ pub options: AdjustOptions } => Nothing, Measured;
        /// Name the dots of a board of circles.
        NameGrid {
            /** Of the photos. */ pub project: Project,
            /** Of each photo. */ pub targets: Vec<PhotoTargets>,
            /** Which. */ pub board: Board,
            /** The first dot, where it was shown. */ pub options: GridOptions,
        } => Nothing, GridNaming;
        /// Name uncoded targets by the geometry of the photos, which are oriented and adjusted first where they are not.
        Match {
            /** Of the photos. */ pub project: Project,
            /** Of each photo. */ pub targets: Vec<PhotoTargets>,
        } => Vec<Note>, Matching;
        /// Find where the photos of a project stand, as far as its measurements determine it.
        Situate { /** Measurements and what is known. */ pub project: Project, /** Of the adjustment. */ pub options: AdjustOptions } => Nothing, Situated;
        /// Predict where a point should be in every oriented photo.
        Predict {
            /** Cameras, oriented photos, the point and its observations. */ pub project: Project,
            /** Standard errors of the photos. */ pub adjustment: Option<Adjustment>,
            /** Which. */ pub point: String,
            /** Of the prediction. */ pub options: PredictOptions,
        } => Nothing, Prediction;
        /// Write a project file with the photos that come along: the parts before, between and after them are returned.
        Pack { /** All but photos. */ pub content: Content, /** Of the photos. */ pub names: Vec<String> } => Nothing, ();
        /// Read a project file; the bytes of photos that were packed come along.
        Unpack {} => Nothing, Unpacked;
        /// Write a foreign format; the files' bytes come along, in the order of their names.
        Export {
            /** Its name. */ pub format: String,
            /** What. */ pub project: Project,
            /** Of the project, where there is one. */ pub adjustment: Option<Adjustment>,
        } => Nothing, Vec<String>;
        /// Sort files by content and read those of other programs.
        ReadForeign {
            /** Names of the files. */ pub names: Vec<String>,
            /** Width and height of the open project's photos by their files. */ pub sizes: BTreeMap<String, [u32; 2]>,
            /** Whether a camera is taken whose model differs by more than 1 px after conversion. */ pub convert: bool,
        } => Nothing, Foreign;
        /// Write a camera for another program; the files' bytes come along, in the order of their names.
        WriteCamera {
            /** Name of the format. */ pub format: String,
            /** The camera. */ pub camera: Camera,
            /** Region, covariance, and whether a difference of more than 1 px is accepted. */ pub options: CameraOptions,
        } => Nothing, Written;
        /// Write a network for another program; the files' bytes come along, in the order of their names.
        WriteNetwork {
            /** Name of the format. */ pub format: String,
            /** The project. */ pub project: Project,
            /** Its result, if there is one. */ pub adjustment: Option<Adjustment>,
            /** Whether a difference of more than 1 px is accepted. */ pub convert: bool,
        } => Nothing, Written;
        /// Make the report of a project.
        MakeReport {
            /** Adjusted, with what its report says. */ pub project: Project,
            /** Its result. */ pub adjustment: Adjustment,
        } => Nothing, ReportMade;
        /// Draw the plots of a result.
        MakePlots {
            /** Adjusted, with the language of its report. */ pub project: Project,
            /** Its result. */ pub adjustment: Adjustment,
            /** What the result before was made from, and that result, where there was one. */ pub before: Option<(Project, Adjustment)>,
        } => Nothing, Vec<Plot>;
        /// Set a result beside the one before.
        CompareResults {
            /** Inputs of the earlier result. */ pub before: Project,
            /** The earlier result. */ pub earlier: Adjustment,
            /** Inputs of the later result. */ pub after: Project,
            /** The later result. */ pub later: Adjustment,
        } => Nothing, Comparison;
        /// Compare epochs of an object; progress in steps done of all.
        CompareEpochs { /** The first is the reference. */ pub epochs: Vec<Epoch>, /** How. */ pub options: MonitoringOptions } => (usize, usize), Monitoring;
        /// Write what a comparison of epochs found as a file: csv, json, dxf or gltf.
        ExportMonitoring {
            /** What was found. */ pub found: Monitoring,
            /** Which file. */ pub format: String,
            /** The pair that is drawn. */ pub pair: usize,
            /** Times the length of displacements in the drawing. */ pub factor: f64,
        } => Nothing, ();
        /// Displacements of a pair of epochs in the photos of one of them.
        DisplacePhotos {
            /** The epoch. */ pub project: Project,
            /** Its adjustment. */ pub adjustment: Adjustment,
            /** The pair. */ pub pair: Pair,
            /** Times the length of displacements. */ pub factor: f64,
        } => Nothing, Vec<PhotoVectors>;
        /// Make the report of a comparison of epochs.
        ReportEpochs {
            /** What was found. */ pub found: Monitoring,
            /** How. */ pub options: MonitoringOptions,
            /** Language, paper and what the first page says. */ pub settings: ReportSettings,
        } => Nothing, ReportMade;
        /// Three epochs of the sample that is monitored, each simulated and adjusted; progress in epochs done of all.
        SampleEpochs {} => (usize, usize), Vec<Epoch>;
        /// Run one of the papers' experiments; progress in steps done of all.
        RunExperiment {
            /** Which. */ pub name: String,
            /** Its inputs. */ pub options: ExperimentOptions,
        } => (usize, usize), Experiment;
        /// Write an experiment's tables: the file of this name, or all of them in an archive.
        ExportExperiment {
            /** What was run. */ pub experiment: Experiment,
            /** One file. */ pub only: Option<String>,
        } => Nothing, ();
        /// A plan to begin with.
        BeginPlan { /** Of what. */ pub of: PlanOf } => Nothing, Plan;
        /// Predict what a plan gives, and the other plans beside it.
        PredictPlan { /** The plan. */ pub plan: Plan } => Nothing, Vec<PlanPrediction>;
        /// The best places for the next photo; progress in places tried of all.
        SuggestPhoto { /** Of the plan. */ pub plan: Plan, /** The best by what. */ pub criterion: Criterion } => (usize, usize), Vec<Suggested>;
        /// Make a plan that reaches what is wanted.
        MakePlan { /** What is wanted of what. */ pub plan: Plan, /** How. */ pub options: MakeOptions } => (usize, usize), Made;
        /// Draw sheets of targets to print.
        DrawSheets { /** What. */ pub options: SheetOptions, /** The sheet that is shown, from 0. */ pub sheet: usize } => Nothing, Drawn;
        /// Write sheets: as a PDF, one as SVG, or the lists that go with them; the files' bytes come along.
        WriteSheets {
            /** What. */ pub options: SheetOptions,
            /** As a PDF. */ pub pdf: bool,
            /** This sheet as SVG. */ pub svg: Option<usize>,
        } => Nothing, Vec<String>;
        /// Lay an adjustment open after so many steps. Matrices and numbers come along as bytes ([`matrices`]); the answer's own are empty.
        LookInside {
            /** What. */ pub of: InsideOf,
            /** Steps taken. */ pub step: usize,
            /** Whether names, blocks and their order come along; they are the same in every step. */ pub names: bool,
        } => Nothing, Looked;
        /// Explain, compare or simulate something of it.
        Inquire { /** Of what. */ pub of: InsideOf, /** What. */ pub inquiry: Inquiry } => Nothing, Found;
        /// Write its matrices as files in an archive, whose bytes come along.
        ExportInside { /** Of what. */ pub of: InsideOf } => Nothing, ();
        /// The sample project, without its photos.
        Sample {} => Nothing, Project;
        /// Render a photo of the sample project and find its targets; its file and its small picture come along.
        SamplePhoto {
            /** Of the file. */ pub name: String,
            /** Longest side of the small picture. */ pub max_side: u32,
        } => Nothing, SamplePhotoMade;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_of_another_task_is_not_taken_for_an_answer() {
        let shown = to_text::<SaidTo<ShowPart>>(&Said::Done(Shown { width: 3, height: 2 }));
        assert!(matches!(from_text::<SaidTo<ShowPart>>(&shown), Ok(Said::Done(Shown { width: 3, height: 2 }))));
        assert!(from_text::<SaidTo<Detect>>(&shown).is_err());
        assert!(from_text::<SaidTo<ShowPart>>("").is_err());
    }

    #[test]
    fn requests_come_back_as_they_went() {
        let request =
            Request::from(Measure { digest: u64::MAX, u: 0.1 + 0.2, v: 1.0 / 3.0, options: DetectOptions::default() });
        let (part, bytes) = request.written();
        assert_eq!(part, Photos::NAME);
        let Photos::Measure(task) = from_bytes::<Photos>(&bytes).expect("a request") else { panic!("another task") };
        assert_eq!((task.digest, task.u, task.v), (u64::MAX, 0.1 + 0.2, 1.0 / 3.0));
    }

    #[test]
    fn that_a_file_is_unreadable_is_understood_by_every_task() {
        let said = unreadable("gone".into());
        assert!(matches!(from_bytes::<SaidTo<ShowPhoto>>(&said), Ok(Said::Unreadable(detail)) if detail == "gone"));
        assert!(matches!(from_bytes::<SaidTo<Adjust>>(&said), Ok(Said::Unreadable(_))));
    }
}
