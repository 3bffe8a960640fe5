//! RAW files of all makers: the sensor's samples as they were read out, without white balance, demosaicing or lens correction.
//!
//! Black levels, the white level and the active area are returned with them. The decoder applies the file's linearisation tables, which
//! only undo its compression. The corrections listed in a DNG (opcode lists) are reported, not applied.

mod about;
mod preview;

use flashraw::{
    BlackLevel, CfaColor, CorruptReason, CorruptionPolicy, DataUnit, DecodeOptions, DecodeUnit, DecodeWarning,
    Error as Fault, FlashRaw, FrameInfo, Limits, OutputFormat, RawFrame, RawPixelData, SensorLayout,
};

use sightline::detection::Channel;
use sightline::error::{Damage, Error, PictureKind, Result};
use sightline::image::Samples;
use sightline::limits;
use sightline::sensor::{Black, Header, Mosaic, Pattern, Unpacked};

use crate::Wanted;
use crate::damage::{broken, check_size, engine_error, unsupported};

/// Maximum number of pixels per byte of the file, against false sizes in damaged headers. Real RAW files have at most 4, since noise
/// does not compress; pictures without noise, as in tests, compress further.
const MAX_PIXELS_PER_BYTE: u64 = 64;

/// Opens a file; `named` is the name of the format that its first bytes indicate.
pub fn unpack(bytes: &[u8], named: &str, wanted: Wanted) -> Result<Unpacked> {
    let raw = FlashRaw::open_with(bytes, bounds()).map_err(|fault| refused(fault, named))?;
    let frame = raw.frame_info();
    check_size([frame.width, frame.height], bytes.len(), MAX_PIXELS_PER_BYTE)?;
    let (corrections, unread_corrections) = about::corrections(frame);
    let mut header = Header {
        format: raw.format().name().into(),
        width: frame.width,
        height: frame.height,
        bits: frame.bits_per_sample.into(),
        info: about::info(bytes, raw.metadata()),
        corrections,
        unread_corrections,
        ..Header::default()
    };
    let mut small = Vec::new();
    if wanted.max_side > 0 {
        (header.small, small) = preview::small(&raw, wanted.max_side).unwrap_or_default();
    }
    if !wanted.samples {
        return Ok(Unpacked { header, samples: Samples::U16(Vec::new()), small });
    }
    let pattern = pattern(frame, raw.format().name())?;
    let decoded = raw
        .decode(DecodeOptions {
            output: OutputFormat::RawU16,
            threads: Some(1),
            limits: bounds(),
            apply_opcodes: false,
            corruption_policy: CorruptionPolicy::Recover,
            ..DecodeOptions::default()
        })
        .map_err(|fault| refused(fault, named))?;
    let units = raw.units();
    header.damaged_rows = decoded.warnings.iter().map(|warning| lost_rows(warning, &units, frame.height)).collect();
    header.mosaic = pattern.map(|pattern| Mosaic {
        pattern,
        active_area: active_area(frame),
        black: black(&decoded.black_level, frame),
        white: f64::from(decoded.white_level.min()).min(65535.0),
    });
    let samples = samples(decoded, frame, wanted.channel)?;
    Ok(Unpacked { header, samples: Samples::U16(samples), small })
}

fn bounds() -> Limits {
    // linear files have three samples per pixel
    Limits::default().with_max_samples(3 * limits::PIXELS).with_max_dimension(65_535)
}

/// The pattern of the colour filters; `None` if every pixel has all channels.
///
/// # Errors
/// Names the layout if it is not supported.
fn pattern(frame: &FrameInfo, format: &str) -> Result<Option<Pattern>> {
    let parsed = |letters: &str, width| Pattern::parse(letters, width).ok_or_else(|| broken(Damage::Header)).map(Some);
    match (frame.layout, &frame.cfa) {
        (SensorLayout::Foveon, _) => Err(unsupported(PictureKind::RawLayered(format.into()))),
        (_, None) if frame.cpp == 3 => Ok(None),
        (SensorLayout::Monochrome, _) if frame.cpp == 1 => parsed("W", 1),
        (_, Some(cfa)) if frame.cpp == 1 => {
            let letters: String = cfa.colors().into_iter().map(CfaColor::letter).collect();
            parsed(&letters, cfa.width())
        }
        _ => Err(unsupported(PictureKind::RawSamples(format.into(), frame.cpp as usize))),
    }
}

/// The area that light reaches: left, top, width and height in pixels.
fn active_area(frame: &FrameInfo) -> [u32; 4] {
    let area = frame.active_area.clamp_to(frame.width, frame.height);
    if area.is_empty() { [0, 0, frame.width, frame.height] } else { [area.x, area.y, area.width, area.height] }
}

fn black(level: &BlackLevel, frame: &FrameInfo) -> Black {
    let each = |list: &[f32]| list.iter().map(|level| f64::from(*level)).collect::<Vec<_>>();
    let (rows, columns) = (usize::from(level.rows.max(1)), usize::from(level.cols.max(1)));
    let places = (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y)));
    // at() would add the differences of rows and columns, which are stored separately
    let plain = BlackLevel { row_deltas: Vec::new(), col_deltas: Vec::new(), ..level.clone() };
    let mut black = Black {
        width: columns,
        levels: places.map(|(x, y)| f64::from(plain.at(x, y, 0))).collect(),
        rows: each(&level.row_deltas),
        columns: each(&level.col_deltas),
    };
    if black.rows.len() != frame.height as usize {
        black.rows.clear();
    }
    if black.columns.len() != frame.width as usize {
        black.columns.clear();
    }
    black
}

/// One sample per pixel: that of the sensor, or the chosen channel of a file that is demosaiced already.
fn samples(decoded: RawFrame, frame: &FrameInfo, channel: Channel) -> Result<Vec<u16>> {
    let pixels = frame.width as usize * frame.height as usize;
    let which = match channel {
        Channel::Red => 0,
        Channel::Grey | Channel::Green => 1,
        Channel::Blue => 2,
    };
    match decoded.data {
        RawPixelData::U16(samples) if samples.len() == pixels => Ok(samples),
        RawPixelData::U16(samples) if samples.len() == 3 * pixels => {
            Ok(samples.chunks_exact(3).map(|pixel| pixel[which]).collect())
        }
        _ => Err(broken(Damage::NoPicture)),
    }
}

/// First row and end of the rows of which a part is missing.
fn lost_rows(warning: &DecodeWarning, units: &[DecodeUnit], height: u32) -> [u32; 2] {
    let unit = |index: u32| units.get(index as usize).map_or([0, height], |unit| [unit.rect.y, unit.rect.bottom()]);
    let rows = |of: DataUnit| of.index().map_or([0, height], unit);
    match &warning.reason {
        CorruptReason::Truncated(cut) => {
            let [first, last] = rows(cut.unit);
            let share = cut.available as f64 / cut.expected.max(1) as f64;
            [first + (f64::from(last - first.min(last)) * share).floor() as u32, last]
        }
        CorruptReason::InvalidUnit { unit, .. } => rows(*unit),
        _ => [0, height],
    }
}

/// The engine's error for an error of the decoder.
fn refused(fault: Fault, named: &str) -> Error {
    match fault {
        Fault::UnsupportedFormat(_) => unsupported(PictureKind::Raw(named.into())),
        Fault::UnsupportedCompression { format, compression } => {
            unsupported(PictureKind::Raw(format!("{format}, {compression}")))
        }
        Fault::CameraUnsupported { make, model, .. } => {
            unsupported(PictureKind::RawCamera(named.into(), format!("{make} {model}")))
        }
        Fault::CorruptFile { .. } => engine_error(&fault),
        other => engine_error(&other),
    }
}
