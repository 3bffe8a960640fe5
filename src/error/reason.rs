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
        #[allow(missing_docs)] // the values are documented by the sentence
        pub enum Reason {
            $(#[doc = $sentence] $name $({ $($value: $type),+ })?,)+
            /// A reason that a crate above the engine declares.
            #[serde(untagged)]
            Other(OtherReason),
        }

        impl fmt::Display for Reason {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                match self {
                    $(Self::$name $({ $($value),+ })? => write!(f, $sentence),)+
                    Self::Other(other) => other.fmt(f),
                }
            }
        }
    };
}

/// A reason that a crate above the engine declares with [`declare_reasons!`](crate::declare_reasons): the engine carries it and does not know it. In
/// JSON it is like any other, its name under `kind` and its values beside; the sentence is not stored, and the crate that declared it writes it again.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct OtherReason {
    /// Its name.
    pub kind: String,
    /// Its values.
    #[serde(flatten)]
    pub values: serde_json::Map<String, serde_json::Value>,
    /// Its English sentence; empty if it came as JSON.
    #[serde(skip)]
    pub sentence: String,
}

impl PartialEq for OtherReason {
    fn eq(&self, other: &Self) -> bool {
        self.kind == other.kind && self.values == other.values
    }
}

impl fmt::Display for OtherReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.sentence.is_empty() {
            return f.write_str(&self.sentence);
        }
        f.write_str(&self.kind)?;
        self.values.iter().try_for_each(|(name, value)| write!(f, ", {name}: {value}"))
    }
}

impl Reason {
    /// The reason of a crate above the engine as data.
    pub fn other<R: Serialize + fmt::Display>(reason: &R) -> Self {
        let values = match serde_json::to_value(reason) {
            Ok(serde_json::Value::Object(values)) => values,
            _ => serde_json::Map::new(),
        };
        let mut values = values;
        let kind = match values.remove("kind") {
            Some(serde_json::Value::String(kind)) => kind,
            _ => String::new(),
        };
        Self::Other(OtherReason { kind, values, sentence: reason.to_string() })
    }

    /// The reason again as the crate that declared it knows it, if it is one of `R`.
    pub fn as_other<R: for<'de> Deserialize<'de>>(&self) -> Option<R> {
        let Self::Other(other) = self else { return None };
        serde_json::from_value(serde_json::to_value(other).ok()?).ok()
    }
}

/// Declares the reasons of a crate above the engine: an enum whose values become a [`Reason`](crate::error::Reason) by `into()`, and come back from one by `of`.
/// Names are unique among all crates, since they share one `kind` in JSON.
#[macro_export]
macro_rules! declare_reasons {
    ($(#[$doc:meta])+ $enum:ident { $($name:ident $({ $($value:ident: $type:ty),+ })? => $sentence:literal;)+ }) => {
        $(#[$doc])+
        #[derive(Clone, Debug, PartialEq, ::serde::Serialize, ::serde::Deserialize)]
        #[serde(tag = "kind", rename_all = "snake_case")]
        #[allow(missing_docs)] // the values are documented by the sentence
        pub enum $enum {
            $(#[doc = $sentence] $name $({ $($value: $type),+ })?,)+
        }

        impl ::std::fmt::Display for $enum {
            fn fmt(&self, f: &mut ::std::fmt::Formatter<'_>) -> ::std::fmt::Result {
                match self {
                    $(Self::$name $({ $($value),+ })? => write!(f, $sentence),)+
                }
            }
        }

        impl From<$enum> for $crate::error::Reason {
            fn from(reason: $enum) -> Self {
                Self::other(&reason)
            }
        }

        impl $enum {
            /// The reason again, if it is one of these.
            pub fn of(reason: &$crate::error::Reason) -> Option<Self> {
                reason.as_other()
            }

            /// The reason of an error, if it is one of these.
            pub fn of_error(error: &$crate::error::Error) -> Option<Self> {
                let $crate::error::Error::Invalid { reason, .. } = error else { return None };
                Self::of(reason)
            }
        }
    };
}

reasons! {
    // The document
    NotJson { message: String } => "not a Sightline document: {message}";
    Format { format: String, version: u32 } => "this is format \"{format}\" version {version}; only \"sightline\" version 1 is supported";
    DamagedDocument { message: String } => "the document is damaged: {message}";
    InteriorModel => "the photo's own interior orientation must use the model of its camera";
    TargetDiameter => "the diameter of a target must be greater than 0";
    TargetNormal => "the normal of a target must not be 0 in all components";
    ImageSigma => "the standard error of an image observation must be greater than 0 pixels";
    DistanceEnds => "a distance needs two different points";
    DistanceLength => "a distance must be greater than 0";
    DistanceSigma => "the standard error of a distance must be greater than 0";
    RigPosition => "the standard error of a rig's positions must be greater than 0";
    RigRotation => "the standard error of a rig's rotations must be at least 1e-8 radians: no mount is more rigid";
    RigColumns => "every exposure of a rig needs one entry for each of its cameras (at least two): a photo, or null if the camera took none";
    RigCamera => "all photos in a column of a rig must be of one camera, but this column has photos of two cameras";
    NotFinite => "a number is not finite or too large";
    NegativeSigma => "a standard error must be 0 (held) or greater";
    PrincipalDistance => "the principal distance must be greater than 0";
    ParameterNotFinite => "a parameter must be a finite number";
    SensorGrid => "width and height of the sensor grid must be at least one pixel";
    PixelPitch => "the pixel pitch must be greater than 0 millimetres";
    ParameterSigma => "the a priori standard error of a parameter must be greater than 0; leave it out to hold the parameter";
    FocalLengthTwice => "f stands for fx = fy: estimate either f, or fx and fy";

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
    CalibrationPlaces => "1 to 1000 places inside of the image are expected";
    CalibrationUnmeasured => "no photo of this camera has a measurement that took part in the adjustment";
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
    EpochShareMethod => "cameras can be shared only in one adjustment of all epochs: choose the method joint, a variance factor other than separate, the datum of the reference points, and epochs that are projects without a rig and without kept control; or share no camera";
    EpochShareOptions { name: String, first: String } => "epochs \"{first}\" and \"{name}\" were adjusted with different weights, or with variance components: adjust both with the same options, or share no camera";
    EpochCameraMissing { camera: String, name: String } => "epoch \"{name}\" has no camera \"{camera}\": give the camera the same name in all epochs, or do not share it";
    EpochCameraUnlike { camera: String, name: String, first: String } => "camera \"{camera}\" differs between epochs \"{first}\" and \"{name}\" in model, sensor, estimated parameters or held values: use the same settings in both, or do not share it";
    EpochShareMany { points: usize, limit: usize } => "all epochs together have {points} points; at most {limit} can be adjusted together, which shared cameras need: compare fewer epochs or points, or share no camera";
    EpochJointNotConverged => "the joint adjustment of all epochs did not converge: share no camera, or compare coordinates";
    DisplacedApart { given: usize } => "points common to the project and the comparison: {given}; at least three that do not lie on a line are needed to show displacements in its photos: open a project that is one of the epochs";
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
    Missing { name: String } => "{name} is missing";
    NotANumber { name: String, text: String } => "{name} is not a number: \"{text}\"";
    NotPositive { name: String, value: Number } => "{name} is not positive: {value}";
    NoneOf { name: String, choices: String, text: String } => "{name} is none of {choices}: \"{text}\"";
    TooLarge { name: String, text: String } => "{name} is too large: \"{text}\"";
    Scaled { value: Number, factor: Number } => "{value} times {factor} is too large for a document; nothing was converted";

    // The project file
    CannotWriteJson { message: String } => "cannot be written as JSON: {message}";

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
    CodeRing => "a code ring has 2 to 24 sectors and no more bits than sectors";

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
#[macro_export]
macro_rules! declare_words {
    ($(#[$doc:meta])+ $enum:ident { $($name:ident = $json:literal => $english:literal;)+ }) => {
        $(#[$doc])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq, ::serde::Serialize, ::serde::Deserialize)]
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

        impl ::std::fmt::Display for $enum {
            fn fmt(&self, f: &mut ::std::fmt::Formatter<'_>) -> ::std::fmt::Result {
                f.write_str(match self {
                    $(Self::$name => $english,)+
                })
            }
        }
    };
}

declare_words! {
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

declare_words! {
    /// Kinds of items that can be missing.
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

declare_words! {
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
            Reason::ImageSigma,
            Reason::NotANumber { name: "Y".into(), text: "zwei".into() },
            Reason::NotOfKind { name: "u".into(), expected: Expected::FiniteNumber },
            Reason::NoSuchOption { name: "a".into(), known: Names(vec!["b".into(), "c".into()]) },
            Reason::AxisRatio { value: 1.5.into() },
            Reason::DiametersSwapped { min_diameter: 0.1.into(), max_diameter: (-0.3).into() },
        ] {
            let error = Error::Invalid { reason, at: Place::line(3) };
            let json = serde_json::to_string(&error).unwrap();
            assert_eq!(serde_json::from_str::<Error>(&json).unwrap(), error, "{json}");
        }
    }

    /// What is no finite number is what such a sentence is about: it must not prevent the sentence from being written.
    #[test]
    fn numbers_that_json_has_not_travel_too() {
        let error = Error::Invalid { reason: Reason::Unmodelled { value: f64::NAN.into() }, at: Place::default() };
        let json = serde_json::to_string(&error).unwrap();
        assert_eq!(serde_json::from_str::<Error>(&json).unwrap().to_string(), error.to_string());
        assert!(error.to_string().contains("NaN"));
    }

    mod above {
        crate::declare_reasons! {
            /// Reasons of a crate above.
            AboveReason {
                Nothing => "there is nothing";
                TooLarge2 { value: f64, limit: usize } => "{value} is more than {limit}";
            }
        }
    }

    /// The engine carries what it does not know: through JSON and back, told by the crate that declared it.
    #[test]
    fn reasons_of_crates_above_travel_too() {
        use above::AboveReason;
        for reason in [AboveReason::Nothing, AboveReason::TooLarge2 { value: 0.1, limit: 3 }] {
            let error = Error::Invalid { reason: reason.clone().into(), at: Place::field("x") };
            assert!(error.to_string().contains(&reason.to_string()), "{error}");
            let json = serde_json::to_value(&error).unwrap();
            assert_eq!(json["reason"], serde_json::to_value(&reason).unwrap(), "no field more, none less");
            let again: Error = serde_json::from_value(json).unwrap();
            assert_eq!(again, error);
            assert_eq!(AboveReason::of_error(&again), Some(reason));
        }
        assert_eq!(AboveReason::of(&Reason::ImageSigma), None);
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
