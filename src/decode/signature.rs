//! The kind of a file from its first bytes: supported formats, and common unsupported ones.

use std::fmt;

use super::bytes::TiffReader;
use crate::error::PictureKind;

/// Kind of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Signature {
    /// JPEG.
    Jpeg,
    /// PNG.
    Png,
    /// TIFF or BigTIFF that holds a developed picture.
    Tiff,
    /// BMP.
    Bmp,
    /// A format whose decoder is not in the engine.
    Packed(Packed),
    /// A known format that is not read, by name.
    Other(&'static str),
    /// A film.
    Video,
    /// Nothing known.
    Unknown,
}

/// A format whose decoder is in a module of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Packed {
    /// HEIC or HEIF, by name.
    Heif(&'static str),
    /// A sensor's samples in a maker's format; empty if that is not known.
    Raw(&'static str),
}

impl Packed {
    /// Whether it holds the samples of a sensor.
    pub fn is_raw(self) -> bool {
        matches!(self, Self::Raw(_))
    }
}

impl From<Packed> for PictureKind {
    fn from(packed: Packed) -> Self {
        match packed {
            Packed::Heif(name) => Self::Named(name.into()),
            Packed::Raw(format) => Self::Raw(format.into()),
        }
    }
}

impl fmt::Display for Packed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        PictureKind::from(*self).fmt(f)
    }
}

/// Formats that are recognised but not read by the engine itself: offset of the signature, the signature, the format.
const OTHERS: [(usize, &[u8], Signature); 24] = [
    (0, b"FUJIFILMCCD-RAW", Signature::Packed(Packed::Raw("Fujifilm RAF"))),
    (0, b"IIU\0", Signature::Packed(Packed::Raw("Panasonic RW2"))),
    (0, b"IIRO", Signature::Packed(Packed::Raw("Olympus ORF"))),
    (0, b"IIRS", Signature::Packed(Packed::Raw("Olympus ORF"))),
    (0, b"MMOR", Signature::Packed(Packed::Raw("Olympus ORF"))),
    (0, b"FOVb", Signature::Packed(Packed::Raw("Sigma X3F"))),
    (0, b"\0MRM", Signature::Packed(Packed::Raw("Minolta MRW"))),
    (8, b"CR\x02", Signature::Packed(Packed::Raw("Canon CR2"))),
    (4, b"ftypcrx", Signature::Packed(Packed::Raw("Canon CR3"))),
    (4, b"ftypheic", Signature::Packed(Packed::Heif("HEIC"))),
    (4, b"ftypheix", Signature::Packed(Packed::Heif("HEIC"))),
    (4, b"ftyphevc", Signature::Packed(Packed::Heif("HEIC"))),
    (4, b"ftypmif1", Signature::Packed(Packed::Heif("HEIF"))),
    (4, b"ftypmsf1", Signature::Packed(Packed::Heif("HEIF"))),
    (4, b"ftypavif", Signature::Other("AVIF")),
    (4, b"ftyp", Signature::Video),
    (8, b"WEBP", Signature::Other("WebP")),
    (0, b"GIF8", Signature::Other("GIF")),
    (0, b"8BPS", Signature::Other("Photoshop")),
    (0, b"\0\0\0\x0cJXL ", Signature::Other("JPEG XL")),
    (0, b"\xff\x0a", Signature::Other("JPEG XL")),
    (0, b"\0\0\0\x0cjP  ", Signature::Other("JPEG 2000")),
    (0, b"\x76\x2f\x31\x01", Signature::Other("OpenEXR")),
    (0, b"%PDF", Signature::Other("PDF")),
];

/// Recognises a file by its content; names and extensions play no part.
pub fn signature(bytes: &[u8]) -> Signature {
    let at = |offset: usize, text: &[u8]| bytes.get(offset..).is_some_and(|rest| rest.starts_with(text));
    if let Some((.., other)) = OTHERS.iter().find(|(offset, text, _)| at(*offset, text)) {
        return *other;
    }
    if at(0, b"\xff\xd8\xff") {
        return Signature::Jpeg;
    }
    if at(0, b"\x89PNG\r\n\x1a\n") {
        return Signature::Png;
    }
    if at(0, b"II*\0") || at(0, b"MM\0*") || at(0, b"II+\0") || at(0, b"MM\0+") {
        return tiff(bytes);
    }
    // Two letters are little evidence: the size in the header has to fit too.
    if at(0, b"BM") && bytes.len() > 26 && bytes[6..10] == [0; 4] {
        return Signature::Bmp;
    }
    Signature::Unknown
}

/// Tells developed pictures from the RAW formats that are built on TIFF.
///
/// Those begin with a reduced preview (NEF, ARW, PEF), carry a DNG version or a colour filter array; decoding the first
/// directory would quietly measure a thumbnail.
fn tiff(bytes: &[u8]) -> Signature {
    const NEW_SUBFILE_TYPE: u16 = 254;
    const PHOTOMETRIC: u16 = 262;
    const SUB_DIRECTORIES: u16 = 330;
    const DNG_VERSION: u16 = 50706;
    const COLOUR_FILTER_ARRAY: u64 = 32803;
    let Some(reader) = TiffReader::tiff(bytes) else { return Signature::Tiff };
    let entries = reader.entries();
    let value = |tag| entries.iter().find(|e| e.tag == tag).and_then(|e| reader.first(e));
    if value(DNG_VERSION).is_some() {
        return Signature::Packed(Packed::Raw("DNG"));
    }
    let preview = value(NEW_SUBFILE_TYPE) == Some(1) && value(SUB_DIRECTORIES).is_some();
    if preview || value(PHOTOMETRIC) == Some(COLOUR_FILTER_ARRAY) {
        return Signature::Packed(Packed::Raw(""));
    }
    Signature::Tiff
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    /// A TIFF file of one directory with short entries.
    fn directory(entries: &[(u16, u16)]) -> Vec<u8> {
        let mut bytes = b"II*\0\x08\0\0\0".to_vec();
        bytes.extend((entries.len() as u16).to_le_bytes());
        for (tag, value) in entries {
            bytes.extend(tag.to_le_bytes());
            bytes.extend(3u16.to_le_bytes());
            bytes.extend(1u32.to_le_bytes());
            bytes.extend(u32::from(*value).to_le_bytes());
        }
        bytes.extend([0; 4]);
        bytes
    }

    #[test]
    fn foreign_formats_are_named() {
        assert_eq!(signature(b"\0\0\0\x18ftypheic\0\0\0\0mif1heic"), Signature::Packed(Packed::Heif("HEIC")));
        assert_eq!(signature(b"II*\0\x10\0\0\0CR\x02\0"), Signature::Packed(Packed::Raw("Canon CR2")));
        assert_eq!(signature(b"\0\0\0\x18ftypisom"), Signature::Video);
        assert_eq!(signature(b"RIFF\x10\0\0\0WEBPVP8 "), Signature::Other("WebP"));
        assert_eq!(signature(b"hello, this is text"), Signature::Unknown);
        assert_eq!(signature(b""), Signature::Unknown);
    }

    #[test]
    fn raw_files_built_on_tiff_are_told_from_pictures() {
        assert_eq!(signature(&directory(&[(254, 0), (262, 1)])), Signature::Tiff);
        assert_eq!(signature(&directory(&[(254, 1), (262, 2), (330, 999)])), Signature::Packed(Packed::Raw("")));
        assert_eq!(signature(&directory(&[(262, 32803)])), Signature::Packed(Packed::Raw("")));
        assert_eq!(signature(&directory(&[(262, 2), (50706, 1)])), Signature::Packed(Packed::Raw("DNG")));
        assert_eq!(signature(b"II*\0\xff\xff\xff\xff"), Signature::Tiff);
    }
}
