//! Contents and layout of a report.

use serde::{Deserialize, Serialize};

/// Language of a report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ReportLanguage {
    /// English.
    #[default]
    #[serde(rename = "en")]
    English,
    /// Korean.
    #[serde(rename = "ko")]
    Korean,
}

/// Size of a report's pages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Paper {
    /// 210 x 297 mm.
    #[default]
    A4,
    /// 8.5 x 11 inches.
    Letter,
}

/// A section of the report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Section {
    /// What a client reads: accuracy, scale, datum, what was left out.
    Summary,
    /// Statement after the Guide to the Expression of Uncertainty in Measurement.
    Uncertainty,
    /// How many observations of what, and how many unknowns.
    Observations,
    /// Cameras with their distortion.
    Cameras,
    /// The network and its picture.
    Network,
    /// Exterior orientations.
    Photos,
    /// Object points.
    Points,
    /// Control points, check points and distances.
    Control,
    /// Length measurement errors after VDI/VDE 2634 part 1.
    Lengths,
    /// Tests and their results.
    Statistics,
    /// Residuals photo by photo.
    Residuals,
    /// Rejected observations, with the step that rejected them and the reason.
    GrossErrors,
    /// Measurements on the result: features and coordinate systems.
    Features,
    /// Options, versions and digests: what it takes to compute it again.
    Settings,
    /// Every image observation.
    AllObservations,
}

impl Section {
    /// All, in the order of the report.
    pub const ALL: [Self; 15] = [
        Self::Summary,
        Self::Uncertainty,
        Self::Observations,
        Self::Cameras,
        Self::Network,
        Self::Photos,
        Self::Points,
        Self::Control,
        Self::Lengths,
        Self::Statistics,
        Self::Residuals,
        Self::GrossErrors,
        Self::Features,
        Self::Settings,
        Self::AllObservations,
    ];
}

/// The largest length measurement error that is permitted: constant + length / per.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LengthLimit {
    /// Part that does not depend on the length, in the project's unit.
    pub constant: f64,
    /// The length over this is added; null: nothing is.
    #[serde(default)]
    pub per: Option<f64>,
}

impl LengthLimit {
    /// The limit for a length.
    pub fn of(self, length: f64) -> f64 {
        self.constant + self.per.map_or(0.0, |per| length / per)
    }
}

/// Settings of a report: texts besides the numbers, and layout.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ReportSettings {
    /// Its title; empty: the project's name.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// Name of the person who measured.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub operator: String,
    /// Of the measurement, as it is to be printed.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub date: String,
    /// Free text on the first page; line breaks are kept.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub text: String,
    /// A picture for the first page: a data: URL of a PNG or JPEG file.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub logo: String,
    /// Language; null: English, or the desk's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub language: Option<ReportLanguage>,
    /// Size of the pages.
    pub paper: Paper,
    /// Sections that are left out.
    pub left_out: Vec<Section>,
    /// Coverage factor of expanded uncertainties.
    pub coverage_factor: f64,
    /// The largest length measurement error that is permitted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length_limit: Option<LengthLimit>,
}

impl Default for ReportSettings {
    fn default() -> Self {
        Self {
            title: String::new(),
            operator: String::new(),
            date: String::new(),
            text: String::new(),
            logo: String::new(),
            language: None,
            paper: Paper::A4,
            left_out: vec![Section::AllObservations],
            coverage_factor: 2.0,
            length_limit: None,
        }
    }
}

impl ReportSettings {
    /// Whether nothing was ever set.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// Whether the report has a section.
    pub fn has(&self, section: Section) -> bool {
        !self.left_out.contains(&section)
    }
}
