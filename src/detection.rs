//! Result of detection: targets with their centres and standard errors, and rejections with their reasons.

mod chromatic_aberration;

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use crate::ring_code::Family;

pub use chromatic_aberration::{ColourApart, ColoursApart, Lateral, Shift};

/// How a centre is measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Least-squares fit of a rendered ellipse.
    #[default]
    LeastSquares,
    /// Ellipse on sub-pixel edge points.
    Ellipse,
    /// Intensity-weighted centroid.
    Intensity,
    /// Gradient-weighted centroid.
    Gradient,
}

/// Which targets are looked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PolarityChoice {
    /// Both.
    #[default]
    Auto,
    /// Bright on dark.
    Bright,
    /// Dark on bright.
    Dark,
}

/// Contrast of one target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Polarity {
    /// Bright on dark.
    Bright,
    /// Dark on bright.
    Dark,
}

/// Which samples of a colour picture are measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Channel {
    /// A JPEG's own luma plane, as stored; of other coloured pictures luminance, 0.2126 R + 0.7152 G + 0.0722 B.
    #[default]
    Grey,
    /// Red.
    Red,
    /// Green: free of lateral colour where the demosaicing left it alone.
    Green,
    /// Blue.
    Blue,
}

/// Which ring codes are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Codes {
    /// Codes are not read.
    #[default]
    #[serde(rename = "none")]
    None,
    /// Schneider / AICON, 12 bits.
    #[serde(rename = "ring-12")]
    Ring12,
    /// Schneider / AICON, 14 bits.
    #[serde(rename = "ring-14")]
    Ring14,
    /// Schneider / AICON, 16 bits.
    #[serde(rename = "ring-16")]
    Ring16,
    /// Schneider / AICON, 20 bits.
    #[serde(rename = "ring-20")]
    Ring20,
    /// Metashape circular, 12 bits.
    #[serde(rename = "metashape-12")]
    Metashape12,
    /// Metashape circular, 14 bits.
    #[serde(rename = "metashape-14")]
    Metashape14,
    /// Metashape circular, 16 bits.
    #[serde(rename = "metashape-16")]
    Metashape16,
    /// Metashape circular, 20 bits.
    #[serde(rename = "metashape-20")]
    Metashape20,
    /// The one family that explains every ring that was read.
    #[serde(rename = "auto")]
    Auto,
}

impl Codes {
    /// The families that are read.
    pub fn families(self) -> &'static [Family] {
        match self {
            Self::None => &[],
            Self::Ring12 => &[Family::Ring12],
            Self::Ring14 => &[Family::Ring14],
            Self::Ring16 => &[Family::Ring16],
            Self::Ring20 => &[Family::Ring20],
            Self::Metashape12 => &[Family::Metashape12],
            Self::Metashape14 => &[Family::Metashape14],
            Self::Metashape16 => &[Family::Metashape16],
            Self::Metashape20 => &[Family::Metashape20],
            Self::Auto => &Family::ALL,
        }
    }
}

impl From<Family> for Codes {
    fn from(family: Family) -> Self {
        match family {
            Family::Ring12 => Self::Ring12,
            Family::Ring14 => Self::Ring14,
            Family::Ring16 => Self::Ring16,
            Family::Ring20 => Self::Ring20,
            Family::Metashape12 => Self::Metashape12,
            Family::Metashape14 => Self::Metashape14,
            Family::Metashape16 => Self::Metashape16,
            Family::Metashape20 => Self::Metashape20,
        }
    }
}

/// Options of the detection; every default works without tuning.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct DetectOptions {
    /// How centres are measured.
    pub method: Method,
    /// Which targets are looked for.
    pub polarity: PolarityChoice,
    /// Which samples of a colour picture are measured.
    pub channel: Channel,
    /// Which ring codes are read.
    pub codes: Codes,
    /// Smallest minor axis (full length) of a target, in pixels.
    pub min_diameter: f64,
    /// Largest full axis of a target in pixels.
    pub max_diameter: f64,
    /// Smallest ratio of a target's axes, minor over major: the cosine of the steepest view that is measured. What is flatter
    /// is refused, for outlines so narrow are scratches and slits more often than targets.
    pub min_axis_ratio: f64,
}

impl Default for DetectOptions {
    fn default() -> Self {
        Self {
            method: Method::default(),
            polarity: PolarityChoice::default(),
            channel: Channel::default(),
            codes: Codes::default(),
            min_diameter: 5.0,
            max_diameter: 400.0,
            min_axis_ratio: 0.29,
        }
    }
}

/// How good a target's image is.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Quality {
    /// Rms of the fit's residuals, in grey levels (least squares) or pixels (ellipse).
    pub fit_rms: f64,
    /// Standard deviation of the grey noise around the target, in grey levels.
    pub noise: f64,
    /// Width of the edge (sigma of the point spread) in pixels.
    pub edge_width: f64,
    /// Share of the target's pixels that are saturated, 0 to 1.
    pub saturated: f64,
    /// Roundness: minor over major axis.
    pub roundness: f64,
    /// Share of the outline that is occluded or disturbed, 0 to 1.
    pub occluded: f64,
    /// Safety of the code reading, 0 (a coin toss) to 1.
    pub code_margin: Option<f64>,
    /// Why a ring was seen but not read.
    #[serde(deserialize_with = "known_note")]
    pub code_note: Option<CodeNote>,
}

/// Why a ring was seen but not read. The serialised names are part of the JavaScript face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CodeNote {
    /// The ring is set all around.
    AllSet,
    /// The bits are no code of the family.
    NoCode,
    /// Something lies beside the ring or on it.
    Disturbed,
    /// A sector lies between light and dark.
    BetweenLevels,
    /// The sectors may be those of another family, or dots that stand around the target: so of every ring whose arcs all end on a coarser grid,
    /// as those of a code of 8 sectors do on one of 16, unless a photo has mostly codes of the finer one.
    OtherFamily,
    /// No single test rejects it, but several are near their limits, or the ring is small, blurred or a single arc: it may resemble a code by chance.
    Uncertain,
    /// The ring is a code of several families.
    SeveralFamilies,
    /// Two or more ellipses stand where a ring has its sectors: a ring that was not read. They are counted as rejected.
    Unread,
}

/// Kept measurements have sentences here that earlier versions wrote: those are ignored.
fn known_note<'de, D: serde::Deserializer<'de>>(value: D) -> Result<Option<CodeNote>, D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Note {
        Known(CodeNote),
        Other(serde::de::IgnoredAny),
    }
    Ok(match Option::<Note>::deserialize(value)? {
        Some(Note::Known(note)) => Some(note),
        Some(Note::Other(_)) | None => None,
    })
}

/// One way to read a ring.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CodeCandidate {
    /// Family of the code.
    pub family: Family,
    /// Its number there.
    pub number: u32,
    /// Safety of this reading; 0 if it is doubtful within its family.
    pub margin: f64,
}

/// One target of a photo. Pixels, radians.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Target {
    /// Number in its photo, from 1; 0 while it belongs to none.
    #[serde(default)]
    pub id: u32,
    /// Centre, to the right.
    pub u: f64,
    /// Centre, downwards.
    pub v: f64,
    /// Standard error of u.
    pub sigma_u: f64,
    /// Standard error of v.
    pub sigma_v: f64,
    /// Covariance of u and v, in square pixels.
    #[serde(default)]
    pub covariance_uv: f64,
    /// Full major axis.
    pub major: f64,
    /// Full minor axis.
    pub minor: f64,
    /// Angle of the major axis from u towards v.
    pub angle: f64,
    /// Grey difference between target and surroundings, always positive.
    pub contrast: f64,
    /// Bright on dark or dark on bright.
    pub polarity: Polarity,
    /// Number of the ring code, where one was read.
    pub code: Option<u32>,
    /// Family of that code.
    #[serde(default)]
    pub code_family: Option<Family>,
    /// What else the ring may be: every reading of a ring that is not safely one code, and under "auto" what other families read in it,
    /// safely or in doubt: other photos may show that it is of theirs. Empty otherwise.
    #[serde(default)]
    pub code_candidates: Vec<CodeCandidate>,
    /// The rim of a hole in it, about the same centre: of a donut the outer rim is the target, and this is a property of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inner: Option<InnerRim>,
    /// Whether something hides a part of its rim: its centre is that of the ellipse through the edges that are seen
    /// ([`Quality::occluded`] is the share that is not), and it takes no part unless a user names it.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub occluded: bool,
    /// How good the image is.
    pub quality: Quality,
}

/// The inner rim of a donut: an ellipse of the other polarity within the target. Pixels, radians.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct InnerRim {
    /// Centre, to the right.
    pub u: f64,
    /// Centre, downwards.
    pub v: f64,
    /// Standard error of u.
    pub sigma_u: f64,
    /// Standard error of v.
    pub sigma_v: f64,
    /// Covariance of u and v, in square pixels.
    pub covariance_uv: f64,
    /// Full major axis.
    pub major: f64,
    /// Full minor axis.
    pub minor: f64,
    /// Angle of the major axis from u towards v.
    pub angle: f64,
    /// Whether the two centres differ by more than their standard errors explain (at 0.1 %): the hole is punched or printed off the centre,
    /// or perspective moves the two ellipses by different amounts. The target's own centre and standard errors are those of the outer rim.
    pub off_centre: bool,
}

impl InnerRim {
    /// The rim of a target, as that of a hole.
    pub fn of(hole: &Target) -> Self {
        let Target { u, v, sigma_u, sigma_v, covariance_uv, major, minor, angle, .. } = *hole;
        Self { u, v, sigma_u, sigma_v, covariance_uv, major, minor, angle, off_centre: false }
    }

    /// The same with its centre moved.
    pub fn moved(self, [du, dv]: [f64; 2]) -> Self {
        Self { u: self.u + du, v: self.v + dv, ..self }
    }

    /// A target with this rim in place of its own.
    pub fn laid_on(self, target: Target) -> Target {
        let Self { u, v, sigma_u, sigma_v, covariance_uv, major, minor, angle, .. } = self;
        Target { u, v, sigma_u, sigma_v, covariance_uv, major, minor, angle, ..target }
    }
}

impl Target {
    /// Reference of an observation.
    pub fn number(&self) -> Option<u32> {
        Some(self.id).filter(|id| *id > 0)
    }

    /// The same at another place, with the rim of its hole.
    pub fn moved(self, by: [f64; 2]) -> Self {
        let inner = self.inner.map(|inner| inner.moved(by));
        Self { u: self.u + by[0], v: self.v + by[1], inner, ..self }
    }

    /// Number of its code in a family, where it reads safely as one.
    pub fn code_in(&self, family: Family) -> Option<u32> {
        let safe = |c: &&CodeCandidate| c.family == family && c.margin > 0.0;
        // a code without its family gives no information on others
        let own = self.code.filter(|_| self.code_family.is_none_or(|own| own == family));
        self.code_candidates.iter().find(safe).map(|c| c.number).or(own)
    }

    /// Takes its code as one of this family, or as none; how else it was read stays among its candidates, and is why it is none.
    pub fn settle_code(&mut self, family: Family) {
        let code = self.code_in(family);
        if let (Some(number), Some(own)) = (self.code, self.code_family.filter(|own| *own != family)) {
            let margin = self.quality.code_margin.unwrap_or(1.0);
            if !self.code_candidates.iter().any(|c| c.family == own && c.number == number) {
                self.code_candidates.push(CodeCandidate { family: own, number, margin });
            }
            (self.quality.code_margin, self.quality.code_note) = (None, Some(CodeNote::OtherFamily));
        }
        if let Some(c) = self.code_candidates.iter().find(|c| c.family == family && c.margin > 0.0) {
            (self.quality.code_margin, self.quality.code_note) = (Some(c.margin), None);
        }
        (self.code, self.code_family) = (code, code.map(|_| family));
    }
}

/// Why a blob is rejected. The serialised names are part of the JavaScript face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// Smaller than `min_diameter`.
    TooSmall,
    /// Larger than `max_diameter`.
    TooLarge,
    /// Its outline is not an ellipse.
    NotAnEllipse,
    /// Flatter than `min_axis_ratio`.
    TooFlat,
    /// Contrast too low against the noise.
    LowContrast,
    /// Touches another blob.
    Touching,
    /// Too many of its pixels are saturated to place the centre.
    Saturated,
    /// Cut by the border of the photo.
    AtBorder,
    /// Too much of its outline is occluded.
    Occluded,
    /// Part of a code ring, not a target.
    CodeRing,
    /// The fit did not converge.
    NoFit,
}

/// A rejected blob, for showing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rejected {
    /// Place in pixels.
    pub u: f64,
    /// Place in pixels.
    pub v: f64,
    /// Rough diameter in pixels.
    pub diameter: f64,
    /// Why.
    pub reason: Reason,
}

/// Result of one method for a target.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MethodResult {
    /// The method.
    pub method: Method,
    /// Its centre, with everything else that is known of the target.
    pub target: Option<Target>,
    /// Why it has none.
    pub reason: Option<Reason>,
}

/// Properties of a picture that result from exposure and processing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct PictureReport {
    /// Amount of the unsharp mask that its edges show: the share of the difference from a mean that was added; 0 if none is seen.
    /// Of a weak or narrow mask amount x radius^2 is known, to some 30 %, and hardly the one apart from the other. A tone curve, or a JPEG
    /// of a quality of 70 or less, steepens edges too and may be taken for a sharpening.
    pub sharpening: f64,
    /// Sigma of that mean in pixels; 0 if there is none.
    pub sharpening_radius: f64,
    /// Share of samples at the dark end of the scale, 0 to 1.
    pub clipped_dark: f64,
    /// Share of samples at the bright end of the scale, 0 to 1.
    pub clipped_bright: f64,
    /// Compression: how much larger the differences across the borders of blocks of eight are than others, as a share.
    pub compression: f64,
    /// Standard deviation of the noise of single samples, in grey levels.
    pub noise: f64,
    /// Standard error of centres relative to what white noise of the same size would do: sqrt of the mean factor of their variances.
    pub noise_correlation: f64,
    /// Whether the standard errors take the noise of neighbouring samples as independent, as those of all methods but least squares do:
    /// of a compressed picture they are too small (by 1.5 to 9 times in `tests/engine/detect/light.rs`).
    pub white_noise_assumed: bool,
    /// Whether the picture was searched and measured a second time, softened, for targets that its processing hides.
    pub softened: bool,
}

/// Colour of a site's filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Colour {
    /// Red.
    Red,
    /// Green.
    Green,
    /// Blue.
    Blue,
    /// Cyan.
    Cyan,
    /// Magenta.
    Magenta,
    /// Yellow.
    Yellow,
    /// No filter.
    White,
    /// Between green and blue, on a few old sensors.
    Emerald,
}

/// Which samples were measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MeasuredOn {
    /// The sites of one colour of a sensor, each by itself.
    #[default]
    Sites,
    /// A picture interpolated between these sites, which methods other than the fit need.
    InterpolatedSites,
}

/// What was measured on, where it is a sensor's own samples. Levels and noise are in its samples.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct SampleSource {
    /// Which samples.
    pub on: MeasuredOn,
    /// Name of the file's format.
    pub format: String,
    /// Colour of the sites.
    pub colour: Option<Colour>,
    /// Filters of the sensor, one letter a site, row by row.
    pub pattern: Option<String>,
    /// Bits of a sample.
    pub bits: u32,
    /// The part of the grid that light reaches: left, top, width, height.
    pub active_area: Option<[u32; 4]>,
    /// Sample from which one is saturated.
    pub white: Option<f64>,
    /// Growth of a sample's variance with the light in it.
    pub gain: Option<f64>,
    /// Standard deviation of a sample without light, where something dark tells.
    pub read_noise: Option<f64>,
    /// Sites that shine by themselves and were left out of the search.
    pub hot_sites: Option<usize>,
    /// Corrections of the lens that the file names, in its own words; none was made.
    pub corrections: Vec<String>,
    /// Lists of corrections in the file that could not be read: what they name is not known.
    pub unread_corrections: usize,
}

/// Which picture of a file with several is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Page {
    /// Number of the picture, from 1, in the order of the file.
    pub number: usize,
    /// Pictures in the file.
    pub of: usize,
    /// Reduced copies and masks before it, which were skipped.
    pub skipped: usize,
}

/// Result of the detection in one photo.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Detection {
    /// Width of the sensor grid in pixels.
    pub width: u32,
    /// Height of the sensor grid in pixels.
    pub height: u32,
    /// Bits of a sample, 8 or 16.
    pub bits: u32,
    /// Rows of the photo that could not be decoded and were not measured: first row and the row after the last.
    #[serde(default)]
    pub damaged_rows: Vec<[u32; 2]>,
    /// Which picture of the file was measured, where the file has several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub page: Option<Page>,
    /// Properties of the picture that result from exposure and processing.
    #[serde(default)]
    pub picture: PictureReport,
    /// What was measured on, where it is a sensor's own samples.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub measured: Option<SampleSource>,
    /// The targets, from top to bottom.
    pub targets: Vec<Target>,
    /// How many blobs were rejected, by reason.
    pub rejected: BTreeMap<Reason, usize>,
    /// The rejected blobs that could be mistaken for targets, for showing.
    pub rejected_blobs: Vec<Rejected>,
}

impl Detection {
    /// Gives every target a number of its own in the photo; those that have one keep it.
    pub fn number_targets(&mut self) {
        let mut taken = BTreeSet::new();
        for target in &mut self.targets {
            if !taken.insert(target.id) {
                target.id = 0;
            }
        }
        let mut next = taken.last().copied().unwrap_or(0);
        for target in self.targets.iter_mut().filter(|target| target.id == 0) {
            next += 1;
            target.id = next;
        }
    }

    /// The target of a number.
    pub fn target(&self, id: u32) -> Option<&Target> {
        self.targets.iter().find(|target| target.id == id)
    }
}
