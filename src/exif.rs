//! Camera data of a photo's EXIF block. Hints for initial values, never measurements.

mod makers;

use std::io::Cursor;

use exif::experimental::Writer;
use exif::{Exif, Field, In, Rational, Tag, Value};
use serde::{Deserialize, Serialize};

pub use makers::{Aberration, LensCorrection, Setting};

/// Contents of the EXIF block; values that are absent or invalid are `None`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct PhotoInfo {
    /// Maker of the camera.
    pub make: Option<String>,
    /// Model of the camera.
    pub model: Option<String>,
    /// Focal length in millimetres.
    pub focal_length_mm: Option<f64>,
    /// Focal length of the 35 mm film camera with the same angle of view, in millimetres.
    pub focal_length_35mm: Option<f64>,
    /// Width and height of a pixel in millimetres, from the focal plane resolution.
    pub pixel_pitch: Option<[f64; 2]>,
    /// How the stored grid has to be turned for showing, 1 to 8 (1: not at all). Coordinates stay on the stored grid.
    pub orientation: u8,
    /// When it was taken, as `YYYY-MM-DDThh:mm:ss`, local time of the camera.
    pub date: Option<String>,
    /// Corrections of the lens that the maker's note lists.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub corrections: Vec<LensCorrection>,
}

impl Default for PhotoInfo {
    fn default() -> Self {
        Self {
            make: None,
            model: None,
            focal_length_mm: None,
            focal_length_35mm: None,
            pixel_pitch: None,
            orientation: 1,
            date: None,
            corrections: Vec::new(),
        }
    }
}

impl PhotoInfo {
    /// Initial principal distance in pixels of a grid of `width` x `height` pixels: focal length over pixel pitch, or
    /// from the 35 mm equivalent, whose frame has a diagonal of 43.27 mm.
    pub fn principal_distance_px(&self, width: u32, height: u32) -> Option<f64> {
        let from_pitch = self.focal_length_mm.zip(self.pixel_pitch).map(|(f, pitch)| f / pitch[0]);
        let diagonal = f64::from(width).hypot(f64::from(height));
        from_pitch.or_else(|| self.focal_length_35mm.map(|f| f * diagonal / 36f64.hypot(24.0)))
    }
}

/// Reads the EXIF block of a JPEG, TIFF or PNG file. Never fails: what cannot be read is absent.
pub fn read(bytes: &[u8]) -> PhotoInfo {
    let mut reader = exif::Reader::new();
    reader.continue_on_error(true);
    let block = reader.read_from_container(&mut Cursor::new(bytes));
    match block.or_else(|error| error.distill_partial_result(|_| {})) {
        Ok(block) => info(&block),
        Err(_) => PhotoInfo::default(),
    }
}

/// The equivalent EXIF block, a TIFF file without a picture; orientation 1 is not written.
pub fn write(info: &PhotoInfo) -> Vec<u8> {
    let ascii = |text: &String| Value::Ascii(vec![text.clone().into_bytes()]);
    // Ten-thousandths: fine enough for what is engraved, and within 32 bits for every sensor that exists.
    let rational = |x: f64| Value::Rational(vec![Rational { num: (x * 1e4).round() as u32, denom: 10_000 }]);
    let short = |n: f64| Value::Short(vec![n.round() as u16]);
    let per_cm = |k: usize| info.pixel_pitch.map(|pitch| rational(10.0 / pitch[k]));
    let date = info.date.as_ref().map(|date| date.replace('-', ":").replace('T', " "));
    let entries = [
        (Tag::Make, info.make.as_ref().map(ascii)),
        (Tag::Model, info.model.as_ref().map(ascii)),
        (Tag::Orientation, (info.orientation != 1).then(|| short(info.orientation.into()))),
        (Tag::DateTimeOriginal, date.as_ref().map(ascii)),
        (Tag::FocalLength, info.focal_length_mm.map(rational)),
        (Tag::FocalLengthIn35mmFilm, info.focal_length_35mm.map(short)),
        (Tag::FocalPlaneXResolution, per_cm(0)),
        (Tag::FocalPlaneYResolution, per_cm(1)),
        (Tag::FocalPlaneResolutionUnit, info.pixel_pitch.map(|_| short(3.0))),
    ];
    let field = |(tag, value): (Tag, Option<Value>)| value.map(|value| Field { tag, ifd_num: In::PRIMARY, value });
    let fields: Vec<Field> = entries.into_iter().filter_map(field).collect();
    let mut writer = Writer::new();
    fields.iter().for_each(|field| writer.push_field(field));
    let mut file = Cursor::new(Vec::new());
    // Writing to memory fails only for values of kinds that are not used here.
    if writer.write(&mut file, false).is_err() {
        return Vec::new();
    }
    file.into_inner()
}

fn info(block: &Exif) -> PhotoInfo {
    PhotoInfo {
        make: text(block, Tag::Make),
        model: text(block, Tag::Model),
        focal_length_mm: positive(block, Tag::FocalLength),
        focal_length_35mm: positive(block, Tag::FocalLengthIn35mmFilm),
        pixel_pitch: pixel_pitch(block),
        orientation: positive(block, Tag::Orientation).filter(|n| *n <= 8.0).map_or(1, |n| n as u8),
        date: text(block, Tag::DateTimeOriginal).or_else(|| text(block, Tag::DateTime)).and_then(|d| iso_date(&d)),
        corrections: corrections(block),
    }
}

/// Corrections listed in the maker's note, if there is one.
fn corrections(block: &Exif) -> Vec<LensCorrection> {
    let note = block.get_field(Tag::MakerNote, In::PRIMARY).map(|field| &field.value);
    let Some(Value::Undefined(_, place)) = note else { return Vec::new() };
    let make = text(block, Tag::Make).unwrap_or_default();
    makers::corrections(block.buf(), *place as usize, block.little_endian(), &make)
}

fn text(block: &Exif, tag: Tag) -> Option<String> {
    let Value::Ascii(lines) = &block.get_field(tag, In::PRIMARY)?.value else { return None };
    // Makers pad with zeros and blanks.
    let text = String::from_utf8_lossy(lines.first()?).trim_matches(['\0', ' ']).to_owned();
    Some(text).filter(|t| !t.is_empty())
}

/// A number above zero.
fn positive(block: &Exif, tag: Tag) -> Option<f64> {
    let value = match &block.get_field(tag, In::PRIMARY)?.value {
        Value::Rational(list) => list.first()?.to_f64(),
        Value::Short(list) => f64::from(*list.first()?),
        Value::Long(list) => f64::from(*list.first()?),
        Value::Double(list) => *list.first()?,
        _ => return None,
    };
    Some(value).filter(|v| v.is_finite() && *v > 0.0)
}

/// Millimetres per resolution unit over resolution; only for sensors that can exist (0.2 to 200 µm).
fn pixel_pitch(block: &Exif) -> Option<[f64; 2]> {
    let unit_mm = match positive(block, Tag::FocalPlaneResolutionUnit).unwrap_or(2.0) as u32 {
        2 => 25.4,
        3 => 10.0,
        4 => 1.0,
        5 => 0.001,
        _ => return None,
    };
    let x = unit_mm / positive(block, Tag::FocalPlaneXResolution)?;
    let y = unit_mm / positive(block, Tag::FocalPlaneYResolution)?;
    let possible = 0.0002..0.2;
    (possible.contains(&x) && possible.contains(&y)).then_some([x, y])
}

/// `YYYY:MM:DD hh:mm:ss` with the separators of ISO 8601; cameras whose clock was never set write zeros or blanks.
fn iso_date(text: &str) -> Option<String> {
    let date = exif::DateTime::from_ascii(text.as_bytes()).ok().filter(|d| d.year > 0 && d.month > 0)?;
    Some(format!(
        "{:04}-{:02}-{:02}T{:02}:{:02}:{:02}",
        date.year, date.month, date.day, date.hour, date.minute, date.second
    ))
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;

    /// A TIFF file of the given entries.
    fn exif_block(entries: Vec<(Tag, Value)>) -> Vec<u8> {
        let fields: Vec<_> =
            entries.into_iter().map(|(tag, value)| Field { tag, ifd_num: In::PRIMARY, value }).collect();
        let mut writer = Writer::new();
        fields.iter().for_each(|field| writer.push_field(field));
        let mut file = Cursor::new(Vec::new());
        writer.write(&mut file, false).unwrap();
        file.into_inner()
    }

    fn ascii(text: &str) -> Value {
        Value::Ascii(vec![text.as_bytes().to_vec()])
    }

    fn rational(num: u32, denom: u32) -> Value {
        Value::Rational(vec![Rational { num, denom }])
    }

    /// The block in a JPEG file that ends after it.
    fn in_jpeg(block: &[u8]) -> Vec<u8> {
        let mut bytes = b"\xff\xd8\xff\xe1".to_vec();
        bytes.extend((block.len() as u16 + 8).to_be_bytes());
        bytes.extend(b"Exif\0\0");
        bytes.extend(block);
        bytes.extend(b"\xff\xd9");
        bytes
    }

    #[test]
    fn where_a_photo_was_taken_is_not_read() {
        let degrees = |d: u32| Value::Rational([d, 30, 15].map(|num| Rational { num, denom: 1 }).to_vec());
        let block = exif_block(vec![
            (Tag::Make, ascii("Maker")),
            (Tag::GPSLatitudeRef, ascii("N")),
            (Tag::GPSLatitude, degrees(47)),
            (Tag::GPSLongitudeRef, ascii("E")),
            (Tag::GPSLongitude, degrees(113)),
        ]);
        let there = exif::Reader::new().read_raw(block.clone()).unwrap();
        assert!(there.get_field(Tag::GPSLatitude, In::PRIMARY).is_some());
        let info = read(&in_jpeg(&block));
        assert_eq!(info, PhotoInfo { make: Some("Maker".into()), ..PhotoInfo::default() });
        let text = serde_json::to_string(&info).unwrap();
        assert!(!text.contains("47") && !text.contains("113"), "{text}");
    }

    #[test]
    fn a_full_block_is_read_from_jpeg_and_tiff() {
        let block = exif_block(vec![
            (Tag::Make, ascii("Maker ")),
            (Tag::Model, ascii("Model 7")),
            (Tag::Orientation, Value::Short(vec![6])),
            (Tag::DateTimeOriginal, ascii("2026:02:03 04:05:06")),
            (Tag::FocalLength, rational(85, 10)),
            (Tag::FocalLengthIn35mmFilm, Value::Short(vec![40])),
            (Tag::FocalPlaneXResolution, rational(2_540_000, 250)),
            (Tag::FocalPlaneYResolution, rational(5080, 1)),
            (Tag::FocalPlaneResolutionUnit, Value::Short(vec![2])),
        ]);
        let expected = PhotoInfo {
            make: Some("Maker".into()),
            model: Some("Model 7".into()),
            focal_length_mm: Some(8.5),
            focal_length_35mm: Some(40.0),
            pixel_pitch: Some([0.0025, 0.005]),
            orientation: 6,
            date: Some("2026-02-03T04:05:06".into()),
            corrections: Vec::new(),
        };
        for bytes in [block.clone(), in_jpeg(&block)] {
            assert_eq!(read(&bytes), expected);
        }
    }

    #[test]
    fn the_maker_s_note_is_found_in_the_block() {
        // one entry of Sony: distortion is corrected if the camera knows the lens
        let note = b"SONY DSC \0\0\0\0\x01\x20\x13\0\x04\0\0\0\x01\0\0\0\x02\0\0\0\0".to_vec();
        let block = exif_block(vec![(Tag::Make, ascii("SONY")), (Tag::MakerNote, Value::Undefined(note, 0))]);
        let (aberration, setting) = (Aberration::Distortion, Setting::Auto);
        let expected = [LensCorrection { aberration, setting, tag: "Sony 0x2013".into() }];
        for bytes in [block.clone(), in_jpeg(&block)] {
            assert_eq!(read(&bytes).corrections, expected);
        }
    }

    #[test]
    fn what_is_written_is_read() {
        let info = PhotoInfo {
            make: Some("Maker".into()),
            model: Some("Model".into()),
            focal_length_mm: Some(8.25),
            focal_length_35mm: Some(40.0),
            pixel_pitch: Some([0.004, 0.0045]),
            orientation: 8,
            date: Some("2026-02-03T04:05:06".into()),
            corrections: Vec::new(),
        };
        let back = read(&write(&info));
        let pitch = back.pixel_pitch.unwrap();
        assert!((pitch[0] / 0.004 - 1.0).abs() < 1e-6 && (pitch[1] / 0.0045 - 1.0).abs() < 1e-6);
        assert_eq!(PhotoInfo { pixel_pitch: info.pixel_pitch, ..back }, info);
        assert_eq!(read(&write(&PhotoInfo::default())), PhotoInfo::default());
    }

    #[test]
    fn nonsense_is_absent() {
        let block = exif_block(vec![
            (Tag::Orientation, Value::Short(vec![9])),
            (Tag::DateTimeOriginal, ascii("0000:00:00 00:00:00")),
            (Tag::FocalLength, rational(5, 0)),
            (Tag::FocalPlaneXResolution, rational(1, 1)),
            (Tag::FocalPlaneYResolution, rational(1, 1)),
        ]);
        assert_eq!(read(&block), PhotoInfo::default());
        assert_eq!(read(b""), PhotoInfo::default());
        assert_eq!(read(b"\xff\xd8\xff\xe1\xff\xff"), PhotoInfo::default());
        let whole = in_jpeg(&exif_block(vec![(Tag::Make, ascii("Maker"))]));
        for end in 0..whole.len() {
            // Cut anywhere it must neither panic nor invent.
            let make = read(&whole[..end]).make;
            assert!(make.is_none_or(|m| m == "Maker"));
        }
    }

    #[test]
    fn principal_distance_comes_from_the_pitch_or_the_equivalent() {
        let mut info = PhotoInfo {
            focal_length_mm: Some(20.0),
            focal_length_35mm: Some(28.0),
            pixel_pitch: Some([0.005, 0.005]),
            ..PhotoInfo::default()
        };
        assert_eq!(info.principal_distance_px(3600, 2400), Some(4000.0));
        info.pixel_pitch = None;
        assert!((info.principal_distance_px(3600, 2400).unwrap() - 2800.0).abs() < 1e-9);
    }
}
