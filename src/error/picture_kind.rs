//! Kinds of unsupported picture files, as data. In JSON each is its English name.

use std::fmt;

use serde::{Deserialize, Serialize};

use PictureKind as K;

/// What a picture that is not read is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "String", into = "String")]
pub enum PictureKind {
    /// A format by its own name, which is the same in every language: WebP.
    Named(String),
    /// A sensor's samples in a maker's format; empty where that is not known.
    Raw(String),
    /// Those of a sensor whose colours lie above each other.
    RawLayered(String),
    /// Those with so many samples a pixel.
    RawSamples(String, usize),
    /// Those of a camera.
    RawCamera(String, String),
    /// HEIF of items of a kind.
    HeifOf(String),
    /// HEIF of pictures laid over each other.
    HeifOverlay,
    /// A kind of a format that is seldom written.
    Rare(String),
    /// MP4 or QuickTime.
    Video,
    /// Samples that are no whole numbers.
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
    /// JPEG whose height stands behind its samples.
    JpegWithoutHeight,
}

/// Those without values.
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
    /// Whether it is the samples of a sensor.
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
    /// The kind of these words; words of no other are a name.
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
    fn every_kind_is_its_words_in_json_and_comes_back() {
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
