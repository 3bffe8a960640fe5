//! Reasons of invalid input, as data: a name and the values of its sentence.
//!
//! Each reason has its English sentence; the desk translates it into every other language.

use std::fmt;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Declares the reasons: a name, the values, the sentence they make.
macro_rules! reasons {
    ($($name:ident $({ $($value:ident: $type:ty),+ })? => $sentence:literal;)+) => {
        /// Why something is not allowed where it stands.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[serde(tag = "kind", rename_all = "snake_case")]
        #[allow(missing_docs)] // the values are named by what stands in the sentence
        pub enum Reason {
            $(#[doc = $sentence] $name $({ $($value: $type),+ })?,)+
        }

        impl fmt::Display for Reason {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                match self {
                    $(Self::$name $({ $($value),+ })? => write!(f, $sentence),)+
                }
            }
        }
    };
}

reasons! {
    // The document
    NotADocument => "not a Sightline document: \"format\": \"sightline\" is missing";
    NotJson { message: String } => "not a Sightline document: {message}";
    Format { format: String, version: u32 } => "this is format \"{format}\" version {version}; only \"sightline\" version 1 is supported";
    NewerVersion { version: String } => "the document has version {version}, but this program reads version 1: open it with a newer program";
    NoVersion => "the document has no version";
    DamagedDocument { message: String } => "the document is damaged: {message}";
    OneFile { given: usize } => "this format consists of one file; {given} were given";
    InteriorModel => "the photo's own interior orientation must use the model of its camera";
    TargetDiameter => "the diameter of a target must be greater than 0";
    TargetNormal => "the normal of a target must not be 0 in all components";
    ImageSigma => "the standard error of an image observation must be greater than 0 pixels";
    DistanceEnds => "a distance needs two different points";
    DistanceLength => "a distance must be greater than 0";
    DistanceSigma => "the standard error of a distance must be greater than 0";
    RigPosition => "the standard error of a rig's positions is greater than 0";
    RigRotation => "the standard error of a rig's rotations is at least 1e-8 radians: no mount holds better";
    RigColumns => "every exposure of a rig has one place for each of its cameras, two or more; null where a camera took no photo";
    RigCamera => "the photos of one column of a rig are of one camera: another photo of the column is of another camera";
    NotFinite => "a number is not finite or too large";
    NegativeSigma => "a standard error must be 0 (fixed) or greater";
    PrincipalDistance => "the principal distance must be greater than 0";
    ParameterNotFinite => "a parameter must be a finite number";
    SensorGrid => "width and height of the sensor grid must be at least one pixel";
    PixelPitch => "the pixel pitch must be greater than 0 millimetres";
    ParameterSigma => "the a priori standard error of a parameter must be greater than 0; leave it out to hold the parameter";
    FocalLengthTwice => "f stands for fx = fy: estimate either f, or fx and fy";

    // Colours of a lens
    NoColoursMeasured => "no photo of this camera has lateral colour measured: measure red and blue of a RAW photo";
    ColoursOfAnotherGrid { photo: String } => "photo \"{photo}\" has another grid than the other photos with lateral colour: measure photos of one size";
    ColoursWithoutDistance => "lateral colour needs the principal distance, which is not known yet: orient or adjust first";
    ColoursBeyondModel { left_px: Number } => "the camera model cannot describe {left_px} pixels of the lateral colour: the distortion folds within the image, or does not come from a lens";

    // Boards of dots
    BoardSize { given: u32, needed: u32 } => "{given} is given; a board needs at least {needed} here, and at most 10000 dots";
    BoardPitch => "the pitch of a board must be greater than 0";
    BoardDiameter => "the diameter of a board's dots must be greater than 0 and less than their distance";

    // Equipment
    NoEquipment { message: String } => "not a Sightline equipment file: {message}";
    EquipmentVersion { version: u32 } => "the equipment file has version {version}, but this program reads version 1: open it with a newer program";
    EquipmentTooLong { megabytes: usize } => "the equipment file exceeds the limit of {megabytes} MB";
    BarIncomplete => "a scale bar needs a name, two ends and a unit";

    // The adjustment
    DatumPoints => "the datum needs at least three points that do not lie on one line";
    NoImage => "the iteration ended at values for which a point has no image: improve the initial values";
    StandardErrorsApart { value: Number, usual: Number } => "this standard error is {value}, but {usual} would match the accuracy of this network: they differ too much for the computation. Check digits and unit";
    PhotoAstray => "most points measured in this photo lie behind it or far outside its image: correct its position and rotation, or remove them and orient it again";
    Unmodelled { value: Number } => "unmodelled is {value}; a number of pixels from 0 is expected";
    CommonDiameter { value: Number } => "target_diameter is {value}; a finite number above 0 is expected";
    DiameterBeyondPoints { value: Number, extent: Number } => "target_diameter is {value}, but all points lie within {extent}; give it in their unit";

    // Calibrations judged
    CalibrationGrid => "a grid must have 2 to 1000 places along each side";
    CalibrationDistance => "a distance must be a finite number above 0, in the unit of the project";
    TranslationWithoutDistance => "a translation changes no direction at infinity: give a distance, or remove the rotation only";
    PhotosOfNoAdjustment => "two cameras by themselves have no photos: remove a rotation, rotation and translation, or nothing";
    NoCameraCovariance => "the adjustment has no standard errors of this camera's parameters: estimate some of them, with statistics";
    RegionWithoutRays => "the camera has too few rays in the region of the fit: use the whole image";
    CamerasOfTwoSizes => "the two cameras have images of different sizes";
    CamerasApart => "no rotation aligns the two cameras: they are not calibrations of one lens";
    EquationsOfAnother => "the equations of this document do not give the standard errors of this adjustment: adjust the document again, without robust weights and variance components of several groups";
    CameraOfSeveral => "there are several cameras: name one";
    PhotoOfCamera => "this camera has an interior orientation per photo: name a photo";

    CrossParts { given: usize, most: usize } => "parts is {given}; photos are split into 2 to {most} parts";
    CrossPhotos { given: usize, needed: usize } => "photos of this camera in the adjustment: {given}, needed: {needed}, so that each part can be calibrated separately; take more photos";
    CrossPerPhoto => "this camera has an interior orientation per photo, so parts of the photos have no common camera to compare";
    PartFails { part: usize, photos: usize, cause: Box<super::Error> } => "part {part} of the photos ({photos} of them) cannot be adjusted by itself: {cause}; take more photos that share points, or use a datum that each part determines (free, or control points in all photos)";
    PartNotConverged { part: usize, photos: usize } => "the adjustment of part {part} of the photos ({photos} of them) does not converge: take more photos, or estimate fewer parameters";
    ModelsJudgedPlainly => "data snooping, robust weights and variance components treat the misfit of a wrong model as gross errors or noise: disable gross errors first, then compare without them";

    ModelWithoutImages { missing: usize } => "image points that this model cannot describe: {missing}; a lens with such a wide angle needs opencv_fisheye";
    ModelNotConverged => "the adjustment with this model does not converge: the model does not fit the lens, or the network does not determine its parameters";
    ModelNotFitted { model: String } => "camera model {model} cannot describe the rays of this camera";

    // Epochs compared
    EpochsCount { given: usize, limit: usize } => "epochs given: {given}; from 2 to {limit} are compared";
    EpochSource { name: String } => "epoch \"{name}\" needs either a project or a list of points, not both";
    EpochNotConverged { name: String } => "the adjustment of epoch \"{name}\" did not converge: correct the project until it does, then compare";
    EpochNoSigmas { name: String } => "epoch \"{name}\" has no standard errors, so no movement can be tested: give sigma for its points, or a covariance matrix";
    EpochUnit { name: String, unit: String, expected: String } => "epoch \"{name}\" is in {unit}, but the epochs before it are in {expected}: convert it to {expected}";
    EpochUnitRatio { name: String, ratio: Number } => "lengths of epoch \"{name}\" are {ratio} times those of the first epoch: give both in one unit, or mark one as having no scale of its own";
    EpochMirrored { name: String } => "epoch \"{name}\" is a mirror image of the first: exchange two of its axes, or the sign of one";
    EpochUnlike { name: String, share: Number } => "the points of epoch \"{name}\" are arranged differently from the first epoch (median deviation over extent: {share}): check that the same names mean the same points";
    EpochNoCommon { name: String, first: String } => "epochs \"{first}\" and \"{name}\" have no common point with a name of its own: give at least four points the same names in both";
    EpochReference { name: String, given: usize, needed: usize } => "reference points common to epoch \"{name}\" and the one it is compared with: {given}, needed: {needed}; name more reference points, or measure those named in both epochs";
    EpochReferenceLine => "the reference points lie on one line and determine no rotation: add one off this line";
    EpochReferenceMany { given: usize, limit: usize } => "reference points: {given}, at most {limit} are tested together: name only those assumed to be stable";
    EpochMatrix { rows: usize, expected: usize } => "the covariance matrix has {rows} rows, or rows whose length is not {expected}: three rows and columns per point, or the lower triangle, are expected";
    EpochNotCovariance => "not a covariance matrix: it must be symmetric, and no combination of coordinates may have a negative variance";
    EpochDate { text: String } => "\"{text}\" is not a date: write it as 2026-03-14 or 2026-03-14T09:30";
    MonitoringProbability { name: String, value: Number } => "{name} is {value}; a probability above 0 is expected, at most 0.5 for the significance";
    MonitoringThresholds => "thresholds must be lengths above 0, and the warning at most the alarm";

    // Measuring on the result
    FeaturePoints { needed: usize, given: usize } => "points that this adjustment determines: {given}, needed: {needed}; add points, or measure them in more photos";
    FeaturePointMissing { name: String } => "point \"{name}\" is not determined by this adjustment: measure it in two photos or more";
    FeatureUndetermined => "the points do not determine the feature, since they lie in one place, on one line, in one plane or nearly so: add points off it";
    FeatureUnsettled => "the fit to the points did not converge: its least squares solution lies far off, as for a round feature through points of a nearly flat patch; add points apart from the others";
    FeatureNotFitted { name: String } => "\"{name}\" is not fitted to points: choose a line, a plane, a circle, a sphere or a cylinder";
    FeatureBroken { name: String } => "it depends on \"{name}\", which could not be measured";
    FeatureNoDirection => "an angle needs two directions (of lines, planes, circles, cylinders), or a point and two others";
    GivenSigma => "the standard error of a given coordinate must be greater than 0; leave it out if all have equal weight";

    // Detection
    OutsidePicture { name: String, value: Number, size: usize } => "{name} is {value}; a position in the picture lies between 0 and {size}";
    DamagedRow { value: Number } => "v is {value}, in rows that are damaged in the file";
    NotPixels { name: String, value: Number } => "{name} is {value}; a positive number of pixels is expected";
    AxisRatio { value: Number } => "min_axis_ratio is {value}; a ratio from 0.15 to 1 is expected";
    DiametersSwapped { min_diameter: Number, max_diameter: Number } => "min_diameter {min_diameter} is larger than max_diameter {max_diameter}";
    Dithered => "the picture is dithered (two levels in patterns of dots), which moved its edges by up to half a pixel: use the original in grey levels";
    Samples { samples: usize, width: usize, height: usize } => "{samples} samples do not make a picture of {width} x {height} pixels";

    // Texts and tables
    NotText => "not a text in UTF-8, UTF-16 or CP949: save it as a text file in UTF-8";
    Missing { name: String } => "{name} is missing";
    MissingField { name: String, fields: usize } => "{name} is missing (fields in this line: {fields})";
    NotANumber { name: String, text: String } => "{name} is not a number: \"{text}\"";
    NotWhole { name: String, text: String } => "{name} is not a whole number: \"{text}\"";
    NotPositive { name: String, value: Number } => "{name} is not positive: {value}";
    Negative { name: String, value: Number } => "{name} is negative: {value}";
    CommaAmongPoints { name: String, text: String } => "{name} has a comma, but the other numbers have a decimal point: \"{text}\" (write it without thousands separators)";
    PointAmongCommas { name: String, text: String } => "{name} has a point, but the other numbers have a decimal comma: \"{text}\" (write it without thousands separators)";
    NoneOf { name: String, choices: String, text: String } => "{name} is none of {choices}: \"{text}\"";
    AmbiguousNumber { name: String, text: String, decimal: String, thousands: String } => "{name} is ambiguous: \"{text}\" is {decimal} with a decimal comma and {thousands} with a thousands separator; choose the decimal sign";
    SeparatorBothWays => "the field separator may separate decimals or thousands too: save the table with semicolons or tabs, or with decimal points and a heading that names every column";
    MoreFields { fields: usize, columns: usize } => "this line has {fields} fields, but the heading names {columns} columns";
    HeadingIncomplete { name: String } => "the heading names no column {name}: name the columns id, X, Y and Z (or N, E, H)";
    HeadingTwice { name: String } => "the heading names two columns {name}";
    UnitOfCoordinates => "the heading gives a unit for the standard errors but none for the coordinates: choose the unit of the coordinates";
    GeographicHeading => "the heading names latitude and longitude: project the points into a plane system first (TM, UTM), since the adjustment is in space";
    GeographicAngle { name: String, text: String } => "{name} is an angle: \"{text}\"; project the points into a plane system first (TM, UTM), since the adjustment is in space";
    ListColumns { needed: usize, columns: usize } => "a row of this list needs at least {needed} columns; this one has {columns}";
    TooLarge { name: String, text: String } => "{name} is too large: \"{text}\"";
    Scaled { value: Number, factor: Number } => "{value} times {factor} is too large for a document; nothing was converted";
    ControlColumns { columns: usize } => "a control point needs four columns (id, X, Y, Z), but the table has {columns}";

    // The project file
    NameWithFolders => "a photo's file name must not contain folders";
    Entries { entries: usize, limit: usize } => "the archive has {entries} entries; a project file has up to {limit}";
    SameNames => "not a project file: entries of the archive have the same name";
    SharedBytes => "not a project file: entries of the archive share their bytes";
    EntryName => "the name of an entry of the archive is damaged";
    EntrySize => "this part of the project file is damaged: its size is not the stated one";
    TakesTooMuch { megabytes: u64 } => "the document would take more than {megabytes} MB of memory";
    CannotCarry { name: String } => "the identifier \"{name}\" cannot be written in this format, where it would be read as another one: rename it";
    NoProjectInside => "not a project file: the archive contains no project.json";
    DamagedEntry { message: String } => "the project file is damaged: {message}";
    Unpacks { megabytes: u64 } => "not a project file: the archive unpacks to more than {megabytes} MB";
    DamagedArchive { message: String } => "not a project file, or a damaged one ({message}): save it again with the program that made it";
    CannotPack { message: String } => "the project file cannot be written: {message}";
    CannotWriteJson { message: String } => "cannot be written as JSON: {message}";
    CannotWritePicture { message: String } => "the picture cannot be written: {message}";

    // Other programs' files
    PhotoModelerCut { part: PhotoModelerPart } => "not a PhotoModeler text export, or incomplete: {part} is missing";
    NoPixels => "the picture has no pixels";
    NotDbat => "not a DBAT project: document and input are missing";
    NoColumn { column: String } => "the format has no column {column}";
    ColumnsNotNamed { file: String } => "the columns of {file} are not named";
    Numbers { name: String, count: usize, text: String } => "{name} is not {count} numbers: \"{text}\"";
    SizeNotPositive { name: String } => "{name} needs a positive width and height";
    LensModel { model: Number } => "lens model {model} distorts the ideal point: only models that correct the measured point (from 1) are supported";
    Skew => "only a skew of 0 is supported";
    CamerasNotTold { cameras: usize } => "cameras in the project: {cameras}; the photos do not name their camera";
    Filter { text: String } => "a filter is keep or remove, not \"{text}\"";
    DamagedXml { message: String } => "the XML is damaged: {message}";
    XmlTooDeep { limit: usize } => "the XML is nested deeper than {limit} elements";
    XmlEntity { name: String } => "the XML is damaged: unknown entity {name}";
    XmlOpen { name: String } => "the XML is damaged: {name} is not closed";
    XmlEmpty => "the XML is damaged: it is empty";
    DamagedYaml { message: String } => "the YAML is damaged: {message}";
    FormatUnrecognised => "the format of these files is not recognised: name it instead of \"auto\"";
    ExpectedHere { expected: String, found: String } => "expected {expected}, found \"{found}\"";
    EndsWhere { expected: String } => "the file ends where {expected} is expected";
    NoSuchCameraModel { model: String } => "camera model {model} is not supported: calibrate with a perspective model (OpenCV, Brown) in the other program, or undistort the photos there";
    ConversionFails { model: String } => "camera model {model} cannot be fitted in this region: give the region of the picture that is used";
    ConversionTooLarge { max_px: Number } => "the camera models differ by up to {max_px} pixels: accept this with the option convert, or give the region of the picture that is used";
    RegionShape => "a region must be a polygon of at least three different points in pixels";
    CovarianceShape => "a covariance needs parameters of this camera, and a symmetric positive matrix with one row and column for each";

    // Film
    PitchMissing => "photo coordinates are in millimetres: give the camera a pixel pitch";
    ReadingSigma => "the standard error of a photo coordinate must be a number of millimetres above 0";
    TooFewMarks { measured: usize, given: usize, needed: usize } => "fiducial marks measured: {measured}, given: {given}; at least {needed} pairs of finite numbers are needed";
    MarksInOnePoint => "all fiducial marks lie in one point";
    MarksOnALine => "the fiducial marks lie on a line";
    TooFewRadii { radii: usize, distortions: usize, terms: usize } => "radii: {radii}, distortions: {distortions}; too few to determine {terms} terms";
    RadiiNotFinite => "radii and distortions must be finite numbers, not all 0";
    RadiiUndetermined { terms: usize } => "the radii do not determine {terms} terms";

    // Networks on paper and pictures of them
    Noise => "noise must be a standard deviation of 0 or more pixels";
    Margin => "the margin must be a number of pixels";
    Incidence => "the maximum incidence must be an angle in radians";
    StationNotFinite => "position and roll of a station must be finite numbers";
    StationAngles => "the angles of a station must be finite numbers";
    StationDirection => "a station needs a rotation or a point to look at";
    StationAim => "a station cannot look at itself";
    Face { index: usize } => "face {index} is not a parallelogram with a finite grey level and a grain above 0";
    Disc => "a target needs a finite centre, a direction and a diameter above 0";
    CodeRing => "a code ring has 2 to 24 sectors and no more bits than sectors";
    Exposure => "an exposure needs a point spread from 0.3 to 10 pixels, vignetting and noise from 0 to 1 and 8 or 16 bits";

    // Sheets to print
    SheetNothing => "there is nothing to print: ask for codes, dots, scale bars or a calibration field";
    SheetDiameter { value: Number } => "a dot of {value} mm cannot be printed: 0.5 to 400 mm are supported";
    SheetRuler { value: Number, length: Number } => "the ruler of {length} mm measures {value}: a value between half and twice its length is expected";
    SheetBar { value: Number } => "a scale bar of {value} mm: a length above 0 and up to a kilometre is expected";
    SheetNumbers { text: String } => "\"{text}\" is not a list of numbers: write it as 1-20, 35";
    SheetNumberUnknown { number: u32, family: usize } => "there is no code {number}: the family has the numbers 1 to {family}";
    SheetTooManyCodes { wanted: usize, family: usize } => "{wanted} codes are wanted and the family has {family}: take fewer, or a family with more bits";
    SheetTooManyTargets { limit: usize } => "these are more than {limit} targets: print them in parts";
    SheetTooMany { limit: usize } => "these are more than {limit} sheets: print them in parts";
    SheetNoRoom { value: Number, width: Number, height: Number } => "a dot of {value} mm with what belongs to it has no room on paper of {width} x {height} mm: take larger paper or smaller dots";
    SheetAdvice => "principal distance, distances and diameter must be above 0, angles below 89°";

    // Plans
    PlanCamera => "a plan needs a camera";
    FormTooMany { limit: usize } => "a form has at most {limit} targets: use fewer columns or rows";
    PlanTooLarge { limit: usize } => "targets times photos exceed {limit}: plan a part of the object";
    PlanLeastPixels => "the minimum target size must be a number of pixels from 0";
    PlanWanted => "the required accuracy must be a length above 0, with a probability from 0.5 to 0.999";
    PlanLens => "f-number, focused distance and circle of confusion must be above 0";
    PlanNothingSeen => "no photo of this camera sees four targets: use larger targets, a longer lens or fewer places without access";

    // Experiments
    ImageNoise => "the standard deviation of image coordinates must be from 0.01 to 1000 µm";
    PixelNoise => "the noise of the pixels must be a share from 0 to 0.2";
    ControlSigma => "the standard error of control coordinates must be from 1e-6 to 1000 mm";
    Rounds { limit: usize } => "at most {limit} rounds of Monte Carlo";

    // The report
    OtherAdjustment => "the result belongs to another state of the project: adjust again";

    // Arguments
    NotOfKind { name: String, expected: Expected } => "{name} is not {expected}";
    NoSuchOption { name: String, known: Names } => "there is no option \"{name}\"; the options are {known}";
    Unreadable { name: String, message: String } => "{name}: {message}";
}

/// A number in a sentence. A number that is not finite is null in JSON.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number(pub f64);

impl From<f64> for Number {
    fn from(value: f64) -> Self {
        Self(value)
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Some(self.0).filter(|value| value.is_finite()).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Option::<f64>::deserialize(deserializer).map(|value| Self(value.unwrap_or(f64::NAN)))
    }
}

/// Names, separated by commas.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Names(pub Vec<String>);

impl fmt::Display for Names {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.join(", "))
    }
}

/// Declares a choice of words: a name, its word in JSON and its English.
macro_rules! words {
    ($(#[$doc:meta])+ $enum:ident { $($name:ident = $json:literal => $english:literal;)+ }) => {
        $(#[$doc])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        pub enum $enum {
            $(#[doc = $english] #[serde(rename = $json)] $name,)+
        }

        impl $enum {
            /// All of them.
            pub const ALL: &[Self] = &[$(Self::$name),+];

            /// The word in JSON.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$name => $json,)+
                }
            }

            /// The one of this word in JSON.
            pub fn named(name: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|one| one.name() == name)
            }
        }

        impl fmt::Display for $enum {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(match self {
                    $(Self::$name => $english,)+
                })
            }
        }
    };
}

words! {
    /// A thing that has a name.
    Thing {
        Camera = "camera" => "camera";
        Photo = "photo" => "photo";
        Point = "point" => "point";
        DatumPoint = "datum point" => "datum point";
        Observation = "observation" => "observation";
        Distance = "distance" => "distance";
        Parameter = "parameter" => "parameter";
        FiducialMark = "fiducial mark" => "fiducial mark";
        Reading = "reading" => "reading";
        File = "file" => "file";
        Format = "format" => "format";
        Experiment = "experiment" => "experiment";
        Network = "network" => "network";
        Feature = "feature" => "feature";
        System = "system" => "coordinate system";
        Layer = "layer" => "layer";
        Epoch = "epoch" => "epoch";
        Group = "group" => "group";
        ScaleBar = "scale bar" => "scale bar";
        CameraModel = "camera model" => "camera model";
    }
}

words! {
    /// What is missing.
    Lack {
        Photos = "photos" => "photos";
        Points = "points" => "points";
        Observations = "observations" => "observations";
        FiducialMarks = "fiducial marks" => "fiducial marks";
        Readings = "readings" => "readings";
        Files = "files" => "files";
        Cameras = "cameras" => "cameras";
        Adjustment = "adjustment" => "result of an adjustment";
    }
}

words! {
    /// A part of PhotoModeler's text export.
    PhotoModelerPart {
        Heading = "heading" => "heading";
        Size = "picture size" => "picture size";
        Weights = "weights" => "weights";
        Camera = "camera" => "camera";
        CameraSigmas = "camera sigmas" => "camera sigmas";
        Photo = "photo" => "photo";
        Exterior = "exterior orientation" => "exterior orientation";
        ExteriorSigmas = "sigmas of the exterior orientation" => "sigmas of the exterior orientation";
        PhotoCamera = "camera of the photo" => "camera of the photo";
        PhotoCameraSigmas = "sigmas of the camera" => "sigmas of the camera";
    }
}

words! {
    /// The expected kind of an argument.
    Expected {
        Object = "object" => "an object";
        Objects = "objects" => "a list of objects";
        Function = "function" => "a function";
        Text = "text" => "text";
        Bytes = "bytes" => "bytes: a Uint8Array or an ArrayBuffer is expected";
        Samples = "samples" => "a picture, row by row: a Uint8Array or a Uint16Array is expected";
        FiniteNumber = "finite_number" => "a finite number";
        Pixels = "pixels" => "a whole number of pixels";
        Truth = "truth" => "true or false";
        TargetNumber = "target_number" => "the number of a target, 1 or larger";
        PhotoId = "photo_id" => "a photo id";
        PointId = "point_id" => "a point id";
        OneOrTwo = "one_or_two" => "a number or two";
        Role = "role" => "tie, control or check";
        NumberOrNull = "number_or_null" => "a number or null";
        ThreeOrNull = "three_or_null" => "three finite numbers or null";
        Plain = "plain" => "plain data: objects, lists, texts, numbers, true, false and null are allowed";
        Tree = "tree" => "a tree: it contains itself";
        Shallower = "shallower" => "nested at most 32 levels deep";
        Smaller = "smaller" => "small enough for an argument";
        Attached = "attached" => "available any more: its buffer was transferred";
        SigmasOrNull = "sigmas_or_null" => "three values, numbers or null, or null";
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::{Error, Place};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn reasons_travel_as_json() {
        for reason in [
            Reason::NoVersion,
            Reason::NotANumber { name: "Y".into(), text: "zwei".into() },
            Reason::NotOfKind { name: "u".into(), expected: Expected::FiniteNumber },
            Reason::PhotoModelerCut { part: PhotoModelerPart::ExteriorSigmas },
            Reason::NoSuchOption { name: "a".into(), known: Names(vec!["b".into(), "c".into()]) },
            Reason::AxisRatio { value: 1.5.into() },
            Reason::DiametersSwapped { min_diameter: 0.1.into(), max_diameter: (-0.3).into() },
        ] {
            let error = Error::Invalid { reason, at: Place::line(3) };
            let json = serde_json::to_string(&error).unwrap();
            assert_eq!(serde_json::from_str::<Error>(&json).unwrap(), error, "{json}");
        }
    }

    /// What is no finite number is what such a sentence is about: it must not keep the sentence from being told.
    #[test]
    fn numbers_that_json_has_not_travel_too() {
        let error = Error::Invalid { reason: Reason::Unmodelled { value: f64::NAN.into() }, at: Place::default() };
        let json = serde_json::to_string(&error).unwrap();
        assert_eq!(serde_json::from_str::<Error>(&json).unwrap().to_string(), error.to_string());
        assert!(error.to_string().contains("NaN"));
    }

    #[test]
    fn words_in_json_are_found_again() {
        for one in Thing::ALL {
            assert_eq!(Thing::named(one.name()), Some(*one));
            assert_eq!(serde_json::to_value(one).unwrap(), one.name());
        }
        assert!(Expected::ALL.iter().all(|one| Expected::named(one.name()) == Some(*one)));
    }
}
