//! Metadata of a RAW file: the camera and the listed corrections.

use flashraw::low_level::codecs::dng_opcodes;
use flashraw::{FrameInfo, RawMetadata};

use sightline::exif::{self, PhotoInfo};

/// The EXIF block where the file is built on TIFF, filled up with what the decoder read from the maker's own.
pub fn info(bytes: &[u8], metadata: &RawMetadata) -> PhotoInfo {
    let block = exif::read(bytes);
    let text = |text: &str| Some(text.trim().to_owned()).filter(|text| !text.is_empty());
    let positive = |value: f64| Some(value).filter(|value| value.is_finite() && *value > 0.0);
    PhotoInfo {
        make: block.make.or_else(|| text(&metadata.make)),
        model: block.model.or_else(|| text(&metadata.model)),
        focal_length_mm: block
            .focal_length_mm
            .or_else(|| metadata.exposure.focal_length.and_then(|f| positive(f.into()))),
        focal_length_35mm: block
            .focal_length_35mm
            .or_else(|| metadata.exposure.focal_length_35mm.and_then(|f| positive(f.into()))),
        orientation: u8::try_from(metadata.orientation.exif()).ok().filter(|n| (1..=8).contains(n)).unwrap_or(1),
        date: block.date.or_else(|| metadata.capture_time.as_deref().and_then(date)),
        ..block
    }
}

/// `YYYY-MM-DDThh:mm:ss` without fractions and zones.
fn date(text: &str) -> Option<String> {
    let date = text.get(..19)?;
    let fits = date.bytes().zip(*b"0000-00-00T00:00:00").all(|(have, want)| match want {
        b'0' => have.is_ascii_digit(),
        other => have == other,
    });
    (fits && !date.starts_with("0000")).then(|| date.to_owned())
}

/// Names of the corrections that a DNG lists, each once, and how many of its lists cannot be read: what those name is not known.
pub fn corrections(frame: &FrameInfo) -> (Vec<String>, usize) {
    let (mut names, mut unread) = (Vec::<String>::new(), 0);
    for list in frame.opcodes.iter().flat_map(|opcodes| &opcodes.lists).filter(|list| !list.is_empty()) {
        let Ok(opcodes) = dng_opcodes::parse(list) else {
            unread += 1;
            continue;
        };
        for opcode in opcodes {
            if !names.iter().any(|name| name == opcode.name()) {
                names.push(opcode.name().to_owned());
            }
        }
    }
    (names, unread)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_lose_their_fractions_and_nonsense_is_absent() {
        assert_eq!(date("2026-02-03T04:05:06.25+09:00").as_deref(), Some("2026-02-03T04:05:06"));
        for nonsense in ["", "2026", "0000-00-00T00:00:00", "2026:02:03 04:05:06", "2026-02-03T04:05:é"] {
            assert_eq!(date(nonsense), None, "{nonsense}");
        }
    }
}
