//! The document of the desk, what has been done to it, and undoing that.

pub mod history;
pub mod keys;
pub mod rings;
pub mod splices;

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use sightline::adjustment::{AdjustOptions, Adjustment};
use sightline::detection::Detection;
use sightline::matching::Doubtful;
use sightline::project::{Parameter, Project, Role};

pub use keys::Table;
use rings::Rings;

/// Everything that is undone and saved together. Parts are shared between states, so that a state is cheap to keep.
#[derive(Clone, Debug, Default)]
pub struct Document {
    pub project: Arc<Project>,
    /// Targets by photo.
    pub detections: Arc<BTreeMap<String, Arc<Detection>>>,
    /// Targets whose name is in doubt, from the last matching.
    pub doubtful: Arc<Vec<Doubtful>>,
    /// Code family of all photos, from the last detection.
    pub rings: Rings,
    /// A priori standard errors of parameters that are now held, by camera: restored when they are estimated again.
    pub sigmas_of_held: BTreeMap<(String, Parameter), f64>,
    /// How the next adjustment is made.
    pub options: AdjustOptions,
    /// The last adjustment, whether or not the project has changed since.
    pub result: Option<Arc<AdjustmentResult>>,
}

/// An adjustment with its input.
#[derive(Clone, Debug, PartialEq)]
pub struct AdjustmentResult {
    /// The project it was made from.
    pub input: Arc<Project>,
    /// The same with the initial values that orientation found.
    pub oriented: Arc<Project>,
    pub adjustment: Adjustment,
}

impl Document {
    /// Whether the result belongs to an earlier state of the project, or to other options.
    pub fn out_of_date(&self) -> bool {
        let same = |result: &Arc<AdjustmentResult>| {
            result.adjustment.options == self.options
                && (Arc::ptr_eq(&result.input, &self.project) || result.input.same_but_features(&self.project))
        };
        self.result.as_ref().is_some_and(|result| !same(result))
    }

    /// The result, where it belongs to the project as it is.
    pub fn current(&self) -> Option<&Arc<AdjustmentResult>> {
        self.result.as_ref().filter(|_| !self.out_of_date())
    }

    /// Whether no project is open: an opened one has a name at least.
    pub fn is_empty(&self) -> bool {
        let project = &self.project;
        let nothing = project.photos.is_empty() && project.points.is_empty() && project.name.is_empty();
        nothing && project.plan.is_none()
    }

    /// Whether nothing has changed between two states.
    pub fn same(&self, other: &Self) -> bool {
        let results = match (&self.result, &other.result) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            (None, None) => true,
            _ => false,
        };
        results
            && self.options == other.options
            && Arc::ptr_eq(&self.project, &other.project)
            && Arc::ptr_eq(&self.detections, &other.detections)
            && Arc::ptr_eq(&self.doubtful, &other.doubtful)
    }

    pub fn project_mut(&mut self) -> &mut Project {
        Arc::make_mut(&mut self.project)
    }

    pub fn detections_mut(&mut self) -> &mut BTreeMap<String, Arc<Detection>> {
        Arc::make_mut(&mut self.detections)
    }
}

/// Kind of a change, for the undo list. It is stored with the project, so the names must not change.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Change {
    PhotosAdded(usize),
    PhotoRemoved(String),
    ShotsSwapped(usize),
    PhotoSwitched(String),
    CameraEdited(String),
    CameraAssigned {
        photos: usize,
        camera: String,
    },
    TargetsDetected,
    TargetMeasured(String),
    Named(String),
    Renamed {
        from: String,
        to: String,
    },
    Moved {
        point: String,
        photo: String,
    },
    ObservationRemoved {
        point: String,
        photo: String,
    },
    ObservationSwitched {
        point: String,
        photo: String,
    },
    PointRemoved(String),
    MarksTaken(usize),
    Matched(usize),
    ControlTaken(usize),
    RoleSet(String),
    ControlEdited(String),
    CentreObserved(String),
    CentreForgotten(String),
    DistanceEdited {
        from: String,
        to: String,
    },
    DistanceAdded {
        from: String,
        to: String,
    },
    DistanceRemoved {
        from: String,
        to: String,
    },
    DistancesTaken(usize),
    DatumChosen,
    ParametersChosen(String),
    AxesExchanged,
    OptionsChosen,
    Adjusted,
    UnitSet,
    AxesSet,
    UnitConverted,
    PhotosAttached(usize),
    PhotosReplaced(usize),
    FeatureMade(String),
    FeatureRemoved(String),
    FeatureRenamed {
        from: String,
        to: String,
    },
    SystemScaled(String),
    LinesDrawn,
    LayerColoured(String),
    ReportEdited,
    PlanEdited,
    StationMoved(String),
    StationAdded(String),
    StationRemoved(String),
    PlanMade(usize),
    Opened,
    CellsEdited {
        table: Table,
        cells: usize,
    },
    RowsSwitched {
        table: Table,
        rows: usize,
        enabled: bool,
    },
    RowsDeleted {
        table: Table,
        rows: usize,
    },
    RolesSet {
        points: usize,
        role: Role,
    },
    PointsMerged {
        points: usize,
        into: String,
    },
    PointSplit {
        point: String,
        new: String,
    },
    PointsRenamed(usize),
    CamerasJoined {
        cameras: usize,
        into: String,
    },
    QuestionAnswered {
        photo: String,
    },
    CalibrationTaken {
        camera: String,
    },
    BarsTaken(usize),
    /// In histories of earlier versions.
    ColoursTaken {
        camera: String,
    },
    /// In histories of earlier versions.
    ColoursForgotten {
        camera: String,
    },
    ModelChosen {
        camera: String,
        model: String,
    },
    RigEdited,
    DotsNamed(usize),
}
