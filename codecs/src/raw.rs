//! RAW files of all makers: the sensor's samples as they were read out, neither balanced nor interpolated nor warped.
//!
//! Black levels, the white level and the lit part come along; linearisation tables of the file, which only undo how it was packed, are
//! applied by the decoder. The lists of corrections that a DNG carries are named, not made.

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
use crate::damage::{broken, check_size, said, unread};

/// Pixels that a byte describes at most: packers of sensors halve, at best quarter, what noise leaves to pack. Pictures without any,
/// as tests draw them, pack further.
const MOST_FROM_A_BYTE: u64 = 64;

/// Opens a file; `named` is what its first bytes say of its format.
pub fn unpack(bytes: &[u8], named: &str, wanted: Wanted) -> Result<Unpacked> {
    let raw = FlashRaw::open_with(bytes, bounds()).map_err(|fault| refused(fault, named))?;
    let frame = raw.frame_info();
    check_size([frame.width, frame.height], bytes.len(), MOST_FROM_A_BYTE)?;
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
        active_area: lit(frame),
        black: black(&decoded.black_level, frame),
        white: f64::from(decoded.white_level.min()).min(65535.0),
    });
    let samples = samples(decoded, frame, wanted.channel)?;
    Ok(Unpacked { header, samples: Samples::U16(samples), small })
}

fn bounds() -> Limits {
    // three samples a pixel in linear files
    Limits::default().with_max_samples(3 * limits::PIXELS).with_max_dimension(65_535)
}

/// The filters; none where every pixel has all colours. Other layouts are refused by name.
fn pattern(frame: &FrameInfo, format: &str) -> Result<Option<Pattern>> {
    let parsed = |letters: &str, width| Pattern::parse(letters, width).ok_or_else(|| broken(Damage::Header)).map(Some);
    match (frame.layout, &frame.cfa) {
        (SensorLayout::Foveon, _) => Err(unread(PictureKind::RawLayered(format.into()))),
        (_, None) if frame.cpp == 3 => Ok(None),
        (SensorLayout::Monochrome, _) if frame.cpp == 1 => parsed("W", 1),
        (_, Some(cfa)) if frame.cpp == 1 => {
            let letters: String = cfa.colors().into_iter().map(CfaColor::letter).collect();
            parsed(&letters, cfa.width())
        }
        _ => Err(unread(PictureKind::RawSamples(format.into(), frame.cpp as usize))),
    }
}

/// The part that light reaches.
fn lit(frame: &FrameInfo) -> [u32; 4] {
    let area = frame.active_area.clamp_to(frame.width, frame.height);
    if area.is_empty() { [0, 0, frame.width, frame.height] } else { [area.x, area.y, area.width, area.height] }
}

fn black(level: &BlackLevel, frame: &FrameInfo) -> Black {
    let each = |list: &[f32]| list.iter().map(|level| f64::from(*level)).collect::<Vec<_>>();
    let (rows, columns) = (usize::from(level.rows.max(1)), usize::from(level.cols.max(1)));
    let places = (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y)));
    // at() adds what rows and columns have of their own, which is kept apart
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

/// One sample a pixel: those of the sensor, or the channel of a file that is developed already.
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

/// Rows of which a part is missing.
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

/// What the decoder refuses, in our words.
fn refused(fault: Fault, named: &str) -> Error {
    match fault {
        Fault::UnsupportedFormat(_) => unread(PictureKind::Raw(named.into())),
        Fault::UnsupportedCompression { format, compression } => {
            unread(PictureKind::Raw(format!("{format}, {compression}")))
        }
        Fault::CameraUnsupported { make, model, .. } => {
            unread(PictureKind::RawCamera(named.into(), format!("{make} {model}")))
        }
        Fault::CorruptFile { .. } => said(&fault),
        other => said(&other),
    }
}
