//! Kinds of unsupported picture files, as data. In JSON each is its English name.

use std::fmt;

use serde::{Deserialize, Serialize};

use PictureKind as K;

/// Kind of a picture file that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "String", into = "String")]
pub enum PictureKind {
    /// A format whose name is the same in every language, for example WebP.
    Named(String),
    /// A RAW file with the name of its format; empty if that is not known.
    Raw(String),
    /// A RAW file of a layered (Foveon) sensor, with the name of its format.
    RawLayered(String),
    /// A RAW file with an unsupported number of samples per pixel: format, number.
    RawSamples(String, usize),
    /// A RAW file of an unsupported camera: format, camera.
    RawCamera(String, String),
    /// HEIF with an unsupported type of items.
    HeifOf(String),
    /// HEIF composed of overlaid pictures.
    HeifOverlay,
    /// A rare variant of the named format.
    Rare(String),
    /// MP4 or QuickTime.
    Video,
    /// Floating-point samples.
    FloatingPoint,
    /// TIFF with a palette of other than 1, 2, 4 or 8 bits.
    DeepPalette,
    /// Lossless JPEG.
    LosslessJpeg,
    /// Hierarchical JPEG.
    HierarchicalJpeg,
    /// JPEG with arithmetic coding.
    ArithmeticJpeg,
    /// JPEG of 12 bits.
    TwelveBitJpeg,
    /// JPEG of other than 8 bits.
    OddJpeg,
    /// JPEG whose height is given after the samples (DNL marker) instead of in the header.
    JpegWithoutHeight,
}

/// Kinds without values, with their names in JSON.
const PLAIN: [(PictureKind, &str); 10] = [
    (K::HeifOverlay, "HEIF of pictures laid over each other"),
    (K::Video, "MP4 or QuickTime video"),
    (K::FloatingPoint, "picture of floating-point samples"),
    (K::DeepPalette, "TIFF with a palette of other than 1, 2, 4 or 8 bits"),
    (K::LosslessJpeg, "lossless JPEG"),
    (K::HierarchicalJpeg, "hierarchical JPEG"),
    (K::ArithmeticJpeg, "JPEG with arithmetic coding"),
    (K::TwelveBitJpeg, "JPEG of 12 bits"),
    (K::OddJpeg, "JPEG of other than 8 bits"),
    (K::JpegWithoutHeight, "JPEG whose height is not in its header"),
];

impl PictureKind {
    /// Whether it is a RAW file.
    pub fn is_raw(&self) -> bool {
        matches!(self, K::Raw(_) | K::RawLayered(_) | K::RawSamples(..) | K::RawCamera(..))
    }
}

impl fmt::Display for PictureKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            K::Named(name) => f.write_str(name),
            K::Raw(format) if format.is_empty() => f.write_str("RAW"),
            K::Raw(format) => write!(f, "RAW ({format})"),
            K::RawLayered(format) => write!(f, "RAW ({format} of a layered sensor)"),
            K::RawSamples(format, samples) => write!(f, "RAW ({format} with {samples} samples a pixel)"),
            K::RawCamera(format, camera) => write!(f, "RAW ({format} of {camera})"),
            K::HeifOf(items) => write!(f, "HEIF of {items}"),
            K::Rare(format) => write!(f, "{format} of a rare kind"),
            plain => f.write_str(PLAIN.iter().find(|(kind, _)| kind == plain).map_or("", |(_, words)| words)),
        }
    }
}

impl From<PictureKind> for String {
    fn from(kind: PictureKind) -> Self {
        kind.to_string()
    }
}

impl From<String> for PictureKind {
    /// The kind with this name in JSON; any other text becomes [`PictureKind::Named`].
    fn from(words: String) -> Self {
        if let Some((kind, _)) = PLAIN.iter().find(|(_, plain)| *plain == words) {
            return kind.clone();
        }
        if words == "RAW" {
            return K::Raw(String::new());
        }
        if let Some(raw) = words.strip_prefix("RAW (").and_then(|rest| rest.strip_suffix(')')) {
            let samples = raw.strip_suffix(" samples a pixel").and_then(|rest| rest.rsplit_once(" with "));
            return if let Some(format) = raw.strip_suffix(" of a layered sensor") {
                K::RawLayered(format.into())
            } else if let Some((format, Ok(samples))) = samples.map(|(format, n)| (format, n.parse())) {
                K::RawSamples(format.into(), samples)
            } else if let Some((format, camera)) = raw.split_once(" of ") {
                K::RawCamera(format.into(), camera.into())
            } else {
                K::Raw(raw.into())
            };
        }
        match (words.strip_prefix("HEIF of "), words.strip_suffix(" of a rare kind")) {
            (Some(items), _) => K::HeifOf(items.into()),
            (None, Some(format)) => K::Rare(format.into()),
            (None, None) => K::Named(words),
        }
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    #[test]
    fn every_kind_is_written_to_json_and_read_back() {
        let with_values = [
            (K::Named("JPEG XL".into()), "JPEG XL"),
            (K::Named("HEIF".into()), "HEIF"),
            (K::Raw(String::new()), "RAW"),
            (K::Raw("Canon CR2".into()), "RAW (Canon CR2)"),
            (K::RawLayered("X3F".into()), "RAW (X3F of a layered sensor)"),
            (K::RawSamples("DNG".into(), 4), "RAW (DNG with 4 samples a pixel)"),
            (K::RawCamera("Nikon NEF".into(), "NIKON Z (x) of y".into()), "RAW (Nikon NEF of NIKON Z (x) of y)"),
            (K::HeifOf("j2k1".into()), "HEIF of j2k1"),
            (K::Rare("PNG".into()), "PNG of a rare kind"),
        ];
        for (kind, words) in with_values.into_iter().chain(PLAIN) {
            let json = serde_json::to_string(&kind).unwrap();
            assert_eq!(json, format!("\"{words}\""));
            assert_eq!(serde_json::from_str::<PictureKind>(&json).unwrap(), kind);
            assert_eq!(kind.is_raw(), words.starts_with("RAW"));
        }
    }
}
